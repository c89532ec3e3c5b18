//! Polynomials in the cosines and sines of angles, kept reduced by `cos^2 + sin^2 = 1`.

mod elimination;
mod half_angle;

pub use elimination::{AngleElimination, eliminate_angle};
pub use half_angle::{HalfAngles, half_tangents};

use super::polynomial::Polynomial;
use super::ring::Ring;
use rug::Rational;

/// The two variables that stand for the cosine and the sine of an angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Pair {
    /// The variable of the cosine.
    pub cos: usize,
    /// The variable of the sine.
    pub sin: usize,
}

/// Returns the normal form modulo `cos^2 + sin^2 = 1` for each of the pairs: of degree 1 or less in every sine.
///
/// Two polynomials have the same one exactly if they are the same function of the angles (over rings without zero
/// divisors in which 2 is not 0).
///
/// # Panics
/// When a variable is in two of the pairs, or twice in one.
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, polynomial::Polynomial, ring::Ring, trigonometric::{Pair, reduce}};
///
/// let (c, s) = (Polynomial::<Int>::variable(0), Polynomial::variable(1));
/// let angle = Pair { cos: 0, sin: 1 };
/// assert_eq!(reduce(&c.pow(2).add(&s.pow(2)), &[angle]), Ring::one());
/// assert_eq!(reduce(&s.pow(3), &[angle]), s.sub(&c.pow(2).mul(&s)));
/// ```
#[must_use]
pub fn reduce<R: Ring>(f: &Polynomial<R>, pairs: &[Pair]) -> Polynomial<R> {
    assert_disjoint(pairs);
    pairs.iter().fold(f.clone(), |f, &pair| reduce_one(f, pair))
}

fn reduce_one<R: Ring>(f: Polynomial<R>, Pair { cos, sin }: Pair) -> Polynomial<R> {
    if f.degree(sin) <= 1 {
        return f;
    }
    let square = Polynomial::one().sub(&Polynomial::variable(cos).pow(2));
    let parts = f.coefficients_in(sin);
    let of_parity = |parity: usize| {
        let parts: Vec<&Polynomial<R>> = parts.iter().skip(parity).step_by(2).collect();
        parts.into_iter().rev().fold(Polynomial::zero(), |sum, part| sum.mul(&square).add(part))
    };
    Polynomial::from_coefficients_in(sin, &[of_parity(0), of_parity(1)])
}

fn assert_disjoint(pairs: &[Pair]) {
    let mut variables: Vec<usize> = pairs.iter().flat_map(|pair| [pair.cos, pair.sin]).collect();
    variables.sort_unstable();
    assert!(variables.is_sorted_by(|a, b| a < b), "a variable belongs to one angle");
}

/// A polynomial that knows which of its variables are cosines and sines, always in normal form; a ring, so that closure
/// equations can be generated over it.
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, ring::Ring, trigonometric::{Pair, Trigonometric}};
///
/// let angle = Pair { cos: 0, sin: 1 };
/// let (c, s) = (Trigonometric::<Int>::cos(angle), Trigonometric::sin(angle));
/// assert_eq!(c.mul(&c).add(&s.mul(&s)), Trigonometric::one());
/// ```
#[derive(Clone, Debug)]
pub struct Trigonometric<R> {
    polynomial: Polynomial<R>,
    /// In increasing order; a number has none.
    pairs: Vec<Pair>,
}

impl<R: Ring> Trigonometric<R> {
    /// Returns the normal form of a polynomial.
    ///
    /// # Panics
    /// When a variable is in two of the pairs, or twice in one.
    #[must_use]
    pub fn new(polynomial: &Polynomial<R>, pairs: &[Pair]) -> Self {
        let mut pairs = pairs.to_vec();
        pairs.sort_unstable();
        pairs.dedup();
        Self { polynomial: reduce(polynomial, &pairs), pairs }
    }

    /// Returns the cosine of an angle.
    #[must_use]
    pub fn cos(angle: Pair) -> Self {
        Self { polynomial: Polynomial::variable(angle.cos), pairs: vec![angle] }
    }

    /// Returns the sine of an angle.
    #[must_use]
    pub fn sin(angle: Pair) -> Self {
        Self { polynomial: Polynomial::variable(angle.sin), pairs: vec![angle] }
    }

    /// Returns the polynomial, of degree 1 or less in every sine.
    #[must_use]
    pub const fn polynomial(&self) -> &Polynomial<R> {
        &self.polynomial
    }

    /// Returns the angles that occur.
    #[must_use]
    pub fn pairs(&self) -> &[Pair] {
        &self.pairs
    }

    /// Returns the angles of both.
    fn union(&self, other: &Self) -> Vec<Pair> {
        let mut pairs = self.pairs.clone();
        if self.pairs != other.pairs {
            pairs.extend(&other.pairs);
            pairs.sort_unstable();
            pairs.dedup();
        }
        pairs
    }

    /// Returns a result over the angles of both.
    fn combined(&self, other: &Self, polynomial: &Polynomial<R>) -> Self {
        let pairs = self.union(other);
        Self { polynomial: reduce(polynomial, &pairs), pairs }
    }
}

impl<R: Ring> PartialEq for Trigonometric<R> {
    fn eq(&self, other: &Self) -> bool {
        let pairs = self.union(other);
        reduce(&self.polynomial, &pairs) == reduce(&other.polynomial, &pairs)
    }
}

impl<R: Ring> Ring for Trigonometric<R> {
    fn zero() -> Self {
        Self { polynomial: Polynomial::zero(), pairs: Vec::new() }
    }
    fn one() -> Self {
        Self { polynomial: Polynomial::one(), pairs: Vec::new() }
    }
    fn add(&self, other: &Self) -> Self {
        self.combined(other, &self.polynomial.add(&other.polynomial))
    }
    fn sub(&self, other: &Self) -> Self {
        self.combined(other, &self.polynomial.sub(&other.polynomial))
    }
    fn mul(&self, other: &Self) -> Self {
        self.combined(other, &self.polynomial.mul(&other.polynomial))
    }
    fn neg(&self) -> Self {
        Self { polynomial: self.polynomial.neg(), pairs: self.pairs.clone() }
    }
    fn is_zero(&self) -> bool {
        self.polynomial.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self { polynomial: Polynomial::from_rational(q)?, pairs: Vec::new() })
    }
}
