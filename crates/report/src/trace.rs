//! Events as JSON Lines: one object a line, in the order of execution.

use base::{AxisSet, Diagnostic, Point, ProgramId};
use dialect::{Control, GroupCodes};
use machine::{Event, EventKind, ResetCause, Signal, StopCause};
use meaning::{CodeLine, CodeOut, Dwell, EndKind, Plane, SetValue, StopKind};

use crate::json::JsonLine;

/// What the trace needs to know beside the events.
pub struct Tracer<'c> {
    control: &'c Control,
    machine: String,
    axes: Vec<String>,
    /// The builder's lines.
    lines: Vec<String>,
    /// Every event carries its time.
    pub with_time: bool,
    /// The answers to codes are events too.
    pub with_io: bool,
    main: Option<ProgramId>,
}

/// The name of a group or code in `modal`, `end`, `reset`.
fn modal(control: &Control, groups: &GroupCodes, line: &mut JsonLine) {
    line.object("modal", |modal| modal_fields(control, groups, modal));
}

fn modal_fields(control: &Control, groups: &GroupCodes, line: &mut JsonLine) {
    for (index, group) in control.shown_groups() {
        line.text(&format!("{:02}", group.number), &control.g_name(groups.0[index]));
    }
}

fn code_letter(line: CodeLine) -> &'static str {
    match line {
        CodeLine::M => "m",
        CodeLine::S => "s",
        CodeLine::T => "t",
        CodeLine::B => "b",
    }
}

impl<'c> Tracer<'c> {
    /// A tracer for a control on a machine of this name with these axis letters, in the machine's order.
    pub fn new(control: &'c Control, machine: &str, letters: impl Iterator<Item = u8>) -> Tracer<'c> {
        let axes = letters.map(|letter| char::from(letter.to_ascii_lowercase()).to_string()).collect();
        let (machine, lines) = (machine.to_owned(), Vec::new());
        Tracer { control, machine, axes, lines, with_time: false, with_io: false, main: None }
    }

    /// The lines that the machine's builder has named, in his order.
    pub fn name_lines<'n>(&mut self, names: impl Iterator<Item = &'n str>) {
        self.lines = names.map(str::to_owned).collect();
    }

