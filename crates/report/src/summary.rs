//! What a run came to: end, cycle time, path, travel, tools, alarms.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use base::{AXES, Point};
use machine::{Event, EventKind};
use meaning::{CodeLine, EndKind};

use crate::json::JsonLine;
use crate::trace::end_name;

/// Times of one tool, seconds.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct ToolTime {
    cutting: f64,
    total: f64,
}

/// A summary, added up event by event.
#[derive(Clone, PartialEq, Debug)]
pub struct Summary {
    control: String,
    machine: String,
    program: String,
    pub(crate) axes: Vec<char>,
    end: Option<EndKind>,
    pub(crate) cutting: f64,
    pub(crate) rapid: f64,
    pub(crate) dwell: f64,
    pub(crate) waiting: f64,
    pub(crate) cutting_mm: f64,
    pub(crate) rapid_mm: f64,
    low: Point,
    high: Point,
    moved: bool,
    tool: u32,
    tools: BTreeMap<u32, ToolTime>,
    blocks: u64,
    pub(crate) moves: u64,
    alarms: Vec<String>,
    pub(crate) alarm_count: u64,
    last_time: f64,
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
            cutting: 0.0,
            rapid: 0.0,
            dwell: 0.0,
            waiting: 0.0,
            cutting_mm: 0.0,
            rapid_mm: 0.0,
            low: [f64::INFINITY; AXES],
            high: [f64::NEG_INFINITY; AXES],
            moved: false,
            tool: 0,
            tools: BTreeMap::new(),
            blocks: 0,
            moves: 0,
            alarms: Vec::new(),
            alarm_count: 0,
            last_time: 0.0,
        }
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
        let mut cutting = 0.0;
        match &event.kind {
            EventKind::Rapid { from, to, duration, length, .. } => {
                self.moves += 1;
                self.rapid += duration.0;
                self.rapid_mm += length;
                self.see(from);
                self.see(to);
            }
            EventKind::Feed { from, to, duration, length, .. } => {
                self.moves += 1;
                cutting = duration.0;
                self.cutting_mm += length;
                self.see(from);
                self.see(to);
            }
            EventKind::Arc { arc, duration, length, .. } => {
                self.moves += 1;
                cutting = duration.0;
                self.cutting_mm += length;
                let (low, high) = arc.extent();
                self.see(&low);
                self.see(&high);
            }
            EventKind::Dwell(dwell) => self.dwell += dwell.seconds(),
            EventKind::Waited(duration) => self.waiting += duration.0,
            EventKind::End { kind, .. } => self.end = Some(*kind),
            EventKind::BlockDone if event.place.block.len > 0 => self.blocks += 1,
            _ => {}
        }
        self.cutting += cutting;
        self.moved |= self.moves > 0;
        let time = self.tools.entry(self.tool).or_default();
        time.cutting += cutting;
        time.total += event.time.0 - self.last_time;
        self.last_time = event.time.0;
        if let EventKind::Code(code) = &event.kind
            && code.line == CodeLine::T
        {
            self.tool = code.code;
        }
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
        self.cutting + self.rapid + self.dwell + self.waiting
    }

    /// The summary as one JSON object.
    pub fn json(&self) -> String {
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
            time.number("total", self.total()).number("cutting", self.cutting).number("rapid", self.rapid);
            time.number("dwell", self.dwell).number("waiting", self.waiting);
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
        let tools = line.field("tools");
        tools.push(b'[');
        for (index, (tool, time)) in self.used_tools().enumerate() {
            if index > 0 {
                tools.push(b',');
            }
            let mut object = JsonLine::begin(tools);
            object.integer("t", u64::from(*tool)).number("cutting", time.cutting).number("total", time.total);
            object.end();
        }
        tools.push(b']');
        line.integer("blocks", self.blocks).integer("moves", self.moves);
        line.field("alarms").extend_from_slice(format!("[{}]", self.alarms.join(",")).as_bytes());
        line.end();
        String::from_utf8_lossy(&out).into_owned()
    }

    fn used_tools(&self) -> impl Iterator<Item = (&u32, &ToolTime)> {
        self.tools.iter().filter(|(_, time)| time.total > 0.0)
    }

    /// The summary for people.
    pub fn text(&self) -> String {
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
            clock(self.cutting),
            clock(self.rapid),
            clock(self.dwell),
            clock(self.waiting)
        );
        for (tool, time) in self.used_tools() {
            let name = if *tool == 0 { "before the first T".to_owned() } else { format!("T{tool:02}") };
            let _ = writeln!(out, "    {name:<20} {}   cutting {}", clock(time.total), clock(time.cutting));
        }
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
        if self.alarm_count > 0 {
            let _ = writeln!(out, "  alarms       {}", self.alarm_count);
        }
        out
    }
}

/// A length with at most three decimals.
pub(crate) fn short(value: f64) -> String {
    let mut out = Vec::new();
    crate::push_number(&mut out, (value * 1000.0).round() / 1000.0);
    String::from_utf8_lossy(&out).into_owned()
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
