//! Sums of plain terms in known variables, read in one pass: most polynomials that programs write are such.

use super::expression::Expression;
use super::fault::Fault;
use super::fraction::Fraction;
use super::names::Names;
use super::parser::{MOST_EXPECTED, MOST_EXPONENT_DIGITS};
use super::scanner::{WORD_DIGITS, integer};
use super::terms::MOST_TERMS;
use crate::int::Int;
use crate::polynomial::Polynomial;
use crate::ring::Ring;

/// Reads one polynomial and multiplies it out: what [`Expression::parse`] and [`Expression::expand`] do together.
///
/// # Errors
/// The text found, the text expected, and the place; or that the result would be too large.
///
/// # Example
/// ```
/// use looproot_algebra::text::{Format, Names, read_polynomial};
///
/// let mut names = Names::given(["x", "y"]).unwrap();
/// let polynomial = read_polynomial("3*x^2*y - 12*y + x", &mut names).unwrap();
/// assert_eq!(Format::Text.polynomial(&polynomial.to_rational(), &names), "3*x^2*y + x - 12*y");
/// assert!(read_polynomial("3*x^2*z", &mut names).is_err());
/// ```
pub fn read_polynomial(text: &str, names: &mut Names) -> Result<Fraction, Fault> {
    match plain(text, names) {
        Some(numerator) => Ok(Fraction { numerator, denominator: Int::one() }),
        None => Expression::parse(text, names)?.expand(),
    }
}

/// Whether a byte may stand in a name.
const LETTERS: [bool; 256] = {
    let (mut letters, mut byte) = ([false; 256], 0_u8);
    while byte < u8::MAX {
        letters[byte as usize] = byte.is_ascii_alphanumeric() || byte == b'_';
        byte += 1;
    }
    letters
};

/// Returns the polynomial if the text has only terms like `-12*x^3*y**2`, perhaps with spaces around their signs; `None` if there is
/// anything else, right or wrong.
fn plain(text: &str, names: &Names) -> Option<Polynomial<Int>> {
    let bytes = text.as_bytes();
    let packing = names.packing().filter(|packing| packing.words() == 1 && bytes.len() <= MOST_TERMS)?;
    let (largest, guards) = (packing.largest(), packing.guards());
    // Terms have about ten bytes.
    let room = (bytes.len() / 8 + 1).min(MOST_EXPECTED);
    let (mut monomials, mut coefficients) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let byte = |at: usize| bytes.get(at).copied().unwrap_or(0);
    let spaces = |mut at: usize| {
        while matches!(byte(at), b' ' | b'\n' | b'\t' | b'\r') {
            at += 1;
        }
        at
    };
    let number = |mut at: usize| {
        let mut value = 0_i64;
        loop {
            let digit = byte(at).wrapping_sub(b'0');
            if digit > 9 {
                return (value, at);
            }
            value = value.wrapping_mul(10).wrapping_add(i64::from(digit));
            at += 1;
        }
    };
    let mut at = spaces(0);
    let mut negative = byte(at) == b'-';
    at += usize::from(matches!(byte(at), b'+' | b'-'));
    loop {
        let start = spaces(at);
        let value;
        (value, at) = number(start);
        let signed = |n: i64| if negative { -n } else { n };
        let coefficient = match at - start {
            0 => Int::from(signed(1)),
            1..=WORD_DIGITS => Int::from(signed(value)),
            _ => integer(&text[start..at]).mul(&Int::from(signed(1))),
        };
        let mut more = at == start || byte(at) == b'*';
        at += usize::from(more && at > start);
        let mut monomial = 0;
        while more {
            let (mut name, start) = (0, at);
            while let letter = byte(at)
                && LETTERS[usize::from(letter)]
            {
                name = name << 8 | u64::from(letter);
                at += 1;
            }
            if at == start || at - start > 8 {
                return None;
            }
            let variable = names.position(name)?;
            let mut exponent = 1;
            let sign = if byte(at) == b'^' { 1 } else { 2 };
            if sign == 1 || byte(at) == b'*' && byte(at + 1) == b'*' {
                let start = at + sign;
                (exponent, at) = number(start);
                if at == start || at - start > MOST_EXPONENT_DIGITS || exponent > i64::from(largest) {
                    return None;
                }
            }
            monomial += exponent.cast_unsigned() << packing.place(variable).1;
            if monomial & guards != 0 {
                return None;
            }
            more = byte(at) == b'*';
            at += usize::from(more);
        }
        monomials.push(monomial);
        coefficients.push(coefficient);
        at = spaces(at);
        negative = byte(at) == b'-';
        if at == bytes.len() {
            return Some(Polynomial::from_unsorted(packing, monomials, coefficients));
        }
        if !matches!(byte(at), b'+' | b'-') {
            return None;
        }
        at += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plain_texts_are_read_as_the_grammar_reads_them() {
        let mut names = Names::given(["x", "y", "long_one", "z9"]).unwrap();
        let good = [
            "3*x^2*y - 12*y + x",
            "-x",
            "+7",
            "0",
            "0*x + y - y",
            " 5 * x",
            "y\n+ x**3*y^2*x",
            "long_one^2*z9-z9",
            "123456789012345678901234567890*x-99999999999999999999*y",
            "x^40000 + 1",
            "x^20000*x^20000",
            "x^02",
            "(x+1)*y",
            "2*3*x",
            "1/2*x",
            "x + # a comment\n y",
        ];
        for text in good {
            let expected = Expression::parse(text, &mut names).unwrap().expand().unwrap();
            assert_eq!(read_polynomial(text, &mut names).unwrap(), expected, "{text}");
        }
        for text in ["", "2x", "x y", "x^-1", "x^2^3", "w", "x'", "3*", "*x", "x+", "x\0", "-", "x^", "9*x*"] {
            let expected = Expression::parse(text, &mut names).unwrap_err();
            let found = read_polynomial(text, &mut names).unwrap_err();
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{text}");
        }
    }
}
