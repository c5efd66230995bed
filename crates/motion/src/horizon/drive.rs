//! Forwards over the horizon: as fast as the settled speeds allow, a whole move or a servo period at a time.

use base::{AXES, Point};

use super::Horizon;
use super::legs::{Legs, slow_down, speed_up, speed_up_bent, split};
use crate::cell::{Cell, Ends, Reserve};
use crate::way::{Edge, Way};

/// A rest of way shorter than this is none, mm.
const NOTHING_LEFT: f64 = 1e-9;

/// A cell that is cut in mid-path is cut into so many at most.
const MOST_PIECES: usize = 12;

/// A stretch along a way in which the acceleration is constant or, under model `jerk`, changes steadily.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Leg {
    /// Where on its way it begins, mm.
    pub s: f64,
    /// The speed there, mm/s.
    pub speed: f64,
    /// How the speed changes, mm/s².
    pub acceleration: f64,
    /// How that changes, mm/s³.
    pub jerk: f64,
    /// How long it takes, s.
    pub seconds: f64,
}

impl Leg {
    /// The place on the way after a time, and the speed there.
    pub fn at(&self, seconds: f64) -> (f64, f64) {
        let (gained, bent) = (self.acceleration * seconds, self.jerk * seconds * seconds / 2.0);
        (self.s + (self.speed + gained / 2.0 + bent / 3.0) * seconds, self.speed + gained + bent)
    }
}

/// Where the axes shall be, and how fast.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Setpoint {
    /// mm and degrees, machine coordinates.
    pub position: Point,
    /// mm/s and degrees/s.
    pub velocity: Point,
}

impl Setpoint {
    /// The speed of all axes together, mm/s (degrees count as mm).
    pub fn speed(&self) -> f64 {
        crate::way::norm(&self.velocity, AXES)
    }
}

/// How far the first cell has been driven.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Drive {
    /// Squared speed at the start of the first cell.
    x: f64,
    /// The legs of the first cell, the one being driven, and the time spent in it.
    legs: Option<Legs>,
    leg: usize,
    spent: f64,
    hold: Hold,
}

/// Whether the axes shall stand as soon as they can.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
enum Hold {
    #[default]
    No,
    /// Not in tapping, which is brought to its end.
    Feed,
    Always,
}

impl Horizon {
    /// Drives to the end of the next move: how long that takes, s. `leg` is shown every leg on its way, with the
    /// squared speed that the axes allow there.
    pub fn drive_move(&mut self, mut leg: impl FnMut(&Way, f64, &Leg)) -> f64 {
        let mut seconds = 0.0;
        self.set_live(false);
        while self.begin_cell() {
            while let Some(next) = self.leg() {
                let rest = next.seconds - self.drive.spent;
                let (s, speed) = next.at(self.drive.spent);
                if let Some((cell, way)) = self.cells.front().and_then(|cell| Some((cell, self.way(cell.way)?))) {
                    leg(way, cell.axes_allow, &Leg { s, speed, seconds: rest, ..next });
                }
                seconds += rest;
                self.drive.leg += 1;
                self.drive.spent = 0.0;
                if self.is_at_border() {
                    self.drop_move();
                    return seconds;
                }
            }
            if !self.is_to_end() || self.end_cell() {
                return seconds;
            }
        }
        seconds
    }

    /// Drives for a time, at most to the end of the next move: the time that is left over, and whether the move has
    /// ended.
    pub fn drive_for(&mut self, mut seconds: f64) -> (f64, bool) {
        self.set_live(true);
        while self.begin_cell() {
            while let Some(next) = self.leg() {
                let rest = next.seconds - self.drive.spent;
                if rest > seconds {
                    self.drive.spent += seconds;
                    return (0.0, false);
                }
                seconds -= rest;
                self.drive.leg += 1;
                self.drive.spent = 0.0;
                if self.is_at_border() {
                    self.drop_move();
                    return (seconds, true);
                }
            }
            if !self.is_to_end() {
                // Held: the axes stand.
                return (0.0, false);
            }
            if self.end_cell() {
                return (seconds, true);
            }
        }
        (seconds, false)
    }

    /// The leg under way; `None` behind the last one of the first cell.
    fn leg(&self) -> Option<Leg> {
        let legs = self.drive.legs.as_ref()?;
        legs.legs[..legs.count].get(self.drive.leg).copied()
    }

