//! The reading side of the control: one block after the other, through calls and returns, as commands.

mod doubt;

use base::{AXES, Alarm, AxisSet, Condition, Place, Point, ProgramId, SourceId, Span};
use dialect::Grouping;
use syntax::{Block, Cursor, Outcome, Value, read_block};

use crate::block::{Flow, read_meaning};
use crate::command::{Body, Command, Finish, MOST_CODES};
use crate::jump::{Calls, Found, Progress, Search};
use crate::operation::{CodeLine, CodeOut, EndKind, Side};
use crate::program::{Frame, Names};
use crate::repetition::Repetition;
use crate::setting::Setting;
use crate::state::State;
use crate::supply::Supply;
use crate::word::Refusal;

/// What came of reading.
pub(crate) enum Read {
    /// A command was read.
    Command,
    /// Bytes of a source are needed first.
    NeedBytes { source: SourceId, offset: u64 },
    /// A program from outside is needed first.
    NeedProgram { number: u32 },
    /// There is nothing more to read.
    Ended,
}

/// The reader.
pub(crate) struct Reader {
    pub setting: Setting,
    pub supply: Supply,
    pub names: Names,
    pub calls: Calls,
    /// The state after the block read last.
    pub state: State,
    /// The state after the block being read, in the making.
    next: State,
    /// Go on after an alarm, to find later ones.
    pub goes_on: bool,
    /// Jumps allowed without motion, dwell or stop.
    pub loop_limit: u64,
    block: Block,
    search: Option<Search>,
    blocks: u64,
    ended: bool,
    jumps: u64,
    repetition: Repetition,
}

impl Reader {
    pub fn new(setting: Setting, state: State) -> Reader {
        let levels = setting.control.subprogram_levels;
        Reader {
            setting,
            supply: Supply::new(),
            names: Names::default(),
            calls: Calls::new(levels),
            state,
            next: state,
            goes_on: false,
            loop_limit: 1_000_000,
            block: Block::default(),
            search: None,
            blocks: 0,
            ended: true,
            jumps: 0,
            repetition: Repetition::default(),
        }
    }

    /// Puts the reader at the head of a program, which begins at `head` in its text; `name` is used if no O word names it.
    pub fn select(&mut self, source: SourceId, name: &str, head: Cursor) {
        let program = self.names.intern(name);
        self.calls.frames.clear();
        self.calls.frames.push(Frame { program, source, head, cursor: head, begun: false, opened: false, repeats: 0 });
        self.rewind();
    }

    /// Goes back to the head of the main program.
    pub fn rewind(&mut self) {
        self.calls.frames.truncate(1);
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
        self.search = None;
        self.blocks = 0;
        self.ended = false;
        self.jumps = 0;
        self.repetition = Repetition::default();
    }

    /// Goes on in the main program at the block after a command, or (`again`) with that block once more.
    ///
    /// A command of a subprogram has no way back to its caller any more: the main program's head is next.
    pub fn go_to(&mut self, command: &Command, again: bool) {
        self.rewind();
        if !command.called
            && let Some(main) = self.calls.frames.first_mut()
        {
            main.cursor = if again { command.here } else { command.frame.cursor };
            main.begun = main.cursor.offset > main.head.offset && !(again && command.here.offset == main.head.offset);
        }
    }

    /// Reads on after a program's end.
    pub fn go_on(&mut self) {
        self.ended = false;
    }

    /// Stops reading until [`Reader::rewind`].
    pub fn end(&mut self) {
        self.ended = true;
        self.search = None;
    }

    /// The program that was asked for, or that there is none.
    pub fn brought(&mut self, source: Option<SourceId>) {
        if let Some(search) = &mut self.search
            && !search.brought(source)
        {
            let target = search.target();
            self.calls.remember(target, None);
            self.search = None;
        }
    }

    /// The main program.
    pub fn main_program(&self) -> Option<(ProgramId, SourceId)> {
        self.calls.frames.first().map(|frame| (frame.program, frame.source))
    }

