//! The expressions a file may write for a number: `3/10`, `-acos(3/5)`, `sqrt(2)/2`, `90 deg`.
//!
//! ```text
//! text    = sum [unit]              unit   = deg | rad | m | cm | mm
//! sum     = term { (+|-) term }     term   = factor { (*|/) factor }
//! factor  = { +|- } ( number | pi | ( sum ) | function ( sum [, sum] ) | (cos|sin|tan) ( sum [deg|rad] ) )
//! ```
//!
//! Without a unit the argument of cos, sin and tan is in radians, whatever the unit of plain angles in the file.

use super::value::{Value, decimal};
use rug::{Integer, Rational};

/// Longest expression read, in bytes.
const LONGEST: usize = 1000;
/// Deepest nesting read.
const DEEPEST: usize = 32;
/// Largest decimal exponent read.
const LARGEST_EXPONENT: i32 = 400;

/// A unit written behind a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    Degree,
    Radian,
    Metre,
    Centimetre,
    Millimetre,
}

/// An expression, evaluated.
pub(super) struct Quantified {
    pub(super) value: Value,
    pub(super) unit: Option<Unit>,
}

/// Reads and evaluates an expression; the error states what was found.
pub(super) fn evaluate(text: &str) -> Result<Quantified, String> {
    if text.len() > LONGEST {
        return Err(format!("an expression of {} characters (at most {LONGEST} are read)", text.len()));
    }
    let mut reader = Reader { rest: text.trim(), depth: 0 };
    if reader.rest.is_empty() {
        return Err("nothing".to_owned());
    }
    let before = reader.rest;
    let (value, terms) = reader.sum()?;
    let unit = reader.unit()?;
    if !reader.rest.is_empty() {
        return Err(format!("`{}` that cannot be read at `{}`", shortened(before), shortened(reader.rest)));
    }
    if unit.is_some() && terms > 1 {
        return Err(one_unit(before));
    }
    Ok(Quantified { value, unit })
}

/// Reads a decimal or an integer with or without a unit, the common case: nothing has to be enclosed. `None` for everything else, faults
/// included.
pub(super) fn plain(text: &str) -> Option<(Rational, Option<Unit>)> {
    let mut reader = Reader { rest: text.trim(), depth: 0 };
    let negative = reader.symbol('-');
    if text.len() > LONGEST || !reader.rest.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let size = reader.rational().ok()?;
    let unit = reader.unit().ok()?;
    reader.rest.is_empty().then(|| (if negative { -size } else { size }, unit))
}

/// Returns the text, cut to a readable length.
pub(super) fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 {
        return text.to_owned();
    }
    let head: String = text.chars().take(37).collect();
    format!("{head}...")
}

fn one_unit(sum: &str) -> String {
    format!("`{}`, a sum with one unit; write the sum in parentheses", shortened(sum.trim_end()))
}

fn without_argument(function: &str) -> String {
    format!("`{function}` without an argument in parentheses")
}

struct Reader<'a> {
    rest: &'a str,
    depth: usize,
}

impl<'a> Reader<'a> {
    /// Reads a sum, and counts its terms.
    fn sum(&mut self) -> Result<(Value, usize), String> {
        let mut value = self.term()?;
        let mut terms = 1;
        loop {
            let negative = if self.symbol('+') {
                false
            } else if self.symbol('-') {
                true
            } else {
                return Ok((value, terms));
            };
            let term = self.term()?;
            value = value.add(&if negative { term.neg() } else { term }).checked()?;
            terms += 1;
        }
    }

    fn term(&mut self) -> Result<Value, String> {
        let mut value = self.factor()?;
        loop {
            if self.symbol('*') {
                value = value.mul(&self.factor()?).checked()?;
            } else if self.symbol('/') {
                value = value.div(&self.factor()?)?.checked()?;
            } else {
                return Ok(value);
            }
        }
    }

    fn factor(&mut self) -> Result<Value, String> {
        let mut negative = false;
        loop {
            if self.symbol('-') {
                negative = !negative;
            } else if !self.symbol('+') {
                break;
            }
        }
        let value = self.primary()?.checked()?;
        Ok(if negative { value.neg() } else { value })
    }

