//! Complex numbers beside what stands for their conjugates.
//!
//! Where angles are complex, `exp(i q)` and `exp(-i q)` are no conjugates any more: a point of the plane is then a pair
//! of numbers z = x + i y and w = x - i y, which are independent. \[Wampler2001\]

use crate::algebra::disc::Disc;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Ring;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::tower::Surd;
use num_complex::Complex;
use rug::{Float, Rational};

/// Bits of the discs in which assemblies are computed: those that rational numbers have there.
pub const BITS: u32 = 512;

/// A pair (z, w): z and its conjugate where the number is one of a real assembly.
#[derive(Clone, Debug, PartialEq)]
pub struct Isotropic<R> {
    /// x + i y
    pub z: R,
    /// x - i y
    pub w: R,
}

impl<R> Isotropic<R> {
    /// Maps both halves to another ring.
    pub fn map<S>(&self, image: impl Fn(&R) -> S) -> Isotropic<S> {
        Isotropic { z: image(&self.z), w: image(&self.w) }
    }
}

impl<R: Ring> Isotropic<R> {
    /// The conjugate; of a rotation its inverse.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { z: self.w.clone(), w: self.z.clone() }
    }
}

impl Isotropic<Gaussian> {
    /// An exact complex number.
    #[must_use]
    pub fn of(z: &Gaussian) -> Self {
        Self { z: z.clone(), w: Complex { re: z.re.clone(), im: Rational::from(-&z.im) } }
    }
}

impl<R: Ring> Ring for Isotropic<R> {
    fn zero() -> Self {
        Self { z: R::zero(), w: R::zero() }
    }
    fn one() -> Self {
        Self { z: R::one(), w: R::one() }
    }
    fn add(&self, other: &Self) -> Self {
        Self { z: self.z.add(&other.z), w: self.w.add(&other.w) }
    }
    fn sub(&self, other: &Self) -> Self {
        Self { z: self.z.sub(&other.z), w: self.w.sub(&other.w) }
    }
    fn mul(&self, other: &Self) -> Self {
        Self { z: self.z.mul(&other.z), w: self.w.mul(&other.w) }
    }
    fn neg(&self) -> Self {
        Self { z: self.z.neg(), w: self.w.neg() }
    }
    fn is_zero(&self) -> bool {
        self.z.is_zero() && self.w.is_zero()
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self { z: R::from_rational(q)?, w: R::from_rational(q)? })
    }
}

/// A number of an assembly: a disc that holds it, and the number itself where it is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Value {
    /// A disc that holds the number.
    pub disc: Disc,
    /// The number itself.
    pub exact: Option<Surd>,
}

/// The disc about an exact complex number.
#[must_use]
pub fn disc_of(z: &Gaussian) -> Disc {
    let i = Disc::point(Float::new(BITS), Float::with_val(BITS, 1));
    Disc::of(&z.re, BITS).add(&Disc::of(&z.im, BITS).mul(&i))
}

/// All rotations whose cosine and sine are enclosed.
#[must_use]
pub fn turn_within((cos, sin): &(Enclosure, Enclosure)) -> Isotropic<Value> {
    let real = |one: &Enclosure| Disc::of(&one.middle().to_rational().unwrap_or_default(), BITS).widened(&one.error());
    let i = Disc::point(Float::new(BITS), Float::with_val(BITS, 1));
    let (cos, sin) = (real(cos), real(sin).mul(&i));
    Isotropic { z: Value::within(cos.add(&sin)), w: Value::within(cos.sub(&sin)) }
}

impl Value {
    /// An exact complex number.
    #[must_use]
    pub fn exactly(z: &Gaussian) -> Self {
        Self { disc: disc_of(z), exact: Some(Surd::gaussian(z)) }
    }

    /// A number of which a disc is all that is known.
    #[must_use]
    pub fn within(disc: Disc) -> Self {
        Self { disc, exact: None }
    }

    /// Returns whether it is zero; `None` where that is undecided.
    #[must_use]
    pub fn vanishes(&self) -> Option<bool> {
        if self.disc.is_not_zero() {
            return Some(false);
        }
        self.exact.as_ref().map(Surd::is_zero).or_else(|| self.disc.is_zero().then_some(true))
    }

    /// The inverse; `None` where it may be zero.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let exact = self.exact.as_ref().map(Surd::inverse);
        Some(Self { disc: self.disc.inverse()?, exact: exact.flatten() })
    }

    /// The middle of the disc.
    #[must_use]
    pub fn middle(&self) -> Complex<f64> {
        middle(&self.disc)
    }
}

/// The middle of a disc.
#[must_use]
pub fn middle(disc: &Disc) -> Complex<f64> {
    Complex::new(disc.re.to_f64(), disc.im.to_f64())
}

/// The result of an operation on what is exact.
fn both(one: &Value, two: &Value, operation: impl Fn(&Surd, &Surd) -> Surd) -> Option<Surd> {
    Some(operation(one.exact.as_ref()?, two.exact.as_ref()?))
}

impl Ring for Value {
    fn zero() -> Self {
        Self { disc: Disc::zero(), exact: Some(Surd::rational(&Rational::new())) }
    }
    fn one() -> Self {
        // In full precision, so that its inverse has that, too.
        Self { disc: Disc::of(&Rational::from(1), BITS), exact: Some(Surd::rational(&Rational::from(1))) }
    }
    fn add(&self, other: &Self) -> Self {
        Self { disc: self.disc.add(&other.disc), exact: both(self, other, Surd::add) }
    }
    fn sub(&self, other: &Self) -> Self {
        Self { disc: self.disc.sub(&other.disc), exact: both(self, other, Surd::sub) }
    }
    fn mul(&self, other: &Self) -> Self {
        // An exact zero stays zero, without rounding.
        if self.disc.is_zero() || other.disc.is_zero() {
            return Self::zero();
        }
        Self { disc: self.disc.mul(&other.disc), exact: both(self, other, Surd::mul) }
    }
    fn neg(&self) -> Self {
        Self { disc: self.disc.neg(), exact: self.exact.as_ref().map(Surd::neg) }
    }
    fn is_zero(&self) -> bool {
        self.vanishes() == Some(true)
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self { disc: Disc::of(q, BITS), exact: Some(Surd::rational(q)) })
    }
}