    /// Reads the next block that says anything into `command`.
    pub fn read(&mut self, command: &mut Command) -> Read {
        loop {
            if self.ended {
                return Read::Ended;
            }
            if let Some(needs) = self.search_on() {
                return needs;
            }
            let Some(&frame) = self.calls.top() else { return Read::Ended };
            let view = self.supply.view(frame.source, frame.cursor.offset);
            match read_block(view.characters, view.last, frame.cursor, &self.setting.control.grammar, &mut self.block) {
                Outcome::More => return Read::NeedBytes { source: frame.source, offset: frame.cursor.offset },
                Outcome::End => return self.end_of_text(&frame, command),
                Outcome::Block => {}
            }
            if self.block.rewind && (frame.begun || frame.opened) {
                return self.end_of_text(&frame, command);
            }
            if self.block.rewind || self.block.is_empty() {
                if let Some(frame) = self.calls.frames.last_mut() {
                    frame.cursor = self.block.next;
                    frame.opened |= self.block.rewind;
                }
                continue;
            }
            if self.begins_program() {
                if frame.begun {
                    return self.end_of_text(&frame, command);
                }
                self.name_program();
            }
            if let Some(read) = self.take_block(&frame, command) {
                return read;
            }
        }
    }

    fn search_on(&mut self) -> Option<Read> {
        let search = self.search.as_mut()?;
        let grammar = self.setting.control.grammar;
        match search.advance(&mut self.supply, &grammar, &mut self.names, &mut self.block, &mut self.calls.index) {
            Progress::NeedBytes { source, offset } => Some(Read::NeedBytes { source, offset }),
            Progress::NeedProgram { number } => Some(Read::NeedProgram { number }),
            Progress::Done(found) => {
                let target = search.target();
                self.calls.remember(target, found);
                self.search = None;
                None
            }
        }
    }

    fn advance(&mut self, to: Cursor) {
        if let Some(frame) = self.calls.frames.last_mut() {
            frame.cursor = to;
        }
    }

    fn begins_program(&self) -> bool {
        self.setting.control.grouping == Grouping::OWords
            && self.block.words.first().is_some_and(|word| word.letter == b'O')
    }

    fn name_program(&mut self) {
        if let Some(Value::Number(number)) = self.block.words.first().map(|word| word.value)
            && let Some(number) = number.integer().and_then(|number| u32::try_from(number).ok())
        {
            let program = self.names.numbered(number);
            if let Some(frame) = self.calls.frames.last_mut() {
                frame.program = program;
            }
        }
    }

    /// Gives the block its meaning; `None` reads on (a jump's target is looked for first, or the block is passed over).
    fn take_block(&mut self, frame: &Frame, command: &mut Command) -> Option<Read> {
        let program = self.calls.top().map_or(frame.program, |frame| frame.program);
        let sequence = match self.block.words.iter().find(|word| word.letter == b'N').map(|word| word.value) {
            Some(Value::Number(number)) => number.integer().and_then(|n| u32::try_from(n).ok()).unwrap_or(0),
            _ => 0,
        };
        let start = self.block.start;
        self.prepare(
            command,
            Place {
                program,
                source: frame.source,
                line: start.line,
                line_start: start.line_start,
                block: self.block.span(),
                sequence,
            },
        );
        self.next = self.state;
        match read_meaning(&self.setting, &self.calls, &self.state, &mut self.next, &self.block, command) {
            Ok(flow) => {
                self.begin(self.block.next, command);
                match self.follow(flow, command) {
                    Ok(()) => {
                        self.state = self.next;
                        command.after = self.next;
                        self.count(command);
                        Some(Read::Command)
                    }
                    Err(alarm) => self.refuse(alarm, command),
                }
            }
            Err(Refusal::Locate(target)) => {
                let main = self.calls.frames.first().map_or(frame.source, |main| main.source);
                let levels = self.calls.frames.len();
                let goal = self.calls.frames.get(levels.saturating_sub(2)).map_or(program, |goal| goal.program);
                self.search = Some(Search::new(target, main, goal, &self.calls.index));
                None
            }
            Err(Refusal::Alarm(alarm)) => {
                self.begin(self.block.next, command);
                self.refuse(alarm, command)
            }
        }
    }

    fn begin(&mut self, next: Cursor, command: &mut Command) {
        if let Some(frame) = self.calls.frames.last_mut() {
            frame.cursor = next;
            frame.begun = true;
            command.frame = *frame;
        }
        command.here = self.block.start;
        command.called = self.calls.frames.len() > 1;
    }

    fn prepare(&self, command: &mut Command, place: Place) {
        command.block = self.blocks;
        command.place = place;
        command.from = self.state.machine;
        command.code_count = 0;
        command.optional_code = None;
        command.body = Body::Nothing;
        command.finish = Finish::Next;
        command.stops_reading = false;
        command.absolute = AxisSet::NONE;
        command.from_unknown = !self.state.unknown.axes.is_empty();
    }

