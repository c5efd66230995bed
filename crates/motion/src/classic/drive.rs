//! The interpolator through time: phase after phase, a whole move or a servo period at a time.

use base::{AXES, Point};

use super::{Interpolator, Phase, Setpoint, Spent, What, lag};
use crate::classic::ramp::Rapid;

/// What happens in a spell.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum SpellKind {
    /// The block is waited for.
    Starving,
    /// The interpolator runs along a cut.
    Cutting,
    /// The axes are waited for until they are in position.
    Settling,
    /// Rapid.
    Rapid,
}

/// A spell of time in which nothing changes for the interpolator.
#[derive(Clone, Copy, Debug)]
pub struct Spell<'i> {
    of: &'i Interpolator,
    /// What happens.
    pub kind: SpellKind,
    /// How long it lasts, s.
    pub seconds: f64,
    /// The speed of the interpolator along its cut, mm/s; zero where it runs along none.
    pub speed: f64,
}

impl Spell<'_> {
    /// Where the axes are after a time, and how fast.
    pub fn at(&self, seconds: f64) -> Setpoint {
        self.of.seen_at(self.of.spent + seconds, self.of.at.unwrap_or_default())
    }

    /// Where the interpolator is after a time.
    pub fn commanded_at(&self, seconds: f64) -> Point {
        self.of.commanded(self.of.spent + seconds, self.of.at.unwrap_or_default()).position
    }
}

impl Interpolator {
    /// Drives to the end of the next move: how long that takes, s. `spell` is shown every spell of it.
    ///
    /// What stands still (an override of zero, a hold) takes an infinite time; the next move begins at its end.
    pub fn drive_move(&mut self, mut spell: impl FnMut(&Spell)) -> f64 {
        let mut total = 0.0;
        while self.begin() {
            let seconds = (self.seconds - self.spent).max(0.0);
            if let Some(kind) = self.kind() {
                let speed = if let Phase::Cutting { speed, .. } = self.phase { speed } else { 0.0 };
                spell(&Spell { of: self, kind, seconds, speed });
            }
            total += seconds;
            self.spent = self.seconds;
            if self.leave() {
                break;
            }
        }
        total
    }

    /// Drives for a time, at most to the end of the next move: the time that is left over, and whether the move has
    /// ended.
    pub fn drive_for(&mut self, mut seconds: f64) -> (f64, bool) {
        while self.begin() {
            let rest = (self.seconds - self.spent).max(0.0);
            if rest > seconds {
                self.spent += seconds;
                return (0.0, false);
            }
            seconds -= rest;
            self.spent = self.seconds;
            if self.leave() {
                return (seconds, true);
            }
        }
        (seconds, false)
    }

    /// Where the axes are now, and how fast; `None` if no move has been added yet.
    pub fn setpoint(&self) -> Option<Setpoint> {
        self.at.map(|at| self.seen_at(self.spent, at))
    }

    /// Where the interpolator is now, which the axes follow; `None` if no move has been added yet.
    pub fn commanded_position(&self) -> Option<Point> {
        self.at.map(|at| self.commanded(self.spent, at).position)
    }

    /// True if no axis is commanded to move and all are in position.
    pub fn is_standing(&self) -> bool {
        let commanded = self.commanded(self.spent, [0.0; AXES]).velocity;
        let behind = self.behind_at(self.spent);
        commanded.iter().all(|&speed| speed == 0.0)
            && self.tail_at(self.spent).is_none()
            && behind.iter().all(|behind| behind.abs() <= self.model.in_position_mm)
    }

    fn kind(&self) -> Option<SpellKind> {
        match self.phase {
            Phase::Between => None,
            Phase::Starving => Some(SpellKind::Starving),
            Phase::Cutting { .. } => Some(SpellKind::Cutting),
            Phase::Settling => Some(SpellKind::Settling),
            Phase::Rapid => Some(SpellKind::Rapid),
        }
    }

    /// Begins the next move, or waits for its block; false if there is none.
    fn begin(&mut self) -> bool {
        if self.phase != Phase::Between {
            return true;
        }
        let Some(ahead) = self.ahead.front_mut() else { return false };
        let (what, blocks) = (ahead.what, std::mem::take(&mut ahead.blocks));
        let waited = self.take_blocks(blocks);
        self.spent = 0.0;
        if waited > 0.0 {
            (self.phase, self.seconds) = (Phase::Starving, waited);
            return true;
        }
        self.at = Some(what.start());
        match what {
            What::Cut(cut) => self.cut_from(&cut, 0.0),
            What::Rapid { from, to } => {
                self.rapid = Rapid::new(&from, &to, &self.rates(&from, &to));
                self.phase = Phase::Rapid;
                self.seconds = self.rapid_seconds();
            }
        }
        true
    }

    /// The interpolator runs on from here.
    fn cut_from(&mut self, cut: &crate::Move, s: f64) {
        let speed = self.speed(cut);
        let steady = lag::steady(&cut.way, s, speed, self.model.feed_s);
        let excess = std::array::from_fn(|axis| self.behind[axis] - steady[axis]);
        let rest = cut.way.length() - s;
        self.phase = Phase::Cutting { s, speed, excess };
        self.seconds = if rest > 0.0 { rest / speed } else { 0.0 };
    }

