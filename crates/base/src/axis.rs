//! Axes: a fixed array of eight, indexed by the order of the machine file.

/// The most axes a machine can have.
pub const AXES: usize = 8;

/// One value an axis; what it counts (mm, nanometres, mm/min …) is said where it is used.
pub type Point = [f64; AXES];

/// A set of axes, one bit each.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Hash)]
pub struct AxisSet(pub u8);

impl AxisSet {
    /// No axis.
    pub const NONE: AxisSet = AxisSet(0);

    /// The set of this axis alone.
    pub const fn only(axis: usize) -> AxisSet {
        AxisSet(1 << axis)
    }

    /// True if the axis is in the set.
    pub const fn has(self, axis: usize) -> bool {
        self.0 & (1 << axis) != 0
    }

    /// Puts an axis into the set.
    pub const fn add(&mut self, axis: usize) {
        self.0 |= 1 << axis;
    }

    /// The axes in either set.
    pub const fn or(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 | other.0)
    }

    /// The axes in both sets.
    pub const fn and(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 & other.0)
    }

    /// The axes in this set that are not in the other.
    pub const fn without(self, other: AxisSet) -> AxisSet {
        AxisSet(self.0 & !other.0)
    }

    /// True if no axis is in the set.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The axes in the set, lowest index first.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        let mut rest = self.0;
        std::iter::from_fn(move || {
            if rest == 0 {
                return None;
            }
            let axis = rest.trailing_zeros() as usize;
            rest &= rest - 1;
            Some(axis)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_gives_back_what_was_added_in_order() {
        let mut set = AxisSet::only(5);
        set.add(0);
        set.add(7);
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 5, 7]);
        assert!(set.has(5) && !set.has(1));
        assert_eq!(set.without(AxisSet::only(5)).iter().collect::<Vec<_>>(), [0, 7]);
        assert!(AxisSet::NONE.is_empty());
    }
}
