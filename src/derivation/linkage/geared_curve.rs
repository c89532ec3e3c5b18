//! The curve of a point of a linkage with gears, from its sections with lines ([`Track`]).

use super::closure::Part;
use super::trace::{Curve, factors_of, mean};
use crate::derivation::interpolation::{COMPARED, Watch};
use crate::derivation::ring_curve::Track;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Gaussian, Given, Linkage};
use crate::linkage::assembly::{glued, groups_of};
use crate::linkage::gears::GearedEquations;
use rug::Rational;

/// Returns the curve of a mean of points of bodies, each with its share, while the first given value moves and the others are held.
///
/// # Errors
/// As [`groups_of`], for numbers that are not rational, and as [`Track::curve`].
pub(super) fn geared_curve(
    linkage: &Linkage,
    given: &[Given],
    points: &[(usize, Gaussian, Rational)],
    watch: &Watch<'_>,
) -> Result<Curve> {
    if !given.is_empty() {
        groups_of(linkage, given)?;
    }
    let held = given.get(1..).unwrap_or_default();
    let joints = glued(linkage, held)?.1.into_iter().map(|(joint, _)| joint).collect();
    let (track, bodies) = track(linkage, held, joints, points).ok_or_else(|| {
        let message = "the curve of a point of this linkage with gears is not derived: its numbers are not rational, its unknowns are too \
                       many, or its bodies are not joined without the gears";
        Error::Unsupported(message.to_owned())
    })?;
    let found = track.curve(watch)?;
    let (polynomial, rows) =
        found.ok_or_else(|| Error::Invalid("found a point that rests, expected one that moves".to_owned()))?;
    let factors = factors_of(&polynomial);
    let polynomial = polynomial.square_free_part();
    Ok(Curve { bodies, polynomial, removed: Vec::new(), rows, factors, compared: Some(COMPARED) })
}

/// Returns the places of the mean, and the bodies of the linkage.
fn track(
    linkage: &Linkage,
    held: &[Given],
    joints: Vec<usize>,
    points: &[(usize, Gaussian, Rational)],
) -> Option<(Track, Vec<usize>)> {
    let mut part = Part::new(linkage, held, joints)?;
    part.group.gears = (0..linkage.joints.len()).filter(|joint| linkage.joints[*joint].is_gear()).collect();
    let equations = GearedEquations::of(linkage, &part.closure, &part.group, &part.state)?;
    let traced = mean(&part.closure, &part.state, linkage.ground, points)?.exact()?;
    let at = equations.place(&traced, part.class_of(linkage.ground)?.0)?;
    let track = Track { unknowns: equations.unknowns, equations: equations.list, at: at.to_vec(), square: None };
    Some((track, (0..linkage.bodies.len()).collect()))
}
