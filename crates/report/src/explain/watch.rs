//! A program run up to the blocks that are to be explained, and what each of them did there.

use std::collections::BTreeMap;

use base::{Alarm, Place, Point, SourceId};
use machine::{Event, EventKind};
use meaning::{State, StatementRead, WordsRead};
use station::{Library, LibraryError, Session, Step};

use super::beside::Beside;

/// Events of one block that are kept; a cycle can have more, which are counted.
const MOST_EVENTS: usize = 2000;

/// Events looked at behind the block, to count how often it is executed; a program may run for ever.
const MOST_AFTER: u64 = 20_000_000;

/// Which blocks are to be explained.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wanted {
    /// Those on this line of the main program's text, at their so-manieth execution (from 1).
    Line(u64, u64),
    /// Every block at its first execution.
    All,
}

/// One execution of one block.
#[derive(Clone, PartialEq, Debug)]
pub struct Watched {
    /// Where it stands.
    pub place: Place,
    /// Which execution of this block it is, from 1.
    pub pass: u64,
    /// The state before it.
    pub before: State,
    /// The state after it; that before it if it was refused.
    pub after: State,
    /// Where the axes are before and after it, mm and degrees, program coordinates.
    pub program: [Point; 2],
    /// Where the axes are before and after it, mm and degrees, machine coordinates.
    pub at: [Point; 2],
    /// What H and D select after it, mm.
    pub offsets: [Option<f64>; 2],
    /// How its words were read.
    pub words: WordsRead,
    /// What happened, as far as it is kept.
    pub events: Vec<Event>,
    /// Which of them run beside their programmed path, and how.
    pub beside: Vec<Beside>,
    /// How many events there were.
    pub event_count: usize,
    /// Why it was refused, if it was.
    pub alarm: Option<Alarm>,
    /// What it did, if it is a macro statement.
    pub statement: Option<StatementRead>,
}

/// What came of watching.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Watch {
    /// The executions that were to be explained, in their order.
    pub found: Vec<Watched>,
    /// How often each block of the line was executed, by the byte at which it begins.
    pub passes: BTreeMap<(SourceId, u64), u64>,
    /// The alarm that stopped the program.
    pub stopped_by: Option<Alarm>,
    /// The last one found is being executed.
    begun: bool,
}

/// Blocks whose executions are counted; beyond it a text is too long for every block to be explained.
const MOST_BLOCKS: usize = 100_000;

impl Watch {
    /// Runs the session's program to its end, pressing CYCLE START after every stop.
    ///
    /// # Errors
    /// A text cannot be read.
    pub fn run<L: Library>(session: &mut Session<L>, wanted: Wanted) -> Result<Watch, LibraryError> {
        let pass = if let Wanted::Line(_, pass) = wanted { pass } else { 1 };
        session.interpreter_mut().record_words(pass);
        let mut watch = Watch::default();
        session.start();
        let mut after = 0;
        while after < MOST_AFTER {
            after += u64::from(!watch.found.is_empty());
            if let Some(place) = session.block_begins() {
                watch.begin(session, place, wanted);
            }
            match session.next() {
                Step::Event(event) => watch.see(session, event),
                Step::Stopped => session.start(),
                Step::Idle => break,
                Step::Failed(error) => return Err(error),
            }
        }
        watch.stopped_by = session.alarm().copied();
        watch.take_statements(session, wanted);
        Ok(watch)
    }

    fn begin<L: Library>(&mut self, session: &Session<L>, place: Place, wanted: Wanted) {
        self.begun = false;
        // A macro statement that wrote something is told with its own place; it is no block.
        if session.place().block != place.block {
            return;
        }
        let pass = match wanted {
            _ if place.line == 0 || place.block.len == 0 => return,
            Wanted::Line(line, _) if place.line != line || place.source != SourceId(0) => return,
            Wanted::Line(_, pass) => pass,
            Wanted::All => 1,
        };
        if self.passes.len() >= MOST_BLOCKS {
            return;
        }
        let count = self.passes.entry((place.source, place.block.start)).or_default();
        *count += 1;
        if *count != pass {
            return;
        }
        let interpreter = session.interpreter();
        let (before, after) = (*interpreter.state_before(), *interpreter.executing_state());
        let mm = |value: Option<f64>| value.map(|nanometres| nanometres / 1e6);
        let memory = interpreter.memory();
        self.begun = true;
        self.found.push(Watched {
            place,
            pass,
            before,
            after,
            program: [programmed(session, &before, &session.position()); 2],
            at: [session.position(); 2],
            offsets: [mm(memory.length(after.h)), mm(memory.radius(after.d))],
            words: interpreter.words_read().cloned().unwrap_or_default(),
            events: Vec::new(),
            beside: Vec::new(),
            event_count: 0,
            alarm: None,
            statement: None,
        });
    }

    /// The macro statements: they are carried out as they are read, and make no block.
    fn take_statements<L: Library>(&mut self, session: &Session<L>, wanted: Wanted) {
        let interpreter = session.interpreter();
        let is_wanted = |place: &Place| match wanted {
            Wanted::Line(line, _) => place.line == line && place.source == SourceId(0),
            Wanted::All => true,
        };
        for runs in interpreter.statements_read() {
            let Some(read) = runs.asked.filter(|read| is_wanted(&read.place)) else { continue };
            self.passes.insert((read.place.source, read.place.block.start), runs.count);
            let at = read.state.machine.map(|counts| counts / 1e6);
            self.found.push(Watched {
                place: read.place,
                pass: if let Wanted::Line(_, pass) = wanted { pass } else { 1 },
                before: read.state,
                after: read.state,
                program: [programmed(session, &read.state, &at); 2],
                at: [at; 2],
                offsets: [None; 2],
                words: WordsRead::default(),
                events: Vec::new(),
                beside: Vec::new(),
                event_count: 0,
                alarm: None,
                statement: Some(read),
            });
        }
        self.found.sort_by_key(|block| (block.place.source, block.place.block.start));
    }

    fn see<L: Library>(&mut self, session: &Session<L>, event: Event) {
        let Some(block) = self.found.last_mut().filter(|_| self.begun) else { return };
        // A statement read ahead speaks for itself.
        if matches!(event.kind, EventKind::Set(_)) && event.place.block != block.place.block {
            return;
        }
        block.at[1] = session.position();
        if let EventKind::Alarm(alarm) = event.kind {
            block.alarm = Some(alarm);
            block.after = block.before;
        }
        block.program[1] = programmed(session, &block.after, &block.at[1]);
        if event.kind != EventKind::BlockDone {
            block.event_count += 1;
            if block.events.len() < MOST_EVENTS {
                let moves =
                    matches!(event.kind, EventKind::Rapid { .. } | EventKind::Feed { .. } | EventKind::Arc { .. });
                let beside = session.beside().filter(|_| moves);
                block.beside.extend(beside.map(|beside| (block.events.len(), *beside)));
                block.events.push(event);
            }
        }
    }
}

/// A place in the coordinates of a program.
fn programmed<L: Library>(session: &Session<L>, state: &State, machine: &Point) -> Point {
    session.interpreter().last_programmed(state, &machine.map(|mm| mm * 1e6)).map(|counts| counts / 1e6)
}
