//! A closure polynomial over the integers, with all provable properties of its roots.

use super::pose::RootPose;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::real_roots::RealRoot;
use crate::algebra::univariate::Univariate;
use crate::error::{Error, Result};
use rug::{Integer, Rational};

/// A closure polynomial in one variable.
#[derive(Clone, Debug)]
pub struct ClosurePolynomial {
    /// The index of the variable.
    pub variable: usize,
    /// Integers without common factor, constant term first, the last one positive.
    pub coefficients: Univariate<Integer>,
    /// The factors divided out.
    pub removed: Vec<Removed>,
    /// Number of roots at infinity, where the angle is pi.
    pub at_pi: usize,
    /// Degree and multiplicity of the square-free factors.
    pub factors: Vec<(usize, usize)>,
    /// The distinct finite real roots, isolated.
    pub roots: Vec<Root>,
}

/// A factor of an elimination's result whose roots belong to no solution.
#[derive(Clone, Debug, PartialEq)]
pub struct Removed {
    /// The factor, square-free, integers without common factor; `None` for roots at infinity.
    pub factor: Option<Polynomial<Rational>>,
    /// The multiplicity with which it was divided out.
    pub multiplicity: usize,
    /// The reason why its roots belong to no solution.
    pub reason: String,
}

/// A real root.
#[derive(Clone, Debug, PartialEq)]
pub struct Root {
    /// The number itself if an evaluation hit it, else the nearest float.
    pub value: f64,
    /// The exact root if it is known to be rational.
    pub exact: Option<Rational>,
    /// Its multiplicity.
    pub multiplicity: usize,
    /// The real poses at it, for a platform.
    pub poses: Vec<RootPose>,
}

impl Root {
    fn of(mut root: RealRoot) -> Self {
        Self { value: root.to_f64(), exact: root.exact(), multiplicity: root.multiplicity(), poses: Vec::new() }
    }
}

/// The meaning of the variable of a polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Meaning {
    /// The half-angle tangent in a polynomial that would have this degree if no root were at infinity.
    HalfTangent { degree: usize },
    /// Any other variable.
    Plain,
}

/// The result of an elimination: the coefficients, constant term first, of a polynomial without factors `1 + t^2`, the number of
/// further roots at infinity, and the factors divided out.
pub(super) struct Eliminant {
    pub coefficients: Univariate<Integer>,
    pub at_pi: usize,
    pub removed: Vec<Removed>,
}

impl Eliminant {
    /// Returns the number of roots with multiplicity, including the angle pi.
    pub fn roots(&self) -> usize {
        self.coefficients.degree().unwrap_or(0) + self.at_pi
    }

    /// Returns the polynomial without factors `1 + t^2`; `None` for zero. Other factors are `removed` already.
    pub fn of(variable: usize, integers: Vec<Integer>, meaning: Meaning, mut removed: Vec<Removed>) -> Option<Self> {
        let mut coefficients = Univariate::new(integers);
        let degree = coefficients.degree()?;
        let mut at_pi = 0;
        if let Meaning::HalfTangent { degree: full } = meaning {
            let factor = Univariate::circle();
            let mut multiplicity = 0;
            while let Some(quotient) = coefficients.quotient(&factor) {
                (coefficients, multiplicity) = (quotient, multiplicity + 1);
            }
            if multiplicity > 0 {
                let factor = Some(over_rationals(variable, &factor));
                let reason = "no angle has the half-angle tangent i".to_owned();
                removed.insert(0, Removed { factor, multiplicity, reason });
            }
            at_pi = full.saturating_sub(degree);
        }
        Some(Self { coefficients, at_pi, removed })
    }
}

impl ClosurePolynomial {
    /// Proves all properties of an eliminant.
    ///
    /// # Errors
    /// If isolation and Sturm's theorem disagree on the number of real roots, which would be a fault of the program.
    pub(super) fn of(variable: usize, Eliminant { coefficients, at_pi, removed }: Eliminant) -> Result<Self> {
        let coefficients = coefficients.primitive_part();
        let factors = coefficients.square_free_decomposition();
        let factors = factors.iter().filter_map(|(factor, k)| Some((factor.degree()?, *k))).collect();
        let roots: Vec<Root> = coefficients.real_roots().into_iter().map(Root::of).collect();
        let counted = coefficients.distinct_real_roots();
        if counted != roots.len() {
            let isolated = roots.len();
            return Err(Error::Invalid(format!("{isolated} real roots isolated, {counted} by Sturm's theorem")));
        }
        Ok(Self { variable, coefficients, removed, at_pi, factors, roots })
    }

    /// Returns the degree.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.coefficients.degree().unwrap_or(0)
    }

    /// Returns the number of distinct complex roots.
    #[must_use]
    pub fn distinct(&self) -> usize {
        self.factors.iter().map(|(degree, _)| degree).sum()
    }

    /// Returns the sign of the discriminant, 0 with multiple roots: for square-free polynomials of degree n with r real roots
    /// it is `(-1)^((n - r)/2)`. `None` for constants.
    #[must_use]
    pub fn discriminant_sign(&self) -> Option<i32> {
        if self.degree() == 0 {
            return None;
        }
        if self.distinct() < self.degree() {
            return Some(0);
        }
        let pairs = (self.degree() - self.roots.len()) / 2;
        Some(if pairs.is_multiple_of(2) { 1 } else { -1 })
    }

    /// Converts to a polynomial in its variable.
    #[must_use]
    pub fn to_polynomial(&self) -> Polynomial<Rational> {
        over_rationals(self.variable, &self.coefficients)
    }
}

pub(super) fn over_rationals(variable: usize, coefficients: &Univariate<Integer>) -> Polynomial<Rational> {
    let image: Vec<Rational> = coefficients.coefficients().iter().map(Rational::from).collect();
    Polynomial::from_univariate(variable, &Univariate::new(image))
}
