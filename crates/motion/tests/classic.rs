//! Model `classic` against what can be worked out by hand, and its laws on random paths.

mod course;
mod old_control;

use course::{arc, limits, line, point};
use motion::{Classic, Interpolator, Limits, Move, Overrides, Setpoint, SpellKind, Spent};
use old_control::{Step, by_moves, run};

/// 100 mm/s rapid and cutting.
fn machine() -> Limits {
    limits(100.0, 500.0, 0.01)
}

const MODEL: Classic = Classic { rapid_s: 0.1, feed_s: 0.05, block_s: 0.0, buffer: 2, in_position_mm: 0.01 };

fn drive(limits: Limits, model: Classic, steps: &[Step]) -> Vec<Spent> {
    run(&mut Interpolator::new(limits, model), steps, by_moves)
}

fn total(spent: &[Spent]) -> f64 {
    spent.iter().map(|spent| spent.seconds).sum()
}

fn stopped(cut: Move) -> Step {
    Step::Cut(Move { stops: true, ..cut })
}

fn close(ours: f64, expected: f64) -> bool {
    (ours - expected).abs() < 1e-9
}

/// Where the axes are at so many places of a move's time.
fn look(interpolator: &mut Interpolator, places: u32) -> Vec<Setpoint> {
    let mut seen = Vec::new();
    interpolator.drive_move(|spell| {
        seen.extend((0..places).map(|place| spell.at(spell.seconds * f64::from(place) / f64::from(places))));
    });
    seen
}

#[test]
fn a_line_takes_its_way_by_its_feed_and_then_settles() {
    // 200 mm at 50 mm/s: 4 s. The axes are τ v = 2.5 mm behind; 0.05 s ln(2.5 / 0.01) = 0.276073 s later in position.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([0.0; 3], [200.0, 0.0, 0.0], 3000.0));
    interpolator.stop();
    assert_eq!(interpolator.drive_for(2.0), (0.0, false));
    let seen = interpolator.setpoint().expect("under way");
    assert!(close(seen.position[0], 97.5) && close(seen.velocity[0], 50.0), "{seen:?}");
    let rest = interpolator.drive_move(|_| {});
    assert!(close(rest, 2.0 + 0.276_073_045_891_119), "{rest}");
    let spent = interpolator.last_spent();
    assert!(close(spent.seconds, 4.276_073_045_891_119) && close(spent.settling, 0.276_073_045_891_119), "{spent:?}");
    assert!(close(interpolator.setpoint().expect("there").position[0], 199.99));
}

#[test]
fn the_start_is_an_exponential() {
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([0.0; 3], [200.0, 0.0, 0.0], 6000.0));
    interpolator.stop();
    interpolator.drive_for(0.05);
    // After τ the speed is 1 - 1/e of 100 mm/s; the way is 100 τ / e.
    let seen = interpolator.setpoint().expect("under way");
    assert!(close(seen.velocity[0], 63.212_055_882_855_77), "{seen:?}");
    assert!(close(seen.position[0], 1.839_397_205_857_212), "{seen:?}");
}

#[test]
fn a_square_corner_is_cut_by_half_of_the_following_distance() {
    // With u = t/τ since the corner, in units of vτ: x = -exp(-u), y = u - 1 + exp(-u). Nearest to the corner where
    // exp(-2u) = y (1 - exp(-u)): u = 0.879422, at 0.508863 of vτ = 5 mm.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([-100.0, 0.0, 0.0], [0.0; 3], 6000.0));
    interpolator.add(&line([0.0; 3], [0.0, 100.0, 0.0], 6000.0));
    assert!(close(interpolator.drive_move(|_| {}), 1.0));
    interpolator.stop();
    let seen = look(&mut interpolator, 100_000);
    let nearest = seen.iter().map(|at| at.position[0].hypot(at.position[1])).fold(f64::INFINITY, f64::min);
    assert!((nearest - 5.0 * 0.508_863_006_183_176_8).abs() < 1e-7, "{nearest}");
    // The same in its place: 0.02 s behind the corner.
    let at = &seen[2000].position;
    let left = 5.0 * (-0.4f64).exp();
    assert!((at[0] + left).abs() < 1e-6 && (at[1] - (2.0 - 5.0 + left)).abs() < 1e-6, "{at:?}");
}

