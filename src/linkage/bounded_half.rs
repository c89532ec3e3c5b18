//! Halves of numbers in floating point, with a bound of their error: they decide most questions of dyads in a hundredth of the time
//! that long discs take.

use super::isotropic::{Value, middle};
use super::quadratic::{Decidable, Top};
use super::state::Half;
use crate::algebra::bounded::{Bounded, Floating};
use crate::algebra::disc::Disc;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use num_complex::Complex;
use rug::{Float, Rational};

/// Bits of the discs that hold such numbers: more than sums of two doubles have that were rounded before, so that what is lost here is a
/// small part of their error.
const DISC_BITS: u32 = 128;
/// What is read off numbers whose own rounding is small beside it is lowered by this.
const LEAST: f64 = 0.99;

/// A complex number whose parts are known up to a bound.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedHalf<T> {
    re: Bounded<T>,
    im: Bounded<T>,
}

impl<T: Floating + From<f64>> BoundedHalf<T> {
    /// Returns an f64 as it is.
    fn of(z: Complex<f64>) -> Self {
        Self { re: Bounded::new(T::from(z.re), 0.0), im: Bounded::new(T::from(z.im), 0.0) }
    }

    /// Returns the computed number, without its error.
    fn computed(self) -> Self {
        Self { re: Bounded::new(self.re.value, 0.0), im: Bounded::new(self.im.value, 0.0) }
    }

    /// Returns the computed number, rounded.
    pub fn middle(self) -> Complex<f64> {
        Complex::new(self.re.value.in_f64(), self.im.value.in_f64())
    }

    /// Returns an upper bound of the absolute value.
    fn at_most(self) -> f64 {
        self.re.size() + self.im.size()
    }

    /// Returns a lower bound of the absolute value of the computed number.
    fn computed_at_least(self) -> f64 {
        self.re.value.in_f64().abs().max(self.im.value.in_f64().abs()) * LEAST
    }

    /// Returns the numbers within this distance of the computed one.
    fn within(self, error: f64) -> Self {
        Self { re: Bounded::new(self.re.value, error), im: Bounded::new(self.im.value, error) }
    }

    /// Returns the number in f64 with the bound of its error.
    #[must_use]
    pub fn in_f64(self) -> BoundedHalf<f64> {
        BoundedHalf { re: self.re.in_f64(), im: self.im.in_f64() }
    }
}

impl<T: Floating> Ring for BoundedHalf<T> {
    const LIGHT: bool = T::LIGHT;

    fn zero() -> Self {
        Self { re: Bounded::zero(), im: Bounded::zero() }
    }
    fn one() -> Self {
        Self { re: Bounded::one(), im: Bounded::zero() }
    }
    fn add(&self, other: &Self) -> Self {
        Self { re: self.re.add(&other.re), im: self.im.add(&other.im) }
    }
    fn sub(&self, other: &Self) -> Self {
        Self { re: self.re.sub(&other.re), im: self.im.sub(&other.im) }
    }
    fn mul(&self, other: &Self) -> Self {
        // An exact zero stays zero, without rounding.
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let re = self.re.mul(&other.re).sub(&self.im.mul(&other.im));
        let im = self.re.mul(&other.im).add(&self.im.mul(&other.re));
        Self { re, im }
    }
    fn neg(&self) -> Self {
        Self { re: self.re.neg(), im: self.im.neg() }
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        let re = if *q == 0 { Bounded::zero() } else { Bounded::from_rational(q)? };
        Some(Self { re, im: Bounded::zero() })
    }
}

impl<T: Floating + From<f64>> Half for BoundedHalf<T> {
    fn exactly(z: &Gaussian) -> Self {
        let part = |q: &Rational| Self::from_rational(q).map_or(Bounded::new(T::zero(), f64::INFINITY), |half| half.re);
        Self { re: part(&z.re), im: part(&z.im) }
    }
}

impl<T: Floating + From<f64>> Decidable for BoundedHalf<T> {
    fn vanishes(&self) -> Option<bool> {
        let is_off = |part: Bounded<T>| part.value.in_f64().abs() * LEAST > part.error();
        if is_off(self.re) || is_off(self.im) {
            return Some(false);
        }
        self.is_zero().then_some(true)
    }

    /// With v beside 1/z and e = |1 - z v| < 1/2, |1/z - v| = e/|z| is at most e |v|/(1 - e).
    fn inverse(&self) -> Option<Self> {
        let start = Self::of(self.middle().inv());
        // One step of Newton's method, as v itself is no better than an f64.
        let step = Self::one().sub(&self.computed().mul(&start));
        let near = start.add(&start.mul(&step)).computed();
        let defect = Self::one().sub(&self.mul(&near)).at_most();
        (defect < 0.5).then(|| near.within(2.0 * defect * near.at_most()))
    }

    /// Of the roots w and -w one has Re(w conj(r)) >= 0, so that |w + r| >= |r| and |w - r| <= |z - r^2|/|r|.
    fn square_root(&self, _: &Top) -> Option<Self> {
        let start = Self::of(self.middle().sqrt());
        let half = Self::of(start.middle().inv() / 2.0);
        let step = self.computed().sub(&start.mul(&start));
        let near = start.add(&step.mul(&half)).computed();
        let (defect, least) = (self.sub(&near.mul(&near)).at_most(), near.computed_at_least());
        let error = defect / least;
        (least > 0.0 && error < least).then(|| near.within(error / LEAST))
    }

    fn conjugate(&self) -> Self {
        Self { re: self.re, im: self.im.neg() }
    }
}

/// Numbers that are followed through the branches of a linkage, and what takes their place where they leave a question open.
pub trait Followed: Decidable {
    /// Numbers that decide more.
    type Finer: Followed;
    /// Whether there are such numbers.
    const HAS_FINER: bool = true;

    /// Returns what is known of the number in f64.
    fn rough(&self) -> BoundedHalf<f64>;
    /// Returns the number as one of an assembly.
    fn value(&self) -> Value;
}

impl Followed for BoundedHalf<f64> {
    type Finer = BoundedHalf<DoubleDouble>;

    fn rough(&self) -> BoundedHalf<f64> {
        *self
    }
    fn value(&self) -> Value {
        disc([self.re.value, self.im.value].map(|part| Float::with_val(DISC_BITS, part)), [self.re, self.im])
    }
}

impl Followed for BoundedHalf<DoubleDouble> {
    type Finer = Value;

    fn rough(&self) -> BoundedHalf<f64> {
        self.in_f64()
    }
    fn value(&self) -> Value {
        let long = |part: DoubleDouble| {
            let [high, low] = part.parts();
            Float::with_val(DISC_BITS, high) + low
        };
        disc([self.re.value, self.im.value].map(long), [self.re, self.im])
    }
}

impl Followed for Value {
    type Finer = Self;
    const HAS_FINER: bool = false;

    fn rough(&self) -> BoundedHalf<f64> {
        let near = middle(&self.disc);
        let off = self.disc.radius().to_f64() / LEAST;
        // Half a unit in the last place of each part, and of what lies below all of them.
        let part = |x: f64| Bounded::new(x, off + f64::EPSILON * x.abs() + f64::MIN_POSITIVE);
        BoundedHalf { re: part(near.re), im: part(near.im) }
    }
    fn value(&self) -> Value {
        self.clone()
    }
}

/// Returns the disc about a number whose parts are known up to a bound.
fn disc<T: Floating>([re, im]: [Float; 2], parts: [Bounded<T>; 2]) -> Value {
    let [a, b] = parts.map(|part| part.error());
    Value::within(Disc::new(re, im, &Float::with_val(64, (a + b) / LEAST)))
}
