//! Where jumps lead: programs by number, blocks by sequence number, found by scanning and remembered a while.
//!
//! A text is not held in memory, so a target is looked for by reading: in the text that calls, in the main program's
//! text, then outside (a barrier). A sequence number is looked for within one program, from the block after the jump to
//! its end, then from its head; the first match wins. What was found is kept, so the block that jumps is read again.

use std::collections::BTreeMap;

use base::{Condition, ProgramId, SourceId};
use syntax::{Cursor, Word};

use crate::block::{Flow, Reading};
use crate::program::{CalledBy, Frame};
use crate::word::Refusal;

/// What a jump looks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Target {
    /// A program, called from a source.
    Program { number: u32, from: SourceId },
    /// A block of the program that begins at `head`, looked for from `from` on.
    Sequence { source: SourceId, program: ProgramId, head: Cursor, from: Cursor, number: u32 },
    /// The block after the end of the loop of this number whose first block is at `from`.
    LoopEnd { source: SourceId, from: Cursor, number: u8 },
}

impl Target {
    /// What is missing where it is nowhere, and the number that was looked for.
    pub fn missing(&self) -> (Condition, [f64; 3]) {
        let (condition, number) = match *self {
            Target::Program { number, .. } => (Condition::ProgramNotFound, number),
            Target::Sequence { number, .. } => (Condition::SequenceNotFound, number),
            Target::LoopEnd { number, .. } => (Condition::MacroLoopPair, u32::from(number)),
        };
        (condition, [f64::from(number), 0.0, 0.0])
    }
}

/// Where a target is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Found {
    pub source: SourceId,
    pub program: ProgramId,
    pub cursor: Cursor,
    /// A jump there from where it was looked for leads into a loop.
    pub enters: bool,
}

/// A loop that is being turned.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct OpenLoop {
    /// Programs on the levels of calls when it was begun.
    pub depth: usize,
    pub number: u8,
    /// Its first block.
    pub head: Cursor,
    /// The block after its last one.
    pub after: Cursor,
}

/// Loops inside one another that a scan follows; a control has fewer.
const MOST_LOOPS: usize = 10;

/// The first blocks of the loops that are being turned where a search begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct LoopsAround {
    heads: [u64; MOST_LOOPS],
    count: usize,
}

impl LoopsAround {
    /// Those of the program on this level.
    pub fn of(loops: &[OpenLoop], depth: usize) -> LoopsAround {
        let mut around = LoopsAround::default();
        for open in loops.iter().filter(|open| open.depth == depth) {
            around.push(open.head.offset);
        }
        around
    }

    pub fn push(&mut self, head: u64) {
        if let Some(slot) = self.heads.get_mut(self.count) {
            *slot = head;
            self.count += 1;
        }
    }

    pub fn pop(&mut self) -> Option<u64> {
        self.count = self.count.checked_sub(1)?;
        Some(self.heads[self.count])
    }

    pub fn heads(&self) -> &[u64] {
        &self.heads[..self.count.min(MOST_LOOPS)]
    }
}

/// Targets remembered, the oldest forgotten first.
const REMEMBERED: usize = 64;
/// Programs whose places are remembered; a text with more is searched from there on each time.
const INDEXED: usize = 65_536;

/// The levels of calls, and what is known of jumps.
pub(crate) struct Calls {
    pub frames: Vec<Frame>,
    pub levels: usize,
    /// Loops being turned, the innermost last.
    pub loops: Vec<OpenLoop>,
    known: Vec<(Target, Option<Found>)>,
    oldest: usize,
    pub index: ProgramIndex,
}

/// Where the programs of texts begin, as far as the texts have been read for them.
#[derive(Default)]
pub(crate) struct ProgramIndex {
    programs: BTreeMap<(SourceId, u32), Found>,
    read_to: BTreeMap<SourceId, (Cursor, bool)>,
}

impl ProgramIndex {
    pub fn find(&self, source: SourceId, number: u32) -> Option<Found> {
        self.programs.get(&(source, number)).copied()
    }

    /// From where on a text is still to be read, and whether a block that is not blank lies before.
    pub fn read_to(&self, source: SourceId) -> (Cursor, bool) {
        self.read_to.get(&source).copied().unwrap_or((Cursor::HEAD, false))
    }

    /// Takes the program of a block in, the first of a number counting, and notes how far the text has been read.
    pub fn take(&mut self, found: Option<(u32, Found)>, source: SourceId, next: Cursor, passed: bool) {
        if self.programs.len() < INDEXED {
            if let Some((number, found)) = found {
                self.programs.entry((source, number)).or_insert(found);
            }
            let read_to = self.read_to.entry(source).or_default();
            if next.offset > read_to.0.offset {
                *read_to = (next, passed);
            }
        }
    }
}

