//! A rotation as three rotations about given axes.

use super::answer::{Answer, Counted, Mode, Rounding, insert_rotation, list, number, pairs};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::kinematics::motion::{Vector, cross};
use crate::verdict::Code;
use looproot_calculus::rotation::matrix::{Matrix, apply, product};
use looproot_calculus::rotation::three_axes::{Equation, angles, turned, with_root};
use looproot_calculus::rotation::turn::Turn;
use looproot_calculus::unit::direction;
use num_complex::Complex;
use rug::Rational;
use serde_json::{Map, Value};
use std::cmp::Ordering;

/// Returns all angles about the three axes.
pub fn answer(axes: &[Vector<Rational>; 3], rotation: &Matrix<Rational>) -> Answer {
    let equation = Equation::of(axes, rotation);
    let amplitude = equation.amplitude_squared();
    let mut keys = Map::new();
    let found = if amplitude == 0 {
        keys.insert("ratio".into(), Value::Null);
        without_amplitude(axes, rotation, &equation)
    } else {
        let square = Rational::from(equation.right.square_ref()) / &amplitude;
        keys.insert("ratio".into(), number(nearest_f64(&square).sqrt()));
        with_amplitude(axes, rotation, &equation)
    };
    Answer { keys: keys.into_iter().chain(found.keys).collect(), ..found }
}

/// Solves the case in which both coefficients of the equation vanish, because the outer axes are parallel to the middle one
/// or one of them is: the middle angle is free, or there is no solution.
fn without_amplitude(
    axes: &[Vector<Rational>; 3],
    rotation: &Matrix<Rational>,
    equation: &Equation<Rational>,
) -> Answer {
    if equation.right != 0 {
        return Answer::none("an outer axis is parallel to the middle one, and the rotation does not keep their angle");
    }
    let parallel = |u: &Vector<Rational>, v: &Vector<Rational>| cross(u, v).iter().all(|c| *c == 0);
    let [n1, n2, n3] = axes;
    // With all axes parallel two angles are free; with two parallel axes one, since only their sum counts.
    let dimension = if parallel(n1, n2) && parallel(n2, n3) { 2 } else { 1 };
    let sample = sample(axes, rotation).map(|q| list(&q));
    Answer::family(dimension, sample, "neighbouring axes are parallel: only the sum of their angles is determined")
}

/// Returns angles with the middle one 0, or the first one if the middle axis is parallel to the last.
fn sample(axes: &[Vector<Rational>; 3], rotation: &Matrix<Rational>) -> Option<[f64; 3]> {
    let axes = float_axes(axes)?;
    let rotation = rotation.each_ref().map(|row| row.each_ref().map(nearest_f64));
    // Rot(n1, t1) Rot(n3, t3) with t2 = 0: the solver accepts any axis between.
    let [n1, _, n3] = axes;
    let between = direction(&cross(&n1, &n3)).unwrap_or_else(|| across(&n1));
    let found = angles(&[n1, between, n3], &rotation)?.into_iter().next()?;
    let second = found[1].angle()?;
    // The solver's own middle angle must vanish for this to be a sample.
    (second.abs() < 1e-6).then_some([found[0].angle()?, 0.0, found[2].angle()?])
}

/// Returns a unit vector perpendicular to one.
fn across(n: &[f64; 3]) -> [f64; 3] {
    let least = (0..3).min_by(|i, j| n[*i].abs().total_cmp(&n[*j].abs())).unwrap_or(0);
    let unit: [f64; 3] = std::array::from_fn(|i| f64::from(u8::from(i == least)));
    direction(&cross(n, &unit)).unwrap_or(unit)
}

fn float_axes(axes: &[Vector<Rational>; 3]) -> Option<[[f64; 3]; 3]> {
    let [a, b, c] = axes.each_ref().map(|axis| direction(&axis.each_ref().map(nearest_f64)));
    Some([a?, b?, c?])
}

fn with_amplitude(axes: &[Vector<Rational>; 3], rotation: &Matrix<Rational>, equation: &Equation<Rational>) -> Answer {
    let discriminant = equation.discriminant();
    let counted =
        |reason: &str| Counted { complex: 2, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.to_owned() };
    match discriminant.cmp0() {
        Ordering::Less => {
            let modes = complex_modes(axes, rotation);
            Answer::complete(
                modes,
                counted("the middle angle has a quadratic equation without real root: the ratio is above 1"),
            )
        }
        Ordering::Equal if cross(&axes[0], &apply(rotation, &axes[2])).iter().all(|c| *c == 0) => {
            let sample = family_sample(axes, rotation, equation).map(|q| list(&q));
            Answer::family(
                1,
                sample,
                "the last axis is taken to the first one: only the sum or the difference of their angles is determined",
            )
        }
        ordering => {
            let modes = real_modes(axes, rotation, ordering == Ordering::Equal);
            let what = if ordering == Ordering::Equal { "a double root" } else { "two real roots" };
            Answer::complete(modes, counted(&format!("the middle angle has a quadratic equation with {what}")))
        }
    }
}

