//! The rows of a control's tables, each with what it rests on.

use crate::meaning::{MMeaning, Meaning};

/// How sure a statement about a control is; each control's `control.toml` says what its letters mean.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Certainty(pub char);

/// What a row rests on.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Origin {
    /// How sure it is.
    pub certainty: Certainty,
    /// Document and section, or "assumed" with the reason.
    pub source: String,
}

/// Whether a control of this kind has a code.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Division {
    /// Always.
    Basic,
    /// With the option of this index fitted.
    Option(u8),
    /// Only related controls have it.
    Sibling,
}

/// What may stand beside a G code, on a control whose codes have classes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Class {
    /// It changes a state: before a movement code, of different groups.
    #[default]
    State,
    /// It moves axes: one a block.
    Movement,
    /// It stands alone.
    Solo,
    /// It changes how the block's movement is made.
    Modifier,
    /// Any other code in force in its own block.
    OneShot,
}

/// Which of its block's words a G code takes for itself, as a centre, a value or an argument.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Takes {
    /// None, or as a movement takes them.
    #[default]
    Nothing,
    /// The axis words: no movement and no other such code can stand beside it.
    AxisWords,
    /// The target, which it names in its own way: of movements only those straight to a target can stand beside it.
    Target,
    /// Every word: no other code can stand beside it.
    AllWords,
}

/// One G code.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct GCode {
    /// Its number.
    pub code: u16,
    /// Index of its modal group; `None` for one-shot codes.
    pub group: Option<u8>,
    /// Whether the control has it.
    pub division: Division,
    /// What may stand beside it, where classes decide that.
    pub class: Class,
    /// Which words it takes for itself, where classes decide what may stand together.
    pub takes: Takes,
    /// What it does.
    pub meaning: Meaning,
    /// Which one of several alike (work system 1 to 6), 0 otherwise.
    pub number: u8,
    /// Rows of the codes under which it is refused.
    pub not_under: Vec<u8>,
    /// What it does, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

impl GCode {
    /// True for codes that act in their own block only.
    pub const fn is_one_shot(&self) -> bool {
        self.group.is_none()
    }
}

/// One M code that the control itself knows.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct MCode {
    /// Its number.
    pub code: u16,
    /// What the control does with it.
    pub meaning: MMeaning,
    /// The name of the line that carries it decoded, if there is one.
    pub decoded: Option<String>,
    /// True if it is also sent to the machine.
    pub to_machine: bool,
    /// True if the next block is not read before this one is done.
    pub stops_read_ahead: bool,
    /// What it does, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// An option of the control, fitted or not.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct OptionRow {
    /// Its name.
    pub name: String,
    /// What it adds, for people.
    pub text: String,
    /// Fitted unless said otherwise.
    pub default: bool,
    /// Options that cannot be fitted together with it.
    pub excludes: Vec<String>,
    /// What the row rests on.
    pub origin: Origin,
}

/// A behaviour on which the maker's text is silent.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct PolicyRow {
    /// Its name.
    pub name: String,
    /// The ways in which it can be read.
    pub values: Vec<String>,
    /// Index of the value taken unless said otherwise.
    pub default: usize,
    /// What is open and what each value does, for people.
    pub text: String,
    /// Where it decides: each entry is a set of words that a block must have (`explain` knows them); `None` if the row
    /// does not say, and the codes named in its text stand for it.
    pub bears_on: Option<Vec<String>>,
    /// What the default rests on.
    pub origin: Origin,
}

/// What a parameter holds.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum ParameterKind {
    /// Eight switches D7 to D0.
    Bits,
    /// A length in mm.
    Length,
    /// A plain number.
    Number,
    /// One of several words; its value is the word's index.
    Choice,
}

/// One bit of a parameter.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ParameterBit {
    /// 0 to 7.
    pub bit: u8,
    /// What it does, for people.
    pub text: String,
    /// What the row rests on.
    pub origin: Origin,
}

/// A parameter or setting of the control.
#[derive(Clone, PartialEq, Debug)]
pub struct ParameterRow {
    /// Its number or its name, as users write it.
    pub name: String,
    /// What it holds.
    pub kind: ParameterKind,
    /// Its value when new.
    pub default: f64,
    /// The words it may be, for a choice.
    pub values: Vec<String>,
    /// The values it may have.
    pub range: Option<[f64; 2]>,
    /// What it does, for people.
    pub text: String,
    /// Its bits, for switches.
    pub bits: Vec<ParameterBit>,
    /// What the row rests on.
    pub origin: Origin,
}
