//! Stewart platforms over any ring: six legs between points of a base and points of a plate.

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
