//! Truncated power series `c_0 + c_1 eps + ... + c_{N-1} eps^{N-1}`: derivatives of any order.

use super::number::{Angle, Number};
use super::ring::Ring;
use rug::Rational;

/// A power series in `eps` modulo `eps^N` over any ring; `N` is at least 1.
///
/// The k-th derivative of the expanded function is `k!` times coefficient k.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Series<R, const N: usize> {
    /// Coefficient k belongs to `eps^k`.
    pub coefficients: [R; N],
}

impl<R: Ring, const N: usize> Series<R, N> {
    /// Returns a constant: all other coefficients are 0.
    #[must_use]
    pub fn constant(value: R) -> Self {
        let mut series = Self { coefficients: std::array::from_fn(|_| R::zero()) };
        series.coefficients[0] = value;
        series
    }

    /// Returns cosine and sine of an angle series whose constant coefficient has this cosine and sine; the constant coefficient
    /// itself is ignored. `None` if some number below `N` has no inverse in the ring.
    ///
    /// `k C_k = -sum_j j a_j S_{k-j}` and `k S_k = sum_j j a_j C_{k-j}`, from `C' = -a' S` and `S' = a' C`.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::series::Series;
    /// // cos and sin of eps itself.
    /// let (cos, sin) = Series { coefficients: [0.0, 1.0, 0.0, 0.0] }.cos_sin_beyond(1.0, 0.0).unwrap();
    /// assert_eq!(cos.coefficients, [1.0, 0.0, -0.5, 0.0]);
    /// assert_eq!(sin.coefficients, [0.0, 1.0, 0.0, -1.0 / 6.0]);
    /// ```
    #[must_use]
    pub fn cos_sin_beyond(&self, cos: R, sin: R) -> Option<(Self, Self)> {
        let (mut c, mut s) = (Self::constant(cos), Self::constant(sin));
        for k in 1..N {
            let (mut of_cos, mut of_sin) = (R::zero(), R::zero());
            for j in 1..=k {
                let slope = R::from_rational(&Rational::from((j, k)))?.mul(&self.coefficients[j]);
                of_cos = of_cos.sub(&slope.mul(&s.coefficients[k - j]));
                of_sin = of_sin.add(&slope.mul(&c.coefficients[k - j]));
            }
            (c.coefficients[k], s.coefficients[k]) = (of_cos, of_sin);
        }
        Some((c, s))
    }

    fn zip(&self, other: &Self, with: impl Fn(&R, &R) -> R) -> Self {
        Self { coefficients: std::array::from_fn(|k| with(&self.coefficients[k], &other.coefficients[k])) }
    }
}

impl<R: Ring, const N: usize> Ring for Series<R, N> {
    fn zero() -> Self {
        Self::constant(R::zero())
    }
    fn one() -> Self {
        Self::constant(R::one())
    }
    fn add(&self, other: &Self) -> Self {
        self.zip(other, R::add)
    }
    fn sub(&self, other: &Self) -> Self {
        self.zip(other, R::sub)
    }
    fn mul(&self, other: &Self) -> Self {
        let coefficient = |k: usize| {
            let mut sum = R::zero();
            for j in 0..=k {
                sum.add_product(&self.coefficients[j], &other.coefficients[k - j]);
            }
            sum
        };
        Self { coefficients: std::array::from_fn(coefficient) }
    }
    fn neg(&self) -> Self {
        Self { coefficients: self.coefficients.each_ref().map(R::neg) }
    }
    fn is_zero(&self) -> bool {
        self.coefficients.iter().all(R::is_zero)
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        R::from_rational(q).map(Self::constant)
    }
    fn from_integer(n: i32) -> Self {
        Self::constant(R::from_integer(n))
    }
    fn cos_sin(angle: &Angle) -> Option<(Self, Self)> {
        R::cos_sin(angle).map(|(cos, sin)| (Self::constant(cos), Self::constant(sin)))
    }
    fn from_number(number: &Number) -> Option<Self> {
        R::from_number(number).map(Self::constant)
    }
}
