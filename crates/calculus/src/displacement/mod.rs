//! Displacements of a body in space: screws, their products, and what they do to points and lines.

pub mod cylindroid;
pub mod points;
pub mod screw;
pub mod velocity;
