//! Eliminants over the integers: polynomials of which the half-angle tangent of one unknown is a root at every solution.
//!
//! The determinant of a cut's pencil has, at every value of the hidden unknown, at least the order of the number of isolated
//! solutions with that value, counted with multiplicity. For let the geometry vary: a general loop nearby has 16
//! solutions with 16 values, all of them simple roots, and near an isolated solution of multiplicity m there are m of
//! them. The determinant varies continuously, and does not vanish identically, so that its root here has at least the
//! order of the number of roots that come together in it. Near a point of a curve of solutions a general loop nearby
//! has solutions, too: the order exceeds the number of isolated solutions where there is such a curve.

use crate::algebra::ball::Ball;
use crate::algebra::determinant::modular as modular_determinant;
use crate::algebra::drawn::Drawn;
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::sort;
use crate::algebra::univariate::Univariate;
use crate::closure::half_angle::half_angle_form;
use crate::elimination::coordinate_ring::{CoordinateRing, Plan};
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::degree::closure_polynomial;
use crate::elimination::pencil::{Pencil, before_second_link, bilinear, pencil};
use crate::kinematics::closed_loop::ClosedLoop;
use rug::{Integer, Rational};
use std::cmp::Reverse;

/// Degree of the determinant of a pencil, with the roots at infinity.
pub(super) const DEGREE: usize = 16;

/// The eliminant of one unknown.
#[derive(Clone, Debug)]
pub struct Eliminant {
    /// Index of the unknown among the six.
    pub unknown: usize,
    /// Square-free factors of the polynomial in the tangent of half the unknown, each with the order of its roots, without factors
    /// `1 + x^2`; no two have a root in common.
    pub factors: Vec<(Coefficients, usize)>,
    /// The order of the root at infinity, where the angle is pi.
    pub at_pi: usize,
}

/// Bits of the coefficients of eliminants: the bits of the longest balls in which roots are compared, and the bits lost in
/// dividing and isolating them.
pub const WIDE: u32 = 1536;

/// The real coefficients of a polynomial, constant first; the last one is not 0.
pub type Coefficients = Vec<Ball<WIDE>>;

impl Eliminant {
    /// Returns the number of roots with multiplicity, a bound on the number of isolated solutions with multiplicity.
    #[must_use]
    pub fn count(&self) -> usize {
        let degree = |(factor, order): &(Coefficients, usize)| factor.len().saturating_sub(1) * order;
        self.factors.iter().map(degree).sum::<usize>() + self.at_pi
    }

    /// The eliminant by a polynomial over the integers.
    fn over_integers(unknown: usize, polynomial: &Univariate<Integer>, at_pi: usize) -> Option<Self> {
        let factors = polynomial.square_free_decomposition().into_iter();
        let factors = factors.map(|(factor, order)| Some((in_balls(&factor)?, order))).collect::<Option<_>>()?;
        Some(Self { unknown, factors, at_pi })
    }
}

/// Coefficients in balls.
pub(super) fn in_balls<const BITS: u32>(polynomial: &Univariate<Integer>) -> Option<Vec<Ball<BITS>>> {
    polynomial.coefficients().iter().map(|c| Ball::from_rational(&Rational::from(c))).collect()
}

/// A cut and the unknown that it hides, with the shape of its determinant modulo a prime.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    pub(super) cut: Cut,
    pub(super) hidden: Hidden,
    /// Index of the remaining unknown among the six.
    pub unknown: usize,
    /// The number of roots other than those of `1 + x^2`, modulo the prime.
    pub count: usize,
    distinct: usize,
}

/// All ways to eliminate a loop whose determinant does not vanish modulo the prime, best first: those with the fewest
/// roots, and of these the ones with the most distinct roots. A filter; nothing rests on it.
#[must_use]
pub fn ways<F: Field + Domain>(closed: &ClosedLoop<F>) -> Vec<Way> {
    let mut ways: Vec<Way> = Cut::hidings()
        .filter_map(|(cut, hidden, unknown)| {
            let found = closure_polynomial(closed, cut, hidden)?;
            let count = DEGREE - 2 * found.spurious;
            let distinct = found.cofactor.square_free_part().degree().unwrap_or(0);
            Some(Way { cut, hidden, unknown, count, distinct })
        })
        .collect();
    sort::by_key(&mut ways, |way| (way.count, Reverse(way.distinct)));
    ways
}

/// Largest number of bits of a number in a loop for which the relations of its ring over the rationals stay short.
const SHORT: u32 = 64;

