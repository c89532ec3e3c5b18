//! Bounds by exact incidences of axes: theorem 3 (a) and (b) of docs/certificate.md.

use super::chain::ChainClosure;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::Motion;

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
