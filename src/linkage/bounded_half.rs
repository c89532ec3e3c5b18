//! Halves of numbers in floating point, with a bound of their error: they decide most questions of dyads in a hundredth of the time
//! that long discs take.

use super::isotropic::{Value, middle};
use super::quadratic::{Decidable, Top};
use super::state::Half;
use crate::algebra::bounded::Floating;
use crate::algebra::disc::Disc;
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use num_complex::Complex;
use rug::{Float, Rational};

/// Bits of the discs that hold such numbers: more than sums of two doubles have that were rounded before, so that what is lost here is a
/// small part of their error.
const DISC_BITS: u32 = 128;
/// Factor that covers the roundings of a bound, which is made of some ten sums, products and roots of numbers that are not negative.
const UP: f64 = 1.0 + 64.0 * f64::EPSILON;
/// Factor that lowers a bound from below in the same way.
const DOWN: f64 = 1.0 - 64.0 * f64::EPSILON;
/// More than a bound loses by underflow.
const TINY: f64 = 1e-280;

/// All complex numbers within a radius of a computed one.
///
/// A bound for both parts together, and not for each, is not turned by a product: it grows with the size of the factors, and not by
/// sqrt(2) more every time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundedHalf<T> {
    re: T,
    im: T,
    radius: f64,
}

impl<T: Floating> BoundedHalf<T> {
    /// Returns a computed number of which this many units in the last place of `size` are lost beside `radius`.
    fn new(re: T, im: T, radius: f64, units: f64, size: f64) -> Self {
        Self { re, im, radius: (radius + units * T::ROUNDOFF * size) * UP + TINY }
    }

    /// Returns the computed number, rounded.
    pub fn middle(self) -> Complex<f64> {
        Complex::new(self.re.in_f64(), self.im.in_f64())
    }

    /// Returns the size of the computed number, about as exact as an f64.
    fn size(self) -> f64 {
        let Complex { re, im } = self.middle();
        (re * re + im * im).sqrt()
    }

    /// Returns an upper bound of all sizes.
    fn at_most(self) -> f64 {
        (self.size() + self.radius) * UP + TINY
    }

    /// Returns the computed number, without its error.
    fn computed(self) -> Self {
        Self { radius: 0.0, ..self }
    }
}

impl<T: Floating + From<f64>> BoundedHalf<T> {
    /// Returns an f64 as it is.
    fn of(z: Complex<f64>) -> Self {
        Self { re: T::from(z.re), im: T::from(z.im), radius: 0.0 }
    }
}

impl<T: Floating> Ring for BoundedHalf<T> {
    const LIGHT: bool = T::LIGHT;

    fn zero() -> Self {
        Self { re: T::zero(), im: T::zero(), radius: 0.0 }
    }
    fn one() -> Self {
        Self { re: T::one(), im: T::zero(), radius: 0.0 }
    }
    fn add(&self, other: &Self) -> Self {
        let (re, im) = (self.re.add(&other.re), self.im.add(&other.im));
        // One rounding of each part.
        let size = re.in_f64().abs() + im.in_f64().abs();
        Self::new(re, im, self.radius + other.radius, 1.0, size)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        // An exact zero stays zero, without rounding.
        if self.is_zero() || other.is_zero() {
            return Self::zero();
        }
        let re = self.re.mul(&other.re).sub(&self.im.mul(&other.im));
        let im = self.re.mul(&other.im).add(&self.im.mul(&other.re));
        let (own, others) = (self.size(), other.size());
        let moved = own * other.radius + others * self.radius + self.radius * other.radius;
        // Each part has two products and a sum, whose terms are together no larger than the product of the sizes, and twice that for both.
        Self::new(re, im, moved, 8.0, own * others)
    }
    fn neg(&self) -> Self {
        Self { re: self.re.neg(), im: self.im.neg(), radius: self.radius }
    }
    fn is_zero(&self) -> bool {
        self.re.is_zero() && self.im.is_zero() && self.radius == 0.0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        if *q == 0 {
            return Some(Self::zero());
        }
        let re = T::from_rational(q)?;
        // The nearest number, or one beside it.
        Some(Self::new(re, T::zero(), 0.0, 2.0, re.in_f64().abs()))
    }
}

