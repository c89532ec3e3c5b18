//! Dense products as one product of big integers.
//!
//! Kronecker's substitution: with `d_v` the degree of the product in the variable v, `x_v` becomes `X^(s_v)`, where `s_v` is
//! the product of the `d_w + 1` over the later variables w, and X becomes `2^B`. Different monomials of the product, the
//! exponent of each `x_v` being at most `d_v`, have different powers of X, its slots; they follow one another like the
//! monomials. With B large enough the coefficients are read off the product of two integers, which GMP computes (see `slots`).
//!
//! The greatest common divisor of two such integers proposes one of the polynomials; what it is worth is for others to
//! prove.
//!
//! # Source
//! Kronecker 1882, Grundzüge einer arithmetischen Theorie der algebraischen Größen, § 4.

use super::slots::{LIMB, Reader, Writer};
use super::transform::{Placed, Transform};
use crate::monomial::Packing;
use crate::ring::Ring;
use rug::{Integer, integer::Order};
use std::borrow::Cow;

/// The most slots: beyond it no dense product is worth its memory.
const MOST_SLOTS: usize = 1 << 24;
/// The most slots for which room is made at once.
const MOST_ROOM: usize = 1 << 16;
/// What GMP takes for products of two integers of so many limbs, in nanoseconds: measured on a processor of 3 GHz.
const PRODUCTS: [(f64, f64); 12] = [
    (1.0, 18.0),
    (10.0, 78.0),
    (30.0, 450.0),
    (60.0, 1.4e3),
    (100.0, 3e3),
    (200.0, 9e3),
    (400.0, 2.6e4),
    (1e3, 9.3e4),
    (4e3, 6e5),
    (1.6e4, 3.2e6),
    (1e5, 3e7),
    (1e6, 4e8),
];
/// The nanoseconds for a slot of the product, a term of a factor, a limb of all numbers, and the rest: measured likewise.
const SLOT: f64 = 3.0;
const TERM: f64 = 5.0;
const COPY: f64 = 1.5;
const REST: f64 = 4e2;

/// Coefficients that are integers.
#[derive(Clone, Copy)]
pub(super) enum Numbers<'a> {
    Words(&'a [i64]),
    Large(&'a [Cow<'a, Integer>]),
}

impl Numbers<'_> {
    /// Returns the length of the longest.
    pub(super) fn bits(&self) -> usize {
        match self {
            Self::Words(words) => length(words.iter().map(|n| n.unsigned_abs()).max().unwrap_or(0)),
            Self::Large(large) => large.iter().map(|n| n.significant_bits()).max().unwrap_or(0) as usize,
        }
    }

    /// Returns the length of the sum of their absolute values.
    fn sum_bits(&self) -> usize {
        match self {
            Self::Words(words) => {
                let sum: u128 = words.iter().map(|n| u128::from(n.unsigned_abs())).sum();
                (u128::BITS - sum.leading_zeros()) as usize
            }
            Self::Large(large) => self.bits() + length(large.len() as u64),
        }
    }
}

fn length(n: u64) -> usize {
    (u64::BITS - n.leading_zeros()) as usize
}

/// Monomials, decreasing, and their coefficients.
type Terms<R> = (Vec<u64>, Vec<R>);

/// The slots are too short to tell whether there is a quotient.
pub(super) struct Undecided;

/// The substitution for two factors.
pub(super) struct Kronecker<'d> {
    packing: Packing,
    degrees: &'d [u32],
    strides: Vec<usize>,
    /// The width of a slot in bits.
    width: usize,
    /// The slots of both factors.
    slots: (usize, usize),
    terms: usize,
}

impl<'d> Kronecker<'d> {
    /// Returns the substitution for factors, not zero, whose product has at most these degrees; `None` if it has too many slots.
    pub(super) fn new(
        packing: Packing,
        degrees: &'d [u32],
        (left, a): (&[u64], &Numbers),
        (right, b): (&[u64], &Numbers),
    ) -> Option<Self> {
        // A coefficient of the product is at most the sum of all of one factor times the largest of the other.
        let bits = (a.sum_bits() + b.bits()).min(b.sum_bits() + a.bits());
        Self::with_width(packing, degrees, bits + 2, left, right)
    }

