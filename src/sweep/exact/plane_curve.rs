//! A polynomial in the input s and an output t over the integers, and what can be proved of it on an interval and in a
//! rectangle.

use super::relation::InOutput;
use crate::algebra::circle_fraction::CircleFraction;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::univariate::Univariate;
use rug::{Integer, Rational};
use std::cmp::Ordering;

/// The variables of polynomials in input and output.
pub(in crate::internal::sweep) const S: usize = 0;
/// The output.
pub(in crate::internal::sweep) const T: usize = 1;

/// A polynomial by powers of the output.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::internal::sweep) struct PlaneCurve {
    /// The coefficient of `t^k` at k.
    rows: Vec<Univariate<Integer>>,
}

/// A rectangle: its centre and half its sides, along s and t.
#[derive(Clone, Debug)]
pub(super) struct Rectangle {
    pub centre: [Rational; 2],
    pub reach: [Rational; 2],
}

impl Rectangle {
    /// The rectangle over an interval about two places, a multiple of their distance high.
    pub fn over([low, high]: [&Rational; 2], [x, y]: [&Rational; 2], height: i32) -> Self {
        let half = |a: &Rational, b: &Rational| Rational::from(a + b) / 2;
        let rise = Rational::from(y - x).abs() * height;
        // Beyond rounding, where both places are the same.
        let margin = (Rational::from(x.abs_ref()) + 1) / 100_000_000_i32;
        let centre = [half(low, high), half(x, y)];
        Self { centre, reach: [Rational::from(high - low) / 2, rise + margin] }
    }
}

/// `1 + x^2`
fn circle(variable: usize) -> Polynomial<Int> {
    let x = Polynomial::<Int>::variable(variable);
    x.mul(&x).add(&Polynomial::one())
}

/// A relation as a polynomial with integer coefficients.
#[derive(Clone, Debug)]
pub(super) struct Integral {
    /// Without factors `1 + s^2` and `1 + t^2`, which have no real roots.
    pub polynomial: Polynomial<Int>,
    /// Its degree in the half tangent of the input, unless it vanishes where that is infinite.
    pub full_degree: usize,
    /// Whether it is known to vanish at half a turn of the output, whatever the input.
    pub is_half_turn: bool,
}

impl Integral {
    /// A polynomial that is, or is not, zero for all outputs where the half tangent of the input is infinite, and that as a
    /// form has half a turn of the output so often for a zero.
    pub fn of_form(polynomial: Polynomial<Int>, is_finite: bool, half_turns: usize) -> Self {
        let full_degree = polynomial.degree(S) as usize + usize::from(!is_finite);
        let mut found = Self { polynomial, full_degree, is_half_turn: half_turns > 0 };
        found.remove_circles();
        found
    }

    /// Divides by factors that have no real zero.
    fn remove_circles(&mut self) {
        for variable in [S, T] {
            while let Some(quotient) = self.polynomial.checked_div_exact(&circle(variable)) {
                self.polynomial = quotient;
                self.full_degree -= if variable == S { 2.min(self.full_degree) } else { 0 };
            }
        }
    }

    /// Whether it is not zero for all outputs where the half tangent of the input is infinite.
    pub fn is_finite(&self) -> bool {
        self.polynomial.degree(S) as usize == self.full_degree
    }
}

/// A relation over the integers.
pub(super) fn integral(relation: &InOutput) -> Integral {
    let power = relation.coefficients().iter().map(CircleFraction::power).max().unwrap_or(0);
    let terms = relation.coefficients().iter().zip(0_u32..).flat_map(|(coefficient, t)| {
        let numerator = coefficient.over(power);
        let term = |(c, s): (&Rational, u32)| (vec![s, t], c.clone());
        numerator.coefficients().iter().zip(0..).map(term).collect::<Vec<_>>()
    });
    let polynomial = Polynomial::from_terms(terms);
    if polynomial.is_zero() {
        return Integral { polynomial: Polynomial::zero(), full_degree: 0, is_half_turn: true };
    }
    let full_degree = 2 * power as usize;
    let mut found = Integral { polynomial: polynomial.primitive().0, full_degree, is_half_turn: false };
    found.remove_circles();
    found
}

