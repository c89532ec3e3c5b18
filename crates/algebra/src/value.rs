//! Values of expressions: always an enclosure, and exact forms if they are known.

use super::enclosure::Enclosure;
use super::half_tangent::{Direction, HalfTangent, square_root};
use super::ring::Ring;
use super::surd::{Closed, Phase, Surd, phase_of_sum, phase_of_turn};
use rug::{Float, Integer, Rational, float::Constant, ops::Pow};

/// Precision in bits of the approximation of an irrational value beside its enclosure: far more than any result keeps.
pub(super) const BITS: u32 = 256;
/// Numerators and denominators beyond this many bits are refused.
const LONGEST: u32 = 20_000;
/// Largest multiple of an angle followed in closed form if its cosine is irrational.
const SMALL: i32 = 8;
/// Largest multiple of an angle followed exactly.
const MULTIPLE: i32 = 256;

/// A real number with its exact forms, as far as they are known.
#[derive(Clone, Debug)]
pub(super) struct Value {
    pub(super) real: Enclosure,
    /// The value itself.
    pub(super) rational: Option<Rational>,
    /// The value as a multiple of pi.
    turns: Option<Rational>,
    /// The direction of the value as an angle.
    direction: Option<Direction>,
    /// The value in closed form, if it is irrational.
    closed: Option<Closed>,
    /// Cosine and sine of the value as an angle in closed form, if neither turns nor direction determine them.
    phase: Option<Phase>,
    /// Whether the value came from pi or an inverse function: an angle in radians.
    pub(super) radians: bool,
}

impl Value {
    pub(super) fn from_rational(rational: Rational) -> Self {
        if rational.is_zero() {
            return Self::from_turns(rational, false);
        }
        let real = Enclosure::of(&rational);
        Self { rational: Some(rational), ..Self::inexact(real, false) }
    }

    /// Returns `turns * pi`.
    pub(super) fn from_turns(turns: Rational, radians: bool) -> Self {
        let rational = turns.is_zero().then(Rational::new);
        let real = Enclosure::pi().scaled(&turns);
        Self { rational, direction: Direction::of_turns(&turns), turns: Some(turns), ..Self::inexact(real, radians) }
    }

    fn inexact(real: Enclosure, radians: bool) -> Self {
        Self { real, rational: None, turns: None, direction: None, closed: None, phase: None, radians }
    }

    /// Returns the value, to far more digits than any result keeps.
    pub(super) fn float(&self) -> Float {
        Float::with_val(BITS, self.real.middle())
    }

    /// Returns the value in closed form, if it is known.
    pub(super) fn closed(&self) -> Option<Closed> {
        self.rational.clone().map(Closed::rational).or_else(|| self.closed.clone())
    }

    /// Returns cosine and sine of the value taken as an angle, in closed form if they are known.
    pub(super) fn phase(&self) -> Option<Phase> {
        if let Some(turns) = &self.turns {
            return Some(phase_of_turn(&Rational::from(turns / 2)));
        }
        if let Some((x, y)) = self.direction.as_ref().map(Direction::coordinates) {
            let square = Rational::from(x.square_ref()) + Rational::from(y.square_ref());
            let length = Closed::from(Surd::square_root(&square)?);
            return Some((Closed::rational(x.clone()).div(&length)?, Closed::rational(y.clone()).div(&length)?));
        }
        self.phase.clone()
    }

    fn in_closed_form(self, closed: Option<Closed>) -> Self {
        Self { closed, ..self }
    }

    /// Returns the phase of a small whole multiple.
    fn multiple(&self, factor: &Rational) -> Option<Phase> {
        let count = Some(factor).filter(|factor| factor.is_integer())?.numer().to_i32().filter(|n| n.abs() <= SMALL)?;
        let (cos, sin) = self.phase()?;
        let one = if count < 0 { (cos, sin.neg()) } else { (cos, sin) };
        (0..count.abs()).try_fold(phase_of_turn(&Rational::new()), |sum, _| phase_of_sum(&sum, &one))
    }

    /// Returns the exact half-angle tangent of the value taken as an angle, if it is rational.
    pub(super) fn half_tangent(&self) -> Option<HalfTangent> {
        self.direction.as_ref()?.half_tangent()
    }

    /// Returns the value, if it is neither infinite, undefined nor overlong.
    pub(super) fn checked(self) -> Result<Self, String> {
        let long = |q: &Rational| q.numer().significant_bits().max(q.denom().significant_bits()) > LONGEST;
        if self.rational.as_ref().is_some_and(long) || self.turns.as_ref().is_some_and(long) {
            return Err("a number with too many digits".to_owned());
        }
        if !self.real.middle().is_finite() || self.real.size() > 4000 {
            return Err("a value that is not finite or absurdly large".to_owned());
        }
        Ok(self)
    }

