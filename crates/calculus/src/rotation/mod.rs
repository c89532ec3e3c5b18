//! Rotations about a fixed point: ten parametrisations, with every branch and every critical place.
//!
//! The quaternion, up to a factor, is the hub: every parametrisation has a conversion to it and one back. At a critical place of
//! a parametrisation, the conversion back returns the family of values that belong to the rotation.
//!
//! | parametrisation | functions | critical |
//! |---|---|---|
//! | direction cosines, rotation tensor | [`matrix::matrix`], [`matrix::from_matrix`] | nowhere |
//! | Euler-Rodrigues parameters | [`Quaternion`](crate::quaternion::Quaternion), [`vectors::unit`] | nowhere, two for a rotation |
//! | Euler angles, Bryan angles, any order of axes | [`euler::Order`] | middle angle 0 or pi, or +-pi/2 |
//! | axis and angle, Euler vector | [`vectors::axis_angle`], [`vectors::axis_turn`], [`vectors::euler_vectors`] | identity, two at pi |
//! | Rodrigues vector | [`vectors::rodrigues`] | infinite at pi |
//! | Wiener vector | [`vectors::wiener`] | two, one of them infinite at the identity |
//! | Cayley-Klein parameters | [`cayley_klein::CayleyKlein`] | nowhere, two for a rotation |

pub mod calibration;
pub mod cayley_klein;
pub mod elements;
pub mod euler;
pub mod line;
pub mod matrix;
pub mod positions;
pub mod rates;
pub mod three_axes;
pub mod turn;
pub mod vectors;
