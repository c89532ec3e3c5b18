//! Numbers and angles of a mechanism file: exact if possible, otherwise correctly rounded.

use super::approximation::simplest_within;
use super::enclosure::Enclosure;
use super::expression::{Quantified, Unit, evaluate, plain, shortened};
use super::ring::Ring;
use super::surd::{Closed, Phase};
use super::value::{BITS, Value};
use crate::error::{Error, Result};
use rug::{Float, Integer, Rational, ops::Pow};
use std::sync::Arc;

pub use super::half_tangent::HalfTangent;

/// Sizes beyond this, and nonzero ones below its inverse, are taken for mistakes: their squares leave the range of f64.
const LARGEST: f64 = 1e150;
/// A decimal of a size from this to its inverse is within the bounds by far.
const COMMON: f64 = 1e-100;
/// Decimal digits to which irrational values are replaced by rationals for exact work, by default.
pub const DIGITS: u32 = 15;
/// Maximum number of digits that can be requested; the working precision has 77.
pub const MOST_DIGITS: u32 = 60;

/// The quantity that a number of a file measures, which determines the admissible units.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// A length: m, cm, mm.
    Length,
    /// A bare number: no unit.
    Ratio,
}

/// The interpretation of numbers in a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Reading {
    /// Metres per unit of a length given without one.
    pub length: Rational,
    /// Whether angles given without a unit are degrees.
    pub degrees: bool,
    /// Decimal digits to which irrational values are replaced by rationals for exact work.
    pub digits: u32,
}

impl Default for Reading {
    /// Metres, radians, 15 digits.
    fn default() -> Self {
        Self { length: Rational::from(1), degrees: false, digits: DIGITS }
    }
}

impl Reading {
    /// Returns the names of the units of lengths and of angles that are given without one.
    #[must_use]
    pub fn units(&self) -> [&'static str; 2] {
        let length = match self.length.denom().to_u32() {
            Some(100) => "centimetres",
            Some(1000) => "millimetres",
            _ => "metres",
        };
        [length, if self.degrees { "degrees" } else { "radians" }]
    }
}

/// A real number of a file: its exact rational value, or a rational within 1e-17 (relative) of an irrational one and an
/// enclosure of that.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    rational: Rational,
    exact: bool,
    float: f64,
    enclosed: Option<Box<Enclosure>>,
    /// The number itself in closed form, if it is irrational and a closed form is known.
    closed: Option<Arc<Closed>>,
    written: Written,
}

/// The expression that an irrational number was read from, times a factor. Numbers are compared by value: any two are equal.
#[derive(Clone, Debug, Default)]
struct Written(Option<Arc<(String, Rational)>>);

impl PartialEq for Written {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Written {
    fn new(expression: &str, factor: Rational) -> Self {
        Self(Some(Arc::new((expression.trim().to_owned(), factor))))
    }

    fn text(&self) -> Option<String> {
        let (expression, factor) = self.0.as_deref()?;
        Some(if *factor == 1 { expression.clone() } else { format!("({expression})*{factor}") })
    }

    fn times(&self, factor: &Rational) -> Self {
        Self(self.0.as_deref().map(|(text, own)| Arc::new((text.clone(), Rational::from(own * factor)))))
    }

    fn squared(&self) -> Self {
        let square =
            |(text, own): &(String, Rational)| (format!("({text})*({text})"), Rational::from(own.square_ref()));
        Self(self.0.as_deref().map(|parts| Arc::new(square(parts))))
    }
}

/// Returns an expression without the unit behind it.
fn without_unit(text: &str) -> &str {
    let text = text.trim();
    let cut = ["mm", "cm", "m"].iter().find_map(|unit| text.strip_suffix(unit));
    cut.unwrap_or(text).trim_end()
}

/// An angle of a file in two forms: correctly rounded in f64, and as an exact rational half-angle tangent, with enclosures
/// of cosine and sine if that is not the angle's own.
#[derive(Clone, Debug, PartialEq)]
pub struct Angle {
    radians: f64,
    cos_sin: (f64, f64),
    half_tangent: HalfTangent,
    exact: bool,
    enclosed: Option<Box<(Enclosure, Enclosure)>>,
    /// Cosine and sine themselves, if the half-angle tangent is irrational and closed forms are known.
    phase: Option<Arc<Phase>>,
    written: Written,
}

/// Returns the f64 nearest to a rational (rug's own `to_f64` truncates).
#[must_use]
pub fn nearest_f64(q: &Rational) -> f64 {
    // Numbers that an f64 holds are divided by its own division, which rounds to the nearest.
    let short = |n: &Integer| n.to_i64().filter(|n| n.unsigned_abs() <= 1 << f64::MANTISSA_DIGITS);
    if let (Some(numerator), Some(denominator)) = (short(q.numer()), short(q.denom())) {
        return numerator as f64 / denominator as f64;
    }
    Float::with_val(53, q).to_f64()
}

impl Number {
    /// Returns a number given exactly.
    #[must_use]
    pub fn exact(rational: Rational) -> Self {
        let float = nearest_f64(&rational);
        Self { rational, exact: true, float, enclosed: None, closed: None, written: Written::default() }
    }

