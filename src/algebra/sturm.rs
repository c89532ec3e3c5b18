//! Real roots of rational polynomials, counted exactly by Sturm's theorem.

use super::rational::primitive_scale;
use super::ring::{Domain, Ring};
use super::univariate::Univariate;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// Where signs of polynomials are asked for.
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
    members: Vec<Univariate<Rational>>,
}

/// The positive multiple with integer coefficients without common factor.
fn positive_primitive(p: &Univariate<Rational>) -> Univariate<Rational> {
    p.scale(&primitive_scale(p.coefficients()))
}

impl SturmChain {
    /// The chain of a polynomial, by primitive remainders.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn new(polynomial: &Univariate<Rational>) -> Self {
        assert!(!polynomial.is_zero(), "every number is a root of zero");
        let mut members = vec![positive_primitive(polynomial)];
        let mut next = positive_primitive(&polynomial.derivative());
        while !next.is_zero() {
            let (remainder, steps) = members[members.len() - 1].pseudo_remainder(&next);
            // The remainder is of l^steps times the member; the chain goes on with minus the remainder of the member.
            let negative_leading = sign(next.coefficients().last()) == Ordering::Less;
            let flipped = negative_leading && steps % 2 == 1;
            members.push(next);
            next = positive_primitive(&if flipped { remainder } else { remainder.neg() });
        }
        // The last member is the greatest common divisor of the first two; without it the roots become simple.
        let divisor = members[members.len() - 1].clone();
        if divisor.degree() > Some(0) {
            members = members.iter().map(|p| p.div_exact(&divisor)).collect();
        }
        Self { members }
    }

    /// The number of distinct real roots.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count_between(Place::MinusInfinity, Place::PlusInfinity)
    }

    /// The number of distinct real roots in the half-open interval `(from, to]`.
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

fn sign(c: Option<&Rational>) -> Ordering {
    c.map_or(Ordering::Equal, Rational::cmp0)
}

fn sign_at(p: &Univariate<Rational>, place: Place) -> Ordering {
    let leading = sign(p.coefficients().last());
    match place {
        Place::At(x) => p.eval(x).cmp0(),
        Place::MinusInfinity if p.degree().is_some_and(|d| d % 2 == 1) => leading.reverse(),
        Place::MinusInfinity | Place::PlusInfinity => leading,
    }
}

impl Univariate<Rational> {
    /// The coefficients of the primitive multiple: integers without common factor, the last one positive.
    #[must_use]
    pub fn primitive_integers(&self) -> Vec<Integer> {
        self.clone().normalise().coefficients().iter().map(|c| c.numer().clone()).collect()
    }

    /// The number of distinct real roots.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn distinct_real_roots(&self) -> usize {
        SturmChain::new(self).count()
    }
}
