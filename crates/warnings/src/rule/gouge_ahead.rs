//! `gouge-ahead`: the tool beside one element of a contour cuts another one.
//!
//! What: under G41 or G42 a move comes nearer than the tool's radius to an element that is to be kept, one that the
//! control does not see when it makes the move, or one that it has left behind: a slot narrower than the tool, a way to
//! the contour that leads through it, a straight way behind blocks without one.
//! Why: the control compares an element with its neighbours only; it raises no alarm and the part is scrap.
//! Do: take a smaller tool, or give the move another way.
//!
//! Judged are all moves beside the path, round its corners, to it and away from it, rapid ones too, against a window of
//! elements before and behind (`--look-ahead`), on one level and in one stretch of compensation, while no alarm has been
//! raised in it. A rapid is taken for straight. Silent up to [`LEAST_MM`]; where the ways to and from a contour cross,
//! for what lies before the crossing and behind it, which is no contour; for the first element's beginning and the last
//! one's end beside the moves to and from them. Of cuts one beside the other the deepest is said.

mod chain;
mod window;

use base::Place;
use meaning::Interpreter;
use path::Part;
use path::plane::{Vector, distance};

use crate::finding::{At, Finding, Found};
use crate::look::number;
use crate::rules::Rule;
use crate::way::{Turns, Way};
use window::Window;

/// Elements that are compared with each other if nothing is said about it.
pub(crate) const LOOK_AHEAD: u32 = 64;
/// A cut of no more than this, mm, is no gouge: places rounded to the least increment make as much.
pub(crate) const LEAST_MM: f64 = 0.002;
/// Moves, or elements, no farther from each other than this belong to one gouge.
const ADJACENT: u64 = 6;
/// Gouges that can be open at once.
const MOST_OPEN: usize = 16;

/// A move that cuts an element.
#[derive(Clone, Copy)]
struct Hit {
    depth: f64,
    radius: f64,
    /// Where, in the plane.
    at: Vector,
    /// The move and the element, counted.
    pair: [u64; 2],
    cutter: (Place, u64, Option<Part>),
    element: Place,
    /// The control had not seen the element that begins there.
    blind: bool,
}

/// Hits beside each other: the deepest and the latest, and the moves and elements so far.
struct Gouge {
    deepest: Hit,
    latest: Vector,
    reach: [[u64; 2]; 2],
}

/// What is remembered of the contour.
pub(crate) struct GougeAhead {
    window: Window,
    open: Vec<Gouge>,
    letters: [char; 2],
    left: bool,
}

impl GougeAhead {
    /// With so many elements looked ahead, none for no look at all.
    pub fn new(look_ahead: u32) -> GougeAhead {
        GougeAhead { window: Window::new(look_ahead), open: Vec::new(), letters: ['?'; 2], left: false }
    }

    /// Where the next move is to be written.
    #[inline]
    pub fn slot(&mut self) -> (&mut Way, &mut Turns) {
        self.window.slot()
    }

    /// Takes the move that was written.
    pub fn step(&mut self, interpreter: &Interpreter, found: &mut Found) {
        if !self.window.is_on() {
            return;
        }
        let (way, _) = self.window.slot();
        let (level, beside, axes) = (way.level, way.beside, way.axes);
        let starts = way.part == Some(Part::Start);
        let changes_side = way.part.is_some() && way.left != self.left;
        if changes_side && level {
            self.left = way.left;
        }
        if starts || changes_side || !level {
            self.end(found);
        }
        if !level {
            return;
        }
        if self.window.moves() == 0 {
            let letter = |axis: u8| interpreter.facts().axes.get(usize::from(axis)).map(|axis| axis.letter);
            self.letters = axes.map(|axis| letter(axis).map_or('?', char::from));
        }
        if changes_side && !starts && !beside {
            // From one side to the other the tool crosses the contour on purpose.
            let (way, _) = self.window.slot();
            (way.has_element, way.part) = (false, Some(Part::Start));
        }
        let is_closed = self.window.push();
        if is_closed {
            let window = &self.window;
            self.open.retain(|gouge| window.counts(&gouge.deepest));
        }
        if self.window.has_to_compare() {
            let (open, letters) = (&mut self.open, self.letters);
            self.window.hits(|hit| note(open, hit, letters, found));
        }
        // What lies so far behind grows no more.
        if let Some(gouge) = self.open.first()
            && gouge.end() + self.window.room() < self.window.moves()
        {
            tell(&self.open.remove(0).deepest, self.letters, found);
        }
    }

    /// What follows lies on another level or in another stretch.
    pub fn end(&mut self, found: &mut Found) {
        self.window.clear();
        for gouge in self.open.drain(..) {
            tell(&gouge.deepest, self.letters, found);
        }
    }
}

impl Gouge {
    /// The last move or element that belongs to it.
    fn end(&self) -> u64 {
        self.reach[0][1].max(self.reach[1][1])
    }

    /// True if the hit lies beside those that belong to it; which of the two cuts does not matter.
    fn holds(&self, hit: &Hit) -> bool {
        let is_close = distance(hit.at, self.latest) <= 2.0 * hit.radius;
        let far = if is_close { ADJACENT } else { 1 };
        let near = |reach: [u64; 2], number: u64| number + far >= reach[0] && number <= reach[1] + far;
        let ([a, b], [cutter, element]) = (self.reach, hit.pair);
        near(a, cutter) && near(b, element) || near(a, element) && near(b, cutter)
    }

    fn take(&mut self, hit: Hit) {
        let [a, b] = hit.pair;
        let pair = if a.abs_diff(self.reach[0][1]) <= b.abs_diff(self.reach[0][1]) { [a, b] } else { [b, a] };
        for (reach, number) in self.reach.iter_mut().zip(pair) {
            *reach = [reach[0].min(number), reach[1].max(number)];
        }
        self.latest = hit.at;
        if hit.depth > self.deepest.depth {
            self.deepest = hit;
        }
    }
}

/// Adds a hit to the gouge beside which it lies.
fn note(open: &mut Vec<Gouge>, hit: Hit, letters: [char; 2], found: &mut Found) {
    if let Some(gouge) = open.iter_mut().find(|gouge| gouge.holds(&hit)) {
        return gouge.take(hit);
    }
    if open.len() >= MOST_OPEN {
        tell(&open.remove(0).deepest, letters, found);
    }
    open.push(Gouge { deepest: hit, latest: hit.at, reach: hit.pair.map(|number| [number; 2]) });
}

fn tell(hit: &Hit, letters: [char; 2], found: &mut Found) {
    let (place, block, part) = hit.cutter;
    let shade = match part {
        None => "end",
        _ if hit.blind => "blind",
        Some(Part::Start) => "start",
        _ => "",
    };
    found.say(Rule::GougeAhead, &place, || {
        let at = format!("{}{} {}{}", letters[0], number(hit.at[0]), letters[1], number(hit.at[1]));
        let depth = number(hit.depth);
        let finding =
            Finding::at(Rule::GougeAhead, shade, block, place, At::Block).labelled(format!("cuts {depth} mm too deep"));
        let finding = finding.with("depth", depth).with("at", at).with("line", hit.element.line.to_string());
        if hit.element.block == place.block && hit.element.source == place.source {
            return finding;
        }
        finding.beside(hit.element, "into this element")
    });
}
