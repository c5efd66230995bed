//! The window of moves and elements that are held against each other.
//!
//! What need not be compared: as long as the directions of neighbouring elements, from one to another, lie within half a
//! turn, the centre beside the one is nowhere nearer to the other than the radius. (Take the element among them that
//! points farthest right: all elements before it lie right of its line, all centres behind it left of its centre's line;
//! and of the one that points farthest left the other way round.) So only what lies before the last half turn is looked
//! at, and of that only what lies in boxes that come near enough.

use path::plane::{Vector, distance, least, less, most};
use path::{Curve, Extent, Part};

use super::{Hit, LEAST_MM};
use crate::way::{Turns, Way};

/// Moves in a box together.
const BOXED: u64 = 8;
/// More than rounding makes of a distance, mm.
const ROUNDING_MM: f64 = 1e-6;
/// Half a turn in the measure of [`direction`], and a bit for rounding.
const HALF_TURN: f64 = 2.0 + 1e-9;
/// A turn back by less than this beside half a turn can go either way round.
const EITHER_WAY: f64 = 2.0 - 1e-6;

/// The latest moves of a stretch, in rings: by their number, as many as a power of two.
pub(super) struct Window {
    /// Elements that are looked back.
    depth: u64,
    entries: Vec<Way>,
    turns: Vec<Turns>,
    /// Elements up to each move.
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
    /// What lies in here is not near to any box before this one.
    free: Extent,
    cleared: u64,
}

impl Window {
    pub fn new(depth: u32) -> Window {
        Window {
            depth: u64::from(depth),
            entries: Vec::new(),
            turns: Vec::new(),
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
            free: Extent::NOTHING,
            cleared: 0,
        }
    }

    pub fn is_on(&self) -> bool {
        self.depth > 0
    }

    /// Where the next move is to be written.
    #[inline]
    pub fn slot(&mut self) -> (&mut Way, &mut Turns) {
        if self.entries.is_empty() {
            self.make_room();
        }
        let index = self.index(self.next);
        (&mut self.entries[index], &mut self.turns[index])
    }

