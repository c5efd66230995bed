//! What the outputs of a virtual machine move, and the inputs that this drives: a slide between two ends, and what turns
//! from position to position.

/// Something that an output moves from one end to the other.
#[derive(Clone, PartialEq, Debug)]
pub struct Actuator {
    /// The output that moves it to its end.
    pub output: u8,
    /// The output that moves it back; without one it goes back when the first is off.
    pub back: Option<u8>,
    /// The input that is on at its end, and the one that is on when it is back.
    pub inputs: [Option<u8>; 2],
    /// From end to end, and back, s.
    pub times: [f64; 2],
}

/// Something that turns from position to position: a magazine, an index table.
#[derive(Clone, PartialEq, Debug)]
pub struct Rotor {
    /// Its name.
    pub name: String,
    /// How many positions it has.
    pub positions: u32,
    /// The code of the first one.
    pub first: u32,
    /// From the code of one to that of the next.
    pub step: u32,
    /// The output that turns it forward.
    pub forward: u8,
    /// The output that turns it backward; without one it turns forward only.
    pub backward: Option<u8>,
    /// The input that turns on at each position.
    pub count: u8,
    /// From one position to the next, s.
    pub time: f64,
}

impl Rotor {
    /// The position of a code, from 0.
    pub fn position_of(&self, code: u32) -> Option<u32> {
        let way = code.checked_sub(self.first)?;
        let position = way / self.step;
        (way % self.step == 0 && position < self.positions).then_some(position)
    }

    /// Which way it is to turn from here to there: the shorter one, forward of two alike, 0 if it stands there.
    pub fn way(&self, from: Counted, to: u32) -> i8 {
        // In half positions: between two it has half a one to the next.
        let round = 2 * self.positions;
        let here = (2 * from.position + round).wrapping_add_signed(i32::from(from.left)) % round;
        let ahead = (2 * to + round - here) % round;
        match ahead {
            0 => 0,
            _ if self.backward.is_some() && ahead > round - ahead => -1,
            _ => 1,
        }
    }
}

/// Where the logic takes something that turns to be, by the pulses that it has seen.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Counted {
    /// The position at which it stands or that it has left last.
    pub position: u32,
    /// Which way it has left that; 0 if it stands there.
    pub left: i8,
}

impl Counted {
    /// Its input turns off or on while the outputs turn it this way.
    pub fn see(&mut self, on: bool, way: i8, positions: u32) {
        if !on {
            self.left = way;
        } else {
            // Turned back between two positions it comes to the same one again.
            let moved = if self.left == way { i32::from(way) } else { 0 };
            self.position = (self.position + positions).wrapping_add_signed(moved) % positions;
            self.left = 0;
        }
    }
}

/// Where a slide is: 0 back, 1 at its end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Slide {
    at: f64,
    since: f64,
    way: i8,
}

impl Slide {
    /// At one of its ends.
    pub fn standing(at_end: bool) -> Slide {
        if at_end { Slide { at: 1.0, since: 0.0, way: 1 } } else { Slide { at: 0.0, since: 0.0, way: -1 } }
    }

    /// When it arrives, if it is on its way.
    pub fn arrives(&self, actuator: &Actuator) -> Option<f64> {
        match self.way {
            1 if self.at < 1.0 => Some(self.since + (1.0 - self.at) * actuator.times[0]),
            -1 if self.at > 0.0 => Some(self.since + self.at * actuator.times[1]),
            _ => None,
        }
    }

    /// It has arrived.
    pub fn arrive(&mut self, now: f64) {
        (self.at, self.since) = (if self.way > 0 { 1.0 } else { 0.0 }, now);
    }

    /// The outputs move it this way from now on, or not at all.
    pub fn turn(&mut self, way: i8, actuator: &Actuator, now: f64) {
        if way == self.way {
            return;
        }
        let passed = (now - self.since).max(0.0);
        let part = |time: f64| if time > 0.0 { passed / time } else { 1.0 };
        match self.way {
            1 => self.at = (self.at + part(actuator.times[0])).min(1.0),
            -1 => self.at = (self.at - part(actuator.times[1])).max(0.0),
            _ => {}
        }
        (self.since, self.way) = (now, way);
    }

    /// Whether the inputs of its two ends are on.
    pub fn ends(&self) -> [bool; 2] {
        [self.at >= 1.0 && self.way >= 0, self.at <= 0.0 && self.way <= 0]
    }
}

/// The part of the way to the next position on which the input of the last one is still on.
const CAM: f64 = 0.25;

/// Where something that turns is, in positions.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Turning {
    at: f64,
    since: f64,
    way: i8,
    /// Its input is on.
    pub cam: bool,
}

impl Turning {
    /// At its first position.
    pub const STANDS: Turning = Turning { at: 0.0, since: 0.0, way: 0, cam: true };