    pub(super) fn add(&self, other: &Self) -> Self {
        let radians = self.radians || other.radians;
        if let (Some(x), Some(y)) = (&self.rational, &other.rational) {
            return Self { radians, ..Self::from_rational(Rational::from(x + y)) };
        }
        if let (Some(x), Some(y)) = (&self.turns, &other.turns) {
            return Self::from_turns(Rational::from(x + y), radians);
        }
        // A sum that cannot be distinguished from 0 is 0.
        let real = self.real.add(&other.real).settled();
        let direction = self.direction.as_ref().zip(other.direction.as_ref()).and_then(|(x, y)| x.plus(y));
        let closed = self.closed().zip(other.closed()).and_then(|(x, y)| x.add(&y));
        let phase = self.phase().zip(other.phase()).and_then(|(x, y)| phase_of_sum(&x, &y));
        Self { direction, closed, phase, ..Self::inexact(real, radians) }
    }

    pub(super) fn neg(&self) -> Self {
        let flip = |q: &Rational| Rational::from(-q);
        Self {
            real: self.real.neg(),
            rational: self.rational.as_ref().map(flip),
            turns: self.turns.as_ref().map(flip),
            direction: self.direction.as_ref().map(Direction::opposite),
            closed: self.closed.as_ref().map(Closed::neg),
            phase: self.phase.as_ref().map(|(cos, sin)| (cos.clone(), sin.neg())),
            radians: self.radians,
        }
    }

    pub(super) fn mul(&self, other: &Self) -> Self {
        let radians = self.radians || other.radians;
        match (&self.rational, &other.rational) {
            (Some(x), Some(y)) => Self { radians, ..Self::from_rational(Rational::from(x * y)) },
            (Some(factor), None) => other.scaled(factor),
            (None, Some(factor)) => self.scaled(factor),
            (None, None) => {
                let product = Self::inexact(self.real.mul(&other.real), radians);
                product.in_closed_form(self.closed().zip(other.closed()).and_then(|(x, y)| x.mul(&y)))
            }
        }
    }

    fn scaled(&self, factor: &Rational) -> Self {
        if let Some(turns) = &self.turns {
            return Self::from_turns(Rational::from(turns * factor), self.radians);
        }
        let real = self.real.scaled(factor);
        let half_turn = Float::with_val(BITS, Constant::Pi);
        let direction = self.direction.as_ref().and_then(|direction| {
            let numerator = factor.numer().to_i32().filter(|n| n.abs() <= MULTIPLE)?;
            let multiple = direction.times(numerator)?;
            match factor.denom().to_u32()? {
                1 => Some(multiple),
                // Halving the multiple is right only if the value is in (-pi, pi].
                2 if Float::with_val(BITS, real.middle() * 2).abs() <= half_turn => multiple.halved(),
                _ => None,
            }
        });
        let closed = self.closed().and_then(|closed| closed.mul(&Closed::rational(factor.clone())));
        Self { direction, closed, phase: self.multiple(factor), ..Self::inexact(real, self.radians) }
    }

    pub(super) fn div(&self, other: &Self) -> Result<Self, String> {
        let by_zero = || "a division by zero".to_owned();
        if other.real.holds_zero() {
            return Err(by_zero());
        }
        if let Some(divisor) = &other.rational {
            return Ok(self.mul(&Self::from_rational(divisor.clone().recip())));
        }
        if let (Some(x), Some(y)) = (&self.turns, &other.turns) {
            return Ok(Self::from_rational(Rational::from(x / y)));
        }
        let ratio = self.real.over(&other.real).ok_or_else(by_zero)?;
        let quotient = Self::inexact(ratio, self.radians || other.radians);
        Ok(quotient.in_closed_form(self.closed().zip(other.closed()).and_then(|(x, y)| x.div(&y))))
    }

    pub(super) fn sqrt(&self) -> Result<Self, String> {
        let negative = || format!("the square root of {}, a negative number", self.real.middle().to_f64());
        if let Some(root) = self.rational.as_ref().and_then(square_root) {
            return Ok(Self::from_rational(root));
        }
        let closed = self.rational.as_ref().and_then(Surd::square_root).map(Closed::from);
        Ok(Self::inexact(self.real.sqrt().ok_or_else(negative)?, false).in_closed_form(closed))
    }

    /// Returns cosine and sine, exact if rational.
    fn cos_sin(&self) -> (Self, Self) {
        if let Some((cos, sin)) = self.direction.as_ref().and_then(Direction::cos_sin) {
            return (Self::from_rational(cos), Self::from_rational(sin));
        }
        let cosine_of_turns = |turns: Rational| {
            // Niven: beside right angles only multiples of pi/3 have a rational cosine, here 1/2 or -1/2.
            let thirds: Rational = turns * 3;
            thirds.is_integer().then(|| match thirds.numer().mod_u(6) {
                1 | 5 => Rational::from((1, 2)),
                2 | 4 => Rational::from((-1, 2)),
                0 => Rational::from(1),
                _ => Rational::from(-1),
            })
        };
        let exact = |turns: Option<Rational>| turns.and_then(cosine_of_turns).map(Self::from_rational);
        let complement = self.turns.as_ref().map(|turns| Rational::from((1, 2)) - turns);
        let (cos, sin) = self.real.cos_sin_of();
        let (closed_cos, closed_sin) = self.phase().unzip();
        let either = |known: Option<Self>, real, closed| {
            known.unwrap_or_else(|| Self::inexact(real, false).in_closed_form(closed))
        };
        (either(exact(self.turns.clone()), cos, closed_cos), either(exact(complement), sin, closed_sin))
    }

