//! Functions of rotations as polynomials in half tangents.

use super::critical::Count;
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::resultant::resultant;
use crate::algebra::ring::{Domain, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::laurent::{Laurent, conjugate};
use num_complex::Complex;
use rug::{Integer, Rational};

/// The degree in an unknown beyond which nothing is eliminated.
const HIGHEST: usize = 64;

/// A polynomial in half tangents x, counted from other angles, or in a displacement.
#[derive(Clone, Debug)]
pub(super) struct Form {
    pub polynomial: Polynomial<Int>,
    /// The degrees that it has as a form: where it falls short of one, it vanishes at half a turn.
    pub degrees: Vec<usize>,
}

/// The rotation with a half tangent.
fn rotation(t: &Rational) -> Gaussian {
    let square = Rational::from(t * t);
    let length = Rational::from(&square + 1);
    Complex { re: (1 - square) / &length, im: Rational::from(t * 2) / length }
}

/// `x^power`, as a polynomial of one variable.
fn powers(base: &Univariate<Gaussian>, power: usize) -> Univariate<Gaussian> {
    (0..power).fold(Univariate::one(), |product, _| product.mul(base))
}

fn gaussian(re: i32, im: i32) -> Gaussian {
    Complex { re: Rational::from(re), im: Rational::from(im) }
}

impl Count {
    /// Cosine and sine over length, both times the circle, and the circle, as polynomials in variable k.
    fn turned(&self, k: usize) -> Option<[Polynomial<Rational>; 3]> {
        let Self::Angle { from, square, .. } = self else { return None };
        let x = Polynomial::<Rational>::variable(k);
        let one = Polynomial::<Rational>::one();
        let across = x.mul(&x).scale(square);
        let (circle, cosine, sine) = (one.add(&across), one.sub(&across), x.scale(&Rational::from(2)));
        // The angle from which it is counted comes first.
        let start = Rational::from(from * from) * square;
        let below = Rational::from(&start + 1);
        let (cos, sin) = (Rational::from(1 - &start) / &below, Rational::from(from * 2) / &below);
        let together = cosine.scale(&cos).sub(&sine.scale(&Rational::from(&sin * square)));
        Some([together, cosine.scale(&sin).add(&sine.scale(&cos)), circle])
    }
}

impl Form {
    /// Returns the form of a function whose values are real; `None` where they are not. Variable k is counted as the k-th of `counts`
    /// says, in half tangents over lengths 1.
    pub fn of(function: &Laurent, counts: &[Count]) -> Option<Self> {
        let turn = |count: &Count| match count {
            Count::Angle { from, .. } => Some(rotation(from)),
            Count::Displacement(_) => None,
        };
        let from: Vec<Option<Gaussian>> = counts.iter().map(turn).collect();
        let largest = |k: usize| {
            let exponents = function.terms().map(|(e, _)| e.get(k).map_or(0, |e| e.unsigned_abs() as usize));
            exponents.max().unwrap_or(0)
        };
        let halves: Vec<usize> = (0..from.len()).map(largest).collect();
        let [plus, minus] = [1, -1].map(|sign| Univariate::new(vec![gaussian(1, 0), gaussian(0, sign)]));
        let mut sum: Polynomial<Gaussian> = Polynomial::zero();
        for (exponents, c) in function.terms() {
            let mut product = Polynomial::constant(c.clone());
            for (k, from) in from.iter().enumerate() {
                let e = exponents.get(k).copied().unwrap_or(0);
                let size = e.unsigned_abs() as usize;
                // (h (1 + ix)/(1 - ix))^e (1 + x^2)^n = h^e (1 + ix)^(n + e) (1 - ix)^(n - e)
                let factor = match from {
                    None if e < 0 => return None,
                    None => powers(&Univariate::x(), size),
                    Some(h) => {
                        let n = halves[k];
                        let (up, down) = if e < 0 { (n - size, n + size) } else { (n + size, n - size) };
                        let h = if e < 0 { conjugate(h) } else { h.clone() };
                        let turned = (0..size).fold(gaussian(1, 0), |product, _| Ring::mul(&product, &h));
                        powers(&plus, up).mul(&powers(&minus, down)).scale(&turned)
                    }
                };
                product = product.mul(&Polynomial::from_univariate(k, &factor));
            }
            sum = sum.add(&product);
        }
        let rational = sum.map(|c| (c.im == 0).then(|| c.re.clone()))?;
        let degree = |(k, n): (usize, &usize)| if from[k].is_some() { 2 * n } else { *n };
        Self::reduced(&rational, halves.iter().enumerate().map(degree).collect(), counts)
    }

    /// Returns the form of a function on the sphere: in it variables 2k and 2k + 1 are the cosine of angle k and its sine over the length
    /// of the axis.
    pub fn on_sphere(function: &Polynomial<Rational>, counts: &[Count]) -> Option<Self> {
        let power = |exponents: &[u32], k: usize| {
            let at = |n: usize| exponents.get(n).copied().unwrap_or(0) as usize;
            [at(2 * k), at(2 * k + 1)]
        };
        let largest = |k: usize| function.terms().map(|(e, _)| power(&e, k).iter().sum::<usize>()).max().unwrap_or(0);
        let highest: Vec<usize> = (0..counts.len()).map(largest).collect();
        // With x = tan(q/2)/l and n = 1 + l^2 x^2, cos q = (1 - l^2 x^2)/n and sin q/l = 2x/n; q begins where x is `from`.
        let factors: Vec<[Polynomial<Rational>; 3]> =
            counts.iter().enumerate().map(|(k, c)| c.turned(k)).collect::<Option<_>>()?;
        let mut sum: Polynomial<Rational> = Polynomial::zero();
        for (exponents, c) in function.terms() {
            let mut product = Polynomial::constant(c.clone());
            for (k, [cosine, sine, circle]) in factors.iter().enumerate() {
                let [own, other] = power(&exponents, k);
                let parts = [(cosine, own), (sine, other), (circle, highest[k] - own - other)];
                for (base, n) in parts {
                    product = (0..n).fold(product, |product, _| product.mul(base));
                }
            }
            sum = sum.add(&product);
        }
        Self::reduced(&sum, highest.iter().map(|n| 2 * n).collect(), counts)
    }

    /// Returns the form of a polynomial without the factors that have no real zero; `None` of zero.
    fn reduced(polynomial: &Polynomial<Rational>, degrees: Vec<usize>, counts: &[Count]) -> Option<Self> {
        if polynomial.is_zero() {
            return None;
        }
        let mut form = Self { polynomial: polynomial.primitive().0, degrees };
        form.remove_circles(counts);
        Some(form)
    }

    /// Divides by factors `1 + l^2 x^2`, which have no real zero.
    fn remove_circles(&mut self, counts: &[Count]) {
        for (k, count) in counts.iter().enumerate() {
            let Count::Angle { square, .. } = count else { continue };
            let x = Polynomial::<Rational>::variable(k);
            let circle = x.mul(&x).scale(square).add(&Polynomial::one()).primitive().0;
            while self.degrees[k] >= 2 {
                let Some(quotient) = self.polynomial.checked_div_exact(&circle) else { break };
                self.polynomial = quotient;
                self.degrees[k] -= 2;
            }
        }
    }

    /// Whether it has its degree in a variable.
    pub fn is_full(&self, variable: usize) -> bool {
        self.polynomial.degree(variable) as usize == self.degrees[variable]
    }

    /// Returns the resultant with another form; `None` where both vanish at half a turn of the variable, or degrees are too large.
    pub fn eliminate(&self, other: &Self, variable: usize, counts: &[Count]) -> Option<Self> {
        let [own, others] = [self, other].map(|form| form.degrees[variable]);
        if !(self.is_full(variable) && other.is_full(variable)) || own > HIGHEST {
            return None;
        }
        let polynomial = resultant(&self.polynomial, &other.polynomial, variable);
        if polynomial.is_zero() {
            return None;
        }
        let degree = |k: usize| if k == variable { 0 } else { self.degrees[k] * others + other.degrees[k] * own };
        let degrees = (0..counts.len()).map(degree).collect();
        let mut form = Self { polynomial: polynomial.primitive_part(), degrees };
        form.remove_circles(counts);
        Some(form)
    }

    /// Returns the polynomial in variable 0 of a form that has no other.
    pub fn in_input(&self) -> Option<Univariate<Integer>> {
        self.polynomial.to_univariate(0)?.map(|c| Some(c.to_integer()))
    }
}
