//! Strapdown inertial navigation: orientation, velocity and place of a body from what its instruments measure.
//!
//! Angular velocity w and specific force f are constant in axes of the body within every interval of length T. There the orientation is
//! `R exp(W t)` with `W p = w x p`, and `v' = R exp(W t) f + g` has an integral in closed form; the square of W is that of the
//! length of w, so that `exp(W t)` and its integrals are combinations of 1, W and W^2. \[Wittenburg2016, 9.10\]

use super::answer::{Answer, Counted, Mode, Rounding, insert_rotation, list, number};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::HalfTangent;
use crate::algebra::ring::Ring;
use crate::catalogue::navigation::{Interval, Navigation};
use crate::kinematics::motion::{Motion, Vector, cross};
use crate::verdict::Code;
use looproot_calculus::quaternion::Quaternion;
use looproot_calculus::rotation::matrix::{from_matrix, matrix};
use looproot_calculus::rotation::rates::{corrected, quaternion_rate};
use looproot_calculus::rotation::vectors::{from_axis_angle, unit};
use looproot_calculus::unit::direction;
use rug::Rational;
use serde_json::{Map, Value, json};

/// The state of the body, enclosed.
struct State {
    orientation: Motion<Enclosure>,
    velocity: Vector<Enclosure>,
    position: Vector<Enclosure>,
}

fn enclosed(v: &Vector<Rational>) -> Vector<Enclosure> {
    v.each_ref().map(Enclosure::of)
}

/// `a + c b`
fn plus(a: &Vector<Enclosure>, c: &Enclosure, b: &Vector<Enclosure>) -> Vector<Enclosure> {
    std::array::from_fn(|k| a[k].add(&c.mul(&b[k])))
}

/// The angle of an interval.
fn angle(interval: &Interval) -> Option<Enclosure> {
    let half = match &interval.half_tangent {
        HalfTangent::Infinite => Enclosure::pi().scaled(&Rational::from((1, 2))),
        HalfTangent::Finite(t) => Enclosure::of(t).atan2(&Enclosure::one())?,
    };
    Some(half.add(&half).add(&Enclosure::pi().scaled(&Rational::from(2 * interval.turns))))
}

impl State {
    /// The state behind an interval.
    fn after(&self, interval: &Interval, gravity: &Vector<Enclosure>) -> Option<Self> {
        let axis = direction(&enclosed(&interval.axis))?;
        let theta = angle(interval)?;
        let is_still = matches!(&interval.half_tangent, HalfTangent::Finite(t) if *t == 0) && interval.turns == 0;
        let (one, half) = (Enclosure::one(), Rational::from((1, 2)));
        let (cos, sin) = match &interval.half_tangent {
            HalfTangent::Infinite => (one.neg(), Enclosure::zero()),
            HalfTangent::Finite(t) => {
                let square = Rational::from(t.square_ref());
                let whole = Rational::from(&square + 1);
                (Enclosure::of(&((1 - square) / &whole)), Enclosure::of(&(Rational::from(t * 2) / whole)))
            }
        };
        let duration = Enclosure::of(&interval.duration);
        let square = duration.mul(&duration);
        // exp(W t) and its first and second integral over the interval are 1, W/|w|, (W/|w|)^2 times these, and powers of T.
        let turned = [one.clone(), sin.clone(), one.sub(&cos)];
        let (first, second) = if is_still {
            (
                [one.clone(), Enclosure::zero(), Enclosure::zero()],
                [Enclosure::of(&half), Enclosure::zero(), Enclosure::zero()],
            )
        } else {
            let inverse = one.over(&theta)?;
            let inverse_square = inverse.mul(&inverse);
            let first = [one.clone(), one.sub(&cos).mul(&inverse), theta.sub(&sin).mul(&inverse)];
            let cubic = theta.mul(&theta).scaled(&half).add(&cos).sub(&one);
            let second = [Enclosure::of(&half), theta.sub(&sin).mul(&inverse_square), cubic.mul(&inverse_square)];
            (first, second)
        };
        let apply = |parts: &[Enclosure; 3], v: &Vector<Enclosure>| {
            let once = cross(&axis, v);
            let twice = cross(&axis, &once);
            let scaled: Vector<Enclosure> = std::array::from_fn(|k| parts[0].mul(&v[k]));
            plus(&plus(&scaled, &parts[1], &once), &parts[2], &twice)
        };
        let force = enclosed(&interval.force);
        let gained = self.orientation.rotate(&apply(&first, &force));
        let moved = self.orientation.rotate(&apply(&second, &force));
        let velocity = plus(&plus(&self.velocity, &duration, &gained), &duration, gravity);
        let fall = square.scaled(&half);
        let position = plus(&plus(&plus(&self.position, &duration, &self.velocity), &square, &moved), &fall, gravity);
        let mut own = Motion::identity();
        for j in 0..3 {
            let column = apply(&turned, &std::array::from_fn(|i| if i == j { one.clone() } else { Enclosure::zero() }));
            for (row, entry) in own.rotation.iter_mut().zip(column) {
                row[j] = entry;
            }
        }
        Some(Self { orientation: self.orientation.then_after(&own), velocity, position })
    }
}

