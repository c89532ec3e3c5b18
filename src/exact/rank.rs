//! The rank of the joint screws of a loop in general position.

use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Field;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, cross};

/// Half-angle tangents and distances of the six unknowns: any numbers will do modulo a prime that is drawn after them.
const PLACES: [i32; 6] = [1_234_577, 7_654_321, 3_141_593, 2_718_281, 1_414_213, 1_732_051];

/// Returns the rank of the six joint screws modulo the prime, at a configuration in general position that need not close the
/// loop: a lower bound on the rank in general position.
#[must_use]
pub fn general_rank<F: Field>(closed: &ClosedLoop<F>) -> usize {
    let mut frame: Motion<F> = Motion::identity();
    let mut screws: Vec<Vec<F>> = Vec::new();
    for ((variable, constant), place) in closed.variables.iter().zip(&closed.constants).zip(PLACES) {
        let axis: [F; 3] = std::array::from_fn(|i| frame.rotation[i][2].clone());
        let place = F::from_integer(place);
        let (screw, step) = match variable {
            Variable::Rotation => {
                let moment = cross(&frame.translation, &axis);
                let scale = F::one().add(&place.mul(&place)).inverse().unwrap_or_else(F::one);
                let cos = F::one().sub(&place.mul(&place)).mul(&scale);
                (axis.into_iter().chain(moment).collect(), Motion::rotation_z(cos, place.add(&place).mul(&scale)))
            }
            Variable::Translation => {
                let nought = std::array::from_fn::<F, 3, _>(|_| F::zero());
                (nought.into_iter().chain(axis).collect(), Motion::translation_z(place))
            }
        };
        screws.push(screw);
        frame = frame.then_after(&step).then_after(constant);
    }
    Echelon::of(screws, 6).rank()
}
