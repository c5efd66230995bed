//! Looks at a program as it is driven, setpoint by setpoint: limits, feed, path, ends.

use base::{AXES, Point};
use motion::{Horizon, Move, Overrides, Setpoint, Way};

use super::program::Program;

/// By how much a limit may seem to be passed: the bar is 1.001.
const SLACK: f64 = 1.001;
/// Where the way bends, the axes may gain so much together while the speed along it falls.
const ROUND_A_CORNER: f64 = 1.01;
/// Of what an axis can give this much is all, at one of two looks: the change of speed is the same all along a cell, so
/// what an axis gives is not, and it is all of it at one place of the cell only, between two looks perhaps.
const ALL: f64 = 0.9;
/// Off the end of a stop, mm.
const AT_END_MM: f64 = 1e-9;
/// A program that takes more periods than this undisturbed is looked at every so many of them only.
const MOST_LOOKS: f64 = 4000.0;
/// Periods that a program may take at most beyond what it takes undisturbed behind the last act.
const PATIENCE: usize = 2000;

/// What the operator does, and at which period.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Act {
    Override(Overrides),
    Hold(bool),
    /// Stand at the end of the first move at whose end that can be.
    Stand,
}

/// How a run went.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// How long each move took, s.
    pub times: Vec<f64>,
    /// Highest part of any limit that was asked for.
    pub velocity: f64,
    pub acceleration: f64,
    pub quotient: f64,
}

struct Watch<'p> {
    program: &'p Program,
    horizon: Horizon,
    overrides: Overrides,
    /// The move under way.
    index: usize,
    last_index: usize,
    /// So many moves have been shown.
    shown: usize,
    /// The move at whose end the axes were asked to stand.
    stands: Option<usize>,
    last: Setpoint,
    /// The last speed, since an override may have taken back the feed; and until where that lasts.
    falling: Option<f64>,
    falling_until: usize,
    /// The part of what an axis can give that one gave at the last look.
    hardest: f64,
    run: Run,
    dt: f64,
    period: usize,
}

/// Drives a program with what the operator does.
pub fn watch(program: &Program, acts: &[(usize, Act)]) -> Result<Run, String> {
    let limits = &program.limits;
    let planned: f64 = move_times(program, false).iter().sum();
    let dt = limits.servo_period * (planned / limits.servo_period / MOST_LOOKS).ceil().max(1.0);
    let last_act = acts.last().map_or(0, |(at, _)| *at);
    let most_periods = (planned / dt * 1.2) as usize + last_act + PATIENCE;
    let start = Setpoint { position: program.moves[0].way.at(0.0), velocity: [0.0; AXES] };
    let mut watch = Watch {
        program,
        horizon: Horizon::new(*limits),
        overrides: Overrides::default(),
        index: 0,
        last_index: 0,
        shown: 0,
        stands: None,
        last: start,
        falling: None,
        falling_until: 0,
        hardest: 0.0,
        run: Run::default(),
        dt,
        period: 0,
    };
    let mut acts = acts.iter().peekable();
    let mut begun = 0.0;
    while watch.index < program.moves.len() {
        while let Some((_, act)) = acts.next_if(|(at, _)| *at == watch.period) {
            watch.act(act);
        }
        let mut left = dt;
        loop {
            fill(&mut watch.horizon, &program.moves, &mut watch.shown);
            let (over, ended) = watch.horizon.drive_for(left);
            if !ended {
                break;
            }
            let now = watch.period as f64 * dt + dt - over;
            watch.run.times.push(now - begun);
            begun = now;
            watch.end_of_move()?;
            left = over;
            if watch.index == program.moves.len() {
                break;
            }
        }
        watch.look()?;
        watch.period += 1;
        if watch.period > most_periods {
            return watch.wrong(format!("stuck at {:?}", watch.last));
        }
    }
    if watch.horizon.is_empty() { Ok(watch.run) } else { watch.wrong("something is left".to_owned()) }
}

/// Shows a horizon what it wants.
pub fn fill(horizon: &mut Horizon, moves: &[Move], shown: &mut usize) {
    while horizon.wants_more() {
        match moves.get(*shown) {
            Some(next) => horizon.add(next),
            None => horizon.stop(),
        }
        *shown += 1;
        assert!(*shown < moves.len() + 9, "it wants more behind the end");
    }
}

/// The times of moves, a whole move at a time; with all of the program shown at once, or what the horizon asks for.
pub fn move_times(program: &Program, all_at_once: bool) -> Vec<f64> {
    let mut horizon = Horizon::new(program.limits);
    let (mut shown, mut times) = (0, Vec::new());
    while times.len() < program.moves.len() {
        while all_at_once && !horizon.is_closed() && shown <= program.moves.len() {
            match program.moves.get(shown) {
                Some(next) => horizon.add(next),
                None => horizon.stop(),
            }
            shown += 1;
        }
        fill(&mut horizon, &program.moves, &mut shown);
        times.push(horizon.drive_move(|_, _, _| ()));
    }
    times
}

