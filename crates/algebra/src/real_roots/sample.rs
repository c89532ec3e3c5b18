//! Roots of a cell told apart by signs on a grid, where halving would come to them one by one.
//!
//! # Why the places are right
//! Let Descartes' rule count m sign changes of the Bernstein coefficients on a cell: inside are at most m roots, each counted as
//! often as it is repeated. Every point of the grid where the polynomial is zero is a root, and between neighbours where
//! it has opposite signs lies another one. If these are m together, they are all, and all simple. The signs are certain:
//! a value in f64 decides where it is beyond the bound of its error, an exact value elsewhere.

use super::bernstein::Expansion;
use pulp::Arch;

/// The most sign changes for which a grid is tried: with roots evenly spread, values are some `e^m` times smaller than
/// the terms they are sums of, and f64 has 53 bits.
const MOST_CHANGES: i32 = 28;
/// The degree up to which products with binomials are far from the end of the range of f64.
const MOST_DEGREE: usize = 400;
/// Points of the grid for each sign change, at least.
const DENSITY: u32 = 8;
/// Points side by side.
const LANES: usize = 8;
/// The bits of a guess that are relied upon, together with those that the grid knows already.
const GUESS_BITS: u32 = 46;
/// The steps of the search for a guess: each of the last ones more than halves the distance in bits.
const GUESS_STEPS: usize = 9;

/// The polynomial on a cell as floats: `b_j C(n,j)`, scaled.
pub(super) struct Sampler {
    terms: Vec<f64>,
    /// The same from the other end.
    reversed: Vec<f64>,
    /// The error of the `b_j`, scaled likewise.
    error: f64,
}

impl Sampler {
    /// Returns the sampler for a cell with so many sign changes, and the bits of its grid; `None` where halving is better.
    pub(super) fn new(expansion: &Expansion, changes: i32) -> Option<(Self, u32)> {
        let n = expansion.degree();
        if !(2..=MOST_CHANGES).contains(&changes) || n > MOST_DEGREE {
            return None;
        }
        let (floats, error) = expansion.floats();
        let mut binomial = 1.0;
        let mut terms = Vec::with_capacity(n + 1);
        for (j, b) in floats.iter().enumerate() {
            terms.push(b * binomial);
            binomial *= (n - j) as f64 / (j + 1) as f64;
        }
        let reversed = terms.iter().rev().copied().collect();
        let bits = (changes.unsigned_abs() * DENSITY).next_power_of_two().trailing_zeros();
        Some((Self { terms, reversed, error }, bits))
    }

    /// Returns the signs at `1/2^bits, 2/2^bits, ...` inside the cell, 0 where they are not certain.
    ///
    /// At `y` up to 1/2, `p(y)/(1-y)^n` is the sum of the `t_j r^j`, with `r = y/(1-y)` and `t_j = b_j C(n,j)`; beyond it
    /// the same holds from the other end. In units of the last place, the number `b_j` is wrong by 3, the binomial by 2n,
    /// their product by 1, `r^j` by n, and Horner's rule adds 2n + 1 for each term: together less than 6n + 20 for the sum
    /// of the `|t_j| r^j`, which is computed beside it with a smaller relative error. The error of the `b_j` themselves
    /// adds `error (1 + r)^n`. Underflow adds less than `2^-1000`.
    pub(super) fn signs(&self, bits: u32) -> Vec<i8> {
        let parts = 1_u32 << bits;
        let n = self.terms.len() - 1;
        let relative = (6 * n + 20) as f64 * (f64::EPSILON / 2.0) * 1.01;
        let mut signs = Vec::with_capacity(parts as usize - 1);
        let half = parts / 2;
        for (terms, right) in [(&self.terms, false), (&self.reversed, true)] {
            let points = if right { half + 1..parts } else { 1..half + 1 };
            let ratios = points.map(|i| ratio(f64::from(i), f64::from(parts), right)).collect::<Vec<f64>>();
            for chunk in ratios.chunks(LANES) {
                let mut r = [0.0; LANES];
                r[..chunk.len()].copy_from_slice(chunk);
                let (values, sizes) = horner(terms, &r);
                for ((value, size), r) in values.iter().zip(&sizes).zip(chunk) {
                    let own = self.error * (1.0 + r).powf(n as f64);
                    let bound = relative * size + 1.01 * own + (-1000_f64).exp2();
                    // Not a number fails.
                    signs.push(if *value > bound {
                        1
                    } else if *value < -bound {
                        -1
                    } else {
                        0
                    });
                }
            }
        }
        signs
    }

