//! The window of moves and elements that are held against each other.
//!
//! What need not be compared: as long as the directions of neighbouring elements, from one to another, lie within half a
//! turn, the centre beside the one is nowhere nearer to the other than the radius. (Take the element among them that
//! points farthest right: all elements before it lie right of its line, all centres behind it left of its centre's line;
//! and of the one that points farthest left the other way round.) So only what lies before the last half turn is looked
//! at, and of that only what lies in boxes that come near enough.

use base::Place;
use path::Part;

use super::{Hit, LEAST_MM};
use crate::curve::{Curve, Extent, Vector, distance, least, most};
use crate::way::Way;

/// Moves in a box together.
const BOXED: u64 = 8;
/// Half a turn in the measure of [`direction`], and a bit for rounding.
const HALF_TURN: f64 = 2.0 + 1e-9;
/// A turn back by less than this beside half a turn can go either way round.
const EITHER_WAY: f64 = 2.0 - 1e-6;

/// A move with its element.
#[derive(Clone, Copy)]
struct Entry {
    centre: Curve,
    element: Option<Curve>,
    place: Place,
    block: u64,
    part: Option<Part>,
    radius: f64,
    /// Elements up to here.
    count: u64,
    /// It runs beside its own element.
    beside: bool,
    /// How it cuts into its own element and the last one is said elsewhere.
    claimed: bool,
    /// It begins where the tool stopped without having seen its element.
    blind: bool,
}

/// The latest moves of a stretch, in rings: by their number, as many as a power of two.
pub(super) struct Window {
    /// Elements that are looked back.
    depth: u64,
    entries: Vec<Entry>,
    counts: Vec<u64>,
    /// The directions in each move, lowest and highest; in those that are summed up, from each to the last such one.
    angles: Vec<[f64; 2]>,
    boxes: Vec<Extent>,
    /// Moves in this stretch, and elements.
    next: u64,
    count: u64,
    /// The first move that is within the depth, the first whose element counts, the first that can cut what comes.
    tail: u64,
    first_element: u64,
    first_cutter: u64,
    /// The same for the move that comes next.
    next_cutter: u64,
    /// From here on all directions lie within half a turn; before `summed` they are summed up, behind it they lie between
    /// these.
    chain: u64,
    summed: u64,
    reach: [f64; 2],
    /// The direction in which the last move ends: turns counted, and not.
    last: Option<[f64; 2]>,
    radius: f64,
    /// Where the last element ends.
    corner: Option<Vector>,
    /// Up to which move the latest one is to be compared.
    compared: u64,
}

impl Window {
    pub fn new(depth: u32) -> Window {
        Window {
            depth: u64::from(depth),
            entries: Vec::new(),
            counts: Vec::new(),
            angles: Vec::new(),
            boxes: Vec::new(),
            next: 0,
            count: 0,
            tail: 0,
            first_element: 0,
            first_cutter: 0,
            next_cutter: 0,
            chain: 0,
            summed: 0,
            reach: NO_REACH,
            last: None,
            radius: 0.0,
            corner: None,
            compared: 0,
        }
    }

    pub fn is_on(&self) -> bool {
        self.depth > 0
    }

    /// Forgets the stretch.
    pub fn clear(&mut self) {
        let mut empty = Window::new(0);
        empty.depth = self.depth;
        std::mem::swap(&mut empty.entries, &mut self.entries);
        std::mem::swap(&mut empty.counts, &mut self.counts);
        std::mem::swap(&mut empty.angles, &mut self.angles);
        std::mem::swap(&mut empty.boxes, &mut self.boxes);
        *self = empty;
    }

    /// Moves in the stretch so far.
    pub fn moves(&self) -> u64 {
        self.next
    }

    /// Moves that there is room for.
    pub fn room(&self) -> u64 {
        self.entries.len() as u64
    }

