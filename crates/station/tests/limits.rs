//! No move is faster than the axes and the program allow, whatever the program.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod programs;
mod watch;

use machine::{Event, EventKind, MachineFile};
use proptest::prelude::*;
use station::{AfterAlarm, Session, Setup};
use watch::{Expect, Texts, configuration, control, machine, run, select};

/// Relative error of a time.
const ROUNDING: f64 = 1e-9;
/// Pieces in which an arc is looked at.
const PIECES: i32 = 200;

/// More than proptest's own number of cases: each is cheap.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    ProptestConfig { cases: default.cases.max(1000), ..default }
}

/// A machine whose axes differ in everything, so that no limit hides behind another.
fn uneven() -> MachineFile {
    let mut machine = machine("stock-vmc", Some(9e6));
    for (axis, (rapid, max_feed, acceleration)) in
        machine.axes.iter_mut().zip([(12_000.0, 6000.0, 500.0), (9000.0, 2000.0, 300.0), (4000.0, 800.0, 1200.0)])
    {
        (axis.rapid, axis.max_feed, axis.acceleration) = (rapid, max_feed, acceleration);
    }
    machine
}

fn events(text: &str) -> Vec<Event> {
    let mut session = Session::new(configuration(uneven(), &Setup::default()), Texts::one(text));
    session.set_after_alarm(AfterAlarm::GoOn);
    session.interpreter_mut().set_loop_limit(100);
    select(&mut session, 0);
    run(&mut session, Expect { most_events: 2000, stays_inside: false })
}

/// The least time that a move can take at full speed, s; accelerating comes on top.
fn least_seconds(event: &Event, machine: &MachineFile) -> Option<(f64, f64)> {
    let mut least = 0.0f64;
    let taken = match &event.kind {
        EventKind::Rapid { from, to, duration, .. } => {
            for (index, axis) in machine.axes.iter().enumerate() {
                least = least.max((to[index] - from[index]).abs() * 60.0 / axis.rapid);
            }
            duration
        }
        EventKind::Feed { from, to, feed, duration, length, .. } => {
            for (index, axis) in machine.axes.iter().enumerate() {
                least = least.max((to[index] - from[index]).abs() * 60.0 / axis.max_feed);
            }
            least = least.max(length * 60.0 / feed);
            duration
        }
        EventKind::Arc { arc, feed, duration, length, .. } => {
            for (index, axis) in machine.axes.iter().enumerate() {
                let mut way = 0.0;
                for piece in 0..PIECES {
                    let at = |piece: i32| arc.at(f64::from(piece) / f64::from(PIECES))[index];
                    way += (at(piece + 1) - at(piece)).abs();
                }
                least = least.max(way * 60.0 / axis.max_feed);
            }
            if *feed > 0.0 {
                least = least.max(length * 60.0 / feed);
            }
            duration
        }
        _ => return None,
    };
    Some((least, taken.0))
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn no_move_is_faster_than_its_axes(text in programs::program(&control())) {
        let machine = uneven();
        for event in events(&text) {
            if let Some((least, taken)) = least_seconds(&event, &machine) {
                prop_assert!(taken >= least * (1.0 - ROUNDING), "{taken} s, at least {least} s: {event:?}");
            }
        }
    }

    /// A move between two stops also has to accelerate and brake.
    #[test]
    fn a_single_move_keeps_every_axis_acceleration(x in -900.0f64..900.0, y in -900.0f64..900.0, z in -90.0f64..90.0, feed in 1u32..9000, rapid: bool) {
        let code = if rapid { "G00" } else { "G01" };
        let machine = uneven();
        for event in events(&format!("G90{code}X{x:.3}Y{y:.3}Z{z:.3}F{feed}\nM30\n")) {
            let (EventKind::Rapid { from, to, duration, .. } | EventKind::Feed { from, to, duration, .. }) = event.kind else { continue };
            for (index, axis) in machine.axes.iter().enumerate() {
                let (way, acceleration) = ((to[index] - from[index]).abs(), axis.acceleration);
                let top = if rapid { axis.rapid } else { axis.max_feed } / 60.0;
                let ramps = top * top / acceleration;
                let least = if way > ramps { way / top + top / acceleration } else { 2.0 * (way / acceleration).sqrt() };
                prop_assert!(duration.0 >= least * (1.0 - ROUNDING), "axis {index}: {} s, at least {least} s", duration.0);
            }
        }
    }

    /// On a circle the mean speed alone already asks for acceleration towards the centre.
    #[test]
    fn a_circle_keeps_the_acceleration_towards_its_centre(radius in 0.01f64..200.0, feed in 1u32..24_000, beside in -20.0f64..20.0) {
        let machine = uneven();
        for event in events(&format!("G91G03X0Y0Z{beside:.3}I{radius:.3}F{feed}\nM30\n")) {
            let EventKind::Arc { arc, duration, .. } = event.kind else { continue };
            let speed = arc.plane_length() / duration.0;
            let least = machine.axes[0].acceleration.min(machine.axes[1].acceleration);
            prop_assert!(speed * speed / arc.radius[0] <= least * (1.0 + ROUNDING), "{speed} mm/s");
        }
    }
}
