//! The JSON of polynomials: `{"vars": ["x", "y"], "terms": [["num", "den", [exponents]], ...]}`, or `polynomials`, a list
//! of objects with `terms`, in place of `terms`.

use super::fault::shortened;
use super::names::Names;
use crate::error::Error;
use crate::monomial::LARGEST_EXPONENT;
use crate::polynomial::Polynomial;
use rug::{Integer, Rational};
use serde_json::{Value, json};
use std::cmp::Ordering;
use std::fmt::Write;

/// Writes polynomials, one alone as an object with `terms`.
///
/// # Panics
/// When a polynomial has more variables than there are names.
#[must_use]
pub fn write_json(polynomials: &[Polynomial<Rational>], names: &Names) -> String {
    let count = names.list().len();
    let mut text = format!("{{\"vars\": {}, ", json!(names.list()));
    if let [one] = polynomials {
        write_terms(&mut text, one, count);
    } else {
        text.push_str("\"polynomials\": [");
        for (index, polynomial) in polynomials.iter().enumerate() {
            text.push_str(if index == 0 { "\n{" } else { ",\n{" });
            write_terms(&mut text, polynomial, count);
            text.push('}');
        }
        text.push(']');
    }
    text.push('}');
    text
}

fn write_terms(text: &mut String, polynomial: &Polynomial<Rational>, count: usize) {
    text.push_str("\"terms\": [");
    for (index, (mut exponents, c)) in polynomial.terms().enumerate() {
        assert!(exponents.iter().skip(count).all(|&e| e == 0), "every variable has a name");
        exponents.resize(count, 0);
        let comma = if index == 0 { "" } else { ", " };
        let exponents: Vec<String> = exponents.iter().map(u32::to_string).collect();
        // Writing to a string cannot fail.
        let _ = write!(text, "{comma}[\"{}\", \"{}\", [{}]]", c.numer(), c.denom(), exponents.join(", "));
    }
    text.push(']');
}

/// Reads the output of [`write_json`]. The names of the document are looked up in (or collected into) the given ones.
///
/// # Errors
/// [`Error::File`] if the text is no JSON, [`Error::Invalid`] if it has another form; both state what was found and expected.
pub fn read_json(text: &str, path: &str, names: &mut Names) -> Result<Vec<Polynomial<Rational>>, Error> {
    let document: Value = serde_json::from_str(text).map_err(|fault| Error::File {
        path: path.to_owned(),
        line: fault.line(),
        message: format!("found what is no JSON: {fault}"),
    })?;
    let wrong = |what: String| Error::Io { path: path.to_owned(), message: what };
    let missing = |key: &str, what: &str| wrong(format!("found no `{key}`, expected {what}"));
    let vars = document["vars"].as_array().ok_or_else(|| missing("vars", "a list of names"))?;
    let mut variables = Vec::new();
    for name in vars {
        let name = name.as_str().ok_or_else(|| wrong(format!("found the name {name}, expected a string")))?;
        // The rules for names are those of a list that is given.
        Names::given([name]).map_err(|fault| wrong(fault.to_string()))?;
        let variable = names.look_up(name).map_err(wrong)?;
        if variables.contains(&variable) {
            return Err(wrong(format!("found `{name}` twice in `vars`, expected it once")));
        }
        variables.push(variable);
    }
    let one = [&document];
    let several: Vec<&Value>;
    let polynomials = match document["polynomials"].as_array() {
        Some(list) => {
            several = list.iter().collect();
            &several[..]
        }
        None => &one[..],
    };
    let read = |polynomial: &&Value| {
        let terms = polynomial["terms"].as_array().ok_or_else(|| missing("terms", "a list of terms"))?;
        let terms: Result<Vec<_>, Error> =
            terms.iter().map(|term| read_term(term, &variables).map_err(wrong)).collect();
        Ok(Polynomial::from_terms(terms?))
    };
    polynomials.iter().map(read).collect()
}

fn read_term(term: &Value, variables: &[usize]) -> Result<(Vec<u32>, Rational), String> {
    let wrong = || format!("found the term {}, expected [\"num\", \"den\", [exponents]]", shortened(&term.to_string()));
    let integer = |value: &Value| Integer::parse(value.as_str()?).ok().map(Integer::from);
    let [numerator, denominator, exponents] = term.as_array().map(Vec::as_slice).ok_or_else(wrong)? else {
        return Err(wrong());
    };
    let numerator = integer(numerator).ok_or_else(wrong)?;
    let denominator = integer(denominator).ok_or_else(wrong)?;
    if denominator.cmp0() == Ordering::Equal {
        return Err(format!("found a denominator of zero in {}", shortened(&term.to_string())));
    }
    let exponents = exponents
        .as_array()
        .filter(|list| list.len() == variables.len())
        .ok_or_else(|| format!("found {}, expected {} exponents", shortened(&term.to_string()), variables.len()))?;
    let mut unpacked = vec![0; variables.iter().map(|v| v + 1).max().unwrap_or(0)];
    for (exponent, &variable) in exponents.iter().zip(variables) {
        let exponent = exponent.as_u64().and_then(|e| u32::try_from(e).ok()).filter(|e| *e <= LARGEST_EXPONENT);
        unpacked[variable] = exponent.ok_or_else(|| {
            format!("found {}, expected exponents from 0 to {LARGEST_EXPONENT}", shortened(&term.to_string()))
        })?;
    }
    Ok((unpacked, Rational::from((numerator, denominator))))
}
