//! Polynomials as results: a verdict in one line, then the polynomial.

use super::arguments::WriteOptions;
use crate::command::arguments::{Colour, OutputOptions};
use crate::command::exit::Fault;
use crate::command::output::Output;
use looproot::internal::report::number::counted;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::{Format, Fraction, Names};
use rug::Rational;
use std::path::PathBuf;

/// Writes a finished text to its destination, but into none of the files that were read.
pub fn write(text: &str, output: Option<&PathBuf>, inputs: &[PathBuf]) -> Result<(), Fault> {
    let options = OutputOptions { output: output.cloned(), color: Colour::Never };
    let place = output.and_then(|output| output.canonicalize().ok());
    let replaced = inputs.iter().find(|input| place.is_some() && input.canonicalize().ok() == place);
    let input = replaced.map(|input| input.display().to_string()).unwrap_or_default();
    Output::write(&options, &input, text)
}

/// Returns polynomials in the requested language; in our own with verdicts.
pub fn polynomials(results: &[Fraction], names: &Names, format: Format) -> Result<String, Fault> {
    let polynomials: Vec<Polynomial<Rational>> = results.iter().map(Fraction::to_rational).collect();
    if format != Format::Text {
        let mut text = format.system(&polynomials, names)?;
        if !text.ends_with('\n') {
            text.push('\n');
        }
        return Ok(text);
    }
    // Verdicts are comments, so that the output can be read again.
    let mut text = String::new();
    if results.len() > 1 {
        let variables = names.list().join(", ");
        text.push_str(&format!("# {} in {variables}\n\n", counted(results.len(), "polynomial")));
    }
    let one = |(result, polynomial): (&Fraction, &Polynomial<Rational>)| {
        format!("# {}\n{}", verdict(result, names), format.polynomial(polynomial, names))
    };
    let blocks: Vec<String> = results.iter().zip(&polynomials).map(one).collect();
    Ok(text + &blocks.join(";\n\n") + "\n")
}

/// Writes polynomials in the requested language.
pub fn results(results: &[Fraction], names: &Names, options: &WriteOptions, inputs: &[PathBuf]) -> Result<(), Fault> {
    write(&polynomials(results, names, options.language())?, options.output.as_ref(), inputs)
}

/// Returns a text like `degree 16 in x, 17 terms, content 1`.
pub fn verdict(result: &Fraction, names: &Names) -> String {
    let polynomial = &result.numerator;
    if polynomial.is_zero() {
        return "zero".to_owned();
    }
    let degrees: Vec<(usize, u32)> = polynomial.degrees().into_iter().enumerate().filter(|(_, d)| *d > 0).collect();
    let name = |variable: usize| &names.list()[variable];
    let degree = match degrees.as_slice() {
        [] => "a number".to_owned(),
        [(variable, degree)] => format!("degree {degree} in {}", name(*variable)),
        several => {
            let each: Vec<String> = several.iter().map(|(variable, d)| format!("{d} in {}", name(*variable))).collect();
            format!("degree {} ({})", polynomial.total_degree().unwrap_or(0), each.join(", "))
        }
    };
    format!("{degree}, {}, content {}", counted(polynomial.len(), "term"), content(result))
}

/// Returns the positive number by which the polynomial is a multiple of one with integer coefficients without common factor.
fn content(result: &Fraction) -> Rational {
    let numerator = result.numerator.coefficients().iter().fold(Int::zero(), |gcd, c| gcd.gcd(c));
    Rational::from((numerator.to_integer(), result.denominator.to_integer()))
}
