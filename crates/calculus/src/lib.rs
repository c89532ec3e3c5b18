//! The calculus of motion: rotations, lines, screws, instantaneous motion and trees of bodies.
//!
//! Every formula is written once over a ring. Rationals give exact answers and f64 fast ones. Dual numbers turn rotations into
//! screws and directions into lines, by the principle of transference; truncated series turn positions into velocities,
//! accelerations and curvatures. [`mod@unit`] defines what a ring must offer besides sums and products.
//!
//! The chapters are those of \[Wittenburg2016\]: 1 and 10 are [`rotation`], 2 is [`mod@line`], 3 is [`displacement`], 9 and 15 are
//! [`instant`], 11 is [`tree`].

pub mod displacement;
pub mod finite;
pub mod instant;
pub mod line;
pub mod motion;
pub mod plane;
pub mod quaternion;
pub mod rotation;
pub mod tree;
pub mod unit;
