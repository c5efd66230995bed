//! One block from a window of characters, in one pass.

use base::Condition;

use crate::block::{Block, Cursor, Extent, Fault, Skip, Statement, Value, Word};
use crate::grammar::{BlockDelete, Colon, Grammar, LowerCase, Percent, Semicolon};
use crate::number::{is_blank, plain_number, scan_number};
use crate::statement::{expression_len, statement_at};

/// The longest run of characters that is looked at as one block; far above any control's own limit.
pub const LONGEST: usize = 8192;

/// What came of reading.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Outcome {
    /// A block was read.
    Block,
    /// The window ends before the block does; nothing was read. Offer a window that reaches further.
    More,
    /// The text has ended.
    End,
}

/// Reads the next block.
///
/// `window` holds the text's characters from `cursor.offset` on, `last` says that the text ends with it. The block's
/// `next` is the cursor for the following call. Blank lines are blocks too, so that lines can be counted.
/// A window of [`LONGEST`] + 2 characters is always enough.
pub fn read_block(window: &[u8], last: bool, cursor: Cursor, grammar: &Grammar, block: &mut Block) -> Outcome {
    let mut cursor = cursor;
    let mut window = window;
    if cursor.skipping {
        let (used, found) = match window.iter().position(|&b| b == b'\n') {
            Some(at) => (at + 1, true),
            None => (window.len(), false),
        };
        cursor.offset += used as u64;
        window = &window[used..];
        if found {
            cursor = Cursor { line: cursor.line + 1, line_start: cursor.offset, skipping: false, ..cursor };
        }
        block.clear(cursor);
        if !found {
            // Nothing here but the rest of an over-long line: an empty block moves the cursor past it.
            return match (last, used) {
                (true, _) => Outcome::End,
                (false, 0) => Outcome::More,
                (false, _) => Outcome::Block,
            };
        }
    }
    if window.is_empty() {
        block.clear(cursor);
        return if last { Outcome::End } else { Outcome::More };
    }
    Lexer { text: window, last, grammar, block, at: 0, ignored: 0, start: 0 }.run(cursor)
}

/// How the block came to its end.
enum End {
    /// At an end-of-block, at a `;`, or at the end of the text; so many characters belong to the ending itself.
    At(usize),
    /// The window ended first.
    Window,
}

struct Lexer<'a> {
    text: &'a [u8],
    last: bool,
    grammar: &'a Grammar,
    block: &'a mut Block,
    /// The next character, counted from the window's head.
    at: usize,
    /// Characters passed over that no tape counts.
    ignored: usize,
    /// The block's first character that is not blank.
    start: usize,
}

