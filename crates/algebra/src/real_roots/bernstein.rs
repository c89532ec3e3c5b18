//! Bernstein coefficients of a polynomial on dyadic intervals, in fixed point with a proved error.
//!
//! On `[0, 1]` a polynomial of degree n is `sum b_j C(n,j) x^j (1-x)^(n-j)`. By Descartes' rule the sign changes of
//! the `b_j` exceed the number of roots inside by an even number; halving the interval takes averages only, so errors
//! do not grow. All coefficients here carry a common positive factor, which is never removed.

use super::cell::Cell;
use super::evaluate::{length, shifted};
use super::fixed::Wide;
use super::rough;
use crate::int::gcd_of_words;
use pulp::Arch;
use rug::Integer;
use std::sync::Arc;

/// The bits that the coefficients of the 256-bit expansion have before the binomial sums lose some.
const WIDE_BITS: i64 = 252;
/// The bits at least of the largest coefficient of an expansion in big integers.
const FRESH_BITS: i64 = 160;
/// The bits that the largest coefficient of an expansion in f64 has beyond its error; fewer would not last for many halvings.
pub(super) const ROUGH_BITS: u32 = 24;
/// The error of an expansion that no halving has touched.
const FRESH_ERROR: u64 = 3;

/// The largest degree n for which the least common multiple of 1 to n + 1, and the products on the way to binomials, fit a word.
const MOST_SHORT: usize = 45;

/// A polynomial made ready for expansion.
pub(super) struct Source {
    /// Constant term first, the last one not zero.
    pub(super) coefficients: Vec<Integer>,
    /// Their lengths in bits; `None` for 0.
    pub(super) lengths: Vec<Option<i64>>,
    /// `l / C(n,i)`, l the least common multiple of the binomials of n.
    weights: Arc<[Integer]>,
    /// The leading bits of coefficient times weight, and the power of two left out.
    leading: Vec<(Wide, i64)>,
    /// The leading bits of the coefficients, and the powers of two left out.
    floats: Vec<(f64, i64)>,
    /// The length in bits of l, and of n + 1.
    weight_bits: i64,
    count_bits: i64,
}

/// Bernstein coefficients on a cell, each with an error of at most `error`.
#[derive(Clone)]
pub(super) enum Expansion {
    /// In fixed point; the error is in units.
    Wide { coefficients: Vec<Wide>, error: u64 },
    /// In f64.
    Rough { coefficients: Vec<f64>, error: f64 },
}

/// Returns `l / C(n,i)` for all i, and l, the least common multiple of the `C(n,i)`.
fn weights(n: usize) -> (Vec<Integer>, Integer) {
    let mut binomials = vec![Integer::from(1)];
    for i in 0..n {
        let next = Integer::from(&binomials[i] * (n - i));
        binomials.push(next.div_exact(&Integer::from(i + 1)));
    }
    let common = binomials.iter().fold(Integer::from(1), Integer::lcm);
    (binomials.iter().map(|b| Integer::from(common.div_exact_ref(b))).collect(), common)
}

/// Returns the same in machine words: l is the least common multiple of 1 to n + 1, divided by n + 1 (Farhi 2009, "An identity
/// involving the least common multiple of binomial coefficients and its application", American Mathematical Monthly 116).
fn short_weights(n: usize) -> (Vec<Integer>, Integer) {
    let n = n as u64;
    let multiple = (1..=n + 1).fold(1, |multiple, k| multiple / gcd_of_words(multiple, k) * k);
    let common = multiple / (n + 1);
    let mut binomial = 1;
    let weight = |i: u64| {
        let weight = Integer::from(common / binomial);
        binomial = binomial * (n - i) / (i + 1);
        weight
    };
    ((0..=n).map(weight).collect(), Integer::from(common))
}

impl Source {
    pub(super) fn new(coefficients: Vec<Integer>) -> Self {
        let n = coefficients.len() - 1;
        let (weights, common) = if n <= MOST_SHORT { short_weights(n) } else { weights(n) };
        let leading = coefficients.iter().zip(&weights).map(|(c, w)| {
            let product = Integer::from(c * w);
            let dropped = (length(&product) - WIDE_BITS).max(0);
            (Wide::new(&shifted(&product, -dropped)), dropped)
        });
        Self {
            leading: leading.collect(),
            floats: coefficients.iter().map(rough::leading).collect(),
            lengths: coefficients.iter().map(|c| (*c != 0).then(|| length(c))).collect(),
            weight_bits: length(&common),
            count_bits: length(&Integer::from(n + 1)),
            weights: weights.into(),
            coefficients,
        }
    }

