//! All assemblies of a linkage on the sphere, real and complex, with the proof that none is missing.
//!
//! The unknowns are the axes of the joints as directions. A body is known by two of its axes that are not parallel: their lengths
//! and the angle between them stay, and every other axis is a fixed combination of them and of their cross product. These
//! equations have exactly the assemblies for solutions, so that a Gröbner basis over the rationals counts them.

mod answer;
mod dyads;
mod equations;
mod family;
mod instant;

pub use answer::{Coordinate, SphereAnswer, SphereMode, quaternion, rotations, solve};
pub use dyads::{Function, SphereDyad, SphereDyads, about, half_turn, start};
pub use equations::{Cluster, System, combination};
pub use family::SphereFamily;
pub use instant::{Rates, rates};
