//! Contours beside which the tool runs: whatever they are, what the window of `gouge-ahead` passes over as far away is
//! far away (it asserts that itself, in tests), and closing a round changes nothing of what is said.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod texts;

use std::fmt::Write;

use proptest::prelude::*;
use station::OffsetColumn;
use texts::{configuration, session, watched};
use warnings::{Finding, Watch};

/// What is found beside a chain of lines, each a turn (degrees) and a length (mm), gone through so many times.
fn found_beside(steps: &[(i32, f64)], rounds: usize, radius: f64, look_ahead: u32) -> Vec<Finding> {
    let mut text = "G17 G21 G40 G90 G94 G54\nG01 X-50. Y-50. F500\nG41 D1 X0. Y0.\n".to_owned();
    let (mut x, mut y, mut heading) = (0.0, 0.0, 0.0_f64);
    for &(turn, length) in (0..rounds).flat_map(|_| steps) {
        heading += f64::from(turn).to_radians();
        (x, y) = (x + length * heading.cos(), y + length * heading.sin());
        let _ = writeln!(text, "X{x:.3} Y{y:.3}");
    }
    text += "G40 X-50. Y-50.\nM30\n";
    let mut configuration = configuration();
    configuration.set_offset(OffsetColumn::Common, 1, radius).expect("the offset is allowed");
    let mut watch = Watch::new(&configuration).looking_ahead(look_ahead);
    watched(&mut session(&configuration, text.as_bytes()), &mut watch, usize::MAX).1
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]

    #[test]
    fn what_is_passed_over_is_far_away(
        steps in prop::collection::vec((-40i32..60, 0.3..6.0f64), 4..40),
        rounds in 1usize..12,
        radius in 0.3..8.0f64,
        look_ahead in prop::sample::select(vec![1u32, 8, 64, 500]),
    ) {
        let found = found_beside(&steps, rounds, radius, look_ahead);
        prop_assert_eq!(&found, &found_beside(&steps, rounds, radius, look_ahead));
    }
}

#[test]
fn a_neck_that_is_too_narrow_is_found() {
    // Out of the way to the right, round to the left in a wide bulb, back through the neck.
    let bulb = [(20, 4.0); 15].into_iter();
    let steps: Vec<(i32, f64)> = [(0, 20.0), (-60, 4.0)].into_iter().chain(bulb).chain([(-60, 20.0)]).collect();
    let said = |radius| found_beside(&steps, 1, radius, 64).iter().any(|finding| finding.rule.name() == "gouge-ahead");
    assert!(!said(0.5) && said(4.0));
}
