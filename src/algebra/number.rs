//! Numbers and angles as a mechanism file gives them: exact where they can be, correctly rounded where not.

use rug::{Float, Rational};

/// A real number of a file: its exact rational value, or a rational within 1e-16 of an irrational one.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    rational: Rational,
    exact: bool,
    float: f64,
}

/// The tangent of half an angle, infinite at pi.
#[derive(Clone, Debug, PartialEq)]
pub enum HalfTangent {
    /// An angle other than pi.
    Finite(Rational),
    /// The angle pi.
    Infinite,
}

/// An angle of a file, known twice: correctly rounded in f64, and as an exact rational half-angle tangent.
#[derive(Clone, Debug, PartialEq)]
pub struct Angle {
    radians: f64,
    cos_sin: (f64, f64),
    half_tangent: HalfTangent,
    exact: bool,
}

/// The f64 nearest to a rational (rug's own `to_f64` truncates).
#[must_use]
pub fn nearest_f64(q: &Rational) -> f64 {
    Float::with_val(53, q).to_f64()
}

impl Number {
    /// A number given exactly.
    #[must_use]
    pub fn exact(rational: Rational) -> Self {
        let float = nearest_f64(&rational);
        Self { rational, exact: true, float }
    }

    /// The exact value, or the rational taken in its place.
    #[must_use]
    pub fn rational(&self) -> &Rational {
        &self.rational
    }

    /// Whether `rational` is the value itself and not an approximation.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact
    }

    /// The value, correctly rounded.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.float
    }
}

impl Angle {
    /// The angle, correctly rounded, as given (not reduced modulo 2 pi). Radians.
    #[must_use]
    pub fn radians(&self) -> f64 {
        self.radians
    }

    /// Cosine and sine, correctly rounded (a right angle has cosine exactly 0).
    #[must_use]
    pub fn cos_sin_f64(&self) -> (f64, f64) {
        self.cos_sin
    }

    /// The exact half-angle tangent, or the rational one taken in its place.
    #[must_use]
    pub fn half_tangent(&self) -> &HalfTangent {
        &self.half_tangent
    }

    /// Whether the half-angle tangent is the angle's own and not an approximation.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact
    }
}
