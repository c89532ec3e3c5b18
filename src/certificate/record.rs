//! The text of certificates: JSON objects with known keys and no others.

use super::families;
use super::fault::{Fault, shortened, unreadable};
use super::mode::{Ball, Unproved};
use super::{polynomial, sweep};
use rug::{Integer, Rational, ops::Pow};
use serde_json::{Map, Value};

/// The `format` of every certificate.
pub const FORMAT: &str = "looproot-certificate";
/// The `version` of the format.
pub const VERSION: u64 = 1;
/// The `status` of an answer whose solutions form a curve.
pub(super) const SELF_MOTION: &str = "self-motion";
/// Maximum number of items of a list.
const LONGEST_LIST: usize = 1000;
/// Maximum number of digits of a decimal before and behind the point.
const LONGEST_DECIMAL: usize = 400;
/// Largest exponent of a decimal.
const LARGEST_EXPONENT: i32 = 400;

/// A certificate as read.
pub(super) struct Record {
    pub data: Map<String, Value>,
    pub claim: Claim,
    pub modes: Vec<Unproved>,
    pub proof: Vec<Value>,
}

/// The claim of a certificate.
#[derive(Default)]
pub(super) struct Claim {
    pub verb: String,
    pub status: String,
    pub proof: String,
    /// The number of all solutions of `solve`; `None` if the real ones alone are claimed.
    pub complex: Option<usize>,
    /// The real solutions of `solve`.
    pub real: Option<usize>,
    /// The dimension of the motion, for `mobility`.
    pub mobility: Option<usize>,
    /// The dimension of the self-motion of `solve`.
    pub self_motion: Option<usize>,
    /// The polynomial of `derive`.
    pub polynomial: Option<polynomial::Claim>,
    /// The families of `conditions`.
    pub families: Option<families::Claim>,
    /// The branches of `sweep`.
    pub sweep: Option<sweep::Claim>,
}

impl Record {
    /// Reads a certificate.
    pub(super) fn read(value: &Value) -> Result<Self, Fault> {
        let needed = ["format", "version", "data", "claim", "modes", "proof"];
        let [format, version, data, claim, modes, proof] = fields(value, needed, &["info"])?;
        if format.as_str() != Some(FORMAT) || version.as_u64() != Some(VERSION) {
            let (format, version) = (shortened(format), shortened(version));
            return unreadable(format!(
                "found format {format}, version {version}, expected {FORMAT}, version {VERSION}"
            ));
        }
        let Value::Object(data) = data else { return unreadable("found no table as `data`") };
        let claim = self::claim(claim)?;
        let modes = list(modes)?.iter().map(mode).collect::<Result<_, _>>()?;
        Ok(Self { data: data.clone(), claim, modes, proof: list(proof)?.to_vec() })
    }
}

fn claim(value: &Value) -> Result<Claim, Fault> {
    let is_mobility = value.get("verb").and_then(Value::as_str) == Some("mobility");
    let words = |verb: &Value, status: &Value, word: &Value| {
        Ok::<_, Fault>((text(verb)?.to_owned(), text(status)?.to_owned(), text(word)?.to_owned()))
    };
    if is_mobility {
        let [verb, status, word, mobility] = fields(value, ["verb", "status", "proof", "mobility"], &[])?;
        let (verb, status, proof) = words(verb, status, word)?;
        return Ok(Claim { verb, status, proof, mobility: Some(count(mobility)?), ..Claim::default() });
    }
    if value.get("verb").and_then(Value::as_str) == Some("conditions") {
        let needed = ["verb", "status", "proof", "families", "oblique_links", "moving_joints"];
        let [verb, status, word, families, links, joints] = fields(value, needed, &[])?;
        let (verb, status, proof) = words(verb, status, word)?;
        let families = Some(families::Claim::read(families, links, joints)?);
        return Ok(Claim { verb, status, proof, families, ..Claim::default() });
    }
    let is_sweep = value.get("verb").and_then(Value::as_str) == Some("sweep");
    if is_sweep && value.get("branches").is_some() {
        let needed = ["verb", "status", "proof", "branches", "circuits", "limits"];
        let [verb, status, word, branches, circuits, limits] = fields(value, needed, &[])?;
        let (verb, status, proof) = words(verb, status, word)?;
        let sweep = Some(sweep::Claim::read(branches, circuits, limits)?);
        return Ok(Claim { verb, status, proof, sweep, ..Claim::default() });
    }
    if value.get("status").and_then(Value::as_str) == Some(SELF_MOTION) {
        let [verb, status, word, dimension] = fields(value, ["verb", "status", "proof", "self_motion"], &[])?;
        let (verb, status, proof) = words(verb, status, word)?;
        return Ok(Claim { verb, status, proof, self_motion: Some(count(dimension)?), ..Claim::default() });
    }
    let of_polynomial = ["unknown", "degree", "polynomial"];
    let is_derived = value.get("verb").and_then(Value::as_str) == Some("derive");
    let (value, polynomial) = if is_derived {
        let needed = ["verb", "status", "proof", "real", "complex", "unknown", "degree", "polynomial"];
        let [.., unknown, degree, coefficients] = fields(value, needed, &[])?;
        let mut rest = value.clone();
        if let Value::Object(table) = &mut rest {
            table.retain(|key, _| !of_polynomial.contains(&key.as_str()));
        }
        (rest, Some(polynomial::Claim::read(unknown, degree, coefficients)?))
    } else {
        (value.clone(), None)
    };
    let value = &value;
    let [verb, status, word, real] = fields(value, ["verb", "status", "proof", "real"], &["complex"])?;
    let (verb, status, proof) = words(verb, status, word)?;
    let complex = value.get("complex").map(count).transpose()?;
    Ok(Claim { verb, status, proof, complex, real: Some(count(real)?), polynomial, ..Claim::default() })
}