impl Calls {
    pub fn new(levels: usize) -> Calls {
        Calls {
            frames: Vec::with_capacity(levels * 2 + 1),
            levels,
            loops: Vec::with_capacity(MOST_LOOPS),
            known: Vec::with_capacity(REMEMBERED),
            oldest: 0,
            index: ProgramIndex::default(),
        }
    }

    /// The answer to a target, if it has been looked for; the inner `None` is "nowhere".
    pub fn lookup(&self, target: &Target) -> Option<Option<Found>> {
        if let Target::Program { number, from } = *target
            && let Some(found) = self.index.find(from, number)
        {
            return Some(Some(found));
        }
        self.known.iter().find(|(known, _)| known == target).map(|&(_, found)| found)
    }

    pub fn remember(&mut self, target: Target, found: Option<Found>) {
        if let (Target::Program { number, from }, Some(found)) = (target, found)
            && self.index.programs.len() < INDEXED
        {
            self.index.programs.insert((from, number), found);
            return;
        }
        if self.known.len() < REMEMBERED {
            self.known.push((target, found));
        } else {
            self.known[self.oldest] = (target, found);
            self.oldest = (self.oldest + 1) % REMEMBERED;
        }
    }

    pub fn forget(&mut self) {
        self.known.clear();
        self.oldest = 0;
        self.index = ProgramIndex::default();
    }

    /// Levels of subprograms that are open.
    pub fn subprogram_level(&self) -> usize {
        self.frames.iter().filter(|frame| frame.called_by == CalledBy::Subprogram).count()
    }

    /// Levels of macro calls that are open.
    pub fn macro_level(&self) -> usize {
        self.top().map_or(0, |frame| usize::from(frame.level))
    }

    /// Closes the loops on this level of calls and above that a jump to the block at `at` has left.
    pub fn leave_loops(&mut self, depth: usize, at: u64) {
        self.loops.retain(|open| open.depth < depth || (open.head.offset <= at && at < open.after.offset));
    }

    pub fn top(&self) -> Option<&Frame> {
        self.frames.last()
    }
}

impl Reading<'_> {
    /// Where a target is that the word of a letter names.
    pub fn locate(&self, target: Target, letter: u8) -> Result<Found, Refusal> {
        match self.calls.lookup(&target) {
            None => Err(Refusal::Locate(target)),
            Some(None) => {
                let (condition, values) = target.missing();
                Err(self.words.alarm(condition, letter).with(values).into())
            }
            Some(Some(found)) => Ok(found),
        }
    }

    /// M98: the program P, L times.
    pub fn call(&mut self, word: &Word) -> Result<Flow, Refusal> {
        let control = self.control();
        let Some(number) = self.words.count(control, b'P')?.filter(|&number| number > 0) else {
            return Err(self.words.alarm_at(Condition::CallTargetMissing, word).into());
        };
        let repeats = self.repeats()?;
        if self.calls.subprogram_level() >= self.calls.levels {
            let levels = self.calls.levels as f64;
            return Err(self.words.alarm_at(Condition::NestingTooDeep, word).with([levels, 0.0, 0.0]).into());
        }
        let found = self.locate(Target::Program { number, from: self.words.place.source }, b'P')?;
        Ok(Flow::Call { found, entry: self.entry(found)?, repeats })
    }

    /// The block with which a called program begins: its first one, or that of Q.
    fn entry(&self, found: Found) -> Result<Cursor, Refusal> {
        let Some(number) = self.words.count(self.control(), b'Q')? else { return Ok(found.cursor) };
        let Found { source, program, cursor, .. } = found;
        let entry = self.locate(Target::Sequence { source, program, head: cursor, from: cursor, number }, b'Q')?;
        Ok(entry.cursor)
    }

    /// M99: back to the caller, after the call or at its block P; in the main program to its head or its block P.
    pub fn subprogram_end(&mut self) -> Result<Flow, Refusal> {
        let control = self.control();
        let levels = self.calls.frames.len();
        let number = self.words.count(control, b'P')?;
        let goal = self.calls.frames.get(levels.saturating_sub(2).min(levels.saturating_sub(1)));
        let (Some(number), Some(goal)) = (number, goal) else {
            return Ok(if levels > 1 { Flow::Return(None) } else { Flow::Again });
        };
        let from = if levels > 1 { goal.cursor } else { self.words.block.next };
        let Frame { source, program, head, .. } = *goal;
        let found = self.locate(Target::Sequence { source, program, head, from, number }, b'P')?;
        Ok(if levels > 1 { Flow::Return(Some(found)) } else { Flow::Jump(found) })
    }
}
