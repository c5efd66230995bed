//! What is drawn: one straight or circular move of the tool.

/// How the tool moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Kind {
    /// Positioning at the machine's own speed.
    Rapid,
    /// Cutting at a programmed feed.
    Feed,
}

/// The plane in which an arc turns, named by its first and second axis.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Plane {
    /// First axis X, second Y, third Z.
    Xy,
    /// First axis Z, second X, third Y.
    Zx,
    /// First axis Y, second Z, third X.
    Yz,
}

impl Plane {
    /// The indices of the first, second and third axis of the plane in a point.
    pub const fn axes(self) -> [usize; 3] {
        match self {
            Plane::Xy => [0, 1, 2],
            Plane::Zx => [2, 0, 1],
            Plane::Yz => [1, 2, 0],
        }
    }
}

/// An arc from the stroke's start to its end. The third axis moves linearly with the angle (a helix); if start and end
/// stand at different distances from the centre, the radius changes linearly with the angle too (a spiral).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    /// The plane of the arc.
    pub plane: Plane,
    /// The centre in mm, in the plane's axis order.
    pub center: [f64; 2],
    /// The angle turned in degrees, positive counter-clockwise seen from the positive end of the third axis;
    /// 360 is a full circle, more is more than one turn.
    pub sweep_deg: f64,
}

/// One move of the tool, in machine coordinates.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stroke {
    /// Rapid or feed.
    pub kind: Kind,
    /// Where the move starts: X, Y, Z in mm.
    pub from: [f64; 3],
    /// Where the move ends: X, Y, Z in mm.
    pub to: [f64; 3],
    /// The arc, or `None` for a straight line.
    pub arc: Option<Arc>,
    /// The feed in mm/min; not used for a rapid.
    pub feed: f64,
    /// The tool number; 0 is no tool.
    pub tool: u32,
}

/// The greatest coordinate that is drawn, in mm: one thousand kilometres. What is beyond is treated as not a number.
const FARTHEST_MM: f64 = 1e9;

/// True if every coordinate is a number of a size that can be drawn.
pub(crate) fn is_drawable(coordinates: &[f64]) -> bool {
    coordinates.iter().all(|value| value.abs() <= FARTHEST_MM)
}

impl Stroke {
    /// True if every coordinate of the stroke can be drawn.
    pub(crate) fn is_drawable(&self) -> bool {
        is_drawable(&self.from)
            && is_drawable(&self.to)
            && self.arc.is_none_or(|arc| is_drawable(&arc.center) && is_drawable(&[arc.sweep_deg]))
    }
}
