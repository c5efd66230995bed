//! The path as it is driven: coloured by its speed, or beside the programmed one.

use machine::EventKind;
use plot::{Drawing, Kind, Stroke};
use station::Session;

use super::strokes::Strokes;
use crate::arguments::LayerArgument;
use crate::texts::Texts;

/// How close chords are to the path that is drawn, mm: one on which speeds are seen, one on which deviations are.
const OF_SPEED: f64 = 2e-3;
const OF_DEVIATION: f64 = 2e-4;
/// The same as a part of a window's width.
const OF_WINDOW: f64 = 2e-4;

/// A move's speeds are told apart in so many steps.
const STEPS: f64 = 48.0;

/// How a move ran, whatever it is.
pub struct Run {
    pub kind: Kind,
    pub seconds: f64,
    pub length: f64,
    /// What it asked for, mm/min.
    pub asked: f64,
}

/// How the move of an event ran, if it is one.
pub fn run_of(event: &EventKind) -> Option<Run> {
    let (kind, duration, length, pace) = match event {
        EventKind::Rapid { duration, length, pace, .. } => (Kind::Rapid, duration, length, pace),
        EventKind::Feed { duration, length, pace, .. } | EventKind::Arc { duration, length, pace, .. } => {
            (Kind::Feed, duration, length, pace)
        }
        _ => return None,
    };
    Some(Run { kind, seconds: duration.0, length: *length, asked: pace.asked * 60.0 })
}

/// What is drawn of how the axes move.
pub struct Driven {
    speed: bool,
    actual: bool,
    tolerance_mm: f64,
    /// The places of the present move, and the speed there in mm/min.
    places: Vec<[f64; 3]>,
    speeds: Vec<f64>,
}

impl Driven {
    pub fn new(layers: &[LayerArgument], window_mm: Option<f64>, exaggeration: f64) -> Driven {
        let wanted = |layer| layers.contains(&layer);
        let (speed, actual) = (wanted(LayerArgument::Speed), wanted(LayerArgument::Actual));
        let whole = if actual { OF_DEVIATION } else { OF_SPEED };
        let tolerance_mm = window_mm.map_or(whole, |width| whole.min(width * OF_WINDOW)) / exaggeration;
        Driven { speed, actual, tolerance_mm, places: Vec::new(), speeds: Vec::new() }
    }

    /// True if anything of it is.
    pub fn is_wanted(&self) -> bool {
        self.speed || self.actual
    }

    /// Draws a move: as it is ordered where that is all that is wanted, else as it is driven.
    pub fn draw(
        &mut self,
        drawing: &mut Drawing,
        strokes: &Strokes,
        session: &Session<Texts>,
        event: &EventKind,
        stroke: &Stroke,
    ) {
        if self.is_wanted() {
            self.places.clear();
            self.speeds.clear();
            session.sample(self.tolerance_mm, |_, setpoint| {
                self.places.push(strokes.at(&setpoint.position));
                self.speeds.push(setpoint.speed() * 60.0);
            });
            if self.places.len() < 2 {
                // It is driven by itself, at a speed that is not known.
                self.places = vec![stroke.from, stroke.to];
                let run = run_of(event).filter(|run| run.seconds > 0.0);
                let mean = run.map_or(0.0, |run| run.length / run.seconds * 60.0);
                self.speeds = vec![mean; 2];
            }
        }
        if self.speed {
            self.draw_speeds(drawing, stroke);
        } else {
            drawing.stroke(stroke);
        }
        if self.actual {
            // An arc that a fourth axis turns in is no arc in the picture: there is nothing to measure it by.
            let is_measured = stroke.arc.is_some() || !matches!(event, EventKind::Arc { .. });
            if is_measured {
                drawing.ordered(stroke);
                if stroke.kind == Kind::Feed {
                    drawing.commanded(stroke);
                }
                drawing.driven(stroke.kind, &self.places);
            } else {
                drawing.driven_alone(&self.places);
            }
        }
    }

    fn draw_speeds(&self, drawing: &mut Drawing, stroke: &Stroke) {
        let step = self.speeds.iter().copied().fold(0.0, f64::max) / STEPS;
        for (places, speeds) in self.places.windows(2).zip(self.speeds.windows(2)) {
            let mean = (speeds[0] + speeds[1]) / 2.0;
            let feed = if step > 0.0 { (mean / step).round() * step } else { 0.0 };
            drawing.stroke(&Stroke { from: places[0], to: places[1], arc: None, feed, ..*stroke });
        }
    }
}
