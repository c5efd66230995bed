//! Address letters: what may follow each.

use crate::row::Origin;

/// What an address letter carries.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AddressKind {
    /// A position of a linear axis.
    LinearAxis,
    /// A position of a rotary axis.
    RotaryAxis,
    /// A length beside the axes (I J K R Q); some functions read it as an angle.
    Length,
    /// A code of so many digits (G M B).
    Code,
    /// A whole number (N O H D L S T).
    Number,
    /// A feed.
    Feed,
    /// A time in a dwell, a whole number elsewhere.
    TimeOrNumber,
    /// An argument of a macro call, nothing elsewhere.
    MacroOnly,
}

/// Where a decimal point may stand.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum PointRule {
    /// Anywhere.
    Yes,
    /// Nowhere.
    No,
    /// In a dwell only.
    Dwell,
    /// Before zeros only: `P4.` and `P4.0` are 4, `P4.5` is refused.
    Whole,
}

/// One address letter.
#[derive(Clone, PartialEq, Debug)]
pub struct Address {
    /// The letter.
    pub letter: u8,
    /// What it carries.
    pub kind: AddressKind,
    /// Most digits that may be written, for codes.
    pub digits: u8,
    /// Lowest and highest value in mm, for lengths in metric input.
    pub metric: [f64; 2],
    /// Lowest and highest value in inches, for lengths in inch input.
    pub inch: [f64; 2],
    /// Lowest and highest value in degrees.
    pub rotary: [f64; 2],
    /// Lowest and highest whole number.
    pub range: [i64; 2],
    /// Feed ranges: metric per minute, inch per minute, metric per revolution, inch per revolution.
    pub feed: [[f64; 2]; 4],
    /// 0 takes the feed away, whatever the range.
    pub zero_is_none: bool,
    /// Lowest and highest time in seconds.
    pub seconds: [f64; 2],
    /// Where a point may stand.
    pub point: PointRule,
    /// Name of the alarm when the value is out of range.
    pub alarm: String,
    /// Name of the alarm where the machine has no such axis; `None` is the alarm of any unknown address.
    pub absent: Option<String>,
    /// What it is, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

impl Address {
    /// True if it says something as an axis' word, or in a macro call, and nowhere else.
    pub const fn is_axis_or_macro(&self) -> bool {
        matches!(self.kind, AddressKind::LinearAxis | AddressKind::RotaryAxis | AddressKind::MacroOnly)
    }
}
