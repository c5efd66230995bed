//! Expressions carried out, on a small stack.
//!
//! A blank counts as zero in arithmetic; EQ and NE tell it from zero.

use base::Condition;
use dialect::Function;

use super::code::{Code, Comparison, Op, Run, STACK};
use super::expression::variable_number;
use super::system::Source;
use super::trouble::Trouble;

/// Carries out a run. A lone variable may give a blank, everything else gives a number.
pub(crate) fn evaluate(code: &Code, run: Run, source: &Source) -> Result<f64, Trouble> {
    if let Some(result) = short(code, run, source) {
        return result;
    }
    let mut stack = [0.0f64; STACK];
    let mut top = 0usize;
    let ops = code.ops(run);
    for (index, op) in ops.iter().enumerate() {
        let value = match *op {
            Op::Number(value) => value,
            Op::Local(index) => source.variables().local(source.level, index),
            Op::Volatile(index) => source.variables().volatile(index),
            Op::Permanent(index) => source.variables().permanent(index),
            Op::System(number) => source.read(number, code.place(run, index))?,
            _ => {
                let below = top.saturating_sub(1);
                let last = stack[below % STACK];
                let (value, taken) = match *op {
                    Op::Indirect => {
                        let place = code.place(run, index);
                        (source.read(variable_number(last, place)?, place)?, 1)
                    }
                    Op::Negate => (-filled(last), 1),
                    Op::Function(Function::ArcTangent) => (0.0, 2),
                    Op::Function(function) => (apply(function, filled(last)), 1),
                    _ => (0.0, 2),
                };
                if taken == 1 {
                    top = below;
                    finite(value, op, last, code, run, index)?
                } else {
                    let first = stack[top.saturating_sub(2) % STACK];
                    top = top.saturating_sub(2);
                    let value = match *op {
                        Op::Compare(comparison) => f64::from(u8::from(compare(comparison, first, last))),
                        _ => combine(*op, filled(first), filled(last)),
                    };
                    finite(value, op, last, code, run, index)?
                }
            }
        };
        if let Some(slot) = stack.get_mut(top) {
            *slot = value;
        }
        top += 1;
    }
    Ok(stack[0])
}

/// The most frequent expressions, which need no stack: one operand, or two and what is done with them.
#[inline]
fn short(code: &Code, run: Run, source: &Source) -> Option<Result<f64, Trouble>> {
    let operand = |op: Op| match op {
        Op::Number(value) => Some(value),
        Op::Local(index) => Some(source.variables().local(source.level, index)),
        Op::Volatile(index) => Some(source.variables().volatile(index)),
        Op::Permanent(index) => Some(source.variables().permanent(index)),
        _ => None,
    };
    match *code.ops(run) {
        [only] => operand(only).map(Ok),
        [first, last, op @ (Op::Add | Op::Subtract | Op::Multiply | Op::Divide | Op::Compare(_))] => {
            let (first, last) = (operand(first)?, operand(last)?);
            Some(match op {
                Op::Compare(comparison) => Ok(f64::from(u8::from(compare(comparison, first, last)))),
                _ => finite(combine(op, filled(first), filled(last)), &op, last, code, run, 2),
            })
        }
        _ => None,
    }
}

/// A blank as the zero that it is in arithmetic.
#[inline]
fn filled(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value }
}

/// Refuses a result that is no number; a blank read through another variable is one.
fn finite(value: f64, op: &Op, last: f64, code: &Code, run: Run, index: usize) -> Result<f64, Trouble> {
    if value.is_finite() || matches!(op, Op::Indirect) {
        return Ok(value);
    }
    let condition = match op {
        Op::Divide => Condition::MacroDivisionByZero,
        Op::Function(Function::Exponential | Function::Tangent) => Condition::MacroOverflow,
        Op::Function(_) | Op::And | Op::Or | Op::Xor => Condition::MacroArgumentRange,
        _ => Condition::MacroOverflow,
    };
    let condition = if condition == Condition::MacroDivisionByZero && filled(last) != 0.0 {
        Condition::MacroOverflow
    } else {
        condition
    };
    Err(Trouble::Refused(condition, code.place(run, index), [filled(last), 0.0, 0.0]))
}

fn compare(comparison: Comparison, a: f64, b: f64) -> bool {
    let blank = (a.is_nan(), b.is_nan());
    match comparison {
        Comparison::Equal => blank == (true, true) || (blank == (false, false) && a == b),
        Comparison::NotEqual => !compare(Comparison::Equal, a, b),
        Comparison::Greater => filled(a) > filled(b),
        Comparison::Less => filled(a) < filled(b),
        Comparison::GreaterOrEqual => filled(a) >= filled(b),
        Comparison::LessOrEqual => filled(a) <= filled(b),
    }
}

fn combine(op: Op, a: f64, b: f64) -> f64 {
    match op {
        Op::Add => a + b,
        Op::Subtract => a - b,
        Op::Multiply => a * b,
        Op::Divide => a / b,
        Op::And => bits(a, b, |a, b| a & b),
        Op::Or => bits(a, b, |a, b| a | b),
        Op::Xor => bits(a, b, |a, b| a ^ b),
        _ => arc_tangent(a, b),
    }
}

