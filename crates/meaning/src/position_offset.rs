//! G45 to G48: the block's own move is lengthened or shortened on every axis that it names.
//!
//! With `d` the distance along an axis and `r` the offset, the axis moves `d + k·sign(d)·r`, k = 1, −1, 2, −2 for G45,
//! G46, G47, G48. A word of zero has the sign it is written with. Centre words of an arc change in the same way.

/// The multiple of the offset and the offset itself, in counts.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct PositionOffset {
    pub factor: f64,
    pub offset: f64,
}

impl PositionOffset {
    /// By how much a distance changes; `minus` says that the word was written with a minus sign.
    pub fn change(self, distance: f64, minus: bool) -> f64 {
        let sign = if distance < 0.0 || (distance == 0.0 && minus) { -1.0 } else { 1.0 };
        self.factor * sign * self.offset
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_the_manual() {
        for (factor, offset, distance, moved) in [
            (1.0, 10.0, 40.0, 50.0),
            (-1.0, 10.0, 40.0, 30.0),
            (2.0, 10.0, 40.0, 60.0),
            (-2.0, 10.0, 40.0, 20.0),
            (1.0, 8.0, -30.0, -38.0),
            (-1.0, 8.0, 5.0, -3.0),
            (2.0, 8.0, 30.0, 46.0),
        ] {
            assert_eq!(distance + PositionOffset { factor, offset }.change(distance, false), moved);
        }
        let extend = PositionOffset { factor: 1.0, offset: 10.0 };
        assert_eq!((extend.change(0.0, false), extend.change(0.0, true)), (10.0, -10.0));
    }
}
