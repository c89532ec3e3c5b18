//! Separates rational roots from irrational ones.

use super::RealRoot;
use rug::{Integer, Rational};
use std::cmp::Ordering;

impl RealRoot {
    /// Returns the root itself, if it is rational. Shrinks the interval for that.
    ///
    /// The denominator of a rational root divides the leading coefficient l, and two fractions with such denominators
    /// are no less than `1/l^2` apart: a narrower interval has at most one, and that is its simplest fraction.
    #[must_use]
    pub fn rational(&mut self) -> Option<Rational> {
        if let Some(leading) = self.polynomial.coefficients().last() {
            let width = Rational::from((1, Integer::from(leading.square_ref()) * 2_u32));
            self.refine(&width);
        }
        self.exact().or_else(|| {
            let (lo, hi) = self.bounds();
            let fraction = simplest(lo, hi);
            (self.compare(&fraction) == Ordering::Equal).then_some(fraction)
        })
    }
}

/// Returns the fraction of least denominator strictly between two numbers, the first below the second.
fn simplest(lo: Rational, hi: Rational) -> Rational {
    if hi.cmp0() != Ordering::Greater {
        return -simplest(-hi, -lo);
    }
    if lo.cmp0() == Ordering::Less {
        return Rational::new();
    }
    let (mut lo, mut hi) = (lo, Some(hi));
    // The continued fraction that both numbers begin with; `None` is infinity.
    let mut quotients = Vec::new();
    let last = loop {
        let floor = Integer::from(lo.floor_ref());
        let above = Integer::from(&floor + 1);
        if hi.as_ref().is_none_or(|hi| *hi > above) {
            break above;
        }
        let reciprocal = |x: Rational| {
            let rest = x - &floor;
            (rest.cmp0() != Ordering::Equal).then(|| rest.recip())
        };
        let Some(next) = hi.and_then(reciprocal) else { break above };
        hi = reciprocal(lo);
        lo = next;
        quotients.push(floor);
    };
    quotients.into_iter().rev().fold(Rational::from(last), |fraction, quotient| fraction.recip() + quotient)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::Ring;
    use crate::univariate::Univariate;

    #[test]
    fn the_simplest_fraction_lies_between() {
        let q = |n: i32, d: i32| Rational::from((n, d));
        assert_eq!(simplest(q(3, 10), q(4, 10)), q(1, 3));
        assert_eq!(simplest(q(-4, 10), q(-3, 10)), q(-1, 3));
        assert_eq!(simplest(q(-1, 9), q(1, 100)), Rational::new());
        assert_eq!(simplest(q(0, 1), q(1, 3)), q(1, 4));
        assert_eq!(simplest(q(2, 1), q(3, 1)), q(5, 2));
        assert_eq!(simplest(q(314, 100), q(315, 100)), q(22, 7));
    }

    #[test]
    fn rational_roots_are_recognised_and_irrational_ones_are_not() {
        // (3 x - 1)^2 (7 x + 22) (x^2 - 2)
        let linear = |a: i32, b: i32| Univariate::new(vec![Integer::from(b), Integer::from(a)]);
        let square = Univariate::new([-2, 0, 1].map(Integer::from).to_vec());
        let product = linear(3, -1).mul(&linear(3, -1)).mul(&linear(7, 22)).mul(&square);
        let found: Vec<_> = product.real_roots().iter_mut().map(RealRoot::rational).collect();
        assert_eq!(found, [Some(Rational::from((-22, 7))), None, Some(Rational::from((1, 3))), None]);
    }
}
