//! A value of a variable as the number of a word.

use base::Decimal;

/// Decimal digits kept of a value with a fraction: nanometres, far below any least increment.
const DECIMALS: u8 = 9;
/// Beyond this a value has no place for decimals; every address refuses it anyway.
const LARGE: f64 = 9e8;
const LARGEST: f64 = 9e17;

/// A value as if it had been written with a point.
pub(crate) fn with_point(value: f64) -> Decimal {
    let magnitude = value.abs();
    let (mantissa, decimals) = if magnitude < LARGE {
        ((magnitude * 1e9).round() as u64, DECIMALS)
    } else {
        (magnitude.min(LARGEST) as u64, 0)
    };
    Decimal { mantissa, decimals, digits: digits(magnitude), point: true, negative: value < 0.0 }
}

/// A value as the nearest whole number, written without a point.
pub(crate) fn whole(value: f64) -> Decimal {
    let magnitude = value.abs().round().min(LARGEST);
    Decimal { mantissa: magnitude as u64, decimals: 0, digits: digits(magnitude), point: false, negative: value < 0.0 }
}

fn digits(magnitude: f64) -> u8 {
    let mut digits = 1;
    let mut rest = magnitude / 10.0;
    while rest >= 1.0 && digits < u8::MAX {
        rest /= 10.0;
        digits += 1;
    }
    digits
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_become_the_digits_one_would_write() {
        assert_eq!(with_point(34.641).scaled(3), Some(34641));
        assert_eq!(with_point(-0.0005).scaled(3), Some(-1));
        assert_eq!(with_point(10.0 * 0.3335).scaled(3), Some(3335));
        assert_eq!((whole(89.6).integer(), whole(89.6).digits), (Some(90), 2));
        assert_eq!(whole(-2.5).integer(), Some(-3));
        assert_eq!(with_point(1e300).scaled(3), None);
    }
}
