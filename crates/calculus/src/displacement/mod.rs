//! Displacements of a body in space: screws, their products, and their action on points and lines.

pub mod cylindroid;
pub mod points;
pub mod screw;
pub mod velocity;