    /// Takes a move; true if its element closes the contour where an earlier one begins or comes by.
    pub fn push(&mut self, way: &Way, claimed: bool) -> bool {
        self.compared = 0;
        self.first_cutter = self.next_cutter;
        let radius = if way.part.is_some() { way.radius } else { self.radius };
        if crosses_the_path(way, self.corner, radius) {
            return false;
        }
        if self.entries.is_empty() {
            self.make_room(way);
        }
        let mask = self.mask();
        let number = self.next;
        let index = (number & mask) as usize;
        self.radius = radius;
        self.count += u64::from(way.element.is_some());
        self.corner = way.element.map_or(self.corner, |element| Some(element.to));
        let extent = extent(&way.centre, way.element.as_ref());
        let entry = &mut self.entries[index];
        entry.centre = way.centre;
        entry.element = way.element;
        entry.place = way.place;
        entry.block = way.block;
        entry.part = way.part;
        entry.radius = radius;
        entry.count = self.count;
        entry.beside = way.beside;
        entry.claimed = claimed;
        entry.blind = way.begins_blind(LEAST_MM);
        self.follow(number, way);
        self.counts[index] = self.count;
        self.next = number + 1;
        while self.counts[(self.tail & mask) as usize] + self.depth < self.count {
            self.tail += 1;
        }
        // The boxes of moves are given up eight at a time.
        self.tail = self.tail.max(((number & !(BOXED - 1)) + BOXED).saturating_sub(self.room()));
        let slot = &mut self.boxes[((number & mask) / BOXED) as usize];
        *slot = if number.is_multiple_of(BOXED) { extent } else { slot.with(&extent) };
        let until = self.chain.min(self.next);
        if self.begin() < until && self.boxes_near(&extent, radius, until) {
            self.compared = until;
            return self.close(number);
        }
        let closes = way.element.as_ref().is_some_and(closes_on_itself);
        if closes {
            self.close_from(number, number);
        }
        closes
    }

    /// Tells what the latest move cuts, and what cuts its element.
    pub fn hits(&self, mut tell: impl FnMut(Hit)) {
        if self.compared == 0 {
            return;
        }
        let number = self.next - 1;
        let latest = self.entry(number);
        let extent = extent(&latest.centre, latest.element.as_ref());
        for other in self.near(&extent, latest.radius, self.compared) {
            let entry = self.entry(other);
            if other == number {
                if !latest.beside && !latest.claimed {
                    self.judge([number, number]).map(&mut tell);
                }
                continue;
            }
            if latest.claimed && entry.count + 1 == latest.count {
                continue;
            }
            if other >= self.first_element {
                self.judge([number, other]).map(&mut tell);
            }
            if other >= self.first_cutter {
                self.judge([other, number]).map(&mut tell);
            }
        }
    }

    /// True unless an element that was cut there has turned out to be none of the contour.
    pub fn counts(&self, hit: &Hit) -> bool {
        let number = hit.pair[1];
        if number < self.tail || number > self.first_element {
            return true;
        }
        number == self.first_element
            && self.entry(number).element.is_some_and(|element| distance(element.nearest(hit.at), hit.at) <= LEAST_MM)
    }

    fn mask(&self) -> u64 {
        self.entries.len() as u64 - 1
    }

    fn entry(&self, number: u64) -> &Entry {
        &self.entries[(number & self.mask()) as usize]
    }

    fn make_room(&mut self, way: &Way) {
        // Corners have moves of their own.
        let room = (self.depth * 2).next_power_of_two().max(4 * BOXED) as usize;
        let nothing = Entry {
            centre: way.centre,
            element: None,
            place: way.place,
            block: 0,
            part: None,
            radius: 0.0,
            count: 0,
            beside: false,
            claimed: false,
            blind: false,
        };
        self.entries = vec![nothing; room];
        self.counts = vec![0; room];
        self.angles = vec![NO_REACH; room];
        self.boxes = vec![Extent::NOTHING; room / BOXED as usize];
    }