    /// Returns the polynomial at `-x`.
    pub(super) fn mirrored(&self) -> Self {
        let odd = |i: usize| i % 2 == 1;
        let negated = |(i, c): (usize, &Integer)| if odd(i) { Integer::from(-c) } else { c.clone() };
        let turned = |(i, &(w, x)): (usize, &(Wide, i64))| if odd(i) { (w.negate(), x) } else { (w, x) };
        Self {
            coefficients: self.coefficients.iter().enumerate().map(negated).collect(),
            lengths: self.lengths.clone(),
            weights: self.weights.clone(),
            leading: self.leading.iter().enumerate().map(turned).collect(),
            floats: self.floats.iter().enumerate().map(|(i, &(m, x))| (if odd(i) { -m } else { m }, x)).collect(),
            ..*self
        }
    }

    pub(super) fn degree(&self) -> usize {
        self.coefficients.len() - 1
    }

    /// Returns the degree as an exponent of two.
    fn degree_bits(&self) -> i64 {
        i64::try_from(self.degree()).expect("degrees are small")
    }

    /// Returns the number of bits that rounding and binomial sums may spoil, see [`Source::expand_to`].
    fn spoilt(&self) -> i64 {
        self.weight_bits + self.degree_bits() + self.count_bits + 4
    }

    /// Returns the length of the largest of the numbers `c_i 2^(k i)`.
    fn reach(&self, k: i64) -> i64 {
        let terms = (0_i64..).zip(&self.lengths).filter_map(|(i, length)| length.map(|length| length + k * i));
        terms.max().unwrap_or(0)
    }

    /// Returns the expansion on `(0, 2^k)` in 256 bits.
    fn expand_wide(&self, k: i64) -> Expansion {
        // |sum_i C(j,i) l/C(n,i) c_i 2^(k i)| <= l (n + 1) 2^reach, for every partial sum too.
        let shift = WIDE_BITS - self.reach(k) - self.weight_bits - self.count_bits;
        let terms = (0_i64..).zip(&self.leading).map(|(i, &(w, x))| w.shift(x + k * i + shift));
        let mut b: Vec<Wide> = terms.collect();
        for i in 1..b.len() {
            for j in (i..b.len()).rev() {
                b[j] = b[j].add(b[j - 1]);
            }
        }
        for b in &mut b {
            *b = b.shift(-self.degree_bits());
        }
        // Each term is wrong by less than 2, their sum by less than 2^(n+1), and that divided by 2^n and rounded by less than 3.
        Expansion::Wide { coefficients: b, error: FRESH_ERROR }
    }

    /// Returns the Bernstein coefficients on a cell right of 0, wrong by less than `FRESH_ERROR` whatever the degree, such that the
    /// largest `c_i x^i` on the cell has `bits` bits. The weights of binomials lengthen the coefficients by more than the
    /// degree in bits, so that `bits` may be negative; it must be above `-spoilt`.
    fn expand_to(&self, cell: &Cell, bits: i64) -> Vec<Integer> {
        let depth = length(&cell.numerator);
        let k = cell.exponent + depth;
        let spoilt = self.spoilt();
        let shift = bits + spoilt - self.reach(k);
        let terms = (0_i64..).zip(&self.coefficients).map(|(i, c)| shifted(c, k * i + shift));
        let mut b: Vec<Integer> = terms.collect();
        if depth > 0 {
            // On the cell x = 2^k t (1 + y/a), with a the numerator, t = a/2^depth in [1/2, 1), and y from 0 to 1.
            let powers = self.powers(cell, bits + spoilt + 2 * self.degree_bits() + self.count_bits);
            for (b, (power, places)) in b.iter_mut().zip(&powers) {
                *b *= power;
                *b >>= places;
            }
            for start in 0..self.degree() {
                for j in (start..self.degree()).rev() {
                    let (head, tail) = b.split_at_mut(j + 1);
                    head[j] += &tail[0];
                }
            }
            for (i, (b, (power, places))) in (0_i64..).zip(b.iter_mut().zip(&powers)) {
                *b = shifted(b, i64::from(*places) - depth * i) / power;
            }
        }
        for (b, weight) in b.iter_mut().zip(self.weights.iter()) {
            *b *= weight;
        }
        for i in 1..b.len() {
            for j in (i..b.len()).rev() {
                let (left, right) = b.split_at_mut(j);
                right[0] += &left[j - 1];
            }
        }
        // The powers are long enough to spoil less than 2 units. So a term is wrong by less than 3 units before the
        // shift by 1, by less than 3 2^(n+1) after it and by less than 4 more after the division. Weights and binomials
        // multiply by at most l together, in each of n + 1 terms.
        let spoilt = u32::try_from(spoilt).expect("degrees are small");
        for b in &mut b {
            *b >>= spoilt;
        }
        b
    }