    /// Returns the substitution with slots of so many bits for two polynomials, not zero, all exponents being at most these
    /// degrees; `None` if it has too many slots.
    pub(super) fn with_width(
        packing: Packing,
        degrees: &'d [u32],
        width: usize,
        left: &[u64],
        right: &[u64],
    ) -> Option<Self> {
        let mut strides = vec![0; degrees.len()];
        let mut slots = 1_usize;
        for (stride, &degree) in strides.iter_mut().zip(degrees).rev() {
            *stride = slots;
            slots = slots.saturating_mul(degree as usize + 1);
        }
        if slots > MOST_SLOTS {
            return None;
        }
        let words = packing.words();
        let mut substitution = Self { packing, degrees, strides, width, slots: (0, 0), terms: 0 };
        let highest = |monomials: &[u64]| substitution.slot(&monomials[..words]) + 1;
        let terms = (left.len() + right.len()) / words;
        (substitution.slots, substitution.terms) = ((highest(left), highest(right)), terms);
        Some(substitution)
    }

    /// Returns the limbs of the larger of the two values.
    pub(super) fn limbs(&self) -> usize {
        self.slots.0.max(self.slots.1) * self.width / LIMB
    }

    /// Returns the nanoseconds that the product is expected to take.
    pub(super) fn cost(&self) -> f64 {
        let limbs = |slots: usize| (slots * self.width) as f64 / LIMB as f64 + 1.0;
        let (a, b) = (limbs(self.slots.0), limbs(self.slots.1));
        let (short, long) = (a.min(b), a.max(b));
        let slots = (self.slots.0 + self.slots.1) as f64;
        let product = long / short * balanced(short) + COPY * 2.0 * (a + b);
        let product = self.transform().map_or(product, |transform| transform.cost().min(product));
        product + SLOT * slots + TERM * self.terms as f64 + REST
    }

    /// Returns another way to the product of long coefficients, if it is expected to be faster.
    fn transform(&self) -> Option<Transform> {
        let limbs = |slots: usize| (slots * self.width) as f64 / LIMB as f64 + 1.0;
        let (a, b) = (limbs(self.slots.0), limbs(self.slots.1));
        let cost = a.max(b) / a.min(b) * balanced(a.min(b));
        Transform::new(self.width, self.slots.0 + self.slots.1 - 1).filter(|transform| transform.cost() < cost)
    }

