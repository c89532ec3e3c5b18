//! Three neighbouring axes that are parallel or meet in a point, exactly: such an arm has at most 8 solutions at any pose.
//!
//! Of three axes through a point the other three joints have to bring that point to its place, which has at most 4 solutions,
//! and each leaves two orientations of the three; of three parallel axes the direction takes the place of the point.
//! \[Pieper1968\]

use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::{OpenLoop, Variable};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// The most solutions of a loop of six rotations with such a triple.
pub const MOST_WITH_TRIPLE: usize = 8;

/// Whether three neighbouring ones of six rotations have parallel axes, or axes through one point, whatever the pose.
#[must_use]
pub fn has_triple(open: &OpenLoop<Rational>) -> bool {
    let is_rotation = |variable: &Variable| *variable == Variable::Rotation;
    open.variables.iter().all(is_rotation)
        && open.constants.windows(2).any(|links| {
            let [before, behind] = [&links[0], &links[1]];
            let parallel = is_parallel(before) && is_parallel(behind);
            parallel || crossing(&before.inverse()).is_some_and(|place| Some(place) == crossing(behind))
        })
}

/// Whether a link keeps the direction of the z axis.
fn is_parallel(link: &Motion<Rational>) -> bool {
    link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero()
}

/// Where on the z axis the image of the z axis under a link crosses it; `None` where it does not, or lies parallel.
fn crossing(link: &Motion<Rational>) -> Option<Rational> {
    let ([x, y, z], [u, v, w]) = (&link.translation, [0, 1, 2].map(|i| &link.rotation[i][2]));
    // (x, y) + s (u, v) = 0
    if !x.mul(v).sub(&y.mul(u)).is_zero() {
        return None;
    }
    let inverse = u.mul(u).add(&v.mul(v)).inverse()?;
    let s = x.mul(u).add(&y.mul(v)).mul(&inverse).neg();
    Some(z.add(&s.mul(w)))
}
