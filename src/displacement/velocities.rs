//! The motion of a body by the velocities and accelerations of three of its points.

use super::answer::{Answer, Named, list, number};
use crate::catalogue::planes::MovingPoint;
use crate::kinematics::motion::{Vector, cross, dot};
use looproot_calculus::displacement::velocity::{State, from_points};
use rug::Rational;
use serde_json::{Value, json};

fn sub(a: &Vector<Rational>, b: &Vector<Rational>) -> Vector<Rational> {
    std::array::from_fn(|i| Rational::from(&a[i] - &b[i]))
}

/// Returns angular velocity, velocity screw and its complex; with accelerations also the angular acceleration, the
/// acceleration pole and the axodes.
pub fn answer(points: &[MovingPoint; 3]) -> Answer {
    let pair = |i: usize| (sub(&points[(i + 1) % 3].at, &points[i].at), (i + 1) % 3, i);
    // The distance of two points is constant: their relative velocity is perpendicular to their difference.
    let is_rigid = (0..3).all(|i| {
        let (apart, to, from) = pair(i);
        dot(&apart, &sub(&points[to].velocity, &points[from].velocity)) == 0
    });
    if !is_rigid {
        return Answer::none("the velocities change a distance between the points: no motion of a body has them");
    }
    let Some((omega, velocity)) = from_points(&points.each_ref().map(|p| (p.at.clone(), p.velocity.clone()))) else {
        return Answer::none("the points lie in a line");
    };
    let mut named = Named::default();
    named.vector("angular_velocity", &omega);
    named.vector("velocity", &velocity);
    let zero = || -> Vector<Rational> { std::array::from_fn(|_| Rational::new()) };
    let mut state = State { omega, velocity, alpha: zero(), acceleration: zero() };
    put_screw(&mut named, &state);
    // The same motion seen from the body: the velocities of points of space relative to it.
    let negative = |v: &Vector<Rational>| v.each_ref().map(|c| Rational::from(-c));
    let inverse = named.rounded(&negative(&state.omega));
    let inverse =
        json!({ "angular_velocity": list(&inverse), "velocity": list(&named.rounded(&negative(&state.velocity))) });
    named.put("inverse", inverse);
    let accelerations: Option<Vec<&Vector<Rational>>> = points.iter().map(|p| p.acceleration.as_ref()).collect();
    let Some(accelerations) = accelerations else {
        return named.answer("the velocities of three points that are not in a line determine those of all points");
    };
    // Without the centripetal part accelerations behave as velocities, with alpha in place of omega.
    let rest: [_; 3] = std::array::from_fn(|k| {
        let inward = cross(&state.omega, &cross(&state.omega, &points[k].at));
        (points[k].at.clone(), sub(accelerations[k], &inward))
    });
    let is_rigid = (0..3).all(|i| {
        let (apart, to, from) = pair(i);
        dot(&apart, &sub(&rest[to].1, &rest[from].1)) == 0
    });
    let (true, Some((alpha, acceleration))) = (is_rigid, from_points(&rest)) else {
        return Answer::none("the accelerations change a distance between the points: no motion of a body has them");
    };
    (state.alpha, state.acceleration) = (alpha, acceleration);
    named.vector("angular_acceleration", &state.alpha);
    named.vector("acceleration", &state.acceleration);
    match state.acceleration_pole() {
        Some(pole) => named.vector("acceleration_pole", &pole),
        None => named.put("acceleration_pole", Value::Null),
    }
    put_axodes(&mut named, &state);
    named.answer("velocities and accelerations of three points that are not in a line determine those of all points")
}

/// Adds axis, pitch and rate, and the complex of the lines that are perpendicular to the velocities of their points.
fn put_screw(named: &mut Named, state: &State<Rational>) {
    let screw = state.screw().and_then(|screw| Some((screw.axis.point()?, screw)));
    let value = match &screw {
        Some((point, screw)) => {
            let mut own = Named::default();
            own.unit("direction", &screw.axis.direction);
            own.vector("point", point);
            own.number("pitch", &screw.pitch);
            own.length("rate", &state.omega);
            own.into_value()
        }
        None => Value::Null,
    };
    named.put("screw", value);
    let (a, b) = (named.rounded(&state.omega), named.rounded(&state.velocity));
    named.put("complex", json!({ "a": list(&a), "b": list(&b) }));
}

/// Adds striction point and distribution parameter of both axodes.
fn put_axodes(named: &mut Named, state: &State<Rational>) {
    let Some(found) = state.axodes() else {
        named.put("axodes", Value::Null);
        return;
    };
    let striction = named.rounded(&found.striction);
    let distribution = number(crate::algebra::number::nearest_f64(&found.distribution));
    named.put("axodes", json!({ "striction": list(&striction), "distribution": distribution }));
}
