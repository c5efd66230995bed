//! One part, four spellings: absolute or incremental, millimetres or inches. The motion is the same to the last bit.
//!
//! Lengths lie on a grid of 0.127 mm = 0.005 inch and feeds on one of 127 mm/min = 5 inch/min, so that both unit
//! systems write them exactly.

#![allow(clippy::expect_used, clippy::panic, clippy::unwrap_used)]

mod watch;

use std::fmt::Write;

use base::Point;
use machine::EventKind;
use proptest::prelude::*;
use proptest::sample;
use station::{OffsetColumn, Session, Setup};
use watch::{Expect, Texts, configuration, machine, run, select};

/// A distance or place in steps of the grid.
type Grid = i64;

/// One piece of a part's program, in distances.
#[derive(Clone, Debug)]
enum Piece {
    Rapid([Grid; 3]),
    Line([Grid; 3], Grid),
    /// Plane, counter-clockwise, centre from the start, end, along the axis beside the plane, feed.
    Arc(usize, bool, [Grid; 2], End, Grid, Grid),
    /// Plane, counter-clockwise, end in the plane, radius beyond the least possible, more than half a circle, feed.
    Radius(usize, bool, [Grid; 2], Grid, bool, Grid),
    /// G43, G44 or G49, number, and how far Z goes.
    Length(u8, u8, Option<Grid>),
    /// G45 to G48, number, distances in X and Y, feed.
    Position(u8, u8, [Grid; 2], Grid),
    /// Cycle, return level, R below the start, depth below R, peck, feed, holes.
    Cycle(u8, u8, Grid, Grid, Grid, Grid, Vec<[Grid; 2]>),
    /// G12 or G13, number, radius, feed.
    Circle(u8, u8, Grid, Grid),
    /// G70 or G72 where X and Y lead, size, angle in degrees, count; with a cycle or alone.
    Pattern(u8, [Grid; 2], Grid, i32, i32, bool),
}

/// Where an arc ends.
#[derive(Clone, Copy, Debug)]
enum End {
    Start,
    Opposite,
    QuarterOn,
    /// Off the circle: a spiral.
    At([Grid; 2]),
}

/// A way of writing.
#[derive(Clone, Copy, Debug)]
struct Spelling {
    incremental: bool,
    inch: bool,
    /// Every other number without a point, in least increments.
    plain: bool,
}

/// Axes of a plane, the axis beside it, their letters and those of the centre.
const PLANES: [(u8, [usize; 3], [char; 2]); 3] =
    [(17, [0, 1, 2], ['I', 'J']), (18, [2, 0, 1], ['K', 'I']), (19, [1, 2, 0], ['J', 'K'])];
const LETTERS: [char; 3] = ['X', 'Y', 'Z'];

/// Writes a part's program.
struct Writer {
    spelling: Spelling,
    /// Where the program is, in its own coordinates.
    at: [Grid; 3],
    text: String,
    numbers: usize,
}

impl Writer {
    fn new(spelling: Spelling) -> Writer {
        let distance = if spelling.incremental { 91 } else { 90 };
        let units = if spelling.inch { 20 } else { 21 };
        Writer { spelling, at: [0; 3], text: format!("O1\nG{units}G{distance}G17G54\n"), numbers: 0 }
    }

    /// A length of so many grid steps.
    fn length(&mut self, letter: char, steps: Grid) {
        self.numbers += 1;
        let (per_step, decimals) = if self.spelling.inch { (50, 4) } else { (127, 3) };
        let counts = steps * per_step;
        if self.spelling.plain && self.numbers.is_multiple_of(2) {
            let _ = write!(self.text, "{letter}{counts}");
            return;
        }
        let (sign, unit) = (if counts < 0 { "-" } else { "" }, 10i64.pow(decimals));
        let (whole, part, width) = (counts.abs() / unit, counts.abs() % unit, decimals as usize);
        let _ = write!(self.text, "{letter}{sign}{whole}.{part:0width$}");
    }

    /// An axis word that leads so far.
    fn axis(&mut self, axis: usize, distance: Grid) {
        self.at[axis] += distance;
        let written = if self.spelling.incremental { distance } else { self.at[axis] };
        self.length(LETTERS[axis], written);
    }

    fn feed(&mut self, steps: Grid) {
        let per_step = if self.spelling.inch { 5 } else { 127 };
        let _ = writeln!(self.text, "F{}.", steps * per_step);
    }

    fn xyz(&mut self, distances: [Grid; 3]) {
        // A zero distance is left out where it is the third: words left out must not matter either.
        for (axis, distance) in distances.into_iter().enumerate() {
            if distance != 0 || axis < 2 {
                self.axis(axis, distance);
            }
        }
    }

