//! Dense polynomials in one variable over any ring, themselves a ring.

use super::ring::{Domain, Field, Ring};
use rug::Rational;

/// A polynomial in one variable.
///
/// # Example
/// ```
/// use looproot_algebra::{ring::Ring, univariate::Univariate};
/// use rug::Rational;
///
/// let poly = |c: &[i32]| Univariate::new(c.iter().map(|&c| Rational::from(c)).collect());
/// // x^3 - 3x + 2 = (x + 2)(x - 1)^2
/// let factors = poly(&[2, -3, 0, 1]).square_free_decomposition();
/// assert_eq!(factors, [(poly(&[2, 1]), 1), (poly(&[-1, 1]), 2)]);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Univariate<R> {
    /// The coefficient of `x^k` at `k`; the last one is not zero.
    coefficients: Vec<R>,
}

impl<R: Ring> Univariate<R> {
    /// Returns the polynomial with the given coefficients, constant term first; zeros at the end are dropped.
    #[must_use]
    pub fn new(mut coefficients: Vec<R>) -> Self {
        while coefficients.last().is_some_and(Ring::is_zero) {
            coefficients.pop();
        }
        Self { coefficients }
    }

    /// Returns a constant.
    #[must_use]
    pub fn constant(c: R) -> Self {
        Self::new(vec![c])
    }

    /// Returns `1 + x^2`, whose roots are the half-angle tangents of no angle.
    #[must_use]
    pub fn circle() -> Self {
        Self::new(vec![R::one(), R::zero(), R::one()])
    }

    /// Returns the variable.
    #[must_use]
    pub fn x() -> Self {
        Self::new(vec![R::zero(), R::one()])
    }

    /// Returns the coefficients, constant term first, none for the zero polynomial.
    #[must_use]
    pub fn coefficients(&self) -> &[R] {
        &self.coefficients
    }

    /// Returns the degree; `None` for the zero polynomial.
    #[must_use]
    pub fn degree(&self) -> Option<usize> {
        self.coefficients.len().checked_sub(1)
    }

    /// Returns the value at `x`, by Horner's rule.
    #[must_use]
    pub fn eval(&self, x: &R) -> R {
        self.coefficients.iter().rev().fold(R::zero(), |value, c| value.mul(x).add(c))
    }

    /// Returns the derivative.
    ///
    /// # Panics
    /// When the degree does not fit an i32.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let term = |(k, c): (usize, &R)| c.mul(&R::from_integer(i32::try_from(k).expect("the degree fits an i32")));
        Self::new(self.coefficients.iter().enumerate().skip(1).map(term).collect())
    }

    /// Returns the product with a number.
    #[must_use]
    pub fn scale(&self, factor: &R) -> Self {
        Self::new(self.coefficients.iter().map(|c| c.mul(factor)).collect())
    }

    /// Returns the polynomial over another ring; `None` as soon as one coefficient has no image.
    pub fn map<S: Ring>(&self, image: impl Fn(&R) -> Option<S>) -> Option<Univariate<S>> {
        self.coefficients.iter().map(image).collect::<Option<_>>().map(Univariate::new)
    }

    /// `self - factor x^shift other`, coefficient by coefficient.
    fn subtract_shifted(coefficients: &mut [R], factor: &R, shift: usize, other: &Self) {
        for (x, y) in coefficients[shift..].iter_mut().zip(&other.coefficients) {
            *x = x.sub(&factor.mul(y));
        }
    }

    /// Returns the remainder of `l^s self` by `divisor`, l the leading coefficient of the divisor, and s.
    ///
    /// # Panics
    /// When the divisor is zero.
    pub(super) fn pseudo_remainder(&self, divisor: &Self) -> (Self, u32) {
        let leading = divisor.coefficients.last().expect("the divisor is not zero");
        let (mut rest, mut steps) = (self.clone(), 0);
        while rest.coefficients.len() >= divisor.coefficients.len() {
            let shift = rest.coefficients.len() - divisor.coefficients.len();
            let Some(top) = rest.coefficients.pop() else { break };
            for c in &mut rest.coefficients {
                *c = c.mul(leading);
            }
            let lower = Self { coefficients: divisor.coefficients[..divisor.coefficients.len() - 1].to_vec() };
            Self::subtract_shifted(&mut rest.coefficients, &top, shift, &lower);
            rest = Self::new(rest.coefficients);
            steps += 1;
        }
        (rest, steps)
    }
}

impl<F: Field> Univariate<F> {
    /// Returns quotient and remainder.
    ///
    /// # Panics
    /// When the divisor is zero.
    #[must_use]
    pub fn div_rem(&self, divisor: &Self) -> (Self, Self) {
        let inverse = divisor.coefficients.last().and_then(F::inverse).expect("the divisor is not zero");
        let mut rest = self.coefficients.clone();
        let mut quotient = Vec::new();
        while rest.len() >= divisor.coefficients.len() {
            let shift = rest.len() - divisor.coefficients.len();
            let factor = rest[rest.len() - 1].mul(&inverse);
            Self::subtract_shifted(&mut rest, &factor, shift, divisor);
            rest.pop();
            quotient.push(factor);
        }
        quotient.reverse();
        (Self::new(quotient), Self::new(rest))
    }