/// The integral polynomial of a form of a certain degree in the output.
pub(super) fn integral_form(relation: &InOutput, degree: usize) -> Integral {
    let is_half_turn = relation.degree().is_none_or(|own| own < degree);
    Integral { is_half_turn, ..integral(relation) }
}

/// A polynomial in one variable over the integers.
pub(super) fn in_one(polynomial: &Polynomial<Int>, variable: usize) -> Univariate<Integer> {
    let converted = polynomial.to_univariate(variable).and_then(|p| p.map(|c| Some(c.to_integer())));
    converted.unwrap_or_else(Univariate::zero)
}

impl PlaneCurve {
    pub fn of(polynomial: &Polynomial<Int>) -> Self {
        Self { rows: polynomial.coefficients_in(T).iter().map(|row| in_one(row, S)).collect() }
    }

    /// Adds half a turn of the output as a zero at every input.
    pub fn with_half_turn(mut self) -> Self {
        self.rows.push(Univariate::zero());
        self
    }

    /// The coefficient of `t^k`.
    pub fn coefficient(&self, k: usize) -> Univariate<Integer> {
        self.rows.get(k).cloned().unwrap_or_else(Univariate::zero)
    }

    /// The sign of the coefficient of `t^k` at an input.
    pub fn sign_of(&self, k: usize, s: &Rational) -> Ordering {
        self.rows.get(k).map_or(Ordering::Equal, |row| row.sign_at(s))
    }

    /// A polynomial in the input alone.
    pub fn of_input(polynomial: &Univariate<Integer>) -> Self {
        Self { rows: vec![polynomial.clone()] }
    }

    /// The degree in the output.
    pub fn degree(&self) -> usize {
        self.rows.len().saturating_sub(1)
    }

    /// The degree in the input.
    pub fn input_degree(&self) -> usize {
        self.rows.iter().filter_map(Univariate::degree).max().unwrap_or(0)
    }

    /// Returns the curve in `-1/s`: half tangents of the input less half a turn.
    pub fn half_turned(&self) -> Self {
        let degree = self.input_degree();
        let turned = |row: &Univariate<Integer>| {
            let mut turned = vec![Integer::new(); degree + 1];
            for (i, c) in row.coefficients().iter().enumerate() {
                turned[degree - i] = if i % 2 == 1 { Integer::from(-c) } else { c.clone() };
            }
            Univariate::new(turned)
        };
        Self { rows: self.rows.iter().map(turned).collect() }
    }

    /// Returns the curve in half tangents of the input counted from an angle with this half tangent h, up to a factor: `(x + h) /
    /// (1 - h x)` replaces s.
    pub fn counted_from(&self, h: &Rational) -> Self {
        let degree = self.input_degree();
        if h.is_zero() {
            return self.clone();
        }
        let [over, under] =
            [[h.clone(), Rational::from(1)], [Rational::from(1), -h.clone()]].map(|c| Univariate::new(c.to_vec()));
        let counted = |row: &Univariate<Integer>| {
            let mut power = Univariate::one();
            let mut sum: Univariate<Rational> = Univariate::zero();
            // From the highest power on: sum = sum over + c under^(degree - i).
            for i in (0..=degree).rev() {
                let c = row.coefficients().get(i).map(Rational::from).unwrap_or_default();
                sum = sum.mul(&over).add(&power.scale(&c));
                power = power.mul(&under);
            }
            sum
        };
        Self::over_rationals(&self.rows.iter().map(counted).collect::<Vec<_>>())
    }

    /// Scales to integer coefficients without common factor.
    fn over_rationals(rows: &[Univariate<Rational>]) -> Self {
        let lengths: Vec<usize> = rows.iter().map(|row| row.coefficients().len()).collect();
        let all: Vec<Rational> = rows.iter().flat_map(|row| row.coefficients().iter().cloned()).collect();
        let mut common = Integer::from(1);
        for c in &all {
            common.lcm_mut(c.denom());
        }
        let mut whole: Vec<Integer> = all.iter().map(|c| Rational::from(c * &common).numer().clone()).collect();
        let content = whole.iter().fold(Integer::new(), Integer::gcd);
        if content > 1 {
            for c in &mut whole {
                c.div_exact_mut(&content);
            }
        }
        let mut rest = whole.into_iter();
        Self { rows: lengths.iter().map(|length| Univariate::new(rest.by_ref().take(*length).collect())).collect() }
    }

