//! The second piece.

use base::{AXES, AxisSet};
use meaning::{Interpreter, State};
use station::{Library, LibraryError, Session};

use super::compare;
use crate::finding::{At, Finding};
use crate::look::{places, plain};
use crate::rule::inherited_state::{groups, state};
use crate::rules::Rule;
use crate::watch::Watch;

/// Runs the program in a session in which nothing has run and in one in which it has, and says where they part.
/// `watch` has seen the program, `piece` is the number of the one that `used` makes.
///
/// # Errors
/// A text cannot be read.
pub fn second_piece<L: Library>(
    fresh: &mut Session<L>,
    used: &mut Session<L>,
    watch: &Watch,
    piece: u64,
) -> Result<Option<Finding>, LibraryError> {
    let (before, after) = (*fresh.interpreter().read_state(), *used.interpreter().read_state());
    let left = left_over(fresh.interpreter(), &before, &after, watch.inherited());
    let Some(parting) = compare(fresh, used, 1, AxisSet::NONE)? else { return Ok(None) };
    let letters: Vec<u8> = fresh.interpreter().facts().axes.iter().map(|axis| axis.letter).collect();
    let (place, order, first, again) = parting.words(&letters, fresh.interpreter().control());
    Ok(Some(
        Finding::at(Rule::SecondPiece, "", order, place, At::Block)
            .labelled(format!("piece {piece} {again}"))
            .with("piece", piece.to_string())
            .with("again", again)
            .with("first", first)
            .with("left", left),
    ))
}

/// What the piece before has left, of that on which the program rests.
fn left_over(interpreter: &Interpreter, before: &State, after: &State, inherited: u32) -> String {
    let control = interpreter.control();
    let mut left = Vec::new();
    let offsets = [control.roles.length, control.roles.compensation];
    let rests_on = groups(control).into_iter().filter(|(_, bit)| *bit != state::LENGTH && inherited & bit != 0);
    for group in rests_on.map(|(group, _)| group).chain(offsets) {
        let (was, is) = (before.groups.0[group], after.groups.0[group]);
        if was != is {
            left.push(format!("{} in place of {}", control.g_name(is), control.g_name(was)));
        }
    }
    if before.length != after.length {
        left.push(format!("a length offset of {} mm", plain(after.length)));
    }
    if before.base_origin != after.base_origin || before.common_shift != after.common_shift {
        left.push("the origin that G92 has set".to_owned());
    }
    if before.displacement != after.displacement {
        left.push("a displacement by G45 to G48".to_owned());
    }
    for (letter, bit, was, is) in [
        ('S', state::S, before.spindle, after.spindle),
        ('H', state::H, before.h, after.h),
        ('D', state::D, before.d, after.d),
    ] {
        if was != is && inherited & bit != 0 {
            left.push(format!("{letter}{is}"));
        }
    }
    if left.is_empty() && before.machine != after.machine {
        let facts = interpreter.facts();
        let moved = (0..AXES).filter(|&axis| before.machine[axis] != after.machine[axis]);
        left.push(format!("the axes at {}", places(facts, moved, &after.machine)));
    }
    if left.is_empty() {
        left.push("values in the control's memory".to_owned());
    }
    left.join(", ")
}
