//! The real quadratic factors of a norm: exactly over the rationals where they are rational, else in f64.

use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Float, Integer, Rational};

/// Rounds of the simultaneous iteration for the roots of a norm, whose degree is small.
const ROUNDS: usize = 500;
/// Newton steps from f64 to any requested precision: the digits double.
const STEPS: usize = 24;

/// The monic quadratic factors of a polynomial without real roots but double rational ones, each as often as it divides;
/// `None` where some are not rational.
///
/// With l the leading coefficient of the primitive integer polynomial, l times a rational factor `t^2 + p t + q` has integer
/// coefficients (Gauss): approximations within 1/(2l) name the only candidate, and a division decides.
///
/// # Panics
/// When the polynomial is zero.
#[must_use]
pub fn quadratic_factors(norm: &Univariate<Rational>) -> Option<Vec<Univariate<Rational>>> {
    let mut found = Vec::new();
    for (part, multiplicity) in norm.square_free_decomposition() {
        match part.degree() {
            // (t - a)^2, the norm of a translation.
            Some(1) if multiplicity % 2 == 0 => {
                let root = Univariate::new(
                    part.coefficients().iter().map(|c| Rational::from(c / &part.coefficients()[1])).collect(),
                );
                found.extend(vec![root.mul(&root); multiplicity / 2]);
            }
            _ => {
                for quadratic in of_square_free(&part)? {
                    found.extend(vec![quadratic; multiplicity]);
                }
            }
        }
    }
    Some(found)
}

fn of_square_free(part: &Univariate<Rational>) -> Option<Vec<Univariate<Rational>>> {
    let leading = part.coefficients().last()?;
    let size = part.coefficients().iter().map(|c| c.numer().significant_bits()).max().unwrap_or(1);
    let bits = 64 + 2 * size;
    let mut found = Vec::new();
    for (p, q) in pairs(part)? {
        let (p, q) = refined(part, p, q, bits)?;
        let rounded = |x: &Rational| {
            let scaled = Rational::from(x * leading);
            let (_, integer) = scaled.fract_round(Integer::new());
            Rational::from((integer, 1)) / leading
        };
        let candidate = Univariate::new(vec![rounded(&q), rounded(&p), Rational::from(1)]);
        if !part.div_rem(&candidate).1.is_zero() {
            return None;
        }
        found.push(candidate);
    }
    // Real roots have no partner.
    (2 * found.len() == part.degree()?).then_some(found)
}

/// The quadratic factors `t^2 + p t + q` that belong to the pairs of complex roots, as `(p, q)`, to rounding.
///
/// `None` where there are real roots.
fn pairs(part: &Univariate<Rational>) -> Option<Vec<(f64, f64)>> {
    let degree = part.degree()?;
    let leading = part.coefficients().last()?;
    let c: Vec<Complex<f64>> =
        part.coefficients().iter().map(|c| Complex::from(nearest_f64(&Rational::from(c / leading)))).collect();
    // Cauchy's bound.
    let radius = 1.0 + c[..degree].iter().map(|c| c.norm()).fold(0.0, f64::max);
    let start = |k: usize| Complex::from_polar(radius.min(4.0), 0.4 + std::f64::consts::TAU * k as f64 / degree as f64);
    let mut roots: Vec<Complex<f64>> = (0..degree).map(start).collect();
    for _ in 0..ROUNDS {
        let mut moved = 0.0_f64;
        for i in 0..degree {
            let value = c.iter().rev().fold(Complex::from(0.0), |value, c| value * roots[i] + c);
            let others =
                (0..degree).filter(|&j| j != i).fold(Complex::from(1.0), |product, j| product * (roots[i] - roots[j]));
            let step = value / others;
            if !step.is_finite() {
                return None;
            }
            roots[i] -= step;
            moved = moved.max(step.norm() / (1.0 + roots[i].norm()));
        }
        if moved < 1e-15 {
            break;
        }
    }
    let upper: Vec<(f64, f64)> = roots
        .iter()
        .filter(|root| root.im > 1e-9 * (1.0 + root.norm()))
        .map(|root| (-2.0 * root.re, root.norm_sqr()))
        .collect();
    (2 * upper.len() == degree).then_some(upper)
}

/// Newton's iteration on the remainder `r1 t + r0` of the division by `t^2 + p t + q` (Bairstow).
fn refined(part: &Univariate<Rational>, p: f64, q: f64, bits: u32) -> Option<(Rational, Rational)> {
    let round = |x: Rational| {
        let scaled = x << bits;
        let (_, integer) = scaled.fract_round(Integer::new());
        Rational::from((integer, 1)) >> bits
    };
    let (mut p, mut q) = (Rational::from_f64(p)?, Rational::from_f64(q)?);
    let goal = Rational::from((1, 1)) >> (bits / 2 + 32);
    for _ in 0..STEPS {
        let divisor = Univariate::new(vec![q.clone(), p.clone(), Rational::from(1)]);
        let (quotient, first) = part.div_rem(&divisor);
        let second = quotient.div_rem(&divisor).1;
        let of = |r: &Univariate<Rational>, k: usize| r.coefficients().get(k).cloned().unwrap_or_default();
        // d(r1 t + r0)/dq = -(s1 t + s0), d/dp = -t (s1 t + s0) reduced.
        let (r0, r1, s0, s1) = (of(&first, 0), of(&first, 1), of(&second, 0), of(&second, 1));
        let (a, b) = (&s0 - Rational::from(&p * &s1), -Rational::from(&s1 * &q));
        // [a s1; b s0] (dp, dq) = (r1, r0)
        let determinant = Rational::from(&a * &s0) - Rational::from(&b * &s1);
        if determinant == 0 {
            return None;
        }
        let dp = (Rational::from(&r1 * &s0) - Rational::from(&r0 * &s1)) / &determinant;
        let dq = (Rational::from(&a * &r0) - Rational::from(&b * &r1)) / &determinant;
        let small = dp.clone().abs() < goal && dq.clone().abs() < goal;
        p = round(p + dp);
        q = round(q + dq);
        if small {
            return Some((p, q));
        }
    }
    None
}

/// The quadratic factors in f64, each as often as it divides; `None` where there are real roots.
///
/// # Panics
/// When the polynomial is zero.
#[must_use]
pub fn numeric_quadratics(norm: &Univariate<Rational>) -> Option<Vec<Univariate<f64>>> {
    let mut found = Vec::new();
    for (part, multiplicity) in norm.square_free_decomposition() {
        for (p, q) in pairs(&part)? {
            let (p, q) = refined(&part, p, q, 128)?;
            let float = |x: &Rational| Float::with_val(53, x).to_f64();
            found.extend(vec![Univariate::new(vec![float(&q), float(&p), 1.0]); multiplicity]);
        }
    }
    Some(found)
}