    fn primary(&mut self) -> Result<Value, String> {
        if self.symbol('(') {
            return self.inside();
        }
        if self.rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return self.number();
        }
        let name = self.word();
        match name {
            "pi" => Ok(Value::from_turns(Rational::from(1), true)),
            "sqrt" => self.argument(name)?.sqrt(),
            "cos" => Ok(self.angle(name)?.cos()),
            "sin" => Ok(self.angle(name)?.sin()),
            "tan" => self.angle(name)?.tan(),
            "acos" => self.argument(name)?.acos(),
            "asin" => self.argument(name)?.asin(),
            "atan" => self.argument(name)?.atan2(&Value::from_rational(Rational::from(1))),
            "atan2" => self.arctangent(),
            "inf" | "infinity" | "nan" => Err(format!("`{name}`, not a finite number")),
            "" if self.rest.is_empty() => Err("an expression that ends too early".to_owned()),
            "" => Err(format!("`{}` where a number should stand", shortened(self.rest))),
            _ => Err(format!(
                "`{}`, neither a number, pi nor one of sqrt, cos, sin, tan, acos, asin, atan, atan2",
                shortened(name)
            )),
        }
    }

    fn argument(&mut self, function: &str) -> Result<Value, String> {
        if !self.symbol('(') {
            return Err(without_argument(function));
        }
        self.inside()
    }

    /// Reads the argument of a function of an angle, in radians.
    fn angle(&mut self, function: &str) -> Result<Value, String> {
        if !self.symbol('(') {
            return Err(without_argument(function));
        }
        self.enter()?;
        let before = self.rest;
        let (value, terms) = self.sum()?;
        let unit = self.unit()?;
        if unit.is_some() && terms > 1 {
            return Err(one_unit(&before[..before.len() - self.rest.len()]));
        }
        let value = match unit {
            None | Some(Unit::Radian) => value,
            Some(Unit::Degree) => value.mul(&Value::from_turns(Rational::from((1, 180)), true)).checked()?,
            Some(_) => return Err(format!("`{function}` of a length, where an angle should stand")),
        };
        self.leave()?;
        Ok(value)
    }

    fn arctangent(&mut self) -> Result<Value, String> {
        let wrong = || "`atan2` without two arguments (y, x)".to_owned();
        if !self.symbol('(') {
            return Err(wrong());
        }
        self.enter()?;
        let (y, _) = self.sum()?;
        if !self.symbol(',') {
            return Err(wrong());
        }
        let (x, _) = self.sum()?;
        self.leave()?;
        y.atan2(&x)
    }

    /// Reads the rest of a parenthesis.
    fn inside(&mut self) -> Result<Value, String> {
        self.enter()?;
        let (value, _) = self.sum()?;
        self.leave()?;
        Ok(value)
    }

    fn enter(&mut self) -> Result<(), String> {
        self.depth += 1;
        if self.depth > DEEPEST { Err(format!("parentheses nested deeper than {DEEPEST}")) } else { Ok(()) }
    }

    fn leave(&mut self) -> Result<(), String> {
        self.depth -= 1;
        if self.symbol(')') { Ok(()) } else { Err("a parenthesis that is not closed".to_owned()) }
    }

    fn symbol(&mut self, symbol: char) -> bool {
        let found = self.rest.strip_prefix(symbol);
        if let Some(rest) = found {
            self.rest = rest.trim_start();
        }
        found.is_some()
    }

    fn word(&mut self) -> &'a str {
        let end = self.rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        word
    }

    /// Digits, with underscores between them as in TOML.
    fn digits(&mut self) -> &'a str {
        let end = self.rest.find(|c: char| !c.is_ascii_digit() && c != '_').unwrap_or(self.rest.len());
        let (digits, rest) = self.rest.split_at(end);
        self.rest = rest;
        digits
    }

    fn number(&mut self) -> Result<Value, String> {
        self.rational().map(Value::from_rational)
    }

    fn rational(&mut self) -> Result<Rational, String> {
        let start = self.rest;
        let whole = self.digits();
        let mut fraction = "";
        if let Some(rest) = self.rest.strip_prefix('.') {
            self.rest = rest;
            fraction = self.digits();
        }
        let mut exponent = 0;
        let behind = self.rest.strip_prefix(['e', 'E']);
        if let Some(behind) = behind.filter(|b| b.starts_with(|c: char| c.is_ascii_digit() || c == '+' || c == '-')) {
            self.rest = behind;
            let negative = self.rest.starts_with('-');
            self.rest = self.rest.strip_prefix(['+', '-']).unwrap_or(self.rest);
            let size: i32 = self.digits().parse().unwrap_or(i32::MAX);
            if size > LARGEST_EXPONENT {
                return Err(format!("`{}`, a power of ten beyond {LARGEST_EXPONENT}", shortened(start)));
            }
            exponent = if negative { -size } else { size };
        }
        let digits: String = whole.chars().chain(fraction.chars()).filter(|c| *c != '_').collect();
        let fraction_digits = fraction.chars().filter(|c| *c != '_').count();
        let parsed = Integer::parse(&digits).map(Integer::from);
        let (Ok(integer), Ok(places)) = (parsed, i32::try_from(fraction_digits)) else {
            return Err(format!("`{}`, not a number", shortened(start)));
        };
        self.rest = self.rest.trim_start();
        Ok(decimal(integer, exponent - places))
    }

    fn unit(&mut self) -> Result<Option<Unit>, String> {
        if !self.rest.starts_with(|c: char| c.is_ascii_alphabetic()) {
            return Ok(None);
        }
        match self.word() {
            "deg" => Ok(Some(Unit::Degree)),
            "rad" => Ok(Some(Unit::Radian)),
            "m" => Ok(Some(Unit::Metre)),
            "cm" => Ok(Some(Unit::Centimetre)),
            "mm" => Ok(Some(Unit::Millimetre)),
            word @ ("pi" | "sqrt" | "sin" | "cos" | "tan") => {
                Err(format!("`{word}` right behind a number; a product needs `*`, as in `2*{word}`"))
            }
            word => Err(format!("unit `{}`, which is none of deg, rad, m, cm, mm", shortened(word))),
        }
    }
}
