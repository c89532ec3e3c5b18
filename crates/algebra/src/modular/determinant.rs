//! Determinants of matrices of polynomials with numeric coefficients.

use super::batch::place;
use super::bound::Norms;
use super::cost::cost;
use super::lattice::Lattice;
use super::minors::Minors;
use super::problem::{Form, Problem, most_points};
use super::substitution::Plan;
use super::terms::{Terms, descending};
use crate::int::Int;
use crate::ring::Ring;
use pulp::Arch;

/// Returns the determinant of a matrix of polynomials in several variables.
///
/// It is exact and proved, from as many values modulo as many primes as bounds on its degree and coefficients require. `None`
/// if that takes too much memory, for more than a few million values.
///
/// # Shape
/// The matrix is square; entries and determinant have the given number of variables. No two terms of an entry have the
/// same exponents.
///
/// # Panics
/// If the shape is wrong.
#[must_use]
pub fn determinant(matrix: &[Vec<Terms>], variables: usize) -> Option<Terms> {
    determinant_on(Arch::new(), matrix, variables)
}

/// As `determinant`, on a chosen instruction set.
pub(super) fn determinant_on(arch: Arch, matrix: &[Vec<Terms>], variables: usize) -> Option<Terms> {
    let size = matrix.len();
    assert!(matrix.iter().all(|row| row.len() == size), "a determinant is of a square matrix");
    let entries = || matrix.iter().flatten().enumerate();
    let terms = entries().flat_map(|(slot, entry)| entry.iter(variables).map(move |(e, c)| (slot, e, c)));

    let norms = Norms::new(size * size, terms.clone().map(|(slot, _, c)| (slot, c)));
    let Some(bits) = bits(size, &norms) else { return Some(Terms::default()) };
    let bound = |size_of: &dyn Fn(&[u32]) -> usize| {
        let mut degrees = vec![0; size * size];
        for (slot, e, _) in terms.clone() {
            degrees[slot] = degrees[slot].max(size_of(e));
        }
        degree_bound(size, &degrees)
    };
    let (parameters, degrees): (Vec<usize>, Vec<usize>) =
        (0..variables).map(|k| (k, bound(&|e| e[k] as usize))).filter(|&(_, degree)| degree > 0).unzip();
    let lattice =
        Lattice::new(&degrees, bound(&|e| e.iter().map(|&x| x as usize).sum()), most_points(bits, parameters.len()))?;

    let mut terms = descending(terms, &parameters);
    for slot in &mut terms.slots {
        *slot = place(size, *slot);
    }
    let problem = Problem {
        form: Form::Matrix(size),
        plan: Plan::new(&terms.slots, &terms.exponents, parameters.len()),
        coefficients: terms.coefficients,
        lattice,
        bits,
    };
    let coefficients = problem.solve(arch);
    Some(problem.lattice.terms(coefficients, variables, &parameters))
}

/// Returns the coefficients of the determinant of a matrix of polynomials in one variable, constant term first; some of the
/// highest may be zero.
///
/// # Shape
/// `entries` holds the entries row by row, each by its coefficients, constant term first.
pub(crate) fn univariate_determinant(size: usize, entries: &[Vec<Int>]) -> Vec<Int> {
    short_determinant(size, entries, None).unwrap_or_else(|| by_values(Arch::new(), size, entries))
}

/// As `univariate_determinant`, by minors in machine words; `None` if they would be too short, or if that is predicted to take
/// more nanoseconds than the limit, or without a limit more than from values.
pub(crate) fn short_determinant(size: usize, entries: &[Vec<Int>], limit: Option<f64>) -> Option<Vec<Int>> {
    let minors = Minors::new(size, entries)?;
    let words = || minors.entries.iter().enumerate().flat_map(|(slot, entry)| entry.iter().map(move |c| (slot, *c)));
    let Some(bits) = bits(size, &Norms::of_words(size * size, words())) else { return Some(Vec::new()) };
    let (terms, degree) = (words().count(), minors.degree());
    let limit = limit.or_else(|| determinant_cost(size, &[degree], degree, bits, terms));
    minors.determinant(bits, limit.unwrap_or(f64::INFINITY))
}

/// As `univariate_determinant`, from values modulo primes on a chosen instruction set.
pub(super) fn by_values(arch: Arch, size: usize, entries: &[Vec<Int>]) -> Vec<Int> {
    let degrees: Vec<usize> =
        entries.iter().map(|entry| entry.iter().rposition(|c| !c.is_zero()).unwrap_or(0)).collect();
    let lattice = Lattice::new(&[degree_bound(size, &degrees)], usize::MAX, usize::MAX)
        .expect("there is no limit to the number of points");
    let (mut slots, mut exponents, mut coefficients) = (Vec::new(), Vec::new(), Vec::new());
    let mut places = Vec::new();
    for (slot, entry) in entries.iter().enumerate() {
        for (k, c) in entry.iter().enumerate().rev().filter(|(_, c)| !c.is_zero()) {
            places.push(slot);
            slots.push(place(size, slot));
            exponents.push(u32::try_from(k).expect("the degree fits a u32"));
            coefficients.push(c.to_integer());
        }
    }
    let norms = Norms::new(size * size, places.into_iter().zip(&coefficients));
    let Some(bits) = bits(size, &norms) else { return Vec::new() };
    let plan = Plan::new(&slots, &exponents, 1);
    let coefficients = coefficients.iter().collect();
    Problem { form: Form::Matrix(size), plan, coefficients, lattice, bits }
        .solve(arch)
        .into_iter()
        .map(Int::from)
        .collect()
}

/// Returns what [`determinant`] is predicted to cost, in nanoseconds, for a matrix of this size with so many terms in all,
/// if the determinant has these degrees and this total one at most and coefficients of so many bits; `None` if there would
/// be too many values.
pub(crate) fn determinant_cost(size: usize, degrees: &[usize], total: usize, bits: f64, terms: usize) -> Option<f64> {
    // Of the terms of an entry few are left when all variables but the first have their values.
    let steps = (size * size) as f64 + terms as f64 / 2.0;
    cost(size, steps, degrees, total, bits, terms).map(|(cost, _)| cost)
}

/// Returns the binary logarithm of a bound on the coefficients of the determinant; `None` where a row or a column is zero.
fn bits(size: usize, norms: &Norms) -> Option<f64> {
    let rows: f64 = (0..size).map(|i| norms.bits((0..size).map(|j| i * size + j))).sum();
    let columns: f64 = (0..size).map(|j| norms.bits((0..size).map(|i| i * size + j))).sum();
    let bits = f64::min(rows, columns);
    (bits > f64::NEG_INFINITY).then_some(bits)
}

/// No row or column contributes more than the highest degree in it.
pub(crate) fn degree_bound(size: usize, degrees: &[usize]) -> usize {
    let row = |i: usize| (0..size).map(|j| degrees[i * size + j]).max().unwrap_or(0);
    let column = |j: usize| (0..size).map(|i| degrees[i * size + j]).max().unwrap_or(0);
    usize::min((0..size).map(row).sum(), (0..size).map(column).sum())
}
