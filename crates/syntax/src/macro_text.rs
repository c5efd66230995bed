//! Macro statements and expressions laid out: blanks around words, none elsewhere.

use crate::number::is_blank;

/// Words that stand between blanks.
const APART: &[&[u8]] = &[
    b"IF", b"THEN", b"WHILE", b"DO", b"END", b"GOTO", b"EQ", b"NE", b"GT", b"LT", b"GE", b"LE", b"OR", b"XOR", b"AND",
    b"MOD",
];

/// Functions, which their bracket follows at once.
const FUNCTIONS: &[&[u8]] = &[
    b"SIN", b"COS", b"TAN", b"ATAN", b"ASIN", b"ACOS", b"SQRT", b"ABS", b"BIN", b"BCD", b"ROUND", b"FIX", b"FUP",
    b"LN", b"EXP",
];

/// A statement or expression in house style; as it is if a word in it is not known.
pub(crate) fn lay_out_macro(text: &[u8]) -> Vec<u8> {
    let bare: Vec<u8> = text.iter().copied().filter(|&byte| !is_blank(byte)).collect();
    let mut out: Vec<u8> = Vec::with_capacity(bare.len() + 8);
    let mut rest = &bare[..];
    let mut blank_due = false;
    while let Some(&byte) = rest.first() {
        if !byte.is_ascii_alphabetic() {
            if std::mem::take(&mut blank_due) {
                out.push(b' ');
            }
            out.push(byte);
            rest = rest.get(1..).unwrap_or_default();
            continue;
        }
        let Some((word, apart)) = word_at(rest) else { return text.to_vec() };
        if !out.is_empty() && (apart || blank_due) {
            out.push(b' ');
        }
        out.extend_from_slice(rest.get(..word).unwrap_or_default());
        blank_due = apart;
        rest = rest.get(word..).unwrap_or_default();
    }
    out
}

/// The number that a statement jumps to with GOTO, as it stands in the text: where, and how long; `Some(None)` if it
/// is not a plain number.
pub fn goto_number(text: &[u8]) -> Option<Option<std::ops::Range<usize>>> {
    let at = text.windows(4).position(|word| word.eq_ignore_ascii_case(b"GOTO"))?;
    let from = at + 4 + text.get(at + 4..)?.iter().take_while(|&&byte| is_blank(byte)).count();
    let rest = text.get(from..).unwrap_or_default();
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let ends = rest.get(digits..).unwrap_or_default().iter().all(|&byte| is_blank(byte));
    Some((digits > 0 && ends).then_some(from..from + digits))
}

/// The length of the word at the head of the letters, and whether blanks stand around it. The longest one counts.
fn word_at(text: &[u8]) -> Option<(usize, bool)> {
    let fits = |word: &&&[u8]| text.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word));
    let apart = APART.iter().filter(fits).map(|word| (word.len(), true)).max();
    let function = FUNCTIONS.iter().filter(fits).map(|word| (word.len(), false)).max();
    apart.max(function)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_number_behind_goto_is_found() {
        assert_eq!(goto_number(b"IF [#1 GT 5] GOTO 90"), Some(Some(18..20)));
        assert_eq!(goto_number(b"GOTO7"), Some(Some(4..5)));
        assert_eq!(goto_number(b"GOTO #1"), Some(None));
        assert_eq!(goto_number(b"GOTO 9+#1"), Some(None));
        assert_eq!(goto_number(b"#1=2"), None);
    }

    #[test]
    fn what_is_not_known_stays_as_it_is() {
        assert_eq!(lay_out_macro(b"#1 = FOO [2]"), b"#1 = FOO [2]");
        assert_eq!(lay_out_macro(b"#1 = - #2"), b"#1=-#2");
    }
}
