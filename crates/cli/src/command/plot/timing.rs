//! `plot --timing`: the signals between control and machine over time.

use machine::{EventKind, Signal};
use meaning::CodeLine;
use plot::{Kind, Timing, Title};
use report::Tracer;

use super::Picture;
use super::driven::run_of;
use crate::arguments::PlotArguments;
use crate::command::{name_of, open, run_through};
use crate::failure::Failure;
use crate::show_alarm::tell_alarm;

/// The row of a code, and its name.
const fn code_row(line: CodeLine) -> (u32, &'static str) {
    match line {
        CodeLine::S => (1, "S"),
        CodeLine::T => (2, "T"),
        CodeLine::B => (3, "B"),
        CodeLine::M => (4, "M"),
    }
}

/// The row of a line; the bits of codes stand in the row of the code.
const fn signal_row(signal: Signal) -> Option<u32> {
    Some(match signal {
        Signal::Bit(..) => return None,
        Signal::Strobe(line, _) => 10 + code_row(line).0,
        Signal::Fin => 20,
        Signal::Den => 21,
        Signal::Decoded(code) => 30 + code,
        Signal::Eop => 1000,
        Signal::Rwd => 1001,
        Signal::Skip => 1010,
        Signal::Interrupt => 1011,
        Signal::SpindleStands => 1020,
        Signal::SpeedReached => 1021,
        Signal::Oriented => 1022,
        Signal::Limit(..) => 1030,
        Signal::Deceleration(..) => 1031,
        // In the builder's order: outputs, then inputs.
        Signal::Line(line) => 1100 + line as u32,
    })
}

/// Writes the chart of a program's signals.
pub(super) fn timing(arguments: &PlotArguments, picture: Picture) -> Result<bool, Failure> {
    let mut session = open(&arguments.file, &arguments.setting)?;
    session.tell_signals(true);
    session.plan_ahead();
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut tracer = Tracer::new(control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    tracer.name_lines(machine.logic.lines.iter().map(|line| line.name.as_str()));
    let title = Title { program: String::new(), control: control.title.clone(), machine: machine.name.clone() };
    let mut timing = Timing::new(title, arguments.during.map(|during| during.0));
    let mut alarmed = false;
    run_through(&mut session, arguments.setting.repeat, |session, event| {
        let time = event.time.0;
        if let Some(run) = run_of(&event.kind) {
            timing.moves(run.kind == Kind::Feed, [time - run.seconds, time]);
        }
        match &event.kind {
            EventKind::Start(_) => timing.name(name_of(session, event.place.program)),
            EventKind::Code(code) => {
                let ((row, name), digits) = (code_row(code.line), usize::from(code.digits));
                timing.code(row, name, time, format!("{:0digits$}", code.code));
            }
            EventKind::Signal(signal, on) => {
                if *signal == Signal::Fin && !on {
                    timing.codes_off(time);
                }
                if let Some(row) = signal_row(*signal) {
                    timing.edge(row, &tracer.signal_name(*signal), time, *on);
                }
            }
            EventKind::Alarm(alarm) => {
                alarmed = true;
                tell_alarm(alarm, control, machine, session.library_mut());
            }
            _ => {}
        }
        Ok(())
    })?;
    picture.write(arguments, &timing.svg())?;
    Ok(!alarmed)
}
