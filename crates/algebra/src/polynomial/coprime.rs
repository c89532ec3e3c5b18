//! Bounds of the degrees of common divisors, from values modulo one prime; with them, divisors from values at a power of two.
//!
//! # Source
//! Char, Geddes, Gonnet 1989, GCDHEU: Heuristic polynomial GCD algorithm based on integer GCD computation, Journal of
//! Symbolic Computation 7 (divisors from integers; the proof is another one here).

use super::Polynomial;
use super::kronecker::{Kronecker, Numbers};
use super::product::{to_large, to_words};
use crate::int::Int;
use crate::modp::{Modulus, PRIME_62};
use crate::residue_polynomial::{Residues, common_divisor, trim};
use crate::ring::Domain;

/// The first state of the generator of values: that of the golden ratio.
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;
/// The terms of both polynomials below which a table of powers costs more than the way without it.
const FEW: usize = 8;
/// The bits of a slot beyond those of a coefficient: for longer coefficients of a divisor, and for a common factor of the
/// values of the cofactors.
const MARGIN: usize = 14;
/// The limbs beyond which the common divisor of the integers, in quadratic time, costs more than images modulo primes.
const MOST_LIMBS: usize = 320;

impl Polynomial<Int> {
    /// Returns bounds of the degrees that a common divisor has in each variable; `None` where none are known.
    ///
    /// Let d be a common divisor over the integers, x a variable, and let all other variables get values modulo a prime
    /// at which the leading coefficient in x of one of the polynomials does not vanish. That of d divides it and does not
    /// vanish either, so that d keeps its degree in x; and it divides both images. Its degree is therefore at most that of
    /// the greatest common divisor of the images.
    ///
    /// Here x becomes `v x` with a value v other than zero, which changes no degree, so that one value of each term serves
    /// all variables.
    pub(super) fn divisor_degrees(&self, other: &Self) -> Option<Vec<u32>> {
        const MODULUS: Modulus = Modulus::new(PRIME_62);
        if self.len() + other.len() < FEW {
            return None;
        }
        let (own, others) = (self.degrees(), other.degrees());
        let count = own.len().max(others.len());
        let of = |degrees: &[u32], variable: usize| degrees.get(variable).copied().unwrap_or(0);
        let mut powers = Vec::with_capacity(count);
        let mut state = SEED;
        for variable in 0..count {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let (value, mut power) = (MODULUS.enter(state), MODULUS.enter(1));
            let largest = of(&own, variable).max(of(&others, variable)) as usize;
            // Powers of sparse polynomials of high degree are not worth a table.
            if value == 0 || largest > 4 * (self.len() + other.len()) + 64 {
                return None;
            }
            let mut table = Vec::with_capacity(largest + 1);
            for _ in 0..=largest {
                table.push(power);
                power = MODULUS.mul(power, value);
            }
            powers.push(table);
        }
        let (a, b) = (self.values(&powers, &MODULUS), other.values(&powers, &MODULUS));
        let bound = |variable: usize| {
            let (own, others) = (of(&own, variable), of(&others, variable));
            if own == 0 || others == 0 {
                return Some(0);
            }
            let image = self.image_in(variable, own as usize, &a, &MODULUS);
            let other_image = other.image_in(variable, others as usize, &b, &MODULUS);
            let kept = image.len() == own as usize + 1 || other_image.len() == others as usize + 1;
            let divisor = kept.then(|| common_divisor(image, other_image, &MODULUS))?;
            u32::try_from(divisor.len() - 1).ok()
        };
        let mut bounds = Vec::with_capacity(count);
        for variable in 0..count {
            bounds.push(bound(variable)?);
            let ends_in_number = |polynomial: &Self, degrees: &[u32]| {
                let degree = of(degrees, variable);
                degree > 0 && polynomial.leads_with_number(variable, degree)
            };
            if bounds[variable] == 0 && (ends_in_number(self, &own) || ends_in_number(other, &others)) {
                // A common divisor free of the variable divides each coefficient of its powers, one of which is a number.
                return Some(vec![0; count]);
            }
        }
        Some(bounds)
    }

    /// Returns whether the coefficient of the highest power of a variable, which has this degree, is a number.
    fn leads_with_number(&self, variable: usize, degree: u32) -> bool {
        let mut highest = (0..self.len()).filter(|&term| self.exponent(term, variable) == degree);
        let others = |term| (0..self.variables()).all(|other| other == variable || self.exponent(term, other) == 0);
        highest.next().is_some_and(others) && highest.next().is_none()
    }

