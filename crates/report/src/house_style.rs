//! A program's text in house style: one block a line, words in order, blanks between them, numbered if that is wished.
//!
//! Comes in: a text's bytes. Goes out: the same programs, their blocks word for word the same, line by line beside the
//! old ones. A block that cannot be read stays as it is; so does everything behind the tape's end.

mod numbering;

use std::collections::BTreeSet;

use dialect::{Control, put_in_order};
use syntax::{Block, Cursor, Item, Outcome, Value, lay_out, read_block, take_apart};
use tape::{Reader, Text};

pub use numbering::Numbering;

/// What is wished of a text.
#[derive(Clone, Debug, Default)]
pub struct HouseStyle {
    /// Letters that are axes on this machine.
    pub axes: Vec<u8>,
    /// New sequence numbers.
    pub numbering: Option<Numbering>,
    /// Blocks that the control refuses, by the byte at which they begin: they stay as they are.
    pub refused: BTreeSet<u64>,
}

/// A text in house style.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Formatted {
    /// Its bytes.
    pub text: Vec<u8>,
    /// Each line of the old text with the lines that take its place, none with their ends.
    pub lines: Vec<(Vec<u8>, Vec<Vec<u8>>)>,
    /// Where old and new text agree to the end: what stands behind the tape's end is not listed.
    pub unchanged: bool,
    /// The programs of the text that others in it call, by their numbers.
    pub called: Vec<u32>,
}

/// A block of the text.
pub(crate) struct Parsed {
    pub line: u64,
    /// Which program of the text it belongs to.
    pub program: usize,
    pub kind: Kind,
}

/// What a block is to be.
pub(crate) enum Kind {
    /// The sign of the tape's ends.
    Rewind,
    /// As it stands.
    Raw(Vec<u8>),
    /// Laid out, in house order if `reorder`.
    Items { items: Vec<Item>, reorder: bool, raw: Vec<u8> },
}

/// Puts a text into house style.
///
/// # Errors
/// Why it cannot be numbered, in words.
pub fn house_style(bytes: &[u8], control: &Control, style: &HouseStyle) -> Result<Formatted, String> {
    let mut characters = bytes.to_vec();
    Text.translate(&mut characters, 0, true);
    let (mut blocks, tail) = parse(bytes, &characters, control, style);
    let called = numbering::called_programs(&blocks, control);
    if let Some(numbering) = style.numbering {
        numbering::renumber(&mut blocks, control, numbering)?;
    }
    let mut lines: Vec<(Vec<u8>, Vec<Vec<u8>>)> = old_lines(bytes, &characters, tail);
    for block in &blocks {
        let new = print(block, control, style)?;
        if let Some((_, lines)) = usize::try_from(block.line - 1).ok().and_then(|line| lines.get_mut(line)) {
            lines.push(new);
        }
    }
    let end = line_end(bytes);
    let mut text = byte_order_mark(bytes).to_vec();
    for (old, new) in &mut lines {
        let mark = byte_order_mark(old).len();
        old.drain(..mark);
        if new.is_empty() {
            new.push(Vec::new());
        }
        for line in new {
            text.extend_from_slice(line);
            text.extend_from_slice(end);
        }
    }
    text.extend_from_slice(bytes.get(tail..).unwrap_or_default());
    let unchanged = text == bytes;
    Ok(Formatted { text, lines, unchanged, called })
}

fn byte_order_mark(bytes: &[u8]) -> &[u8] {
    const MARK: &[u8] = b"\xEF\xBB\xBF";
    if bytes.starts_with(MARK) { MARK } else { b"" }
}

/// How the text's lines end: as the first one does.
fn line_end(bytes: &[u8]) -> &'static [u8] {
    match bytes.iter().position(|byte| matches!(byte, b'\r' | b'\n')) {
        Some(at) if bytes.get(at..at + 2) == Some(b"\r\n") => b"\r\n",
        Some(at) if bytes.get(at) == Some(&b'\r') => b"\r",
        _ => b"\n",
    }
}

/// The lines before the tail, without their ends.
fn old_lines(bytes: &[u8], characters: &[u8], tail: usize) -> Vec<(Vec<u8>, Vec<Vec<u8>>)> {
    let mut lines = Vec::new();
    let mut from = 0;
    while from < tail {
        let rest = characters.get(from..tail).unwrap_or_default();
        let len = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        let old = bytes.get(from..from + len).unwrap_or_default();
        lines.push((old.strip_suffix(b"\r").unwrap_or(old).to_vec(), Vec::new()));
        from += len + 1;
    }
    lines
}

