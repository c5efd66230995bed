//! What programs a text holds, as the control's memory would list them when it is loaded.

use base::SourceId;
use meaning::WINDOW;
use syntax::{Block, Cursor, Grammar, Outcome, Value, read_block};
use tape::{Reader, Text};

use crate::library::{Library, LibraryError};

/// The numbers of the programs in a text and where each begins, in their order; the first of a number counts.
///
/// # Errors
/// The text cannot be read.
pub fn programs_in(
    library: &mut impl Library,
    source: SourceId,
    grammar: &Grammar,
) -> Result<Vec<(u32, Cursor)>, LibraryError> {
    let mut programs: Vec<(u32, Cursor)> = Vec::new();
    let (mut block, mut bytes, mut begun) = (Block::default(), Vec::new(), false);
    let (mut cursor, mut start, mut last, mut settled) = (Cursor::HEAD, 0u64, false, 0usize);
    loop {
        let window = &bytes[((cursor.offset - start) as usize).min(settled)..settled];
        match read_block(window, last, cursor, grammar, &mut block) {
            Outcome::Block => {}
            Outcome::End => return Ok(programs),
            Outcome::More => {
                start = cursor.offset;
                last = library.read(source, start, WINDOW, &mut bytes)? || bytes.is_empty();
                settled = Text.translate(&mut bytes, start, last);
                continue;
            }
        }
        if block.rewind && begun {
            return Ok(programs);
        }
        begun |= !block.is_empty();
        let first = block.words.first().filter(|word| word.letter == b'O').map(|word| word.value);
        if let Some(Value::Number(number)) = first
            && let Some(number) = number.integer().and_then(|number| u32::try_from(number).ok())
            && !programs.iter().any(|(known, _)| *known == number)
        {
            programs.push((number, block.start));
        }
        cursor = block.next;
    }
}
