//! The poses of a platform at the real roots of its closure polynomial, to the last digit.

use super::polynomial::{ClosurePolynomial, Root};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::assembly::platform::PlatformMode;
use crate::closure::study::{Leg, scalar};
use crate::elimination::platform_polynomial::PlatformPolynomial;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::platform::Platform;
use crate::mechanism::platform_modes;
use crate::solve::dense::{inverse, times};
use crate::solve::pose::{Eight, equations, patch};
use rug::{Float, Rational};

/// A pose at a root.
#[derive(Clone, Debug, PartialEq)]
pub struct RootPose {
    /// The rotation (w, x, y, z), of norm 1, its first nonzero part positive.
    pub quaternion: [f64; 4],
    /// The position, in the unit of the mechanism.
    pub position: [f64; 3],
}

/// Maximum number of Newton steps with exact residuals and a fixed derivative; each brings about twelve digits.
const MOST_STEPS: usize = 12;
/// A step below this size, for x of norm 1 and lengths about 1, is the last.
const SETTLED: f64 = 1e-30;
/// Precision in bits of the division by the norm of a quaternion.
const BITS: u32 = 160;
/// Distance of a pose's coordinate from the root to which it belongs, relative to 1 + |k|.
const NEAR: f64 = 1e-9;
/// Real parts of quaternions below this are zero.
const ZERO: f64 = 1e-15;

/// A dual quaternion with rational parameters near those of a pose.
type Exact = Eight<Rational>;

/// Assigns the real poses of a platform to the roots of its polynomial. `coordinate` is the value of the variable at a pose as
/// a fraction. Returns a remark on roots without a pose.
pub(super) fn lift(
    platform: &Platform<Rational>,
    squares: &[Rational; 6],
    known: Option<&PlatformPolynomial>,
    polynomial: &mut ClosurePolynomial,
    coordinate: impl Fn(&Quaternion<Rational>, &Quaternion<Rational>) -> [Rational; 2],
) -> Vec<String> {
    let modes = platform_modes(platform, squares, known);
    let unit = unit(platform, squares);
    let small = |x: &Rational| Rational::from(x / &unit);
    let legs: [Leg<Rational>; 6] = std::array::from_fn(|i| {
        let square = small(&small(&squares[i]));
        Leg::new(&platform.base[i].each_ref().map(small), &platform.plate[i].each_ref().map(small), square)
    });
    let mut homeless = 0;
    for mode in modes.iter().filter(|mode| mode.real && mode.certificate.is_some()) {
        let start = start(mode, unit.to_f64());
        let point = refined(&legs, &start).unwrap_or_else(|| start.map(exact));
        let [w, i, j, k] = [0, 1, 2, 3].map(|index: usize| point[index].clone());
        let x = Quaternion { scalar: w, vector: [i, j, k] };
        let [w, i, j, k] = [4, 5, 6, 7].map(|index: usize| Rational::from(&point[index] * &unit));
        let y = Quaternion { scalar: w, vector: [i, j, k] };
        let [above, below] = coordinate(&x, &y);
        let value = if below == 0 { f64::INFINITY } else { nearest_f64(&(above / below)) };
        let distance = |root: &Root| (root.value - value).abs();
        let nearest = polynomial.roots.iter_mut().min_by(|a, b| distance(a).total_cmp(&distance(b)));
        match nearest.filter(|root| distance(root) < NEAR * (1.0 + value.abs())) {
            Some(root) => root.poses.push(pose(&x, &y)),
            None => homeless += 1,
        }
    }
    let mut complaints = Vec::new();
    if homeless > 0 {
        complaints.push(format!("{homeless} poses of the numeric solution belong to no root of the polynomial"));
    }
    let Some(known) = known else { return complaints };
    // It may be that neither of two poses at a real root is real: they share a real rotation, and their positions are complex.
    let is_complex = |root: &Root| {
        let proved = modes.iter().filter(|mode| !mode.real && mode.certificate.is_some());
        let values = proved.map(|mode| known.coordinate.at(&std::array::from_fn(|k| mode.study[k])));
        values.into_iter().any(|value| (value - root.value).norm() < NEAR * (1.0 + root.value.abs()))
    };
    let empty = polynomial.roots.iter().filter(|root| root.poses.is_empty() && !is_complex(root)).count();
    if empty > 0 {
        complaints.push(format!("no pose was found at {empty} of the real roots"));
    }
    complaints
}

