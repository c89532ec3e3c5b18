//! Instantaneous motion in the plane: pole, inflection circle, curvature of paths, stationary curvature.

pub mod plane;
