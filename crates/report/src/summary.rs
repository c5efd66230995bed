//! What a run came to: end, cycle time, path, travel, tools, alarms.

use std::fmt::Write as _;

use base::{AXES, Point};
use machine::{Event, EventKind};
use meaning::{CodeLine, EndKind};

use crate::cycle_time::{Ledgers, Operation, Split};
use crate::json::JsonLine;
use crate::losses::{Cause, Loss, why_json};
use crate::trace::end_name;

/// A summary, added up event by event.
#[derive(Clone, PartialEq, Debug)]
pub struct Summary {
    control: String,
    machine: String,
    program: String,
    pub(crate) axes: Vec<char>,
    end: Option<EndKind>,
    pub(crate) times: Split,
    pub(crate) ledgers: Ledgers,
    /// The run plans ahead and its operations are named: they are told.
    whole: bool,
    pub(crate) cutting_mm: f64,
    pub(crate) rapid_mm: f64,
    low: Point,
    high: Point,
    moved: bool,
    blocks: u64,
    pub(crate) moves: u64,
    alarms: Vec<String>,
    pub(crate) alarm_count: u64,
}

/// Alarms listed by name in a summary; more are counted.
const LISTED_ALARMS: usize = 100;

impl Summary {
    /// A summary of nothing yet.
    pub fn new(control: &str, machine: &str, axes: impl Iterator<Item = u8>) -> Summary {
        Summary {
            control: control.to_owned(),
            machine: machine.to_owned(),
            program: String::new(),
            axes: axes.map(char::from).collect(),
            end: None,
            times: Split::default(),
            ledgers: Ledgers::default(),
            whole: false,
            cutting_mm: 0.0,
            rapid_mm: 0.0,
            low: [f64::INFINITY; AXES],
            high: [f64::NEG_INFINITY; AXES],
            moved: false,
            blocks: 0,
            moves: 0,
            alarms: Vec::new(),
            alarm_count: 0,
        }
    }

    /// The run plans ahead, and its operations are watched: what is lost and how long each one lasts is told as well.
    pub fn tell_whole(&mut self) {
        self.whole = true;
    }

    /// The program's name.
    pub fn set_program(&mut self, name: &str) {
        name.clone_into(&mut self.program);
    }

    /// Blocks executed so far.
    pub fn blocks(&self) -> u64 {
        self.blocks
    }

    /// An alarm, as JSON and for counting.
    pub fn add_alarm(&mut self, json: String) {
        self.alarm_count += 1;
        if self.alarms.len() < LISTED_ALARMS {
            self.alarms.push(json);
        }
    }

    fn see(&mut self, point: &Point) {
        for (axis, &at) in point.iter().enumerate() {
            self.low[axis] = self.low[axis].min(at);
            self.high[axis] = self.high[axis].max(at);
        }
    }

    /// Takes an event in.
    pub fn add(&mut self, event: &Event) {
        let split = Split::of(event);
        match &event.kind {
            EventKind::Rapid { from, to, length, .. } => {
                self.moves += 1;
                self.rapid_mm += length;
                self.see(from);
                self.see(to);
            }
            EventKind::Feed { from, to, length, .. } => {
                self.moves += 1;
                self.cutting_mm += length;
                self.see(from);
                self.see(to);
            }
            EventKind::Arc { arc, length, .. } => {
                self.moves += 1;
                self.cutting_mm += length;
                let (low, high) = arc.extent();
                self.see(&low);
                self.see(&high);
            }
            EventKind::Dwell(_) | EventKind::Waited(_) | EventKind::Signal(..) => {}
            EventKind::End { kind, .. } => return self.end = Some(*kind),
            EventKind::BlockDone => return self.blocks += u64::from(event.place.block.len > 0),
            EventKind::Code(code) if code.line == CodeLine::T => return self.ledgers.call(code.code),
            EventKind::Code(code) if code.line == CodeLine::M => return self.ledgers.machine_code(code.code),
            _ => return,
        }
        self.moved |= self.moves > 0;
        self.times += split;
        self.ledgers.add(split);
    }

    /// The name of the main program.
    pub(crate) fn program(&self) -> &str {
        &self.program
    }

