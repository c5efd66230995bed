//! When two events are the same at the machine: axes go to the same places in the same way, the same codes go out.
//!
//! Axes are told apart by their letters; one that only one of the machines has must stand still. Times are no
//! difference: they are summed up. What a program writes must be the same where it outlives the program.

use base::{AXES, Point};
use dialect::Control;
use machine::{Event, EventKind, MachineAxis};
use meaning::{Dwell, SetValue};

use crate::explain::set_text;
use crate::trace::{end_name, stop_name};

/// What writing a number with six decimals may add to it.
const WRITING: f64 = 1e-6;
/// Feeds that differ by less, mm/min or of the whole, are one.
const FEED: f64 = 1e-6;
/// Dwells that differ by less are one, s or turns.
const DWELL: f64 = 1e-6;

/// One of the two runs.
#[derive(Clone, Copy)]
pub struct Side<'c> {
    /// Its control.
    pub control: &'c Control,
    /// Its machine's axes.
    pub axes: &'c [MachineAxis],
}

/// What is compared with what.
pub struct Likeness<'c> {
    sides: [Side<'c>; 2],
    /// The axes of both machines, by their indices there.
    common: Vec<[usize; 2]>,
    /// The axes of one machine alone.
    own: [Vec<usize>; 2],
    /// How far places may lie apart, mm and degrees.
    tolerance: f64,
}

/// True for what somebody at the machine would see.
pub fn is_seen(event: &Event) -> bool {
    match &event.kind {
        EventKind::Rapid { from, to, .. } | EventKind::Feed { from, to, .. } => from != to,
        EventKind::Arc { .. }
        | EventKind::Dwell(_)
        | EventKind::Code(_)
        | EventKind::Stop(_)
        | EventKind::Alarm(_)
        | EventKind::End { .. } => true,
        EventKind::Set(value) => !matches!(value, SetValue::Variable { .. } | SetValue::Universal { .. }),
        _ => false,
    }
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance + WRITING
}

fn same_feed(a: f64, b: f64) -> bool {
    a == b || (a - b).abs() <= FEED * a.abs().max(1.0)
}

