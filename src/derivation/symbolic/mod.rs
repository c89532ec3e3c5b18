//! Derivations that keep link parameters as symbols: the same closure equations and eliminations over a ring of
//! polynomials.

pub(super) mod dual;
mod interpolated;
mod parts;
mod routes;
mod setting;
mod size;
mod table;

pub(crate) use interpolated::derive_interpolated;
pub(crate) use setting::{Place, Setting};

use super::chain::{Exact, eliminate, exact};
use super::interpolation::Watch;
use super::symbols::{Symbols, joint_labels};
use super::two_sides;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::catalogue::entry::{Case, Design, Entry};
use crate::elimination::kind::Elimination;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, JointKind};
use crate::kinematics::link_form::LinkForm;
use crate::mechanism::ss_dyad_loop;
use parts::Parts;
use routes::Outcome;
use rug::Rational;
use table::Table;

/// A polynomial with symbols in its coefficients.
#[derive(Clone, Debug)]
pub struct Displayed {
    /// Its name.
    pub name: String,
    /// The polynomial over unknowns and symbols.
    pub polynomial: Polynomial<Rational>,
    /// The same polynomial over the unknowns and the names of sub-expressions.
    pub compact: Polynomial<Rational>,
}

/// A variable that is a quotient.
#[derive(Clone, Debug)]
pub struct Quotient {
    /// The variable.
    pub variable: usize,
    /// The numerator over unknowns and symbols.
    pub numerator: Polynomial<Rational>,
    /// The denominator over unknowns and symbols.
    pub denominator: Polynomial<Rational>,
}

/// The closure polynomial in its variable.
#[derive(Clone, Debug)]
pub struct SymbolicPolynomial {
    /// A half-angle tangent or a distance.
    pub variable: usize,
    /// The polynomial.
    pub displayed: Displayed,
}

/// A derivation with symbols for link parameters.
#[derive(Clone, Debug)]
pub struct Symbolic {
    /// The names of unknowns, symbols and sub-expressions.
    pub names: Names,
    /// The parameters that are symbols: `alpha1` has the variables `ca1` and `sa1`.
    pub symbols: Vec<String>,
    /// The parameters that keep the numbers of the file: `d4 = 0`.
    pub numbers: Vec<String>,
    /// The closure equations.
    pub equations: Vec<Displayed>,
    /// The steps from the equations to the polynomial.
    pub steps: Vec<String>,
    /// The closure polynomial; `None` if the derivation ends with two equations in two unknowns.
    pub polynomial: Option<SymbolicPolynomial>,
    /// Named sub-expressions over the symbols.
    pub parts: Vec<(String, Polynomial<Rational>)>,
    /// Translations in terms of unknowns and symbols.
    pub translations: Vec<Quotient>,
    /// The variables of the symbols with the numbers of the file.
    pub values: Vec<(usize, Rational)>,
    /// The data with which the result was compared, as a clause: `at the numbers of the file equal to ...`.
    pub compared: String,
    /// Whether every step is an identity; if not, the probability of error is below 2^-40.
    pub proved: bool,
}

/// Derives one case with symbols: by [`derive_symbolic`] if an elimination works with symbols, else, for up to three symbols that
/// are named, by interpolation between derivations with numbers. The symbols are then link parameters, the input, the position
/// `x`, `y`, `z` of the pose of an arm, turns `turn_x`, `turn_y`, `turn_z` of the tool there about its own axes, points `point2.x` of axes in
/// screws, or lengths `leg1` and coordinates of points `base1.x`, `plate1.x` of a platform.
///
/// # Errors
/// [`Error::Unsupported`] if the polynomial has too many terms, or no derivation with numbers exists; [`Error::Invalid`] for an
/// unknown parameter.
pub fn derive_with_symbols(entry: &Entry, case: &Case, wanted: &[String], watch: &Watch<'_>) -> Result<Symbolic> {
    let is_of_pose =
        |name: &String| setting::COORDINATES.iter().chain(&setting::TURNS).any(|own| *own == name.as_str());
    if case.pose.is_some() && wanted.iter().any(is_of_pose) {
        return interpolated::derive_interpolated(entry, case, wanted, watch);
    }
    match derive_symbolic(entry, case, wanted) {
        Err(Error::Unsupported(_)) if !wanted.is_empty() => {
            interpolated::derive_interpolated(entry, case, wanted, watch)
        }
        other => other,
    }
}

/// Derives one case with symbols for its link parameters and its input: for the parameters named, or for all that are
/// neither zero nor a right angle in the file.
///
/// # Errors
/// [`Error::Unsupported`], with an estimate of the size, for loops whose polynomial is too large for symbols, and
/// for mechanisms without DH parameters; [`Error::Invalid`] for an unknown parameter.
pub fn derive_symbolic(entry: &Entry, case: &Case, wanted: &[String]) -> Result<Symbolic> {
    let (Design::Arm(chain) | Design::Loop(chain)) = &entry.design else {
        let message = "symbols for platforms: their closure polynomial, of degree 40 with 6 lengths and 36 coordinates, is \
                       computed for numbers only";
        return Err(Error::Unsupported(message.to_owned()));
    };
    let is_pair = chain.joint_kinds() == [JointKind::Revolute; 4];
    let (symbols, numeric) = if is_pair { (four_rotations(chain), None) } else { numeric(chain, case)? };
    let unknowns = 3 * symbols.len();
    let table = Table::of(chain, case, wanted, unknowns, !is_pair)?;
    let outcome = match &numeric {
        None => {
            let input = case.input.first().map_or(chain.joint_kinds().len(), |input| input.joint);
            dual::four_revolutes(chain, &table, &symbols, (input + 3) % 4)?
        }
        Some(numeric) => routes::route(chain, case, &table, &symbols, numeric)?,
    };
    finished(&table, &symbols, outcome)
}

