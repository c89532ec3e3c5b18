//! All solutions of the equations of a synthesis: a family with its dimension, or points with their multiplicities.
//!
//! A Gröbner basis over the rationals gives the dimension of the set of solutions. Where they are finitely many, the quotient
//! ring gives their number and shows which of them coincide, and every unknown is a rational function of the roots of one
//! polynomial. Solutions outside of the main chart are not overlooked: the other charts must have none.

use super::cells::{CHOICES, Chart, Place, Shape};
use super::krawczyk::Certified;
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, Solutions};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::mechanism::exact_loop::roots::{Root, roots};
use rug::Rational;
use std::sync::Arc;

/// The solution set of a system of equations.
pub(super) enum Found {
    /// Infinitely many, complex ones included: the dimension of their set.
    Family(usize),
    /// Finitely many, none included: the distinct ones.
    Points(Vec<Point>),
}

/// Solutions that have their number field in common.
#[derive(Debug)]
struct Part {
    chart: Chart,
    /// The coordinates of the chart as quotients of polynomials in the root: numerators, and the denominator of all.
    coordinates: Arc<(Vec<Univariate<Rational>>, Univariate<Rational>)>,
    polynomial: Univariate<Rational>,
}

/// The form in which a solution is known.
#[derive(Clone, Debug)]
enum Known {
    /// As a root of a polynomial.
    Exactly(Arc<Part>, Root),
    /// By a box in which it is the only one.
    InBox(Certified),
}

/// One solution.
#[derive(Clone, Debug)]
pub(super) struct Point {
    known: Known,
    /// The number of solutions that coincide here.
    pub multiplicity: usize,
}

impl Point {
    /// Whether all unknowns are real.
    pub fn is_real(&self) -> bool {
        match &self.known {
            // The root is a linear form with rational coefficients in the unknowns, and they are rational functions of it.
            Known::Exactly(_, root) => root.is_real(),
            Known::InBox(solution) => solution.is_real,
        }
    }

    /// The degree of the exact polynomial whose root this is, if there is one.
    pub fn degree(&self) -> Option<usize> {
        match &self.known {
            Known::Exactly(part, _) => part.polynomial.degree(),
            Known::InBox(_) => None,
        }
    }

    /// Returns the unknowns in discs of about `bits` bits; `None` where the root cannot be computed to them.
    pub fn place(&self, bits: u32) -> Option<Place<Disc>> {
        let (part, root) = match &self.known {
            Known::Exactly(part, root) => (part, root.ball(bits)?),
            Known::InBox(solution) => return Some(solution.place()),
        };
        let (numerators, denominator) = &*part.coordinates;
        let inverse = root.evaluate(denominator.coefficients()).inverse()?;
        let value = |p: &Univariate<Rational>| root.evaluate(p.coefficients()).mul(&inverse);
        let coordinates: Vec<Disc> = numerators.iter().map(value).collect();
        Some(part.chart.place(&coordinates))
    }

    /// Whether all coordinates are 0, exactly.
    pub fn is_origin(&self) -> bool {
        let Known::Exactly(part, Root::Rational(q)) = &self.known else { return false };
        part.coordinates.0.iter().all(|p| p.eval(q) == 0)
    }
}

impl Found {
    /// Solutions that are all there are, and simple.
    pub fn certified(solutions: Vec<Certified>) -> Self {
        let point = |solution| Point { known: Known::InBox(solution), multiplicity: 1 };
        Self::Points(solutions.into_iter().map(point).collect())
    }
}

/// Solves the equations that a place of the unknowns has to fulfil; `None` where that takes more than `effort` products of
/// words.
pub(super) fn solve(
    shape: &Shape,
    equations: &dyn Fn(&Place<Equation>) -> Vec<Equation>,
    effort: u64,
) -> Option<Found> {
    for choice in 0..CHOICES {
        let charts = Chart::all(shape, choice);
        let mut dimensions = Vec::new();
        let mut main = None;
        for chart in &charts {
            let unknowns = chart.unknowns();
            let coordinates: Vec<Equation> = (0..unknowns).map(Equation::variable).collect();
            let basis = Basis::of(unknowns, &equations(&chart.place(&coordinates)), effort)?;
            dimensions.push(basis.dimension());
            main = main.or(Some(basis));
        }
        if let Some(dimension) = dimensions.iter().flatten().max().filter(|dimension| **dimension > 0) {
            return Some(Found::Family(*dimension));
        }
        if dimensions[1..].iter().any(Option::is_some) {
            continue;
        }
        return match dimensions[0] {
            None => Some(Found::Points(Vec::new())),
            Some(_) => points(&main?, &charts[0]).map(Found::Points),
        };
    }
    None
}

/// The zeros of an ideal of dimension 0.
fn points(basis: &Basis, chart: &Chart) -> Option<Vec<Point>> {
    let unknowns = chart.unknowns();
    let solutions = Solutions::of(FiniteRing::of(basis)?, unknowns)?;
    let quotients = (0..unknowns).map(|k| solutions.quotient(&Equation::variable(k)));
    let quotients = quotients.collect::<Option<Vec<_>>>()?;
    let denominator = quotients.first().map_or_else(Univariate::one, |[_, denominator]| denominator.clone());
    let coordinates = Arc::new((quotients.into_iter().map(|[numerator, _]| numerator).collect(), denominator));
    let mut points = Vec::new();
    for values in &solutions.parts {
        let coordinates = coordinates.clone();
        let part = Arc::new(Part { chart: chart.clone(), coordinates, polynomial: values.polynomial.clone() });
        for root in roots(&values.polynomial)? {
            points.push(Point { known: Known::Exactly(part.clone(), root), multiplicity: values.multiplicity });
        }
    }
    Some(points)
}
