//! An operator who does anything at any time, and what holds after everything he does.

#![allow(dead_code)] // each test takes what it needs of it

pub mod places;
pub mod words;

use std::collections::BTreeMap;
use std::sync::LazyLock;

use base::Point;
use machine::{Event, EventKind};
use proptest::prelude::*;
use proptest::sample::select;
use proptest::strategy::Union;
use station::{Action, CellKind, Operator, Said, Session, read_action};

use crate::watch::{Texts, Watch};

/// Nearer than this the axes have not moved, mm or degrees.
const STANDS_MM: f64 = 1e-6;
/// A path is cut into chords: by so much more than the border it may bulge, mm.
const BORDER_MM: f64 = 1e-6;

static GROUPS: LazyLock<Vec<(u32, Vec<Action>)>> = LazyLock::new(|| {
    let read = |line: &&str| read_action(line).unwrap_or_else(|why| panic!("{line}: {why}"));
    words::WORDS.iter().map(|(weight, lines)| (*weight, lines.iter().map(read).collect())).collect()
});

/// An action, any of all.
pub fn action() -> impl Strategy<Value = Action> {
    Union::new_weighted(GROUPS.iter().map(|(weight, actions)| (*weight, select(&actions[..]))).collect())
}

/// More than proptest's own number of cases: each is cheap.
pub fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(1000), ..default }
}

/// A control that somebody works, watched.
pub struct Station {
    /// Where it is, one of `places`.
    pub place: usize,
    pub operator: Operator<Texts>,
    watch: Watch,
    pub events: Vec<Event>,
    /// The last action was refused.
    pub refused: bool,
    /// What has been written at the panel and taken, by the line that shows it.
    pub written: BTreeMap<String, String>,
    /// The axis whose button is pressed, or which goes home, and where to.
    button: Option<(u8, Option<bool>)>,
    programs: Vec<(String, u32, u64)>,
}

/// What stands before an action.
struct Before {
    /// Axes may be under way without anything more being pressed.
    moves: bool,
    /// The axis that a button has set going, and nothing else.
    button: Option<(u8, Option<bool>)>,
    /// Without power, or the emergency stop button is pressed.
    dead: bool,
    rpm: f64,
    position: Point,
    time: f64,
    events: usize,
}

impl Before {
    fn of(station: &Station) -> Before {
        let session = &station.operator.session;
        let dead = session.emergency_stop() || !session.is_powered();
        let (runs, by_hand) = (session.is_running() && !session.is_stopped(), session.is_moved_by_hand());
        Before {
            moves: !dead && session.alarm().is_none() && (runs || by_hand),
            button: station.button.filter(|_| by_hand),
            dead,
            rpm: session.spindle_rpm().abs(),
            position: session.position(),
            time: session.time().0,
            events: station.events.len(),
        }
    }

    /// Axes may move in this action.
    fn is_cause(&self, action: &Action, refused: bool) -> bool {
        match action {
            // What is refused in it is an action that had to wait.
            Action::Run(_) => self.moves,
            Action::Jog(..) | Action::Step(..) => !self.dead && !refused,
            // Axes that are under way come to stand.
            Action::FeedHold
            | Action::Reset
            | Action::Key(_)
            | Action::EmergencyStop
            | Action::PowerOff
            | Action::Input(..)
            | Action::Fault(_) => self.moves && !refused,
            _ => false,
        }
    }
}

/// Cells by kind, name and value; programs by name and text.
pub type Kept = (Vec<(CellKind, String, String)>, Vec<(String, Vec<u8>)>);

impl Station {
    /// A control that has just been powered on, with all programs in its memory.
    pub fn new(place: usize) -> Station {
        let session = Session::new(places::configuration(place), places::texts(place));
        let watch = Watch::new(&session, true);
        let mut station = Station {
            place,
            operator: Operator::new(session),
            watch,
            events: Vec::new(),
            refused: false,
            written: BTreeMap::new(),
            button: None,
            programs: Vec::new(),
        };
        for text in 0..places::PROGRAMS.len() {
            station.perform(&Action::Load(text.to_string(), Some(format!("P{text}"))));
        }
        station
    }

    /// Performs an action and looks at all that came of it.
    pub fn perform(&mut self, action: &Action) {
        let before = Before::of(self);
        let Station { operator, watch, events, refused, .. } = self;
        *refused = false;
        // Looking at a text again and again is no standing still.
        operator.session.library_mut().again = 0;
        let mut tell = |session: &mut Session<Texts>, said: Said| match said {
            Said::Event(event) => {
                watch.see(&event, session);
                events.push(event);
            }
            // An action that had to wait is refused in a later one.
            Said::Refused { action: of, .. } => *refused |= of == action.to_string(),
            Said::Shown { .. } => {}
        };
        let performed = operator.perform(action, &mut tell);
        // A file that is not there changes nothing either.
        let names_file = matches!(action, Action::Load(..) | Action::Tape(_));
        assert!(performed.is_ok() || names_file, "texts in memory can be read: {action}, {performed:?}");
        *refused |= performed.is_err();
        assert!(!operator.is_busy(), "without a clock every action ends: {action}");
        self.has_a_cause(action, &before);
        self.is_legal(action, &before);
        self.note(action, before.moves);
    }