    /// The next edge of its input, and whether it turns on.
    pub fn next(&self, rotor: &Rotor) -> Option<(f64, bool)> {
        if self.way == 0 {
            return None;
        }
        let beside = (self.at - self.at.round()).abs();
        if self.cam {
            return Some((self.since + (CAM - beside).max(0.0) * rotor.time, false));
        }
        Some((self.since + (self.goal() - self.at).abs() * rotor.time, true))
    }

    /// The next position on its way.
    fn goal(&self) -> f64 {
        if self.way > 0 { self.at.floor() + 1.0 } else { self.at.ceil() - 1.0 }
    }

    /// The edge has come.
    pub fn pass(&mut self, on: bool, rotor: &Rotor, now: f64) {
        self.cam = on;
        if on {
            (self.at, self.since) = (self.goal().rem_euclid(f64::from(rotor.positions)), now);
        }
    }

    /// The outputs turn it this way from now on, or not at all.
    pub fn turn(&mut self, way: i8, rotor: &Rotor, now: f64) {
        if way == self.way {
            return;
        }
        let passed = (now - self.since).max(0.0) / rotor.time;
        let end = self.goal();
        self.at += f64::from(self.way) * passed;
        if self.way > 0 && self.at > end || self.way < 0 && self.at < end {
            self.at = end;
        }
        (self.since, self.way) = (now, way);
    }

    /// Where it stands, as someone finds it who looks.
    pub fn found(&self, rotor: &Rotor) -> Counted {
        let at = if self.cam { self.at.round() } else { self.at.floor() };
        let position = at.rem_euclid(f64::from(rotor.positions)) as u32;
        Counted { position, left: i8::from(!self.cam) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rotor(backward: Option<u8>) -> Rotor {
        let name = "table".to_owned();
        Rotor { name, positions: 12, first: 0, step: 30, forward: 0, backward, count: 1, time: 0.5 }
    }

    #[test]
    fn codes_name_positions_and_the_way_is_the_shorter_one() {
        let rotor = rotor(Some(2));
        assert_eq!([0, 90, 330].map(|code| rotor.position_of(code)), [Some(0), Some(3), Some(11)]);
        assert_eq!([45, 360].map(|code| rotor.position_of(code)), [None, None]);
        let stands = |position| Counted { position, left: 0 };
        assert_eq!([0, 1, 6, 7].map(|to| rotor.way(stands(0), to)), [0, 1, 1, -1]);
        assert_eq!((rotor.way(stands(11), 1), self::rotor(None).way(stands(0), 7)), (1, 1));
        // Between two positions it is at neither.
        let between = Counted { position: 0, left: 1 };
        assert_eq!([0, 1].map(|to| rotor.way(between, to)), [-1, 1]);
        assert_eq!(self::rotor(None).way(between, 0), 1, "the long way round");
    }

    #[test]
    fn a_position_has_its_pulse() {
        let (rotor, mut turning) = (rotor(None), Turning::STANDS);
        turning.turn(1, &rotor, 10.0);
        assert_eq!(turning.next(&rotor), Some((10.125, false)));
        turning.pass(false, &rotor, 10.125);
        assert_eq!(turning.next(&rotor), Some((10.5, true)));
        turning.pass(true, &rotor, 10.5);
        turning.turn(0, &rotor, 10.5);
        assert_eq!((turning.found(&rotor), turning.next(&rotor)), (Counted { position: 1, left: 0 }, None));
        // Stopped between two positions it goes on from there.
        turning.turn(1, &rotor, 20.0);
        turning.pass(false, &rotor, 20.125);
        turning.turn(0, &rotor, 20.25);
        assert_eq!(turning.found(&rotor), Counted { position: 1, left: 1 });
        turning.turn(1, &rotor, 30.0);
        assert_eq!(turning.next(&rotor), Some((30.25, true)));
    }

    #[test]
    fn pulses_are_counted_either_way() {
        let mut counted = Counted::default();
        for (on, way) in [(false, -1), (true, -1), (false, 1), (true, -1), (false, 1), (true, 1)] {
            counted.see(on, way, 12);
        }
        assert_eq!(counted, Counted { position: 0, left: 0 });
    }

    #[test]
    fn a_slide_turned_back_on_its_way_goes_back_as_far() {
        let actuator = Actuator { output: 0, back: None, inputs: [Some(1), Some(2)], times: [0.5, 1.0] };
        let mut slide = Slide::standing(false);
        assert_eq!(slide.ends(), [false, true]);
        slide.turn(1, &actuator, 1.0);
        assert_eq!((slide.ends(), slide.arrives(&actuator)), ([false, false], Some(1.5)));
        slide.turn(-1, &actuator, 1.25);
        assert_eq!(slide.arrives(&actuator), Some(1.75));
        slide.arrive(1.75);
        assert_eq!((slide.ends(), slide.arrives(&actuator)), ([false, true], None));
    }
}