    pub(super) fn cos(&self) -> Self {
        self.cos_sin().0
    }

    pub(super) fn sin(&self) -> Self {
        self.cos_sin().1
    }

    pub(super) fn tan(&self) -> Result<Self, String> {
        if let Some(tangent) = self.direction.as_ref().and_then(Direction::tangent) {
            return Ok(Self::from_rational(tangent));
        }
        let (cos, sin) = self.cos_sin();
        sin.div(&cos).map_err(|_| "the tangent of a right angle".to_owned())
    }

    pub(super) fn acos(&self) -> Result<Self, String> {
        self.within_one("acos")?;
        if let Some(cosine) = &self.rational {
            for (numerator, turns) in [(2, (0, 1)), (1, (1, 3)), (0, (1, 2)), (-1, (2, 3)), (-2, (1, 1))] {
                if *cosine == Rational::from((numerator, 2)) {
                    return Ok(Self::from_turns(Rational::from(turns), true));
                }
            }
        }
        let direction = self.rational.as_ref().and_then(|x| Direction::new(x.clone(), complement(x)?));
        let angle = self.real.acos().ok_or_else(|| self.outside("acos"))?;
        let other = |x: &Rational| Surd::square_root(&(1 - Rational::from(x.square_ref()))).map(Closed::from);
        let phase = self.rational.as_ref().and_then(|x| Some((Closed::rational(x.clone()), other(x)?)));
        Ok(Self { direction, phase, ..Self::inexact(angle, true) })
    }

    pub(super) fn asin(&self) -> Result<Self, String> {
        self.within_one("asin")?;
        if let Some(sine) = &self.rational {
            for (numerator, turns) in [(2, (1, 2)), (1, (1, 6)), (0, (0, 1)), (-1, (-1, 6)), (-2, (-1, 2))] {
                if *sine == Rational::from((numerator, 2)) {
                    return Ok(Self::from_turns(Rational::from(turns), true));
                }
            }
        }
        let direction = self.rational.as_ref().and_then(|y| Direction::new(complement(y)?, y.clone()));
        let angle = self.real.asin().ok_or_else(|| self.outside("asin"))?;
        let other = |y: &Rational| Surd::square_root(&(1 - Rational::from(y.square_ref()))).map(Closed::from);
        let phase = self.rational.as_ref().and_then(|y| Some((other(y)?, Closed::rational(y.clone()))));
        Ok(Self { direction, phase, ..Self::inexact(angle, true) })
    }

    /// Returns the angle of the direction (x, y); `atan(y)` is `atan2(y, 1)`.
    pub(super) fn atan2(&self, x: &Self) -> Result<Self, String> {
        let real = self.real.atan2(&x.real).ok_or_else(|| "atan2(0, 0)".to_owned())?;
        let direction = self.rational.clone().zip(x.rational.clone()).and_then(|(y, x)| Direction::new(x, y));
        if let (Some(y), Some(x)) = (&self.rational, &x.rational) {
            let steep = y.clone().abs() == x.clone().abs();
            if steep || y.is_zero() || x.is_zero() {
                let quarters = Float::with_val(BITS, real.middle() * 4) / Float::with_val(BITS, Constant::Pi);
                if let Some(quarters) = quarters.round().to_i32_saturating() {
                    return Ok(Self::from_turns(Rational::from((quarters, 4)), true));
                }
            }
        }
        Ok(Self { direction, ..Self::inexact(real, true) })
    }

    fn within_one(&self, function: &str) -> Result<(), String> {
        let is_within = *self.real.middle() <= 1 && *self.real.middle() >= -1;
        is_within.then_some(()).ok_or_else(|| self.outside(function))
    }

    fn outside(&self, function: &str) -> String {
        format!("{function} of {}, outside [-1, 1]", self.real.middle().to_f64())
    }
}

/// Returns `sqrt(1 - x^2)`, if it is rational.
fn complement(x: &Rational) -> Option<Rational> {
    square_root(&(1 - Rational::from(x.square_ref())))
}

/// Returns the decimal `digits * 10^exponent`.
pub(super) fn decimal(digits: Integer, exponent: i32) -> Rational {
    let power = Integer::from(10).pow(exponent.unsigned_abs());
    if exponent < 0 { Rational::from((digits, power)) } else { Rational::from(digits * power) }
}
