//! Which G codes may stand together in one block.
//!
//! Two schemes: a control whose codes have classes counts and orders them by its own [`Combination`]; elsewhere one-shot
//! codes keep company as the policy `one-shot-company` says.

use base::Condition;

use crate::control::Control;
use crate::fitting::Fitting;
use crate::meaning::Meaning;
use crate::policy::{CycleWithMotion, OneShotCompany};
use crate::row::{Class, Takes};

/// How many codes of which class may stand in a block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Combination {
    /// Codes of any class.
    pub most_codes: usize,
    /// State-change codes without a movement code.
    pub most_states: usize,
    /// State-change codes beside a movement code.
    pub most_states_with_movement: usize,
}

impl Combination {
    /// The first rule that a block's codes break: the condition and the index of the code that breaks it.
    pub(crate) fn check(self, control: &Control, rows: &[u8]) -> Result<(), (Condition, usize)> {
        let row = |index: usize| control.g_codes.get(usize::from(rows[index]));
        let is = |index: usize, class: Class| row(index).is_some_and(|row| row.class == class);
        let of = |class: Class| (0..rows.len()).filter(move |&index| is(index, class));
        let found = |condition, index: Option<usize>| index.map_or(Ok(()), |index| Err((condition, index)));
        if let Some(solo) = of(Class::Solo).next()
            && rows.len() > 1
        {
            // The caret stands under the code that wants to be alone: of two such, under the second.
            let other = of(Class::Solo).nth(1).unwrap_or(solo);
            return Err((Condition::GNotAlone, other));
        }
        let movement = of(Class::Movement).next();
        found(Condition::GTwoMoves, of(Class::Movement).nth(1))?;
        let group = |index: usize| row(index).and_then(|row| row.group);
        found(
            Condition::GSameGroup,
            of(Class::State).find(|&index| of(Class::State).any(|other| other < index && group(other) == group(index))),
        )?;
        if let Some(movement) = movement {
            found(Condition::GOrder, of(Class::State).find(|&index| index > movement))?;
            found(Condition::GTooMany, of(Class::State).nth(self.most_states_with_movement))?;
        } else {
            found(Condition::GTooMany, of(Class::State).nth(self.most_states))?;
        }
        found(Condition::GTooMany, (rows.len() > self.most_codes).then_some(self.most_codes))?;
        let exact_stop = |&index: &usize| row(index).is_some_and(|row| row.meaning == Meaning::ExactStop);
        if movement.is_none() {
            found(Condition::ExactStopWithoutMovement, (0..rows.len()).find(exact_stop))?;
        }
        let takes = |index: usize| row(index).map_or(Takes::Nothing, |row| row.takes);
        if rows.len() > 1 && (0..rows.len()).any(|index| takes(index) == Takes::AllWords) {
            return Err((Condition::AxisWordsClaimedTwice, 1));
        }
        let straight =
            movement.and_then(row).is_some_and(|row| matches!(row.meaning, Meaning::Rapid | Meaning::Linear));
        let claims = |&index: &usize| match takes(index) {
            Takes::AxisWords => true,
            Takes::Target => !straight,
            _ => is(index, Class::Movement),
        };
        found(Condition::AxisWordsClaimedTwice, (0..rows.len()).filter(claims).nth(1))
    }
}

/// The G codes of a block as written: rows of the control's table.
#[derive(Clone, Copy, Debug)]
pub struct Written<'a> {
    /// Rows in their order.
    pub rows: &'a [u8],
    /// The movement in force after the block's own codes.
    pub motion: Option<Meaning>,
}

/// Checks a block's G codes against one another.
///
/// # Errors
/// The condition and the index (in the order of writing) of the code that is refused.
pub fn check_combination(control: &Control, fitting: &Fitting, written: Written) -> Result<(), (Condition, usize)> {
    if let Some(combination) = control.combination {
        return combination.check(control, written.rows);
    }
    if written.rows.len() < 2 && written.motion.is_some_and(|motion| !motion.is_arc()) {
        return Ok(());
    }
    let meaning = |index: usize| control.g_codes.get(usize::from(written.rows[index])).map(|row| row.meaning);
    let is_one_shot =
        |index: usize| control.g_codes.get(usize::from(written.rows[index])).is_some_and(|row| row.is_one_shot());
    let mut one_shot = None;
    let mut motion_code = None;
    let mut cycle_code = None;
    for index in 0..written.rows.len() {
        let Some(code) = meaning(index) else { continue };
        if is_one_shot(index) {
            if one_shot.is_some() {
                return Err((Condition::OneShotTwice, index));
            }
            one_shot = Some(index);
        } else if code.is_motion() {
            motion_code = Some(index);
        } else if code.is_cycle() {
            cycle_code = Some(index);
        }
        if code.length_offset().is_some() && written.motion.is_some_and(Meaning::is_arc) {
            return Err((Condition::LengthOffsetWithArc, index));
        }
    }
    if let (Some(motion), Some(cycle)) = (motion_code, cycle_code)
        && fitting.policies.cycle_with_motion == CycleWithMotion::Refuse
    {
        return Err((Condition::CycleWithMotion, motion.max(cycle)));
    }
    match one_shot {
        Some(index) => check_company(fitting, index, meaning(index), motion_code, meaning, written.rows.len()),
        None => Ok(()),
    }
}

/// Checks what stands beside the block's one one-shot code.
fn check_company(
    fitting: &Fitting,
    index: usize,
    code: Option<Meaning>,
    motion_code: Option<usize>,
    meaning: impl Fn(usize) -> Option<Meaning>,
    count: usize,
) -> Result<(), (Condition, usize)> {
    let company = fitting.policies.one_shot_company;
    if company == OneShotCompany::Lenient {
        return Ok(());
    }
    let Some(code) = code else { return Ok(()) };
    let goes_with = |motion: Meaning| match code {
        Meaning::ExactStop => true,
        Meaning::MachineCoordinates => matches!(motion, Meaning::Rapid | Meaning::Linear),
        _ => code.position_offset().is_some(),
    };
    if let Some(motion) = motion_code.and_then(&meaning)
        && !goes_with(motion)
    {
        return Err((Condition::OneShotWithMotion, index));
    }
    if company == OneShotCompany::Literal {
        let other = (0..count).find(|&other| other != index && !meaning(other).is_some_and(Meaning::is_motion));
        if other.is_some() {
            return Err((Condition::OneShotCompany, index));
        }
    }
    Ok(())
}