    /// Returns a rational that represents a nearby real number of which no more is known.
    #[must_use]
    pub fn rounded(rational: Rational) -> Self {
        Self { exact: false, ..Self::exact(rational) }
    }

    /// Returns a rational that represents a nearby real number.
    #[must_use]
    pub fn standing_for(rational: Rational, real: Enclosure) -> Self {
        let float = if real.holds_zero() { 0.0 } else { real.middle().to_f64() };
        Self {
            rational,
            exact: false,
            float,
            enclosed: Some(Box::new(real)),
            closed: None,
            written: Written::default(),
        }
    }

    /// Returns a number in closed form, with a rational near it and an enclosure.
    #[must_use]
    pub fn in_closed_form(rational: Rational, real: Enclosure, closed: Closed) -> Self {
        match closed.as_rational() {
            Some(own) => Self::exact(own),
            None => Self { closed: Some(Arc::new(closed)), ..Self::standing_for(rational, real) },
        }
    }

    /// Returns the simplest rational within `10^-digits` (relative) of a float.
    ///
    /// # Panics
    /// When `float` is not finite.
    #[must_use]
    pub fn near(float: &Float, digits: u32) -> Rational {
        simplest_within(float, &(relative(digits) * float.clone().abs()))
    }

    /// Returns the square, as exact as the number is; that of a square root is the rational number under it.
    #[must_use]
    pub fn squared(&self) -> Self {
        let square = Rational::from(self.rational.square_ref());
        match self.enclosed() {
            Some(real) => {
                let closed = self.closed.as_ref().and_then(|closed| closed.mul(closed));
                if let Some(whole) = closed.as_ref().and_then(Closed::as_rational) {
                    return Self::exact(whole);
                }
                let closed = closed.map(Arc::new);
                Self { closed, written: self.written.squared(), ..Self::standing_for(square, real.mul(real)) }
            }
            None if self.exact => Self::exact(square),
            None => Self::rounded(square),
        }
    }

    /// Returns the number times a rational one, as exact as it is.
    #[must_use]
    pub fn scaled(&self, factor: &Rational) -> Self {
        let product = Rational::from(&self.rational * factor);
        match self.enclosed() {
            Some(real) => {
                let closed =
                    self.closed.as_ref().and_then(|own| own.mul(&Closed::rational(factor.clone()))).map(Arc::new);
                let written = self.written.times(factor);
                Self { closed, written, ..Self::standing_for(product, real.scaled(factor)) }
            }
            None if self.exact => Self::exact(product),
            None => Self::rounded(product),
        }
    }

    /// Returns the number as an expression that reads as exactly this number, lengths in metres; `None` if none is known.
    #[must_use]
    pub fn text(&self) -> Option<String> {
        if self.exact { Some(rational_text(&self.rational)) } else { self.written.text() }
    }

    /// Returns the number 0.
    #[must_use]
    pub fn zero() -> Self {
        Self::exact(Rational::new())
    }

    /// Takes a float as the exact binary fraction it is.
    ///
    /// # Panics
    /// When `float` is NaN or infinite.
    #[must_use]
    pub fn from_f64(float: f64) -> Self {
        let rational = Rational::from_f64(float).expect("a finite number was promised");
        Self { rational, exact: true, float, enclosed: None, closed: None, written: Written::default() }
    }

