//! The window of moves and elements that are held against each other.
//!
//! Only what lies before the last half turn ([`Chain`]) is looked at, and of that only what lies in boxes that come near
//! enough.

use path::plane::{Vector, distance};
use path::{Curve, Extent, Part};

use super::chain::Chain;
use super::{Hit, LEAST_MM};
use crate::way::{Turns, Way};

/// Moves in a box together.
const BOXED: u64 = 8;
/// More than rounding makes of a distance, mm.
const ROUNDING_MM: f64 = 1e-6;

/// The latest moves of a stretch, in rings: by their number, as many as a power of two.
pub(super) struct Window {
    /// Elements that are looked back.
    depth: u64,
    entries: Vec<Way>,
    turns: Vec<Turns>,
    /// Elements up to each move.
    counts: Vec<u64>,
    /// From where on nothing need be compared.
    chain: Chain,
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
            chain: Chain::default(),
            boxes: Vec::new(),
            next: 0,
            count: 0,
            tail: 0,
            first_element: 0,
            first_cutter: 0,
            next_cutter: 0,
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
        std::mem::swap(&mut empty.chain, &mut self.chain);
        empty.chain.break_off(0);
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
        way.blind = way.begins_blind(turns, LEAST_MM);
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
        self.chain.follow(number, way, turns);
        self.counts[index] = self.count;
        self.next = number + 1;
        while self.counts[self.index(self.tail)] + self.depth < self.count {
            self.tail += 1;
        }
        // The boxes of moves are given up eight at a time.
        self.tail = self.tail.max(((number & !(BOXED - 1)) + BOXED).saturating_sub(self.room()));
        let slot = &mut self.boxes[index / BOXED as usize];
        *slot = if number.is_multiple_of(BOXED) { extent } else { slot.with(&extent) };
        let until = self.chain.begin().min(self.next);
        if self.begin() < until {
            let is_clear = self.is_clear(&extent, until);
            debug_assert_eq!(is_clear, self.near(&extent, radius, until).next().is_none(), "what is far is far");
            if !is_clear {
                self.compared = until;
                return self.close(number);
            }
        }
        let closes = self.closes_on_itself(number);
        if closes {
            self.close_from(number, number);
        }
        closes
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
        self.chain = Chain::of(room);
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

    /// Looks whether the latest element comes to an earlier one; then what lies before that place and what will lie
    /// behind it lead to the contour and away from it.
    fn close(&mut self, number: u64) -> bool {
        let Some(element) = self.element(number) else { return false };
        let mut met = self.closes_on_itself(number).then_some((number, element.to));
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
        self.close_from(other, number);
        true
    }

    /// True for a full circle.
    #[inline]
    fn closes_on_itself(&self, number: u64) -> bool {
        let Way { element, has_element, .. } = self.entry(number);
        *has_element && element.is_arc && distance(element.ends[0], element.ends[1]) <= LEAST_MM
    }

    /// The contour is closed from an element to the end of the latest one.
    fn close_from(&mut self, first: u64, last: u64) {
        self.first_element = first;
        self.next_cutter = last + 1;
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
            // Standing there the tool cuts what comes; going on from there, whatever lies in its way.
            blind: cutter.blind || cut.blind && self.count_at(pair[0]) + 1 == self.count_at(pair[1]),
        })
    }
}

/// A straight piece at a corner that leads across the contour, to the other side of it.
#[inline]
fn crosses_the_path(way: &Way, turns: &Turns, corner: Option<Vector>) -> bool {
    let leads_across = |corner| distance(way.centre(turns).nearest(corner), corner) < way.radius - LEAST_MM;
    way.part == Some(Part::Round) && !way.centre.is_arc && corner.is_some_and(leads_across)
}
