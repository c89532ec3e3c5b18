//! `looproot poly resultant`

use super::arguments::ResultantOptions;
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::algebra::int::Int;
use looproot::algebra::resultant::resultant;
use looproot::algebra::ring::Ring;
use looproot::algebra::text::Fraction;
use rug::ops::Pow;

/// Eliminates a variable from two polynomials.
pub fn run(options: &ResultantOptions) -> Result<Exit, Fault> {
    let arguments: Vec<&str> = std::iter::once(&options.f).chain(&options.g).map(String::as_str).collect();
    let (polynomials, names) = input::exactly::<2>(&arguments, &options.read)?;
    input::check_degrees(&polynomials)?;
    let variable = names.known(&options.eliminate)?;
    let [f, g] = &polynomials;
    let result = of_fractions(f, g, variable);
    tell::results(&[result], &names, &options.write, &input::files(&arguments))?;
    Ok(Exit::Complete)
}

/// `res(f/a, g/b) = res(f, g) / (a^deg g b^deg f)`
pub fn of_fractions(f: &Fraction, g: &Fraction, variable: usize) -> Fraction {
    let numerator = resultant(&f.numerator, &g.numerator, variable);
    let power = |f: &Fraction, exponent: u32| Int::from(f.denominator.to_integer().pow(exponent));
    let denominator = power(f, g.numerator.degree(variable)).mul(&power(g, f.numerator.degree(variable)));
    Fraction { numerator, denominator }.reduced()
}
