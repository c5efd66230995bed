//! Random chains of lines and arcs beside which the tool runs: whatever comes out joins up, is a number and ends.
#![no_main]

use dialect::{CompensationCut, CompensationRules, CompensationStart};
use libfuzzer_sys::fuzz_target;
use meaning::{Element, Offset, Plane, Turn};
use path::{ChainRules, Link, Shape, run_chain};

/// Elements of a chain.
const MOST: usize = 16;
/// Bytes that make one.
const BYTES: usize = 8;
/// Pieces that one element can be run in, at most.
const PIECES: usize = 8;

/// A length in counts: a nanometre to a kilometre, so that tiny elements stand beside huge ones.
fn length(bytes: [u8; 2]) -> f64 {
    let number = f64::from(i16::from_le_bytes(bytes) >> 4);
    number * 10f64.powi(i32::from(bytes[0] & 15) - 3).max(1.0)
}

fn element(from: [f64; 2], bytes: &[u8; BYTES]) -> Element {
    let [kind, _, a, b, c, d, e, f] = *bytes;
    let step = [length([a, b]), length([c, d])];
    let to = [from[0] + step[0], from[1] + step[1]];
    if kind & 1 == 0 {
        return Element { from, to, turn: None };
    }
    let clockwise = kind & 2 != 0;
    if kind & 4 != 0 {
        return Element { from, to: from, turn: Some(Turn { center: to, clockwise, full_circle: true }) };
    }
    // On the bisector, so that it is a circle but for rounding; now and then a spiral.
    let aside = f64::from(i8::from_le_bytes([e])) / 16.0;
    let wrong = if kind & 24 == 24 { f64::from(f) * 1000.0 } else { 0.0 };
    let center = [from[0] + step[0] / 2.0 - step[1] * aside + wrong, from[1] + step[1] / 2.0 + step[0] * aside];
    Element { from, to, turn: Some(Turn { center, clockwise, full_circle: false }) }
}

fuzz_target!(|bytes: &[u8]| {
    let Some((&[options, tool, scale, ..], rest)) =
        bytes.split_at_checked(4).and_then(|(head, rest)| Some((head.first_chunk::<3>()?, rest)))
    else {
        return;
    };
    let radius = f64::from(tool) * 10f64.powi(i32::from(scale % 8) - 4);
    let mut offset = Offset { radius, plane: Plane::Xy, axes: [0, 1], round_corners: options & 1 != 0 };
    let mut chain: Vec<Link> = Vec::with_capacity(MOST);
    let mut from = [0.0; 2];
    for bytes in rest.chunks_exact(BYTES).take(MOST) {
        let Some(bytes) = bytes.first_chunk::<BYTES>() else { break };
        let element = element(from, bytes);
        from = element.to;
        // Seldom another tool, the other side, or the way back.
        match bytes[1] {
            0..8 => offset.radius = -offset.radius,
            8..16 => offset.radius *= 0.75,
            _ => {}
        }
        chain.push((element, (bytes[1] < 248).then_some(offset)));
    }
    let rules = ChainRules {
        start: if options & 2 == 0 { CompensationStart::Square } else { CompensationStart::Corner },
        cut: if options & 16 == 0 { CompensationCut::Run } else { CompensationCut::Refuse },
        table: CompensationRules {
            refuses_machine_places: false,
            refuses_equal_arc: options & 4 != 0,
            circles_close: options & 8 != 0,
        },
    };
    let mut stands = None;
    let mut pieces = 0;
    run_chain(&chain, &rules, |shape| {
        pieces += 1;
        let (from, to) = match shape {
            Shape::Line { from, to, .. } | Shape::Rapid { from, to, .. } => (*from, *to),
            Shape::Arc { arc, .. } => {
                let numbers = [arc.sweep, arc.start_angle, arc.center[0], arc.center[1], arc.radius[0], arc.radius[1]];
                assert!(numbers.iter().all(|number| number.is_finite()), "{arc:?}");
                (arc.from, arc.to)
            }
            _ => return,
        };
        assert!(from.iter().chain(&to).all(|place| place.is_finite()), "{shape:?}");
        if let Some(stands) = stands {
            assert_eq!(from, stands, "a piece begins where the one before it ended");
        }
        stands = Some(to);
    });
    assert!(pieces <= chain.len() * PIECES);
});
