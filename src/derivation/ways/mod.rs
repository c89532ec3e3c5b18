//! One closure polynomial by several eliminations, each with its own equations and matrix: see docs/ways.md.

mod dual;
mod half_angle;
mod matrix;
mod raghavan_roth;
mod study;

use super::chain::{self, Exact};
use super::cuts;
use super::equation::Equation;
use super::four_bar;
use super::polynomial::Removed;
use super::symbols::Symbols;
use super::{Derivation, derive};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::entry::{Case, Design, Entry};
use crate::elimination::kind::Elimination;
use crate::error::{Error, Result};
use crate::mechanism::ss_dyad_loop;
use rug::{Integer, Rational};

/// A way from the closure of a loop to its closure polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Lee, Woernle and Hiller: invariants of two lines with a marked point, a pencil of size 8.
    WoernleLee,
    /// Half-angle tangents in all equations, and the resultant of two polynomials in one of them.
    HalfAngle,
    /// Study's parameters of both sides of the loop as tensor products of half-angle pairs.
    Study,
    /// Raghavan and Roth: six equations in three unknowns, a matrix of size 12.
    RaghavanRoth,
    /// The spherical loop over dual numbers.
    Dual,
}

impl Way {
    /// All ways with their names.
    pub const NAMED: [(&'static str, Self); 5] = [
        ("woernle-lee", Self::WoernleLee),
        ("half-angle", Self::HalfAngle),
        ("study", Self::Study),
        ("raghavan-roth", Self::RaghavanRoth),
        ("dual", Self::Dual),
    ];

    /// Returns the name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::NAMED.iter().find(|(_, way)| *way == self).map_or("", |(name, _)| name)
    }
}

/// The matrix of an elimination.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Matrix {
    /// The number of rows.
    pub rows: usize,
    /// The number of columns.
    pub columns: usize,
    /// The degree of its entries in the unknown that is kept.
    pub entries: usize,
    /// The meaning of its rows and columns.
    pub meaning: String,
}

/// A derivation by one way.
#[derive(Clone, Debug)]
pub struct ByWay {
    /// The way.
    pub way: Way,
    /// Its matrix.
    pub matrix: Matrix,
    /// The degree of the eliminant before false factors are divided out.
    pub before: usize,
    /// The factors divided out: roots that belong to no solution.
    pub divided: Vec<Removed>,
    /// The equations and steps of this way with the closure polynomial, which is that of `derive` over the rationals.
    pub derivation: Derivation,
}

/// The result of an elimination.
struct Found {
    equations: Vec<Equation>,
    steps: Vec<String>,
    matrix: Matrix,
    /// Polynomials in the unknown that all have every solution as a root.
    eliminants: Vec<Univariate<Rational>>,
}

/// Returns the error for a way that does not apply.
fn refusal(way: Way, why: &str) -> Error {
    Error::Unsupported(format!("--by {} does not apply: {why}", way.name()))
}

/// Derives the closure polynomial of an arm or a loop by one way, and compares it over the rationals with that of [`derive`].
///
/// # Errors
/// [`Error::Unsupported`] if the way does not apply to the mechanism, with the reason; [`Error::Invalid`] if both differ, which
/// would be a fault of this program.
pub fn derive_by(entry: &Entry, case: &Case, way: Way) -> Result<ByWay> {
    let (Design::Arm(chain) | Design::Loop(chain)) = &entry.design else {
        return Err(refusal(way, "a platform has one elimination, by Study's parameters: derive without --by"));
    };
    if ss_dyad_loop::<Rational>(chain, case)?.is_some() {
        return Err(refusal(way, "two spherical joints leave one equation in one unknown, with nothing to eliminate"));
    }
    let own = derive(entry, case)?;
    let exact = chain::exact(chain, case)?;
    let known = own.polynomial.as_ref().map(|polynomial| polynomial.variable / 3);
    let unknown = known.ok_or_else(|| refusal(way, "the loop has no closure polynomial"))?;
    match found(&exact, unknown, way) {
        Err(Error::Unsupported(message)) => {
            // Another unknown may be possible; its polynomial is then derived.
            let others = (0..6).filter(|other| *other != unknown);
            others
                .into_iter()
                .find_map(|other| {
                    let found = found(&exact, other, way).ok()?;
                    let own = keeping(entry, &exact, other, &own)?;
                    Some(compared(way, other, found, own))
                })
                .unwrap_or(Err(Error::Unsupported(message)))
        }
        found => compared(way, unknown, found?, own),
    }
}

/// Derives another unknown.
fn keeping(entry: &Entry, exact: &Exact, unknown: usize, own: &Derivation) -> Option<Derivation> {
    let eliminated = match exact.elimination() {
        Elimination::Cut => cuts::eliminate_keeping(exact, unknown),
        Elimination::FourBar => four_bar::eliminate_keeping(exact, unknown),
        Elimination::Centre(_) | Elimination::Triangle | Elimination::Planar => None,
    }?;
    let found = chain::settle(exact, eliminated, None).ok()?;
    found.polynomial.as_ref()?;
    let warnings = if entry.rounded { own.warnings.clone() } else { found.warnings.clone() };
    Some(Derivation { warnings, ..found })
}

