//! `offset-unset`: an offset or origin that the program names and the set-up does not give.
//!
//! What: H or D calls an offset whose value is zero, or a work system is selected whose origin is zero on every axis.
//! Why: the tool runs as if it had no length or no radius, or the part as if it stood at machine zero.
//! Do: measure it and write it into the offset memory (`--offset`, `--work`, the set-up file), or correct the number.
//!
//! Silent where the set-up gives no offset, or no origin, at all: the program is then looked at without a machine.
//! Silent once the program writes the memory itself (G10): what it writes it means.
//! H00 and D00 are no offsets and mean it. Said once a program for each number and system.

use dialect::Meaning;
use meaning::Memory;

use crate::finding::{At, Finding, Found};
use crate::look::Look;
use crate::rules::Rule;

/// Numbers that have been spoken of are kept up to this one.
const NUMBERS: usize = 128;

/// What the set-up gives, and what has been said.
pub(crate) struct OffsetUnset {
    /// Some offset, some radius, some origin is set.
    given: [bool; 3],
    /// By H, by D, by work system.
    said: [u128; 3],
}

impl OffsetUnset {
    pub fn new(memory: &Memory, highest: u32) -> OffsetUnset {
        let any = |value: &dyn Fn(u32) -> Option<f64>| (1..=highest).any(|n| value(n).is_some_and(|v| v != 0.0));
        let lengths = any(&|number| memory.length(number));
        let radii = any(&|number| memory.radius(number));
        let origins = memory.work.iter().flatten().any(|&value| value != 0.0);
        OffsetUnset { given: [lengths, radii, origins], said: [0; 3] }
    }

    pub fn look(&mut self, look: &Look, found: &mut Found) {
        let roles = look.control.roles;
        let (wording, after) = (&look.command.wording, look.after());
        if wording.one_shot == Some(Meaning::WriteData) {
            self.given = [false; 3];
        }
        let has_length = matches!(look.in_force(roles.length), Some(Meaning::LengthPlus | Meaning::LengthMinus));
        if has_length && (wording.has(b'H') || wording.writes(roles.length)) {
            let at = if wording.has(b'H') { At::Letter(b'H') } else { At::G(look.code_in(roles.length)) };
            self.judge(look, found, 0, after.h, look.memory.length(after.h), at);
        }
        let compensated =
            matches!(look.in_force(roles.compensation), Some(Meaning::CompensationLeft | Meaning::CompensationRight))
                && (wording.has(b'D') || wording.writes(roles.compensation));
        let by_position = wording.one_shot.is_some_and(|code| {
            code.position_offset().is_some()
                || matches!(code, Meaning::CircleCutClockwise | Meaning::CircleCutCounterClockwise)
        });
        if compensated || by_position {
            let at = if wording.has(b'D') { At::Letter(b'D') } else { At::Block };
            self.judge(look, found, 1, after.d, look.memory.radius(after.d), at);
        }
        if wording.writes(roles.work) {
            self.judge_system(look, found);
        }
    }

    fn judge(&mut self, look: &Look, found: &mut Found, index: usize, number: u32, value: Option<f64>, at: At) {
        let unset = number > 0 && value.is_none_or(|value| value == 0.0);
        if !unset || !self.given[index] || !self.is_first(index, number) {
            return;
        }
        let letter = if index == 0 { 'H' } else { 'D' };
        let shade = if index == 0 { "length" } else { "radius" };
        found.say(Rule::OffsetUnset, &look.command.place, || {
            Finding::new(Rule::OffsetUnset, shade, look.command, at).with("name", format!("{letter}{number:02}"))
        });
    }

    fn judge_system(&mut self, look: &Look, found: &mut Found) {
        let work = look.control.roles.work;
        let row = look.after().groups.0[work];
        let Some(code) = look.control.g_codes.get(usize::from(row)) else { return };
        let origin = look.memory.work.get(usize::from(code.number.saturating_sub(1)));
        let unset = code.meaning == Meaning::WorkSystem
            && origin.is_some_and(|origin| origin.iter().all(|&value| value == 0.0))
            && look.after().common_shift.iter().all(|&value| value == 0.0);
        if !unset || !self.given[2] || !self.is_first(2, u32::from(code.number)) {
            return;
        }
        found.say(Rule::OffsetUnset, &look.command.place, || {
            Finding::new(Rule::OffsetUnset, "work", look.command, At::G(code.code)).with("name", look.code_name(work))
        });
    }

    fn is_first(&mut self, index: usize, number: u32) -> bool {
        let bit = 1u128 << (number as usize).min(NUMBERS - 1);
        let first = self.said[index] & bit == 0;
        self.said[index] |= bit;
        first
    }
}
