//! Names for the coefficients of polynomials, so that large ones can be read.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::derivation::equation::primitive;
use rug::Rational;

/// Exponents and coefficient.
type Term = (Vec<u32>, Rational);

/// Named sub-expressions: A, B, C and so on.
pub(super) struct Parts {
    /// The variable of the first sub-expression.
    first: usize,
    pub list: Vec<(String, Polynomial<Rational>)>,
}

impl Parts {
    /// Creates an empty list whose variables begin with this one.
    pub fn new(first: usize) -> Self {
        Self { first, list: Vec::new() }
    }

    /// Returns a coefficient by its name, a new one if needed. Numbers and single terms stay as they are.
    pub fn name(&mut self, coefficient: &Polynomial<Rational>) -> Polynomial<Rational> {
        if coefficient.len() <= 1 {
            return coefficient.clone();
        }
        let own = primitive(coefficient);
        let factor = Rational::from(&coefficient.coefficients()[0] / &own.coefficients()[0]);
        let at = self.list.iter().position(|(_, known)| *known == own).unwrap_or_else(|| {
            let (letter, round) = (self.list.len() % 26, self.list.len() / 26);
            let letter = char::from(b'A' + u8::try_from(letter).unwrap_or(0));
            let name = if round == 0 { letter.to_string() } else { format!("{letter}{round}") };
            self.list.push((name, own));
            self.list.len() - 1
        });
        Polynomial::variable(self.first + at).scale(&factor)
    }

    /// Names the coefficients of a polynomial whose first variables are unknowns.
    pub fn compact(&mut self, polynomial: &Polynomial<Rational>, unknowns: usize) -> Polynomial<Rational> {
        let mut collected: Vec<(Vec<u32>, Vec<Term>)> = Vec::new();
        // Terms with the same powers of the unknowns follow one another.
        for (mut exponents, c) in polynomial.terms() {
            exponents.resize(exponents.len().max(unknowns), 0);
            let mut rest = vec![0; unknowns];
            rest.extend_from_slice(&exponents[unknowns..]);
            exponents.truncate(unknowns);
            match collected.last_mut().filter(|(powers, _)| *powers == exponents) {
                Some((_, terms)) => terms.push((rest, c.clone())),
                None => collected.push((exponents, vec![(rest, c.clone())])),
            }
        }
        collected.into_iter().fold(Polynomial::zero(), |sum, (powers, terms)| {
            let coefficient = self.name(&Polynomial::from_terms(terms));
            let monomial = Polynomial::from_terms([(powers, Rational::from(1))]);
            sum.add(&monomial.mul(&coefficient))
        })
    }
}