    /// Returns the powers of `t = numerator/2^length`, each with the number of its binary places.
    fn powers(&self, cell: &Cell, places: i64) -> Vec<(Integer, u32)> {
        let depth = u32::try_from(length(&cell.numerator)).expect("cells have millions of bits at most");
        let places = u32::try_from(places).expect("precisions are of millions of bits at most");
        let mut powers = vec![(Integer::from(1), 0)];
        for i in 0..self.degree() {
            let (before, used) = &powers[i];
            let exact = Integer::from(before * &cell.numerator);
            let excess = (used + depth).saturating_sub(places);
            powers.push((exact >> excess, used + depth - excess));
        }
        powers
    }

    /// Returns the Bernstein coefficients on a cell right of 0, the largest of at least `wanted` bits. Starts with the
    /// precision `bits` and stores there the one that would have sufficed.
    pub(super) fn expand_long(&self, cell: &Cell, wanted: i64, bits: &mut i64) -> Vec<Integer> {
        let spoilt = self.spoilt();
        loop {
            *bits = (*bits).max(1 - spoilt);
            let b = self.expand_to(cell, *bits);
            let largest = b.iter().map(length).max().unwrap_or(0);
            // A result that is all error does not show how much is missing, so twice the precision of the terms is tried.
            *bits += if largest > 2 { wanted - largest } else { *bits + spoilt };
            if largest >= wanted {
                return b;
            }
            *bits += i64::from(u8::MAX);
        }
    }

    /// Returns the expansion on a cell right of 0, precise whatever it takes.
    pub(super) fn expand(&self, cell: &Cell, bits: &mut i64) -> Expansion {
        if cell.numerator == 0 && self.degree_bits() <= WIDE_BITS / 2 {
            let expansion = self.expand_wide(cell.exponent);
            if expansion.stands_out(64) {
                return expansion;
            }
        }
        let reach = self.reach(cell.exponent + length(&cell.numerator));
        let expansion = rough::expand(&self.floats, reach, cell);
        if expansion.stands_out(ROUGH_BITS) {
            return expansion;
        }
        let b = self.expand_long(cell, FRESH_BITS, bits);
        let excess = b.iter().map(length).max().unwrap_or(0) - WIDE_BITS;
        let coefficients = b.iter().map(|b| Wide::new(&shifted(b, -excess.max(0)))).collect();
        Expansion::Wide { coefficients, error: FRESH_ERROR }
    }
}

/// Makes the coefficients those of the right half; returns those of the left half.
#[inline(always)]
fn halves<C: Copy>(b: &mut [C], average: impl Fn(&mut C, &C)) -> Vec<C> {
    let mut left = Vec::with_capacity(b.len());
    left.push(b[0]);
    for end in (1..b.len()).rev() {
        for j in 0..end {
            let (head, tail) = b.split_at_mut(j + 1);
            average(&mut head[j], &tail[0]);
        }
        left.push(b[0]);
    }
    left
}

impl Expansion {
    /// Becomes the expansion on the right half; returns the one on the left half.
    pub(super) fn halve(&mut self) -> Self {
        match self {
            Self::Wide { coefficients, error } => {
                let left = halves(coefficients, Wide::average);
                // Each of n averages in a row rounds down by at most a half.
                *error += left.len() as u64 / 2 + 1;
                Self::Wide { coefficients: left, error: *error }
            }
            Self::Rough { coefficients, error } => {
                let largest = coefficients.iter().map(|b| b.abs()).fold(0.0, f64::max);
                *error += rough::error_of_halving(coefficients.len(), largest);
                let left = Arch::new().dispatch(
                    #[inline(always)]
                    || halves(coefficients, |a, b| *a = 0.5 * (*a + b)),
                );
                Self::Rough { coefficients: left, error: *error }
            }
        }
    }

