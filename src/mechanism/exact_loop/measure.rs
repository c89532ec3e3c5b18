//! Measures of an exact solution in f64: its residual and its condition number.

use super::cycle::Cycle;
use crate::algebra::number::nearest_f64;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{Motion, cross};
use crate::solve::scalar::Scalar;
use looproot_calculus::finite::finite;
use nalgebra::DMatrix;
use num_complex::Complex;
use rug::Rational;

/// A motion among complex numbers, lengths over a unit.
fn rounded(motion: &Motion<Rational>, unit: f64) -> Motion<Complex<f64>> {
    let lifted = |x: &Rational| Complex::from(nearest_f64(x));
    Motion {
        rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(lifted)),
        translation: motion.translation.each_ref().map(|x| lifted(x) / unit),
    }
}

/// The residual of the closure equations with these values of the unknowns, and the condition number of the screws of the
/// joints: a spherical joint has three of them, in all directions through its centre, however it stands.
pub(super) fn measure(cycle: &Cycle, values: &[Complex<f64>], unit: f64) -> (f64, f64) {
    let identity: Motion<Complex<f64>> = Motion::identity();
    let mut frame = cycle.before.as_ref().map_or_else(|| identity.clone(), |before| rounded(before, unit));
    let mut columns: Vec<[Complex<f64>; 6]> = Vec::new();
    if cycle.before.is_some() {
        columns.extend((0..3).map(|k| std::array::from_fn(|i| Complex::from(f64::from(u8::from(i == k))))));
    }
    for (step, value) in cycle.steps.iter().zip(values) {
        let axis = [0, 1, 2].map(|i| frame.rotation[i][2]);
        let motion = match step.variable {
            Variable::Rotation => {
                let [x, y, z] = cross(&frame.translation, &axis);
                columns.push([axis[0], axis[1], axis[2], x, y, z]);
                let (cos, sin) = value.cos_sin_of();
                Motion::rotation_z(cos, sin)
            }
            Variable::Translation => {
                let zero = Complex::ZERO;
                columns.push([zero, zero, zero, axis[0], axis[1], axis[2]]);
                Motion::translation_z(value / unit)
            }
        };
        frame = frame.then_after(&motion).then_after(&rounded(&step.behind, unit));
    }
    let turned = (0..9).map(|k| (frame.rotation[k / 3][k % 3] - identity.rotation[k / 3][k % 3]).norm());
    // A spherical joint turns back whatever is turned.
    let turned = if cycle.before.is_some() { 0.0 } else { turned.fold(0.0, f64::max) };
    let residual = frame.translation.iter().map(|x| x.norm()).fold(turned, f64::max);
    let matrix = DMatrix::from_fn(6, columns.len(), |i, j| columns[j][i]);
    let singular = finite(matrix).singular_values();
    // There are more columns than rows, or no columns at all.
    let is_full = columns.len() <= 6 && singular.min() > 0.0;
    (residual, if is_full { singular.max() / singular.min() } else { f64::INFINITY })
}