    /// Appends the event's line, if it has one. `name` gives programs their names, `diagnostic` says an alarm in words.
    pub fn write<'n>(
        &mut self,
        event: &Event,
        name: impl Fn(ProgramId) -> &'n str,
        diagnostic: Option<&Diagnostic>,
        out: &mut Vec<u8>,
    ) {
        let kind = match &event.kind {
            EventKind::BlockDone | EventKind::Waited(_) => return,
            EventKind::Finished(_) | EventKind::Signal(..) if !self.with_io => return,
            // A held axis has not moved.
            EventKind::Rapid { from, to, .. } | EventKind::Feed { from, to, .. } if from == to => return,
            kind => kind,
        };
        let mut line = JsonLine::begin(out);
        line.text("event", event_name(kind));
        self.place(event, &name, &mut line);
        self.fields(kind, &name, event, diagnostic, &mut line);
        if self.with_time || matches!(kind, EventKind::Signal(..)) {
            line.number("time", event.time.0);
        }
        line.end();
        out.push(b'\n');
    }

    fn place<'n>(&mut self, event: &Event, name: &impl Fn(ProgramId) -> &'n str, line: &mut JsonLine) {
        let place = &event.place;
        if matches!(event.kind, EventKind::Start(_)) {
            self.main = Some(place.program);
            return;
        }
        if matches!(event.kind, EventKind::Reset { .. }) || place.line == 0 {
            return;
        }
        if self.main != Some(place.program) {
            line.text("program", name(place.program));
        }
        line.integer("line", place.line);
        if place.sequence > 0 {
            line.integer("n", u64::from(place.sequence));
        }
    }

    fn fields<'n>(
        &self,
        kind: &EventKind,
        name: &impl Fn(ProgramId) -> &'n str,
        event: &Event,
        diagnostic: Option<&Diagnostic>,
        line: &mut JsonLine,
    ) {
        match kind {
            EventKind::Start(groups) => {
                line.text("control", &self.control.name).text("machine", &self.machine);
                line.text("program", name(event.place.program));
                modal(self.control, groups, line);
            }
            EventKind::Rapid { to, .. } => self.point("to", to, line),
            EventKind::Feed { to, feed, .. } => {
                self.point("to", to, line);
                line.number("f", *feed);
            }
            EventKind::Arc { arc, feed, .. } => {
                self.point("to", &arc.to, line);
                line.number("f", *feed);
                line.text("plane", plane_name(arc.plane));
                line.object("center", |center| {
                    for (axis, value) in arc.axes.iter().zip(arc.center) {
                        center.number(self.axis_name(usize::from(*axis)), value);
                    }
                });
                line.number("sweep", arc.sweep.to_degrees());
            }
            EventKind::Dwell(Dwell::Seconds(seconds)) => {
                line.number("seconds", *seconds);
            }
            EventKind::Dwell(Dwell::Revolutions { turns, .. }) => {
                line.number("revolutions", *turns);
            }
            EventKind::Code(code) => self.code(*code, line),
            EventKind::Signal(signal, on) => {
                line.text("name", &self.signal_name(*signal)).boolean("on", *on);
            }
            EventKind::Finished(code) => {
                line.text("for", code_letter(*code));
            }
            EventKind::Set(value) => self.set(value, line),
            EventKind::Stop(cause) => {
                line.text("kind", stop_name(*cause));
            }
            EventKind::Alarm(alarm) => {
                let column = (alarm.place.line > 0).then(|| alarm.place.column(alarm.span));
                alarm_fields(column, diagnostic, line);
            }
            EventKind::Reset { cause, groups } => {
                line.text("cause", cause_name(*cause));
                modal(self.control, groups, line);
            }
            EventKind::End { kind, rewind, reset, groups, to } => {
                line.text("kind", end_name(*kind)).boolean("rewind", *rewind).boolean("reset", *reset);
                modal(self.control, groups, line);
                self.point("to", to, line);
            }
            EventKind::BlockDone | EventKind::Waited(_) => {}
        }
    }

    /// What a line between control and machine is called.
    pub fn signal_name(&self, signal: Signal) -> String {
        let decoded = |code| self.control.m_code(code).and_then(|row| row.decoded.clone()).unwrap_or_default();
        let line = |line: u8| self.lines.get(usize::from(line)).cloned().unwrap_or_default();
        signal.name(decoded, |axis| self.axis_name(usize::from(axis)).to_ascii_uppercase(), line)
    }

    fn axis_name(&self, axis: usize) -> &str {
        self.axes.get(axis).map_or("?", String::as_str)
    }

    /// A point as an object of the machine's axes.
    fn point(&self, field: &str, point: &Point, line: &mut JsonLine) {
        let all = AxisSet(((1u16 << self.axes.len().min(8)) - 1) as u8);
        self.axes_object(field, point, all, line);
    }

    fn axes_object(&self, field: &str, point: &Point, axes: AxisSet, line: &mut JsonLine) {
        line.object(field, |object| {
            for axis in axes.iter() {
                object.number(self.axis_name(axis), point[axis]);
            }
        });
    }

    fn code(&self, code: CodeOut, line: &mut JsonLine) {
        line.integer("code", u64::from(code.code));
        let digits = usize::from(code.digits);
        line.text("bcd", &format!("{:0digits$}", code.code));
        if code.line == CodeLine::M
            && let Some(decoded) = self.control.m_code(code.code).and_then(|row| row.decoded.as_ref())
        {
            line.text("decoded", decoded);
        }
    }

    fn set(&self, value: &SetValue, line: &mut JsonLine) {
        match value {
            SetValue::Variable { number, value } => {
                line.text("what", &format!("variable {number}"));
                if value.is_nan() {
                    line.null("value");
                } else {
                    line.number("value", *value);
                }
            }
            SetValue::Offset { number, value } => {
                let column = if self.control.common_offsets { "" } else { "H" };
                line.text("what", &format!("offset {column}{number}"));
                line.number("value", *value);
            }
            SetValue::Radius { number, value } => {
                line.text("what", &format!("offset D{number}"));
                line.number("value", *value);
            }
            SetValue::Shift { code, axes, shift } => {
                let what = code
                    .map_or_else(|| "work external".to_owned(), |row| format!("shift {}", self.control.g_name(row)));
                line.text("what", &what);
                self.axes_object("value", shift, *axes, line);
            }
            SetValue::WorkOrigin { system, axes, origin } => {
                line.text("what", &format!("work {}", self.control.g_name(*system)));
                self.axes_object("value", origin, *axes, line);
            }
            SetValue::Universal { axes, shown } => {
                line.text("what", "universal");
                self.axes_object("value", shown, *axes, line);
            }
            SetValue::StrokeArea(area) => {
                line.text("what", "stroke area 2");
                line.object("value", |value| {
                    self.axes_object("low", &area.low, area.axes, value);
                    self.axes_object("high", &area.high, area.axes, value);
                    value.text("forbidden", if area.outside { "outside" } else { "inside" });
                });
            }
        }
    }

    /// Events of this program need not name it.
    pub(crate) fn set_main(&mut self, program: ProgramId) {
        self.main = Some(program);
    }

    /// The word by which an event is known.
    pub(crate) fn event_word(kind: &EventKind) -> &'static str {
        event_name(kind)
    }
}

