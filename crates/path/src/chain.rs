//! The path beside a chain of elements that is known from end to end: the compensation of programs without a program,
//! for whoever looks at its geometry alone (oracles, random input, pictures).

use base::{AXES, Point};
use dialect::{CompensationCut, CompensationRestart, CompensationRules, CompensationStart};
use meaning::{Act, ArcMove, Element, Feed, Offset, Operation};

use crate::compensation::{Beside, Compensation, Edge, Join, Next, NextKind, Plan, Rules};
use crate::pieces::{Carried, Pieces};
use crate::shape::{COUNTS, Shape, Shaped};

/// What a control lays down.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ChainRules {
    /// How the first element ends.
    pub start: CompensationStart,
    /// Whether a path that cuts into an element near its own is refused.
    pub cut: CompensationCut,
    /// What else is refused.
    pub table: CompensationRules,
}

/// An element and how the tool runs beside it; without an offset it leads the tool back.
pub type Link = (Element, Option<Offset>);

/// Runs a chain and hands on every shape that has a length; mm. Returns the element whose block is refused, if one is:
/// nothing is run from there on.
pub fn run_chain(chain: &[Link], rules: &ChainRules, mut each: impl FnMut(&Shape)) -> Option<usize> {
    let rules = Rules { start: rules.start, restart: CompensationRestart::Direct, cut: rules.cut, table: rules.table };
    let mut compensation = Compensation::default();
    let mut shaped = Shaped::default();
    let mut position = chain.first().map_or([0.0; AXES], |(first, offset)| point(first.from, offset));
    for (index, (element, offset)) in chain.iter().enumerate() {
        let operation = operation(element, offset);
        let Some(offset) = offset else {
            if element.turn.is_some() && compensation.is_on() {
                return Some(index);
            }
            compensation.cancel();
            let to = point(element.to, &None);
            each(&Shape::Line { from: position, to, feed: FEED });
            position = to;
            continue;
        };
        let Some(edge) = Edge::new(element) else { continue };
        let now = Beside { edge, offset: *offset };
        let (next, at) = next_of(chain, index);
        let (mut plan, mut end) = (Plan::default(), Join::default());
        if compensation.plan(&now, &next, (false, &mut end), &rules, &mut plan).is_err() {
            return Some(index);
        }
        let after = next_of(chain, at).0;
        let fits = next.element().is_none_or(|beside| {
            Compensation::look_past(&now, &end, beside, &after, &rules, &mut Join::default()).is_ok()
        });
        if !fits || compensation.look_about(&now, &plan, &end, (&next, &after), &rules).is_err() {
            return Some(index);
        }
        compensation.take(&now, &plan, &end, &next);
        let from = position;
        let Beside { edge, offset } = &now;
        let carried = Carried { element, edge, offset, plan: &plan, end: &end, from: &from, certain: true };
        let mut pieces = Pieces::default();
        let mut more = pieces.begin(&carried, &operation, &mut position, &mut shaped);
        while more {
            each(&shaped.shape);
            more = pieces.next(&operation, &mut position, &mut shaped);
        }
    }
    None
}

/// Some feed: the geometry does not depend on it.
const FEED: Feed = Feed { mm_per_min: 100.0, exact_stop: false, tapping: false, per_revolution: false, way_mm: 0.0 };

fn next_of(chain: &[Link], index: usize) -> (Next, usize) {
    for (at, (element, offset)) in chain.iter().enumerate().skip(index + 1) {
        if let Some(edge) = Edge::new(element) {
            let next = offset.map_or(Next { kind: NextKind::Ends, ..Next::default() }, |offset| Next {
                kind: NextKind::Element,
                beside: Beside { edge, offset },
            });
            return (next, at);
        }
    }
    (Next::default(), chain.len())
}

fn point(counts: [f64; 2], offset: &Option<Offset>) -> Point {
    let mut point = [0.0; AXES];
    for (axis, counts) in offset.map_or([0, 1], |offset| offset.axes).into_iter().zip(counts) {
        if let Some(place) = point.get_mut(usize::from(axis)) {
            *place = counts / COUNTS;
        }
    }
    point
}

fn operation(element: &Element, offset: &Option<Offset>) -> Operation {
    let to = point(element.to, offset);
    let act = match (element.turn, offset) {
        (Some(turn), Some(offset)) => Act::Arc {
            arc: ArcMove {
                to,
                plane: offset.plane,
                axes: offset.axes,
                center: turn.center.map(|counts| counts / COUNTS),
                clockwise: turn.clockwise,
                full_circle: turn.full_circle,
            },
            feed: FEED,
        },
        _ => Act::Line { to, feed: FEED },
    };
    Operation { act, ..Operation::default() }
}