    /// The first move that anything is compared with.
    fn begin(&self) -> u64 {
        self.tail.max(self.first_element.min(self.first_cutter))
    }

    fn boxes_near(&self, extent: &Extent, radius: f64, until: u64) -> bool {
        let last = (until - 1) / BOXED;
        (self.begin() / BOXED..=last).any(|number| self.is_box_near(number, extent, radius))
    }

    fn is_box_near(&self, number: u64, extent: &Extent, radius: f64) -> bool {
        let index = ((number * BOXED) & self.mask()) / BOXED;
        self.boxes[index as usize].is_near(extent, radius)
    }

    /// The moves before `until` in boxes that come near.
    fn near(&self, extent: &Extent, radius: f64, until: u64) -> impl Iterator<Item = u64> {
        let begin = self.begin();
        let boxes = begin / BOXED..=(until - 1) / BOXED;
        let near = boxes.filter(move |&number| self.is_box_near(number, extent, radius));
        near.flat_map(move |number| (number * BOXED).max(begin)..((number + 1) * BOXED).min(until))
    }

    /// Follows the directions: from which move on they lie within half a turn.
    fn follow(&mut self, number: u64, way: &Way) {
        let curve = match (way.part, &way.element) {
            (Some(Part::Along), Some(element)) if way.beside => element,
            (Some(Part::Round), _) => &way.centre,
            _ => return self.break_off(number + 1),
        };
        let (begins, ends) = match &curve.turn {
            None => {
                let begins = direction(curve.directions()[0]);
                (begins, begins)
            }
            Some(_) => curve.directions().map(direction).into(),
        };
        if !begins.is_finite() || !ends.is_finite() {
            return self.break_off(number + 1);
        }
        let turn = self.last.map_or(0.0, |[_, last]| shortest(begins - last));
        let first = self.last.map_or(0.0, |[angle, _]| angle) + turn;
        let swept = curve.turn.map_or(0.0, |turn| {
            let quarters = turn.sweep / std::f64::consts::FRAC_PI_2;
            let ends = ends - begins;
            ends + 4.0 * ((quarters - ends) / 4.0).round()
        });
        let own = [first.min(first + swept), first.max(first + swept)];
        if self.last.is_none() || turn.abs() > EITHER_WAY {
            self.break_off(number);
        }
        self.last = Some([first + swept, ends]);
        self.shorten(number, own);
    }

    /// Takes the directions of a move and leaves out of the chain what they do not lie within half a turn of.
    fn shorten(&mut self, number: u64, own: [f64; 2]) {
        let mask = self.mask();
        let index = |number: u64| (number & mask) as usize;
        let mut chain = self.chain.max(number.saturating_sub(mask));
        self.angles[index(number)] = own;
        let mut reach = wider(self.reach, own);
        let fits = |all: [f64; 2]| all[1] - all[0] <= HALF_TURN;
        while chain < number {
            if chain < self.summed {
                if fits(wider(self.angles[index(chain)], reach)) {
                    break;
                }
                chain += 1;
            } else if fits(reach) {
                break;
            } else {
                // Each move is summed up once.
                let mut all = NO_REACH;
                for earlier in (chain..=number).rev() {
                    let angle = &mut self.angles[index(earlier)];
                    all = wider(all, *angle);
                    *angle = all;
                }
                self.summed = number + 1;
                reach = NO_REACH;
            }
        }
        self.chain = chain;
        self.reach = reach;
    }

    fn break_off(&mut self, from: u64) {
        self.chain = from;
        self.summed = from;
        self.reach = NO_REACH;
        self.last = None;
    }

