//! The motion X with `A X = X B`.

use super::answer::{Answer, Counted, Mode, insert_motion};
use crate::algebra::number::nearest_f64;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::verdict::Code;
use looproot_calculus::finite::finite;
use looproot_calculus::rotation::calibration::{Translation, nearest, residual, translation};
use looproot_calculus::rotation::matrix::{Matrix, from_matrix};
use looproot_calculus::rotation::positions::{is_rotation, taking};
use looproot_calculus::rotation::vectors::{euler_vectors, unit};
use looproot_calculus::unit::{Root, direction};
use rug::Rational;
use serde_json::{Map, Value};

type Pair = (Motion<Rational>, Motion<Rational>);

/// Returns every motion that fits all pairs, or the nearest one.
pub fn answer(pairs: &[Pair]) -> Result<Answer> {
    let turning: Vec<Turning> = pairs.iter().map(Turning::of).collect();
    if turning.iter().any(|pair| !pair.agrees) {
        let reason = "the angles of A and B differ in some pair: no motion fits exactly";
        return Ok(if pairs.len() == 1 { Answer::none(reason) } else { nearest_fit(pairs, reason) });
    }
    let first = turning.iter().find(|pair| pair.turns());
    let second = first.and_then(|first| turning.iter().find(|pair| pair.turns() && !parallel(&pair.a, &first.a)));
    match (first, second) {
        (Some(first), Some(second)) => of_two(pairs, first, second),
        (Some(first), None) if turning.len() == 1 => Ok(one_pair(&pairs[0], first)),
        (None, _) if turning.len() == 1 => Ok(one_translation(&pairs[0])),
        _ => Err(Error::Unsupported(
            "several pairs of a calibration with parallel axes, or without rotation: add a pair with another axis"
                .to_owned(),
        )),
    }
}

/// The condition of a pair on the rotation: its axes, and whether it can be satisfied at all.
struct Turning {
    a: Vector<Rational>,
    b: Vector<Rational>,
    /// Whether the angle is pi, where the sign of the axis is free.
    is_half: bool,
    /// Whether the cosines of the angles are equal.
    agrees: bool,
}

impl Turning {
    /// Scales the axes so that X takes b to a: by the scalar parts of the quaternions, for a rotation by pi by the norm if that
    /// is rational.
    fn of((a, b): &Pair) -> Self {
        let (p, q) = (from_matrix(&a.rotation), from_matrix(&b.rotation));
        let (wp, wq) = (p.scalar.clone(), q.scalar.clone());
        let (sp, sq) = (dot(&p.vector, &p.vector), dot(&q.vector, &q.vector));
        let agrees = Rational::from(wp.square_ref()) * &sq == Rational::from(wq.square_ref()) * &sp;
        let is_half = wp == 0 && sp != 0;
        let scaled = |v: &Vector<Rational>, by: &Rational| {
            if *by == 0 { v.clone() } else { v.each_ref().map(|c| Rational::from(c / by)) }
        };
        let (a, mut b) = (scaled(&p.vector, &wp), scaled(&q.vector, &wq));
        if is_half
            && agrees
            && let Some(ratio) = Root::sqrt(&Rational::from(&sp / &sq))
        {
            b = b.map(|c| c * &ratio);
        }
        Self { a, b, is_half, agrees }
    }

    fn turns(&self) -> bool {
        self.a.iter().any(|c| *c != 0)
    }
}

fn parallel(u: &Vector<Rational>, v: &Vector<Rational>) -> bool {
    cross(u, v).iter().all(|c| *c == 0)
}

/// Solves for the rotation from two axes that are not parallel, which is unique up to signs at rotations by pi.
fn of_two(pairs: &[Pair], first: &Turning, second: &Turning) -> Result<Answer> {
    let signs = |pair: &Turning| if pair.is_half { vec![1, -1] } else { vec![1] };
    let signed = |v: &Vector<Rational>, sign: i32| v.each_ref().map(|c| Rational::from(c * sign));
    let mut modes = Vec::new();
    for s in signs(first) {
        for t in signs(second) {
            let before = [first.b.clone(), second.b.clone()];
            let after = [signed(&first.a, s), signed(&second.a, t)];
            let Some(rotation) = taking(&before, &after) else { continue };
            let fits =
                is_rotation(&rotation) && pairs.iter().all(|(a, b)| commutes(&a.rotation, &rotation, &b.rotation));
            if !fits {
                continue;
            }
            if let Translation::One(found) = translation(pairs, &rotation) {
                modes.push(mode(&Motion { rotation, translation: found }));
            }
        }
    }
    if modes.is_empty() {
        let irrational = first.is_half && dot(&first.a, &first.a) != dot(&first.b, &first.b)
            || second.is_half && dot(&second.a, &second.a) != dot(&second.b, &second.b);
        if irrational && pairs.len() < 3 {
            let message = "half turns of a calibration whose axes have an irrational ratio of lengths: add a pair that is no half turn";
            return Err(Error::Unsupported(message.to_owned()));
        }
        return Ok(nearest_fit(pairs, "no motion fits all pairs exactly"));
    }
    let complex = modes.len();
    let reason =
        "two axes that are not parallel determine the rotation, and the translation solves linear equations of rank 3";
    Ok(Answer::complete(
        modes,
        Counted { complex, code: Code::GeometryBoundMet, at_infinity: 0, reason: reason.into() },
    ))
}