#[test]
fn arcs_become_smaller() {
    // 50 mm/s on r = 10, τ = 0.05 s: ωτ = 0.25, so r / √1.0625. Four turns: the first is still running in.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    let turn = arc([10.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0; 2], false, 3000.0);
    for _ in 0..3 {
        interpolator.add(&turn);
        if !interpolator.wants_more() {
            assert!(close(interpolator.drive_move(|_| {}), 0.4 * std::f64::consts::PI));
        }
    }
    interpolator.stop();
    // The thousand places behind them are those of the settling.
    for at in &look(&mut interpolator, 1000)[..1000] {
        let radius = at.position[0].hypot(at.position[1]);
        assert!(close(radius, 9.701_425_001_453_32), "{radius}");
        assert!(close(at.velocity[0].hypot(at.velocity[1]), 5.0 * radius), "{at:?}");
    }
}

#[test]
fn short_blocks_starve_the_interpolator() {
    // 1000 lines of 0.1 mm at 100 mm/s are 1 ms each, but a block takes 20 ms: 20 ms a block, 1 ms for the last.
    let at = |index: usize| [index as f64 * 0.1, 0.0, 0.0];
    let steps: Vec<_> = (0..1000).map(|index| Step::Cut(line(at(index), at(index + 1), 6000.0))).collect();
    let spent = drive(machine(), Classic { block_s: 0.020, ..MODEL }, &steps);
    assert!(close(spent[0].starving, 0.020) && close(spent[0].seconds, 0.021));
    for spent in &spent[1..] {
        assert!(close(spent.starving, 0.019), "{spent:?}");
    }
    let settling = spent[999].settling;
    assert!(settling > 0.0 && close(total(&spent), 1000.0 * 0.020 + 0.001 + settling));
    // Blocks that are long enough are not waited for; without a block time nothing is.
    let steps: Vec<_> = (0..10).map(|index| Step::Cut(line(at(index), at(index + 1), 240.0))).collect();
    let spent = drive(machine(), Classic { block_s: 0.020, ..MODEL }, &steps);
    assert!(spent[1..].iter().all(|spent| spent.starving == 0.0 && (spent.seconds - spent.settling - 0.025) < 1e-12));
    assert!(drive(machine(), MODEL, &steps).iter().all(|spent| spent.starving == 0.0));
}

#[test]
fn a_larger_buffer_bridges_more_short_blocks() {
    // A long line, eight short ones (2.5 ms each, 10 ms to be made ready): with 2, 4, 7 places so many are in time.
    let at = |index: usize| [100.0 + index as f64 * 0.25, 0.0, 0.0];
    let mut steps = vec![Step::Cut(line([0.0; 3], at(0), 6000.0))];
    steps.extend((0..8).map(|index| Step::Cut(line(at(index), at(index + 1), 6000.0))));
    // By hand: the places' blocks are ready when the long one ends at T. The next is ready at T + 10 ms, wanted at
    // T + 2.5 ms times the places: at 5 ms, 10 ms, 17.5 ms. The ones behind follow every 10 ms.
    for (buffer, in_time) in [(2, 2), (4, 5), (7, 8)] {
        let spent = drive(machine(), Classic { block_s: 0.010, buffer, ..MODEL }, &steps);
        let fast = spent[1..].iter().filter(|spent| spent.starving < 1e-9).count();
        assert_eq!(fast, in_time, "{buffer}: {spent:?}");
    }
}

