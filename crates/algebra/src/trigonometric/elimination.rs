//! Eliminates an angle from two equations that are linear in its cosine and sine.

use super::{Pair, reduce};
use crate::polynomial::Polynomial;
use crate::ring::{Field, Ring};

/// The result for two equations `A c + B s + C = 0`, `A' c + B' s + C' = 0` in the cosine c and the sine s of an angle.
#[derive(Clone, Debug)]
pub struct AngleElimination<R> {
    /// `N1^2 + N2^2 - N3^2`, which vanishes if and only if the equations have a common solution on the circle
    /// `c^2 + s^2 = 1`, including its points at infinity.
    pub equation: Polynomial<R>,
    /// `N1 = B C' - B' C`
    pub cos: Polynomial<R>,
    /// `N2 = C A' - C' A`
    pub sin: Polynomial<R>,
    /// `N3 = A B' - A' B`: if it does not vanish, c and s are `N1/N3` and `N2/N3`. If all three vanish, the two
    /// equations are the same, and have two solutions.
    pub denominator: Polynomial<R>,
}

/// Eliminates an angle from two polynomials linear in its cosine and sine: Cramer's rule, and `cos^2 + sin^2 = 1`.
///
/// Four times the equation is, up to sign, the resultant of the two half-angle forms, without any power of `1 + t^2`.
///
/// `None` if one of the polynomials, in normal form, is not linear. The `others` are angles whose cosines and sines are
/// in the coefficients; the result is in normal form with respect to them.
///
/// # Panics
/// If a variable is in two of the angles.
///
/// # Source
/// \[Wittenburg2016\]
///
/// # Example
/// ```
/// use looproot_algebra::{polynomial::Polynomial, ring::Ring, trigonometric::{Pair, eliminate_angle}};
/// use rug::Rational;
///
/// // x = r cos, y = r sin
/// let v = |k| Polynomial::<Rational>::variable(k);
/// let (c, s, x, y, r) = (v(0), v(1), v(2), v(3), v(4));
/// let circle = eliminate_angle(&r.mul(&c).sub(&x), &r.mul(&s).sub(&y), Pair { cos: 0, sin: 1 }, &[]).unwrap();
/// assert_eq!(circle.equation, r.pow(2).mul(&x.pow(2).add(&y.pow(2)).sub(&r.pow(2))));
/// ```
#[must_use]
pub fn eliminate_angle<R: Ring>(
    f: &Polynomial<R>,
    g: &Polynomial<R>,
    angle: Pair,
    others: &[Pair],
) -> Option<AngleElimination<R>> {
    let mut pairs = others.to_vec();
    pairs.push(angle);
    let ([a, b, c], [d, e, h]) = (linear_parts(&reduce(f, &pairs), angle)?, linear_parts(&reduce(g, &pairs), angle)?);
    let minor = |x: &Polynomial<R>, y: &Polynomial<R>, z: &Polynomial<R>, w: &Polynomial<R>| {
        reduce(&x.mul(y).sub(&z.mul(w)), others)
    };
    let (cos, sin, denominator) = (minor(&b, &h, &e, &c), minor(&c, &d, &h, &a), minor(&a, &e, &d, &b));
    let equation = cos.mul(&cos).add(&sin.mul(&sin)).sub(&denominator.mul(&denominator));
    Some(AngleElimination { equation: reduce(&equation, others), cos, sin, denominator })
}

/// Returns the coefficients of cosine, sine and 1.
fn linear_parts<R: Ring>(f: &Polynomial<R>, angle: Pair) -> Option<[Polynomial<R>; 3]> {
    let mut parts = [const { Vec::new() }; 3];
    for (mut exponents, c) in f.terms() {
        let mut take = |variable: usize| exponents.get_mut(variable).map_or(0, std::mem::take);
        let part = match (take(angle.cos), take(angle.sin)) {
            (1, 0) => 0,
            (0, 1) => 1,
            (0, 0) => 2,
            _ => return None,
        };
        parts[part].push((exponents, c.clone()));
    }
    Some(parts.map(Polynomial::from_terms))
}

impl<R: Ring> AngleElimination<R> {
    /// Returns cosine and sine for the given values of the other variables; `None` if the denominator vanishes, or a
    /// coefficient has no image.
    pub fn cos_sin_at<F: Field>(&self, image: impl Fn(&R) -> Option<F>, values: &[F]) -> Option<(F, F)> {
        let at = |f: &Polynomial<R>| f.map(&image).map(|f| f.evaluate(values));
        let inverse = at(&self.denominator)?.inverse()?;
        Some((at(&self.cos)?.mul(&inverse), at(&self.sin)?.mul(&inverse)))
    }
}
