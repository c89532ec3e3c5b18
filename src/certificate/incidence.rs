//! Bounds by exact incidences of axes and points: theorem 3 of docs/certificate.md.

use super::chain::ChainClosure;
use super::platform::PlatformClosure;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::{Motion, cross};
use rug::Rational;

/// Returns the least bound of all triples of neighbouring axes of a loop; `None` if there is none.
pub(super) fn of_axes(closure: &ChainClosure) -> Option<usize> {
    let turns = |k: usize| closure.variables[k % 6] == Variable::Rotation;
    let translations = |first: usize| (first + 3..first + 6).filter(|&k| !turns(k)).count();
    let bound = |first: usize| {
        if !(first..first + 3).all(turns) || !closure.spherical.is_empty() {
            return None;
        }
        let (before, behind) = (first % 6, (first + 1) % 6);
        let (parallel, meet) = match &closure.exact {
            Some(links) => incidence(&links[before], &links[behind]),
            None => incidence(&closure.links[before], &closure.links[behind]),
        };
        // A point is brought to its place in at most 4, 4, 2 or 1 ways, and each leaves two rotations about it. A direction
        // is brought to its place, with the height along it, in 4 ways by three rotations and in 2 by two and a translation.
        let of_point = meet.then(|| 2 * [4, 4, 2, 1][translations(first)]);
        let of_direction = parallel.then(|| [Some(8), Some(4), None, None][translations(first)]).flatten();
        of_point.into_iter().chain(of_direction).min()
    };
    (0..6).filter_map(bound).min()
}

/// Returns whether the three axes at two links are parallel, and whether they meet in a point; `false` if neither is seen.
fn incidence<R: Ring>(before: &Motion<R>, behind: &Motion<R>) -> (bool, bool) {
    let is_along = |link: &Motion<R>| link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero();
    let parallel = is_along(before) && is_along(behind);
    let on_axis = |link: &Motion<R>| link.translation[0].is_zero() && link.translation[1].is_zero();
    // Both neighbours pass through the origin of the middle one.
    let plain = on_axis(before) && on_axis(behind) && behind.translation[2].is_zero();
    let meet = || {
        let (one, other) = (crossing(&before.inverse())?, crossing(behind)?);
        Some(one[0].mul(&other[1]).sub(&other[0].mul(&one[1])).is_zero())
    };
    (parallel, !parallel && (plain || meet() == Some(true)))
}

/// Returns the point of the z axis at which its image under a link crosses it, as a quotient.
fn crossing<R: Ring>(link: &Motion<R>) -> Option<[R; 2]> {
    let ([x, y, z], [u, v, w]) = (&link.translation, [0, 1, 2].map(|i| &link.rotation[i][2]));
    let square = u.mul(u).add(&v.mul(v));
    let along = x.mul(u).add(&y.mul(v));
    let is_crossed = x.mul(v).sub(&y.mul(u)).is_zero() && !square.is_zero();
    is_crossed.then(|| [z.mul(&square).sub(&along.mul(w)), square])
}

/// Returns 16 if three legs meet in a point, or if all legs meet in pairs in the corners of a triangle.
pub(super) fn of_points(closure: &PlatformClosure) -> Option<usize> {
    let points = closure.exact.as_ref()?;
    (points.iter().any(three_meet) || points.iter().any(in_pairs)).then_some(16)
}

type Points = [[Rational; 3]; 6];

fn three_meet(points: &Points) -> bool {
    (0..6).any(|i| points.iter().filter(|point| **point == points[i]).count() >= 3)
}

fn in_pairs(points: &Points) -> bool {
    let mut corners: Vec<&[Rational; 3]> = Vec::new();
    for point in points {
        if points.iter().filter(|other| *other == point).count() != 2 {
            return false;
        }
        if !corners.contains(&point) {
            corners.push(point);
        }
    }
    let [a, b, c] = corners.as_slice() else { return false };
    let side = |p: &[Rational; 3]| -> [Rational; 3] { std::array::from_fn(|k| Rational::from(&p[k] - &a[k])) };
    cross(&side(b), &side(c)).iter().any(|x| *x != 0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_meet_in_pairs_or_in_threes() {
        let points = |list: [[i32; 3]; 6]| list.map(|p| p.map(Rational::from));
        let (a, b, c, d) = ([0, 0, 0], [1, 0, 0], [0, 1, 0], [2, 0, 0]);
        assert!(in_pairs(&points([a, b, c, a, b, c])) && !in_pairs(&points([a, b, d, a, b, d])));
        assert!(three_meet(&points([a, b, c, a, d, a])) && !three_meet(&points([a, b, c, a, d, b])));
    }
}