#[test]
fn blocks_without_a_move_take_their_time_too() {
    let steps = [
        Step::Cut(line([0.0; 3], [1.0, 0.0, 0.0], 6000.0)),
        Step::Empty(3),
        Step::Cut(line([1.0, 0.0, 0.0], [2.0, 0.0, 0.0], 6000.0)),
    ];
    // Ready after 20 ms, then the fifth block after 100 ms; the first line has ended after 30 ms.
    let spent = drive(machine(), Classic { block_s: 0.020, ..MODEL }, &steps);
    assert!(close(spent[0].seconds, 0.030) && close(spent[1].starving, 0.070), "{spent:?}");
}

#[test]
fn a_dwell_fills_the_buffer_and_a_stop_of_reading_empties_it() {
    let short = |from: f64| Step::Cut(line([from, 0.0, 0.0], [from + 0.1, 0.0, 0.0], 6000.0));
    let model = Classic { block_s: 0.020, ..MODEL };
    let spent = drive(machine(), model, &[Step::Dwell(1.0), short(0.0), short(0.1), short(0.2)]);
    // The dwell's own block is waited for; then two are ready, and the third 20 ms after the first is taken.
    assert!(close(spent[0].starving, 0.020) && close(spent[0].seconds, 1.020), "{spent:?}");
    assert!(spent[1].starving == 0.0 && spent[2].starving == 0.0 && close(spent[3].starving, 0.018), "{spent:?}");
    let spent = drive(machine(), model, &[Step::Dwell(1.0), Step::EmptyBuffer, short(0.0), short(0.1)]);
    assert!(close(spent[1].starving, 0.020) && close(spent[2].starving, 0.019), "{spent:?}");
}

#[test]
fn rapids_accelerate_linearly_and_every_axis_for_itself() {
    // 1000 mm/s²: 100 mm at 100 mm/s take 1.1 s; 2.5 mm take 2 √(2.5 / 1000) = 0.1 s; the longest axis counts.
    let rapid = |to: [f64; 3]| Step::Rapid([0.0; 3], to, true);
    let spent = drive(machine(), MODEL, &[rapid([100.0, 0.0, 0.0])]);
    assert!(close(total(&spent), 1.1), "{spent:?}");
    assert!(close(total(&drive(machine(), MODEL, &[rapid([0.0, -2.5, 0.0])])), 0.1));
    assert!(close(total(&drive(machine(), MODEL, &[rapid([50.0, -100.0, 20.0])])), 1.1));

    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add_rapid(&point([0.0; 3]), &point([50.0, -100.0, 20.0]), true);
    interpolator.drive_for(0.35);
    let at = interpolator.setpoint().expect("under way");
    // X and Y steady after 5 mm; Z has reached its end after 0.3 s.
    assert!(close(at.position[0], 30.0) && close(at.position[1], -30.0) && at.position[2] == 20.0, "{at:?}");
    assert!(close(at.velocity[0], 100.0) && close(at.velocity[1], -100.0) && at.velocity[2] == 0.0, "{at:?}");
    interpolator.drive_move(|_| {});
    assert_eq!(interpolator.setpoint().expect("there").position, point([50.0, -100.0, 20.0]));

    // In a straight line the slower axes wait for the slowest: always 0.5 : -1 : 0.2.
    let mut interpolator = Interpolator::new(Limits { straight_rapid: true, ..machine() }, MODEL);
    interpolator.add_rapid(&point([0.0; 3]), &point([50.0, -100.0, 20.0]), true);
    for at in look(&mut interpolator, 50) {
        let y = -at.position[1];
        assert!(close(at.position[0], y / 2.0) && close(at.position[2], y / 5.0), "{at:?}");
    }
    assert!(close(interpolator.last_spent().seconds, 1.1));
}