    /// Forgets the stretch, but not what was written of the next move.
    pub fn clear(&mut self) {
        if self.next > 0 {
            let (way, turns) = self.slot();
            (self.entries[0], self.turns[0]) = (*way, *turns);
        }
        let mut empty = Window::new(0);
        empty.depth = self.depth;
        std::mem::swap(&mut empty.entries, &mut self.entries);
        std::mem::swap(&mut empty.turns, &mut self.turns);
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

    /// Takes the move that was written; true if its element closes the contour where an earlier one begins or comes by.
    pub fn push(&mut self) -> bool {
        self.compared = 0;
        self.first_cutter = self.next_cutter;
        let number = self.next;
        let index = self.index(number);
        let (way, turns) = (&mut self.entries[index], &self.turns[index]);
        if way.part.is_none() {
            way.radius = self.radius;
        }
        let radius = way.radius;
        if crosses_the_path(way, turns, self.corner) {
            return false;
        }
        if self.radius != radius {
            (self.radius, self.free) = (radius, Extent::NOTHING);
        }
        let mut extent = way.centre.extent(&turns[0]);
        if way.has_element {
            self.count += 1;
            self.corner = Some(way.element.ends[1]);
            extent = extent.with(&way.element.extent(&turns[1]));
        }
        self.follow(number);
        self.counts[index] = self.count;
        self.next = number + 1;
        while self.counts[self.index(self.tail)] + self.depth < self.count {
            self.tail += 1;
        }
        // The boxes of moves are given up eight at a time.
        self.tail = self.tail.max(((number & !(BOXED - 1)) + BOXED).saturating_sub(self.room()));
        let slot = &mut self.boxes[index / BOXED as usize];
        *slot = if number.is_multiple_of(BOXED) { extent } else { slot.with(&extent) };
        let until = self.chain.min(self.next);
        if self.begin() >= until || self.is_clear(&extent, until) {
            return false;
        }
        self.compared = until;
        self.close(number)
    }

    /// True if the latest move has come near to others.
    #[inline]
    pub fn has_to_compare(&self) -> bool {
        self.compared > 0
    }

    /// Tells what the latest move cuts, and what cuts its element.
    pub fn hits(&self, mut tell: impl FnMut(Hit)) {
        let number = self.next.saturating_sub(1);
        let latest = self.entry(number);
        let extent = self.extent(number);
        for other in self.near(&extent, latest.radius, self.compared) {
            if other == number {
                if !latest.beside && !latest.claimed {
                    self.judge([number, number]).map(&mut tell);
                }
                continue;
            }
            if latest.claimed && self.count_at(other) + 1 == self.count {
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
            && self.element(number).is_some_and(|element| distance(element.nearest(hit.at), hit.at) <= LEAST_MM)
    }

    fn mask(&self) -> u64 {
        self.entries.len() as u64 - 1
    }

    #[inline]
    fn index(&self, number: u64) -> usize {
        (number & self.mask()) as usize
    }

    fn entry(&self, number: u64) -> &Way {
        &self.entries[self.index(number)]
    }

    fn element(&self, number: u64) -> Option<Curve> {
        self.entry(number).element(&self.turns[self.index(number)])
    }

    /// The box around a move and its element.
    fn extent(&self, number: u64) -> Extent {
        let (way, turns) = (self.entry(number), &self.turns[self.index(number)]);
        let extent = way.centre.extent(&turns[0]);
        if way.has_element { extent.with(&way.element.extent(&turns[1])) } else { extent }
    }

    fn count_at(&self, number: u64) -> u64 {
        self.counts[self.index(number)]
    }

    #[cold]
    fn make_room(&mut self) {
        // Corners have moves of their own.
        let room = (self.depth * 2).next_power_of_two().max(4 * BOXED) as usize;
        self.entries = vec![Way::default(); room];
        self.turns = vec![Turns::default(); room];
        self.counts = vec![0; room];
        self.angles = vec![NO_REACH; room];
        self.boxes = vec![Extent::NOTHING; room / BOXED as usize];
    }

    /// The first move that anything is compared with.
    fn begin(&self) -> u64 {
        self.tail.max(self.first_element.min(self.first_cutter))
    }

    /// True if the latest move is near to no box of moves before `until`.
    #[inline]
    fn is_clear(&mut self, extent: &Extent, until: u64) -> bool {
        let first = self.begin() / BOXED;
        let is_free = self.free.holds(extent);
        if is_free && (until - 1) / BOXED < self.cleared {
            return true;
        }
        if !is_free {
            (self.free, self.cleared) = (Extent::EVERYTHING, first);
        }
        self.clear_boxes(extent, first, until)
    }

    /// Looks at the boxes that are not known to be far, and remembers how far each is.
    fn clear_boxes(&mut self, extent: &Extent, first: u64, until: u64) -> bool {
        let full = self.next / BOXED;
        for number in self.cleared.max(first)..=(until - 1) / BOXED {
            let far = self.boxes[self.index(number * BOXED) / BOXED as usize].gap(extent) - self.radius;
            if far <= 0.0 {
                return false;
            }
            if number < full {
                self.free = self.free.around(extent, far - ROUNDING_MM);
                self.cleared = number + 1;
            }
        }
        true
    }

    fn is_box_near(&self, number: u64, extent: &Extent, radius: f64) -> bool {
        self.boxes[self.index(number * BOXED) / BOXED as usize].is_near(extent, radius)
    }

    /// The moves before `until` in boxes that come near.
    fn near(&self, extent: &Extent, radius: f64, until: u64) -> impl Iterator<Item = u64> {
        let begin = self.begin();
        let boxes = begin / BOXED..=(until - 1) / BOXED;
        let near = boxes.filter(move |&number| self.is_box_near(number, extent, radius));
        near.flat_map(move |number| (number * BOXED).max(begin)..((number + 1) * BOXED).min(until))
    }

    /// Follows the directions: from which move on they lie within half a turn.
    #[inline]
    fn follow(&mut self, number: u64) {
        let (way, turns) = (self.entry(number), &self.turns[self.index(number)]);
        let (track, turn) = match way.part {
            Some(Part::Along) if way.beside => (&way.element, &turns[1]),
            Some(Part::Round) => (&way.centre, &turns[0]),
            _ => return self.break_off(number + 1),
        };
        let (begins, ends, sweep) = if track.is_arc {
            let [begins, ends] = track.curve(turn).directions().map(direction);
            (begins, ends, turn.sweep)
        } else {
            let begins = direction(less(track.ends[1], track.ends[0]));
            (begins, begins, 0.0)
        };
        if !begins.is_finite() || !ends.is_finite() {
            return self.break_off(number + 1);
        }
        let turn = self.last.map_or(0.0, |[_, last]| shortest(begins - last));
        let first = self.last.map_or(0.0, |[angle, _]| angle) + turn;
        let mut swept = ends - begins;
        if sweep != 0.0 {
            let quarters = sweep / std::f64::consts::FRAC_PI_2;
            swept += 4.0 * ((quarters - swept) / 4.0).round();
        }
        let own = [least(first, first + swept), most(first, first + swept)];
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
        let Some(element) = self.element(number) else { return false };
        let itself = element.turn.is_some() && distance(element.from, element.to) <= LEAST_MM;
        let mut met = itself.then_some((number, element.to));
        for other in self.near(&element.extent(), LEAST_MM, self.compared) {
            let Some(earlier) = self.element(other).filter(|_| other >= self.first_element && other != number) else {
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
        self.first_element = other;
        self.next_cutter = number + 1;
        true
    }

    fn trim(&mut self, number: u64, trim: impl FnOnce(&Curve) -> Curve) {
        let index = self.index(number);
        let (way, turns) = (&mut self.entries[index], &mut self.turns[index]);
        if let Some(element) = way.element(turns) {
            way.element.take(&trim(&element), &mut turns[1]);
        }
    }

    /// How a move cuts an element.
    fn judge(&self, pair: [u64; 2]) -> Option<Hit> {
        let [cutter, cut] = pair.map(|number| self.entry(number));
        let element = self.element(pair[1])?;
        let centre = cutter.centre(&self.turns[self.index(pair[0])]);
        let radius = cutter.radius.min(cut.radius) - centre.slack() - element.slack();
        if !centre.extent().is_near(&element.extent(), radius) {
            return None;
        }
        let (apart, at) = centre.approach(&element);
        let depth = radius - apart;
        let is_there = |end: Vector| distance(at, end) <= LEAST_MM;
        let by_the_way = match cutter.part {
            Some(Part::Start) => self.count_at(pair[1]) == 1 && is_there(element.from),
            None => self.count_at(pair[1]) == self.count && is_there(element.to),
            _ => false,
        };
        (depth > LEAST_MM && !by_the_way).then_some(Hit {
            depth,
            radius,
            at,
            pair,
            cutter: (cutter.place, cutter.block, cutter.part),
            element: cut.place,
        })
    }
}

const NO_REACH: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn wider(one: [f64; 2], other: [f64; 2]) -> [f64; 2] {
    [least(one[0], other[0]), most(one[1], other[1])]
}

/// A straight piece at a corner that leads across the contour, to the other side of it.
#[inline]
fn crosses_the_path(way: &Way, turns: &Turns, corner: Option<Vector>) -> bool {
    let leads_across = |corner| distance(way.centre(turns).nearest(corner), corner) < way.radius - LEAST_MM;
    way.part == Some(Part::Round) && !way.centre.is_arc && corner.is_some_and(leads_across)
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
