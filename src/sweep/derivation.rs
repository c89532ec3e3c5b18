//! Derivations of all mechanisms: overconstrained loops by their closure polynomials in input and output.

use super::exact::Exact;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::input_output::{Relation, derivation};
use crate::derivation::{Derivation, derive};
use crate::error::Result;
use crate::mechanism::locked_variable;

/// Returns whether a polynomial may have a real branch: one in the output alone without real roots has none, and its complex
/// roots need not close the loop.
fn is_branch((_, polynomial): &(usize, Polynomial<Int>)) -> bool {
    let in_output = polynomial.to_univariate(1).and_then(|p| p.map(|c| Some(c.to_integer())));
    in_output.is_none_or(|p| p.distinct_real_roots() > 0)
}

/// Derives the closure equations and the closure polynomial of one case: by [`derive`], or of an overconstrained loop of rotations by what its
/// closure equations have in common in the input and each output.
///
/// # Errors
/// As [`derive`].
pub fn derive_any(entry: &Entry, case: &Case) -> Result<Derivation> {
    let input = case.input.first().filter(|_| case.input.len() == 1);
    if let (Some(chain), Some(input)) = (entry.chain(), input)
        && let Ok(Some(locked)) = locked_variable(chain, case)
    {
        let found = Exact::input_output(entry, case, input.value.variable());
        let relations: Vec<Relation> =
            found.into_iter().filter(is_branch).map(|(output, polynomial)| Relation { output, polynomial }).collect();
        if !relations.is_empty() {
            let mut derived = derivation(chain, locked, &input.value, &relations)?;
            if entry.rounded {
                let rounded = "numbers of the file without rational value or half-angle tangent are replaced by rationals nearby \
                               (--digits): everything here is exact for those";
                derived.warnings.push(rounded.to_owned());
            }
            derived.warnings.extend(case.warnings.iter().cloned());
            return Ok(derived);
        }
    }
    derive(entry, case)
}