    /// How it ended, in a word.
    pub(crate) fn end_word(&self) -> &'static str {
        match (self.end, self.alarm_count) {
            (Some(kind), _) => end_name(kind),
            (None, 0) => "-",
            (None, _) => "alarm",
        }
    }

    /// The travel along an axis: lowest and highest.
    pub(crate) fn extent(&self, letter: char) -> Option<[f64; 2]> {
        let axis = self.axes.iter().position(|&axis| axis == letter)?;
        self.moved.then(|| [self.low[axis], self.high[axis]])
    }

    pub(crate) fn total(&self) -> f64 {
        self.times.total()
    }

    /// The summary as one JSON object.
    pub fn json(&self) -> String {
        self.json_and(|_| {})
    }

    /// The same with the blocks that lose most, and what is lost by each cause.
    pub fn json_with_losses(&self, worst: &[Loss], by_cause: &[(Cause, f64)]) -> String {
        self.json_and(|line| why_json(worst, by_cause, line))
    }

    fn json_and(&self, further: impl FnOnce(&mut JsonLine)) -> String {
        let mut out = Vec::new();
        let mut line = JsonLine::begin(&mut out);
        line.text("control", &self.control).text("machine", &self.machine).text("program", &self.program);
        match self.end {
            Some(kind) => line.text("end", end_name(kind)),
            None => {
                line.field("end").extend_from_slice(b"null");
                &mut line
            }
        };
        line.object("cycle_time", |time| {
            time.number("total", self.total()).number("cutting", self.times.cutting).number("rapid", self.times.rapid);
            time.number("dwell", self.times.dwell).number("waiting", self.times.waiting);
            if self.whole {
                time.number("acceleration", self.times.lost());
            }
        });
        line.object("path_length", |path| {
            path.number("cutting", self.cutting_mm).number("rapid", self.rapid_mm);
        });
        line.object("extents", |extents| {
            for (axis, letter) in self.axes.iter().enumerate().filter(|_| self.moved) {
                let out = extents.field(&letter.to_ascii_lowercase().to_string());
                out.push(b'[');
                crate::push_number(out, self.low[axis]);
                out.push(b',');
                crate::push_number(out, self.high[axis]);
                out.push(b']');
            }
        });
        line.list("tools", &self.used_tools(), |(tool, time), item| {
            item.object("", |object| {
                object.integer("t", u64::from(*tool)).number("cutting", time.cutting).number("total", time.total());
                if self.whole {
                    rest_of_split(time, object);
                }
            });
        });
        if self.whole {
            self.operations_json(&mut line);
        }
        line.integer("blocks", self.blocks).integer("moves", self.moves);
        line.field("alarms").extend_from_slice(format!("[{}]", self.alarms.join(",")).as_bytes());
        further(&mut line);
        line.end();
        String::from_utf8_lossy(&out).into_owned()
    }

    fn operations_json(&self, line: &mut JsonLine) {
        line.list("operations", &self.operations(), |operation, item| {
            item.object("", |object| {
                object.integer("t", u64::from(operation.tool)).text("name", &operation.name);
                object.text("program", &operation.program).integer("line", operation.line);
                let time = &operation.split;
                object.integer("times", operation.times).number("cutting", time.cutting).number("total", time.total());
                rest_of_split(time, object);
            });
        });
    }

    /// The tools that take time, by their numbers.
    pub(crate) fn used_tools(&self) -> Vec<(u32, Split)> {
        let mut tools = self.ledgers.own().tools.clone();
        tools.retain(|(_, time)| time.total() > 0.0);
        tools.sort_by_key(|(tool, _)| *tool);
        tools
    }

    /// The operations, in the order of their first beginning.
    pub(crate) fn operations(&self) -> Vec<Operation> {
        self.ledgers.own().operations()
    }

    /// A tool's name.
    pub(crate) fn tool_name(&self, tool: u32) -> String {
        if tool == 0 { format!("before the first {}", self.ledgers.custom()) } else { format!("T{tool:02}") }
    }

    /// The summary for people.
    pub fn text(&self) -> String {
        let mut out = self.head();
        for (tool, time) in self.used_tools() {
            let name = self.tool_name(tool);
            let _ = writeln!(out, "    {name:<20} {}   cutting {}", clock(time.total()), clock(time.cutting));
        }
        out.push_str(&self.path());
        out
    }

    /// How it ended, and the cycle time.
    pub(crate) fn head(&self) -> String {
        let mut out = String::new();
        let end = match (self.end, self.alarm_count) {
            (Some(EndKind::Text), _) => "ended with its text, without M02 or M30".to_owned(),
            (Some(EndKind::Loop), _) => "never ends: it goes round for ever with nothing changed".to_owned(),
            (Some(kind), _) => format!("ended with {}", end_name(kind)),
            (None, 0) => "stopped".to_owned(),
            (None, _) => "stopped by an alarm".to_owned(),
        };
        let _ = writeln!(out, "{}  {end}  ({}, {})", self.program, self.control, self.machine);
        let _ = writeln!(
            out,
            "  cycle time   {}   cutting {} · rapid {} · dwell {} · waiting for FIN {}",
            clock(self.total()),
            clock(self.times.cutting),
            clock(self.times.rapid),
            clock(self.times.dwell),
            clock(self.times.waiting)
        );
        let (lost, times) = (self.times.lost(), &self.times);
        let [lost, cutting, rapid] = [lost, times.lost_cutting, times.lost_rapid].map(period);
        let _ =
            writeln!(out, "    of that    {lost} lost to acceleration and limits: cutting {cutting}, rapid {rapid}");
        out
    }

    /// Path, travel, blocks and alarms.
    pub(crate) fn path(&self) -> String {
        let mut out = String::new();
        let _ = writeln!(out, "  path         {:.1} mm cutting, {:.1} mm rapid", self.cutting_mm, self.rapid_mm);
        if self.moved {
            let extents: Vec<_> = self
                .axes
                .iter()
                .enumerate()
                .map(|(axis, letter)| format!("{letter} {} … {}", short(self.low[axis]), short(self.high[axis])))
                .collect();
            let _ = writeln!(out, "  travel       {}", extents.join("   "));
        }
        let _ = writeln!(out, "  blocks       {} in {} moves", self.blocks, self.moves);
        out.push_str(&self.alarm_line());
        out
    }

    /// How many alarms, if there are any.
    pub(crate) fn alarm_line(&self) -> String {
        if self.alarm_count > 0 { format!("  alarms       {}\n", self.alarm_count) } else { String::new() }
    }
}

