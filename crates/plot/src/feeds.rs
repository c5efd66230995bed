//! Which feeds occur, and which of them share a colour.
//!
//! A few feeds are kept exactly and have a colour and a name each; when there are more, all lie on one continuous scale.

/// Up to so many distinct feeds have a colour of their own.
pub(crate) const MOST_NAMED: usize = 6;

/// Feeds of a continuous scale closer than one part in so many of an octave are drawn alike.
const PARTS_OF_OCTAVE: f64 = 16.0;

/// The feeds that occurred, in mm/min.
#[derive(Clone, Debug)]
pub(crate) struct Feeds {
    /// The distinct feeds, slowest first, as long as there are few.
    named: Vec<f64>,
    /// True once there were too many feeds to name.
    pub many: bool,
    /// The slowest feed above zero.
    pub slowest: f64,
    /// The fastest feed.
    pub fastest: f64,
    last: f64,
}

impl Feeds {
    /// No feed.
    pub fn new() -> Feeds {
        Feeds { named: Vec::new(), many: false, slowest: f64::INFINITY, fastest: 0.0, last: f64::NAN }
    }

    /// Takes note that a feed occurs.
    pub fn note(&mut self, feed: f64) {
        if feed == self.last {
            return;
        }
        self.last = feed;
        if feed > 0.0 {
            self.slowest = self.slowest.min(feed);
            self.fastest = self.fastest.max(feed);
        }
        if self.many {
            return;
        }
        let place = self.named.partition_point(|known| *known < feed);
        if self.named.get(place) != Some(&feed) {
            self.named.insert(place, feed);
            self.many = self.named.len() > MOST_NAMED;
        }
    }

    /// The distinct feeds, slowest first; empty when there are too many to name.
    pub fn named(&self) -> &[f64] {
        if self.many { &[] } else { &self.named }
    }

    /// True if two feeds are drawn alike.
    pub fn alike(&self, a: f64, b: f64) -> bool {
        a == b || (self.many && part_of_octave(a) == part_of_octave(b))
    }

    /// A number for feeds of about the same colour: the half octave of a continuous scale, or the feed's place.
    pub fn colour_group(&self, feed: f64) -> i32 {
        if self.many { part_of_octave(feed) >> 3 } else { self.named.partition_point(|known| *known < feed) as i32 }
    }
}

fn part_of_octave(feed: f64) -> i32 {
    if feed > 0.0 { (libm::log2(feed) * PARTS_OF_OCTAVE).floor() as i32 } else { i32::MIN }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_feeds_are_named_and_many_are_a_scale() {
        let mut feeds = Feeds::new();
        for feed in [300.0, 100.0, 300.0, 0.0, 200.0] {
            feeds.note(feed);
        }
        assert_eq!(feeds.named(), [0.0, 100.0, 200.0, 300.0]);
        assert!(!feeds.alike(100.0, 101.0));
        for feed in 0..10 {
            feeds.note(1000.0 + f64::from(feed));
        }
        assert!(feeds.many && feeds.named().is_empty());
        assert_eq!((feeds.slowest, feeds.fastest), (100.0, 1009.0));
        assert!(feeds.alike(1000.0, 1001.0) && !feeds.alike(100.0, 200.0));
    }
}
