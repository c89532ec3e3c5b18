//! Displacements with some property: answers, with a verdict, to the questions of files of kind `displacement`.
//!
//! The formulas are those of `looproot_calculus`. Signs and zeros are decided over the rationals. Listed values are
//! computed in enclosures of many digits and rounded once, so that their distance from the solution is known.

pub mod answer;
mod calibration;
mod elements;
mod line;
mod navigation;
mod points;
mod positions;
mod resultant;
mod surface;
mod three_rotations;
mod tile;
mod velocities;

use crate::catalogue::displacement::Displacement;
use crate::error::Result;
pub use answer::{Answer, Mode};

/// Returns the answers to a question, one for each of its problems.
///
/// # Errors
/// [`crate::error::Error::Unsupported`] for several pairs of a calibration with parallel axes.
pub fn answers(question: &Displacement) -> Result<Vec<Answer>> {
    Ok(match question {
        Displacement::Elements(places, values) => vec![elements::answer(*places, values)],
        Displacement::ThreeRotations(axes, rotations) => {
            rotations.iter().map(|rotation| three_rotations::answer(axes, rotation)).collect()
        }
        Displacement::Calibration(pairs) => vec![calibration::answer(pairs)?],
        Displacement::Resultant(screws) => vec![resultant::answer(screws)],
        Displacement::Points(points) => vec![points::answer(points)],
        Displacement::Line(lines, through) => vec![line::answer(lines, *through)],
        Displacement::Circle(points) => vec![positions::circle(points)],
        Displacement::Between(both, share) => vec![positions::slerp(both, share)],
        Displacement::Relative(positions) => vec![positions::relative(positions)],
        Displacement::Reflections(planes) => vec![positions::reflections(planes)],
        Displacement::Midpoints(screw, points) => vec![positions::midpoints(screw, points)],
        Displacement::Surface(motion) => vec![surface::answer(motion)],
        Displacement::Navigation(given) => vec![navigation::answer(given)],
        Displacement::Tile(given) => vec![tile::answer(given)],
        Displacement::Velocities(points) => vec![velocities::answer(points)],
    })
}