    /// Reads the text of a number: an integer, a decimal or an expression, with or without a unit.
    ///
    /// # Units
    /// Lengths are returned in metres.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the text is no number, has a wrong unit, or exceeds 1e150; it states what was found.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::number::{Number, Quantity, Reading};
    /// let length = Number::parse("150 mm", Quantity::Length, &Reading::default())?;
    /// assert_eq!(*length.rational(), rug::Rational::from((3, 20)));
    /// # Ok::<(), looproot_algebra::error::Error>(())
    /// ```
    pub fn parse(text: &str, quantity: Quantity, reading: &Reading) -> Result<Self> {
        let expected = match quantity {
            Quantity::Length => "a length",
            Quantity::Ratio => "a number without unit",
        };
        let scale = |unit: Option<Unit>| match (quantity, unit) {
            (Quantity::Length, None) => Ok(reading.length.clone()),
            (Quantity::Length, Some(Unit::Metre)) | (Quantity::Ratio, None) => Ok(Rational::from(1)),
            (Quantity::Length, Some(Unit::Centimetre)) => Ok(Rational::from((1, 100))),
            (Quantity::Length, Some(Unit::Millimetre)) => Ok(Rational::from((1, 1000))),
            _ => Err(Error::Invalid(format!("found `{}`, expected {expected}", shortened(text)))),
        };
        if let Some((rational, unit)) = plain(text) {
            let number = Self::exact(rational * scale(unit)?);
            // Sizes near the bounds are compared in more digits.
            if number.rational.is_zero() || (COMMON..1.0 / COMMON).contains(&number.float.abs()) {
                return Ok(number);
            }
        }
        let Quantified { value, unit } = read(text, expected)?;
        let scale = scale(unit)?;
        let value = value.mul(&Value::from_rational(scale.clone()));
        check_size(&value.float(), text)?;
        let closed = value.closed().map(Arc::new);
        Ok(if let Some(rational) = value.rational {
            Self::exact(rational)
        } else {
            let near = Self::near(&value.float(), 17.max(reading.digits + 2));
            let written = Written::new(without_unit(text), scale);
            Self { closed, written, ..Self::standing_for(near, value.real) }
        })
    }

    /// Returns the exact value, or the rational taken in its place.
    #[must_use]
    pub fn rational(&self) -> &Rational {
        &self.rational
    }

    /// Returns the number itself as a rational or in closed form, by cosines of parts of a turn and square roots; `None` if
    /// only an approximation is known.
    #[must_use]
    pub fn closed(&self) -> Option<Closed> {
        if self.exact { Some(Closed::rational(self.rational.clone())) } else { self.closed.as_deref().cloned() }
    }

    /// Returns whether `rational` is the value itself and not an approximation.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact
    }

    /// Returns the value, correctly rounded.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        self.float
    }

    /// Returns an enclosure of the value, if the rational is not the value itself.
    #[must_use]
    pub fn enclosed(&self) -> Option<&Enclosure> {
        self.enclosed.as_deref()
    }
}

/// The text of an angle, read.
struct Radians {
    /// The angle in radians.
    value: Value,
    /// Whether it was written in degrees, without the unit.
    is_plain_degrees: bool,
}

impl Radians {
    fn read(text: &str, reading: &Reading) -> Result<Self> {
        let Quantified { value, unit } = read(text, "an angle")?;
        let found = || shortened(text);
        let degrees = match unit {
            None if reading.degrees && value.radians => {
                return Err(Error::Invalid(format!(
                    "found `{0}` where plain angles are degrees, expected its unit: `{0} rad` or `{0} deg`",
                    found()
                )));
            }
            None => reading.degrees,
            Some(Unit::Degree) => true,
            Some(Unit::Radian) => false,
            Some(_) => return Err(Error::Invalid(format!("found `{}`, expected an angle", found()))),
        };
        let value = if degrees { value.mul(&Value::from_turns(Rational::from((1, 180)), true)) } else { value };
        check_size(&value.float(), text)?;
        Ok(Self { value, is_plain_degrees: unit.is_none() && degrees })
    }
}

impl Angle {
    /// Returns the angle 0.
    #[must_use]
    pub fn zero() -> Self {
        Self::from_half_tangent(HalfTangent::Finite(Rational::new()))
    }

