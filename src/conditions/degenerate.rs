//! The cases besides the curves on which both joints move: locked joints, and twists of 0 or pi.

use super::closure_identity::{Member, closes};
use super::four_bar::LENGTHS;
use super::step::Step;
use super::twist_family::Ratio;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::derivation::transference::{SpatialPair, Variables};

type Poly = Polynomial<Int>;

fn ratio(p: Poly) -> Ratio {
    (p, Poly::one())
}

/// Returns the angle pi.
fn pi() -> Ratio {
    (Poly::one(), Poly::zero())
}

/// Returns the loop whose links 1, 2 and 3, 4 are folded onto one another, so that axes 1 and 3 coincide.
#[must_use]
pub fn folded() -> [Member; 4] {
    let v = Poly::variable;
    let x = v(Variables::X);
    let member = |theta: Ratio, d: Poly, link: usize| Member {
        theta,
        d,
        alpha: ratio(v(Variables::twist(link))),
        a: v(Variables::length(link)),
    };
    let d = v(Variables::offset(0));
    [
        member(ratio(x.clone()), d.clone(), 0),
        member(pi(), Poly::zero(), 0),
        member(ratio(x.neg()), d.neg(), 2),
        member(pi(), Poly::zero(), 2),
    ]
}

/// Treats folds, in which one joint is locked.
pub(super) fn folds(steps: &mut Vec<Step>) {
    steps.push(Step {
        title: "Folds".to_owned(),
        text: "Where one joint k stands still and no sine of a twist is zero, the directions of axes k + 1, k + 2, k + 3 keep their angles: \
               by the cosine law joint k + 2 stands still too, and the joints k + 1 and k + 3 turn only if their axes, on bodies then rigidly \
               joined to one another, have the same direction; turning against one another about parallel axes moves nothing only if the \
               axes coincide. So a fold is a loop with coincident axes: t2 = t1, a2 = a1, d2 = 0, t4 = t3, a4 = a3, d4 = 0, d3 = -d1, up to \
               orientations of the axes, in which joints 2 and 4 stay at pi and joint 3 turns against joint 1 (closure identity checked). \
               Two joints move: degenerate."
            .to_owned(),
        formulas: Vec::new(),
        holds: closes(&folded()),
    });
}

/// Treats twists that are multiples of pi.
pub(super) fn zero_twists(pair: &SpatialPair<Poly>, steps: &mut Vec<Step>) {
    let v = Poly::variable;
    let (x, y, zero) = (v(Variables::X), v(Variables::Y), Poly::zero());
    // A function of theta1 + theta4 has equal derivatives; of weight 1 in x, d/dtheta1 is ((1 + x^2) d/dx - 2 x)/2.
    let turned = |f: &Poly, variable: usize| {
        let t = v(variable);
        f.derivative(variable).mul(&t.mul(&t).add(&Poly::one())).sub(&f.mul(&t.add(&t)))
    };
    let parallel = pair.f.substitute(Variables::twist(3), &zero);
    let sum_only = turned(&parallel, Variables::X) == turned(&parallel, Variables::Y) && !parallel.is_zero();
    // With three twists zero f does not depend on the angles, and requires the fourth twist to be zero as well.
    let flat =
        (0..3).filter(|&k| k != 1).chain([3]).fold(pair.f.clone(), |f, k| f.substitute(Variables::twist(k), &zero));
    let circles = |p: &Poly| p.mul(p).add(&Poly::one());
    let fourth = v(Variables::twist(1));
    let expected = fourth.mul(&fourth).mul(&circles(&x)).mul(&circles(&y)).scale(&Int::from_integer(2));
    let planar = (0..4).fold(pair.g.clone(), |g, k| g.substitute(Variables::twist(k), &zero));
    let holds = sum_only && flat == expected && planar.is_zero() && LENGTHS.len() == 6;
    steps.push(Step {
        title: "Twists of 0 or pi".to_owned(),
        text: "One twist of link k is 0 or pi (f then depends on the sum of the two neighbouring angles only; checked for link 4): the axes form \
               a spherical triangle, which is rigid, so the other joints stand still and the two parallel axes turn against one another: they \
               coincide, a_k = 0. Two neighbouring links: three parallel axes, the fourth joint stands still (its axis sees both ends of the \
               triple in one direction), and what is left is a planar triangle: rigid unless two axes coincide, neighbours or the outer \
               ones, at equal lengths of the two links, with the other two links folded. Two opposite links: the sums of \
               the angles about both directions are constant, so that the position vectors a_k u and a_(k+2) v, on circles in two planes that \
               are not parallel, have a constant sum: such circles have at most two points in common, no curve, unless both radii are \
               zero: coincident axes. Three: then the fourth too (f is 2 t2^2 times powers of 1 + x^2 and 1 + y^2; checked), all axes are \
               parallel: the planar four-bar, with the sum of the offsets (each in the direction of its axis) zero and all lengths free."
            .to_owned(),
        formulas: Vec::new(),
        holds,
    });
}
