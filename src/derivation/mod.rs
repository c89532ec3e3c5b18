//! The closure equations and the closure polynomial of a mechanism, exactly.
//!
//! The equations are those of [`crate::closure`] and [`crate::elimination`], written over the rationals in the cosines and
//! sines of the unknowns. The polynomial comes from the same eliminations as the numbers of the solver.

mod boundary;
mod by_basis;
mod by_ring;
mod chain;
mod coordinate_ring;
mod cuts;
mod equation;
mod four_bar;
pub(crate) mod input_output;
mod interpolation;
mod linkage;
mod platform;
mod polynomial;
mod pose;
mod ring_curve;
mod ring_symbolic;
mod ring_trace;
mod short_loop;
mod sphere;
mod substitution;
mod surface;
mod symbolic;
mod symbols;
pub mod transference;
mod triangle;
mod true_roots;
mod two_sides;
mod ways;

pub use by_basis::{Equations, relation_by_bases};
pub use by_ring::{RingDerivation, RingPolynomial, Unknown, derive_in_space, derive_on_sphere};
pub use equation::Equation;
pub use interpolation::Watch;
pub use linkage::{
    Coordinate, Curve, CurveSymbolic, GroupPolynomial, InputOutput, LinkageDerivation, LinkageSymbolic, Symbol,
    derive_linkage, derive_linkage_with_input, derive_linkage_with_symbols, in_cosines, relation_by_values, trace,
    trace_mass, trace_with_symbols,
};
pub use polynomial::{ClosurePolynomial, Removed, Root};
pub use pose::RootPose;
pub use ring_symbolic::{RingSymbolic, derive_in_space_with_symbols, derive_on_sphere_with_symbols};
pub use ring_trace::{CurveRelation, RingCurve, SphereTrace, trace_in_space, trace_on_sphere};
pub use sphere::{
    SpecialPoint, SphereCurve, SphereEnd, SphereSymbol, SphereSymbolic, Transfer, sphere_sides, sphere_trace,
    sphere_with_symbols, transfer,
};
pub use substitution::Substitution;
pub use surface::{Surface, surface};
pub use symbolic::{Displayed, Quotient, Symbolic, SymbolicPolynomial, derive_symbolic, derive_with_symbols};
pub(crate) use symbolic::{Place, Setting, derive_interpolated};
pub(crate) use symbols::variable_name;
pub use ways::{ByWay, Matrix, Way, derive_by};

use crate::algebra::int::Int;
use crate::algebra::number::Number;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::platform::Platform;
use rug::{Integer, Rational};

/// The derivation of one case of a mechanism file.
#[derive(Clone, Debug)]
pub struct Derivation {
    /// The names of all variables.
    pub names: Names,
    /// The closure equations, in the order in which they are used.
    pub equations: Vec<Equation>,
    /// The steps from the equations to the polynomial, a sentence each.
    pub steps: Vec<String>,
    /// The closure polynomial; `None` if it vanishes identically or is not known.
    pub polynomial: Option<ClosurePolynomial>,
    /// The reason why there is no polynomial.
    pub without: Option<String>,
    /// Whether the polynomial is proved to be the right one; if not, the probability of error is below 2^-40.
    pub proved: bool,
    /// Upper bound on the number of solutions of a simple root in general.
    pub per_root: usize,
    /// Whether the solutions are finite in number, as far as is known; otherwise a root may belong to a self-motion.
    pub finite: bool,
    /// The definition of the variable of the polynomial, as an equation; `None` if the equations contain it.
    pub definition: Option<Polynomial<Rational>>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

impl Derivation {
    /// Returns the variable of a loop's polynomial as an index among the joint variables of the chain, and its kind.
    #[must_use]
    pub fn unknown(&self, chain: &Chain) -> Option<(usize, Variable)> {
        let name = &self.names.list()[self.polynomial.as_ref()?.variable];
        let named = |(_, (label, kind)): &(usize, (String, Variable))| *name == symbols::name(label, *kind);
        let found = symbols::joint_variables(chain).into_iter().enumerate().find(named)?;
        Some((found.0, found.1.1))
    }

    /// Returns the equations that contain the unknowns of the polynomial without cosines and sines, and the polynomial itself.
    #[must_use]
    pub fn system(&self) -> Vec<Polynomial<Rational>> {
        let equations = self.equations.iter().filter_map(|equation| equation.algebraic.clone());
        let mut system: Vec<Polynomial<Rational>> = equations.chain(self.definition.clone()).collect();
        let polynomial = self.polynomial.as_ref().map(ClosurePolynomial::to_polynomial);
        // A single equation in one unknown is its own closure polynomial.
        system.extend(polynomial.filter(|polynomial| !system.contains(polynomial)));
        system
    }
}

/// Returns a polynomial in one variable with integer coefficients.
fn over_integers(polynomial: &Polynomial<Int>, variable: usize) -> Univariate<Integer> {
    let converted = polynomial.to_univariate(variable).and_then(|p| p.map(|c| Some(c.to_integer())));
    converted.unwrap_or_else(Univariate::zero)
}

/// Returns the closure equations of a platform alone, with the names of their variables.
///
/// # Errors
/// [`crate::error::Error::Invalid`] for a case without legs.
pub fn platform_equations(geometry: &Platform<Number>, case: &Case) -> Result<(Names, Vec<Equation>)> {
    platform::equations_of(geometry, case)
}

/// Derives the closure equations and the closure polynomial of one case.
///
/// # Errors
/// [`crate::error::Error::Unsupported`] for mechanisms without an exact route.
pub fn derive(entry: &Entry, case: &Case) -> Result<Derivation> {
    let mut derivation = match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => chain::derive(chain, case)?,
        Design::Platform(geometry) => platform::derive(geometry, case)?,
    };
    if entry.rounded {
        let rounded = "numbers of the file without rational value or half-angle tangent are replaced by rationals nearby \
                       (--digits): everything here is exact for those";
        derivation.warnings.push(rounded.to_owned());
    }
    derivation.warnings.extend(case.warnings.iter().cloned());
    Ok(derivation)
}