fn exact(x: f64) -> Rational {
    Rational::from_f64(x).unwrap_or_default()
}

/// Returns a power of two near the largest length.
fn unit(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Rational {
    let points = platform.base.iter().chain(&platform.plate).flatten().map(|x| x.to_f64().abs());
    let largest = points.chain(squares.iter().map(|s| s.to_f64().abs().sqrt())).fold(0.0, f64::max);
    let exponent = largest.log2().ceil();
    if exponent.is_finite() { exact(exponent.exp2()) } else { Rational::from(1) }
}

/// Returns Study's parameters of a real mode, lengths over the unit.
fn start(mode: &PlatformMode, unit: f64) -> Eight<f64> {
    let [w, i, j, k] = mode.quaternion.map(|z| z.re);
    let x = Quaternion { scalar: w, vector: [i, j, k] };
    let y = Quaternion { scalar: 0.0, vector: mode.position.map(|z| z.re / unit) }.mul(&x);
    [w, i, j, k, y.scalar, y.vector[0], y.vector[1], y.vector[2]]
}

/// Returns the solution near a point, to far more digits than the point has; `None` if it is singular.
fn refined(legs: &[Leg<Rational>; 6], start: &Eight<f64>) -> Option<Exact> {
    let numbers = legs.each_ref().map(|leg| Leg {
        matrix: leg.matrix.each_ref().map(|row| row.each_ref().map(nearest_f64)),
        square: nearest_f64(&leg.square),
    });
    let patch = patch(start);
    let inverse = inverse(&equations(&numbers, start, &patch).jacobian)?;
    let mut point = start.map(exact);
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (x, y) = (std::array::from_fn(|k| point[k].clone()), std::array::from_fn(|k| point[4 + k].clone()));
        let mut values = [0.0; 8];
        for (value, leg) in values.iter_mut().zip(legs) {
            *value = 0.5 * leg.quadric(&x, &y, Ring::mul).to_f64();
        }
        values[6] = scalar(&x, &y).to_f64();
        let drift = |k: usize| Rational::from(&point[k] - &exact(start[k])) * exact(patch[k]);
        values[7] = (0..4).map(drift).sum::<Rational>().to_f64();
        let step = times(&inverse, &values);
        let size = step.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
        if !(size < 0.5 * before) {
            return None;
        }
        for (x, s) in point.iter_mut().zip(step) {
            *x -= exact(s);
        }
        if size < SETTLED {
            return Some(point);
        }
        before = size;
    }
    None
}

/// Returns the pose of Study's parameters, each number the nearest float.
fn pose(x: &Quaternion<Rational>, y: &Quaternion<Rational>) -> RootPose {
    let norm = x.norm();
    let length = Float::with_val(BITS, &norm).sqrt();
    let parts = [&x.scalar, &x.vector[0], &x.vector[1], &x.vector[2]];
    let mut quaternion = parts.map(|part| (Float::with_val(BITS, part) / &length).to_f64());
    for part in &mut quaternion {
        if part.abs() < ZERO {
            *part = 0.0;
        }
    }
    if quaternion.iter().find(|part| **part != 0.0).is_some_and(|part| *part < 0.0) {
        quaternion = quaternion.map(|part| 0.0 - part);
    }
    let position = y.mul(&x.conjugate()).vector.map(|part| nearest_f64(&(part / &norm)));
    RootPose { quaternion, position }
}