#[test]
fn without_in_position_check_the_next_rapid_begins_when_this_one_slows_down() {
    let corner = [100.0, 0.0, 0.0];
    let steps = |checked| [Step::Rapid([0.0; 3], corner, checked), Step::Rapid(corner, [100.0, 100.0, 0.0], true)];
    assert!(close(total(&drive(machine(), MODEL, &steps(true))), 2.2));
    let spent = drive(machine(), MODEL, &steps(false));
    assert!(close(spent[0].seconds, 1.0) && close(spent[1].seconds, 1.1), "{spent:?}");
    // While X covers its last 5 (1 - t/T)² mm, Y its first 5 (t/T)²: nearest at T/2, 1.25 mm beside in either.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add_rapid(&point([0.0; 3]), &point(corner), false);
    interpolator.add_rapid(&point(corner), &point([100.0, 100.0, 0.0]), true);
    interpolator.drive_move(|_| {});
    interpolator.drive_for(0.05);
    let at = interpolator.setpoint().expect("under way");
    assert!(close(at.position[0], 98.75) && close(at.position[1], 1.25), "{at:?}");
    assert!(close(at.velocity[0], 50.0) && close(at.velocity[1], 50.0), "{at:?}");
    // X still slows down while Y waits for its block.
    let mut interpolator = Interpolator::new(machine(), Classic { block_s: 2.0, ..MODEL });
    interpolator.add_rapid(&point([0.0; 3]), &point(corner), false);
    interpolator.begin_block();
    interpolator.add_rapid(&point(corner), &point([100.0, 100.0, 0.0]), true);
    interpolator.drive_move(|_| {});
    interpolator.drive_for(0.05);
    assert!(!interpolator.is_standing() && close(interpolator.setpoint().expect("under way").position[0], 98.75));
    interpolator.drive_for(0.06);
    assert!(interpolator.is_standing());
    // Before a cut the rapid is driven to its end.
    let spent = drive(
        machine(),
        MODEL,
        &[Step::Rapid([0.0; 3], corner, false), Step::Cut(line(corner, [100.0, 10.0, 0.0], 6000.0))],
    );
    assert!(close(spent[0].seconds, 1.1), "{spent:?}");
}

#[test]
fn an_exact_stop_costs_its_settling_and_a_rapid_waits_for_the_cut_before() {
    let sides = [([0.0; 3], [10.0, 0.0, 0.0]), ([10.0, 0.0, 0.0], [10.0, 10.0, 0.0])];
    let cuts = sides.map(|(from, to)| line(from, to, 6000.0));
    // 0.1 s a side; at its end the axes are 5 (1 - exp(-2)) mm behind, at the second's in Y.
    let settling = 0.05 * (500.0 * (1.0 - (-2f64).exp())).ln();
    let through = drive(machine(), MODEL, &cuts.map(Step::Cut));
    assert!(close(through[0].seconds, 0.1) && through[0].settling == 0.0, "{through:?}");
    assert!(close(through[1].settling, settling), "{through:?}");
    let exact = drive(machine(), MODEL, &cuts.map(stopped));
    assert!(close(exact[0].seconds, 0.1 + settling), "{exact:?}");
    let before_rapid =
        drive(machine(), MODEL, &[Step::Cut(cuts[0]), Step::Rapid([10.0, 0.0, 0.0], [110.0, 0.0, 0.0], true)]);
    assert!(close(before_rapid[0].settling, settling) && close(before_rapid[1].seconds, 1.1), "{before_rapid:?}");
}

#[test]
fn a_feed_is_held_to_what_the_slowest_axis_can_do() {
    let mut limits = machine();
    limits.axes[1].max_feed = 30.0;
    // 3 : 4 in a plane: Y at 30 mm/s is 37.5 mm/s along the line, 50 mm long.
    let spent = drive(limits, MODEL, &[Step::Cut(line([0.0; 3], [30.0, 40.0, 0.0], 6000.0))]);
    assert!(close(spent[0].seconds - spent[0].settling, 50.0 / 37.5), "{spent:?}");
    // The rapid rate as a feed: 100 mm/s in X, whatever Y may do in cuts.
    let spent = drive(limits, MODEL, &[Step::Cut(line([0.0; 3], [30.0, 40.0, 0.0], f64::INFINITY))]);
    assert!(close(spent[0].seconds - spent[0].settling, 0.4), "{spent:?}");
}

