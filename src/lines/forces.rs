//! Forces and couples as a screw, their power, and reciprocal screws.

use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::catalogue::lines::Wrench;
use crate::displacement::Answer;
use crate::displacement::answer::{Named, Rounding, list, number};
use crate::kinematics::motion::{Vector, cross, dot};
use crate::kinematics::screw_system::{Screw, ScrewSystem};
use looproot_calculus::displacement::cylindroid::Pitched;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::unit::{Unit, length};
use rug::Rational;
use serde_json::{Value, json};

/// The resultant of forces and couples: force and moment about the origin, central axis and pitch, and its power.
pub fn wrench(question: &Wrench) -> Answer {
    let zero = || -> Vector<Rational> { std::array::from_fn(|_| Rational::new()) };
    let add = |a: &Vector<Rational>, b: &Vector<Rational>| -> Vector<Rational> {
        std::array::from_fn(|i| Rational::from(&a[i] + &b[i]))
    };
    let force = question.forces.iter().fold(zero(), |sum, (_, force)| add(&sum, force));
    let moment = question.forces.iter().fold(zero(), |sum, (at, force)| add(&sum, &cross(at, force)));
    let moment = question.couples.iter().fold(moment, |sum, couple| add(&sum, couple));
    let mut named = Named::default();
    named.vector("force", &force);
    named.vector("moment", &moment);
    match Pitched::of_twist(&Line { direction: force.clone(), moment: moment.clone() }) {
        Some(screw) => {
            let mut own = Named::default();
            own.unit("direction", &screw.axis.direction);
            match screw.axis.point() {
                Some(point) => own.vector("point", &point),
                None => own.put("point", Value::Null),
            }
            own.number("pitch", &screw.pitch);
            own.length("magnitude", &force);
            named.put("screw", own.into_value());
        }
        // A couple alone, or nothing.
        None => named.put("screw", Value::Null),
    }
    let power = question.screws.iter().map(|turning| {
        let twist = turning.screw.twist();
        let product = dot(&force, &twist.moment).add(&dot(&moment, &twist.direction)).mul(&turning.rate);
        let unit = length(&twist.direction.each_ref().map(Enclosure::of)).and_then(|size| size.reciprocal());
        let power = unit.map(|unit| Rounding::default().number(&Enclosure::of(&product).mul(&unit)));
        json!({ "power": power.map_or(Value::Null, number), "reciprocal": product == 0 })
    });
    named.put("powers", power.collect());
    named.answer("forces and couples on a rigid body have one resultant screw")
}

/// The system of the screws and the one reciprocal to it: orders, bases, principal screws.
pub fn reciprocal(screws: &[Pitched<Rational>]) -> Answer {
    let one = |screw: &Pitched<Rational>| {
        let twist = screw.twist();
        Screw { direction: twist.direction, moment: twist.moment }
    };
    let system = ScrewSystem::of(&screws.iter().map(one).collect::<Vec<_>>());
    let reciprocal = system.reciprocal();
    let mut named = Named::default();
    named.put("order", json!(system.order()));
    named.put("reciprocal_order", json!(reciprocal.order()));
    named.put("principal_screws", principal(&system));
    named.put("reciprocal_principal_screws", principal(&reciprocal));
    let basis: Vec<Value> = reciprocal
        .basis()
        .iter()
        .map(|screw| {
            let mut own = Named::default();
            own.vector("direction", &screw.direction);
            own.vector("moment", &screw.moment);
            own.into_value()
        })
        .collect();
    named.put("reciprocal_basis", json!(basis));
    named.answer("the screws that do no work on n independent ones form a system of order 6 - n")
}

/// Pitches, directions and points of the principal screws, by rising pitch.
fn principal(system: &ScrewSystem<Rational>) -> Value {
    let float = |v: &Vector<Rational>| v.each_ref().map(nearest_f64);
    let basis: Vec<Screw<f64>> = system
        .basis()
        .iter()
        .map(|screw| Screw { direction: float(&screw.direction), moment: float(&screw.moment) })
        .collect();
    let (found, translations) = ScrewSystem::of(&basis).principal_screws();
    let shown = found.iter().map(|own| {
        let point = own.screw.foot().map_or(Value::Null, |point| list(&point));
        json!({ "pitch": number(own.pitch), "direction": list(&own.screw.direction), "point": point })
    });
    json!({ "screws": shown.collect::<Vec<_>>(), "translations": translations })
}
