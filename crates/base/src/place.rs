//! Places in a program: every operation, event and alarm carries one.

/// A text that programs are read from: a file, standard input, a program in memory.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, PartialOrd, Ord)]
pub struct SourceId(pub u32);

/// A program by its name, interned by the interpreter.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub struct ProgramId(pub u32);

/// A run of bytes in a source; files beyond 4 GiB exist, single words and blocks of that size do not.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Span {
    /// Byte offset of the first byte in its source.
    pub start: u64,
    /// Length in bytes.
    pub len: u32,
}

impl Span {
    /// The byte offset just after the last byte.
    pub const fn end(self) -> u64 {
        self.start + self.len as u64
    }

    /// The smallest span that holds both.
    pub fn to(self, other: Span) -> Span {
        let start = self.start.min(other.start);
        let end = self.end().max(other.end());
        Span { start, len: u32::try_from(end - start).unwrap_or(u32::MAX) }
    }
}

/// Where a block stands: its program, its line, and where in the text it begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Place {
    /// The program the block belongs to.
    pub program: ProgramId,
    /// The text it was read from.
    pub source: SourceId,
    /// 1-based line in that text.
    pub line: u64,
    /// Byte offset at which that line begins.
    pub line_start: u64,
    /// The block's own bytes, without its end-of-block.
    pub block: Span,
    /// The block's sequence number N, 0 if it has none.
    pub sequence: u32,
}

impl Place {
    /// 1-based column of a span on this block's line, counted in bytes as a tape counts characters.
    pub const fn column(&self, span: Span) -> u64 {
        span.start.saturating_sub(self.line_start) + 1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_join_and_columns_count_from_one() {
        let a = Span { start: 10, len: 3 };
        let b = Span { start: 20, len: 2 };
        assert_eq!(a.to(b), Span { start: 10, len: 12 });
        assert_eq!(b.to(a), a.to(b));
        let place = Place { line_start: 10, ..Place::default() };
        assert_eq!(place.column(b), 11);
    }
}
