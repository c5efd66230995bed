//! `run`: the program on the virtual machine, with progress and a summary.

use std::io::{IsTerminal, Write};

use indicatif::{ProgressBar, ProgressStyle};
use machine::EventKind;
use report::{Format, Summary, render};

use super::{name_of, open, run_through};
use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::output::{colour_err, say};
use crate::show_alarm::show_alarm;

/// Blocks between two looks at the progress bar.
const BLOCKS_A_TICK: u64 = 512;

pub fn run(arguments: &RunArguments) -> Result<bool, Failure> {
    let mut session = open(&arguments.file, &arguments.setting)?;
    session.plan_ahead();
    let configuration = session.configuration().clone();
    let (control, machine) = (&configuration.control, &configuration.machine);
    let mut summary = Summary::new(&control.name, &machine.name, machine.axes.iter().map(|axis| axis.letter));
    let progress = progress_bar(session.library().length(base::SourceId(0)), arguments.file == "-");
    let format = Format::Text { colour: colour_err() };
    let mut alarmed = false;
    run_through(&mut session, arguments.setting.repeat, |session, event| {
        summary.add(event);
        match &event.kind {
            EventKind::Start(_) => summary.set_program(name_of(session, event.place.program)),
            EventKind::Alarm(alarm) => {
                alarmed = true;
                let (diagnostic, excerpt) = show_alarm(alarm, control, machine, session.library_mut());
                summary.add_alarm(render(&diagnostic, &excerpt, Format::Json));
                progress.suspend(|| say(&render(&diagnostic, &excerpt, format)));
            }
            EventKind::BlockDone if summary.blocks().is_multiple_of(BLOCKS_A_TICK) => {
                if event.place.source == base::SourceId(0) {
                    progress.set_position(event.place.block.start);
                }
                progress.set_message(format!("{} blocks, line {}", summary.blocks(), event.place.line));
            }
            _ => {}
        }
        Ok(())
    })?;
    progress.finish_and_clear();
    let text = if arguments.json { summary.json() + "\n" } else { summary.text() };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(!alarmed)
}

/// A bar over the file's bytes; of standard input only the blocks done are known.
fn progress_bar(length: u64, is_stdin: bool) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let (bar, template) = if is_stdin {
        (ProgressBar::new_spinner(), "{spinner} {msg}")
    } else {
        (ProgressBar::new(length), "{bar:40} {percent:>3} %  {msg}  {eta} left")
    };
    match ProgressStyle::with_template(template) {
        Ok(style) => bar.with_style(style),
        Err(_) => bar,
    }
}
