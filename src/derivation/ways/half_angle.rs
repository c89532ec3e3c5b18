//! Half-angle tangents in all equations, and Sylvester's resultant by one of them.

use super::matrix::{PolynomialMatrix, sylvester};
use super::{Found, Matrix, Way, refusal};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::derivation::chain::{self, Exact};
use crate::derivation::symbols::Symbols;
use crate::derivation::{Equation, cuts};
use crate::elimination::kind::Elimination;
use crate::error::Result;
use rug::Rational;

/// Combinations of four equations: any regular matrix without zeros serves.
const MIXED: [[i32; 4]; 4] = [[1, 2, -1, 3], [2, -1, 3, 1], [-1, 3, 1, 2], [3, 1, 2, -2]];

/// Derives the equations of the loop in half-angle tangents, and their resultants.
pub(super) fn found(exact: &Exact, unknown: usize) -> Result<Found> {
    let none = |why: &str| refusal(Way::HalfAngle, why);
    let eliminated = if exact.elimination() == Elimination::Cut {
        cuts::eliminate_keeping(exact, unknown)
            .ok_or_else(|| none("every cut that keeps the unknown loses equations"))?
    } else {
        chain::eliminate(exact)?
    };
    if eliminated.polynomial.as_ref().is_none_or(|(own, _, _)| *own != unknown) {
        return Err(none("every elimination vanishes identically"));
    }
    let equations: Vec<Equation> = eliminated.equations.into_iter().filter(|one| one.algebraic.is_some()).collect();
    let algebraic: Vec<Polynomial<Rational>> = equations.iter().filter_map(|one| one.algebraic.clone()).collect();
    let kept = Symbols::variable(unknown);
    let name = |variable: usize| exact.symbols.name(variable / 3);
    let others: Vec<usize> =
        (0..6).map(Symbols::variable).filter(|v| *v != kept && algebraic.iter().any(|p| p.degree(*v) > 0)).collect();
    let start = format!(
        "With cos = (1 - t^2)/(1 + t^2) and sin = 2t/(1 + t^2) the {} become polynomials in {}.",
        if algebraic.len() == 1 {
            "closure equation".to_owned()
        } else {
            format!("{} closure equations", algebraic.len())
        },
        std::iter::once(kept).chain(others.iter().copied()).map(name).collect::<Vec<_>>().join(", ")
    );
    match (algebraic.as_slice(), others.as_slice()) {
        ([one], []) => {
            let eliminant = one.to_univariate(kept).ok_or_else(|| none("the equation has other unknowns"))?;
            let meaning = "the closure equation itself".to_owned();
            let matrix = Matrix { rows: 1, columns: 1, entries: eliminant.degree().unwrap_or(0), meaning };
            Ok(Found { equations, steps: vec![start], matrix, eliminants: vec![eliminant] })
        }
        ([f, g], [other]) => {
            let rows = sylvester(f, g, *other, kept).ok_or_else(|| none("the equations have other unknowns"))?;
            let matrix = PolynomialMatrix::of(&rows);
            let meaning = format!("Sylvester's matrix of both equations in the powers of {}", name(*other));
            let size = Matrix { rows: matrix.rows(), columns: matrix.columns(), entries: matrix.degree(), meaning };
            let step = format!(
                "They are of degree {} and {} in {}; the determinant of Sylvester's matrix is their resultant.",
                f.degree(*other),
                g.degree(*other),
                name(*other)
            );
            Ok(Found { equations, steps: vec![start, step], matrix: size, eliminants: vec![matrix.determinant()] })
        }
        ([a, b, c, d], _) => four(exact, equations.clone(), [a, b, c, d], kept, &others, start),
        _ => Err(none("the closure equations of this loop are not two in two unknowns, nor four in three")),
    }
}

/// Eliminates one tangent x from four equations `e0 + x e1` by minors; then takes resultants of two pairs of these.
fn four(
    exact: &Exact,
    equations: Vec<Equation>,
    list: [&Polynomial<Rational>; 4],
    kept: usize,
    others: &[usize],
    start: String,
) -> Result<Found> {
    let none = |why: &str| refusal(Way::HalfAngle, why);
    let is_linear = |v: &&usize| list.iter().all(|p| p.degree(**v) <= 1);
    let linear = *others.iter().find(is_linear).ok_or_else(|| none("no unknown is linear in all equations"))?;
    let other = *others.iter().find(|v| **v != linear).ok_or_else(|| none("there is no third unknown"))?;
    let parts = list.map(|p| {
        let c = p.coefficients_in(linear);
        [0, 1].map(|k| c.get(k).cloned().unwrap_or_else(Polynomial::zero))
    });
    let determinants = |parts: &[[Polynomial<Rational>; 2]; 4]| {
        let minor = |i: usize, j: usize| parts[i][0].mul(&parts[j][1]).sub(&parts[i][1].mul(&parts[j][0]));
        let matrix = |pairs: [[usize; 2]; 2]| {
            let [f, g] = pairs.map(|[i, j]| minor(i, j));
            let matrix = PolynomialMatrix::of(&sylvester(&f, &g, other, kept)?);
            let determinant = matrix.determinant();
            (determinant.degree().is_some()).then_some((matrix, determinant))
        };
        matrix([[0, 1], [2, 3]]).zip(matrix([[0, 2], [1, 3]]))
    };
    // Two minors of special equations may have a factor in common, which those of combinations of the equations mostly have not.
    let mixed = || -> [[Polynomial<Rational>; 2]; 4] {
        let weight = |i: usize, j: usize| Rational::from(MIXED[i][j]);
        std::array::from_fn(|i| {
            [0, 1].map(|k| {
                let terms = (0..4).map(|j| parts[j][k].scale(&weight(i, j)));
                terms.fold(Polynomial::zero(), |sum, term| sum.add(&term))
            })
        })
    };
    let own = determinants(&parts).map(|found| (found, ""));
    let found = own.or_else(|| determinants(&mixed()).map(|found| (found, " of four combinations of the equations")));
    let (((matrix, one), (_, two)), of) = found.ok_or_else(|| {
        none(
            "the matrix of this loop is singular for every value of the unknown, also of combinations of the equations",
        )
    })?;
    let name = |variable: usize| exact.symbols.name(variable / 3);
    let steps = vec![
        start,
        format!(
            "They are linear in {x}, e0 + {x} e1 = 0: the minors e0 e1' - e0' e1 of two of them are free of it, and of degree 4 in {} and \
             {}.",
            name(other),
            name(kept),
            x = name(linear)
        ),
        format!(
            "The resultants of the minors (1,2), (3,4) and (1,3), (2,4){of} by {} are determinants of Sylvester's matrix; what only one of them has \
             for a factor belongs to no solution.",
            name(other)
        ),
    ];
    let meaning = format!("Sylvester's matrix of two minors in the powers of {}", name(other));
    let size = Matrix { rows: matrix.rows(), columns: matrix.columns(), entries: matrix.degree(), meaning };
    Ok(Found { equations, steps, matrix: size, eliminants: vec![one, two] })
}