    /// Returns the angle in (-pi, pi] with this half-angle tangent.
    #[must_use]
    pub fn from_half_tangent(half_tangent: HalfTangent) -> Self {
        let (radians, cos_sin) = match &half_tangent {
            HalfTangent::Infinite => (std::f64::consts::PI, (-1.0, 0.0)),
            HalfTangent::Finite(t) => {
                let square = Rational::from(t.square_ref());
                let length = Rational::from(&square + 1);
                let cos = nearest_f64(&((1 - square) / &length));
                let sin = nearest_f64(&(Rational::from(t * 2) / length));
                ((Float::with_val(BITS, t).atan() * 2_u32).to_f64(), (cos, sin))
            }
        };
        Self { radians, cos_sin, half_tangent, exact: true, enclosed: None, phase: None, written: Written::default() }
    }

    /// Returns the angle of a float in radians, its half-angle tangent rounded to 15 digits.
    ///
    /// # Panics
    /// When `radians` is NaN or infinite.
    #[must_use]
    pub fn from_radians(radians: f64) -> Self {
        assert!(radians.is_finite(), "a finite angle was promised, got {radians}");
        Self::rounded(&Enclosure::of_float(&Float::with_val(53, radians)), DIGITS)
    }

    /// Reads the text of an angle: an expression, with or without a unit.
    ///
    /// # Units
    /// Without a unit radians, or degrees if `reading` says so; `pi` and inverse functions are in radians already
    /// and then need their unit written.
    ///
    /// # Errors
    /// [`Error::Invalid`], stating what was found instead of an angle.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::number::{Angle, HalfTangent, Reading};
    /// let angle = Angle::parse("-acos(3/5)", &Reading::default())?;
    /// assert_eq!(*angle.half_tangent(), HalfTangent::Finite((-1, 2).into()));
    /// # Ok::<(), looproot_algebra::error::Error>(())
    /// ```
    pub fn parse(text: &str, reading: &Reading) -> Result<Self> {
        let Radians { value, is_plain_degrees } = Radians::read(text, reading)?;
        if let Some(half_tangent) = value.half_tangent() {
            return Ok(Self { radians: value.float().to_f64(), ..Self::from_half_tangent(half_tangent) });
        }
        let own = text.trim();
        let own = if is_plain_degrees { format!("({own}) deg") } else { own.to_owned() };
        let written = Written::new(&own, Rational::from(1));
        Ok(Self { phase: value.phase().map(Arc::new), written, ..Self::rounded(&value.real, reading.digits) })
    }

    /// Reads the text of an angle as [`Angle::parse`] does, and returns no more than its radians: for limits and for values
    /// that are compared, whose cosine and sine nobody asks for.
    ///
    /// # Errors
    /// [`Error::Invalid`] saying what was found instead of an angle.
    pub fn parse_radians(text: &str, reading: &Reading) -> Result<f64> {
        Ok(Radians::read(text, reading)?.value.float().to_f64())
    }

    /// Reads the half-angle tangent of an angle: a rational number or `inf`.
    ///
    /// # Errors
    /// [`Error::Invalid`], stating what was found instead.
    pub fn parse_half_tangent(text: &str, reading: &Reading) -> Result<Self> {
        if text.trim() == "inf" {
            return Ok(Self::from_half_tangent(HalfTangent::Infinite));
        }
        let number = Number::parse(text, Quantity::Ratio, reading)?;
        let enclosed = match number.enclosed() {
            None => None,
            Some(t) => Some(Box::new(from_tangent(t).ok_or_else(|| {
                Error::Invalid(format!("found `{}`, expected a number that is known better", shortened(text)))
            })?)),
        };
        let exact = number.exact;
        let phase = number.closed.as_ref().and_then(|t| {
            let (one, square) = (Closed::rational(Rational::from(1)), t.mul(t)?);
            let length = one.add(&square)?;
            Some(Arc::new((one.add(&square.neg())?.div(&length)?, t.add(t)?.div(&length)?)))
        });
        Ok(Self { exact, enclosed, phase, ..Self::from_half_tangent(HalfTangent::Finite(number.rational)) })
    }

