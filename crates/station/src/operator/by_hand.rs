//! The axis buttons, the increments and the manual return to the reference point, each in its mode.

use dialect::ModeKind;

use super::{Operator, Said};
use crate::action::{Action, Until};
use crate::library::{LibraryError, Shelf};
use crate::memory;
use crate::session::{HandMove, Session};

/// The increments of STEP, mm or degrees.
const INCREMENTS: [f64; 4] = [0.001, 0.01, 0.1, 1.0];

impl<L: Shelf> Operator<L> {
    /// Moves an axis as the action says; the inner error is why not.
    ///
    /// A button pressed for a time and an increment last until the axis stands. A button without a time stays pressed,
    /// and a return to the reference point goes on by itself: time passes for them by `run`.
    pub(super) fn move_by_hand(
        &mut self,
        action: &Action,
        tell: &mut dyn FnMut(&mut Session<L>, Said),
    ) -> Result<Result<(), String>, LibraryError> {
        let (letter, how) = match self.hand_move(action) {
            Ok(found) => found,
            Err(why) => return Ok(Err(why)),
        };
        let axis = match memory::axis_of(&self.session.configuration().machine, letter) {
            Ok(axis) => axis,
            Err(error) => return Ok(Err(error.0)),
        };
        if let Err(why) = self.session.begin_by_hand(axis, how) {
            return Ok(Err(why));
        }
        match action {
            Action::Jog(_, _, Some(seconds)) => {
                self.run(&Until::Seconds(*seconds), tell)?;
                self.session.stop_by_hand();
            }
            Action::Step(..) => self.run(&Until::Idle, tell)?,
            _ => {}
        }
        Ok(Ok(()))
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