fn alarm_fields(column: Option<u64>, diagnostic: Option<&Diagnostic>, line: &mut JsonLine) {
    if let Some(diagnostic) = diagnostic {
        if let Some(alarm) = &diagnostic.alarm {
            line.text("name", &alarm.name);
            if let Some(number) = alarm.number {
                line.integer("number", u64::from(number));
            }
        }
        if let Some(column) = column {
            line.integer("column", column);
        }
        line.text("text", &diagnostic.message);
    }
}

fn event_name(kind: &EventKind) -> &'static str {
    match kind {
        EventKind::Start(_) => "start",
        EventKind::Rapid { .. } => "rapid",
        EventKind::Feed { .. } => "feed",
        EventKind::Arc { .. } => "arc",
        EventKind::Dwell(_) => "dwell",
        EventKind::Code(code) => code_letter(code.line),
        EventKind::Finished(_) => "fin",
        EventKind::Signal(..) => "signal",
        EventKind::Set(_) => "set",
        EventKind::Stop(_) => "stop",
        EventKind::Alarm(_) => "alarm",
        EventKind::Reset { .. } => "reset",
        EventKind::End { .. } => "end",
        EventKind::BlockDone | EventKind::Waited(_) => "",
    }
}

fn plane_name(plane: Plane) -> &'static str {
    match plane {
        Plane::Xy => "xy",
        Plane::Zx => "zx",
        Plane::Yz => "yz",
    }
}

pub(crate) fn stop_name(cause: StopCause) -> &'static str {
    match cause {
        StopCause::FeedHold => "feed-hold",
        StopCause::Program(StopKind::Program) => "M00",
        StopCause::Program(StopKind::Optional) => "M01",
        StopCause::Program(StopKind::SingleBlock) => "single-block",
        StopCause::Program(StopKind::Cycle) => "cycle",
    }
}

/// The names of function keys.
const FUNCTION_KEYS: &[&str] = &["F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8", "F9", "F10", "F11", "F12"];

pub(crate) fn cause_name(cause: ResetCause) -> &'static str {
    match cause {
        ResetCause::Key => "reset-key",
        ResetCause::FunctionKey(number) => {
            FUNCTION_KEYS.get(usize::from(number).wrapping_sub(1)).copied().unwrap_or("key")
        }
        ResetCause::ProgramEnd => "program-end",
        ResetCause::EmergencyStop => "emergency-stop",
    }
}

/// The name of a program's end.
pub(crate) fn end_name(kind: EndKind) -> &'static str {
    match kind {
        EndKind::M02 => "M02",
        EndKind::M30 => "M30",
        EndKind::M99 => "M99",
        EndKind::Text => "text",
        EndKind::Loop => "loop",
    }
}
