//! Geometry over any ring: rigid motions, chains and loops.

mod axis_frame;
pub mod chain;
pub mod closed_loop;
pub mod dual_quaternion;
mod enclosed;
pub mod framework;
pub mod freedom;
pub mod idle;
pub mod joint;
pub mod link_form;
pub mod motion;
pub mod motion_polynomial;
pub mod placement;
pub mod platform;
pub mod screw_system;
pub mod velocity;
