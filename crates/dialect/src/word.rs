//! Numbers of words as this control means them: least increments, the decimal-point rule, ranges.

use base::{Condition, Decimal, UnitSystem, units::NM_PER_INCH};

use crate::address::{Address, AddressKind, PointRule};
use crate::control::Control;

/// A refused number: the condition and its values.
pub type Refused = (Condition, [f64; 3]);

const MM: i64 = 1_000_000;
const DEGREE: i64 = 1_000_000;

impl Control {
    /// A word as a length in nanometres. Without a point it counts least increments, each `coarse` times its size.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    #[inline]
    pub fn length(&self, address: &Address, number: Decimal, units: UnitSystem, coarse: i64) -> Result<i64, Refused> {
        let (increment, unit, range) = match units {
            UnitSystem::Metric => (self.increments[0], MM, address.metric),
            UnitSystem::Inch => (self.increments[1], NM_PER_INCH, address.inch),
        };
        counts(number, increment * coarse, unit, range)
    }

    /// A word as an angle in microdegrees. Without a point it counts least increments.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    pub fn angle(&self, address: &Address, number: Decimal) -> Result<i64, Refused> {
        counts(number, self.increments[2], DEGREE, address.rotary)
    }

    /// A word as a whole number.
    ///
    /// # Errors
    /// A point that may not be, too many digits, a value outside the range.
    pub fn integer(&self, address: &Address, number: Decimal) -> Result<i64, Refused> {
        if number.point && !matches!(address.point, PointRule::Yes | PointRule::Whole) {
            return Err((Condition::PointNotAllowed, [0.0; 3]));
        }
        if address.kind == AddressKind::Code && number.digits > address.digits {
            return Err((Condition::DigitsTooMany, [f64::from(number.digits), f64::from(address.digits), 0.0]));
        }
        let Some(value) = number.integer() else { return Err((Condition::PointNotAllowed, [0.0; 3])) };
        let [low, high] = address.range;
        if value < low || value > high || (number.negative && low >= 0 && value != 0) {
            return Err((Condition::ValueOutOfRange, [value as f64, low as f64, high as f64]));
        }
        Ok(value)
    }

    /// A dwell's P as seconds: milliseconds without a point, seconds with one where the address may have one.
    ///
    /// # Errors
    /// The value lies outside the address's range, or its point has no place.
    pub fn dwell_seconds(&self, address: &Address, number: Decimal) -> Result<f64, Refused> {
        if address.point != PointRule::Whole {
            return self.seconds(address, number);
        }
        match number.integer() {
            Some(_) => self.seconds(address, Decimal { point: false, ..number }),
            None => Err((Condition::PointNotAllowed, [0.0; 3])),
        }
    }

    /// A time in seconds: milliseconds without a point, seconds with one.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    pub fn seconds(&self, address: &Address, number: Decimal) -> Result<f64, Refused> {
        let milliseconds = if number.point { number.scaled(3) } else { number.integer() };
        let seconds = milliseconds.unwrap_or(i64::MAX) as f64 / 1000.0;
        let [low, high] = address.seconds;
        if seconds < low || seconds > high {
            return Err((Condition::ValueOutOfRange, [seconds, low, high]));
        }
        Ok(seconds)
    }

    /// A feed per minute in nanometres, `inch_tenths` says that a plain number in inch input counts 0.1 in/min.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    pub fn feed_per_minute(
        &self,
        address: &Address,
        number: Decimal,
        units: UnitSystem,
        inch_tenths: bool,
    ) -> Result<f64, Refused> {
        let (plain, unit, range) = match units {
            UnitSystem::Metric => (MM, MM, address.feed[0]),
            UnitSystem::Inch => {
                (if inch_tenths { NM_PER_INCH / 10 } else { NM_PER_INCH }, NM_PER_INCH, address.feed[1])
            }
        };
        feed(address, number, plain, unit, range)
    }

    /// A dwell's P (or X) as turns of the spindle: thousandths (or, `whole`, turns) without a point, turns with one.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    pub fn dwell_turns(&self, address: &Address, number: Decimal, whole: bool) -> Result<f64, Refused> {
        let number = if whole { Decimal { point: true, ..number } } else { number };
        self.dwell_seconds(address, number)
    }

    /// A feed per revolution in nanometres. Without a point it counts least increments, each `coarse` times its size.
    ///
    /// # Errors
    /// The value lies outside the address's range.
    pub fn feed_per_revolution(
        &self,
        address: &Address,
        number: Decimal,
        units: UnitSystem,
        coarse: i64,
    ) -> Result<f64, Refused> {
        let (increment, unit, range) = match units {
            UnitSystem::Metric => (self.increments[0], MM, address.feed[2]),
            UnitSystem::Inch => (self.increments[1], NM_PER_INCH, address.feed[3]),
        };
        feed(address, number, increment * coarse, unit, range)
    }
}

/// A number in counts: with a point `unit` each, rounded to the increment; without one `increment` each.
#[inline(always)]
fn counts(number: Decimal, increment: i64, unit: i64, range: [f64; 2]) -> Result<i64, Refused> {
    let increments = if number.point {
        // The usual case first: thousandths of a mm or degree. A division would cost more than the rest.
        if unit == increment * 1000 {
            number.scaled(3)
        } else if unit == increment * 10_000 {
            number.scaled(4)
        } else {
            let per_unit = i128::from(unit / increment);
            number.scaled(9).map(|value| round_half_away(i128::from(value) * per_unit, 1_000_000_000))
        }
    } else {
        number.integer()
    };
    let value = increments.and_then(|value| value.checked_mul(increment));
    // A count or more within the bounds it matters nothing how they are rounded, and no division is needed.
    let [low, high] = range.map(|bound| bound * unit as f64);
    if let Some(value) = value.filter(|&value| value as f64 >= low + 1.0 && value as f64 <= high - 1.0) {
        return Ok(value);
    }
    at_its_bounds(number, value, increment, unit, range)
}

/// A value that lies at its bounds or beyond them.
#[cold]
#[inline(never)]
fn at_its_bounds(
    number: Decimal,
    value: Option<i64>,
    increment: i64,
    unit: i64,
    range: [f64; 2],
) -> Result<i64, Refused> {
    let in_units = value.map_or(f64::INFINITY, |value| value as f64) / unit as f64;
    match value {
        Some(value) if in_units >= range[0] && in_units <= range[1] => Ok(value),
        _ => {
            let written =
                if number.point { number.to_f64() } else { number.to_f64() * (increment as f64 / unit as f64) };
            Err((Condition::ValueOutOfRange, [written, range[0], range[1]]))
        }
    }
}

fn feed(address: &Address, number: Decimal, plain: i64, unit: i64, range: [f64; 2]) -> Result<f64, Refused> {
    let nanometres = if number.point {
        number.scaled(9).map(|value| i128::from(value) * i128::from(unit)).map(|value| value as f64 / 1e9)
    } else {
        number.integer().and_then(|value| value.checked_mul(plain)).map(|value| value as f64)
    };
    let value = nanometres.unwrap_or(f64::INFINITY);
    if value == 0.0 && address.zero_is_none {
        return Ok(0.0);
    }
    let in_units = value / unit as f64;
    if in_units < range[0] || in_units > range[1] {
        return Err((Condition::ValueOutOfRange, [in_units, range[0], range[1]]));
    }
    Ok(value)
}

fn round_half_away(value: i128, divisor: i128) -> i64 {
    let (quotient, rest) = (value / divisor, value % divisor);
    let away = if rest.abs() * 2 >= divisor { rest.signum() } else { 0 };
    i64::try_from(quotient + away).unwrap_or(i64::MAX)
}
