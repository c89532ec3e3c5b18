//! The product of screws.

use super::answer::{Answer, Counted, Mode, Rounding, insert_motion, screw};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::number::HalfTangent;
use crate::algebra::ring::Ring;
use crate::catalogue::displacement::GivenScrew;
use crate::kinematics::motion::Motion;
use crate::verdict::Code;
use looproot_calculus::displacement::screw::motion;
use looproot_calculus::line::pluecker::Line;
use serde_json::Map;

/// Returns the displacement by all screws in their order.
pub fn answer(screws: &[GivenScrew]) -> Answer {
    let all = screws.iter().try_fold(Motion::<Enclosure>::identity(), |all, screw| Some(one(screw)?.then_after(&all)));
    let modes = all.map(|all| {
        let (found, radius) = rounded(&all);
        let mut values = Map::new();
        insert_motion(&mut values, &found);
        values.insert("screw".into(), screw(&found));
        Mode { real: true, multiplicity: 1, residual: 0.0, radius: Some(radius), values }
    });
    let reason = "a product of displacements is one displacement".to_owned();
    Answer::complete(
        modes.into_iter().collect(),
        Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason },
    )
}

/// Returns a motion in f64, and a bound on the distance of its numbers from those enclosed.
pub(super) fn rounded(motion: &Motion<Enclosure>) -> (Motion<f64>, f64) {
    let mut rounding = Rounding::default();
    let rotation = rounding.matrix(&motion.rotation);
    (Motion { rotation, translation: rounding.vector(&motion.translation) }, rounding.radius)
}

/// Returns the motion of a screw, enclosed.
pub(super) fn one(screw: &GivenScrew) -> Option<Motion<Enclosure>> {
    let enclosed = |v: &[rug::Rational; 3]| v.each_ref().map(Enclosure::of);
    let axis = Line { direction: enclosed(&screw.axis.direction), moment: enclosed(&screw.axis.moment) }.unit()?;
    let (cos, sin) = match &screw.half_tangent {
        HalfTangent::Infinite => (Enclosure::zero(), Enclosure::one()),
        HalfTangent::Finite(t) => (Enclosure::one(), Enclosure::of(t)),
    };
    motion(&axis, &cos, &sin, &Enclosure::of(&screw.translation))
}
