//! The displacement of points.

use super::answer::{Answer, Counted, Mode, insert_motion, screw};
use crate::algebra::number::nearest_f64;
use crate::kinematics::motion::Motion;
use crate::verdict::Code;
use looproot_calculus::displacement::points::{Moved, nearest, of_three, residual, spread};
use looproot_calculus::rotation::positions::is_rotation;
use rug::Rational;
use serde_json::Map;

/// Returns the displacement that takes all points to their images, or the nearest one.
pub fn answer(points: &[Moved<Rational>]) -> Answer {
    let before: Vec<_> = points.iter().map(|p| p.0.clone()).collect();
    let found =
        spread(&before).and_then(|[i, j, k]| of_three(&[points[i].clone(), points[j].clone(), points[k].clone()]));
    let float = |v: &[Rational; 3]| v.each_ref().map(nearest_f64);
    let floats: Vec<Moved<f64>> = points.iter().map(|(p, q)| (float(p), float(q))).collect();
    let exact =
        found.filter(|motion| is_rotation(&motion.rotation) && points.iter().all(|(p, q)| motion.apply(p) == *q));
    let mode = |motion: &Motion<f64>, radius: Option<f64>| {
        let mut values = Map::new();
        insert_motion(&mut values, motion);
        values.insert("screw".into(), screw(motion));
        Mode { real: true, multiplicity: 1, residual: residual(&floats, motion), radius, values }
    };
    if let Some(motion) = exact {
        let rounded =
            Motion { rotation: motion.rotation.each_ref().map(float), translation: float(&motion.translation) };
        let largest =
            rounded.rotation.iter().flatten().chain(&rounded.translation).fold(0.0_f64, |m, x| m.max(x.abs()));
        // Each entry is the nearest f64 of a rational number.
        let modes = vec![mode(&rounded, Some(largest * f64::EPSILON))];
        let reason = "three points that are not in a line have one displacement, and distances are kept".to_owned();
        return Answer::complete(modes, Counted { complex: 1, code: Code::GeneralBoundMet, at_infinity: 0, reason });
    }
    let reason = "the distances of the points are not kept exactly: the nearest displacement is listed";
    Answer::nearest(nearest(&floats).map(|motion| mode(&motion, None)), reason)
}
