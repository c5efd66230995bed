//! Units as types, and the exact relations between them.
//!
//! Words are exact counts of nanometres or microdegrees; geometry is `f64` millimetres and degrees.

/// Nanometres in an inch, exact by definition of the inch.
pub const NM_PER_INCH: i64 = 25_400_000;

/// The unit system in which a program's lengths are written (G20 / G21).
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum UnitSystem {
    /// Millimetres.
    #[default]
    Metric,
    /// Inches.
    Inch,
}

/// A time or duration.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
pub struct Seconds(pub f64);

impl std::ops::Add for Seconds {
    type Output = Seconds;
    fn add(self, other: Seconds) -> Seconds {
        Seconds(self.0 + other.0)
    }
}

impl std::ops::AddAssign for Seconds {
    fn add_assign(&mut self, other: Seconds) {
        self.0 += other.0;
    }
}

impl std::ops::Sub for Seconds {
    type Output = Seconds;
    fn sub(self, other: Seconds) -> Seconds {
        Seconds(self.0 - other.0)
    }
}

impl Seconds {
    /// The later of two times.
    pub fn max(self, other: Seconds) -> Seconds {
        if self.0 < other.0 { other } else { self }
    }
}

/// A feed along a path.
#[derive(Clone, Copy, PartialEq, PartialOrd, Debug, Default)]
pub struct MmPerMinute(pub f64);
