//! Algebraic numbers: polynomials modulo a square-free polynomial, by dynamic evaluation.
//!
//! The modulus need not be irreducible. If an element turns out to be zero at some of its roots and not at others, the
//! field remembers the factor that separates them. The computation is then void, and is repeated over each factor.
//! Results of a computation without such an element hold at every root alike.

use super::ring::{Domain, Field, Ring};
use super::univariate::Univariate;
use rug::{Float, Integer, Rational};
use std::sync::{Arc, OnceLock};

/// `Q[t]/f` for a square-free polynomial f.
#[derive(Debug)]
pub struct NumberField {
    /// Monic with integer coefficients, the minimal polynomial of `leading * t`.
    modulus: Vec<Integer>,
    /// The leading coefficient of the primitive integer polynomial that t is a root of.
    leading: Integer,
    /// A proper factor of the modulus, once one is found.
    split: OnceLock<Univariate<Rational>>,
}

/// A number of a [`NumberField`], or a rational one, which belongs to all of them.
#[derive(Clone, Debug)]
pub struct Algebraic {
    /// Coefficients of the powers of `leading * t`, the last one not zero; without common factor with the denominator.
    numerator: Vec<Integer>,
    /// The denominator, which is positive.
    denominator: Integer,
    field: Option<Arc<NumberField>>,
}

impl NumberField {
    /// Returns the field of a root t of a square-free polynomial.
    ///
    /// # Panics
    /// When the polynomial is constant.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::{number_field::NumberField, ring::{Field, Ring}, univariate::Univariate};
    /// use rug::Rational;
    ///
    /// // (t^2 - 2)(t - 3)
    /// let modulus = Univariate::new([6, -2, -3, 1].map(Rational::from).to_vec());
    /// let field = NumberField::new(&modulus);
    /// let t = field.root();
    /// let x = t.mul(&t).sub(&Ring::from_integer(2));
    /// // Zero at two roots and not at the third: no inverse, but a factor.
    /// assert!(x.inverse().is_none());
    /// assert_eq!(field.split().unwrap().degree(), Some(2));
    /// ```
    #[must_use]
    pub fn new(polynomial: &Univariate<Rational>) -> Arc<Self> {
        assert!(polynomial.degree() > Some(0), "a constant has no root");
        let mut integers = polynomial.primitive_integers();
        let leading = integers.pop().expect("not constant");
        // (leading t)^k has the coefficient a_k leading^(d-1-k).
        let mut power = Integer::from(1);
        for c in integers.iter_mut().rev() {
            *c *= &power;
            power *= &leading;
        }
        integers.push(Integer::from(1));
        Arc::new(Self { modulus: integers, leading, split: OnceLock::new() })
    }

    /// Returns the root t.
    #[must_use]
    pub fn root(self: &Arc<Self>) -> Algebraic {
        let numerator = if self.modulus.len() == 2 {
            vec![Integer::from(-&self.modulus[0])]
        } else {
            vec![Integer::new(), Integer::from(1)]
        };
        Algebraic { numerator, denominator: self.leading.clone(), field: Some(self.clone()) }.reduced()
    }

    /// Returns a proper factor of the polynomial of t, if one was found: all results since are void.
    #[must_use]
    pub fn split(&self) -> Option<&Univariate<Rational>> {
        self.split.get()
    }

    fn polynomial(&self) -> Univariate<Rational> {
        Univariate::new(self.modulus.iter().map(Rational::from).collect())
    }

    /// Remembers a factor, given in `leading * t`.
    fn remember(&self, factor: &Univariate<Rational>) {
        let mut power = Rational::from(1);
        let mut coefficients = Vec::new();
        for c in factor.coefficients() {
            coefficients.push(Rational::from(c * &power));
            power *= &self.leading;
        }
        // One factor is enough.
        let _ = self.split.set(Univariate::new(coefficients).normalise());
    }

    /// The coefficients of a product or sum, reduced by the modulus.
    fn reduce(&self, coefficients: &mut Vec<Integer>) {
        let degree = self.modulus.len() - 1;
        while coefficients.len() > degree {
            let Some(top) = coefficients.pop() else { break };
            let shift = coefficients.len() - degree;
            for (x, c) in coefficients[shift..].iter_mut().zip(&self.modulus) {
                *x -= &top * c;
            }
        }
    }
}