    /// Returns where in these parts of the grid, from 0 to 1 of each, the polynomial probably vanishes, and the bits of that.
    pub(super) fn guesses(&self, parts: &[u32], bits: u32) -> (Vec<f64>, u32) {
        let whole = f64::from(1_u32 << bits);
        let mut guesses = Vec::with_capacity(parts.len());
        for (terms, right) in [(&self.terms, false), (&self.reversed, true)] {
            let side: Vec<f64> =
                parts.iter().filter(|&&i| (2 * i >= 1 << bits) == right).map(|&i| f64::from(i)).collect();
            for chunk in side.chunks(LANES) {
                let (mut lo, mut hi) = ([0.0; LANES], [1.0; LANES]);
                let at = |y: &[f64; LANES]| {
                    let mut r = [0.0; LANES];
                    for ((r, start), y) in r.iter_mut().zip(chunk).zip(y) {
                        *r = ratio(start + y, whole, right);
                    }
                    // The factor left out, (1-y)^n, changes little within a part.
                    horner(terms, &r).0
                };
                let (mut from, mut to) = (at(&lo), at(&hi));
                let mut y = [0.5; LANES];
                for step in 0..GUESS_STEPS {
                    let values = at(&y);
                    for i in 0..LANES {
                        // The Illinois rule: an end that stays counts half.
                        if (values[i] > 0.0) == (from[i] > 0.0) {
                            (lo[i], from[i], to[i]) = (y[i], values[i], if step > 0 { to[i] / 2.0 } else { to[i] });
                        } else {
                            (hi[i], to[i], from[i]) = (y[i], values[i], if step > 0 { from[i] / 2.0 } else { from[i] });
                        }
                        let next = lo[i] + (hi[i] - lo[i]) * (from[i] / (from[i] - to[i]));
                        y[i] = if lo[i] <= next && next <= hi[i] { next } else { f64::midpoint(lo[i], hi[i]) };
                    }
                }
                guesses.extend_from_slice(&y[..chunk.len()]);
            }
        }
        (guesses, GUESS_BITS.saturating_sub(bits))
    }
}

/// Returns `y/(1-y)` at `y = point/parts`, or `(1-y)/y` on the right half.
fn ratio(point: f64, parts: f64, right: bool) -> f64 {
    if right { (parts - point) / point } else { point / (parts - point) }
}

