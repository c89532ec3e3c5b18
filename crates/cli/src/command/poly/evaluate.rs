//! `looproot poly evaluate`

use super::arguments::EvaluateOptions;
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::internal::error::Error;
use looproot_algebra::number::nearest_f64;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::text::{Expression, Format, Fraction, Names};
use rug::Rational;
use serde_json::json;

/// Computes the value of a polynomial, or the rest of it if some variables have values.
pub fn run(options: &EvaluateOptions) -> Result<Exit, Fault> {
    let argument = &[options.polynomial.as_str()];
    let mut names = input::names(&options.read)?;
    let source = input::Source::of(&options.polynomial)?;
    let inputs = input::files(argument);
    // An expression with numbers for all variables need not be multiplied out.
    if !source.is_json() {
        let expressions = Expression::parse_all(&source.text, &mut names).map_err(|fault| source.fault(fault))?;
        let [expression] = expressions.as_slice() else {
            return Err(Error::Invalid(format!("found {} polynomials, expected 1", expressions.len())).into());
        };
        let values = values(&options.at, &names)?;
        if let Some(values) = values.iter().cloned().collect::<Option<Vec<_>>>() {
            let value = expression.value(&values)?;
            tell::write(&told(&value, options.write.language()), options.write.output.as_ref(), &inputs)?;
            return Ok(Exit::Complete);
        }
        let fraction = expression.expand().map_err(|fault| source.fault(fault))?;
        return rest(&fraction, &values, &names, options);
    }
    let ([fraction], names) = input::exactly(argument, &options.read)?;
    let values = values(&options.at, &names)?;
    rest(&fraction, &values, &names, options)
}

/// Returns the value of each variable that has one.
fn values(at: &[String], names: &Names) -> Result<Vec<Option<Rational>>, Error> {
    let mut values = vec![None; names.list().len()];
    for text in at {
        let (name, number) = text.split_once('=').ok_or_else(|| {
            Error::Invalid(format!("found `{text}` behind --at, expected a variable and its value: x=1/2"))
        })?;
        let variable = names.known(name.trim())?;
        if values[variable].replace(input::number(number)?).is_some() {
            return Err(Error::Invalid(format!("found two values of `{}`, expected one", name.trim())));
        }
    }
    Ok(values)
}

fn rest(
    fraction: &Fraction,
    values: &[Option<Rational>],
    names: &Names,
    options: &EvaluateOptions,
) -> Result<Exit, Fault> {
    input::check_degrees(std::slice::from_ref(fraction))?;
    let mut polynomial = fraction.to_rational();
    for (variable, value) in values.iter().enumerate() {
        if let Some(value) = value {
            polynomial = polynomial.substitute(variable, &Polynomial::constant(value.clone()));
        }
    }
    let inputs = input::files(&[&options.polynomial]);
    match polynomial.to_constant() {
        Some(value) if values.iter().all(Option::is_some) => {
            tell::write(&told(&value, options.write.language()), options.write.output.as_ref(), &inputs)?;
        }
        _ => tell::results(&[Fraction::from_rational(&polynomial)], names, &options.write, &inputs)?,
    }
    Ok(Exit::Complete)
}

fn told(value: &Rational, format: Format) -> String {
    let float = nearest_f64(value);
    match format {
        Format::Json => {
            let (num, den) = (value.numer().to_string(), value.denom().to_string());
            format!("{}\n", json!({ "num": num, "den": den, "f64": float.is_finite().then_some(float) }))
        }
        _ if value.is_integer() => format!("{value}\n"),
        _ => format!("{value}\n# about {float:?}\n"),
    }
}
