//! Arms and loops: which elimination.

use super::polynomial::{ClosurePolynomial, Meaning, Removed};
use super::symbols::{Symbols, joint_labels};
use super::{Derivation, Equation, cuts, four_bar, triangle, two_sides};
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::degree::general_degree;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::freedom::Freedom;
use crate::mechanism::{closed_loop, coupled_loop};
use rug::Rational;

/// The field in which ways to eliminate are compared before the best one is taken over the rationals.
pub(super) type Mod = ModP<PRIME_61>;

/// What an elimination hands over.
pub(super) struct Eliminated {
    pub equations: Vec<Equation>,
    pub steps: Vec<String>,
    /// The unknown that is left, the polynomial in it, and what its variable is.
    pub polynomial: Option<(usize, Univariate<Rational>, Meaning)>,
    /// What was divided out of the polynomial.
    pub removed: Vec<Removed>,
    /// At most so many solutions belong to a root by the way of the elimination.
    pub per_root: usize,
}

/// A loop over the rationals and modulo a prime.
pub(super) struct Exact {
    pub closed: ClosedLoop<Rational>,
    pub modular: Option<ClosedLoop<Mod>>,
    pub symbols: Symbols,
    /// The first of the three unknowns of a ball, if there is one.
    pub ball: Option<usize>,
}

/// The derivation of one case of an arm or a loop.
pub(super) fn derive(chain: &Chain, case: &Case) -> Result<Derivation> {
    if let Some(coupled) = coupled_loop::<Rational>(chain, case)? {
        let symbols = Symbols::single(chain, coupled.indices[2], coupled.variable);
        let eliminated = two_sides::coupled(&symbols, &joint_labels(chain), &coupled);
        return derivation(&symbols, eliminated);
    }
    let exact = exact(chain, case)?;
    let mut derivation = derivation(&exact.symbols, eliminate(&exact)?)?;
    if let (Some(without), None) = (&mut derivation.without, &case.pose) {
        without.push_str(&format!("; {}", Freedom::of(chain)));
    }
    if let Some(polynomial) = &derivation.polynomial {
        derivation.warnings.extend(false_roots(&exact, polynomial.degree() + polynomial.at_pi));
    }
    Ok(derivation)
}

/// How many of the roots, counted with multiplicity, belong to no solution, if the ring of the closure equations says so.
fn false_roots(exact: &Exact, roots: usize) -> Option<String> {
    // A ball is counted by its centre, and nothing is false of 16.
    if exact.ball.is_some() || roots == 16 {
        return None;
    }
    let count = Plan::of(exact.modular.as_ref()?)?.count();
    (count < roots).then(|| {
        let of_none = roots - count;
        format!(
            "{of_none} of its roots belong to no solution: the ring of the closure equations has dimension {count} \
             (modulo 2^61 - 1)"
        )
    })
}

/// The loop of a case with one ball or none.
pub(super) fn exact(chain: &Chain, case: &Case) -> Result<Exact> {
    let Some((layout, closed)) = closed_loop::<Rational>(chain, case)? else {
        return Err(Error::Invalid("a case without pose and input".to_owned()));
    };
    let modular = closed_loop::<Mod>(chain, case)?.map(|(_, closed)| closed);
    let symbols = Symbols::of(chain, &layout, closed.variables);
    Ok(Exact { closed, modular, symbols, ball: layout.ball_unknown() })
}

/// The elimination that the unknowns ask for.
pub(super) fn eliminate(exact: &Exact) -> Result<Eliminated> {
    let eliminated = match (exact.ball, general_degree(exact.closed.variables)) {
        (Some(ball), _) => Some(two_sides::ball(exact, ball)),
        (None, Some(2)) => triangle::eliminate(exact),
        (None, Some(8)) => two_sides::opposite_axes(exact).or_else(|| four_bar::eliminate(exact)),
        (None, Some(_)) => Some(cuts::eliminate(exact)),
        (None, None) => {
            let rotations = exact.closed.variables.iter().filter(|v| **v == Variable::Rotation).count();
            return Err(Error::Unsupported(format!(
                "{rotations} unknown rotations: planar and translational loops have no exact route; derived are loops with three \
                 unknown rotations at least: give a distance in place of an angle"
            )));
        }
    };
    let parallel = || Error::Unsupported("all axes are parallel: the loop moves in parallel planes".to_owned());
    eliminated.ok_or_else(parallel)
}

fn derivation(symbols: &Symbols, eliminated: Eliminated) -> Result<Derivation> {
    let polynomial = match eliminated.polynomial {
        Some((unknown, polynomial, meaning)) if polynomial.degree().is_some() => {
            let (variable, integers) = (Symbols::variable(unknown), polynomial.primitive_integers());
            ClosurePolynomial::of(variable, integers, meaning, eliminated.removed)?
        }
        _ => None,
    };
    let without = polynomial
        .is_none()
        .then(|| "every elimination vanishes identically: a self-motion, or no isolated solution at all".to_owned());
    Ok(Derivation {
        names: symbols.names()?,
        equations: eliminated.equations,
        steps: eliminated.steps,
        polynomial,
        without,
        proved: true,
        per_root: eliminated.per_root,
        definition: None,
        warnings: Vec::new(),
    })
}