    /// Returns coefficients beside the powers of X that their monomials become.
    fn placed<'a>(&self, monomials: &[u64], large: &'a [Cow<Integer>]) -> Vec<Placed<'a>> {
        self.slots(monomials).zip(large.iter().rev().map(|n| Cow::Borrowed(&**n))).collect()
    }

    /// Returns the powers of X that monomials become, the lowest first.
    fn slots<'a>(&'a self, monomials: &'a [u64]) -> impl Iterator<Item = usize> + 'a {
        // In one word fields are shifted out.
        let fields =
            (0..self.strides.len()).map(|variable| self.packing.place(variable).1).zip(self.strides.iter().copied());
        let fields: Vec<(u32, usize)> = fields.collect();
        let words = self.packing.words();
        monomials.rchunks_exact(words).map(move |monomial| match monomial {
            [word] => fields.iter().map(|&(shift, stride)| self.packing.field(*word, shift) as usize * stride).sum(),
            _ => self.slot(monomial),
        })
    }

    /// Returns the power of X that a monomial becomes.
    fn slot(&self, monomial: &[u64]) -> usize {
        let term = |(variable, &stride): (usize, &usize)| self.packing.exponent(monomial, variable) as usize * stride;
        self.strides.iter().enumerate().map(term).sum()
    }

    /// Returns the nanoseconds that a quotient is expected to take.
    pub(super) fn quotient_cost(&self) -> f64 {
        // GMP's divisions take up to three times as long as its products of divisors and quotients.
        const DIVISION: f64 = 3.0;
        let limbs = |slots: usize| (slots * self.width) as f64 / LIMB as f64 + 1.0;
        let (a, b) = (limbs(self.slots.0.saturating_sub(self.slots.1)), limbs(self.slots.1));
        let (short, long) = (a.min(b), a.max(b));
        DIVISION * long / short * balanced(short)
            + COPY * 4.0 * (a + b)
            + SLOT * self.slots.0 as f64
            + TERM * self.terms as f64
            + REST
    }

    /// Returns the product: monomials, decreasing, and coefficients.
    pub(super) fn product<R: Ring>(
        &self,
        (left, a): (&[u64], &Numbers),
        (right, b): (&[u64], &Numbers),
    ) -> (Vec<u64>, Vec<R>) {
        let slots = self.slots.0 + self.slots.1 - 1;
        if let (Numbers::Large(a), Numbers::Large(b)) = (a, b)
            && let Some(transform) = self.transform()
        {
            let mut product = transform.product(&self.placed(left, a), &self.placed(right, b), slots);
            let number = |slot: usize| Some(R::from_large(std::mem::take(&mut product[slot]))).filter(|c| !c.is_zero());
            return self.collect(slots, number);
        }
        let ((a, s), (b, t)) = (self.integer(left, a, self.slots.0), self.integer(right, b, self.slots.1));
        // Squares are cheaper.
        let product = if a == b { a.square() } else { a * b };
        self.read(&product, slots, s != t)
    }

    /// Returns monomials, decreasing, and coefficients of the greatest common divisor of both values, as if they were those
    /// of a polynomial at `X = 2^B`.
    pub(super) fn divisor<R: Ring>(
        &self,
        (left, a): (&[u64], &Numbers),
        (right, b): (&[u64], &Numbers),
    ) -> (Vec<u64>, Vec<R>) {
        let divisor = self.integer(left, a, self.slots.0).0.gcd(&self.integer(right, b, self.slots.1).0);
        self.read(&divisor, self.slots.0.min(self.slots.1), false)
    }

    /// Returns monomials, decreasing, and coefficients of the quotient of two polynomials if that of their values shows it: no
    /// quotient where the values leave a remainder, `Err` where the slots are too short to tell.
    ///
    /// # Why the quotient is right
    /// Let f and g be the polynomials, `X = 2^B` and `f(X) = g(X) q`; without such a q there is no quotient. Let Q be the polynomial with
    /// `Q(X) = q`. If none of its degrees is above the difference of those of f and g, different monomials of `g Q` have different slots.
    /// If, moreover, f and `g Q` have coefficients below `2^(B-2)` in absolute value, those of `g Q` being at most as many times the
    /// products of those of g and Q as the shorter one has terms, then both have the same value at X, and are equal. All of this is checked.
    pub(super) fn quotient<R: Ring>(
        &self,
        (left, a): (&[u64], &Numbers),
        (right, b): (&[u64], &Numbers),
        lower: &[u32],
    ) -> Result<Option<Terms<R>>, Undecided> {
        let slots = (self.slots.0 + 1).checked_sub(self.slots.1).ok_or(Undecided)?;
        let ((f, s), (g, t)) = (self.integer(left, a, self.slots.0), self.integer(right, b, self.slots.1));
        let (quotient, rest) = f.div_rem(g);
        if rest.cmp0().is_ne() {
            return Ok(None);
        }
        // The highest slot must hold what is left of the quotient, with its sign.
        if quotient.significant_bits() as usize >= slots * self.width {
            return Err(Undecided);
        }
        let mut reader = Reader::new(&quotient, self.width, slots, false);
        let longest = (0..slots).map(|slot| reader.bits(slot)).max().unwrap_or(0);
        let (monomials, coefficients) = self.read(&quotient, slots, s != t);
        let terms = coefficients.len().min(right.len() / self.packing.words());
        let bits = (b.bits() + longest + length(terms as u64)).max(a.bits());
        let fits = |monomial: &[u64]| {
            let within = |(v, degree): (usize, &u32)| {
                self.packing.exponent(monomial, v) + lower.get(v).copied().unwrap_or(0) <= *degree
            };
            self.degrees.iter().enumerate().all(within)
        };
        let fit = bits + 2 <= self.width && monomials.chunks_exact(self.packing.words()).all(fits);
        if fit { Ok(Some((monomials, coefficients))) } else { Err(Undecided) }
    }

    /// Returns monomials, decreasing, and coefficients of the polynomial that has a value at `X = 2^B` which fits so many
    /// slots and is not negative, or those times -1.
    fn read<R: Ring>(&self, value: &Integer, slots: usize, negative: bool) -> (Vec<u64>, Vec<R>) {
        let mut reader = Reader::new(value, self.width, slots, negative);
        let nonzero = |c: R| (!c.is_zero()).then_some(c);
        match self.width {
            ..65 => {
                let words = reader.words(slots);
                self.collect(slots, |slot| Some(words[slots - 1 - slot]).filter(|n| *n != 0).map(R::from_word))
            }
            65..129 => self.collect(slots, |slot| nonzero(R::from_wide(reader.pair(slot)))),
            _ => self.collect(slots, |slot| nonzero(R::from_large(reader.large(slot)))),
        }
    }

    /// Returns the absolute value of a factor, not zero, at `X = 2^B`, and whether the value is negative.
    fn integer(&self, monomials: &[u64], numbers: &Numbers, slots: usize) -> (Integer, bool) {
        let mut writer = Writer::new(self.width, slots);
        let slots = self.slots(monomials);
        let negative;
        match numbers {
            Numbers::Words(words) => {
                negative = words.first().is_some_and(|n| *n < 0);
                writer.words(slots.zip(words.iter().rev().copied()), negative);
            }
            Numbers::Large(large) => {
                negative = large.first().is_some_and(|n| n.is_negative());
                let mut buffer = Vec::new();
                for (slot, n) in slots.zip(large.iter().rev()) {
                    buffer.resize(n.significant_digits::<u64>(), 0);
                    n.write_digits(&mut buffer, Order::Lsf);
                    writer.large(slot, &buffer, n.is_negative() != negative);
                }
            }
        }
        (writer.finish(), negative)
    }

    /// Returns the monomials, decreasing, of the slots with a coefficient other than zero, and these coefficients.
    fn collect<R>(&self, slots: usize, mut read: impl FnMut(usize) -> Option<R>) -> (Vec<u64>, Vec<R>) {
        let words = self.packing.words();
        // Dense products fill most slots, and are what this is for.
        let room = slots.min(MOST_ROOM);
        let (mut monomials, mut coefficients) = (Vec::with_capacity(room * words), Vec::with_capacity(room));
        let Some((&inner, outer)) = self.degrees.split_last() else {
            // Constants.
            coefficients.extend(read(0));
            monomials.resize(words * coefficients.len(), 0);
            return (monomials, coefficients);
        };
        let (word, shift) = self.packing.place(outer.len());
        let rows = slots.div_ceil(inner as usize + 1);
        let mut row_monomial = vec![0_u64; words];
        for row in (0..rows).rev() {
            row_monomial.fill(0);
            let mut rest = row;
            for (variable, &degree) in outer.iter().enumerate().rev() {
                let (word, shift) = self.packing.place(variable);
                let exponent = rest % (degree as usize + 1);
                row_monomial[word] |= (exponent as u64) << shift;
                rest /= degree as usize + 1;
            }
            let start = row * (inner as usize + 1);
            for exponent in (0..=inner as usize).rev().filter(|exponent| start + exponent < slots) {
                if let Some(c) = read(start + exponent) {
                    if let [only] = row_monomial[..] {
                        monomials.push(only | (exponent as u64) << shift);
                    } else {
                        let base = monomials.len();
                        monomials.extend_from_slice(&row_monomial);
                        monomials[base + word] |= (exponent as u64) << shift;
                    }
                    coefficients.push(c);
                }
            }
        }
        (monomials, coefficients)
    }
}

