//! Closure polynomials in the coordinate ring of equations with finitely many solutions: polynomials whose roots are the values of a
//! function at all solutions.
//!
//! Multiplication by a function is a linear map of the ring, whose eigenvalues are its values at the solutions, each as often as the
//! solution counts. With the maps N and D of two functions the roots of `det(t D - N)` are the values of their quotient, and it vanishes
//! identically only if both are 0 at one solution.

use crate::algebra::drawn::Drawn;
use crate::algebra::echelon::Echelon;
use crate::algebra::groebner::{Basis, Equation, FiniteRing, Quotient};
use crate::algebra::modular::{Terms, determinant};
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use rug::{Integer, Rational};

/// Largest dimension of a ring: matrices of so many rows take a second.
const MOST: usize = 96;

/// A matrix by its columns.
pub(super) type Columns = Vec<Vec<Rational>>;

/// A function on the solutions.
#[derive(Clone, Debug)]
pub(super) enum Function {
    /// A polynomial in the unknowns.
    Plain(Equation),
    /// The tangent of half an angle over the length of a vector.
    HalfTangent {
        /// The cosine.
        cos: Equation,
        /// The sine over that length.
        sin: Equation,
        /// The square of the length.
        square: Rational,
    },
}

/// The ring of equations with finitely many solutions.
pub(super) struct CoordinateRing {
    basis: Basis,
    quotient: Quotient,
}

/// What equations have.
pub(super) enum Solutions {
    /// No solution.
    None,
    /// Finitely many.
    Finite(Box<CoordinateRing>),
    /// A set of this dimension.
    Set(usize),
}

impl CoordinateRing {
    /// Returns the ring of equations; `None` if it takes more products of words than `effort` or has a dimension above 96.
    pub fn of(unknowns: usize, equations: &[Equation], effort: u64) -> Option<Solutions> {
        let basis = Basis::of(unknowns, equations, effort)?;
        match basis.dimension() {
            None => Some(Solutions::None),
            Some(0) => {
                let quotient = Quotient::of(&basis, MOST)?;
                Some(Solutions::Finite(Box::new(Self { basis, quotient })))
            }
            Some(dimension) => Some(Solutions::Set(dimension)),
        }
    }

    /// Returns the number of solutions, complex ones included, with multiplicity.
    pub fn dimension(&self) -> usize {
        self.quotient.dimension()
    }

    /// Returns the number of distinct solutions; `None` where there are too many.
    pub fn distinct(&self) -> Option<usize> {
        Some(FiniteRing::of(&self.basis)?.distinct())
    }

    /// Returns the polynomial whose roots are the values of a function at all solutions, primitive, and the number of solutions at which
    /// the tangent of half an angle is infinite. The degree and that number add to the dimension.
    pub fn values(&self, function: &Function) -> Option<(Univariate<Integer>, usize)> {
        let size = self.dimension();
        let (polynomial, at_pi) = match function {
            Function::Plain(own) => {
                let unit = |i: usize| (0..size).map(|j| Rational::from(u8::from(i == j))).collect();
                (pencil(&(0..size).map(unit).collect(), &self.quotient.multiplication(own)?)?, 0)
            }
            Function::HalfTangent { cos, sin, square } => {
                let (cos, sin) = (self.quotient.multiplication(cos)?, self.quotient.multiplication(sin)?);
                // Each solution makes half a turn against one of the directions at most.
                let polynomial = (0..=size).find_map(|k| turned(&cos, &sin, square, k))?;
                let at_pi = size.checked_sub(polynomial.degree()?)?;
                (polynomial, at_pi)
            }
        };
        Some((Univariate::new(polynomial.primitive_integers()), at_pi))
    }

