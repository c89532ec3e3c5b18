//! Loads on an assembly at rest: what holds them at the inputs, and the forces in the joints.
//!
//! The drive at an input follows from virtual power: what the loads do where the input runs at unit rate. The forces in the joints
//! solve the equilibrium of all bodies, `J^T l = -w`, with the Jacobian J of the closure equations and inputs, and the loads w.
//! \[Wittenburg2016, 17.7\]

use super::dynamics::{Reaction, of_joints};
use super::rates::{Body, Moving, freedoms, jacobian, moved, moving, open, prescribed};
use crate::kinematics::linkage::{Given, Linkage};
use looproot_calculus::finite::finite;
use nalgebra::DVector;

/// A singular value below this share of the largest one stands for 0.
const SINGULAR: f64 = 1e-10;

/// A load on a body; K components of its force, and M of its moment, in axes of the ground.
#[derive(Clone, Debug, PartialEq)]
pub enum Load<const K: usize, const M: usize> {
    /// A force, newtons, at a point of the body.
    Force {
        /// The body.
        body: usize,
        /// The point in axes of the body.
        at: [f64; K],
        /// The force.
        force: [f64; K],
    },
    /// A moment, newton metres.
    Moment {
        /// The body.
        body: usize,
        /// The moment.
        moment: [f64; M],
    },
}

/// A load in the plane.
pub type PlaneLoad = Load<2, 1>;
/// A load in space or on the sphere.
pub type SpaceLoad = Load<3, 3>;

/// Balance of an assembly at rest.
#[derive(Clone, Debug)]
pub struct Balance {
    /// The drive at every input: newton metres, or newtons along the line of a slider.
    pub holding: Vec<f64>,
    /// The forces in the joints; `None` where bodies at rest do not determine them.
    pub joints: Option<Vec<Option<Reaction>>>,
}

/// Returns the balance of loads on a real assembly; `None` where the inputs do not determine rates.
#[must_use]
pub fn balance(linkage: &Linkage, given: &[Given], rest: &[Body], loads: &[PlaneLoad]) -> Option<Balance> {
    let moved = moved(linkage);
    let mut weight = DVector::zeros(3 * moved.len());
    for load in loads {
        let body = match load {
            Load::Force { body, .. } | Load::Moment { body, .. } => *body,
        };
        // A load on the ground does nothing.
        let Some(k) = moved.iter().position(|own| *own == body) else { continue };
        match load {
            Load::Force { at, force: [fx, fy], .. } => {
                let [x, y] = rest[body].turned(*at).map(|part| part.coefficients[0]);
                weight[3 * k] += x * fy - y * fx;
                weight[3 * k + 1] += fx;
                weight[3 * k + 2] += fy;
            }
            Load::Moment { moment: [moment], .. } => weight[3 * k] += moment,
        }
    }
    let count = freedoms(given);
    let mut holding = Vec::new();
    for k in 0..count {
        let rate = |j: usize| Moving { coefficients: [0.0, f64::from(u8::from(j == k)), 0.0, 0.0] };
        let bodies = moving(linkage, given, rest, &(0..count).map(rate).collect::<Vec<_>>())?;
        let rates = moved.iter().flat_map(|body| {
            let Body { angle, origin: [x, y] } = &bodies[*body];
            [angle, x, y].map(|part| part.coefficients[1])
        });
        let power: f64 = rates.zip(&weight).map(|(rate, load)| rate * load).sum();
        holding.push(-power + 0.0);
    }
    let equations = |bodies: &[Body]| [open(linkage, bodies), prescribed(linkage, given, bodies)].concat();
    let jacobian = jacobian(linkage, rest, &equations);
    // More equations than unknowns: forces of some joints could be exchanged for those of others.
    let joints = (jacobian.nrows() == jacobian.ncols()).then(|| {
        let svd = finite(jacobian.transpose()).svd(true, true);
        let is_regular = svd.singular_values.min() > SINGULAR * svd.singular_values.max();
        let found = svd.solve(&-weight, 0.0).ok().filter(|_| is_regular)?;
        Some(of_joints(linkage, rest, &found))
    });
    Some(Balance { holding, joints: joints.flatten() })
}
