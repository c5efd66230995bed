//! Time by tool and by operation, under both customs of tool changes: T alone changes, or M06 does.

use base::ProgramId;
use dialect::Control;

use super::Split;
use crate::sheet::TOOL_CHANGE;

/// Operations kept apart; what comes after is one.
const MOST_OPERATIONS: usize = 500;

/// What names an operation, the strongest last.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, Default)]
enum Named {
    /// The canned cycle, or that there is none.
    #[default]
    Cycle,
    /// The subprogram that it is.
    Program,
    /// A remark.
    Remark,
}

/// A block, as far as it may begin an operation.
pub struct BlockSeen<'s> {
    pub program: ProgramId,
    pub program_name: &'s str,
    pub line: u64,
    /// The remark above it.
    pub remark: Option<String>,
    /// The row of the canned cycle in force.
    pub cycle: Option<u8>,
}

/// A block with a tool change.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Here {
    pub remark: Option<String>,
    pub program: String,
    pub line: u64,
    pub own: ProgramId,
}

/// A piece of work.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Operation {
    /// The tool in the spindle, 0 before the first.
    pub tool: u32,
    /// What the program calls it, or what it is; empty before anything is known of it.
    pub name: String,
    /// Where it begins first.
    pub program: String,
    pub line: u64,
    /// How often.
    pub times: u64,
    /// Its time.
    pub split: Split,
    named: Named,
    cycle: Option<u8>,
    own: ProgramId,
    /// The program that called its own, if it began there.
    caller: Option<ProgramId>,
    cuts: bool,
}

/// Time by tool and operation under one custom.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Ledger {
    /// Tools in the order of their use.
    pub tools: Vec<(u32, Split)>,
    operations: Vec<Operation>,
    now: Operation,
}

impl Ledger {
    fn add(&mut self, split: Split) {
        self.now.split += split;
        self.now.cuts |= split.cutting > 0.0;
        let tool = self.now.tool;
        match self.tools.last_mut() {
            Some((last, time)) if *last == tool => *time += split,
            _ => {
                // The present tool stands last, so that it is found at once.
                let index = self.tools.iter().position(|(known, _)| *known == tool);
                let (_, mut time) = index.map_or((tool, Split::default()), |index| self.tools.remove(index));
                time += split;
                self.tools.push((tool, time));
            }
        }
    }

    /// Ends the present operation and begins one like `next`; one that is nothing yet becomes it.
    fn begin(&mut self, next: Operation) {
        let is_nothing = self.now.named == Named::Cycle && !self.now.cuts && self.now.tool == next.tool;
        if is_nothing {
            let split = self.now.split;
            self.now = Operation { split, ..next };
        } else {
            let before = std::mem::replace(&mut self.now, next);
            file(&mut self.operations, before);
        }
    }

    fn block(&mut self, seen: &BlockSeen, control: &Control) {
        if self.now.line == 0 {
            // The program's first block.
            seen.program_name.clone_into(&mut self.now.program);
            (self.now.line, self.now.own) = (seen.line, seen.program);
        }
        let now = &self.now;
        let begun = |name: String, named: Named| Operation {
            tool: now.tool,
            name,
            named,
            program: seen.program_name.to_owned(),
            line: seen.line,
            own: seen.program,
            caller: if now.own == seen.program { now.caller } else { Some(now.own) },
            ..Operation::default()
        };
        let unnamed = now.named == Named::Cycle;
        let next = match &seen.remark {
            Some(remark) if now.named < Named::Remark || now.own == seen.program => {
                begun(remark.clone(), Named::Remark)
            }
            _ if now.caller == Some(seen.program) => {
                let operation = begun(work(seen.cycle, control), Named::Cycle);
                Operation { cycle: seen.cycle, caller: None, ..operation }
            }
            _ if unnamed && now.own != seen.program => begun(seen.program_name.to_owned(), Named::Program),
            _ if unnamed && (now.cycle != seen.cycle || now.name.is_empty()) => {
                Operation { cycle: seen.cycle, ..begun(work(seen.cycle, control), Named::Cycle) }
            }
            _ => return,
        };
        self.begin(next);
    }