/// A logical operation on 32-bit integers; NaN where an operand is none.
fn bits(a: f64, b: f64, op: impl Fn(i32, i32) -> i32) -> f64 {
    let integer = |value: f64| {
        let rounded = value.round();
        (rounded >= f64::from(i32::MIN) && rounded <= f64::from(u32::MAX)).then_some(rounded as i64 as i32)
    };
    match (integer(a), integer(b)) {
        (Some(a), Some(b)) => f64::from(op(a, b)),
        _ => f64::NAN,
    }
}

/// The angle from 0 to 360° whose tangent is `a / b`.
fn arc_tangent(a: f64, b: f64) -> f64 {
    if a == 0.0 && b == 0.0 {
        return f64::NAN;
    }
    let degrees = libm::atan2(a, b).to_degrees();
    if degrees < 0.0 { degrees + 360.0 } else { degrees }
}

fn apply(function: Function, x: f64) -> f64 {
    match function {
        Function::Sine => sine(x),
        Function::Cosine => sine(x + 90.0),
        Function::Tangent => {
            let cosine = sine(x + 90.0);
            if cosine == 0.0 { f64::INFINITY } else { sine(x) / cosine }
        }
        Function::ArcTangent => libm::atan(x).to_degrees(),
        Function::ArcSine => libm::asin(x).to_degrees(),
        Function::ArcCosine => libm::acos(x).to_degrees(),
        Function::SquareRoot => x.sqrt(),
        Function::Absolute => x.abs(),
        Function::FromBcd => digits(x, 16, 10),
        Function::ToBcd => digits(x, 10, 16),
        Function::Round => x.round(),
        Function::Fix => x.trunc(),
        Function::Fup => {
            if x < 0.0 {
                x.floor()
            } else {
                x.ceil()
            }
        }
        Function::Logarithm => libm::log(x),
        Function::Exponential => libm::exp(x),
    }
}

/// An angle less its whole turns, exactly.
fn within_a_turn(degrees: f64) -> f64 {
    /// Below this many degrees whole turns times 360 have no more bits than an `f64` holds, so that nothing is rounded.
    const EXACT: f64 = 1e12;
    if degrees.abs() >= EXACT {
        return libm::fmod(degrees, 360.0);
    }
    let turn = degrees - (degrees / 360.0).trunc() * 360.0;
    // The division may have been rounded up to the next whole turn.
    if turn != 0.0 && (turn < 0.0) != (degrees < 0.0) { turn + 360.0_f64.copysign(degrees) } else { turn }
}

/// The sine of an angle in degrees, exact at every multiple of 30° that has an exact one.
fn sine(degrees: f64) -> f64 {
    let turn = within_a_turn(degrees);
    let (sign, angle) = if turn < 0.0 { (-1.0, -turn) } else { (1.0, turn) };
    let (sign, angle) = if angle >= 180.0 { (-sign, angle - 180.0) } else { (sign, angle) };
    let angle = if angle > 90.0 { 180.0 - angle } else { angle };
    let value = if angle == 30.0 {
        0.5
    } else if angle > 45.0 {
        libm::cos((90.0 - angle).to_radians())
    } else {
        libm::sin(angle.to_radians())
    };
    sign * value
}

/// The digits of a whole number in one base read in another; NaN where a digit is none.
fn digits(x: f64, from: u32, to: u32) -> f64 {
    let rounded = x.round();
    if !(0.0..=99_999_999.0).contains(&rounded) && from == 10 || !(0.0..=f64::from(u32::MAX)).contains(&rounded) {
        return f64::NAN;
    }
    let (mut rest, mut value, mut place) = (rounded as u64, 0u64, 1u64);
    while rest > 0 {
        let digit = rest % u64::from(from);
        if digit >= u64::from(to.min(10)) {
            return f64::NAN;
        }
        value += digit * place;
        place *= u64::from(to);
        rest /= u64::from(from);
    }
    value as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_turns_are_taken_off_exactly() {
        let mut angle = 0.1_f64;
        for _ in 0..2000 {
            angle = angle * 1.017 + 0.37;
            for degrees in [angle, -angle, (angle / 360.0).round() * 360.0, f64::from_bits(angle.to_bits() + 1)] {
                assert_eq!(within_a_turn(degrees), libm::fmod(degrees, 360.0), "{degrees}");
            }
        }
    }

    #[test]
    fn sines_of_round_angles_are_round() {
        for (degrees, value) in
            [(0.0, 0.0), (30.0, 0.5), (90.0, 1.0), (180.0, 0.0), (210.0, -0.5), (-30.0, -0.5), (750.0, 0.5)]
        {
            assert_eq!(sine(degrees), value, "{degrees}");
        }
        assert_eq!(digits(37.0, 16, 10), 25.0);
        assert_eq!(digits(25.0, 10, 16), 37.0);
        assert!(digits(10.0, 16, 10).is_nan());
    }
}
