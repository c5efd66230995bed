//! The axis buttons, the increments and the manual return to the reference point, each in its mode.

use dialect::ModeKind;

use super::Operator;
use crate::action::{Action, Until};
use crate::library::Shelf;
use crate::memory;
use crate::session::HandMove;

/// The increments of STEP, mm or degrees.
const INCREMENTS: [f64; 4] = [0.001, 0.01, 0.1, 1.0];

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
        let mode = self.mode();
        match (action, mode.kind) {
            (Action::Jog(axis, up, _), ModeKind::Jog | ModeKind::Rapid) => {
                Ok((*axis, HandMove::Button { up: *up, rapid: mode.kind == ModeKind::Rapid }))
            }
            (Action::Step(_, way), ModeKind::Step) if !INCREMENTS.contains(&way.abs()) => {
                Err("the increments of mode step are 0.001, 0.01, 0.1 and 1".to_owned())
            }
            (Action::Step(axis, way), ModeKind::Step | ModeKind::Handle) => Ok((*axis, HandMove::By(*way))),
            (Action::Home(axis), ModeKind::Return) => Ok((*axis, HandMove::Home)),
            _ => Err(format!("{action} does nothing in mode {}", mode.name)),
        }
    }
}