    /// Returns the polynomial of least degree through the given points (abscissa, value), by Newton's divided differences.
    ///
    /// # Panics
    /// When two abscissae are equal.
    #[must_use]
    pub fn interpolate(points: &[(F, F)]) -> Self {
        let mut differences: Vec<F> = points.iter().map(|(_, value)| value.clone()).collect();
        for order in 1..points.len() {
            // Abscissae of equal distances need one inverse an order.
            let (mut distance, mut inverse) = (F::zero(), F::zero());
            for i in (order..points.len()).rev() {
                let own = points[i].0.sub(&points[i - order].0);
                if own != distance || own.is_zero() {
                    inverse = own.inverse().expect("the abscissae are distinct");
                    distance = own;
                }
                differences[i] = differences[i].sub(&differences[i - 1]).mul(&inverse);
            }
        }
        let add_node = |poly: Self, (difference, (x, _)): (&F, &(F, F))| {
            let linear = Self::new(vec![x.neg(), F::one()]);
            poly.mul(&linear).add(&Self::constant(difference.clone()))
        };
        differences.iter().zip(points).rev().fold(Self::zero(), add_node)
    }
}

impl<F: Field + Domain> Univariate<F> {
    /// Returns the normalised multiple: monic, or over the rationals primitive with positive leading coefficient.
    #[must_use]
    pub fn normalise(mut self) -> Self {
        F::normalise(&mut self.coefficients);
        self
    }

    /// Returns the greatest common divisor, normalised; zero only of two zeros.
    #[must_use]
    pub fn gcd(&self, other: &Self) -> Self {
        let (mut a, mut b) = (self.clone().normalise(), other.clone().normalise());
        while !b.is_zero() {
            (a, b) = (b.clone(), a.pseudo_remainder(&b).0.normalise());
        }
        a
    }

    /// Returns the product of the distinct irreducible factors, normalised.
    ///
    /// Right in characteristic 0 and in characteristics above the degree; so is the decomposition.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn square_free_part(&self) -> Self {
        self.div_exact(&self.gcd(&self.derivative())).normalise()
    }

    /// Returns the square-free factors that are not constant, normalised, each with its multiplicity, by increasing
    /// multiplicity; the product of their powers is a multiple of the polynomial by a number.
    ///
    /// # Panics
    /// When the polynomial is zero.
    ///
    /// # Source
    /// Yun 1976, On square-free decomposition algorithms, SYMSAC.
    #[must_use]
    pub fn square_free_decomposition(&self) -> Vec<(Self, usize)> {
        let derivative = self.derivative();
        let repeated = self.gcd(&derivative);
        let mut rest = self.div_exact(&repeated);
        let mut slope = derivative.div_exact(&repeated).sub(&rest.derivative());
        let (mut factors, mut multiplicity) = (Vec::new(), 1);
        while rest.degree() > Some(0) {
            let factor = rest.gcd(&slope);
            rest = rest.div_exact(&factor);
            slope = slope.div_exact(&factor).sub(&rest.derivative());
            if factor.degree() > Some(0) {
                factors.push((factor, multiplicity));
            }
            multiplicity += 1;
        }
        factors
    }

    /// Returns the largest factor all of whose roots are roots of another polynomial, with their whole multiplicity here.
    ///
    /// # Panics
    /// When the polynomial is zero.
    #[must_use]
    pub fn part_with_roots_of(&self, other: &Self) -> Self {
        assert!(!self.is_zero(), "the zero polynomial has every root");
        let (mut rest, mut part) = (self.clone(), Self::one());
        loop {
            let common = rest.gcd(other);
            if common.degree().unwrap_or(0) == 0 {
                return part;
            }
            rest = rest.div_exact(&common);
            part = part.mul(&common);
        }
    }

    /// Returns how often `factor` divides, and the quotient; for instance for the `(1 + x^2)^k` of a half-angle substitution.
    ///
    /// # Panics
    /// If the polynomial is zero, or the factor constant.
    #[must_use]
    pub fn remove_factor(&self, factor: &Self) -> (usize, Self) {
        assert!(!self.is_zero(), "every factor divides zero without end");
        assert!(factor.degree() > Some(0), "a constant factor divides without end");
        let (mut multiplicity, mut rest) = (0, self.clone());
        loop {
            let (quotient, remainder) = rest.div_rem(factor);
            if !remainder.is_zero() {
                return (multiplicity, rest);
            }
            (multiplicity, rest) = (multiplicity + 1, quotient);
        }
    }
}

impl<R: Ring> Ring for Univariate<R> {
    fn zero() -> Self {
        Self { coefficients: Vec::new() }
    }
    fn one() -> Self {
        Self::constant(R::one())
    }
    fn add(&self, other: &Self) -> Self {
        let (long, short) =
            if self.coefficients.len() < other.coefficients.len() { (other, self) } else { (self, other) };
        let mut sum = long.coefficients.clone();
        for (x, y) in sum.iter_mut().zip(&short.coefficients) {
            *x = x.add(y);
        }
        Self::new(sum)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let mut product = vec![R::zero(); self.coefficients.len() + other.coefficients.len() - 1];
        for (i, x) in self.coefficients.iter().enumerate() {
            for (j, y) in other.coefficients.iter().enumerate() {
                product[i + j] = product[i + j].add(&x.mul(y));
            }
        }
        Self::new(product)
    }
    fn neg(&self) -> Self {
        Self { coefficients: self.coefficients.iter().map(Ring::neg).collect() }
    }
    fn is_zero(&self) -> bool {
        self.coefficients.is_empty()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        R::from_rational(q).map(Self::constant)
    }
}

impl<F: Field + Domain> Domain for Univariate<F> {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        if other.is_zero() {
            return None;
        }
        let (quotient, remainder) = self.div_rem(other);
        remainder.is_zero().then_some(quotient)
    }
}
