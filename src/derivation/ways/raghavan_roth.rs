//! Raghavan and Roth: six of fourteen equations are free of three unknowns. Times 1 and a half-angle tangent they are twelve
//! linear equations in the products of powers of two half-angle tangents. \[RaghavanRoth1993\]

use super::matrix::PolynomialMatrix;
use super::{Found, Matrix, Way, refusal};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::closure::half_angle::half_angle_form;
use crate::closure::woernle_lee::{SIZE, act, right_columns, split_inverse};
use crate::derivation::Equation;
use crate::derivation::chain::Exact;
use crate::derivation::symbols::bilinear_form;
use crate::elimination::cut::Cut;
use crate::error::Result;
use rug::Rational;

/// Coefficients over (1, cos, sin) of unknowns 1, 2 and 3 of a cut, outermost first.
type Trilinear = [[[Rational; 3]; 3]; 3];

/// Returns the matrix that keeps an unknown.
pub(super) fn found(exact: &Exact, unknown: usize) -> Result<Found> {
    let none = |why: &str| refusal(Way::RaghavanRoth, why);
    if exact.spherical.is_some() {
        return Err(none("the angles of a spherical joint are not determined by lines through its centre"));
    }
    let keeps = |cut: &&Cut| cut.unknown_index(2) == unknown;
    let fits = |cut: &&Cut| cut.fits(exact.closed.variables);
    let mut cuts = Cut::ALL.iter().filter(keeps).filter(fits);
    let found = cuts.find_map(|cut| {
        let rows = rows(exact, *cut)?;
        let matrix = PolynomialMatrix::of(&matrix(&rows));
        let determinant = matrix.determinant();
        determinant.degree()?;
        Some((*cut, rows, matrix, determinant))
    });
    let Some((cut, rows, matrix, determinant)) = found else {
        let why = "it needs six equations of rank 14 in all, and four unknown rotations with a translation, if there is one, next to but one \
                   of them: every cut of this loop that keeps an unknown loses equations or has translations elsewhere";
        return Err(none(why));
    };
    let label = |j: usize| exact.symbols.label(cut.unknown_index(j));
    let name = |j: usize| exact.symbols.name(cut.unknown_index(j));
    let steps = vec![
        format!(
            "The loop is cut at the axes of joints {} and {}: a line and a marked point on it, seen from both sides, give 14 equations in \
             five unknowns, linear in the 8 products of (1, cos, sin) of joints {} and {}.",
            label(2),
            label(5),
            label(3),
            label(4)
        ),
        format!(
            "The 15 x 9 matrix of these products has rank 9: six combinations are free of them, trilinear in (1, cos, sin) of joints {}, {} \
             and {}.",
            label(0),
            label(1),
            label(2)
        ),
        format!(
            "In half-angle tangents, times 1 and {a}, they are 12 linear equations in the products of (1, {a}, {a}^2, {a}^3) and (1, {b}, {b}^2): a \
             12 x 12 matrix of degree 2 in {}.",
            name(2),
            a = name(0),
            b = name(1)
        ),
        format!("Its determinant is of degree 24 or less; 1 + {0}^2 divides it four times in general.", name(2)),
    ];
    let meaning =
        format!("six equations times 1 and {0}, over the products of powers of {0} and {1}", name(0), name(1));
    let size = Matrix { rows: 12, columns: 12, entries: matrix.degree(), meaning };
    // In a loop that is read backwards the unknown has the opposite sign.
    let eliminant = if cut.reversed { mirrored(&determinant) } else { determinant };
    Ok(Found { equations: listed(exact, cut, &rows), steps, matrix: size, eliminants: vec![eliminant] })
}

fn mirrored(p: &Univariate<Rational>) -> Univariate<Rational> {
    let signed = |(k, c): (usize, &Rational)| if k % 2 == 1 { Rational::from(-c) } else { c.clone() };
    Univariate::new(p.coefficients().iter().enumerate().map(signed).collect())
}

/// Returns the six equations free of unknowns 4 to 6 of a cut; `None` if it loses equations.
fn rows(exact: &Exact, cut: Cut) -> Option<[Trilinear; 6]> {
    let view = cut.of(&exact.closed);
    let form = half_angle_form(&view)?;
    let back = view.constants[1].inverse();
    let columns =
        right_columns(&view).map(|row| row.map(|column| split_inverse(view.variables[2], &act(&back, &column))));
    Some(std::array::from_fn(|e| {
        columns.each_ref().map(|row| {
            row.each_ref().map(|parts| {
                parts.each_ref().map(|part| {
                    (0..SIZE).fold(Rational::new(), |sum, i| sum + Rational::from(&form.free_of_last[e][i] * &part[i]))
                })
            })
        })
    }))
}

/// Converts coefficients over (1, cos, sin) to those over (1, t, t^2), times `1 + t^2`.
fn powers(row: &[Rational; 3]) -> [Rational; 3] {
    let [one, cos, sin] = row;
    [Rational::from(one + cos), Rational::from(sin * 2), Rational::from(one - cos)]
}

/// Returns the twelve rows.
fn matrix(rows: &[Trilinear; 6]) -> Vec<Vec<Univariate<Rational>>> {
    let mut matrix = Vec::new();
    for row in rows {
        // `[k1][k2]` over the powers of the third tangent, then those of the second, then those of the first.
        let third: [[[Rational; 3]; 3]; 3] = row.each_ref().map(|plane| plane.each_ref().map(powers));
        let second: [[[Rational; 3]; 3]; 3] = third.each_ref().map(|plane| {
            let by_power = [0, 1, 2].map(|p| powers(&[0, 1, 2].map(|k| plane[k][p].clone())));
            [0, 1, 2].map(|q| [0, 1, 2].map(|p| by_power[p][q].clone()))
        });
        let at = |q: usize, p: usize| powers(&[0, 1, 2].map(|k| second[k][q][p].clone()));
        let all: [[[Rational; 3]; 3]; 3] = [0, 1, 2].map(|q| [0, 1, 2].map(|p| at(q, p)));
        for shift in 0..2 {
            let mut line = vec![Univariate::zero(); 12];
            for (q, by_third) in all.iter().enumerate() {
                for i in 0..3 {
                    let coefficients = by_third.iter().map(|by_first| by_first[i].clone()).collect();
                    line[3 * (i + shift) + q] = Univariate::new(coefficients);
                }
            }
            matrix.push(line);
        }
    }
    matrix
}

fn listed(exact: &Exact, cut: Cut, rows: &[Trilinear; 6]) -> Vec<Equation> {
    let monomials = [0, 1, 2].map(|j| exact.symbols.monomials(cut.unknown_index(j), cut.reversed));
    let label = |j: usize| exact.symbols.label(cut.unknown_index(j));
    let one = |(row, number): (&Trilinear, usize)| {
        let polynomial = (0..3).fold(Polynomial::zero(), |sum, k1| {
            let form: [[Rational; 3]; 3] = row[k1].clone();
            sum.add(&bilinear_form(&form, &monomials[1], &monomials[2]).mul(&monomials[0][k1]))
        });
        let name = format!("without {}, {}, {}: equation {number}", label(3), label(4), label(5));
        Equation::used(name, &polynomial)
    };
    rows.iter().zip(1..).map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_tangents_take_the_place_of_cosine_and_sine() {
        // cos + sin: (1 - t^2) + 2 t
        let row = [0, 1, 1].map(Rational::from);
        assert_eq!(powers(&row), [1, 2, -1].map(Rational::from));
    }
}