    fn count(&mut self, command: &Command) {
        self.blocks += 1;
        if !matches!(command.body, Body::Nothing | Body::Set(..)) || command.finish != Finish::Next {
            self.jumps = 0;
        }
    }

    /// Carries the program to where the block sends it.
    fn follow(&mut self, flow: Flow, command: &mut Command) -> Result<(), Alarm> {
        if flow == Flow::Next {
            return Ok(());
        }
        self.jumps += 1;
        if self.jumps > self.loop_limit {
            let place = command.place;
            let jump = self.block.words.iter().find(|word| word.letter == b'M');
            let span = jump.map_or(place.block, |word| word.extent.span(place.block.start));
            let alarm = Alarm::new(Condition::EndlessLoop, place, span);
            return Err(alarm.with([self.loop_limit as f64, 0.0, 0.0]));
        }
        match flow {
            Flow::Next => {}
            Flow::Call(found, repeats) => self.enter(found, repeats),
            Flow::Return(found) => self.leave(found),
            Flow::Again => self.run_again(command),
            // A round without a move, dwell or stop is not a program that runs again: the loop limit ends it.
            Flow::Jump(found) if self.jumps == 1 && self.repetition.comes_again(found.cursor, &self.next) => {
                self.run_again(command)
            }
            Flow::Jump(found) => self.advance(found.cursor),
        }
        Ok(())
    }

    fn enter(&mut self, found: Found, repeats: u32) {
        let Found { source, program, cursor } = found;
        self.calls.frames.push(Frame {
            program,
            source,
            head: cursor,
            cursor,
            begun: false,
            opened: false,
            repeats: repeats - 1,
        });
    }

    fn leave(&mut self, found: Option<Found>) {
        let Some(frame) = self.calls.frames.last_mut() else { return };
        if frame.repeats > 0 && found.is_none() {
            frame.repeats -= 1;
            frame.cursor = frame.head;
            frame.begun = false;
            frame.opened = false;
            return;
        }
        self.calls.frames.pop();
        if let Some(found) = found {
            self.advance(found.cursor);
        }
    }

    /// M99 in the main program: it asks to be run again.
    fn run_again(&mut self, command: &mut Command) {
        command.finish = Finish::End(EndKind::M99);
        command.stops_reading = true;
        if let Some(main) = self.calls.frames.first_mut() {
            main.cursor = main.head;
            main.begun = false;
            main.opened = false;
        }
    }

    /// The block is refused: it has no effect. Checking on, what it names becomes unknown.
    fn refuse(&mut self, alarm: Alarm, command: &mut Command) -> Option<Read> {
        let clouded = self.unknown_in_block().clouds(alarm.condition, &self.setting.control.roles, alarm.axis);
        if !self.goes_on {
            self.ended = true;
        } else {
            self.forget_what_it_names();
        }
        if clouded {
            return None;
        }
        self.prepare(command, alarm.place);
        command.body = Body::Alarm(alarm);
        command.after = self.state;
        self.blocks += 1;
        Some(Read::Command)
    }

    fn end_of_text(&mut self, frame: &Frame, command: &mut Command) -> Read {
        let Cursor { offset, line, line_start, .. } = frame.cursor;
        self.prepare(
            command,
            Place {
                program: frame.program,
                source: frame.source,
                line,
                line_start,
                block: Span { start: offset, len: 0 },
                sequence: 0,
            },
        );
        command.finish = Finish::End(EndKind::Text);
        command.after = self.state;
        command.side = Side::Off;
        command.frame = *frame;
        command.here = frame.cursor;
        command.called = self.calls.frames.len() > 1;
        self.ended = true;
        Read::Command
    }

    /// Sets where the axes stand (counts).
    pub fn stand_at(&mut self, machine: Point) {
        self.state.machine = machine;
    }
}

/// A command that says nothing.
pub(crate) fn empty_command(state: &State) -> Command {
    Command {
        block: 0,
        place: Place::default(),
        after: *state,
        from: state.machine,
        codes: [CodeOut { line: CodeLine::M, code: 0, digits: 0, after_motion: false }; MOST_CODES],
        code_count: 0,
        optional_code: None,
        body: Body::Nothing,
        finish: Finish::Next,
        stops_reading: false,
        side: Side::Off,
        plane: AxisSet::NONE,
        axis_words: [syntax::Extent::default(); AXES],
        absolute: AxisSet::NONE,
        stroke_check: false,
        from_unknown: false,
        frame: Frame::default(),
        here: Cursor::HEAD,
        called: false,
    }
}
