//! Determinants and resultants of polynomials with numeric coefficients, from their images modulo many primes.
//!
//! Polynomials are evaluated at integer points modulo primes, determinants of numbers are found there, interpolated, and
//! the coefficients put together by Chinese remainders. The arithmetic is that of f64 with a fused multiply-add, primes
//! side by side in the lanes of the widest registers that the machine has, or without such lanes that of Montgomery.

mod batch;
mod bound;
mod chinese;
mod determinant;
mod lanes;
mod lattice;
mod primes;
mod problem;
mod resultant;
mod substitution;
mod terms;

pub use determinant::determinant;
pub(super) use determinant::{degree_bound, univariate_determinant};
pub use resultant::resultant;
pub use terms::Terms;

use lattice::Lattice;
use primes::count_beyond;
use rug::Integer;

/// The number of values, each modulo one prime, beyond which a determinant is not to be found from its values.
const MOST_VALUES: usize = 1 << 24;

/// The number of points at which determinants with coefficients up to `2^bits` may be evaluated.
fn most_points(bits: f64, parameters: usize) -> usize {
    MOST_VALUES / usize::max(count_beyond(bits), 4 * parameters)
}

/// Terms of several polynomials in the order in which they are evaluated.
struct Sorted<'a> {
    slots: Vec<usize>,
    exponents: Vec<u32>,
    coefficients: Vec<&'a Integer>,
}

/// Sorts terms, each with the index of its polynomial and all its exponents, by the exponents of the parameters.
fn descending<'a>(terms: impl Iterator<Item = (usize, &'a [u32], &'a Integer)>, parameters: &[usize]) -> Sorted<'a> {
    let mut terms: Vec<_> = terms.collect();
    let key = |e: &'a [u32]| parameters.iter().map(move |&k| e[k]);
    terms.sort_by(|(a, e, _), (b, f, _)| (b.cmp(a)).then_with(|| key(f).cmp(key(e))));
    let distinct = terms.windows(2).all(|t| t[0].0 != t[1].0 || t[0].1 != t[1].1);
    assert!(distinct, "no two terms of a polynomial have the same exponents");
    Sorted {
        slots: terms.iter().map(|t| t.0).collect(),
        exponents: terms.iter().flat_map(|t| key(t.1)).collect(),
        coefficients: terms.iter().map(|t| t.2).collect(),
    }
}

impl Lattice {
    /// The polynomial with these coefficients, its parameters being those of the given variables.
    fn terms(&self, coefficients: Vec<Integer>, variables: usize, parameters: &[usize]) -> Terms {
        let mut terms = Terms::default();
        for (k, c) in coefficients.into_iter().enumerate() {
            if c.is_zero() {
                continue;
            }
            let first = terms.exponents.len();
            terms.exponents.resize(first + variables, 0);
            for (&parameter, &e) in parameters.iter().zip(self.point(k)) {
                terms.exponents[first + parameter] = e;
            }
            terms.coefficients.push(c);
        }
        terms
    }
}
