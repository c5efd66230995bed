//! A program as the edit display has it: the words of its part of a text, and the ends of its blocks.

use base::SourceId;
use syntax::{Block, Cursor, Extent, Grammar, Outcome, read_block};
use tape::{Codes, Format, IGNORED, recognise};

use crate::library::{Library, LibraryError};

/// Longer texts are not edited, bytes.
const LONGEST: usize = 16 << 20;
/// Bytes read at a time.
const PIECE: usize = 1 << 16;

/// What the cursor stands on: a word, a sign, a whole macro statement, a comment, or the end of a block.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Part {
    pub at: usize,
    pub len: usize,
    pub line: u64,
    /// It is the end of a block.
    pub ends: bool,
    /// Where its block begins.
    pub block: usize,
}

/// A program in its text.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct ProgramText {
    pub text: Vec<u8>,
    pub parts: Vec<Part>,
    /// The program's own part of the text.
    pub from: usize,
    pub to: usize,
}

/// The whole text of a source in the control's characters, every line ended alike.
///
/// # Errors
/// It cannot be read, or is too long.
pub(crate) fn text_of(
    library: &mut impl Library,
    source: SourceId,
    codes: Option<Codes>,
) -> Result<Vec<u8>, LibraryError> {
    let (mut bytes, mut piece) = (Vec::new(), Vec::new());
    loop {
        let last = library.read(source, bytes.len() as u64, PIECE, &mut piece)? || piece.is_empty();
        bytes.extend_from_slice(&piece);
        if last {
            break;
        }
        if bytes.len() > LONGEST {
            return Err(LibraryError("the text is too long to be taken as a whole".to_owned()));
        }
    }
    let format = codes.as_ref().map_or(Format::Text, |codes| recognise(&bytes, codes));
    format.translate(&codes.unwrap_or_default(), &mut bytes, 0, true);
    let head = usize::try_from(format.head()).unwrap_or(0).min(bytes.len());
    Ok(bytes.split_off(head).into_iter().filter(|&byte| byte != IGNORED).collect())
}

/// Every block of a text with its characters, until `see` has seen enough.
pub(crate) fn blocks_of_text(text: &[u8], grammar: &Grammar, mut see: impl FnMut(&Block) -> bool) {
    let (mut block, mut cursor) = (Block::default(), Cursor::HEAD);
    loop {
        let from = usize::try_from(cursor.offset).unwrap_or(usize::MAX).min(text.len());
        match read_block(&text[from..], true, cursor, grammar, &mut block) {
            Outcome::Block => {}
            Outcome::End | Outcome::More => return,
        }
        if !see(&block) || block.next.offset <= cursor.offset {
            return;
        }
        cursor = block.next;
    }
}

impl ProgramText {
    /// The program of this number in a text, the first one without a number; `None` if there is none.
    pub fn of(text: Vec<u8>, number: Option<u32>, grammar: &Grammar) -> Option<ProgramText> {
        let (mut parts, mut from, mut to, mut begun) = (Vec::new(), None, text.len(), false);
        blocks_of_text(&text, grammar, |block| {
            let start = block.start.offset as usize;
            let named = block.whole_number(b'O').filter(|_| block.begins_program(grammar));
            if from.is_none() {
                let is_it = match number {
                    Some(number) => named == Some(i64::from(number)),
                    None => !block.rewind,
                };
                if !is_it {
                    return true;
                }
                from = Some(start);
            } else if begun && (named.is_some() || block.rewind) {
                to = start;
                return false;
            }
            begun = true;
            put_parts(block, &mut parts);
            true
        });
        Some(ProgramText { text, parts, from: from?, to })
    }

    /// The characters of a part; the end of a block is `;`.
    pub fn word(&self, part: &Part) -> String {
        if part.ends {
            return ";".to_owned();
        }
        let own = self.text.get(part.at..part.at + part.len).unwrap_or_default();
        String::from_utf8_lossy(own).into_owned()
    }

    /// The index of the part at or behind this place; the last one behind them all.
    pub fn part_at(&self, at: usize) -> usize {
        let found = self.parts.iter().position(|part| part.at + part.len > at);
        found.unwrap_or(self.parts.len().saturating_sub(1))
    }

    /// The lines of the program with their numbers, as a page shows them: so many from this line on.
    pub fn lines(&self, first: u64, most: usize) -> Vec<String> {
        let before = self.text[..self.from].iter().filter(|&&byte| byte == b'\n').count() as u64;
        let lines = self.text[self.from..self.to].split(|&byte| byte == b'\n').enumerate();
        let own = lines.filter(|(index, _)| before + 1 + *index as u64 >= first).take(most);
        let mut own: Vec<_> = own.map(|(_, line)| String::from_utf8_lossy(line).into_owned()).collect();
        if own.last().is_some_and(String::is_empty) {
            own.pop();
        }
        own
    }
}

/// The parts of a block in their order.
fn put_parts(block: &Block, parts: &mut Vec<Part>) {
    let start = block.start.offset as usize;
    let extents = block.words.iter().map(|word| word.extent);
    let extents = extents.chain(block.skips.iter().map(|skip| skip.extent)).chain(block.comments.iter().copied());
    let mut own: Vec<Extent> = extents.chain(block.call_name).chain(block.statement.map(|it| it.extent)).collect();
    own.sort_by_key(|extent| extent.at);
    let line = block.start.line;
    let part = |at, len, ends| Part { at, len, line, ends, block: start };
    parts.extend(own.iter().map(|extent| part(start + usize::from(extent.at), usize::from(extent.len), false)));
    let end = start + block.len as usize;
    let next = block.next.offset as usize;
    if next > end {
        parts.push(part(end, next - end, true));
    }
}

/// The number of a program that is known by one: `O1234`.
pub fn number_of(name: &str) -> Option<u32> {
    name.strip_prefix('O')?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_its_words_and_ends_of_blocks() {
        let text = b"%\nO1\nG00X10.Y-1\nM30\nO2\n/2G01 X1 (END)\nM99\n%\n".to_vec();
        let words = |number| {
            let program = ProgramText::of(text.clone(), number, &Grammar::default()).expect("it is there");
            program.parts.iter().map(|part| program.word(part)).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(words(Some(1)), "O1 ; G00 X10. Y-1 ; M30 ;");
        assert_eq!(words(Some(2)), "O2 ; /2 G01 X1 (END) ; M99 ;");
        assert_eq!(words(None), words(Some(1)));
        assert_eq!(ProgramText::of(text, Some(3), &Grammar::default()), None);
    }
}
