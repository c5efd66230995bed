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

impl ReferenceReturn {
    /// What missing keys mean: returned in the positive direction, a dog of 30 that ends 5 before the point, a grid of 10.
    pub(crate) fn default_for(rapid: f64) -> ReferenceReturn {
        ReferenceReturn { positive: true, dog: [5.0, 30.0], grid: 10.0, feeds: [rapid / 2.0, 300.0] }
    }

    /// Reads `[axes.X.return]` of an axis with this rapid rate, acceleration and jerk (0 is not limited).
    pub(crate) fn read(table: &mut Table, [rapid, acceleration, jerk]: [f64; 3]) -> ReferenceReturn {
        let missing = ReferenceReturn::default_for(rapid);
        let place = table.range();
        let read = ReferenceReturn {
            positive: table.choice("direction", &[("+", true), ("-", false)]).unwrap_or(missing.positive),
            dog: [positive(table, "dog_end", missing.dog[0]), positive(table, "dog_length", missing.dog[1])],
            grid: positive(table, "grid", missing.grid),
            feeds: [positive(table, "search_feed", missing.feeds[0]), positive(table, "creep_feed", missing.feeds[1])],
        };
        if read.dog[0] >= read.grid {
            let why = "dog_end must be less than grid: behind the dog the first mark of the grid is the point";
            table.error(place.clone(), why);
        }
        if read.feeds[1] > read.feeds[0] {
            table.error(place.clone(), "creep_feed must not be greater than search_feed");
        }
        // On its way to stand the axis must have met the dog only, and creep before that ends.
        let [search, creep] = read.feeds.map(|feed| {
            let speed = feed / 60.0;
            speed * speed / (2.0 * acceleration) + if jerk > 0.0 { speed * acceleration / (2.0 * jerk) } else { 0.0 }
        });
        if search > read.dog[1] {
            let why = format!("dog_length must be {search} at least: so far the axis runs until it stands");
            table.error(place.clone(), why);
        }
        if creep > read.dog[0] {
            table.error(place, format!("dog_end must be {creep} at least: so far the axis creeps until it stands"));
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

    /// Where an axis must first go back to that stands on the dog or behind it.
    pub fn back(&self, point: f64, position: f64) -> Option<f64> {
        let [first, _] = self.dog_at(point);
        let sign = if self.positive { 1.0 } else { -1.0 };
        ((position - first) * sign >= 0.0).then_some(first - sign * self.grid)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_on_the_dog_or_behind_it_goes_back_first() {
        let axis = ReferenceReturn::default_for(12_000.0);
        assert_eq!([-200.0, -20.0, 3.0].map(|from| axis.back(0.0, from)), [None, Some(-45.0), Some(-45.0)]);
        assert!(axis.is_on_dog(0.0, -20.0) && !axis.is_on_dog(0.0, -4.0));
        let other = ReferenceReturn { positive: false, ..axis };
        assert_eq!((other.dog_at(100.0), other.back(100.0, 90.0)), ([135.0, 105.0], Some(145.0)));
    }
}
