//! The cycles of a linkage as polynomials over the rationals.
//!
//! The unknowns are the cosine x and the sine y of every class but the first, which is at rest, with `x^2 + y^2 = 1`, and then the
//! slides.

use super::equations::Equations;
use super::isotropic::Isotropic;
use crate::algebra::groebner::Equation;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use num_complex::Complex;
use rug::Rational;

/// A complex number whose parts are polynomials.
pub(super) type Form = Complex<Equation>;

/// Returns the number of unknowns.
pub(super) fn unknowns<N>(equations: &Equations<N>) -> usize {
    2 * equations.classes.saturating_sub(1) + equations.slides.len()
}

/// Returns a number as one whose parts are polynomials.
pub(super) fn constant(z: &Gaussian) -> Form {
    let part = |q: &Rational| Equation::from_rational(q).unwrap_or_else(Equation::zero);
    Form { re: part(&z.re), im: part(&z.im) }
}

/// Returns a power of the rotation of a class: `T_n(x) + i y U_(n-1)(x)`, in which y appears at most once. Class 0 is at rest.
pub(super) fn turned(class: usize, exponent: i32) -> Form {
    if class == 0 {
        return Form::one();
    }
    let (x, y) = (Equation::variable(2 * class - 2), Equation::variable(2 * class - 1));
    let two_x = x.add(&x);
    // T and U of degrees n - 1 and n - 2, n and n - 1.
    let (mut below, mut here) = ((Equation::one(), Equation::zero()), (x, Equation::one()));
    if exponent == 0 {
        here = below.clone();
    }
    for _ in 1..exponent.unsigned_abs() {
        let next = (two_x.mul(&here.0).sub(&below.0), two_x.mul(&here.1).sub(&below.1));
        below = std::mem::replace(&mut here, next);
    }
    let im = here.1.mul(&y);
    Form { re: here.0, im: if exponent < 0 { im.neg() } else { im } }
}

/// Returns the displacement along a slide.
pub(super) fn way(classes: usize, slide: usize) -> Form {
    Form { re: Equation::variable(2 * (classes - 1) + slide), im: Equation::zero() }
}

/// Returns the sums of the cycles, which vanish where they close.
pub(super) fn cycle_forms(equations: &Equations<Isotropic<Gaussian>>) -> Vec<Form> {
    let sum = |(k, cycle): (usize, &Vec<Isotropic<Gaussian>>)| {
        let links = cycle.iter().enumerate().map(|(class, c)| constant(&c.z).mul(&turned(class, 1)));
        let slides = equations.slides.iter().enumerate().map(|(q, slide)| {
            constant(&slide.coefficients[k].z).mul(&turned(slide.class, 1)).mul(&way(equations.classes, q))
        });
        links.chain(slides).fold(Form::zero(), |sum, term| sum.add(&term))
    };
    equations.cycles.iter().enumerate().map(sum).collect()
}

/// Returns `x^2 + y^2 - 1` for every class but the first.
pub(super) fn circles(classes: usize) -> impl Iterator<Item = Equation> {
    (1..classes).map(|class| {
        let Form { re, im } = turned(class, 1);
        re.mul(&re).add(&im.mul(&im)).sub(&Equation::one())
    })
}
