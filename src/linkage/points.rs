//! The points of a finite set that a Gröbner basis over the rationals describes: algebraic numbers, as exact as one likes.

use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, Solutions};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::mechanism::exact_loop::roots::{Root, roots};
use rug::Rational;

/// Products of words that a Gröbner basis may take: some seconds.
pub(crate) const EFFORT: u64 = 2_000_000_000;

/// Bits in which points are computed, and more where two of them are not told apart.
const BITS: [u32; 3] = [640, 1280, 5120];
/// Radius below which a point is exact enough for what stands on it.
const WANTED: f64 = 1e-40;

/// All points of a finite set.
pub(crate) struct Points {
    /// Every unknown as the quotient of two polynomials in a separating form, numerator first.
    quotients: Vec<[Univariate<Rational>; 2]>,
    /// The values of the form, each with the multiplicity of its point.
    pub list: Vec<(Root, usize)>,
}

impl Points {
    /// Returns the points of a set of dimension 0 in this number of unknowns; `None` if they are more than a ring is made for, or
    /// were not told apart.
    pub fn of(unknowns: usize, basis: &Basis) -> Option<Self> {
        if unknowns == 0 {
            return Some(Self { quotients: Vec::new(), list: vec![(Root::Rational(Rational::new()), 1)] });
        }
        let solutions = Solutions::of(FiniteRing::of(basis)?, unknowns)?;
        let quotients = (0..unknowns).map(|k| solutions.quotient(&Equation::variable(k))).collect::<Option<_>>()?;
        let mut list = Vec::new();
        for part in &solutions.parts {
            list.extend(roots(&part.polynomial)?.into_iter().map(|root| (root, part.multiplicity)));
        }
        Some(Self { quotients, list })
    }

    /// Returns the unknowns at a point, computed with this many bits; `None` where these are too few.
    pub fn values(&self, root: &Root, bits: u32) -> Option<Vec<Disc>> {
        let ball = root.ball(bits)?;
        let value = |[numerator, denominator]: &[Univariate<Rational>; 2]| {
            let inverse = ball.evaluate(denominator.coefficients()).inverse()?;
            Some(ball.evaluate(numerator.coefficients()).mul(&inverse))
        };
        self.quotients.iter().map(value).collect()
    }

    /// Returns the unknowns at a point so exactly that groups can stand on it; `None` where that does not succeed.
    pub fn narrow(&self, root: &Root) -> Option<Vec<Disc>> {
        let is_narrow = |values: &Vec<Disc>| values.iter().all(|value| value.radius().to_f64() < WANTED);
        BITS.iter().find_map(|bits| self.values(root, *bits).filter(is_narrow))
    }

    /// Returns the unknowns at a point of rational coordinates; `None` for another one.
    pub fn rational(&self, root: &Root) -> Option<Vec<Rational>> {
        let Root::Rational(at) = root else { return None };
        let value = |[numerator, denominator]: &[Univariate<Rational>; 2]| {
            let below = denominator.eval(at);
            (below != 0).then(|| numerator.eval(at) / below)
        };
        self.quotients.iter().map(value).collect()
    }
}
