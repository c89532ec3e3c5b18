//! Geometry over any ring: rigid motions, chains and loops.

pub use looproot_calculus::{motion, quaternion as dual_quaternion};

mod axis_frame;
pub mod chain;
pub mod closed_loop;
pub mod data_field;
pub mod decimal;
mod enclosed;
pub mod exact_motion;
pub mod forward;
pub mod framework;
pub mod freedom;
pub mod idle;
pub mod joint;
pub mod known_motion;
pub mod link_form;
pub mod linkage;
pub mod motion_polynomial;
pub mod placement;
pub mod platform;
pub mod platform_limits;
pub mod screw_system;
pub mod screws;
pub mod space;
pub mod span;
pub mod sphere;
pub mod task;
pub mod tolerance;
mod typed_placement;
pub mod velocity;
