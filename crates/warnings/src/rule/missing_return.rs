//! `missing-return`: a called program's file ends without M99.
//!
//! What: the text of a program that was called comes to its end, and no M99 stands before it.
//! Why: this control takes the end for the way back; another, or the next release of this one, may stop there, with the
//! tool in the part.
//! Do: write M99 in its last block.

use meaning::{Command, Interpreter};

use crate::finding::{At, Finding, Found};
use crate::rules::Rule;

pub(crate) fn look(interpreter: &Interpreter, command: &Command, found: &mut Found) {
    let Some(place) = interpreter.unreturned() else { return };
    found.say(Rule::MissingReturn, &place, || {
        let name = interpreter.program_name(place.program).to_owned();
        Finding::at(Rule::MissingReturn, "", command.block, place, At::Block).with("program", name)
    });
}
