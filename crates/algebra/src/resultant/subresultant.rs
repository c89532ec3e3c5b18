//! The chain of subresultants by pseudo-division: resultants over any ring with exact division, and the way back to
//! the eliminated variable.

use super::odd;
use crate::ring::{Domain, Ring};
use crate::univariate::Univariate;

/// Returns the subresultants `S_0, ..., S_(k-1)` of two polynomials of degrees m and n, k the smaller one.
///
/// `S_j` is the polynomial of degree j or less whose coefficient of `x^i` is the determinant of the rows
/// `x^(n-j-1) f, ..., f, x^(m-j-1) g, ..., g` in the columns of `x^(m+n-j-1), ..., x^(j+1), x^i`. `S_0` is the resultant
/// (unless k is 0). If it vanishes, and the coefficient of x in `S_1` does not, `S_1` has the common root; and so on:
/// the first one that does not vanish is a greatest common divisor over the fractions.
///
/// # Source
/// Ducos 2000, Optimizations of the subresultant algorithm, Journal of Pure and Applied Algebra 145.
#[must_use]
pub fn chain<D: Domain>(f: &Univariate<D>, g: &Univariate<D>) -> Vec<Univariate<D>> {
    let (Some(m), Some(n)) = (f.degree(), g.degree()) else { return Vec::new() };
    if m < n {
        let swapped = chain(g, f).into_iter().enumerate();
        return swapped.map(|(j, s)| if odd((m - j) * (n - j)) { s.neg() } else { s }).collect();
    }
    let mut subresultants = vec![Univariate::zero(); n];
    if n == 0 {
        return subresultants;
    }
    // Throughout, `a` is S_d up to a factor, `b` is S_(d-1), and `scale` the leading coefficient of S_d.
    let mut scale = power(leading(g), m - n);
    let mut a = g.clone();
    let mut b = signed_pseudo_remainder(f, g);
    while let (Some(d), Some(e)) = (a.degree(), b.degree()) {
        subresultants[d - 1] = b.clone();
        let regular = if e + 1 < d { lowered(&b, &scale, d - e - 1) } else { b.clone() };
        subresultants[e] = regular.clone();
        if e == 0 {
            break;
        }
        b = next(&a, &b, &regular, &scale);
        scale = leading(&regular).clone();
        a = regular;
    }
    subresultants
}

/// Returns the resultant as the last of the chain of subresultants, right also for constants: `Res(f, c) = c^m`; 0 if a
/// polynomial is zero.
#[must_use]
pub fn resultant<D: Domain>(f: &Univariate<D>, g: &Univariate<D>) -> D {
    match (f.degree(), g.degree()) {
        (None, _) | (_, None) => D::zero(),
        (Some(m), Some(0)) => power(leading(g), m),
        (Some(0), Some(n)) => power(leading(f), n),
        _ => chain(f, g)[0].coefficients().first().cloned().unwrap_or_else(D::zero),
    }
}

fn leading<R: Ring>(f: &Univariate<R>) -> &R {
    f.coefficients().last().expect("the polynomial is not zero")
}

fn coefficient<R: Ring>(f: &Univariate<R>, k: usize) -> R {
    f.coefficients().get(k).cloned().unwrap_or_else(R::zero)
}

/// Returns the power, by repeated squaring.
pub(super) fn power<R: Ring>(x: &R, exponent: usize) -> R {
    if exponent <= 1 {
        return if exponent == 0 { R::one() } else { x.clone() };
    }
    let half = power(x, exponent / 2);
    let square = half.mul(&half);
    if odd(exponent) { square.mul(x) } else { square }
}

/// Returns the remainder of `(-l)^(m-n+1) f` by g, l the leading coefficient of g: with this sign the subresultant `S_(n-1)`.
fn signed_pseudo_remainder<D: Domain>(f: &Univariate<D>, g: &Univariate<D>) -> Univariate<D> {
    let steps = f.coefficients().len() - g.coefficients().len() + 1;
    let (remainder, taken) = f.pseudo_remainder(g);
    let factor = power(leading(g), steps - taken as usize);
    remainder.scale(&if odd(steps) { factor.neg() } else { factor })
}

/// Returns `b l^gap / scale^gap`, l the leading coefficient of b: the regular subresultant of the same degree, by powers
/// that are kept small on the way (Lazard's improvement).
fn lowered<D: Domain>(b: &Univariate<D>, scale: &D, gap: usize) -> Univariate<D> {
    let x = leading(b);
    let mut factor = x.clone();
    for bit in (0..gap.ilog2()).rev() {
        factor = factor.mul(&factor).div_exact(scale);
        if odd(gap >> bit) {
            factor = factor.mul(x).div_exact(scale);
        }
    }
    Univariate::new(b.coefficients().iter().map(|c| c.mul(&factor).div_exact(scale)).collect())
}

/// Returns the subresultant `S_(e-1)` after a of degree d, `b = S_(d-1)` of degree e and the regular one of that degree, with
/// divisions as early as they are exact.
fn next<D: Domain>(a: &Univariate<D>, b: &Univariate<D>, regular: &Univariate<D>, scale: &D) -> Univariate<D> {
    let (d, e) = (a.coefficients().len() - 1, b.coefficients().len() - 1);
    let (leading_a, leading_b, leading_regular) = (leading(a), leading(b), leading(regular));
    // h is x^j modulo b, times the leading coefficient of the regular one, for j = e, e + 1, ...; below e it is a
    // multiple of a power of x.
    let mut h: Vec<D> = regular.coefficients()[..e].iter().map(Ring::neg).collect();
    let top = coefficient(a, e);
    let mut sum: Vec<D> = (0..e).map(|j| coefficient(a, j).mul(leading_regular).add(&top.mul(&h[j]))).collect();
    for j in e + 1..d {
        h = shifted(&h, b, |carry, c| carry.mul(c).div_exact(leading_b));
        let factor = coefficient(a, j);
        if !factor.is_zero() {
            for (s, x) in sum.iter_mut().zip(&h) {
                *s = s.add(&factor.mul(x));
            }
        }
    }
    let carry = h[e - 1].clone();
    let term = |j: usize| {
        let mut value = sum[j].div_exact(leading_a);
        if j > 0 {
            value = value.add(&h[j - 1]);
        }
        let value = leading_b.mul(&value).sub(&carry.mul(&b.coefficients()[j])).div_exact(scale);
        if odd(d - e + 1) { value.neg() } else { value }
    };
    Univariate::new((0..e).map(term).collect())
}

/// Returns `x h` less the multiple of b that takes off the power that b has as its highest.
fn shifted<D: Domain>(h: &[D], b: &Univariate<D>, multiple: impl Fn(&D, &D) -> D) -> Vec<D> {
    let carry = &h[h.len() - 1];
    let term = |j: usize| {
        let below = if j == 0 { D::zero() } else { h[j - 1].clone() };
        below.sub(&multiple(carry, &b.coefficients()[j]))
    };
    (0..h.len()).map(term).collect()
}
