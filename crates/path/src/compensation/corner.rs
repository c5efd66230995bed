//! The end of one element where the next one begins: inside, outside, straight on or all the way back.

use super::edge::Edge;
use super::intersection::Bend;
use crate::plane::{NONE, Vector, add, angle, cross, dot, left, length, times};

/// Feet of the two normals nearer to each other than this, mm, are one: the elements are tangent.
pub const TANGENT_MM: f64 = 1e-6;
/// A turn back with less sine than this is a turn back on the same line: it is outside, whichever way it turns.
const REVERSAL: f64 = 1e-9;
/// Most places on the way from one element to the next.
const MOST: usize = 4;

/// On which side of the path a corner turns.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Corner {
    /// There is none: straight on, or the tool stops square to the path.
    #[default]
    None,
    /// Towards the tool.
    Inside,
    /// Away from the tool.
    Outside,
}

/// How the tool gets from one element to the next: places beside the corner, the first where the first element's path
/// ends, the last where the next one's begins.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(crate) struct Join {
    places: [Vector; MOST],
    count: u8,
    /// From the first place to the second on an arc about the corner.
    pub round: bool,
    pub corner: Corner,
}

impl Join {
    /// At one place.
    pub fn at(place: Vector) -> Join {
        Join { places: [place, NONE, NONE, NONE], count: 1, round: false, corner: Corner::None }
    }

    /// By way of these places.
    pub fn through(corner: Corner, places: &[Vector]) -> Join {
        let mut join = Join { places: [NONE; MOST], count: places.len().min(MOST) as u8, round: false, corner };
        for (slot, place) in join.places.iter_mut().zip(places) {
            *slot = *place;
        }
        join
    }

    /// The places.
    pub fn places(&self) -> &[Vector] {
        self.places.get(..usize::from(self.count)).unwrap_or_default()
    }

    /// Where the first element's path ends.
    pub fn first(&self) -> Vector {
        self.places[0]
    }

    /// Where the next element's path begins.
    pub fn last(&self) -> Vector {
        self.places().last().copied().unwrap_or(NONE)
    }
}

/// The turn from one element to the next.
pub(crate) fn bend(first: &Edge, second: &Edge) -> Bend {
    let (from, to) = (first.tangent[1], second.tangent[0]);
    Bend { cos: dot(from, to), sin: cross(from, to), curvature: [first.curvature[1], second.curvature[0]] }
}

/// On which side the corner turns for a tool beside it by `s`, left positive.
pub(crate) fn side_of(bend: &Bend, s: f64) -> Corner {
    if bend.cos > 0.0 && (s * bend.sin).abs() <= TANGENT_MM {
        return Corner::None;
    }
    let turns_back = bend.cos < 0.0 && bend.sin.abs() <= REVERSAL;
    if turns_back || s * bend.sin < 0.0 { Corner::Outside } else { Corner::Inside }
}

/// The corner between two elements for a tool beside both by `s`, left positive; false if its paths inside the corner
/// do not meet.
pub(crate) fn join(first: &Edge, second: &Edge, s: f64, round: bool, join: &mut Join) -> bool {
    let bend = bend(first, second);
    join.count = 1;
    join.round = false;
    join.corner = side_of(&bend, s);
    if bend.cos >= 0.0 && bend.curvature == [0.0; 2] && !(round && join.corner == Corner::Outside) {
        join.places[0] = between_lines(first, second, &bend, s);
        return true;
    }
    match join.corner {
        Corner::None => {
            let middle = add(first.normal(1, 1.0), second.normal(0, 1.0));
            join.places[0] = times(middle, s / length(middle));
        }
        Corner::Inside => {
            let Some([beside, along]) = bend.meeting(s) else { return false };
            join.places[0] = add(first.normal(1, s + beside), times(first.tangent[1], along));
        }
        Corner::Outside => *join = outside(first, second, &bend, s, round),
    }
    true
}

/// Where the paths beside two lines meet that turn by a right angle at most: 1 + cos is at least 1.
fn between_lines(first: &Edge, second: &Edge, bend: &Bend, s: f64) -> Vector {
    times(left(add(first.tangent[1], second.tangent[0])), s / (1.0 + bend.cos))
}

/// The angle by which an arc about an outside corner turns from one foot to the other: away from the tool's side.
pub(crate) fn sweep_round(first: Vector, second: Vector, s: f64) -> f64 {
    angle(first, second).abs().copysign(-s)
}

/// Round an outside corner: on an arc, or along the elements' tangents to where they meet, if that is not too far.
pub(crate) fn outside(first: &Edge, second: &Edge, bend: &Bend, s: f64, round: bool) -> Join {
    let feet = [first.normal(1, s), second.normal(0, s)];
    if round {
        return Join { round: true, ..Join::through(Corner::Outside, &feet) };
    }
    let mut places = [NONE; MOST];
    let mut count = 0;
    let mut put = |place: Vector| {
        places[count] = place;
        count += 1;
    };
    if first.is_arc() {
        put(feet[0]);
    }
    if bend.cos >= 0.0 {
        put(between_lines(first, second, bend, s));
    } else {
        put(add(feet[0], times(first.tangent[1], s.abs())));
        put(add(feet[1], times(second.tangent[0], -s.abs())));
    }
    if second.is_arc() {
        put(feet[1]);
    }
    Join::through(Corner::Outside, &places[..count])
}
