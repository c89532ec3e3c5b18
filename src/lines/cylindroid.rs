//! The cylindroid of two screws.

use crate::algebra::enclosure::Enclosure;
use crate::displacement::answer::{Answer, Counted, Mode, Rounding, list};
use crate::kinematics::motion::{cross, dot};
use crate::verdict::Code;
use looproot_calculus::displacement::cylindroid::{Cylindroid, Pitched, cylindroid};
use looproot_calculus::line::pluecker::Line;
use rug::Rational;
use serde_json::{Map, json};

/// The principal screws of the surface.
pub fn answer(screws: &[Pitched<Rational>; 2]) -> Answer {
    let [one, two] = screws;
    if cross(&one.axis.direction, &two.axis.direction).iter().all(|c| *c == 0) {
        return Answer::none("the screws are parallel: they span no cylindroid");
    }
    let meet = one.axis.product(&two.axis) == 0;
    let is_flat = meet && one.pitch == two.pitch;
    if is_flat {
        return Answer::family(
            1,
            None,
            "the axes meet and the pitches are one: all screws of the flat pencil have that pitch, and every two perpendicular ones are principal",
        );
    }
    let enclosed = |screw: &Pitched<Rational>| {
        let vector = |v: &[Rational; 3]| v.each_ref().map(Enclosure::of);
        let axis = Line { direction: vector(&screw.axis.direction), moment: vector(&screw.axis.moment) };
        Pitched { axis, pitch: Enclosure::of(&screw.pitch) }
    };
    let modes = cylindroid(&enclosed(one), &enclosed(two)).map(|found| mode(&found)).into_iter().collect();
    let reason = "two screws that are not parallel span one cylindroid, and its pitches are the eigenvalues of a symmetric matrix";
    Answer::complete(modes, Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason: reason.into() })
}

fn mode(found: &Cylindroid<Enclosure>) -> Mode {
    let mut rounding = Rounding::default();
    // The first entry of a direction that is not 0 is positive.
    let mut signed = |v: &[Enclosure; 3]| {
        let v = rounding.vector(v);
        if v.iter().find(|x| **x != 0.0).is_some_and(|x| *x < 0.0) { v.map(|x| -x) } else { v }
    };
    let directions = [signed(&found.directions[0]), signed(&found.directions[1])];
    let axis = signed(&found.axis);
    let centre = rounding.vector(&found.centre);
    let pitches = rounding.vector(&found.pitches);
    let mut values = Map::new();
    values.insert("principal_pitches".into(), list(&pitches));
    values.insert("principal_directions".into(), json!(directions.map(|d| list(&d))));
    values.insert("axis".into(), json!({ "direction": list(&axis), "point": list(&centre) }));
    values.insert("length".into(), list(&[rounding.number(&found.length)])[0].clone());
    let residual = dot(&directions[0], &directions[1]).abs();
    Mode { real: true, multiplicity: 1, residual, radius: Some(rounding.radius), values }
}