/// Returns whether all numbers of a loop are short.
fn is_short(closed: &ClosedLoop<Rational>) -> bool {
    let bits = |x: &Rational| x.numer().significant_bits().max(x.denom().significant_bits());
    let numbers = closed.constants.iter().flat_map(|g| g.rotation.iter().flatten().chain(&g.translation));
    numbers.map(bits).max() <= Some(SHORT)
}

/// Words of all numbers of reduced relations after which a ring over the rationals is given up.
const MOST_WORDS: u64 = 1_000_000;

/// Returns the ring over the rationals that a plan leads to; `None` where its relations become too long.
fn ring(plan: &Plan, closed: &ClosedLoop<Rational>) -> Option<CoordinateRing<Rational>> {
    let mut words = 0;
    let length = |x: &Rational| u64::from(x.numer().significant_bits() + x.denom().significant_bits()) / 64;
    plan.ring_within(closed, |row| {
        words += row.iter().map(length).sum::<u64>();
        words < MOST_WORDS
    })
}

/// Returns whether a loop is proved to have no solution, complex ones included: 1 is a combination of its closure equations over
/// the rationals. `false` where no such combination is found, and where numbers are long.
///
/// The plan is made for the loop modulo a prime and says which combinations to form; each of them is formed again over the
/// rationals.
#[must_use]
pub fn has_no_solution(closed: &ClosedLoop<Rational>, plan: &Plan) -> bool {
    plan.count() == 0 && is_short(closed) && ring(plan, closed).is_some()
}

/// The eliminant of an unknown as the characteristic polynomial of its values in the ring of the closure equations over the
/// rationals, for loops whose determinants vanish: its roots have the multiplicities of the solutions. `None` where
/// solutions form families, and where numbers are long.
///
/// The relations that lead to the ring are found modulo the prime. Each of them holds over the rationals as formed there, so
/// that the ring has no larger dimension, and every solution is an eigenvector.
#[must_use]
pub fn eliminant_by_ring(
    closed: &ClosedLoop<Rational>,
    modular: &ClosedLoop<Drawn>,
    unknown: usize,
) -> Option<Eliminant> {
    if !is_short(closed) {
        return None;
    }
    let cut = Cut { rotation: unknown, reversed: false };
    let ring = ring(&Plan::of(&cut.of(modular))?, &cut.of(closed))?;
    let (rotated, _) = ring.view();
    let pencil = ring.tangent_pencil((6 - rotated) % 6);
    let count = pencil[0].len();
    let polynomial = Univariate::new(modular_determinant(&pencil).primitive_integers());
    Eliminant::over_integers(unknown, &polynomial, count - polynomial.degree()?)
}

/// Returns the eliminant that a way leads to; `None` where its determinant vanishes identically.
#[must_use]
pub fn eliminant(closed: &ClosedLoop<Rational>, way: &Way) -> Option<Eliminant> {
    let (polynomial, at_pi) = polynomial(closed, way)?;
    Eliminant::over_integers(way.unknown, &polynomial, at_pi)
}

/// The number of roots of the eliminant that a way leads to.
#[must_use]
pub fn count(closed: &ClosedLoop<Rational>, way: &Way) -> Option<usize> {
    let (polynomial, at_pi) = polynomial(closed, way)?;
    Some(polynomial.degree()? + at_pi)
}

/// The pencil that a way leads to, in the tangent of half the hidden unknown of its cut; `None` where the cut is degenerate.
pub(super) fn pencil_of<F: Field>(closed: &ClosedLoop<F>, way: &Way) -> Option<Pencil<F>> {
    let view = way.cut.of(closed);
    let rows = bilinear(&before_second_link(&half_angle_form(&view)?, &view.constants[1]), &view);
    Some(pencil(&rows, way.hidden))
}

/// Returns the coefficients of a determinant in the unknown of the loop, which is the negative of the unknown of a reversed cut.
pub(super) fn in_unknown<R: Ring>(way: &Way, coefficients: &[R]) -> Vec<R> {
    let sign = |(k, c): (usize, &R)| if way.cut.reversed && k % 2 == 1 { c.neg() } else { c.clone() };
    coefficients.iter().enumerate().map(sign).collect()
}

/// The polynomial of an eliminant and the order of its root at infinity.
fn polynomial(closed: &ClosedLoop<Rational>, way: &Way) -> Option<(Univariate<Integer>, usize)> {
    let determinant = modular_determinant(&pencil_of(closed, way)?.coefficients);
    let signed = in_unknown(way, determinant.coefficients());
    let mut polynomial = Univariate::new(Univariate::<Rational>::new(signed).primitive_integers());
    let at_pi = DEGREE - polynomial.degree()?;
    let circle = Univariate::circle();
    while let Some(quotient) = polynomial.quotient(&circle) {
        polynomial = quotient;
    }
    Some((polynomial, at_pi))
}
