//! The text of a statement, character by character.

use base::Condition;
use syntax::Extent;

use super::trouble::Trouble;

/// The text of a block, read character by character; blanks have no meaning.
pub(crate) struct Scanner<'t> {
    pub text: &'t [u8],
    pub at: usize,
    pub end: usize,
    /// Where the statement or word begins.
    begin: usize,
}

impl<'t> Scanner<'t> {
    pub fn new(text: &'t [u8], extent: Extent) -> Scanner<'t> {
        let end = (usize::from(extent.at) + usize::from(extent.len)).min(text.len());
        let begin = usize::from(extent.at);
        Scanner { text, at: begin, end, begin }
    }

    fn skip(&mut self) {
        while self.at < self.end && matches!(self.text[self.at], b' ' | b'\t' | 0) {
            self.at += 1;
        }
    }

    /// Where the next character stands.
    pub fn here(&mut self) -> usize {
        self.skip();
        self.at
    }

    pub fn peek(&mut self) -> Option<u8> {
        self.skip();
        self.text.get(self.at).filter(|_| self.at < self.end).map(u8::to_ascii_uppercase)
    }

    pub fn take(&mut self, character: u8) -> bool {
        let there = self.peek() == Some(character);
        self.at += usize::from(there);
        there
    }

    /// Takes a word of letters if it stands here.
    pub fn take_word(&mut self, word: &str) -> bool {
        let from = self.at;
        let there = word.bytes().all(|letter| self.take(letter));
        if !there {
            self.at = from;
        }
        there
    }

    /// From a character on up to here.
    pub fn since(&self, from: usize) -> Extent {
        let len = self.at.saturating_sub(from).max(1);
        Extent { at: from.min(usize::from(u16::MAX)) as u16, len: len.min(usize::from(u16::MAX)) as u16 }
    }

    /// The rest, as what cannot be read.
    pub fn unreadable(&mut self) -> Trouble {
        self.skip();
        // What breaks off is shown as a whole.
        let from = if self.at < self.end { self.at } else { self.begin.min(self.end.saturating_sub(1)) };
        let len = self.end.saturating_sub(from).max(1);
        Trouble::at(Condition::MacroStatement, Extent { at: from as u16, len: len.min(usize::from(u16::MAX)) as u16 })
    }

    /// A whole number without sign or point.
    pub fn whole(&mut self) -> Option<u32> {
        let mut value = None;
        while let Some(digit @ b'0'..=b'9') = self.peek() {
            self.at += 1;
            value = Some(value.unwrap_or(0u32).saturating_mul(10).saturating_add(u32::from(digit - b'0')));
        }
        value
    }

    pub fn number(&mut self) -> Option<f64> {
        let (mut mantissa, mut decimals, mut any, mut point) = (0u64, 0i32, false, false);
        loop {
            match self.peek() {
                Some(digit @ b'0'..=b'9') => {
                    any = true;
                    if mantissa < 100_000_000_000_000_000 {
                        mantissa = mantissa * 10 + u64::from(digit - b'0');
                        decimals += i32::from(point);
                    } else if !point {
                        decimals -= 1;
                    }
                }
                Some(b'.') if !point => point = true,
                _ => break,
            }
            self.at += 1;
        }
        let power = |n: i32| libm::pow(10.0, f64::from(n));
        any.then(|| if decimals >= 0 { mantissa as f64 / power(decimals) } else { mantissa as f64 * power(-decimals) })
    }
}
