//! Numbers with their units, as a machinist reads them.

use base::UnitSystem;
use meaning::ReadAs;

/// Millimetres in an inch.
const INCH: f64 = 25.4;

/// A number with so many decimals, without a minus sign before nothing but zeros.
pub fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let zero = text.bytes().all(|byte| matches!(byte, b'-' | b'0' | b'.'));
    if zero { text.trim_start_matches('-').to_owned() } else { text }
}

/// A number with at most so many decimals and no trailing zeros.
pub fn plain(value: f64, decimals: usize) -> String {
    let text = fixed(value, decimals);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

/// A length or angle of an axis.
pub fn coordinate(value: f64) -> String {
    fixed(value, 3)
}

/// What a word's number comes to, with its unit.
pub fn quantity(read: ReadAs, value: f64, units: UnitSystem) -> String {
    let inch = units == UnitSystem::Inch;
    match read {
        ReadAs::Number | ReadAs::Whole | ReadAs::Ratio => plain(value, 6),
        ReadAs::Length if inch => format!("{} in", fixed(value / INCH, 4)),
        ReadAs::Length => format!("{} mm", fixed(value, 3)),
        ReadAs::Angle => format!("{} deg", fixed(value, 3)),
        ReadAs::Seconds => format!("{} s", plain(value, 3)),
        ReadAs::Turns => format!("{} rev", plain(value, 3)),
        ReadAs::FeedPerMinute if inch => format!("{} in/min", plain(value / INCH, 4)),
        ReadAs::FeedPerMinute => format!("{} mm/min", plain(value, 3)),
        ReadAs::FeedPerRevolution if inch => format!("{} in/rev", plain(value / INCH, 5)),
        ReadAs::FeedPerRevolution => format!("{} mm/rev", plain(value, 4)),
    }
}

/// The unit in which a word's value is given to programs that read JSON.
pub const fn unit(read: ReadAs) -> &'static str {
    match read {
        ReadAs::Number | ReadAs::Whole | ReadAs::Ratio => "",
        ReadAs::Length => "mm",
        ReadAs::Angle => "deg",
        ReadAs::Seconds => "s",
        ReadAs::Turns => "rev",
        ReadAs::FeedPerMinute => "mm/min",
        ReadAs::FeedPerRevolution => "mm/rev",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_their_unit_and_no_noise() {
        assert_eq!(quantity(ReadAs::Length, 1.0, UnitSystem::Metric), "1.000 mm");
        assert_eq!(quantity(ReadAs::Length, -0.0001, UnitSystem::Metric), "0.000 mm");
        assert_eq!(quantity(ReadAs::Length, 25.4, UnitSystem::Inch), "1.0000 in");
        assert_eq!(quantity(ReadAs::Seconds, 1.0, UnitSystem::Metric), "1 s");
        assert_eq!(quantity(ReadAs::FeedPerMinute, 312.5, UnitSystem::Metric), "312.5 mm/min");
        assert_eq!(quantity(ReadAs::Whole, 10.0, UnitSystem::Metric), "10");
    }
}
