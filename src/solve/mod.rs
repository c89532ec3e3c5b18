//! Pencil to roots, in f64: eigenvalues, null vectors, back-substitution, polish.

pub mod back_substitution;
pub mod biquadratic;
pub mod crowded_roots;
pub mod curve;
pub mod decoupled;
pub mod dense;
pub mod eigen;
pub mod explorer;
pub mod francis;
pub mod hessenberg;
pub mod kernel;
pub mod lane_closure;
pub mod lanes;
pub mod newton;
pub mod paths;
pub mod plane_curve;
pub mod polynomial_roots;
pub mod pose;
pub mod scalar;
pub mod self_motion;
pub mod separated;
pub mod simultaneous;
pub mod singular;
pub mod spectrum;
pub mod walk;