/// Behind `cutting` and `total`, what else a split says.
fn rest_of_split(time: &Split, object: &mut JsonLine) {
    object.number("rapid", time.rapid).number("dwell", time.dwell).number("waiting", time.waiting);
    object.number("acceleration", time.lost());
}

/// A length with at most three decimals.
pub(crate) fn short(value: f64) -> String {
    let mut out = Vec::new();
    crate::push_number(&mut out, (value * 1000.0).round() / 1000.0);
    String::from_utf8_lossy(&out).into_owned()
}

/// Seconds, to the millisecond where they are few.
pub(crate) fn period(seconds: f64) -> String {
    if seconds < 9.9995 { format!("{seconds:.3} s") } else { clock(seconds) }
}

/// Seconds in a column: `0.12`, `12.3`, `1:02.3`, `1:02:03`.
pub(crate) fn ticks(seconds: f64) -> String {
    if seconds < 0.95 {
        return format!("{seconds:.2}");
    }
    let text = clock(seconds);
    text.trim_end_matches(|character: char| character.is_alphabetic() || character == ' ').to_owned()
}

/// Seconds as minutes and seconds, or hours.
pub(crate) fn clock(seconds: f64) -> String {
    let tenths = (seconds * 10.0).round() as u64;
    let (minutes, rest) = (tenths / 600, tenths % 600);
    if minutes >= 60 {
        format!("{}:{:02}:{:02} h", minutes / 60, minutes % 60, rest / 10)
    } else if minutes > 0 {
        format!("{minutes}:{:02}.{} min", rest / 10, rest % 10)
    } else {
        format!("{}.{} s", rest / 10, rest % 10)
    }
}