    /// Returns an angle without a known rational half-angle tangent.
    fn rounded(enclosed: &Enclosure, digits: u32) -> Self {
        let radians = &Float::with_val(BITS, enclosed.middle());
        let tolerance = relative(digits + 1);
        let enclosed = enclosed.cos_sin_of();
        let (cos, sin) = (enclosed.0.middle(), enclosed.1.middle());
        // Of both quotients that are tan(x/2) the one without a small difference.
        let tangent = if cos.is_sign_negative() {
            Float::with_val(BITS, 1 - cos) / sin
        } else {
            Float::with_val(BITS, sin / Float::with_val(BITS, 1 + cos))
        };
        // An error of d in the half-angle tangent t changes the angle by 2 d / (1 + t^2). Small angles are rounded relative to
        // themselves: a twist of 1e-17 is not 0.
        let distance_from_pi = Float::with_val(BITS, 2 / &tangent).abs();
        let half_tangent = if tangent.is_infinite() || distance_from_pi < tolerance {
            HalfTangent::Infinite
        } else {
            let allowed = (Float::with_val(BITS, tangent.square_ref()) + 1_u32) / 2_u32;
            let allowed = if tangent.clone().abs() < 1 { tangent.clone().abs() } else { allowed };
            HalfTangent::Finite(simplest_within(&tangent, &(allowed * tolerance)))
        };
        let cos_sin = (cos.to_f64(), sin.to_f64());
        Self {
            radians: radians.to_f64(),
            cos_sin,
            half_tangent,
            exact: false,
            enclosed: Some(Box::new(enclosed)),
            phase: None,
            written: Written::default(),
        }
    }

    /// Returns half a turn less this angle.
    ///
    /// # Example
    /// ```
    /// use looproot_algebra::number::{Angle, HalfTangent, Reading};
    /// let angle = Angle::parse("acos(-3/5)", &Reading::default())?.supplement();
    /// assert_eq!(*angle.half_tangent(), HalfTangent::Finite((1, 2).into()));
    /// let angle = Angle::parse("99 deg", &Reading::default())?.supplement();
    /// assert_eq!(angle.text().as_deref(), Some("(180 - (99)) deg"));
    /// assert!(Angle::parse("(180 - (99)) deg", &Reading::default()).is_ok());
    /// # Ok::<(), looproot_algebra::error::Error>(())
    /// ```
    #[must_use]
    pub fn supplement(&self) -> Self {
        let half_tangent = match &self.half_tangent {
            HalfTangent::Infinite => HalfTangent::Finite(Rational::new()),
            HalfTangent::Finite(t) if t.is_zero() => HalfTangent::Infinite,
            HalfTangent::Finite(t) => HalfTangent::Finite(Rational::from(t.recip_ref())),
        };
        let opposite = |cosine: &Enclosure| cosine.scaled(&Rational::from(-1));
        let enclosed = self.enclosed.as_ref().map(|of| Box::new((opposite(&of.0), of.1.clone())));
        let phase = self.phase.as_ref().map(|of| Arc::new((of.0.neg(), of.1.clone())));
        // A unit stands behind a whole sum.
        let of_text = |text: &str| match text.strip_suffix("deg") {
            Some(degrees) => format!("(180 - ({})) deg", degrees.trim_end()),
            None => format!("pi - ({})", text.strip_suffix("rad").unwrap_or(text).trim_end()),
        };
        let written = self.written.text().map(|text| Written::new(&of_text(&text), Rational::from(1)));
        let written = written.unwrap_or_default();
        let (exact, turned) = (self.exact, Self::from_half_tangent(half_tangent));
        if exact { turned } else { Self { exact, enclosed, phase, written, ..turned } }
    }

    /// Returns the angle modulo a full turn as an expression in radians, or with its unit; `None` if none is known.
    #[must_use]
    pub fn text(&self) -> Option<String> {
        if !self.exact {
            return self.written.text();
        }
        Some(match &self.half_tangent {
            HalfTangent::Infinite => "pi".to_owned(),
            HalfTangent::Finite(t) if t.is_zero() => "0".to_owned(),
            HalfTangent::Finite(t) if *t == 1 => "pi/2".to_owned(),
            HalfTangent::Finite(t) if *t == -1 => "-pi/2".to_owned(),
            HalfTangent::Finite(t) if *t < 0 => format!("-2*atan({})", rational_text(&t.clone().abs())),
            HalfTangent::Finite(t) => format!("2*atan({})", rational_text(t)),
        })
    }

