//! A number as it was written: exact digits, whether a point was written, its sign even when it is zero.

/// The most digits before the point (and of significance in all) that a word can hold.
pub const MOST_DIGITS: u8 = 18;
/// Digits after the point beyond this many change nothing that any control can resolve.
pub const MOST_DECIMALS: u8 = 12;

/// A decimal number of a program word, exactly as written.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Decimal {
    /// All digits as one number, without sign and point.
    pub mantissa: u64,
    /// How many of the digits stand after the point.
    pub decimals: u8,
    /// How many digits were written before the point, leading zeros included.
    pub digits: u8,
    /// True if a decimal point was written, whatever follows it.
    pub point: bool,
    /// True if a minus sign was written, before zero too (`X-0` chooses a direction in G45 to G48).
    pub negative: bool,
}

const POWERS: [i64; 19] = {
    let mut powers = [1i64; 19];
    let mut i = 1;
    while i < 19 {
        powers[i] = powers[i - 1] * 10;
        i += 1;
    }
    powers
};

impl Decimal {
    /// True if the value is zero, however written.
    pub const fn is_zero(self) -> bool {
        self.mantissa == 0
    }

    /// The value times 10 to the `places`, rounded half away from zero; `None` beyond 64 bits.
    pub fn scaled(self, places: u8) -> Option<i64> {
        let magnitude = i64::try_from(self.mantissa).ok()?;
        let value = if self.decimals <= places {
            magnitude.checked_mul(*POWERS.get((places - self.decimals) as usize)?)?
        } else {
            let divisor = *POWERS.get((self.decimals - places) as usize)?;
            let (quotient, rest) = (magnitude / divisor, magnitude % divisor);
            if rest >= divisor - rest { quotient + 1 } else { quotient }
        };
        Some(if self.negative { -value } else { value })
    }

    /// The value as an integer if nothing but zeros stands after the point.
    pub fn integer(self) -> Option<i64> {
        let divisor = *POWERS.get(self.decimals as usize)? as u64;
        if !self.mantissa.is_multiple_of(divisor) {
            return None;
        }
        let magnitude = i64::try_from(self.mantissa / divisor).ok()?;
        Some(if self.negative { -magnitude } else { magnitude })
    }

    /// The value as a floating-point number, correctly rounded for up to 15 digits.
    pub fn to_f64(self) -> f64 {
        let magnitude = self.mantissa as f64 / POWERS[(self.decimals as usize).min(18)] as f64;
        if self.negative { -magnitude } else { magnitude }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn decimal(mantissa: u64, decimals: u8, negative: bool) -> Decimal {
        Decimal { mantissa, decimals, negative, point: decimals > 0, digits: 1 }
    }

    #[test]
    fn scaling_is_exact_and_rounds_half_away_from_zero() {
        assert_eq!(decimal(15, 1, false).scaled(3), Some(1500));
        assert_eq!(decimal(12345, 4, false).scaled(3), Some(1235));
        assert_eq!(decimal(12345, 4, true).scaled(3), Some(-1235));
        assert_eq!(decimal(12344, 4, true).scaled(3), Some(-1234));
        assert_eq!(decimal(u64::MAX, 0, false).scaled(0), None);
        assert_eq!(decimal(999_999_999_999_999_999, 0, false).scaled(3), None);
    }

    #[test]
    fn integers_may_carry_a_zero_fraction_only() {
        assert_eq!(decimal(300, 2, false).integer(), Some(3));
        assert_eq!(decimal(301, 2, false).integer(), None);
        assert_eq!(decimal(7, 0, true).integer(), Some(-7));
        assert_eq!(decimal(25, 1, true).to_f64(), -2.5);
    }
}