impl<T: Floating + From<f64>> Half for BoundedHalf<T> {
    fn exactly(z: &Gaussian) -> Self {
        let unknown = Self { radius: f64::INFINITY, ..Self::zero() };
        let part = |q: &Rational| Self::from_rational(q).unwrap_or(unknown);
        let (re, im) = (part(&z.re), part(&z.im));
        Self { re: re.re, im: im.re, radius: (re.radius + im.radius) * UP }
    }
}

impl<T: Floating + From<f64>> Decidable for BoundedHalf<T> {
    fn vanishes(&self) -> Option<bool> {
        if self.size() * DOWN > self.radius + TINY {
            return Some(false);
        }
        self.is_zero().then_some(true)
    }

    /// With v beside 1/z and e = |1 - z v| < 1/2, |1/z - v| = e/|z| is at most e |v|/(1 - e).
    fn inverse(&self) -> Option<Self> {
        let start = Self::of(self.middle().inv());
        // One step of Newton's method, as the first inverse is no better than an f64.
        let step = Self::one().sub(&self.computed().mul(&start));
        let near = start.add(&start.mul(&step)).computed();
        let defect = Self::one().sub(&self.mul(&near)).at_most();
        (defect < 0.5).then(|| Self { radius: 2.0 * defect * near.at_most() * UP, ..near })
    }

    /// Of the roots w and -w one has Re(w conj(r)) >= 0, so that |w + r| >= |r| and |w - r| <= |z - r^2|/|r|.
    fn square_root(&self, _: &Top) -> Option<Self> {
        let start = Self::of(self.middle().sqrt());
        let half = Self::of(start.middle().inv() / 2.0);
        let step = self.computed().sub(&start.mul(&start));
        let near = start.add(&step.mul(&half)).computed();
        let (defect, least) = (self.sub(&near.mul(&near)).at_most(), near.size() * DOWN);
        let radius = defect / least * UP;
        (least > TINY && radius < least).then_some(Self { radius, ..near })
    }

    fn conjugate(&self) -> Self {
        Self { im: self.im.neg(), ..*self }
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
    /// Returns a number of which a disc is all that is known.
    fn within(value: &Value) -> Self;
}

impl Followed for BoundedHalf<f64> {
    type Finer = BoundedHalf<DoubleDouble>;

    fn rough(&self) -> BoundedHalf<f64> {
        *self
    }
    fn value(&self) -> Value {
        disc([self.re, self.im].map(|part| Float::with_val(DISC_BITS, part)), self.radius)
    }
    fn within(value: &Value) -> Self {
        value.rough()
    }
}

impl Followed for BoundedHalf<DoubleDouble> {
    type Finer = Value;

    fn rough(&self) -> BoundedHalf<f64> {
        let near = self.middle();
        // Each part is the nearest f64, or one beside it.
        BoundedHalf::new(near.re, near.im, self.radius, 2.0, near.re.abs() + near.im.abs())
    }
    fn value(&self) -> Value {
        let long = |part: DoubleDouble| {
            let [high, low] = part.parts();
            Float::with_val(DISC_BITS, high) + low
        };
        disc([self.re, self.im].map(long), self.radius)
    }
    fn within(value: &Value) -> Self {
        let part = |part: &Float| {
            let high = part.to_f64();
            DoubleDouble::from(high).add(&DoubleDouble::from(Float::with_val(part.prec(), part - high).to_f64()))
        };
        let (re, im) = (part(&value.disc.re), part(&value.disc.im));
        let off = value.disc.radius().to_f64() * UP + f64::MIN_POSITIVE;
        Self::new(re, im, off, 2.0, re.in_f64().abs() + im.in_f64().abs())
    }
}

impl Followed for Value {
    type Finer = Self;
    const HAS_FINER: bool = false;

    fn rough(&self) -> BoundedHalf<f64> {
        let near = middle(&self.disc);
        // Rounding takes half a unit in the last place of each part and of the radius.
        let off = self.disc.radius().to_f64() * UP + f64::MIN_POSITIVE;
        BoundedHalf::new(near.re, near.im, off, 2.0, near.re.abs() + near.im.abs())
    }
    fn value(&self) -> Value {
        self.clone()
    }
    fn within(value: &Value) -> Self {
        value.clone()
    }
}

/// Returns the disc about a computed number.
fn disc([re, im]: [Float; 2], radius: f64) -> Value {
    // The centre loses less than 2^-127 of its size, the radius of what is not exact is 2^-100 of it at least.
    Value::within(Disc::new(re, im, &Float::with_val(64, radius * 1.01)))
}
