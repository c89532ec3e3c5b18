//! Curves of moving and fixed points: the circle points and centre points of four positions in the plane, and the cones of
//! axes of four positions on the sphere.
//!
//! The equations of a dyad are linear in its fixed point and in its moving one. A point of one body belongs to a dyad where
//! the coefficients of the other one's coordinates and of 1 have a determinant of 0.

use super::cells::Place;
use super::equations::Wanted;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::{DyadKind, Space};
use rug::{Integer, Rational};
use std::fmt::Write;

/// A polynomial in x and y: coefficients of the powers of y, each a polynomial in x.
type Plane = Univariate<Univariate<Rational>>;

/// A curve in the coordinates of one body.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The kind of the points: `moving` or `fixed`.
    pub of: &'static str,
    /// The name of its points.
    pub name: &'static str,
    /// Its degree.
    pub degree: usize,
    /// Its terms, those of the highest degree first: the exponents of x and y, and an integer; without common factor, the first
    /// one positive. On the sphere x and y are the first two components of an axis whose third one is 1.
    pub terms: Vec<([usize; 2], Integer)>,
}

impl Curve {
    /// The polynomial as text.
    #[must_use]
    pub fn polynomial(&self) -> String {
        let mut text = String::new();
        for ([x, y], coefficient) in &self.terms {
            let power = |name: &str, exponent: usize| match exponent {
                0 => String::new(),
                1 => format!("*{name}"),
                _ => format!("*{name}^{exponent}"),
            };
            let factors = power("x", *x) + &power("y", *y);
            let size = Integer::from(coefficient.abs_ref());
            let sign = if *coefficient < 0 { "-" } else { "+" };
            let term = match factors.strip_prefix('*') {
                Some(factors) if size == 1 => factors.to_owned(),
                _ => format!("{size}{factors}"),
            };
            if text.is_empty() {
                let _ = write!(text, "{}{term}", if sign == "-" { "-" } else { "" });
            } else {
                let _ = write!(text, " {sign} {term}");
            }
        }
        text
    }

    /// The exact value at a point.
    #[cfg(test)]
    pub(super) fn exact(&self, x: &Rational, y: &Rational) -> Rational {
        let power =
            |base: &Rational, exponent: usize| (0..exponent).fold(Rational::from(1), |product, _| product * base);
        self.terms.iter().map(|([i, j], c)| power(x, *i) * power(y, *j) * c).sum()
    }

    /// The value at a point.
    #[must_use]
    pub fn value(&self, x: f64, y: f64) -> f64 {
        let power = |base: f64, exponent: usize| base.powi(i32::try_from(exponent).unwrap_or(i32::MAX));
        self.terms.iter().map(|([i, j], c)| c.to_f64() * power(x, *i) * power(y, *j)).sum()
    }
}

/// The curves of moving and fixed points, where there are any: with four different positions in the plane or on the sphere.
pub(super) fn curves(wanted: &Wanted) -> Vec<Curve> {
    let (names, is_sphere) = match (wanted.kind, wanted.space) {
        (DyadKind::RR, Space::Plane) => (["circle points", "centre points"], false),
        (DyadKind::RR, Space::Sphere) => (["moving axes", "fixed axes"], true),
        _ => return Vec::new(),
    };
    let [x, y] = [Plane::constant(Univariate::x()), Plane::x()];
    let mut curves = Vec::new();
    for (of, name, is_moving) in [("moving", names[0], true), ("fixed", names[1], false)] {
        // The other body's point stands at 0 and at the unit points: the values there are the coefficients.
        let at = |other: [i32; 3]| {
            let own = [x.clone(), y.clone(), Plane::one()];
            let other = other.map(Plane::from_integer);
            let [fixed, moving] = if is_moving { [other, own] } else { [own, other] };
            let place = if is_sphere {
                Place { directions: vec![fixed.to_vec(), moving.to_vec()], numbers: Vec::new() }
            } else {
                Place { directions: Vec::new(), numbers: [&fixed[..2], &moving[..2]].concat() }
            };
            wanted.equations(&place)
        };
        let [first, second, third] =
            if is_sphere { [[1, 0, 0], [0, 1, 0], [0, 0, 1]] } else { [[1, 0, 0], [0, 1, 0], [0; 3]] };
        let [a, b, c] = [at(first), at(second), at(third)];
        if a.len() != 3 {
            return Vec::new();
        }
        // In the plane the values at the unit points are those at 0 more than the coefficients, which no determinant notices.
        let determinant = (0..3).fold(Plane::zero(), |sum, i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            sum.add(&a[i].mul(&b[j].mul(&c[k]).sub(&b[k].mul(&c[j]))))
        });
        curves.extend(curve(of, name, &determinant));
    }
    curves
}

/// The curve of a polynomial; `None` where it vanishes everywhere or is a constant.
fn curve(of: &'static str, name: &'static str, polynomial: &Plane) -> Option<Curve> {
    let mut terms: Vec<([usize; 2], Rational)> = Vec::new();
    for (j, row) in polynomial.coefficients().iter().enumerate() {
        for (i, c) in row.coefficients().iter().enumerate().filter(|(_, c)| **c != 0) {
            terms.push(([i, j], c.clone()));
        }
    }
    crate::algebra::sort::by_key(&mut terms, |([i, j], _)| std::cmp::Reverse((i + j, *i)));
    let ([i, j], first) = terms.first()?;
    let degree = i + j;
    if degree == 0 {
        return None;
    }
    let denominator = terms.iter().fold(Integer::from(1), |lcm, (_, c)| lcm.lcm(c.denom()));
    let whole = |c: &Rational| Integer::from(&denominator / c.denom()) * c.numer();
    let content = terms.iter().fold(Integer::new(), |gcd, (_, c)| gcd.gcd(&whole(c)));
    let content = if *first < 0 { -content } else { content };
    let terms = terms.iter().map(|(exponents, c)| (*exponents, whole(c).div_exact(&content))).collect();
    Some(Curve { of, name, degree, terms })
}
