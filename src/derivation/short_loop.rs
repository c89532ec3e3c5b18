//! Loops of few unknowns, with translations among them: the closure polynomial in the coordinate ring of the closure equations.

use super::Derivation;
use super::coordinate_ring::{CoordinateRing, Function, Solutions};
use super::equation::{Equation, primitive};
use super::polynomial::{ClosurePolynomial, Eliminant};
use super::symbols::{Symbols, joint_labels, joint_variables};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::mechanism::exact_loop::{Cycle, System};
use crate::mechanism::locked_variable;
use rug::{Integer, Rational};

/// Products of words after which a basis is given up, as in an answer of `solve`: loops of four unknowns take a thousandth of it.
const EFFORT: u64 = 10_000_000;

/// A closure polynomial, and the step of the loop whose variable it has.
struct Found {
    step: usize,
    coefficients: Univariate<Integer>,
    at_pi: usize,
}

impl Found {
    /// Returns the number of distinct roots, the half turn among them.
    fn values(&self) -> usize {
        self.coefficients.square_free_part().degree().unwrap_or(0) + usize::from(self.at_pi > 0)
    }
}

/// Returns the derivation of an overconstrained loop at an input; `None` for other mechanisms, for loops with spherical joints, where no
/// solution is there, and where the basis takes too much work.
///
/// # Errors
/// For a case without input that has one.
pub(super) fn derive(chain: &Chain, case: &Case) -> Result<Option<Derivation>> {
    let Ok(Some(locked)) = locked_variable(chain, case) else { return Ok(None) };
    let layout = Layout::of(chain, Some(locked))?;
    if layout.missing() == 0 {
        return Ok(None);
    }
    let Some(cycle) = Cycle::of(chain, &layout, case)?.filter(|cycle| cycle.before.is_none()) else { return Ok(None) };
    let Some(system) = System::of_loop(&cycle.steps) else { return Ok(None) };
    let Some(solutions) = CoordinateRing::of(system.variables, &system.equations, EFFORT) else { return Ok(None) };
    let symbols = Symbols::variables(joint_labels(chain), joint_variables(chain).into_iter().map(|(_, kind)| kind));
    let places = cycle.steps.iter().zip(&cycle.indices).flat_map(|(step, index)| match step.variable {
        Variable::Rotation => vec![3 * index, 3 * index + 1],
        Variable::Translation => vec![Symbols::variable(*index)],
    });
    let variables: Vec<Polynomial<Rational>> = places.map(Polynomial::variable).collect();
    // What is 0 in itself, as entries of rotations about one direction, and what is written twice, is left out.
    let mut written: Vec<Polynomial<Rational>> = Vec::new();
    for equation in &system.equations {
        let polynomial = primitive(&equation.evaluate(&variables));
        if !polynomial.is_zero() && !written.contains(&polynomial) {
            written.push(polynomial);
        }
    }
    let name = |k: usize| format!("closure equation {}", k + 1);
    let equations = written.iter().enumerate().map(|(k, own)| {
        let used = Equation::used(name(k), own);
        // Circles of cosines and sines say nothing of half-angle tangents.
        Equation { algebraic: used.algebraic.filter(|own| !own.is_zero()), ..used }
    });
    let mut steps = vec![
        "The loop has fewer than six unknowns beside the input: its closure equations are more than these. Both halves of the loop, one of them \
         inverted, are equal at every solution."
            .to_owned(),
    ];
    let (mut polynomial, mut without, mut per_root) = (None, None, 1);
    match solutions {
        // A loop that does not close at this input may close at others, of which its refusal speaks.
        Solutions::None => return Ok(None),
        Solutions::Set(dimension) => {
            without =
                Some(format!("the solutions at this input form a set of dimension {dimension}, complex ones counted"));
        }
        Solutions::Finite(ring) => {
            steps.push(format!(
                "A Gröbner basis over the rationals makes them a ring of dimension {}, the number of solutions, complex ones included, with \
                 multiplicity. The closure polynomial is the characteristic polynomial of the multiplication by its variable there.",
                ring.dimension()
            ));
            if let Some(found) = best(&ring, &system, &cycle) {
                let variable = Symbols::variable(cycle.indices[found.step]);
                per_root = ring.dimension() + 1 - found.values();
                let eliminant = Eliminant { coefficients: found.coefficients, at_pi: found.at_pi, removed: Vec::new() };
                polynomial = Some(ClosurePolynomial::of(variable, eliminant)?);
            }
        }
    }
    Ok(Some(Derivation {
        names: symbols.names()?,
        equations: equations.collect(),
        steps,
        polynomial,
        without,
        proved: true,
        per_root,
        finite: true,
        definition: None,
        warnings: Vec::new(),
    }))
}

/// The closure polynomial of the first unknown that tells all solutions apart, or of one with the most values.
fn best(ring: &CoordinateRing, system: &System, cycle: &Cycle) -> Option<Found> {
    let mut best: Option<Found> = None;
    for (step, [one, other]) in system.unknowns.iter().enumerate() {
        let function = match cycle.steps[step].variable {
            Variable::Rotation => {
                Function::HalfTangent { cos: one.clone(), sin: other.clone(), square: Rational::from(1) }
            }
            Variable::Translation => Function::Plain(one.clone()),
        };
        let Some((coefficients, at_pi)) = ring.values(&function) else { continue };
        let found = Found { step, coefficients, at_pi };
        if best.as_ref().is_none_or(|best| best.values() < found.values()) {
            best = Some(found);
        }
    }
    best
}
