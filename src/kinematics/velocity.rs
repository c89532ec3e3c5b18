//! The velocity of a platform's plate with respect to its legs.

use super::motion::{Motion, Vector, cross};
use super::platform::Platform;
use crate::algebra::ring::Ring;
use looproot_calculus::finite::finite;
use nalgebra::{Matrix6, Vector6};

/// Below this ratio of the singular values there is no velocity to speak of.
const SINGULAR: f64 = 1e-13;

/// The screws of the legs, `(l_i, R b_i x l_i)` with `l_i = p + R b_i - a_i`: for a plate whose origin moves with the
/// velocity v while it turns with the angular velocity w, `L_i dL_i/dt = l_i . v + (R b_i x l_i) . w`.
///
/// # Units
/// Length, and length squared; v and w in the frame of the base.
#[must_use]
pub fn leg_screws<R: Ring>(platform: &Platform<R>, pose: &Motion<R>) -> [[R; 6]; 6] {
    let legs = platform.legs(pose);
    std::array::from_fn(|i| {
        let moment = cross(&pose.rotate(&platform.plate[i]), &legs[i]);
        std::array::from_fn(|k| if k < 3 { legs[i][k].clone() } else { moment[k - 3].clone() })
    })
}

/// The motion of the plate with its legs, to first order.
#[derive(Clone, Debug, PartialEq)]
pub struct Velocity {
    /// Singular values of the inverse Jacobian, which turns the twist of the plate into the rates of the legs, largest
    /// first: the velocity taken at the centroid of the points of the plate, the angular velocity times their mean
    /// (quadratic) distance from it. Free of units and of the frames in which base and plate are given.
    pub singular_values: [f64; 6],
    /// From the rates of the legs to the twist: column i holds the velocity of the origin of the plate and the angular
    /// velocity, in the frame of the base, while leg i alone lengthens at rate 1. `None` at a singular pose.
    pub twist: Option<[[f64; 6]; 6]>,
}

/// The motion of the plate with its legs at a pose.
#[must_use]
pub fn velocity(platform: &Platform<f64>, pose: &Motion<f64>) -> Velocity {
    let centroid: Vector<f64> = std::array::from_fn(|k| platform.plate.iter().map(|point| point[k] / 6.0).sum::<f64>());
    let arm = |point: &Vector<f64>| -> Vector<f64> { std::array::from_fn(|k| point[k] - centroid[k]) };
    let square = |v: &Vector<f64>| v.iter().map(|x| x * x).sum::<f64>();
    let size = (platform.plate.iter().map(|point| square(&arm(point))).sum::<f64>() / 6.0).sqrt();
    // A plate without extent: its rotation moves nothing.
    let size = if size > 0.0 { size } else { 1.0 };
    // About the centroid: leg ends and pose of a plate whose origin lies there.
    let here = Motion { rotation: pose.rotation, translation: pose.apply(&centroid) };
    let centred = Platform { base: platform.base, plate: platform.plate.each_ref().map(arm) };
    let screws = leg_screws(&centred, &here);
    let jacobian = Matrix6::from_fn(|i, k| {
        let length = screws[i][..3].iter().map(|x| x * x).sum::<f64>().sqrt();
        let entry = if k < 3 { screws[i][k] } else { screws[i][k] / size };
        if length > 0.0 { entry / length } else { 0.0 }
    });
    let mut singular_values: [f64; 6] = finite(jacobian).singular_values().into();
    singular_values.sort_by(|a, b| b.total_cmp(a));
    let regular = singular_values[5] > SINGULAR * singular_values[0];
    let inverse = if regular { jacobian.try_inverse() } else { None };
    let to_centroid = here.rotate(&centroid);
    let twist = inverse.map(|inverse| {
        let columns: [[f64; 6]; 6] = std::array::from_fn(|leg| {
            let column: Vector6<f64> = inverse.column(leg).into();
            let turn = [column[3] / size, column[4] / size, column[5] / size];
            let behind = cross(&turn, &to_centroid);
            std::array::from_fn(|k| if k < 3 { column[k] - behind[k] } else { turn[k - 3] })
        });
        std::array::from_fn(|k| std::array::from_fn(|leg| columns[leg][k]))
    });
    Velocity { singular_values, twist }
}
