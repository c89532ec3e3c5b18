//! The short way in: arms, loops, platforms and linkages by name, with numbers in and numbers out.
//!
//! Angles are radians, lengths metres, quaternions have w first.
//!
//! # Example
//! ```
//! use looproot::Arm;
//!
//! let arm = Arm::robot("ur5")?;
//! let pose = arm.fk(&[0.1, -1.0, 1.2, 0.3, 0.7, -0.4])?;
//! let answer = arm.ik(&pose)?;
//! assert!(answer.modes.iter().all(|mode| mode.certified));
//! assert_eq!(answer.verdict.real, answer.modes.len());
//! # Ok::<(), looproot::Error>(())
//! ```

mod arm;
mod closed;
mod forward;
mod linkage;
mod model;
mod pose;
mod workspace;

pub use arm::{Arm, Convention, DhRow, ScrewRow};
pub use closed::{Loop, Platform};
pub use linkage::Linkage;
pub use model::{Model, conditions, mobility, verify};
pub use pose::Matrix;
pub use workspace::Workspace;
