//! The operator at work: actions on a session, refused with a reason where the control would refuse them.

use base::SourceId;
use machine::{Event, EventKind, ResetCause};
use syntax::Cursor;

use crate::library::{Library, LibraryError};
use crate::script::{Action, Show, Until};
use crate::session::{Session, Step};

/// What an action brings to light.
#[derive(Clone, PartialEq, Debug)]
pub enum Said {
    /// Something happened at the machine.
    Event(Event),
    /// The action was refused and changed nothing.
    Refused {
        /// The action as written.
        action: String,
        /// Why.
        why: String,
    },
    /// A display.
    Shown(Shown),
}

/// What a display shows; the values are read from the session at that moment.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Shown {
    /// The codes in force.
    Modal,
    /// Where the axes are.
    Position,
    /// What the station is doing.
    State,
}

/// A program in the control's memory.
#[derive(Clone, PartialEq, Debug)]
pub struct Loaded {
    /// The text it stands in.
    pub source: SourceId,
    /// Its name.
    pub name: String,
    /// Where it begins in that text.
    pub head: Cursor,
}

/// An operator at a session's panel.
pub struct Operator<L> {
    /// The session.
    pub session: Session<L>,
    selected: bool,
}

impl<L: Library> Operator<L> {
    /// An operator at a control that has been powered on.
    pub fn new(mut session: Session<L>) -> Operator<L> {
        session.set_repeats_main(true);
        Operator { session, selected: false }
    }

    /// Performs an action. `find` brings a program by its name, as loaded before. What happens is handed to `tell`.
    ///
    /// # Errors
    /// A text could not be read.
    pub fn perform(
        &mut self,
        action: &Action,
        find: impl FnOnce(&mut L, &str) -> Option<Loaded>,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), LibraryError> {
        let refusal = match action {
            Action::Select(name) => self.select(name, find),
            Action::CycleStart => self.cycle_start(),
            Action::Reset => {
                self.session.reset(ResetCause::Key);
                self.drain(tell)?;
                None
            }
            Action::Input(name, on) => self.session.set_input(name, *on).err(),
            Action::Switch(name, number, on) => self.session.set_switch(name, *number, *on).err(),
            Action::Run(until) => {
                self.run(until, tell)?;
                None
            }
            Action::Show(Show::Other(_)) => Some("this display is not built yet".to_owned()),
            Action::Show(show) => {
                let shown = match show {
                    Show::Modal => Shown::Modal,
                    Show::Position => Shown::Position,
                    _ => Shown::State,
                };
                tell(&mut self.session, Said::Shown(shown));
                None
            }
            Action::NotBuilt(_) => Some("this action is not built yet".to_owned()),
            // Loading needs files: the caller has done it.
            Action::Load(..) => None,
        };
        if let Some(why) = refusal {
            tell(&mut self.session, Said::Refused { action: words_of(action), why });
        }
        Ok(())
    }

    fn select(&mut self, name: &str, find: impl FnOnce(&mut L, &str) -> Option<Loaded>) -> Option<String> {
        if self.session.is_running() {
            return Some("a program is running".to_owned());
        }
        match find(self.session.library_mut(), name) {
            Some(Loaded { source, name, head }) => {
                self.session.interpreter_mut().forget_texts();
                self.session.select(source, &name, head);
                self.selected = true;
                None
            }
            None => Some(format!("there is no program {name} in memory")),
        }
    }

    fn cycle_start(&mut self) -> Option<String> {
        if self.session.alarm().is_some() {
            return Some("an alarm stands; RESET clears it".to_owned());
        }
        if !self.selected {
            return Some("no program is selected".to_owned());
        }
        if self.session.is_running() && !self.session.is_stopped() {
            return Some("the program is running".to_owned());
        }
        self.session.start();
        None
    }

    fn drain(&mut self, tell: &mut dyn FnMut(&mut Session<L>, Said)) -> Result<(), LibraryError> {
        loop {
            match self.session.next() {
                Step::Event(event) => tell(&mut self.session, Said::Event(event)),
                Step::Failed(error) => return Err(error),
                Step::Stopped | Step::Idle => return Ok(()),
            }
        }
    }

    fn run(&mut self, until: &Until, tell: &mut dyn FnMut(&mut Session<L>, Said)) -> Result<(), LibraryError> {
        loop {
            if let Until::Line(line) = until
                && self.session.block_begins().is_some_and(|place| place.line == *line)
            {
                return Ok(());
            }
            let event = match self.session.next() {
                Step::Event(event) => event,
                Step::Failed(error) => return Err(error),
                // It would wait for ever: nobody presses CYCLE START while this action lasts.
                Step::Stopped | Step::Idle => return Ok(()),
            };
            tell(&mut self.session, Said::Event(event));
            let done = match (until, event.kind) {
                (Until::Stop, EventKind::Stop(_)) | (Until::Alarm, EventKind::Alarm(_)) => true,
                (Until::End, EventKind::End { .. }) => return self.drain(tell),
                _ => false,
            };
            if done {
                return Ok(());
            }
        }
    }
}

/// An action in the words of the vocabulary.
fn words_of(action: &Action) -> String {
    let state = |on: &bool| if *on { "on" } else { "off" };
    match action {
        Action::Load(file, _) => format!("load {file}"),
        Action::Select(name) => format!("select {name}"),
        Action::CycleStart => "cycle-start".to_owned(),
        Action::Reset => "reset".to_owned(),
        Action::Input(name, on) => format!("input {name} {}", state(on)),
        Action::Switch(name, None, on) => format!("switch {name} {}", state(on)),
        Action::Switch(name, Some(number), on) => format!("switch {name}={number} {}", state(on)),
        Action::Show(Show::Other(what)) => format!("show {what}"),
        Action::Show(_) => "show".to_owned(),
        Action::Run(_) => "run".to_owned(),
        Action::NotBuilt(line) => line.clone(),
    }
}