    /// Returns the products of functions with so many powers of another one, from the power 0 on, as elements of the ring: those of the
    /// first function come first.
    pub fn products(&self, along: &Equation, starts: &[(Equation, usize)]) -> Option<Columns> {
        let table = self.quotient.multiplication(along)?;
        let mut list = Vec::new();
        for (start, count) in starts {
            let mut next = self.quotient.element(start)?;
            for power in 0..*count {
                if power > 0 {
                    next = applied(&table, &next);
                }
                list.push(next.clone());
            }
        }
        Some(list)
    }
}

/// Returns the combination of columns with these coefficients.
fn applied(columns: &Columns, coefficients: &[Rational]) -> Vec<Rational> {
    let mut sum = vec![Rational::new(); columns.len()];
    for (column, c) in columns.iter().zip(coefficients).filter(|(_, c)| **c != 0) {
        for (x, y) in sum.iter_mut().zip(column).filter(|(_, y)| **y != 0) {
            *x += Rational::from(c * y);
        }
    }
    sum
}

/// Returns the rows of elements, given as columns, that are independent modulo the prime of this run, and hence over the rationals, as
/// many as the rank modulo the prime. `None` where a denominator is 0 modulo the prime.
fn independent_rows(columns: &[Vec<Rational>]) -> Option<Vec<usize>> {
    let size = columns.first().map_or(0, Vec::len);
    let row = |i: usize| columns.iter().map(|column| Drawn::from_rational(&column[i])).collect::<Option<Vec<Drawn>>>();
    let rows = (0..size).map(row).collect::<Option<Vec<_>>>()?;
    Some(Echelon::of(rows, columns.len()).independent_rows().to_vec())
}

/// Returns the rank of elements modulo the prime of this run, at most that over the rationals.
pub(super) fn rank(columns: &[Vec<Rational>]) -> Option<usize> {
    Some(independent_rows(columns)?.len())
}

/// Returns the coefficients of the only relation of elements, integers without common factor; `None` where there is none, or more than one.
pub(super) fn dependence(columns: &[Vec<Rational>]) -> Option<Vec<Integer>> {
    let count = columns.len();
    let chosen = independent_rows(columns)?;
    if chosen.len() + 1 != count {
        return None;
    }
    // By Cramer's rule they are the minors of the chosen rows, which are the coefficients of a determinant with powers of a variable for its
    // last row.
    let row = |i: &usize| {
        let common = columns.iter().fold(Integer::from(1), |common, column| common.lcm(column[*i].denom()));
        let entry = |column: &Vec<Rational>| {
            let number = Rational::from(&column[*i] * &common);
            let mut terms = Terms::default();
            if number != 0 {
                terms.exponents.push(0);
                terms.coefficients.push(number.numer().clone());
            }
            terms
        };
        columns.iter().map(entry).collect::<Vec<Terms>>()
    };
    let mut matrix: Vec<Vec<Terms>> = chosen.iter().map(row).collect();
    let power = |k: usize| {
        let mut terms = Terms::default();
        terms.exponents.push(u32::try_from(k).unwrap_or(u32::MAX));
        terms.coefficients.push(Integer::from(1));
        terms
    };
    matrix.push((0..count).map(power).collect());
    let mut coefficients = vec![Rational::new(); count];
    for (exponents, c) in determinant(&matrix, 1)?.iter(1) {
        coefficients[exponents[0] as usize] = Rational::from(c);
    }
    // The other rows have a larger rank where the prime divides a minor.
    let size = columns.first().map_or(0, Vec::len);
    let is_zero = |i: usize| {
        let terms = columns.iter().zip(&coefficients).filter(|(_, c)| **c != 0);
        terms.fold(Rational::new(), |sum, (column, c)| sum + Rational::from(&column[i] * c)) == 0
    };
    let whole = (0..size).filter(|i| !chosen.contains(i)).all(is_zero);
    let mut list = Univariate::new(coefficients).primitive_integers();
    list.resize(count, Integer::new());
    whole.then_some(list)
}

