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

    /// True if it is to turn backward from here to there: the shorter way, forward of two alike.
    pub fn goes_back(&self, from: u32, to: u32) -> bool {
        let ahead = (to + self.positions - from) % self.positions;
        self.backward.is_some() && ahead > self.positions - ahead
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

    /// The position at which it stands, or the one that it has left last.
    pub fn position(&self, rotor: &Rotor) -> u32 {
        (self.at.round().rem_euclid(f64::from(rotor.positions))) as u32
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
        assert!(!rotor.goes_back(0, 6) && rotor.goes_back(0, 7) && !rotor.goes_back(11, 1));
        assert!(!self::rotor(None).goes_back(0, 7), "it cannot");
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
        assert_eq!((turning.position(&rotor), turning.cam, turning.next(&rotor)), (1, true, None));
        // Stopped between two positions it goes on from there.
        turning.turn(1, &rotor, 20.0);
        turning.pass(false, &rotor, 20.125);
        turning.turn(0, &rotor, 20.25);
        turning.turn(1, &rotor, 30.0);
        assert_eq!(turning.next(&rotor), Some((30.25, true)));
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