    /// Returns the angle, correctly rounded, as given (not reduced modulo 2 pi). Radians.
    #[must_use]
    pub fn radians(&self) -> f64 {
        self.radians
    }

    /// Returns cosine and sine, correctly rounded (a right angle has cosine exactly 0).
    #[must_use]
    pub fn cos_sin_f64(&self) -> (f64, f64) {
        self.cos_sin
    }

    /// Returns the exact half-angle tangent, or the rational one taken in its place.
    #[must_use]
    pub fn half_tangent(&self) -> &HalfTangent {
        &self.half_tangent
    }

    /// Returns enclosures of cosine and sine, if the half-angle tangent is not the angle's own.
    #[must_use]
    pub fn enclosed(&self) -> Option<&(Enclosure, Enclosure)> {
        self.enclosed.as_deref()
    }

    /// Returns cosine and sine themselves as rationals or in closed form; `None` if only an approximation is known.
    #[must_use]
    pub fn phase(&self) -> Option<Phase> {
        if self.exact {
            let (cos, sin) = super::ring::exact_cos_sin(self);
            return Some((Closed::rational(cos), Closed::rational(sin)));
        }
        self.phase.as_deref().cloned()
    }

    /// Returns whether the half-angle tangent is the angle's own and not an approximation.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.exact
    }
}

/// Returns a rational as a decimal if it is a short one, else as a fraction.
fn rational_text(q: &Rational) -> String {
    let mut scaled = q.clone();
    for places in 0..=LONGEST_DECIMAL {
        if scaled.is_integer() {
            let digits = scaled.numer().clone().abs().to_string();
            let sign = if *q < 0 { "-" } else { "" };
            if places == 0 {
                return format!("{sign}{digits}");
            }
            let padded = format!("{digits:0>width$}", width = places + 1);
            let (head, tail) = padded.split_at(padded.len() - places);
            return format!("{sign}{head}.{tail}");
        }
        scaled *= 10;
    }
    q.to_string()
}

/// Maximum number of decimal places.
const LONGEST_DECIMAL: usize = 24;

/// Returns cosine and sine from the tangent of half the angle.
fn from_tangent(t: &Enclosure) -> Option<(Enclosure, Enclosure)> {
    let (one, square) = (Enclosure::one(), t.mul(t));
    let length = one.add(&square);
    Some((one.sub(&square).over(&length)?, t.add(t).over(&length)?))
}

/// Returns `10^-digits`.
fn relative(digits: u32) -> Float {
    Float::with_val(BITS, 10).pow(-f64::from(digits.min(MOST_DIGITS)))
}

fn read(text: &str, expected: &str) -> Result<Quantified> {
    evaluate(text).map_err(|found| Error::Invalid(format!("found {found}, expected {expected}")))
}

fn check_size(value: &Float, text: &str) -> Result<()> {
    let size = value.clone().abs();
    if size > LARGEST || (!size.is_zero() && size < 1.0 / LARGEST) {
        let found = shortened(text);
        return Err(Error::Invalid(format!("found `{found}`, expected a size between 1e-150 and 1e150, or 0")));
    }
    Ok(())
}

#[cfg(test)]
#[allow(clippy::float_cmp)] // correctly rounded values are compared as such
mod tests {
    use super::*;

    fn ratio(text: &str) -> Number {
        Number::parse(text, Quantity::Ratio, &Reading::default()).unwrap()
    }

    fn angle(text: &str) -> Angle {
        Angle::parse(text, &Reading::default()).unwrap()
    }

    fn refused(text: &str) -> String {
        Number::parse(text, Quantity::Ratio, &Reading::default()).unwrap_err().to_string()
    }

    #[test]
    fn decimals_are_what_they_are_as_expressions() {
        let reading = Reading { length: Rational::from((1, 1000)), ..Reading::default() };
        let pairs = [
            ("0", "0 * 2"),
            ("-0.0", "(0)"),
            ("150", "(150)"),
            (" -1.5e-3 ", "(-1.5e-3)"),
            ("1_000.25", "(1000.25)"),
            ("2 mm", "(2) mm"),
            ("-3.5cm", "(-3.5) cm"),
            ("7e80 m", "(7e80) m"),
            ("1e-120", "(1e-120)"),
            ("9e149", "(9e149)"),
            ("12.", "(12)"),
        ];
        for (text, sum) in pairs {
            let [number, other] = [text, sum].map(|text| Number::parse(text, Quantity::Length, &reading).unwrap());
            assert_eq!(number, other, "{text}");
        }
        for text in ["1e154", "1e-160", "2 deg", "1 m 2", "--", "1e", "1.2.3", ""] {
            assert!(Number::parse(text, Quantity::Length, &reading).is_err(), "{text}");
        }
    }

