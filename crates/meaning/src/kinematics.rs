//! How the axes that turn tool or work move the tip of the tool, and back.
//!
//! An *upright* place is where X, Y, Z would stand for a tip if nothing were turned: the tip, and the tool's length above
//! it. The tool's direction, from the tip towards the holder, is that of Z, tilted about X (axis A) or Y (axis B) and then
//! turned about Z (axis C). On a table the axes turn the work the other way, so that one and the same number means one
//! and the same direction. Lengths in mm, angles in degrees, places of the machine.

use base::Point;

use crate::cycle::pattern::sin_cos_deg;

/// Where the two axes sit.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Carrier {
    /// Both in the head, the turning axis carries the tilting one.
    Head,
    /// Both in the table, the tilting axis carries the turning one.
    Table,
    /// The head tilts, the table turns.
    HeadAndTable,
}

/// The axes that give the tool its direction, as the machine builder's file has them.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Kinematics {
    /// Where they sit.
    pub carrier: Carrier,
    /// Indices of X, Y, Z.
    pub linear: [u8; 3],
    /// Index of the axis that tilts.
    pub tilt: u8,
    /// It tilts about Y (B); about X (A) otherwise.
    pub about_y: bool,
    /// Index of the axis that turns about Z.
    pub turn: u8,
    /// From the point about which the head tilts to the face of the spindle.
    pub pivot: f64,
    /// A point on the axes of the table.
    pub centre: [f64; 3],
}

type Vector = [f64; 3];

fn plus(a: Vector, b: Vector, times: f64) -> Vector {
    [a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]]
}

/// Turned about Z.
fn about_z([x, y, z]: Vector, degrees: f64) -> Vector {
    let (sin, cos) = sin_cos_deg(degrees);
    [x * cos - y * sin, x * sin + y * cos, z]
}

fn size([x, y, z]: Vector) -> f64 {
    libm::hypot(libm::hypot(x, y), z)
}

impl Kinematics {
    /// Tilted.
    fn tilted(&self, [x, y, z]: Vector, degrees: f64) -> Vector {
        let (sin, cos) = sin_cos_deg(degrees);
        match self.about_y {
            true => [x * cos + z * sin, y, z * cos - x * sin],
            false => [x, y * cos - z * sin, y * sin + z * cos],
        }
    }

    /// The angles of the two axes at a point.
    pub fn angles(&self, point: &Point) -> [f64; 2] {
        [point[usize::from(self.tilt)], point[usize::from(self.turn)]]
    }

    /// True if X, Y and Z stand where they would if nothing were turned, whatever the place.
    pub fn is_upright(&self, point: &Point) -> bool {
        let [tilt, turn] = self.angles(point);
        tilt % 360.0 == 0.0 && (self.carrier == Carrier::Head || turn % 360.0 == 0.0)
    }

    fn take(&self, point: &Point) -> Vector {
        self.linear.map(|axis| point[usize::from(axis)])
    }

    fn put(&self, point: &Point, vector: Vector) -> Point {
        let mut point = *point;
        for (axis, value) in self.linear.iter().zip(vector) {
            point[usize::from(*axis)] = value;
        }
        point
    }

    /// From the upright place with these angles to the machine's. `length` is that of the tool.
    pub fn placed(&self, upright: &Point, length: f64) -> Point {
        let [tilt, turn] = self.angles(upright);
        let tip = plus(self.take(upright), [0.0, 0.0, length], -1.0);
        let reach = length + self.pivot;
        let about = |vector: Vector| plus(vector, self.centre, -1.0);
        let place = match self.carrier {
            Carrier::Head => {
                let direction = about_z(self.tilted([0.0, 0.0, 1.0], tilt), turn);
                plus(plus(tip, direction, reach), [0.0, 0.0, self.pivot], -1.0)
            }
            Carrier::Table => {
                let turned = self.tilted(about_z(about(tip), -turn), -tilt);
                plus(plus(turned, self.centre, 1.0), [0.0, 0.0, length], 1.0)
            }
            Carrier::HeadAndTable => {
                let turned = plus(about_z(about(tip), -turn), self.centre, 1.0);
                let direction = self.tilted([0.0, 0.0, 1.0], tilt);
                plus(plus(turned, direction, reach), [0.0, 0.0, self.pivot], -1.0)
            }
        };
        self.put(upright, place)
    }

