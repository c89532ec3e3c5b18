//! Quotient rings of finite dimension: the number of solutions, their multiplicities, and the values of polynomials
//! at them.

use super::basis::Basis;
use super::monomial::Monomial;
use super::polynomial::{Equation, Work, remainder};
use crate::ring::Ring;
use crate::univariate::Univariate;
use rug::{Integer, Rational};
use std::collections::HashMap;

/// Maximum number of standard monomials, above that of any small system of kinematics.
const MOST: usize = 64;

/// The polynomials modulo an ideal with finitely many zeros; an element is its coefficients over the standard monomials.
#[derive(Clone, Debug)]
pub struct Quotient {
    basis: Basis,
    standard: Vec<Monomial>,
    places: HashMap<Monomial, usize>,
}

impl Quotient {
    /// Returns the quotient by the ideal of a basis; `None` if there are infinitely many zeros, or more than `most`.
    #[must_use]
    pub fn of(basis: &Basis, most: usize) -> Option<Self> {
        let standard = basis.standard(most)?;
        let places = standard.iter().enumerate().map(|(k, m)| (*m, k)).collect();
        Some(Self { basis: basis.clone(), standard, places })
    }

    /// Returns the dimension: the number of solutions, complex ones included, with multiplicity.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.standard.len()
    }

    /// Returns the element represented by a polynomial; `None` for degrees above 127.
    #[must_use]
    pub fn element(&self, equation: &Equation) -> Option<Vec<Rational>> {
        let mut denominator = Integer::from(1);
        for c in equation.terms().values() {
            denominator.lcm_mut(c.denom());
        }
        let whole = |c: &Rational| Integer::from(denominator.div_exact_ref(c.denom())) * c.numer();
        let work: Work<Integer> = equation.terms().iter().map(|(m, c)| (*m, whole(c))).collect();
        let mut scale = denominator.clone();
        // The normal forms of small monomials take no more work than the basis itself.
        let mut effort = u64::MAX;
        let rest = remainder(work, &self.basis.by_size(), &mut scale, &mut effort)?;
        let mut element = vec![Rational::new(); self.standard.len()];
        for (monomial, c) in rest {
            element[*self.places.get(&monomial)?] = Rational::from((c, scale.clone()));
        }
        Some(element)
    }

    /// Returns the matrix of the multiplication with a polynomial: its columns are the products with the standard monomials, of which 1
    /// is the first.
    #[must_use]
    pub fn multiplication(&self, by: &Equation) -> Option<Vec<Vec<Rational>>> {
        let column = |m: &Monomial| self.element(&by.mul(&Equation::monomial(*m)));
        self.standard.iter().map(column).collect()
    }
}

/// The quotient with the traces of its elements.
#[derive(Clone, Debug)]
pub struct FiniteRing {
    quotient: Quotient,
    /// The trace of the multiplication by each standard monomial.
    traces: Vec<Rational>,
    /// The matrix of traces of the products of standard monomials: sums of their values over the solutions, with
    /// multiplicity.
    products: Vec<Vec<Rational>>,
}

/// An element by its coefficients.
type Element = Vec<Rational>;

impl FiniteRing {
    /// Returns the ring of a basis; `None` if there are infinitely many zeros, or more than 64.
    #[must_use]
    pub fn of(basis: &Basis) -> Option<Self> {
        let quotient = Quotient::of(basis, MOST)?;
        let mut ring = Self { quotient, traces: Vec::new(), products: Vec::new() };
        ring.multiply()?;
        Some(ring)
    }

    /// Returns the dimension: the number of solutions, complex ones included, with multiplicity.
    #[must_use]
    pub fn dimension(&self) -> usize {
        self.quotient.dimension()
    }

    /// Returns the number of distinct solutions: the rank of the matrix of traces (Hermite).
    #[must_use]
    pub fn distinct(&self) -> usize {
        rank(self.products.clone())
    }

    /// Returns the element represented by a polynomial; `None` for degrees above 127.
    #[must_use]
    pub fn element(&self, equation: &Equation) -> Option<Element> {
        self.quotient.element(equation)
    }

    /// Returns the trace of the multiplication with an element.
    pub(super) fn trace(&self, element: &Element) -> Rational {
        dot(element, &self.traces)
    }