    fn piece(&mut self, piece: &Piece) {
        match piece {
            Piece::Rapid(distances) => {
                self.text += "G00";
                self.xyz(*distances);
                self.text += "\n";
            }
            Piece::Line(distances, feed) => {
                self.text += "G01";
                self.xyz(*distances);
                self.feed(*feed);
            }
            Piece::Arc(plane, ccw, center, end, beside, feed) => {
                let (code, [u, v, w], letters) = PLANES[*plane];
                let [i, j] = *center;
                let (du, dv) = match *end {
                    End::Start => (0, 0),
                    End::Opposite => (2 * i, 2 * j),
                    End::QuarterOn => (i + j, j - i),
                    End::At([du, dv]) => (du, dv),
                };
                let _ = write!(self.text, "G{code}G0{}", if *ccw { 3 } else { 2 });
                self.axis(u, du);
                self.axis(v, dv);
                if *beside != 0 {
                    self.axis(w, *beside);
                }
                self.length(letters[0], i);
                self.length(letters[1], j);
                self.feed(*feed);
            }
            Piece::Radius(plane, ccw, end, more, greater, feed) => {
                let (code, [u, v, _], _) = PLANES[*plane];
                let _ = write!(self.text, "G{code}G0{}", if *ccw { 3 } else { 2 });
                self.axis(u, end[0]);
                self.axis(v, end[1]);
                let least = (end[0] * end[0] + end[1] * end[1]).isqrt() / 2 + 1;
                self.length('R', if *greater { -(least + more) } else { least + more });
                self.feed(*feed);
            }
            Piece::Length(code, number, distance) => {
                let _ = write!(self.text, "G00G{code}");
                if let Some(distance) = distance {
                    self.axis(2, *distance);
                }
                let _ = writeln!(self.text, "H{number}");
            }
            Piece::Position(code, number, distances, feed) => {
                let _ = write!(self.text, "G01G{code}");
                self.axis(0, distances[0]);
                self.axis(1, distances[1]);
                let _ = write!(self.text, "D{number}");
                self.feed(*feed);
            }
            Piece::Circle(code, number, radius, feed) => {
                let _ = write!(self.text, "G{code}D{number}");
                self.length('I', *radius);
                self.feed(*feed);
            }
            Piece::Cycle(cycle, level, r, depth, peck, feed, holes) => {
                let _ = write!(self.text, "G{level}G{cycle}");
                for (index, hole) in holes.iter().enumerate() {
                    self.axis(0, hole[0]);
                    self.axis(1, hole[1]);
                    if index == 0 {
                        self.levels(*r, *depth, *peck);
                        self.feed(*feed);
                    } else {
                        self.text += "\n";
                    }
                }
                self.text += "G80\n";
                if *level == 99 {
                    self.at[2] -= r;
                }
            }
            Piece::Pattern(code, place, size, angle, count, drills) => {
                if *drills {
                    self.text += "G98G81";
                    self.levels(3, 7, 1);
                    self.text += "L0";
                    self.feed(4);
                }
                let _ = write!(self.text, "G{code}");
                self.axis(0, place[0]);
                self.axis(1, place[1]);
                self.length('I', *size);
                let _ = writeln!(self.text, "J{angle}.L{count}\nG80");
                // The last hole lies off the grid: one absolute move leads back to it.
                self.text += "G90G00";
                let incremental = std::mem::replace(&mut self.spelling.incremental, false);
                self.axis(0, 0);
                self.axis(1, 0);
                self.spelling.incremental = incremental;
                self.text += if incremental { "\nG91\n" } else { "\n" };
            }
        }
    }

    /// R, Z, Q and P of a cycle that begins where the program is.
    fn levels(&mut self, r: Grid, depth: Grid, peck: Grid) {
        let (r_word, z_word) =
            if self.spelling.incremental { (-r, -depth) } else { (self.at[2] - r, self.at[2] - r - depth) };
        self.length('R', r_word);
        self.length('Z', z_word);
        self.length('Q', peck);
        self.text += "P250";
    }
}

fn write(pieces: &[Piece], spelling: Spelling) -> String {
    let mut writer = Writer::new(spelling);
    pieces.iter().for_each(|piece| writer.piece(piece));
    writer.text + "M30\n"
}

