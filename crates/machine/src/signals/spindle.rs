//! The spindle as its drive runs it: ramps, the speed-reached signal, orientation.
//!
//! Its speed changes by the same amount in every second: from rest to the highest one in the acceleration time.

use base::Seconds;
use data::Table;
use meaning::{CodeLine, CodeOut};

use crate::path_table::{not_negative, positive};

/// What the builder says of the spindle.
#[derive(Clone, PartialEq, Debug)]
pub struct SpindleFacts {
    /// The highest speed, rev/min.
    pub max_rpm: f64,
    /// From rest to the highest speed, s.
    pub acceleration_time: f64,
    /// From rest to its angle, s.
    pub orientation_time: f64,
    /// M codes that turn it forward, backward, stop it, and stop it at its angle.
    pub codes: [Vec<u32>; 4],
    /// Speeds of S codes that are no speeds themselves, rev/min.
    pub speeds: Vec<(u32, f64)>,
    /// Codes that change the speed are done when it is reached.
    pub waits: bool,
    /// The longest time to the speed, s.
    pub time_out: f64,
}

impl Default for SpindleFacts {
    /// A file without `[spindle]`.
    fn default() -> SpindleFacts {
        SpindleFacts {
            max_rpm: 6000.0,
            acceleration_time: 1.0,
            orientation_time: 0.5,
            codes: [vec![3], vec![4], vec![5], vec![19]],
            speeds: Vec::new(),
            waits: false,
            time_out: 5.0,
        }
    }
}

/// Reads `[spindle]`.
pub(crate) fn spindle(table: &mut Table) -> SpindleFacts {
    let missing = SpindleFacts::default();
    let max_rpm = positive(table, "max_rpm", missing.max_rpm);
    let acceleration_time = not_negative(table, "acceleration_time", missing.acceleration_time);
    table.choice("tapping", &[("float", ()), ("rigid", ())]);
    let [forward, backward, stop, orient] = missing.codes;
    let mut codes = |key, missing| match table.integers(key) {
        Some(list) => list.into_iter().filter_map(|code| u32::try_from(code).ok()).collect(),
        None => missing,
    };
    let codes =
        [codes("forward", forward), codes("reverse", backward), codes("stop", stop), codes("orientation", orient)];
    SpindleFacts {
        max_rpm,
        acceleration_time,
        orientation_time: not_negative(table, "orientation_time", missing.orientation_time),
        codes,
        speeds: table.table("speeds", speeds).unwrap_or_default(),
        waits: table.boolean("wait_for_speed").unwrap_or(false),
        time_out: positive(table, "speed_timeout", 5.0 * acceleration_time.max(1.0)),
    }
}

/// `s12 = 500`: which speed a code of S is.
fn speeds(table: &mut Table) -> Vec<(u32, f64)> {
    let mut speeds = Vec::new();
    for entry in table.rest() {
        match entry.key.strip_prefix('s').and_then(|digits| digits.parse().ok()) {
            Some(code) => speeds.extend(entry.number().map(|rpm| (code, rpm.max(0.0)))),
            None => entry.error(format!("`{}` is no code of S; write s12 = 500", entry.key)),
        }
    }
    speeds
}

/// What the spindle shall do.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Turns {
    Forward,
    Backward,
    Stands,
    Orients,
}

/// The order of the codes in a file.
const TURNS: [Turns; 4] = [Turns::Forward, Turns::Backward, Turns::Stands, Turns::Orients];

/// A spindle in virtual time.
#[derive(Clone, PartialEq, Debug)]
pub struct Spindle {
    facts: SpindleFacts,
    /// The digits of S are a speed.
    digits: u8,
    commanded_rpm: f64,
    turns: Turns,
    /// The speed at the last command, with its direction, and when that was.
    from_rpm: f64,
    since: f64,
    target_rpm: f64,
    /// What has been reached is told.
    told: bool,
    /// It does not get to its speed.
    weak: bool,
}

/// The digits of S from which on it says a speed.
const SPEED_DIGITS: u8 = 4;

impl Spindle {
    /// A spindle that stands.
    pub fn new(facts: SpindleFacts) -> Spindle {
        Spindle {
            facts,
            digits: SPEED_DIGITS,
            commanded_rpm: 0.0,
            turns: Turns::Stands,
            from_rpm: 0.0,
            since: 0.0,
            target_rpm: 0.0,
            told: true,
            weak: false,
        }
    }

    /// The speed now, rev/min; backward is negative.
    pub fn rpm(&self, now: f64) -> f64 {
        let target = self.reachable();
        let change = self.rate() * (now - self.since).max(0.0);
        let left = target - self.from_rpm;
        if left.abs() <= change { target } else { self.from_rpm + change * left.signum() }
    }

    /// Rev/min in a second.
    fn rate(&self) -> f64 {
        let time = self.facts.acceleration_time;
        if time > 0.0 { self.facts.max_rpm / time } else { f64::INFINITY }
    }

    fn reachable(&self) -> f64 {
        if self.weak { self.target_rpm / 2.0 } else { self.target_rpm }
    }

