//! Where jumps lead: programs by number, blocks by sequence number, found by scanning and remembered a while.
//!
//! A text is not held in memory, so a target is looked for by reading: in the text that calls, in the main program's
//! text, then outside (a barrier). A sequence number is looked for within one program, from the block after the jump to
//! its end, then from its head; the first match wins. What was found is kept, so the block that jumps is read again.

use std::collections::BTreeMap;

use base::{Alarm, Condition, ProgramId, SourceId};
use dialect::CallFromLarge;
use syntax::{Cursor, Word};

use crate::block::{Flow, Reading};
use crate::program::{CalledBy, Frame, ProgramKey};
use crate::word::Refusal;

/// What a jump looks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Target {
    /// A program, called from a source.
    Program { program: ProgramKey, from: SourceId },
    /// A block of the program that begins at `head`, looked for from `from` on.
    Sequence { source: SourceId, program: ProgramId, head: Cursor, from: Cursor, number: u32 },
    /// The block after the end of the loop of this number whose first block is at `from`.
    LoopEnd { source: SourceId, from: Cursor, number: u8 },
}

impl Target {
    /// What is missing where it is nowhere, and the number that was looked for.
    pub fn missing(&self) -> (Condition, [f64; 3]) {
        let (condition, number) = match *self {
            Target::Program { program: ProgramKey::Number(number), .. } => (Condition::ProgramNotFound, number),
            Target::Program { .. } => (Condition::FileNotFound, 0),
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
#[derive(Clone)]
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
#[derive(Clone, Default)]
pub(crate) struct ProgramIndex {
    programs: BTreeMap<(SourceId, u32), Found>,
    read_to: BTreeMap<SourceId, (Cursor, bool)>,
}

impl ProgramIndex {
    pub fn find(&self, source: SourceId, program: ProgramKey) -> Option<Found> {
        let ProgramKey::Number(number) = program else { return None };
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
        if let Target::Program { program, from } = *target
            && let Some(found) = self.index.find(from, program)
        {
            return Some(Some(found));
        }
        self.known.iter().find(|(known, _)| known == target).map(|&(_, found)| found)
    }

    pub fn remember(&mut self, target: Target, found: Option<Found>) {
        if let (Target::Program { program: ProgramKey::Number(number), from }, Some(found)) = (target, found)
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

    /// M98: the program P, or the one that is named, L times.
    pub fn call(&mut self, word: &Word) -> Result<Flow, Refusal> {
        let program = self.callee(word)?;
        let repeats = self.repeats()?;
        self.check_level(word)?;
        if repeats == 0 {
            return Ok(Flow::Next);
        }
        let target = Target::Program { program, from: self.words.place.source };
        if let (Some(None), Some(name)) = (self.calls.lookup(&target), self.words.block.call_name) {
            let span = name.span(self.words.block.start.offset);
            return Err(Alarm::new(Condition::FileNotFound, self.words.place, span).into());
        }
        let found = self.locate(target, b'P')?;
        let large = matches!(program, ProgramKey::File { large: true, .. });
        Ok(Flow::Call { found, entry: self.entry(found)?, repeats, large })
    }

    /// The program that M98 calls: the one whose name stands behind it, or P.
    fn callee(&self, word: &Word) -> Result<ProgramKey, Alarm> {
        let control = self.control();
        let missing = || self.words.alarm_at(Condition::CallTargetMissing, word);
        if control.grammar.named_call.is_none() {
            let number = self.words.count(control, b'P')?.filter(|&number| number > 0);
            return number.map(ProgramKey::Number).ok_or_else(missing);
        }
        let (block, taken) = (self.words.block, self.word_count);
        let company = |other: &&Word| !matches!(other.letter, b'N' | b'L') && other.extent != word.extent;
        if let Some(other) = block.words.iter().take(taken).find(company) {
            return Err(self.words.alarm_at(Condition::CallNotAlone, other));
        }
        match (self.called, block.call_name) {
            (Some(Ok(program)), _) => Ok(program),
            (Some(Err(condition)), Some(name)) => {
                Err(Alarm::new(condition, self.words.place, name.span(block.start.offset)))
            }
            _ => Err(missing()),
        }
    }

    /// Refuses a call that is one too deep, or out of a program that calls no others.
    fn check_level(&self, word: &Word) -> Result<(), Alarm> {
        if self.is_in_large() {
            return Err(self.words.alarm_at(Condition::CallFromLarge, word));
        }
        if self.calls.subprogram_level() >= self.calls.levels {
            let levels = self.calls.levels as f64;
            return Err(self.words.alarm_at(Condition::NestingTooDeep, word).with([levels, 0.0, 0.0]));
        }
        Ok(())
    }

    /// True in a program that was called as a large one and calls no others.
    pub fn is_in_large(&self) -> bool {
        let refuses = self.setting.fitting.policies.call_from_large == CallFromLarge::Refuse;
        refuses && self.calls.top().is_some_and(|frame| frame.large)
    }

    /// M97: the part of this program that begins at block P, L times.
    pub fn internal_call(&mut self, word: &Word, code: u32) -> Result<Flow, Refusal> {
        if !self.setting.fitting.options.internal_call {
            let alarm = self.words.alarm_at(Condition::MNotFitted, word);
            return Err(alarm.with([f64::from(code), 0.0, 0.0]).into());
        }
        let Some(number) = self.words.count(self.control(), b'P')?.filter(|&number| number > 0) else {
            return Err(self.words.alarm_at(Condition::CallTargetMissing, word).into());
        };
        let repeats = self.repeats()?;
        self.check_level(word)?;
        let Some(&Frame { source, program, head, .. }) = self.calls.top() else { return Ok(Flow::Next) };
        if repeats == 0 {
            return Ok(Flow::Next);
        }
        let target = Target::Sequence { source, program, head, from: self.words.block.next, number };
        let entry = self.locate(target, b'P')?.cursor;
        let found = Found { source, program, cursor: head, enters: false };
        Ok(Flow::Call { found, entry, repeats, large: false })
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
