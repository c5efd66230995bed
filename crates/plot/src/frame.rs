//! Which part of the machine's space the picture shows.
//!
//! Cutting moves are always shown whole. Rapids only if they are near: a return to the reference point would make a
//! small part a dot. If nothing cuts, everything is shown.

use crate::extent::Extent;
use crate::layers::DrawnLayers;
use crate::piece::Piece;
use crate::stroke::Kind;
use crate::survey::Survey;

/// A rapid's end so near to the cutting moves is shown, as a part of their extent.
const NEAR_PART: f64 = 0.25;

/// A path that is nearly a point in plan is shown with this much around it, as a part of its extent.
const LEAST_PLAN_PART: f64 = 0.5;

/// What is shown of a path without any extent, in mm.
const POINT_MM: f64 = 10.0;

/// The box that the views are made for.
pub(crate) fn frame(survey: &Survey, pieces: &[Piece], layers: &DrawnLayers) -> Extent {
    let subject = survey.subject();
    if subject.is_empty() {
        return Extent { min: [0.0; 3], max: [100.0, 100.0, 0.0] };
    }
    let mut frame = *subject;
    let near = subject.grown(subject.span() * NEAR_PART);
    for piece in pieces.iter().filter(|piece| piece.kind == Kind::Rapid) {
        for end in [piece.from, piece.to] {
            if near.contains(end) {
                frame.include(end);
            }
        }
    }
    layers.widen(&mut frame, &near);
    let span = frame.span();
    let least = if span > 0.0 { span * LEAST_PLAN_PART } else { POINT_MM };
    if frame.size(0).max(frame.size(1)) < least {
        for axis in 0..2 {
            let more = 0.5 * (least - frame.size(axis));
            frame.min[axis] -= more;
            frame.max[axis] += more;
        }
    }
    frame
}
