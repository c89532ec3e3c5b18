//! The second implementation of the rationals, which shares no code with the first: the oracle of the tests.
//!
//! There is none for `Ratio<i128>`, whose products overflow: ring operations cannot report a failure.

use super::ring::{Domain, Field, Ring};
use num_bigint::BigInt;
use num_rational::Ratio;
use num_traits::{One, Zero};
use rug::{Integer, Rational, integer::Order};

/// Converts an integer to the other library, digit by digit.
fn big_int(n: &Integer) -> BigInt {
    let digits: Vec<u32> = n.to_digits(Order::Lsf);
    let magnitude = BigInt::from(num_bigint::BigUint::new(digits));
    if n.is_negative() { -magnitude } else { magnitude }
}

impl Ring for Ratio<BigInt> {
    fn zero() -> Self {
        Zero::zero()
    }
    fn one() -> Self {
        One::one()
    }
    fn add(&self, other: &Self) -> Self {
        self + other
    }
    fn sub(&self, other: &Self) -> Self {
        self - other
    }
    fn mul(&self, other: &Self) -> Self {
        self * other
    }
    fn neg(&self) -> Self {
        -self.clone()
    }
    fn is_zero(&self) -> bool {
        Zero::is_zero(self)
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Ratio::new(big_int(q.numer()), big_int(q.denom())))
    }
    fn from_integer(n: i32) -> Self {
        Ratio::from(BigInt::from(n))
    }
}

impl Domain for Ratio<BigInt> {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        (!Zero::is_zero(other)).then(|| self / other)
    }
}

impl Field for Ratio<BigInt> {
    fn inverse(&self) -> Option<Self> {
        (!Zero::is_zero(self)).then(|| self.recip())
    }
    fn pivot_size(&self) -> f64 {
        if Zero::is_zero(self) { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}
