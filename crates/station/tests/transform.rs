//! Scale and mirror: a part scaled by G51 is the part with every number multiplied, a part mirrored by M95 the part with
//! signs, senses and angles turned over by hand.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use base::Point;
use dialect::ParameterSetting;
use machine::EventKind;
use proptest::prelude::*;
use proptest::sample;
use station::{Session, Setup};
use watch::{Expect, Texts, configuration, machine, run, select};

/// Points that are derived differ by rounding, mm.
const EXACTNESS_MM: f64 = 1e-6;

/// One block or two; lengths in thousandths of a mm, angles in thousandths of a degree.
#[derive(Clone, Debug)]
enum Piece {
    Incremental(bool),
    Rapid([i64; 3]),
    Line([i64; 3]),
    /// Plane G17 to G19, counter-clockwise, centre, end, beside the plane.
    Arc(usize, bool, [i64; 2], [i64; 2], i64),
    /// Counter-clockwise, distance to the end, how much longer than needed the radius is, the greater arc.
    Radius(bool, [i64; 2], i64, bool),
    /// Through this point to the reference point along X and Y.
    Reference([i64; 2]),
    /// G81 to G89, G98 or G99, R, Z, positions, repeats.
    Cycle(u8, u8, i64, i64, [i64; 2], u8),
    Bolts([i64; 2], i64, i64, i8),
    Arcs([i64; 2], i64, i64, i64, u8),
    Row([i64; 2], i64, i64, u8),
}

/// How words are written: the factor of lengths, and the axes X and Y turned over.
#[derive(Clone, Copy, Debug)]
struct Hand {
    factor: i64,
    over: [bool; 2],
}

impl Hand {
    fn along(self, axis: usize, value: i64) -> i64 {
        if self.over.get(axis) == Some(&true) { -value * self.factor } else { value * self.factor }
    }

    fn swaps(self, axes: [usize; 2]) -> bool {
        let over = |axis: usize| self.over.get(axis) == Some(&true);
        over(axes[0]) != over(axes[1])
    }

    fn angle(self, angle: i64) -> i64 {
        match self.over {
            [false, false] => angle,
            [true, false] => 180_000 - angle,
            [false, true] => -angle,
            [true, true] => 180_000 + angle,
        }
    }

    fn turn(self, angle: i64) -> i64 {
        if self.swaps([0, 1]) { -angle } else { angle }
    }

    fn xyz(self, to: [i64; 3]) -> String {
        format!("X{}Y{}Z{}", self.along(0, to[0]), self.along(1, to[1]), self.along(2, to[2]))
    }

    fn xy(self, to: [i64; 2]) -> String {
        format!("X{}Y{}", self.along(0, to[0]), self.along(1, to[1]))
    }

    fn write(self, pieces: &[Piece]) -> String {
        let mut text = "F1000\n".to_owned();
        for piece in pieces {
            self.piece(piece, &mut text);
        }
        text
    }

