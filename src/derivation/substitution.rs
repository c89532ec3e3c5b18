//! Substitutes the solver's solutions in the equations that a derivation displays.

use super::{ClosurePolynomial, Derivation, Equation, Symbolic};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::Names;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::mechanism::Mechanism;
use num_complex::Complex;
use rug::Rational;
use std::collections::BTreeMap;

/// An equation holds if its value at a solution is at most this part of the sum of the sizes of its terms.
const VANISHING: f64 = 1e-8;
/// Half-angle tangent above which the angle is taken as pi, where equations in it have no meaning.
const AT_PI: f64 = 1e6;

/// Values of variables by their names.
type Values = BTreeMap<String, Complex<f64>>;

/// The result of substituting solutions in equations.
#[derive(Clone, Debug, PartialEq)]
pub struct Substitution {
    /// Number of solutions, complex ones included.
    pub solutions: usize,
    /// Number of real solutions.
    pub real: usize,
    /// Number of displayed equations.
    pub equations: usize,
    /// Number of values; less than solutions times equations if an angle is pi, or a variable has no value.
    pub values: usize,
    /// The largest value relative to the sizes of all terms.
    pub largest: f64,
    /// The reason why there was nothing to substitute.
    pub without: Option<String>,
}

/// A displayed equation, `polynomial = 0`.
struct Shown<'d> {
    name: &'d str,
    polynomial: &'d Polynomial<Rational>,
    /// The half-angle tangents in which it was written, those included whose coefficients are 0: at infinity it says nothing.
    tangents: Vec<String>,
}

impl<'d> Shown<'d> {
    fn new(name: &'d str, polynomial: &'d Polynomial<Rational>) -> Self {
        Self { name, polynomial, tangents: Vec::new() }
    }

    /// Returns the polynomial of one unknown; it may be constant, where all roots are infinite.
    fn in_unknown(names: &Names, variable: usize, polynomial: &'d Polynomial<Rational>) -> Self {
        let tangents = names.list().get(variable).filter(|name| name.starts_with('t')).cloned().into_iter().collect();
        Self { name: "closure polynomial", polynomial, tangents }
    }

    /// Returns the forms of an equation in cosines and sines, and in half-angle tangents.
    fn forms(equation: &'d Equation, names: &Names) -> impl Iterator<Item = Self> {
        let cosines = names.list().iter().enumerate().filter(|(k, _)| equation.polynomial.degree(*k) > 0);
        let tangents = cosines.filter_map(|(_, name)| name.strip_prefix(['c', 's'])).map(|label| format!("t{label}"));
        let algebraic = equation.algebraic.as_ref().map(|polynomial| Self {
            name: &equation.name,
            polynomial,
            tangents: tangents.collect(),
        });
        std::iter::once(Self::new(&equation.name, &equation.polynomial)).chain(algebraic)
    }
}

impl Derivation {
    /// Substitutes every solution of the case, found by the solver in floating point, in every equation of the derivation.
    ///
    /// # Errors
    /// [`Error::Invalid`] if one does not vanish: either the derivation or the solver is wrong.
    pub fn substituted(&self, entry: &Entry, case: &Case) -> Result<Substitution> {
        let polynomial = self.polynomial.as_ref().map(ClosurePolynomial::to_polynomial);
        let names = &self.names;
        let mut shown: Vec<Shown<'_>> =
            self.equations.iter().flat_map(|equation| Shown::forms(equation, names)).collect();
        let closure = self.polynomial.iter().zip(&polynomial);
        shown.extend(closure.map(|(closure, polynomial)| Shown::in_unknown(names, closure.variable, polynomial)));
        checked(entry, case, names, &shown, |values| {
            // The definition of the variable of a platform's polynomial is linear in it.
            let (Some(definition), Some(polynomial)) = (&self.definition, &self.polynomial) else { return };
            let parts = definition.coefficients_in(polynomial.variable);
            if let [rest, factor] = parts.as_slice()
                && let (Some(rest), Some(factor)) = (number(rest, names, values), number(factor, names, values))
                && factor.norm() > 0.0
            {
                values.insert(names.list()[polynomial.variable].clone(), -rest / factor);
            }
        })
    }
}

impl Symbolic {
    /// Substitutes every solution of the case, found by the solver in floating point, with the numbers of the file for the
    /// symbols, in every equation of the derivation, in names and expanded.
    ///
    /// # Errors
    /// [`Error::Invalid`] if one does not vanish: either the derivation or the solver is wrong.
    pub fn substituted(&self, entry: &Entry, case: &Case) -> Result<Substitution> {
        let names = &self.names;
        // `d = above/below` as an equation.
        let translations: Vec<Polynomial<Rational>> = self
            .translations
            .iter()
            .map(|one| Polynomial::variable(one.variable).mul(&one.denominator).sub(&one.numerator))
            .collect();
        let equations = self
            .equations
            .iter()
            .flat_map(|one| [&one.compact, &one.polynomial].map(|polynomial| Shown::new(&one.name, polynomial)));
        let closure = self.polynomial.iter().flat_map(|one| {
            [&one.displayed.compact, &one.displayed.polynomial]
                .map(|polynomial| Shown::in_unknown(names, one.variable, polynomial))
        });
        let translations = translations.iter().map(|polynomial| Shown::new("translation", polynomial));
        let shown: Vec<Shown<'_>> = equations.chain(closure).chain(translations).collect();
        checked(entry, case, names, &shown, |values| {
            for (variable, number) in &self.values {
                values.insert(names.list()[*variable].clone(), Complex::from(number.to_f64()));
            }
            for (name, part) in &self.parts {
                if let Some(value) = number(part, names, values) {
                    values.insert(name.clone(), value);
                }
            }
        })
    }
}