impl Watch<'_> {
    fn wrong<T>(&self, what: String) -> Result<T, String> {
        Err(format!("period {}, move {}: {what}", self.period, self.index))
    }

    fn act(&mut self, act: &Act) {
        match act {
            Act::Override(overrides) => {
                self.overrides = *overrides;
                self.horizon.set_overrides(*overrides);
                // It may not have come down before a move of a lower feed begins.
                (self.falling, self.falling_until) = (Some(f64::INFINITY), self.index + 3);
            }
            Act::Hold(held) => self.horizon.hold(*held),
            Act::Stand => {
                // What follows is shown anew behind the move at whose end they stand.
                let left = self.horizon.stand_soon();
                self.shown = self.index + left;
                self.stands = self.shown.checked_sub(1);
            }
        }
    }

    fn end_of_move(&mut self) -> Result<(), String> {
        let ended = &self.program.moves[self.index];
        self.index += 1;
        if ended.stops || self.index == self.program.moves.len() || self.stands == Some(self.index - 1) {
            let end = end_of(ended);
            if let Some(setpoint) = self.horizon.setpoint() {
                let off = apart(&setpoint.position, &end);
                if off > AT_END_MM || setpoint.velocity.iter().any(|part| *part != 0.0) {
                    return self.wrong(format!("ends {off} mm off its end, {:?}", setpoint.velocity));
                }
            }
        }
        Ok(())
    }

    /// The feed that holds now, mm/s of all axes together.
    fn feed(&self, index: usize) -> f64 {
        let asked = &self.program.moves[index];
        self.overrides.actual(&asked.feed) / 60.0 * asked.share
    }

    fn look(&mut self) -> Result<(), String> {
        let limits = &self.program.limits;
        let dt = self.dt;
        let last_move = self.program.moves.len() - 1;
        let now = if self.index > last_move {
            Setpoint { position: end_of(&self.program.moves[last_move]), velocity: [0.0; AXES] }
        } else {
            let start = Setpoint { position: self.program.moves[self.index].way.at(0.0), velocity: [0.0; AXES] };
            self.horizon.setpoint().unwrap_or(start)
        };
        let acceleration = self.horizon.acceleration();
        let around = self.index.saturating_sub(1)..=(self.index + 1).min(last_move);
        // In DRY RUN a cut at the rapid rate is one like any other, once it has come down to that.
        let may_fall = self.falling.is_some() || self.overrides.dry_run.is_none();
        let rapid = may_fall && around.clone().any(|index| self.program.moves[index].feed.mm_per_min == f64::INFINITY);
        // The direction of a short way is as exact as its ends are.
        let shortest = around.clone().map(|index| self.program.moves[index].way.length()).fold(1.0, f64::min);
        for axis in 0..limits.count {
            let limit = &limits.axes[axis];
            let rate = if rapid { limit.rapid } else { limit.max_feed };
            let velocity = now.velocity[axis].abs() / rate;
            let analytic = acceleration[axis].abs() / limit.acceleration;
            let noise = 1e-15 * (1.0 + now.position[axis].abs()) / shortest * rate / dt;
            let change = ((now.velocity[axis] - self.last.velocity[axis]) / dt).abs() - noise;
            let quotient = change / limit.acceleration;
            let mean = (now.position[axis] - self.last.position[axis]) / dt;
            let late = (mean - (now.velocity[axis] + self.last.velocity[axis]) / 2.0).abs() - 1e-12 / dt - noise;
            if !now.position[axis].is_finite() || velocity.is_nan() || velocity > SLACK {
                return self.wrong(format!("axis {axis}: velocity {velocity} of its limit"));
            }
            if analytic.is_nan() || quotient.is_nan() || analytic.max(quotient) > SLACK {
                return self.wrong(format!("axis {axis}: acceleration {analytic}, quotient {quotient} of its limit"));
            }
            // What is gone is what the velocity says.
            if late > limit.acceleration * dt * 0.5 * SLACK {
                return self.wrong(format!("axis {axis}: {mean} mm/s gone, {:?} said", now.velocity[axis]));
            }
            let run = &mut self.run;
            run.velocity = run.velocity.max(velocity);
            run.acceleration = run.acceleration.max(analytic);
            run.quotient = run.quotient.max(quotient);
        }
        let speed = norm(&now.velocity);
        if let Some(was) = self.falling {
            let is_over = speed > self.feed(self.index.min(last_move)) * SLACK + 1e-9;
            // Where an axis gives all it can already, the others may gain.
            let hardest = (0..limits.count).map(|axis| acceleration[axis].abs() / limits.axes[axis].acceleration);
            let hardest = std::mem::replace(&mut self.hardest, hardest.fold(0.0, f64::max)).max(self.hardest);
            if is_over && speed > was * ROUND_A_CORNER && hardest < ALL {
                return self.wrong(format!("{speed} mm/s, {was} before, and the feed has been taken back"));
            }
            self.falling = Some(if is_over { speed } else { speed.max(was.min(f64::MAX)) });
            if !is_over && (self.index >= self.falling_until || speed == 0.0) {
                self.falling = None;
            }
        } else if speed > self.feed(self.index.min(last_move)) * SLACK + 1e-9 {
            return self.wrong(format!("{speed} mm/s, the feed is {}", self.feed(self.index.min(last_move))));
        }
        self.look_at_path(&now, around.clone())?;
        let gone: f64 = (0..AXES)
            .map(|axis| {
                (now.position[axis] - self.last.position[axis]) * (now.velocity[axis] + self.last.velocity[axis])
            })
            .sum();
        // Not where it may have turned round within the period.
        let far = (dt * speed.max(norm(&self.last.velocity))).max(apart(&now.position, &self.last.position));
        let turns = around.clone().any(|index| match &self.program.moves[index].way {
            Way::Arc { arc, .. } => arc.radius[0].min(arc.radius[1]) < 4.0 * far,
            _ => false,
        });
        let is_one_move = std::mem::replace(&mut self.last_index, self.index) == self.index;
        if is_one_move && !turns && dot(&now.velocity, &self.last.velocity) > 0.0 && gone < -1e-12 {
            return self.wrong(format!("it runs backwards {:?} {:?}", self.last, now));
        }
        self.last = now;
        Ok(())
    }

    fn look_at_path(&self, now: &Setpoint, around: std::ops::RangeInclusive<usize>) -> Result<(), String> {
        let tolerated = self.program.limits.corner_tolerance * SLACK + 1e-9;
        let mut off = f64::INFINITY;
        for index in around {
            off = off.min(distance(&self.program.moves[index].way, &now.position, tolerated));
            if off <= tolerated {
                return Ok(());
            }
        }
        self.wrong(format!("{off} mm off the path"))
    }
}

