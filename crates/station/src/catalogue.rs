//! What programs a text holds, as the control's memory would list them when it is loaded.

use base::SourceId;
use meaning::WINDOW;
use syntax::{Block, Cursor, Grammar, Outcome, read_block};
use tape::{Codes, Format, recognise};

use crate::library::{Library, LibraryError};

/// Reads a text block by block, as it stands, whatever jumps it holds. `see` gets each block with its own characters
/// and says whether to go on. `codes` are those of the control's tapes, if it reads any.
///
/// # Errors
/// The text cannot be read.
pub fn blocks_of(
    library: &mut impl Library,
    source: SourceId,
    grammar: &Grammar,
    codes: Option<Codes>,
    mut see: impl FnMut(&Block, &[u8]) -> bool,
) -> Result<(), LibraryError> {
    let (mut block, mut bytes) = (Block::default(), Vec::new());
    let (mut cursor, mut start, mut last, mut settled) = (Cursor::HEAD, 0u64, false, 0usize);
    let mut format = None;
    let codes_at_hand = codes.unwrap_or_default();
    loop {
        let window = &bytes[((cursor.offset - start) as usize).min(settled)..settled];
        match read_block(window, last, cursor, grammar, &mut block) {
            Outcome::Block => {}
            Outcome::End => return Ok(()),
            Outcome::More => {
                start = cursor.offset;
                last = read_window(library, source, start, &mut bytes)?;
                let format = *format.get_or_insert_with(|| {
                    let format = codes.map_or(Format::Text, |codes| recognise(&bytes, &codes));
                    // A tape begins behind its label.
                    cursor = Cursor { offset: format.head(), line_start: format.head(), ..cursor };
                    format
                });
                settled = format.translate(&codes_at_hand, &mut bytes, start, last);
                continue;
            }
        }
        let from = (block.start.offset - start) as usize;
        let own = bytes.get(from..from.saturating_add(block.len as usize)).unwrap_or_default();
        if !see(&block, own) {
            return Ok(());
        }
        cursor = block.next;
    }
}

/// The numbers of the programs in a text and where each begins, in their order; the first of a number counts. `codes`
/// are those of the control's tapes, if it reads any.
///
/// # Errors
/// The text cannot be read.
pub fn programs_in(
    library: &mut impl Library,
    source: SourceId,
    grammar: &Grammar,
    codes: Option<Codes>,
) -> Result<Vec<(u32, Cursor)>, LibraryError> {
    let mut programs: Vec<(u32, Cursor)> = Vec::new();
    let mut begun = false;
    blocks_of(library, source, grammar, codes, |block, _| {
        if block.rewind && begun {
            return false;
        }
        begun |= !block.is_empty();
        let named = block.whole_number(b'O').filter(|_| block.begins_program(grammar));
        if let Some(number) = named.and_then(|number| u32::try_from(number).ok())
            && !programs.iter().any(|(known, _)| *known == number)
        {
            programs.push((number, block.start));
        }
        true
    })?;
    Ok(programs)
}

/// Reads a whole window, however few bytes the library gives at a time; true if the text ends with it.
fn read_window(
    library: &mut impl Library,
    source: SourceId,
    start: u64,
    bytes: &mut Vec<u8>,
) -> Result<bool, LibraryError> {
    bytes.clear();
    let mut part = Vec::new();
    while bytes.len() < WINDOW {
        let offset = start + bytes.len() as u64;
        let last = library.read(source, offset, WINDOW - bytes.len(), &mut part)? || part.is_empty();
        bytes.extend_from_slice(&part);
        if last {
            return Ok(true);
        }
    }
    Ok(false)
}
