//! `run`: the program on the virtual machine, with progress and a summary.

use std::io::Write;

use machine::EventKind;
use report::{Format, Losses, Naming, Summary, render};
use station::Session;

use super::{name_of, open, run_through};
use crate::arguments::{RunArguments, SettingArguments};
use crate::failure::Failure;
use crate::output::{colour_err, say};
use crate::progress::Progress;
use crate::show_alarm::show_alarm;
use crate::texts::Texts;

pub fn run(arguments: &RunArguments) -> Result<bool, Failure> {
    let ran = run_timed(&arguments.file, &arguments.setting, false)?;
    let text = if arguments.json { ran.summary.json() + "\n" } else { ran.summary.text() };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(!ran.alarmed)
}

/// A program that has been run.
pub struct Ran {
    pub session: Session<Texts>,
    pub summary: Summary,
    pub losses: Option<Losses>,
    pub alarmed: bool,
}

/// Runs a program with its true times; alarms are said on standard error. With `why`, what it loses is watched.
pub fn run_timed(file: &str, setting: &SettingArguments, why: bool) -> Result<Ran, Failure> {
    let mut session = open(file, setting)?;
    session.plan_ahead();
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut summary = Summary::new(&control.name, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    summary.tell_whole();
    let mut naming = Naming::default();
    let mut losses = why.then(|| Losses::new(control, machine));
    let mut progress = Progress::new(file, setting);
    let format = Format::Text { colour: colour_err() };
    let mut alarmed = false;
    run_through(&mut session, setting.repeat, |session, event| {
        naming.see(session, event, &mut summary, &mut |texts, source, at, len| texts.excerpt(source, at, len));
        summary.add(event);
        if let Some(losses) = &mut losses {
            losses.see(session, event);
        }
        progress.see(event);
        match &event.kind {
            EventKind::Start(_) => summary.set_program(name_of(session, event.place.program)),
            EventKind::Alarm(alarm) => {
                alarmed = true;
                let (diagnostic, excerpt) = show_alarm(alarm, control, machine, session.library_mut());
                summary.add_alarm(render(&diagnostic, &excerpt, Format::Json));
                progress.suspend(|| say(&render(&diagnostic, &excerpt, format)));
            }
            _ => {}
        }
        Ok(())
    })?;
    progress.finish();
    Ok(Ran { session, summary, losses, alarmed })
}
