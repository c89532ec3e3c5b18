//! The lexical elements of a text: spaces, numbers, names, and their places.

use super::fault::{Fault, Place, shortened};
use crate::error::Error;
use crate::int::Int;
use crate::ring::Ring;
use rug::{Integer, Rational, integer::Order, ops::Pow};

/// Largest decimal exponent read, as in `1e-400`.
const LARGEST_EXPONENT: u32 = 400;

/// The digits that fit a machine word, and the most that are put together piece by piece, which is faster than general conversion.
pub(super) const WORD_DIGITS: usize = 18;
const FEW_DIGITS: usize = 1200;
/// The digits of a piece, and what it multiplies the digits before it by.
const PIECE: usize = 16;
const TEN_TO_PIECE: u64 = 10_000_000_000_000_000;

/// A text and how far it is read.
#[derive(Clone, Copy)]
pub(super) struct Scanner<'t> {
    text: &'t str,
    at: usize,
    line: usize,
    line_start: usize,
}

impl<'t> Scanner<'t> {
    pub(super) const fn new(text: &'t str) -> Self {
        Self { text, at: 0, line: 1, line_start: 0 }
    }

    /// Bytes not read yet.
    pub(super) const fn remaining(&self) -> usize {
        self.text.len() - self.at
    }

    pub(super) const fn place(&self) -> Place {
        Place { line: self.line, column: self.at - self.line_start + 1 }
    }

    pub(super) const fn fault(&self, message: String) -> Fault {
        Fault::new(self.place(), message)
    }

    /// Returns the next byte after spaces and comments (`#` to the end of the line); 0 at the end.
    #[inline]
    pub(super) fn peek(&mut self) -> u8 {
        let bytes = self.text.as_bytes();
        loop {
            match bytes.get(self.at) {
                Some(b' ' | b'\t' | b'\r') => self.at += 1,
                Some(b'\n') => {
                    self.at += 1;
                    self.line += 1;
                    self.line_start = self.at;
                }
                Some(b'#') => self.at += self.text[self.at..].find('\n').unwrap_or(self.text.len() - self.at),
                // A zero byte is no letter of ours; it must not be taken for the end.
                Some(0) => return 1,
                Some(&byte) => return byte,
                None => return 0,
            }
        }
    }

    /// Returns the byte behind the one that [`Self::peek`] returned.
    pub(super) fn second(&self) -> u8 {
        self.text.as_bytes().get(self.at + 1).copied().unwrap_or(0)
    }

    pub(super) fn advance(&mut self, bytes: usize) {
        self.at += bytes;
    }

