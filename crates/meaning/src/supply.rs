//! Windows onto the texts of programs: what was read is kept a while, so that short subprograms are not asked for anew.

use base::SourceId;
use tape::Reader;

/// How many bytes of a text are asked for at a time. Texts are read as [`tape::Text`]; a punched tape's reader takes
/// its place here, one for each source.
pub const WINDOW: usize = 64 * 1024;
/// How many windows are kept.
const WINDOWS: usize = 4;

struct Window {
    source: SourceId,
    start: u64,
    bytes: Vec<u8>,
    last: bool,
    used: u64,
}

/// The windows.
pub(crate) struct Supply {
    windows: Vec<Window>,
    current: usize,
    clock: u64,
}

/// The characters of a text from an offset on.
pub(crate) struct View<'a> {
    pub characters: &'a [u8],
    /// The text ends with them.
    pub last: bool,
}

impl Supply {
    pub fn new() -> Supply {
        Supply { windows: Vec::with_capacity(WINDOWS), current: 0, clock: 0 }
    }

    /// Forgets every window; texts may have changed.
    pub fn clear(&mut self) {
        self.windows.clear();
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
                None => return View { characters: &[], last: false },
            }
        }
        let window = &self.windows[self.current];
        View { characters: &window.bytes[(offset - window.start) as usize..], last: window.last }
    }

    /// Takes the bytes of a source from `offset` on into a window.
    pub fn fill(&mut self, source: SourceId, offset: u64, bytes: &[u8], last: bool) {
        self.clock += 1;
        // A window that this one continues is read through; otherwise the one that was not used for longest goes.
        let continued = self
            .windows
            .iter()
            .position(|w| w.source == source && offset >= w.start && offset <= w.start + w.bytes.len() as u64);
        let slot = match continued {
            Some(slot) => slot,
            None if self.windows.len() < WINDOWS => {
                let bytes = Vec::with_capacity(WINDOW);
                self.windows.push(Window { source, start: offset, bytes, last, used: 0 });
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
        let settled = tape::Text.translate(&mut window.bytes, offset, last);
        window.bytes.truncate(settled);
        self.current = slot;
    }
}
