//! How many roots of a polynomial share all algebraic properties.

use super::modp::{ModP, PRIME_61, PRIME_62};
use super::ring::Ring;
use super::univariate::Univariate;
use rug::Rational;

/// Returns a lower bound on the number of roots that are conjugate to a root of a square-free polynomial over the rationals, whichever
/// it is: the least degree of an irreducible factor, or less.
///
/// # Example
/// ```
/// use looproot_algebra::{conjugates::fewest_conjugates, univariate::Univariate};
/// use rug::Rational;
///
/// let of = |coefficients: &[i32]| Univariate::new(coefficients.iter().copied().map(Rational::from).collect());
/// // The fifth roots of unity but 1.
/// assert_eq!(fewest_conjugates(&of(&[1, 1, 1, 1, 1])), 4);
/// // (x^2 + 1)(x^2 + 2)
/// assert_eq!(fewest_conjugates(&of(&[2, 0, 3, 0, 1])), 2);
/// assert_eq!(fewest_conjugates(&of(&[-1, 0, 1])), 1);
/// ```
#[must_use]
pub fn fewest_conjugates(polynomial: &Univariate<Rational>) -> usize {
    if polynomial.real_roots().iter_mut().any(|root| root.rational().is_some()) {
        return 1;
    }
    let degree = polynomial.degree().unwrap_or(1);
    let stays_whole = degree <= 3
        || is_irreducible::<PRIME_61>(polynomial)
        || is_irreducible::<PRIME_62>(polynomial)
        || is_irreducible::<1_000_000_007>(polynomial)
        || is_irreducible::<998_244_353>(polynomial)
        || is_irreducible::<104_729>(polynomial)
        || is_irreducible::<7919>(polynomial);
    if stays_whole { degree } else { 2 }
}

/// Whether a polynomial is irreducible modulo a prime, and hence over the rationals: no factor of it divides `x^(p^k) - x`
/// for k up to half its degree.
fn is_irreducible<const P: u64>(polynomial: &Univariate<Rational>) -> bool {
    let Some(f) = polynomial.map(ModP::<P>::from_rational) else { return false };
    if f.degree() != polynomial.degree() {
        return false;
    }
    let mut power = Univariate::x();
    for _ in 0..f.degree().unwrap_or(0) / 2 {
        let base = power;
        power = Univariate::one();
        for bit in (0..u64::BITS - P.leading_zeros()).rev() {
            power = power.mul(&power).div_rem(&f).1;
            if P >> bit & 1 == 1 {
                power = power.mul(&base).div_rem(&f).1;
            }
        }
        if f.gcd(&power.sub(&Univariate::x())).degree() != Some(0) {
            return false;
        }
    }
    true
}
