//! `corner-mode-unset`: an outside corner under compensation, and the program says nowhere how to go round it.
//!
//! What: the tool goes round an outside corner under G41 or G42 and neither M96 nor M97 was programmed.
//! Why: the two ways differ: an arc keeps the cutter at the corner, the intersection leads it away from it and back, by
//! up to 1.4 times its radius, where a clamp or the next wall may stand. Which one a control takes by itself is a
//! setting or was never written down; RESET may keep what another program has said.
//! Do: write M96 or M97 before the contour.
//!
//! Silent for inside corners and tangent ones, which both modes run alike. Said once a program.

use base::Place;
use dialect::CornerMode;
use meaning::{Corner as Mode, Interpreter};
use path::Corner;
use path::plane::{Vector, cross, dot, length};

use crate::finding::{At, Finding, Found};
use crate::look::number;
use crate::rules::Rule;
use crate::way::{Turns, Way};

/// What has been seen of corners.
#[derive(Default)]
pub(crate) struct CornerModeUnset {
    said: bool,
    /// An outside corner whose second element has not come yet: its block and the direction in which the first ends.
    open: Option<(Place, u64, Vector)>,
}

impl CornerModeUnset {
    /// A program begins.
    pub fn begin(&mut self) {
        *self = CornerModeUnset::default();
    }

    /// Nobody knows what follows the corner.
    pub fn drop_corner(&mut self) {
        self.open = None;
    }

    #[inline]
    pub fn look(&mut self, (way, turns): (&Way, &Turns), interpreter: &Interpreter, found: &mut Found) {
        if !self.said && (self.open.is_some() || way.corner == Corner::Outside) {
            self.judge((way, turns), interpreter, found);
        }
    }

    fn judge(&mut self, (way, turns): (&Way, &Turns), interpreter: &Interpreter, found: &mut Found) {
        let Some(element) = way.element(turns) else {
            // A block that starts compensation has its corner with the first element, at a place of its own.
            return;
        };
        let [begins, ends] = element.directions();
        if let Some((place, block, direction)) = self.open.take() {
            self.said = true;
            found.say(Rule::CornerModeUnset, &place, || finding(way, interpreter, (place, block), direction, begins));
        } else if way.corner == Corner::Outside && interpreter.executing_state().corner == Mode::NotProgrammed {
            self.open = Some((way.place, way.block, ends));
        }
    }
}

fn finding(
    way: &Way,
    interpreter: &Interpreter,
    (place, block): (Place, u64),
    first: Vector,
    second: Vector,
) -> Finding {
    let cosine = dot(first, second) / (length(first) * length(second));
    // Up to a right angle to where the paths meet; beyond it along each for the radius.
    let reach = if cosine >= 0.0 { (2.0 / (1.0 + cosine)).sqrt() } else { std::f64::consts::SQRT_2 };
    let turn = libm::atan2(cross(first, second), dot(first, second)).to_degrees().abs();
    let reach = number(reach * way.radius);
    let (radius, turn) = (number(way.radius), number(turn));
    let here = match interpreter.fitting().policies.corner_mode {
        CornerMode::Arc => "an arc",
        CornerMode::Intersection => "the intersection of the paths",
    };
    Finding::at(Rule::CornerModeUnset, "", block, place, At::Block)
        .labelled(format!("ends at an outside corner of {turn} deg"))
        .with("here", here)
        .with("reach", reach)
        .with("radius", radius)
}
