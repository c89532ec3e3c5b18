//! `looproot poly roots`

use super::arguments::{ReadOptions, RootsOptions};
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::algebra::int::Int;
use looproot::algebra::real_roots::RealRoot;
use looproot::algebra::text::{Fraction, Names};
use looproot::algebra::univariate::Univariate;
use looproot::error::Error;
use looproot::report::number::counted;
use looproot::report::table::Columns;
use rug::Rational;
use serde_json::{Value, json};

/// Finds all real roots of a polynomial in one variable.
pub fn run(options: &RootsOptions) -> Result<Exit, Fault> {
    let argument = &[options.polynomial.as_str()];
    let ([f], names) = input::exactly(argument, &ReadOptions { vars: None })?;
    input::check_degrees(std::slice::from_ref(&f))?;
    let (polynomial, name) = univariate(&f, &names)?;
    let mut roots = polynomial.real_roots();
    let text =
        if options.write.json { document(&mut roots, &polynomial, name) } else { table(&mut roots, &polynomial, name) };
    tell::write(&text, options.write.output.as_ref(), &input::files(argument))?;
    Ok(if roots.is_empty() { Exit::Unreachable } else { Exit::Complete })
}

/// The polynomial in its only variable, and the name of that.
fn univariate<'n>(f: &Fraction, names: &'n Names) -> Result<(Univariate<Rational>, &'n str), Error> {
    let degrees = f.numerator.degrees();
    let variables: Vec<usize> = (0..degrees.len()).filter(|&variable| degrees[variable] > 0).collect();
    let name = |variable: usize| names.list()[variable].as_str();
    match variables.as_slice() {
        [variable] => {
            let image = |c: &Int| Some(Rational::from(c.to_integer()));
            let polynomial = f.numerator.to_univariate(*variable).and_then(|p| p.map(image));
            let polynomial = polynomial.ok_or_else(|| Error::Invalid("found other variables".to_owned()))?;
            Ok((polynomial, name(*variable)))
        }
        [] => Err(Error::Invalid("found a number, expected a polynomial in one variable".to_owned())),
        several => {
            let found: Vec<&str> = several.iter().map(|&variable| name(variable)).collect();
            Err(Error::Invalid(format!("found the variables {}, expected one", found.join(", "))))
        }
    }
}

/// `3 distinct real roots of a polynomial of degree 5 in x, 4 counted with multiplicity`
fn verdict(roots: &[RealRoot], polynomial: &Univariate<Rational>, name: &str) -> String {
    let degree = polynomial.degree().unwrap_or(0);
    let total: usize = roots.iter().map(RealRoot::multiplicity).sum();
    let count = counted(roots.len(), "distinct real root").replacen("0 ", "no ", 1);
    let count = if roots.is_empty() { count.replace("distinct ", "") } else { count };
    let tail = if total > roots.len() { format!(", {total} with multiplicity") } else { String::new() };
    format!("{count} of degree {degree} in {name}{tail}")
}

fn table(roots: &mut [RealRoot], polynomial: &Univariate<Rational>, name: &str) -> String {
    let mut text = verdict(roots, polynomial, name) + "\n";
    if roots.is_empty() {
        return text;
    }
    let mut table = Columns::new(&["", name, "multiplicity", "between", "and"], &[name, "between", "and"]);
    for (index, root) in roots.iter_mut().enumerate() {
        let exact = root.rational();
        let (lower, upper) = root.enclosure();
        let number = |x: f64| format!("{x:?}");
        table.row([
            (index + 1).to_string(),
            exact
                .as_ref()
                .filter(|q| q.to_string().len() <= 24)
                .map_or_else(|| number(root.to_f64()), Rational::to_string),
            root.multiplicity().to_string(),
            if exact.is_some() { "exact".to_owned() } else { number(lower) },
            if exact.is_some() { String::new() } else { number(upper) },
        ]);
    }
    text.push('\n');
    text.push_str(&table.text());
    text
}

fn document(roots: &mut [RealRoot], polynomial: &Univariate<Rational>, name: &str) -> String {
    let root = |root: &mut RealRoot| -> Value {
        // Narrows the interval, too.
        let (value, exact) = (root.to_f64(), root.rational());
        let (lower, upper) = root.bounds();
        json!({
            "value": value, "multiplicity": root.multiplicity(), "exact": exact.map(|q| q.to_string()),
            "interval": [lower.to_string(), upper.to_string()],
        })
    };
    let roots: Vec<String> = roots.iter_mut().map(|r| format!("\n{}", root(r))).collect();
    let degree = polynomial.degree().unwrap_or(0);
    format!("{{ \"variable\": {}, \"degree\": {degree}, \"roots\": [{}\n] }}\n", json!(name), roots.join(","))
}