    pub(super) fn degree(&self) -> usize {
        match self {
            Self::Wide { coefficients, .. } => coefficients.len() - 1,
            Self::Rough { coefficients, .. } => coefficients.len() - 1,
        }
    }

    /// Returns the sign that coefficient `j` certainly has, or 0.
    #[inline(always)]
    pub(super) fn sign(&self, j: usize) -> i8 {
        match self {
            Self::Wide { coefficients, error } => coefficients[j].sign_beyond(*error),
            Self::Rough { coefficients, error } => {
                i8::from(coefficients[j] > *error) - i8::from(coefficients[j] < -*error)
            }
        }
    }

    /// Returns floats within three units of their last places of the coefficients, scaled by a power of two to be below the degree
    /// and 1, and the error of the coefficients, scaled likewise.
    pub(super) fn floats(&self) -> (Vec<f64>, f64) {
        match self {
            Self::Wide { coefficients, error } => {
                // All are below 2^255.
                let scale = (-255_f64).exp2();
                (coefficients.iter().map(|b| b.nearby() * scale).collect(), *error as f64 * scale)
            }
            Self::Rough { coefficients, error } => (coefficients.clone(), *error),
        }
    }

    /// Returns the least and the largest number of sign changes, the first and last sign being known better.
    pub(super) fn sign_changes(&self, first: i8, last: i8) -> (i32, i32) {
        let n = self.degree();
        let (mut least, mut before) = (0, 0);
        // The most changes up to here that end in plus, and in minus.
        let (mut plus, mut minus) = (-1, -1);
        for j in 0..=n {
            let at_end = j == 0 || j == n;
            let sign = if j == 0 {
                first
            } else if j == n {
                last
            } else {
                self.sign(j)
            };
            if sign == 0 && at_end {
                continue;
            }
            (plus, minus) = (plus.max(minus + 1), minus.max(plus + 1));
            if sign != 0 {
                *(if sign > 0 { &mut minus } else { &mut plus }) = -2;
                least += i32::from(before == -sign);
                before = sign;
            }
        }
        (least, plus.max(minus).max(0))
    }

    /// Returns whether the largest coefficient has that many bits more than the error.
    pub(super) fn stands_out(&self, bits: u32) -> bool {
        match self {
            Self::Wide { coefficients, error } => coefficients.iter().any(|b| b.exceeds(*error, bits)),
            Self::Rough { coefficients, error } => {
                let least = error * f64::from(bits).exp2();
                coefficients.iter().any(|b| b.abs() > least)
            }
        }
    }

    /// Returns whether enough bits are left for another halving to be useful.
    pub(super) fn is_precise(&self) -> bool {
        self.stands_out(12)
    }

    /// Returns the approximate position in the cell of its only root, from 0 to 1, if the polynomial has the given sign left
    /// of it; `None` if floats cannot determine it.
    pub(super) fn guess_root(&self, left: i8) -> Option<f64> {
        let n = self.degree();
        let (floats, _) = self.floats();
        let scale = floats.iter().map(|b| b.abs()).fold(0.0, f64::max);
        let mut binomial = 1.0;
        let mut terms: Vec<f64> = Vec::with_capacity(n + 1);
        for (j, b) in floats.iter().enumerate() {
            terms.push(b / scale * binomial);
            binomial *= (n - j) as f64 / (j + 1) as f64;
        }
        // On the left half y/(1-y) runs from 0 to 1, on the right half (1-y)/y does, with the terms reversed.
        let sign = f64::from(left);
        let on_right = terms.iter().sum::<f64>() * sign > 0.0;
        if on_right {
            terms.reverse();
        }
        let sign = if on_right { -sign } else { sign };
        let (mut lo, mut hi, mut r) = (0.0, 1.0, 0.5);
        for _ in 0..60 {
            let (mut value, mut slope) = (0.0, 0.0);
            for term in terms.iter().rev() {
                slope = slope * r + value;
                value = value * r + term;
            }
            *(if value * sign > 0.0 { &mut lo } else { &mut hi }) = r;
            let newton = r - value / slope;
            let next = if lo < newton && newton < hi { newton } else { f64::midpoint(lo, hi) };
            let done = (next - r).abs() <= 4.0 * f64::EPSILON * r;
            r = next;
            if done {
                break;
            }
        }
        let y = if on_right { 1.0 / (1.0 + r) } else { r / (1.0 + r) };
        y.is_finite().then_some(y)
    }