    /// Returns whether it is proved that no variable occurs in a common divisor; `false` says nothing.
    #[cfg(test)]
    fn has_constant_divisors(&self, other: &Self) -> bool {
        self.divisor_degrees(other).is_some_and(|degrees| degrees.iter().all(|degree| *degree == 0))
    }

    /// Returns the greatest common divisor of two primitive polynomials if that of their values at a power of two shows it;
    /// no common divisor may have larger degrees than these. It divides both, which division proves; a common divisor
    /// that it divides differs by a factor in which no variable can occur, and that is 1 for primitive polynomials.
    pub(super) fn divisor_by_value(&self, other: &Self, bounds: &[u32]) -> Option<Self> {
        let is_largest =
            |candidate: &Self| bounds.iter().enumerate().all(|(variable, bound)| candidate.degree(variable) == *bound);
        // A polynomial that divides the other needs no search.
        for (divisor, dividend) in [(self, other), (other, self)] {
            if is_largest(divisor) {
                return dividend.checked_div_exact(divisor).map(|_| divisor.primitive_part());
            }
        }
        let packing = self.joint_packing(other);
        let (left, right) = (self.packed_as(packing), other.packed_as(packing));
        let degrees: Vec<u32> =
            (0..packing.variables()).map(|variable| self.degree(variable).max(other.degree(variable))).collect();
        let words = to_words(&self.coefficients).zip(to_words(&other.coefficients));
        let large =
            if words.is_none() { to_large(&self.coefficients).zip(to_large(&other.coefficients)) } else { None };
        let (a, b) = match (&words, &large) {
            (Some((a, b)), _) => (Numbers::Words(a), Numbers::Words(b)),
            (None, large) => large.as_ref().map(|(a, b)| (Numbers::Large(a), Numbers::Large(b)))?,
        };
        // No slot may be too short for the longer coefficients.
        let width = (a.bits().min(b.bits()) + MARGIN).max(a.bits().max(b.bits()) + 2);
        let substitution = Kronecker::with_width(packing, &degrees, width, &left, &right)?;
        if substitution.limbs() > MOST_LIMBS {
            return None;
        }
        let (monomials, coefficients) = substitution.divisor((&left, &a), (&right, &b));
        let candidate = Self { packing, monomials, coefficients }.primitive_part();
        let divides = |polynomial: &Self| polynomial.checked_div_exact(&candidate).is_some();
        (is_largest(&candidate) && divides(self) && divides(other)).then_some(candidate)
    }

    /// Returns the value of each term.
    fn values(&self, powers: &[Vec<u64>], modulus: &Modulus) -> Vec<u64> {
        let mut values: Vec<u64> = self.coefficients.iter().map(|c| c.residue(modulus)).collect();
        for (variable, table) in powers.iter().enumerate().filter(|(_, table)| table.len() > 1) {
            if variable >= self.variables() {
                break;
            }
            let (word, shift) = self.packing.place(variable);
            let words = self.packing.words();
            for (value, monomial) in values.iter_mut().zip(self.monomials.chunks_exact(words)) {
                let exponent = self.packing.field(monomial[word], shift) as usize;
                *value = modulus.mul(*value, table[exponent]);
            }
        }
        values
    }

