//! The grammar, by recursive descent.
//!
//! ```text
//! sum     = term { ("+" | "-") term }
//! term    = factor { ("*" | "/") factor }
//! factor  = { "+" | "-" } primary [ ("^" | "**") exponent ]
//! primary = number | name | "(" sum ")"
//! ```

use super::expression::Node;
use super::fault::{Fault, Place};
use super::names::Names;
use super::scanner::{Scanner, WORD_DIGITS, integer};
use super::terms::{MOST_TERMS, Terms, bits, power};
use crate::int::Int;
use crate::monomial::LARGEST_EXPONENT;
use crate::ring::Ring;
use std::cmp::Ordering;

/// Parentheses nested deeper than this are refused.
const DEEPEST: usize = 500;
/// Room is made for this many terms before they are read.
pub(super) const MOST_EXPECTED: usize = 1 << 16;
/// Number of digits up to which an exponent needs no check of its size.
pub(super) const MOST_EXPONENT_DIGITS: usize = 6;
/// Powers of numbers may have this many bits in one text, all taken together.
const LARGEST_POWERS: u64 = 100_000_000;

/// Reads a text that is one polynomial.
pub(super) fn one(text: &str, names: &mut Names) -> Result<Node, Fault> {
    let mut parser = Parser::new(text, names);
    let node = parser.sum()?;
    match parser.scanner.peek() {
        0 => Ok(node),
        _ => Err(parser.unexpected("an operator or the end")),
    }
}

/// Reads a text of polynomials with `;` between them.
pub(super) fn all(text: &str, names: &mut Names) -> Result<Vec<Node>, Fault> {
    let mut parser = Parser::new(text, names);
    let mut nodes = Vec::new();
    loop {
        nodes.push(parser.sum()?);
        let more = parser.scanner.eat(b';');
        match (parser.scanner.peek(), more) {
            (0, _) => return Ok(nodes),
            (_, true) => {}
            (_, false) => return Err(parser.unexpected("an operator, `;` or the end")),
        }
    }
}

/// Reads a matrix: `[[a, b], [c, d]]`, `[a, b; c, d]`, or the latter without brackets.
pub(super) fn matrix(text: &str, names: &mut Names) -> Result<Vec<Vec<Node>>, Fault> {
    let mut parser = Parser::new(text, names);
    let bracket = parser.scanner.eat(b'[');
    let nested = bracket && parser.scanner.peek() == b'[';
    let mut rows = Vec::new();
    loop {
        if nested && !parser.scanner.eat(b'[') {
            return Err(parser.unexpected("`[`, the beginning of a row"));
        }
        let mut row = vec![parser.sum()?];
        while parser.scanner.eat(b',') {
            row.push(parser.sum()?);
        }
        if nested && !parser.scanner.eat(b']') {
            return Err(parser.unexpected("an operator, `,` or the `]` of the row"));
        }
        rows.push(row);
        let more = parser.scanner.eat(if nested { b',' } else { b';' });
        let at_end = parser.scanner.peek() == if bracket { b']' } else { 0 };
        match (more, at_end) {
            (_, true) => break,
            (true, false) => {}
            (false, false) if nested => return Err(parser.unexpected("`,` or the `]` of the matrix")),
            (false, false) => return Err(parser.unexpected("an operator, `,`, `;` or the end of the matrix")),
        }
    }
    parser.scanner.eat(b']');
    match parser.scanner.peek() {
        0 => Ok(rows),
        _ => Err(parser.unexpected("the end behind the matrix")),
    }
}

struct Parser<'t, 'n> {
    scanner: Scanner<'t>,
    names: &'n mut Names,
    depth: usize,
    /// Terms so far.
    terms: usize,
    /// Bits of powers of numbers so far.
    power_bits: u64,
}

/// A factor of a term.
enum Factor {
    /// Numerator and denominator.
    Number(Int, Int),
    /// A power of a variable.
    Variable(u32, u32),
    /// A parenthesis that holds one plain term.
    Term(Terms),
    /// Anything else.
    Other(Node),
}

impl<'t, 'n> Parser<'t, 'n> {
    fn new(text: &'t str, names: &'n mut Names) -> Self {
        Self { scanner: Scanner::new(text), names, depth: 0, terms: 0, power_bits: 0 }
    }

