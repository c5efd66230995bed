//! G50 and G51: everything larger or smaller about a point, and mirrored where a ratio may be negative.
//!
//! Which letters carry the ratios and the centre, and what 1 in a ratio is worth, the control's table says. Along an axis
//! whose centre is not named it is the present position.

use base::{Alarm, AxisSet, Condition, Decimal};
use dialect::{Meaning, RatioUnit, ScaledAxes, ScalingCompany, ScalingNegativeRatio, ScalingRule};

use crate::block::Reading;
use crate::operation::Side;
use crate::record::ReadAs;
use crate::transform::TRANSFORMED;
use crate::unknown::letter_bit;

/// Lowest and highest ratio, in units of a ratio without a point.
const RATIOS: [f64; 2] = [1.0, 99_999_999.0];

impl Reading<'_> {
    /// The block's G50 or G51, if it has one.
    pub fn scaling_code(&self) -> Option<Meaning> {
        let group = self.control().roles.scaling?;
        if self.groups_written & (1 << group) == 0 {
            return None;
        }
        self.control().in_force(&self.next.groups, group)
    }

    /// Turns scaling on or off; true if the block's words were the centre and nothing moves.
    pub fn scaling(&mut self, code: Meaning) -> Result<bool, Alarm> {
        let control = self.setting.control.as_ref();
        // Where codes have classes these say what may stand together.
        let alone = self.setting.fitting.policies.scaling_company == ScalingCompany::Alone;
        if alone && control.combination.is_none() {
            self.refuse_company()?;
        }
        let not_now = control.scaling.as_ref().is_some_and(|rule| rule.not_in_compensation);
        if not_now && self.command.side != Side::Off {
            return Err(self.group_alarm(Condition::ScalingInCompensation, control.roles.scaling));
        }
        // The scale before has no part in where the new centre is.
        self.next.transform.scaled = AxisSet::NONE;
        let (Meaning::ScalingOn, Some(rule)) = (code, control.scaling.as_ref()) else { return Ok(false) };
        let here = self.present();
        let of_all = self.ratio_of_all(rule)?;
        let mut scaled = AxisSet::NONE;
        for (axis, facts) in self.setting.facts.axes.iter().enumerate().take(TRANSFORMED) {
            let place = b"XYZ".iter().position(|&letter| letter == facts.letter);
            // Degrees are no size.
            if facts.rotary || (rule.axes == ScaledAxes::Xyz && place.is_none()) {
                continue;
            }
            scaled.add(axis);
            let letter = |letters: Option<[u8; 3]>| Some(letters?[place?]);
            let older = match letter(rule.older_centre) {
                Some(letter) if !self.words.has(facts.letter) => self.words.length(control, letter, self.units)?,
                _ => None,
            };
            let center = match older {
                Some(center) => center,
                None => self.centre_of(axis, rule.centre_by_distance, &here)?,
            };
            let own = match letter(rule.ratios) {
                Some(letter) => self.ratio_of_one(rule, letter)?,
                None => None,
            };
            let ratio = match own.or(of_all) {
                Some(ratio) => ratio,
                None => self.ratio_left_out(rule)?,
            };
            self.next.transform.center[axis] = center;
            self.next.transform.factor[axis] = ratio;
        }
        if rule.axes == ScaledAxes::Xyz
            && let Some(axis) = self.axes_named().without(scaled).iter().next()
        {
            return Err(self.axis_alarm(Condition::AxisWordsClaimedTwice, axis));
        }
        self.next.transform.scaled = scaled;
        Ok(true)
    }

    /// The ratio of all axes, if it is written and counts.
    fn ratio_of_all(&self, rule: &ScalingRule) -> Result<Option<f64>, Alarm> {
        let RatioUnit::Fixed(unit) = rule.unit else {
            let ratio = self.ratio(rule, rule.ratio)?;
            // A negative one is invalid: it is as if it were left out.
            return Ok(ratio.filter(|&ratio| ratio > 0.0));
        };
        let Some(count) = self.words.count(self.control(), rule.ratio)? else { return Ok(None) };
        if count == 0 {
            return Err(self.words.below(self.control(), rule.ratio, 0, 1));
        }
        // In this order 250 thousandths are 0.25 to the last digit.
        Ok(Some(f64::from(count) / (1.0 / unit).round()))
    }

    /// The ratio of one axis; a negative one mirrors it.
    fn ratio_of_one(&self, rule: &ScalingRule, letter: u8) -> Result<Option<f64>, Alarm> {
        let Some(ratio) = self.ratio(rule, letter)? else { return Ok(None) };
        let policy = self.setting.fitting.policies.scaling_negative_ratio;
        if ratio > 0.0 {
            return Ok(Some(ratio));
        }
        if !rule.negative_mirrors {
            return Err(self.ratio_alarm(rule, letter, ratio));
        }
        Ok(Some(match policy {
            ScalingNegativeRatio::Amount => ratio,
            ScalingNegativeRatio::Parameter => -self.ratio_left_out(rule)?,
        }))
    }

    /// The ratio in the word of this letter, with its sign.
    fn ratio(&self, rule: &ScalingRule, letter: u8) -> Result<Option<f64>, Alarm> {
        let Some(number) = self.words.number(letter)? else { return Ok(None) };
        let unit = self.ratio_unit(rule);
        let ratio = ratio_of(number, unit);
        let size = ratio.abs();
        if size < RATIOS[0] / unit || size > RATIOS[1] / unit {
            return Err(self.ratio_alarm(rule, letter, ratio));
        }
        self.words.note(letter, ReadAs::Ratio, ratio);
        Ok(Some(ratio))
    }

    /// How many units of a ratio without a point are 1.
    fn ratio_unit(&self, rule: &ScalingRule) -> f64 {
        let worth = match &rule.unit {
            RatioUnit::Fixed(worth) => *worth,
            RatioUnit::Parameter(index, worths) => {
                let chosen = self.setting.fitting.parameter(*index) as usize;
                worths.get(chosen).copied().unwrap_or(1.0)
            }
        };
        (1.0 / worth).round()
    }

    /// The ratio where none is written.
    fn ratio_left_out(&self, rule: &ScalingRule) -> Result<f64, Alarm> {
        let Some(parameter) = rule.left_out else {
            return Err(self.group_alarm(Condition::ScalingFactorMissing, self.control().roles.scaling));
        };
        Ok(self.setting.fitting.parameter(parameter) / self.ratio_unit(rule))
    }

    fn ratio_alarm(&self, rule: &ScalingRule, letter: u8, ratio: f64) -> Alarm {
        let unit = self.ratio_unit(rule);
        self.words.alarm(Condition::ValueOutOfRange, letter).with([ratio, RATIOS[0] / unit, RATIOS[1] / unit])
    }

    /// G50 and G51 stand alone: no other G code beside them, and no way to go beside G50.
    fn refuse_company(&self) -> Result<(), Alarm> {
        let group = self.control().roles.scaling;
        let taken = || self.words.block.words.iter().take(self.word_count);
        let in_group = |word: &syntax::Word| {
            let syntax::Value::Number(number) = word.value else { return false };
            let row = number.integer().and_then(|code| self.control().g_row(code));
            let row = row.and_then(|row| self.control().g_codes.get(usize::from(row)));
            row.is_some_and(|row| row.group.map(usize::from) == group)
        };
        if let Some(other) = taken().find(|word| word.letter == b'G' && !in_group(word)) {
            return Err(self.words.alarm_at(Condition::ScalingNotAlone, other));
        }
        let off = self.scaling_code() != Some(Meaning::ScalingOn);
        let is_axis = |word: &&syntax::Word| self.setting.axis_letters & letter_bit(word.letter) != 0;
        match taken().find(is_axis) {
            Some(word) if off => Err(self.words.alarm_at(Condition::ScalingNotAlone, word)),
            _ => Ok(()),
        }
    }
}

/// A ratio: with a point the value itself, else so many units.
fn ratio_of(number: Decimal, units: f64) -> f64 {
    let value = number.to_f64();
    if number.point { value } else { value / units }
}
