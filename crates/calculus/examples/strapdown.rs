//! Strapdown inertial navigation: the orientation of a body from its angular velocity alone, by the kinematic differential
//! equations of Euler-Rodrigues parameters, with and without correction of their norm. \[Wittenburg2016, 9.10 and 10.9\]
//!
//! The body moves on a cone: `q(t) = Rz(t) Rx(a) Rz(-t)`, the motion at which errors of gyroscopes show most.

use looproot_algebra::dual::Dual;
use looproot_calculus::motion::Vector;
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::rates::{angular_velocity, corrected, quaternion_rate};
use looproot_calculus::unit::Analytic;

/// The half angle of the cone.
const CONE: f64 = 0.2;

/// The orientation at a time, which over dual numbers carries its rate.
fn orientation<R: Analytic>(time: &R, half: &R, cone: &R) -> Quaternion<R> {
    let (cos, sin) = time.mul(half).cos_sin_of();
    let (cos_cone, sin_cone) = cone.mul(half).cos_sin_of();
    let about_z = Quaternion { scalar: cos, vector: [R::zero(), R::zero(), sin] };
    let about_x = Quaternion { scalar: cos_cone, vector: [sin_cone, R::zero(), R::zero()] };
    about_z.mul(&about_x).mul(&about_z.conjugate())
}

/// What the gyroscopes measure at a time.
fn gyroscopes(time: f64) -> Option<Vector<f64>> {
    let moving = Dual { value: time, epsilon: 1.0 };
    angular_velocity(&orientation(&moving, &Dual::constant(0.5), &Dual::constant(CONE)))
}

/// Integrates over one turn with steps of order 4; returns the error of the orientation and that of the norm.
fn navigate(steps: u32, is_corrected: bool) -> Option<[f64; 2]> {
    let step = std::f64::consts::TAU / f64::from(steps);
    let plus = |q: &Quaternion<f64>, rate: &Quaternion<f64>, by: f64| Quaternion {
        scalar: q.scalar + by * rate.scalar,
        vector: std::array::from_fn(|k| q.vector[k] + by * rate.vector[k]),
    };
    let mut q = orientation(&0.0, &0.5, &CONE);
    for k in 0..steps {
        let time = f64::from(k) * step;
        let rate = |q: &Quaternion<f64>, time: f64| quaternion_rate(q, &gyroscopes(time)?);
        let first = rate(&q, time)?;
        let second = rate(&plus(&q, &first, step / 2.0), time + step / 2.0)?;
        let third = rate(&plus(&q, &second, step / 2.0), time + step / 2.0)?;
        let last = rate(&plus(&q, &third, step), time + step)?;
        for (rate, share) in [(first, 6.0), (second, 3.0), (third, 3.0), (last, 6.0)] {
            q = plus(&q, &rate, step / share);
        }
        if is_corrected {
            q = corrected(&q)?;
        }
    }
    let off = plus(&q, &orientation(&0.0, &0.5, &CONE), -1.0);
    Some([off.norm().sqrt(), (q.norm().sqrt() - 1.0).abs()])
}

/// Prints the errors after one turn, and asserts their order.
pub fn main() {
    let mut last = f64::INFINITY;
    for steps in [16, 32, 64, 128] {
        let errors = navigate(steps, false).zip(navigate(steps, true));
        assert!(errors.is_some(), "a quaternion of norm 0");
        let Some(([free, drift], [kept, norm])) = errors else { return };
        println!(
            "{steps:4} steps: error {free:.1e}, norm off by {drift:.1e}; corrected: error {kept:.1e}, norm off by {norm:.1e}"
        );
        assert!(norm < 1e-14 && kept < last / 8.0, "errors of order 4, and a norm of 1");
        last = kept;
    }
}