    fn unexpected(&mut self, expected: &str) -> Fault {
        let found = self.scanner.found();
        self.scanner.fault(format!("found {found}, expected {expected}"))
    }

    fn sum(&mut self) -> Result<Node, Fault> {
        // Most texts are one long sum of terms of about ten bytes; parentheses are short.
        let expected = if self.depth == 0 { self.scanner.remaining() / 8 } else { 0 };
        let (mut terms, mut others) = (Terms::with_capacity(expected.min(MOST_EXPECTED)), Vec::new());
        self.scanner.peek();
        let place = self.scanner.place();
        let mut negative = false;
        loop {
            if !self.plain_term(negative, &mut terms) {
                self.term(negative, &mut terms, &mut others)?;
            }
            negative = match self.scanner.peek() {
                b'+' => false,
                b'-' => true,
                _ => break,
            };
            self.scanner.advance(1);
        }
        Ok(match (terms.len(), others.len()) {
            (_, 0) => Node::Terms(place, terms.folded()),
            (0, 1) => others.remove(0),
            _ => Node::Sum(place, terms, others),
        })
    }

    /// Reads a term as programs write them, `-12*x^3*y**2`: digits, known names, small exponents. Returns
    /// false, and reads nothing, if there is anything else, right or wrong.
    fn plain_term(&mut self, negative: bool, terms: &mut Terms) -> bool {
        self.scanner.peek();
        let before = self.scanner;
        let complete = self.terms < MOST_TERMS && self.read_plain_term(negative, terms);
        if complete {
            self.terms += 1;
        } else {
            self.scanner = before;
            terms.drop_term();
        }
        complete
    }

    fn read_plain_term(&mut self, negative: bool, terms: &mut Terms) -> bool {
        let bytes = self.scanner.rest();
        let byte = |at: usize| bytes.get(at).copied().unwrap_or(0);
        let number = |start: usize| {
            let (mut value, mut at) = (0_i64, start);
            while let Some(digit) = bytes.get(at).map(|byte| byte.wrapping_sub(b'0')).filter(|digit| *digit < 10) {
                value = value.wrapping_mul(10).wrapping_add(i64::from(digit));
                at += 1;
            }
            (value, at)
        };
        let (value, mut at) = number(0);
        let mut coefficient = match at {
            0 => Int::one(),
            1..=WORD_DIGITS => Int::from(value),
            _ => integer(self.scanner.next(at)),
        };
        let mut more = at == 0 || byte(at) == b'*';
        at += usize::from(more && at > 0);
        while more {
            let (mut name, start) = (0, at);
            while let Some(letter) = bytes.get(at).filter(|byte| byte.is_ascii_alphanumeric() || **byte == b'_') {
                name = name << 8 | u64::from(*letter);
                at += 1;
            }
            if at == start || at - start > 8 || byte(at) == b'\'' {
                return false;
            }
            let Some(variable) = self.names.position(name) else { return false };
            let power = byte(at) == b'^' || byte(at) == b'*' && byte(at + 1) == b'*';
            let mut exponent = 1;
            if power {
                let start = at + if byte(at) == b'^' { 1 } else { 2 };
                (exponent, at) = number(start);
                if at == start || at - start > MOST_EXPONENT_DIGITS {
                    return false;
                }
            }
            let (Ok(variable), Ok(exponent)) = (u32::try_from(variable), u32::try_from(exponent)) else { return false };
            if terms.multiply(variable, exponent).is_none() {
                return false;
            }
            more = byte(at) == b'*';
            at += usize::from(more);
        }
        self.scanner.advance(at);
        // Digits after a name are part of it, digits before a name lack their `*`, and all else is to be complained about.
        if !matches!(self.scanner.peek(), 0 | b'+' | b'-' | b')' | b',' | b';' | b']') {
            return false;
        }
        if negative {
            coefficient = coefficient.neg();
        }
        terms.finish_whole_term(coefficient);
        true
    }

