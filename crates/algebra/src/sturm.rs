//! Real roots of polynomials, counted exactly by Sturm's theorem.

use super::ring::Ring;
use super::rounded_chain::count_by_leading_signs;
use super::univariate::Univariate;
use rug::{Integer, Rational, ops::Pow};
use std::{cmp::Ordering, mem};

/// A place at which signs of polynomials are evaluated.
#[derive(Clone, Copy, Debug)]
pub enum Place<'a> {
    /// Left of all roots.
    MinusInfinity,
    /// A number.
    At(&'a Rational),
    /// Right of all roots.
    PlusInfinity,
}

/// The Sturm chain of the square-free part of a polynomial, each member a positive multiple of the classical one.
#[derive(Clone, Debug)]
pub struct SturmChain {
    members: Vec<Univariate<Integer>>,
}

impl SturmChain {
    /// Returns the chain of a polynomial, by subresultant remainders.
    ///
    /// # Panics
    /// When the polynomial is zero.
    ///
    /// # Source
    /// Collins 1967, "Subresultants and reduced polynomial remainder sequences", J. ACM 14, and Brown and Traub 1971,
    /// "On Euclid's algorithm and the theory of subresultants", for the factors known to divide remainders.
    #[must_use]
    pub fn new(polynomial: &Univariate<Rational>) -> Self {
        assert!(!polynomial.is_zero(), "every number is a root of zero");
        Self::of_square_free(Univariate::new(polynomial.primitive_integers()).square_free_part())
    }

    fn of_square_free(polynomial: Univariate<Integer>) -> Self {
        let mut next = polynomial.derivative();
        let mut members = vec![polynomial];
        // All remainders after the first are divisible by these, g h^drop.
        let (mut g, mut h) = (Integer::from(1), Integer::from(1));
        while !next.is_zero() {
            let before = &members[members.len() - 1];
            let drop = before.coefficients().len() - next.coefficients().len();
            let exponent = u32::try_from(drop).expect("degrees are small");
            let leading = next.coefficients()[next.coefficients().len() - 1].clone();
            let (remainder, steps) = before.pseudo_remainder(&next);
            // To complete the factor of the remainder to leading^(drop + 1), whatever its steps were.
            let missing = Integer::from((&leading).pow(exponent + 1 - steps));
            let mut divisor = Integer::from((&h).pow(exponent)) * &g;
            // The chain goes on with minus the remainder of the member, times something positive.
            let flipped = divisor.is_negative() != (leading.is_negative() && drop.is_multiple_of(2));
            if !flipped {
                divisor = -divisor;
            }
            let reduced = |c: &Integer| Some(Integer::from(c * &missing).div_exact(&divisor));
            let after = remainder.map(reduced).expect("every integer has an image");
            h = match exponent {
                0 => h,
                1 => leading.clone(),
                _ => Integer::from((&leading).pow(exponent)).div_exact(&Integer::from((&h).pow(exponent - 1))),
            };
            g = leading;
            members.push(mem::replace(&mut next, after));
        }
        Self { members }
    }

    /// Returns the number of distinct real roots.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count_between(Place::MinusInfinity, Place::PlusInfinity)
    }

    /// Returns the number of distinct real roots in the half-open interval `(from, to]`.
    ///
    /// # Panics
    /// When `to` is left of `from`, by Sturm's theorem only if there are roots between.
    #[must_use]
    pub fn count_between(&self, from: Place, to: Place) -> usize {
        let count = self.sign_changes(from).checked_sub(self.sign_changes(to));
        count.expect("the interval runs from left to right")
    }

    fn sign_changes(&self, place: Place) -> usize {
        let mut signs: Vec<Ordering> = self.members.iter().map(|p| sign_at(p, place)).collect();
        signs.retain(|&s| s != Ordering::Equal);
        signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }
}

