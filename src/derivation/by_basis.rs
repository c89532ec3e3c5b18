//! The closure polynomial of a system of equations as a polynomial in a parameter too, interpolated from those at numbers.
//!
//! At a value of the parameter a Gröbner basis over the rationals has a ring of finite dimension, and the values of a linear form in the
//! unknowns at all solutions are the roots of a characteristic polynomial. Where these roots are simple every real one belongs to one
//! real solution, and every real solution to one of them.

use super::interpolation::{Family, Source, Values, Watch};
use crate::algebra::groebner::{Basis, Equation, FiniteRing};
use crate::algebra::int::Int;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::univariate::Univariate;
use crate::error::{Error, Result};
use rug::{Integer, Rational};

/// Products of words that a basis at one value may take, about a second: some dozens of them are needed.
const EFFORT: u64 = 300_000_000;
/// Values at which a linear form is looked for, in case that the first ones are special.
const TRIED: usize = 4;

/// A number of unknowns and the polynomials in them that vanish.
pub type Equations = (usize, Vec<Equation>);

/// The rings at values of the parameter, and the linear form.
struct Forms<'a> {
    at: &'a (dyn Fn(&Rational) -> Option<Equations> + Sync),
    form: i32,
    degree: usize,
}

/// Returns the number of unknowns and the ring; `None` where it is not finite or takes too much work.
fn ring((unknowns, equations): &Equations) -> Option<FiniteRing> {
    let basis = Basis::of(*unknowns, equations, EFFORT)?;
    if basis.dimension() == Some(0) { FiniteRing::of(&basis) } else { None }
}

impl Source for Forms<'_> {
    fn coefficients(&self, values: &[Rational]) -> Option<Vec<Integer>> {
        let equations = (self.at)(values.first()?)?;
        let polynomial = ring(&equations)?.values_of_form(equations.0, self.form)?;
        let integers: Univariate<Integer> = integers(&polynomial);
        (integers.degree() == Some(self.degree)).then(|| integers.coefficients().to_vec())
    }
}

fn integers(polynomial: &Univariate<Rational>) -> Univariate<Integer> {
    let common = polynomial.coefficients().iter().fold(Integer::from(1), |common, c| common.lcm(c.denom()));
    let whole = |c: &Rational| Rational::from(c * &common).numer().clone();
    Univariate::new(polynomial.coefficients().iter().map(whole).collect())
}

/// Returns the polynomial in a parameter (variable 0) and a linear form in the unknowns (variable 1) that vanishes at all solutions of the
/// equations `at` a value of the parameter. It is compared at values drawn at random, and has no proof.
///
/// # Errors
/// [`Error::Unsupported`] where the equations have no or infinitely many solutions, take too much work, or the values do not determine the
/// polynomial.
pub fn relation_by_bases(
    at: &(dyn Fn(&Rational) -> Option<Equations> + Sync),
    name: &str,
    watch: &Watch<'_>,
) -> Result<Polynomial<Int>> {
    let none = || {
        let message = "the equations have no solutions, infinitely many, or take too much work at the first values of the parameter";
        Error::Unsupported(message.to_owned())
    };
    // At special values solutions coincide or lie at infinity: the most that are seen are those of nearly all values.
    let seen = (0..TRIED).filter_map(|k| {
        let equations = at(&Values::Small.first(k))?;
        let ring = ring(&equations)?;
        Some((ring.distinct(), ring.separating_form(equations.0)?, ring.dimension()))
    });
    let (_, form, degree) =
        seen.max_by_key(|(distinct, ..)| *distinct).filter(|(_, _, degree)| *degree > 0).ok_or_else(none)?;
    let source = Forms { at, form, degree };
    let family = Family::new(&source, watch, Values::Small, vec![name.to_owned()], degree + 1);
    family.relation()
}
