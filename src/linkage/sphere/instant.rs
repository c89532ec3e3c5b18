//! Velocity and acceleration of every body of an assembly on the sphere.
//!
//! The angular velocities of two bodies of a joint differ along its axis. With a unit rate of the first input this is a linear
//! system for all of them; its derivative is one with the same matrix for the angular accelerations.

use super::answer::SphereMode;
use crate::algebra::number::nearest_f64;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::sphere::{SphereGiven, SphereLinkage};
use crate::mechanism::Moving;
use looproot_calculus::displacement::velocity::State;
use looproot_calculus::finite::finite;
use looproot_calculus::rotation::matrix::apply;
use nalgebra::{DMatrix, DVector};

/// A singular value below this share of the largest one stands for 0.
const SINGULAR: f64 = 1e-10;

/// The motion of all bodies at an instant, in axes of the ground.
#[derive(Clone, Debug)]
pub struct Rates {
    /// The rotation of every body with its rate and half its acceleration.
    pub bodies: Vec<Moving>,
    /// Rate and acceleration of every joint.
    pub joints: Vec<[f64; 2]>,
}

/// Returns the motion of a real assembly where the first input runs at unit rate and the others stand; `None` at a position where
/// the inputs do not determine the rates.
#[must_use]
pub fn rates(linkage: &SphereLinkage, given: &[SphereGiven], mode: &SphereMode) -> Option<Rates> {
    let places: Vec<[[f64; 3]; 3]> = mode.bodies.iter().map(|rows| rows.map(|row| row.map(|c| c.re))).collect();
    let columns = 3 * linkage.bodies.len();
    let axes: Vec<Vector<f64>> = linkage
        .joints
        .iter()
        .map(|joint| {
            let own = joint.at[0].each_ref().map(nearest_f64);
            let length = dot(&own, &own).sqrt();
            apply(&places[joint.of[0]], &own).map(|c| c / length)
        })
        .collect();
    let mut system = Linear { columns, rows: Vec::new(), right: Vec::new() };
    system.fix([linkage.ground, linkage.ground], &[0.0; 3]);
    for (joint, axis) in linkage.joints.iter().zip(&axes) {
        for k in 0..3 {
            system.push(joint.of, &cross(&unit(k), axis), 0.0);
        }
    }
    let driven = given.first()?.joint?;
    for one in given {
        match one.joint {
            Some(joint) => system.push(one.of, &axes[joint], f64::from(u8::from(joint == driven))),
            None => system.fix([linkage.ground, one.of[1]], &[0.0; 3]),
        }
    }
    let matrix = DMatrix::from_fn(system.rows.len(), columns, |i, j| system.rows[i][j]);
    let svd = finite(matrix.clone()).svd(true, true);
    if svd.singular_values.len() < columns || !(svd.singular_values.min() > SINGULAR * svd.singular_values.max()) {
        return None;
    }
    let solved = |right: Vec<f64>| svd.solve(&DVector::from_vec(right), 0.0).ok();
    let of = |all: &DVector<f64>, body: usize| -> Vector<f64> { std::array::from_fn(|k| all[3 * body + k]) };
    let apart = |all: &DVector<f64>, [a, b]: [usize; 2]| -> Vector<f64> {
        let (a, b) = (of(all, a), of(all, b));
        std::array::from_fn(|k| b[k] - a[k])
    };
    let first = solved(system.right.clone())?;
    // The axis u turns with its first body: (u x d)' = 0 gives u x d' = -(w x u) x d, and along the axis d'.u keeps its value, as
    // the rate of u is across d.
    let mut right = vec![0.0; system.right.len()];
    for (k, (joint, axis)) in linkage.joints.iter().zip(&axes).enumerate() {
        let turning = cross(&of(&first, joint.of[0]), axis);
        let apart = apart(&first, joint.of);
        for i in 0..3 {
            // A row is (e x u).d = e.(u x d), behind the three rows of the ground.
            right[3 + 3 * k + i] = -dot(&unit(i), &cross(&turning, &apart));
        }
    }
    let second = solved(right)?;
    let bodies = places.iter().enumerate().map(|(body, place)| {
        let zero = [0.0; 3];
        let state = State { omega: of(&first, body), alpha: of(&second, body), velocity: zero, acceleration: zero };
        state.motion(&Motion { rotation: *place, translation: zero })
    });
    let joints = linkage
        .joints
        .iter()
        .zip(&axes)
        .map(|(joint, axis)| [&first, &second].map(|all| dot(axis, &apart(all, joint.of))));
    Some(Rates { bodies: bodies.collect::<Option<_>>()?, joints: joints.collect() })
}

fn unit(k: usize) -> Vector<f64> {
    std::array::from_fn(|i| f64::from(u8::from(i == k)))
}

/// Linear equations in the angular velocities of all bodies.
struct Linear {
    columns: usize,
    rows: Vec<Vec<f64>>,
    right: Vec<f64>,
}

impl Linear {
    /// Adds `v . (w_b - w_a) = value`; of the ground against itself `v . w = value`.
    fn push(&mut self, [a, b]: [usize; 2], v: &Vector<f64>, value: f64) {
        let mut row = vec![0.0; self.columns];
        for (k, c) in v.iter().enumerate() {
            if a != b {
                row[3 * a + k] -= c;
            }
            row[3 * b + k] += c;
        }
        self.rows.push(row);
        self.right.push(value);
    }

    /// Adds three equations for an angular velocity that is known.
    fn fix(&mut self, of: [usize; 2], value: &Vector<f64>) {
        for (k, value) in value.iter().enumerate() {
            self.push(of, &unit(k), *value);
        }
    }
}
