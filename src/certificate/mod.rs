//! Certificates that anyone can check: the format of docs/certificate.md, and a checker that uses no solver.
//!
//! A certificate holds the data of one case as a mechanism file, the verdict claimed for it, balls around its solutions, and
//! the proof that there are no others. The checker derives the closure equations from the data and checks each item anew.

mod algebraic;
mod all_roots;
mod bound;
mod chain;
mod check;
mod curve;
mod data;
mod deflated;
mod distance;
mod double_points;
mod doubled;
mod eliminant;
mod enclosing;
mod families;
mod fault;
mod four_bars;
mod incidence;
mod isolation;
mod kernel;
mod lines;
mod linkage;
mod mode;
mod moving;
mod nearby;
mod platform;
mod points;
mod polynomial;
mod real_ball;
mod real_zeros;
mod reconstructed;
mod record;
mod refine;
mod spherical;
mod strict;
mod sweep;

pub use bound::{proof_of, proof_of_all, proof_of_own, proof_of_real_list};
pub use chain::ChainClosure;
pub use check::{Holds, check, check_all, closed};
pub use data::{data_of, data_of_loop};
pub use distance::proof_by_distance;
pub use double_points::proof_of_doubles;
pub use families::{KIND as FAMILIES, Listed, claim_of_families};
pub use fault::Fault;
pub use four_bars::{data_of_turning_linkage, data_of_turning_loop};
pub use isolation::{Closed, proved_modes};
pub use kernel::proof_of_kernel;
pub use linkage::{LinkageClosure, data_of_linkage};
pub use mode::Ball;
pub use moving::{proof_of_motion, proof_of_rest, proof_of_self_motion};
pub use polynomial::proof_of_polynomial;
pub use reconstructed::proof_of_points;
pub use record::{FORMAT, VERSION};
pub use refine::{Near, balls, balls_of_linkage};
pub use spherical::data_of_turning_sphere;
pub use sweep::proof_of_sweep;
