//! `mirror-off-elsewhere`: mirror image, scale or rotation ends at another place than where it makes no difference.
//!
//! What: M94 stands where the axis is not on the line of its M95, or, in G91, G50 or G69 stands away from the centre of G51 or G68.
//! Why: the axis stands at a place that the unmirrored, unscaled, unturned program would call by another number. What follows by
//! distances is displaced by that difference, and goes on being so until an absolute word comes for the axis.
//! Do: go back to the place of M95 (of the centre) before the cancelling block.
//!
//! Silent for scaling and rotation in G90, whose next word for the axis is absolute, and where the two numbers are one.

use base::AxisSet;
use dialect::Meaning;

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

/// Two places less than this apart, in counts, are one.
const SAME: f64 = 1.0;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let (before, after) = (look.before, look.after());
    let unmirrored = before.transform.mirrored.without(after.transform.mirrored);
    let unscaled = before.transform.scaled.without(after.transform.scaled);
    let in_distances = look.in_force(look.control.roles.distance) == Some(Meaning::Incremental);
    let (rotation, still_turned) = (before.transform.rotation, after.transform.rotation.on);
    let unturned = match rotation.on && !still_turned {
        true => rotation.plane(),
        false => AxisSet::NONE,
    };
    let axes = if in_distances { unmirrored.or(unscaled).or(unturned) } else { unmirrored };
    if axes.is_empty() {
        return;
    }
    // The same place of the machine, as the program calls it with the old transform and with the new one.
    let programmed = |transform| {
        let state = meaning::State { transform, ..*before };
        look.interpreter.programmed(&state, &look.command.from)
    };
    let (then, now) = (programmed(before.transform), programmed(after.transform));
    let shift = |axis: usize| now[axis] - then[axis];
    let Some(axis) = axes.iter().find(|&axis| shift(axis).abs() >= SAME) else { return };
    found.say(Rule::MirrorOffElsewhere, &look.command.place, || {
        let letter = char::from(look.letter(axis)).to_string();
        let (shade, at) = match unmirrored.has(axis) {
            true => {
                let off =
                    look.control.m_of(dialect::MMeaning::MirrorOff).map_or(At::Block, |row| At::M(row.code.into()));
                ("mirror", off)
            }
            false => {
                let (shade, code) = match unscaled.has(axis) {
                    true => ("scale", Meaning::ScalingOff),
                    false => ("rotation", Meaning::RotationOff),
                };
                let off = look.control.row_of(code).and_then(|row| look.control.g_codes.get(usize::from(row)));
                (shade, off.map_or(At::Block, |row| At::G(row.code)))
            }
        };
        Finding::new(Rule::MirrorOffElsewhere, shade, look.command, at)
            .labelled(format!("{letter} is off by {} mm", plain(shift(axis))))
            .with("axis", letter)
            .with("distance", plain(shift(axis)))
    });
}