    /// How long until the next move may begin. Without a check the next rapid begins when the last axis slows down, but
    /// not before the rapid in front of this one has ended: no more than two go together.
    fn rapid_seconds(&self) -> f64 {
        let goes_over = matches!(self.ahead.get(1), Some(next) if matches!(next.what, What::Rapid { .. }));
        let checked = self.ahead.front().is_none_or(|this| this.stops);
        let own = if goes_over && !checked { self.rapid.released } else { self.rapid.seconds };
        own.max(self.tail.as_ref().map_or(0.0, |(tail, spent)| tail.seconds - spent))
    }

    /// Leaves a phase at its end; true if the move ends with it.
    fn leave(&mut self) -> bool {
        let seconds = if self.seconds.is_finite() { self.seconds } else { 0.0 };
        let phase = self.phase;
        let stood_still = self.seconds == f64::INFINITY;
        self.behind = if stood_still { [0.0; AXES] } else { self.behind_at(seconds) };
        self.account(seconds);
        let ended = match (phase, self.ahead.front()) {
            (Phase::Cutting { .. }, Some(front)) => {
                self.at = front.what.way().map(|way| way.at(way.length())).or(self.at);
                let wait = lag::settling(&self.behind, self.model.in_position_mm, self.model.feed_s);
                if front.stops && wait > 0.0 {
                    (self.phase, self.seconds, self.spent) = (Phase::Settling, wait, 0.0);
                    return false;
                }
                true
            }
            (Phase::Rapid, _) => {
                self.at = Some(self.rapid.to);
                if !stood_still && seconds < self.rapid.seconds {
                    self.tail = Some((self.rapid, seconds));
                }
                true
            }
            (Phase::Settling, _) => true,
            _ => false,
        };
        (self.phase, self.seconds, self.spent) = (Phase::Between, 0.0, 0.0);
        if ended {
            self.ahead.pop_front();
            self.last = std::mem::take(&mut self.this);
            if stood_still {
                self.last.seconds = f64::INFINITY;
            }
        }
        ended
    }

    /// Counts time of the present phase.
    fn account(&mut self, seconds: f64) {
        self.clock += seconds;
        self.this.seconds += seconds;
        match self.phase {
            Phase::Starving => self.this.starving += seconds,
            Phase::Settling => self.this.settling += seconds,
            _ => {}
        }
        if let Some((tail, spent)) = &mut self.tail {
            *spent += seconds;
            if *spent >= tail.seconds {
                self.tail = None;
            }
        }
    }

    /// Time passes between moves.
    pub(super) fn elapse(&mut self, seconds: f64) {
        self.behind = self.behind_at(seconds);
        self.account(seconds);
        self.this = Spent::default();
    }

    /// What is under way goes on with other speeds from where it is.
    pub(super) fn go_on_anew(&mut self) {
        let Some(what) = self.ahead.front().map(|ahead| ahead.what) else { return };
        let spent = self.spent;
        match (self.phase, what) {
            (Phase::Cutting { s, speed, .. }, What::Cut(cut)) => {
                self.behind = self.behind_at(spent);
                self.account(spent);
                self.cut_from(&cut, s + speed * spent);
            }
            (Phase::Rapid, What::Rapid { from, to }) => {
                self.behind = self.behind_at(spent);
                self.account(spent);
                self.rapid.plan(spent, &self.rates(&from, &to));
                self.seconds = self.rapid_seconds();
            }
            // Nothing moves by itself.
            _ => return,
        }
        self.spent = 0.0;
    }

    /// What the axes are behind the interpolator after so much of the phase.
    fn behind_at(&self, spent: f64) -> Point {
        let tau = self.model.feed_s;
        let left = lag::left_after(spent, tau);
        match (&self.phase, self.ahead.front().and_then(|front| front.what.way())) {
            (Phase::Cutting { s, speed, excess }, Some(way)) => {
                let steady = lag::steady(way, s + speed * spent, *speed, tau);
                std::array::from_fn(|axis| steady[axis] + excess[axis] * left)
            }
            _ => self.behind.map(|behind| behind * left),
        }
    }

    /// The rapid that is still slowing down after so much of the phase.
    fn tail_at(&self, spent: f64) -> Option<(&Rapid, f64)> {
        let (tail, before) = self.tail.as_ref()?;
        (before + spent < tail.seconds).then_some((tail, before + spent))
    }

    /// What is commanded, before any lag.
    fn commanded(&self, spent: f64, at: Point) -> Setpoint {
        let way = self.ahead.front().and_then(|front| front.what.way());
        match (&self.phase, way) {
            (Phase::Cutting { s, speed, .. }, Some(way)) => {
                let s = (s + speed * spent).min(way.length());
                let slope = way.slope(s);
                Setpoint { position: way.at(s), velocity: slope.map(|slope| slope * speed) }
            }
            (Phase::Rapid, _) => self.rapid.at(spent),
            _ => Setpoint { position: at, velocity: [0.0; AXES] },
        }
    }

    /// Where the axes are after so much of the phase, and how fast.
    fn seen_at(&self, spent: f64, at: Point) -> Setpoint {
        let Setpoint { mut position, velocity } = self.commanded(spent, at);
        let mut own = if self.phase == Phase::Rapid { velocity } else { [0.0; AXES] };
        let behind = self.behind_at(spent);
        for axis in 0..AXES {
            position[axis] -= behind[axis];
            own[axis] += behind[axis] / self.model.feed_s;
        }
        if let Some((tail, before)) = self.tail_at(spent) {
            let seen = tail.at(before);
            for axis in 0..AXES {
                position[axis] -= tail.to[axis] - seen.position[axis];
                own[axis] += seen.velocity[axis];
            }
        }
        Setpoint { position, velocity: own }
    }
}
