//! The rooms that run pose after pose: what is between a geometry and the list of its assemblies, in machine numbers.
//!
//! They import nothing of the other rooms, and are a crate of their own: a pose takes microseconds here, so that they are compiled for
//! speed, and all others for size. Their files stand beside those of the other rooms.
//! Their names may change with every version: what is public stands at the root of `looproot`.

use looproot_algebra as algebra;

/// The one error of the library, with the numbers in its message.
#[doc(hidden)]
pub mod error;

/// Rigid motions, joints, chains, loops and platforms over any ring.
#[doc(hidden)]
pub mod kinematics;

/// A mechanism as closure equations.
#[doc(hidden)]
pub mod closure;

/// Closure equations as one matrix pencil in the hidden unknown, over any field.
#[doc(hidden)]
pub mod elimination;

/// A pencil as roots in f64.
#[doc(hidden)]
pub mod solve;

/// The proof that exactly one solution lies within a radius.
#[doc(hidden)]
pub mod certify;

/// A geometry prepared once, then every way to close it, pose after pose.
#[doc(hidden)]
pub mod assembly;
