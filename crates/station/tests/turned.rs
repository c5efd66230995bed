//! Rotation, a ratio for each axis and polar coordinates: the moves of a program under G51 and G68 are those of the
//! plain program, mapped by arithmetic here; a polar program makes the points that sine and cosine give.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::sync::{Arc, LazyLock};

use base::Point;
use dialect::{Control, ParameterSetting};
use machine::EventKind;
use proptest::prelude::*;
use proptest::sample;
use station::{Configuration, Session, Setup};
use watch::{Expect, Texts, load, machine, run, select};

/// Points that are derived differ by rounding, mm.
const EXACTNESS_MM: f64 = 1e-6;
/// The three planes: first and second axis, the one beside them.
const PLANES: [[usize; 3]; 3] = [[0, 1, 2], [2, 0, 1], [1, 2, 0]];
const LETTERS: [char; 3] = ['X', 'Y', 'Z'];
const CENTRES: [char; 3] = ['I', 'J', 'K'];

/// One block or two; lengths in thousandths of a mm. `None` leaves a word out.
#[derive(Clone, Debug)]
enum Piece {
    Incremental(bool),
    Move(bool, [Option<i64>; 3]),
    /// Counter-clockwise, from start to centre, so many quarters.
    Quarters(bool, [i64; 2], u8),
    /// Counter-clockwise, distance to the end, how much longer than needed the radius is, the greater arc.
    Radius(bool, [i64; 2], i64, bool),
    /// G81 to G89, G98 or G99, R, Z, place, repeats under G91.
    Cycle(u8, u8, i64, i64, [Option<i64>; 2], u8),
}

fn words(letters: &[char], values: &[Option<i64>]) -> String {
    letters.iter().zip(values).filter_map(|(letter, value)| value.map(|value| format!("{letter}{value}"))).collect()
}

/// A program in the plane of this index.
fn write(plane: usize, pieces: &[Piece]) -> String {
    let [u, v, _] = PLANES[plane];
    let mut text = String::new();
    for piece in pieces {
        text += &match piece {
            Piece::Incremental(true) => "G91".to_owned(),
            Piece::Incremental(false) => "G90".to_owned(),
            Piece::Move(rapid, to) => format!("G0{}{}", u8::from(!rapid), words(&LETTERS, to)),
            Piece::Quarters(ccw, center, quarters) => {
                let mut arm = [-center[0], -center[1]];
                for _ in 0..*quarters {
                    arm = if *ccw { [-arm[1], arm[0]] } else { [arm[1], -arm[0]] };
                }
                let (way, g) = ([center[0] + arm[0], center[1] + arm[1]], if *ccw { 3 } else { 2 });
                let end = words(&[LETTERS[u], LETTERS[v]], &way.map(Some));
                format!("G91 G0{g}{end}{}{}{}{}\nG90", CENTRES[u], center[0], CENTRES[v], center[1])
            }
            Piece::Radius(ccw, way, more, greater) => {
                let radius = (way[0].abs() + way[1].abs() + more) * if *greater { -1 } else { 1 };
                let end = words(&[LETTERS[u], LETTERS[v]], &way.map(Some));
                format!("G91 G0{}{end}R{radius}\nG90", if *ccw { 3 } else { 2 })
            }
            Piece::Cycle(g, level, r, z, at, repeats) => {
                let place = words(&LETTERS[..2], at);
                format!("G91 G{level} G{g}{place}R{r}Z{z}P100L{repeats}\nG80\nG90")
            }
        };
        text += "\n";
    }
    text
}

