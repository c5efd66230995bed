//! A block in house style: one blank between words, numbers without needless zeros and signs, comments where they were.
//!
//! Comes in: a block taken apart into [`Item`]s. Goes out: its line. Which item stands before which is not decided here.

use crate::block::{Block, StatementKind, Value};
use crate::macro_text::lay_out_macro;
use crate::number::is_blank;

/// Codes and offset numbers are written with at least so many digits.
const CODE_DIGITS: usize = 2;

/// A part of a block.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Item {
    /// A block-delete sign, as `/` or `/2`.
    Skip(Vec<u8>),
    /// A word: its letter, what follows it without blanks, and how that was read.
    Word {
        /// The letter, a capital.
        letter: u8,
        /// The number or expression, without blanks.
        text: Vec<u8>,
        /// What it is.
        value: Value,
    },
    /// The name of a program that is called.
    Name(Vec<u8>),
    /// A comment with its parentheses.
    Comment(Vec<u8>),
    /// A macro statement.
    Statement {
        /// Its first word.
        kind: StatementKind,
        /// Its text.
        text: Vec<u8>,
    },
}

/// A block's parts in the order in which they stand. `text` holds the block's own characters.
pub fn take_apart(block: &Block, text: &[u8]) -> Vec<Item> {
    let part = |at: u16, len: u16| text.get(usize::from(at)..usize::from(at) + usize::from(len)).unwrap_or_default();
    let bare = |part: &[u8]| part.iter().copied().filter(|&byte| !is_blank(byte)).collect::<Vec<u8>>();
    let mut items: Vec<(u16, Item)> = Vec::new();
    for skip in &block.skips {
        items.push((skip.extent.at, Item::Skip(bare(part(skip.extent.at, skip.extent.len)))));
    }
    for word in &block.words {
        let own = bare(part(word.extent.at, word.extent.len));
        let text = own.get(1..).unwrap_or_default().to_vec();
        items.push((word.extent.at, Item::Word { letter: word.letter, text, value: word.value }));
    }
    if let Some(name) = block.call_name {
        items.push((name.at, Item::Name(part(name.at, name.len).to_vec())));
    }
    for comment in &block.comments {
        let own = part(comment.at, comment.len).iter().copied().filter(|&byte| byte != 0).collect();
        items.push((comment.at, Item::Comment(own)));
    }
    if let Some(statement) = block.statement {
        let own = part(statement.extent.at, statement.extent.len).to_vec();
        items.push((statement.extent.at, Item::Statement { kind: statement.kind, text: own }));
    }
    items.sort_by_key(|(at, _)| *at);
    items.into_iter().map(|(_, item)| item).collect()
}

/// The line that a block's parts make.
pub fn lay_out(items: &[Item]) -> Vec<u8> {
    let mut line = Vec::new();
    let mut after_bare_skip = false;
    for item in items {
        if !line.is_empty() && !after_bare_skip {
            line.push(b' ');
        }
        after_bare_skip = false;
        match item {
            Item::Skip(sign) => {
                line.extend_from_slice(sign);
                after_bare_skip = sign.len() == 1;
            }
            Item::Word { letter, text, value } => {
                line.push(*letter);
                match value {
                    Value::Number(_) => line.extend_from_slice(&number(*letter, text)),
                    Value::Expression => line.extend_from_slice(&lay_out_macro(text)),
                    Value::Missing => line.extend_from_slice(text),
                }
            }
            Item::Name(text) | Item::Comment(text) => line.extend_from_slice(text),
            Item::Statement { text, .. } => line.extend_from_slice(&lay_out_macro(text)),
        }
    }
    line
}

/// A number in house style: the same value, the same point or none, the sign of `-0` kept.
fn number(letter: u8, text: &[u8]) -> Vec<u8> {
    let (sign, digits) = match text {
        [b'-', rest @ ..] => (&b"-"[..], rest),
        [b'+', rest @ ..] => (&b""[..], rest),
        _ => (&b""[..], text),
    };
    let point = digits.iter().position(|&byte| byte == b'.');
    let (whole, rest) = digits.split_at(point.unwrap_or(digits.len()));
    let zeros = whole.iter().take_while(|&&byte| byte == b'0').count();
    let least = match letter {
        // The digits of names are the programmer's; those of F and S can choose between meanings.
        b'N' | b'O' | b'P' | b'F' | b'S' | b'L' | b'B' => whole.len(),
        b'G' | b'M' if point.is_none() => CODE_DIGITS,
        b'T' | b'H' | b'D' if point.is_none() => whole.len().max(CODE_DIGITS),
        _ => 1,
    };
    let kept = whole.get(zeros..).unwrap_or_default();
    let mut out = sign.to_vec();
    out.extend(std::iter::repeat_n(b'0', least.saturating_sub(kept.len())));
    out.extend_from_slice(kept);
    out.extend_from_slice(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Cursor, Grammar, Outcome, read_block};

    fn line(text: &str) -> String {
        let mut block = Block::default();
        let outcome = read_block(text.as_bytes(), true, Cursor::HEAD, &Grammar::default(), &mut block);
        assert_eq!((outcome, &block.faults[..]), (Outcome::Block, &[][..]), "{text}");
        let own = &text.as_bytes()[block.start.offset as usize..];
        String::from_utf8(lay_out(&take_apart(&block, own))).expect("text")
    }

    #[test]
    fn one_blank_stands_between_words_and_none_inside() {
        assert_eq!(line("N10G1X 1 0 . 5Y-2.F100M3"), "N10 G01 X10.5 Y-2. F100 M03");
        assert_eq!(line("/  N5 G0 X1.  (A  REMARK)  "), "/N5 G00 X1. (A  REMARK)");
        assert_eq!(line("G1 X1. /2 Y2. /Z3."), "G01 X1. /2 Y2. /Z3.");
    }

    #[test]
    fn numbers_keep_their_value_and_their_point() {
        assert_eq!(line("X+010.500 Y-.5 Z-0 I.0 K0005"), "X10.500 Y-0.5 Z-0 I0.0 K5");
        assert_eq!(line("O0001"), "O0001");
        assert_eq!(line("N0010 G001 T1 H3 D031 M003 P0100"), "N0010 G01 T01 H03 D031 M03 P0100");
        assert_eq!(line("X0.123456789012345"), "X0.123456789012345");
        assert_eq!(line("G000 M00"), "G00 M00");
    }

    #[test]
    fn macro_statements_are_laid_out() {
        assert_eq!(line("N5 #1 = #2 + 3 (SUM)"), "N5 #1=#2+3 (SUM)");
        assert_eq!(line("IF[#1GT#2]GOTO90"), "IF [#1 GT #2] GOTO 90");
        assert_eq!(line("WHILE [ #31 LE#11 ]DO1"), "WHILE [#31 LE #11] DO 1");
        assert_eq!(line("X[ #24 + COS [#32] ] G#30"), "X[#24+COS[#32]] G#30");
        assert_eq!(line("#1=#2AND#3XOR#4"), "#1=#2 AND #3 XOR #4");
    }
}
