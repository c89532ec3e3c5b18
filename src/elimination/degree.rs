//! The largest number of solutions of a loop: the degree of its closure polynomial, computed exactly.
//!
//! Every finite solution of a cut that loses no equation is a root of the pencil's determinant, a polynomial in x = tan(q/2) of
//! degree 16; solutions that share a root give it at least their number as multiplicity. Roots x = +-i belong to no finite angle.
//! Roots that an arm has at two general poses alike belong to no solution: a joint that stood still at all poses would leave five
//! joints for six freedoms. The remaining degree bounds the number of isolated solutions, and the least such bound over all cuts
//! holds. The bound of a general pose of a geometry holds for all its poses, because isolated solutions with multiplicity can
//! only become fewer in special positions. Loops with three and four rotations are counted by their own polynomials, of degree 2
//! and 8.
//! \[SommeseWampler2005\]

use super::cut::{Cut, Hidden};
use super::kind::Elimination;
use super::pencil::{Pencil, before_second_link, bilinear, offset, pencil};
use super::rearranged::{Rearranged, rearranged};
use super::{octic, spherical_triangle};
use crate::algebra::determinant::by_interpolation;
use crate::algebra::ring::{Domain, Field};
use crate::algebra::univariate::Univariate;
use crate::closure::half_angle::{HalfAngleForm, half_angle_form};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::link_form::LinkForm;
use crate::kinematics::motion::Motion;

/// The closure polynomial of one cut.
#[derive(Clone, Debug, PartialEq)]
pub struct ClosurePolynomial<F> {
    /// Determinant of the pencil, its hidden angle turned by the offset of [`half_tangent_pair`] at 3/7.
    pub polynomial: Univariate<F>,
    /// The power k of the factor `(1 + x^2)^k`.
    pub spurious: usize,
    /// The polynomial without that factor.
    pub cofactor: Univariate<F>,
}

/// A bound on the number of isolated solutions of a loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Degree {
    /// Upper bound on the number of finite solutions, with multiplicity.
    pub solutions: usize,
    /// The number of roots of the closure polynomial that were left out.
    pub left_out: usize,
}

/// Cosine and sine of the angle with half-angle tangent `t`; `None` where `1 + t^2` has no inverse.
#[must_use]
pub fn half_tangent_pair<F: Field>(t: &F) -> Option<(F, F)> {
    let square = t.mul(t);
    let scale = F::one().add(&square).inverse()?;
    Some((F::one().sub(&square).mul(&scale), t.add(t).mul(&scale)))
}

/// The pencil of one cut, its hidden angle turned by the offset of [`half_tangent_pair`] at 3/7.
#[derive(Clone, Debug)]
pub struct TurnedPencil<F> {
    /// The loop as the cut reads it.
    pub view: ClosedLoop<F>,
    /// The closure equations after the elimination.
    pub form: HalfAngleForm<F>,
    /// The pencil.
    pub pencil: Pencil<F>,
}

/// Returns the pencil of a loop for one cut and one hidden unknown; `None` where the cut is degenerate.
#[must_use]
pub fn turned_pencil<F: Field>(closed: &ClosedLoop<F>, cut: Cut, hidden: Hidden) -> Option<TurnedPencil<F>> {
    if !cut.fits(closed.variables) {
        return None;
    }
    let view = cut.of(closed);
    let form = half_angle_form(&view)?;
    let rows = before_second_link(&form, &view.constants[1]);
    let t = F::from_integer(3).mul(&F::from_integer(7).inverse()?);
    let (cos, sin) = half_tangent_pair(&t)?;
    let equations = offset(&bilinear(&rows, &view), hidden, &cos, &sin);
    Some(TurnedPencil { pencil: pencil(&equations, hidden), view, form })
}

