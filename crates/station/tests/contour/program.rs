//! Contours as program texts, and what a session makes of them.

use std::fmt::Write;
use std::sync::{Arc, LazyLock};

use base::Condition;
use dialect::{Control, ParameterSetting};
use machine::EventKind;
use station::{Configuration, OffsetColumn, Session, Setup, Step};

use super::measure::{Bow, Form, Vector, add, apart, left_of, times};
use super::{Contour, Place, mm};
use crate::watch::{Texts, load, machine, select};

/// How outside corners are gone round.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Corners {
    /// M96.
    Arcs,
    /// M97.
    Intersections,
    /// No code: what the control does of itself, which is intersections.
    Unsaid,
}

/// Which two axes span the plane of a program.
pub const PLANES: [(&str, [&str; 2], [&str; 2], &str); 3] =
    [("G17", ["X", "Y"], ["I", "J"], "Z"), ("G18", ["Z", "X"], ["K", "I"], "Y"), ("G19", ["Y", "Z"], ["J", "K"], "X")];
const AXES: [[usize; 2]; 3] = [[0, 1], [2, 0], [1, 2]];

/// How a contour is programmed.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// What stands in the offset memory, mm.
    pub offset: f64,
    /// G42 instead of G41.
    pub right: bool,
    pub corners: Corners,
    /// G20 instead of G21.
    pub inch: bool,
    /// G91 instead of G90.
    pub incremental: bool,
    /// An index of `PLANES`.
    pub plane: usize,
    /// What each element's block says beside it.
    pub beside: Beside,
}

/// What stands with each element and changes nothing of its path in the plane.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Beside {
    Nothing,
    /// The third axis moves with every element.
    Third,
    /// Lines are positioning moves.
    Rapid,
    /// A block like this stands behind every element.
    Block(&'static str),
}

impl Job {
    /// The tool to the left of the path by `side` mm, to the right if it is negative; M96 or M97.
    pub fn new(side: f64, corners: Corners) -> Job {
        Job {
            offset: side.abs(),
            right: side < 0.0,
            corners,
            inch: false,
            incremental: false,
            plane: 0,
            beside: Beside::Nothing,
        }
    }

    /// How far the tool is to the left of the path, mm.
    pub fn side(&self) -> f64 {
        if self.right { -self.offset } else { self.offset }
    }

    fn length(&self, nm: i64) -> String {
        let (scale, decimals) = if self.inch { (2540, 4) } else { (1000, 3) };
        assert_eq!(nm % scale, 0, "{nm} nm cannot be written in these units");
        let (sign, count) = (if nm < 0 { "-" } else { "" }, (nm / scale).unsigned_abs());
        let one = 10u64.pow(decimals);
        format!("{sign}{}.{:0width$}", count / one, count % one, width = decimals as usize)
    }

    fn words(&self, letters: [&str; 2], place: Place) -> String {
        format!("{}{}{}{}", letters[0], self.length(place[0]), letters[1], self.length(place[1]))
    }

    /// A point twice as far beside a path as the tool runs: there, neither way on nor off touches what the path leaves
    /// free.
    fn beside(&self, at: Vector, tangent: Vector) -> Place {
        let unit = if self.inch { 127_000.0 } else { 1000.0 };
        add(at, times(left_of(tangent), 2.0 * self.side())).map(|mm| (mm * 1e6 / unit).round() as i64 * unit as i64)
    }
}

/// No word names a place farther off, nm.
const FARTHEST: i64 = 90_000_000_000;

/// The program of a contour: from beside its start onto it, along it, and off its end.
pub fn text(contour: &Contour, job: Job) -> String {
    text_with(contour, job, |_| "")
}