    /// The upright place of where the machine stands.
    pub fn upright(&self, machine: &Point, length: f64) -> Point {
        let [tilt, turn] = self.angles(machine);
        let place = self.take(machine);
        let reach = length + self.pivot;
        let about = |vector: Vector| plus(vector, self.centre, -1.0);
        let tip = match self.carrier {
            Carrier::Head => {
                let direction = about_z(self.tilted([0.0, 0.0, 1.0], tilt), turn);
                plus(plus(place, [0.0, 0.0, self.pivot], 1.0), direction, -reach)
            }
            Carrier::Table => {
                let turned = about(plus(place, [0.0, 0.0, length], -1.0));
                plus(about_z(self.tilted(turned, tilt), turn), self.centre, 1.0)
            }
            Carrier::HeadAndTable => {
                let direction = self.tilted([0.0, 0.0, 1.0], tilt);
                let turned = plus(plus(place, [0.0, 0.0, self.pivot], 1.0), direction, -reach);
                plus(about_z(about(turned), turn), self.centre, 1.0)
            }
        };
        self.put(machine, plus(tip, [0.0, 0.0, length], 1.0))
    }

    /// By how much the tip leaves its straight way at most while the axes run straight from one place to the other, both
    /// upright with their angles. In so many equal parts it is less by the square of their number.
    ///
    /// A way that turns by ω and whose lever is ρ bends by at most ρ·ω²/8; a lever that grows by Δ meanwhile adds Δ·ω/4.
    pub fn bend(&self, from: &Point, to: &Point, lengths: [f64; 2]) -> f64 {
        let [tilt, turn] = [0, 1].map(|axis| (self.angles(to)[axis] - self.angles(from)[axis]).abs().to_radians());
        let [length, grown] = [lengths[0].abs().max(lengths[1].abs()), (lengths[1] - lengths[0]).abs()];
        let tips = [(from, lengths[0]), (to, lengths[1])]
            .map(|(point, length)| plus(self.take(point), [0.0, 0.0, length], -1.0));
        let lever = tips.map(|tip| size(plus(tip, self.centre, -1.0)));
        let (lever, way) = (lever[0].max(lever[1]), size(plus(tips[1], tips[0], -1.0)));
        let of = |lever: f64, grown: f64, angle: f64| lever * angle * angle / 8.0 + grown * angle / 4.0;
        let reach = length + self.pivot.abs();
        match self.carrier {
            Carrier::Head => of(reach, grown, tilt + turn),
            Carrier::Table => of(lever, way, tilt + turn),
            Carrier::HeadAndTable => of(reach, grown, tilt) + of(lever, way, turn),
        }
    }

    /// The tilt of the tool, and the turn nearest to `near`, for a direction; `None` for the turn if the tool is upright.
    /// Of the two pairs of angles that a direction has, that with the shorter way from `near` is taken.
    pub fn towards(&self, [i, j, k]: Vector, near: [f64; 2]) -> (f64, Option<f64>) {
        let aside = libm::hypot(i, j);
        if aside <= UPRIGHT * k.abs() {
            let tilt = if k < 0.0 { 180.0 } else { 0.0 };
            return (round_to(tilt, near[0]), None);
        }
        let tilt = libm::atan2(aside, k).to_degrees();
        let turn = if self.about_y { libm::atan2(j, i) } else { libm::atan2(i, -j) }.to_degrees();
        let ways = [(tilt, turn), (-tilt, turn + 180.0)].map(|(tilt, turn)| (tilt, round_to(turn, near[1])));
        let far = |(tilt, turn): (f64, f64)| (tilt - near[0]).abs() + (turn - near[1]).abs();
        let (tilt, turn) = if far(ways[1]) < far(ways[0]) { ways[1] } else { ways[0] };
        (tilt, Some(turn))
    }

    /// By how much the other pair of letters counts C further: a tilt about X looks along -Y where one about Y looks
    /// along X.
    pub const fn other_turn(&self) -> f64 {
        if self.about_y { 90.0 } else { -90.0 }
    }
}

/// A direction nearer to the axis than this, as a part of its length, is along it.
const UPRIGHT: f64 = 1e-9;