/// Returns the closure polynomial of a loop for one cut and one hidden unknown; `None` where the cut is degenerate or the
/// determinant vanishes identically.
#[must_use]
pub fn closure_polynomial<F: Field + Domain>(
    closed: &ClosedLoop<F>,
    cut: Cut,
    hidden: Hidden,
) -> Option<ClosurePolynomial<F>> {
    let TurnedPencil { pencil, .. } = turned_pencil(closed, cut, hidden)?;
    let polynomial = by_interpolation(&pencil.coefficients);
    polynomial.degree()?;
    let (spurious, cofactor) = polynomial.remove_factor(&Univariate::circle());
    Some(ClosurePolynomial { polynomial, spurious, cofactor })
}

/// Returns the least bound over all cuts; `None` if all are degenerate. `other` is the same arm at another general pose, which
/// reveals the roots independent of the pose; `None` for a loop, or where the count at one special pose is requested. Where a
/// bound is at most `enough`, further cuts are not tried.
#[must_use]
pub fn degree<F: Field + Domain>(
    closed: &ClosedLoop<F>,
    other: Option<&ClosedLoop<F>>,
    enough: usize,
) -> Option<Degree> {
    let elimination = Elimination::of(closed.variables, None);
    let solutions = match elimination {
        Elimination::Cut => return degree_by_cuts(closed, other, enough),
        Elimination::Triangle => spherical_triangle::count(&LinkForm::of(closed)?)?,
        Elimination::FourBar => octic::bound(&LinkForm::of(closed)?)?,
        Elimination::Centre(_) | Elimination::Planar => return None,
    };
    Some(Degree { solutions, left_out: elimination.degree(closed.variables)? - solutions })
}

/// [`degree`] of a loop with five or six rotations.
fn degree_by_cuts<F: Field + Domain>(
    closed: &ClosedLoop<F>,
    other: Option<&ClosedLoop<F>>,
    enough: usize,
) -> Option<Degree> {
    let mut best: Option<Degree> = None;
    let mut all = |closed: &ClosedLoop<F>, other: Option<&ClosedLoop<F>>| {
        for (cut, hidden, _) in Cut::hidings() {
            if best.is_some_and(|best| best.solutions <= enough) {
                return;
            }
            let Some(found) = closure_polynomial(closed, cut, hidden) else { continue };
            let standing = other
                .and_then(|other| closure_polynomial(other, cut, hidden))
                .map_or(0, |other| found.cofactor.gcd(&other.cofactor).degree().unwrap_or(0));
            let left_out = 2 * found.spurious + standing;
            let bound = Degree { solutions: 16 - left_out, left_out };
            if best.is_none_or(|b| bound.solutions < b.solutions) {
                best = Some(bound);
            }
        }
    };
    all(closed, other);
    // The other loop at another pose has the same parallel axes, as a rule.
    let others = other.map(|other| rearranged(other, 0.0));
    for (k, moved) in rearranged(closed, 0.0).iter().enumerate() {
        let same = |other: &&Rearranged<F>| other.order == moved.order;
        all(&moved.closed, others.as_ref().and_then(|list| list.get(k)).filter(same).map(|other| &other.closed));
    }
    best
}

/// Returns a motion in general position as the closing transformation of an arm's loop, or for a loop's locked variable; every
/// `choice` gives another one.
#[must_use]
pub fn general_closing<F: Field>(locked: Option<Variable>, choice: i32) -> Option<Motion<F>> {
    let tangent = |n: i32| half_tangent_pair(&F::from_integer(n + 1009 * choice));
    match locked {
        Some(Variable::Translation) => Some(Motion::translation_z(F::from_integer(1_234_577 + choice))),
        Some(Variable::Rotation) => {
            let (cos, sin) = tangent(1_234_577)?;
            Some(Motion::rotation_z(cos, sin))
        }
        None => {
            let (c1, s1) = tangent(1_234_577)?;
            let (c2, s2) = tangent(7_654_321)?;
            let (c3, s3) = tangent(3_141_593)?;
            let turn = Motion::rotation_z(c1, s1)
                .then_after(&Motion::rotation_x(c2, s2))
                .then_after(&Motion::rotation_z(c3, s3));
            let shift = [2_718_281, 1_414_213, 1_732_051].map(|n| F::from_integer(n - 4099 * choice));
            Some(Motion { translation: shift, ..turn })
        }
    }
}