/// Returns angles of the family at a critical place, the last one 0.
fn family_sample(
    axes: &[Vector<Rational>; 3],
    rotation: &Matrix<Rational>,
    equation: &Equation<Rational>,
) -> Option<[f64; 3]> {
    let unit = float_axes(axes)?;
    let rotation = rotation.each_ref().map(|row| row.each_ref().map(nearest_f64));
    let amplitude = nearest_f64(&equation.amplitude_squared());
    let length = nearest_f64(&equation.square).sqrt();
    let right = nearest_f64(&equation.right);
    let (cos, sin) =
        (nearest_f64(&equation.cos) * right / amplitude, nearest_f64(&equation.sin) * length * right / amplitude);
    let middle = Turn { cos, sin };
    // Rot(n1, t1) = R Rot(n2, t2)^-1
    let rest = product(&rotation, &turned(&unit[1], &middle.negated())?);
    let side = across(&unit[0]);
    let first = Turn::between(&unit[0], &side, &apply(&rest, &side))?;
    Some([first.angle()?, middle.angle()?, 0.0])
}

fn real_modes(axes: &[Vector<Rational>; 3], rotation: &Matrix<Rational>, is_double: bool) -> Vec<Mode> {
    let enclosed = |v: &Vector<Rational>| direction(&v.each_ref().map(Enclosure::of));
    let [Some(a), Some(b), Some(c)] = axes.each_ref().map(enclosed) else { return Vec::new() };
    let own = [a, b, c];
    let matrix = rotation.each_ref().map(|row| row.each_ref().map(Enclosure::of));
    let equation = Equation::of(&own, &matrix);
    let found = if is_double {
        with_root(&own, &matrix, &equation, &Enclosure::zero()).map(|turns| vec![turns])
    } else {
        angles(&own, &matrix)
    };
    let exact = rotation.each_ref().map(|row| row.each_ref().map(nearest_f64));
    let mode = |turns: [Turn<Enclosure>; 3]| {
        let mut rounding = Rounding::default();
        let [a, b, c] = turns.each_ref().map(angle_of);
        let q = rounding.vector(&[a?, b?, c?]);
        let mut values = Map::new();
        values.insert("q".into(), list(&q));
        insert_rotation(&mut values, &exact);
        let residual = residual(axes, &exact, &q).unwrap_or(f64::NAN);
        let multiplicity = if is_double { 2 } else { 1 };
        Some(Mode { real: true, multiplicity, residual, radius: Some(rounding.radius), values })
    };
    found.into_iter().flatten().filter_map(mode).collect()
}

/// Encloses the angle in (-pi, pi]: near pi by the opposite direction, so that no enclosure crosses the cut.
fn angle_of(turn: &Turn<Enclosure>) -> Option<Enclosure> {
    if *turn.cos.middle() >= 0 {
        return turn.sin.atan2(&turn.cos);
    }
    let opposite = turn.sin.neg().atan2(&turn.cos.neg())?.settled();
    let is_above = turn.sin.holds_zero() || *turn.sin.middle() > 0;
    Some(if is_above { opposite.add(&Enclosure::pi()) } else { opposite.sub(&Enclosure::pi()) })
}

/// Returns the largest entry by which the product of the three rotations differs from the given one.
fn residual(axes: &[Vector<Rational>; 3], rotation: &Matrix<f64>, q: &[f64; 3]) -> Option<f64> {
    let [n1, n2, n3] = float_axes(axes)?;
    let turn = |axis: &[f64; 3], angle: &f64| turned(axis, &Turn::of_angle(angle));
    let all = product(&product(&turn(&n1, &q[0])?, &turn(&n2, &q[1])?), &turn(&n3, &q[2])?);
    let entries = all.iter().flatten().zip(rotation.iter().flatten());
    Some(entries.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max))
}

/// Returns the two complex solutions, in f64.
fn complex_modes(axes: &[Vector<Rational>; 3], rotation: &Matrix<Rational>) -> Vec<Mode> {
    let Some(unit) = float_axes(axes) else { return Vec::new() };
    let complex = |x: f64| Complex { re: x, im: 0.0 };
    let own = unit.map(|axis| axis.map(complex));
    let matrix = rotation.each_ref().map(|row| row.each_ref().map(|q| complex(nearest_f64(q))));
    let equation = Equation::of(&own, &matrix);
    let root = equation.discriminant().sqrt();
    // cos + i sin = exp(i angle)
    let angle = |turn: &Turn<Complex<f64>>| {
        let i = Complex { re: 0.0, im: 1.0 };
        -i * (turn.cos + i * turn.sin).ln()
    };
    let mode = |root: Complex<f64>| {
        let turns = with_root(&own, &matrix, &equation, &root)?;
        let mut values = Map::new();
        values.insert("q".into(), pairs(&turns.each_ref().map(angle)));
        Some(Mode { real: false, multiplicity: 1, residual: 0.0, radius: None, values })
    };
    [root, -root].into_iter().filter_map(mode).collect()
}
