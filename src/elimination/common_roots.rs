//! The number of solutions of an overconstrained loop: the roots that its closure polynomials have in common.
//!
//! A loop of fewer than six unknowns is given virtual joints, and becomes one of six with a closure polynomial in the half-angle
//! tangent of one of its own angles. Its solutions are those at which all virtual joints are zero, wherever the virtual axes lie;
//! all other roots move with these axes. So the solutions are the common roots of the polynomials of two choices of axes in
//! general position. There are never fewer common roots than solutions; there are more only for solutions that share a root and
//! for accidents, and the least number over all cuts is free of these if one cut is. Two polynomials without a common root modulo
//! a prime have none over the rationals: such a loop does not close.

use super::cut::{Cut, Hidden};
use super::degree::closure_polynomial;
use super::kind::Elimination;
use super::octic;
use super::separated::offset;
use super::spherical_four_bar::FourBar;
use crate::algebra::ring::{Domain, Field};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::link_form::LinkForm;

/// Returns an upper bound on the number of isolated solutions, with multiplicity, that two loops have in common whose unknowns
/// differ only in the axes of the virtual joints. The search stops once the bound is down to `enough`. `None` where no cut has a
/// closure polynomial: as a rule the solutions then form families.
#[must_use]
pub fn common_roots<F: Field + Domain>(
    one: &ClosedLoop<F>,
    other: &ClosedLoop<F>,
    is_idle: [bool; 6],
    enough: usize,
) -> Option<usize> {
    let mut best = None;
    let mut note = |first: &Univariate<F>, second: &Univariate<F>| {
        let count = first.gcd(second).degree().unwrap_or(0);
        best = Some(best.map_or(count, |b: usize| b.min(count)));
        best <= Some(enough)
    };
    match Elimination::of(one.variables, None) {
        Elimination::Cut => {
            for (cut, hidden, _) in Cut::hidings().filter(|(_, _, unknown)| !is_idle[*unknown]) {
                let both = [one, other].map(|closed| closure_polynomial(closed, cut, hidden));
                let [Some(first), Some(second)] = both else { continue };
                if note(&first.cofactor, &second.cofactor) {
                    return best;
                }
            }
        }
        Elimination::FourBar => {
            let (one, other): (LinkForm<F, 4, 2>, LinkForm<F, 4, 2>) = (LinkForm::of(one)?, LinkForm::of(other)?);
            for base in 0..4 {
                for (hidden, unknown) in [(Hidden::First, base), (Hidden::Second, (base + 1) % 4)] {
                    if is_idle[one.rotations[unknown]] {
                        continue;
                    }
                    let both = [&one, &other].map(|form| octic_of(form, base, hidden));
                    let [Some(first), Some(second)] = both else { continue };
                    if note(&first, &second) {
                        return best;
                    }
                }
            }
        }
        Elimination::Centre(_) | Elimination::Triangle | Elimination::Planar => {}
    }
    best
}

/// Returns the closure polynomial of four rotations without the roots that belong to no angle; `None` where it vanishes.
fn octic_of<F: Field + Domain>(form: &LinkForm<F, 4, 2>, base: usize, hidden: Hidden) -> Option<Univariate<F>> {
    let polynomial = octic::closure_polynomial(&FourBar::new(form, base)?.equations(), hidden, &offset());
    polynomial.degree()?;
    Some(polynomial.remove_factor(&Univariate::circle()).1)
}
