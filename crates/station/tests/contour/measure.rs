//! Plane geometry of the tests' own: shapes, distances, and the points at which a distance can be least.

use std::f64::consts::TAU;

/// mm.
pub type Vector = [f64; 2];

pub fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1]]
}

pub fn minus(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1]]
}

pub fn times(a: Vector, by: f64) -> Vector {
    [a[0] * by, a[1] * by]
}

pub fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub fn length(a: Vector) -> f64 {
    a[0].hypot(a[1])
}

pub fn apart(a: Vector, b: Vector) -> f64 {
    length(minus(a, b))
}

/// A quarter turn to the left.
pub fn left_of(a: Vector) -> Vector {
    [-a[1], a[0]]
}

pub fn toward(angle: f64) -> Vector {
    [angle.cos(), angle.sin()]
}

/// An arc, or a spiral whose radius changes steadily.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bow {
    pub from: Vector,
    pub to: Vector,
    pub center: Vector,
    pub radius: [f64; 2],
    pub start: f64,
    /// + counter-clockwise.
    pub sweep: f64,
}

/// A line or an arc.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Form {
    Line(Vector, Vector),
    Arc(Bow),
}

impl Form {
    pub fn line(from: Vector, to: Vector) -> Form {
        Form::Line(from, to)
    }

    pub fn arc(from: Vector, to: Vector, center: Vector, ccw: bool) -> Form {
        let [a, b] = [minus(from, center), minus(to, center)];
        let turn = cross(a, b).atan2(dot(a, b));
        let sweep = match ccw {
            _ if from == to => TAU.copysign(if ccw { 1.0 } else { -1.0 }),
            true if turn <= 0.0 => turn + TAU,
            false if turn >= 0.0 => turn - TAU,
            _ => turn,
        };
        Form::Arc(Bow { from, to, center, radius: [length(a), length(b)], start: a[1].atan2(a[0]), sweep })
    }

    pub fn from(&self) -> Vector {
        match self {
            Form::Line(from, _) => *from,
            Form::Arc(bow) => bow.from,
        }
    }

    pub fn to(&self) -> Vector {
        match self {
            Form::Line(_, to) => *to,
            Form::Arc(bow) => bow.to,
        }
    }

    pub fn length(&self) -> f64 {
        match self {
            Form::Line(from, to) => apart(*from, *to),
            Form::Arc(bow) => (bow.radius[0] + bow.radius[1]) / 2.0 * bow.sweep.abs(),
        }
    }

    /// The point after this share of the way.
    pub fn at(&self, share: f64) -> Vector {
        match self {
            Form::Line(from, to) => add(*from, times(minus(*to, *from), share)),
            Form::Arc(bow) => {
                let radius = bow.radius[0] + (bow.radius[1] - bow.radius[0]) * share;
                add(bow.center, times(toward(bow.start + bow.sweep * share), radius))
            }
        }
    }

    fn direction(&self, spoke: Vector) -> Vector {
        match self {
            Form::Line(from, to) => times(minus(*to, *from), 1.0 / apart(*from, *to)),
            Form::Arc(bow) => times(left_of(spoke), bow.sweep.signum() / length(spoke)),
        }
    }

    /// The unit tangents at both ends.
    pub fn tangents(&self) -> [Vector; 2] {
        let center = match self {
            Form::Line(..) => [0.0; 2],
            Form::Arc(bow) => bow.center,
        };
        [self.direction(minus(self.from(), center)), self.direction(minus(self.to(), center))]
    }

    /// The foot of a point on the endless line or circle: its share of the way (below 0 or above 1 beside the element),
    /// and how far the point lies to the left of it.
    pub fn foot(&self, point: Vector) -> (f64, f64) {
        match self {
            Form::Line(from, to) => {
                let (way, there) = (minus(*to, *from), minus(point, *from));
                (dot(way, there) / dot(way, way), cross(way, there) / length(way))
            }
            Form::Arc(bow) => {
                let spoke = minus(point, bow.center);
                let ahead = (spoke[1].atan2(spoke[0]) - bow.start) * bow.sweep.signum();
                let mut share = ahead.rem_euclid(TAU) / bow.sweep.abs();
                // Just before the start is nearer than nearly a turn after it.
                if share > 1.0 && (share - 1.0) > TAU / bow.sweep.abs() - share {
                    share -= TAU / bow.sweep.abs();
                }
                let radius = bow.radius[0] + (bow.radius[1] - bow.radius[0]) * share.clamp(0.0, 1.0);
                (share, (radius - length(spoke)) * bow.sweep.signum())
            }
        }
    }

    /// How far a point is from the nearest point of this.
    pub fn distance(&self, point: Vector) -> f64 {
        let ends = apart(point, self.from()).min(apart(point, self.to()));
        let (share, beside) = self.foot(point);
        if (0.0..=1.0).contains(&share) { beside.abs().min(ends) } else { ends }
    }

    /// Points of this at which its distance to another shape can be least: its ends, its feet of that shape's ends and
    /// centre, the points where it runs as that shape does, and `samples` others.
    pub fn nearest_to(&self, other: &Form, samples: usize) -> Vec<Vector> {
        let mut points = vec![self.from(), self.to()];
        points.extend((1..samples).map(|sample| self.at(sample as f64 / samples as f64)));
        let mut feet = vec![other.from(), other.to()];
        match (self, other) {
            (_, Form::Arc(bow)) => feet.push(bow.center),
            (Form::Arc(bow), Form::Line(from, to)) => {
                let across = left_of(minus(*to, *from));
                feet.extend([add(bow.center, across), minus(bow.center, across)]);
            }
            (Form::Line(..), Form::Line(..)) => {}
        }
        if let Form::Arc(bow) = self {
            let opposite = |foot: &Vector| minus(times(bow.center, 2.0), *foot);
            let opposites: Vec<_> = feet.iter().map(opposite).collect();
            feet.extend(opposites);
        }
        let shares = feet.into_iter().map(|foot| self.foot(foot).0).filter(|share| (0.0..=1.0).contains(share));
        points.extend(shares.map(|share| self.at(share)));
        points
    }
}

/// How far a point is from the nearest of these shapes.
pub fn distance_to_all<'a>(forms: impl IntoIterator<Item = &'a Form>, point: Vector) -> f64 {
    forms.into_iter().map(|form| form.distance(point)).fold(f64::INFINITY, f64::min)
}

/// The farthest that one path leaves the other.
pub fn leaves(path: &[Form], other: &[Form], samples: usize) -> f64 {
    let points = path.iter().flat_map(|form| (0..=samples).map(|sample| form.at(sample as f64 / samples as f64)));
    points.map(|point| distance_to_all(other, point)).fold(0.0, f64::max)
}
