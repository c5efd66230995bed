//! The smallest box around points, in mm.

/// A box parallel to the axes; empty until a point is included.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Extent {
    /// The lowest X, Y, Z in mm.
    pub min: [f64; 3],
    /// The highest X, Y, Z in mm.
    pub max: [f64; 3],
}

impl Extent {
    /// The box around nothing.
    pub const EMPTY: Extent = Extent { min: [f64::INFINITY; 3], max: [f64::NEG_INFINITY; 3] };

    /// True if no point was included.
    pub fn is_empty(&self) -> bool {
        self.min[0] > self.max[0]
    }

    /// Widens the box to hold a point.
    pub fn include(&mut self, point: [f64; 3]) {
        self.min = std::array::from_fn(|axis| self.min[axis].min(point[axis]));
        self.max = std::array::from_fn(|axis| self.max[axis].max(point[axis]));
    }

    /// Widens the box to hold another box.
    pub fn include_extent(&mut self, other: &Extent) {
        if !other.is_empty() {
            self.include(other.min);
            self.include(other.max);
        }
    }

    /// The length of the box along an axis in mm; 0 if it is empty.
    pub fn size(&self, axis: usize) -> f64 {
        (self.max[axis] - self.min[axis]).max(0.0)
    }

    /// The longest side in mm; 0 if the box is empty.
    pub fn span(&self) -> f64 {
        self.size(0).max(self.size(1)).max(self.size(2))
    }

    /// The box with every side moved outwards, in mm.
    pub fn grown(&self, by_mm: f64) -> Extent {
        Extent { min: self.min.map(|low| low - by_mm), max: self.max.map(|high| high + by_mm) }
    }

    /// True if the point is in the box or on its faces.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        (0..3).all(|axis| self.min[axis] <= point[axis] && point[axis] <= self.max[axis])
    }

    /// The eight corners.
    pub fn corners(&self) -> [[f64; 3]; 8] {
        let (low, high) = (self.min, self.max);
        std::array::from_fn(|corner| {
            std::array::from_fn(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_holds_what_was_included() {
        let mut extent = Extent::EMPTY;
        assert!(extent.is_empty());
        assert_eq!(extent.span(), 0.0);
        extent.include([1.0, 2.0, 3.0]);
        extent.include([-1.0, 7.0, 3.0]);
        assert_eq!((extent.size(0), extent.size(1), extent.size(2)), (2.0, 5.0, 0.0));
        assert!(extent.contains([0.0, 2.0, 3.0]) && !extent.contains([0.0, 2.0, 3.1]));
        assert_eq!(extent.corners()[7], [1.0, 7.0, 3.0]);
    }
}
