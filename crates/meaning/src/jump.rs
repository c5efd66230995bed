//! Where jumps lead: programs by number, blocks by sequence number, found by scanning and remembered a while.
//!
//! A text is not held in memory, so a target is looked for by reading: in the text that calls, in the main program's
//! text, then outside (a barrier). A sequence number is looked for within one program, from the block after the jump to
//! its end, then from its head; the first match wins. What was found is kept, so the block that jumps is read again.

use std::collections::BTreeMap;

use base::{Condition, ProgramId, SourceId};
use syntax::{Block, Cursor, Grammar, Outcome, Value, Word, read_block};

use crate::block::{Flow, Reading};
use crate::program::{CalledBy, Frame, Names};
use crate::supply::Supply;
use crate::user_macro::statement::loop_mark;
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

    fn push(&mut self, head: u64) {
        if let Some(slot) = self.heads.get_mut(self.count) {
            *slot = head;
            self.count += 1;
        }
    }

    fn pop(&mut self) -> Option<u64> {
        self.count = self.count.checked_sub(1)?;
        Some(self.heads[self.count])
    }

    fn heads(&self) -> &[u64] {
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
    fn find(&self, source: SourceId, number: u32) -> Option<Found> {
        self.programs.get(&(source, number)).copied()
    }

    /// From where on a text is still to be read, and whether a block that is not blank lies before.
    fn read_to(&self, source: SourceId) -> (Cursor, bool) {
        self.read_to.get(&source).copied().unwrap_or((Cursor::HEAD, false))
    }

    /// Takes the program of a block in, the first of a number counting, and notes how far the text has been read.
    fn take(&mut self, found: Option<(u32, Found)>, source: SourceId, next: Cursor, passed: bool) {
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

    pub fn top(&self) -> Option<&Frame> {
        self.frames.last()
    }
}

impl Reading<'_> {
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
        let target = Target::Program { number, from: self.words.place.source };
        match self.calls.lookup(&target) {
            None => Err(Refusal::Locate(target)),
            Some(None) => {
                let values = [f64::from(number), 0.0, 0.0];
                Err(self.words.alarm(Condition::ProgramNotFound, b'P').with(values).into())
            }
            Some(Some(found)) => {
                let entry = self.entry(found)?;
                Ok(Flow::Call { found, entry, repeats })
            }
        }
    }

    /// The block with which a called program begins: its first one, or that of Q.
    fn entry(&self, found: Found) -> Result<Cursor, Refusal> {
        let Some(number) = self.words.count(self.control(), b'Q')? else { return Ok(found.cursor) };
        let Found { source, program, cursor, .. } = found;
        let target = Target::Sequence { source, program, head: cursor, from: cursor, number };
        match self.calls.lookup(&target) {
            None => Err(Refusal::Locate(target)),
            Some(None) => {
                let values = [f64::from(number), 0.0, 0.0];
                Err(self.words.alarm(Condition::SequenceNotFound, b'Q').with(values).into())
            }
            Some(Some(entry)) => Ok(entry.cursor),
        }
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
        let target = Target::Sequence { source, program, head, from, number };
        match self.calls.lookup(&target) {
            None => Err(Refusal::Locate(target)),
            Some(None) => {
                let values = [f64::from(number), 0.0, 0.0];
                Err(self.words.alarm(Condition::SequenceNotFound, b'P').with(values).into())
            }
            Some(Some(found)) if levels > 1 => Ok(Flow::Return(Some(found))),
            Some(Some(found)) => Ok(Flow::Jump(found)),
        }
    }
}

/// The program that begins with this block, if one does.
fn program_of(source: SourceId, names: &mut Names, block: &Block) -> Option<(u32, Found)> {
    let first = block.words.first().filter(|word| word.letter == b'O')?;
    let Value::Number(number) = first.value else { return None };
    let number = number.integer().and_then(|number| u32::try_from(number).ok())?;
    Some((number, Found { source, program: names.numbered(number), cursor: block.start, enters: false }))
}