impl Algebraic {
    /// Reduces to lowest terms.
    fn reduced(mut self) -> Self {
        while self.numerator.last().is_some_and(|c| *c == 0) {
            self.numerator.pop();
        }
        if self.numerator.is_empty() {
            self.denominator = Integer::from(1);
            return self;
        }
        if self.denominator == 1 {
            return self;
        }
        let mut common = self.denominator.clone();
        for c in &self.numerator {
            if common == 1 {
                break;
            }
            common.gcd_mut(c);
        }
        if self.denominator < 0 {
            common = -common;
        }
        if common != 1 {
            self.denominator.div_exact_mut(&common);
            for c in &mut self.numerator {
                c.div_exact_mut(&common);
            }
        }
        self
    }

    /// Returns the field of two operands.
    fn field_with(&self, other: &Self) -> Option<Arc<NumberField>> {
        self.field.as_ref().or(other.field.as_ref()).cloned()
    }

    /// Returns `self + sign other`.
    fn combined(&self, other: &Self, plus: bool) -> Self {
        let common = Integer::from(self.denominator.gcd_ref(&other.denominator));
        let own = Integer::from(other.denominator.div_exact_ref(&common));
        let mut others = Integer::from(self.denominator.div_exact_ref(&common));
        let denominator = Integer::from(&self.denominator * &own);
        if !plus {
            others = -others;
        }
        let mut numerator: Vec<Integer> = self.numerator.iter().map(|c| Integer::from(c * &own)).collect();
        for (k, c) in other.numerator.iter().enumerate() {
            if k == numerator.len() {
                numerator.push(Integer::new());
            }
            numerator[k] += c * &others;
        }
        Self { numerator, denominator, field: self.field_with(other) }.reduced()
    }

    /// Returns the product, not in lowest terms.
    fn product(&self, other: &Self) -> Self {
        let field = self.field_with(other);
        if self.numerator.is_empty() || other.numerator.is_empty() {
            return Self { field, ..Self::zero() };
        }
        let mut numerator = vec![Integer::new(); self.numerator.len() + other.numerator.len() - 1];
        for (i, x) in self.numerator.iter().enumerate() {
            for (j, y) in other.numerator.iter().enumerate() {
                numerator[i + j] += x * y;
            }
        }
        if let Some(field) = &field {
            field.reduce(&mut numerator);
        }
        Self { numerator, denominator: Integer::from(&self.denominator * &other.denominator), field }
    }

    /// Returns the same number at the roots of another polynomial, a factor of that of its own field.
    #[must_use]
    pub fn over(&self, field: &Arc<NumberField>) -> Self {
        let Some(own) = &self.field else { return self.clone() };
        // In powers of t, and by Horner's rule in those of the new root.
        let root = field.root().mul(&Self::from_integer_big(&own.leading));
        let horner = |value: Self, c: &Integer| value.mul(&root).add(&Self::from_integer_big(c));
        let numerator = self.numerator.iter().rev().fold(Self::zero(), horner);
        let denominator = numerator.denominator * &self.denominator;
        Self { numerator: numerator.numerator, denominator, field: Some(field.clone()) }.reduced()
    }

    fn from_integer_big(n: &Integer) -> Self {
        Self { numerator: vec![n.clone()], denominator: Integer::from(1), field: None }.reduced()
    }

    /// Returns the number as a polynomial in t.
    #[must_use]
    pub fn polynomial(&self) -> Univariate<Rational> {
        let mut power = Rational::from((Integer::from(1), self.denominator.clone()));
        let mut coefficients = Vec::with_capacity(self.numerator.len());
        for c in &self.numerator {
            coefficients.push(Rational::from(c * &power));
            if let Some(field) = &self.field {
                power *= &field.leading;
            }
        }
        Univariate::new(coefficients)
    }

    /// Coefficients of the powers of `leading t`, with leading the leading coefficient of the polynomial of t over the integers, and
    /// their denominator, in lowest terms.
    #[must_use]
    pub fn parts(&self) -> (&[Integer], &Integer) {
        (&self.numerator, &self.denominator)
    }

