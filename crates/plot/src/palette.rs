//! Which colour a feed is drawn in.

use crate::colour::{Rgb, of_few, on_scale};
use crate::feeds::Feeds;

/// A continuous scale is drawn in so many shades.
const SHADES: usize = 32;

/// The colours of the feeds that occurred.
#[derive(Clone, Debug)]
pub(crate) enum Palette {
    /// A colour for each feed, slowest first.
    Few(Vec<f64>),
    /// A scale in equal ratios between two feeds in mm/min.
    Scale { slowest: f64, fastest: f64 },
    /// A scale in equal steps from rest to the fastest speed in mm/min.
    Speed { fastest: f64 },
}

impl Palette {
    /// The palette for the feeds.
    pub fn new(feeds: &Feeds) -> Palette {
        if feeds.many {
            Palette::Scale { slowest: feeds.slowest, fastest: feeds.fastest }
        } else {
            Palette::Few(feeds.named().to_vec())
        }
    }

    /// The palette for real speeds.
    pub fn of_speed(speeds: &Feeds) -> Palette {
        Palette::Speed { fastest: speeds.fastest }
    }

    /// How many colours there are.
    pub fn shades(&self) -> usize {
        match self {
            Palette::Few(feeds) => feeds.len(),
            Palette::Scale { .. } | Palette::Speed { .. } => SHADES,
        }
    }

    /// The shade of a feed, from 0, the slowest, to below [`Palette::shades`].
    pub fn shade(&self, feed: f64) -> usize {
        match self {
            Palette::Few(feeds) => feeds.partition_point(|known| *known < feed),
            Palette::Scale { .. } | Palette::Speed { .. } => (self.place(feed) * SHADES as f64) as usize,
        }
        .min(self.shades().saturating_sub(1))
    }

    /// The place of a feed on a continuous scale, 0 to 1.
    pub fn place(&self, feed: f64) -> f64 {
        let (slowest, fastest) = match self {
            Palette::Few(_) => return 0.0,
            Palette::Scale { slowest, fastest } => (slowest, fastest),
            Palette::Speed { fastest } => return (feed / fastest).clamp(0.0, 1.0),
        };
        if feed <= *slowest {
            return 0.0;
        }
        (libm::log(feed / slowest) / libm::log(fastest / slowest)).clamp(0.0, 1.0)
    }

    /// The colour of a shade.
    pub fn colour(&self, shade: usize) -> Rgb {
        match self {
            Palette::Few(feeds) => of_few(shade, feeds.len()),
            Palette::Scale { .. } | Palette::Speed { .. } => on_scale(shade as f64 / (SHADES - 1) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_feed_finds_its_shade() {
        let mut feeds = Feeds::new();
        [100.0, 400.0, 200.0].into_iter().for_each(|feed| feeds.note(feed));
        let few = Palette::new(&feeds);
        assert_eq!([100.0, 200.0, 400.0].map(|feed| few.shade(feed)), [0, 1, 2]);
        (0..9).for_each(|feed| feeds.note(1000.0 + 100.0 * f64::from(feed)));
        let scale = Palette::new(&feeds);
        assert_eq!([0.0, 100.0, 1800.0, 9999.0].map(|feed| scale.shade(feed)), [0, 0, 31, 31]);
        assert!((scale.place((100.0f64 * 1800.0).sqrt()) - 0.5).abs() < 1e-12, "equal ratios are equal distances");
    }
}