    /// Returns the bytes not read yet.
    pub(super) const fn rest(&self) -> &'t [u8] {
        self.text.as_bytes().split_at(self.at).1
    }

    /// Returns so many of them, which are ASCII.
    pub(super) fn next(&self, count: usize) -> &'t str {
        &self.text[self.at..self.at + count]
    }

    /// Passes over this byte if it comes next.
    pub(super) fn eat(&mut self, byte: u8) -> bool {
        let found = self.peek() == byte;
        self.at += usize::from(found);
        found
    }

    /// Returns the next element as quoted in an error.
    pub(super) fn found(&mut self) -> String {
        if self.peek() == 0 {
            return "the end".to_owned();
        }
        let rest = &self.text[self.at..];
        let word = rest.bytes().take_while(|c| c.is_ascii_alphanumeric() || *c == b'_').count();
        let end = if word > 0 { word } else { rest.chars().next().map_or(0, char::len_utf8) };
        format!("`{}`", shortened(&rest[..end]).escape_debug())
    }

    /// Reads the name that begins here; the caller has seen its first letter.
    #[inline]
    pub(super) fn name(&mut self) -> &'t str {
        let bytes = self.text.as_bytes();
        let start = self.at;
        while bytes.get(self.at).is_some_and(|c| c.is_ascii_alphanumeric() || *c == b'_') {
            self.at += 1;
        }
        while bytes.get(self.at) == Some(&b'\'') {
            self.at += 1;
        }
        &self.text[start..self.at]
    }

    #[inline]
    fn digits(&mut self) -> &'t str {
        let bytes = self.text.as_bytes();
        let start = self.at;
        while bytes.get(self.at).is_some_and(u8::is_ascii_digit) {
            self.at += 1;
        }
        &self.text[start..self.at]
    }

    /// Numerator and denominator of the number that begins here: digits, perhaps with a point and a power of ten.
    #[inline]
    pub(super) fn number(&mut self) -> Result<(Int, Int), Fault> {
        let place = self.place();
        let start = self.at;
        let whole = self.digits();
        match self.text.as_bytes().get(self.at) {
            Some(b'.' | b'e' | b'E') => self.decimal(whole, &self.text[start..], place),
            _ => Ok((integer(whole), Int::one())),
        }
    }

    fn decimal(&mut self, whole: &str, source: &str, place: Place) -> Result<(Int, Int), Fault> {
        let fault = |what: &str| Fault::new(place, format!("found `{}`, {what}", shortened(source)));
        let mut fraction = "";
        if self.text[self.at..].starts_with('.') {
            self.at += 1;
            fraction = self.digits();
        }
        if whole.is_empty() && fraction.is_empty() {
            return Err(Fault::new(place, "found a point without digits, expected a number".to_owned()));
        }
        let mut value = Rational::from(integer(&format!("{whole}{fraction}")).to_integer());
        let ten_to = |n: usize| u32::try_from(n).ok().map(|n| Integer::from(10).pow(n));
        value /= ten_to(fraction.len()).ok_or_else(|| fault("a number with too many digits"))?;
        let rest = &self.text[self.at..];
        if let Some(behind) = rest.strip_prefix(['e', 'E']) {
            let unsigned = behind.strip_prefix(['+', '-']).unwrap_or(behind);
            // `2e` and `2e_x` are a number with a name behind, which the parser complains about.
            if unsigned.starts_with(|c: char| c.is_ascii_digit()) {
                self.at += rest.len() - unsigned.len();
                let size = self.digits().parse::<u32>().ok().filter(|size| *size <= LARGEST_EXPONENT);
                let size = size.ok_or_else(|| fault(&format!("a power of ten beyond {LARGEST_EXPONENT}")))?;
                let power = Integer::from(10).pow(size);
                if behind.starts_with('-') { value /= power } else { value *= power }
            }
        }
        let (numerator, denominator) = value.into_numer_denom();
        Ok((Int::from(numerator), Int::from(denominator)))
    }

    /// Reads the whole number that begins here, if it fits a u64.
    pub(super) fn small(&mut self) -> Option<u64> {
        self.digits().parse().ok()
    }
}

/// Returns the eight bytes of a text from a place on, the first one lowest; zeros beyond its end.
#[inline(always)]
pub(super) fn eight(bytes: &[u8], at: usize) -> u64 {
    if let Some(eight) = bytes.get(at..at + 8) {
        return eight.try_into().map_or(0, u64::from_le_bytes);
    }
    let rest = bytes.get(at..).unwrap_or(&[]);
    rest.iter().rev().fold(0, |word, byte| word << 8 | u64::from(*byte))
}

/// Returns how many of these eight bytes are digits before the first that is none, and the value of those digits, all at once: neighbours are
/// joined to numbers of two digits, those to numbers of four, and of eight.
#[inline(always)]
pub(super) const fn leading_digits(eight: u64) -> (usize, u64) {
    let x = eight ^ 0x3030_3030_3030_3030;
    // The highest bit of each byte above 9; wrong only behind the first of them.
    let others = (x.wrapping_add(0x7676_7676_7676_7676) | x) & 0x8080_8080_8080_8080;
    let count = others.trailing_zeros() / 8;
    if count == 0 {
        return (0, 0);
    }
    let x = x << (64 - 8 * count);
    let x = (x.wrapping_mul(10).wrapping_add(x >> 8)) & 0x00ff_00ff_00ff_00ff;
    let x = (x.wrapping_mul(100).wrapping_add(x >> 16)) & 0x0000_ffff_0000_ffff;
    let x = (x.wrapping_mul(10_000).wrapping_add(x >> 32)) & 0xffff_ffff;
    (count as usize, x)
}

/// Returns the value of up to [`WORD_DIGITS`] decimal digits.
#[inline(always)]
fn word(digits: &[u8]) -> u64 {
    digits.iter().fold(0, |value, digit| value * 10 + u64::from(digit - b'0'))
}

/// Returns the value of [`PIECE`] decimal digits.
#[inline(always)]
fn piece(digits: &[u8]) -> u64 {
    leading_digits(eight(digits, 0)).1 * 100_000_000 + leading_digits(eight(digits, 8)).1
}