    #[test]
    fn decimals_are_read_from_their_text() {
        assert_eq!(*ratio("0.1").rational(), Rational::from((1, 10)));
        assert_eq!(*ratio("-1.5e-2").rational(), Rational::from((-3, 200)));
        assert_eq!(*ratio("(1/2 + 1/3) * -6").rational(), -5);
        assert_eq!(*ratio("sqrt(9/4)").rational(), Rational::from((3, 2)));
        assert_eq!(*ratio("cos(pi/3) + sin(-pi/6)").rational(), 0);
        assert_eq!(*ratio("1_000").rational(), 1000);
        assert!(ratio("sqrt(9/4)").is_exact() && !ratio("sqrt(2)").is_exact());
        assert_eq!(ratio("sqrt(2)/2").to_f64(), std::f64::consts::FRAC_1_SQRT_2);
        assert_eq!(ratio("sqrt(2)*sqrt(2) - 2").to_f64(), 0.0);
    }

    #[test]
    fn arguments_of_functions_of_an_angle_may_have_units() {
        assert_eq!(*ratio("2*sin(30 deg)").rational(), 1);
        assert_eq!(*ratio("3*cos(-60 deg)").rational(), Rational::from((3, 2)));
        assert_eq!(*ratio("tan(45 deg) + sin(pi/2 rad)").rational(), 2);
        assert_eq!(ratio("3*sin(40 deg)"), ratio("3*sin(2*pi/9)"));
        assert!((ratio("2*cos((30 + 10) deg)").to_f64() - 1.532_088_886_237_956).abs() < 1e-15);
        assert!(!ratio("2*cos(pi/7)").is_exact());
        assert_eq!(angle("asin(sin(90 deg))"), angle("pi/2"));
        // The argument is in radians, whatever the unit of plain angles.
        let degrees = Reading { degrees: true, ..Reading::default() };
        let length = Number::parse("3*sin(40)", Quantity::Length, &degrees).unwrap();
        assert!((length.to_f64() - 3.0 * 40.0_f64.sin()).abs() < 1e-15);
        let lengths = Reading { length: Rational::from((1, 1000)), ..Reading::default() };
        let length = Number::parse("2*sin(30 deg) cm", Quantity::Length, &lengths).unwrap();
        assert_eq!(*length.rational(), Rational::from((1, 100)));
    }

    #[test]
    fn units_scale() {
        let length = |text: &str, reading: &Reading| Number::parse(text, Quantity::Length, reading);
        let millimetres = Reading { length: Rational::from((1, 1000)), degrees: true, digits: DIGITS };
        assert_eq!(*length("15 cm", &millimetres).unwrap().rational(), Rational::from((3, 20)));
        assert_eq!(*length("150", &millimetres).unwrap().rational(), Rational::from((3, 20)));
        assert_eq!(Angle::parse("90", &millimetres).unwrap(), angle("pi/2"));
        assert!(Angle::parse("pi/2", &millimetres).unwrap_err().to_string().contains("`pi/2 rad`"));
        assert!(length("90 deg", &millimetres).is_err());
        assert!(Angle::parse("3 mm", &millimetres).is_err());
    }

