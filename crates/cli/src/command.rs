//! The commands, one file each, and what running a program has in common.

pub mod check;
pub mod controls;
pub mod coverage;
pub mod diff;
pub mod explain;
mod fix;
pub mod fmt;
pub mod memory;
pub mod operate;
pub mod plot;
pub mod run;
pub mod sheet;
pub mod tape;
pub mod time;
pub mod trace;

use base::{ProgramId, SourceId};
use machine::Event;
use station::{Configuration, Session, Step};

use crate::arguments::SettingArguments;
use crate::failure::Failure;
use crate::setting;
use crate::texts::Texts;

/// A session with the program of `file` selected.
pub fn open(file: &str, arguments: &SettingArguments) -> Result<Session<Texts>, Failure> {
    let configuration = setting::configuration(arguments)?;
    let mut texts = setting::texts(file, arguments)?;
    texts.show_tapes(configuration.fitting.tape_codes(&configuration.control));
    let source = texts.open(file)?;
    Ok(begin_session(configuration, texts, source, file, arguments))
}

/// A session with a program selected, whose text is `source`.
pub fn begin_session(
    configuration: Configuration,
    texts: Texts,
    source: SourceId,
    file: &str,
    arguments: &SettingArguments,
) -> Session<Texts> {
    let mut session = Session::new(configuration, texts);
    session.interpreter_mut().set_loop_limit(arguments.loop_limit);
    session.select(source, &Texts::program_name(file), syntax::Cursor::HEAD);
    session
}

/// Runs the program to its end, `repeat` times, pressing CYCLE START after every stop. Events go to `see`.
pub fn run_through(
    session: &mut Session<Texts>,
    repeat: u64,
    mut see: impl FnMut(&mut Session<Texts>, &Event) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut events = Vec::with_capacity(32);
    for piece in 0..repeat {
        if piece == 0 {
            session.start()
        } else {
            session.start_over()
        }
        loop {
            match session.next_events(&mut events) {
                None => {
                    for event in &events {
                        see(session, event)?;
                    }
                    events.clear();
                }
                Some(Step::Event(event)) => see(session, &event)?,
                Some(Step::Stopped) => session.start(),
                Some(Step::Idle) => break,
                Some(Step::Failed(error)) => return Err(Failure::call(error)),
            }
        }
        if session.alarm().is_some() {
            break;
        }
    }
    Ok(())
}

/// A program's name.
pub fn name_of(session: &Session<Texts>, program: ProgramId) -> &str {
    session.interpreter().program_name(program)
}