/// The same with these words in the elements' blocks.
pub fn text_with(contour: &Contour, job: Job, words: impl Fn(usize) -> &'static str) -> String {
    let (plane, letters, centers, third) = PLANES[job.plane];
    let forms = contour.forms();
    let (first, last) = (&forms[0], &forms[forms.len() - 1]);
    let start = job.beside(first.from(), first.tangents()[0]);
    let end = job.beside(last.to(), last.tangents()[1]);
    let way = |from: Place, to: Place| {
        job.words(letters, if job.incremental { [to[0] - from[0], to[1] - from[1]] } else { to })
    };
    let positions = if job.incremental { "G91" } else { "G90" };
    let units = if job.inch { "G20" } else { "G21" };
    let corners = match job.corners {
        Corners::Arcs => "M96",
        Corners::Intersections => "M97",
        Corners::Unsaid => "",
    };
    let on = if job.right { "G42" } else { "G41" };
    let mut text = format!("{positions}\n{plane}\n{units}\nG94\nG40\n{corners}\n");
    let mut at = [0, 0];
    while at != start {
        let next = [0, 1].map(|axis| at[axis] + (start[axis] - at[axis]).clamp(-FARTHEST, FARTHEST));
        let _ = writeln!(text, "G00{}", way(at, next));
        at = next;
    }
    let _ = writeln!(text, "{on}D01");
    let begin = contour.elements[0].from;
    let _ = writeln!(text, "G01{}F{}", way(start, begin), if job.inch { "5." } else { "127." });
    for (index, element) in contour.elements.iter().enumerate() {
        let mut end = way(element.from, element.to) + words(index);
        if job.beside == Beside::Third {
            let _ = write!(end, "{third}-{}.{}", index / 10, index % 10);
        }
        let _ = match element.round {
            None => writeln!(text, "{}{end}", if job.beside == Beside::Rapid { "G00" } else { "G01" }),
            Some(round) => {
                let spoke = [0, 1].map(|axis| round.center[axis] - element.from[axis]);
                writeln!(text, "G0{}{end}{}", if round.ccw { 3 } else { 2 }, job.words(centers, spoke))
            }
        };
        if let Beside::Block(block) = job.beside {
            let _ = writeln!(text, "{block}");
        }
    }
    let off = way(contour.elements[contour.elements.len() - 1].to, end);
    let _ = writeln!(text, "G40\nG01{off}\nM30");
    text
}

/// What the control calls interference.
const INTERFERENCE: [Condition; 5] = [
    Condition::InnerArcTooSmall,
    Condition::CompensatedPathReversed,
    Condition::CompensatedCircleOpen,
    Condition::CompensatedPathsApart,
    Condition::ElementCut,
];

/// A piece of the centre path.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Piece {
    /// The index of the element whose block it belongs to; before the first: the start-up, after the last: the cancel.
    pub element: i64,
    pub form: Form,
}

/// What a program did.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Run {
    pub pieces: Vec<Piece>,
    /// The alarm that ended it, and the element in whose block.
    pub alarm: Option<(Condition, i64)>,
}

impl Run {
    /// The pieces of one element's block.
    pub fn of(&self, element: usize) -> impl Iterator<Item = &Form> {
        self.between(element, element + 1)
    }

    /// The pieces of these elements' blocks.
    pub fn between(&self, first: usize, end: usize) -> impl Iterator<Item = &Form> {
        let wanted = first as i64..end as i64;
        self.pieces.iter().filter(move |piece| wanted.contains(&piece.element)).map(|piece| &piece.form)
    }

    /// The pieces of a contour's elements, without the way on and off.
    pub fn contour(&self, contour: &Contour) -> &[Piece] {
        let elements = 0..contour.elements.len() as i64;
        let first = self.pieces.iter().take_while(|piece| piece.element < elements.start).count();
        let end = self.pieces.iter().take_while(|piece| piece.element < elements.end).count();
        &self.pieces[first..end]
    }

    /// Where the tool is when an element's block begins.
    pub fn end_before(&self, element: usize) -> Vector {
        let before = self.pieces.iter().take_while(|piece| piece.element < element as i64);
        before.last().map_or([0.0; 2], |piece| piece.form.to())
    }

    /// How many elements have run, the first ones.
    pub fn ran(&self, elements: usize) -> usize {
        if self.alarm.is_none() {
            return elements;
        }
        self.pieces.last().map_or(0, |piece| (piece.element + 1).clamp(0, elements as i64) as usize)
    }