    /// True if a move ends before the leg under way.
    fn is_at_border(&self) -> bool {
        self.drive.legs.as_ref().is_some_and(|legs| legs.border == Some(self.drive.leg))
    }

    /// True if the first cell is driven to its end.
    fn is_to_end(&self) -> bool {
        self.drive.legs.as_ref().is_some_and(|legs| legs.end.is_some())
    }

    /// Where the axes are now, and how fast; `None` if nothing is under way.
    pub fn setpoint(&self) -> Option<Setpoint> {
        let cell = self.cells.front()?;
        let way = self.way(cell.way)?;
        let (s, speed) = self.here();
        let slope = way.slope(s);
        Some(Setpoint { position: way.at(s), velocity: slope.map(|slope| slope * speed) })
    }

    /// The acceleration of every axis now, mm/s².
    pub fn acceleration(&self) -> Point {
        let (Some(cell), Some(legs)) = (self.cells.front(), &self.drive.legs) else { return [0.0; AXES] };
        let (Some(way), Some(leg)) = (self.way(cell.way), legs.legs[..legs.count].get(self.drive.leg)) else {
            return [0.0; AXES];
        };
        let (s, speed) = leg.at(self.drive.spent);
        let (slope, bend) = (way.slope(s), way.bend(s));
        std::array::from_fn(|axis| slope[axis] * leg.acceleration + bend[axis] * speed * speed)
    }

    /// True if the axes stand where they have been held.
    pub fn is_standing(&self) -> bool {
        self.here().1 <= 0.0
    }

    /// Feed hold: the axes shall stand as soon as they can, once tapping is over; or go on.
    pub fn hold(&mut self, held: bool) {
        self.set_hold(if held { Hold::Feed } else { Hold::No });
    }

    /// Emergency stop: the axes stand as soon as they can, whatever is under way. What is ahead is then to be cleared.
    pub fn emergency_stop(&mut self) {
        self.set_hold(Hold::Always);
    }

    /// True if the axes stand because they have been held.
    pub fn is_held(&self) -> bool {
        self.drive.hold != Hold::No && self.is_standing() && self.cells.front().is_none_or(|cell| self.holds(cell))
    }

    fn set_hold(&mut self, hold: Hold) {
        if self.drive.hold != hold {
            self.drive.hold = hold;
            self.cut_here();
            self.settled = 0;
            self.look_again();
        }
    }

    /// The squared speed at the start of the first cell, which is not under way.
    pub(super) fn speed_squared(&self) -> f64 {
        self.drive.x
    }

    /// True if the axes are to stand as soon as they can in this cell.
    fn holds(&self, cell: &Cell) -> bool {
        match self.drive.hold {
            Hold::No => false,
            Hold::Feed => !cell.moves.iter().any(|mover| self.asked(*mover).is_some_and(|asked| asked.feed.tapping)),
            Hold::Always => true,
        }
    }

    /// The place on the first cell's way, and the speed there.
    fn here(&self) -> (f64, f64) {
        let Some(cell) = self.cells.front() else { return (0.0, 0.0) };
        match &self.drive.legs {
            None => (cell.part[0], self.drive.x.sqrt()),
            Some(legs) => match legs.legs[..legs.count].get(self.drive.leg) {
                Some(leg) => leg.at(self.drive.spent),
                // Driven to where the axes stand, or to the cell's end.
                None => match (legs.end, legs.legs[..legs.count].last()) {
                    (None, Some(last)) => (last.at(last.seconds).0, 0.0),
                    (None, None) => (cell.part[0], 0.0),
                    (Some(x), _) => (cell.part[1], x.sqrt()),
                },
            },
        }
    }

    /// The first cell begins here: what is under way is planned anew from the present place and speed.
    pub(super) fn cut_here(&mut self) {
        let (s, speed) = self.here();
        let is_passed = self.is_border_passed();
        if self.drive.legs.take().is_none() {
            return;
        }
        (self.drive.leg, self.drive.spent, self.drive.x) = (0, 0.0, speed * speed);
        let Some(mut cell) = self.cells.pop_front() else { return };
        let start = s.clamp(cell.part[0], cell.part[1] - NOTHING_LEFT / 2.0);
        cell.ends = match cell.ends {
            Ends::At(_) if is_passed => Ends::Not,
            Ends::At(border) => Ends::At(border.max(start)),
            other => other,
        };
        self.push_rest(&cell, start);
    }

