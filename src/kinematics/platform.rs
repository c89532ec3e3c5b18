//! Stewart platforms over any ring: six legs between points of a base and points of a plate.

use super::dual_quaternion::Quaternion;
use super::motion::{Motion, Vector, dot};
use crate::algebra::ring::Ring;

/// Six legs, leg i from point `base[i]` of the base to point `plate[i]` of the moving plate, each in its own frame.
///
/// # Units
/// The unit of length of the mechanism.
#[derive(Clone, Debug, PartialEq)]
pub struct Platform<R> {
    /// The points `a_i`, in the frame of the base.
    pub base: [Vector<R>; 6],
    /// The points `b_i`, in the frame of the plate.
    pub plate: [Vector<R>; 6],
}

impl<R: Ring> Platform<R> {
    /// The legs as vectors in the frame of the base, `p + R b_i - a_i`, at a pose of the plate.
    #[must_use]
    pub fn legs(&self, pose: &Motion<R>) -> [Vector<R>; 6] {
        std::array::from_fn(|i| {
            let end = pose.apply(&self.plate[i]);
            std::array::from_fn(|k| end[k].sub(&self.base[i][k]))
        })
    }

    /// The squared lengths of the legs at a pose of the plate.
    #[must_use]
    pub fn legs_squared(&self, pose: &Motion<R>) -> [R; 6] {
        self.legs(pose).map(|leg| dot(&leg, &leg))
    }

    /// Maps the platform to another ring; `None` as soon as one coordinate has no image.
    pub fn map<S>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Platform<S>> {
        let point = |v: &Vector<R>| -> Option<Vector<S>> { Some([image(&v[0])?, image(&v[1])?, image(&v[2])?]) };
        let points = |[a, b, c, d, e, f]: &[Vector<R>; 6]| -> Option<[Vector<S>; 6]> {
            Some([point(a)?, point(b)?, point(c)?, point(d)?, point(e)?, point(f)?])
        };
        Some(Platform { base: points(&self.base)?, plate: points(&self.plate)? })
    }
}

impl Platform<f64> {
    /// Returns the distance of two poses of the plate: the root mean square of the ways of its six points. It depends neither on the
    /// frame of the plate nor on a choice of units for angles beside lengths.
    #[must_use]
    pub fn distance(&self, one: &Motion<f64>, other: &Motion<f64>) -> f64 {
        let squares = self.plate.iter().map(|point| {
            let (from, to) = (one.apply(point), other.apply(point));
            (0..3).map(|k| (to[k] - from[k]).powi(2)).sum::<f64>()
        });
        (squares.sum::<f64>() / 6.0).sqrt()
    }

    /// Returns the size of the plate: the root mean square of the distances of its points from their centroid. A turn by a small
    /// angle about an axis through the centroid moves the points by at most that angle times the size.
    #[must_use]
    pub fn plate_size(&self) -> f64 {
        let centroid: Vector<f64> = std::array::from_fn(|k| self.plate.iter().map(|point| point[k] / 6.0).sum());
        let square = |point: &Vector<f64>| (0..3).map(|k| (point[k] - centroid[k]).powi(2)).sum::<f64>();
        (self.plate.iter().map(square).sum::<f64>() / 6.0).sqrt()
    }
}

/// Returns the pose of the plate from a quaternion `w, x, y, z` of any norm and a position; `None` for other numbers of values and
/// for the quaternion 0.
#[must_use]
pub fn pose_of(q: &[f64]) -> Option<Motion<f64>> {
    let &[w, x, y, z, a, b, c] = q else { return None };
    let norm = w * w + x * x + y * y + z * z;
    if !norm.is_normal() {
        return None;
    }
    let rotation = Quaternion { scalar: w, vector: [x, y, z] }.scaled_rotation();
    Some(Motion { rotation: rotation.map(|row| row.map(|x| x / norm)), translation: [a, b, c] })
}
