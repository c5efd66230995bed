//! Blocks that were compiled, by their place: a loop's statements and words are not read from its text anew.

use std::cell::Cell;
use std::rc::Rc;

use base::SourceId;
use syntax::{Block, Cursor, Extent, Value, Word};

use super::code::{Code, Run};
use super::expression::Compiler;
use super::scanner::Scanner;
use super::statement::{Statement, compile};
use super::trouble::Trouble;
use super::variables::Variables;
use crate::program::CallName;
use dialect::Control;

/// Blocks kept; when there are more all are forgotten and compiled anew.
const MOST_LINES: usize = 16_384;
/// Operations kept.
const MOST_OPS: usize = 1 << 18;
/// Places of the index: twice the lines, a power of two.
const SLOTS: usize = 32_768;
const NOTHING: u32 = u32::MAX;
/// The place of a block that is not to be found again: its block-delete sign decides each time what it holds.
pub(crate) const UNFOUND: u64 = u64::MAX;

/// One kept block.
#[derive(Debug)]
pub(crate) struct Line {
    source: SourceId,
    /// Where reading stood before it.
    at: u64,
    pub start: Cursor,
    pub len: u32,
    pub next: Cursor,
    /// Its N, 0 for none.
    pub sequence: u32,
    words: (u32, u32),
    pub statement: Option<Statement>,
    /// The program that it calls by name, and where the name stands.
    pub called: Cell<CallName>,
    call_name: Option<Extent>,
    /// The same as it was recognised.
    recognised: Option<syntax::Statement>,
    pub extent: Extent,
    /// The first comment behind the statement.
    pub comment: Extent,
    /// Nothing but a statement and perhaps N stands in it.
    pub plain: bool,
    /// Words with variables stand in it.
    pub has_runs: bool,
    /// Where its jump leads or its loop ends, once that has been looked for.
    pub target: Cell<Option<Target>>,
}

/// What a kept statement has found out once for all.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Target {
    pub cursor: Cursor,
    /// The jump leads into a loop.
    pub enters: bool,
}

/// The kept blocks.
#[derive(Clone, Default)]
pub(crate) struct Store {
    pub code: Code,
    /// Shared, so that a line can be carried out while the reader changes, without being copied; behind the first
    /// `count` stand those that were forgotten, for their room.
    lines: Vec<Rc<Line>>,
    count: usize,
    words: Vec<Word>,
    /// The run of every kept word that has one.
    runs: Vec<Option<Run>>,
    index: Vec<u32>,
    last: u32,
}

impl Store {
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    pub fn clear(&mut self) {
        self.code.clear();
        self.count = 0;
        self.words.clear();
        self.runs.clear();
        self.index.fill(NOTHING);
        self.last = 0;
    }

    pub fn line(&self, index: u32) -> Option<&Rc<Line>> {
        self.lines.get(index as usize).filter(|_| (index as usize) < self.count)
    }

    /// Notes what a statement has found out.
    pub fn set_target(&self, index: u32, target: Target) {
        if let Some(line) = self.line(index) {
            line.target.set(Some(target));
        }
    }

    /// Notes the program that a kept block calls by name.
    pub fn set_called(&self, index: u32, called: CallName) {
        if let Some(line) = self.line(index) {
            line.called.set(called);
        }
    }

    /// The kept block that begins where reading stands.
    #[inline]
    pub fn find(&mut self, source: SourceId, at: u64) -> Option<u32> {
        let is_it = |line: &Rc<Line>| line.at == at && line.source == source;
        // Blocks were mostly kept one after the other.
        let following = self.last + 1;
        if (following as usize) < self.count && self.lines.get(following as usize).is_some_and(is_it) {
            self.last = following;
            return Some(following);
        }
        let mut slot = slot_of(source, at);
        while let Some(&index) = self.index.get(slot) {
            let line = self.lines.get(index as usize)?;
            if is_it(line) {
                self.last = index;
                return Some(index);
            }
            slot = (slot + 1) % SLOTS;
        }
        None
    }

