//! `memory-size`: the program is larger than the control's memory.
//!
//! What: the text has more characters than the memory for part programs holds, by the parameter `program memory`
//! (metres of tape, ten characters an inch).
//! Why: loading stops half way with an alarm, and what is in memory is a program without its end.
//! Do: run it from tape, or divide it; set the parameter to what this machine has.
//!
//! A block longer than the control reads is no warning: the control refuses it, and so does `check`.

/// Characters on a metre of tape: ten an inch.
const CHARACTERS_A_METRE: f64 = 10_000.0 / 25.4;

use base::Place;
use dialect::{Control, Fitting};

use crate::finding::{At, Finding};
use crate::look::number;
use crate::rules::Rule;

/// The parameter that says how large the memory is, metres of tape; 0 = not known.
pub(crate) const PARAMETER: &str = "program memory";

pub(crate) fn finding(control: &Control, fitting: &Fitting, characters: u64, head: Place) -> Option<Finding> {
    let metres = fitting.parameter_by_name(control, PARAMETER).filter(|&metres| metres > 0.0)?;
    let holds = (metres * CHARACTERS_A_METRE).floor();
    if characters as f64 <= holds {
        return None;
    }
    Some(
        Finding::at(Rule::MemorySize, "", 0, head, At::Block)
            .with("characters", characters.to_string())
            .with("holds", format!("{holds}"))
            .with("metres", number(metres))
            .with("needs", number((characters as f64 / CHARACTERS_A_METRE).ceil())),
    )
}
