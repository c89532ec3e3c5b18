//! Integers that stay in a machine word while they fit: the coefficients of symbolic work, which rarely leave 64 bits.

use super::ring::{Domain, Ring};
use rug::{Complete, Integer, Rational};
use std::cmp::Ordering;

/// An integer of any size, without allocation while it fits an i64.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Int(Repr);

/// Large never holds what fits Small, so that equality is structural.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Repr {
    Small(i64),
    Large(Box<Integer>),
}

impl Int {
    /// The number as an i64, if it fits.
    #[must_use]
    #[inline(always)]
    pub fn to_i64(&self) -> Option<i64> {
        match &self.0 {
            Repr::Small(n) => Some(*n),
            Repr::Large(_) => None,
        }
    }

    /// The number as a big integer.
    #[must_use]
    pub fn to_integer(&self) -> Integer {
        match &self.0 {
            Repr::Small(n) => Integer::from(*n),
            Repr::Large(n) => Integer::clone(n),
        }
    }

    /// Its sign: how it compares to 0.
    #[must_use]
    pub fn sign(&self) -> Ordering {
        match &self.0 {
            Repr::Small(n) => n.cmp(&0),
            Repr::Large(n) => n.cmp0(),
        }
    }

    /// The greatest common divisor, never negative; zero only of two zeros.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        Self::from(self.to_integer().gcd(&other.to_integer()))
    }
}

impl From<i64> for Int {
    fn from(n: i64) -> Self {
        Self(Repr::Small(n))
    }
}

impl From<i128> for Int {
    fn from(n: i128) -> Self {
        i64::try_from(n).map_or_else(|_| Self(Repr::Large(Box::new(Integer::from(n)))), Self::from)
    }
}

impl From<Integer> for Int {
    fn from(n: Integer) -> Self {
        match n.to_i64() {
            Some(n) => Self(Repr::Small(n)),
            None => Self(Repr::Large(Box::new(n))),
        }
    }
}

impl Ring for Int {
    fn zero() -> Self {
        Self(Repr::Small(0))
    }
    fn one() -> Self {
        Self(Repr::Small(1))
    }
    #[inline]
    fn add(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_add(*b) {
                Some(sum) => Self(Repr::Small(sum)),
                None => Self::from(i128::from(*a) + i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) | (Repr::Large(b), Repr::Small(a)) => Self::from((&**b + *a).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((&**a + &**b).complete()),
        }
    }
    #[inline]
    fn sub(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_sub(*b) {
                Some(difference) => Self(Repr::Small(difference)),
                None => Self::from(i128::from(*a) - i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) => Self::from((*a - &**b).complete()),
            (Repr::Large(a), Repr::Small(b)) => Self::from((&**a - *b).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((&**a - &**b).complete()),
        }
    }
    #[inline]
    fn mul(&self, other: &Self) -> Self {
        match (&self.0, &other.0) {
            (Repr::Small(a), Repr::Small(b)) => match a.checked_mul(*b) {
                Some(product) => Self(Repr::Small(product)),
                None => Self::from(i128::from(*a) * i128::from(*b)),
            },
            (Repr::Small(a), Repr::Large(b)) | (Repr::Large(b), Repr::Small(a)) => Self::from((&**b * *a).complete()),
            (Repr::Large(a), Repr::Large(b)) => Self::from((&**a * &**b).complete()),
        }
    }
    fn neg(&self) -> Self {
        match &self.0 {
            Repr::Small(n) => n.checked_neg().map_or_else(|| Self::from(-i128::from(*n)), Self::from),
            Repr::Large(n) => Self::from((-&**n).complete()),
        }
    }
    #[inline(always)]
    fn is_zero(&self) -> bool {
        matches!(self.0, Repr::Small(0))
    }
    /// Only integers have an image.
    fn from_rational(q: &Rational) -> Option<Self> {
        q.is_integer().then(|| Self::from(q.numer().clone()))
    }
    fn from_integer(n: i32) -> Self {
        Self::from(i64::from(n))
    }
}

impl Domain for Int {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        if let (Repr::Small(a), Repr::Small(b)) = (&self.0, &other.0) {
            if let Some(remainder) = a.checked_rem(*b) {
                return (remainder == 0).then(|| Self(Repr::Small(a / b)));
            }
        }
        let (a, b) = (self.to_integer(), other.to_integer());
        a.is_divisible(&b).then(|| Self::from(a.div_exact(&b)))
    }
}
