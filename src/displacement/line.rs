//! Displacements that take a line to a line.

use super::answer::{Answer, insert_motion, insert_rotation, screw};
use crate::algebra::dual::Dual;
use crate::algebra::number::nearest_f64;
use crate::catalogue::displacement::Through;
use looproot_calculus::line::pluecker::Line;
use looproot_calculus::rotation::line::taking;
use looproot_calculus::rotation::matrix::matrix;
use looproot_calculus::rotation::turn::Turn;
use rug::Rational;
use serde_json::{Map, Value};

/// Returns the family `(cos f/2 + l2 sin f/2) m`, with f any angle, or any dual angle for lines in space.
pub fn answer(lines: &[Line<Rational>; 2], through: Through) -> Answer {
    let float = |v: &[Rational; 3]| v.each_ref().map(nearest_f64);
    let [first, second] =
        lines.each_ref().map(|line| Line { direction: float(&line.direction), moment: float(&line.moment) }.unit());
    let sample = first.zip(second).and_then(|(first, second)| match through {
        Through::Origin => rotation(&first, &second),
        Through::Space => motion(&first, &second),
    });
    match through {
        Through::Origin => Answer::family(
            1,
            sample,
            "a half turn takes the first direction to the second, and every rotation about the second keeps it",
        ),
        Through::Space => Answer::family(
            2,
            sample,
            "a half turn takes the first line to the second, and every screw about the second keeps it",
        ),
    }
}

fn rotation(first: &Line<f64>, second: &Line<f64>) -> Option<Value> {
    let q = taking(&first.direction, &second.direction, &Turn::zero())?;
    let mut values = Map::new();
    insert_rotation(&mut values, &matrix(&q)?);
    Some(Value::Object(values))
}

/// Returns a motion between the lines. Over dual numbers the rotation is a screw, here by pi.
fn motion(first: &Line<f64>, second: &Line<f64>) -> Option<Value> {
    let half: Turn<Dual<f64>> = Turn::zero();
    let motion = taking(&first.dual(), &second.dual(), &half)?.to_motion()?;
    let mut values = Map::new();
    insert_motion(&mut values, &motion);
    values.insert("screw".into(), screw(&motion));
    Some(Value::Object(values))
}
