//! Numbers of poses as they are given: decimals as they are typed, whole numbers of up to 18 digits over a power of ten, and doubles.

use crate::algebra::double_double::DoubleDouble;
use crate::algebra::number::Number;
use crate::algebra::ring::Ring;
use rug::Rational;
use rug::ops::Pow;

/// Largest number of digits: all of them fit in a machine word.
const MOST_DIGITS: usize = 18;
/// The powers of ten that are doubles.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];
/// Exponents up to this size are two of these powers.
const LARGEST: i32 = 44;

/// The number `digits * 10^exponent`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Decimal {
    digits: i64,
    exponent: i32,
}

impl Decimal {
    /// Reads digits with or without sign, point and exponent; `None` for all other text, and for numbers with more digits or
    /// exponents than lengths and rotations have.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let bytes = text.as_bytes();
        let (is_negative, mut at) = (bytes.first() == Some(&b'-'), usize::from(bytes.first() == Some(&b'-')));
        let (mut digits, mut exponent, mut count, mut has_point) = (0_i64, 0, 0, false);
        let begin = at;
        while let Some(byte) = bytes.get(at) {
            match byte {
                b'0'..=b'9' => {
                    digits = digits.checked_mul(10)?.checked_add(i64::from(byte - b'0'))?;
                    count += usize::from(digits > 0);
                    exponent -= i32::from(has_point);
                }
                b'.' if !has_point && at > begin => has_point = true,
                b'e' | b'E' => break,
                _ => return None,
            }
            at += 1;
        }
        // A number begins and ends with a digit.
        let ends = at > begin && bytes[at - 1] != b'.';
        if !ends || count > MOST_DIGITS {
            return None;
        }
        if at < bytes.len() {
            let own = text.get(at + 1..)?;
            let plain = own.strip_prefix('-').unwrap_or(own);
            if plain.is_empty() || plain.len() > 2 || !plain.bytes().all(|byte| byte.is_ascii_digit()) {
                return None;
            }
            exponent += own.parse::<i32>().ok()?;
        }
        (-LARGEST..=LARGEST)
            .contains(&exponent)
            .then_some(Self { digits: if is_negative { -digits } else { digits }, exponent })
    }

    /// The number times a power of ten.
    #[must_use]
    pub fn shifted(self, by: i32) -> Self {
        Self { exponent: self.exponent + by, ..self }
    }

    /// One unit of its last digit.
    #[must_use]
    pub fn last_digit(self) -> f64 {
        10_f64.powi(self.exponent)
    }

    /// The number itself.
    #[must_use]
    pub fn rational(self) -> Rational {
        let power = Rational::from(10).pow(self.exponent);
        Rational::from(self.digits) * power
    }

    /// The number as a file gives it.
    #[must_use]
    pub fn number(self) -> Number {
        Number::exact(self.rational())
    }

    /// The number in twice the digits of a double.
    #[must_use]
    pub fn double_double(self) -> DoubleDouble {
        let mut own = whole(self.digits);
        let mut left = self.exponent.unsigned_abs() as usize;
        while left > 0 {
            let step = left.min(POWERS.len() - 1);
            let power = POWERS[step];
            own = if self.exponent < 0 { own.divided_by(power) } else { own.mul(&DoubleDouble::from(power)) };
            left -= step;
        }
        own
    }
}

/// Doubles that are the nearest ones to decimals of this many places stand for these; all of them up to 9 km are told apart.
const PLACES: i32 = 12;
/// One over the last of these places.
const SCALE: f64 = 1e12;
/// Whole numbers below this are doubles.
const WHOLE: f64 = 9_007_199_254_740_992.0;
/// Doubles of other sizes, 0 apart, are left to the reader of text, which bounds them.
const COMMON: f64 = 1e100;

/// A number of a pose that is known exactly and used in f64, as a rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plain {
    /// A decimal.
    Typed(Decimal),
    /// A double, as the binary fraction that it is.
    Double(f64),
}

impl Plain {
    /// Takes the double nearest to a decimal of few places for that decimal, as text would be read, and any other as it is.
    /// `None` for sizes that poses do not have.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, reason = "a whole number below 2^53")]
    pub fn of_double(x: f64) -> Option<Self> {
        let digits = (x * SCALE).round();
        // The quotient of two doubles is rounded once.
        if digits.abs() < WHOLE && digits / SCALE == x {
            return Some(Self::Typed(Decimal { digits: digits as i64, exponent: -PLACES }));
        }
        (COMMON.recip()..COMMON).contains(&x.abs()).then_some(Self::Double(x))
    }

    /// The number itself.
    #[must_use]
    pub fn rational(self) -> Rational {
        match self {
            Self::Typed(decimal) => decimal.rational(),
            Self::Double(x) => Rational::from_f64(x).unwrap_or_default(),
        }
    }

    /// The number as a file gives it.
    #[must_use]
    pub fn number(self) -> Number {
        Number::exact(self.rational())
    }

    /// The number in twice the digits of a double.
    #[must_use]
    pub fn double_double(self) -> DoubleDouble {
        match self {
            Self::Typed(decimal) => decimal.double_double(),
            Self::Double(x) => DoubleDouble::from(x),
        }
    }
}

/// A whole number, exactly.
#[must_use]
#[expect(clippy::cast_possible_truncation, reason = "a double that was rounded from a machine word")]
pub fn whole(n: i64) -> DoubleDouble {
    let high = n as f64;
    let low = (i128::from(n) - high as i128) as f64;
    DoubleDouble::from(high).add(&DoubleDouble::from(low))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_are_read_exactly() {
        for text in
            ["0", "-0.0", "1", "-1.5", "0.70710678118654757", "123456789012345678", "1e-16", "-1.2246467991473532e-16"]
        {
            let own = Decimal::read(text).unwrap_or_else(|| panic!("{text}"));
            let expected: f64 = text.parse().unwrap();
            assert_eq!(own.number().to_f64(), expected, "{text}");
            assert_eq!(own.double_double().to_f64(), expected, "{text}");
            let exact = DoubleDouble::from_rational(&own.rational()).unwrap();
            let off = own.double_double().sub(&exact).to_f64().abs();
            assert!(off <= 1e-30 * expected.abs(), "{text}: {off:e}");
        }
    }

    #[test]
    fn doubles_are_the_decimals_they_were_typed_as_or_themselves() {
        for text in ["0", "-0.5", "0.1", "0.1625", "-0.425", "1234.567890123", "1e-12", "0.000000000001"] {
            let x: f64 = text.parse().unwrap();
            let exact = Decimal::read(text).unwrap().rational();
            assert_eq!(Plain::of_double(x).unwrap().rational(), exact, "{text}");
        }
        for x in [1.0 / 3.0, 0.707_106_781_186_547_5, 0.1_f64.next_up(), 1.224_646_799_147_353_2e-16, 1e22, 12_345.1] {
            let own = Plain::of_double(x).unwrap();
            assert_eq!(own.number().to_f64(), x);
            assert_eq!(own.double_double().to_f64(), x);
            assert_eq!(own, Plain::Double(x));
            assert_eq!(own.rational(), Rational::from_f64(x).unwrap());
        }
        assert!([1e200, 1e-200, f64::NAN, f64::INFINITY].iter().all(|x| Plain::of_double(*x).is_none()));
    }

    #[test]
    fn other_text_is_left_to_others() {
        for text in
            ["", "-", ".5", "5.", "1e", "1e+5", "1e100", "nan", "pi", "1/2", "1 mm", "1234567890123456789", "1.2.3"]
        {
            assert_eq!(Decimal::read(text), None, "{text}");
        }
    }
}
