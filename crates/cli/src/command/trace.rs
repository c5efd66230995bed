//! `trace`: every executed event as JSON Lines.

use machine::EventKind;
use report::Tracer;

use super::{open, run_through};
use crate::arguments::TraceArguments;
use crate::failure::Failure;
use crate::output::Output;
use crate::show_alarm::tell_alarm;

pub fn trace(arguments: &TraceArguments) -> Result<bool, Failure> {
    let mut session = open(&arguments.file, &arguments.setting)?;
    session.interpreter_mut().tell_variables(true);
    session.tell_signals(arguments.io);
    // Where a switch stops a move is a matter of how the axes brake.
    let stops = !session.configuration().machine.limit_switches().is_empty();
    if arguments.time || arguments.io || stops {
        session.plan_ahead();
    }
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut tracer = Tracer::new(control, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    tracer.name_lines(machine.logic.lines.iter().map(|line| line.name.as_str()));
    tracer.with_time = arguments.time;
    tracer.with_io = arguments.io;
    let mut output = Output::new();
    let mut alarmed = false;
    run_through(&mut session, arguments.setting.repeat, |session, event| {
        let mut diagnostic = None;
        if let EventKind::Alarm(alarm) = &event.kind {
            alarmed = true;
            output.flush()?;
            diagnostic = Some(tell_alarm(alarm, control, machine, session.library_mut()).0);
        }
        let interpreter = session.interpreter();
        tracer.write(event, |program| interpreter.program_name(program), diagnostic.as_ref(), &mut output.buffer);
        output.pass()
    })?;
    output.flush()?;
    Ok(!alarmed)
}
