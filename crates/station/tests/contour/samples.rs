//! How many random contours a test takes.

/// How many samples a test takes: `default`, or what the environment asks for with CONTOURS.
pub fn samples_asked(default: u64) -> u64 {
    std::env::var("CONTOURS").map_or(default, |count| count.parse().expect("CONTOURS is a number"))
}
