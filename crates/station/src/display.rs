//! The panel's displays as values: what a script's `show` prints and a panel's pages draw.

mod alarms;
mod command;
mod diagnosis;
mod lists;

use base::{AXES, Point};
use dialect::{GroupCodes, MMeaning, Meaning};
use machine::Waiting;
use meaning::Corner;

use crate::action::Show;
use crate::library::Library;
use crate::memory::{self, WorkSystem};
use crate::operator::Operator;
use crate::session::Session;

/// A value of a display.
#[derive(Clone, PartialEq, Debug)]
pub enum Value {
    /// Nothing: a blank variable, a cell that there is not.
    Null,
    /// Yes or no.
    Truth(bool),
    /// A number: mm, degrees, mm/min, or as it is.
    Number(f64),
    /// A text.
    Text(String),
    /// One after the other.
    List(Vec<Value>),
    /// By their names, in this order.
    Object(Vec<(String, Value)>),
}

impl Value {
    /// An object of these fields.
    pub(crate) fn object<const N: usize>(fields: [(&str, Value); N]) -> Value {
        Value::Object(fields.map(|(name, value)| (name.to_owned(), value)).into())
    }

    /// An object of fields that are there or not.
    pub(crate) fn fields(fields: Vec<(&str, Value)>) -> Value {
        Value::Object(fields.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
    }

    fn text(text: &str) -> Value {
        Value::Text(text.to_owned())
    }

    fn number_or_null(number: Option<f64>) -> Value {
        number.map_or(Value::Null, Value::Number)
    }

    fn text_or_null(text: Option<&str>) -> Value {
        text.map_or(Value::Null, Value::text)
    }
}

impl<L: Library> Operator<L> {
    /// What a display shows now.
    ///
    /// # Errors
    /// The control has no such page.
    pub fn display(&mut self, show: &Show) -> Result<Value, String> {
        let control = &self.session.configuration().control;
        if let Some(display) = show.display().filter(|display| !control.station.shows(display)) {
            return Err(format!(
                "the {} has no page that shows {display}; `show displays` lists its pages",
                control.title
            ));
        }
        Ok(match show {
            Show::Modal => modal(&self.session, &self.session.interpreter().executing_state().groups),
            Show::Position => position(&self.session),
            Show::Machine => machine(&self.session),
            Show::Alarm => alarms::standing(&mut self.session),
            Show::Alarms => alarms::past(&self.session),
            Show::Offsets => lists::offsets(&self.session),
            Show::Works => lists::works(&self.session),
            Show::Parameters => lists::parameters(&mut self.session),
            Show::Variables => lists::variables(&self.session)?,
            Show::Directory => self.directory(),
            Show::Command => command::command(&mut self.session),
            Show::Diagnosis => diagnosis::diagnosis(&self.session),
            Show::Displays => lists::displays(&self.session),
            Show::Offset(column, number) => {
                let interpreter = self.session.interpreter();
                let value = memory::read_named_offset(interpreter.control(), interpreter.memory(), *column, *number);
                Value::number_or_null(value)
            }
            Show::Work(system) => work(&self.session, system)?,
            Show::Parameter(name, bit) => self.parameter(name, *bit),
            Show::Variable(number) => Value::number_or_null(self.session.interpreter().variable(*number)),
            Show::Feed => feed(&self.session),
            Show::Program => self.program(),
            Show::State => self.state(),
        })
    }

    fn parameter(&mut self, name: &str, bit: Option<u8>) -> Value {
        let interpreter = self.session.interpreter_mut();
        interpreter.store_codes();
        let value = interpreter.fitting().parameter_by_name(interpreter.control(), name);
        Value::number_or_null(value.and_then(|value| match bit {
            None => Some(value),
            Some(bit @ 0..8) => Some(f64::from(value as u8 >> bit & 1)),
            Some(_) => None,
        }))
    }

    fn program(&mut self) -> Value {
        let page = self.edit_page();
        let session = &self.session;
        let state = session.interpreter().executing_state();
        let typed = String::from_utf8_lossy(session.typed_blocks());
        let whole = |number: u32| Value::Number(f64::from(number));
        // A state of the control by the M code that commands it; a control without such codes shows nothing.
        let mode = |on: bool, codes: [MMeaning; 2]| {
            let row = session.configuration().control.m_of(codes[usize::from(on)]);
            row.map_or(Value::Null, |row| Value::Text(format!("M{:02}", row.code)))
        };
        let mut value = Value::object([
            ("name", Value::text_or_null(self.running_name())),
            ("line", Value::Number(session.place().line as f64)),
            ("f", Value::Number(state.feed.nanometres / 1e6)),
            ("s", whole(state.spindle)),
            ("t", whole(state.tool)),
            ("b", whole(state.index)),
            ("h", whole(state.h)),
            ("d", whole(state.d)),
            ("interrupt", mode(state.interrupt.is_some(), [MMeaning::InterruptOff, MMeaning::InterruptOn])),
            ("buffering", mode(state.buffering, [MMeaning::BufferingOff, MMeaning::BufferingOn])),
            ("mirror", mode(state.transform.is_mirror_on(), [MMeaning::MirrorOff, MMeaning::MirrorOn])),
            ("corner", mode(state.corner == Corner::Arc, [MMeaning::CornerIntersection, MMeaning::CornerArc])),
            ("label_skip", Value::Truth(session.label_skip())),
            ("typed", Value::List(typed.lines().map(Value::text).collect())),
            ("memory", Value::List(self.programs().map(Value::text).collect())),
        ]);
        if let Value::Object(fields) = &mut value {
            fields.extend(page.into_iter().flatten());
        }
        value
    }

