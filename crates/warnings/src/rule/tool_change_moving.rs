//! `tool-change-moving`: a tool change in a block with motion.
//!
//! What: M06 stands in a block that moves an axis.
//! Why: a code that goes out with the motion starts the changer while the axes are still under way, and which of the
//! two comes first is the machine builder's choice: the same program changes tools elsewhere on another machine.
//! Do: go to the change position in one block and write M06 alone in the next.
//!
//! Silent where the machine's file says that M06 goes out after the motion and that motion is a return to a reference
//! point: `G91 G28 Z0 M06` then does one after the other.

use dialect::Meaning;
use meaning::CodeLine;

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// The machine code that changes tools, by custom of the trade.
const TOOL_CHANGE: u32 = 6;

pub(crate) fn look(look: &Look, found: &mut Found) {
    let is_change = |code: &&meaning::CodeOut| code.line == CodeLine::M && code.code == TOOL_CHANGE;
    let Some(change) = look.command.sent().iter().find(is_change) else { return };
    let returns =
        matches!(look.command.wording.one_shot, Some(Meaning::ReferenceReturn | Meaning::OtherReferenceReturn));
    if !look.command.moves() || look.command.from == look.after().machine || (change.after_motion && returns) {
        return;
    }
    found.say(Rule::ToolChangeMoving, &look.command.place, || {
        let when = if change.after_motion { "after the motion" } else { "as the motion starts" };
        Finding::new(Rule::ToolChangeMoving, "", look.command, At::M(TOOL_CHANGE))
            .with("when", when)
            .labelled(format!("goes out {when}"))
    });
}
