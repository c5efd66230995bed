//! Model `classic`: what holds on every path, whatever the operator does.
//!
//! The environment can ask for more random programs: PROGRAMS=10000.

mod course;
mod old_control;

use base::AXES;
use course::seeds::samples_asked;
use course::{arc, limits, line};
use motion::{Classic, Interpolator, Limits, Move, Overrides, Setpoint, SpellKind};
use old_control::{Step, by_moves, run};
use proptest::collection::vec;
use proptest::prelude::*;

/// What a random step is made of: its kind, where it leads, its feed in mm/s, whether it stops.
type Draw = (u8, [f64; 3], f64, bool);

/// A program through random points; what the kinds mean is the same everywhere, `kinds` says how many of them occur.
fn program(draws: &[Draw]) -> (Vec<Step>, [f64; 3]) {
    let mut at = [0.0; 3];
    let mut steps = Vec::new();
    for &(kind, [x, y, z], speed, stops) in draws {
        let from = at;
        let f = speed * 60.0;
        at = [at[0] + x, at[1] + y, at[2] + z];
        let cut = |way: Move| Step::Cut(Move { stops, ..way });
        steps.push(match kind {
            0..=3 => cut(line(from, at, f)),
            4 => {
                // Round a centre beside the middle of the chord: a helix, from which a spiral differs by its end.
                let center = [from[0] + x / 2.0 - y * 0.7, from[1] + y / 2.0 + x * 0.7];
                cut(arc(from, at, center, stops, f))
            }
            5 => {
                at = from;
                cut(arc(from, from, [from[0] + x, from[1] + y], stops, f))
            }
            6 => {
                let center = [from[0] + x * 0.6 - y * 0.5, from[1] + y * 0.6 + x * 0.5];
                cut(arc(from, at, center, !stops, f))
            }
            7 => {
                at = from;
                Step::Dwell(speed / 1000.0)
            }
            8 => {
                at = from;
                Step::Empty(1 + x.abs() as u32)
            }
            _ => Step::Rapid(from, at, stops),
        });
    }
    (steps, at)
}

fn draws(kinds: std::ops::Range<u8>) -> impl Strategy<Value = Vec<Draw>> {
    let part = || prop_oneof![-20.0f64..20.0, -0.2f64..0.2];
    // In the plane there is always some way.
    let xyz = (part(), part(), part()).prop_map(|(x, y, z)| [x + 0.001f64.copysign(x), y, z]);
    vec((kinds, xyz, 1.0f64..150.0, any::<bool>()), 1..30)
}

fn models() -> impl Strategy<Value = Classic> {
    let block = prop_oneof![Just(0.0), 0.001f64..0.06];
    (0.05f64..0.2, 0.02f64..0.1, block, prop_oneof![Just(2u32), Just(4), Just(7)], 0.001f64..0.02).prop_map(
        |(rapid_s, feed_s, block_s, buffer, in_position_mm)| Classic {
            rapid_s,
            feed_s,
            block_s,
            buffer,
            in_position_mm,
        },
    )
}

/// Rapids of 150 mm/s; cuts up to 100, 80 and 40 mm/s.
fn machine(straight_rapid: bool) -> Limits {
    let mut limits = Limits { straight_rapid, ..limits(100.0, 500.0, 0.01) };
    for (axis, most) in limits.axes.iter_mut().zip([100.0, 80.0, 40.0]) {
        (axis.rapid, axis.max_feed) = (150.0, most);
    }
    limits
}

/// What the operator does at a period: holds, goes on, turns the switches.
type Hand = (u16, u8, f64);

fn hands() -> impl Strategy<Value = Vec<Hand>> {
    vec((1u16..400, 0u8..4, 0.0f64..2.0), 0..20)
}