    /// Returns the traces of the products of an element with all standard monomials.
    pub(super) fn traces_with(&self, element: &Element) -> Element {
        self.products.iter().map(|row| dot(element, row)).collect()
    }

    /// Finds the traces of products: the products of pairs of standard monomials, one variable after the other.
    fn multiply(&mut self) -> Option<()> {
        let Quotient { basis, standard, places } = &self.quotient;
        let size = standard.len();
        let variables: Option<Vec<Vec<Element>>> =
            (0..basis.variables).map(|k| self.quotient.multiplication(&Equation::variable(k))).collect();
        let variables = variables?;
        let unit = |k: usize| -> Element { (0..size).map(|i| Rational::from(i32::from(i == k))).collect() };
        // The columns of the multiplication with each standard monomial: smaller ones come first.
        let mut tables: Vec<Vec<Element>> = Vec::new();
        for monomial in standard {
            let factor = (0..basis.variables).find(|k| monomial.exponent(*k) > 0);
            let table = match factor {
                None => (0..size).map(unit).collect(),
                Some(k) => {
                    let rest = places.get(&monomial.over(Monomial::variable(k)))?;
                    tables[*rest].iter().map(|column| applied(&variables[k], column)).collect()
                }
            };
            tables.push(table);
        }
        let trace = |table: &Vec<Element>| (0..size).fold(Rational::new(), |sum, k| sum + &table[k][k]);
        self.traces = tables.iter().map(trace).collect();
        self.products =
            tables.iter().map(|table| table.iter().map(|column| dot(column, &self.traces)).collect()).collect();
        Some(())
    }

    /// Returns the characteristic polynomial of the multiplication with a linear form, by the sums of the powers of its roots, and
    /// the powers of the form.
    pub(super) fn characteristic(&self, form: &Equation) -> Option<(Univariate<Rational>, Vec<Element>)> {
        let table = self.quotient.multiplication(form)?;
        let size = self.dimension();
        let mut powers = vec![self.element(&Equation::one())?];
        for k in 0..size {
            powers.push(applied(&table, &powers[k]));
        }
        let sums: Vec<Rational> = powers.iter().map(|power| self.trace(power)).collect();
        // Newton's identities: k a_k = -(s_k + a_1 s_(k-1) + ... + a_(k-1) s_1).
        let mut coefficients = vec![Rational::from(1)];
        for k in 1..=size {
            let sum = (0..k).fold(Rational::new(), |sum, j| sum + Rational::from(&coefficients[j] * &sums[k - j]));
            coefficients.push(-sum / Rational::from(k));
        }
        coefficients.reverse();
        Some((Univariate::new(coefficients), powers))
    }
}

fn dot(x: &[Rational], y: &[Rational]) -> Rational {
    let products = x.iter().zip(y).filter(|(x, y)| **x != 0 && **y != 0);
    products.fold(Rational::new(), |sum, (x, y)| sum + Rational::from(x * y))
}

/// Returns the combination of columns with these coefficients.
fn applied(columns: &[Element], coefficients: &Element) -> Element {
    let mut sum = vec![Rational::new(); columns.len()];
    for (column, c) in columns.iter().zip(coefficients).filter(|(_, c)| **c != 0) {
        for (x, y) in sum.iter_mut().zip(column).filter(|(_, y)| **y != 0) {
            *x += Rational::from(c * y);
        }
    }
    sum
}

/// Returns the rank of a matrix.
fn rank(mut rows: Vec<Element>) -> usize {
    let (width, mut rank) = (rows.first().map_or(0, Vec::len), 0);
    for column in 0..width {
        let Some(pivot) = (rank..rows.len()).find(|k| rows[*k][column] != 0) else { continue };
        rows.swap(rank, pivot);
        let (above, below) = rows.split_at_mut(rank + 1);
        let pivot = &above[rank];
        for row in below.iter_mut().filter(|row| row[column] != 0) {
            let factor = Rational::from(&row[column] / &pivot[column]);
            for (x, y) in row.iter_mut().zip(pivot).skip(column) {
                *x -= Rational::from(&factor * y);
            }
        }
        rank += 1;
    }
    rank
}
