//! Positions of a body: on a circle, between two others, behind reflections, about a screw.

use super::answer::{Answer, Counted, Mode, Named, homogeneous, insert_motion, insert_rotation, list, number, screw};
use super::resultant::{one, rounded};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::catalogue::displacement::GivenScrew;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::verdict::Code;
use looproot_calculus::displacement::screw::midpoint_perpendicular;
use looproot_calculus::line::plane::Plane;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::rotation::matrix::{Matrix, from_matrix, matrix};
use looproot_calculus::rotation::positions::{between, circle_axis};
use looproot_calculus::unit::Unit;
use rug::Rational;
use serde_json::{Map, Value, json};

fn sub(a: &Vector<Rational>, b: &Vector<Rational>) -> Vector<Rational> {
    std::array::from_fn(|i| Rational::from(&a[i] - &b[i]))
}

/// Returns the rotation of a point of the body through three positions: axis, centre of the circle, angles of the three steps.
pub fn circle(points: &[Vector<Rational>; 3]) -> Answer {
    let axis = circle_axis(points);
    let (a, b) = (sub(&points[1], &points[0]), sub(&points[2], &points[0]));
    // The centre relative to the first point: (|b|^2 (n x a) + |a|^2 (b x n))/(2 n.n).
    let (to, back) = (cross(&axis, &a), cross(&b, &axis));
    let twice = dot(&axis, &axis).mul(&Rational::from(2));
    let Some(share) = twice.reciprocal() else { return Answer::none("the points lie in a line") };
    let (square_a, square_b) = (dot(&a, &a), dot(&b, &b));
    let centre: Vector<Rational> = std::array::from_fn(|i| {
        let sum = Rational::from(&square_b * &to[i]) + Rational::from(&square_a * &back[i]);
        sum * &share + &points[0][i]
    });
    let arms = points.each_ref().map(|point| sub(point, &centre));
    let length = nearest_f64(&dot(&axis, &axis)).sqrt();
    let step = |k: usize| {
        let (from, to) = (&arms[k], &arms[(k + 1) % 3]);
        let sine = nearest_f64(&dot(&axis, &cross(from, to))) / length;
        sine.atan2(nearest_f64(&dot(from, to)))
    };
    let mut named = Named::default();
    named.unit("axis", &axis);
    named.vector("centre", &centre);
    named.length("radius_of_circle", &arms[0]);
    named.put("angles", list(&[step(0), step(1), step(2)]));
    named.answer(
        "three points that are not in a line lie on one circle, and a rotation takes one to the next about its normal",
    )
}

/// Returns the rotation at a share of the way.
pub fn slerp([from, to]: &[Matrix<Rational>; 2], share: &Rational) -> Answer {
    let float = |m: &Matrix<Rational>| m.each_ref().map(|row| row.each_ref().map(nearest_f64));
    let quaternion = |m: &Matrix<Rational>| -> Quaternion<f64> { from_matrix(&float(m)) };
    let (start, end) = (quaternion(from), quaternion(to));
    // For a relative rotation by pi there are two shortest ways: the trace of to from^T is -1.
    let trace = (0..3).fold(Rational::new(), |sum, i| sum + dot(&from[i], &to[i]));
    let ways = if trace == -1 { 2 } else { 1 };
    let other = Quaternion { scalar: -end.scalar, vector: end.vector.map(|c| -c) };
    let mut modes = Vec::new();
    for target in [end, other].iter().take(ways) {
        let found = between(&start, target, &nearest_f64(share)).and_then(|q| matrix(&q));
        let Some(rows) = found else { continue };
        let mut values = Map::new();
        insert_rotation(&mut values, &rows);
        modes.push(Mode { real: true, multiplicity: 1, residual: 0.0, radius: None, values });
    }
    let reason = if ways == 2 {
        "the rotations are half a turn apart: two ways are shortest"
    } else {
        "one way between the rotations is shortest, at constant angular velocity about one axis"
    };
    let counted = Counted { complex: ways, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.to_owned() };
    Answer::complete(modes, counted)
}

