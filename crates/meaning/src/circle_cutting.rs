//! G12 and G13: a round hole milled from its centre.
//!
//! With the cutter offset `r` of D and the hole's radius I the tool's centre runs on a circle of radius `e = I − r`: out
//! to +X on a half circle of `e/2`, once round, and back to the centre on another half circle, all in one sense.

use base::{Alarm, Condition, Point};
use dialect::Meaning;

use crate::block::Reading;
use crate::command::Body;
use crate::operation::{Act, ArcMove, Feed, Plane, Side};

/// A round hole. Positions are counts in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct CircleCut {
    /// Where the tool stands: the hole's centre.
    pub center: Point,
    /// The two axes of the hole's plane.
    pub axes: [u8; 2],
    pub plane: Plane,
    /// From the centre to where the tool's centre meets its circle.
    pub reach: [f64; 2],
    pub clockwise: bool,
    pub feed: Feed,
}

/// The round hole is three arcs: out, round, back.
const PIECES: u8 = 3;

impl CircleCut {
    /// The piece of this index, from 0. SINGLE BLOCK stops behind the last one only.
    pub fn piece(&self, index: u8) -> Option<Act> {
        let [u, v] = self.axes.map(usize::from);
        let mut wall = self.center;
        wall[u] += self.reach[0];
        wall[v] += self.reach[1];
        let middle = [(self.center[u] + wall[u]) / 2.0, (self.center[v] + wall[v]) / 2.0];
        let (to, about) = match index {
            0 => (wall, middle),
            1 => (wall, [self.center[u], self.center[v]]),
            2 => (self.center, middle),
            _ => return None,
        };
        let arc = ArcMove {
            to: to.map(|counts| counts / 1e6),
            plane: self.plane,
            axes: self.axes,
            center: about.map(|counts| counts / 1e6),
            clockwise: self.clockwise,
            full_circle: index == 1,
        };
        let exact_stop = self.feed.exact_stop && index + 1 == PIECES;
        Some(Act::Arc { arc, feed: Feed { exact_stop, ..self.feed } })
    }
}

impl Reading<'_> {
    /// G12 and G13, always in X and Y.
    pub fn cut_circle(&mut self, code: Meaning) -> Result<(), Alarm> {
        let control = self.setting.control.as_ref();
        if self.command.side != Side::Off {
            return Err(self.one_shot_alarm(Condition::CircleInCompensation));
        }
        let [Some(x), Some(y)] = [b'X', b'Y'].map(|letter| self.setting.facts.axis(letter)) else {
            return Err(self.one_shot_alarm(Condition::AddressUnavailable));
        };
        if let Some(axis) = self.axes_named().iter().next() {
            let letter = self.setting.facts.axes.get(axis).map_or(0, |facts| facts.letter);
            return Err(self.words.alarm(Condition::AddressUnavailable, letter));
        }
        let at = |letter: u8, condition| match self.words.has(letter) {
            true => self.words.alarm(condition, letter),
            false => self.one_shot_alarm(condition),
        };
        let radius = self.words.length(control, b'I', self.units)?.unwrap_or(0.0);
        if radius < 0.0 {
            let highest = control.address(b'I').map_or(0.0, |address| address.metric[1]);
            return Err(at(b'I', Condition::ValueOutOfRange).with([radius / 1e6, 0.0, highest]));
        }
        let offset = match self.offset(self.setting.memory.radius(self.next.d)) {
            Some(offset) if self.next.d > 0 => offset,
            _ => return Err(at(b'D', Condition::CircleOffsetMissing)),
        };
        let transform = self.next.transform;
        // The hole is scaled, the cutter is not.
        let radius = transform.size([x, y], radius);
        let reach = radius - offset;
        if radius == 0.0 || reach <= 0.0 {
            return Err(at(b'I', Condition::CircleTooSmall).with([radius / 1e6, offset / 1e6, 0.0]));
        }
        let feed = self.feed().map_err(|alarm| self.one_shot_alarm(alarm.condition))?;
        self.command.body = Body::Circle(CircleCut {
            center: self.next.machine,
            axes: [x as u8, y as u8],
            plane: Plane::Xy,
            reach: transform.vector([x, y], [1.0, 0.0]).map(|arm| arm / transform.size([x, y], 1.0) * reach),
            clockwise: (code == Meaning::CircleCutClockwise) != transform.turns_over([x, y]),
            feed,
        });
        Ok(())
    }
}
