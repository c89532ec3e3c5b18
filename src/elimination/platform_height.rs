//! How large the integers of a platform's polynomial can be, known before it is: what turns its images modulo many primes
//! into a proof.
//!
//! With u = N (p.p, p, R^T p) for seven unknowns of degree 2 beside the quaternion x of degree 1, a pose is an isolated
//! zero of ten forms with integer coefficients: the six legs, linear in u; three components of `x q - p x`, of degree 3;
//! and `p.p - N s`, of degree 4. Such forms have 54 zeros at most, and the resultant of theirs with a linear form is at
//! most the product of the sums of the absolute values of coefficients, each to the number of zeros of the other forms.
//! docs/platforms.md has the proof.
//!
//! # Source
//! \[Canny1990\] for isolated zeros beside curves of others, \[Sombra2004\] for the size of resultants.

use crate::closure::study::LinearLegs;
use rug::{Integer, Rational};

/// Zeros of ten such forms, `2^6 3^3 4 / 2^7`.
const ZEROS: f64 = 54.0;
/// Sums of the absolute values of the coefficients of the forms that are the same for all platforms.
const CUBIC: f64 = 6.0;
const QUARTIC: f64 = 7.0;
/// More than what rounding adds to a sum of logarithms.
const SLACK: f64 = 1.0;

/// A bound for the isolated poses of a platform with given legs, all of them together.
#[derive(Clone, Copy, Debug)]
pub struct PlatformHeight {
    /// Bits of the resultant of the ten forms with a linear form, without what the latter contributes.
    bits: f64,
}

impl PlatformHeight {
    /// The bound for legs as linear equations and their squared lengths.
    #[must_use]
    pub fn new(legs: &LinearLegs<Rational>, squares: &[Rational; 6]) -> Self {
        // Lengths in a unit in which the points are integers: p and R^T p times it, p.p times its square.
        let unit = legs.matrix.iter().flatten().fold(Integer::from(1), |lcm, x| lcm.lcm(x.denom()));
        let area = Integer::from(unit.square_ref());
        let leg = |i: usize| {
            let linear = legs.matrix[i][1..].iter().map(|x| Rational::from(x * &unit));
            let form = legs.forms[i].iter().enumerate().flat_map(|(j, row)| {
                row.iter()
                    .enumerate()
                    .map(move |(k, c)| if j == k { Rational::from(c + &squares[i]) } else { c.clone() })
            });
            let row: Vec<Rational> = linear.chain(form.map(|c| c * &area)).collect();
            let scale = row.iter().fold(Integer::from(1), |lcm, x| lcm.lcm(x.denom()));
            let sum: Rational = row.into_iter().map(|x| x.abs() * &scale).sum();
            // The coefficient of p.p beside them.
            logarithm(&(sum.ceil().numer() + &scale).into())
        };
        let legs: f64 = (0..6).map(|i| ZEROS / 2.0 * leg(i)).sum();
        let cubics = 3.0 * ZEROS / 3.0 * (CUBIC + 1.0).log2();
        let quartic = ZEROS / 4.0 * (QUARTIC + 1.0).log2();
        Self { bits: legs + cubics + quartic + SLACK }
    }

    /// Bits that bound the product of all leading coefficients and roots outside the unit circle (Mahler's measure) of
    /// the primitive polynomial of a coordinate `weights.(x_1, x_2, x_3) / x_0`.
    #[must_use]
    pub fn measure(&self, weights: &[i32; 3]) -> f64 {
        let sum: f64 = weights.iter().map(|&w| f64::from(w).abs()).sum();
        self.bits + ZEROS * (1.0 + sum).log2()
    }

    /// Bits of the product of N over all isolated poses, an integer where every pose is in lowest terms.
    #[must_use]
    pub fn norm(&self) -> f64 {
        // Eleven unknowns in the linear form; N is a sum of four squares.
        2.0 * (self.bits + ZEROS * 11_f64.log2()) + ZEROS * 2.0
    }
}

/// The binary logarithm of an integer and one more.
fn logarithm(n: &Integer) -> f64 {
    let (mantissa, exponent) = Integer::from(n + 1_u32).to_f64_exp();
    mantissa.log2() + f64::from(exponent)
}
