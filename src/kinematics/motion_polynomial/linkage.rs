//! The closed loop of two factorisations: one chain forwards, the other backwards.

use super::{MotionPolynomial, evaluate, linear, parts};
use crate::algebra::dual::Dual;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion::Vector;
use crate::kinematics::screw_system::{Screw, ScrewSystem};

/// One joint of such a loop: what it turns about, and how far for each t.
#[derive(Clone, Debug)]
pub struct Joint<F> {
    /// The axis, or the direction of a prismatic joint, where the loop is at t = infinity.
    pub axis: Screw<F>,
    /// Whether the joint translates.
    pub prismatic: bool,
    /// The motion of the joint, a polynomial in t, up to real factors.
    pub motion: MotionPolynomial<F>,
}

/// A closed loop that moves with t; at t = infinity it is in its home position, all joint variables 0.
#[derive(Clone, Debug)]
pub struct Linkage<F> {
    /// The joints round the loop.
    pub joints: Vec<Joint<F>>,
}

impl<F: Field> Joint<F> {
    /// The joint of the factor `t - h`.
    fn of(h: &DualQuaternion<F>) -> Self {
        let direction: Vector<F> = std::array::from_fn(|k| h.vector[k].value.clone());
        let moment: Vector<F> = std::array::from_fn(|k| h.vector[k].epsilon.clone());
        let size = |v: &Vector<F>| v.iter().map(Field::pivot_size).fold(0.0, f64::max);
        let prismatic = size(&direction) <= F::PIVOT_ZERO * size(&moment);
        let axis = if prismatic { Screw::translation(&moment) } else { Screw { direction, moment } };
        Self { axis, prismatic, motion: linear(h) }
    }

    /// Whether two joints in a row are one: on one axis, or translations along one direction.
    fn is_coaxial(&self, other: &Self) -> bool {
        self.prismatic == other.prismatic && ScrewSystem::of(&[self.axis.clone(), other.axis.clone()]).order() == 1
    }

    /// Whether the joint never moves: its motion is real.
    fn is_fixed(&self) -> bool {
        let part = parts(&self.motion);
        let size = |p: &Univariate<F>| p.coefficients().iter().map(Field::pivot_size).fold(0.0, f64::max);
        let scale = size(&part[0]);
        (1..8).filter(|k| *k != 4).all(|k| size(&part[k]) <= F::PIVOT_ZERO * 1e4 * scale)
    }
}

impl<F: Field> Linkage<F> {
    /// The loop of `(t - h_1) ... (t - h_n) = (t - k_1) ... (t - k_n)`: the joints h in their order, then the joints k
    /// backwards and turning the other way. Neighbours on one axis become one joint, and factors that the two sides share drop
    /// out.
    #[must_use]
    pub fn of(left: &[DualQuaternion<F>], right: &[DualQuaternion<F>]) -> Self {
        let backwards = right.iter().rev().map(DualQuaternion::conjugate);
        let mut joints: Vec<Joint<F>> = left.iter().cloned().chain(backwards).map(|h| Joint::of(&h)).collect();
        // Around the loop until no two neighbours are one.
        let mut k = 0;
        while joints.len() > 1 && k < joints.len() {
            let next = (k + 1) % joints.len();
            if !joints[k].is_coaxial(&joints[next]) {
                k += 1;
                continue;
            }
            joints[k].motion = joints[k].motion.mul(&joints[next].motion);
            joints.remove(next);
            k = k.min(joints.len() - 1);
            if joints[k].is_fixed() {
                joints.remove(k);
            }
            k = 0;
        }
        Self { joints }
    }

    /// Whether the loop is closed for every t: the product of its joints is a real polynomial. In an exact field a proof that
    /// it moves.
    #[must_use]
    pub fn closes(&self) -> bool {
        let product = self
            .joints
            .iter()
            .fold(DualQuaternion::identity(), |product: MotionPolynomial<F>, joint| product.mul(&joint.motion));
        Joint { axis: Screw::translation(&std::array::from_fn(|_| F::zero())), prismatic: false, motion: product }
            .is_fixed()
    }

    /// The screws of the joints at t, up to factors.
    #[must_use]
    pub fn screws(&self, t: &F) -> Vec<Screw<F>> {
        let mut frame: DualQuaternion<F> = DualQuaternion::identity();
        let screw = |joint: &Joint<F>| {
            let line = DualQuaternion {
                scalar: Dual::zero(),
                vector: std::array::from_fn(|k| Dual {
                    value: joint.axis.direction[k].clone(),
                    epsilon: joint.axis.moment[k].clone(),
                }),
            };
            // The frame is off the unit norm by a real number, which only scales the screw.
            let moved = frame.mul(&line).mul(&frame.conjugate());
            frame = frame.mul(&evaluate(&joint.motion, t));
            Screw {
                direction: std::array::from_fn(|k| moved.vector[k].value.clone()),
                moment: std::array::from_fn(|k| moved.vector[k].epsilon.clone()),
            }
        };
        self.joints.iter().map(screw).collect()
    }

    /// The letters of the joints in short: `4R`, `RRPRRP`.
    #[must_use]
    pub fn letters(&self) -> String {
        let letters: String = self.joints.iter().map(|joint| if joint.prismatic { 'P' } else { 'R' }).collect();
        match letters.chars().next() {
            Some(first) if letters.len() > 1 && letters.chars().all(|c| c == first) => {
                format!("{}{first}", letters.len())
            }
            _ => letters,
        }
    }
}
