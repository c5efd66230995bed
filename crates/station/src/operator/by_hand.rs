//! The axis buttons, the increments and the manual return to the reference point, each in its mode.

use dialect::ModeKind;

use super::Operator;
use crate::action::{Action, Until};
use crate::library::Shelf;
use crate::memory;
use crate::session::HandMove;

impl<L: Shelf> Operator<L> {
    /// Moves an axis as the action says, or says why not.
    ///
    /// A button pressed for a time and an increment last until the axis stands. A button without a time stays pressed,
    /// and a return to the reference point goes on by itself: time passes for them by `run`.
    pub(super) fn move_by_hand(&mut self, action: &Action) -> Result<(), String> {
        let (letter, how) = self.hand_move(action)?;
        let axis = memory::axis_of(&self.session.configuration().machine, letter).map_err(|error| error.0)?;
        self.session.begin_by_hand(axis, how)?;
        match action {
            Action::Jog(_, _, Some(seconds)) => self.last(&Until::Seconds(*seconds), true),
            Action::Step(..) => self.last(&Until::Idle, false),
            _ => {}
        }
        Ok(())
    }

    /// What the action does in the mode in which the station stands.
    fn hand_move(&self, action: &Action) -> Result<(u8, HandMove), String> {
        let (mode, increments) = (self.mode(), &self.session.configuration().control.station.increments);
        match (action, mode.kind) {
            (Action::Jog(axis, up, _), ModeKind::Jog | ModeKind::Rapid) => {
                Ok((*axis, HandMove::Button { up: *up, rapid: mode.kind == ModeKind::Rapid }))
            }
            (Action::Step(_, way), ModeKind::Step) if !increments.contains(&way.abs()) => {
                let mut known: Vec<_> = increments.iter().map(f64::to_string).collect();
                let last = known.pop().unwrap_or_default();
                Err(format!("the increments of mode {} are {} and {last}", mode.name, known.join(", ")))
            }
            (Action::Step(axis, way), ModeKind::Step | ModeKind::Handle) => Ok((*axis, HandMove::By(*way))),
            (Action::Home(axis), ModeKind::Return) => Ok((*axis, HandMove::Home)),
            _ => Err(format!("{action} does nothing in mode {}", mode.name)),
        }
    }
}
