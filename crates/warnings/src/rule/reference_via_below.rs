//! `reference-via-below`: the way to the reference point leads down first.
//!
//! What: the intermediate point of G28 or G30 lies below where the tool stands, as in `G90 G28 Z0` at Z50.
//! Why: the tool goes to the intermediate point at rapid before it goes home: Z0 is the top of the part, or deeper.
//! Do: `G91 G28 Z0`, whose intermediate point is the place itself, or name a point above the work.

use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let returns =
        matches!(look.command.wording.one_shot, Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn));
    let (true, Some(via), Some(axis)) = (returns, look.command.via(), look.length_axis()) else { return };
    let down = look.command.from[axis] - via[axis];
    if down <= 0.0 {
        return;
    }
    found.say(Rule::ReferenceViaBelow, &look.command.place, || {
        let letter = look.letter(axis);
        let (_, code) = look.one_shot().unwrap_or_default();
        Finding::new(Rule::ReferenceViaBelow, "", look.command, At::Letter(letter))
            .with("code", code)
            .with("axis", char::from(letter).to_string())
            .with("distance", plain(down))
            .labelled(format!("first down by {} mm", plain(down)))
    });
}
