//! Bounds on the number of solutions of a loop, with the words for them.

use crate::elimination::degree::Degree;
use crate::exact::MOST_WITH_TRIPLE;
use crate::verdict::{Bound, Code, Proof};

/// The phrase that says on which computation counts rest.
pub(super) const MODULO: &str = "modulo a prime drawn at run time";

/// The degree of closure polynomials as a bound; `place` says where it holds.
pub(super) fn of_cuts(degree: Degree, place: &str) -> Bound {
    let all = degree.solutions + degree.left_out;
    let because = if degree.left_out == 0 {
        format!("a closure polynomial of degree {all} {place}")
    } else {
        format!(
            "a closure polynomial of degree {all}, of whose roots {} belong to no solution {place} ({MODULO})",
            degree.left_out
        )
    };
    Bound { count: degree.solutions, proof: Proof::None, code: Code::CountMet, because }
}

/// The bound of arms with three neighbouring axes that are parallel or meet in a point, with the proof that they do.
pub(super) fn of_triple(proof: Proof) -> Bound {
    Bound {
        count: MOST_WITH_TRIPLE,
        proof,
        code: Code::GeometryBoundMet,
        because: format!(
            "at most {MOST_WITH_TRIPLE} that an arm with three neighbouring axes parallel or through one point can have"
        ),
    }
}

/// The dimension of the ring of a loop as a bound.
pub(super) fn of_ring(count: usize) -> Bound {
    let because = if count == 0 {
        format!("the closure equations, of which 1 is a combination at this pose ({MODULO})")
    } else {
        format!("the closure equations, whose ring has dimension {count} at this pose ({MODULO})")
    };
    Bound { count, proof: Proof::None, code: Code::CountMet, because }
}
