#![doc = include_str!("../README.md")]
//
// The public API stands at the root. Its implementation stands in one hidden module, for the command line, the bindings, tests
// and benches: its names may change with every version.

use looproot_algebra as algebra;

/// The implementation, in layer order: none of these modules imports a later one.
#[doc(hidden)]
#[path = ""]
#[rustfmt::skip]
pub mod internal {
    pub use looproot_engine::{assembly, certify, closure, elimination, error, kinematics, solve};

    pub mod catalogue;
    pub mod certificate;
    pub mod exact;
    pub mod verdict;
    pub mod mechanism;
    pub mod displacement;
    pub mod gearing;
    pub mod lines;
    pub mod synthesis;
    pub mod linkage;
    pub mod derivation;
    pub mod sweep;
    pub mod mobility;
    pub mod factoring;
    pub mod conditions;
    pub mod benchmark;
    pub mod claims;
    pub mod scene;
    pub mod report;
    pub mod view;
    pub mod face;
}

use internal::{
    assembly, benchmark, catalogue, certificate, certify, claims, closure, conditions, derivation, displacement,
    elimination, error, exact, face, factoring, gearing, kinematics, lines, linkage, mechanism, mobility, report,
    scene, solve, sweep, synthesis, verdict, view,
};

pub use error::{Error, Result};
pub use face::{
    Arm, Convention, DhRow, Linkage, Loop, Matrix, Platform, ScrewRow, Workspace, conditions, mobility, verify,
};
pub use kinematics::chain::JointKind;
pub use kinematics::joint::Variable;
pub use kinematics::velocity::Velocity;
pub use mechanism::{ArmAnswer, Family, FullMode, PlatformAnswer, PlatformMode, PoseError, Solution};
pub use scene::Pose;
pub use sweep::Range;
pub use verdict::{Code, Proof, Status, Verdict};
