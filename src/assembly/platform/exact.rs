//! Adds poses that are known as algebraic numbers to the list.

use super::prepared::Frame;
use super::search::{Found, ROUNDED};
use crate::algebra::long_float::LongFloat;
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::multiple_pose::ExactPoses;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::solve::polynomial_roots::polynomial_roots;
use crate::solve::pose::Eight;
use crate::solve::scalar::{Number, narrowed};
use num_complex::Complex;
use rug::{Integer, Rational};

type Long = Complex<LongFloat>;

/// Bits to which a real root is isolated.
const BITS: u32 = 340;
/// Error bound of a root: more than 300 of its bits are right.
const ROOT_ERROR: f64 = 1e-90;
/// Imaginary parts below this, relative to the root, belong to real roots.
const REAL: f64 = 1e-60;
/// Maximum magnification of the root's error in a coordinate; the result is far below the last digit of an f64.
const MOST_MAGNIFIED: f64 = 1e60;

/// Returns the real roots of a polynomial and one of each conjugate pair; `None` if the isolation does not converge.
fn roots(polynomial: &Univariate<Rational>) -> Option<Vec<(Long, bool)>> {
    let width = Rational::from((1, Integer::from(1) << BITS));
    let mut found = Vec::new();
    for mut root in polynomial.real_roots() {
        root.refine(&width);
        let (low, high) = root.bounds();
        let middle = (low + high) / Rational::from(2);
        found.push((Complex::new(LongFloat::from_rational(&middle)?, LongFloat::zero()), true));
    }
    let complex = polynomial.degree()? - found.len();
    if complex > 0 {
        let long = polynomial.map(LongFloat::from_rational)?;
        let upper = polynomial_roots(&long)?.into_iter().filter(|z| z.im.to_f64() > REAL * z.size());
        let upper: Vec<Long> = upper.collect();
        if 2 * upper.len() != complex || upper.iter().any(|z| !is_near_a_root(&long, z)) {
            return None;
        }
        found.extend(upper.into_iter().map(|z| (z, false)));
    }
    Some(found)
}

/// Returns whether a root lies very near: there is always one within the degree times `|f / f'|`.
fn is_near_a_root(polynomial: &Univariate<LongFloat>, at: &Long) -> bool {
    let (mut value, mut slope) = (Long::zero(), Long::zero());
    for c in polynomial.coefficients().iter().rev() {
        slope = slope.mul(at).add(&value);
        value = value.mul(at).add(&Long::from_real(*c));
    }
    let degree = polynomial.coefficients().len() as f64;
    degree * value.bound() < ROOT_ERROR * slope.size() * at.size().max(f64::MIN_POSITIVE)
}

/// Returns the value of a number at a root; `None` if it is too sensitive to the root.
fn value(number: &Algebraic, root: &Long) -> Option<Long> {
    let (mut sum, mut slope, size) = (Long::zero(), 0.0_f64, root.bound().max(1.0));
    for c in number.coefficients().iter().rev() {
        slope = slope * size + sum.bound();
        sum = sum.mul(root).add(&Long::from_real(LongFloat::from_rational(c)?));
        slope = slope.max(sum.bound());
    }
    (slope * size < MOST_MAGNIFIED).then_some(sum)
}

/// Returns the modes of conjugate poses.
pub fn exact_modes(poses: &ExactPoses, frame: &Frame) -> Option<Vec<Found>> {
    let mode = |(root, real): (Long, bool)| {
        let [w, i, j, k] = poses.quaternion.each_ref().map(|c| value(c, &root));
        let [x, y, z] = poses.position.each_ref().map(|c| value(c, &root));
        let study = study(&Quaternion { scalar: w?, vector: [i?, j?, k?] }, &[x?, y?, z?], frame);
        let reach = study.iter().map(|z| z.norm()).fold(1.0, f64::max);
        reach.is_finite().then(|| Found::exact(study, real, ROUNDED * reach, poses.multiplicity))
    };
    roots(&poses.polynomial)?.into_iter().map(mode).collect()
}

/// Returns Study's parameters in the frame of polishing, with x of hermitian norm 1.
fn study(x: &Quaternion<Long>, position: &[Long; 3], frame: &Frame) -> Eight<Complex<f64>> {
    let square: f64 = x.vector.iter().chain([&x.scalar]).map(|c| c.square_size()).sum();
    let scale = LongFloat::from(1.0 / square.sqrt().max(f64::MIN_POSITIVE));
    let x = Quaternion { scalar: x.scalar.times(scale), vector: x.vector.map(|c| c.times(scale)) };
    let pure = |vector: [Long; 3]| Quaternion { scalar: Long::zero(), vector };
    let origin = |k: usize| frame.origins[k].map(|c| Long::from_real(LongFloat::from(c)));
    let base = origin(0);
    let moved = std::array::from_fn(|k| position[k].sub(&base[k]));
    let (before, behind) = (pure(moved).mul(&x), x.mul(&pure(origin(1))));
    let unit = LongFloat::from(1.0 / frame.scale);
    let dual = |a: &Long, b: &Long| narrowed(a.add(b).times(unit));
    let [i, j, k] = x.vector.map(narrowed);
    let [u, v] = [&before.vector, &behind.vector];
    [
        narrowed(x.scalar),
        i,
        j,
        k,
        dual(&before.scalar, &behind.scalar),
        dual(&u[0], &v[0]),
        dual(&u[1], &v[1]),
        dual(&u[2], &v[2]),
    ]
}