    pub fn is_interference(&self) -> bool {
        self.alarm.is_some_and(|(condition, _)| INTERFERENCE.contains(&condition))
    }
}

fn control() -> Arc<Control> {
    static CONTROL: LazyLock<Arc<Control>> = LazyLock::new(|| load("yasnac-mx1"));
    CONTROL.clone()
}

/// A control on an endless machine, ready to run many programs with one offset after the other.
pub struct Bench {
    configuration: Configuration,
    column: OffsetColumn,
}

impl Bench {
    /// As it comes.
    pub fn new() -> Bench {
        Bench::with(control(), Setup::default())
    }

    /// A path that cuts into an element near its own is refused.
    pub fn strict() -> Bench {
        let policies = vec![("compensation-cut".to_owned(), "refuse".to_owned())];
        Bench::with(control(), Setup { policies, ..Setup::default() })
    }

    /// The other control, as it comes: it knows no M96.
    pub fn other() -> Bench {
        Bench::with(load("incon-m84"), Setup::default())
    }

    fn with(control: Arc<Control>, setup: Setup) -> Bench {
        let column = if control.common_offsets { OffsetColumn::Common } else { OffsetColumn::Radius };
        let configuration = Configuration::new(control, machine("unlimited", None), &[&setup]);
        Bench { configuration: configuration.expect("the set-up fits"), column }
    }

    /// One whose M95 mirrors the first axis.
    pub fn mirroring() -> Bench {
        let setting = ParameterSetting { name: "6000".to_owned(), bit: None, value: "00000001".to_owned() };
        let parameters = vec![setting];
        Bench::with(control(), Setup { parameters, ..Setup::default() })
    }

    /// What stands in number 2 of the offset memory, mm.
    pub fn set_second_offset(&mut self, offset: f64) {
        self.configuration.set_offset(self.column, 2, offset).expect("the offset is allowed");
    }

    /// Runs a text with this offset in number 1.
    pub fn run_text(&mut self, text: &str, job: Job, elements: i64) -> Run {
        self.configuration.set_offset(self.column, 1, job.offset).expect("the offset is allowed");
        let mut session = Session::new(self.configuration.clone(), Texts::one(text));
        select(&mut session, 0);
        session.start();
        let [u, v] = AXES[job.plane];
        let lines = if matches!(job.beside, Beside::Block(_)) { 2 } else { 1 };
        // The block that leads onto the contour is the first one with a feed.
        let onto = text.lines().position(|line| line.contains('F')).map_or(0, |line| line as i64 + 1);
        let mut run = Run::default();
        while let Step::Event(event) = session.next() {
            let behind = event.place.line as i64 - onto - 1;
            let element = if behind < 0 { behind } else { (behind / lines).min(elements) };
            let form = match &event.kind {
                EventKind::Rapid { from, to, .. } | EventKind::Feed { from, to, .. } => {
                    Form::line([from[u], from[v]], [to[u], to[v]])
                }
                EventKind::Arc { arc, .. } => Form::Arc(Bow {
                    from: [arc.from[u], arc.from[v]],
                    to: [arc.to[u], arc.to[v]],
                    center: arc.center,
                    radius: arc.radius,
                    start: arc.start_angle,
                    sweep: arc.sweep,
                }),
                EventKind::Alarm(alarm) => {
                    run.alarm = Some((alarm.condition, element));
                    break;
                }
                _ => continue,
            };
            // The third axis alone: in the plane nothing but the last digit moves.
            if matches!(form, Form::Line(from, to) if apart(from, to) < 1e-12) {
                continue;
            }
            if let Some(last) = run.pieces.last() {
                assert!(apart(last.form.to(), form.from()) < 1e-12, "a gap before {form:?} in\n{text}");
            }
            run.pieces.push(Piece { element, form });
        }
        run
    }

    pub fn run(&mut self, contour: &Contour, job: Job) -> Run {
        self.run_text(&text(contour, job), job, contour.elements.len() as i64)
    }
}

/// Where an element ends, mm.
pub fn end(contour: &Contour, element: usize) -> Vector {
    mm(contour.elements[element].to)
}
