//! Planes: through points, their lines, and what a linear complex makes of points, planes and lines.

use crate::catalogue::lines::Polarity;
use crate::displacement::Answer;
use crate::displacement::answer::Named;
use crate::kinematics::motion::Vector;
use looproot_calculus::line::plane::Plane;
use looproot_calculus::line::pluecker::Line;
use rug::Rational;
use serde_json::Value;

/// The plane through three points that are not in a line.
pub fn plane(points: &[Vector<Rational>; 3]) -> Answer {
    let plane = Plane::through(points);
    let mut named = Named::default();
    put_plane(&mut named, &plane);
    named.answer("three points that are not in a line lie in one plane")
}

/// Unit normal, and the point nearest the origin.
fn put_plane(named: &mut Named, plane: &Plane<Rational>) {
    named.unit("normal", &plane.normal);
    match plane.foot() {
        Some(foot) => {
            named.length("distance_from_origin", &foot);
            named.vector("foot", &foot);
        }
        None => named.put("foot", Value::Null),
    }
}

/// The line of two planes.
pub fn line([one, two]: &[Plane<Rational>; 2]) -> Answer {
    let line = one.meet(two);
    if line.direction.iter().any(|c| *c != 0) {
        let mut named = Named::default();
        put_line(&mut named, &line);
        return named.answer("two planes that are not parallel share one line");
    }
    if line.moment.iter().all(|c| *c == 0) {
        return Answer::family(2, None, "the two planes are one: every line of it lies in both");
    }
    Answer::none("the planes are parallel and share no line")
}

/// Direction of length 1, and the point nearest the origin.
fn put_line(named: &mut Named, line: &Line<Rational>) {
    named.unit("direction", &line.direction);
    match line.point() {
        Some(point) => named.vector("point", &point),
        None => named.put("point", Value::Null),
    }
}

/// Null planes of points, null points of planes, reciprocal polars of lines.
pub fn polarity(question: &Polarity) -> Answer {
    let complex = &question.complex;
    let mut named = Named::default();
    let planes = question.points.iter().map(|point| {
        let mut own = Named::default();
        own.vector("point", point);
        own.unit("normal", &complex.null_plane(point));
        own.into_value()
    });
    named.put("null_planes", planes.collect());
    let points = question.planes.iter().map(|plane| {
        let mut own = Named::default();
        own.unit("normal", &plane.normal);
        match complex.null_point(&plane.normal, &plane.distance) {
            Some(point) => own.vector("point", &point),
            None => own.put("point", Value::Null),
        }
        own.into_value()
    });
    named.put("null_points", points.collect());
    let polars = question.lines.iter().map(|line| match complex.polar(line) {
        Some(polar) => {
            let mut own = Named::default();
            put_line(&mut own, &polar);
            own.into_value()
        }
        // All null planes of a special complex contain its axis.
        None => Value::Null,
    });
    named.put("polars", polars.collect());
    named.answer("a linear complex pairs points with planes, and lines with lines, one to one")
}
