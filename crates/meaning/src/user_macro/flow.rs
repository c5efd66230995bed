//! Statements carried out by the reader: variables written, jumps taken, loops turned.

use std::rc::Rc;

use base::{Alarm, AxisSet, Condition, Place};
use dialect::VariableMeaning;
use syntax::{Cursor, Extent};

use super::code::Run;
use super::evaluation::evaluate;
use super::expression::{Reference, unknown, variable_number};
use super::statement::{Destination, Statement};
use super::store::{Line, Target};
use super::system::{Source, Written};
use super::trouble::Trouble;
use crate::command::Command;
use crate::data_setting::DataWrite;
use crate::jump::{Found, LoopsAround, OpenLoop, Target as Goal};
use crate::operation::SetValue;
use crate::program::Frame;
use crate::reader::{After, Note, Read, Reader};
use crate::record::StatementRead;
use crate::search::Search;

/// Statements that may be carried out ahead of a block that is being executed.
pub(crate) const MOST_AHEAD: u32 = 4096;

/// What a statement leads to.
enum Next {
    /// The block behind it.
    Following,
    /// Another place of the same program.
    At(Cursor),
    /// Nothing yet: something must be looked for first.
    Wait,
}

impl Reader {
    /// Where expressions of the block at hand read their variables.
    pub(crate) fn source(&self) -> Source<'_> {
        let frame = self.calls.top();
        Source {
            setting: &self.setting,
            state: &self.state,
            level: frame.map_or(0, |frame| usize::from(frame.level)),
            program: frame.map_or_else(Default::default, |frame| frame.program),
            names: &self.names,
            answers: &self.answers,
        }
    }

    /// Carries a kept statement out. `None` reads on.
    pub(crate) fn take_statement(&mut self, index: u32, command: &mut Command) -> Option<Read> {
        let line = Rc::clone(self.store.line(index)?);
        match self.carry_out(index, &line) {
            Ok(Next::Wait) => None,
            Ok(next) => {
                self.answers.clear();
                if self.setting.record.is_some() {
                    self.record_statement(&line, &next);
                }
                if line.sequence > 0 {
                    self.state.sequence = line.sequence;
                }
                if let Some(top) = self.calls.frames.last_mut() {
                    top.cursor = match next {
                        Next::At(cursor) => cursor,
                        _ => line.next,
                    };
                    if !top.begun {
                        top.first = line.start.offset;
                    }
                    top.begun = true;
                }
                None
            }
            Err(Trouble::Needs(quantity)) => Some(Read::NeedValue(quantity)),
            Err(Trouble::Refused(condition, extent, values)) => {
                self.store.load(&line, &mut self.block);
                let frame = self.frame();
                self.refuse_statement((condition, extent, values), &frame, command)
            }
        }
    }

    /// The program in execution.
    fn frame(&self) -> Frame {
        self.calls.top().copied().unwrap_or_default()
    }

    /// Keeps what a statement did, for whoever explains the program.
    fn record_statement(&mut self, line: &Line, next: &Next) {
        let place = self.place_of(line);
        let wrote = self.notes.back().filter(|note| note.place == place).map(|note| note.value);
        let to = if let Next::At(cursor) = next { cursor } else { &line.next };
        let (state, goes_to) = (*self.state, to.line);
        self.records.statement(StatementRead { place, state, wrote, goes_to });
    }

    /// A statement (or a word with a variable) of the block at hand is refused.
    pub(crate) fn refuse_statement(
        &mut self,
        (condition, extent, values): (Condition, Extent, [f64; 3]),
        frame: &Frame,
        command: &mut Command,
    ) -> Option<Read> {
        let place = self.place_of_block(frame);
        let alarm = Alarm::new(condition, place, extent.span(place.block.start)).with(values);
        let next = self.block.next;
        self.answers.clear();
        // Checking on, whatever variables hold from here on is doubtful.
        let doubtful = self.variables_doubtful && alarm.condition != Condition::MacroStatement;
        self.variables_doubtful = true;
        self.begin(next, command);
        let read = self.refuse(alarm, command);
        if doubtful && self.goes_on { None } else { read }
    }

    fn place_of(&self, line: &Line) -> Place {
        let top = self.calls.top();
        Place {
            program: top.map_or_else(Default::default, |top| top.program),
            source: top.map_or_else(Default::default, |top| top.source),
            line: line.start.line,
            line_start: line.start.line_start,
            block: base::Span { start: line.start.offset, len: line.len },
            sequence: line.sequence,
        }
    }

    fn carry_out(&mut self, index: u32, line: &Line) -> Result<Next, Trouble> {
        if !self.setting.fitting.options.user_macro {
            return Err(Trouble::at(Condition::MacroNotFitted, line.extent));
        }
        let Some(statement) = line.statement else { return Ok(Next::Following) };
        let next = match statement {
            Statement::Assign { condition, target, place, value } => {
                let assigns = match condition {
                    Some(condition) => self.holds(condition)?,
                    None => true,
                };
                if assigns {
                    self.assign(line, target, place, value)?;
                }
                Next::Following
            }
            Statement::Goto { condition, to, place } => match condition {
                Some(condition) if !self.holds(condition)? => Next::Following,
                _ => self.jump(index, line, to, place)?,
            },
            Statement::Loop { condition, number } => self.enter_loop(index, line, condition, number)?,
            Statement::End { number } => self.end_loop(line, number)?,
        };
        if !matches!(next, Next::Wait) {
            self.statements += 1;
            if self.statements > self.loop_limit {
                return Err(self.endless(line));
            }
        }
        Ok(next)
    }

    /// The alarm for a loop without a move: it names the innermost loop's first line and this one.
    fn endless(&self, line: &Line) -> Trouble {
        let here = line.start.line;
        let (first, last) = match self.calls.loops.last() {
            Some(open) => (open.head.line, open.after.line.saturating_sub(1).max(here)),
            None => (line.target.get().map_or(here, |target| target.cursor.line.min(here)), here),
        };
        let values = [self.loop_limit as f64, first as f64, last as f64];
        Trouble::Refused(Condition::EndlessLoop, line.extent, values)
    }

    #[inline]
    fn holds(&self, condition: Run) -> Result<bool, Trouble> {
        Ok(evaluate(&self.store.code, condition, &self.source())? != 0.0)
    }

    fn assign(&mut self, line: &Line, target: Reference, place: Extent, value: Run) -> Result<(), Trouble> {
        let source = self.source();
        let level = source.level;
        let result = evaluate(&self.store.code, value, &source)?;
        let number = match target {
            Reference::Computed(run) => variable_number(evaluate(&self.store.code, run, &source)?, place)?,
            Reference::Local(index) => u32::from(index),
            Reference::Volatile(index) => source.variables().number(0, index),
            Reference::Permanent(index) => source.variables().number(1, index),
            Reference::System(number) => number,
        };
        let variables = &mut self.setting.memory.variables;
        let told = match target {
            Reference::Local(index) => {
                variables.set_local(level, index, result);
                SetValue::Variable { number, value: result }
            }
            Reference::Volatile(index) => {
                variables.set_volatile(index, result);
                SetValue::Variable { number, value: result }
            }
            Reference::Permanent(index) => {
                variables.set_permanent(index, result);
                SetValue::Variable { number, value: result }
            }
            Reference::Computed(_) | Reference::System(_) => self.assign_by_number(line, number, result, place)?,
        };
        if self.tells_variables {
            let place = self.place_of(line);
            self.notes.push_back(Note { before: self.blocks, place, value: told });
        }
        self.ahead += 1;
        Ok(())
    }

    /// Writes any variable; what the trace tells of it.
    fn assign_by_number(&mut self, line: &Line, number: u32, value: f64, place: Extent) -> Result<SetValue, Trouble> {
        let source = self.source();
        let Some(row) = self.setting.control.user_macro.variable(number) else { return Err(unknown(number, place)) };
        if !row.write {
            return Err(Trouble::Refused(Condition::MacroReadOnly, place, [f64::from(number), 0.0, 0.0]));
        }
        let filled = if value.is_nan() { 0.0 } else { value };
        match row.meaning {
            VariableMeaning::OutputBit | VariableMeaning::OutputWord => {
                let outputs = source.outputs_after(row, number, filled);
                self.setting.memory.variables.outputs = outputs;
            }
            VariableMeaning::Clock | VariableMeaning::RunHours => {
                let which = usize::from(row.meaning == VariableMeaning::RunHours);
                let shift = source.clock_shift(which, filled)?;
                self.setting.memory.variables.clock_shift[which] = shift;
            }
            VariableMeaning::Local | VariableMeaning::CommonVolatile | VariableMeaning::CommonPermanent => {
                self.set_variable(number, value);
            }
            _ => {
                let written = source.written(number, value, place)?;
                return self.write(line, number, value, written);
            }
        }
        Ok(SetValue::Variable { number, value })
    }

    /// Writes what stands behind a system variable; what the trace tells of it.
    fn write(&mut self, line: &Line, number: u32, value: f64, written: Written) -> Result<SetValue, Trouble> {
        match written {
            Written::Nothing => return Ok(SetValue::Variable { number, value }),
            Written::Offset(offset, mm, stored) => {
                let write = DataWrite::Offset { number: offset, value: stored };
                self.state.memory_mark ^= self.setting.memory.write(write);
                return Ok(SetValue::Offset { number: offset, value: mm });
            }
            Written::Origin(system, axis, counts) => match system.checked_sub(1) {
                None if self.setting.control.functions.work.external => {
                    let mut origin = self.setting.memory.external;
                    origin[axis] = counts;
                    self.state.memory_mark ^= self.setting.memory.write(DataWrite::External { origin });
                    let shift = self.setting.to_mm(&origin);
                    return Ok(SetValue::Shift { code: None, axes: AxisSet::only(axis), shift });
                }
                None => self.state.common_shift[axis] = counts,
                Some(index) => {
                    let system = usize::from(index);
                    let mut origin = self.setting.memory.work.get(system).copied().unwrap_or_default();
                    origin[axis] = counts;
                    self.state.memory_mark ^= self.setting.memory.write(DataWrite::Work { system, origin });
                    return Ok(self.setting.work_origin(system, AxisSet::only(axis), &origin));
                }
            },
            Written::BlockControl(bits) => self.state.block_control = bits,
            Written::FeedControl(bits) => self.state.feed_control = bits,
            Written::Alarm(number) => {
                let end = if line.comment.len > 0 { line.comment } else { line.extent };
                let len = (end.at + end.len).saturating_sub(line.extent.at);
                let whole = Extent { at: line.extent.at, len };
                return Err(Trouble::Refused(Condition::MacroUser, whole, [number, 0.0, 0.0]));
            }
        }
        Ok(SetValue::Variable { number, value })
    }

    fn jump(&mut self, index: u32, line: &Line, to: Destination, place: Extent) -> Result<Next, Trouble> {
        let (number, computed) = match to {
            Destination::Number(number) => (number, false),
            Destination::Computed(run) => {
                let value = evaluate(&self.store.code, run, &self.source())?;
                (variable_number(value, place)?, true)
            }
        };
        let target = match line.target.get() {
            Some(target) if !computed => target,
            _ => {
                let frame = self.frame();
                let goal = Goal::Sequence {
                    source: frame.source,
                    program: frame.program,
                    head: frame.head,
                    from: line.next,
                    number,
                };
                let Some(found) = self.locate(goal, place)? else { return Ok(Next::Wait) };
                let target = Target { cursor: found.cursor, enters: found.enters };
                if !computed {
                    self.store.set_target(index, target);
                }
                target
            }
        };
        if target.enters {
            let values = [f64::from(number), target.cursor.line as f64, 0.0];
            return Err(Trouble::Refused(Condition::MacroIntoLoop, place, values));
        }
        let at = target.cursor.offset;
        self.calls.leave_loops(self.calls.frames.len(), at);
        if at <= line.start.offset && self.turns_for_ever(target.cursor) {
            return Ok(Next::Wait);
        }
        Ok(Next::At(target.cursor))
    }

    /// Where a goal is; `None` has started a search, and the statement is carried out anew when that has ended.
    fn locate(&mut self, goal: Goal, place: Extent) -> Result<Option<Found>, Trouble> {
        match self.calls.lookup(&goal) {
            None => self.look_for(goal),
            Some(None) => {
                let (condition, values) = goal.missing();
                return Err(Trouble::Refused(condition, place, values));
            }
            Some(found) => return Ok(found),
        }
        Ok(None)
    }

    fn look_for(&mut self, goal: Goal) {
        let Some(main) = self.calls.frames.first().map(|main| main.source) else { return };
        let around = match goal {
            // A loop's end is counted from inside it.
            Goal::LoopEnd { .. } => LoopsAround::default(),
            _ => LoopsAround::of(&self.calls.loops, self.calls.frames.len()),
        };
        self.search = Some(Search::new(goal, main, &self.calls.index, around));
    }

    fn enter_loop(&mut self, index: u32, line: &Line, condition: Option<Run>, number: u8) -> Result<Next, Trouble> {
        let depth = self.calls.frames.len();
        let head = Cursor { skipping: false, ..line.start };
        let open = self.calls.loops.last().is_some_and(|open| open.depth == depth && open.head.offset == head.offset);
        let after = match line.target.get() {
            Some(target) => target.cursor,
            None => {
                let goal = Goal::LoopEnd { source: self.frame().source, from: line.next, number };
                let Some(found) = self.locate(goal, line.extent)? else { return Ok(Next::Wait) };
                self.store.set_target(index, Target { cursor: found.cursor, enters: false });
                found.cursor
            }
        };
        let goes_in = match condition {
            Some(condition) => self.holds(condition)?,
            None => true,
        };
        if !goes_in {
            if open {
                self.calls.loops.pop();
            }
            return Ok(Next::At(after));
        }
        if !open {
            let here = self.calls.loops.iter().filter(|open| open.depth == depth);
            let (count, same) = here.fold((0, false), |(count, same), open| (count + 1, same || open.number == number));
            if same {
                let values = [f64::from(number), 0.0, 0.0];
                return Err(Trouble::Refused(Condition::MacroLoopPair, line.extent, values));
            }
            let most = self.setting.control.user_macro.loops;
            if count >= most {
                return Err(Trouble::Refused(Condition::MacroLoopDepth, line.extent, [most as f64, 0.0, 0.0]));
            }
            self.calls.loops.push(OpenLoop { depth, number, head, after });
        }
        Ok(Next::Following)
    }

    fn end_loop(&mut self, line: &Line, number: u8) -> Result<Next, Trouble> {
        let depth = self.calls.frames.len();
        match self.calls.loops.last() {
            Some(open) if open.depth == depth && open.number == number => {
                let head = open.head;
                if self.turns_for_ever(head) {
                    return Ok(Next::Wait);
                }
                Ok(Next::At(head))
            }
            _ => Err(Trouble::Refused(Condition::MacroLoopPair, line.extent, [f64::from(number), 0.0, 0.0])),
        }
    }

    /// A loop that has come round to the same state with the same variables would go on for ever: the program asks
    /// whether it shall.
    fn turns_for_ever(&mut self, head: Cursor) -> bool {
        let for_ever = self.comes_again(head, After::Statement);
        if for_ever {
            self.asks_again = Some(head);
        }
        for_ever
    }
}

impl Reader {
    /// The value of a variable for a display; `None` is a blank, or what cannot be shown without asking the machine.
    pub fn variable(&self, number: u32) -> Option<f64> {
        let value = self.source().read(number, Extent::default()).ok()?;
        (!value.is_nan()).then_some(value)
    }

    /// The level whose local variables are read and written.
    pub fn macro_level(&self) -> usize {
        self.source().level
    }

    /// Writes a local or common variable by hand.
    pub fn set_variable(&mut self, number: u32, value: f64) -> bool {
        let level = self.source().level;
        let Some(row) = self.setting.control.user_macro.variable(number) else { return false };
        let variables = &mut self.setting.memory.variables;
        match row.meaning {
            VariableMeaning::Local => variables.set_local(level, number.min(255) as u8, value),
            VariableMeaning::CommonVolatile => {
                let index = variables.index(0, number);
                variables.set_volatile(index, value);
            }
            VariableMeaning::CommonPermanent => {
                let index = variables.index(1, number);
                variables.set_permanent(index, value);
            }
            _ => return false,
        }
        true
    }
}
