//! The eliminations that are feasible with symbols.

use super::dual::{axes, dualised, neighbours, opposite_link, three_translations};
use super::parts::Parts;
use super::size::too_large;
use super::table::{Symbol, Table};
use super::{Numeric, Quotient};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::Case;
use crate::derivation::chain::Eliminated;
use crate::derivation::equation::primitive;
use crate::derivation::symbols::Symbols;
use crate::derivation::triangle::of_row;
use crate::elimination::separated::{Plan, Separated, powers, quartic};
use crate::elimination::spherical_pair;
use crate::elimination::spherical_triangle::{triangle, triangle_without};
use crate::elimination::two_sided::TwoSided;
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use crate::kinematics::link_form::LinkForm;
use crate::mechanism::locked_variable;
use rug::Rational;

/// A function that returns a polynomial over the names of sub-expressions and may add names.
pub(super) type OverNames = Box<dyn FnOnce(&mut Parts) -> Polynomial<Rational>>;

/// The result of a route.
pub(super) struct Outcome {
    /// Name and polynomial over unknowns and symbols.
    pub equations: Vec<(String, Polynomial<Rational>)>,
    pub steps: Vec<String>,
    /// The remaining variable, the polynomial, and the naming of its coefficients if not one by one.
    pub polynomial: Option<(usize, Polynomial<Rational>, Option<OverNames>)>,
    pub translations: Vec<Quotient>,
    /// Results with symbols, and their expected values at the numbers of the file.
    pub compare: Vec<(Polynomial<Rational>, Polynomial<Rational>)>,
    /// Factors that may have been divided out: roots that belong to no solution at these numbers, but do at others.
    pub removed: Polynomial<Rational>,
    pub compared: String,
}

/// Returns an element of the ring as a polynomial.
pub(super) fn expanded(symbol: &Symbol) -> Polynomial<Rational> {
    symbol.polynomial().clone()
}

/// Returns the polynomial in one unknown with these coefficients in a ring of polynomials.
pub(super) fn in_variable(variable: usize, polynomial: &Univariate<Polynomial<Rational>>) -> Polynomial<Rational> {
    Polynomial::from_coefficients_in(variable, polynomial.coefficients())
}

pub(super) fn symbolic_loop(chain: &Chain, case: &Case, table: &Table<'_>) -> Result<ClosedLoop<Symbol>> {
    let layout = Layout::of(chain, locked_variable(chain, case)?)?;
    let open = chain.open_loop_over(&layout, table)?;
    Ok(open.ok_or_else(no_image)?.close(&table.closing()?))
}

pub(super) fn vanishing() -> Error {
    let message = "the closure polynomial vanishes whatever the symbols are: a self-motion, or no isolated solution";
    Error::Unsupported(message.to_owned())
}

pub(super) fn no_image() -> Error {
    Error::Unsupported("the geometry has no image in the ring of symbols".to_owned())
}

/// Derives any loop except those of four revolutes.
pub(super) fn route(
    chain: &Chain,
    case: &Case,
    table: &Table<'_>,
    symbols: &Symbols,
    numeric: &Numeric,
) -> Result<Outcome> {
    let (exact, eliminated) = match numeric {
        Numeric::SsDyad(eliminated) => {
            let layout = Layout::of(chain, locked_variable(chain, case)?)?;
            let ss_dyad = chain.open_ss_dyad(&layout, table)?.close(&table.closing()?);
            return one_row(symbols, 0, ss_dyad.variable, &spherical_pair::equation(&ss_dyad), eliminated);
        }
        Numeric::Single(exact, eliminated) => (exact, eliminated),
    };
    let closed = symbolic_loop(chain, case, table)?;
    let by_two_rows = |way: TwoSided| {
        let (equations, numbers) = way.equations(&closed).zip(way.equations(&exact.closed)).ok_or_else(no_image)?;
        two_rows(symbols, way.unknowns(closed.variables), &equations, &numbers.plan(0.0), eliminated)
    };
    if let Some(spherical) = exact.spherical {
        return by_two_rows(TwoSided::Centre(spherical));
    }
    if let Some(form) = LinkForm::<_, 4, 2>::of(&closed) {
        if let Some(base) = opposite_link(&form) {
            return neighbours(exact, &form, base, symbols);
        }
        // With symbols a translation may leave the axis along which it runs in the file.
        let is_opposite = axes(&form).is_some_and(|[one, two]| one.abs_diff(two) == 2);
        return match exact.two_sided().filter(|_| is_opposite) {
            Some(way @ TwoSided::OppositeAxes(_)) => by_two_rows(way),
            _ => Err(too_large(chain, case, exact)),
        };
    }
    let (form, numbers): (LinkForm<_, 3, 3>, LinkForm<_, 3, 3>) =
        LinkForm::of(&closed).zip(LinkForm::of(&exact.closed)).ok_or_else(no_image)?;
    let dropped = triangle(&numbers).dropped;
    let unknown = form.rotations[(dropped + 2) % 3];
    let row = triangle_without(&form, dropped).equation;
    let mut outcome = one_row(symbols, unknown, Variable::Rotation, &row, eliminated)?;
    // Each translation runs along the axis of its own rotation.
    if axes(&form) == Some([0, 1, 2]) {
        three_translations(&mut outcome, symbols, &dualised(&form), dropped);
    }
    Ok(outcome)
}