    fn piece(self, piece: &Piece, text: &mut String) {
        let factor = self.factor;
        let block = match piece {
            Piece::Incremental(true) => "G91".to_owned(),
            Piece::Incremental(false) => "G90".to_owned(),
            Piece::Rapid(to) => format!("G00{}", self.xyz(*to)),
            Piece::Line(to) => format!("G01{}", self.xyz(*to)),
            Piece::Arc(plane, ccw, center, end, beside) => {
                let axes = [[0, 1], [2, 0], [1, 2]][*plane];
                let third = 3 - axes[0] - axes[1];
                let ccw = *ccw != self.swaps(axes);
                let word = |letters: &[u8; 3], axis: usize, value| {
                    format!("{}{}", char::from(letters[axis]), self.along(axis, value))
                };
                let mut block = format!("G{}G0{}", 17 + plane, if ccw { 3 } else { 2 });
                for place in 0..2 {
                    block += &word(b"XYZ", axes[place], end[place]);
                    block += &word(b"IJK", axes[place], center[place]);
                }
                block + &word(b"XYZ", third, *beside)
            }
            Piece::Radius(ccw, way, more, greater) => {
                let ccw = *ccw != self.swaps([0, 1]);
                let radius = (way[0].abs() + way[1].abs() + more) * factor;
                let radius = if *greater { -radius } else { radius };
                format!("G91G17G0{}{}R{radius}\nG90", if ccw { 3 } else { 2 }, self.xy(*way))
            }
            Piece::Reference(via) => format!("G28{}", self.xy(*via)),
            Piece::Cycle(g, level, r, z, at, repeats) => {
                let (r, z) = (r * factor, z * factor);
                format!("G{level}G{g}{}R{r}Z{z}P100L{repeats}\nG80", self.xy(*at))
            }
            Piece::Bolts(at, radius, angle, holes) => {
                let holes = self.turn(i64::from(*holes));
                format!("G70{}I{}J{}L{holes}", self.xy(*at), radius * factor, self.angle(*angle))
            }
            Piece::Arcs(at, radius, angle, step, holes) => {
                let (angle, step) = (self.angle(*angle), self.turn(*step));
                format!("G71{}I{}J{angle}K{step}L{holes}", self.xy(*at), radius * factor)
            }
            Piece::Row(at, pitch, angle, holes) => {
                format!("G72{}I{}J{}L{holes}", self.xy(*at), pitch * factor, self.angle(*angle))
            }
        };
        *text += &block;
        *text += "\n";
    }
}