    /// Returns the sums of the values of the terms with the same power of a variable, of this degree here, without zeros at
    /// the end.
    fn image_in(&self, variable: usize, degree: usize, values: &[u64], modulus: &Modulus) -> Residues {
        let mut image = vec![0; degree + 1];
        let (word, shift) = self.packing.place(variable);
        let words = self.packing.words();
        for (value, monomial) in values.iter().zip(self.monomials.chunks_exact(words)) {
            let power = &mut image[self.packing.field(monomial[word], shift) as usize];
            *power = modulus.add(*power, *value);
        }
        trim(&mut image);
        image
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ring::Ring;
    use proptest::prelude::*;

    type Poly = Polynomial<Int>;

    /// Returns the divisor of primitive polynomials by Euclid's algorithm in the first variable that occurs.
    fn by_euclid(a: &Poly, b: &Poly) -> Poly {
        match (0..3).find(|&v| a.degree(v) > 0 || b.degree(v) > 0) {
            Some(variable) => a.euclidean_gcd(b, variable),
            None => Poly::one(),
        }
    }

    fn polynomial(variables: usize) -> impl Strategy<Value = Poly> {
        let term = (prop::collection::vec(0..4_u32, variables), -9..9_i64);
        prop::collection::vec(term, 1..12)
            .prop_map(|terms| Poly::from_terms(terms.into_iter().map(|(exponents, c)| (exponents, Int::from(c)))))
    }

    proptest! {
        #[test]
        fn no_divisor_is_denied((f, g, h) in (1..4_usize).prop_flat_map(|n| (polynomial(n), polynomial(n), polynomial(n)))) {
            prop_assume!(!f.is_zero() && !g.is_zero() && !h.is_zero());
            let (a, b) = (f.mul(&h), g.mul(&h));
            prop_assert!(h.to_constant().is_some() || !a.has_constant_divisors(&b));
            let variable = (0..3).find(|&v| f.degree(v) > 0);
            let slow = variable.map(|variable| f.euclidean_gcd(&g, variable));
            let constant = slow.is_none_or(|gcd| gcd.to_constant().is_some());
            prop_assert!(constant || !f.has_constant_divisors(&g));
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        #[test]
        fn divisors_by_values_are_the_greatest(
            (f, g, h) in (1..4_usize).prop_flat_map(|n| (polynomial(n), polynomial(n), polynomial(n))),
            squared in any::<bool>(),
        ) {
            prop_assume!(!f.is_zero() && !g.is_zero() && !h.is_zero());
            let h = if squared { h.mul(&h) } else { h };
            for (a, b) in [(f.mul(&h), g.mul(&h)), (h.clone(), g.mul(&h)), (f.mul(&h).neg(), h.clone()), (h.clone(), h.neg())] {
                let (a, b) = (a.primitive_part(), b.primitive_part());
                let Some(bounds) = a.divisor_degrees(&b) else { continue };
                let expected = by_euclid(&a, &b);
                prop_assert!(bounds.iter().enumerate().all(|(variable, bound)| expected.degree(variable) <= *bound));
                if let Some(found) = a.divisor_by_value(&b, &bounds) {
                    prop_assert_eq!(&found, &expected);
                }
                prop_assert_eq!(&a.gcd(&b), &expected);
            }
        }
    }

    /// Values have a common factor that no polynomial shows, coefficients reach the ends of words, leading ones are negative.
    #[test]
    fn values_that_mislead() {
        let [x, y] = [0, 1].map(Poly::variable);
        let number = |n: i64| Poly::constant(Int::from(n));
        let h = x.pow(3).scale(&Int::from(i64::MAX >> 40)).sub(&x.mul(&y)).add(&number(7)).add(&y.pow(5));
        for (f, g) in [
            (x.pow(2).add(&number(6)), x.add(&number(2)).pow(3)),
            (x.pow(2).add(&x), x.pow(4).add(&x.pow(2)).add(&number(2))),
            (number(1), y.sub(&x).neg()),
            (y.pow(4).sub(&number(1)), y.pow(6).sub(&number(1))),
        ] {
            let (a, b) = (f.mul(&h).neg(), g.mul(&h));
            assert_eq!(a.gcd(&b), f.euclidean_gcd(&g, 0).mul(&h).primitive_part());
        }
    }

    #[test]
    fn coprime_polynomials_are_told_by_values() {
        let [x, y, z] = [0, 1, 2].map(Poly::variable);
        let one = Poly::one();
        let f = x.add(&y).add(&z).add(&one).pow(3);
        let g = x.mul(&y).sub(&z).add(&one).pow(2);
        assert!(f.has_constant_divisors(&g));
        assert_eq!(f.scale(&Int::from(6)).gcd(&g.scale(&Int::from(-4))), Poly::constant(Int::from(2)));
        // A divisor in one variable only, and monomials.
        assert!(!f.mul(&z.add(&one)).has_constant_divisors(&g.mul(&z.add(&one))));
        assert!(!f.mul(&z).has_constant_divisors(&g.mul(&z)));
    }

    /// All leading coefficients vanish modulo the prime: nothing is concluded.
    #[test]
    fn lost_degrees_prove_nothing() {
        let p = Int::from(PRIME_62);
        let [x, y] = [0, 1].map(Poly::variable);
        let h = x.scale(&p).add(&Poly::one());
        let f = h.mul(&y.add(&Poly::one()).pow(3));
        let g = h.mul(&y.sub(&Poly::one()).pow(3));
        assert!(f.len() + g.len() >= FEW && !f.has_constant_divisors(&g));
        assert_eq!(f.gcd(&g), h);
    }
}
