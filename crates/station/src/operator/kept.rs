//! What the station remembers beside the control's cells: programs, the selected one, switches, what was interrupted.

use base::{Place, SourceId, Span};
use syntax::Cursor;

use super::{Operator, memory_key};
use crate::library::{Library, LibraryError, Shelf, Wanted};
use crate::program_text::number_of;
use crate::session::Percents;
use crate::switches::SessionSwitches;
use crate::{Said, Session, TYPED};

/// What the panel's switches and pages stand at.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Panel {
    /// The mode switch.
    pub mode: String,
    /// The switches.
    pub switches: SessionSwitches,
    /// The override switches.
    pub percents: Percents,
    /// The program that is selected, as memory lists it.
    pub selected: Option<String>,
}

/// Where a program was when the power failed.
#[derive(Clone, PartialEq, Debug)]
pub struct Interrupted {
    /// Its name.
    pub program: String,
    /// The block; which text and program it belongs to is found by the name.
    pub place: Place,
}

impl<L: Library> Operator<L> {
    /// The programs in memory: name, as it is shown, the text it stands in, where it begins there.
    pub fn kept_programs(&self) -> impl Iterator<Item = (&str, &str, SourceId, Cursor)> {
        self.programs.iter().map(|(key, loaded)| (key.as_str(), loaded.name.as_str(), loaded.source, loaded.head))
    }
}

impl<L: Shelf> Operator<L> {
    /// How the panel stands.
    pub fn panel(&self) -> Panel {
        Panel {
            mode: self.mode().name.clone(),
            switches: self.session.switches(),
            percents: self.session.percents(),
            selected: self.selected.clone(),
        }
    }

    /// True if the panel stands so; says it without memory being taken for it.
    pub fn stands_at(&self, panel: &Panel) -> bool {
        self.mode().name == panel.mode
            && self.session.switches() == panel.switches
            && self.session.percents() == panel.percents
            && self.selected == panel.selected
    }

    /// Turns the panel as it stood; what this control does not have is left.
    pub fn turn_panel(&mut self, panel: &Panel) {
        let _ = self.turn_mode(&panel.mode);
        self.session.set_percents(panel.percents);
        if let Some(name) = &panel.selected {
            let _ = self.select(name);
        }
    }

    /// The program at whose block the power would interrupt it, or has interrupted it.
    pub fn at_work(&self) -> Option<(&str, Place)> {
        let place = self.session.at_work()?;
        Some((self.session.interpreter().program_name(place.program), place))
    }

    /// The power comes back after it failed in the middle of a program: that is an alarm.
    ///
    /// # Errors
    /// A text could not be read.
    pub fn come_back_from(
        &mut self,
        interrupted: &Interrupted,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<(), LibraryError> {
        let name = interrupted.program.as_str();
        let typed = interrupted.place.source == TYPED;
        let source = match self.programs.get(&memory_key(name, self.files())) {
            _ if typed => Some(TYPED),
            Some(loaded) => Some(loaded.source),
            None => match number_of(name) {
                Some(number) => self.session.library_mut().find_program(Wanted::Number(number, ""))?,
                None => None,
            },
        };
        let program = self.session.interpreter_mut().program_named(name);
        let place = match source {
            Some(source) => Place { program, source, ..interrupted.place },
            // Its text is gone: there is no block to show.
            None => Place { program, line_start: 0, block: Span::default(), ..interrupted.place },
        };
        self.session.come_back_from(place);
        self.drain_told(tell)
    }
}
