//! Random platforms with a planted pose, counted and timed.

pub mod accuracy;
pub mod sample;
pub mod speed;
