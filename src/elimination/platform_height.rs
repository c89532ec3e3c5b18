//! An a priori bound on the integers of a platform's polynomial, which turns its images modulo many primes into a proof.
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
/// Upper bound on the rounding error of a sum of logarithms.
const SLACK: f64 = 1.0;

/// A bound for the isolated poses of a platform with given legs, all of them together.
#[derive(Clone, Copy, Debug)]
pub struct PlatformHeight {
    /// Binary logarithms of the sums of absolute values of the integer coefficients of each leg: of s, of p and q, of x.
    legs: [[f64; 3]; 6],
}

impl PlatformHeight {
    /// The bound for legs as linear equations and their squared lengths.
    #[must_use]
    pub fn new(legs: &LinearLegs<Rational>, squares: &[Rational; 6]) -> Self {
        // Lengths in a unit in which the points are integers: p and R^T p times it, p.p times its square.
        let unit = legs.matrix.iter().flatten().fold(Integer::from(1), |lcm, x| lcm.lcm(x.denom()));
        let area = Integer::from(unit.square_ref());
        let leg = |i: usize| {
            let linear: Vec<Rational> = legs.matrix[i][1..].iter().map(|x| Rational::from(x * &unit)).collect();
            let form = legs.forms[i].iter().enumerate().flat_map(|(j, row)| {
                row.iter()
                    .enumerate()
                    .map(move |(k, c)| if j == k { Rational::from(c + &squares[i]) } else { c.clone() })
            });
            let form: Vec<Rational> = form.map(|c| c * &area).collect();
            let scale = linear.iter().chain(&form).fold(Integer::from(1), |lcm, x| lcm.lcm(x.denom()));
            let sum =
                |part: &[Rational]| -> Rational { part.iter().map(|x| Rational::from(x.abs_ref()) * &scale).sum() };
            [logarithm(&scale), logarithm(sum(&linear).numer()), logarithm(sum(&form).numer())]
        };
        Self { legs: std::array::from_fn(leg) }
    }

    /// Returns the bits of the resultant of the ten forms with a linear form, without the contribution of the latter, when s is
    /// measured in units of `4^t` and p, q in units of `2^t`.
    fn bits(&self, t: f64) -> f64 {
        let leg = |&[s, linear, form]: &[f64; 3]| sum(sum(s + 2.0 * t, linear + t), sum(form, 2.0 * t));
        let legs: f64 = self.legs.iter().map(|parts| ZEROS / 2.0 * leg(parts)).sum();
        let cubics = 3.0 * ZEROS / 3.0 * sum(6_f64.log2() + t, 0.0);
        let quartic = ZEROS / 4.0 * (3.0 + 2.0 * t);
        legs + cubics + quartic - ZEROS / 2.0 * 8.0 * t + SLACK
    }

    /// Returns the least value over all units.
    fn least(&self, bits: impl Fn(f64) -> f64) -> f64 {
        let longest = self.legs.iter().flatten().fold(0.0, |a: f64, &b| a.max(b));
        let (mut least, mut t) = (f64::INFINITY, 0.0);
        while t <= longest {
            least = least.min(bits(t));
            t += 1.0;
        }
        least
    }

    /// Bits that bound the product of all leading coefficients and roots outside the unit circle (Mahler's measure) of
    /// the primitive polynomial of a coordinate `weights.(x_1, x_2, x_3) / x_0`.
    #[must_use]
    pub fn measure(&self, weights: &[i32; 3]) -> f64 {
        let sum: f64 = weights.iter().map(|&w| f64::from(w).abs()).sum();
        self.least(|t| self.bits(t)) + ZEROS * (1.0 + sum).log2()
    }

    /// Bits of the product of N over all isolated poses, an integer where every pose is in lowest terms.
    #[must_use]
    pub fn norm(&self) -> f64 {
        // The linear form has eleven unknowns: x, and square roots of s, p, q. N is a sum of four squares.
        let linear = |t: f64| sum(sum(2.0, t), 6_f64.log2() + t / 2.0);
        2.0 * self.least(|t| self.bits(t) + ZEROS * linear(t)) + ZEROS * 2.0
    }
}

/// The binary logarithm of a positive integer, `-inf` for 0.
fn logarithm(n: &Integer) -> f64 {
    let (mantissa, exponent) = n.to_f64_exp();
    mantissa.log2() + f64::from(exponent)
}

/// Returns the binary logarithm of the sum of two numbers given by their logarithms, one of them finite.
fn sum(a: f64, b: f64) -> f64 {
    let (small, large) = if a < b { (a, b) } else { (b, a) };
    large + (small - large).exp2().ln_1p() / std::f64::consts::LN_2
}