/// The numeric derivation of a case, with which symbols are compared.
enum Numeric {
    /// Two spherical joints.
    SsDyad(super::chain::Eliminated),
    /// Any other loop.
    Single(Box<Exact>, super::chain::Eliminated),
}

fn numeric(chain: &Chain, case: &Case) -> Result<(Symbols, Option<Numeric>)> {
    if let Some(ss_dyad) = ss_dyad_loop::<Rational>(chain, case)? {
        let symbols = Symbols::single(chain, ss_dyad.indices[2], ss_dyad.variable);
        let eliminated = two_sides::ss_dyad(&symbols, &joint_labels(chain), &ss_dyad);
        return Ok((symbols, Some(Numeric::SsDyad(eliminated))));
    }
    let exact = exact(chain, case)?;
    let is_neighbour = || LinkForm::of(&exact.closed).is_some_and(|form| dual::opposite_link(&form).is_some());
    let special = exact.elimination() == Elimination::Triangle
        || exact.two_sided().is_some_and(|way| way.serves(&exact.closed).is_some())
        || is_neighbour();
    if !special {
        return Err(size::too_large(chain, case, &exact));
    }
    let eliminated = eliminate(&exact)?;
    Ok((exact.symbols.clone(), Some(Numeric::Single(Box::new(exact), eliminated))))
}

/// Returns the unknowns of a loop of four revolutes.
fn four_rotations(chain: &Chain) -> Symbols {
    Symbols::rotations(joint_labels(chain))
}

/// Compares with the numbers, and names coefficients.
fn finished(table: &Table<'_>, symbols: &Symbols, outcome: Outcome) -> Result<Symbolic> {
    let values: Vec<(usize, Polynomial<Rational>)> =
        table.values().into_iter().map(|(variable, value)| (variable, Polynomial::constant(value))).collect();
    let are_equal = |left: &Polynomial<Rational>, right: &Polynomial<Rational>| match (left.is_zero(), right.is_zero())
    {
        (false, false) => super::equation::primitive(left) == super::equation::primitive(right),
        (left, right) => left == right,
    };
    for (symbolic, number) in &outcome.compare {
        let at = symbolic.substitute_all(&values);
        let equal = are_equal(&at, number) || are_equal(&at, &number.mul(&outcome.removed));
        if !equal {
            let message = "the polynomial with symbols does not become that of the numbers: a fault of this program";
            return Err(Error::Invalid(message.to_owned()));
        }
    }
    let header = Header {
        unknowns: symbols.list(),
        variables: table.names.clone(),
        symbols: table.symbols.iter().map(|symbol| symbol.name.clone()).collect(),
        numbers: table.numbers.clone(),
        values: table.values(),
        proved: true,
    };
    assembled(header, outcome)
}

/// The head of a derivation with symbols.
struct Header {
    /// The names of the unknowns, three for each.
    unknowns: Vec<String>,
    /// The names of the symbols' variables, which come after them.
    variables: Vec<String>,
    symbols: Vec<String>,
    numbers: Vec<String>,
    values: Vec<(usize, Rational)>,
    proved: bool,
}

/// Names the coefficients.
fn assembled(header: Header, outcome: Outcome) -> Result<Symbolic> {
    let unknowns = header.unknowns.len();
    let mut parts = Parts::new(unknowns + header.variables.len());
    let mut equations = Vec::new();
    for (name, polynomial) in outcome.equations {
        let compact = parts.compact(&polynomial, unknowns);
        equations.push(Displayed { name, polynomial, compact });
    }
    let polynomial = outcome.polynomial.map(|(variable, polynomial, over_names)| {
        let compact = match over_names {
            Some(over_names) => over_names(&mut parts),
            None => parts.compact(&polynomial, unknowns),
        };
        (variable, Displayed { name: "closure polynomial".to_owned(), polynomial, compact })
    });
    // Names of sub-expressions come first, so that they precede the powers that they multiply.
    let count = parts.list.len();
    let all = unknowns + header.variables.len() + count;
    let moved = |polynomial: &Polynomial<Rational>| {
        Polynomial::from_terms(polynomial.terms().map(|(mut exponents, c)| {
            exponents.resize(all, 0);
            exponents.rotate_right(count);
            (exponents, c.clone())
        }))
    };
    let displayed = |one: &Displayed| {
        let (polynomial, compact) = (moved(&one.polynomial), moved(&one.compact));
        Displayed { name: one.name.clone(), polynomial, compact }
    };
    let names = parts.list.iter().map(|(name, _)| name.clone()).chain(header.unknowns);
    let quotient = |one: &Quotient| {
        let (numerator, denominator) = (moved(&one.numerator), moved(&one.denominator));
        Quotient { variable: one.variable + count, numerator, denominator }
    };
    Ok(Symbolic {
        names: Names::given(names.chain(header.variables))?,
        symbols: header.symbols,
        numbers: header.numbers,
        equations: equations.iter().map(displayed).collect(),
        steps: outcome.steps,
        polynomial: polynomial
            .map(|(variable, one)| SymbolicPolynomial { variable: variable + count, displayed: displayed(&one) }),
        translations: outcome.translations.iter().map(quotient).collect(),
        values: header.values.into_iter().map(|(variable, number)| (variable + count, number)).collect(),
        parts: parts.list.iter().map(|(name, part)| (name.clone(), moved(part))).collect(),
        compared: outcome.compared,
        proved: header.proved,
    })
}
