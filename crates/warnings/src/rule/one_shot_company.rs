//! `one-shot-company`: a one-shot code in company that the letter of the manual forbids.
//!
//! What: a one-shot code stands beside another G code; practice writes `G91 G28 Z0`, the manual's sentence wants a
//! block of its own for it, with few exceptions.
//! Why: a control that goes by the letter stops there with an alarm, in the middle of the part.
//! Do: write the modal code in the block before, or try once on the machine whether it takes the block.
//!
//! Said once a program, at the first such block: whether the control accepts it is one question. Silent where the
//! policy `one-shot-company` is `literal`: the block is refused then.

use dialect::{Meaning, OneShotCompany};

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// What has been said.
#[derive(Default)]
pub(crate) struct Company {
    said: bool,
}

impl Company {
    pub fn look(&mut self, look: &Look, found: &mut Found) {
        let wording = &look.command.wording;
        if self.said || look.fitting.policies.one_shot_company == OneShotCompany::Literal {
            return;
        }
        let Some(code) = wording.one_shot else { return };
        let motion = look.control.roles.motion;
        // The pairs that the manual itself allows.
        let goes_with_motion = code == Meaning::ExactStop
            || code.position_offset().is_some()
            || (code == Meaning::MachineCoordinates
                && matches!(look.in_force(motion), Some(Meaning::Rapid | Meaning::Linear)));
        let forbidden = if goes_with_motion { wording.groups & !(1 << motion) } else { wording.groups };
        if forbidden == 0 {
            return;
        }
        let beside = look.code_name(forbidden.trailing_zeros() as usize);
        let Some((number, name)) = look.one_shot() else { return };
        self.said = true;
        found.say(Rule::OneShotCompany, &look.command.place, || {
            Finding::new(Rule::OneShotCompany, "", look.command, At::G(number))
                .with("code", name)
                .labelled(format!("beside {beside}"))
                .with("beside", beside)
        });
    }
}
