//! Drives a session servo period by servo period and looks at every setpoint: speed, its first and second difference,
//! the way.

pub mod case;
pub mod path;
pub mod programs;

use std::fmt;

use base::{AXES, Point, Seconds};
use machine::EventKind;
use motion::{Limits, Model, Setpoint};
use station::{Percents, Session, Step};
use testkit::Dice;

use crate::watch::Texts;
use path::Paths;

/// The bar.
const SLACK: f64 = 1.001;
/// Speed that an axis of model `classic` may have left of the move before when positioning begins.
const LEFT_OVER: f64 = 1.002;
/// Times that CYCLE START is pressed.
const MOST_STARTS: u64 = 500;

/// The highest part of any limit that was asked for, and of how much that is the figure.
#[derive(Clone, Debug, Default)]
pub struct Figures {
    pub programs: u64,
    pub moves: u64,
    pub periods: u64,
    pub acts: u64,
    pub velocity: f64,
    pub acceleration: f64,
    pub jerk: f64,
    /// Off the path, as a part of the tolerance.
    pub path: f64,
}

impl fmt::Display for Figures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Figures { programs, moves, periods, acts, velocity, acceleration, jerk, path } = self;
        write!(
            f,
            "{programs} programs, {moves} moves, {periods} servo periods, {acts} acts; highest part of the limit: \
             velocity {velocity:.6}, acceleration {acceleration:.6}, jerk {jerk:.6}, path {path:.6}"
        )
    }
}

/// What the operator does: nothing, or anything at any time.
#[derive(Clone, Copy, Debug)]
pub struct Hand(Option<Dice>);

impl Hand {
    pub fn off() -> Hand {
        Hand(None)
    }

    pub fn on(seed: u64) -> Hand {
        Hand(Some(Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1)))
    }

    pub fn is_on(&self) -> bool {
        self.0.is_some()
    }

    /// A number below `count`, never 0 from a hand that is off.
    fn throw(&mut self, count: u64) -> u64 {
        self.0.as_mut().map_or(1, |dice| dice.throw(count))
    }

    /// Something is done in one period of a hundred; true if something is.
    fn act(&mut self, session: &mut Session<Texts>) -> bool {
        if self.throw(100) != 0 {
            return false;
        }
        match self.throw(5) {
            0 if session.is_running() => session.feed_hold(),
            0 => return false,
            1 => {
                let on = self.throw(2) == 0;
                if session.set_switch("single-block", station::Which::One, on).is_ok() {
                    session.stand_soon();
                }
            }
            2 => session.set_percents(Percents::default()),
            _ => {
                let [feed, rapid] = [self.throw(21) as u16 * 10, [25, 50, 100][self.throw(3) as usize]];
                session.set_percents(Percents { feed: feed.max(10), rapid, ..Percents::default() });
            }
        }
        true
    }
}

/// What is looked at.
struct Look<'f> {
    limits: Limits,
    period: f64,
    /// The last setpoint, and how its speed had changed.
    last: Option<(Setpoint, Option<Point>)>,
    paths: Paths,
    figures: &'f mut Figures,
}

/// Drives the selected program to its end, so many periods at most.
pub fn drive(session: &mut Session<Texts>, most: u64, hand: &mut Hand, figures: &mut Figures) -> Result<(), String> {
    session.run_live();
    session.start();
    let limits = session.configuration().machine.limits();
    let period = limits.servo_period;
    let begun = figures.periods;
    figures.programs += 1;
    let mut look = Look { limits, period, last: None, paths: Paths::new(&limits), figures };
    let (mut now, mut starts, mut last) = (0u64, 0, false);
    while !last && look.figures.periods - begun < most {
        now += 1;
        look.figures.acts += u64::from(hand.act(session));
        loop {
            match session.next_until(Seconds(now as f64 * period)) {
                None => break,
                Some(Step::Event(event)) => look.moved(&event.kind),
                Some(Step::Stopped) if starts < MOST_STARTS => {
                    starts += 1;
                    session.start();
                }
                Some(Step::Stopped | Step::Idle) => last = true,
                Some(Step::Failed(error)) => panic!("texts in memory can be read: {error}"),
            }
            if last {
                break;
            }
        }
        let reached = (session.time().0 / period - 1e-6).ceil() as u64;
        if reached > now {
            // What is executed as a whole has passed: dwells, answers, moves to a signal.
            (now, look.last) = (reached, None);
            look.paths.leave();
            continue;
        }
        let stands = Setpoint { position: session.position(), velocity: [0.0; AXES] };
        let setpoint = match session.setpoint() {
            // One move has just ended and the next one not begun.
            None if session.is_moving() => {
                look.last = None;
                continue;
            }
            setpoint => setpoint.unwrap_or(stands),
        };
        look.at(&setpoint).map_err(|what| format!("period {now}: {what}"))?;
    }
    if last && !hand.is_on() {
        look.paths.end();
    }
    look.off_the_path()
}

impl Look<'_> {
    fn moved(&mut self, event: &EventKind) {
        self.figures.moves += u64::from(self.paths.moved(event));
    }

    fn at(&mut self, now: &Setpoint) -> Result<(), String> {
        self.figures.periods += 1;
        if !matches!(self.limits.model, Model::Classic(_)) {
            self.paths.at(&now.position);
            self.off_the_path()?;
        }
        let is_classic = matches!(self.limits.model, Model::Classic(_));
        let mut changes = [0.0; AXES];
        for axis in 0..self.limits.count {
            let limit = &self.limits.axes[axis];
            let rate = limit.rapid.max(limit.max_feed);
            let part = now.velocity[axis].abs() / rate;
            if part.is_nan() || part > if is_classic { LEFT_OVER } else { SLACK } {
                return Err(format!("axis {axis}: velocity {part} of its limit"));
            }
            self.figures.velocity = self.figures.velocity.max(part);
            let (Some((last, before)), false) = (&self.last, is_classic) else { continue };
            changes[axis] = (now.velocity[axis] - last.velocity[axis]) / self.period;
            // The direction of a short way is as exact as its ends are.
            let noise = self.paths.noise() * now.velocity[axis].abs() / self.period;
            let part = (changes[axis].abs() - noise) / limit.acceleration;
            if part > SLACK {
                return Err(format!("axis {axis}: acceleration {part} of its limit at {:?}", now.position));
            }
            self.figures.acceleration = self.figures.acceleration.max(part);
            let (Some(before), true) = (before, self.limits.jerk(axis).is_finite()) else { continue };
            let jerk = ((changes[axis] - before[axis]).abs() - 2.0 * noise) / self.period;
            let part = jerk / self.limits.jerk(axis);
            if part > SLACK {
                return Err(format!("axis {axis}: jerk {part} of its limit at {:?}", now.position));
            }
            self.figures.jerk = self.figures.jerk.max(part);
        }
        let changes = self.last.is_some().then_some(changes);
        self.last = Some((*now, changes));
        Ok(())
    }

    fn off_the_path(&mut self) -> Result<(), String> {
        let (part, at) = self.paths.worst();
        if part > SLACK {
            return Err(format!("{part} of the tolerance off the path at {at:?}"));
        }
        self.figures.path = self.figures.path.max(part);
        Ok(())
    }
}
