//! Sums of plain terms in known variables, read in one pass: most polynomials that programs write are such.

use super::expression::Expression;
use super::fault::Fault;
use super::fraction::Fraction;
use super::names::Names;
use super::parser::{MOST_EXPECTED, MOST_EXPONENT_DIGITS};
use super::scanner::{WORD_DIGITS, eight, integer, leading_digits};
use super::terms::{MOST_TERMS, bits, common_multiple};
use crate::int::Int;
use crate::monomial::Packing;
use crate::polynomial::Polynomial;
use crate::ring::{Domain, Ring};

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
        Some(fraction) => Ok(fraction),
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

/// Returns the polynomial if the text has only terms like `-12*x^3*y**2` or `3/4*x`, perhaps with spaces around their signs; `None` if there
/// is anything else, right or wrong.
fn plain(text: &str, names: &Names) -> Option<Fraction> {
    let packing = names.packing().filter(|packing| packing.words() == 1 && text.len() <= MOST_TERMS)?;
    let (largest, guards) = (u64::from(packing.largest()), packing.guards());
    let mut reader =
        Reader { text, bytes: text.as_bytes(), at: 0, names, packing, largest, guards, singles: [NONE; 128] };
    for (variable, name) in names.list().iter().enumerate() {
        if let ([byte], Ok(shift)) = (name.as_bytes(), u8::try_from(packing.place(variable).1)) {
            reader.singles[usize::from(byte % 128)] = shift;
        }
    }
    // Terms have six bytes or more, mostly.
    let room = (text.len() / 6 + 1).min(MOST_EXPECTED);
    let (mut monomials, mut coefficients) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let mut denominators: Vec<(usize, Int)> = Vec::new();
    reader.skip_spaces();
    let mut negative = reader.byte() == b'-';
    reader.at += usize::from(matches!(reader.byte(), b'+' | b'-'));
    loop {
        reader.skip_spaces();
        let start = reader.at;
        coefficients.push(reader.number(negative));
        if reader.byte() == b'/' && reader.at > start {
            reader.at += 1;
            let start = reader.at;
            let denominator = reader.number(false);
            let numerator = coefficients.pop().filter(|_| reader.at > start && !denominator.is_zero())?;
            let common = numerator.gcd(&denominator);
            let denominator = denominator.div_exact(&common);
            coefficients.push(numerator.div_exact(&common));
            if denominator != Int::one() {
                denominators.push((monomials.len(), denominator));
            }
        }
        let more = reader.at == start || reader.byte() == b'*';
        reader.at += usize::from(more && reader.at > start);
        monomials.push(if more { reader.monomial()? } else { 0 });
        reader.skip_spaces();
        negative = reader.byte() == b'-';
        if reader.at == reader.bytes.len() {
            break;
        }
        if !matches!(reader.byte(), b'+' | b'-') {
            return None;
        }
        reader.at += 1;
    }
    let denominator = cleared(&mut coefficients, &denominators)?;
    Some(Fraction { numerator: Polynomial::from_unsorted(packing, monomials, coefficients), denominator })
}

/// The most bytes of all numerators over a common denominator; beyond it the grammar decides.
const MOST_BYTES: u64 = 1 << 24;

/// Multiplies numerators by the least common multiple of the denominators that are not 1, each beside the number of its own, and returns that;
/// `None` if the numbers become too long.
fn cleared(numerators: &mut [Int], denominators: &[(usize, Int)]) -> Option<Int> {
    let mut common = Int::one();
    if denominators.is_empty() {
        return Some(common);
    }
    for (_, own) in denominators {
        common = common_multiple(&common, own);
        // Watched while it grows: multiples of very many denominators would take for ever.
        if (bits(&common) / 8).saturating_mul(numerators.len() as u64) > MOST_BYTES {
            return None;
        }
    }
    let mut fractions = denominators.iter().peekable();
    for (index, numerator) in numerators.iter_mut().enumerate() {
        let own = fractions.next_if(|(term, _)| *term == index);
        *numerator = own.map_or_else(|| numerator.mul(&common), |(_, own)| numerator.mul(&common.div_exact(own)));
    }
    Some(common)
}

/// No variable.
const NONE: u8 = u8::MAX;

/// A text of plain terms, and how far it is read.
struct Reader<'t> {
    text: &'t str,
    bytes: &'t [u8],
    at: usize,
    names: &'t Names,
    packing: Packing,
    /// The largest exponent, and the bits that no monomial has.
    largest: u64,
    guards: u64,
    /// The places of the variables with names of one letter.
    singles: [u8; 128],
}

