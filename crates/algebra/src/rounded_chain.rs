//! The leading signs of a Sturm chain in rounded arithmetic with proved errors: enough to count all real roots.
//!
//! The exact members have coefficients hundreds of times longer than the polynomial; their leading signs need a few
//! hundred bits. Each member is kept up to a positive factor, as integers with one bound for all their errors.

use super::univariate::Univariate;
use rug::{Assign, Integer};
use std::{cmp::Ordering, mem};

/// The bits tried first, and those after which the exact chain is left to decide.
const FIRST_BITS: u32 = 256;
const LAST_BITS: u32 = 1 << 16;

/// A polynomial whose coefficients are wrong by at most `error` each.
struct Rounded {
    /// Constant term first.
    coefficients: Vec<Integer>,
    error: Integer,
}

impl Rounded {
    /// Shortens the coefficients to the given length.
    fn shorten(&mut self, bits: u32) {
        let longest = self.coefficients.iter().map(Integer::significant_bits).max().unwrap_or(0);
        let excess = longest.saturating_sub(bits);
        if excess > 0 {
            for c in &mut self.coefficients {
                *c >>= excess;
            }
            self.error >>= excess;
            // One for the coefficient, one for the error, both rounded down.
            self.error += 2_u32;
        }
    }

    /// Returns the sign of the leading coefficient, if it is certain.
    fn leading_sign(&self) -> Option<Ordering> {
        let leading = self.coefficients.last()?;
        leading.cmp_abs(&self.error).is_gt().then(|| leading.cmp0())
    }
}

/// Minus the remainder of `a` by `b`, whose degree is lower by one and whose leading sign is certain, `places` binary
/// places being used for the quotient.
fn negative_remainder(a: &Rounded, b: &Rounded, places: u32) -> Option<Rounded> {
    let (n, m) = (a.coefficients.len(), b.coefficients.len());
    let leading = b.coefficients.last()?;
    let least = Integer::from(leading.abs_ref()) - &b.error;
    // The quotient of numbers wrong by `error` and by that of b: value in units of the last place, and its error.
    let divide = |numerator: Integer, error: Integer| {
        let quotient = numerator / leading;
        let error = (error + (Integer::from(quotient.abs_ref()) + 1_u32) * &b.error) / &least + 2_u32;
        (quotient, error)
    };
    let second = if m > 1 { b.coefficients[m - 2].clone() } else { Integer::new() };
    let (slope, slope_error) = divide(a.coefficients[n - 1].clone() << places, a.error.clone() << places);
    let product_error = |(x, x_error): (&Integer, &Integer), y: &Integer| {
        Integer::from(x.abs_ref()) * &b.error + (Integer::from(y.abs_ref()) + &b.error) * x_error
    };
    let rest = Integer::from(&a.coefficients[n - 2] << places) - Integer::from(&slope * &second);
    let rest_error = Integer::from(&a.error << places) + product_error((&slope, &slope_error), &second);
    let (constant, constant_error) = divide(rest, rest_error);
    let largest = b.coefficients.iter().max_by(|x, y| x.cmp_abs(y))?;
    let error = product_error((&slope, &slope_error), largest) + product_error((&constant, &constant_error), largest);
    let mut product = Integer::new();
    let remainder = (0..m - 1).map(|i| {
        product.assign(&constant * &b.coefficients[i]);
        if i > 0 {
            product += &slope * &b.coefficients[i - 1];
        }
        product >>= places;
        Integer::from(&product - &a.coefficients[i])
    });
    Some(Rounded { coefficients: remainder.collect(), error: (error >> places) + &a.error + 2_u32 })
}

/// Returns the changes between the leading signs of the chain at minus and at plus infinity; `None` if the precision does
/// not suffice.
fn count_in(p: &Univariate<Integer>, bits: u32) -> Option<usize> {
    let rounded = |p: &Univariate<Integer>| {
        // Short coefficients are exact, and are lengthened to leave room for the computation.
        let coefficients = p.coefficients().iter().map(|c| Integer::from(c << bits)).collect();
        let mut rounded = Rounded { coefficients, error: Integer::new() };
        rounded.shorten(bits);
        rounded
    };
    let (mut a, mut b) = (rounded(p), rounded(&p.derivative()));
    let mut before = a.leading_sign()?;
    let mut count = 0;
    while !b.coefficients.is_empty() {
        let sign = b.leading_sign()?;
        // Degrees fall by one, so equal signs at plus infinity are a change at minus infinity, and the reverse.
        count += if sign == before { 1 } else { -1 };
        before = sign;
        let mut next = negative_remainder(&a, &b, bits)?;
        next.shorten(bits);
        a = mem::replace(&mut b, next);
    }
    usize::try_from(count).ok()
}

/// Returns the polynomial at `2^k x`, times a power of two, k such that the first and last coefficient are of about one size:
/// then no coefficients are lost in the common error of all.
fn balanced(p: &Univariate<Integer>) -> Univariate<Integer> {
    let length = |c: &Integer| i64::from(c.significant_bits());
    let (Some(first), Some(last)) = (p.coefficients().first(), p.coefficients().last()) else { return p.clone() };
    let degree = p.coefficients().len() - 1;
    let steps = i64::try_from(degree.max(1)).expect("degrees are small");
    let k = (length(first) - length(last)) / steps;
    let size = usize::try_from(k.unsigned_abs()).expect("lengths are small");
    let places = |i: usize| size * if k < 0 { degree - i } else { i };
    Univariate::new(p.coefficients().iter().enumerate().map(|(i, c)| Integer::from(c << places(i))).collect())
}

/// Returns the number of real roots of a polynomial whose chain falls in degree by one each time; `None` if that is not
/// certain, also for multiple roots.
pub(super) fn count_by_leading_signs(p: &Univariate<Integer>) -> Option<usize> {
    if !p.has_clearly_full_chain() {
        return None;
    }
    let p = balanced(p);
    let mut bits = FIRST_BITS;
    while bits <= LAST_BITS {
        if let Some(count) = count_in(&p, bits) {
            return Some(count);
        }
        bits *= 2;
    }
    None
}