    /// When it is at its speed, or at its angle.
    pub fn arrives(&self) -> f64 {
        let left = (self.target_rpm - self.from_rpm).abs();
        let angle = if self.turns == Turns::Orients { self.facts.orientation_time } else { 0.0 };
        if self.weak && self.target_rpm != 0.0 {
            return f64::INFINITY;
        }
        self.since + if left > 0.0 { left / self.rate() } else { 0.0 } + angle
    }

    /// The machine takes a code, if it is about the spindle; true if what it does changes.
    pub fn take(&mut self, code: CodeOut, now: f64) -> bool {
        let before = (self.turns, self.target_rpm);
        match code.line {
            CodeLine::S => {
                self.digits = code.digits;
                let listed = self.facts.speeds.iter().find(|(own, _)| *own == code.code).map(|(_, rpm)| *rpm);
                let plain = (code.digits >= SPEED_DIGITS).then_some(f64::from(code.code));
                self.commanded_rpm = listed.or(plain).unwrap_or(0.0).min(self.facts.max_rpm);
            }
            CodeLine::M => {
                let row = self.facts.codes.iter().position(|codes| codes.contains(&code.code));
                let Some(turns) = row.and_then(|row| TURNS.get(row)) else { return false };
                self.turns = *turns;
            }
            CodeLine::T | CodeLine::B => return false,
        }
        let target = match self.turns {
            Turns::Forward => self.commanded_rpm,
            Turns::Backward => -self.commanded_rpm,
            Turns::Stands | Turns::Orients => 0.0,
        };
        let changes = (self.turns, target) != before;
        if changes {
            self.from_rpm = self.rpm(now);
            (self.since, self.target_rpm, self.told) = (now, target, false);
        }
        changes
    }

    /// How long a code that was just taken takes, if the machine is done only then.
    pub fn takes(&self, now: f64) -> f64 {
        if self.facts.waits { (self.arrives() - now).max(0.0) } else { 0.0 }
    }

    /// True if it turns or shall turn.
    pub fn is_turning(&self) -> bool {
        self.target_rpm != 0.0
    }

    /// True if it stands at its angle once it has arrived.
    pub fn orients(&self) -> bool {
        self.turns == Turns::Orients
    }

    /// When it arrives, if that has not been told.
    pub fn next(&self) -> Option<f64> {
        (!self.told).then(|| self.arrives()).filter(|at| at.is_finite())
    }

    /// True once it has been told that it has arrived.
    pub fn has_arrived(&self) -> bool {
        self.told
    }

    /// It has been told that it has arrived.
    pub fn pass(&mut self) {
        self.told = true;
    }

    /// When the control gives it up, and the speed that was asked for.
    pub fn gives_up(&self) -> Option<(Seconds, f64)> {
        let fails = !self.told && self.weak && self.target_rpm != 0.0;
        fails.then_some((Seconds(self.since + self.facts.time_out), self.target_rpm.abs()))
    }

    /// True if it does not get to its speed.
    pub fn is_weak(&self) -> bool {
        self.weak
    }

    /// It does not get to its speed, or does again.
    pub fn set_weak(&mut self, weak: bool, now: f64) {
        self.from_rpm = self.rpm(now);
        (self.since, self.weak) = (now, weak);
        self.told &= !weak || self.target_rpm == 0.0;
    }

    /// The drive is off: it runs down.
    pub fn stop(&mut self, now: f64) {
        self.from_rpm = self.rpm(now);
        (self.since, self.target_rpm, self.turns, self.told) = (now, 0.0, Turns::Stands, self.from_rpm == 0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn code(line: CodeLine, code: u32) -> CodeOut {
        CodeOut { line, code, digits: if line == CodeLine::S { 4 } else { 2 }, after_motion: false }
    }

    #[test]
    fn its_speed_changes_by_the_same_amount_in_every_second() {
        let mut spindle = Spindle::new(SpindleFacts::default());
        assert!(!spindle.take(code(CodeLine::S, 3000), 0.0), "nothing turns it yet");
        assert!(spindle.take(code(CodeLine::M, 3), 1.0));
        assert_eq!((spindle.rpm(1.25), spindle.arrives()), (1500.0, 1.5));
        // Backward from 3000 forward is twice the way.
        assert!(spindle.take(code(CodeLine::M, 4), 2.0));
        assert_eq!((spindle.rpm(2.5), spindle.arrives()), (0.0, 3.0));
        assert!(spindle.take(code(CodeLine::M, 19), 4.0));
        assert_eq!((spindle.rpm(4.5), spindle.arrives()), (0.0, 5.0));
    }

    #[test]
    fn a_weak_one_never_arrives() {
        let mut spindle = Spindle::new(SpindleFacts::default());
        spindle.set_weak(true, 0.0);
        spindle.take(code(CodeLine::S, 3000), 0.0);
        spindle.take(code(CodeLine::M, 3), 0.0);
        assert_eq!((spindle.rpm(9.0), spindle.next()), (1500.0, None));
        assert_eq!(spindle.gives_up(), Some((Seconds(5.0), 3000.0)));
    }
}
