//! Random numbers that are the same in every run (SplitMix64).

use std::panic::AssertUnwindSafe;

/// How many samples a test takes: `default`, or what the environment asks for with PROGRAMS.
pub fn samples_asked(default: u64) -> u64 {
    std::env::var("PROGRAMS").map_or(default, |count| count.parse().expect("PROGRAMS is a number"))
}

/// The numbers of the samples that a test takes: as [`samples_asked`] says, or only those of ONLY=1831,3419.
pub fn seeds_asked(default: u64) -> Vec<u64> {
    match std::env::var("ONLY") {
        Ok(only) => only.split(',').map(|seed| seed.parse().expect("ONLY is a list of numbers")).collect(),
        Err(_) => (0..samples_asked(default)).collect(),
    }
}

/// Runs a check for many numbers and tells of the first ones that fail, and of how many do.
pub fn over_seeds(default: u64, check: impl Fn(u64) -> Result<(), String>) {
    let seeds = seeds_asked(default);
    let mut wrong = Vec::new();
    for &seed in &seeds {
        let checked = std::panic::catch_unwind(AssertUnwindSafe(|| check(seed)));
        let checked = checked.unwrap_or_else(|panic| Err(panic.downcast_ref::<String>().cloned().unwrap_or_default()));
        if let Err(what) = checked {
            wrong.push(format!("program {seed}: {what}"));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {} programs:\n{}",
        wrong.len(),
        seeds.len(),
        wrong[..wrong.len().min(25)].join("\n")
    );
}

pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Random {
        // Seeds one beside the other give unlike rows.
        let mut random = Random(seed.wrapping_mul(0xD129_0000_5A4B_9C3D) ^ 0x5851_F42D_4C95_7F2D);
        random.bits();
        random
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^ (bits >> 31)
    }

    /// Evenly from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    /// From `low` to `high`, each power of ten as likely as another.
    pub fn scaled(&mut self, low: f64, high: f64) -> f64 {
        self.between(low.ln(), high.ln()).exp()
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.bits() % count.max(1) as u64) as usize
    }

    pub fn chance(&mut self, share: f64) -> bool {
        self.between(0.0, 1.0) < share
    }

    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }
}