/// Returns the rotations that take every position to every later one: `R_j R_i^T`, with axes in space. Of four positions there are six.
pub fn relative(positions: &[Matrix<Rational>]) -> Answer {
    let mut named = Named::default();
    let mut list = Vec::new();
    for (from, start) in positions.iter().enumerate() {
        for (to, end) in positions.iter().enumerate().skip(from + 1) {
            let step: Matrix<Rational> = std::array::from_fn(|i| std::array::from_fn(|j| dot(&end[i], &start[j])));
            let rotation = step.each_ref().map(|row| named.rounded(row));
            let motion = Motion { rotation, translation: [0.0; 3] };
            let turn = screw(&motion);
            let mut values = Map::new();
            values.insert("from".into(), json!(from + 1));
            values.insert("to".into(), json!(to + 1));
            // The identity has no axis.
            let is_identity = step == Motion::<Rational>::identity().rotation;
            values.insert("axis".into(), if is_identity { Value::Null } else { turn["direction"].clone() });
            values.insert("angle".into(), turn["angle"].clone());
            insert_rotation(&mut values, &rotation);
            list.push(Value::Object(values));
        }
    }
    named.put("relative", Value::Array(list));
    named.answer("the rotation from one position to another is the second one after the inverse of the first")
}

/// Returns the product of reflections: a displacement for an even number, else one behind a reflection.
pub fn reflections(planes: &[Plane<Rational>]) -> Answer {
    let all = planes.iter().try_fold(Motion::<Rational>::identity(), |all, p| Some(p.mirror()?.then_after(&all)));
    let Some(all) = all else { return Answer::none("a plane without normal reflects nothing") };
    let mut named = Named::default();
    let rotation = all.rotation.each_ref().map(|row| named.rounded(row));
    let motion = Motion { rotation, translation: named.rounded(&all.translation) };
    let is_displacement = planes.len().is_multiple_of(2);
    named.put("determinant", json!(if is_displacement { 1 } else { -1 }));
    if is_displacement {
        let mut values = Map::new();
        insert_motion(&mut values, &motion);
        for (name, value) in values {
            named.put(&name, value);
        }
        named.put("screw", screw(&motion));
        return named
            .answer("an even number of reflections is a displacement; two turn by twice the angle of their planes");
    }
    named.put("matrix", homogeneous(&motion));
    named.answer("an odd number of reflections changes the sense of rotation and is no displacement")
}

/// Returns Roth's lines: through the midpoint of a point and its image, perpendicular to their chord, cutting the axis at a
/// right angle.
pub fn midpoints(given: &GivenScrew, points: &[Vector<Rational>]) -> Answer {
    let Some((motion, radius)) = one(given).map(|motion| rounded(&motion)) else {
        return Answer::none("the screw has no axis");
    };
    let float = |v: &Vector<Rational>| v.each_ref().map(nearest_f64);
    let axis = Line { direction: float(&given.axis.direction), moment: float(&given.axis.moment) };
    let mut values = Map::new();
    insert_motion(&mut values, &motion);
    let line = |point: &Vector<Rational>| {
        let before = float(point);
        let image = motion.apply(&before);
        let found = axis.unit().and_then(|axis| midpoint_perpendicular(&motion, &axis, &before)?.unit());
        let miss = found.as_ref().zip(axis.unit()).map(|(line, axis)| line.product(&axis));
        let line = found.map_or(Value::Null, |l| json!({ "direction": list(&l.direction), "moment": list(&l.moment) }));
        json!({ "point": list(&before), "image": list(&image), "line": line, "gap": miss.map_or(Value::Null, number) })
    };
    values.insert("midpoints".into(), points.iter().map(line).collect());
    let mode = Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(radius), values };
    let reason = "the perpendicular to chord and axis through the midpoint of the chord cuts the axis at a right angle";
    let counted = Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.to_owned() };
    Answer::complete(vec![mode], counted)
}