impl Lexer<'_> {
    fn run(mut self, cursor: Cursor) -> Outcome {
        while self.text.get(self.at).is_some_and(|&b| is_blank(b)) {
            self.at += 1;
            if self.at > LONGEST {
                // Blank tape, a leader say: passed over piece by piece.
                self.block.clear(cursor);
                self.block.next.offset = cursor.offset + self.at as u64;
                return Outcome::Block;
            }
        }
        self.start = self.at;
        self.block.clear(Cursor { offset: cursor.offset + self.at as u64, ..cursor });
        match self.words() {
            End::Window if self.at - self.start > LONGEST => self.give_up(cursor),
            End::Window if !self.last => Outcome::More,
            End::Window => self.close(cursor, 0),
            End::At(ending) => self.close(cursor, ending),
        }
    }

    fn words(&mut self) -> End {
        loop {
            let Some(&byte) = self.text.get(self.at) else { return End::Window };
            if self.at - self.start > LONGEST {
                return End::Window;
            }
            match byte {
                b'A'..=b'Z' => {
                    if self.statement() {
                        continue;
                    }
                    if !self.word(byte) {
                        return End::Window;
                    }
                }
                b'\n' => return End::At(1),
                0 => {
                    self.ignored += 1;
                    self.at += 1;
                }
                b' ' | b'\t' => self.at += 1,
                b'(' => {
                    if !self.comment() {
                        return End::Window;
                    }
                }
                b';' => {
                    if self.grammar.semicolon == Semicolon::EndOfBlock {
                        return End::At(1);
                    }
                    match self.text[self.at..].iter().position(|&b| b == b'\n') {
                        Some(len) => self.end_comment(len),
                        None if self.last => self.end_comment(self.text.len() - self.at),
                        None => {
                            self.at = self.text.len();
                            return End::Window;
                        }
                    }
                }
                b'%' if self.grammar.percent == Percent::Ignore => {
                    if !self.lone_percent() {
                        return End::Window;
                    }
                }
                b'%' => {
                    if self.at > self.start {
                        return End::At(0);
                    }
                    self.block.rewind = true;
                    self.at += 1;
                    return self.after_rewind();
                }
                b'/' => self.skip_sign(),
                b'#' => {
                    if !self.statement() {
                        self.fault(Condition::CharacterUnknown, self.at, 1);
                        self.at += 1;
                    }
                }
                b':' if self.grammar.colon == Colon::ProgramNumber => {
                    if !self.word(b'O') {
                        return End::Window;
                    }
                }
                b'a'..=b'z' => {
                    let refused = self.grammar.lower_case == LowerCase::Refuse;
                    if !refused && self.statement() {
                        continue;
                    }
                    let from = self.at;
                    let whole = self.word(byte.to_ascii_uppercase());
                    if refused {
                        self.fault(Condition::LowerCase, from, self.at - from);
                    }
                    if !whole {
                        return End::Window;
                    }
                }
                b'0'..=b'9' | b'+' | b'-' | b'.' => {
                    let scan = scan_number(&self.text[self.at..]);
                    if scan.open && !self.last {
                        self.at = self.text.len();
                        return End::Window;
                    }
                    self.fault(Condition::AddressMissing, self.at, scan.len);
                    self.at += scan.len;
                }
                b')' => {
                    self.fault(Condition::CommentClose, self.at, 1);
                    self.at += 1;
                }
                _ => {
                    self.fault(Condition::CharacterUnknown, self.at, 1);
                    self.at += 1;
                }
            }
        }
    }

    /// A letter and its number. False if the window ends first.
    fn word(&mut self, letter: u8) -> bool {
        if letter == b'M'
            && let Some(whole) = self.named_call()
        {
            return whole;
        }
        let from = self.at;
        if let Some((number, len)) = plain_number(&self.text[from + 1..]) {
            let extent = self.extent(from, 1 + len);
            self.block.words.push(Word { letter, extent, value: Value::Number(number) });
            self.at = from + 1 + len;
            return true;
        }
        self.other_word(letter)
    }

    /// A letter and what is not simply a number. False if the window ends first.
    fn other_word(&mut self, letter: u8) -> bool {
        let from = self.at;
        let scan = scan_number(&self.text[from + 1..]);
        if scan.open && !self.last {
            self.at = self.text.len();
            return false;
        }
        let (len, value) = match scan.number {
            Some(number) => {
                if let Some((condition, _)) = scan.fault {
                    self.fault(condition, from, 1 + scan.len);
                }
                (1 + scan.len, Value::Number(number))
            }
            None => match expression_len(&self.text[from + 1..], self.last) {
                None if !self.last => {
                    self.at = self.text.len();
                    return false;
                }
                None | Some(Ok(0)) => {
                    match scan.fault {
                        Some((condition, _)) => self.fault(condition, from, 1 + scan.len),
                        None => self.fault(Condition::NumberMissing, from, 1),
                    }
                    (1 + scan.len, Value::Missing)
                }
                Some(Ok(len)) => {
                    self.block.variables = true;
                    (1 + len, Value::Expression)
                }
                Some(Err(at)) => {
                    self.fault(Condition::MacroStatement, from, 1 + at);
                    (1 + at, Value::Missing)
                }
            },
        };
        let extent = self.extent(from, len);
        self.block.words.push(Word { letter, extent, value });
        self.at = from + len;
        true
    }

    /// A macro statement takes the rest of the block, comments apart.
    fn statement(&mut self) -> bool {
        if matches!(self.text.get(self.at + 1), Some(b'0'..=b'9' | b'-' | b'.' | b'+')) && self.text[self.at] != b'#' {
            return false;
        }
        let fold = self.grammar.lower_case == LowerCase::Fold;
        let Some(kind) = statement_at(&self.text[self.at..], fold) else { return false };
        let from = self.at;
        while let Some(&byte) = self.text.get(self.at) {
            match byte {
                b'\n' | b'(' | b'%' | b';' => break,
                0 => self.ignored += 1,
                _ => {}
            }
            self.at += 1;
        }
        let mut end = self.at;
        while end > from && is_blank(self.text[end - 1]) {
            end -= 1;
        }
        let extent = self.extent(from, end - from);
        if self.block.statement.is_some() {
            self.fault(Condition::MacroStatement, from, end - from);
        } else {
            self.block.statement = Some(Statement { kind, extent });
        }
        true
    }

    /// A comment in parentheses. False if the window ends first.
    fn comment(&mut self) -> bool {
        let from = self.at;
        let Some(len) = self.text[from..].iter().position(|&b| matches!(b, b')' | b'\n')) else {
            self.at = self.text.len();
            if self.last {
                self.fault(Condition::CommentOpen, from, self.at - from);
            }
            return self.last;
        };
        if self.text[from + len] == b'\n' {
            self.fault(Condition::CommentOpen, from, len);
            self.at = from + len;
        } else {
            let extent = self.extent(from, len + 1);
            self.block.comments.push(extent);
            self.at = from + len + 1;
        }
        true
    }

    /// A comment that takes the rest of the line.
    fn end_comment(&mut self, len: usize) {
        let extent = self.extent(self.at, len);
        self.block.comments.push(extent);
        self.at += len;
    }

    /// `%` that says nothing, if it stands alone on its line. False if the window ends first.
    fn lone_percent(&mut self) -> bool {
        let behind = self.text.get(self.at + 1..).unwrap_or_default().iter().find(|&&byte| !is_blank(byte));
        if behind.is_none() && !self.last {
            self.at = self.text.len();
            return false;
        }
        if self.at == self.start && matches!(behind, None | Some(b'\n')) {
            let extent = self.extent(self.at, 1);
            self.block.comments.push(extent);
        } else {
            self.fault(Condition::CharacterUnknown, self.at, 1);
        }
        self.at += 1;
        true
    }

    fn skip_sign(&mut self) {
        let from = self.at;
        if self.grammar.block_delete == BlockDelete::Head {
            return self.skip_sign_at_head();
        }
        let mut next = from + 1;
        while self.text.get(next).is_some_and(|&b| is_blank(b)) {
            next += 1;
        }
        let (switch, len) = match self.text.get(next) {
            Some(digit @ b'1'..=b'9') => (digit - b'0', next + 1 - from),
            _ => (1, 1),
        };
        let first_word = u16::try_from(self.block.words.len()).unwrap_or(u16::MAX);
        let extent = self.extent(from, len);
        self.block.skips.push(Skip { switch, first_word, extent });
        self.at = from + len;
    }

    fn skip_sign_at_head(&mut self) {
        let only_number = self.block.words.iter().all(|word| word.letter == b'N') && self.block.skips.is_empty();
        if only_number && self.block.statement.is_none() {
            let first_word = u16::try_from(self.block.words.len()).unwrap_or(u16::MAX);
            let extent = self.extent(self.at, 1);
            self.block.skips.push(Skip { switch: 1, first_word, extent });
        } else {
            self.fault(Condition::BlockDeletePlace, self.at, 1);
        }
        self.at += 1;
    }

    /// `%` is a block of its own: blanks and one end-of-block after it belong to it.
    fn after_rewind(&mut self) -> End {
        let mut next = self.at;
        while self.text.get(next).is_some_and(|&b| is_blank(b)) {
            next += 1;
        }
        match self.text.get(next) {
            Some(b'\n') => End::At(next + 1 - self.at),
            Some(_) => End::At(0),
            None if self.last => End::At(0),
            None => {
                self.at = self.text.len();
                End::Window
            }
        }
    }

    fn close(self, cursor: Cursor, ending: usize) -> Outcome {
        let Lexer { text, grammar, block, at, ignored, start, .. } = self;
        let mut end = at;
        while end > start && is_blank(text[end - 1]) {
            end -= 1;
        }
        block.len = (end - start) as u32;
        let characters = (at - start).saturating_sub(ignored) + 1;
        if characters > grammar.block_length as usize && block.faults.len() < MOST_FAULTS {
            let limit = (grammar.block_length as usize).min(at - start);
            let extent = Extent { at: limit as u16, len: (at - start - limit).max(1) as u16 };
            block.faults.push(Fault { condition: Condition::BlockTooLong, extent });
        }
        // Blanks at its end do not belong to the block, nor to a comment or fault that reached into them.
        if end < at || !block.faults.is_empty() {
            let words = block.words.iter_mut().map(|word| &mut word.extent);
            let faults = block.faults.iter_mut().map(|fault| &mut fault.extent);
            let extents = block.comments.iter_mut().chain(words).chain(faults);
            extents.for_each(|extent| extent.clip(block.len));
        }
        let offset = cursor.offset + (at + ending) as u64;
        let ended_line = ending > 0 && text[at + ending - 1] == b'\n';
        block.next = if ended_line {
            Cursor { offset, line: cursor.line + 1, line_start: offset, skipping: false }
        } else {
            Cursor { offset, ..cursor }
        };
        Outcome::Block
    }

    /// The block is longer than anything that is looked at: it is refused, and the rest of its line passed over.
    fn give_up(self, cursor: Cursor) -> Outcome {
        let Lexer { block, at, start, grammar, .. } = self;
        block.words.clear();
        block.skips.clear();
        block.comments.clear();
        block.call_name = None;
        block.statement = None;
        block.variables = false;
        block.faults.clear();
        block.len = (at - start).min(LONGEST) as u32;
        let from = (grammar.block_length as usize).min(LONGEST - 1) as u16;
        let extent = Extent { at: from, len: 1 };
        block.faults.push(Fault { condition: Condition::BlockTooLong, extent });
        block.next = Cursor { offset: cursor.offset + at as u64, skipping: true, ..cursor };
        Outcome::Block
    }

    fn extent(&self, from: usize, len: usize) -> Extent {
        Extent { at: u16::try_from(from - self.start).unwrap_or(u16::MAX), len: u16::try_from(len).unwrap_or(u16::MAX) }
    }

    fn fault(&mut self, condition: Condition, from: usize, len: usize) {
        if self.block.faults.len() < MOST_FAULTS {
            let extent = self.extent(from, len);
            self.block.faults.push(Fault { condition, extent });
        }
    }
}

/// Faults beyond so many in one block say nothing new.
const MOST_FAULTS: usize = 64;

mod call;

#[cfg(test)]
mod tests;
