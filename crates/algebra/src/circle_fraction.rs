//! Polynomials in the tangent s of half an angle, over powers of `1 + s^2`: the ring in which the cosine and the sine of
//! that angle lie.

use super::ring::{Field, Ring};
use super::univariate::Univariate;
use rug::Rational;

/// `numerator / (1 + s^2)^power`, in lowest terms.
#[derive(Clone, Debug, PartialEq)]
pub struct CircleFraction {
    numerator: Univariate<Rational>,
    power: u32,
}

/// Returns whether `1 + s^2` divides a polynomial: whether its value at the imaginary unit is zero.
fn is_divisible(polynomial: &Univariate<Rational>) -> bool {
    let mut value = [Rational::new(), Rational::new()];
    for (k, c) in polynomial.coefficients().iter().enumerate() {
        if k % 4 < 2 {
            value[k % 2] += c;
        } else {
            value[k % 2] -= c;
        }
    }
    value.iter().all(Rational::is_zero)
}

impl CircleFraction {
    fn new(mut numerator: Univariate<Rational>, mut power: u32) -> Self {
        if numerator.is_zero() {
            return Self { numerator, power: 0 };
        }
        while power > 0 && is_divisible(&numerator) {
            numerator = numerator.div_rem(&Univariate::circle()).0;
            power -= 1;
        }
        Self { numerator, power }
    }

    /// Returns a polynomial in s.
    #[must_use]
    pub fn polynomial(numerator: Univariate<Rational>) -> Self {
        Self { numerator, power: 0 }
    }

    /// Returns the variable s.
    #[must_use]
    pub fn variable() -> Self {
        Self::polynomial(Univariate::x())
    }

    /// Returns cosine and sine of the angle.
    #[must_use]
    pub fn cosine_and_sine() -> (Self, Self) {
        let over = |numerator: [i32; 3]| Self::new(Univariate::new(numerator.map(Rational::from).to_vec()), 1);
        (over([1, 0, -1]), over([0, 2, 0]))
    }

    /// Returns the power of `1 + s^2` in the denominator.
    #[must_use]
    pub fn power(&self) -> u32 {
        self.power
    }

    /// Returns the product with `(1 + s^2)^power`, for a power not below that of the denominator.
    #[must_use]
    pub fn over(&self, power: u32) -> Univariate<Rational> {
        (self.power..power).fold(self.numerator.clone(), |product, _| product.mul(&Univariate::circle()))
    }
}

impl Ring for CircleFraction {
    fn zero() -> Self {
        Self::polynomial(Univariate::zero())
    }
    fn one() -> Self {
        Self::polynomial(Univariate::one())
    }
    fn add(&self, other: &Self) -> Self {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let power = self.power.max(other.power);
        Self::new(self.over(power).add(&other.over(power)), power)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        Self::new(self.numerator.mul(&other.numerator), self.power + other.power)
    }
    fn neg(&self) -> Self {
        Self { numerator: self.numerator.neg(), power: self.power }
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self::polynomial(Univariate::constant(q.clone())))
    }
}

/// This is no field: only numbers times powers of `1 + s^2` have an inverse here, and for any other element algorithms get
/// `None`.
impl Field for CircleFraction {
    fn inverse(&self) -> Option<Self> {
        let [c] = self.numerator.coefficients() else { return None };
        let inverse = Univariate::constant(c.clone().recip());
        Some(Self::new((0..self.power).fold(inverse, |product, _| product.mul(&Univariate::circle())), 0))
    }
    fn pivot_size(&self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_of_cosine_and_sine_add_up_to_one() {
        let (cos, sin) = CircleFraction::cosine_and_sine();
        assert_eq!(cos.mul(&cos).add(&sin.mul(&sin)), CircleFraction::one());
        assert_eq!(cos.power(), 1);
        assert_eq!(cos.sub(&cos), CircleFraction::zero());
    }

    #[test]
    fn units_have_inverses_and_nothing_else_has() {
        let (cos, _) = CircleFraction::cosine_and_sine();
        assert_eq!(cos.inverse(), None);
        let half = CircleFraction::one().add(&cos);
        // 2/(1 + s^2)
        let inverse = half.inverse().expect("a unit");
        assert_eq!(inverse.mul(&half), CircleFraction::one());
    }
}