fn found(exact: &Exact, unknown: usize, way: Way) -> Result<Found> {
    match way {
        Way::WoernleLee => woernle_lee(exact, unknown),
        Way::HalfAngle => half_angle::found(exact, unknown),
        Way::Study => study::found(exact, unknown),
        Way::RaghavanRoth => raghavan_roth::found(exact, unknown),
        Way::Dual => dual::found(exact, unknown),
    }
}

/// Applies the elimination of the solver.
fn woernle_lee(exact: &Exact, unknown: usize) -> Result<Found> {
    let eliminated = chain::eliminate(exact)?;
    let none = || refusal(Way::WoernleLee, "every elimination vanishes identically");
    let (_, polynomial, _) = eliminated.polynomial.filter(|(own, _, _)| *own == unknown).ok_or_else(none)?;
    // The factors divided out there already belong to the eliminant.
    let whole = eliminated.removed.iter().fold(polynomial, |product, one| {
        let factor = one.factor.as_ref().and_then(|factor| factor.to_univariate(Symbols::variable(unknown)));
        factor.map_or(product.clone(), |factor| (0..one.multiplicity).fold(product, |p, _| Ring::mul(&p, &factor)))
    });
    let matrix = |rows, columns, entries, meaning: &str| Matrix { rows, columns, entries, meaning: meaning.to_owned() };
    let matrix = match exact.elimination() {
        Elimination::Centre(_) => {
            matrix(2, 3, 2, "two equations over (1, cos, sin), or (1, d, d^2), of the unknown that goes")
        }
        Elimination::Triangle => matrix(1, 3, 2, "one equation over (1, cos, sin) of the unknown"),
        Elimination::Cut => matrix(
            8,
            8,
            2,
            "four equations times 1 and a half-angle tangent, over the products of its powers up to 3 with (1, the \
                                            half-angle tangent of the third unknown)",
        ),
        Elimination::FourBar | Elimination::Planar => {
            matrix(2, 3, 2, "two equations over (1, cos, sin) of the unknown that goes")
        }
    };
    Ok(Found { equations: eliminated.equations, steps: eliminated.steps, matrix, eliminants: vec![whole] })
}

/// Compares with the known closure polynomial: both must be equal once false factors are divided out.
fn compared(way: Way, unknown: usize, found: Found, own: Derivation) -> Result<ByWay> {
    let variable = Symbols::variable(unknown);
    let name = own.names.list()[variable].clone();
    let polynomial = own.polynomial.as_ref().ok_or_else(|| refusal(way, "the loop has no closure polynomial"))?;
    let integers = |p: &Univariate<Rational>| Univariate::new(p.primitive_integers());
    let eliminants: Vec<Univariate<Integer>> = found.eliminants.iter().map(integers).collect();
    if eliminants.iter().any(|p| p.degree().is_none()) {
        return Err(refusal(way, "the matrix of this loop is singular for every value of the unknown"));
    }
    let before = eliminants[0].degree().unwrap_or(0);
    let mut divided = Vec::new();
    let mut divide = |factor: &Univariate<Integer>, reason: &str| {
        for (factor, multiplicity) in factor.square_free_decomposition() {
            if factor.degree() > Some(0) {
                let factor = Polynomial::from_univariate(variable, &rational(&factor.primitive_part()));
                divided.push(Removed { factor: Some(factor), multiplicity, reason: reason.to_owned() });
            }
        }
    };
    let common = eliminants.iter().skip(1).fold(eliminants[0].clone(), |gcd, p| gcd.gcd(p));
    let foreign = eliminants[0].quotient(&common).unwrap_or_else(Ring::one);
    divide(&foreign, "another mixture of the same equations does not have these roots");
    let circle = Univariate::circle();
    let mut rest = common;
    let mut circles = Univariate::new(vec![Integer::from(1)]);
    while let Some(quotient) = rest.quotient(&circle).filter(|_| polynomial.coefficients.quotient(&circle).is_none()) {
        (rest, circles) = (quotient, Ring::mul(&circles, &circle));
    }
    divide(&circles, "no angle has the half-angle tangent i");
    let wanted = polynomial.coefficients.primitive_part();
    let mut quotient = rest.quotient(&wanted).ok_or_else(|| {
        let message = format!(
            "--by {} gives a polynomial in {name} that the closure polynomial does not divide: a fault of this program",
            way.name()
        );
        Error::Invalid(message)
    })?;
    while let Some(again) = quotient.quotient(&wanted).filter(|_| wanted.degree() > Some(0)) {
        divide(&wanted, "at each root of the closure polynomial there is more than one solution");
        quotient = again;
    }
    divide(&quotient.primitive_part(), "the closure polynomial does not have these roots: they belong to no solution");
    let mut steps = found.steps;
    steps.push(format!(
        "The eliminant is of degree {before} in {name}. Without the factors that are divided out it is, over the rationals, the closure \
         polynomial of degree {} that the elimination by Woernle and Lee gives.",
        polynomial.degree()
    ));
    let derivation = Derivation { equations: found.equations, steps, definition: None, ..own };
    Ok(ByWay { way, matrix: found.matrix, before, divided, derivation })
}

fn rational(p: &Univariate<Integer>) -> Univariate<Rational> {
    p.map(|c| Some(Rational::from(c))).unwrap_or_else(Ring::zero)
}
