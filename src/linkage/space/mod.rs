//! All assemblies of a linkage in space.
//!
//! Inputs merge bodies; what is left is one system of polynomials over the rationals whose solutions are the assemblies, and its
//! Gröbner basis counts them. Groups that can be solved one after the other have counts of their own, which multiply.

mod answer;
mod clusters;
mod conditions;
mod equations;
mod independent;
mod plate_pose;
mod rates;
mod six_legs;
mod universal;
mod values;

pub use answer::{Coordinate, SpaceAnswer, SpaceGroup, SpaceMode, bodies, solve, solve_real};
pub use clusters::{clusters, groups};
pub use conditions::conditions;
pub use equations::{Symbol, System};
pub use rates::{SpaceRates, rates};
pub use six_legs::{is_platform, platform_of};
