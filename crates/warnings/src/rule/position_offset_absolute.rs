//! `position-offset-absolute`: a displacement left by G45 to G48 when an absolute block comes.
//!
//! What: blocks with G45 to G48 have left an axis beside its programmed place, and the next word for it is absolute.
//! Why: whether an absolute word takes the displacement back is one of the things that controls settle differently:
//! the axis then goes to the programmed point here and beside it there, by a tool's radius or diameter.
//! Do: take the displacement back with the opposite code before programming in G90, or run the contour in G91.
//!
//! Silent where the absolute block itself is G28, G30, G53 or G92: these end a displacement by what they are.

use dialect::{Meaning, PositionOffsetAbsolute};

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let command = look.command;
    if !command.moves() || !matches!(command.wording.one_shot, None | Some(Meaning::ExactStop)) {
        return;
    }
    let left = |&axis: &usize| look.before.displacement[axis] != 0.0 && command.absolute.has(axis);
    let Some(axis) = (0..look.facts.axes.len()).find(left) else { return };
    found.say(Rule::PositionOffsetAbsolute, &command.place, || {
        let letter = char::from(look.letter(axis));
        let by = look.before.displacement[axis];
        let here = match look.fitting.policies.position_offset_absolute {
            PositionOffsetAbsolute::Dropped => "is dropped here: the axis goes to the programmed place",
            PositionOffsetAbsolute::Kept => "is kept here: the axis goes beside the programmed place",
        };
        Finding::new(Rule::PositionOffsetAbsolute, "", command, At::Letter(look.letter(axis)))
            .with("axis", letter.to_string())
            .with("distance", plain(by))
            .with("here", here)
            .labelled(format!("{letter} is displaced by {} mm", plain(by)))
    });
}
