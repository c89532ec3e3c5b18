//! Functions of rotations as polynomials in half tangents.

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
pub(super) fn rotation((numerator, denominator): (i32, i32)) -> Gaussian {
    let t = Rational::from((numerator, denominator));
    let square = Rational::from(&t * &t);
    let length = Rational::from(&square + 1);
    Complex { re: (1 - square) / &length, im: 2 * t / length }
}

/// `x^power`, as a polynomial of one variable.
fn powers(base: &Univariate<Gaussian>, power: usize) -> Univariate<Gaussian> {
    (0..power).fold(Univariate::one(), |product, _| product.mul(base))
}

fn gaussian(re: i32, im: i32) -> Gaussian {
    Complex { re: Rational::from(re), im: Rational::from(im) }
}

impl Form {
    /// Returns the form of a function whose values are real; `None` where they are not. Variable k is an angle counted from that of
    /// rotation k of `from`, or a displacement where there is none.
    pub fn of(function: &Laurent, from: &[Option<Gaussian>]) -> Option<Self> {
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
        if rational.is_zero() {
            return None;
        }
        let degree = |(k, n): (usize, &usize)| if from[k].is_some() { 2 * n } else { *n };
        let degrees = halves.iter().enumerate().map(degree).collect();
        let mut form = Self { polynomial: rational.primitive().0, degrees };
        form.remove_circles(from);
        Some(form)
    }

    /// Divides by factors `1 + x^2`, which have no real zero.
    fn remove_circles(&mut self, from: &[Option<Gaussian>]) {
        for k in (0..from.len()).filter(|k| from[*k].is_some()) {
            let x = Polynomial::<Int>::variable(k);
            let circle = x.mul(&x).add(&Polynomial::one());
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
    pub fn eliminate(&self, other: &Self, variable: usize, from: &[Option<Gaussian>]) -> Option<Self> {
        let [own, others] = [self, other].map(|form| form.degrees[variable]);
        if !(self.is_full(variable) && other.is_full(variable)) || own > HIGHEST {
            return None;
        }
        let polynomial = resultant(&self.polynomial, &other.polynomial, variable);
        if polynomial.is_zero() {
            return None;
        }
        let degree = |k: usize| if k == variable { 0 } else { self.degrees[k] * others + other.degrees[k] * own };
        let degrees = (0..from.len()).map(degree).collect();
        let mut form = Self { polynomial: polynomial.primitive_part(), degrees };
        form.remove_circles(from);
        Some(form)
    }

    /// Returns the polynomial in variable 0 of a form that has no other.
    pub fn in_input(&self) -> Option<Univariate<Integer>> {
        self.polynomial.to_univariate(0)?.map(|c| Some(c.to_integer()))
    }
}