/// Drives by periods, the operator's hands at the switches; shows what is seen before and after every period.
fn by_hand<'s>(
    period: f64,
    hands: &'s [Hand],
    mut look: impl FnMut(&Interpolator, &Setpoint, &Setpoint, f64) + 's,
) -> impl FnMut(&mut Interpolator) + 's {
    let (mut hands, mut wait) = (hands.iter(), 0u32);
    let mut next: Option<&Hand> = None;
    let mut before: Option<Setpoint> = None;
    move |interpolator| {
        let mut rest = 0.0;
        loop {
            next = next.or_else(|| hands.next());
            wait += 1;
            match next {
                Some(&(when, what, part)) if wait >= u32::from(when) => {
                    (wait, next) = (0, None);
                    match what {
                        0 => interpolator.hold(true),
                        1 => interpolator.hold(false),
                        2 => interpolator.set_overrides(Overrides { feed: part, ..*interpolator.overrides() }),
                        _ => interpolator.set_overrides(Overrides { rapid: part / 2.0, ..*interpolator.overrides() }),
                    }
                }
                // Nobody is left to let it go on.
                None => {
                    interpolator.hold(false);
                    interpolator.set_overrides(Overrides::default());
                }
                _ => {}
            }
            let start = before.or_else(|| interpolator.setpoint());
            let (left, ended) = interpolator.drive_for(period - rest);
            let driven = period - rest - left;
            rest = (rest + driven) % period;
            let after = interpolator.setpoint();
            if let (Some(start), Some(after)) = (start, after) {
                look(interpolator, &start, &after, driven);
            }
            before = after;
            if ended {
                // A dwell may follow, in which the axes go on settling.
                before = None;
                return;
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(samples_asked(300) as u32))]

    #[test]
    fn times_and_places_do_not_depend_on_the_period(
        draws in draws(0..10), model in models(), period in 0.0003f64..0.05, straight in any::<bool>(),
    ) {
        let (steps, _) = program(&draws);
        let mut at_once = Interpolator::new(machine(straight), model);
        let expected = run(&mut at_once, &steps, by_moves);
        let mut in_steps = Interpolator::new(machine(straight), model);
        let seen = run(&mut in_steps, &steps, by_hand(period, &[], |_, _, _, _| {}));
        prop_assert_eq!(seen.len(), expected.len());
        for (seen, expected) in seen.iter().zip(&expected) {
            prop_assert!((seen.seconds - expected.seconds).abs() < 1e-9, "{:?} {:?}", seen, expected);
            prop_assert!((seen.starving - expected.starving).abs() < 1e-9, "{:?} {:?}", seen, expected);
            prop_assert!((seen.settling - expected.settling).abs() < 1e-9, "{:?} {:?}", seen, expected);
        }
        if let (Some(seen), Some(expected)) = (in_steps.setpoint(), at_once.setpoint()) {
            for axis in 0..3 {
                prop_assert!((seen.position[axis] - expected.position[axis]).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn every_stop_is_within_the_width_and_no_stretch_jumps(draws in draws(0..10), model in models()) {
        let (steps, end) = program(&draws);
        let limits = machine(false);
        let mut interpolator = Interpolator::new(limits, model);
        let mut last: Option<Setpoint> = None;
        let (mut jumps, mut settled) = (Vec::new(), Vec::new());
        run(&mut interpolator, &steps, |interpolator| {
            let stops = interpolator.is_closed() && !interpolator.wants_more();
            let mut command = None;
            interpolator.drive_move(|spell| {
                let start = spell.at(0.0);
                if let Some(last) = last {
                    jumps.extend((0..3).map(|axis| (start.position[axis] - last.position[axis]).abs()));
                }
                last = Some(spell.at(spell.seconds));
                command = Some(spell.commanded_at(spell.seconds));
                if let (SpellKind::Settling, Some(at), Some(command)) = (spell.kind, last, command) {
                    settled.extend((0..3).map(|axis| (at.position[axis] - command[axis]).abs()));
                }
            });
            // The last look was at the end of the last spell; a dwell changes the place by what was left.
            if let (true, Some(at), Some(command)) = (stops && interpolator.is_empty(), last, command) {
                jumps.extend((0..3).map(|axis| (at.position[axis] - command[axis]).abs() - model.in_position_mm));
                last = None;
            }
        });
        prop_assert!(jumps.iter().all(|&jump| jump < 1e-9), "{:?}", jumps);
        prop_assert!(settled.iter().all(|&behind| behind < model.in_position_mm + 1e-9), "{:?}", settled);
        let at = interpolator.setpoint().map(|seen| seen.position).unwrap_or_default();
        if steps.iter().any(|step| matches!(step, Step::Cut(_) | Step::Rapid(..))) {
            for axis in 0..3 {
                prop_assert!((at[axis] - end[axis]).abs() < model.in_position_mm + 1e-9);
            }
            // What is left dies away.
            interpolator.pass(5.0);
            let at = interpolator.setpoint().map(|seen| seen.position).unwrap_or_default();
            prop_assert!((0..3).all(|axis| (at[axis] - end[axis]).abs() < 1e-9));
        }
    }

    #[test]
    fn no_axis_is_ever_faster_than_its_rate(
        draws in draws(0..10), model in models(), hands in hands(), straight in any::<bool>(),
    ) {
        let limits = machine(straight);
        let (steps, _) = program(&draws);
        let only_cuts = !steps.iter().any(|step| matches!(step, Step::Rapid(..)));
        let mut worst = [0.0f64; 3];
        let look = |_: &Interpolator, before: &Setpoint, after: &Setpoint, seconds: f64| {
            for axis in 0..3 {
                let rate = if only_cuts { limits.axes[axis].max_feed } else { limits.axes[axis].rapid };
                let moved = (after.position[axis] - before.position[axis]).abs() - 1e-9;
                worst[axis] = worst[axis].max(after.velocity[axis].abs() / rate).max(moved / (rate * seconds.max(1e-12)));
            }
        };
        let mut interpolator = Interpolator::new(limits, model);
        run(&mut interpolator, &steps, by_hand(0.001, &hands, look));
        // What is left in position behind a cut dies away beside the rapid that follows.
        let room = if only_cuts { 1e-9 } else { 1e-3 };
        prop_assert!(worst.iter().all(|&part| part <= 1.0 + room), "{:?}", worst);
    }

    /// The lag's own equation, followed in small steps behind the interpolator's place alone.
    #[test]
    fn the_axes_follow_the_interpolator_as_the_lag_says(draws in draws(0..9), model in models(), hands in hands()) {
        const PERIOD: f64 = 0.0002;
        let (steps, _) = program(&draws);
        let tau = model.feed_s;
        let mut behind = [0.0; AXES];
        let mut command: Option<[f64; AXES]> = None;
        let mut worst = 0.0f64;
        let look = |interpolator: &Interpolator, _: &Setpoint, after: &Setpoint, seconds: f64| {
            let now = interpolator.commanded_position().unwrap_or_default();
            let before = command.replace(now).unwrap_or([0.0; AXES]);
            let left = (-seconds / tau).exp();
            for axis in 0..3 {
                let rate = if seconds > 0.0 { (now[axis] - before[axis]) / seconds } else { 0.0 };
                behind[axis] = behind[axis] * left + rate * tau * (1.0 - left);
                worst = worst.max((now[axis] - behind[axis] - after.position[axis]).abs());
            }
        };
        // A dwell passes unseen: without any.
        let steps: Vec<_> = steps.into_iter().filter(|step| !matches!(step, Step::Dwell(_))).collect();
        run(&mut Interpolator::new(machine(false), model), &steps, by_hand(PERIOD, &hands, look));
        prop_assert!(worst < 2e-4, "{}", worst);
    }

    #[test]
    fn rapids_keep_to_their_acceleration_and_end_where_they_should(
        draws in draws(9..10), model in models(), hands in hands(), straight in any::<bool>(), checked in any::<bool>(),
    ) {
        let limits = machine(straight);
        let (mut steps, end) = program(&draws);
        for step in &mut steps {
            if let Step::Rapid(.., own) = step {
                *own = checked;
            }
        }
        let mut worst = 0.0f64;
        // One slows down and the next one gets faster, in opposite directions.
        let most = limits.axes[0].rapid / model.rapid_s * if checked { 1.0 } else { 2.0 };
        let look = |_: &Interpolator, before: &Setpoint, after: &Setpoint, seconds: f64| {
            for axis in 0..3 {
                worst = worst.max((after.velocity[axis] - before.velocity[axis]).abs() - most * seconds);
            }
        };
        let mut interpolator = Interpolator::new(limits, model);
        run(&mut interpolator, &steps, by_hand(0.001, &hands, look));
        prop_assert!(worst < 1e-6, "{}", worst);
        let at = interpolator.setpoint().map(|seen| seen.position).unwrap_or_default();
        prop_assert_eq!(&at[..3], &end[..]);
    }

    #[test]
    fn no_block_begins_before_it_is_ready_and_more_places_are_never_slower(draws in draws(0..10), model in models()) {
        let (steps, _) = program(&draws);
        // Without settling, which is shorter the more the axes have caught up while the interpolator waited.
        let model = Classic { in_position_mm: 1e9, ..model };
        let time = |model| -> f64 {
            run(&mut Interpolator::new(machine(false), model), &steps, by_moves).iter().map(|spent| spent.seconds).sum()
        };
        let times = [2, 4, 7].map(|buffer| time(Classic { buffer, ..model }));
        prop_assert!(times[0] >= times[1] - 1e-9 && times[1] >= times[2] - 1e-9, "{:?}", times);
        // Blocks behind the last one that moves or dwells are not waited for.
        let count = |step: &Step| if let Step::Empty(count) = step { *count } else { 1 };
        let last = steps.iter().rposition(|step| !matches!(step, Step::Empty(_))).map_or(0, |last| last + 1);
        let ready = f64::from(steps[..last].iter().map(count).sum::<u32>()) * model.block_s;
        let moved = time(Classic { block_s: 0.0, ..model });
        prop_assert!(times[2] >= ready.max(moved) - 1e-9 && times[0] <= ready + moved + 1e-9, "{:?} {} {}", times, ready, moved);
    }

    #[test]
    fn the_parts_of_a_moves_time_are_those_of_its_stretches(draws in draws(0..10), model in models()) {
        let (steps, _) = program(&draws);
        let mut interpolator = Interpolator::new(machine(false), model);
        let mut wrong = 0.0f64;
        run(&mut interpolator, &steps, |interpolator| {
            let mut parts = [0.0; 3];
            let seconds = interpolator.drive_move(|spell| {
                let part = match spell.kind {
                    SpellKind::Starving => 0,
                    SpellKind::Settling => 1,
                    SpellKind::Cutting | SpellKind::Rapid => 2,
                };
                parts[part] += spell.seconds;
            });
            let spent = interpolator.last_spent();
            wrong = wrong.max((spent.starving - parts[0]).abs()).max((spent.settling - parts[1]).abs());
            wrong = wrong.max((spent.seconds - seconds).abs()).max((parts.iter().sum::<f64>() - seconds).abs());
        });
        prop_assert!(wrong < 1e-12, "{}", wrong);
    }
}
