//! Calls of programs by the names of their files: what stands behind the code is a name and no words.

use base::Condition;

use super::Lexer;
use crate::block::{Value, Word};
use crate::number::{is_blank, scan_number};

impl Lexer<'_> {
    /// The word at hand with the name behind it, if its code calls a program by name; false if the window ends first.
    ///
    /// The name may begin with a digit, so the code ends where its digits do.
    pub(super) fn named_call(&mut self) -> Option<bool> {
        let code = self.grammar.named_call?;
        let from = self.at;
        let first = self.behind_blanks(from + 1);
        let rest = self.text.get(first..).unwrap_or_default();
        let digits = rest.iter().take_while(|digit| digit.is_ascii_digit()).count();
        let behind = first + digits;
        if behind >= self.text.len() && !self.last {
            self.at = self.text.len();
            return Some(false);
        }
        let number = scan_number(rest.get(..digits)?).number?;
        if number.integer() != Some(i64::from(code)) || self.text.get(behind) == Some(&b'.') {
            return None;
        }
        let name = self.behind_blanks(behind);
        let rest = self.text.get(name..).unwrap_or_default();
        // A remark may follow the name at once, and stand in its place never.
        let ends = |(at, &byte): (usize, &u8)| is_blank(byte) || matches!(byte, b'\n' | b';') || byte == b'(' && at > 0;
        let len = match rest.iter().enumerate().position(ends) {
            Some(len) => len,
            None if self.last => rest.len(),
            None => {
                self.at = self.text.len();
                return Some(false);
            }
        };
        let extent = self.extent(from, behind - from);
        self.block.words.push(Word { letter: b'M', extent, value: Value::Number(number) });
        self.at = behind;
        if len > 0 {
            if self.block.call_name.is_some() {
                self.fault(Condition::WordRepeated, from, behind - from);
            }
            self.block.call_name = Some(self.extent(name, len));
            self.at = name + len;
        }
        Some(true)
    }

    fn behind_blanks(&self, mut at: usize) -> usize {
        while self.text.get(at).is_some_and(|&byte| is_blank(byte)) {
            at += 1;
        }
        at
    }
}
