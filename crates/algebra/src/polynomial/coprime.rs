//! The proof that common divisors are constants, from values modulo one prime.

use super::Polynomial;
use crate::int::Int;
use crate::modp::{Modulus, PRIME_62};
use crate::residue_polynomial::{Residues, common_divisor, trim};

/// The first state of the generator of values: that of the golden ratio.
const SEED: u64 = 0x9e37_79b9_7f4a_7c15;
/// The terms of both polynomials below which a table of powers costs more than the way without it.
const FEW: usize = 8;

impl Polynomial<Int> {
    /// Returns whether it is proved that no variable occurs in a common divisor; `false` says nothing.
    ///
    /// Let d be a common divisor over the integers, x a variable, and let all other variables get values modulo a prime
    /// at which the leading coefficient in x of one of the polynomials does not vanish. That of d divides it and does not
    /// vanish either, so that d keeps its degree in x; and it divides both images. Where these have no common divisor but
    /// constants, x does not occur in d.
    ///
    /// Here x becomes `v x` with a value v other than zero, which changes no degree, so that one value of each term serves
    /// all variables.
    pub(super) fn has_constant_divisors(&self, other: &Self) -> bool {
        const MODULUS: Modulus = Modulus::new(PRIME_62);
        if self.len() + other.len() < FEW {
            return false;
        }
        let (own, others) = (self.degrees(), other.degrees());
        // A variable of one polynomial alone occurs in no common divisor, but in its leading coefficients.
        let count = own.len().max(others.len());
        let of = |degrees: &[u32], variable: usize| degrees.get(variable).copied().unwrap_or(0);
        let mut powers = Vec::with_capacity(count);
        let mut state = SEED;
        for variable in 0..count {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let (value, mut power) = (MODULUS.enter(state), MODULUS.enter(1));
            if value == 0 {
                return false;
            }
            let largest = of(&own, variable).max(of(&others, variable)) as usize;
            // Powers of sparse polynomials of high degree are not worth a table.
            if largest > 4 * (self.len() + other.len()) + 64 {
                return false;
            }
            let mut table = Vec::with_capacity(largest + 1);
            for _ in 0..=largest {
                table.push(power);
                power = MODULUS.mul(power, value);
            }
            powers.push(table);
        }
        let (a, b) = (self.values(&powers, &MODULUS), other.values(&powers, &MODULUS));
        (0..count).filter(|&variable| of(&own, variable) > 0 && of(&others, variable) > 0).all(|variable| {
            let images = [(self, &a, &own), (other, &b, &others)].map(|(polynomial, values, degrees)| {
                polynomial.image_in(variable, of(degrees, variable) as usize, values, &MODULUS)
            });
            let kept = images[0].len() == of(&own, variable) as usize + 1
                || images[1].len() == of(&others, variable) as usize + 1;
            let [a, b] = images;
            kept && common_divisor(a, b, &MODULUS).len() == 1
        })
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
