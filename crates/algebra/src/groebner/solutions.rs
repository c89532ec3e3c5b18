//! The solutions of a finite system as algebraic numbers, with their multiplicities.
//!
//! A linear form u that has different values at different solutions makes every polynomial a polynomial in u there: the
//! rational univariate representation.

use super::polynomial::Equation;
use super::ring::FiniteRing;
use crate::ring::Ring;
use crate::univariate::Univariate;
use rug::Rational;
use std::sync::OnceLock;

/// Linear forms that are tried. Only finitely many of a general family fail: one for each pair of solutions and choice.
const TRIES: i32 = 40;

/// Solutions with the same multiplicity: the roots of a square-free polynomial.
#[derive(Clone, Debug)]
pub struct Values {
    /// The polynomial whose roots are the values of the linear form: square-free, primitive integers.
    pub polynomial: Univariate<Rational>,
    /// The number of solutions that coincide at each of its roots.
    pub multiplicity: usize,
    /// The inverse of the denominator of all values, modulo the polynomial, computed on first use; `None` if there is none.
    inverse: OnceLock<Option<Univariate<Rational>>>,
}

/// All solutions of a system.
#[derive(Clone, Debug)]
pub struct Solutions {
    ring: FiniteRing,
    /// The powers of the linear form.
    powers: Vec<Vec<Rational>>,
    /// Horner's polynomials of the square-free characteristic one.
    horner: Vec<Univariate<Rational>>,
    /// The denominator of all values.
    denominator: Univariate<Rational>,
    /// The solutions by their multiplicity.
    pub parts: Vec<Values>,
}

impl Solutions {
    /// Returns the solutions of a system with this ring in `variables` variables; `None` if no linear form was found that
    /// separates them.
    ///
    /// # Source
    /// Rouillier 1999, Solving zero-dimensional systems through the rational univariate representation, AAECC 9.
    #[must_use]
    pub fn of(ring: FiniteRing, variables: usize) -> Option<Self> {
        let distinct = ring.distinct();
        for number in 0..TRIES {
            let form = linear_form(variables, number);
            let (characteristic, powers) = ring.characteristic(&form)?;
            let whole = characteristic.square_free_part();
            if whole.degree() == Some(distinct) {
                return Self::by(ring, powers, &characteristic, &whole);
            }
        }
        None
    }

    fn by(
        ring: FiniteRing,
        powers: Vec<Vec<Rational>>,
        characteristic: &Univariate<Rational>,
        whole: &Univariate<Rational>,
    ) -> Option<Self> {
        let horner = horner(whole);
        let mut found = Self { ring, powers, horner, denominator: Univariate::zero(), parts: Vec::new() };
        found.denominator = found.numerator(&Equation::one())?;
        // Most polynomials have simple roots only, which this test finds faster than a decomposition.
        let parts = if whole.degree() == characteristic.degree() {
            vec![(whole.clone(), 1)]
        } else {
            characteristic.square_free_decomposition()
        };
        for (polynomial, multiplicity) in parts {
            found.parts.push(Values { polynomial, multiplicity, inverse: OnceLock::new() });
        }
        Some(found)
    }

    /// Returns the sum over all solutions of the value of a polynomial, each times the product of u minus the other roots.
    fn numerator(&self, equation: &Equation) -> Option<Univariate<Rational>> {
        let traces = self.ring.traces_with(&self.ring.element(equation)?);
        let count = self.horner.len();
        let mut sum = Univariate::zero();
        for (power, horner) in self.powers.iter().zip(self.horner.iter().rev()).take(count) {
            let trace = power.iter().zip(&traces).fold(Rational::new(), |sum, (x, y)| sum + Rational::from(x * y));
            sum = sum.add(&horner.scale(&trace));
        }
        Some(sum)
    }

    /// Returns the value of a polynomial as a polynomial in u, at the solutions of one part; `None` for degrees above 127.
    #[must_use]
    pub fn value(&self, part: &Values, equation: &Equation) -> Option<Univariate<Rational>> {
        let inverse = part.inverse.get_or_init(|| inverse_modulo(&self.denominator, &part.polynomial));
        let numerator = self.numerator(equation)?.div_rem(&part.polynomial).1;
        Some(numerator.mul(inverse.as_ref()?).div_rem(&part.polynomial).1)
    }

    /// Returns the value of a polynomial as the quotient of two polynomials in u, numerator first: it holds at all solutions, and the
    /// denominator is 0 at none. Numbers are far smaller than those of [`Self::value`]. `None` for degrees above 127.
    #[must_use]
    pub fn quotient(&self, equation: &Equation) -> Option<[Univariate<Rational>; 2]> {
        Some([self.numerator(equation)?, self.denominator.clone()])
    }
}