impl Reader<'_> {
    /// Returns the next byte, 0 at the end.
    #[inline(always)]
    fn byte(&self) -> u8 {
        self.bytes.get(self.at).copied().unwrap_or(0)
    }

    #[inline(always)]
    fn skip_spaces(&mut self) {
        while matches!(self.byte(), b' ' | b'\n' | b'\t' | b'\r') {
            self.at += 1;
        }
    }

    /// Reads the whole number that begins here with a sign from before, or 1 if there is none.
    #[inline(always)]
    fn number(&mut self, negative: bool) -> Int {
        let start = self.at;
        let (mut count, mut value) = leading_digits(eight(self.bytes, self.at));
        self.at += count;
        while count == 8 {
            let more;
            (count, more) = leading_digits(eight(self.bytes, self.at));
            // Beyond a word it is read once more.
            value = value.wrapping_mul(TEN_TO[count]).wrapping_add(more);
            self.at += count;
        }
        if self.at - start > WORD_DIGITS {
            let number = integer(&self.text[start..self.at]);
            return if negative { number.neg() } else { number };
        }
        let value = if self.at == start { 1 } else { value.cast_signed() };
        Int::from(if negative { -value } else { value })
    }

    /// Reads powers of variables with `*` between them.
    #[inline(always)]
    fn monomial(&mut self) -> Option<u64> {
        let mut monomial = 0;
        loop {
            let shift = self.variable()?;
            let mut exponent = 1;
            let sign = if self.byte() == b'^' { 1 } else { 2 };
            if sign == 1 || self.byte() == b'*' && self.bytes.get(self.at + 1) == Some(&b'*') {
                let count;
                (count, exponent) = leading_digits(eight(self.bytes, self.at + sign));
                if count == 0 || count > MOST_EXPONENT_DIGITS || exponent > self.largest {
                    return None;
                }
                self.at += sign + count;
            }
            monomial += exponent << shift;
            if monomial & self.guards != 0 {
                return None;
            }
            if self.byte() != b'*' {
                return Some(monomial);
            }
            self.at += 1;
        }
    }

    /// Reads the name of a variable, and returns its place.
    #[inline(always)]
    fn variable(&mut self) -> Option<u32> {
        let first = self.byte();
        if !LETTERS[usize::from(self.bytes.get(self.at + 1).copied().unwrap_or(0))] {
            self.at += 1;
            let shift = self.singles[usize::from(first % 128)];
            // Those of letters beyond ASCII are no names.
            return (shift != NONE && first < 128).then_some(u32::from(shift));
        }
        let (variable, end) = long_name(self.bytes, self.at, self.names)?;
        self.at = end;
        Some(self.packing.place(variable).1)
    }
}

/// Returns the variable whose name of several letters begins here, and the end of the name. It stands alone so that the reader stays in
/// registers.
fn long_name(bytes: &[u8], start: usize, names: &Names) -> Option<(usize, usize)> {
    let letters = bytes[start..].iter().take_while(|byte| LETTERS[usize::from(**byte)]);
    let (mut name, mut count) = (0, 0);
    for letter in letters {
        name = name << 8 | u64::from(*letter);
        count += 1;
    }
    if count > 8 { None } else { Some((names.position(name)?, start + count)) }
}

/// Powers of ten.
const TEN_TO: [u64; 9] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000, 10_000_000, 100_000_000];

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
            "4/6*x - 1/3 + 5*y - 3/123456789012345678901*x*y + 0/7*x",
            "12345678*x + 123456789*y - 1234567890123456 + 123456789012345678*x^2 - 1234567890123456789*x^3",
            "9999999999999999999999*x^12*y^0 + 1/1",
            "x + # a comment\n y",
        ];
        for text in good {
            let expected = Expression::parse(text, &mut names).unwrap().expand().unwrap();
            assert_eq!(read_polynomial(text, &mut names).unwrap(), expected, "{text}");
        }
        for text in [
            "",
            "2x",
            "x y",
            "x^-1",
            "x^2^3",
            "w",
            "x'",
            "3*",
            "*x",
            "x+",
            "x\0",
            "-",
            "x^",
            "9*x*",
            "1/0*x",
            "1/",
            "1/*x",
            "/2",
            "x^1234567890",
        ] {
            let expected = Expression::parse(text, &mut names).unwrap_err();
            let found = read_polynomial(text, &mut names).unwrap_err();
            assert_eq!(format!("{found:?}"), format!("{expected:?}"), "{text}");
        }
    }
}
