//! Random programs, driven period by period: no limit is passed, the path is not left, every stop is where it should be.
//!
//! The environment can ask for more of them: PROGRAMS=10000; or for single ones: ONLY=1831,3419.

mod course;

use std::cell::Cell;

use course::program::{Program, program};
use course::seeds::over_seeds;
use course::watch::{Act, Run, move_times, watch};
use motion::Overrides;
use testkit::Random;

const PROGRAMS: u64 = 200;
/// How far two ways of driving may differ in the time of a whole program, relative: rounding.
const ROUNDING: f64 = 1e-9;

/// How many programs were driven, and the highest part of any limit that was asked for: velocity, acceleration.
#[derive(Default)]
struct Highest(Cell<(u64, f64, f64)>);

impl Highest {
    fn add(&self, run: &Run) {
        let (programs, velocity, acceleration) = self.0.get();
        let hardest = run.acceleration.max(run.quotient);
        self.0.set((programs + 1, velocity.max(run.velocity), acceleration.max(hardest)));
    }

    fn tell(&self, what: &str) {
        let (programs, velocity, acceleration) = self.0.get();
        println!(
            "{programs} programs, {what}: highest part of the limit: velocity {velocity:.6}, acceleration {acceleration:.6}"
        );
    }
}

/// Runs a check over many programs.
fn over_programs(check: impl Fn(u64, &Program) -> Result<(), String>) {
    over_seeds(PROGRAMS, |seed| check(seed, &program(seed)));
}

fn agree(one: &[f64], other: &[f64], what: &str) -> Result<(), String> {
    let whole: f64 = one.iter().sum();
    if one.len() != other.len() {
        return Err(format!("{what}: {} and {} moves", one.len(), other.len()));
    }
    for (index, (one, other)) in one.iter().zip(other).enumerate() {
        let apart = (one - other).abs();
        if apart.is_nan() || apart > ROUNDING * whole {
            return Err(format!("{what}: move {index} takes {one} s and {other} s"));
        }
    }
    Ok(())
}

#[test]
fn nothing_is_passed_and_nothing_is_left() {
    let highest = Highest::default();
    over_programs(|_, program| {
        let run = watch(program, &[])?;
        highest.add(&run);
        agree(&run.times, &move_times(program, false), "period by period, and move by move")
    });
    highest.tell("nobody at the switches");
}

#[test]
fn the_time_does_not_depend_on_how_much_is_seen_beyond_what_is_asked_for() {
    over_programs(|_, program| {
        agree(&move_times(program, true), &move_times(program, false), "all seen, and as asked")
    });
}

#[test]
fn the_operator_may_do_what_he_likes_when_he_likes() {
    let highest = Highest::default();
    over_programs(|seed, program| {
        let mut random = Random::new(seed ^ 0xACE5);
        let seconds: f64 = move_times(program, false).iter().sum();
        let periods = ((seconds / program.limits.servo_period) as usize).min(4000) + 1;
        let mut acts = Vec::new();
        let (mut at, mut held) = (0, false);
        for _ in 0..random.between(1.0, 12.0) as usize {
            let (few, any) = (random.below(20), random.below(periods));
            at += random.pick(&[0, 1, 2, few, any]);
            let act = if random.chance(0.2) {
                Act::Stand
            } else if random.chance(0.4) {
                held = !held;
                Act::Hold(held)
            } else {
                let any = random.between(0.0, 2.0);
                let feed = random.pick(&[0.0, 0.01, 0.5, 1.0, 1.5, 2.0, any]);
                let rapid = random.pick(&[0.25, 0.5, 1.0]);
                let spindle = random.pick(&[0.5, 1.0, 1.2]);
                let rapid_limit = random.pick(&[f64::INFINITY, f64::INFINITY, 3.0]);
                let dry_run = random.pick(&[None, None, None, Some(50.0), Some(2000.0)]);
                Act::Override(Overrides { feed, rapid, spindle, rapid_limit, dry_run })
            };
            acts.push((at, act));
        }
        at += random.below(200);
        acts.push((at, Act::Hold(false)));
        acts.push((at, Act::Override(Overrides::default())));
        watch(program, &acts).map(|run| highest.add(&run)).map_err(|what| format!("{what}\n   {acts:?}"))
    });
    highest.tell("overrides, holds, single block and DRY RUN thrown in");
}