    /// Reads a product, and adds it to the plain terms or else to the others.
    fn term(&mut self, negative: bool, terms: &mut Terms, others: &mut Vec<Node>) -> Result<(), Fault> {
        let (mut numerator, mut denominator) = (Int::from(if negative { -1_i64 } else { 1 }), Int::one());
        let mut factors = Vec::new();
        let mut divide = false;
        self.scanner.peek();
        let start = self.scanner.place();
        self.terms += 1;
        if self.terms > MOST_TERMS {
            return Err(Fault::new(start, format!("found more than the {MOST_TERMS} terms possible")));
        }
        loop {
            while let sign @ (b'+' | b'-') = self.scanner.peek() {
                self.scanner.advance(1);
                if sign == b'-' {
                    numerator = numerator.neg();
                }
            }
            let place = self.scanner.place();
            let factor = self.factor()?;
            let factor = if divide { inverse(&factor, place)? } else { factor };
            match factor {
                Factor::Number(n, d) => {
                    numerator = numerator.mul(&n);
                    denominator = denominator.mul(&d);
                }
                Factor::Variable(variable, exponent) => {
                    terms.multiply(variable, exponent).ok_or_else(|| too_large(place))?;
                }
                Factor::Term(term) => {
                    let (n, d, powers) = term.single().unwrap_or_else(|| (Int::one(), Int::one(), &[]));
                    numerator = numerator.mul(&n);
                    denominator = denominator.mul(&d);
                    for &(variable, exponent) in powers {
                        terms.multiply(variable, exponent).ok_or_else(|| too_large(place))?;
                    }
                }
                Factor::Other(node) => factors.push(node),
            }
            divide = match self.scanner.peek() {
                b'*' => false,
                b'/' => true,
                b'0'..=b'9' | b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'(' => return Err(self.juxtaposed()),
                _ => break,
            };
            self.scanner.advance(1);
        }
        if factors.is_empty() {
            terms.finish_term(numerator, denominator);
            return Ok(());
        }
        let plain = terms.split_term(numerator, denominator);
        let is_one = plain.single().is_some_and(|(n, d, powers)| n == Int::one() && d == n && powers.is_empty());
        if plain.len() == 0 {
            return Ok(());
        }
        if factors.len() == 1 && is_one {
            others.append(&mut factors);
            return Ok(());
        }
        if !is_one {
            factors.push(Node::Terms(start, plain));
        }
        others.push(Node::Product(start, factors));
        Ok(())
    }

    fn juxtaposed(&mut self) -> Fault {
        let found = self.scanner.found();
        self.scanner
            .fault(format!("found {found} where an operator should stand; write products with `*`: 2*x, not 2x"))
    }

    fn factor(&mut self) -> Result<Factor, Fault> {
        let place = self.scanner.place();
        let base = match self.scanner.peek() {
            b'0'..=b'9' | b'.' => {
                let (numerator, denominator) = self.scanner.number()?;
                Factor::Number(numerator, denominator)
            }
            b'A'..=b'Z' | b'a'..=b'z' | b'_' => {
                let name = self.scanner.name();
                let variable = self.names.look_up(name).map_err(|message| Fault::new(place, message))?;
                Factor::Variable(u32::try_from(variable).map_err(|_| too_large(place))?, 1)
            }
            b'(' => match self.parenthesis()? {
                Node::Terms(_, terms) if terms.len() < 2 => Factor::Term(terms),
                node => Factor::Other(node),
            },
            _ => return Err(self.unexpected("a number, a variable or `(`")),
        };
        match self.scanner.peek() {
            b'^' => self.scanner.advance(1),
            b'*' if self.scanner.second() == b'*' => self.scanner.advance(2),
            _ => return Ok(base),
        }
        let exponent = self.exponent()?;
        if matches!(self.scanner.peek(), b'^') || (self.scanner.peek() == b'*' && self.scanner.second() == b'*') {
            return Err(self.unexpected("parentheses around one of the powers, as in (x^2)^3"));
        }
        self.raise(base, exponent, place)
    }