    /// Returns the first sign that is certain.
    pub(super) fn first_sign(&self) -> i8 {
        (0..=self.degree()).map(|j| self.sign(j)).find(|&sign| sign != 0).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real_roots::cell::dyadic;
    use rug::Rational;

    #[test]
    fn weights_in_words_are_those_of_big_integers() {
        for n in 1..=MOST_SHORT {
            assert_eq!(short_weights(n), weights(n), "{n}");
        }
    }

    /// Returns `l b_j` on a cell for `p(x) = sum c_i x^i`, exactly: `sum_i C(j,i) w_i q_i` with `q(y) = p(x_0 + w y)`.
    fn exactly(source: &Source, cell: &Cell) -> Vec<Rational> {
        let (start, width) = (cell.lo(), cell.hi() - cell.lo());
        let mut q: Vec<Rational> = source.coefficients.iter().map(Rational::from).collect();
        let n = q.len() - 1;
        for from in 0..n {
            for j in (from..n).rev() {
                let carried = Rational::from(&q[j + 1] * &start);
                q[j] += carried;
            }
        }
        let mut power = Rational::from(1);
        for (q, weight) in q.iter_mut().zip(source.weights.iter()) {
            *q *= Rational::from(weight) * &power;
            power *= &width;
        }
        for i in 1..q.len() {
            for j in (i..q.len()).rev() {
                let carried = q[j - 1].clone();
                q[j] += carried;
            }
        }
        q
    }

    #[test]
    fn expansions_are_wrong_by_less_than_the_stated_error_at_any_degree() {
        for degree in [1_usize, 7, 40, 127, 200, 260] {
            let mut coefficients = vec![Integer::new(); degree + 1];
            coefficients[degree] = Integer::from(1);
            coefficients[0] = Integer::from(-2);
            coefficients[degree / 2] += Integer::from(7) << 20_u32;
            let source = Source::new(coefficients);
            for (numerator, exponent) in [(0, 1), (0, -3), (1, 0), (3, -2), (1025, -10), (5, -30)] {
                let cell = Cell::new(Integer::from(numerator), exponent);
                let exact = exactly(&source, &cell);
                let depth = length(&cell.numerator);
                // Of the scaling of `expand_to` all but `spoilt` remains.
                for bits in [1 - source.spoilt(), -100, 60, 300].map(|bits| bits.max(1 - source.spoilt())) {
                    let unit = bits - source.reach(cell.exponent + depth);
                    for (found, exact) in source.expand_to(&cell, bits).iter().zip(&exact) {
                        let expected = dyadic(&Integer::from(1), unit) * exact;
                        let error = (expected - found).abs();
                        assert!(error < FRESH_ERROR, "{degree} {numerator} {exponent} {bits}: {error}");
                    }
                }
            }
        }
    }

    #[test]
    fn expansions_in_floats_are_wrong_by_less_than_they_say() {
        for degree in [1_usize, 7, 40, 200, 400] {
            // Of changing size and sign, some of them 0, from a linear congruence.
            let next = |state: &u64| {
                Some(state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407))
            };
            let numbers = std::iter::successors(Some(degree as u64), next);
            let coefficient = |x: u64| Integer::from(x.cast_signed() >> 8) >> u32::try_from(x % 60).unwrap();
            let mut coefficients: Vec<Integer> = numbers.map(coefficient).take(degree).collect();
            coefficients.push(Integer::from(-3));
            let source = Source::new(coefficients);
            for (numerator, exponent) in [(0, 1), (0, -3), (1, 0), (3, -2), (1025, -10), (5, -30)] {
                let cell = Cell::new(Integer::from(numerator), exponent);
                let reach = source.reach(exponent + length(&cell.numerator));
                let mut right = rough::expand(&source.floats, reach, &cell);
                let parts = [cell.part(&Integer::new(), 1), cell.part(&Integer::from(1), 1)];
                let whole = right.clone();
                let left = right.halve();
                for (cell, found) in [(&cell, whole), (&parts[0], left), (&parts[1], right)] {
                    let Expansion::Rough { coefficients, error } = found else { panic!("floats stay floats") };
                    assert!(error < 1e-10 * degree as f64);
                    let unit = dyadic(&Integer::from(1), reach) * &source.weights[0];
                    for (found, exact) in coefficients.iter().zip(exactly(&source, cell)) {
                        let difference = exact / &unit - Rational::from_f64(*found).unwrap();
                        assert!(difference.abs() < error, "{degree} {numerator} {exponent}");
                    }
                }
            }
        }
    }
}
