//! The conditions of a pose imposed on an arm of few joints, and the joints held in an arm of many.

use crate::algebra::sort;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::forward::{Forward, Twist};
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::screws::{Behind, VirtualJoint};
use looproot_calculus::finite::finite;
use nalgebra::DMatrix;
use std::f64::consts::PI;

/// At how many configurations a choice is tried: one of them may be singular by chance.
const CONFIGURATIONS: usize = 15;
/// Smallest singular values below this, lengths over the reach of the arm, are those of a choice that never is regular.
const REGULAR: f64 = 1e-6;
/// Sliding joints cost the solver more than turning ones: they are taken where these are so much worse.
const SLIDING: f64 = 0.25;

/// The virtual joints along the axes of the tool among which is chosen.
const ALL: [VirtualJoint; 6] = [
    VirtualJoint { variable: Variable::Rotation, axis: 0 },
    VirtualJoint { variable: Variable::Rotation, axis: 1 },
    VirtualJoint { variable: Variable::Rotation, axis: 2 },
    VirtualJoint { variable: Variable::Translation, axis: 0 },
    VirtualJoint { variable: Variable::Translation, axis: 1 },
    VirtualJoint { variable: Variable::Translation, axis: 2 },
];

/// Describes in words the motion that a virtual joint leaves free.
pub(super) fn words(joint: VirtualJoint) -> String {
    let what = match joint.variable {
        Variable::Rotation => "rotation about",
        Variable::Translation => "translation along",
    };
    format!("{what} the tool's {}", ["x", "y", "z"][joint.axis])
}

/// The conditions that are met where these virtual joints make up for what the arm lacks.
pub(super) fn conditions(free: &[VirtualJoint]) -> Vec<String> {
    ALL.into_iter().filter(|own| !free.contains(own)).map(words).collect()
}

/// The arm whose joints are chosen: its Jacobian at some configurations.
pub(super) struct Trial {
    columns: Vec<Vec<[f64; 6]>>,
    tools: Vec<Motion<f64>>,
    reach: f64,
}

impl Trial {
    /// An arm with these limits and joints held at these values.
    pub(super) fn of(forward: &Forward, limits: &[[f64; 2]], held: &[(usize, f64)]) -> Self {
        let reach = forward.reach().max(f64::MIN_POSITIVE);
        let (mut columns, mut tools) = (Vec::new(), Vec::new());
        for number in 0..CONFIGURATIONS {
            let q = configuration(forward, limits, held, number, reach);
            let (tool, twists) = forward.jacobian(&q);
            let kept = twists.iter().enumerate().filter(|(k, _)| held.iter().all(|(own, _)| own != k));
            columns.push(kept.map(|(_, twist)| column(twist, reach)).collect());
            tools.push(tool);
        }
        Self { columns, tools, reach }
    }

    /// The choices of `count` virtual joints beside those of the task that make the loop regular, the best one first.
    pub(super) fn filled(&self, count: usize, task: &[Behind]) -> Vec<Vec<VirtualJoint>> {
        let mut scored: Vec<(f64, Vec<VirtualJoint>)> = subsets(ALL.len(), count)
            .into_iter()
            .map(|chosen| chosen.into_iter().map(|k| ALL[k]).collect::<Vec<_>>())
            .map(|chosen| {
                let sliding = chosen.iter().filter(|own| own.variable == Variable::Translation).count();
                let factor = SLIDING.powi(i32::try_from(sliding).unwrap_or(0));
                (self.score(task, &chosen, &[]) * factor, chosen)
            })
            .filter(|(score, _)| *score > REGULAR)
            .collect();
        sort::by(&mut scored, |a, b| b.0.total_cmp(&a.0));
        scored.into_iter().map(|(_, chosen)| chosen).collect()
    }

