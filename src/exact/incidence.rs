//! Three neighbouring axes that are parallel or meet in a point, exactly: such an arm has at most 8 solutions at any pose.
//!
//! Where three axes meet in a point, the other three joints have to bring that point to its place, which has at most 4 solutions,
//! and each leaves two orientations of the three; for three parallel axes the direction takes the place of the point.
//! \[Pieper1968\]

use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::{OpenLoop, Variable};
use crate::kinematics::motion::Motion;

/// Upper bound on the number of solutions of a loop of six rotations with such a triple.
pub const MOST_WITH_TRIPLE: usize = 8;

/// Returns whether three neighbouring axes of six rotations are parallel or meet in one point, whatever the pose. Over enclosures
/// that is proved by numbers enclosed by 0 alone.
#[must_use]
pub fn has_triple<R: Ring>(open: &OpenLoop<R>) -> bool {
    let is_rotation = |variable: &Variable| *variable == Variable::Rotation;
    open.variables.iter().all(is_rotation)
        && open.constants.windows(2).any(|links| {
            let [before, behind] = [&links[0], &links[1]];
            let parallel = is_parallel(before) && is_parallel(behind);
            parallel
                || crossing(&before.inverse()).zip(crossing(behind)).is_some_and(|(one, other)| is_same(&one, &other))
        })
}

/// Whether a link keeps the direction of the z axis.
fn is_parallel<R: Ring>(link: &Motion<R>) -> bool {
    link.rotation[0][2].is_zero() && link.rotation[1][2].is_zero()
}

/// Returns the point at which a link's image of the z axis crosses the z axis, as a quotient; `None` where it does not cross, or
/// is parallel.
fn crossing<R: Ring>(link: &Motion<R>) -> Option<[R; 2]> {
    let ([x, y, z], [u, v, w]) = (&link.translation, [0, 1, 2].map(|i| &link.rotation[i][2]));
    // (x, y) + s (u, v) = 0
    if !x.mul(v).sub(&y.mul(u)).is_zero() {
        return None;
    }
    // An enclosure of it may hold 0: then the axes may coincide, and each of their points is one at which they meet.
    let square = u.mul(u).add(&v.mul(v));
    let along = x.mul(u).add(&y.mul(v));
    (!square.is_zero()).then(|| [z.mul(&square).sub(&along.mul(w)), square])
}

/// Whether two quotients are one number. Enclosures that are equal may enclose different numbers; a difference of exactly 0 says so.
fn is_same<R: Ring>([one, below]: &[R; 2], [other, beneath]: &[R; 2]) -> bool {
    one.mul(beneath).sub(&other.mul(below)).is_zero()
}
