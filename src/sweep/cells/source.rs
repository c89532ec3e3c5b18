//! The source of the closure polynomial in a parameter and an unknown.

use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::entry::{Case, Entry};
use crate::algebra::drawn;
use crate::derivation::{
    GroupPolynomial, LinkageDerivation, Setting, Watch, derive_interpolated, derive_linkage, derive_linkage_with_symbols,
    relation_by_values, variable_name,
};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Given, Linkage};
use crate::sweep::exact::{Exact, Moved};
use crate::verdict::Proof;

/// Probability of error of a polynomial that is interpolated and compared at 20 places.
const ERROR: f64 = 1e-12;

/// A closure polynomial and what it rests on.
pub struct Source {
    pub(super) exact: Exact,
    /// The name of the unknown.
    pub(super) unknown: String,
    /// Whether it is interpolated without a bound of its degree.
    pub(super) is_probable: bool,
    pub(super) proof: Proof,
}

impl Source {
    /// Eliminated with the parameter as a variable, where the sweep has a route for that; else interpolated.
    pub(super) fn of(entry: &Entry, case: &Case, setting: &Setting) -> Result<Self> {
        let moved = Moved { case, place: setting.place, kind: setting.kind };
        if let (Some(chain), Ok(exact)) = (entry.chain(), Exact::moving(entry, moved)) {
            let joint = exact.output(0).map_or(0, |output| output.joint);
            let unknown = variable_name(chain, joint).unwrap_or_default();
            return Ok(Self { exact, unknown, is_probable: false, proof: Proof::Proved });
        }
        Self::interpolated(entry, case, setting)
    }

    fn interpolated(entry: &Entry, case: &Case, setting: &Setting) -> Result<Self> {
        let derivation = derive_interpolated(entry, case, std::slice::from_ref(&setting.name), &Watch::none())?;
        let none = || Error::Unsupported("there is no closure polynomial in the parameter and one unknown".to_owned());
        let found = derivation.polynomial.as_ref().ok_or_else(none)?;
        let names = derivation.names.list();
        let parameter = names.iter().position(|name| *name == setting.variable).ok_or_else(none)?;
        let own = [parameter, found.variable];
        let whole = found.displayed.polynomial.primitive().0;
        let terms = whole.terms().map(|(exponents, c)| {
            let power = |k: usize| exponents.get(k).copied().unwrap_or(0);
            (own.map(power).to_vec(), c.clone())
        });
        let polynomial: Polynomial<Int> = Polynomial::from_terms(terms);
        let unknown = names[found.variable].clone();
        let is_distance = unknown.starts_with('d') && entry.chain().is_some();
        let kind = if is_distance { Variable::Translation } else { Variable::Rotation };
        let full = polynomial.degree(1) as usize;
        let exact = Exact::of_polynomial(&polynomial, setting.kind, kind, full).ok_or_else(none)?;
        let seed = drawn::seed();
        let proof = if derivation.proved { Proof::Proved } else { Proof::Probable { error: ERROR, seed } };
        Ok(Self { exact, unknown, is_probable: !derivation.proved, proof })
    }

    /// The relation of the first given joint and the output of a linkage, the others held; with the name of a coordinate of a point that
    /// relation with the coordinate as a symbol, interpolated, at the value of the joint.
    pub(super) fn of_linkage(linkage: &Linkage, given: &[Given], coordinate: Option<&str>) -> Result<Self> {
        let derivation = derive_linkage(linkage, given)?;
        let best = whole(&derivation)?;
        let unknown = format!("t_{}", linkage.bodies[best.body].name);
        let none =
            || Error::Unsupported("the closure polynomial of the linkage vanishes for all values of an unknown".to_owned());
        let is_turn = matches!(given.first(), Some(Given::Turn { .. }));
        let of_input = if is_turn { Variable::Rotation } else { Variable::Translation };
        let (polynomial, kind, agrees, is_probable) = match (coordinate, &derivation.input_output) {
            (Some(name), _) => {
                let found = derive_linkage_with_symbols(linkage, given, &[name.to_owned()], &Watch::none())?;
                let at_input = found.at_input(linkage, &given[0]).ok_or_else(none)?;
                (at_input, Variable::Translation, found.agrees, true)
            }
            (None, Some(relation)) => (relation.polynomial.clone(), of_input, relation.agrees, false),
            // Of a slide in a body that turns the determinant is not a polynomial in its displacement.
            (None, None) => {
                let own = relation_by_values(linkage, given, 0, (best.body, best.roots()), &Watch::none())?;
                (own, of_input, true, true)
            }
        };
        let full = polynomial.degree(1) as usize;
        let exact = Exact::of_polynomial(&polynomial, kind, Variable::Rotation, full).ok_or_else(none)?;
        // Over a simple root the matrix has a kernel of one dimension, hence one assembly at most: with as many of both every root has one.
        // None of them is at infinity where displacements are bounded.
        let is_simple = best.coefficients.gcd(&best.coefficients.derivative()).degree() == Some(0) && best.at_pi <= 1;
        let is_matched = agrees && best.is_proved() && is_simple && best.roots() == full && derivation.is_bounded;
        let proof = match (is_matched, is_probable) {
            (false, _) => Proof::None,
            (true, true) => Proof::Probable { error: ERROR, seed: drawn::seed() },
            (true, false) => Proof::Proved,
        };
        Ok(Self { exact, unknown, is_probable, proof })
    }
}

/// Returns the polynomial on which all assemblies depend.
fn whole(derivation: &LinkageDerivation) -> Result<&GroupPolynomial> {
    let none = |what: &str| Error::Unsupported(format!("there is no closure polynomial {what}"));
    let best = derivation.polynomials.first().ok_or_else(|| none("of the linkage"))?;
    // The groups that the polynomial does not depend on have assemblies of their own.
    let all: usize = derivation.groups.iter().map(|(_, count)| count).product();
    if best.assemblies.is_some_and(|own| own != all) {
        return Err(none("on which all assemblies depend: the linkage has groups that are independent of each other"));
    }
    Ok(best)
}