    /// Compiles and keeps a block that can be read; `text` is its own text, reading stood at `at` before it.
    pub fn keep(
        &mut self,
        control: &Control,
        variables: &Variables,
        (source, at): (SourceId, u64),
        block: &Block,
        text: &[u8],
    ) -> Result<u32, Trouble> {
        if self.count >= MOST_LINES || self.code.len() >= MOST_OPS {
            self.clear();
        }
        let before = (self.code.len(), self.words.len());
        let kept = self.compile_block(control, variables, block, text);
        let (statement, has_runs) = match kept {
            Ok(kept) => kept,
            Err(trouble) => {
                self.code.truncate(before.0);
                self.words.truncate(before.1);
                self.runs.truncate(before.1);
                return Err(trouble);
            }
        };
        let extent = block.statement.map_or_else(Extent::default, |statement| statement.extent);
        let kept = Line {
            source,
            at,
            start: block.start,
            len: block.len,
            next: block.next,
            sequence: sequence_of(block),
            words: (before.1 as u32, self.words.len() as u32),
            statement,
            called: Cell::new(None),
            call_name: block.call_name,
            recognised: block.statement,
            extent,
            comment: block.comments.iter().copied().find(|comment| comment.at > extent.at).unwrap_or_default(),
            plain: statement.is_some() && block.skips.is_empty() && block.words.iter().all(|word| word.letter == b'N'),
            has_runs,
            target: Cell::new(None),
        };
        match self.lines.get_mut(self.count) {
            Some(room) => match Rc::get_mut(room) {
                Some(forgotten) => *forgotten = kept,
                None => *room = Rc::new(kept),
            },
            None => self.lines.push(Rc::new(kept)),
        }
        self.count += 1;
        let line = (self.count - 1) as u32;
        if at != UNFOUND {
            self.enter(source, at, line);
        }
        self.last = line;
        Ok(line)
    }

    fn compile_block(
        &mut self,
        control: &Control,
        variables: &Variables,
        block: &Block,
        text: &[u8],
    ) -> Result<(Option<Statement>, bool), Trouble> {
        let mut has_runs = false;
        let mut compiler = Compiler::new(control, variables, &mut self.code);
        for word in &block.words {
            let run = match word.value {
                Value::Expression => {
                    has_runs = true;
                    let extent = Extent { at: word.extent.at + 1, len: word.extent.len.saturating_sub(1) };
                    let mut scanner = Scanner::new(text, extent);
                    let run = compiler.expression(&mut scanner)?;
                    if scanner.peek().is_some() {
                        return Err(scanner.unreadable());
                    }
                    Some(run)
                }
                _ => None,
            };
            self.words.push(*word);
            self.runs.push(run);
        }
        let statement = match block.statement {
            Some(statement) => Some(compile(&mut compiler, statement.kind, text, statement.extent)?),
            None => None,
        };
        Ok((statement, has_runs))
    }

    fn enter(&mut self, source: SourceId, at: u64, line: u32) {
        if self.index.is_empty() {
            self.index = vec![NOTHING; SLOTS];
        }
        let mut slot = slot_of(source, at);
        while self.index.get(slot).is_some_and(|&index| index != NOTHING) {
            slot = (slot + 1) % SLOTS;
        }
        if let Some(index) = self.index.get_mut(slot) {
            *index = line;
        }
    }

    /// Writes a kept block into `block`, as reading its text would.
    pub fn load(&self, line: &Line, block: &mut Block) {
        block.start = line.start;
        block.len = line.len;
        block.next = line.next;
        block.rewind = false;
        block.words.clear();
        block.words.extend_from_slice(self.words.get(line.words.0 as usize..line.words.1 as usize).unwrap_or_default());
        block.skips.clear();
        block.comments.clear();
        block.call_name = line.call_name;
        block.statement = line.recognised;
        block.faults.clear();
    }

    /// The run of a kept block's word, if it has one.
    pub fn run_of(&self, line: &Line, word: usize) -> Option<Run> {
        self.runs.get(line.words.0 as usize + word).copied().flatten()
    }
}

/// The N of a block, 0 if it has none.
pub(crate) fn sequence_of(block: &Block) -> u32 {
    block.whole_number(b'N').and_then(|number| u32::try_from(number).ok()).unwrap_or(0)
}

fn slot_of(source: SourceId, at: u64) -> usize {
    let mixed = (at ^ u64::from(source.0) << 40).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> 49) as usize % SLOTS
}
