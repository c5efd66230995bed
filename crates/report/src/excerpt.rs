//! The source line of a diagnostic, made fit to be shown: any bytes come in, text with the right columns goes out.

/// Lines longer than this are shown in part.
const LONGEST: usize = 200;

/// A line of a program with the place that is meant.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Excerpt {
    /// The file as the user named it.
    pub file: String,
    /// 1-based line.
    pub line: u64,
    /// 1-based column in bytes.
    pub column: u64,
    /// The line's text.
    pub text: String,
    /// What is meant, as byte positions in `text`.
    pub from: usize,
    /// The end of what is meant.
    pub to: usize,
    /// The offending word as written.
    pub word: String,
}

impl Excerpt {
    /// An excerpt of `bytes`, which begin at the line's first byte; `column` and `width` are in bytes.
    pub fn new(file: &str, line: u64, bytes: &[u8], column: u64, width: u32) -> Excerpt {
        let end = bytes.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(bytes.len());
        let bytes = &bytes[..end];
        let first = usize::try_from(column.saturating_sub(1)).unwrap_or(usize::MAX).min(bytes.len());
        let last = first.saturating_add(width as usize).min(bytes.len());
        let window_start = if first > LONGEST { first - LONGEST / 2 } else { 0 };
        let window_end = bytes.len().min(window_start + LONGEST);
        let mut text = String::new();
        let (mut from, mut to) = (0, 0);
        let shown = String::from_utf8_lossy(&bytes[window_start..window_end]);
        // Characters outside ASCII stand for themselves; a control character is shown as a dot.
        let mut at = window_start;
        for character in shown.chars() {
            if at <= first {
                from = text.len();
            }
            text.push(if character.is_control() { '.' } else { character });
            at += if character == char::REPLACEMENT_CHARACTER { 1 } else { character.len_utf8() };
            if at <= last {
                to = text.len();
            }
        }
        if first >= window_end {
            from = text.len();
        }
        let word = text.get(from..to.max(from)).unwrap_or_default().to_owned();
        Excerpt { file: file.to_owned(), line, column, text, from, to: to.max(from), word }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_word_is_found_again_whatever_bytes_stand_before_it() {
        assert_eq!(Excerpt::new("f", 1, b"G01 X1..2\nM30", 5, 5).word, "X1..2");
        assert_eq!(Excerpt::new("f", 1, b"\x00\xFF(\xE4)X5.", 6, 3).word, "X5.");
        assert_eq!(Excerpt::new("f", 1, "(ä)X5.".as_bytes(), 5, 3).word, "X5.");
        assert_eq!(Excerpt::new("f", 1, b"G01", 9, 3).word, "");
        let long = format!("{}X7.{}", "Y1.".repeat(500), "Z1.".repeat(500));
        assert_eq!(Excerpt::new("f", 1, long.as_bytes(), 1501, 3).word, "X7.");
    }
}
