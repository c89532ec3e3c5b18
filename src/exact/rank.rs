//! The rank of the joint screws of a loop in general position.

use crate::algebra::drawn::Drawn;
use crate::algebra::echelon::Echelon;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, cross};

/// Half-angle tangents and distances of the six unknowns: any numbers do, modulo a prime that is drawn after them.
const PLACES: [i32; 6] = [1_234_577, 7_654_321, 3_141_593, 2_718_281, 1_414_213, 1_732_051];

/// The rank of the six joint screws modulo the prime, at a configuration in general position that need not close the loop.
/// The rank in general position is at least that.
#[must_use]
pub fn general_rank(closed: &ClosedLoop<Drawn>) -> usize {
    let mut frame: Motion<Drawn> = Motion::identity();
    let mut screws: Vec<Vec<Drawn>> = Vec::new();
    for ((variable, constant), place) in closed.variables.iter().zip(&closed.constants).zip(PLACES) {
        let axis: [Drawn; 3] = std::array::from_fn(|i| frame.rotation[i][2]);
        let place = Drawn::from_integer(place);
        let (screw, step) = match variable {
            Variable::Rotation => {
                let moment = cross(&frame.translation, &axis);
                let scale = Drawn::one().add(&place.mul(&place)).inverse().unwrap_or_else(Drawn::one);
                let cos = Drawn::one().sub(&place.mul(&place)).mul(&scale);
                (axis.into_iter().chain(moment).collect(), Motion::rotation_z(cos, place.add(&place).mul(&scale)))
            }
            Variable::Translation => {
                let nought = [Drawn::zero(); 3];
                (nought.into_iter().chain(axis).collect(), Motion::translation_z(place))
            }
        };
        screws.push(screw);
        frame = frame.then_after(&step).then_after(constant);
    }
    Echelon::of(screws, 6).rank()
}
