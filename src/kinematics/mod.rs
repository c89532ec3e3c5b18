//! Geometry over any ring: rigid motions, joints, chains.

pub mod chain;
pub mod motion;
pub mod placement;
