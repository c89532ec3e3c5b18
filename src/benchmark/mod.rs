//! Self-measurement of the program: solutions found, lost, spurious or duplicated against planted truth, and its speed.

pub mod accuracy;
pub mod agreement;
pub mod framework;
pub mod mobility;
pub mod platform;
pub mod published;
pub mod sample;
pub mod speed;
pub mod speed_loops;
mod speed_robots;