    #[test]
    fn angles_stay_exact_where_their_half_tangent_is_rational() {
        let t = |text: &str| (angle(text).half_tangent().clone(), angle(text).is_exact());
        let exactly = |n: i32, d: i32| (HalfTangent::Finite(Rational::from((n, d))), true);
        assert_eq!(t("0"), exactly(0, 1));
        assert_eq!(t("pi/2"), exactly(1, 1));
        assert_eq!(t("-pi/2"), exactly(-1, 1));
        assert_eq!(t("-90 deg"), exactly(-1, 1));
        assert_eq!(t("pi"), (HalfTangent::Infinite, true));
        assert_eq!(t("-540 deg"), (HalfTangent::Infinite, true));
        assert_eq!(t("acos(3/5)"), exactly(1, 2));
        assert_eq!(t("asin(3/5)"), exactly(1, 3));
        assert_eq!(t("2*atan(1/3)"), exactly(1, 3));
        assert_eq!(t("acos(3/5)/2 + acos(3/5)/2"), exactly(1, 2));
        assert_eq!(t("acos(3/5) + pi/2"), exactly(3, 1));
        assert_eq!(t("-3*acos(3/5)"), exactly(-11, 2));
        assert_eq!(t("atan2(0, -1)"), (HalfTangent::Infinite, true));
        assert_eq!(t("pi/4 + pi/4"), exactly(1, 1));
        assert_eq!(angle("pi/2").cos_sin_f64(), (0.0, 1.0));
        assert_eq!(angle("pi").cos_sin_f64(), (-1.0, 0.0));
        assert_eq!(angle("-pi").radians(), -std::f64::consts::PI);
    }

    #[test]
    fn other_angles_are_rounded_and_say_so() {
        let decimal = angle("1.5707963267948966");
        assert!(!decimal.is_exact());
        assert_eq!(decimal.cos_sin_f64().0, 1.923_132_169_163_975_3e-17);
        for text in ["1", "pi/3", "1 deg", "-2.5", "3.14159", "1e-40", "100"] {
            let angle = angle(text);
            let HalfTangent::Finite(t) = angle.half_tangent() else { panic!("{text} is not pi") };
            let turned = Angle::from_half_tangent(HalfTangent::Finite(t.clone()));
            assert!(!angle.is_exact());
            let (c, s) = (angle.cos_sin_f64(), turned.cos_sin_f64());
            assert!((c.0 - s.0).abs() < 1e-15 && (c.1 - s.1).abs() < 1e-15, "{text}");
        }
        assert_eq!(*angle("3.14159265358979323846").half_tangent(), HalfTangent::Infinite);
        assert_eq!(Angle::from_radians(1.0).radians(), 1.0);
    }

    #[test]
    fn half_tangents_are_read() {
        let read = |text: &str| Angle::parse_half_tangent(text, &Reading::default());
        assert_eq!(read("inf").unwrap().radians(), std::f64::consts::PI);
        assert_eq!(read("1").unwrap(), angle("pi/2"));
        assert!(read("pi deg").is_err());
    }

    #[test]
    fn nonsense_is_refused_with_what_was_found() {
        for (text, found) in [
            ("", "nothing"),
            ("1/0", "division by zero"),
            ("1/(sqrt(2)*sqrt(2)-2)", "division by zero"),
            ("nan", "not a finite number"),
            ("-inf", "not a finite number"),
            ("1e999", "power of ten"),
            ("1e300", "between"),
            ("1e-300", "between"),
            ("1e400*1e400*1e400*1e400", "absurdly large"),
            ("sqrt(-1)", "negative"),
            ("acos(2)", "outside"),
            ("tan(pi/2)", "right angle"),
            ("atan2(0,0)", "atan2"),
            ("1 +", "too early"),
            ("(1", "not closed"),
            ("foo", "neither"),
            ("1 2", "cannot be read"),
            ("1 furlong", "none of"),
            ("1 mm + 2 mm", "cannot be read"),
            ("1 + 2 mm", "one unit"),
            ("2 mm", "without unit"),
            ("sin(2 mm)", "`sin` of a length"),
            ("3*sin(30 + 10 deg)", "`30 + 10 deg`, a sum with one unit"),
            ("2pi", "`pi` right behind a number; a product needs `*`, as in `2*pi`"),
            ("cos(40 deg", "not closed"),
            ("tan(40 degrees)", "unit `degrees`"),
            ("sin 40", "without an argument"),
            ("--+.", "not a number"),
            ("\u{e9}", "should stand"),
        ] {
            assert!(refused(text).contains(found), "{text}: {}", refused(text));
        }
        assert!(refused(&"(".repeat(500)).contains("nested"));
        assert!(refused(&"1".repeat(2000)).contains("characters"));
        assert!(!angle(&format!("{}atan(1/3)", "64*".repeat(60))).is_exact());
    }
}
