//! `length-cancel-moves`: G49 or H00 without Z moves the axis.
//!
//! What: the block cancels the length offset and names no Z; the spindle moves by the whole offset at once.
//! Why: cancelling an offset of 120 mm lowers the tool by 120 mm, at rapid if G00 is in force, and nobody wrote a Z.
//! Do: cancel in a block that says where Z goes (`G49 Z300.`), or after `G91 G28 Z0`, whose block drops the offset.
//!
//! Silent where no offset was in force: a `G49` in a program's first line moves nothing then. With `--repeat 2` the
//! same line is judged in the state that the first piece left.

use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let Some(axis) = look.length_axis() else { return };
    let wording = &look.command.wording;
    let length = look.control.roles.length;
    let by_code = wording.writes(length) && look.in_force(length) == Some(Meaning::LengthOff);
    let by_number = wording.has(b'H') && look.after().h == 0;
    if !(by_code || by_number) || wording.has(look.letter(axis)) || look.before.length == 0.0 {
        return;
    }
    let moved = look.after().machine[axis] - look.command.from[axis];
    if moved == 0.0 || look.after().length != 0.0 {
        return;
    }
    found.say(Rule::LengthCancelMoves, &look.command.place, || {
        let at = if by_code { At::G(look.code_in(length)) } else { At::Letter(b'H') };
        let way = if moved < 0.0 { "down, towards the work" } else { "up, away from the work" };
        Finding::new(Rule::LengthCancelMoves, "", look.command, at)
            .with("axis", char::from(look.letter(axis)).to_string())
            .with("distance", plain(moved.abs()))
            .with("way", way)
            .labelled(format!("moves {}{}", char::from(look.letter(axis)), plain(moved)))
    });
}