type Move = (&'static str, Point, [f64; 2], f64);

fn motion(text: &str, mirrored: [bool; 2]) -> Vec<Move> {
    let bits = u8::from(mirrored[0]) | u8::from(mirrored[1]) << 1;
    let setup = Setup {
        parameters: vec![ParameterSetting { name: "6000".into(), bit: None, value: bits.to_string() }],
        ..Setup::default()
    };
    let mut session = Session::new(configuration(machine("unlimited", None), &setup), Texts::one(text));
    select(&mut session, 0);
    let events = run(&mut session, Expect { most_events: 100_000, stays_inside: true });
    let moves = events.iter().filter_map(|event| match &event.kind {
        EventKind::Rapid { to, .. } => Some(("rapid", *to, [0.0; 2], 0.0)),
        EventKind::Feed { to, .. } => Some(("feed", *to, [0.0; 2], 0.0)),
        EventKind::Arc { arc, .. } => Some(("arc", arc.to, arc.center, arc.sweep)),
        EventKind::Alarm(alarm) => panic!("{:?} in line {} of\n{text}", alarm.condition, alarm.place.line),
        _ => None,
    });
    moves.collect()
}

fn differ(one: &Move, other: &Move) -> bool {
    let apart = |a: f64, b: f64| (a - b).abs() > EXACTNESS_MM;
    let points = one.1.iter().zip(&other.1).chain(one.2.iter().zip(&other.2)).any(|(&a, &b)| apart(a, b));
    one.0 != other.0 || points || apart(one.3, other.3)
}

/// Moves so short that rounding decides whether there are any.
fn without_nothing(moves: Vec<Move>) -> Vec<Move> {
    let mut kept: Vec<Move> = Vec::new();
    for next in moves {
        let last = kept.last().map_or([0.0; 8], |last| last.1);
        let still = next.1.iter().zip(&last).all(|(a, b)| (a - b).abs() <= EXACTNESS_MM);
        if next.0 == "arc" || !still {
            kept.push(next);
        }
    }
    kept
}

fn same(one: &str, mirrored: [bool; 2], other: &str) -> Result<(), TestCaseError> {
    let (a, b) = (without_nothing(motion(one, mirrored)), without_nothing(motion(other, [false; 2])));
    let first = a.iter().zip(&b).position(|(a, b)| differ(a, b));
    prop_assert!(first.is_none() && a.len() == b.len(), "move {first:?} of\n{one}\nand\n{other}\n{a:?}\n{b:?}");
    Ok(())
}

fn length() -> impl Strategy<Value = i64> {
    prop_oneof![1 => Just(0), 6 => -80_000i64..80_000]
}

fn angle() -> impl Strategy<Value = i64> {
    prop_oneof![sample::select(vec![0i64, 90_000, -90_000, 180_000]), -400_000i64..400_000]
}

fn piece() -> impl Strategy<Value = Piece> {
    let some = |pair: &[i64; 2]| *pair != [0, 0];
    let pair = || [length(), length()];
    let triple = || [length(), length(), length()];
    prop_oneof![
        2 => any::<bool>().prop_map(Piece::Incremental),
        2 => triple().prop_map(Piece::Rapid),
        3 => triple().prop_map(Piece::Line),
        3 => (0usize..3, any::<bool>(), pair().prop_filter("a radius", some), pair(), length())
            .prop_map(|(p, ccw, c, e, b)| Piece::Arc(p, ccw, c, e, b)),
        2 => (any::<bool>(), pair().prop_filter("a way", some), 1i64..9000, any::<bool>())
            .prop_map(|(ccw, w, m, g)| Piece::Radius(ccw, w, m, g)),
        1 => pair().prop_map(Piece::Reference),
        2 => (sample::select(vec![81u8, 82, 84]), 98u8..100, 0i64..9000, -9000i64..-1, pair(), 1u8..4)
            .prop_map(|(g, level, r, z, at, l)| Piece::Cycle(g, level, r, z, at, l)),
        1 => (pair(), 1i64..30_000, angle(), sample::select(vec![-5i8, -1, 1, 3, 6]))
            .prop_map(|(at, i, j, l)| Piece::Bolts(at, i, j, l)),
        1 => (pair(), 1i64..30_000, angle(), angle(), 1u8..6).prop_map(|(at, i, j, k, l)| Piece::Arcs(at, i, j, k, l)),
        1 => (pair(), -9000i64..9000, angle(), 1u8..6).prop_map(|(at, i, j, l)| Piece::Row(at, i, j, l)),
    ]
}

const AS_WRITTEN: Hand = Hand { factor: 1, over: [false; 2] };

proptest! {
    #[test]
    fn a_scaled_part_has_its_numbers_multiplied(pieces in prop::collection::vec(piece(), 1..12), factor in 2i64..6) {
        let scaled = format!("G51X0Y0Z0P{}\n{}", factor * 1000, AS_WRITTEN.write(&pieces));
        same(&scaled, [false; 2], &Hand { factor, over: [false; 2] }.write(&pieces))?;
    }

    #[test]
    fn a_part_scaled_down_has_its_numbers_divided(pieces in prop::collection::vec(piece(), 1..12)) {
        let scaled = format!("G51X0Y0Z0P250\n{}", Hand { factor: 4, over: [false; 2] }.write(&pieces));
        same(&scaled, [false; 2], &AS_WRITTEN.write(&pieces))?;
    }

    #[test]
    fn a_mirrored_part_is_turned_over(pieces in prop::collection::vec(piece(), 1..12), over in any::<[bool; 2]>()) {
        let mirrored = format!("M95\n{}", AS_WRITTEN.write(&pieces));
        same(&mirrored, over, &Hand { factor: 1, over }.write(&pieces))?;
    }

    #[test]
    fn a_part_turned_over_and_mirrored_is_itself(pieces in prop::collection::vec(piece(), 1..12), over in any::<[bool; 2]>()) {
        let mirrored = format!("M95\n{}", Hand { factor: 1, over }.write(&pieces));
        same(&mirrored, over, &AS_WRITTEN.write(&pieces))?;
    }

    #[test]
    fn a_part_scaled_and_mirrored_is_both(pieces in prop::collection::vec(piece(), 1..12), over in any::<[bool; 2]>()) {
        let both = format!("M95\nG51X0Y0Z0P3000\n{}", AS_WRITTEN.write(&pieces));
        same(&both, over, &Hand { factor: 3, over }.write(&pieces))?;
    }
}
