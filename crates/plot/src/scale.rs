//! Round numbers along an axis, and how they are written.

/// The steps that a reader divides easily.
const ROUND: [f64; 4] = [1.0, 2.0, 5.0, 10.0];

/// More ticks than this are never wanted on one axis.
const MOST_TICKS: f64 = 400.0;

/// The round step (1, 2 or 5 times a power of ten) that is at least as great as asked.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Step {
    /// 1, 2, 5 or 10.
    digit: f64,
    /// The power of ten.
    power: i32,
}

impl Step {
    /// The least round step not below `least`, which is above zero.
    pub fn at_least(least: f64) -> Step {
        let power = libm::log10(least).floor() as i32;
        // A hair of slack, so that a step of just 5 is not made 10 by rounding.
        let enough = |digit: &f64| Step { digit: *digit, power }.times(1.0) >= least * (1.0 - 1e-9);
        Step { digit: ROUND.into_iter().find(enough).unwrap_or(10.0), power }
    }

    /// A whole multiple of the step, rounded once.
    pub fn times(self, count: f64) -> f64 {
        let ten = libm::pow(10.0, f64::from(self.power.abs()));
        if self.power < 0 { count * self.digit / ten } else { count * self.digit * ten }
    }

    /// The multiples of the step from `low` to `high`, both included.
    pub fn ticks(self, low: f64, high: f64) -> Vec<f64> {
        let step = self.times(1.0);
        let slack = 1e-9;
        let first = (low / step - slack).ceil();
        let last = (high / step + slack).floor();
        let count = (last - first + 1.0).clamp(0.0, MOST_TICKS) as u32;
        // Plus zero: no tick is written -0.
        (0..count).map(|nth| self.times(first + f64::from(nth)) + 0.0).collect()
    }
}

/// A number with at most three decimals, without those that are zero, with a true minus sign.
pub(crate) fn written(value: f64) -> String {
    let text = format!("{value:.3}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    match text.strip_prefix('-') {
        Some("0") => "0".to_owned(),
        Some(digits) => format!("\u{2212}{digits}"),
        None => text.to_owned(),
    }
}

/// A small length with three figures, at most to a nanometre.
pub(crate) fn written_deviation(by: f64) -> String {
    let decimals = (2 - libm::log10(by).floor() as i32).clamp(0, 6) as usize;
    format!("{by:.decimals$}")
}

/// A range of numbers, or one number if its ends are written alike.
pub(crate) fn written_range(low: f64, high: f64) -> String {
    let (low, high) = (written(low), written(high));
    if low == high { low } else { format!("{low} \u{2026} {high}") }
}

/// A length for reading: mm with three figures of sense, or m from ten metres on.
pub(crate) fn written_length(length_mm: f64) -> String {
    if length_mm >= 10_000.0 {
        format!("{:.2} m", length_mm / 1000.0)
    } else if length_mm >= 100.0 {
        format!("{length_mm:.0} mm")
    } else {
        format!("{} mm", written((length_mm * 10.0).round() / 10.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_one_two_or_five() {
        let step = |least| Step::at_least(least).times(1.0);
        assert_eq!([step(1.0), step(1.1), step(2.1), step(5.0), step(5.1)], [1.0, 2.0, 5.0, 5.0, 10.0]);
        assert_eq!([step(0.03), step(0.2), step(0.11), step(340.0)], [0.05, 0.2, 0.2, 500.0]);
    }

    #[test]
    fn ticks_are_the_round_numbers_of_the_range() {
        assert_eq!(Step::at_least(40.0).ticks(-60.0, 120.0), [-50.0, 0.0, 50.0, 100.0]);
        assert_eq!(Step::at_least(0.1).ticks(0.1, 0.3), [0.1, 0.2, 0.3]);
        assert_eq!(Step::at_least(1.0).ticks(0.2, 0.8), Vec::<f64>::new());
        assert_eq!(written(Step::at_least(0.1).ticks(-0.1, 0.0)[1]), "0");
        assert!(Step::at_least(1e-9).ticks(0.0, 1e9).len() <= 400);
    }

    #[test]
    fn numbers_are_written_short() {
        let cases =
            [(0.0, "0"), (-0.0001, "0"), (12.5, "12.5"), (-3.0, "\u{2212}3"), (0.1234, "0.123"), (100.0, "100")];
        for (value, text) in cases {
            assert_eq!(written(value), text);
        }
        assert_eq!(written_range(1.0, 1.0001), "1");
        assert_eq!(
            [written_length(12.34), written_length(812.4), written_length(12_345.0)],
            ["12.3 mm", "812 mm", "12.35 m"]
        );
    }
}
