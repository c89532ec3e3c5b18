//! `looproot poly gcd` and `looproot poly factor-free`

use super::arguments::{FactorFreeOptions, GcdOptions};
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::internal::error::Error;
use looproot::internal::report::number::counted;
use looproot::internal::report::table::Columns;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::{Format, Fraction, write_json};
use rug::Rational;
use serde_json::{Value, json};

/// Finds the greatest common divisor: primitive, its first coefficient positive.
pub fn common(options: &GcdOptions) -> Result<Exit, Fault> {
    let arguments: Vec<&str> = std::iter::once(&options.f).chain(&options.g).map(String::as_str).collect();
    let (polynomials, names) = input::polynomials(&arguments, &options.read)?;
    input::check_degrees(&polynomials)?;
    let gcd = polynomials.iter().fold(Polynomial::<Int>::zero(), |gcd, f| gcd.gcd(&f.numerator));
    let result = Fraction { numerator: gcd.primitive_part(), denominator: Int::one() };
    tell::results(&[result], &names, &options.write, &input::files(&arguments))?;
    Ok(Exit::Complete)
}

/// Splits a polynomial into a number and square-free primitive factors.
pub fn square_free(options: &FactorFreeOptions) -> Result<Exit, Fault> {
    let argument = &[options.polynomial.as_str()];
    let ([f], names) = input::exactly(argument, &options.read)?;
    input::check_degrees(std::slice::from_ref(&f))?;
    if f.numerator.is_zero() {
        return Err(Error::Invalid("found zero, of which every polynomial is a factor".to_owned()).into());
    }
    let factors = f.numerator.square_free_decomposition();
    let rational = |p: &Polynomial<Int>| Fraction { numerator: p.clone(), denominator: Int::one() }.to_rational();
    // The factors are primitive, so the leading coefficients determine the number in front of them.
    let leading = |p: &Polynomial<Int>| p.coefficients().first().map_or_else(Int::zero, Clone::clone).to_integer();
    let powers = factors.iter().map(|(p, k)| (0..*k).map(|_| Rational::from(leading(p))).product::<Rational>());
    let product = powers.fold(Rational::from(f.denominator.to_integer()), |product, power| product * power);
    let number = Rational::from(leading(&f.numerator)) / product;
    let text = if options.write.json {
        let factor = |(p, k): &(Polynomial<Int>, usize)| -> Value {
            let mut document: Value = serde_json::from_str(&write_json(&[rational(p)], &names)).unwrap_or(Value::Null);
            json!({ "multiplicity": k, "terms": document["terms"].take() })
        };
        let factors: Vec<String> = factors.iter().map(|f| format!("\n{}", factor(f))).collect();
        let (vars, number) = (json!(names.list()), number.to_string());
        format!("{{ \"vars\": {vars}, \"number\": \"{number}\", \"factors\": [{}\n] }}\n", factors.join(","))
    } else {
        let mut text = format!("{}, number {number}\n", counted(factors.len(), "square-free factor"));
        let mut table = Columns::new(&["multiplicity", "degree", "terms", "factor"], &["factor"]);
        for (p, k) in &factors {
            let degree = p.total_degree().unwrap_or(0).to_string();
            table.row([k.to_string(), degree, p.len().to_string(), Format::Text.polynomial(&rational(p), &names)]);
        }
        if !factors.is_empty() {
            text.push_str(&format!("\n{}", table.text()));
        }
        text
    };
    tell::write(&text, options.write.output.as_ref(), &input::files(argument))?;
    Ok(Exit::Complete)
}
