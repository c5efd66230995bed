//! `plot --chart`: speed and the velocity of every axis over time.

use machine::EventKind;
use plot::{Chart, ChartAxis, Kind, Title};

use super::Picture;
use super::driven::run_of;
use crate::arguments::PlotArguments;
use crate::command::{name_of, open, run_through};
use crate::failure::Failure;
use crate::show_alarm::tell_alarm;

/// How close the places are of which velocities are drawn, mm: as close as directions change on the smallest arcs.
const TOLERANCE_MM: f64 = 1e-3;

/// Writes the chart of a program.
pub(super) fn chart(arguments: &PlotArguments, picture: Picture) -> Result<bool, Failure> {
    let mut session = open(&arguments.file, &arguments.setting)?;
    session.plan_ahead_in_detail();
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let title = Title { program: String::new(), control: control.title.clone(), machine: machine.name.clone() };
    let axes = machine.axes.iter().map(|axis| {
        let turns = axis.rotary;
        ChartAxis { letter: char::from(axis.letter), turns }
    });
    let mut chart = Chart::new(title, axes);
    let mut alarmed = false;
    run_through(&mut session, arguments.setting.repeat, |session, event| {
        if let Some(run) = run_of(&event.kind) {
            let end = event.time.0;
            let during = [end - run.seconds, end];
            chart.begin(run.kind, during);
            if run.kind == Kind::Feed {
                chart.commanded(during, run.asked);
                let mut begun = during[0];
                for stretch in session.stretches() {
                    let ends = begun + stretch.leg.seconds;
                    chart.allowed([begun, ends], run.asked, stretch.allowed * 60.0);
                    begun = ends;
                }
            }
            session.sample(TOLERANCE_MM, |since, setpoint| {
                let velocities = setpoint.velocity.map(|velocity| velocity * 60.0);
                chart.moves(run.kind, (during[0] + since).min(end), setpoint.speed() * 60.0, &velocities);
            });
        }
        chart.block(event.place.line, event.time.0);
        match &event.kind {
            EventKind::Start(_) => chart.name(name_of(session, event.place.program)),
            EventKind::Alarm(alarm) => {
                alarmed = true;
                tell_alarm(alarm, control, machine, session.library_mut());
            }
            _ => {}
        }
        Ok(())
    })?;
    picture.write(arguments, &chart.svg())?;
    Ok(!alarmed)
}