/// Returns the polynomial of the tangent of half an angle, from that of the angle against a direction in which no solution makes half a
/// turn; `None` where one does. The direction has the tangent k of half its angle over the length.
fn turned(cos: &Columns, sin: &Columns, square: &Rational, k: usize) -> Option<Univariate<Rational>> {
    let size = cos.len();
    let k = Rational::from(k);
    let own = Rational::from(&k * &k) * square;
    let length = Rational::from(&own + 1);
    let (c, s) = ((1 - own) / &length, Rational::from(&k * 2) / &length);
    let combined = |x: &Rational, y: &Rational, unit: bool| -> Columns {
        let entry = |i: usize, j: usize| {
            let sum = Rational::from(x * &cos[i][j]) + Rational::from(y * &sin[i][j]);
            if unit && i == j { sum + 1 } else { sum }
        };
        (0..size).map(|i| (0..size).map(|j| entry(i, j)).collect()).collect()
    };
    // 1 + cos and sin over the length, of the angle less that of the direction.
    let below = combined(&c, &Rational::from(&s * square), true);
    let above = combined(&Rational::from(-&s), &c, false);
    let against = pencil(&below, &above)?;
    if k == 0 {
        return Some(against);
    }
    // (t - k)/(1 + k |u|^2 t) for t.
    let numerator = Univariate::new(vec![Rational::from(-&k), Rational::from(1)]);
    let denominator = Univariate::new(vec![Rational::from(1), k * square]);
    let power = |p: &Univariate<Rational>, count: usize| (0..count).fold(Univariate::one(), |all, _| all.mul(p));
    let terms = against.coefficients().iter().enumerate();
    Some(terms.fold(Univariate::zero(), |sum, (i, c)| {
        sum.add(&power(&numerator, i).mul(&power(&denominator, size - i)).scale(c))
    }))
}

/// Returns `det(t D - N)` up to a factor; `None` for zero.
fn pencil(below: &Columns, above: &Columns) -> Option<Univariate<Rational>> {
    let column = |(below, above): (&Vec<Rational>, &Vec<Rational>)| -> Vec<Terms> {
        let common = below.iter().chain(above).fold(Integer::from(1), |common, q| common.lcm(q.denom()));
        let entry = |(below, above): (&Rational, &Rational)| {
            let mut terms = Terms::default();
            for (power, q) in [(1, below.clone()), (0, Rational::from(-above))].into_iter().filter(|(_, q)| *q != 0) {
                terms.exponents.push(power);
                terms.coefficients.push((q * &common).numer().clone());
            }
            terms
        };
        below.iter().zip(above).map(entry).collect()
    };
    let matrix: Vec<Vec<Terms>> = below.iter().zip(above).map(column).collect();
    let found = determinant(&matrix, 1)?;
    let mut coefficients = vec![Rational::new(); matrix.len() + 1];
    for (exponents, c) in found.iter(1) {
        coefficients[exponents[0] as usize] = Rational::from(c);
    }
    Some(Univariate::new(coefficients)).filter(|found| !found.is_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The points of the unit circle on a line: one of them makes half a turn.
    #[test]
    fn half_turns_are_counted() {
        let (cos, sin) = (Equation::variable(0), Equation::variable(1));
        let circle = cos.mul(&cos).add(&sin.mul(&sin)).sub(&Equation::one());
        // Through (-1, 0) and (0, 1), whose half tangents are infinite and 1.
        let line = sin.sub(&cos).sub(&Equation::one());
        let Some(Solutions::Finite(ring)) = CoordinateRing::of(2, &[circle, line], 1_000_000) else {
            panic!("two points")
        };
        let function = Function::HalfTangent { cos, sin, square: Rational::from(1) };
        let (polynomial, at_pi) = ring.values(&function).expect("a polynomial");
        assert_eq!((ring.dimension(), ring.distinct(), at_pi), (2, Some(2), 1));
        assert_eq!(polynomial.coefficients(), [Integer::from(-1), Integer::from(1)]);
    }
}