fn sign_at(p: &Univariate<Integer>, place: Place) -> Ordering {
    let leading = p.coefficients().last().map_or(Ordering::Equal, Integer::cmp0);
    match place {
        Place::At(x) => p.sign_at(x),
        Place::MinusInfinity if p.degree().is_some_and(|d| d % 2 == 1) => leading.reverse(),
        Place::MinusInfinity | Place::PlusInfinity => leading,
    }
}

impl Univariate<Integer> {
    /// Returns the number of distinct real roots, by Sturm's theorem.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn distinct_real_roots(&self) -> usize {
        assert!(!self.is_zero(), "every number is a root of zero");
        count_by_leading_signs(self).unwrap_or_else(|| {
            let part = self.square_free_part();
            count_by_leading_signs(&part).unwrap_or_else(|| SturmChain::of_square_free(part).count())
        })
    }
}

impl Univariate<Rational> {
    /// Returns the coefficients of the primitive multiple: integers without common factor, the last one positive.
    #[must_use]
    pub fn primitive_integers(&self) -> Vec<Integer> {
        let mut common = Integer::from(1);
        for c in self.coefficients().iter().filter(|c| !c.is_integer()) {
            common.lcm_mut(c.denom());
        }
        let integer = |c: &Rational| {
            if common == 1 { c.numer().clone() } else { Integer::from(common.div_exact_ref(c.denom())) * c.numer() }
        };
        let mut integers: Vec<Integer> = self.coefficients().iter().map(integer).collect();
        let mut content = Integer::new();
        for c in integers.iter().rev() {
            content.gcd_mut(c);
            if content == 1 {
                break;
            }
        }
        if integers.last().is_some_and(Integer::is_negative) {
            content = -content;
        }
        if content != 1 {
            // Zero only of the zero polynomial, which has no coefficients.
            for c in &mut integers {
                c.div_exact_mut(&content);
            }
        }
        integers
    }

    /// Returns the number of distinct real roots, by Sturm's theorem.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn distinct_real_roots(&self) -> usize {
        Univariate::new(self.primitive_integers()).distinct_real_roots()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Integers, common factors, and denominators, words and longer ones, of both signs: as by the rationals' own way.
    #[test]
    fn primitive_integers_are_those_of_the_normalised_multiple() {
        assert!(Univariate::<Rational>::new(Vec::new()).primitive_integers().is_empty());
        let mut state = 7_u64;
        let mut next = |bits: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Integer::from(state.cast_signed() >> (64 - bits))
        };
        for round in 0..300_usize {
            let (bits, fractions) = ([2, 9, 63][round % 3], round % 2 == 1);
            let factor = next(bits) << (if round % 5 == 0 { 70_u32 } else { 0 });
            let number = |_| {
                let denominator = if fractions { next(8).abs() + 1_u32 } else { Integer::from(1) };
                Rational::from((next(bits) * &factor, denominator))
            };
            let poly = Univariate::new((0..=round % 12).map(number).collect());
            let normalised = poly.clone().normalise();
            let expected: Vec<Integer> = normalised.coefficients().iter().map(|c| c.numer().clone()).collect();
            assert!(normalised.coefficients().iter().all(Rational::is_integer));
            assert_eq!(poly.primitive_integers(), expected, "{poly:?}");
        }
    }

    #[test]
    fn rounded_chains_count_like_exact_ones() {
        let mut state = 1_u64;
        let mut next = |bits: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            Integer::from(state.cast_signed() >> (64 - bits))
        };
        let mut decided = 0;
        for round in 0..200_usize {
            let bits = [3, 8, 60][round % 3];
            let p = Univariate::new((0..=round % 17).map(|_| next(bits)).chain([Integer::from(1)]).collect());
            let exact = SturmChain::of_square_free(p.square_free_part()).count();
            if let Some(count) = count_by_leading_signs(&p) {
                assert_eq!(count, exact, "{p:?}");
                decided += 1;
            }
        }
        assert!(decided > 150, "{decided}");
    }
}
