//! The return to a reference point by a deceleration dog: what the builder says of it, and its pieces.
//!
//! The axis runs towards the dog, slows down on it, creeps off it, and stops at the next mark of the grid behind: the
//! reference point. An axis that begins on the dog or behind it first goes back in front of it.

use data::Table;

use crate::path_table::positive;

/// An axis' dog, grid and speeds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ReferenceReturn {
    /// True if the axis returns in its positive direction.
    pub positive: bool,
    /// How far in front of the reference point the dog ends, and how long it is, mm or degrees.
    pub dog: [f64; 2],
    /// From one mark of the grid to the next, mm or degrees; the reference point is one.
    pub grid: f64,
    /// Towards the dog, and behind it, mm/min or degrees/min.
    pub feeds: [f64; 2],
}

/// A piece of the return.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ReturnPiece {
    /// Where it ends, machine coordinate.
    pub to: f64,
    /// How fast, mm/min or degrees/min.
    pub feed: f64,
}

impl ReferenceReturn {
    /// What missing keys mean: returned in the positive direction, a dog of 30 that ends 5 before the point, a grid of 10.
    pub(crate) fn default_for(rapid: f64) -> ReferenceReturn {
        ReferenceReturn { positive: true, dog: [5.0, 30.0], grid: 10.0, feeds: [rapid / 2.0, 300.0] }
    }

    /// Reads `[axes.X.return]`.
    pub(crate) fn read(table: &mut Table, rapid: f64) -> ReferenceReturn {
        let missing = ReferenceReturn::default_for(rapid);
        let place = table.range();
        let read = ReferenceReturn {
            positive: table.choice("direction", &[("+", true), ("-", false)]).unwrap_or(missing.positive),
            dog: [positive(table, "dog_end", missing.dog[0]), positive(table, "dog_length", missing.dog[1])],
            grid: positive(table, "grid", missing.grid),
            feeds: [positive(table, "search_feed", missing.feeds[0]), positive(table, "creep_feed", missing.feeds[1])],
        };
        if read.dog[0] >= read.grid {
            table
                .error(place, "dog_end must be less than grid: behind the dog the first mark of the grid is the point");
        }
        read
    }

    /// The ends of the dog, in the order in which the axis meets them, for this reference point.
    pub fn dog_at(&self, point: f64) -> [f64; 2] {
        let sign = if self.positive { 1.0 } else { -1.0 };
        let [end, length] = self.dog;
        [point - sign * (end + length), point - sign * end]
    }

    /// True if the axis stands on the dog.
    pub fn is_on_dog(&self, point: f64, position: f64) -> bool {
        let [first, last] = self.dog_at(point);
        position >= first.min(last) && position <= first.max(last)
    }

    /// The pieces of the way from here: back in front of the dog if need be, to the dog, over it and to the point.
    ///
    /// At the dog's beginning the axis begins to slow down from the search feed to the creep feed.
    pub fn pieces(&self, point: f64, position: f64) -> impl Iterator<Item = ReturnPiece> {
        let [first, _] = self.dog_at(point);
        let sign = if self.positive { 1.0 } else { -1.0 };
        let [search, creep] = self.feeds;
        let beyond = (position - first) * sign >= 0.0;
        let back = beyond.then_some(ReturnPiece { to: first - sign * self.grid, feed: search });
        let rest = [ReturnPiece { to: first, feed: search }, ReturnPiece { to: point, feed: creep }];
        back.into_iter().chain(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_axis_meets_the_dog_and_creeps_to_the_point() {
        let axis = ReferenceReturn::default_for(12_000.0);
        let way = |from: f64| axis.pieces(0.0, from).map(|piece| (piece.to, piece.feed)).collect::<Vec<_>>();
        assert_eq!(way(-200.0), [(-35.0, 6000.0), (0.0, 300.0)]);
        assert_eq!(way(-20.0), [(-45.0, 6000.0), (-35.0, 6000.0), (0.0, 300.0)], "it begins on the dog");
        assert!(axis.is_on_dog(0.0, -20.0) && !axis.is_on_dog(0.0, -4.0));
        let other = ReferenceReturn { positive: false, ..axis };
        assert_eq!(other.dog_at(100.0), [135.0, 105.0]);
    }
}
