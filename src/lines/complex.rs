//! The linear complex of five lines.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::displacement::answer::{Answer, Counted, Mode, Rounding, list, number};
use crate::kinematics::motion::Vector;
use crate::verdict::Code;
use looproot_calculus::line::complex::{Complex, containing};
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::unit::{Unit, direction, length};
use rug::Rational;
use serde_json::{Map, Value, json};

/// The complex with its pitch and axis, and the null planes of points.
pub fn answer(lines: &[Line<Rational>], points: &[Vector<Rational>]) -> Answer {
    let basis = containing(lines);
    let [complex] = basis.as_slice() else {
        let rank = 6 - basis.len();
        let reason =
            format!("the five lines have rank {rank}, and a system of {} complexes contains them", basis.len());
        return Answer::family(basis.len() - 1, None, reason);
    };
    let modes = mode(complex, points).into_iter().collect();
    let reason = "five lines of rank 5 lie in one linear complex".to_owned();
    Answer::complete(modes, Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason })
}

fn mode(complex: &Complex<Rational>, points: &[Vector<Rational>]) -> Option<Mode> {
    let enclosed = |v: &Vector<Rational>| v.each_ref().map(Enclosure::of);
    let has_axis = complex.a.iter().any(|c| *c != 0);
    // The first entry that is not 0 is positive.
    let first = complex.a.iter().chain(&complex.b).find(|c| **c != 0)?;
    let sign = if *first < 0 { Rational::from(-1) } else { Rational::from(1) };
    let own = Complex { a: complex.a.each_ref().map(|c| c.mul(&sign)), b: complex.b.each_ref().map(|c| c.mul(&sign)) };
    let scale = length(&enclosed(if has_axis { &own.a } else { &own.b }))?.reciprocal()?;
    let scaled = |v: &Vector<Rational>| enclosed(v).map(|c| c.mul(&scale));
    let mut rounding = Rounding::default();
    let (a, b) = (rounding.vector(&scaled(&own.a)), rounding.vector(&scaled(&own.b)));
    let mut values = Map::new();
    values.insert("complex".into(), json!({ "a": list(&a), "b": list(&b) }));
    values.insert("pitch".into(), own.pitch().map_or(Value::Null, |q| number(rounding.number(&Enclosure::of(&q)))));
    let axis = own.axis_point().map(|point| {
        let point = rounding.vector(&enclosed(&point));
        json!({ "direction": list(&a), "point": list(&point) })
    });
    values.insert("axis".into(), axis.unwrap_or(Value::Null));
    let planes = points.iter().map(|point| {
        let normal = direction(&enclosed(&own.null_plane(point))).map(|normal| list(&rounding.vector(&normal)));
        json!({ "point": list(&point.each_ref().map(crate::algebra::number::nearest_f64)), "normal": normal })
    });
    let planes: Vec<Value> = planes.collect();
    values.insert("null_planes".into(), json!(planes));
    Some(Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(rounding.radius), values })
}