#[test]
fn a_hold_takes_its_time_and_the_axes_run_out() {
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([0.0; 3], [100.0, 0.0, 0.0], 6000.0));
    interpolator.stop();
    interpolator.drive_for(0.5);
    interpolator.hold(true);
    interpolator.drive_for(0.05);
    let at = interpolator.setpoint().expect("under way");
    assert!((at.velocity[0] - 100.0 / std::f64::consts::E).abs() < 0.01 && !interpolator.is_standing(), "{at:?}");
    interpolator.drive_for(0.95);
    assert!(interpolator.is_standing());
    assert!((interpolator.setpoint().expect("held").position[0] - 50.0).abs() < 1e-6);
    interpolator.hold(false);
    let rest = interpolator.drive_move(|_| {});
    let spent = interpolator.last_spent();
    assert!(close(rest - spent.settling, 0.5) && close(spent.seconds - spent.settling, 2.0), "{rest} {spent:?}");

    // A rapid is at 45 mm and slows down over 5 mm; from there the other 50 mm take 0.6 s.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add_rapid(&point([0.0; 3]), &point([100.0, 0.0, 0.0]), true);
    interpolator.drive_for(0.5);
    interpolator.hold(true);
    interpolator.drive_for(1.0);
    let at = interpolator.setpoint().expect("held");
    assert!(close(at.position[0], 50.0) && at.velocity[0] == 0.0 && interpolator.is_standing(), "{at:?}");
    interpolator.hold(false);
    interpolator.drive_move(|_| {});
    assert!(close(interpolator.last_spent().seconds, 0.5 + 1.0 + 0.6), "{:?}", interpolator.last_spent());
}

#[test]
fn overrides_act_at_once() {
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([0.0; 3], [100.0, 0.0, 0.0], 3000.0));
    interpolator.stop();
    interpolator.drive_for(1.0);
    interpolator.set_overrides(Overrides { feed: 0.5, ..Overrides::default() });
    interpolator.drive_for(1.0);
    interpolator.set_overrides(Overrides { feed: 4.0, ..Overrides::default() });
    // 50 mm + 25 mm, and the rest at 100 mm/s, which is all that the axis can do.
    let rest = interpolator.drive_move(|_| {});
    assert!(close(rest - interpolator.last_spent().settling, 0.25), "{rest}");
    // A rapid at a quarter: as hard, for a quarter of the time: 0.025 + 100/25 s.
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.set_overrides(Overrides { rapid: 0.25, ..Overrides::default() });
    interpolator.add_rapid(&point([0.0; 3]), &point([100.0, 0.0, 0.0]), true);
    assert!(close(interpolator.drive_move(|_| {}), 4.025));
}

#[test]
fn what_stands_still_takes_for_ever_and_the_next_move_goes_on() {
    let mut interpolator = Interpolator::new(machine(), MODEL);
    interpolator.add(&line([0.0; 3], [100.0, 0.0, 0.0], 3000.0));
    interpolator.add_rapid(&point([100.0, 0.0, 0.0]), &point([0.0; 3]), true);
    interpolator.drive_for(1.0);
    interpolator.set_overrides(Overrides { feed: 0.0, ..Overrides::default() });
    assert_eq!(interpolator.drive_move(|_| {}), f64::INFINITY);
    assert_eq!(interpolator.setpoint().expect("there").position, point([100.0, 0.0, 0.0]));
    assert_eq!(interpolator.last_spent().seconds, f64::INFINITY);
    assert!(close(interpolator.drive_move(|_| {}), 1.1));
    assert_eq!(interpolator.setpoint().expect("there").position, point([0.0; 3]));
}

#[test]
fn stretches_tell_what_happens() {
    let mut interpolator = Interpolator::new(machine(), Classic { block_s: 0.1, ..MODEL });
    interpolator.begin_block();
    interpolator.add(&Move { stops: true, ..line([0.0; 3], [100.0, 0.0, 0.0], 3000.0) });
    let mut told = Vec::new();
    interpolator.drive_move(|spell| told.push((spell.kind, spell.speed)));
    assert_eq!(told, [(SpellKind::Starving, 0.0), (SpellKind::Cutting, 50.0), (SpellKind::Settling, 0.0)]);
}
