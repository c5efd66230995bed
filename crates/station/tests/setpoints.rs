//! Setpoints as they go to the drives: never a step that an axis cannot make, and at every stop exactly where it is.

#![allow(clippy::expect_used, clippy::panic)]

mod watch;

use machine::EventKind;
use station::{Session, Setup, Step};
use watch::{Texts, configuration, machine, select};

const INCREMENT_MM: f64 = 1e-6;
const PERIOD_S: f64 = 0.001;

/// Servo periods to drive at least: PERIODS=10000000 drives as many.
fn wanted() -> u64 {
    std::env::var("PERIODS").ok().and_then(|text| text.parse().ok()).unwrap_or(100_000)
}

#[test]
fn what_was_sent_adds_up_to_where_the_axes_are() {
    let part = "O1\nG90 G54 G00 X1.235 Y-3.333 Z5.\nG01 Z-1.001 F300\nX21.77 F2500\nG03 X31.77 Y6.667 I0 J10. F1500\n\
                G02 X20.1 Y17.1 R11.5 Z-2.\nG01 X1.235 Y-3.333\nG00 Z5.\nM30\n";
    let mut session = Session::new(configuration(machine("stock-vmc", None), &Setup::default()), Texts::one(part));
    session.run_live();
    session.drive_in(INCREMENT_MM);
    let (mut rounds, mut periods) = (0, 0);
    while periods < wanted() {
        rounds += 1;
        select(&mut session, 0);
        session.start();
        loop {
            match session.next() {
                Step::Event(event) => {
                    assert!(!matches!(event.kind, EventKind::Alarm(_)), "{event:?}");
                }
                Step::Stopped => session.start(),
                Step::Idle => break,
                Step::Failed(error) => panic!("{error}"),
            }
        }
        let drives = session.drives().expect("setpoints are taken");
        let stands = session.position().map(|at| (at / INCREMENT_MM).round() as i64);
        assert_eq!(drives.counts(), &stands);
        periods = drives.periods();
        assert_eq!(session.position()[..3], [1.235, -3.333, 5.0]);
    }
    let largest = session.drives().map(|drives| *drives.largest()).expect("they are taken");
    println!("{periods} servo periods, {rounds} rounds: the sum is the end");
    // The rapid rate is 200 mm/s.
    assert!(largest.iter().all(|&step| step as f64 * INCREMENT_MM <= 200.0 * PERIOD_S * 1.001), "{largest:?}");
}
