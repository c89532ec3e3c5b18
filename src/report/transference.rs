//! From the sphere into space: the verdict first, then both equations and the offsets; as text and JSON.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::derivation::transference::Transfer;
use crate::error::Result;
use rug::Rational;
use serde_json::{Value, json};
use std::fmt::Write;

/// `f of 20 terms, over dual numbers g of 66; d4 = -(...)/(df/dtheta4)`
#[must_use]
pub fn verdict(transfer: &Transfer) -> String {
    let (f, g) = (transfer.f.len(), transfer.g.len());
    let given: Vec<&str> = transfer.offsets.iter().map(|(name, ..)| name.as_str()).collect();
    let offsets = if given.is_empty() { String::new() } else { format!("; g gives {}", given.join(" or ")) };
    format!("spherical equation f of {f} terms, over dual numbers a second one, g of {g}{offsets}")
}

fn plain(polynomial: &Polynomial<Rational>, names: &Names) -> String {
    Format::Text.polynomial(polynomial, names)
}

/// Everything for a reader.
#[must_use]
pub fn text(transfer: &Transfer) -> String {
    let names = &transfer.names;
    let mut text = format!("{}\n\n{}\n", verdict(transfer), transfer.title);
    for (number, step) in (1..).zip(&transfer.steps) {
        let _ = writeln!(text, "{number}. {step}");
    }
    let _ = write!(text, "\nf = {}\n\ng = {}\n", plain(&transfer.f, names), plain(&transfer.g, names));
    for (name, numerator, denominator) in &transfer.offsets {
        let _ = writeln!(text, "\n{name} = ({})/({})", plain(numerator, names), plain(denominator, names));
    }
    text
}

/// The equations as one document.
#[must_use]
pub fn json(transfer: &Transfer) -> Value {
    let names = &transfer.names;
    let equation =
        |name: &str, polynomial: &Polynomial<Rational>| json!({ "name": name, "text": plain(polynomial, names) });
    let offset = |(name, numerator, denominator): &(String, Polynomial<Rational>, Polynomial<Rational>)| json!({ "name": name, "numerator": plain(numerator, names), "denominator": plain(denominator, names) });
    json!({
        "title": transfer.title,
        "verdict": verdict(transfer),
        "symbols": names.list(),
        "equations": [equation("spherical f", &transfer.f), equation("dual part g", &transfer.g)],
        "offsets": transfer.offsets.iter().map(offset).collect::<Vec<_>>(),
        "steps": transfer.steps,
    })
}

/// Both equations in the language of another program.
///
/// # Errors
/// Where the language has no way to say it.
pub fn system(transfer: &Transfer, format: Format) -> Result<String> {
    Ok(format.system(&[transfer.f.clone(), transfer.g.clone()], &transfer.names)?)
}