impl FiniteRing {
    /// Returns the number of the first linear form in so many variables that has different values at different solutions, as
    /// [`Self::values_of_form`] counts them; `None` if none was found.
    #[must_use]
    pub fn separating_form(&self, variables: usize) -> Option<i32> {
        let distinct = self.distinct();
        let is_separating = |number: &i32| {
            self.values_of_form(variables, *number).is_some_and(|f| f.square_free_part().degree() == Some(distinct))
        };
        (0..TRIES).find(is_separating)
    }

    /// Returns the monic polynomial whose roots are the values of the linear form of a number, small integers times the variables, at
    /// all solutions, each with its multiplicity.
    #[must_use]
    pub fn values_of_form(&self, variables: usize, number: i32) -> Option<Univariate<Rational>> {
        Some(self.characteristic(&linear_form(variables, number))?.0)
    }
}

/// Returns the linear form of this number: small coefficients first.
fn linear_form(variables: usize, number: i32) -> Equation {
    let (step, start) = (number + 1, number / 2 + 1);
    let coefficient = |k: usize| {
        let k = i32::try_from(k).unwrap_or(0);
        // Residues of a quadratic: no fixed linear relation among them for all numbers.
        (start + step * k + k * k * (1 + number % 3)) % (5 + 2 * number) + 1
    };
    let term = |k: usize| Equation::variable(k).mul(&Equation::from_integer(coefficient(k)));
    (0..variables).fold(Equation::zero(), |sum, k| sum.add(&term(k)))
}

/// Returns `H_j`, the first j + 1 coefficients of a monic polynomial from the highest on, as a polynomial of degree j.
fn horner(polynomial: &Univariate<Rational>) -> Vec<Univariate<Rational>> {
    let Some(leading) = polynomial.coefficients().last() else { return Vec::new() };
    let degree = polynomial.degree().unwrap_or(0);
    let monic = polynomial.scale(&leading.clone().recip());
    let part = |j: usize| Univariate::new(monic.coefficients()[degree - j..].to_vec());
    (0..degree).map(part).collect()
}

/// Returns the inverse of a polynomial modulo another one; `None` if they have a common root.
#[must_use]
pub fn inverse_modulo(
    polynomial: &Univariate<Rational>,
    modulus: &Univariate<Rational>,
) -> Option<Univariate<Rational>> {
    let mut above = (modulus.clone(), Univariate::zero());
    let mut rest = (polynomial.div_rem(modulus).1, Univariate::one());
    while rest.0.degree() > Some(0) {
        let (quotient, remainder) = above.0.div_rem(&rest.0);
        let cofactor = above.1.sub(&quotient.mul(&rest.1));
        (above, rest) = (rest, (remainder, cofactor));
    }
    let constant = rest.0.coefficients().first()?;
    Some(rest.1.scale(&constant.clone().recip()).div_rem(modulus).1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::groebner::Basis;

    fn x(k: usize) -> Equation {
        Equation::variable(k)
    }

    fn number(n: i32) -> Equation {
        Equation::from_integer(n)
    }

    /// A circle and a line: a tangent, a secant and one that passes by.
    #[test]
    fn a_circle_and_lines() {
        let circle = x(0).mul(&x(0)).add(&x(1).mul(&x(1))).sub(&number(25));
        for (line, distinct, multiplicity, real) in [
            (x(0).sub(&number(5)), 1, 2, 1),
            (x(0).add(&x(1)).sub(&number(7)), 2, 1, 2),
            (x(0).sub(&number(6)), 2, 1, 0),
        ] {
            let basis = Basis::of(2, &[circle.clone(), line], 100_000).unwrap();
            let ring = FiniteRing::of(&basis).unwrap();
            assert_eq!((ring.dimension(), ring.distinct()), (2, distinct));
            let solutions = Solutions::of(ring, 2).unwrap();
            let [part] = solutions.parts.as_slice() else { panic!("one multiplicity") };
            assert_eq!((part.multiplicity, part.polynomial.degree()), (multiplicity, Some(distinct)));
            assert_eq!(part.polynomial.distinct_real_roots(), real);
            let [x, y] = [0, 1].map(|k| solutions.value(part, &x(k)).unwrap());
            let square = x.mul(&x).add(&y.mul(&y)).sub(&Univariate::constant(Rational::from(25)));
            assert!(square.div_rem(&part.polynomial).1.is_zero());
        }
    }

    /// A point of multiplicity 4, not a curvilinear one, and three simple ones.
    #[test]
    fn multiplicities_are_those_of_the_ring() {
        let quadric = |k: usize| x(k).mul(&x(k)).mul(&x(k).sub(&number(1)));
        let basis = Basis::of(2, &[quadric(0), quadric(1)], 100_000).unwrap();
        let solutions = Solutions::of(FiniteRing::of(&basis).unwrap(), 2).unwrap();
        let mut found: Vec<(usize, usize)> =
            solutions.parts.iter().map(|p| (p.multiplicity, p.polynomial.degree().unwrap())).collect();
        found.sort_unstable();
        assert_eq!(found, [(1, 1), (2, 2), (4, 1)]);
    }
}