/// Returns the value of decimal digits.
#[inline]
pub(super) fn integer(digits: &str) -> Int {
    let bytes = digits.as_bytes();
    if bytes.len() <= WORD_DIGITS {
        return Int::from(word(bytes).cast_signed());
    }
    if bytes.len() > FEW_DIGITS {
        return Int::from(Integer::parse(digits).map(Integer::from).unwrap_or_default());
    }
    long_integer(bytes)
}

/// Returns the value of more decimal digits than a word has.
#[expect(clippy::cast_possible_truncation, reason = "limbs are the halves of two words")]
fn long_integer(digits: &[u8]) -> Int {
    // A limb has more than 19 digits; numbers of up to eight limbs need no memory for it.
    let (mut few, mut many) = ([0; 8], Vec::new());
    let limbs = if digits.len() <= 19 * few.len() {
        &mut few[..]
    } else {
        many.resize(digits.len() / 19 + 2, 0);
        &mut many[..]
    };
    let (first, rest) = digits.split_at(digits.len() % PIECE);
    let mut used = 1;
    limbs[0] = word(first);
    for digits in rest.chunks_exact(PIECE) {
        let mut carry = piece(digits);
        for limb in &mut limbs[..used] {
            let product = u128::from(*limb) * u128::from(TEN_TO_PIECE) + u128::from(carry);
            (*limb, carry) = (product as u64, (product >> 64) as u64);
        }
        if carry > 0 {
            limbs[used] = carry;
            used += 1;
        }
    }
    Int::from(Integer::from_digits(&limbs[..used], Order::Lsf))
}

/// Reads a number in digits, optionally with a sign, a point, a power of ten, and a divisor: `-22/7`, `0.1`, `1e-3`.
///
/// # Errors
/// [`Error::Invalid`], stating what was found.
pub fn read_number(text: &str) -> Result<Rational, Error> {
    let (numerator, denominator) = read_fraction(text)?;
    Ok(match (numerator.to_i64(), denominator.to_i64()) {
        (Some(n), Some(1)) => Rational::from(n),
        (Some(n), Some(d)) => Rational::from((n, d)),
        _ => Rational::from((numerator.to_integer(), denominator.to_integer())),
    })
}

/// Reads a number as [`read_number`] does: numerator and denominator, which is positive, perhaps with common factors.
///
/// # Errors
/// [`Error::Invalid`], stating what was found.
///
/// # Example
/// ```
/// use looproot_algebra::{int::Int, text::read_fraction};
///
/// assert_eq!(read_fraction("-22/7").unwrap(), (Int::from(-22), Int::from(7)));
/// assert_eq!(read_fraction("-12").unwrap(), (Int::from(-12), Int::from(1)));
/// assert!(read_fraction("-").is_err() && read_fraction("--1").is_err());
/// ```
pub fn read_fraction(text: &str) -> Result<(Int, Int), Error> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    if (1..=WORD_DIGITS).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_digit()) {
        // Most numbers are short and whole.
        let number = integer(digits);
        return Ok((if digits.len() < text.len() { number.neg() } else { number }, Int::one()));
    }
    let fault = |fault: Fault| fault.in_text(text);
    let mut scanner = Scanner::new(text);
    let negative = scanner.peek() == b'-';
    if matches!(scanner.peek(), b'+' | b'-') {
        scanner.advance(1);
    }
    let unsigned = |scanner: &mut Scanner| match scanner.peek() {
        b'0'..=b'9' | b'.' => scanner.number().map_err(fault),
        _ => {
            let found = scanner.found();
            Err(fault(scanner.fault(format!("found {found}, expected digits"))))
        }
    };
    let (mut numerator, mut denominator) = unsigned(&mut scanner)?;
    if scanner.eat(b'/') {
        let (n, d) = unsigned(&mut scanner)?;
        (numerator, denominator) = (numerator.mul(&d), denominator.mul(&n));
    }
    if scanner.peek() != 0 || denominator.is_zero() {
        let found = if denominator.is_zero() { "a division by zero".to_owned() } else { scanner.found() };
        return Err(fault(scanner.fault(format!("found {found}, expected a number"))));
    }
    Ok((if negative { numerator.neg() } else { numerator }, denominator))
}
