//! Runs programs in a session and asserts what every run keeps. The fuzz target `interpret` uses it too.

#![allow(dead_code)] // each test takes what it needs of it

use std::sync::{Arc, LazyLock};

use base::{Condition, Place, Point, SourceId, Span};
use dialect::Control;
use machine::{Event, EventKind, MachineFile, StopCause, builtin_machine, read_machine};
use station::{Configuration, Library, LibraryError, Session, Setup, Shelf, Step, TYPED, Wanted};
use syntax::Cursor;

/// Positions are exact to less than this, mm.
pub const EXACTNESS_MM: f64 = 1e-9;

/// Alarms that stand in no block.
const FROM_THE_PANEL: &[Condition] = &[
    Condition::TravelExceeded,
    Condition::EmergencyStop,
    Condition::MemoryFull,
    Condition::ProgramProtected,
    Condition::ServoFault,
    Condition::LimitSwitchReached,
    Condition::SpindleTooSlow,
    Condition::PowerFailed,
];

/// Times in a row that the same bytes may be asked for before it counts as standing still.
const MOST_AGAIN: u32 = 100;

/// Program texts in memory, handed out in pieces of these sizes in turn (no sizes: as much as is asked for).
#[derive(Clone, Default)]
pub struct Texts {
    /// The texts; a source's id is its index.
    pub texts: Vec<Vec<u8>>,
    /// Numbers of programs, and the sources in which they stand, beside those found in open texts.
    pub programs: Vec<(u32, SourceId)>,
    /// File names of programs, in capitals, and the sources in which they stand.
    pub files: Vec<(&'static str, SourceId)>,
    /// Sizes of the pieces.
    pub pieces: Vec<usize>,
    /// How many pieces have been handed out.
    pub turn: usize,
    /// What was asked for last.
    pub asked: (SourceId, u64),
    /// How many times in a row it was.
    pub again: u32,
}

impl Texts {
    /// One text, handed out in one piece.
    pub fn one(text: impl Into<Vec<u8>>) -> Texts {
        Texts { texts: vec![text.into()], ..Texts::default() }
    }

    /// The same in pieces.
    pub fn in_pieces(mut self, pieces: &[usize]) -> Texts {
        self.pieces = pieces.to_vec();
        self
    }
}

impl Library for Texts {
    fn read(&mut self, source: SourceId, offset: u64, len: usize, bytes: &mut Vec<u8>) -> Result<bool, LibraryError> {
        bytes.clear();
        self.again = if self.asked == (source, offset) { self.again + 1 } else { 0 };
        self.asked = (source, offset);
        assert!(self.again < MOST_AGAIN, "the same bytes are asked for again and again: {source:?} from {offset} on");
        let Some(text) = self.texts.get(source.0 as usize) else { return Ok(true) };
        let from = (offset as usize).min(text.len());
        let len = match self.pieces.len() {
            0 => len,
            sizes => len.min(self.pieces[self.turn % sizes].max(1)),
        };
        self.turn += 1;
        let to = (from + len).min(text.len());
        bytes.extend_from_slice(&text[from..to]);
        Ok(to == text.len())
    }

    fn size(&self, source: SourceId) -> Option<u64> {
        self.texts.get(source.0 as usize).map(|text| text.len() as u64)
    }

    fn find_program(&mut self, wanted: Wanted) -> Result<Option<SourceId>, LibraryError> {
        Ok(match wanted {
            Wanted::Number(number, _) => {
                self.programs.iter().find(|(known, _)| *known == number).map(|&(_, source)| source)
            }
            Wanted::File(name) => {
                self.files.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)).map(|&(_, source)| source)
            }
        })
    }
}

impl Shelf for Texts {
    /// A file's name is the number of its text.
    fn open_file(&mut self, file: &str) -> Result<(SourceId, String), LibraryError> {
        match file.parse::<u32>() {
            Ok(text) if (text as usize) < self.texts.len() => Ok((SourceId(text), format!("P{text}"))),
            _ => Err(LibraryError(format!("there is no text {file}"))),
        }
    }

