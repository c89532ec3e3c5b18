//! Two spherical joints and one variable: the distance of their centres, degree 2.
//!
//! `|V p - p0|^2 = |l|^2` for the centre p of the first spherical joint seen from behind V, p0 of the second one from before it,
//! and the link l between them: linear in (1, cos, sin), or of degree 2 in the distance. The spin of the link about l
//! is idle: it changes no distance and is no unknown.

use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::{SsDyad, Variable};
use crate::kinematics::motion::{Vector, dot};

/// `equation . m = 0` over the monomials (1, cos q, sin q) or (1, d, d^2) of V.
#[must_use]
pub fn equation<R: Ring>(ss_dyad: &SsDyad<R>) -> [R; 3] {
    let (p, far) = (&ss_dyad.behind.translation, ss_dyad.before.inverse().translation);
    let square = dot(&ss_dyad.link.translation, &ss_dyad.link.translation);
    match ss_dyad.variable {
        Variable::Rotation => {
            let twice = |x: R| x.add(&x).neg();
            let constant = dot(p, p).add(&dot(&far, &far)).sub(&square).add(&twice(p[2].mul(&far[2])));
            let cos = p[0].mul(&far[0]).add(&p[1].mul(&far[1]));
            let sin = p[0].mul(&far[1]).sub(&p[1].mul(&far[0]));
            [constant, twice(cos), twice(sin)]
        }
        Variable::Translation => {
            let w: Vector<R> = std::array::from_fn(|i| p[i].sub(&far[i]));
            [dot(&w, &w).sub(&square), w[2].add(&w[2]), R::one()]
        }
    }
}

/// Returns the exact number of positions; `None` where V is not determined.
#[must_use]
pub fn count<F: Field>(ss_dyad: &SsDyad<F>) -> Option<usize> {
    let [constant, first, second] = equation(ss_dyad);
    match (first.is_zero() && second.is_zero(), constant.is_zero()) {
        (false, _) => Some(2),
        (true, false) => Some(0),
        (true, true) => None,
    }
}
