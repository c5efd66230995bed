//! Numbers of twice the usual length, for a second opinion on the last digits.

/// The sum of two `f64`, the second less than the last digit of the first: about 31 digits.
#[derive(Clone, Copy, Debug)]
pub struct Double(f64, f64);

impl Double {
    /// Without rounding.
    pub fn whole(number: i128) -> Double {
        let high = number as f64;
        Double::sum(high, (number - high as i128) as f64)
    }

    /// Without rounding.
    pub fn of(number: f64) -> Double {
        Double(number, 0.0)
    }

    /// The product of two `f64`, without rounding.
    pub fn product(a: f64, b: f64) -> Double {
        let high = a * b;
        Double(high, a.mul_add(b, -high))
    }

    fn sum(a: f64, b: f64) -> Double {
        let high = a + b;
        let back = high - a;
        Double(high, (a - (high - back)) + (b - back))
    }

    pub fn plus(self, other: Double) -> Double {
        let (high, low) = (Double::sum(self.0, other.0), Double::sum(self.1, other.1));
        let high = Double::sum(high.0, high.1 + low.0);
        Double::sum(high.0, high.1 + low.1)
    }

    pub fn minus(self, other: Double) -> Double {
        self.plus(Double(-other.0, -other.1))
    }

    pub fn times(self, other: Double) -> Double {
        let high = Double::product(self.0, other.0);
        Double::sum(high.0, high.1 + self.0 * other.1 + self.1 * other.0)
    }

    pub fn over(self, other: Double) -> Double {
        let first = self.0 / other.0;
        let rest = self.minus(other.times(Double::of(first)));
        let second = rest.0 / other.0;
        let rest = rest.minus(other.times(Double::of(second)));
        Double::sum(first, second).plus(Double::of(rest.0 / other.0))
    }

    pub fn root(self) -> Double {
        if self.0 <= 0.0 {
            return Double(0.0, 0.0);
        }
        let near = Double::of(self.0.sqrt());
        // One step of Newton's doubles the digits.
        let step = self.minus(near.times(near)).over(near.plus(near));
        near.plus(step)
    }

    pub fn value(self) -> f64 {
        self.0 + self.1
    }
}

#[test]
fn twice_the_digits() {
    let whole = |number: i128| Double::whole(number);
    let third = whole(1).over(whole(3));
    assert!(third.times(whole(3)).minus(whole(1)).value().abs() < 1e-30);
    let root = whole(2).root();
    assert!(root.times(root).minus(whole(2)).value().abs() < 1e-30);
    let long = 123_456_789_012_345_678_901_234_567_i128;
    assert_eq!(whole(long).minus(whole(long - 1)).value(), 1.0);
}
