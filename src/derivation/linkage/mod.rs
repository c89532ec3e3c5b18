//! Closure polynomials, input-output polynomials and coupler curves of planar linkages, exactly.

mod closure;
mod cosines;
mod four_bar;
mod geared;
mod geared_curve;
mod inputs;
mod places;
mod symbolic;
mod trace;
mod trace_symbolic;

pub use closure::{GroupPolynomial, InputOutput, LinkageDerivation, Symbol, derive_linkage};
pub use cosines::in_cosines;
pub use inputs::{derive_linkage_with_input, relation_by_values};
pub use symbolic::{Coordinate, LinkageSymbolic, derive_linkage_with_symbols};
pub use trace::{Curve, trace, trace_mass};
pub use trace_symbolic::{CurveSymbolic, trace_with_symbols};

use crate::algebra::int::Int;
use crate::algebra::modular::Terms;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};

/// Returns the primitive polynomial of a determinant without the factors `1 + t^2` of its half-angle tangents t;
/// `None` for zero.
fn without_circles(terms: &Terms, variables: usize, tangents: &[usize]) -> Option<Polynomial<Int>> {
    let list = terms.iter(variables).map(|(exponents, c)| (exponents.to_vec(), Int::from(c.clone())));
    let mut polynomial = Polynomial::from_terms(list);
    if polynomial.is_zero() {
        return None;
    }
    polynomial = polynomial.primitive_part();
    for variable in tangents {
        let t = Polynomial::<Int>::variable(*variable);
        let circle = t.mul(&t).add(&Ring::one());
        while let Some(quotient) = polynomial.checked_div_exact(&circle) {
            polynomial = quotient;
        }
    }
    Some(polynomial)
}
