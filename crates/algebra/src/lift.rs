//! From residues modulo small primes back to rational numbers.

use rug::{Integer, Rational, ops::RemRounding};

/// Returns the rational number of least height with the given residues, each with its prime; `None` if there is none with
/// numerator and denominator up to the square root of half the product of the primes.
///
/// Euclid's algorithm is stopped half-way.
///
/// # Panics
/// If a prime occurs twice.
#[must_use]
pub fn rational(residues: &[(u64, u64)]) -> Option<Rational> {
    let (mut value, mut modulus) = (Integer::new(), Integer::from(1));
    for &(residue, prime) in residues {
        let inverse = modulus.clone().invert(&Integer::from(prime)).expect("the primes are distinct");
        let step = (Integer::from(residue) - &value) * inverse;
        value += &modulus * step.rem_euc(prime);
        modulus *= prime;
    }
    let bound = Integer::from(&modulus / 2).sqrt();
    let (mut larger, mut smaller) = (modulus.clone(), value);
    let (mut before, mut factor) = (Integer::new(), Integer::from(1));
    while smaller > bound {
        let (quotient, remainder) = larger.div_rem(smaller.clone());
        (larger, smaller) = (smaller, remainder);
        let next = before - quotient * &factor;
        (before, factor) = (factor, next);
    }
    let fits = factor != 0 && Integer::from(factor.abs_ref()) <= bound && Integer::from(smaller.gcd_ref(&factor)) == 1;
    fits.then(|| Rational::from((smaller, factor)))
}

/// Returns the vector of least height with the given residues, one list for each prime; `None` as soon as one entry has none.
///
/// # Panics
/// When a prime occurs twice or the lists are not of one length.
#[must_use]
pub fn vector(lists: &[(u64, Vec<u64>)]) -> Option<Vec<Rational>> {
    let length = lists.first()?.1.len();
    (0..length).map(|k| rational(&lists.iter().map(|(prime, list)| (list[k], *prime)).collect::<Vec<_>>())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modp::ModP;
    use crate::ring::Ring;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn rationals_of_small_height_come_back(numerator in -1000_i32..1000, denominator in 1_i32..1000) {
            let q = Rational::from((numerator, denominator));
            let images = [
                (ModP::<2039>::from_rational(&q).unwrap().value(), 2039),
                (ModP::<2027>::from_rational(&q).unwrap().value(), 2027),
            ];
            prop_assert_eq!(rational(&images), Some(q));
        }
    }

    #[test]
    fn nothing_of_small_height_is_none() {
        // 5/3 and its negative are the smallest modulo 31 that need more than sqrt(31/2).
        let of = |q: (i32, i32)| ModP::<31>::from_rational(&Rational::from(q)).unwrap().value();
        assert_eq!(rational(&[(of((2, 3)), 31)]), Some(Rational::from((2, 3))));
        assert!((0..31).any(|residue| rational(&[(residue, 31)]).is_none()));
    }
}