    /// A tool change.
    fn change(&mut self, tool: u32, here: &Here) {
        let now = &mut self.now;
        if now.tool == tool {
            return;
        }
        if now.named == Named::Remark && !now.cuts {
            // The remark above the tool change names what follows it; what came before is the old tool's.
            let before = Operation { name: String::new(), split: std::mem::take(&mut now.split), ..now.clone() };
            now.tool = tool;
            match self.operations.iter_mut().rfind(|known| known.tool == before.tool) {
                Some(known) => known.split += before.split,
                None => file(&mut self.operations, before),
            }
            return;
        }
        let named = if here.remark.is_some() { Named::Remark } else { Named::Cycle };
        let name = here.remark.clone().unwrap_or_default();
        let next = Operation { tool, name, named, program: here.program.clone(), ..Operation::default() };
        let next = Operation { line: here.line, own: here.own, caller: now.caller, ..next };
        self.begin(next);
    }

    /// The operations in the order of their first beginning.
    pub fn operations(&self) -> Vec<Operation> {
        let mut all = self.operations.clone();
        file(&mut all, self.now.clone());
        all
    }
}

/// Adds an operation to the list, or to what is on it and the same.
fn file(list: &mut Vec<Operation>, one: Operation) {
    if one.split.total() <= 0.0 {
        return;
    }
    // The end of the program behind the last piece of work belongs to that.
    let is_idle = one.named == Named::Cycle && one.split.cutting + one.split.rapid + one.split.dwell <= 0.0;
    if let (true, Some(last)) = (is_idle, list.last_mut().filter(|last| last.tool == one.tool)) {
        return last.split += one.split;
    }
    let full = list.len() >= MOST_OPERATIONS;
    let same = |known: &&mut Operation| (known.tool, known.own, &known.name) == (one.tool, one.own, &one.name);
    match list.iter_mut().find(same) {
        Some(known) => {
            known.split += one.split;
            known.times += 1;
        }
        None if full => {
            if let Some(last) = list.last_mut() {
                "all further operations".clone_into(&mut last.name);
                last.split += one.split;
                last.times += 1;
            }
        }
        None => list.push(Operation { times: 1, ..one }),
    }
}

/// What is done where nothing names it.
fn work(cycle: Option<u8>, control: &Control) -> String {
    match cycle {
        Some(row) => control.g_name(row),
        None => "moves".to_owned(),
    }
}

/// Both customs, until the program's end shows which it follows.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Ledgers {
    by_t: Ledger,
    by_m06: Ledger,
    called: Option<u32>,
    /// The remark where it was called.
    called_remark: Option<String>,
    here: Here,
    changes: bool,
}

impl Ledgers {
    /// Time passes.
    pub fn add(&mut self, split: Split) {
        self.by_t.add(split);
        self.by_m06.add(split);
    }

    /// A block begins.
    pub fn block(&mut self, seen: &BlockSeen, control: &Control) {
        self.by_t.block(seen, control);
        self.by_m06.block(seen, control);
    }

    /// The block of the tool change that comes now.
    pub fn note(&mut self, here: Here) {
        self.here = here;
    }

    /// A T goes out.
    pub fn call(&mut self, tool: u32) {
        self.by_t.change(tool, &self.here);
        (self.called, self.called_remark) = (Some(tool), self.here.remark.take());
    }

    /// An M code goes out.
    pub fn machine_code(&mut self, code: u32) {
        if code != TOOL_CHANGE {
            return;
        }
        self.changes = true;
        let called = self.called_remark.take();
        self.here.remark = self.here.remark.take().or(called);
        if let Some(tool) = self.called {
            self.by_m06.change(tool, &self.here);
        }
    }

    /// By the custom that the program follows.
    pub fn own(&self) -> &Ledger {
        if self.changes { &self.by_m06 } else { &self.by_t }
    }

    /// The code that changes tools here.
    pub fn custom(&self) -> &'static str {
        if self.changes { "M06" } else { "T" }
    }
}