    /// The choices of `count` joints to hold, numbers among those not held yet, that leave the loop regular; the best first.
    pub(super) fn held(&self, count: usize, task: &[Behind]) -> Vec<Vec<usize>> {
        let total = self.columns.first().map_or(0, Vec::len);
        let mut scored: Vec<(f64, Vec<usize>)> = subsets(total, count)
            .into_iter()
            .map(|chosen| (self.score(task, &[], &chosen), chosen))
            .filter(|(score, _)| *score > REGULAR)
            .collect();
        sort::by(&mut scored, |a, b| b.0.total_cmp(&a.0));
        scored.into_iter().map(|(_, chosen)| chosen).collect()
    }

    /// The median over the configurations of the smallest singular value.
    fn score(&self, task: &[Behind], filled: &[VirtualJoint], left_out: &[usize]) -> f64 {
        let mut values: Vec<f64> = self
            .columns
            .iter()
            .zip(&self.tools)
            .map(|(own, tool)| {
                let kept = own.iter().enumerate().filter(|(k, _)| !left_out.contains(k)).map(|(_, column)| *column);
                let filled = filled.iter().map(|joint| column(&twist(*joint, tool), self.reach));
                let columns: Vec<[f64; 6]> = kept.chain(columns(task, tool, self.reach)).chain(filled).collect();
                finite(DMatrix::from_fn(6, columns.len(), |i, j| columns[j][i])).singular_values().min()
            })
            .collect();
        values.sort_by(f64::total_cmp);
        values[values.len() / 2]
    }
}

/// The velocities that the virtual joints of a task give the tool.
pub(super) fn columns(task: &[Behind], tool: &Motion<f64>, reach: f64) -> Vec<[f64; 6]> {
    let mut columns = Vec::new();
    // Behind the rotation of the pose stands a frame turned as the base is.
    let mut frame = tool.clone();
    for behind in task {
        let own = match behind {
            Behind::Joint(joint) => std::slice::from_ref(joint),
            Behind::Spherical => &ALL[..3],
            Behind::Constant(_) => {
                frame = Motion::translation(tool.translation);
                &[]
            }
        };
        columns.extend(own.iter().map(|joint| column(&twist(*joint, &frame), reach)));
    }
    columns
}

/// The velocity that a virtual joint gives the tool.
fn twist(joint: VirtualJoint, tool: &Motion<f64>) -> Twist {
    let axis: Vector<f64> = std::array::from_fn(|i| tool.rotation[i][joint.axis]);
    match joint.variable {
        Variable::Rotation => Twist { linear: [0.0; 3], angular: axis },
        Variable::Translation => Twist { linear: axis, angular: [0.0; 3] },
    }
}

/// A velocity as a column, lengths over the reach; a sliding joint runs through the reach in unit time.
pub(super) fn column(twist: &Twist, reach: f64) -> [f64; 6] {
    let [x, y, z] = twist.linear;
    let [a, b, c] = twist.angular;
    let over = if twist.angular == [0.0; 3] { 1.0 } else { reach };
    [a, b, c, x / over, y / over, z / over]
}

/// Joint values within the limits, spread evenly by the fractional parts of multiples of square roots.
fn configuration(forward: &Forward, limits: &[[f64; 2]], held: &[(usize, f64)], number: usize, reach: f64) -> Vec<f64> {
    let value = |(k, variable): (usize, &Variable)| {
        if let Some((_, value)) = held.iter().find(|(own, _)| *own == k) {
            return *value;
        }
        let whole = if *variable == Variable::Rotation { PI } else { reach };
        let [low, high] = limits.get(k).copied().unwrap_or([-whole, whole]);
        let (low, high) = (low.max(-whole), high.min(whole));
        // Square roots of different primes have multiples that fill the cube.
        let root = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0][k % 8].sqrt();
        let part = (root * (number + 1) as f64).fract();
        low + part * (high - low)
    };
    forward.variables().iter().enumerate().map(value).collect()
}

/// Returns all subsets of `count` of the numbers below `total`.
fn subsets(total: usize, count: usize) -> Vec<Vec<usize>> {
    if count == 0 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for last in (count - 1)..total {
        for mut choice in subsets(last, count - 1) {
            choice.push(last);
            all.push(choice);
        }
    }
    all
}
