//! Generators of ruled surfaces, and the hyperboloids of two bodies that turn about skew lines.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::catalogue::planes::Turning;
use crate::displacement::Answer;
use crate::displacement::answer::{Counted, Mode, Named, Rounding, list, number};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::verdict::Code;
use looproot_calculus::displacement::cylindroid::Pitched;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::line::ruled;
use looproot_calculus::unit::{Unit, length};
use rug::Rational;
use serde_json::{Map, Value, json};

/// Striction point and distribution parameter.
pub fn generator([line, rate]: &[Line<Rational>; 2]) -> Answer {
    let mut named = Named::default();
    let Some(found) = ruled::generator(line, rate) else {
        let reason =
            "the direction stands still: the surface is a cylinder, and every point of the line a striction point";
        return Answer::family(1, None, reason);
    };
    named.vector("striction", &found.striction);
    named.number("distribution", &found.distribution);
    let is_developable = found.distribution == 0;
    named.put("developable", json!(is_developable));
    let reason = if is_developable {
        "neighbouring generators meet: the surface is developable there"
    } else {
        "neighbouring generators are skew: the striction point is the foot of their common perpendicular"
    };
    named.answer(reason)
}

/// The twist of a turning body.
fn twist(turning: &Turning) -> Option<Line<Enclosure>> {
    let enclosed = |v: &Vector<Rational>| v.each_ref().map(Enclosure::of);
    let axis = &turning.screw.axis;
    let axis = Line { direction: enclosed(&axis.direction), moment: enclosed(&axis.moment) }.unit()?;
    let (rate, pitch) = (Enclosure::of(&turning.rate), Enclosure::of(&turning.screw.pitch));
    let unit = Pitched { axis, pitch }.twist();
    let scaled = |v: &Vector<Enclosure>| v.each_ref().map(|c| c.mul(&rate));
    Some(Line { direction: scaled(&unit.direction), moment: scaled(&unit.moment) })
}

/// The screw of the second body against the first, and the hyperboloids about both axes on which that screw lies.
pub fn relative(both: &[Turning; 2]) -> Answer {
    let nothing = || Answer::none("the bodies do not turn against one another");
    let (Some(one), Some(two)) = (twist(&both[0]), twist(&both[1])) else { return nothing() };
    let sub = |a: &Vector<Enclosure>, b: &Vector<Enclosure>| -> Vector<Enclosure> {
        std::array::from_fn(|i| a[i].sub(&b[i]))
    };
    let against = Line { direction: sub(&two.direction, &one.direction), moment: sub(&two.moment, &one.moment) };
    let Some((rate, screw)) = length(&against.direction).zip(Pitched::of_twist(&against)) else { return nothing() };
    let (Some(axis), Some(point)) = (screw.axis.unit(), screw.axis.point()) else { return nothing() };
    let mut rounding = Rounding::default();
    let mut values = Map::new();
    let shown = json!({
        "direction": list(&rounding.vector(&axis.direction)),
        "point": list(&rounding.vector(&point)),
        "pitch": number(rounding.number(&screw.pitch)),
        "rate": number(rounding.number(&rate)),
    });
    values.insert("screw".into(), shown);
    values.insert("sliding".into(), number(rounding.number(&screw.pitch.mul(&rate))));
    let surface = |turning: &Turning, rounding: &mut Rounding| -> Option<Value> {
        let enclosed = |v: &Vector<Rational>| v.each_ref().map(Enclosure::of);
        let own = &turning.screw.axis;
        let own = Line { direction: enclosed(&own.direction), moment: enclosed(&own.moment) }.unit()?;
        let across = cross(&own.direction, &axis.direction);
        let sine = length(&across)?;
        let cosine = dot(&own.direction, &axis.direction);
        let throat = own.product(&axis).mul(&sine.reciprocal()?);
        let angle = rounding.number(&sine).atan2(rounding.number(&cosine));
        Some(json!({ "throat": number(rounding.number(&throat).abs()), "angle": number(angle) }))
    };
    // Parallel to the axis of a body the screw has a cylinder in place of a hyperboloid.
    let surfaces: Vec<Value> =
        both.iter().map(|turning| surface(turning, &mut rounding).unwrap_or(Value::Null)).collect();
    values.insert("hyperboloids".into(), json!(surfaces));
    let mode = Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(rounding.radius), values };
    let reason = "the relative motion is one screw; carried about both axes it sweeps hyperboloids that roll and slide on one another";
    let counted = Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.to_owned() };
    Answer::complete(vec![mode], counted)
}
