//! The number of distinct real roots of a closure polynomial at a real algebraic number.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::resultant::subresultant::chain;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::sweep::exact::{PlaneCurve, sign_changes};
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Subresultants of polynomials up to this degree in the unknown are formed: those of a degree of 16 in both variables take
/// minutes.
const MOST: usize = 8;

/// A real root of a square-free polynomial.
pub(super) struct Place<'r> {
    root: RealRoot,
    minimal: &'r Univariate<Integer>,
}

impl<'r> Place<'r> {
    /// A root of a polynomial without multiple roots.
    pub fn of(root: &RealRoot, minimal: &'r Univariate<Integer>) -> Self {
        Self { root: root.clone(), minimal }
    }

    /// The sign of a polynomial there.
    fn sign_of(&mut self, polynomial: &Univariate<Integer>) -> Ordering {
        let (low, high) = self.root.bounds();
        if low == high {
            return polynomial.sign_at(&low);
        }
        if polynomial.degree().is_none() {
            return Ordering::Equal;
        }
        let common = polynomial.gcd(self.minimal);
        // One root of the minimal polynomial is inside, so that the divisor changes its sign there or has no root.
        if common.degree() > Some(0) && common.sign_at(&low) != common.sign_at(&high) {
            return Ordering::Equal;
        }
        loop {
            let (low, high) = self.root.bounds();
            if low == high || sign_changes(polynomial, [&low, &high]) == 0 {
                return polynomial.sign_at(&(Rational::from(&low + &high) / 2));
            }
            self.root.refine(&(Rational::from(&high - &low) / 4));
        }
    }

    /// The number of distinct real roots in the unknown, half a turn among them; `None` for high degrees, and where both 0 and
    /// infinity are roots.
    ///
    /// # Source
    /// Basu, Pollack, Roy 2006, Algorithms in Real Algebraic Geometry, theorem 4.33, with the signed subresultants of the
    /// polynomial and its derivative.
    pub fn distinct_real_roots(&mut self, curve: &PlaneCurve) -> Option<usize> {
        let degree = curve.degree();
        if degree == 0 || degree > MOST {
            return None;
        }
        let inverted = curve.inverted();
        let curve = if self.sign_of(&curve.coefficient(degree)).is_ne() {
            curve
        } else if self.sign_of(&inverted.coefficient(degree)).is_ne() {
            &inverted
        } else {
            return None;
        };
        let f = Univariate::new((0..=degree).map(|k| image(&curve.coefficient(k))).collect());
        let subresultants = chain(&f, &f.derivative());
        let principal = |j: usize| {
            let Some(c) = subresultants[j].coefficients().get(j) else { return Univariate::zero() };
            c.to_univariate(0).and_then(|p| p.map(|c| Some(c.to_integer()))).unwrap_or_else(Univariate::zero)
        };
        let leading = self.sign_of(&curve.coefficient(degree));
        // The first two are the sign of the leading coefficient and the leading coefficient of the derivative.
        let mut signs = vec![leading, leading];
        for j in (0..degree - 1).rev() {
            let sign = self.sign_of(&principal(j));
            signs.push(if is_turned(degree - j) { sign.reverse() } else { sign });
        }
        usize::try_from(variations(&signs)).ok()
    }
}

fn image(p: &Univariate<Integer>) -> Polynomial<Int> {
    let converted = p.map(|c| Some(Int::from(c.clone()))).unwrap_or_else(Univariate::zero);
    Polynomial::from_univariate(0, &converted)
}

/// Whether `(-1)^(i (i - 1) / 2)` is negative.
fn is_turned(i: usize) -> bool {
    matches!(i % 4, 2 | 3)
}

/// Permanences less variations of the signs, zeros counted as Basu, Pollack and Roy say.
fn variations(signs: &[Ordering]) -> i32 {
    let mut count = 0;
    let mut last = 0;
    for next in 1..signs.len() {
        if signs[next].is_eq() {
            continue;
        }
        let gap = next - last;
        if gap % 2 == 1 {
            let is_same = (signs[last] == signs[next]) != is_turned(gap);
            count += if is_same { 1 } else { -1 };
        }
        last = next;
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The distinct real roots of `sum rows[k](s) t^k` at every real root of a polynomial in s.
    fn counts(rows: &[&[i32]], minimal: &[i32]) -> Vec<Option<usize>> {
        let row = |c: &[i32]| Univariate::new(c.iter().copied().map(Integer::from).collect());
        let polynomial = Polynomial::from_terms(rows.iter().zip(0_u32..).flat_map(|(row, t)| {
            row.iter().zip(0_u32..).map(move |(c, s)| (vec![s, t], Int::from_integer(*c))).collect::<Vec<_>>()
        }));
        let (curve, minimal) = (PlaneCurve::of(&polynomial), row(minimal));
        minimal.real_roots().iter().map(|root| Place::of(root, &minimal).distinct_real_roots(&curve)).collect()
    }

    #[test]
    fn roots_are_counted_at_irrational_places() {
        // t^2 - s at s = sqrt(2) and -sqrt(2), and where s = 0.
        assert_eq!(counts(&[&[0, -1], &[0], &[1]], &[-2, 0, 1]), [Some(0), Some(2)]);
        assert_eq!(counts(&[&[0, -1], &[0], &[1]], &[0, 1]), [Some(1)]);
        // (t^2 - s^2 + 2) t: at s^2 = 2 one root, at s^2 = 3 three.
        assert_eq!(counts(&[&[0], &[2, 0, -1], &[0], &[1]], &[-2, 0, 1]), [Some(1), Some(1)]);
        assert_eq!(counts(&[&[0], &[2, 0, -1], &[0], &[1]], &[-3, 0, 1]), [Some(3), Some(3)]);
    }

    #[test]
    fn infinity_counts_as_a_root() {
        // (s^2 - 2) t^2 + t - 1: at s^2 = 2 the roots are 1 and infinity.
        assert_eq!(counts(&[&[-1], &[1], &[-2, 0, 1]], &[-2, 0, 1]), [Some(2), Some(2)]);
    }
}
