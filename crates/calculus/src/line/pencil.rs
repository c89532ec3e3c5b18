//! The lines of a linear system of complexes: transversals of given lines, directrices of a congruence.
//!
//! A line is a complex that is in involution with itself. In a pencil of complexes this is one quadratic equation.

use super::complex::Complex;
use super::pluecker::Line;
use looproot_algebra::ring::Ring;

/// Returns twice the quadratic form `a . b` on a basis of a system of complexes: a symmetric matrix whose entry (i, j) is the
/// Klein form of two members.
#[must_use]
pub fn klein_form<R: Ring>(basis: &[Complex<R>]) -> Vec<Vec<R>> {
    basis.iter().map(|one| basis.iter().map(|two| one.with(two)).collect()).collect()
}

/// Returns the member `s one + t two` of a pencil as a line: the axis of rotation of a special complex.
#[must_use]
pub fn member<R: Ring>(one: &Complex<R>, two: &Complex<R>, s: &R, t: &R) -> Line<R> {
    let sum = |x: &[R; 3], y: &[R; 3]| std::array::from_fn(|i| x[i].mul(s).add(&y[i].mul(t)));
    Line { direction: sum(&one.a, &two.a), moment: sum(&one.b, &two.b) }
}

/// Returns the coefficients of `s^2`, `2 s t` and `t^2` in twice the form `a . b` of the pencil.
///
/// # Example
/// ```
/// use looproot_calculus::line::{complex::containing, pencil::quadratic, pluecker::Line};
/// use rug::Rational;
/// let line = |p: [i32; 3], q: [i32; 3]| Line::through(&p.map(Rational::from), &q.map(Rational::from));
/// let lines = [
///     line([0, 0, 0], [1, 0, 0]), line([0, 0, 1], [0, 1, 1]), line([1, 1, 0], [1, 1, 1]), line([2, -1, 0], [3, -1, 1]),
/// ];
/// let basis = containing(&lines);
/// let [a, b, c] = quadratic(&basis[0], &basis[1]);
/// // Four lines in general have two transversals: here the discriminant is positive, and they are real.
/// assert!(Rational::from(&b * &b) - a * c > 0);
/// ```
///
/// # Source
/// \[Wittenburg2016, 2.5\]
#[must_use]
pub fn quadratic<R: Ring>(one: &Complex<R>, two: &Complex<R>) -> [R; 3] {
    [one.with(one), one.with(two), two.with(two)]
}