    /// Nothing moves but what somebody has set going.
    fn has_a_cause(&self, action: &Action, before: &Before) {
        let session = &self.operator.session;
        let (from, to) = (before.position, session.position());
        let way: Vec<f64> = from.iter().zip(to).map(|(from, to)| to - from).collect();
        let moved = way.iter().any(|way| way.abs() > STANDS_MM);
        let is_cause = before.is_cause(action, self.refused);
        assert!(is_cause || !moved, "no motion without a cause: {action}, {from:?} to {to:?}");
        // A move that was held is told when it is given up, as far as it has come.
        let ends_there = |to: &Point| to.iter().zip(from).all(|(to, from)| (to - from).abs() <= STANDS_MM);
        for event in self.events[before.events..].iter().filter(|_| !is_cause) {
            let stands = match &event.kind {
                EventKind::Rapid { to, .. } | EventKind::Feed { to, .. } => ends_there(to),
                EventKind::Arc { arc, .. } => ends_there(&arc.to),
                EventKind::Start(_) => *action == Action::CycleStart,
                _ => true,
            };
            assert!(stands, "nothing is told to have moved without a cause: {action}, {event:?}");
        }
        // By hand one axis moves, the way its button says, and no farther.
        let (hand, most) = match action {
            Action::Jog(axis, up, _) => (Some((*axis, Some(*up))), f64::INFINITY),
            Action::Step(axis, way) => (Some((*axis, Some(*way > 0.0))), way.abs() + STANDS_MM),
            Action::Run(_) => (before.button, f64::INFINITY),
            _ => (None, f64::INFINITY),
        };
        let Some((letter, up)) = hand else { return };
        let axes = &session.configuration().machine.axes;
        let own = axes.iter().position(|axis| axis.letter == letter);
        let switches = session.switches();
        let held = switches.machine_lock || switches.z_cancel && letter == b'Z';
        for (axis, way) in way.iter().enumerate().filter(|(_, way)| way.abs() > STANDS_MM) {
            assert_eq!(Some(axis), own, "{action}: one axis moves by hand, {way}");
            assert!(up.is_none_or(|up| up == (*way > 0.0)), "{action}: its way, {way}");
            assert!(way.abs() <= most, "{action}: and no farther, {way}");
            // A lock turned while the axis moves holds the next move.
            assert!(!held || matches!(action, Action::Run(_)), "{action}: a lock holds it, {way}");
        }
    }

    /// The states of a control go together.
    fn is_legal(&self, action: &Action, before: &Before) {
        let session = &self.operator.session;
        assert!(session.time().0 >= before.time, "time runs on: {action}");
        let travel = session.configuration().machine.travel();
        let (position, counted) = (session.position(), session.counted_position());
        for axis in 0..session.configuration().machine.axes.len() {
            let inside =
                position[axis] >= travel.low[axis] - BORDER_MM && position[axis] <= travel.high[axis] + BORDER_MM;
            assert!(inside, "{action}: axis {axis} stands at {}", position[axis]);
        }
        assert!(counted.iter().chain(&session.distance_to_go()).all(|mm| mm.is_finite()), "{action}: {counted:?}");
        let (off, pressed) = (!session.is_powered(), session.emergency_stop());
        if off {
            assert!(session.alarm().is_none() && !session.is_in_program(), "{action}: nothing stands without power");
        } else if pressed {
            assert!(session.alarm().is_some() && !session.is_in_program(), "{action}: the emergency stop stands");
        }
        if off || pressed || session.alarm().is_some() {
            let moves = session.is_moved_by_hand() || session.is_driven() || session.setpoint().is_some();
            assert!(!moves, "{action}: no axis is under way");
            assert!(session.waiting().is_none() && !session.waits_for_override(), "{action}: nothing is waited for");
        }
        if before.dead && (off || pressed) {
            assert!(session.spindle_rpm().abs() <= before.rpm + STANDS_MM, "{action}: the spindle does not speed up");
        }
        assert!(!session.is_stopped() || session.is_in_program(), "{action}: only a program is stopped");
        assert!(!session.is_held() || session.is_stopped(), "{action}: what is held is stopped");
        if session.is_stopped() && !session.is_moved_by_hand() {
            assert!(!session.is_driven(), "{action}: what is stopped stands");
        }
        let overrides = &session.configuration().control.station.overrides;
        let percents = session.percents();
        for (steps, percent) in overrides.iter().zip([percents.feed, percents.rapid, percents.spindle]) {
            assert!(steps.is_empty() || steps.contains(&percent), "{action}: an override has steps, {percent}");
        }
        let control = &session.configuration().control;
        for state in [session.interpreter().executing_state(), session.interpreter().read_state()] {
            for (group, &row) in state.groups.0.iter().enumerate().take(control.groups.len()) {
                let code = control.g_codes.get(usize::from(row));
                assert!(
                    code.is_some_and(|code| code.group == Some(group as u8)),
                    "{action}: group {group} is in force"
                );
            }
        }
        let selected = self.operator.panel().selected;
        let is_known = |name: &String| self.operator.programs().any(|known| known == name);
        assert!(selected.as_ref().is_none_or(is_known), "{action}: {selected:?} is selected and not in memory");
        let told = &self.events[before.events..];
        let is_code = |event: &Event| matches!(event.kind, EventKind::Code(_));
        assert!(!before.dead || !told.iter().any(is_code), "{action}: no code goes out, {told:?}");
    }

