//! Self-motions as answers: sets of solutions of dimension 1 and more.

/// Solutions that form a curve or more.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// Its dimension, at least 1.
    pub dimension: usize,
    /// Which joint variables move along it, counted from 0 in joint order; none where that is not known.
    pub moving: Vec<usize>,
    /// How far it stays from the pose that was asked for; 0 where it reaches it exactly.
    pub distance: f64,
    /// A whole configuration of it, within the limits if it has one there; of a platform the quaternion `w, x, y, z` and
    /// the position `x, y, z`.
    pub sample: Vec<f64>,
    /// More of its configurations, of a curve in their order along it.
    pub samples: Vec<Vec<f64>>,
}
