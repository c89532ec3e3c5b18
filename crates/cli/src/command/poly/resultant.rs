//! `looproot poly resultant`

use super::arguments::ResultantOptions;
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::resultant::{eliminate, resultant};
use looproot_algebra::ring::Ring;
use looproot_algebra::text::Fraction;
use rug::ops::Pow;

/// Eliminates a variable from two polynomials.
pub fn run(options: &ResultantOptions) -> Result<Exit, Fault> {
    let arguments: Vec<&str> = std::iter::once(&options.f).chain(&options.g).map(String::as_str).collect();
    let (polynomials, names) = input::exactly::<2>(&arguments, &options.read)?;
    input::check_degrees(&polynomials)?;
    let variable = names.known(&options.eliminate)?;
    let [f, g] = &polynomials;
    let mut results = vec![of_fractions(f, g, variable)];
    if options.lift {
        let lift = eliminate(&f.numerator, &g.numerator, variable).lift;
        let numerator = Polynomial::from_coefficients_in(variable, lift.coefficients()).primitive_part();
        results.push(Fraction { numerator, denominator: Int::one() });
    }
    tell::results(&results, &names, &options.write, &input::files(&arguments))?;
    Ok(Exit::Complete)
}

/// Returns the resultant of fractions by `res(f/a, g/b) = res(f, g) / (a^deg g b^deg f)`.
pub fn of_fractions(f: &Fraction, g: &Fraction, variable: usize) -> Fraction {
    let numerator = resultant(&f.numerator, &g.numerator, variable);
    let power = |f: &Fraction, exponent: u32| Int::from(f.denominator.to_integer().pow(exponent));
    let denominator = power(f, g.numerator.degree(variable)).mul(&power(g, f.numerator.degree(variable)));
    Fraction { numerator, denominator }.reduced()
}