/// Where a search is.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stage {
    /// In this source, from the cursor on.
    Scan(SourceId),
    /// The program is asked for.
    Asked,
    /// In the source that was brought; if the number does not stand in it, its head is the program.
    Brought(SourceId),
}

/// A search in progress.
pub(crate) struct Search {
    target: Target,
    main: SourceId,
    stage: Stage,
    cursor: Cursor,
    /// A block that is not blank has been passed since the search's start.
    passed: bool,
    /// A sequence search that has gone on from the program's head.
    from_head: bool,
    /// Loops being turned where the search began.
    around: LoopsAround,
    /// Loops that the scan has come into.
    passed_loops: LoopsAround,
}

/// What a search needs or has come to.
pub(crate) enum Progress {
    NeedBytes { source: SourceId, offset: u64 },
    NeedProgram { number: u32 },
    Done(Option<Found>),
}

impl Search {
    /// Begins a search; `main` is the main program's source, `around` the loops being turned.
    pub fn new(target: Target, main: SourceId, index: &ProgramIndex, around: LoopsAround) -> Search {
        let (stage, (cursor, passed)) = match target {
            Target::Program { from, .. } => (Stage::Scan(from), index.read_to(from)),
            Target::Sequence { source, from, .. } | Target::LoopEnd { source, from, .. } => {
                (Stage::Scan(source), (from, false))
            }
        };
        let passed_loops = LoopsAround::default();
        Search { target, main, stage, cursor, passed, from_head: false, around, passed_loops }
    }

    pub fn target(&self) -> Target {
        self.target
    }

    /// The program was brought, or there is none.
    pub fn brought(&mut self, source: Option<SourceId>) -> bool {
        match source {
            Some(source) => {
                self.stage = Stage::Brought(source);
                (self.cursor, self.passed) = (Cursor::HEAD, false);
                true
            }
            None => false,
        }
    }

    /// Goes on as far as the text at hand allows.
    pub fn advance(
        &mut self,
        supply: &mut Supply,
        grammar: &Grammar,
        names: &mut Names,
        block: &mut Block,
        index: &mut ProgramIndex,
    ) -> Progress {
        loop {
            let source = match (self.stage, self.target) {
                (Stage::Asked, Target::Program { number, .. }) => return Progress::NeedProgram { number },
                (Stage::Asked, _) => return Progress::Done(None),
                (Stage::Scan(source) | Stage::Brought(source), _) => source,
            };
            self.cursor = supply.begin(source, self.cursor);
            let view = supply.view(source, self.cursor.offset);
            let last = view.last;
            let ended = match read_block(view.characters, last, self.cursor, grammar, block) {
                Outcome::More => return Progress::NeedBytes { source, offset: self.cursor.offset },
                Outcome::End => true,
                Outcome::Block => {
                    let tape_end = block.rewind && self.passed;
                    self.passed |= !block.is_empty() && !block.rewind;
                    if let Target::Program { .. } = self.target {
                        let program = program_of(source, names, block);
                        index.take(program, source, if tape_end { self.cursor } else { block.next }, self.passed);
                    }
                    let from = (block.start.offset - self.cursor.offset) as usize;
                    let text = view.characters.get(from..from + block.len as usize).unwrap_or_default();
                    if let Some(done) = self.loop_ends(source, block, text) {
                        return Progress::Done(done);
                    }
                    if let Some(found) = self.matches(source, names, block) {
                        return Progress::Done(Some(found));
                    }
                    self.pass_loop(block, text);
                    let here = self.cursor;
                    self.cursor = block.next;
                    tape_end || self.section_ends(here, block)
                }
            };
            if ended && let Some(done) = self.end_of_text(source, names, index) {
                return done;
            }
        }
    }