    fn parenthesis(&mut self) -> Result<Node, Fault> {
        let open = self.scanner.place();
        if self.depth == DEEPEST {
            return Err(self.scanner.fault(format!("found parentheses nested deeper than {DEEPEST}")));
        }
        self.scanner.advance(1);
        self.depth += 1;
        let node = self.sum()?;
        self.depth -= 1;
        if !self.scanner.eat(b')') {
            let Place { line, column } = open;
            let opened = format!("an operator or `)` for the `(` in line {line}, column {column}");
            return Err(self.unexpected(&opened));
        }
        Ok(node)
    }

    /// Reads a whole number, optionally in parentheses.
    fn exponent(&mut self) -> Result<u32, Fault> {
        const EXPECTED: &str = "a whole number as exponent, not negative";
        let open = self.scanner.eat(b'(');
        self.scanner.eat(b'+');
        if !self.scanner.peek().is_ascii_digit() {
            return Err(self.unexpected(EXPECTED));
        }
        let place = self.scanner.place();
        let exponent = self.scanner.small().filter(|e| *e <= u64::from(LARGEST_EXPONENT));
        let exponent = exponent.and_then(|e| u32::try_from(e).ok()).ok_or_else(|| too_large(place))?;
        if open && !self.scanner.eat(b')') {
            return Err(self.unexpected("`)` behind the exponent"));
        }
        if self.scanner.peek() == b'.' {
            return Err(self.unexpected(EXPECTED));
        }
        Ok(exponent)
    }

    fn raise(&mut self, base: Factor, exponent: u32, place: Place) -> Result<Factor, Fault> {
        let raised =
            |e: u32| e.checked_mul(exponent).filter(|e| *e <= LARGEST_EXPONENT).ok_or_else(|| too_large(place));
        Ok(match base {
            _ if exponent == 0 => Factor::Number(Int::one(), Int::one()),
            Factor::Number(n, d) => {
                let (n, d) = self.raise_number(&n, &d, exponent, place)?;
                Factor::Number(n, d)
            }
            Factor::Variable(variable, e) => Factor::Variable(variable, raised(e)?),
            Factor::Term(term) => {
                let (n, d, powers) = term.single().unwrap_or_else(|| (Int::one(), Int::one(), &[]));
                let (n, d) = self.raise_number(&n, &d, exponent, place)?;
                let mut result = Terms::default();
                for &(variable, e) in powers {
                    result.multiply(variable, raised(e)?).ok_or_else(|| too_large(place))?;
                }
                result.finish_term(n, d);
                Factor::Term(result)
            }
            Factor::Other(node) if exponent == 1 => Factor::Other(node),
            Factor::Other(node) => Factor::Other(Node::Power(place, Box::new(node), exponent)),
        })
    }

    fn raise_number(&mut self, n: &Int, d: &Int, exponent: u32, place: Place) -> Result<(Int, Int), Fault> {
        let one = |n: &Int| n.to_i64().is_some_and(|n| n.unsigned_abs() < 2);
        let size = |n: &Int| if one(n) { 0 } else { bits(n).saturating_mul(u64::from(exponent)) };
        self.power_bits = self.power_bits.saturating_add(size(n)).saturating_add(size(d));
        if self.power_bits > LARGEST_POWERS {
            return Err(Fault::new(place, "found powers of numbers with too many digits".to_owned()));
        }
        Ok((power(n, exponent), power(d, exponent)))
    }
}

fn too_large(place: Place) -> Fault {
    Fault::new(place, format!("found an exponent above {LARGEST_EXPONENT}"))
}

/// Returns the factor by which a division by this one multiplies.
fn inverse(factor: &Factor, place: Place) -> Result<Factor, Fault> {
    let (n, d) = match factor {
        Factor::Number(n, d) => (n.clone(), d.clone()),
        Factor::Term(term) => match term.single() {
            Some((n, d, [])) => (n, d),
            _ => return Err(by_polynomial(place)),
        },
        Factor::Variable(..) | Factor::Other(_) => return Err(by_polynomial(place)),
    };
    match n.sign() {
        Ordering::Equal => Err(Fault::new(place, "found a division by zero".to_owned())),
        Ordering::Greater => Ok(Factor::Number(d, n)),
        Ordering::Less => Ok(Factor::Number(d.neg(), n.neg())),
    }
}

fn by_polynomial(place: Place) -> Fault {
    Fault::new(place, "found a division by variables, expected a number as divisor".to_owned())
}
