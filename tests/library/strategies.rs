//! Random inputs of the laws: numbers, expressions, polynomials, matrices and motions.
#![allow(dead_code, reason = "shared by several test files")]

use looproot_algebra::{dual::Dual, modp::ModP, ring::Ring, univariate::Univariate};
use num_bigint::BigInt;
use num_complex::Complex;
use num_rational::Ratio;
use proptest::prelude::*;
use rug::{Integer, Rational};

/// Small rationals, zero and integers among them often.
pub fn rational() -> impl Strategy<Value = Rational> {
    prop_oneof![
        3 => (-999_i32..1000, 1_i32..1000).prop_map(|(n, d)| Rational::from((n, d))),
        2 => (-9_i32..10).prop_map(Rational::from),
    ]
}

/// An expression in one variable.
#[derive(Clone, Debug)]
pub enum Expression {
    /// The variable.
    Variable,
    /// A number.
    Number(Rational),
    /// `-a`
    Neg(Box<Expression>),
    /// `a + b`
    Add(Box<Expression>, Box<Expression>),
    /// `a - b`
    Sub(Box<Expression>, Box<Expression>),
    /// `a b`
    Mul(Box<Expression>, Box<Expression>),
}

impl Expression {
    /// The value over any ring; `None` if a number has no image there.
    #[must_use]
    pub fn evaluate<R: Ring>(&self, x: &R) -> Option<R> {
        Some(match self {
            Self::Variable => x.clone(),
            Self::Number(q) => R::from_rational(q)?,
            Self::Neg(a) => a.evaluate(x)?.neg(),
            Self::Add(a, b) => a.evaluate(x)?.add(&b.evaluate(x)?),
            Self::Sub(a, b) => a.evaluate(x)?.sub(&b.evaluate(x)?),
            Self::Mul(a, b) => a.evaluate(x)?.mul(&b.evaluate(x)?),
        })
    }

    /// The value with every term taken positive: the scale of its rounding errors.
    #[must_use]
    pub fn majorant(&self, x: f64) -> f64 {
        match self {
            Self::Variable => x.abs(),
            Self::Number(q) => q.to_f64().abs(),
            Self::Neg(a) => a.majorant(x),
            Self::Add(a, b) | Self::Sub(a, b) => a.majorant(x) + b.majorant(x),
            Self::Mul(a, b) => a.majorant(x) * b.majorant(x),
        }
    }
}

/// Expressions of up to some twenty operations.
pub fn expression() -> impl Strategy<Value = Expression> {
    let leaf = prop_oneof![Just(Expression::Variable), rational().prop_map(Expression::Number)];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let pair = || (inner.clone().prop_map(Box::new), inner.clone().prop_map(Box::new));
        prop_oneof![
            inner.clone().prop_map(|a| Expression::Neg(Box::new(a))),
            pair().prop_map(|(a, b)| Expression::Add(a, b)),
            pair().prop_map(|(a, b)| Expression::Sub(a, b)),
            pair().prop_map(|(a, b)| Expression::Mul(a, b)),
        ]
    })
}

/// Finite doubles of every size.
pub fn double() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => any::<f64>().prop_filter("finite", |x| x.is_finite()),
        3 => -1e3..1e3,
        2 => (-20_i32..20).prop_map(f64::from),
        1 => (-40_i32..40, -1e3..1e3).prop_map(|(e, x): (i32, f64)| x * 2_f64.powi(e)),
    ]
}

/// Polynomials with at most `len` coefficients.
pub fn polynomial(len: usize) -> impl Strategy<Value = Univariate<Rational>> {
    prop::collection::vec(rational(), 0..=len).prop_map(Univariate::new)
}

/// Polynomials other than zero.
pub fn nonzero_polynomial(len: usize) -> impl Strategy<Value = Univariate<Rational>> {
    polynomial(len).prop_filter("not zero", |p| !p.is_zero())
}

/// The polynomial with the given coefficients, constant term first.
#[must_use]
pub fn integers(coefficients: &[i32]) -> Univariate<Rational> {
    Univariate::new(coefficients.iter().map(|&c| Rational::from(c)).collect())
}

/// Matrices of rationals, singular ones among them.
pub fn matrix<const R: usize, const C: usize>() -> impl Strategy<Value = [[Rational; C]; R]> {
    let small = (-3_i32..4).prop_map(Rational::from);
    let entry = prop_oneof![2 => rational().boxed(), 3 => small.boxed(), 1 => Just(Rational::new()).boxed()];
    prop::collection::vec(entry, R * C)
        .prop_map(|v| std::array::from_fn(|i| std::array::from_fn(|j| v[i * C + j].clone())))
}

/// Elements of a ring built from rationals.
pub trait Sample: Ring {
    /// An element; several rationals so that composite rings get more than images of rationals.
    #[must_use]
    fn sample(q: &[Rational; 4]) -> Self;
}

impl Sample for Rational {
    fn sample(q: &[Rational; 4]) -> Self {
        q[0].clone()
    }
}

impl Sample for Integer {
    fn sample(q: &[Rational; 4]) -> Self {
        q[0].numer().clone()
    }
}

impl Sample for Ratio<BigInt> {
    fn sample(q: &[Rational; 4]) -> Self {
        Self::from_rational(&q[0]).expect("every rational has an image")
    }
}

impl<const P: u64> Sample for ModP<P> {
    fn sample(q: &[Rational; 4]) -> Self {
        Self::from_rational(&q[0]).expect("the denominators are far below the primes")
    }
}

impl<R: Sample> Sample for Dual<R> {
    fn sample([a, b, c, d]: &[Rational; 4]) -> Self {
        let swapped = [c.clone(), d.clone(), a.clone(), b.clone()];
        Self { value: R::sample(&[a.clone(), b.clone(), c.clone(), d.clone()]), epsilon: R::sample(&swapped) }
    }
}

impl<R: Sample> Sample for Complex<R> {
    fn sample(q: &[Rational; 4]) -> Self {
        let dual = Dual::<R>::sample(q);
        Self { re: dual.value, im: dual.epsilon }
    }
}

impl<R: Sample> Sample for Univariate<R> {
    fn sample(q: &[Rational; 4]) -> Self {
        let turned = |k: usize| R::sample(&std::array::from_fn(|i| q[(i + k) % 4].clone()));
        Self::new((0..4).map(turned).collect())
    }
}

/// Ring elements.
pub fn element<R: Sample>() -> impl Strategy<Value = R> {
    [rational(), rational(), rational(), rational()].prop_map(|q| R::sample(&q))
}