    fn state(&self) -> Value {
        let session = &self.session;
        let alarm = session.alarm().map(|alarm| session.configuration().control.alarm_name(alarm).name);
        let waiting = if session.is_stopped() {
            Some("cycle-start".to_owned())
        } else if let Some(waiting) = session.waiting() {
            Some(self.awaited(&waiting))
        } else if session.waits_for_override() {
            Some(if session.waits_for_rapid() { "rapid-override" } else { "feed-override" }.to_owned())
        } else if session.goes_round() {
            Some("the end of an endless program".to_owned())
        } else {
            None
        };
        Value::object([
            ("mode", Value::text(&self.mode().name)),
            ("running", Value::Truth(session.is_running() && !session.is_stopped())),
            ("held", Value::Truth(session.is_held())),
            ("waiting_for", Value::text_or_null(waiting.as_deref())),
            ("alarm", Value::text_or_null(alarm.as_deref())),
            ("program", Value::text_or_null(self.running_name())),
            ("line", Value::Number(session.place().line as f64)),
        ])
    }

    /// What the control waits for at the machine, in words.
    fn awaited(&self, waiting: &Waiting) -> String {
        let state = if waiting.on { "FIN" } else { "FIN off" };
        let code = waiting.code.line.word(waiting.code.code);
        match self.session.logic_waiting(waiting) {
            Some(step) => format!("{state} after {code}: {step}"),
            None => format!("{state} after {code}"),
        }
    }

    /// The program in which the line being executed stands; the selected one while nothing is executed.
    fn running_name(&self) -> Option<&str> {
        let place = self.session.place();
        if place.line == 0 { self.program_name() } else { Some(self.session.interpreter().program_name(place.program)) }
    }

    fn program_name(&self) -> Option<&str> {
        let interpreter = self.session.interpreter();
        interpreter.main_program().map(|(program, _)| interpreter.program_name(program)).filter(|name| !name.is_empty())
    }
}

fn axes<L: Library>(session: &Session<L>, point: &Point) -> Value {
    let letters = session.configuration().machine.axes.iter().take(AXES).map(|axis| axis.letter.to_ascii_lowercase());
    Value::Object(letters.zip(point).map(|(letter, &at)| (char::from(letter).to_string(), Value::Number(at))).collect())
}

fn modal<L: Library>(session: &Session<L>, groups: &GroupCodes) -> Value {
    let control = &session.configuration().control;
    let shown = control.shown_groups();
    Value::Object(
        shown
            .map(|(index, group)| (format!("{:02}", group.number), Value::Text(control.g_name(groups.0[index]))))
            .collect(),
    )
}

fn position<L: Library>(session: &Session<L>) -> Value {
    Value::object([
        ("machine", axes(session, &session.position())),
        ("work", axes(session, &session.work_display())),
        ("universal", axes(session, &session.universal_display())),
        ("distance_to_go", axes(session, &session.distance_to_go())),
    ])
}

fn machine<L: Library>(session: &Session<L>) -> Value {
    let percents = session.percents();
    let percent = |percent: u16| Value::Number(f64::from(percent));
    let lines: Vec<_> = session.logic_lines().map(|(name, on)| (name.to_owned(), Value::Truth(on))).collect();
    let mut shown = vec![
        ("name", Value::text(&session.configuration().machine.name)),
        ("position", axes(session, &session.position())),
        ("reference", reference(session)),
        ("emergency_stop", Value::Truth(session.emergency_stop())),
        (
            "override",
            Value::object([
                ("feed", percent(percents.feed)),
                ("rapid", percent(percents.rapid)),
                ("spindle", percent(percents.spindle)),
            ]),
        ),
    ];
    if !lines.is_empty() {
        shown.push(("lines", Value::Object(lines)));
    }
    Value::fields(shown)
}

/// Which axes have been returned to their reference point.
fn reference<L: Library>(session: &Session<L>) -> Value {
    let established = session.interpreter().executing_state().reference.established;
    let axes = session.configuration().machine.axes.iter().take(AXES).enumerate();
    let letter = |letter: u8| char::from(letter.to_ascii_lowercase()).to_string();
    Value::Object(axes.map(|(index, axis)| (letter(axis.letter), Value::Truth(established.has(index)))).collect())
}

fn work<L: Library>(session: &Session<L>, system: &str) -> Result<Value, String> {
    let interpreter = session.interpreter();
    let memory = interpreter.memory();
    let found = memory::work_system(interpreter.control(), memory, system).map_err(|error| error.0)?;
    let origin = match found {
        WorkSystem::Stored(index) => memory.work.get(index).copied().unwrap_or([0.0; AXES]),
        WorkSystem::External => memory.external,
        WorkSystem::Base => interpreter.executing_state().base_origin,
    };
    Ok(axes(session, &origin.map(|counts| counts / 1e6)))
}

fn feed<L: Library>(session: &Session<L>) -> Value {
    let interpreter = session.interpreter();
    let state = interpreter.executing_state();
    let control = interpreter.control();
    let commanded = state.feed.nanometres / 1e6;
    let per_revolution = control.in_force(&state.groups, control.roles.feed_mode) == Some(Meaning::FeedPerRevolution);
    let mm_per_min = if per_revolution { commanded * f64::from(state.spindle) } else { commanded };
    let feed = meaning::Feed { mm_per_min, exact_stop: false, tapping: false, per_revolution, way_mm: 0.0 };
    let moves = session.is_running() && !session.is_stopped();
    let actual = match session.setpoint() {
        Some(setpoint) => setpoint.speed() * 60.0,
        None if moves => session.overrides().actual(&feed),
        None => 0.0,
    };
    Value::object([
        ("f", Value::Number(commanded)),
        ("override", Value::Number(f64::from(session.percents().feed))),
        ("actual", Value::Number(actual)),
    ])
}