/// The angle with whole turns added that lies nearest to another.
fn round_to(degrees: f64, near: f64) -> f64 {
    degrees + ((near - degrees) / 360.0).round() * 360.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn machine(carrier: Carrier, about_y: bool) -> Kinematics {
        Kinematics {
            carrier,
            linear: [0, 1, 2],
            tilt: 3,
            about_y,
            turn: 4,
            pivot: 150.0,
            centre: [100.0, -50.0, -400.0],
        }
    }

    const ALL: [(Carrier, bool); 6] = [
        (Carrier::Head, true),
        (Carrier::Head, false),
        (Carrier::Table, true),
        (Carrier::Table, false),
        (Carrier::HeadAndTable, true),
        (Carrier::HeadAndTable, false),
    ];

    fn near(a: &Point, b: &Point, by: f64) -> bool {
        a.iter().zip(b).all(|(a, b)| (a - b).abs() <= by)
    }

    #[test]
    fn what_is_placed_is_found_again_and_upright_nothing_is_displaced() {
        for (carrier, about_y) in ALL {
            let machine = machine(carrier, about_y);
            let upright = [10.0, 20.0, 130.0, 30.0, -75.0, 0.0, 0.0, 0.0];
            let placed = machine.placed(&upright, 80.0);
            assert!(near(&machine.upright(&placed, 80.0), &upright, 1e-9), "{carrier:?}");
            let level = [10.0, 20.0, 130.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            assert_eq!(machine.placed(&level, 80.0), level, "{carrier:?}");
        }
    }

    #[test]
    fn three_ways_give_one_direction() {
        let by_b = machine(Carrier::Head, true);
        let by_a = machine(Carrier::Head, false);
        let direction = [0.25 * 2f64.sqrt(), 0.25 * 2f64.sqrt(), 0.75f64.sqrt()];
        let (tilt, turn) = by_b.towards(direction, [0.0; 2]);
        assert!((tilt - 30.0).abs() < 1e-9 && (turn.expect("tilted") - 45.0).abs() < 1e-9);
        let (tilt, turn) = by_a.towards(direction, [0.0, 100.0]);
        assert!((tilt - 30.0).abs() < 1e-9 && (turn.expect("tilted") - 135.0).abs() < 1e-9);
        assert_eq!(45.0 + by_b.other_turn(), 135.0);
        // The same head, told by either pair, holds the spindle in the same place.
        let at = |machine: &Kinematics, tilt, turn| machine.placed(&[0.0, 0.0, 0.0, tilt, turn, 0.0, 0.0, 0.0], 100.0);
        let (b, a) = (at(&by_b, 30.0, 45.0), at(&by_a, 30.0, 135.0));
        assert!((0..3).all(|axis| (b[axis] - a[axis]).abs() < 1e-9));
    }

    #[test]
    fn the_nearer_of_two_pairs_is_taken_and_upright_leaves_the_turn_open() {
        let head = machine(Carrier::Head, true);
        let (tilt, turn) = head.towards([-1.0, 0.0, 1.0], [40.0, 5.0]);
        assert_eq!((tilt.round(), turn.map(f64::round)), (-45.0, Some(0.0)));
        let (tilt, turn) = head.towards([-1.0, 0.0, 1.0], [40.0, 170.0]);
        assert_eq!((tilt.round(), turn.map(f64::round)), (45.0, Some(180.0)));
        assert_eq!(head.towards([0.0, 0.0, 2.0], [40.0, 170.0]), (0.0, None));
    }

    #[test]
    fn the_tip_bends_no_further_than_is_said() {
        for (carrier, about_y) in ALL {
            let machine = machine(carrier, about_y);
            let from = [0.0, 0.0, 100.0, -10.0, 20.0, 0.0, 0.0, 0.0];
            let to = [80.0, -30.0, 140.0, 35.0, 95.0, 0.0, 0.0, 0.0];
            let said = machine.bend(&from, &to, [100.0, 120.0]);
            let ends = [machine.placed(&from, 100.0), machine.placed(&to, 120.0)];
            let mut most = 0.0f64;
            for part in 0..=100 {
                let part = f64::from(part) / 100.0;
                let between = |a: &Point, b: &Point| -> Point { std::array::from_fn(|i| a[i] + (b[i] - a[i]) * part) };
                let length = 100.0 + 20.0 * part;
                let wanted = machine.placed(&between(&from, &to), length);
                let run = between(&ends[0], &ends[1]);
                most = most.max(size(plus(machine.take(&wanted), machine.take(&run), -1.0)));
            }
            assert!(most <= said && most > said / 20.0, "{carrier:?}: {most} of {said}");
        }
    }
}
