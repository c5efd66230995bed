//! Macro calls: G65 once, G66 after every move until G67, each with arguments in local variables.

use base::{Alarm, Condition, UnitSystem};
use dialect::{AddressKind, CallL0, Meaning};
use syntax::{Value, Word};

use super::variables::{BLANK, LOCALS};
use crate::block::{Flow, Reading};
use crate::jump::{Found, Target};
use crate::program::ProgramKey;
use crate::word::Refusal;

/// The local variables that a call fills.
pub(crate) type Arguments = [f64; LOCALS];

/// A modal call in force.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ModalCall {
    pub found: Found,
    pub repeats: u32,
    pub arguments: Arguments,
}

/// A word that may stand in the call block beside arguments.
const NO_ARGUMENT: &[u8] = b"GLNOP";

impl Reading<'_> {
    /// Whether the block calls a macro, and then whether after every move.
    pub fn macro_call_kind(&self) -> Option<bool> {
        if matches!(self.one_shot, Some((Meaning::MacroCall, _))) {
            return Some(false);
        }
        let control = self.control();
        let group = control.roles.modal_macro;
        let written = self.groups_written & (1 << group) != 0;
        (written && control.in_force(&self.next.groups, group) == Some(Meaning::ModalMacroCall)).then_some(true)
    }

    /// G65, G66: fills the arguments and finds the program.
    pub fn macro_call(&mut self, modal: bool) -> Result<Flow, Refusal> {
        let control = self.control();
        if !self.setting.fitting.options.user_macro {
            return Err(self.one_shot_alarm(Condition::MacroNotFitted).into());
        }
        self.words.integer(control, b'N')?;
        if control.combination.is_some() {
            self.refuse_other_codes()?;
        }
        let Some(number) = self.words.count(control, b'P')?.filter(|&number| number > 0) else {
            return Err(self.one_shot_alarm(Condition::CallTargetMissing).into());
        };
        let repeats = self.repeats()?;
        if !modal && self.calls.macro_level() >= control.macro_levels {
            let levels = control.macro_levels as f64;
            return Err(self.one_shot_alarm(Condition::MacroNestingTooDeep).with([levels, 0.0, 0.0]).into());
        }
        if self.is_in_large() {
            return Err(self.one_shot_alarm(Condition::CallFromLarge).into());
        }
        self.take_arguments()?;
        if repeats == 0 {
            return Ok(Flow::Next);
        }
        let target = Target::Program { program: ProgramKey::Number(number), from: self.words.place.source };
        let found = self.locate(target, b'P')?;
        Ok(if modal { Flow::ModalCall(found, repeats) } else { Flow::MacroCall(found, repeats) })
    }

    /// Where codes have classes a macro call is the only G code of its block.
    fn refuse_other_codes(&self) -> Result<(), Alarm> {
        let words = self.words.block.words.iter().take(self.word_count);
        let mut codes = words.filter(|word| word.letter == b'G');
        match (codes.next(), codes.next()) {
            (Some(_), Some(other)) => Err(self.words.alarm_at(Condition::AxisWordsClaimedTwice, other)),
            _ => Ok(()),
        }
    }

    /// L of a call.
    pub fn repeats(&self) -> Result<u32, Alarm> {
        match self.words.count(self.control(), b'L')? {
            Some(0) if self.setting.fitting.policies.call_l0 == CallL0::Refuse => {
                Err(self.words.below(self.control(), b'L', 0, 1))
            }
            repeats => Ok(repeats.unwrap_or(1)),
        }
    }

    /// The block's words as local variables. I J K may come in groups: each further group fills the next three.
    fn take_arguments(&mut self) -> Result<(), Alarm> {
        let table = &self.control().user_macro;
        self.arguments.fill(BLANK);
        let (mut group, mut last) = (0usize, None);
        for (index, word) in self.words.block.words.iter().enumerate().take(self.word_count) {
            if NO_ARGUMENT.contains(&word.letter) {
                continue;
            }
            let Some(variable) = table.argument(word.letter) else {
                return Err(self.words.alarm_at(Condition::MacroArgument, word));
            };
            let mut variable = usize::from(variable);
            if let Some(order) = b"IJK".iter().position(|&letter| letter == word.letter) {
                if last.is_some_and(|last| order <= last) {
                    group += 1;
                }
                last = Some(order);
                variable += 3 * group;
                if group >= table.triples {
                    return Err(self.words.alarm_at(Condition::MacroArgument, word));
                }
            }
            let value = self.argument(index, word)?;
            self.words.note_argument(word, variable, value);
            if let Some(slot) = self.arguments.get_mut(variable.wrapping_sub(1)) {
                *slot = value;
            }
        }
        Ok(())
    }

    /// The value of an argument: as written with a point, in the address's increments without one unless integers are whole units.
    fn argument(&self, index: usize, word: &Word) -> Result<f64, Alarm> {
        if let Some(&value) = self.word_values.get(index).filter(|value| !value.is_nan()) {
            return Ok(value);
        }
        let Value::Number(number) = word.value else {
            return Err(self.words.alarm_at(Condition::NumberMissing, word));
        };
        if number.point {
            return Ok(number.to_f64());
        }
        let control = self.control();
        let [metric, inch, rotary] = control.increments;
        let coarse = self.words.coarse as f64;
        let kind = control.address(word.letter).map(|address| address.kind);
        if self.words.whole_units && (kind != Some(AddressKind::Feed) || self.is_per_revolution()) {
            return Ok(number.to_f64());
        }
        let increment = match kind {
            Some(AddressKind::LinearAxis | AddressKind::Length) if self.units == UnitSystem::Inch => {
                inch as f64 * coarse / base::units::NM_PER_INCH as f64
            }
            Some(AddressKind::LinearAxis | AddressKind::Length) => metric as f64 * coarse / 1e6,
            Some(AddressKind::RotaryAxis) => rotary as f64 / 1e6,
            Some(AddressKind::Feed) => self.least_feed(),
            _ => 1.0,
        };
        // Dividing keeps what is written exact: 10 thousandths are 0.01, not 0.010000000000000002.
        Ok(number.to_f64() / (1.0 / increment).round())
    }
}