    /// Puts the rest of a cell in front of the others.
    fn push_rest(&mut self, cell: &Cell, start: f64) {
        let Some(way) = self.way(cell.way).copied() else { return };
        if cell.acceleration().is_some() {
            return self.cells.push_front(cell.from(start));
        }
        // In its middle the axes may be asked for more than at its ends; what it is uneven by goes with the square of its
        // length, so the rest is cut until that does not matter.
        let length = cell.part[1] - start;
        let left = length / cell.length();
        let uneven = cell.uneven * left * left;
        let pieces = Reserve::parts(uneven).min(MOST_PIECES);
        let reserve = Reserve::of(uneven / (pieces * pieces) as f64);
        for piece in (0..pieces).rev() {
            let is_last = piece + 1 == pieces;
            let [from, to] = [piece, piece + 1].map(|piece| start + length * piece as f64 / pieces as f64);
            let part = [from, if is_last { cell.part[1] } else { to }];
            let edges = part.map(|s| Edge::new(&way, s));
            let mut rest = Cell::bent(self.scale(cell.moves), cell.way, part, [&edges[0], &edges[1]], &reserve);
            rest.ends = match cell.ends {
                Ends::At(border) if border <= part[1] && (border > from || piece == 0) => Ends::At(border),
                Ends::AtEnd if is_last => Ends::AtEnd,
                _ => Ends::Not,
            };
            (rest.moves, rest.feed_allows) = (cell.moves, cell.feed_allows);
            if is_last {
                (rest.gain, rest.stops) = (cell.gain, cell.stops);
            }
            self.cells.push_front(rest);
        }
    }

    /// True if in the first cell a move has ended already.
    pub(super) fn is_border_passed(&self) -> bool {
        self.drive.legs.as_ref().and_then(|legs| legs.border).is_some_and(|border| self.drive.leg >= border)
    }

    /// Plans the first cell if it is not; false if there is none.
    fn begin_cell(&mut self) -> bool {
        if self.drive.legs.is_some() {
            return true;
        }
        let Some(cell) = self.cells.front() else { return false };
        let end = self.end_of(0);
        let mut legs = match cell.acceleration() {
            _ if self.holds(cell) => slow_down(cell, self.drive.x),
            Some(acceleration) => speed_up(cell, acceleration, self.drive.x, end),
            None => speed_up_bent(cell, self.drive.x, end),
        };
        if let Ends::At(border) = cell.ends {
            split(&mut legs, border);
        }
        self.drive.legs = Some(legs);
        (self.drive.leg, self.drive.spent) = (0, 0.0);
        true
    }

    /// Leaves the first cell; true if a move ends with it.
    fn end_cell(&mut self) -> bool {
        let Some(cell) = self.cells.front() else { return false };
        let (stops, gain, ends) = (cell.stops, cell.gain, cell.ends == Ends::AtEnd);
        self.cells.pop_front();
        let x = self.drive.legs.take().and_then(|legs| legs.end).unwrap_or(0.0);
        self.drive.x = if stops { 0.0 } else { x / gain };
        self.settled = self.settled.saturating_sub(1);
        self.looked = self.looked.saturating_sub(1);
        self.goal = self.goal.saturating_sub(1);
        let open = self.open.as_ref().map_or(u64::MAX, |open| open.number);
        let needed = self.cells.front().map_or(open, |next| next.way);
        while self.first_way < needed && self.ways.pop_front().is_some() {
            self.first_way += 1;
        }
        if self.cells.is_empty() && self.open.is_none() {
            self.closed = false;
        }
        if ends {
            self.drop_move();
        }
        ends
    }

    fn drop_move(&mut self) {
        // A corner's feed is that of both moves: the first stays until its corner is driven.
        let open = self.open.as_ref().map_or(u64::MAX, |open| open.mover);
        let needed = self.cells.front().map_or(open, |cell| cell.moves[0]);
        while self.first_move < needed && self.asked.pop_front().is_some() {
            self.first_move += 1;
        }
    }
}
