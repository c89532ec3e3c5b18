//! Values of integer polynomials at rational numbers, in as many bits as their signs need.

use rug::Integer;
use std::cmp::Ordering;

/// `mantissa 2^unit`, with the right sign.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) mantissa: Integer,
    pub(super) unit: i64,
}

/// The length from which on exact values are avoided.
const WORTH_ROUNDING: i64 = 512;

/// Returns the length in bits, as a signed number.
pub(super) fn length(n: &Integer) -> i64 {
    i64::from(n.significant_bits())
}

/// Returns `floor(2^shift n)`, the result being of a size that can be held.
pub(super) fn shifted(n: &Integer, shift: i64) -> Integer {
    let size = u32::try_from(shift.unsigned_abs()).unwrap_or(u32::MAX);
    if shift < 0 { Integer::from(n >> size) } else { Integer::from(n << size) }
}

/// Returns the sign as a number.
pub(super) fn sign(n: &Integer) -> i8 {
    match n.cmp0() {
        Ordering::Less => -1,
        Ordering::Equal => 0,
        Ordering::Greater => 1,
    }
}

/// Returns the largest length of the numbers `c_i 2^(k i)`.
pub(super) fn reach(coefficients: &[Integer], k: i64) -> i64 {
    let terms = (0_i64..).zip(coefficients).filter(|(_, c)| **c != 0);
    terms.map(|(i, c)| length(c) + k * i).max().unwrap_or(0)
}

/// Returns the value at `numerator 2^exponent`, right to at least `wanted` bits. It starts with the precision `bits`, and if
/// that is too little, stores there the larger one used.
pub(super) fn value_at(
    coefficients: &[Integer],
    numerator: &Integer,
    exponent: i64,
    wanted: i64,
    bits: &mut i64,
) -> Value {
    let zeros = i64::from(numerator.find_one(0).unwrap_or(0));
    let (numerator, exponent) = (shifted(numerator, -zeros), exponent + zeros);
    let depth = length(&numerator);
    let k = exponent + depth;
    let reach = reach(coefficients, k);
    let degree = i64::try_from(coefficients.len()).expect("degrees are small");
    // Every step rounds twice, and |x| < 2^k carries errors on without growth.
    let error = length(&Integer::from(2 * degree));
    let exact = depth * degree + reach - k.min(0) * degree;
    let places = u32::try_from(depth).expect("lengths fit a u32");
    // Values of a few words are not worth rounding.
    while exact > (*bits).max(WORTH_ROUNDING) {
        let shift = *bits - reach;
        let mut value = Integer::new();
        for (i, c) in (0..degree).rev().zip(coefficients.iter().rev()) {
            value *= &numerator;
            value >>= places;
            value += shifted(c, k * i + shift);
        }
        let missing = wanted.max(1) + 1 + error - length(&value);
        if missing <= 0 {
            return Value { mantissa: value, unit: -shift };
        }
        // A value that is all error does not show how much is missing.
        *bits += if length(&value) > error { missing + 8 } else { missing + *bits };
    }
    let step = exponent.min(0);
    let x = shifted(&numerator, exponent.max(0));
    let mut value = Integer::new();
    for (i, c) in (0_i64..degree).rev().zip(coefficients.iter().rev()) {
        value *= &x;
        if step == 0 {
            value += c;
        } else {
            value += shifted(c, -step * (degree - 1 - i));
        }
    }
    Value { mantissa: value, unit: step * (degree - 1) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::Rational;

    #[test]
    fn values_have_the_right_sign_and_precision() {
        let poly = [-2_i32, 0, 1, 7, -3].map(Integer::from);
        for numerator in [-123_456_789_i32, -5, -1, 0, 1, 3, 1 << 20, 998_877_665] {
            for exponent in [-70_i64, -30, -3, 0, 2, 40] {
                let n = Integer::from(numerator);
                let power = Rational::from(1) << u32::try_from(exponent.abs()).unwrap();
                let x = if exponent < 0 { Rational::from(&n) / power } else { Rational::from(&n) * power };
                let expected = poly.iter().rev().fold(Rational::new(), |v, c| v * &x + c);
                for wanted in [1_i64, 20, 90] {
                    let Value { mantissa, unit } = value_at(&poly, &n, exponent, wanted, &mut 16);
                    let power = Rational::from(1) << u32::try_from(unit.abs()).unwrap();
                    let value =
                        if unit < 0 { Rational::from(mantissa) / power } else { Rational::from(mantissa) * power };
                    assert_eq!(value.cmp0(), expected.cmp0());
                    let bound = Rational::from(expected.abs_ref()) >> u32::try_from(wanted).unwrap();
                    assert!((value - &expected).abs() <= bound, "{numerator} {exponent} {wanted}");
                }
            }
        }
    }
}