/// Returns orientation, velocity and place behind all intervals.
pub fn answer(given: &Navigation) -> Answer {
    let start = State {
        orientation: Motion { rotation: given.rotation.each_ref().map(enclosed), ..Motion::identity() },
        velocity: enclosed(&given.velocity),
        position: enclosed(&given.position),
    };
    let gravity = enclosed(&given.gravity);
    let end = given.intervals.iter().try_fold(start, |state, interval| state.after(interval, &gravity));
    let Some(end) = end else { return Answer::none("an interval has no axis") };
    let mut rounding = Rounding::default();
    let rotation = rounding.matrix(&end.orientation.rotation);
    let mut values = Map::new();
    insert_rotation(&mut values, &rotation);
    values.insert("velocity".into(), list(&rounding.vector(&end.velocity)));
    values.insert("position".into(), list(&rounding.vector(&end.position)));
    if let Some(drift) = given.steps.and_then(|steps| drift(given, steps.max(1), &rotation)) {
        values.insert("drift".into(), drift);
    }
    let reason = "angular velocity and specific force are constant in the body within every interval, and the equations have an integral in \
                  closed form";
    let mode = Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(rounding.radius), values };
    Answer::complete(
        vec![mode],
        Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.to_owned() },
    )
}

/// Integrates the kinematic differential equations of the Euler-Rodrigues parameters by steps of fourth order, with and without correction
/// of their norm: how far norm and orientation are off. In f64.
fn drift(given: &Navigation, steps: usize, end: &[[f64; 3]; 3]) -> Option<Value> {
    let float = |v: &Vector<Rational>| v.each_ref().map(Rational::to_f64);
    let start = unit(&from_matrix(&given.rotation.each_ref().map(float)))?;
    let run = |is_corrected: bool| -> Option<Quaternion<f64>> {
        let mut q = start.clone();
        let mut exact = start.clone();
        for interval in &given.intervals {
            let angle = angle(interval)?.middle().to_f64();
            let axis = direction(&float(&interval.axis))?;
            #[expect(clippy::cast_precision_loss, reason = "at most ten thousand")]
            let share = angle / steps as f64;
            // The axis stands still in space too; the unit of time is that in which the body turns by one radian.
            let omega = Motion { rotation: matrix(&exact)?, translation: [0.0; 3] }.rotate(&axis);
            let plus = |q: &Quaternion<f64>, rate: &Quaternion<f64>, by: f64| Quaternion {
                scalar: q.scalar + by * rate.scalar,
                vector: std::array::from_fn(|k| q.vector[k] + by * rate.vector[k]),
            };
            for _ in 0..steps {
                let first = quaternion_rate(&q, &omega)?;
                let second = quaternion_rate(&plus(&q, &first, share / 2.0), &omega)?;
                let third = quaternion_rate(&plus(&q, &second, share / 2.0), &omega)?;
                let last = quaternion_rate(&plus(&q, &third, share), &omega)?;
                for (rate, part) in [(first, 6.0), (second, 3.0), (third, 3.0), (last, 6.0)] {
                    q = plus(&q, &rate, share / part);
                }
                if is_corrected {
                    q = corrected(&q)?;
                }
            }
            exact = exact.mul(&from_axis_angle(&axis, &angle)?);
        }
        Some(q)
    };
    let off = |q: &Quaternion<f64>| {
        let rows = matrix(q)?;
        Some(rows.iter().flatten().zip(end.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
    };
    let (free, kept) = (run(false)?, run(true)?);
    let norm = |q: &Quaternion<f64>| number(q.norm().sqrt() - 1.0);
    Some(json!({
        "steps": steps, "norm": norm(&free), "corrected_norm": norm(&kept),
        "error": number(off(&free)?), "corrected_error": number(off(&kept)?),
    }))
}