/// Returns the nanoseconds for a product of two integers of so many limbs: straight lines between logarithms.
pub(super) fn balanced(limbs: f64) -> f64 {
    let last = PRODUCTS.len() - 2;
    let piece = PRODUCTS.iter().skip(1).position(|(size, _)| limbs < *size).unwrap_or(last).min(last);
    let [(x0, y0), (x1, y1)] = [PRODUCTS[piece], PRODUCTS[piece + 1]];
    let slope = (y1 / y0).ln() / (x1 / x0).ln();
    y0 * ((limbs.max(1.0) / x0).ln() * slope).exp()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::int::Int;
    use crate::polynomial::Polynomial;
    use crate::polynomial::product::to_large;
    use crate::ring::Ring;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    /// Returns the product by the substitution.
    fn substituted(f: &Poly, g: &Poly) -> Poly {
        let degrees: Vec<u32> = (0..f.variables().max(g.variables())).map(|v| f.degree(v) + g.degree(v)).collect();
        let packing = Packing::new(degrees.len(), degrees.iter().copied().max().unwrap_or(0));
        let (left, right) = (f.packed_as(packing), g.packed_as(packing));
        let (a, b) = (to_large(f.coefficients()).unwrap(), to_large(g.coefficients()).unwrap());
        let (a, b) = (Numbers::Large(&a), Numbers::Large(&b));
        let substitution = Kronecker::new(packing, &degrees, (&left, &a), (&right, &b)).unwrap();
        let (monomials, coefficients) = substitution.product((&left, &a), (&right, &b));
        Poly { packing, monomials, coefficients }
    }

    /// Returns the product term by term.
    fn term_by_term(f: &Poly, g: &Poly) -> Poly {
        let times = |(exponents, c): (Vec<u32>, &Int)| f.mul(&Poly::from_terms([(exponents, c.clone())]));
        g.terms().map(times).fold(Poly::zero(), |sum, product| sum.add(&product))
    }

    /// Numbers of all lengths, the ends of words among them.
    fn number() -> impl Strategy<Value = Int> {
        let ends = [i64::MIN, i64::MIN + 1, -1, 1, i64::MAX].map(Int::from).to_vec();
        let long = (any::<i64>(), 0..300_u32).prop_map(|(n, bits)| Int::from(Integer::from(n) << bits));
        prop_oneof![(-9..9_i64).prop_map(Int::from), any::<i64>().prop_map(Int::from), prop::sample::select(ends), long]
    }

    fn polynomial(variables: usize) -> impl Strategy<Value = Poly> {
        let term = (prop::collection::vec(0..7_u32, variables), number());
        prop::collection::vec(term, 1..25).prop_map(Poly::from_terms)
    }

    proptest! {
        // Each case multiplies four times, term by term as well.
        #![proptest_config(ProptestConfig::with_cases(48))]
        #[test]
        fn products_are_those_of_the_terms((f, g) in (0..5_usize).prop_flat_map(|n| (polynomial(n), polynomial(n)))) {
            prop_assume!(!f.is_zero() && !g.is_zero());
            let expected = term_by_term(&f, &g);
            prop_assert_eq!(&substituted(&f, &g), &expected);
            prop_assert_eq!(&f.mul(&g), &expected);
            prop_assert_eq!(&substituted(&f, &f), &term_by_term(&f, &f));
            prop_assert_eq!(&substituted(&f.neg(), &f), &term_by_term(&f, &f).neg());
        }
    }

    /// Every coefficient as large as the slots allow, of all signs: what lies below a slot is then nearest to half of it.
    #[test]
    fn slots_are_full() {
        for bits in [1_u32, 20, 30, 31, 32, 61, 62, 63, 64, 95, 126, 127, 128, 200] {
            let top = Int::from((Integer::from(1) << bits) - 1_u32);
            for pattern in 0..16_u32 {
                let sign = |power: u32, mask: u32| if mask >> (power % 4) & 1 == 1 { top.neg() } else { top.clone() };
                let dense = |mask: u32| Poly::from_terms((0..40).map(|power| (vec![power], sign(power, mask))));
                let (f, g) = (dense(pattern), dense(pattern ^ 5));
                let expected = term_by_term(&f, &g);
                assert_eq!(substituted(&f, &g), expected, "{bits} {pattern}");
                assert_eq!(f.mul(&g), expected, "{bits} {pattern}");
            }
        }
    }

    #[test]
    fn costs_follow_the_table() {
        assert!((balanced(30.0) - 450.0).abs() < 1e-6);
        assert!(balanced(0.5) <= 18.0 && balanced(1e7) > 4e8);
        assert!((1..200).all(|k| balanced(f64::from(k) * 999.0) < balanced(f64::from(k + 1) * 999.0)));
    }
}
