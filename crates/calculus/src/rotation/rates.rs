//! Kinematic differential equations: the rates of the parameters of a rotation for its angular velocity.
//!
//! A rotation over dual numbers carries its rate; its angular velocity, in axes fixed in space, is twice the vector of
//! `q' q*`. The equation of each parametrisation is its conversion to the quaternion over dual numbers, so that there is no second
//! table of formulas.

use crate::motion::{Vector, cross, dot};
use crate::quaternion::Quaternion;
use crate::unit::{Root, Unit};
use looproot_algebra::dual::Dual;

/// Returns the angular velocity of a quaternion of any norm that carries its rate, in axes fixed in space; `None` if the norm
/// is no unit.
///
/// # Example
/// ```
/// use looproot_algebra::dual::Dual;
/// use looproot_calculus::quaternion::Quaternion;
/// use looproot_calculus::rotation::rates::angular_velocity;
/// use rug::Rational;
/// // The Rodrigues vector (1, 2, 3) t at t = 0 turns at twice that rate.
/// let dual = |b: i32| Dual { value: Rational::new(), epsilon: Rational::from(b) };
/// let q = Quaternion { scalar: Dual::constant(Rational::from(1)), vector: [dual(1), dual(2), dual(3)] };
/// assert_eq!(angular_velocity(&q).unwrap(), [2, 4, 6].map(Rational::from));
/// ```
///
/// # Source
/// \[Wittenburg2016, ch. 10\]
#[must_use]
pub fn angular_velocity<R: Unit>(q: &Quaternion<Dual<R>>) -> Option<Vector<R>> {
    let part = |of: fn(&Dual<R>) -> R| Quaternion { scalar: of(&q.scalar), vector: q.vector.each_ref().map(of) };
    let (value, rate) = (part(|d| d.value.clone()), part(|d| d.epsilon.clone()));
    let twice = value.norm().reciprocal().map(|inverse| inverse.add(&inverse))?;
    Some(rate.mul(&value.conjugate()).vector.map(|c| c.mul(&twice)))
}

/// Returns the rate of a quaternion for an angular velocity in axes fixed in space: `q' = omega q / 2`. Its norm is constant.
#[must_use]
pub fn quaternion_rate<R: Unit>(q: &Quaternion<R>, omega: &Vector<R>) -> Option<Quaternion<R>> {
    let half = R::from_integer(2).reciprocal()?;
    let turned = Quaternion { scalar: R::zero(), vector: omega.clone() }.mul(q);
    Some(Quaternion { scalar: turned.scalar.mul(&half), vector: turned.vector.map(|c| c.mul(&half)) })
}

/// Returns the rates of `N` parameters for an angular velocity, from the conversion of the parameters to the quaternion. `None` at
/// the critical places of the parametrisation, at which rates are infinite or free.
///
/// # Example
/// ```
/// use looproot_calculus::rotation::rates::parameter_rates;
/// use looproot_calculus::rotation::vectors::from_rodrigues;
/// // u' = (omega + omega x u + (omega . u) u)/2
/// let rates = parameter_rates(&[0.5, 0.0, 0.0], &[1.0, 0.0, 2.0], from_rodrigues).unwrap();
/// assert!(rates.iter().zip([0.625, 0.5, 1.0]).all(|(a, b)| (a - b).abs() < 1e-12));
/// ```
#[must_use]
pub fn parameter_rates<R: Unit>(
    parameters: &Vector<R>,
    omega: &Vector<R>,
    to_quaternion: impl Fn(&Vector<Dual<R>>) -> Quaternion<Dual<R>>,
) -> Option<Vector<R>> {
    let column = |k: usize| {
        let moved = std::array::from_fn(|j| Dual {
            value: parameters[j].clone(),
            epsilon: if j == k { R::one() } else { R::zero() },
        });
        angular_velocity(&to_quaternion(&moved))
    };
    let [a, b, c] = [column(0)?, column(1)?, column(2)?];
    let determinant = dot(&a, &cross(&b, &c));
    if determinant.is_small() {
        return None;
    }
    let inverse = determinant.reciprocal()?;
    let triple = |u: &Vector<R>, v: &Vector<R>| dot(omega, &cross(u, v)).mul(&inverse);
    Some([triple(&b, &c), triple(&c, &a), triple(&a, &b)])
}

/// Corrects a quaternion to norm 1 after a step of an integrator, to second order in the error and without a root:
/// `q (3 - q.q)/2`.
///
/// # Example
/// ```
/// use looproot_calculus::{quaternion::Quaternion, rotation::rates::corrected};
/// let q = corrected(&Quaternion { scalar: 1.0 + 1e-6, vector: [0.0; 3] }).unwrap();
/// assert!((q.norm() - 1.0).abs() < 1e-11);
/// ```
///
/// # Source
/// \[Wittenburg2016, 10.9\]: a correction keeps Euler-Rodrigues parameters on the unit sphere.
#[must_use]
pub fn corrected<R: Root>(q: &Quaternion<R>) -> Option<Quaternion<R>> {
    let factor = R::from_integer(3).sub(&q.norm()).over(&R::from_integer(2))?;
    Some(Quaternion { scalar: q.scalar.mul(&factor), vector: q.vector.each_ref().map(|c| c.mul(&factor)) })
}
