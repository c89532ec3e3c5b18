//! From residues modulo several primes back to integers.

use rug::Integer;

/// The integers of least absolute value with given residues modulo a fixed set of primes.
///
/// With `M` the product of the primes and `r_i` the residues, the integer is `sum_i s_i M/p_i - q M`, where `s_i` is
/// `r_i` divided by `M/p_i` modulo `p_i`, and q the integer nearest to `sum_i s_i / p_i`.
pub(super) struct Chinese {
    product: Integer,
    /// `M/p_i`
    cofactors: Vec<Integer>,
    /// `1/p_i`
    reciprocals: Vec<f64>,
}

impl Chinese {
    pub(super) fn new(primes: &[u64]) -> Self {
        let product: Integer = primes.iter().map(|&p| Integer::from(p)).product();
        let cofactors = primes.iter().map(|&p| Integer::from(product.div_exact_ref(&Integer::from(p)))).collect();
        let reciprocals = primes.iter().map(|&p| 1.0 / p as f64).collect();
        Self { product, cofactors, reciprocals }
    }

    /// Returns the integer, given the `s_i`, if it is less than a quarter of the product of the primes in absolute value.
    ///
    /// The margin keeps the sum of the quotients, in floating point, far from values that would round the wrong way.
    #[expect(clippy::cast_possible_truncation, reason = "no larger than the number of primes")]
    pub(super) fn combine(&self, shares: &[i64]) -> Integer {
        let mut sum = Integer::with_capacity(self.product.significant_bits() as usize + 64);
        let mut quotient = 0.0;
        for ((&share, cofactor), &reciprocal) in shares.iter().zip(&self.cofactors).zip(&self.reciprocals) {
            sum += cofactor * share;
            quotient += share as f64 * reciprocal;
        }
        sum -= &self.product * quotient.round() as i64;
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::modular::primes::primes_beyond;

    #[test]
    fn integers_up_to_a_quarter_of_the_product_come_back() {
        for count in [1, 2, 7] {
            let primes = primes_beyond(f64::from(count) * 49.0 - 1.0);
            let chinese = Chinese::new(&primes);
            let quarter = Integer::from(&chinese.product / 4);
            for n in [Integer::new(), Integer::from(-1), quarter.clone(), -quarter] {
                let share = |(&p, cofactor): (&u64, &Integer)| {
                    let p = Integer::from(p);
                    let inverse = cofactor.clone().invert(&p).unwrap();
                    let share = (&n * inverse).modulo(&p).to_i64().unwrap();
                    // Either representative will do.
                    if share % 3 == 0 { share - p.to_i64().unwrap() } else { share }
                };
                let shares: Vec<i64> = primes.iter().zip(&chinese.cofactors).map(share).collect();
                assert_eq!(chinese.combine(&shares), n);
            }
        }
    }
}
