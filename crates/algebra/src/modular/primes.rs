//! The primes below `2^49`, largest first.

use crate::modp::is_prime;

/// Every prime used here lies below `2^PRIME_BITS`, and close to it.
pub const PRIME_BITS: u32 = 49;

/// Distances of the largest primes below `2^PRIME_BITS`; finding them takes longer than a small determinant.
const DISTANCES: [u16; 64] = [
    81, 111, 123, 139, 181, 201, 213, 265, 283, 339, 441, 445, 475, 519, 565, 571, 579, 585, 703, 741, 753, 759, 789,
    805, 855, 909, 939, 943, 969, 1009, 1015, 1083, 1123, 1131, 1165, 1173, 1215, 1245, 1281, 1323, 1399, 1405, 1441,
    1453, 1489, 1519, 1581, 1611, 1621, 1693, 1749, 1771, 1795, 1911, 1929, 1993, 1995, 2001, 2023, 2083, 2101, 2103,
    2115, 2185,
];

/// Returns enough primes for their product to exceed `2^bits`.
pub(super) fn primes_beyond(bits: f64) -> Vec<u64> {
    let (mut primes, mut left) = (Vec::new(), bits);
    for p in largest_primes() {
        if left < 0.0 {
            break;
        }
        primes.push(p);
        // A little less than the logarithm, so that rounding cannot leave the product too small.
        left -= (p as f64).log2() - 1e-9;
    }
    primes
}

/// No less than the number of primes whose product exceeds `2^bits`, as long as they are near `2^PRIME_BITS`.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few more than none")]
pub(super) fn count_beyond(bits: f64) -> usize {
    (bits / f64::from(PRIME_BITS)) as usize + 2
}

/// Returns the primes below `2^PRIME_BITS`, largest first.
pub fn largest_primes() -> impl Iterator<Item = u64> {
    let top = 1 << PRIME_BITS;
    let tabled = DISTANCES.iter().map(move |&distance| top - u64::from(distance));
    let last = top - u64::from(DISTANCES[DISTANCES.len() - 1]);
    tabled.chain((0..last).rev().filter(|&p| is_prime(p)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_holds_the_largest_primes() {
        let found = (0..1 << PRIME_BITS).rev().filter(|&p| is_prime(p));
        assert!(found.take(DISTANCES.len() + 3).eq(largest_primes().take(DISTANCES.len() + 3)));
    }

    #[test]
    fn the_product_exceeds_the_bound() {
        assert_eq!(primes_beyond(-1.0).len(), 0);
        assert_eq!(primes_beyond(0.0).len(), 1);
        assert_eq!(primes_beyond(97.9).len(), 2);
        assert_eq!(primes_beyond(98.0).len(), 3);
    }
}