/// Returns the values of a polynomial at points, and of that with the absolute values of its coefficients.
fn horner(terms: &[f64], points: &[f64; LANES]) -> ([f64; LANES], [f64; LANES]) {
    Arch::new().dispatch(
        #[inline(always)]
        || {
            let (mut values, mut sizes) = ([0.0; LANES], [0.0; LANES]);
            for term in terms.iter().rev() {
                for i in 0..LANES {
                    values[i] = values[i] * points[i] + term;
                    sizes[i] = sizes[i] * points[i] + term.abs();
                }
            }
            (values, sizes)
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real_roots::bernstein::Source;
    use crate::real_roots::cell::Cell;
    use crate::ring::Ring;
    use crate::univariate::Univariate;
    use proptest::prelude::*;
    use rug::{Integer, Rational};

    type Poly = Univariate<Integer>;

    /// Returns the product of the `b x - a` over the fractions `a/b`.
    fn with_roots(roots: &[(i64, i64)]) -> Poly {
        let factor = |&(a, b): &(i64, i64)| Univariate::new(vec![Integer::from(-a), Integer::from(b)]);
        roots.iter().map(factor).fold(Univariate::one(), |product, factor| product.mul(&factor))
    }

    /// Every interval holds exactly one of the roots known, in order.
    fn isolates(poly: &Poly, roots: &[(i64, i64)]) {
        let mut known: Vec<Rational> = roots.iter().map(|&root| Rational::from(root)).collect();
        known.sort();
        let multiplicity = |root: &Rational| known.iter().filter(|other| *other == root).count();
        let mut distinct = known.clone();
        distinct.dedup();
        let mut found = poly.real_roots();
        assert_eq!(found.len(), distinct.len());
        for (root, expected) in found.iter_mut().zip(&distinct) {
            let (lo, hi) = root.bounds();
            assert!(lo <= *expected && *expected <= hi, "{expected}");
            assert_eq!(distinct.iter().filter(|other| lo <= **other && **other <= hi).count(), 1, "{expected}");
            assert_eq!(root.multiplicity(), multiplicity(expected), "{expected}");
            assert!(root.exact().is_none_or(|exact| exact == *expected));
            // The guess, right or wrong, leads to the same float.
            assert!((root.to_f64() - expected.to_f64()).abs() <= expected.to_f64().abs() * f64::EPSILON);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(40))]
        #[test]
        fn known_roots_are_isolated(
            mut roots in prop::collection::vec((-60..60_i64, 1..5_i64), 1..22),
            repeated in prop::collection::vec(any::<prop::sample::Index>(), 0..3),
            near in any::<bool>(),
        ) {
            roots.extend(repeated.iter().map(|index| *index.get(&roots)).collect::<Vec<_>>());
            if near {
                // A neighbour far nearer than any grid resolves.
                let (a, b) = roots[0];
                roots.push((a * 1_000_000_007 + 1, b * 1_000_000_007));
            }
            isolates(&with_roots(&roots), &roots);
            // The same beside roots that are not real.
            let complex = Univariate::new([5, 2, 1].map(Integer::from).to_vec());
            isolates(&with_roots(&roots).mul(&complex), &roots);
        }
    }

    #[test]
    fn integers_in_a_row() {
        for n in [5_i64, 30, 64, 90] {
            let roots: Vec<(i64, i64)> = (1..=n).map(|k| (k, 1)).collect();
            isolates(&with_roots(&roots), &roots);
            let both: Vec<(i64, i64)> = (-n / 2..=n / 2).map(|k| (2 * k + 1, 7)).collect();
            isolates(&with_roots(&both), &both);
        }
    }

    /// Clusters of integers far apart, to which Newton's steps lead; no two intervals meet.
    #[test]
    fn clusters_of_integers() {
        for (clusters, size, distance) in [(3_i64, 3_i64, 10_i64), (4, 5, 1_000_000), (6, 8, 1_000_000_000)] {
            let cluster = |i: i64| (0..size).map(move |j| (distance * i + j, 1));
            let roots: Vec<(i64, i64)> = (-1..clusters - 1).flat_map(cluster).collect();
            isolates(&with_roots(&roots), &roots);
            let found = with_roots(&roots).real_roots();
            assert!(found.windows(2).all(|pair| pair[0].bounds().1 < pair[1].bounds().0));
        }
    }

    /// Signs that f64 calls certain are those of exact values, also where roots lie close together or at points of the grid.
    #[test]
    fn certain_signs_are_right() {
        let spread: Vec<(i64, i64)> = (1..=24).map(|k| (k, 25)).collect();
        let close: Vec<(i64, i64)> = (0..12).map(|k| (500_000 + k * k, 1_000_000)).collect();
        let dyadic: Vec<(i64, i64)> = (1..20).map(|k| (k, 32)).collect();
        for roots in [spread, close, dyadic] {
            let poly = with_roots(&roots);
            let source = Source::new(poly.coefficients().to_vec());
            let expansion = source.expand(&Cell::new(Integer::new(), 0), &mut 256);
            let (sampler, _) = Sampler::new(&expansion, 20).unwrap();
            for bits in [3, 7] {
                let signs = sampler.signs(bits);
                assert_eq!(signs.len(), (1 << bits) - 1);
                for (i, sign) in (1_i64..).zip(signs).filter(|(_, sign)| *sign != 0) {
                    let value = poly.sign_at(&Rational::from((i, 1 << bits)));
                    assert_eq!(sign.cmp(&0), value, "{i} of 2^{bits}");
                }
            }
        }
    }
}
