//! Why a statement gives no result now.

use base::Condition;
use syntax::Extent;

use crate::pull::Quantity;

/// Why a statement is not carried out now.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Trouble {
    /// It is refused: what is wrong, where in the block, the numbers for the sentence.
    Refused(Condition, Extent, [f64; 3]),
    /// The machine must be asked first; then it is carried out anew.
    Needs(Quantity),
}

impl Trouble {
    pub fn at(condition: Condition, place: Extent) -> Trouble {
        Trouble::Refused(condition, place, [0.0; 3])
    }
}