    /// What has been taken is remembered, to be found again.
    fn note(&mut self, action: &Action, waits: bool) {
        if !self.operator.session.is_moved_by_hand() {
            self.button = None;
        }
        let changes = matches!(action, Action::Edit(_) | Action::Load(..));
        let kept = self.operator.kept_programs();
        let now: Vec<_> = kept.map(|(key, _, source, head)| (key.to_owned(), source.0, head.offset)).collect();
        assert!(now == self.programs || changes, "{action}: programs are changed by edit and load alone");
        assert!(now == self.programs || !self.refused, "{action}: what is refused changes no program");
        self.programs = now;
        if self.refused {
            return;
        }
        match action {
            Action::Jog(axis, up, None) => self.button = Some((*axis, Some(*up))),
            Action::Home(axis) => self.button = Some((*axis, None)),
            _ => {}
        }
        let line = action.to_string();
        if let Some(cell) = words::cell_of(&line) {
            let shown = self.shows(cell);
            // It may wait until the axes stand, and be refused then.
            if waits {
                self.written.remove(cell);
            } else {
                if let Some((_, value)) = line.split_once(" = ").filter(|_| !line.starts_with("parameter")) {
                    let value = if value == "blank" { "Null" } else { value };
                    let value = value.parse::<f64>().map_or(value.to_owned(), |value| format!("Number({value:?})"));
                    assert!(shown.contains(&value), "{line}: {cell} shows {shown}");
                }
                self.written.insert(cell.to_owned(), shown);
            }
        }
    }

    /// Performs lines.
    pub fn script(&mut self, lines: &[&str]) {
        lines.iter().for_each(|line| self.perform(&read_action(line).expect(line)));
    }

    /// The letters of the axes.
    pub fn letters(&self) -> Vec<char> {
        self.operator.session.configuration().machine.axes.iter().map(|axis| char::from(axis.letter)).collect()
    }

    /// What a display shows.
    pub fn shows(&mut self, what: &str) -> String {
        self.operator.session.library_mut().again = 0;
        let Ok(Action::Show(show)) = read_action(&format!("show {what}")) else { panic!("{what}") };
        format!("{:?}", self.operator.display(&show))
    }

    /// All that survives power-off: cells by kind and name, programs by name.
    pub fn kept(&mut self) -> Kept {
        let configuration = self.operator.session.configuration().clone();
        let mut cells = Vec::new();
        self.operator.session.see_kept(&mut |cell, value| {
            let (kind, name) = cell.name(&configuration.control, &configuration.machine);
            cells.extend(cell.text(&configuration.control, value).map(|text| (kind, name, text)));
        });
        let texts = &self.operator.session.library().texts;
        let programs = self.operator.kept_programs();
        let programs = programs.map(|(key, _, source, _)| (key.to_owned(), texts[source.0 as usize].clone()));
        (cells, programs.collect())
    }

    /// What was acknowledged is there after power-off, and in a control that takes its memory up.
    pub fn loses_nothing(&mut self) {
        for (shown, value) in self.written.clone() {
            assert_eq!(self.shows(&shown), value, "{shown} was written");
        }
        let kept = self.kept();
        self.script(&["power-off", "power-on"]);
        assert_eq!(self.kept(), kept, "power-off takes nothing away");
        let mut again = Session::new(places::reopened(self.place, &kept.0), places::texts(self.place));
        let mut cells = Vec::new();
        let configuration = again.configuration().clone();
        again.see_kept(&mut |cell, value| {
            let (kind, name) = cell.name(&configuration.control, &configuration.machine);
            cells.extend(cell.text(&configuration.control, value).map(|text| (kind, name, text)));
        });
        assert_eq!(cells, kept.0, "a memory taken up again is the same");
    }
}
