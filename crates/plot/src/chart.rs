//! The chart as the caller sees it: speeds and velocities over time go in, a picture comes out.
//!
//! However long the program is, memory is bounded: see [`Trace`] and [`Spans`].

use crate::chart_sheet::chart_sheet;
use crate::drawing::Title;
use crate::stroke::Kind;
use crate::trace::{Spans, Trace};

/// An axis of a chart.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct ChartAxis {
    /// Its letter.
    pub letter: char,
    /// It turns: its velocity is in degrees/min.
    pub turns: bool,
}

/// An axis with what it did.
#[derive(Clone, Debug)]
pub(crate) struct AxisTrace {
    pub axis: ChartAxis,
    /// mm/min or degrees/min.
    pub velocity: Trace,
}

/// Speed along the path and the velocity of every axis over time, being drawn.
#[derive(Clone, Debug)]
pub struct Chart {
    pub(crate) title: Title,
    /// Speed along the path, mm/min: of cuts and of rapids, each zero during the other.
    pub(crate) cutting: Trace,
    pub(crate) rapid: Trace,
    pub(crate) axes: Vec<AxisTrace>,
    /// The feed that is commanded, and what the axes' limits leave of it where that is less; mm/min.
    pub(crate) commanded: Spans<f64>,
    pub(crate) allowed: Spans<f64>,
    /// The line of each block; of several, the first one's.
    pub(crate) blocks: Spans<u64>,
    /// The end of what has come in, s, and what of it was spent in cuts and in rapids.
    pub(crate) seconds: f64,
    pub(crate) cutting_s: f64,
    pub(crate) rapid_s: f64,
}

impl Chart {
    /// An empty chart.
    pub fn new(title: Title, axes: impl Iterator<Item = ChartAxis>) -> Chart {
        Chart {
            title,
            cutting: Trace::new(),
            rapid: Trace::new(),
            axes: axes.map(|axis| AxisTrace { axis, velocity: Trace::new() }).collect(),
            commanded: Spans::new(),
            allowed: Spans::new(),
            blocks: Spans::new(),
            seconds: 0.0,
            cutting_s: 0.0,
            rapid_s: 0.0,
        }
    }

    /// The program's name, as soon as it is known.
    pub fn name(&mut self, program: &str) {
        program.clone_into(&mut self.title.program);
    }

    /// Up to this time, s, a block of this line is executed.
    pub fn block(&mut self, line: u64, until: f64) {
        self.blocks.push([self.blocks.end(), until], line, |first, _| *first);
        self.seconds = self.seconds.max(until);
    }

    /// A move begins and ends at these times, s.
    pub fn begin(&mut self, kind: Kind, [from, to]: [f64; 2]) {
        *if kind == Kind::Rapid { &mut self.rapid_s } else { &mut self.cutting_s } += to - from;
        let end = self.cutting.end();
        if end + NO_TIME < from {
            // The axes have stood.
            for trace in self.traces() {
                trace.push(end, 0.0);
                trace.push(from, 0.0);
            }
        }
    }

    /// During a cut this feed is commanded, mm/min.
    pub fn commanded(&mut self, during: [f64; 2], feed: f64) {
        self.commanded.push(during, feed, |one, other| one.max(*other));
    }

    /// During a part of a cut at this feed the axes' limits allow so much, mm/min.
    pub fn allowed(&mut self, during: [f64; 2], feed: f64, allowed: f64) {
        if allowed < feed * HARDLY_LESS {
            self.allowed.push(during, allowed, |one, other| one.min(*other));
        }
    }

    /// At this time, s, the axes move: how fast along the path, mm/min, and each of them.
    pub fn moves(&mut self, kind: Kind, at: f64, speed: f64, velocities: &[f64]) {
        let (cut, rapid) = if kind == Kind::Rapid { (0.0, speed) } else { (speed, 0.0) };
        self.cutting.push(at, cut);
        self.rapid.push(at, rapid);
        for (axis, velocity) in self.axes.iter_mut().zip(velocities) {
            axis.velocity.push(at, *velocity);
        }
    }

    /// The chart as SVG: well-formed, the same bytes for the same input.
    pub fn svg(&self) -> String {
        let mut whole = self.clone();
        whole.begin(Kind::Feed, [whole.seconds; 2]);
        chart_sheet(&whole)
    }

    fn traces(&mut self) -> impl Iterator<Item = &mut Trace> {
        [&mut self.cutting, &mut self.rapid].into_iter().chain(self.axes.iter_mut().map(|axis| &mut axis.velocity))
    }
}

/// Moves that are no farther apart than this follow each other, s: times are sums.
const NO_TIME: f64 = 1e-7;
/// What is above this part of a feed is the same.
const HARDLY_LESS: f64 = 0.999;