    /// As a polynomial in input and output.
    pub fn polynomial(&self) -> Polynomial<Int> {
        let terms = self.rows.iter().zip(0_u32..).flat_map(|(row, t)| {
            let term = move |(c, s): (&Integer, u32)| (vec![s, t], Int::from(c.clone()));
            row.coefficients().iter().zip(0..).map(term).collect::<Vec<_>>()
        });
        Polynomial::from_terms(terms)
    }

    /// Returns the curve in `1/t`.
    pub fn inverted(&self) -> Self {
        Self { rows: self.rows.iter().rev().cloned().collect() }
    }

    /// The polynomial in t at an input, up to a factor.
    pub fn at(&self, s: &Rational) -> Univariate<Integer> {
        let values = self.rows.iter().map(|row| value(row, s)).collect();
        Univariate::new(Univariate::new(values).primitive_integers())
    }

    /// The polynomial in s at an output, up to a factor.
    pub fn across(&self, t: &Rational) -> Univariate<Integer> {
        let rational =
            |row: &Univariate<Integer>| row.map(|c| Some(Rational::from(c))).unwrap_or_else(Univariate::zero);
        let sum = self
            .rows
            .iter()
            .rev()
            .fold(Univariate::zero(), |sum: Univariate<Rational>, row| sum.scale(t).add(&rational(row)));
        Univariate::new(sum.primitive_integers())
    }

    /// The coefficients about the centre of a rectangle, `x^i y^k` at `[k][i]`.
    fn about(&self, [s, t]: &[Rational; 2]) -> Vec<Vec<Rational>> {
        let width = self.input_degree() + 1;
        let mut rows: Vec<Vec<Rational>> = self.rows.iter().map(|row| shifted(row, s, width)).collect();
        for low in 0..rows.len() {
            for k in (low..rows.len() - 1).rev() {
                let (lower, upper) = rows.split_at_mut(k + 1);
                for (x, y) in lower[k].iter_mut().zip(&upper[0]) {
                    *x += Rational::from(y * t);
                }
            }
        }
        rows
    }

    /// Whether it has no zero in a rectangle, by the sizes of its coefficients about the centre; `false` proves nothing.
    pub(super) fn is_nonzero_in(&self, rectangle: &Rectangle) -> bool {
        let about = self.about(&rectangle.centre);
        let Some(centre) = about.first().and_then(|row| row.first()) else { return false };
        sum_of_sizes(&about, rectangle, |i, k| (i, k) != (0, 0)) < centre.clone().abs()
    }

    /// Returns whether its zeros in a rectangle are the graph of one function of s with simple roots that leaves it at the ends
    /// of s only; `false` proves nothing.
    ///
    /// The derivative by t has no zero, and the polynomial has none on the upper and the lower side, where its signs differ.
    pub(super) fn is_graph_in(&self, rectangle: &Rectangle) -> bool {
        let about = self.about(&rectangle.centre);
        let Some(slope) = about.get(1).and_then(|row| row.first()) else { return false };
        let rise = slope.clone().abs() * &rectangle.reach[1];
        // Each term of the derivative, times the reach, is k times that of the polynomial.
        let mut others = Rational::new();
        for_each_size(&about, rectangle, |i, k, size| {
            if (i, k) != (0, 1) {
                others += size * Rational::from(k.max(1));
            }
        });
        others < rise
    }
}

/// Calls a function with the size of every term on a rectangle.
fn for_each_size(about: &[Vec<Rational>], rectangle: &Rectangle, mut each: impl FnMut(usize, usize, Rational)) {
    let [across, along] = &rectangle.reach;
    let mut height = Rational::from(1);
    for (k, row) in about.iter().enumerate() {
        let mut size = height.clone();
        for (i, c) in row.iter().enumerate() {
            each(i, k, Rational::from(c.abs_ref()) * &size);
            size *= across;
        }
        height *= along;
    }
}

