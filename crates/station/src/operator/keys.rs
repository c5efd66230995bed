//! Keys beside the usual buttons: each does what the control's table says.

use dialect::Key;
use machine::ResetCause;

use super::{Operator, table};
use crate::action::Action;
use crate::library::Shelf;

impl<L: Shelf> Operator<L> {
    /// What the control's table says that a key does.
    pub(super) fn key(&self, name: &str) -> Option<&Key> {
        let keys = &self.session.configuration().control.station.keys;
        keys.iter().find(|(key, _)| key.eq_ignore_ascii_case(name)).map(|(_, does)| does)
    }

    fn no_such_key(&self, name: &str) -> String {
        let keys = &self.session.configuration().control.station.keys;
        if keys.is_empty() {
            return "this control has no such keys".to_owned();
        }
        let known: Vec<_> = keys.iter().map(|(key, _)| key.as_str()).collect();
        format!("no key {name} is known; the keys are {}", known.join(", "))
    }

    /// Presses a key; what it does decides whether it is taken.
    pub(super) fn press_key(&mut self, name: &str) -> Result<(), String> {
        let does = self.key(name).cloned().ok_or_else(|| self.no_such_key(name))?;
        let action = match &does {
            Key::Reset => Action::Reset,
            Key::Mode(mode) => Action::Mode(mode.clone()),
        };
        if let Some(why) = table::refusal(&action, table::situation(&self.session, self.mode())) {
            return Err(why.to_owned());
        }
        match does {
            Key::Mode(mode) => self.turn_mode(&mode),
            Key::Reset => {
                let number = name.get(1..).and_then(|number| number.parse().ok()).unwrap_or(0);
                self.session.reset_by(ResetCause::FunctionKey(number));
                Ok(())
            }
        }
    }
}
