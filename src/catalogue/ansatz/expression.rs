//! Lengths, angles and relations as they are written, with cosines and sines of symbols.

use super::{Symbols, Twist};
use crate::algebra::number::{Angle, Reading};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::exact_cos_sin;
use crate::algebra::text::Expression;
use crate::error::{Error, Result};
use rug::Rational;

/// The functions of an angle, in the order of their variables.
pub(super) const FUNCTIONS: [&str; 3] = ["cos", "sin", "tan_half"];

/// Words that occur in numbers.
const RESERVED: [&str; 15] =
    ["pi", "sqrt", "cos", "sin", "tan", "tan_half", "acos", "asin", "atan", "atan2", "deg", "rad", "m", "cm", "mm"];

/// The largest factor of an angle that is accepted.
const LARGEST_FACTOR: i32 = 12;

/// Returns the words of a text, each with its position.
fn words(text: &str) -> Vec<(usize, &str)> {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '\'';
    let mut words = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let rest = &text[at..];
        let length = rest.find(|c| !is_part(c)).unwrap_or(rest.len());
        if length == 0 {
            at += rest.chars().next().map_or(1, char::len_utf8);
            continue;
        }
        // 1e-3 is a number.
        if rest.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            words.push((at, &rest[..length]));
        }
        at += length;
    }
    words
}

/// Refuses a name that occurs in numbers.
pub(super) fn check_name(name: &str) -> Result<()> {
    if RESERVED.contains(&name) {
        return Err(Error::Invalid(format!(
            "found the symbol `{name}`, which has a meaning already; expected another name"
        )));
    }
    Ok(())
}

/// Returns whether a text is a number and no expression in symbols.
pub(super) fn is_number(text: &str) -> bool {
    words(text).iter().all(|(_, word)| RESERVED.contains(word))
}

/// Returns the words that are no part of a number and are not in `cos(...)`, `sin(...)` or `tan_half(...)`.
pub(super) fn bare_words(text: &str) -> Result<Vec<String>> {
    let flat = flattened(text)?;
    let is_function = |word: &str| FUNCTIONS.iter().any(|name| word.starts_with(&format!("{name}_")));
    let bare = |(_, word): &(usize, &str)| !RESERVED.contains(word) && !is_function(word);
    Ok(words(&flat).iter().filter(|word| bare(word)).map(|(_, word)| (*word).to_owned()).collect())
}

/// Replaces `cos(alpha)` by `cos_alpha `, which has the same length, so that positions remain valid.
fn flattened(text: &str) -> Result<String> {
    let mut flat = text.to_owned();
    for (at, word) in words(text) {
        let behind = &text[at + word.len()..];
        let gap = behind.len() - behind.trim_start().len();
        if !FUNCTIONS.contains(&word) || !behind.trim_start().starts_with('(') {
            continue;
        }
        let inside = &behind[gap + 1..];
        let length = inside.find(')').unwrap_or(inside.len());
        let name = inside[..length].trim();
        if name.is_empty() || length == inside.len() || words(name) != [(0, name)] {
            return Err(Error::Invalid(format!(
                "column {}: found `{word}` of something else than one symbol, expected `{word}(alpha)`",
                at + 1
            )));
        }
        let end = at + word.len() + gap + 1 + length + 1;
        flat.replace_range(at..end, &format!("{:<width$}", format!("{word}_{name}"), width = end - at));
    }
    Ok(flat)
}

/// Reads a polynomial in the variables of the symbols.
pub(super) fn polynomial(text: &str, symbols: &Symbols) -> Result<Polynomial<Rational>> {
    let flat = flattened(text)?;
    for (at, word) in words(&flat) {
        if symbols.angles.iter().any(|angle| angle == word) {
            let expected = format!("cos({word}), sin({word}) or tan_half({word})");
            return Err(Error::Invalid(format!(
                "column {}: found the angle `{word}` where a length is meant, expected {expected}",
                at + 1
            )));
        }
    }
    let mut names = symbols.names().clone();
    let expression = Expression::parse(&flat, &mut names).and_then(|expression| expression.expand());
    let fault = |fault: crate::algebra::text::Fault| {
        Error::Invalid(format!("column {}: {}", fault.place.column, fault.message))
    };
    Ok(expression.map_err(fault)?.to_rational())
}

/// Returns the terms of a sum outside parentheses, with their signs.
fn terms(text: &str) -> Vec<(bool, &str)> {
    let (mut terms, mut start, mut negative, mut depth) = (Vec::new(), 0, false, 0_usize);
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            '+' | '-' if depth == 0 => {
                let before = text[start..at].trim_end();
                if before.is_empty() {
                    negative ^= c == '-';
                    start = at + 1;
                } else if !before.ends_with(['*', '/']) {
                    terms.push((negative, &text[start..at]));
                    (start, negative) = (at + 1, c == '-');
                }
            }
            _ => {}
        }
    }
    terms.push((negative, &text[start..]));
    terms
}

/// Reads an angle: a sum of multiples of symbols and at most one number.
pub(super) fn twist(text: &str, symbols: &Symbols, reading: &Reading) -> Result<(Twist, bool)> {
    let count = symbols.angles.len();
    let mut sum = Twist { multiples: vec![0; count], constant: (Rational::from(1), Rational::new()) };
    if is_number(text) {
        let angle = Angle::parse(text, reading)?;
        sum.constant = exact_cos_sin(&angle);
        return Ok((sum, angle.is_exact()));
    }
    let mut exact = true;
    for (negative, term) in terms(text) {
        let sign = if negative { -1 } else { 1 };
        if is_number(term) {
            let angle = Angle::parse(term, reading)?;
            exact &= angle.is_exact();
            sum.constant = super::turned(&sum.constant, &exact_cos_sin(&angle), sign);
            continue;
        }
        let (factor, name) = match term.split_once('*') {
            None => ("1", term),
            Some((factor, name)) if is_number(factor) => (factor, name),
            Some((name, factor)) => (factor, name),
        };
        let (factor, name) = (factor.trim().parse::<i32>(), name.trim());
        let Some(factor) = factor.ok().filter(|factor| factor.abs() <= LARGEST_FACTOR) else {
            return Err(Error::Invalid(format!(
                "found `{}` in an angle, expected a symbol, perhaps times a whole number up to {LARGEST_FACTOR}",
                term.trim()
            )));
        };
        if symbols.lengths.iter().any(|length| length == name) {
            return Err(Error::Invalid(format!("found the length `{name}` in an angle, expected an angle")));
        }
        let Some(angle) = symbols.angles.iter().position(|angle| angle == name) else {
            let known =
                if symbols.angles.is_empty() { "none is declared".to_owned() } else { symbols.angles.join(", ") };
            return Err(Error::Invalid(format!(
                "found the unknown symbol `{name}`, expected one of the angles: {known}"
            )));
        };
        sum.multiples[angle] += sign * factor;
    }
    Ok((sum, exact))
}