fn mode(value: &Value) -> Result<Unproved, Fault> {
    let [centre, radius, real, multiplicity] = fields(value, ["centre", "radius", "real", "multiplicity"], &[])?;
    let Value::Bool(real) = real else { return unreadable("found no true or false as `real` of a mode") };
    let part = |part: &Value| match part {
        Value::Array(both) => match both.as_slice() {
            [re, im] => Ok((decimal(re)?, decimal(im)?)),
            _ => unreadable("found a number of a centre with other than two parts"),
        },
        other => Ok((decimal(other)?, Rational::new())),
    };
    let centre = list(centre)?.iter().map(part).collect::<Result<_, _>>()?;
    let ball = Ball { centre, radius: decimal(radius)?, real: *real };
    Ok(Unproved { ball, multiplicity: count(multiplicity)? })
}

/// Returns the values of a table that has these keys, possibly some of the optional ones, and no others.
pub(super) fn fields<'a, const N: usize>(
    value: &'a Value,
    needed: [&str; N],
    optional: &[&str],
) -> Result<[&'a Value; N], Fault> {
    let Value::Object(table) = value else {
        return unreadable(format!("found {}, expected a table with the keys {}", shortened(value), needed.join(", ")));
    };
    if let Some(key) = table.keys().find(|key| !needed.contains(&key.as_str()) && !optional.contains(&key.as_str())) {
        return unreadable(format!("found the unknown key `{}`", shortened(key)));
    }
    let mut found = [value; N];
    for (place, key) in found.iter_mut().zip(needed) {
        let Some(value) = table.get(key) else { return unreadable(format!("found no `{key}`, expected one")) };
        *place = value;
    }
    Ok(found)
}

pub(super) fn list(value: &Value) -> Result<&[Value], Fault> {
    match value {
        Value::Array(items) if items.len() <= LONGEST_LIST => Ok(items),
        _ => unreadable(format!("found {}, expected a list of at most {LONGEST_LIST}", shortened(value))),
    }
}

pub(super) fn text(value: &Value) -> Result<&str, Fault> {
    value.as_str().map_or_else(|| unreadable(format!("found {}, expected a text", shortened(value))), Ok)
}

/// Reads a small whole number.
pub(super) fn count(value: &Value) -> Result<usize, Fault> {
    let small = value.as_u64().filter(|count| *count < 1_000_000).and_then(|count| usize::try_from(count).ok());
    small.map_or_else(|| unreadable(format!("found {}, expected a whole number", shortened(value))), Ok)
}

/// Reads a decimal as a rational.
pub(super) fn decimal(value: &Value) -> Result<Rational, Fault> {
    let written = text(value)?;
    parsed(written)
        .map_or_else(|| unreadable(format!("found `{}`, expected a decimal number", shortened(&written))), Ok)
}

fn parsed(written: &str) -> Option<Rational> {
    let is_digits = |text: &str| text.len() <= LONGEST_DECIMAL && text.bytes().all(|b| b.is_ascii_digit());
    let negative = written.starts_with('-');
    let unsigned = written.strip_prefix(['-', '+']).unwrap_or(written);
    let (mantissa, exponent) = match unsigned.split_once(['e', 'E']) {
        Some((mantissa, exponent)) if exponent.len() <= 4 => (mantissa, exponent.parse::<i32>().ok()?),
        Some(_) => return None,
        None => (unsigned, 0),
    };
    let (head, tail) = mantissa.split_once('.').map_or((mantissa, None), |(head, tail)| (head, Some(tail)));
    let is_written = !head.is_empty() && is_digits(head) && tail.is_none_or(|tail| !tail.is_empty() && is_digits(tail));
    if !is_written || exponent.abs() > LARGEST_EXPONENT {
        return None;
    }
    let tail = tail.unwrap_or_default();
    let digits = format!("{head}{tail}").parse::<Integer>().ok()?;
    let power = exponent - i32::try_from(tail.len()).ok()?;
    let scale = Integer::from(10).pow(power.unsigned_abs());
    let size = if power < 0 { Rational::from((digits, scale)) } else { Rational::from(digits * scale) };
    Some(if negative { -size } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_exactly_or_not_at_all() {
        for (text, p, q) in [("0.25", 1, 4), ("-3e-1", -3, 10), ("12.5E1", 125, 1), ("+7", 7, 1)] {
            assert_eq!(parsed(text), Some(Rational::from((p, q))), "{text}");
        }
        for text in ["", ".5", "1.", "NaN", "1e999999999", "1e401", "inf", "0x1", "1_0", "--1", "1/2"] {
            assert_eq!(parsed(text), None, "{text}");
        }
    }
}
