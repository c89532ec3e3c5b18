//! The closure polynomial of a triangle hung on six legs, exactly.

use super::circle::{Pairs, Triangle, pairs};
use super::eliminant::Eliminant;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::resultant::resultant;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, dot};
use crate::kinematics::platform::Platform;
use rug::{Integer, Rational};

/// The polynomial of a coordinate of one corner of the triangle.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TrianglePolynomial {
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Vec<Integer>,
    /// The pairs of legs that meet.
    pub pairs: Pairs,
    /// The direction of its variable: `direction.P` for the corner P of the first pair, in the frame of the body whose points do
    /// not coincide.
    pub direction: [Integer; 3],
    /// The number of poses that belong to a root: 2 where the triangle has a mirror image in the plane of the other body.
    pub per_root: usize,
}

impl TrianglePolynomial {
    /// `N k` at Study's parameters (x, y), for the point in which the first pair meets; N = x.x, k the variable.
    pub fn scaled_coordinate<R: Ring>(&self, x: &Quaternion<R>, y: &Quaternion<R>, point: &Vector<R>) -> R {
        let point = Quaternion { scalar: R::zero(), vector: point.clone() };
        // The corner as seen from the other body: p + R b, or R^T (a - p).
        let corner = if self.pairs.at_base {
            let lever = point.mul(x);
            let apart = Quaternion {
                scalar: lever.scalar.sub(&y.scalar),
                vector: std::array::from_fn(|k| lever.vector[k].sub(&y.vector[k])),
            };
            x.conjugate().mul(&apart)
        } else {
            let lever = x.mul(&point);
            let sum = Quaternion {
                scalar: lever.scalar.add(&y.scalar),
                vector: std::array::from_fn(|k| lever.vector[k].add(&y.vector[k])),
            };
            sum.mul(&x.conjugate())
        };
        let direction = self.direction.each_ref().map(|g| R::from_rational(&Rational::from(g)));
        direction.iter().zip(&corner.vector).fold(R::zero(), |sum, (g, c)| {
            let g = g.as_ref().map_or_else(R::zero, Clone::clone);
            sum.add(&g.mul(c))
        })
    }
}

/// Multiples of the second coordinate added to the first one where that does not tell all solutions apart.
const SLOPES: [i32; 3] = [0, 1, -2];

/// The polynomial of a platform whose legs meet in pairs, with legs of these squared lengths; `None` where they do not, or
/// where the roots are not simple or not as many as there are poses: 16 in general, 8 pairs of mirror images where the
/// other body is plane.
#[must_use]
pub fn triangle_polynomial(
    platform: &Platform<Rational>,
    legs_squared: &[Rational; 6],
    poses: usize,
) -> Option<TrianglePolynomial> {
    let pairs = pairs(platform)?;
    let triangle = Triangle::new(platform, legs_squared, &pairs)?;
    let circle = &triangle.circles[0];
    let [alpha, beta] = [Polynomial::<Rational>::variable(0), Polynomial::variable(1)];
    let over = |x: &Rational| Polynomial::constant(x.clone());
    let form = Eliminant::new(&triangle, 0).map(over).value(&[Polynomial::one(), alpha.clone(), beta.clone()]);
    let squares = circle.squares.each_ref().map(over);
    let outside = alpha.mul(&alpha).mul(&squares[0]).sub(&over(&circle.radius_square));
    // Modulo the circle, beta^2 v.v = r^2 - alpha^2 u.u: an even and an odd part.
    let square = outside.scale(&-Rational::from(circle.squares[1].recip_ref()));
    let mut parts = [Polynomial::zero(), Polynomial::zero()];
    for (power, coefficient) in form.coefficients_in(1).iter().enumerate() {
        let raised = (0..power / 2).fold(coefficient.clone(), |product, _| product.mul(&square));
        parts[power % 2] = parts[power % 2].add(&raised);
    }
    let mirrored = parts[1].is_zero();
    let (form, conic) = (parts[0].add(&parts[1].mul(&beta)), outside.add(&beta.mul(&beta).mul(&squares[1])));
    for slope in SLOPES {
        let slope = Rational::from(slope);
        let eliminated = if mirrored && slope == 0 {
            parts[0].primitive().0
        } else {
            let turned = alpha.sub(&beta.scale(&slope));
            let moved = |f: &Polynomial<Rational>| f.substitute(0, &turned).primitive().0;
            resultant(&moved(&form), &moved(&conic), 1)
        };
        let per_root = if mirrored && slope == 0 { 2 } else { 1 };
        let direction = direction(&triangle, &slope);
        let coefficients = in_coordinate(&eliminated, &direction)?;
        let candidate = TrianglePolynomial { coefficients, pairs, direction: direction.integers, per_root };
        if is_complete(&candidate, poses) {
            return Some(candidate);
        }
    }
    None
}

/// Whether all roots are simple, and as many as there should be.
fn is_complete(candidate: &TrianglePolynomial, poses: usize) -> bool {
    let polynomial = Univariate::new(candidate.coefficients.clone());
    let Some(degree) = polynomial.degree().filter(|degree| *degree > 0) else { return false };
    degree * candidate.per_root == poses && polynomial.square_free_decomposition().iter().all(|(_, k)| *k == 1)
}

/// The coordinate `alpha + slope beta` as `(direction.P - shift)/factor`.
struct Direction {
    integers: [Integer; 3],
    shift: Rational,
    factor: Rational,
}

fn direction(triangle: &Triangle<Rational>, slope: &Rational) -> Direction {
    let circle = &triangle.circles[0];
    let weights: Vector<Rational> = std::array::from_fn(|k| {
        let [u, v] = [0, 1].map(|arm| Rational::from(&circle.arms[arm][k] / &circle.squares[arm]));
        u + slope.clone() * v
    });
    let denominator = weights.iter().fold(Integer::from(1), |lcm, w| lcm.lcm(w.denom()));
    let scaled = weights.each_ref().map(|w| Rational::from(w * &denominator).numer().clone());
    let content = scaled.iter().fold(Integer::new(), Integer::gcd);
    let integers = scaled.map(|w| w.div_exact(&content));
    let shift = dot(&integers.each_ref().map(Rational::from), &circle.centre);
    Direction { integers, shift, factor: Rational::from((denominator, content)) }
}

/// The polynomial with `(k - shift)/factor` for its variable: integers, the last one positive.
fn in_coordinate(polynomial: &Polynomial<Int>, direction: &Direction) -> Option<Vec<Integer>> {
    let image = polynomial.map(|c| Some(Rational::from(c.to_integer())))?.to_univariate(0)?;
    let inner = Univariate::new(vec![
        Rational::from(-&direction.shift) / &direction.factor,
        Rational::from(direction.factor.recip_ref()),
    ]);
    let composed =
        image.coefficients().iter().rev().fold(Univariate::zero(), |sum: Univariate<Rational>, c| {
            sum.mul(&inner).add(&Univariate::constant(c.clone()))
        });
    Some(composed.primitive_integers())
}
