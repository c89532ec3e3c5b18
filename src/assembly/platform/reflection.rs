//! Poses mirrored in the base plane, if base and moving platform are both plane.
//!
//! Let S_a be the reflection in the plane of the base and S_b the one in the plane of the moving platform. Then `S_a g S_b`
//! is a motion that takes the moving platform to the mirror image of its pose under g, with the same leg lengths.

use super::mode::PlatformMode;
use super::prepared::{centroid, size};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::platform::Platform;
use num_complex::Complex;

/// Points this near to a plane, in units of the size of the platform, lie in it.
const FLAT: f64 = 1e-13;
/// Poses this near are one.
const SAME: f64 = 1e-6;

/// A plane, `normal.p = offset` with a normal of length 1.
#[derive(Clone, Copy, Debug)]
struct Plane {
    normal: Vector<f64>,
    offset: f64,
}

/// The planes of base and moving platform.
#[derive(Clone, Copy, Debug)]
pub struct Reflection {
    base: Plane,
    plate: Plane,
    unit: f64,
}

/// Returns the plane of six points, if there is exactly one.
fn plane(points: &[Vector<f64>; 6], unit: f64) -> Option<Plane> {
    let centre = centroid(points);
    let local = points.map(|p| -> Vector<f64> { std::array::from_fn(|k| p[k] - centre[k]) });
    let mut best: (f64, Vector<f64>) = (0.0, [0.0; 3]);
    for i in 0..6 {
        for j in 0..i {
            let normal = cross(&local[i], &local[j]);
            let square = dot(&normal, &normal);
            if square > best.0 {
                best = (square, normal);
            }
        }
    }
    let length = best.0.sqrt();
    if !(length > FLAT * unit * unit) {
        return None;
    }
    let normal = best.1.map(|x| x / length);
    let reach = points.iter().flatten().fold(unit, |reach: f64, x| reach.max(x.abs()));
    let flat = local.iter().all(|p| dot(&normal, p).abs() < FLAT * reach);
    flat.then(|| Plane { normal, offset: dot(&normal, &centre) })
}

impl Reflection {
    /// Returns the reflection of a platform, if base and moving platform are plane.
    pub fn of(platform: &Platform<f64>) -> Option<Self> {
        let unit = size(platform);
        Some(Self { base: plane(&platform.base, unit)?, plate: plane(&platform.plate, unit)?, unit })
    }

    /// Returns rotation and translation of the mirrored pose.
    fn image(&self, mode: &PlatformMode) -> ([Complex<f64>; 4], Vector<Complex<f64>>) {
        let pure = |v: &Vector<f64>, factor: f64| Quaternion {
            scalar: Complex::from(0.0),
            vector: v.map(|x| Complex::from(factor * x)),
        };
        let [w, x, y, z] = mode.quaternion;
        let rotation = Quaternion { scalar: w, vector: [x, y, z] };
        let mirrored = pure(&self.base.normal, 1.0).mul(&rotation).mul(&pure(&self.plate.normal, 1.0));
        // p' = S_a (p + R t_b) + t_a with t = 2 offset normal.
        let shift = rotation.mul(&pure(&self.plate.normal, 2.0 * self.plate.offset)).mul(&rotation.conjugate());
        let norm = rotation.norm();
        let moved: Vector<Complex<f64>> = std::array::from_fn(|k| mode.position[k] + shift.vector[k] / norm);
        let height: Complex<f64> = moved.iter().zip(&self.base.normal).map(|(p, n)| p * n).sum();
        let image = std::array::from_fn(|k| moved[k] - 2.0 * (height - self.base.offset) * self.base.normal[k]);
        let [x, y, z] = mirrored.vector;
        ([mirrored.scalar, x, y, z], image)
    }

    /// Records for every mode which one is its mirror image.
    pub fn mark(&self, modes: &mut [PlatformMode]) {
        for k in 0..modes.len() {
            if modes[k].mirror.is_some() {
                continue;
            }
            let (quaternion, position) = self.image(&modes[k]);
            let distance = |mode: &PlatformMode| {
                let product: Complex<f64> = quaternion.iter().zip(&mode.quaternion).map(|(a, b)| a * b.conj()).sum();
                let reach = position.iter().map(|p| p.norm()).fold(self.unit, f64::max);
                let moved = position.iter().zip(&mode.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
                (1.0 - product.norm_sqr()).max(moved / reach)
            };
            let image = (k..modes.len()).filter(|&j| modes[j].real == modes[k].real && modes[j].mirror.is_none());
            let nearest = image.map(|j| (j, distance(&modes[j]))).min_by(|a, b| a.1.total_cmp(&b.1));
            if let Some((j, distance)) = nearest
                && distance < SAME
            {
                modes[k].mirror = Some(j);
                modes[j].mirror = Some(k);
            }
        }
    }
}
