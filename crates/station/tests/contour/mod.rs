//! Contours of lines and arcs on whole nanometres, and what can be done to them without rounding.

#![allow(dead_code)] // each test takes what it needs of it

pub mod claims;
pub mod double;
pub mod generate;
pub mod measure;
pub mod program;
pub mod samples;

use measure::{Form, Vector};

/// A point of the plane, nm.
pub type Place = [i64; 2];

/// What makes an element an arc.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Round {
    /// Its centre, nm.
    pub center: Place,
    /// Counter-clockwise.
    pub ccw: bool,
}

/// A line or an arc, as a block programs it. An arc that ends where it begins is a full circle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Element {
    /// Where it begins, nm.
    pub from: Place,
    /// Where it ends, nm.
    pub to: Place,
    /// The arc, if it is one.
    pub round: Option<Round>,
}

fn squared(from: Place, to: Place) -> i128 {
    let [x, y] = [i128::from(to[0] - from[0]), i128::from(to[1] - from[1])];
    x * x + y * y
}

pub fn mm(place: Place) -> Vector {
    place.map(|nm| nm as f64 / 1e6)
}

impl Element {
    pub fn line(from: Place, to: Place) -> Element {
        Element { from, to, round: None }
    }

    pub fn arc(from: Place, to: Place, center: Place, ccw: bool) -> Element {
        Element { from, to, round: Some(Round { center, ccw }) }
    }

    /// It has a length, and an arc both ends at one radius, to the nanometre squared.
    pub fn is_exact(&self) -> bool {
        match self.round {
            None => self.from != self.to,
            Some(round) => {
                let radius = squared(round.center, self.from);
                radius > 0 && radius == squared(round.center, self.to)
            }
        }
    }

    /// How much the radii at both ends differ, mm.
    pub fn growth(&self) -> f64 {
        self.round.map_or(0.0, |round| {
            let [from, to] = [self.from, self.to].map(|end| (squared(round.center, end) as f64).sqrt() / 1e6);
            (to - from).abs()
        })
    }

    fn mapped(&self, map: impl Fn(Place) -> Place, over: bool) -> Element {
        let round = self.round.map(|round| Round { center: map(round.center), ccw: round.ccw != over });
        Element { from: map(self.from), to: map(self.to), round }
    }

    pub fn backwards(&self) -> Element {
        let round = self.round.map(|round| Round { ccw: !round.ccw, ..round });
        Element { from: self.to, to: self.from, round }
    }

    /// Its two parts, if it can be split on whole micrometres without a change of its shape.
    fn halves(&self) -> Option<[Element; 2]> {
        let at = match self.round {
            None => {
                let middle = [0, 1].map(|axis| self.from[axis] + (self.to[axis] - self.from[axis]) / 2);
                let on_line = squared(self.from, middle) == squared(middle, self.to)
                    && (0..2).all(|axis| middle[axis] % 1000 == 0 && (self.to[axis] - self.from[axis]) % 2 == 0);
                on_line.then_some(middle)?
            }
            // A circle through a point of a grid goes through its seven images too.
            Some(Round { center, .. }) => {
                let [u, v] = [self.from[0] - center[0], self.from[1] - center[1]];
                let images = [[-u, v], [u, -v], [-u, -v], [v, u], [-v, u], [v, -u], [-v, -u]];
                let form = self.form();
                let inside = |image: &[i64; 2]| {
                    let share = form.foot(mm([center[0] + image[0], center[1] + image[1]])).0;
                    share > 0.05 && share < 0.95
                };
                let image = images.into_iter().find(inside)?;
                [center[0] + image[0], center[1] + image[1]]
            }
        };
        Some([Element { to: at, ..*self }, Element { from: at, ..*self }])
    }

    /// Its shape in mm.
    pub fn form(&self) -> Form {
        match self.round {
            None => Form::line(mm(self.from), mm(self.to)),
            Some(Round { center, ccw }) => Form::arc(mm(self.from), mm(self.to), mm(center), ccw),
        }
    }
}

/// Elements one after the other.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Contour {
    pub elements: Vec<Element>,
}

impl Contour {
    pub fn is_whole(&self) -> bool {
        self.elements.windows(2).all(|pair| pair[0].to == pair[1].from) && !self.elements.is_empty()
    }

    pub fn is_exact(&self) -> bool {
        self.elements.iter().all(Element::is_exact)
    }

    /// How much the radii of its worst arc differ, mm.
    pub fn growth(&self) -> f64 {
        self.elements.iter().map(Element::growth).fold(0.0, f64::max)
    }

    fn mapped(&self, map: impl Fn(Place) -> Place + Copy, over: bool) -> Contour {
        Contour { elements: self.elements.iter().map(|element| element.mapped(map, over)).collect() }
    }

    /// Turned over about the second axis.
    pub fn mirrored(&self) -> Contour {
        self.mapped(|[x, y]| [-x, y], true)
    }

    /// Turned by this many quarters about the origin.
    pub fn turned(&self, quarters: usize) -> Contour {
        let turn = |[x, y]: Place| [[x, y], [-y, x], [-x, -y], [y, -x]][quarters % 4];
        self.mapped(turn, false)
    }

    pub fn backwards(&self) -> Contour {
        Contour { elements: self.elements.iter().rev().map(Element::backwards).collect() }
    }

    /// Every element that can be is split in two; how many were.
    pub fn split(&self) -> (Contour, usize) {
        let mut elements = Vec::new();
        for element in &self.elements {
            match element.halves() {
                Some(halves) => elements.extend(halves),
                None => elements.push(*element),
            }
        }
        let more = elements.len() - self.elements.len();
        (Contour { elements }, more)
    }

    /// A closed contour gone round once and on to the end of its second element, so that every corner is met on the way.
    pub fn gone_round(&self) -> Contour {
        let again = self.elements.iter().chain(self.elements.iter().take(2));
        Contour { elements: again.copied().collect() }
    }

    pub fn part(&self, range: std::ops::Range<usize>) -> Contour {
        Contour { elements: self.elements[range].to_vec() }
    }

    pub fn forms(&self) -> Vec<Form> {
        self.elements.iter().map(Element::form).collect()
    }
}