    fn keep_in_memory(&mut self, program: Wanted, source: SourceId) {
        let Wanted::Number(number, _) = program else { return };
        self.programs.retain(|(known, _)| *known != number);
        self.programs.push((number, source));
    }

    fn forget_in_memory(&mut self, program: Wanted) {
        let Wanted::Number(number, _) = program else { return };
        self.programs.retain(|(known, _)| *known != number);
    }

    fn hold_text(&mut self, _name: &str, text: Vec<u8>) -> Result<SourceId, LibraryError> {
        self.texts.push(text);
        Ok(SourceId((self.texts.len() - 1) as u32))
    }
}

/// A built-in machine, its travel narrowed to ± this many mm if any are given.
pub fn machine(name: &str, travel: Option<f64>) -> MachineFile {
    let (file, text) = builtin_machine(name).expect("a machine that comes with the program");
    let mut machine = read_machine(&file, text).expect("it is valid");
    if let Some(travel) = travel {
        machine.axes.iter_mut().for_each(|axis| axis.travel = [-travel, travel]);
    }
    machine
}

/// A built-in control.
pub fn load(name: &str) -> Arc<Control> {
    let files = dialect::builtin_files(name).expect("its files are there");
    Arc::new(dialect::load_control(&files).expect("they are valid"))
}

/// The control that most of this is done with, loaded once.
pub fn control() -> Arc<Control> {
    static CONTROL: LazyLock<Arc<Control>> = LazyLock::new(|| load("yasnac-mx1"));
    CONTROL.clone()
}

/// That control as it comes, on a machine, set up.
pub fn configuration(machine: MachineFile, setup: &Setup) -> Configuration {
    Configuration::new(control(), machine, &[setup]).expect("the set-up fits")
}

/// Selects the text of this number, from its head.
pub fn select(session: &mut Session<Texts>, text: u32) {
    session.select(SourceId(text), "test", Cursor::HEAD);
}

/// What is asserted of a run beyond what holds for all.
#[derive(Clone, Copy)]
pub struct Expect {
    /// Events after which the run is given up: programs may be endless.
    pub most_events: usize,
    /// No axis ever leaves its travel, and each move begins where the one before ended. Not so while checking on
    /// after an alarm.
    pub stays_inside: bool,
}

/// Runs the selected program, pressing CYCLE START after every stop, and asserts what holds of every event.
pub fn run(session: &mut Session<Texts>, expect: Expect) -> Vec<Event> {
    let mut watch = Watch::new(session, expect.stays_inside);
    let mut events = Vec::new();
    let mut stops = 0;
    session.start();
    while events.len() < expect.most_events && stops < expect.most_events {
        match session.next() {
            Step::Event(event) => {
                watch.see(&event, session);
                events.push(event);
            }
            Step::Stopped => {
                stops += 1;
                session.start();
            }
            Step::Idle => break,
            Step::Failed(error) => panic!("texts in memory can be read: {error}"),
        }
    }
    events
}

/// Looks at every event of a session.
pub struct Watch {
    position: Point,
    time: f64,
    limits: Option<(Point, Point)>,
    axes: usize,
}

impl Watch {
    /// A watch on a session from now on.
    pub fn new(session: &Session<Texts>, stays_inside: bool) -> Watch {
        let machine = &session.configuration().machine;
        let travel = machine.travel();
        Watch {
            position: session.position(),
            time: session.time().0,
            limits: stays_inside.then_some((travel.low, travel.high)),
            axes: machine.axes.len(),
        }
    }

