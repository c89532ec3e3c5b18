//! Greatest common divisors of polynomials in one and the same variable, from those of their values at a power of two.
//!
//! # Why the divisor is right
//! Let f and g be primitive, B such that all their coefficients are below `2^(B-2)` in absolute value, and `X = 2^B`. Let c be the integer
//! `gcd(f(X), g(X))` and G the polynomial with `G(X) = c` and coefficients from `-X/2` to `X/2`; let P be its primitive part.
//!
//! P divides f: P(X) divides f(X), with a quotient q; let Q be the polynomial with `Q(X) = q` and such coefficients. If the coefficients
//! of `P Q`, which are at most as many times the products of those of P and Q as the shorter one has terms, are below `2^(B-2)`, then `P Q` and f have
//! the same value at X and both have coefficients below `X/4`: they are equal. The same for g. Nothing of this is taken for granted, all is
//! checked; where a check fails other ways decide.
//!
//! P is the greatest: let `h = P k` be it. Then `h(X)` divides c, which is the content of G times P(X), so that k(X) divides that content, and is
//! at most `X/2`. All roots of k are roots of f, and at most `1 + X/4` in absolute value (Cauchy). Were k not constant, k(X)
//! would be at least `X - 1 - X/4`, which is more than `X/2` as B is above 3. A constant k divides f, which is primitive.
//!
//! # Source
//! Char, Geddes, Gonnet 1989, GCDHEU: heuristic polynomial GCD algorithm based on integer GCD computation, Journal of Symbolic Computation 7.

use super::Polynomial;
use super::line::{Field, Numbers, only_variable};
use super::slots::{LIMB, Reader};
use crate::int::Int;
use crate::ring::{Domain, Ring};
use rug::Integer;
use std::borrow::Cow;

/// Bits of a slot beyond those of the coefficients: for the coefficients of the cofactors, which are longer than those of the product when
/// much cancels in it, for the number of terms, and for the sign.
const MARGIN: usize = 6;
/// The most limbs of the values before coprime polynomials are told by an image modulo a prime, which is faster where a slot has more than
/// one limb; the most after that, beyond which a few images take less; and the most where all slots are shorter than a limb.
const FEW_LIMBS: usize = 32;
const KNOWN_LIMBS: usize = 320;
const MOST_LIMBS: usize = 1 << 14;

impl Polynomial<Int> {
    /// Returns whether one and the same variable occurs in both polynomials, which are not zero, and no other.
    pub(super) fn shares_line(&self, other: &Self) -> bool {
        let packing = self.packing;
        packing.words() == 1
            && packing.agrees(&other.packing)
            && only_variable(packing, &self.monomials, &other.monomials).is_some()
    }

    /// Returns the greatest common divisor of two polynomials that are not zero, if one and the same variable occurs in both and no other,
    /// and the values are short or, where that is `known` not to be constant, not too long; `None` where other ways have to decide.
    pub(crate) fn divisor_on_line(&self, other: &Self, known: bool) -> Option<Self> {
        let packing = self.packing;
        if packing.words() != 1 || !packing.agrees(&other.packing) {
            return None;
        }
        let variable = only_variable(packing, &self.monomials, &other.monomials)?;
        let fields = [self, other].map(|f| Field::new(packing, variable, &f.monomials));
        let contents = [self.content(), other.content()];
        let one = Int::one();
        // Copied only where there is something to divide by.
        let parts = [divided(&self.coefficients, &contents[0]), divided(&other.coefficients, &contents[1])];
        let numbers = [Numbers::new(&parts[0])?, Numbers::new(&parts[1])?];
        let [m, n] = &numbers;
        let terms = (usize::BITS - self.len().max(other.len()).leading_zeros()) as usize;
        let width = m.longest.max(n.longest) + terms + MARGIN;
        let limbs = fields[0].slots().max(fields[1].slots()) * width / LIMB;
        let most = match (width <= LIMB, known) {
            (true, _) => MOST_LIMBS,
            (false, true) => KNOWN_LIMBS,
            (false, false) => FEW_LIMBS,
        };
        if limbs > most {
            return None;
        }
        let values = [fields[0].value(width, &self.monomials, m).0, fields[1].value(width, &other.monomials, n).0];
        let common = Integer::from(values[0].gcd_ref(&values[1]));
        let content = contents[0].gcd(&contents[1]);
        let lowest = ((fields[0].lowest.min(fields[1].lowest)) as u64) << fields[0].shift;
        let slots = common.significant_bits() as usize / width + 1;
        let mut reader = Reader::new(&common, width, slots, false);
        // Half of `2^64` is no word.
        let number = |slot| if width < LIMB { Int::from(reader.word(slot)) } else { Int::from(reader.large(slot)) };
        let mut divisor: Vec<Int> = (0..slots).map(number).collect();
        while divisor.last().is_some_and(Ring::is_zero) {
            divisor.pop();
        }
        if divisor.len() > 1 {
            let own = divisor.iter().fold(Int::zero(), |gcd, c| if gcd == one { gcd } else { gcd.gcd(c) });
            let value = if own == one { common } else { common.div_exact(&own.to_integer()) };
            if own != one {
                for c in &mut divisor {
                    *c = c.div_exact(&own);
                }
            }
            let bits = Numbers::new(&divisor)?.longest;
            for (f, field) in values.iter().zip(&fields) {
                let slots = (field.slots() + 1).checked_sub(divisor.len())?;
                if !divides((&value, bits, divisor.len()), f, slots, width) {
                    return None;
                }
            }
        } else {
            divisor = vec![Int::one()];
        }
        let (mut monomials, mut coefficients) = (Vec::new(), Vec::new());
        for (power, c) in divisor.iter().enumerate().rev().filter(|(_, c)| !c.is_zero()) {
            monomials.push(lowest + ((power as u64) << fields[0].shift));
            coefficients.push(if content == one { c.clone() } else { c.mul(&content) });
        }
        Some(Self { packing, monomials, coefficients })
    }
}

