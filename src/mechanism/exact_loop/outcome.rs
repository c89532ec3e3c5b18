//! The solution set of closure equations: a family, or points with their multiplicities.

use super::equations::System;
use super::roots::{Root, roots};
use crate::algebra::disc::Disc;
use crate::algebra::drawn::Drawn;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, Solutions, Values};
use crate::algebra::univariate::Univariate;
use rug::Rational;

/// The solutions of a system.
#[derive(Clone, Debug)]
pub(crate) enum Outcome {
    /// Infinitely many, in complex numbers: the dimension of their set.
    Moving(usize),
    /// Finitely many.
    Finite(Box<Points>),
}

/// Finitely many solutions.
#[derive(Clone, Debug)]
pub(crate) struct Points {
    solutions: Solutions,
    /// Complex ones included, with multiplicity.
    pub count: usize,
    /// The distinct ones.
    pub distinct: Vec<Point>,
}

/// One solution.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// The part of the solutions to which it belongs.
    part: usize,
    root: Root,
    /// The number of solutions that coincide here.
    pub multiplicity: usize,
}

impl Point {
    /// Whether all unknowns are real.
    pub fn is_real(&self) -> bool {
        self.root.is_real()
    }

    /// Returns the root of its part at this point, to about `bits` bits.
    pub fn root(&self, bits: u32) -> Option<Disc> {
        self.root.ball(bits)
    }
}

impl Outcome {
    /// Decides a system; `None` where that takes more products of words.
    pub fn of(system: &System, effort: u64) -> Option<Self> {
        let basis = Basis::of(system.variables, &system.equations, effort)?;
        if let Some(dimension) = basis.dimension().filter(|dimension| *dimension > 0) {
            return Some(Self::Moving(dimension));
        }
        let ring = FiniteRing::of(&basis)?;
        let count = ring.dimension();
        let solutions = Solutions::of(ring, system.variables)?;
        let mut points = Vec::new();
        for (part, values) in solutions.parts.iter().enumerate() {
            let multiplicity = values.multiplicity;
            points.extend(roots(&values.polynomial)?.into_iter().map(|root| Point { part, root, multiplicity }));
        }
        Some(Self::Finite(Box::new(Points { solutions, count, distinct: points })))
    }
}

/// Returns the dimension of the set of solutions modulo the prime of the run, complex ones included, 0 for none; `None` where that takes
/// more products, and where the prime divides a denominator.
pub(crate) fn dimension_modulo_prime(system: &System, effort: u64) -> Option<usize> {
    Some(Basis::<Drawn>::of(system.variables, &system.equations, effort)?.dimension().unwrap_or(0))
}

impl Points {
    /// Real solutions with multiplicity.
    pub fn real(&self) -> usize {
        self.distinct.iter().filter(|point| point.is_real()).map(|point| point.multiplicity).sum()
    }

    fn part(&self, point: &Point) -> &Values {
        &self.solutions.parts[point.part]
    }

    /// The value of a polynomial at the solutions of the part that a point belongs to, over the number field of that part.
    pub fn value(&self, point: &Point, equation: &Equation) -> Option<Univariate<Rational>> {
        self.solutions.value(self.part(point), equation)
    }

    /// The value of a polynomial at all solutions as the quotient of two polynomials in their roots, numerator first; the denominator is 0
    /// at none. Its numbers are far smaller than those of [`Self::value`].
    pub fn quotient(&self, equation: &Equation) -> Option<[Univariate<Rational>; 2]> {
        self.solutions.quotient(equation)
    }

    /// Whether an algebraic number is 0 at a point, exactly.
    pub fn is_zero(&self, point: &Point, value: &Univariate<Rational>) -> Option<bool> {
        let polynomial = &self.part(point).polynomial;
        let common = polynomial.gcd(value);
        let rest = polynomial.div_rem(&common).0;
        // The point is a root of one of the two factors, and not of the other one.
        for bits in (0..10).map(|k| 128 << k) {
            let root = point.root.ball(bits)?;
            if root.evaluate(common.coefficients()).is_not_zero() {
                return Some(false);
            }
            if root.evaluate(rest.coefficients()).is_not_zero() {
                return Some(true);
            }
        }
        None
    }
}