/// The text's blocks, and where it ends for the control.
fn parse(bytes: &[u8], characters: &[u8], control: &Control, style: &HouseStyle) -> (Vec<Parsed>, usize) {
    let mut blocks: Vec<Parsed> = Vec::new();
    let mut block = Block::default();
    let (mut cursor, mut program, mut begun) = (Cursor::HEAD, 0, false);
    loop {
        let at = (cursor.offset as usize).min(characters.len());
        let window = characters.get(at..).unwrap_or_default();
        if read_block(window, true, cursor, &control.grammar, &mut block) != Outcome::Block {
            return (blocks, bytes.len());
        }
        cursor = block.next;
        let line = block.start.line;
        if block.rewind {
            blocks.push(Parsed { line, program, kind: Kind::Rewind });
            if begun {
                return (blocks, (cursor.offset as usize).min(bytes.len()));
            }
            begun = true;
            continue;
        }
        let from = block.start.offset as usize;
        let own = characters.get(from..from + block.len as usize).unwrap_or_default();
        if block.is_empty() && block.comments.is_empty() {
            continue;
        }
        begun |= !block.is_empty();
        let named = block.begins_program(&control.grammar);
        if named && blocks.iter().any(is_said) {
            program += 1;
        }
        let raw: Vec<u8> = own.iter().copied().filter(|&byte| byte != 0).collect();
        let kind = if cursor.skipping {
            // Far longer than any block: the rest of its line belongs to it, whatever stands there.
            let rest = characters.get(from..).unwrap_or_default();
            let end = from + rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
            cursor.offset = end as u64;
            Kind::Raw(bytes.get(from..end).unwrap_or_default().trim_ascii_end().to_vec())
        } else if !block.faults.is_empty() {
            Kind::Raw(raw)
        } else {
            let reorder = !style.refused.contains(&block.start.offset);
            Kind::Items { items: take_apart(&block, own), reorder, raw }
        };
        blocks.push(Parsed { line, program, kind });
    }
}

/// True for a block that says something.
fn is_said(block: &Parsed) -> bool {
    match &block.kind {
        Kind::Rewind => false,
        Kind::Raw(_) => true,
        Kind::Items { items, .. } => items.iter().any(|item| !matches!(item, Item::Comment(_))),
    }
}

/// The line of a block. One that is not read back word for word, or would be too long for the control, stays as it is.
fn print(block: &Parsed, control: &Control, style: &HouseStyle) -> Result<Vec<u8>, String> {
    let (items, reorder, raw) = match &block.kind {
        Kind::Rewind => return Ok(b"%".to_vec()),
        Kind::Raw(raw) => return Ok(raw.clone()),
        Kind::Items { items, reorder, raw } => (items, *reorder, raw),
    };
    if !reorder && style.numbering.is_none() {
        return Ok(raw.clone());
    }
    let mut ordered = items.clone();
    if reorder {
        put_in_order(control, |letter| style.axes.contains(&letter), &mut ordered);
    }
    let line = lay_out(&ordered);
    if says_the_same(&line, items, control) {
        return Ok(line);
    }
    match style.numbering {
        None => Ok(raw.clone()),
        Some(_) => Err(format!("line {}: with its new number the block is too long for the control", block.line)),
    }
}

/// True if a line, read back, has the words of these parts, each piece between block-delete signs the same ones.
fn says_the_same(line: &[u8], items: &[Item], control: &Control) -> bool {
    let mut block = Block::default();
    let outcome = read_block(line, true, Cursor::HEAD, &control.grammar, &mut block);
    let whole = outcome == Outcome::Block && block.faults.is_empty() && block.next.offset as usize == line.len();
    whole && signature(&take_apart(&block, line)) == signature(items)
}

/// What a block says, piece by piece, whatever the order of the words in a piece.
fn signature(items: &[Item]) -> Vec<Vec<String>> {
    let mut pieces = vec![Vec::new()];
    for item in items {
        let said = match item {
            Item::Skip(sign) => {
                pieces.push(vec![format!("/{}", String::from_utf8_lossy(sign))]);
                continue;
            }
            Item::Word { letter, value: Value::Number(number), .. } => {
                let base::Decimal { mantissa, decimals, point, negative, .. } = number;
                format!("{letter} {mantissa} {decimals} {point} {negative}")
            }
            Item::Word { letter, text, .. } => format!("{letter} {text:?}"),
            Item::Name(text) => format!("name {text:?}"),
            Item::Comment(text) => format!("({text:?}"),
            Item::Statement { kind, text } => {
                let bare: Vec<u8> = text.iter().copied().filter(|byte| !matches!(byte, b' ' | b'\t' | 0)).collect();
                format!("{kind:?} {bare:?}")
            }
        };
        if let Some(piece) = pieces.last_mut() {
            piece.push(said);
        }
    }
    pieces.iter_mut().for_each(|piece| piece.sort());
    pieces
}