/// Returns coefficients divided by their content.
fn divided<'a>(coefficients: &'a [Int], content: &Int) -> Cow<'a, [Int]> {
    if *content == Int::one() {
        return Cow::Borrowed(coefficients);
    }
    coefficients.iter().map(|c| c.div_exact(content)).collect()
}

/// Returns whether a polynomial with this value, with so many terms of so many bits, is proved to divide one with the value f; the quotient
/// has so many slots.
fn divides((value, bits, terms): (&Integer, usize, usize), f: &Integer, slots: usize, width: usize) -> bool {
    // The value divides a divisor of f, so that there is no remainder.
    let quotient = Integer::from(f.div_exact_ref(value));
    // The highest slot must hold what is left of the quotient, with its sign.
    if quotient.significant_bits() as usize >= slots * width {
        return false;
    }
    let mut reader = Reader::new(&quotient, width, slots, false);
    let longest = (0..slots).map(|slot| reader.bits(slot)).max().unwrap_or(0);
    let shorter = terms.min(slots);
    bits + longest + (usize::BITS - shorter.leading_zeros()) as usize + 2 <= width
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    fn polynomial(longest: u32) -> impl Strategy<Value = Poly> {
        let number = (any::<i64>(), 0..longest, 0..64_u32)
            .prop_map(|(n, bits, less)| Int::from(Integer::from(n >> less) << bits));
        prop::collection::vec((0..12_u32, number), 1..8)
            .prop_map(|terms| Poly::from_terms(terms.into_iter().map(|(e, c)| (vec![0, e], c))))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn divisors_are_those_of_euclid(
            (f, g, h) in prop::sample::select(vec![1, 70]).prop_flat_map(|n| (polynomial(n), polynomial(n), polynomial(n)))
        ) {
            prop_assume!(!f.is_zero() && !g.is_zero() && !h.is_zero());
            for (a, b) in [(f.mul(&h), g.mul(&h)), (f.clone(), g.clone()), (f.mul(&f), f.mul(&h))] {
                let content = a.content().gcd(&b.content());
                let expected = a.primitive_part().euclidean_gcd(&b.primitive_part(), 1).scale(&content);
                for known in [false, true] {
                    if let Some(found) = a.divisor_on_line(&b, known) {
                        prop_assert_eq!(&found, &expected);
                    }
                }
            }
        }
    }

    /// Most pairs must not be left to other ways.
    #[test]
    fn divisors_are_found_here() {
        let x = Poly::variable(0);
        let linear = |a: i64, b: i64| x.scale(&Int::from(a)).add(&Poly::constant(Int::from(b)));
        let h = (1..9).fold(Poly::one(), |h, i| h.mul(&linear(i, 3 - 2 * i)));
        let (f, g) = (h.mul(&linear(7, 5).pow(4)), h.mul(&linear(-3, 11).pow(3)));
        let (six, twelve) = (Int::from(6), Int::from(12));
        let (f, g) = (f.mul(&x).scale(&six), g.mul(&x.pow(2)).scale(&twelve));
        assert_eq!(f.divisor_on_line(&g, false), Some(h.scale(&six).mul(&x)));
        assert_eq!(linear(7, 5).divisor_on_line(&linear(7, 6), false), Some(Poly::one()));
    }
}