/// Where a move ends.
pub fn end_of(ended: &Move) -> Point {
    ended.way.at(ended.way.length())
}

/// How far a point is from a way; an upper bound that is enough to be below `enough` where it is.
fn distance(way: &Way, point: &Point, enough: f64) -> f64 {
    let length = way.length();
    let at = |s: f64| apart(&way.at(s), point);
    let guess = match way {
        Way::Arc { arc, .. } => {
            let [u, v] = arc.axes.map(usize::from);
            let angle = (point[v] - arc.center[1]).atan2(point[u] - arc.center[0]);
            let turned = (angle - arc.start_angle) * arc.sweep.signum();
            let turned = turned.rem_euclid(std::f64::consts::TAU);
            let mut best = at(0.0).min(at(length));
            if turned <= arc.sweep.abs() {
                best = best.min(at(turned / arc.sweep.abs() * length));
            }
            best
        }
        _ => {
            let (from, slope) = (way.at(0.0), way.slope(0.0));
            let s: f64 = (0..AXES).map(|axis| (point[axis] - from[axis]) * slope[axis]).sum();
            at(s.clamp(0.0, length))
        }
    };
    if guess <= enough || way.is_straight() {
        return guess;
    }
    // Beside a small or steep arc the spoke is not the nearest: search.
    const STEPS: usize = 400;
    let nearest = (0..=STEPS).map(|step| at(length * step as f64 / STEPS as f64)).enumerate();
    let (step, _) = nearest.min_by(|one, other| one.1.total_cmp(&other.1)).expect("many");
    let (mut low, mut high) = (
        (step as f64 - 1.0).max(0.0) / STEPS as f64 * length,
        (step as f64 + 1.0).min(STEPS as f64) / STEPS as f64 * length,
    );
    for _ in 0..80 {
        let (one, other) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        if at(one) < at(other) { high = other } else { low = one }
    }
    guess.min(at((low + high) / 2.0))
}

pub fn apart(one: &Point, other: &Point) -> f64 {
    let gap: Point = std::array::from_fn(|axis| one[axis] - other[axis]);
    norm(&gap)
}

pub fn norm(vector: &Point) -> f64 {
    dot(vector, vector).sqrt()
}

fn dot(one: &Point, other: &Point) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
