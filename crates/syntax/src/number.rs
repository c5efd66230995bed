//! The digits of a word to an exact [`Decimal`].

use base::{
    Condition, Decimal,
    number::{MOST_DECIMALS, MOST_DIGITS},
};

/// A number as far as it was read.
pub(crate) struct Scan {
    /// Characters taken, blanks inside included.
    pub len: usize,
    /// The number, if there were digits.
    pub number: Option<Decimal>,
    /// What is wrong with it, and at which character.
    pub fault: Option<(Condition, usize)>,
    /// The characters ran out while the number could still go on.
    pub open: bool,
}

/// Blanks have no meaning, not even inside a number.
pub(crate) const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0)
}

/// The usual number at the head of `text`, and its length: no blank inside it, nothing wrong with it, and a character
/// behind it that ends it. `None` leaves it to [`scan_number`].
#[inline]
pub(crate) fn plain_number(text: &[u8]) -> Option<(Decimal, usize)> {
    let negative = text.first() == Some(&b'-');
    let from = usize::from(negative);
    let (mut at, mut mantissa, mut point) = (from, 0u64, None);
    loop {
        match *text.get(at)? {
            digit @ b'0'..=b'9' => mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit - b'0')),
            b'.' if point.is_none() => point = Some(at),
            b'.' | b'+' | b'-' => return None,
            blank if is_blank(blank) && !text.get(at + 1)?.is_ascii_uppercase() => return None,
            _ => break,
        }
        at += 1;
    }
    let decimals = point.map_or(0, |point| at - point - 1);
    let digits = at - from - decimals - usize::from(point.is_some());
    if !(1..=usize::from(MOST_DIGITS)).contains(&(digits + decimals)) || decimals > usize::from(MOST_DECIMALS) {
        return None;
    }
    let (decimals, digits) = (decimals as u8, digits as u8);
    Some((Decimal { mantissa, decimals, digits, point: point.is_some(), negative }, at))
}

/// Reads sign, digits and point from the head of `text`.
pub(crate) fn scan_number(text: &[u8]) -> Scan {
    let mut number = Decimal::default();
    let mut significant = 0u8;
    let mut any = false;
    let mut signed = false;
    let mut fault = None;
    let mut end = 0;
    let mut i = 0;
    while let Some(&byte) = text.get(i) {
        match byte {
            b'0'..=b'9' => {
                any = true;
                if number.point {
                    if number.decimals < MOST_DECIMALS && significant < MOST_DIGITS {
                        number.decimals += 1;
                        number.mantissa = number.mantissa * 10 + u64::from(byte - b'0');
                        significant += u8::from(number.mantissa > 0);
                    }
                } else {
                    number.digits = number.digits.saturating_add(1);
                    if significant < MOST_DIGITS {
                        number.mantissa = number.mantissa * 10 + u64::from(byte - b'0');
                        significant += u8::from(number.mantissa > 0);
                    } else if fault.is_none() {
                        fault = Some((Condition::NumberTooLong, i));
                    }
                }
            }
            b'.' => {
                if number.point && fault.is_none() {
                    fault = Some((Condition::SignOrPoint, i));
                }
                number.point = true;
            }
            b'+' | b'-' => {
                if (any || signed || number.point) && fault.is_none() {
                    fault = Some((Condition::SignOrPoint, i));
                }
                signed = true;
                number.negative |= byte == b'-';
            }
            _ if is_blank(byte) => {
                i += 1;
                continue;
            }
            _ => break,
        }
        i += 1;
        end = i;
    }
    let open = i == text.len();
    if number.point && !any && fault.is_none() {
        // A lone point (`X.`) is no number.
        fault = Some((Condition::SignOrPoint, end - 1));
    }
    Scan { len: end, number: any.then_some(number), fault, open }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(text: &str) -> Decimal {
        let scan = scan_number(text.as_bytes());
        assert_eq!(scan.fault, None, "{text}");
        scan.number.unwrap_or_default()
    }

    #[test]
    fn digits_point_and_sign_are_kept_as_written() {
        assert_eq!(number("-012.50"), Decimal { mantissa: 1250, decimals: 2, digits: 3, point: true, negative: true });
        assert_eq!(number("+.5"), Decimal { mantissa: 5, decimals: 1, digits: 0, point: true, negative: false });
        assert_eq!(number("-0"), Decimal { mantissa: 0, decimals: 0, digits: 1, point: false, negative: true });
        assert_eq!(number("1 0 . 5"), number("10.5"));
    }

    #[test]
    fn decimals_without_end_are_harmless_and_digits_without_end_are_not() {
        let long = number("0.33333333333333333333333333333333333");
        assert_eq!(long.decimals, MOST_DECIMALS);
        assert_eq!(scan_number(b"1234567890123456789").fault, Some((Condition::NumberTooLong, 18)));
        assert_eq!(number("0000000000000000000000001").mantissa, 1);
    }

    #[test]
    fn the_usual_numbers_are_read_alike_in_both_ways() {
        let mut plain = 0;
        for sign in ["", "-", "+"] {
            for digits in
                ["", "0", "7", "012", "1.", ".5", "-1", "1.25.", ".", "1 2", "0.1234567890123", "12345678901234.5"]
            {
                for end in ["Y", "\n", " Y1", " 1", ";", "", " ", "0000000000Y", "-", "(a)"] {
                    let text = format!("{sign}{digits}{end}");
                    let scan = scan_number(text.as_bytes());
                    if let Some((number, len)) = plain_number(text.as_bytes()) {
                        plain += 1;
                        assert_eq!(
                            (Some(number), len, None, false),
                            (scan.number, scan.len, scan.fault, scan.open),
                            "{text}"
                        );
                    }
                }
            }
        }
        assert!(plain > 60, "{plain}");
    }

    #[test]
    fn stray_signs_and_points_are_found_where_they_stand() {
        assert_eq!(scan_number(b"1-2").fault, Some((Condition::SignOrPoint, 1)));
        assert_eq!(scan_number(b"1.2.3").fault, Some((Condition::SignOrPoint, 3)));
        assert_eq!(scan_number(b"--2").fault, Some((Condition::SignOrPoint, 1)));
        assert_eq!(scan_number(b".").fault, Some((Condition::SignOrPoint, 0)));
        assert!(scan_number(b"X").number.is_none());
    }
}