impl<'c> Likeness<'c> {
    /// Two machines' axes found to each other.
    pub fn new(sides: [Side<'c>; 2], tolerance: f64) -> Likeness<'c> {
        let index_of = |side: usize, letter: u8| sides[side].axes.iter().position(|axis| axis.letter == letter);
        let mut likeness = Likeness { sides, common: Vec::new(), own: [Vec::new(), Vec::new()], tolerance };
        for (index, axis) in sides[0].axes.iter().enumerate().take(AXES) {
            match index_of(1, axis.letter) {
                Some(other) => likeness.common.push([index, other]),
                None => likeness.own[0].push(index),
            }
        }
        let alone = |(index, axis): (usize, &MachineAxis)| index_of(0, axis.letter).is_none().then_some(index);
        likeness.own[1] = sides[1].axes.iter().enumerate().take(AXES).filter_map(alone).collect();
        likeness
    }

    fn letter(&self, side: usize, axis: usize) -> u8 {
        self.sides[side].axes.get(axis).map_or(0, |axis| axis.letter)
    }

    /// True if both are the same at the machine.
    pub fn same(&self, a: &Event, b: &Event) -> bool {
        match (&a.kind, &b.kind) {
            (EventKind::Rapid { from, to, .. }, EventKind::Rapid { from: other_from, to: other, .. }) => {
                self.same_ends([from, other_from], [to, other])
            }
            (
                EventKind::Feed { from, to, feed, .. },
                EventKind::Feed { from: other_from, to: other, feed: other_feed, .. },
            ) => same_feed(*feed, *other_feed) && self.same_ends([from, other_from], [to, other]),
            (EventKind::Arc { arc, feed, .. }, EventKind::Arc { arc: other, feed: other_feed, .. }) => {
                same_feed(*feed, *other_feed)
                    && arc.plane == other.plane
                    && self.same_ends([&arc.from, &other.from], [&arc.to, &other.to])
                    && (0..2).all(|axis| near(arc.center[axis], other.center[axis], self.tolerance))
                    && self.same_sweep(arc.sweep, other.sweep, arc.radius[0].max(arc.radius[1]))
            }
            (EventKind::Dwell(a), EventKind::Dwell(b)) => same_dwell(*a, *b),
            (EventKind::Code(a), EventKind::Code(b)) => (a.line, a.code) == (b.line, b.code),
            (EventKind::Stop(a), EventKind::Stop(b)) => a == b,
            (EventKind::End { kind, .. }, EventKind::End { kind: other, .. }) => kind == other,
            (EventKind::Alarm(a), EventKind::Alarm(b)) => {
                let letter = |side, axis: Option<u8>| axis.map(|axis| self.letter(side, usize::from(axis)));
                a.condition == b.condition && letter(0, a.axis) == letter(1, b.axis)
            }
            (EventKind::Set(a), EventKind::Set(b)) => self.written(0, *a) == self.written(1, *b),
            _ => false,
        }
    }

    fn same_ends(&self, from: [&Point; 2], to: [&Point; 2]) -> bool {
        self.common.iter().all(|axes| near(to[0][axes[0]], to[1][axes[1]], self.tolerance))
            && [0, 1].into_iter().all(|side| self.own[side].iter().all(|&axis| from[side][axis] == to[side][axis]))
    }

    /// The ends agree, so sweeps differ by nothing or by turns; a flat arc's small angles by rounding.
    fn same_sweep(&self, a: f64, b: f64, radius: f64) -> bool {
        a.is_sign_positive() == b.is_sign_positive() && (a - b).abs() * radius <= 4.0 * (self.tolerance + WRITING)
    }

    /// What a program wrote, as the trace has it.
    fn written(&self, side: usize, value: SetValue) -> String {
        set_text(self.sides[side].control, self.sides[side].axes, value)
    }

    /// In what two events differ, each with what stands on either side.
    pub fn parts(&self, a: &Event, b: &Event) -> Vec<(String, String, String)> {
        let mut parts = Vec::new();
        let mut part = |name: &str, a: String, b: String| {
            if a != b {
                parts.push((name.to_owned(), a, b));
            }
        };
        if let (Some(ends), Some(other)) = (ends_of(&a.kind), ends_of(&b.kind)) {
            part("kind of move", kind_of(&a.kind), kind_of(&b.kind));
            for axes in &self.common {
                if !near(ends.1[axes[0]], other.1[axes[1]], self.tolerance) {
                    let letter = char::from(self.letter(0, axes[0])).to_string();
                    part(&letter, number(ends.1[axes[0]]), number(other.1[axes[1]]));
                }
            }
            for (side, ends) in [ends, other].into_iter().enumerate() {
                for &axis in self.own[side].iter().filter(|&&axis| ends.0[axis] != ends.1[axis]) {
                    let (at, none) = (number(ends.1[axis]), "no such axis".to_owned());
                    let (one, two) = if side == 0 { (at, none) } else { (none, at) };
                    part(&char::from(self.letter(side, axis)).to_string(), one, two);
                }
            }
            if let (Some(feed), Some(other)) = (feed_of(&a.kind), feed_of(&b.kind))
                && !same_feed(feed, other)
            {
                part("F", number(feed), number(other));
            }
            if let (EventKind::Arc { arc, .. }, EventKind::Arc { arc: other, .. }) = (&a.kind, &b.kind) {
                part("plane", plane(arc.plane), plane(other.plane));
                let near = (0..2).all(|axis| near(arc.center[axis], other.center[axis], self.tolerance));
                if !near {
                    part("centre", centre(arc.center), centre(other.center));
                }
                if !self.same_sweep(arc.sweep, other.sweep, arc.radius[0].max(arc.radius[1])) {
                    part("sweep", number(arc.sweep.to_degrees()), number(other.sweep.to_degrees()));
                }
            }
        } else {
            part("event", self.in_words(0, &a.kind), self.in_words(1, &b.kind));
        }
        parts
    }

    /// What happens, in so few words that two of them can stand side by side.
    fn in_words(&self, side: usize, kind: &EventKind) -> String {
        match kind {
            EventKind::Dwell(Dwell::Seconds(seconds)) => format!("dwell {} s", number(*seconds)),
            EventKind::Dwell(Dwell::Revolutions { turns, .. }) => format!("dwell {} turns", number(*turns)),
            EventKind::Code(code) => code.line.word(code.code),
            EventKind::Stop(cause) => format!("stop {}", stop_name(*cause)),
            EventKind::End { kind, .. } => format!("end {}", end_name(*kind)),
            EventKind::Alarm(alarm) => format!("alarm {}", self.sides[side].control.alarm_name(alarm).name),
            EventKind::Set(value) => self.written(side, *value),
            _ => kind_of(kind),
        }
    }
}

fn same_dwell(a: Dwell, b: Dwell) -> bool {
    match (a, b) {
        (Dwell::Seconds(a), Dwell::Seconds(b)) => near(a, b, DWELL),
        (Dwell::Revolutions { turns: a, .. }, Dwell::Revolutions { turns: b, .. }) => near(a, b, DWELL),
        _ => false,
    }
}

fn ends_of(kind: &EventKind) -> Option<(&Point, &Point)> {
    match kind {
        EventKind::Rapid { from, to, .. } | EventKind::Feed { from, to, .. } => Some((from, to)),
        EventKind::Arc { arc, .. } => Some((&arc.from, &arc.to)),
        _ => None,
    }
}

fn feed_of(kind: &EventKind) -> Option<f64> {
    match kind {
        EventKind::Feed { feed, .. } | EventKind::Arc { feed, .. } => Some(*feed),
        _ => None,
    }
}

fn kind_of(kind: &EventKind) -> String {
    match kind {
        EventKind::Rapid { .. } => "rapid",
        EventKind::Feed { .. } => "cut",
        EventKind::Arc { .. } => "arc",
        _ => "",
    }
    .to_owned()
}

fn plane(plane: meaning::Plane) -> String {
    plane.letters().map(char::from).iter().collect()
}

fn centre(center: [f64; 2]) -> String {
    format!("{}, {}", number(center[0]), number(center[1]))
}

/// A number as the trace has it.
fn number(value: f64) -> String {
    let mut out = Vec::new();
    crate::push_number(&mut out, value);
    String::from_utf8_lossy(&out).into_owned()
}
