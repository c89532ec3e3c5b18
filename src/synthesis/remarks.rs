//! Remarks in words on special positions.

use super::equations::Wanted;
use super::poles::pole;
use crate::catalogue::Space;
use crate::kinematics::motion::Motion;
use rug::Rational;

/// Remarks on pairs of positions.
pub(super) fn remarks(wanted: &Wanted) -> Vec<String> {
    let mut remarks = Vec::new();
    let positions = &wanted.positions;
    for k in 0..positions.len() {
        if let Some(j) = (0..k).find(|j| positions[*j] == positions[k]) {
            remarks.push(format!("positions {} and {} are equal: they count once", j + 1, k + 1));
            continue;
        }
        if wanted.space != Space::Sphere
            && let Some(j) = (0..k).find(|j| positions[*j].rotation == positions[k].rotation)
        {
            remarks.push(format!("positions {} and {} differ by a translation only", j + 1, k + 1));
        }
    }
    if wanted.space == Space::Plane
        && let Some(pole) = common_pole(positions)
    {
        let [x, y] = pole;
        remarks.push(format!("all positions have the pole ({x}, {y}) in common: they are rotations about one point"));
    }
    remarks
}

/// Returns the point of the ground that all motions from the first position leave in place; `None` where there is none.
fn common_pole(positions: &[Motion<Rational>]) -> Option<[Rational; 2]> {
    let first = positions.first()?;
    let mut others = positions.iter().skip(1).filter(|motion| *motion != first).map(|motion| pole(first, motion));
    let pole = others.next()??;
    others.all(|other| other.as_ref() == Some(&pole)).then_some(pole)
}