    /// Looks whether the latest element comes to an earlier one; then what lies before that place and what will lie
    /// behind it lead to the contour and away from it.
    fn close(&mut self, number: u64) -> bool {
        let latest = self.entry(number);
        let Some(element) = latest.element else { return false };
        let mut met = closes_on_itself(&element).then_some((number, element.to));
        for other in self.near(&element.extent(), LEAST_MM, self.compared) {
            let Some(earlier) = self.entry(other).element.filter(|_| other >= self.first_element && other != number)
            else {
                continue;
            };
            if !earlier.extent().is_near(&element.extent(), LEAST_MM) {
                continue;
            }
            let touches = |curve: &Curve, place: Vector| distance(curve.nearest(place), place) <= LEAST_MM;
            let place = if touches(&element, earlier.from) {
                Some(earlier.from)
            } else if touches(&earlier, element.to) {
                Some(element.to)
            } else {
                element.crossing(&earlier)
            };
            met = place.filter(|place| distance(*place, element.from) > LEAST_MM).map(|place| (other, place)).or(met);
        }
        let Some((other, place)) = met else { return false };
        if other != number {
            self.trim(number, |element| element.before(place));
            self.trim(other, |element| element.behind(place));
        }
        self.close_from(other, number);
        true
    }

    /// The contour is closed from an element to the end of the latest one.
    fn close_from(&mut self, first: u64, last: u64) {
        self.first_element = first;
        self.next_cutter = last + 1;
    }

    fn trim(&mut self, number: u64, trim: impl FnOnce(&Curve) -> Curve) {
        let mask = self.mask();
        let entry = &mut self.entries[(number & mask) as usize];
        entry.element = entry.element.as_ref().map(trim);
    }

    /// How a move cuts an element.
    fn judge(&self, pair: [u64; 2]) -> Option<Hit> {
        let [cutter, cut] = pair.map(|number| self.entry(number));
        let element = cut.element.as_ref()?;
        let radius = cutter.radius.min(cut.radius) - cutter.centre.slack() - element.slack();
        if !cutter.centre.extent().is_near(&element.extent(), radius) {
            return None;
        }
        let (apart, at) = cutter.centre.approach(element);
        let depth = radius - apart;
        let is_there = |end: Vector| distance(at, end) <= LEAST_MM;
        let by_the_way = match cutter.part {
            Some(Part::Start) => cut.count == 1 && is_there(element.from),
            None => cut.count == self.count && is_there(element.to),
            _ => false,
        };
        (depth > LEAST_MM && !by_the_way).then_some(Hit {
            depth,
            radius,
            at,
            pair,
            cutter: (cutter.place, cutter.block, cutter.part),
            element: cut.place,
            // Standing there the tool cuts what comes; going on from there, whatever lies in its way.
            blind: cutter.blind || cut.blind && cutter.count + 1 == cut.count,
        })
    }
}

/// True for a full circle.
fn closes_on_itself(element: &Curve) -> bool {
    element.turn.is_some() && distance(element.from, element.to) <= LEAST_MM
}

/// The box around a move and its element.
fn extent(centre: &Curve, element: Option<&Curve>) -> Extent {
    let extent = centre.extent();
    element.map_or(extent, |element| extent.with(&element.extent()))
}

const NO_REACH: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn wider(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [least(one[0], other[0]), most(one[1], other[1])]
}

/// A straight piece at a corner that leads across the contour, to the other side of it.
fn crosses_the_path(way: &Way, corner: Option<Vector>, radius: f64) -> bool {
    way.part == Some(Part::Round)
        && way.centre.turn.is_none()
        && corner.is_some_and(|corner| distance(way.centre.nearest(corner), corner) < radius - LEAST_MM)
}

/// A direction as a number from 0 to 4 that grows with its angle; opposite ones differ by 2.
fn direction(way: Vector) -> f64 {
    let part = way[0] / (way[0].abs() + way[1].abs());
    if way[1] >= 0.0 { 1.0 - part } else { 3.0 + part }
}

/// The shorter way round.
fn shortest(turn: f64) -> f64 {
    if turn > 2.0 {
        turn - 4.0
    } else if turn < -2.0 {
        turn + 4.0
    } else {
        turn
    }
}
