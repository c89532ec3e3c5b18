//! Powers, by the multinomial theorem if its terms seldom coincide, else by repeated squaring.

use super::{Polynomial, Size};
use crate::monomial::{LARGEST_EXPONENT, Packing};
use crate::ring::Ring;
use rug::{Complete, Integer, Rational};
use std::cell::OnceCell;

/// The multinomial theorem is for sums of few terms.
const FEW: usize = 32;

/// Returns the number of ways to choose, at most `u64::MAX`.
fn choices(n: u64, k: u64) -> u64 {
    let mut choices = 1_u128;
    for i in 0..u128::from(k.min(n - k)) {
        choices = choices * (u128::from(n) - i) / (i + 1);
        if choices > u128::from(u64::MAX) {
            return u64::MAX;
        }
    }
    u64::try_from(choices).unwrap_or(u64::MAX)
}

impl<R: Ring> Polynomial<R> {
    /// Returns a bound on the size of a power.
    #[must_use]
    pub fn power_size(&self, exponent: u32) -> Size {
        let (len, exponent) = (self.len() as u64, u64::from(exponent));
        let degrees = (0..self.variables()).map(|v| u64::from(self.degree(v)) * exponent);
        let cells = degrees.clone().fold(1_u64, |cells, degree| cells.saturating_mul(degree + 1));
        let terms = if len == 0 { u64::from(exponent == 0) } else { choices(exponent + len - 1, len - 1).min(cells) };
        Size { terms, largest_exponent: degrees.max().unwrap_or(0) }
    }

    /// Returns the power; `x^0` is 1, for x = 0 too.
    ///
    /// # Panics
    /// When an exponent grows above [`LARGEST_EXPONENT`]; see [`Self::power_size`].
    #[must_use]
    pub fn pow(&self, exponent: u32) -> Self {
        match (exponent, self.len()) {
            (0, _) => Self::one(),
            (1, _) | (_, 0) => self.clone(),
            (2, _) => self.product(self),
            (_, 1) => self.squared_power(exponent),
            (_, len) => {
                let combinations = choices(u64::from(exponent) + len as u64 - 1, len as u64 - 1);
                let size = self.power_size(exponent);
                assert!(
                    size.largest_exponent <= u64::from(LARGEST_EXPONENT),
                    "an exponent of {}, above {LARGEST_EXPONENT}",
                    size.largest_exponent
                );
                // If there is no room for all combinations, many of them coincide.
                if len <= FEW && combinations <= size.terms {
                    self.multinomial_power(exponent)
                } else {
                    self.squared_power(exponent)
                }
            }
        }
    }

    fn squared_power(&self, exponent: u32) -> Self {
        let half = self.pow(exponent / 2);
        let square = half.product(&half);
        if exponent % 2 == 1 { square.product(self) } else { square }
    }

    fn multinomial_power(&self, exponent: u32) -> Self {
        let largest = u64::from(self.largest_exponent()) * u64::from(exponent);
        let packing = if largest <= u64::from(self.packing.largest()) {
            self.packing
        } else {
            Packing::new(self.variables(), u32::try_from(largest).unwrap_or(u32::MAX))
        };
        let words = packing.words();
        let own = self.packed_as(packing);
        let terms = own.chunks_exact(words).zip(&self.coefficients).map(|(m, c)| (m, powers(c, exponent))).collect();
        let rows = (0..=exponent).map(|_| OnceCell::new()).collect();
        let (base, mut expansion) =
            (Base { terms, rows }, Expansion { monomials: Vec::new(), coefficients: Vec::new() });
        base.expand(0, exponent, &vec![0; words], &R::one(), &mut expansion);
        Self::from_unsorted(packing, expansion.monomials, expansion.coefficients)
    }
}

fn powers<R: Ring>(x: &R, exponent: u32) -> Vec<R> {
    let mut powers = vec![R::one()];
    for k in 0..exponent as usize {
        powers.push(powers[k].mul(x));
    }
    powers
}

/// A sum of terms that is to be expanded.
struct Base<'a, R> {
    /// The monomials, and the powers of their coefficients.
    terms: Vec<(&'a [u64], Vec<R>)>,
    /// Rows of Pascal's triangle, as they are used.
    rows: Vec<OnceCell<Vec<R>>>,
}

/// The multinomial expansion as it grows.
struct Expansion<R> {
    monomials: Vec<u64>,
    coefficients: Vec<R>,
}

impl<R: Ring> Base<'_, R> {
    /// Appends `c m (t_first + t_(first + 1) + ...)^exponent`.
    fn expand(&self, first: usize, exponent: u32, m: &[u64], c: &R, expansion: &mut Expansion<R>) {
        if exponent == 0 {
            expansion.monomials.extend_from_slice(m);
            expansion.coefficients.push(c.clone());
            return;
        }
        let (term, powers) = &self.terms[first];
        if first + 1 == self.terms.len() {
            expansion.monomials.extend(m.iter().zip(*term).map(|(start, step)| start + step * u64::from(exponent)));
            expansion.coefficients.push(c.mul(&powers[exponent as usize]));
            return;
        }
        let row = self.rows[exponent as usize].get_or_init(|| binomials(exponent));
        let mut monomial = m.to_vec();
        for k in (0..=exponent).rev() {
            for ((word, start), step) in monomial.iter_mut().zip(m).zip(*term) {
                *word = start + step * u64::from(k);
            }
            let factor = c.mul(&row[k as usize]).mul(&powers[k as usize]);
            self.expand(first + 1, exponent - k, &monomial, &factor, expansion);
        }
    }
}

/// Returns a row of Pascal's triangle.
fn binomials<R: Ring>(n: u32) -> Vec<R> {
    let mut row = Vec::with_capacity(n as usize + 1);
    let mut binomial = Integer::from(1);
    for k in 0..=n {
        let image = binomial.to_i128().map(R::from_wide);
        row.push(
            image
                .unwrap_or_else(|| R::from_rational(&Rational::from(&binomial)).expect("integers map into every ring")),
        );
        binomial = (&binomial * (n - k)).complete() / (k + 1);
    }
    row
}