    fn matches(&self, source: SourceId, names: &mut Names, block: &Block) -> Option<Found> {
        let first = block.words.iter().find(|word| word.letter == b'O' || word.letter == b'N')?;
        let number_of = |word: &Word| match word.value {
            Value::Number(number) => number.integer(),
            _ => None,
        };
        match self.target {
            Target::Program { number, .. } => {
                program_of(source, names, block).filter(|(found, _)| *found == number).map(|(_, found)| found)
            }
            Target::Sequence { number, program, .. } => {
                // Behind the O word of the next program a number is that program's; from the head on it is this one's.
                let own = first.letter == b'N' || self.from_head;
                let numbered = block.words.iter().find(|word| word.letter == b'N');
                let is_it = own && numbered.and_then(number_of) == Some(i64::from(number));
                is_it.then_some(Found { source, program, cursor: block.start, enters: self.enters() })
            }
            Target::LoopEnd { .. } => None,
        }
    }

    /// Whether a jump to where the scan stands leads into a loop that is not being turned.
    fn enters(&self) -> bool {
        let turned = |head: &u64| self.from_head && self.around.heads().contains(head);
        !self.passed_loops.heads().iter().all(turned)
    }

    /// Keeps the account of the loops that a sequence search has come into.
    fn pass_loop(&mut self, block: &Block, text: &[u8]) {
        let Some(statement) = block.statement else { return };
        match loop_mark(text, statement.kind, statement.extent) {
            Some((true, _)) => self.passed_loops.push(block.start.offset),
            Some((false, _)) => {
                self.passed_loops.pop();
            }
            None => {}
        }
    }

    /// A search for a loop's end: found, or (the inner `None`) the loops cross.
    fn loop_ends(&mut self, source: SourceId, block: &Block, text: &[u8]) -> Option<Option<Found>> {
        let Target::LoopEnd { number, .. } = self.target else { return None };
        let statement = block.statement?;
        match loop_mark(text, statement.kind, statement.extent)? {
            // Here the account holds the numbers of the loops inside.
            (true, inner) => {
                self.around.push(u64::from(inner));
                None
            }
            (false, ended) => match self.around.pop() {
                Some(inner) if inner == u64::from(ended) => None,
                None if ended == u32::from(number) => {
                    Some(Some(Found { source, program: ProgramId::default(), cursor: block.next, enters: false }))
                }
                _ => Some(None),
            },
        }
    }

    /// True if a sequence search has left its part of the program.
    fn section_ends(&self, here: Cursor, block: &Block) -> bool {
        let next_program = block.words.first().is_some_and(|word| word.letter == b'O');
        let Target::Sequence { head, from, .. } = self.target else {
            return next_program && matches!(self.target, Target::LoopEnd { .. });
        };
        if self.from_head {
            return here.offset >= from.offset;
        }
        next_program && block.start.offset > head.offset.max(from.offset.saturating_sub(1))
    }

    /// The scan has come to an end without a match: what next.
    fn end_of_text(&mut self, source: SourceId, names: &mut Names, index: &ProgramIndex) -> Option<Progress> {
        match (self.target, self.stage) {
            (Target::Sequence { head, .. }, _) => {
                if self.from_head {
                    return Some(Progress::Done(None));
                }
                self.from_head = true;
                self.cursor = head;
                self.passed = false;
                self.passed_loops = LoopsAround::default();
            }
            (Target::LoopEnd { .. }, _) => return Some(Progress::Done(None)),
            (Target::Program { number, .. }, Stage::Scan(scanned)) if scanned != self.main => {
                if let Some(found) = index.find(self.main, number) {
                    return Some(Progress::Done(Some(found)));
                }
                self.stage = Stage::Scan(self.main);
                (self.cursor, self.passed) = index.read_to(self.main);
            }
            (Target::Program { .. }, Stage::Scan(_)) => self.stage = Stage::Asked,
            (Target::Program { number, .. }, Stage::Brought(_)) => {
                let program = names.numbered(number);
                let cursor = Cursor::HEAD;
                return Some(Progress::Done(Some(Found { source, program, cursor, enters: false })));
            }
            (Target::Program { .. }, Stage::Asked) => return Some(Progress::Done(None)),
        }
        None
    }
}