/// Derives one equation in one unknown.
fn one_row(
    symbols: &Symbols,
    unknown: usize,
    kind: Variable,
    row: &[Symbol; 3],
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let row = row.each_ref().map(expanded);
    let equation = sum(&row, &symbols.monomials(unknown, false));
    let variable = Symbols::variable(unknown);
    let polynomial = in_variable(variable, &of_row(kind, &row));
    let over_names: OverNames =
        Box::new(move |parts| in_variable(variable, &of_row(kind, &row.each_ref().map(|c| parts.name(c)))));
    finish(variable, &[equation], &polynomial, over_names, eliminated)
}

pub(super) fn sum(row: &[Polynomial<Rational>; 3], monomials: &[Polynomial<Rational>; 3]) -> Polynomial<Rational> {
    row.iter().zip(monomials).fold(Polynomial::zero(), |sum, (c, monomial)| sum.add(&c.mul(monomial)))
}

/// Returns the closure polynomial of two equations with separated sides, without division.
fn closure<R: Ring>(equations: &Separated<R>, hidden: usize) -> Univariate<R> {
    let powers = powers(equations.kinds[hidden], &[1, 1, 0].map(R::from_integer));
    Univariate::new(quartic(&equations.conic(hidden, &equations.solved(1 - hidden)), &powers).to_vec())
}

/// Derives two equations with an unknown on either side.
fn two_rows(
    symbols: &Symbols,
    unknowns: [usize; 2],
    equations: &Separated<Symbol>,
    plan: &Plan<Rational>,
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let Plan::Together { hidden, .. } = *plan else {
        let message = "symbols for a loop whose two equations fall apart into one in each unknown, for the numbers of the \
                       file";
        return Err(Error::Unsupported(message.to_owned()));
    };
    // All constants are moved to the first side, so that each has one name.
    let rows = equations.rows.each_ref().map(|row| {
        let [mut left, mut right] = row.each_ref().map(|side| side.each_ref().map(expanded));
        left[0] = left[0].sub(&right[0]);
        right[0] = Polynomial::zero();
        [left, right]
    });
    let listed = rows.iter().map(|row| {
        let [left, right] = [0, 1].map(|side| sum(&row[side], &symbols.monomials(unknowns[side], false)));
        left.sub(&right)
    });
    let variable = Symbols::variable(unknowns[hidden]);
    let polynomial = Univariate::new(closure(equations, hidden).coefficients().iter().map(expanded).collect());
    let (kinds, listed) = (equations.kinds, listed.collect::<Vec<_>>());
    let over_names: OverNames = Box::new(move |parts| {
        let rows = rows.each_ref().map(|row| row.each_ref().map(|side| side.each_ref().map(|c| parts.name(c))));
        in_variable(variable, &closure(&Separated { kinds, rows }, hidden))
    });
    finish(variable, &listed, &in_variable(variable, &polynomial), over_names, eliminated)
}

/// Returns the primitive multiple with positive leading coefficient, and the factor.
pub(super) fn canonical(polynomial: &Polynomial<Rational>) -> (Polynomial<Rational>, Rational) {
    let primitive = primitive(polynomial);
    let factor = match (primitive.coefficients().first(), polynomial.coefficients().first()) {
        (Some(own), Some(given)) => Rational::from(own / given),
        _ => Rational::from(1),
    };
    (primitive, factor)
}

/// Adds the names and steps of the derivation from numbers, and its polynomial to compare with.
fn finish(
    variable: usize,
    equations: &[Polynomial<Rational>],
    polynomial: &Polynomial<Rational>,
    over_names: OverNames,
    eliminated: &Eliminated,
) -> Result<Outcome> {
    let number = match &eliminated.polynomial {
        Some((_, polynomial, _)) => Polynomial::from_univariate(variable, polynomial),
        None => Polynomial::zero(),
    };
    let factors = eliminated.removed.iter().filter_map(|one| Some((one.factor.as_ref()?, one.multiplicity)));
    let removed = factors.fold(Polynomial::one(), |product, (factor, multiplicity)| {
        (0..multiplicity).fold(product, |product, _| product.mul(factor))
    });
    if polynomial.is_zero() {
        return Err(vanishing());
    }
    let (polynomial, factor) = canonical(polynomial);
    let over_names: OverNames = Box::new(move |parts| over_names(parts).scale(&factor));
    let names = eliminated.equations.iter().map(|equation| equation.name.clone());
    let equations = equations.iter().map(|equation| canonical(equation).0);
    Ok(Outcome {
        equations: names.zip(equations).collect(),
        steps: eliminated.steps.clone(),
        compare: vec![(polynomial.clone(), number)],
        removed,
        polynomial: Some((variable, polynomial, Some(over_names))),
        translations: Vec::new(),
        compared: "at the numbers of the file equal to the closure polynomial derived from the numbers".to_owned(),
    })
}
