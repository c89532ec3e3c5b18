//! Remarks in words on special positions.

use super::equations::Wanted;
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

/// The point of the body that stands at the same place of the ground in two positions, in the ground's coordinates.
fn pole(one: &Motion<Rational>, other: &Motion<Rational>) -> Option<[Rational; 2]> {
    // From the first position to the second: x -> R x + t, and (I - R) x = t.
    let relative = other.then_after(&one.inverse());
    let (cos, sin) = (&relative.rotation[0][0], &relative.rotation[1][0]);
    let [x, y, _] = &relative.translation;
    let off = Rational::from(1 - cos);
    let square = Rational::from(&off * &off) + Rational::from(sin * sin);
    if square == 0 {
        return None;
    }
    let first = Rational::from(&off * x) - Rational::from(sin * y);
    let second = Rational::from(sin * x) + Rational::from(&off * y);
    Some([first / &square, second / square])
}
