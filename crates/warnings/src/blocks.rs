//! The blocks of a text one after the other, as they stand there: for what a run does not show.

use base::SourceId;
use meaning::WINDOW;
use station::{Library, LibraryError};
use syntax::{Block, Cursor, Grammar, Outcome, read_block};
use tape::{Codes, Format, recognise};

/// A text on its way through the reader.
pub(crate) struct Blocks<'l, L> {
    library: &'l mut L,
    source: SourceId,
    grammar: &'l Grammar,
    codes: Option<Codes>,
    /// Text or tape: known once the head has been read.
    format: Option<Format>,
    cursor: Cursor,
    bytes: Vec<u8>,
    part: Vec<u8>,
    start: u64,
    settled: usize,
    last: bool,
    pub block: Block,
}

impl<'l, L: Library> Blocks<'l, L> {
    /// The blocks of a text from its head. `codes` are those of the control's tapes, if it reads any.
    pub fn new(library: &'l mut L, source: SourceId, grammar: &'l Grammar, codes: Option<Codes>) -> Blocks<'l, L> {
        Blocks {
            library,
            source,
            grammar,
            codes,
            format: None,
            cursor: Cursor::HEAD,
            bytes: Vec::new(),
            part: Vec::new(),
            start: 0,
            settled: 0,
            last: false,
            block: Block::default(),
        }
    }

    /// Goes on from another place.
    ///
    /// # Errors
    /// The text cannot be read.
    pub fn go_to(&mut self, cursor: Cursor) -> Result<(), LibraryError> {
        self.read_window()?;
        self.cursor = cursor;
        self.read_window()
    }

    /// Reads the next block into `block`; false at the text's end.
    ///
    /// # Errors
    /// The text cannot be read.
    pub fn next(&mut self) -> Result<bool, LibraryError> {
        loop {
            let from = usize::try_from(self.cursor.offset - self.start).unwrap_or(usize::MAX).min(self.settled);
            let window = self.bytes.get(from..self.settled).unwrap_or_default();
            match read_block(window, self.last, self.cursor, self.grammar, &mut self.block) {
                Outcome::Block => {
                    self.cursor = self.block.next;
                    return Ok(true);
                }
                Outcome::End => return Ok(false),
                Outcome::More => self.read_window()?,
            }
        }
    }

    /// The characters of a run inside the block read last.
    pub fn text(&self, extent: syntax::Extent) -> &[u8] {
        let from = (self.block.start.offset - self.start) as usize + usize::from(extent.at);
        self.bytes.get(from..from + usize::from(extent.len)).unwrap_or_default()
    }

    /// Reads a whole window, however few bytes the library gives at a time.
    fn read_window(&mut self) -> Result<(), LibraryError> {
        self.start = self.cursor.offset;
        self.bytes.clear();
        self.last = false;
        while self.bytes.len() < WINDOW && !self.last {
            let offset = self.start + self.bytes.len() as u64;
            let wanted = WINDOW - self.bytes.len();
            self.last = self.library.read(self.source, offset, wanted, &mut self.part)? || self.part.is_empty();
            self.bytes.extend_from_slice(&self.part);
        }
        let format = match self.format {
            Some(format) => format,
            None => {
                let format = self.codes.map_or(Format::Text, |codes| recognise(&self.bytes, &codes));
                // A tape begins behind its label.
                self.cursor = Cursor { offset: format.head(), line_start: format.head(), ..self.cursor };
                format
            }
        };
        self.format = Some(format);
        self.settled = format.translate(&self.codes.unwrap_or_default(), &mut self.bytes, self.start, self.last);
        Ok(())
    }
}
