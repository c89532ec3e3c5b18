//! The family of all plates on three UPU legs, along which poses are followed: points, axes and squared lengths move in straight lines.

use crate::closure::study::{Form, Four, Leg, scalar};
use crate::closure::universal_leg::{UniversalLeg, joined};
use crate::solve::paths::{Family, Here, Point};
use num_complex::Complex;

/// The legs.
pub(super) type Legs = [UniversalLeg<Complex<f64>>; 3];
/// Study's parameters x and y of a pose, up to a factor.
pub(super) type Pose = Point<8>;

/// Legs that move from `start`, at 1, to `target`, at 0.
pub(super) struct Moving<'a> {
    pub start: &'a Legs,
    pub target: &'a Legs,
}

fn times(z: &Complex<f64>, c: &Complex<f64>) -> Complex<f64> {
    z * c
}

/// Returns x and y.
pub(super) fn parts<R: Clone>(v: &[R; 8]) -> [Four<R>; 2] {
    [0, 4].map(|from| std::array::from_fn(|k| v[from + k].clone()))
}

/// The combination of two legs, entry by entry.
fn combined(
    one: &UniversalLeg<Complex<f64>>,
    two: &UniversalLeg<Complex<f64>>,
    of: impl Fn(Complex<f64>, Complex<f64>) -> Complex<f64>,
) -> UniversalLeg<Complex<f64>> {
    let form = |a: &Form<Complex<f64>>, b: &Form<Complex<f64>>| -> Form<Complex<f64>> {
        std::array::from_fn(|i| std::array::from_fn(|j| of(a[i][j], b[i][j])))
    };
    UniversalLeg {
        leg: Leg { matrix: form(&one.leg.matrix, &two.leg.matrix), square: of(one.leg.square, two.leg.square) },
        axes: [0, 1].map(|k| form(&one.axes[k], &two.axes[k])),
    }
}

impl Family<8> for Moving<'_> {
    fn at(&self, parameter: Complex<f64>, v: &Pose, patch: &Pose) -> Here<8> {
        let [x, y] = parts(v);
        let mut here = Here::zero();
        for (k, (start, target)) in self.start.iter().zip(self.target).enumerate() {
            let leg = combined(start, target, |a, b| b + parameter * (a - b));
            let rate = combined(start, target, |a, b| a - b);
            let (values, slopes) = (leg.values(&x, &y, times), leg.slopes(&x, &y, times));
            let w = leg.leg.vector(&x, &y, times);
            let zero = [Complex::from(0.0); 4];
            // The velocity of w, and that of n x m by the product rule.
            let moved = rate.leg.vector(&x, &zero, times);
            let first = UniversalLeg { leg: leg.leg.clone(), axes: [rate.axes[0], leg.axes[1]] };
            let second = UniversalLeg { leg: leg.leg.clone(), axes: [leg.axes[0], rate.axes[1]] };
            let drifts = [
                scalar(&w, &moved) * 2.0 - scalar(&x, &x) * rate.leg.square,
                scalar(&moved, &leg.between(&x, times))
                    + scalar(&w, &first.between(&x, times))
                    + scalar(&w, &second.between(&x, times)),
            ];
            for (form, ((value, slope), drift)) in values.into_iter().zip(slopes).zip(drifts).enumerate() {
                here.values[2 * k + form] = value;
                here.jacobian[2 * k + form] = slope;
                here.drift[2 * k + form] = drift;
            }
        }
        // Study's condition.
        here.values[6] = scalar(&x, &y);
        here.jacobian[6] = joined(&y, &x);
        here.jacobian[7] = *patch;
        here
    }
}

/// Returns whether Study's parameters are those of a pose: neither x nor its norm N is 0.
pub(super) fn is_pose(v: &Pose) -> bool {
    let [x, _] = parts(v);
    let size: f64 = x.iter().map(Complex::norm_sqr).sum();
    // Far from rounding; a pose nearer than that to none is not certified anyway.
    size > 1e-12 && scalar(&x, &x).norm() > 1e-10 * size
}
