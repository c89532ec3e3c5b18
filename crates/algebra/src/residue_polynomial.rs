//! Dense polynomials in one variable modulo a prime: residues in Montgomery form, constant term first, none zero at the end.

use super::modp::{Modulus, product as wide_product};

/// A polynomial without zeros at its end; the zero polynomial has no coefficients.
pub(super) type Residues = Vec<u64>;

/// Drops the zeros at the end.
pub(super) fn trim(polynomial: &mut Residues) {
    let length = polynomial.iter().rposition(|&r| r != 0).map_or(0, |last| last + 1);
    polynomial.truncate(length);
}

/// Returns the value at a residue.
pub(super) fn value(polynomial: &[u64], x: u64, modulus: &Modulus) -> u64 {
    polynomial.iter().rev().fold(0, |value, &c| modulus.add(modulus.mul(value, x), c))
}

/// Returns the derivative.
pub(super) fn derivative(polynomial: &[u64], modulus: &Modulus) -> Residues {
    let (one, mut index) = (modulus.enter(1), 0);
    let term = |&r: &u64| {
        index = modulus.add(index, one);
        modulus.mul(index, r)
    };
    let mut derivative = polynomial.iter().skip(1).map(term).collect();
    trim(&mut derivative);
    derivative
}

/// Returns the product of two polynomials that are not zero.
pub(super) fn product(a: &[u64], b: &[u64], modulus: &Modulus) -> Residues {
    let reversed: Vec<u64> = b.iter().rev().copied().collect();
    let coefficient = |k: usize| {
        let (first, last) = ((k + 1).saturating_sub(b.len()), k.min(a.len() - 1));
        let factors = reversed[b.len() - 1 + first - k..].chunks(4);
        a[first..=last].chunks(4).zip(factors).fold(0, |sum, (a, b)| {
            // Four products of residues below 2^62 stay below 2^64 times the prime.
            let products: u128 = a.iter().zip(b).map(|(&a, &b)| wide_product(a, b)).sum();
            modulus.add(sum, modulus.fold(products))
        })
    };
    (0..a.len() + b.len() - 1).map(coefficient).collect()
}

/// Leaves the remainder by a monic polynomial.
pub(super) fn remainder_by_monic(a: &mut Residues, b: &[u64], modulus: &Modulus) {
    let lower = &b[..b.len() - 1];
    while a.len() >= b.len() {
        let Some(top) = a.pop() else { return };
        let shift = a.len() - lower.len();
        for (x, &y) in a[shift..].iter_mut().zip(lower) {
            *x = modulus.sub(*x, modulus.mul(top, y));
        }
    }
    trim(a);
}

/// Quotient and remainder.
pub(super) fn divide(a: &[u64], b: &[u64], modulus: &Modulus) -> (Residues, Residues) {
    let mut rest = a.to_vec();
    let (Some(&leading), true) = (b.last(), a.len() >= b.len()) else { return (Residues::new(), rest) };
    let inverse = modulus.inverse(leading);
    let mut quotient = vec![0; a.len() - b.len() + 1];
    for shift in (0..quotient.len()).rev() {
        let factor = modulus.mul(rest[shift + b.len() - 1], inverse);
        for (x, &y) in rest[shift..].iter_mut().zip(b) {
            *x = modulus.sub(*x, modulus.mul(factor, y));
        }
        quotient[shift] = factor;
    }
    trim(&mut rest);
    (quotient, rest)
}

/// Leaves a multiple of the remainder by a polynomial that is not zero: products in the place of an inverse, which costs
/// more than a hundred of them.
pub(super) fn reduce(a: &mut Residues, b: &[u64], modulus: &Modulus) {
    let (Some((&leading, lower)), p) = (b.split_last(), modulus.prime()) else { return };
    if lower.is_empty() {
        return a.clear();
    }
    let square = modulus.mul(leading, leading);
    while a.len() >= b.len() {
        let Some(top) = a.pop() else { return };
        let shift = a.len() - lower.len();
        if shift == 0 {
            let negative = p - top;
            for (x, &y) in a.iter_mut().zip(lower) {
                // Two products of residues below 2^62 stay below 2^64 times the prime, and so do three.
                *x = modulus.fold(wide_product(*x, leading) + wide_product(y, negative));
            }
        } else {
            // Two steps of the division at once: remainder sequences mostly fall by one degree each.
            let Some(next) = a.pop() else { return };
            let first = p - modulus.mul(top, leading);
            let products = wide_product(next, leading) + wide_product(p - top, lower[lower.len() - 1]);
            let second = p - modulus.fold(products);
            let (low, high) = a.split_at_mut(shift - 1);
            for x in low {
                *x = modulus.mul(*x, square);
            }
            let mut before = 0;
            for (x, &y) in high.iter_mut().zip(lower) {
                *x = modulus.fold(wide_product(*x, square) + wide_product(y, second) + wide_product(before, first));
                before = y;
            }
        }
        trim(a);
    }
}

/// Returns a greatest common divisor, not normalised; zero only of two zeros.
pub(super) fn common_divisor(mut a: Residues, mut b: Residues, modulus: &Modulus) -> Residues {
    while !b.is_empty() {
        reduce(&mut a, &b, modulus);
        (a, b) = (b, a);
    }
    a
}

/// Divides by the leading coefficient.
pub(super) fn make_monic(a: &mut Residues, modulus: &Modulus) {
    if let Some(&leading) = a.last() {
        let inverse = modulus.inverse(leading);
        for c in a {
            *c = modulus.mul(*c, inverse);
        }
    }
}
