//! The source of the closure polynomial in a parameter and an unknown.

use super::subject::Parameter;
use crate::algebra::drawn;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::entry::{Case, Entry};
use crate::derivation::{Equations, Setting, Watch, derive_interpolated, relation_by_bases, variable_name};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Given, Linkage};
use crate::sweep::exact::{Exact, Moved};
use crate::sweep::linkage_relation::LinkageRelation;
use crate::verdict::Proof;
use rug::Rational;

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
    pub(super) fn of(entry: &Entry, case: &Case, setting: &Setting, watch: &Watch<'_>) -> Result<Self> {
        let moved = Moved { case, place: setting.place, kind: setting.kind };
        if let (Some(chain), Ok(exact)) = (entry.chain(), Exact::moving(entry, moved)) {
            let joint = exact.output(0).map_or(0, |output| output.joint);
            let unknown = variable_name(chain, joint).unwrap_or_default();
            return Ok(Self { exact, unknown, is_probable: false, proof: Proof::Proved });
        }
        Self::interpolated(entry, case, setting, watch)
    }

    fn interpolated(entry: &Entry, case: &Case, setting: &Setting, watch: &Watch<'_>) -> Result<Self> {
        let derivation = derive_interpolated(entry, case, std::slice::from_ref(&setting.name), watch)?;
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

    /// A polynomial in the half tangents of a parameter and an output of which every real root belongs to one real mode, and every real
    /// mode to one of them.
    pub(super) fn of_transfer(polynomial: &Polynomial<Int>, unknown: String) -> Option<Self> {
        let exact =
            Exact::of_polynomial(polynomial, Variable::Rotation, Variable::Rotation, polynomial.degree(1) as usize)?;
        Some(Self { exact, unknown, is_probable: false, proof: Proof::Proved })
    }

    /// The characteristic polynomial of a linear form u in the unknowns of the equations at a value of the parameter, interpolated.
    pub(super) fn by_bases(
        at: &(dyn Fn(&Rational) -> Option<Equations> + Sync),
        parameter: &Parameter,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        let polynomial = relation_by_bases(at, &parameter.name, watch)?;
        let none = || Error::Unsupported("modes coincide at all values of the parameter".to_owned());
        let full = polynomial.degree(1) as usize;
        let exact = Exact::of_polynomial(&polynomial, parameter.kind, Variable::Translation, full).ok_or_else(none)?;
        let proof = Proof::Probable { error: ERROR, seed: drawn::seed() };
        Ok(Self { exact, unknown: "u".to_owned(), is_probable: true, proof })
    }

    /// The relation of the first given joint of a linkage, or of a coordinate of a point, and the angle of a body.
    pub(super) fn of_linkage(
        linkage: &Linkage,
        given: &[Given],
        coordinate: Option<&str>,
        watch: &Watch<'_>,
    ) -> Result<Self> {
        let LinkageRelation { exact, unknown, is_probable, proof, .. } =
            LinkageRelation::of(linkage, given, coordinate, watch)?;
        Ok(Self { exact, unknown, is_probable, proof })
    }
}
