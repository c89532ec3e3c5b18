//! `looproot poly roots`

use super::arguments::{ReadOptions, RootsOptions};
use super::{input, tell};
use crate::command::exit::{Exit, Fault};
use looproot::internal::error::Error;
use looproot::internal::report::number::counted;
use looproot::internal::report::table::Columns;
use looproot_algebra::int::Int;
use looproot_algebra::real_roots::RealRoot;
use looproot_algebra::text::{Fraction, Names};
use looproot_algebra::univariate::Univariate;
use rug::Rational;
use serde_json::{Value, json};

/// Maximum degree for a second count of the roots by Sturm's theorem, which takes longer than isolating them.
const HIGHEST_STURM: usize = 200;

/// Finds all real roots of a polynomial in one variable.
pub fn run(options: &RootsOptions) -> Result<Exit, Fault> {
    let argument = &[options.polynomial.as_str()];
    let ([f], names) = input::exactly(argument, &ReadOptions { vars: None })?;
    input::check_degrees(std::slice::from_ref(&f))?;
    let (polynomial, name) = univariate(&f, &names)?;
    let mut roots = polynomial.real_roots();
    let sturm = (polynomial.degree() <= Some(HIGHEST_STURM)).then(|| polynomial.distinct_real_roots());
    let write = if options.write.json { document } else { table };
    let text = write(&mut roots, &polynomial, name, sturm);
    tell::write(&text, options.write.output.as_ref(), &input::files(argument))?;
    Ok(match sturm {
        Some(count) if count != roots.len() => Exit::NotProved,
        _ if roots.is_empty() => Exit::Unreachable,
        _ => Exit::Complete,
    })
}

/// Returns the polynomial in its only variable, and the name of the variable.
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

/// Returns a text like `3 distinct real roots of degree 5 in x, 4 with multiplicity; Sturm's theorem counts 3`.
fn verdict(roots: &[RealRoot], polynomial: &Univariate<Rational>, name: &str, sturm: Option<usize>) -> String {
    let degree = polynomial.degree().unwrap_or(0);
    let total: usize = roots.iter().map(RealRoot::multiplicity).sum();
    let count = counted(roots.len(), "distinct real root").replacen("0 ", "no ", 1);
    let count = if roots.is_empty() { count.replace("distinct ", "") } else { count };
    let tail = if total > roots.len() { format!(", {total} with multiplicity") } else { String::new() };
    let check = sturm.map_or_else(String::new, |count| {
        let word = if count == roots.len() { "" } else { "CONTRADICTION: " };
        format!("; {word}Sturm's theorem counts {count}")
    });
    format!("{count} of degree {degree} in {name}{tail}{check}")
}

fn table(roots: &mut [RealRoot], polynomial: &Univariate<Rational>, name: &str, sturm: Option<usize>) -> String {
    let mut text = verdict(roots, polynomial, name, sturm) + "\n";
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

fn document(roots: &mut [RealRoot], polynomial: &Univariate<Rational>, name: &str, sturm: Option<usize>) -> String {
    let root = |root: &mut RealRoot| -> Value {
        // This narrows the interval, too.
        let (value, exact) = (root.to_f64(), root.rational());
        let (lower, upper) = root.bounds();
        json!({
            "value": value, "multiplicity": root.multiplicity(), "exact": exact.map(|q| q.to_string()),
            "interval": [lower.to_string(), upper.to_string()],
        })
    };
    let roots: Vec<String> = roots.iter_mut().map(|r| format!("\n{}", root(r))).collect();
    let degree = polynomial.degree().unwrap_or(0);
    let (name, sturm) = (json!(name), json!(sturm));
    let roots = roots.join(",");
    format!("{{ \"variable\": {name}, \"degree\": {degree}, \"sturm\": {sturm}, \"roots\": [{roots}\n] }}\n")
}