    /// Asserts what holds of an event.
    pub fn see(&mut self, event: &Event, session: &Session<Texts>) {
        assert!(event.time.0.is_finite(), "{event:?}");
        // What the machine answered while something moved is told when the block waits for it.
        if !matches!(event.kind, EventKind::Finished(_) | EventKind::Waited(_)) {
            assert!(event.time.0 >= self.time, "time runs on: {} {event:?}", self.time);
            self.time = event.time.0;
        }
        // The start of a program is no block of it, and the operator's buttons need none.
        let may_be_placeless = matches!(
            event.kind,
            EventKind::Start(_) | EventKind::BlockDone | EventKind::Reset { .. } | EventKind::Rapid { .. }
        ) || matches!(event.kind, EventKind::Stop(StopCause::FeedHold))
            || matches!(event.kind, EventKind::Alarm(alarm) if FROM_THE_PANEL.contains(&alarm.condition));
        let placeless = may_be_placeless && event.place.line == 0;
        if !placeless {
            self.check_place(event, session);
        }
        match &event.kind {
            EventKind::Rapid { from, to, duration, length, .. } => {
                self.check_move(event, from, to, duration.0, *length);
                self.position = *to;
            }
            EventKind::Feed { from, to, feed, duration, length, .. } => {
                self.check_feed(event, *feed);
                self.check_move(event, from, to, duration.0, *length);
                self.position = *to;
            }
            EventKind::Arc { arc, feed, duration, length, .. } => {
                self.check_feed(event, *feed);
                let numbers = [arc.center, arc.radius, [arc.sweep, arc.start_angle]].concat();
                assert!(numbers.iter().all(|number| number.is_finite()), "{event:?}");
                assert!(arc.sweep != 0.0 && arc.sweep.abs() <= std::f64::consts::TAU, "{event:?}");
                self.check_move(event, &arc.from, &arc.to, duration.0, *length);
                (1..16).for_each(|part| self.check_inside(event, &arc.at(f64::from(part) / 16.0)));
                self.position = arc.to;
            }
            EventKind::Alarm(alarm) => {
                assert!(alarm.values.iter().all(|value| !value.is_nan()), "{event:?}");
            }
            EventKind::End { to, .. } => assert!(to.iter().all(|mm| mm.is_finite()), "{event:?}"),
            _ => {}
        }
    }

    fn check_place(&self, event: &Event, session: &Session<Texts>) {
        let Place { source, line, line_start, block, .. } = event.place;
        let text = match source {
            TYPED => session.typed_text(),
            source => session.library().texts.get(source.0 as usize).expect("the source is one of the texts"),
        };
        assert!(line >= 1 && line_start <= block.start, "{event:?}");
        assert!(block.end() <= text.len() as u64, "the block lies in its text: {event:?}");
        if let EventKind::Alarm(alarm) = &event.kind {
            assert_eq!(alarm.place, event.place);
            // Of a block that is too long the end-of-block itself may be the character too many.
            let end = if alarm.condition == Condition::BlockTooLong { text.len() as u64 } else { block.end() };
            let Span { start, .. } = alarm.span;
            assert!(block.start <= start && alarm.span.end() <= end, "the word lies in its block: {event:?}");
        }
    }

    fn check_move(&self, event: &Event, from: &Point, to: &Point, seconds: f64, length: f64) {
        assert!([from, to].iter().all(|point| point.iter().all(|mm| mm.is_finite())), "{event:?}");
        assert!(seconds.is_finite() && seconds >= 0.0 && length.is_finite() && length >= 0.0, "{event:?}");
        if self.limits.is_some() {
            // Beside what is counted (MANUAL ABSOLUTE off) a place is a difference, and is rounded as one.
            let begins = from.iter().zip(&self.position).all(|(from, at)| (from - at).abs() < EXACTNESS_MM);
            assert!(begins, "a move begins where the axes are, at {:?}: {event:?}", self.position);
        }
        self.check_inside(event, to);
    }

    fn check_inside(&self, event: &Event, point: &Point) {
        let Some((low, high)) = &self.limits else { return };
        let inside = |axis: usize| point[axis] >= low[axis] - EXACTNESS_MM && point[axis] <= high[axis] + EXACTNESS_MM;
        assert!((0..self.axes).all(inside), "{point:?} leaves the travel: {event:?}");
    }

    fn check_feed(&self, event: &Event, feed: f64) {
        // Checking on after a refused move, an arc can begin on its own centre.
        assert!(feed.is_finite() && (feed > 0.0 || self.limits.is_none()), "{event:?}");
    }
}
