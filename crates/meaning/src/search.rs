//! A search for a jump's target: read block by block through the texts, as far as they are at hand.

use base::{ProgramId, SourceId};
use syntax::{Block, Cursor, Grammar, Grouping, Outcome, read_block};

use crate::block::cut_by_block_delete;
use crate::jump::{Found, LoopsAround, ProgramIndex, Target};
use crate::program::{Names, ProgramKey};
use crate::supply::Supply;
use crate::user_macro::statement::loop_mark;

/// The program that begins with this block, if one does.
fn program_of(source: SourceId, names: &mut Names, grammar: &Grammar, block: &Block) -> Option<(u32, Found)> {
    let number = block.whole_number(b'O').filter(|_| block.begins_program(grammar))?;
    let number = u32::try_from(number).ok()?;
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
#[derive(Clone)]
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
    NeedProgram { program: ProgramKey },
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
        block_delete: u16,
    ) -> Progress {
        if grammar.grouping == Grouping::Files && matches!(self.target, Target::Program { .. }) {
            // No text holds another program.
            self.stage = Stage::Asked;
        }
        loop {
            let source = match (self.stage, self.target) {
                (Stage::Asked, Target::Program { program, .. }) => return Progress::NeedProgram { program },
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
                    // A loop begins and ends where its statements are obeyed.
                    let (_, cut) = cut_by_block_delete(block, block_delete);
                    block.statement = block.statement.filter(|statement| statement.extent.at < cut);
                    let tape_end = block.rewind && self.passed;
                    self.passed |= !block.is_empty() && !block.rewind;
                    if let Target::Program { .. } = self.target {
                        let program = program_of(source, names, grammar, block);
                        index.take(program, source, if tape_end { self.cursor } else { block.next }, self.passed);
                    }
                    let from = (block.start.offset - self.cursor.offset) as usize;
                    let text = view.characters.get(from..from + block.len as usize).unwrap_or_default();
                    if let Some(done) = self.loop_ends(source, block, text) {
                        return Progress::Done(done);
                    }
                    if let Some(found) = self.matches(source, names, grammar, block) {
                        return Progress::Done(Some(found));
                    }
                    self.pass_loop(block, text);
                    let here = self.cursor;
                    self.cursor = block.next;
                    tape_end || self.section_ends(here, grammar, block)
                }
            };
            if ended && let Some(done) = self.end_of_text(source, names, index) {
                return done;
            }
        }
    }

    fn matches(&self, source: SourceId, names: &mut Names, grammar: &Grammar, block: &Block) -> Option<Found> {
        match self.target {
            Target::Program { program, .. } => program_of(source, names, grammar, block)
                .filter(|(found, _)| ProgramKey::Number(*found) == program)
                .map(|(_, found)| found),
            Target::Sequence { number, program, .. } => {
                // Behind the O word of the next program a number is that program's; from the head on it is this one's.
                let own = self.from_head || !block.begins_program(grammar);
                let is_it = own && block.whole_number(b'N') == Some(i64::from(number));
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
    fn section_ends(&self, here: Cursor, grammar: &Grammar, block: &Block) -> bool {
        let next_program = block.begins_program(grammar);
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
            (Target::Program { program, .. }, Stage::Scan(scanned)) if scanned != self.main => {
                if let Some(found) = index.find(self.main, program) {
                    return Some(Progress::Done(Some(found)));
                }
                self.stage = Stage::Scan(self.main);
                (self.cursor, self.passed) = index.read_to(self.main);
            }
            (Target::Program { .. }, Stage::Scan(_)) => self.stage = Stage::Asked,
            (Target::Program { program, .. }, Stage::Brought(_)) => {
                let program = match program {
                    ProgramKey::Number(number) => names.numbered(number),
                    ProgramKey::File { name, .. } => name,
                };
                let cursor = Cursor::HEAD;
                return Some(Progress::Done(Some(Found { source, program, cursor, enters: false })));
            }
            (Target::Program { .. }, Stage::Asked) => return Some(Progress::Done(None)),
        }
        None
    }
}