    /// Returns the value as a rational number, if it is one.
    #[must_use]
    pub fn rational(&self) -> Option<Rational> {
        match self.numerator.as_slice() {
            [] => Some(Rational::new()),
            [c] => Some(Rational::from((c, &self.denominator))),
            _ => None,
        }
    }

    /// Returns the coefficients of the powers of t.
    #[must_use]
    pub fn coefficients(&self) -> Vec<Rational> {
        let one = Integer::from(1);
        let leading = self.field.as_ref().map_or(&one, |field| &field.leading);
        let mut power = Integer::from(1);
        let mut coefficients = Vec::new();
        for c in &self.numerator {
            coefficients.push(Rational::from((Integer::from(c * &power), &self.denominator)));
            power *= leading;
        }
        coefficients
    }

    /// Returns the value for this value of t.
    #[must_use]
    pub fn at(&self, t: &Float) -> Float {
        let bits = t.prec();
        let one = Integer::from(1);
        let leading = self.field.as_ref().map_or(&one, |field| &field.leading);
        let u = Float::with_val(bits, t * leading);
        let horner = |value: Float, c: &Integer| value * &u + c;
        self.numerator.iter().rev().fold(Float::new(bits), horner) / &self.denominator
    }
}

impl PartialEq for Algebraic {
    fn eq(&self, other: &Self) -> bool {
        self.numerator == other.numerator && self.denominator == other.denominator
    }
}

impl Ring for Algebraic {
    fn zero() -> Self {
        Self { numerator: Vec::new(), denominator: Integer::from(1), field: None }
    }
    fn one() -> Self {
        Self { numerator: vec![Integer::from(1)], denominator: Integer::from(1), field: None }
    }
    fn add(&self, other: &Self) -> Self {
        self.combined(other, true)
    }
    fn sub(&self, other: &Self) -> Self {
        self.combined(other, false)
    }
    fn mul(&self, other: &Self) -> Self {
        self.product(other).reduced()
    }
    fn neg(&self) -> Self {
        let numerator = self.numerator.iter().map(|c| Integer::from(-c)).collect();
        Self { numerator, denominator: self.denominator.clone(), field: self.field.clone() }
    }
    fn is_zero(&self) -> bool {
        self.numerator.is_empty()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let (numerator, denominator) = (vec![q.numer().clone()], q.denom().clone());
        Some(Self { numerator, denominator, field: None }.reduced())
    }
}

impl Domain for Algebraic {
    fn checked_div_exact(&self, other: &Self) -> Option<Self> {
        Some(self.mul(&other.inverse()?))
    }
}

impl Field for Algebraic {
    /// Returns `None` for zero, and for an element that is zero at some roots only, which gives the field a factor.
    fn inverse(&self) -> Option<Self> {
        if let Some(q) = self.rational() {
            let inverse = Self::from_rational(&q.inverse()?)?;
            return Some(Self { field: self.field.clone(), ..inverse });
        }
        let field = self.field.as_ref()?;
        // Euclid: the remainder is the cofactor times the numerator, modulo the modulus.
        let mut above = (field.polynomial(), Univariate::zero());
        let mut rest = (Univariate::new(self.numerator.iter().map(Rational::from).collect()), Univariate::one());
        while rest.0.degree() > Some(0) {
            let (quotient, remainder) = above.0.div_rem(&rest.0);
            let cofactor = above.1.sub(&quotient.mul(&rest.1));
            (above, rest) = (rest, (remainder, cofactor));
        }
        let Some(constant) = rest.0.coefficients().first() else {
            field.remember(&above.0);
            return None;
        };
        let scale = Rational::from(&self.denominator) / constant;
        let cofactor = rest.1.scale(&scale);
        let mut denominator = Integer::from(1);
        for c in cofactor.coefficients() {
            denominator.lcm_mut(c.denom());
        }
        let whole = |c: &Rational| Integer::from(denominator.div_exact_ref(c.denom())) * c.numer();
        let numerator = cofactor.coefficients().iter().map(whole).collect();
        Some(Self { numerator, denominator, field: Some(field.clone()) }.reduced())
    }
    fn pivot_size(&self) -> f64 {
        if self.is_zero() { 0.0 } else { 1.0 }
    }
    const PIVOT_ZERO: f64 = 0.0;
}
