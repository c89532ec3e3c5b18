//! Arms and loops: the choice of the elimination.

use super::polynomial::{ClosurePolynomial, Eliminant, Meaning, Removed};
use super::symbols::{Symbols, joint_labels};
use super::true_roots::{self, Settled};
use super::{Derivation, Equation, cuts, four_bar, short_loop, triangle, two_sides};
use crate::algebra::drawn::Drawn;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::elimination::kind::Elimination;
use crate::elimination::two_sided::TwoSided;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::freedom::Freedom;
use crate::mechanism::{closed_loop, ss_dyad_loop};
use rug::Rational;

/// The field in which eliminations are compared before the best one is carried out over the rationals.
pub(super) type Mod = Drawn;

/// The remark on a polynomial whose solutions need not be isolated.
const FAMILY: &str = "the solutions are not known to be finite in number: a root may belong to a self-motion";

/// The result of an elimination.
pub(super) struct Eliminated {
    pub equations: Vec<Equation>,
    pub steps: Vec<String>,
    /// The remaining unknown, the polynomial in it, and the meaning of its variable.
    pub polynomial: Option<(usize, Univariate<Rational>, Meaning)>,
    /// The factors divided out of the polynomial.
    pub removed: Vec<Removed>,
    /// Upper bound on the number of solutions of a root in this elimination.
    pub per_root: usize,
}

/// A loop over the rationals and modulo a prime.
pub(super) struct Exact {
    pub closed: ClosedLoop<Rational>,
    pub modular: Option<ClosedLoop<Mod>>,
    pub symbols: Symbols,
    /// The first of the three unknowns of a spherical joint, if there is one.
    pub spherical: Option<usize>,
}

impl Exact {
    pub fn elimination(&self) -> Elimination {
        Elimination::of(self.closed.variables, self.spherical)
    }

    pub fn two_sided(&self) -> Option<TwoSided> {
        TwoSided::of(&self.closed, self.spherical, 0.0)
    }
}

/// Derives one case of an arm or a loop.
pub(super) fn derive(chain: &Chain, case: &Case) -> Result<Derivation> {
    if let Some(ss_dyad) = ss_dyad_loop::<Rational>(chain, case)? {
        let symbols = Symbols::single(chain, ss_dyad.indices[2], ss_dyad.variable);
        let eliminated = two_sides::ss_dyad(&symbols, &joint_labels(chain), &ss_dyad);
        return derivation(&symbols, eliminated, |found| found.map(|(k, eliminant)| (k, Settled::as_it_is(eliminant))));
    }
    if let Some(short) = short_loop::derive(chain, case)? {
        return Ok(short);
    }
    let exact = exact(chain, case)?;
    // With six unknown rotations, or five and a translation, the ring takes as long as the elimination.
    let is_long = exact.elimination() == Elimination::Cut;
    let (eliminated, count) =
        rayon::join(|| eliminate(&exact), || if is_long { true_roots::count(&exact) } else { None });
    let mut derivation = settle(&exact, eliminated?, count)?;
    if let (Some(without), None) = (&mut derivation.without, &case.pose) {
        without.push_str(&format!("; {}", Freedom::of(chain)));
    }
    Ok(derivation)
}

/// Removes the roots of an eliminant that belong to no solution; `count` is the number of solutions, if it is known.
pub(super) fn settle(exact: &Exact, eliminated: Eliminated, count: Option<usize>) -> Result<Derivation> {
    let per_root = eliminated.per_root;
    derivation(&exact.symbols, eliminated, |found| match found {
        Some((unknown, eliminant)) if count == Some(eliminant.roots() * per_root) => {
            Some((unknown, true_roots::met(exact, unknown, eliminant)))
        }
        Some((unknown, eliminant)) => Some((unknown, true_roots::settled(exact, unknown, eliminant, per_root))),
        None => true_roots::by_ring(exact),
    })
}

/// Returns the loop of a case with one spherical joint or none.
pub(super) fn exact(chain: &Chain, case: &Case) -> Result<Exact> {
    let Some((layout, closed)) = closed_loop::<Rational>(chain, case)? else {
        return Err(Error::Invalid("a case without pose and input".to_owned()));
    };
    let modular = closed_loop::<Mod>(chain, case)?.map(|(_, closed)| closed);
    let symbols = Symbols::of(chain, &layout, closed.variables);
    Ok(Exact { closed, modular, symbols, spherical: layout.spherical_unknown() })
}

/// Carries out the elimination that fits the unknowns.
pub(super) fn eliminate(exact: &Exact) -> Result<Eliminated> {
    let special = exact.two_sided().and_then(|way| two_sides::eliminate(exact, way));
    let eliminated = match exact.elimination() {
        _ if special.is_some() => special,
        Elimination::Centre(_) => None,
        Elimination::Triangle => triangle::eliminate(exact),
        Elimination::FourBar => four_bar::eliminate(exact),
        Elimination::Cut => Some(cuts::eliminate(exact)),
        Elimination::Planar => {
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

fn derivation(
    symbols: &Symbols,
    eliminated: Eliminated,
    settle: impl FnOnce(Option<(usize, Eliminant)>) -> Option<(usize, Settled)>,
) -> Result<Derivation> {
    let eliminant = eliminated.polynomial.and_then(|(unknown, polynomial, meaning)| {
        let (variable, integers) = (Symbols::variable(unknown), polynomial.primitive_integers());
        Some((unknown, Eliminant::of(variable, integers, meaning, eliminated.removed)?))
    });
    let mut steps = eliminated.steps;
    let (mut polynomial, mut proved, mut per_root) = (None, true, eliminated.per_root);
    let mut finite = true;
    if let Some((unknown, settled)) = settle(eliminant) {
        polynomial = Some(ClosurePolynomial::of(Symbols::variable(unknown), settled.eliminant)?);
        (proved, finite) = (settled.proved, settled.finite);
        if let Some(step) = settled.step {
            // From here on there is one root for each solution.
            per_root = 1;
            steps.push(step);
        }
    }
    let without = polynomial
        .is_none()
        .then(|| "every elimination vanishes identically: a self-motion, or no isolated solution at all".to_owned());
    Ok(Derivation {
        names: symbols.names()?,
        equations: eliminated.equations,
        steps,
        polynomial,
        without,
        proved,
        per_root,
        finite,
        definition: None,
        warnings: if finite { Vec::new() } else { vec![FAMILY.to_owned()] },
    })
}