/// What moves: kind, end, centre, sweep, feed.
type Motion = (&'static str, Point, [f64; 2], f64, f64);

fn motion(text: &str) -> Vec<Motion> {
    let setup = Setup {
        offsets: vec![
            (OffsetColumn::Common, 1, 120.0),
            (OffsetColumn::Common, 2, -3.255),
            (OffsetColumn::Common, 31, 8.001),
            (OffsetColumn::Common, 32, -0.5),
        ],
        work: vec![("G54".into(), b'X', 10.0), ("G54".into(), b'Z', -20.005)],
        // Both kinds of programs begin at program zero.
        start: vec![(b'X', 10.0), (b'Z', -20.005)],
        // As shipped, an absolute word drops what G45 to G48 left behind and an incremental one keeps it: two motions.
        policies: vec![("position-offset-absolute".into(), "kept".into())],
        ..Setup::default()
    };
    let mut session = Session::new(configuration(machine("unlimited", None), &setup), Texts::one(text));
    select(&mut session, 0);
    let events = run(&mut session, Expect { most_events: 100_000, stays_inside: true });
    let moves = events.iter().filter_map(|event| match &event.kind {
        EventKind::Rapid { to, .. } => Some(("rapid", *to, [0.0; 2], 0.0, 0.0)),
        EventKind::Feed { to, feed, .. } => Some(("feed", *to, [0.0; 2], 0.0, *feed)),
        EventKind::Arc { arc, feed, .. } => Some(("arc", arc.to, arc.center, arc.sweep, *feed)),
        EventKind::Alarm(alarm) => panic!("{:?} in line {} of\n{text}", alarm.condition, alarm.place.line),
        _ => None,
    });
    moves.collect()
}

fn distance() -> impl Strategy<Value = Grid> {
    prop_oneof![1 => Just(0), 5 => -400i64..400]
}

fn feed() -> impl Strategy<Value = Grid> {
    1i64..60
}

fn piece() -> impl Strategy<Value = Piece> {
    let end = prop_oneof![
        Just(End::Start),
        Just(End::Opposite),
        Just(End::QuarterOn),
        [distance(), distance()].prop_map(End::At)
    ];
    let not_nothing = |pair: &[Grid; 2]| *pair != [0, 0];
    prop_oneof![
        2 => [distance(), distance(), distance()].prop_map(Piece::Rapid),
        3 => ([distance(), distance(), distance()], feed()).prop_map(|(d, f)| Piece::Line(d, f)),
        3 => (0usize..3, any::<bool>(), [distance(), distance()].prop_filter("a radius", not_nothing), end, distance(), feed())
            .prop_map(|(p, ccw, c, end, beside, f)| Piece::Arc(p, ccw, c, end, beside, f)),
        2 => (0usize..3, any::<bool>(), [distance(), distance()].prop_filter("a way", not_nothing), 0i64..300, any::<bool>(), feed())
            .prop_map(|(p, ccw, e, more, greater, f)| Piece::Radius(p, ccw, e, more, greater, f)),
        1 => (sample::select(vec![43u8, 44, 49]), sample::select(vec![0u8, 1, 2]), proptest::option::of(distance()))
            .prop_map(|(g, h, z)| Piece::Length(g, h, z)),
        2 => (45u8..49, sample::select(vec![31u8, 32]), [distance(), distance()], feed()).prop_map(|(g, d, to, f)| Piece::Position(g, d, to, f)),
        1 => (12u8..14, sample::select(vec![31u8, 32]), 64i64..400, feed()).prop_map(|(g, d, i, f)| Piece::Circle(g, d, i, f)),
        2 => (sample::select(vec![73u8, 74, 76, 81, 82, 83, 84, 85, 86, 87, 88, 89]), sample::select(vec![98u8, 99]), 0i64..40, 1i64..90, 1i64..30, feed(), prop::collection::vec([distance(), distance()], 1..4))
            .prop_map(|(g, level, r, z, q, f, holes)| Piece::Cycle(g, level, r, z, q, f, holes)),
        1 => (sample::select(vec![70u8, 72]), [distance(), distance()], 1i64..300, -400i32..400, 1i32..9, any::<bool>())
            .prop_map(|(g, at, i, j, l, drills)| Piece::Pattern(g, at, i, j, l, drills)),
    ]
}

proptest! {
    #[test]
    fn every_spelling_of_a_part_is_the_same_motion(pieces in prop::collection::vec(piece(), 1..12)) {
        let plain = write(&pieces, Spelling { incremental: false, inch: false, plain: false });
        let wanted = motion(&plain);
        for (incremental, inch) in [(false, true), (true, false), (true, true)] {
            let text = write(&pieces, Spelling { incremental, inch, plain: true });
            prop_assert_eq!(&motion(&text), &wanted, "of\n{}\nand\n{}", text, plain);
        }
    }

    #[test]
    fn a_part_split_in_two_by_a_subprogram_is_the_same_motion(pieces in prop::collection::vec(piece(), 2..8), cut in 1usize..7) {
        let spelling = Spelling { incremental: false, inch: false, plain: false };
        let whole = write(&pieces, spelling);
        let mut writer = Writer::new(spelling);
        let cut = cut.min(pieces.len() - 1);
        pieces[..cut].iter().for_each(|piece| writer.piece(piece));
        let main = std::mem::take(&mut writer.text);
        pieces[cut..].iter().for_each(|piece| writer.piece(piece));
        let text = format!("{main}M98P2\nM30\nO2\n{}M99\n", writer.text);
        prop_assert_eq!(motion(&text), motion(&whole), "of\n{}", text);
    }
}
