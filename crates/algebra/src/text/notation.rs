//! The notation of numbers, products and powers in each language.

use super::format::Format;
use crate::polynomial::Polynomial;
use rug::{Integer, Rational};
use std::fmt::Write;

/// The signs of a language.
struct Notation {
    plus: &'static str,
    minus: &'static str,
    power: &'static str,
    /// Before, between and behind numerator and denominator.
    fraction: [&'static str; 3],
}

impl Notation {
    const fn of(format: Format) -> Self {
        let usual = Self { plus: " + ", minus: " - ", power: "^", fraction: ["", "/", ""] };
        match format {
            Format::Sympy => Self { power: "**", fraction: ["Rational(", ", ", ")"], ..usual },
            Format::Julia => Self { fraction: ["", "//", ""], ..usual },
            Format::Msolve | Format::Phcpack => Self { plus: "+", minus: "-", ..usual },
            _ => usual,
        }
    }
}

/// Returns the polynomial in one line, in a language that writes `*` for products.
pub(super) fn plain<S: AsRef<str>>(format: Format, polynomial: &Polynomial<Rational>, names: &[S]) -> String {
    let notation = Notation::of(format);
    let mut text = String::new();
    for (exponents, c) in polynomial.terms() {
        let negative = c.is_negative();
        text.push_str(match (text.is_empty(), negative) {
            (true, true) => "-",
            (true, false) => "",
            (false, true) => notation.minus,
            (false, false) => notation.plus,
        });
        let mut first = true;
        if !c.numer().as_abs().eq(&1) || *c.denom() != 1 || exponents.iter().all(|&e| e == 0) {
            write_magnitude(&mut text, c, &notation);
            first = false;
        }
        for (variable, &exponent) in exponents.iter().enumerate().filter(|(_, e)| **e > 0) {
            if !std::mem::take(&mut first) {
                text.push('*');
            }
            text.push_str(names[variable].as_ref());
            if exponent > 1 {
                text.push_str(notation.power);
                write_number(&mut text, &exponent);
            }
        }
    }
    if text.is_empty() { "0".to_owned() } else { text }
}

fn write_magnitude(text: &mut String, c: &Rational, notation: &Notation) {
    let [before, between, behind] = notation.fraction;
    let numerator = c.numer().as_abs();
    if *c.denom() == 1 {
        return write_number(text, &*numerator);
    }
    text.push_str(before);
    write_number(text, &*numerator);
    text.push_str(between);
    write_number(text, c.denom());
    text.push_str(behind);
}

fn write_number(text: &mut String, number: &impl std::fmt::Display) {
    // Writing to a string cannot fail.
    let _ = write!(text, "{number}");
}

/// Returns the terms in LaTeX, each with its sign.
pub(super) fn latex(polynomial: &Polynomial<Rational>, names: &[String]) -> Vec<String> {
    let mut typeset: Vec<String> = names.iter().map(|name| latex_name(name)).collect();
    for variable in 0..names.len() {
        // `x1` and `x_1` look the same with an index.
        if typeset[..variable].contains(&typeset[variable]) {
            typeset[variable] = format!("\\mathrm{{{}}}", names[variable].replace('_', "\\_"));
        }
    }
    let mut terms = Vec::new();
    for (exponents, c) in polynomial.terms() {
        let mut term = match (terms.is_empty(), c.is_negative()) {
            (true, true) => "-".to_owned(),
            (true, false) => String::new(),
            (false, true) => "- ".to_owned(),
            (false, false) => "+ ".to_owned(),
        };
        let size: Integer = c.numer().clone().abs();
        let factors: Vec<String> = exponents
            .iter()
            .zip(&typeset)
            .filter(|(e, _)| **e > 0)
            .map(|(&e, name)| match e {
                1 => name.clone(),
                _ if name.contains('\'') => format!("({name})^{{{e}}}"),
                _ => format!("{name}^{{{e}}}"),
            })
            .collect();
        if *c.denom() != 1 {
            write_number(&mut term, &format!("\\frac{{{size}}}{{{}}} ", c.denom()));
        } else if size != 1 || factors.is_empty() {
            write_number(&mut term, &format!("{size} "));
        }
        term.push_str(&factors.join(" "));
        terms.push(term.trim_end().to_owned());
    }
    if terms.is_empty() { vec!["0".to_owned()] } else { terms }
}

const GREEK: [&str; 25] = [
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi", "psi", "omega", "Gamma", "Delta",
];

/// Returns `x_{12}` for x12 and x_12, Greek letters by their names, other words upright.
fn latex_name(name: &str) -> String {
    let body = name.trim_end_matches('\'');
    let primes = &name[body.len()..];
    let letters = body.trim_end_matches(|c: char| c.is_ascii_digit());
    let (stem, index) = match body.split_once('_') {
        Some((stem, index)) if !stem.is_empty() && !index.is_empty() => (stem, index.to_owned()),
        _ => (letters, body[letters.len()..].to_owned()),
    };
    let stem = match stem {
        _ if GREEK.contains(&stem) => format!("\\{stem}"),
        _ if stem.len() == 1 => stem.to_owned(),
        _ => format!("\\mathrm{{{}}}", stem.replace('_', "\\_")),
    };
    let index = index.replace('_', "\\_");
    let index = if index.is_empty() { String::new() } else { format!("_{{{index}}}") };
    format!("{stem}{index}{primes}")
}