type Move = (&'static str, [f64; 3], [f64; 2], f64);

fn control() -> Arc<Control> {
    static CONTROL: LazyLock<Arc<Control>> = LazyLock::new(|| load("incon-m84"));
    CONTROL.clone()
}

/// The moves of a program behind its first `G00X0Y0Z0`.
fn motion(text: &str) -> Vec<Move> {
    let setup = Setup {
        parameters: vec![ParameterSetting { name: "arc radius tolerance".into(), bit: None, value: "1".into() }],
        ..Setup::default()
    };
    let configuration =
        Configuration::new(control(), machine("unlimited", None), &[&setup]).expect("the set-up fits the control");
    let mut session = Session::new(configuration, Texts::one(text));
    select(&mut session, 0);
    let three = |point: &Point| [point[0], point[1], point[2]];
    let start = text.lines().position(|line| line == "G00X0Y0Z0").map_or(0, |line| line as u64 + 1);
    let events = run(&mut session, Expect { most_events: 100_000, stays_inside: true });
    let moves = events.iter().filter(|event| event.place.line > start).filter_map(|event| match &event.kind {
        EventKind::Rapid { to, .. } => Some(("rapid", three(to), [0.0; 2], 0.0)),
        EventKind::Feed { to, .. } => Some(("feed", three(to), [0.0; 2], 0.0)),
        EventKind::Arc { arc, .. } => Some(("arc", three(&arc.to), arc.center, arc.sweep)),
        EventKind::Alarm(alarm) => panic!("{:?} in line {} of\n{text}", alarm.condition, alarm.place.line),
        _ => None,
    });
    moves.collect()
}

/// What G51 and G68 do: scaled about `center`, then turned about `pivot`, which is scaled too.
#[derive(Clone, Copy, Debug)]
struct Map {
    plane: usize,
    center: [i64; 3],
    /// Thousandths.
    ratio: [i64; 3],
    pivot: [i64; 2],
    /// Thousandths of a degree.
    angle: i64,
}

impl Map {
    fn codes(&self, turned_first: bool) -> String {
        let [u, v, _] = PLANES[self.plane];
        let scale = format!(
            "G51{}I{}J{}K{}\n",
            words(&LETTERS, &self.center.map(Some)),
            self.ratio[0],
            self.ratio[1],
            self.ratio[2]
        );
        let turn = format!("G68{}R{}\n", words(&[LETTERS[u], LETTERS[v]], &self.pivot.map(Some)), self.angle);
        if turned_first { turn + &scale } else { scale + &turn }
    }

    fn is_over(&self) -> bool {
        let [u, v, _] = PLANES[self.plane];
        (self.ratio[u] < 0) != (self.ratio[v] < 0)
    }

    fn scaled(&self, axis: usize, mm: f64) -> f64 {
        let (center, ratio) = (self.center[axis] as f64 / 1e3, self.ratio[axis] as f64 / 1e3);
        center + ratio * (mm - center)
    }

    fn point(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [u, v, _] = PLANES[self.plane];
        let pivot = [self.scaled(u, self.pivot[0] as f64 / 1e3), self.scaled(v, self.pivot[1] as f64 / 1e3)];
        let (du, dv) = (self.scaled(u, x) - pivot[0], self.scaled(v, y) - pivot[1]);
        let angle = (self.angle as f64 / 1e3).to_radians() * if self.is_over() { -1.0 } else { 1.0 };
        [pivot[0] + du * angle.cos() - dv * angle.sin(), pivot[1] + du * angle.sin() + dv * angle.cos()]
    }

    fn mapped(&self, (kind, to, center, sweep): Move) -> Move {
        let [u, v, w] = PLANES[self.plane];
        let mut there = to;
        [there[u], there[v]] = self.point([to[u], to[v]]);
        there[w] = self.scaled(w, to[w]);
        match kind {
            "arc" => (kind, there, self.point(center), if self.is_over() { -sweep } else { sweep }),
            _ => (kind, there, center, sweep),
        }
    }
}

fn same(text: &str, expected: &[Move]) -> Result<(), TestCaseError> {
    let differ = |(one, other): (&Move, &Move)| {
        let apart = |a: &f64, b: &f64| (a - b).abs() > EXACTNESS_MM;
        let numbers = |m: &Move| [&m.1[..], &m.2[..], &[m.3]].concat();
        one.0 != other.0 || numbers(one).iter().zip(&numbers(other)).any(|(a, b)| apart(a, b))
    };
    let found = motion(text);
    let first = found.iter().zip(expected).position(differ);
    prop_assert!(
        first.is_none() && found.len() == expected.len(),
        "move {first:?} of\n{text}\n{found:?}\nexpected\n{expected:?}"
    );
    Ok(())
}

fn length() -> impl Strategy<Value = i64> {
    prop_oneof![1 => Just(0), 6 => -80_000i64..80_000]
}

fn angle() -> impl Strategy<Value = i64> {
    prop_oneof![sample::select(vec![0i64, 90_000, -90_000, 180_000]), -360_000i64..=360_000]
}

fn piece(arcs: bool, cycles: bool) -> impl Strategy<Value = Piece> {
    let some = |pair: &[i64; 2]| *pair != [0, 0];
    let pair = || [length(), length()];
    let word = || prop::option::weighted(0.6, length());
    let arcs = u32::from(arcs);
    prop_oneof![
        2 => any::<bool>().prop_map(Piece::Incremental),
        5 => (any::<bool>(), [word(), word(), word()]).prop_map(|(rapid, to)| Piece::Move(rapid, to)),
        3 * arcs => (any::<bool>(), pair().prop_filter("a radius", some), 1u8..=4)
            .prop_map(|(ccw, c, q)| Piece::Quarters(ccw, c, q)),
        2 * arcs => (any::<bool>(), pair().prop_filter("a way", some), 10i64..9000, any::<bool>())
            .prop_map(|(ccw, w, m, g)| Piece::Radius(ccw, w, m, g)),
        2 * u32::from(cycles) =>
            (sample::select(vec![81u8, 82, 85]), 98u8..100, -9000i64..0, -9000i64..-1, [word(), word()], 1u8..4)
            .prop_map(|(g, level, r, z, at, l)| Piece::Cycle(g, level, r, z, at, l)),
    ]
}

fn pieces(arcs: bool, cycles: bool) -> impl Strategy<Value = Vec<Piece>> {
    prop::collection::vec(piece(arcs, cycles), 1..12)
}

/// Ratios of one size with any signs, a centre, a rotation.
fn map(plane: usize, ratio: impl Strategy<Value = [i64; 3]>) -> impl Strategy<Value = Map> {
    ([length(), length(), length()], ratio, [length(), length()], angle())
        .prop_map(move |(center, ratio, pivot, angle)| Map { plane, center, ratio, pivot, angle })
}

fn of_one_size() -> impl Strategy<Value = [i64; 3]> {
    (1i64..4000, any::<[bool; 3]>()).prop_map(|(size, over)| over.map(|over| if over { -size } else { size }))
}

fn of_any_size() -> impl Strategy<Value = [i64; 3]> {
    let ratio = || (1i64..4000, any::<bool>()).prop_map(|(size, over)| if over { -size } else { size });
    [ratio(), ratio(), ratio()]
}

fn holds(map: Map, pieces: &[Piece], turned_first: bool) -> Result<(), TestCaseError> {
    let head = format!("G{}\n", 17 + map.plane);
    let body = format!("F1000\nG00X0Y0Z0\n{}", write(map.plane, pieces));
    let plain: Vec<Move> = motion(&(head.clone() + &body)).into_iter().map(|m| map.mapped(m)).collect();
    same(&(head + &map.codes(turned_first) + &body), &plain)
}

proptest! {
    #[test]
    fn a_part_scaled_mirrored_and_turned_is_mapped(
        map in map(0, of_one_size()), pieces in pieces(true, true), turned_first in any::<bool>()
    ) {
        holds(map, &pieces, turned_first)?;
    }

    #[test]
    fn lines_and_holes_are_mapped_by_any_ratios(map in map(0, of_any_size()), pieces in pieces(false, true)) {
        holds(map, &pieces, false)?;
    }

    #[test]
    fn the_other_planes_do_the_same(
        map in (1usize..3).prop_flat_map(|plane| map(plane, of_one_size())), pieces in pieces(true, false)
    ) {
        holds(map, &pieces, false)?;
    }

    #[test]
    fn polar_words_are_points(
        plane in 0usize..3, words in prop::collection::vec((any::<bool>(), prop::option::of(length()), prop::option::of(angle())), 1..12)
    ) {
        let [u, v, _] = PLANES[plane];
        let mut text = format!("G{}\nG00X0Y0Z0\nG16\n", 17 + plane);
        let (mut pole, mut radius, mut degrees, mut at) = ([0.0; 2], 0.0, 0.0f64, [0.0; 3]);
        let mut expected: Vec<Move> = Vec::new();
        for (incremental, length, angle) in words {
            text += &format!("G9{}", u8::from(incremental));
            if let Some(length) = length {
                text += &format!("{}{length}", LETTERS[u]);
                pole = if incremental { [at[u], at[v]] } else { [0.0; 2] };
                radius = length as f64 / 1e3;
            }
            if let Some(angle) = angle {
                text += &format!("{}{angle}", LETTERS[v]);
                degrees = angle as f64 / 1e3 + if incremental { degrees } else { 0.0 };
            }
            text += "\n";
            if length.is_none() && angle.is_none() {
                continue;
            }
            let mut to = at;
            to[u] = pole[0] + radius * degrees.to_radians().cos();
            to[v] = pole[1] + radius * degrees.to_radians().sin();
            if to.iter().zip(&at).any(|(a, b)| (a - b).abs() > 1e-9) {
                expected.push(("rapid", to, [0.0; 2], 0.0));
            }
            at = to;
        }
        same(&text, &expected)?;
    }
}
