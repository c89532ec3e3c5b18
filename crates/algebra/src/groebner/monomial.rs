//! Monomials in one word each, whose order as numbers is that of the monomials.

/// The largest number of variables.
pub const MOST_VARIABLES: usize = 15;

/// The largest exponent, and the largest degree.
const LARGEST: u128 = 127;

/// A monomial: its degree in the highest byte, below it 127 minus each exponent, that of the last variable first.
/// Larger words are larger monomials by degree, then reverse lexicographically.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Monomial(u128);

/// The monomial 1: no exponent takes anything from 127.
const ONE: u128 = repeated(LARGEST);
/// The highest bit of each byte.
const GUARDS: u128 = repeated(128);

/// Returns a word with the same value in each byte but the highest.
const fn repeated(byte: u128) -> u128 {
    let (mut word, mut k) = (0, 0);
    while k < MOST_VARIABLES {
        word |= byte << (8 * k);
        k += 1;
    }
    word
}

/// Returns the position of the byte of a variable: the last variables are highest.
const fn shift(variable: usize) -> usize {
    8 * variable
}

impl Monomial {
    /// Returns the monomial 1.
    pub const fn one() -> Self {
        Self(ONE)
    }

    /// Returns one variable.
    pub const fn variable(k: usize) -> Self {
        Self(ONE - (1 << shift(k)) + (1 << 120))
    }

    /// Returns the total degree.
    pub const fn degree(self) -> usize {
        (self.0 >> 120) as usize
    }

    /// Returns the exponent of a variable.
    pub const fn exponent(self, k: usize) -> usize {
        (LARGEST - ((self.0 >> shift(k)) & 255)) as usize
    }

    /// Returns the product; `None` if its degree is too large for the word.
    pub fn times(self, other: Self) -> Option<Self> {
        (self.degree() + other.degree() <= LARGEST as usize).then_some(Self(self.0 + (other.0 - ONE)))
    }

    /// Returns whether this monomial divides another one.
    pub const fn divides(self, other: Self) -> bool {
        let low = (1 << 120) - 1;
        (((self.0 & low) | GUARDS) - (other.0 & low)) & GUARDS == GUARDS
    }

    /// Returns `self / divisor` for a divisor.
    pub const fn over(self, divisor: Self) -> Self {
        Self(self.0 - divisor.0 + ONE)
    }

    /// Returns the least common multiple; `None` if its degree is too large for the word.
    pub fn common_multiple(self, other: Self) -> Option<Self> {
        let mut product = Some(Self::one());
        for k in 0..MOST_VARIABLES {
            for _ in 0..self.exponent(k).max(other.exponent(k)) {
                product = product.and_then(|p| p.times(Self::variable(k)));
            }
        }
        product
    }

    /// Returns whether no variable occurs in both.
    pub fn is_coprime_to(self, other: Self) -> bool {
        (0..MOST_VARIABLES).all(|k| self.exponent(k) == 0 || other.exponent(k) == 0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn monomial(exponents: &[usize]) -> Monomial {
        let factors = exponents.iter().enumerate().flat_map(|(k, e)| std::iter::repeat_n(Monomial::variable(k), *e));
        factors.fold(Monomial::one(), |product, factor| product.times(factor).unwrap())
    }

    #[test]
    fn words_are_ordered_by_degree_then_reverse_lexicographically() {
        let descending =
            [[2, 0, 0], [1, 1, 0], [0, 2, 0], [1, 0, 1], [0, 1, 1], [0, 0, 2], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
        let words: Vec<Monomial> = descending.iter().map(|e| monomial(e)).collect();
        assert!(words.windows(2).all(|pair| pair[0] > pair[1]));
    }

    #[test]
    fn products_quotients_and_multiples_agree_with_exponents() {
        let (a, b) = (monomial(&[2, 0, 1, 3]), monomial(&[1, 4, 1, 0]));
        let product = a.times(b).unwrap();
        assert_eq!((0..5).map(|k| product.exponent(k)).collect::<Vec<_>>(), [3, 4, 2, 3, 0]);
        assert!(a.divides(product) && b.divides(product) && !a.divides(b) && !product.divides(a));
        assert_eq!(product.over(a), b);
        assert_eq!(a.common_multiple(b), Some(monomial(&[2, 4, 1, 3])));
        assert!(!a.is_coprime_to(b) && monomial(&[0, 0, 0, 1]).is_coprime_to(b));
        assert!(monomial(&[127]).times(Monomial::variable(0)).is_none());
    }
}
