//! The answer to the question whether a mechanism moves.

use super::order::Local;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::screw_system::Screw;
use crate::verdict::{Code, Proof};

/// One joint variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct JointVariable {
    /// Its joint, from 1.
    pub joint: usize,
    /// Its kind.
    pub variable: Variable,
}

/// A real configuration, and the motion through it.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The joint variables in joint order: angles in (-pi, pi], distances.
    pub q: Vec<f64>,
    /// Degree of the number field in which the configuration was found; 1 for a rational one, 0 for one known in floating
    /// point only.
    pub degree: usize,
    /// Rank of the joint screws.
    pub rank: usize,
    /// The set that the configurations near this one form.
    pub local: Local,
    /// Marks the joint variables that move along the curve or in the manifold.
    pub moving: Vec<bool>,
    /// The branch it lies on, numbered from 0; `None` if it does not move. Configurations that a curve passes one after the other
    /// are of one branch.
    pub branch: Option<usize>,
    /// The common property of the axes, in words.
    pub system: String,
    /// A basis of the screws reciprocal to all joints: of the wrenches that the loop can hold in itself, its redundant
    /// constraints.
    pub redundant: Vec<Screw<f64>>,
}

impl Configuration {
    /// The dimension of the motion through this configuration; `None` where that is not decided.
    #[must_use]
    pub fn dimension(&self) -> Option<usize> {
        match self.local {
            Local::Manifold { dimension } => Some(dimension),
            Local::Curve => Some(1),
            Local::Isolated { .. } => Some(0),
            Local::Open | Local::Deficient => None,
        }
    }
}

/// The joint variables that were held to find the configurations, with their values.
pub type Held = Vec<(usize, f64)>;

/// The mobility of a loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mobility {
    /// The joint variables; of a platform the lengths of its legs.
    pub variables: Vec<JointVariable>,
    /// The number of equations that bind them in general: six round a loop, none in an open chain, one for every leg of a
    /// platform.
    pub equations: usize,
    /// The rank of the screws where it is known without a configuration: of an arm in general position, of a platform that of the
    /// lines of its legs.
    pub general_rank: Option<usize>,
    /// The dimension of the largest motion found: 0 when the loop is immobile, `None` when that is not decided.
    pub mobility: Option<usize>,
    /// The proof of that.
    pub proof: Proof,
    /// The reason as a code.
    pub code: Code,
    /// The order to which an immobile loop is shaky: the multiplicity of its configuration, 2 or more.
    pub shaky: Option<usize>,
    /// The held joints.
    pub held: Held,
    /// The real configurations there; of an immobile loop all of them. Every one of a mobile loop lies on a branch.
    pub configurations: Vec<Configuration>,
    /// The number of configurations, complex ones included.
    pub complex: usize,
    /// Whether all configurations are listed, or some may be missing.
    pub is_listed: bool,
    /// Why.
    pub reason: String,
}

impl Mobility {
    /// Gruebler's count: of a single loop the freedoms of its joints less six.
    #[must_use]
    pub fn gruebler(&self) -> i64 {
        let [freedoms, equations] =
            [self.variables.len(), self.equations].map(|n| i64::try_from(n).unwrap_or(i64::MAX));
        freedoms - equations
    }

    /// The rank of the joint screws along the motion: the largest found, as every rank but that of special configurations.
    #[must_use]
    pub fn screw_rank(&self) -> Option<usize> {
        self.configurations.iter().map(|configuration| configuration.rank).max().or(self.general_rank)
    }

    /// The number of different real branches through what is held; 0 of an immobile loop.
    #[must_use]
    pub fn branches(&self) -> usize {
        self.configurations.iter().filter_map(|configuration| configuration.branch).max().map_or(0, |last| last + 1)
    }
}