fn sum_of_sizes(about: &[Vec<Rational>], rectangle: &Rectangle, wanted: impl Fn(usize, usize) -> bool) -> Rational {
    let mut sum = Rational::new();
    for_each_size(about, rectangle, |i, k, size| {
        if wanted(i, k) {
            sum += size;
        }
    });
    sum
}

/// The value at a rational number.
fn value(row: &Univariate<Integer>, s: &Rational) -> Rational {
    row.coefficients().iter().rev().fold(Rational::new(), |value, c| value * s + c)
}

/// The coefficients about a number, `width` of them.
fn shifted(row: &Univariate<Integer>, s: &Rational, width: usize) -> Vec<Rational> {
    let mut coefficients: Vec<Rational> = row.coefficients().iter().map(Rational::from).collect();
    coefficients.resize(width, Rational::new());
    for low in 0..width {
        for i in (low..width - 1).rev() {
            let next = Rational::from(&coefficients[i + 1] * s);
            coefficients[i] += next;
        }
    }
    coefficients
}

/// A bound on the number of roots of a polynomial in an open interval, with multiplicity, that is too large by an even
/// number: the sign changes of its coefficients where the interval is mapped to the positive numbers (Descartes).
pub(in crate::internal::sweep) fn sign_changes(polynomial: &Univariate<Integer>, [low, high]: [&Rational; 2]) -> usize {
    let width = polynomial.coefficients().len();
    let mut about = shifted(polynomial, low, width);
    let length = Rational::from(high - low);
    let mut power = Rational::from(1);
    for c in &mut about {
        *c *= &power;
        power *= &length;
    }
    about.reverse();
    for lowest in 0..width {
        for i in (lowest..width.saturating_sub(1)).rev() {
            let next = about[i + 1].clone();
            about[i] += next;
        }
    }
    let signs: Vec<_> = about.iter().map(Rational::cmp0).filter(|sign| sign.is_ne()).collect();
    signs.windows(2).filter(|pair| pair[0] != pair[1]).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rational(n: i32, d: i32) -> Rational {
        Rational::from((n, d))
    }

    /// `s^2 + t^2 - 1`
    fn unit_circle() -> PlaneCurve {
        let [s, t] = [S, T].map(Polynomial::<Int>::variable);
        PlaneCurve::of(&s.mul(&s).add(&t.mul(&t)).sub(&Polynomial::one()))
    }

    #[test]
    fn a_circle_is_a_graph_beside_its_limits_only() {
        let rectangle = |s, t, x, y| Rectangle { centre: [s, t], reach: [x, y] };
        let curve = unit_circle();
        assert!(curve.is_graph_in(&rectangle(rational(0, 1), rational(1, 1), rational(1, 10), rational(1, 10))));
        assert!(!curve.is_graph_in(&rectangle(rational(1, 1), rational(0, 1), rational(1, 100), rational(1, 10))));
        assert!(curve.is_nonzero_in(&rectangle(rational(0, 1), rational(0, 1), rational(1, 2), rational(1, 2))));
        assert!(!curve.is_nonzero_in(&rectangle(rational(0, 1), rational(1, 1), rational(1, 10), rational(1, 10))));
        assert_eq!(curve.half_turned().inverted().degree(), 2);
    }

    #[test]
    fn sign_changes_count_roots_in_an_interval() {
        // (x - 1)(x - 2)(x - 3)
        let cubic = Univariate::new([-6, 11, -6, 1].map(Integer::from).to_vec());
        let count = |low: (i32, i32), high: (i32, i32)| {
            sign_changes(&cubic, [&rational(low.0, low.1), &rational(high.0, high.1)])
        };
        assert_eq!(count((0, 1), (1, 2)), 0);
        assert_eq!(count((1, 2), (3, 2)), 1);
        assert_eq!(count((0, 1), (10, 1)), 3);
        assert_eq!(count((3, 2), (10, 1)), 2);
    }
}
