//! The simplest rational in an interval.

use rug::{Float, Integer, Rational};

/// Returns the rational of smallest denominator within `tolerance` of `value`, by continued fractions of both ends.
///
/// # Panics
/// When `value` or `tolerance` is not finite, or `tolerance` is negative.
#[must_use]
pub fn simplest_within(value: &Float, tolerance: &Float) -> Rational {
    assert!(value.is_finite() && tolerance.is_finite() && !tolerance.is_sign_negative(), "a finite interval");
    let exact = |x: Float| x.to_rational().expect("finite floats are rational");
    let precision = value.prec() + 64;
    let low = exact(Float::with_val(precision, value - tolerance));
    let high = exact(Float::with_val(precision, value + tolerance));
    simplest_between(low, high)
}

/// Returns the rational of smallest denominator in `[low, high]`.
#[must_use]
pub fn simplest_between(low: Rational, high: Rational) -> Rational {
    if low <= 0 && high >= 0 {
        return Rational::new();
    }
    if high < 0 {
        return -simplest_positive(-high, -low);
    }
    simplest_positive(low, high)
}

/// As [`simplest_between`] for `0 < low <= high`: common partial quotients, then the smallest that differs.
fn simplest_positive(mut low: Rational, mut high: Rational) -> Rational {
    let mut quotients: Vec<Integer> = Vec::new();
    loop {
        let floor = Integer::from(low.floor_ref());
        let next = Integer::from(&floor + 1);
        if low == floor {
            quotients.push(floor);
            break;
        }
        if high >= next {
            quotients.push(next);
            break;
        }
        low -= &floor;
        high -= &floor;
        quotients.push(floor);
        (low, high) = (high.recip(), low.recip());
    }
    let mut result = Rational::from(quotients.pop().unwrap_or_default());
    while let Some(quotient) = quotients.pop() {
        result = result.recip() + quotient;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_smallest_denominator() {
        let pi = Float::with_val(200, rug::float::Constant::Pi);
        let within = |t: f64| simplest_within(&pi, &Float::with_val(200, t));
        assert_eq!(within(0.01), Rational::from((22, 7)));
        assert_eq!(within(1e-6), Rational::from((355, 113)));
        assert_eq!(within(4.0), 0);
        assert_eq!(
            simplest_within(&Float::with_val(200, -pi.clone()), &Float::with_val(200, 1e-6)),
            Rational::from((-355, 113))
        );
    }

    #[test]
    fn an_empty_interval_gives_the_number_itself() {
        let x = Float::with_val(60, 0.1);
        assert_eq!(simplest_within(&x, &Float::new(53)), x.to_rational().unwrap());
    }
}
