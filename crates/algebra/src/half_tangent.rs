//! Exact angles: a direction of the rational plane, and the half-angle tangent if it is rational.

use rug::{Integer, Rational};

/// Directions with longer coordinates are given up: the angle is then known only approximately.
const LONGEST: u32 = 4096;

/// The tangent of half an angle, infinite at pi.
#[derive(Clone, Debug, PartialEq)]
pub enum HalfTangent {
    /// An angle other than pi.
    Finite(Rational),
    /// The angle pi.
    Infinite,
}

/// The direction (x, y) of an angle, as a nonzero Gaussian number of any length.
#[derive(Clone, Debug)]
pub(super) struct Direction {
    x: Rational,
    y: Rational,
}

impl Direction {
    /// Returns the direction of a nonzero vector; `None` for the zero vector or overlong coordinates.
    pub(super) fn new(x: Rational, y: Rational) -> Option<Self> {
        if x.is_zero() && y.is_zero() {
            return None;
        }
        // Only the ratio counts: primitive integers keep products short.
        let scale = x.denom().clone().lcm(y.denom());
        let (x, y) = (x * &scale, y * &scale);
        let divisor = x.numer().clone().gcd(y.numer());
        let (x, y) = (x / &divisor, y / &divisor);
        let short = x.numer().significant_bits().max(y.numer().significant_bits()) <= LONGEST;
        short.then_some(Self { x, y })
    }

    /// Returns the coordinates of a vector in this direction.
    pub(super) fn coordinates(&self) -> (&Rational, &Rational) {
        (&self.x, &self.y)
    }

    /// Returns the direction of `turns * pi`, rational for multiples of a quarter of pi.
    pub(super) fn of_turns(turns: &Rational) -> Option<Self> {
        let quarters = Rational::from(turns * 4);
        if !quarters.is_integer() {
            return None;
        }
        let (x, y) = match quarters.numer().mod_u(8) {
            0 => (1, 0),
            1 => (1, 1),
            2 => (0, 1),
            3 => (-1, 1),
            4 => (-1, 0),
            5 => (-1, -1),
            6 => (0, -1),
            _ => (1, -1),
        };
        Self::new(Rational::from(x), Rational::from(y))
    }

    /// Returns the direction of the sum of two angles.
    pub(super) fn plus(&self, other: &Self) -> Option<Self> {
        Self::new(
            Rational::from(&self.x * &other.x) - Rational::from(&self.y * &other.y),
            Rational::from(&self.x * &other.y) + Rational::from(&self.y * &other.x),
        )
    }

    /// Returns the direction of the opposite angle.
    pub(super) fn opposite(&self) -> Self {
        Self { x: self.x.clone(), y: Rational::from(-&self.y) }
    }

    /// Returns the direction of `n` times the angle.
    pub(super) fn times(&self, n: i32) -> Option<Self> {
        let base = if n < 0 { self.opposite() } else { self.clone() };
        let mut result = Self { x: Rational::from(1), y: Rational::new() };
        for bit in (0..32).rev() {
            result = result.plus(&result)?;
            if n.unsigned_abs() >> bit & 1 == 1 {
                result = result.plus(&base)?;
            }
        }
        Some(result)
    }

    /// Returns the direction of half the angle taken in (-pi, pi], if it is rational.
    pub(super) fn halved(&self) -> Option<Self> {
        let length = self.length()?;
        let x = Rational::from(&length + &self.x);
        if x.is_zero() { Self::new(x, Rational::from(1)) } else { Self::new(x, self.y.clone()) }
    }

    /// Returns cosine and sine, if they are rational.
    pub(super) fn cos_sin(&self) -> Option<(Rational, Rational)> {
        let length = self.length()?;
        Some((Rational::from(&self.x / &length), Rational::from(&self.y / &length)))
    }

    /// Returns the tangent; `None` at a right angle.
    pub(super) fn tangent(&self) -> Option<Rational> {
        (!self.x.is_zero()).then(|| Rational::from(&self.y / &self.x))
    }

    /// Returns the tangent of half the angle, if it is rational.
    pub(super) fn half_tangent(&self) -> Option<HalfTangent> {
        let denominator = self.length()? + &self.x;
        if denominator.is_zero() {
            return Some(HalfTangent::Infinite);
        }
        Some(HalfTangent::Finite(Rational::from(&self.y / &denominator)))
    }

    fn length(&self) -> Option<Rational> {
        square_root(&(Rational::from(self.x.square_ref()) + Rational::from(self.y.square_ref())))
    }
}

/// Returns the square root of a rational that is the square of one.
pub(super) fn square_root(square: &Rational) -> Option<Rational> {
    let root = |n: &Integer| n.is_perfect_square().then(|| n.clone().sqrt());
    Some(Rational::from((root(square.numer())?, root(square.denom())?)))
}
