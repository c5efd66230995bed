//! Texts in memory, and a control to run them.

#![allow(dead_code)] // each test uses its part

use std::sync::Arc;

use base::SourceId;
use station::{AfterAlarm, Configuration, Library, LibraryError, Session, Setup, Step};
use warnings::{Finding, Watch, look_at_text};

/// One text.
#[derive(Clone, Default)]
pub struct Text(pub Vec<u8>);

impl Library for Text {
    fn read(&mut self, _: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError> {
        let start = (offset as usize).min(self.0.len());
        let end = start.saturating_add(len).min(self.0.len());
        bytes.clear();
        bytes.extend_from_slice(&self.0[start..end]);
        Ok(end == self.0.len())
    }

    fn find_program(&mut self, _: station::Wanted) -> Result<Option<SourceId>, LibraryError> {
        Ok(None)
    }
}

/// The first built-in control on its stock machine.
pub fn configuration() -> Configuration {
    let name = "yasnac-mx1";
    let files = dialect::builtin_files(name).expect("it is built in");
    let control = dialect::load_control(&files).expect("it loads");
    let (file, text) = machine::builtin_machine("unlimited").expect("it is built in");
    let machine = machine::read_machine(&file, text).expect("it loads");
    Configuration::new(Arc::new(control), machine, &[&Setup::default()]).expect("it fits")
}

/// A session at the head of a text.
pub fn session(configuration: &Configuration, text: &[u8]) -> Session<Text> {
    let mut session = Session::new(configuration.clone(), Text(text.to_vec()));
    session.interpreter_mut().set_loop_limit(300);
    session.set_after_alarm(AfterAlarm::GoOn);
    session.select(SourceId(0), "text", syntax::Cursor::HEAD);
    session
}

/// Runs a text under the watch, as far as `most` events, and tells how many there were.
pub fn watched(session: &mut Session<Text>, watch: &mut Watch, most: usize) -> (usize, Vec<Finding>) {
    let (mut events, mut found) = (0, Vec::new());
    session.start();
    while events < most {
        match session.next() {
            Step::Event(event) => {
                events += 1;
                watch.see(&event, session.interpreter(), session.beside());
                if watch.has_found() {
                    found.extend(watch.take());
                }
            }
            Step::Stopped => session.start(),
            Step::Idle => break,
            Step::Failed(error) => panic!("{error}"),
        }
    }
    watch.finish();
    found.extend(watch.take());
    let length = session.library().0.len() as u64;
    found.extend(look_at_text(session, length).expect("it is in memory"));
    (events, found)
}