/// Returns whether `A X = X B` for rotations.
fn commutes(a: &Matrix<Rational>, x: &Matrix<Rational>, b: &Matrix<Rational>) -> bool {
    use looproot_calculus::rotation::matrix::product;
    product(a, x) == product(x, b)
}

fn mode(x: &Motion<Rational>) -> Mode {
    let rounded = float(x);
    let mut values = Map::new();
    insert_motion(&mut values, &rounded);
    let radius = radius(x);
    Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(radius), values }
}

/// Returns the largest rounding error of an entry.
fn radius(x: &Motion<Rational>) -> f64 {
    let entries = x.rotation.iter().flatten().chain(&x.translation);
    let apart = |q: &Rational| {
        let exact = Rational::from_f64(nearest_f64(q)).unwrap_or_default();
        nearest_f64(&(q - exact)).abs()
    };
    entries.map(apart).fold(0.0, f64::max)
}

fn float(x: &Motion<Rational>) -> Motion<f64> {
    Motion {
        rotation: x.rotation.each_ref().map(|row| row.each_ref().map(nearest_f64)),
        translation: x.translation.each_ref().map(nearest_f64),
    }
}

/// Solves one pair, which leaves a rotation about the axis of A and a translation along it, if the translations agree.
fn one_pair((a, b): &Pair, pair: &Turning) -> Answer {
    // The translation along the axis, over its length: rational where the axes are scaled alike.
    let along = |v: &Vector<Rational>, t: &Vector<Rational>| dot(v, t);
    let (of_a, of_b) = (along(&pair.a, &a.translation), along(&pair.b, &b.translation));
    let lengths =
        Rational::from(&of_a * &of_a) * dot(&pair.b, &pair.b) == Rational::from(&of_b * &of_b) * dot(&pair.a, &pair.a);
    let same_sign = pair.is_half || (of_a >= 0) == (of_b >= 0) || of_a == 0;
    if !lengths || !same_sign {
        return Answer::none("the translations of A and B along their axes differ: no motion fits");
    }
    let reason = "one pair: a rotation about the axis of A and a translation along it are free; a second pair with another axis determines X";
    Answer::family(2, sample(a, b), reason)
}

/// Returns a motion that fits one pair.
fn sample(a: &Motion<Rational>, b: &Motion<Rational>) -> Option<Value> {
    let (a, b) = (float(a), float(b));
    let axis = |m: &Motion<f64>| direction(&euler_vectors(&unit(&from_matrix(&m.rotation))?)[0]);
    let (u, v) = (axis(&a)?, axis(&b)?);
    let half = looproot_calculus::rotation::turn::Turn::zero();
    let flip = looproot_calculus::rotation::line::taking(&v, &u, &half)?;
    let rotation = looproot_calculus::rotation::matrix::matrix(&flip)?;
    let pairs = [(a, b)];
    // The least translation among those that fit.
    let rows = nalgebra::Matrix3::from_fn(|i, j| pairs[0].0.rotation[i][j] - f64::from(u8::from(i == j)));
    let turned = looproot_calculus::rotation::matrix::apply(&rotation, &pairs[0].1.translation);
    let right = nalgebra::Vector3::from_fn(|i, _| turned[i] - pairs[0].0.translation[i]);
    let t = finite(rows).svd(true, true).solve(&right, 1e-9).ok()?;
    let x = Motion { rotation, translation: [t[0], t[1], t[2]] };
    let mut values = Map::new();
    insert_motion(&mut values, &x);
    (residual(&pairs, &x) < 1e-6).then_some(Value::Object(values))
}

/// Solves a pair without rotation: X takes one translation to the other, and its own translation is free.
fn one_translation((a, b): &Pair) -> Answer {
    let (s, t) = (&a.translation, &b.translation);
    if dot(s, s) != dot(t, t) {
        return Answer::none("A and B are translations of different lengths: no motion fits");
    }
    let dimension = if dot(s, s) == 0 { 6 } else { 4 };
    Answer::family(dimension, None, "A and B have no rotation: they leave the translation of X free")
}

/// Returns the motion that fits best.
fn nearest_fit(pairs: &[Pair], reason: &str) -> Answer {
    let pairs: Vec<(Motion<f64>, Motion<f64>)> = pairs.iter().map(|(a, b)| (float(a), float(b))).collect();
    let mode = nearest(&pairs).map(|x| {
        let mut values = Map::new();
        insert_motion(&mut values, &x);
        Mode { real: true, multiplicity: 1, residual: residual(&pairs, &x), radius: None, values }
    });
    Answer::nearest(mode, format!("{reason}; the nearest one is listed"))
}
