//! Bernstein coefficients in f64 with a proved error: 53 bits suffice for most cells of most polynomials.
//!
//! On `[a, b]`, `0 <= a < b`, the variable is `x = a (1-y) + b y`. Where p has the coefficients `b_j` of degree m, `x p + c` has those of degree
//! m + 1, `c + (m+1-j)/(m+1) a b_j + j/(m+1) b b_(j-1)` (Horner's rule). The two weights are not negative and add up to at most b. In units in
//! which b is at most 1, errors are not magnified, as they are where binomials are added.
//!
//! # The error
//! Let u be `2^-53`. The leading bits of a coefficient are wrong by 2 u in proportion, and so are those of a and b. A step makes
//! weights by three roundings, and multiplies and adds by three: with those of a or b less than 8 u in proportion to what the
//! same step makes of absolute values. Those never exceed `S = sum |c_i| b^i`. So all coefficients are wrong by less than
//! `1.01 (8n + 2) u S`. Numbers below the range of f64 add less than `2^-1000` each.

use super::bernstein::Expansion;
use super::cell::Cell;
use super::evaluate::length;
use pulp::Arch;
use rug::Integer;

/// The exponent of two below which a coefficient is left out.
const LEAST: i64 = -1000;

/// Returns `2^exponent`, which must be a normal number.
pub(super) fn power_of_two(exponent: i64) -> f64 {
    // The exponent that 1 has in the bits of a float, and the bits behind it.
    const BIAS: i64 = 1023;
    const FRACTION: u32 = f64::MANTISSA_DIGITS - 1;
    f64::from_bits((exponent + BIAS).cast_unsigned() << FRACTION)
}

/// Returns the leading bits of a number as a float between 1/2 and 1 or 0, wrong by less than `2^-52` in proportion, and the power of two left out.
pub(super) fn leading(n: &Integer) -> (f64, i64) {
    let (mantissa, exponent) = n.to_f64_exp();
    (mantissa, i64::from(exponent))
}

/// Returns the coefficients on a cell right of 0 of the polynomial whose coefficients have these leading bits; the largest of the
/// numbers `c_i 2^(k i)` has `reach` bits, with `2^k` the first power of two beyond the cell.
pub(super) fn expand(leads: &[(f64, i64)], reach: i64, cell: &Cell) -> Expansion {
    let depth = length(&cell.numerator);
    let k = cell.exponent + depth;
    // In units of 2^k, and of 2^reach.
    let part = |n: &Integer| {
        let (mantissa, exponent) = leading(n);
        mantissa * power_of_two((exponent - depth).max(LEAST))
    };
    let (from, to) = (part(&cell.numerator), part(&cell.end()));
    let scaled = (0_i64..).zip(leads).map(|(i, (mantissa, exponent))| {
        let exponent = exponent + k * i - reach;
        if exponent < LEAST { 0.0 } else { mantissa * power_of_two(exponent) }
    });
    let terms: Vec<f64> = scaled.collect();
    let (b, size) = Arch::new().dispatch(
        #[inline(always)]
        || horner(&terms, from, to),
    );
    let n = (leads.len() - 1) as f64;
    let unit = f64::EPSILON / 2.0;
    // The size itself is wrong by less than a hundredth.
    let bound = 1.01 * 1.01 * (8.0 * n + 2.0) * unit * size + (n + 1.0) * power_of_two(LEAST + 10);
    Expansion::Rough { coefficients: b, error: bound }
}

/// Returns the error that halving a cell adds to so many coefficients: each of n averages in a row rounds once, in proportion or below
/// the range of f64, and none exceeds the largest coefficient.
pub(super) fn error_of_halving(count: usize, largest: f64) -> f64 {
    1.01 * count as f64 * (f64::EPSILON / 2.0 * largest + power_of_two(LEAST))
}

/// Returns the coefficients on `[from, to]` of the polynomial with these terms, and `sum |c_i| to^i`.
#[inline(always)]
fn horner(terms: &[f64], from: f64, to: f64) -> (Vec<f64>, f64) {
    let count = terms.len();
    let (mut before, mut after) = (vec![0.0; count + 1], vec![0.0; count + 1]);
    let places: Vec<f64> = (0..=count).map(|j| j as f64).collect();
    let mut size = 0.0;
    // Entry j + 1 holds coefficient j; entry 0 stays 0.
    for (degree, term) in terms.iter().rev().enumerate() {
        size = size * to + term.abs();
        let whole = degree as f64;
        let part = if degree == 0 { 0.0 } else { 1.0 / whole };
        let (stay, rise) = (part * from, part * to);
        before[degree + 1] = 0.0;
        let pairs = before[..=degree].iter().zip(&before[1..degree + 2]);
        for ((b, place), (lower, same)) in after[1..degree + 2].iter_mut().zip(&places).zip(pairs) {
            *b = term + ((whole - place) * stay * same + place * rise * lower);
        }
        std::mem::swap(&mut before, &mut after);
    }
    before.remove(0);
    (before, size)
}
