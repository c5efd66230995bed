//! Windows onto the texts of programs: what was read is kept a while, so that short subprograms are not asked for anew.

use std::collections::BTreeMap;

use base::SourceId;
use syntax::Cursor;
use tape::{Codes, Format};

/// How many bytes of a text are asked for at a time. The first window of a source decides whether it is text or the
/// image of a punched tape, and in which code: [`tape::recognise`].
pub const WINDOW: usize = 64 * 1024;
/// How many windows are kept.
const WINDOWS: usize = 4;

#[derive(Clone)]
struct Window {
    source: SourceId,
    start: u64,
    bytes: Vec<u8>,
    /// The rows of a tape as they are punched; nothing of a text.
    rows: Vec<u8>,
    last: bool,
    used: u64,
}

/// The windows.
#[derive(Clone)]
pub(crate) struct Supply {
    windows: Vec<Window>,
    formats: BTreeMap<SourceId, Format>,
    current: usize,
    clock: u64,
}

/// The characters of a text from an offset on.
pub(crate) struct View<'a> {
    pub characters: &'a [u8],
    /// The same as the rows of a tape; nothing of a text.
    pub rows: &'a [u8],
    /// The text ends with them.
    pub last: bool,
}

impl Supply {
    pub fn new() -> Supply {
        Supply { windows: Vec::with_capacity(WINDOWS), formats: BTreeMap::new(), current: 0, clock: 0 }
    }

    /// Forgets every window; texts may have changed.
    pub fn clear(&mut self) {
        self.windows.clear();
        self.formats.clear();
    }

    /// How a source is read, once its beginning has been seen.
    pub fn format(&self, source: SourceId) -> Option<Format> {
        self.formats.get(&source).copied()
    }

    /// The bytes to ask for where there is nothing at hand from `offset` on: a source's first window is its beginning.
    pub fn wanted(&self, source: SourceId, offset: u64) -> u64 {
        if self.formats.contains_key(&source) { offset } else { 0 }
    }

    /// Where reading really begins: the head of a tape is behind its label.
    pub fn begin(&self, source: SourceId, cursor: Cursor) -> Cursor {
        if cursor.offset > 0 {
            return cursor;
        }
        let head = self.format(source).unwrap_or_default().head();
        Cursor { offset: head, line_start: head, ..cursor }
    }

    /// What is at hand from `offset` on; no characters if nothing is.
    pub fn view(&mut self, source: SourceId, offset: u64) -> View<'_> {
        let holds = |window: &Window| {
            window.source == source && offset >= window.start && {
                let end = window.start + window.bytes.len() as u64;
                offset < end || (offset == end && window.last)
            }
        };
        if !self.windows.get(self.current).is_some_and(holds) {
            match self.windows.iter().position(holds) {
                Some(found) => {
                    self.current = found;
                    self.clock += 1;
                    self.windows[found].used = self.clock;
                }
                None => return View { characters: &[], rows: &[], last: false },
            }
        }
        let window = &self.windows[self.current];
        let from = (offset - window.start) as usize;
        View { characters: &window.bytes[from..], rows: window.rows.get(from..).unwrap_or_default(), last: window.last }
    }

    /// Takes the bytes of a source from `offset` on into a window. `codes` are those of the control's tapes, if it
    /// reads any.
    pub fn fill(&mut self, source: SourceId, offset: u64, bytes: &[u8], last: bool, codes: Option<Codes>) {
        self.clock += 1;
        let codes_at_hand = codes.unwrap_or_default();
        if offset == 0 && !self.formats.contains_key(&source) {
            let format = codes.map_or(Format::Text, |codes| tape::recognise(bytes, &codes));
            self.formats.insert(source, format);
        }
        let format = self.format(source).unwrap_or_default();
        // A window that this one continues is read through; otherwise the one that was not used for longest goes.
        let continued = self
            .windows
            .iter()
            .position(|w| w.source == source && offset >= w.start && offset <= w.start + w.bytes.len() as u64);
        let slot = match continued {
            Some(slot) => slot,
            None if self.windows.len() < WINDOWS => {
                let bytes = Vec::with_capacity(WINDOW);
                self.windows.push(Window { source, start: offset, bytes, rows: Vec::new(), last, used: 0 });
                self.windows.len() - 1
            }
            None => self.windows.iter().enumerate().min_by_key(|(_, w)| w.used).map_or(0, |(slot, _)| slot),
        };
        let window = &mut self.windows[slot];
        window.source = source;
        window.start = offset;
        window.last = last;
        window.used = self.clock;
        window.bytes.clear();
        window.bytes.extend_from_slice(bytes);
        window.rows.clear();
        if format != Format::Text {
            window.rows.extend_from_slice(bytes);
        }
        let settled = format.translate(&codes_at_hand, &mut window.bytes, offset, last);
        window.bytes.truncate(settled);
        self.current = slot;
    }
}
