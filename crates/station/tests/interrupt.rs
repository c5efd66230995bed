//! The program interrupt inside a block: the piece that runs is the last one, and the codes of the block stay in force.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use machine::EventKind;
use station::{Session, Setup, Step};
use watch::{Texts, configuration, machine, select};

/// Lines and ends of the moves of a program whose interrupt input turns on after so many of them.
fn moves(text: &str, interrupted_after: usize) -> Vec<(u64, [f64; 3])> {
    let configuration = configuration(machine("stock-vmc", None), &Setup::default());
    let mut session = Session::new(configuration, Texts::one(text));
    select(&mut session, 0);
    session.start();
    let mut moves = Vec::new();
    loop {
        let event = match session.next() {
            Step::Event(event) => event,
            Step::Idle => return moves,
            other => panic!("{other:?}"),
        };
        let (EventKind::Rapid { to, .. } | EventKind::Feed { to, .. }) = event.kind else {
            assert!(!matches!(event.kind, EventKind::Alarm(_)), "{event:?}");
            continue;
        };
        moves.push((event.place.line, [to[0], to[1], to[2]]));
        if moves.len() == interrupted_after {
            session.set_input("interrupt", true).expect("there is one");
        }
    }
}

#[test]
fn the_rest_of_a_hole_is_dropped_and_the_next_distance_counts_from_there() {
    let text = "M91P5\nG91G99G81X10.R-2.Z-5.F100L3\nX99.\nN5G80X1.\nM30\n";
    assert_eq!(
        moves(text, 2),
        [(2, [10.0, 0.0, 0.0]), (2, [10.0, 0.0, -2.0]), (4, [11.0, 0.0, -2.0])],
        "G91 of the block that was broken off stays in force"
    );
    assert_eq!(
        moves(text, 99).len(),
        4 + 3 * 3 + 1,
        "without the interrupt four holes are made, and the axis stands at R from the first on"
    );
}

#[test]
fn between_two_legs_of_a_reference_return() {
    let text = "M91P5\nG28X7.Y3.\nX99.\nN5G90X1.\nM30\n";
    assert_eq!(moves(text, 1), [(2, [7.0, 3.0, 0.0]), (4, [1.0, 3.0, 0.0])]);
}

#[test]
fn in_a_macro_that_runs_ahead_the_program_that_said_it_goes_on() {
    let text = "O1\nM91P5\nG00X1.\nG65P2A5.\nX99.\nN5G00Y1.\nM30\nO2\nWHILE[#1GT0]DO1\nX#1\n#1=#1-1\nEND1\nM99\n";
    assert_eq!(
        moves(text, 3),
        [(3, [1.0, 0.0, 0.0]), (10, [5.0, 0.0, 0.0]), (10, [4.0, 0.0, 0.0]), (6, [4.0, 1.0, 0.0])]
    );
}
