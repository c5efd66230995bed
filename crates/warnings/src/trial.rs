//! Two runs of one program held against each other: what the machine does in both, and where they part.
//!
//! `second-piece`. What: the program run once more does not do the same. Why: it rests on what it left behind, so the
//! first piece is good and the second is not. Do: set at its beginning what it changes on the way.
//! `inherited-state` with `--all-power-on`: the same with the power-on parameters of the control set otherwise.
//!
//! Compared is what happens to a work piece: cuts with their feed, dwells, codes, stops, the end, and where the axes
//! stand after a block that moves. Where the second piece begins elsewhere because the first ended there is no
//! difference yet: an axis counts from the first block that places it (an absolute word, a reference return) or cuts.

mod deed;
mod power_on;
mod second;

pub use power_on::{Outcomes, PowerOn, power_on_trials};
pub use second::second_piece;

use base::{AxisSet, Place};
use dialect::Control;
use station::{Library, LibraryError, Session};

use deed::{Deed, Deeds};

/// Where two runs part: what the one does and the other does not; `None` if one has come to its end.
pub(crate) struct Parting {
    pub one: Option<Deed>,
    pub other: Option<Deed>,
}

impl Parting {
    /// Where it is, and what the one does there and what the other does.
    pub fn words(&self, letters: &[u8], control: &Control) -> (Place, u64, String, String) {
        // What comes first decides: the run that is still at an earlier block does something more there.
        let at = match (self.one, self.other) {
            (Some(one), Some(other)) if one.order < other.order => Some(one),
            (one, other) => other.or(one),
        };
        let Some(at) = at else { return (Place::default(), 0, String::new(), String::new()) };
        let tell = |deed: Option<Deed>, beside: Option<Deed>| match deed {
            Some(deed) if deed.place.block == at.place.block => {
                let beside = beside.filter(|beside| beside.place.block == at.place.block);
                deed.words(beside.as_ref(), letters, control)
            }
            _ => "does nothing more here".to_owned(),
        };
        (at.place, at.order, tell(self.one, self.other), tell(self.other, self.one))
    }
}

/// Runs two sessions side by side to the first thing in which they differ. `placed` are the axes whose places count
/// from the start.
pub(crate) fn compare<L: Library>(
    one: &mut Session<L>,
    other: &mut Session<L>,
    pieces: u64,
    placed: AxisSet,
) -> Result<Option<Parting>, LibraryError> {
    let mut ones = Deeds::new(one, pieces, placed);
    let mut others = Deeds::new(other, pieces, placed);
    loop {
        let (one, other) = (ones.next()?, others.next()?);
        match (&one, &other) {
            (None, None) => return Ok(None),
            (Some(a), Some(b)) if a.is_same(b) => {}
            _ => return Ok(Some(Parting { one, other })),
        }
    }
}
