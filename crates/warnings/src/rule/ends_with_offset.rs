//! `ends-with-offset`: the program ends, or starts again, with a tool offset in force.
//!
//! What: at M02, M30 or M99 the length offset (G43, G44) or the radius compensation (G41, G42) is still on.
//! Why: the offset of the last tool stands when the next program begins. Its first `G49` without Z then moves the axis
//! by the whole offset, from wherever it stands; its first Z word goes to a place for the wrong tool.
//! Do: cancel before the end: `G49` in the block of a Z word or after the return to the reference point, `G40` with
//! the last move away from the work.
//!
//! Silent for a length offset whose value is zero, for what the control itself cancels at this end, and where the text
//! merely stops without an end.

use base::Place;
use dialect::{GroupCodes, Meaning, Occasion};
use meaning::{Command, EndKind};

use crate::finding::{At, Finding, Found};
use crate::look::{Look, plain};
use crate::rules::Rule;

/// Where the offsets were switched on.
#[derive(Default)]
pub(crate) struct EndsWithOffset {
    length: Option<Place>,
    side: Option<Place>,
}

impl EndsWithOffset {
    /// Notes where an offset is switched on.
    pub fn look(&mut self, look: &Look) {
        let roles = look.control.roles;
        let wording = &look.command.wording;
        if wording.writes(roles.length) {
            self.length = Some(look.command.place);
        }
        if wording.writes(roles.compensation) {
            self.side = Some(look.command.place);
        }
    }

    /// The program ends with these codes in force.
    pub fn end(&self, look: &Look, groups: &GroupCodes, (kind, reset): (EndKind, bool), found: &mut Found) {
        if kind == EndKind::Text || !found.is_new(Rule::EndsWithOffset, &look.command.place) {
            return;
        }
        let roles = look.control.roles;
        let command = look.command;
        let length = look.after().length;
        // What the machine builder's wiring may do is another thing on the next machine.
        let left = match reset && look.control.station.end_resets {
            true => look.fitting.groups_after(look.control, Occasion::ProgramEnd, *groups),
            false => *groups,
        };
        let in_force = |group: usize| look.control.in_force(&left, group);
        if matches!(in_force(roles.length), Some(Meaning::LengthPlus | Meaning::LengthMinus)) && length != 0.0 {
            let name = look.control.g_name(groups.0[roles.length]);
            let make = finding(command, "length", name, self.length).with("amount", plain(length));
            found.list.push(make.with("h", format!("H{:02}", look.after().h)));
        }
        if matches!(in_force(roles.compensation), Some(Meaning::CompensationLeft | Meaning::CompensationRight)) {
            let name = look.control.g_name(groups.0[roles.compensation]);
            found.list.push(finding(command, "radius", name, self.side));
        }
    }
}

fn finding(command: &Command, shade: &'static str, name: String, since: Option<Place>) -> Finding {
    let finding =
        Finding::new(Rule::EndsWithOffset, shade, command, At::Block).labelled(format!("{name} is still in force"));
    let finding = finding.with("code", name);
    match since {
        Some(place) => finding.beside(place, "in force since here"),
        None => finding,
    }
}