/// Substitutes solutions in equations.
fn checked(
    entry: &Entry,
    case: &Case,
    names: &Names,
    shown: &[Shown<'_>],
    complete: impl Fn(&mut Values),
) -> Result<Substitution> {
    let mut found =
        Substitution { solutions: 0, real: 0, equations: shown.len(), values: 0, largest: 0.0, without: None };
    let one = Entry { cases: vec![case.clone()], ..entry.clone() };
    let solved = Mechanism::prepare(&one)
        .and_then(|mechanism| mechanism.solve(case, Roots::All, &mut Workspace::default(), &mut Assembly::default()));
    let solution = match solved {
        Ok(solution) => solution,
        Err(error) => return Ok(Substitution { without: Some(error.to_string()), ..found }),
    };
    if solution.modes.is_empty() {
        return Ok(Substitution { without: Some(solution.verdict.reason), ..found });
    }
    for (number, mode) in (1..).zip(&solution.modes) {
        let mut values = match &entry.design {
            Design::Arm(chain) | Design::Loop(chain) => joints(chain, &mode.q),
            Design::Platform(_) => study(&mode.q),
        };
        complete(&mut values);
        found.solutions += 1;
        found.real += usize::from(mode.real);
        for equation in shown.iter().filter(|one| one.tangents.iter().all(|tangent| values.contains_key(tangent))) {
            let Some((value, size)) = value(equation.polynomial, names, &values) else { continue };
            // At the origin all terms may be rounding errors.
            let part = value.norm() / (size + 1e-6);
            if !(part <= VANISHING) {
                return Err(Error::Invalid(format!(
                    "the equation \"{}\" does not vanish at solution {number} of the solver, but is {part:.1e} of the size of its \
                     terms: derivation and solver contradict each other, a fault of this program",
                    equation.name
                )));
            }
            found.values += 1;
            found.largest = found.largest.max(part);
        }
    }
    Ok(found)
}

/// Returns cosine, sine and half-angle tangent, or distance, of every joint variable.
fn joints(chain: &Chain, q: &[Complex<f64>]) -> Values {
    let mut values = Values::new();
    let mut q = q.iter();
    let rotation = |values: &mut Values, label: &str, angle: Option<&Complex<f64>>| {
        let Some(angle) = angle else { return };
        let half = (angle * 0.5).tan();
        values.insert(format!("c{label}"), angle.cos());
        values.insert(format!("s{label}"), angle.sin());
        if half.norm() < AT_PI {
            values.insert(format!("t{label}"), half);
        }
    };
    for variable in chain.variables() {
        let number = variable.number();
        match variable.variable {
            Variable::Rotation => rotation(&mut values, &number, q.next()),
            Variable::Translation => values.extend(q.next().map(|distance| (format!("d{number}"), *distance))),
        }
    }
    values
}

/// Returns Study's parameters of a pose.
fn study(q: &[Complex<f64>]) -> Values {
    let &[w, i, j, k, x, y, z] = q else { return Values::new() };
    let rotation = Quaternion { scalar: w, vector: [i, j, k] };
    let y = Quaternion { scalar: Complex::ZERO, vector: [x, y, z] }.mul(&rotation);
    let list = |letter: char, quaternion: Quaternion<Complex<f64>>| {
        let [a, b, c] = quaternion.vector;
        [quaternion.scalar, a, b, c].into_iter().enumerate().map(move |(n, value)| (format!("{letter}{n}"), value))
    };
    list('x', rotation).chain(list('y', y)).collect()
}

/// Returns the value of a polynomial of moderate coefficients.
fn number(polynomial: &Polynomial<Rational>, names: &Names, values: &Values) -> Option<Complex<f64>> {
    let largest = polynomial.coefficients().iter().map(|c| c.clone().abs()).max()?;
    value(polynomial, names, values).map(|(value, _)| value * largest.to_f64())
}

/// Returns the value of a polynomial, and the sum of the sizes of its terms, both over the largest coefficient; `None` if
/// a variable has no value.
fn value(polynomial: &Polynomial<Rational>, names: &Names, values: &Values) -> Option<(Complex<f64>, f64)> {
    let largest = polynomial.coefficients().iter().map(|c| c.clone().abs()).max()?;
    let list: Vec<Option<&Complex<f64>>> = names.list().iter().map(|name| values.get(name)).collect();
    let (mut sum, mut size) = (Complex::ZERO, 0.0);
    for (exponents, c) in polynomial.terms() {
        let mut term = Complex::from(Rational::from(c / &largest).to_f64());
        for (value, exponent) in list.iter().zip(exponents).filter(|(_, exponent)| *exponent > 0) {
            term *= (*value)?.powi(i32::try_from(exponent).ok()?);
        }
        sum += term;
        size += term.norm();
    }
    Some((sum, size))
}
