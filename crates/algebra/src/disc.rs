//! Discs of complex numbers, in as many bits as their centres have; results computed with them are proved.

use super::ring::Ring;
use rug::{
    Float, Rational,
    float::{Constant, Round},
};

/// Precision of a radius in bits; a radius is always rounded up.
const RADIUS_BITS: u32 = 64;

/// Default precision of a rational number in bits.
const DEFAULT_BITS: u32 = 512;

/// All complex numbers no farther from a centre than a radius.
///
/// Comparison is by centre and radius.
#[derive(Clone, Debug, PartialEq)]
pub struct Disc {
    /// Real part of the centre.
    pub re: Float,
    /// Imaginary part of the centre.
    pub im: Float,
    radius: Float,
}

/// Returns a radius, rounded up.
fn up<T>(value: T) -> Float
where
    Float: rug::ops::AssignRound<T, Round = Round, Ordering = std::cmp::Ordering>,
{
    Float::with_val_round(RADIUS_BITS, value, Round::Up).0
}

/// Rounds a radius down.
fn down<T>(value: T) -> Float
where
    Float: rug::ops::AssignRound<T, Round = Round, Ordering = std::cmp::Ordering>,
{
    Float::with_val_round(RADIUS_BITS, value, Round::Down).0
}

impl Disc {
    /// Returns the disc about a point.
    #[must_use]
    pub fn new(re: Float, im: Float, radius: &Float) -> Self {
        Self { re, im, radius: up(radius.abs_ref()) }
    }

    /// Returns a point.
    #[must_use]
    pub fn point(re: Float, im: Float) -> Self {
        Self { re, im, radius: Float::new(RADIUS_BITS) }
    }

    /// Encloses a rational number in this many bits.
    #[must_use]
    pub fn of(q: &Rational, bits: u32) -> Self {
        Self::point(Float::with_val(bits, q), Float::new(bits)).rounded(1)
    }

    /// Returns all real numbers between two rational ones.
    #[must_use]
    pub fn between(low: &Rational, high: &Rational, bits: u32) -> Self {
        let middle = Self::of(&(Rational::from(low + high) / 2), bits);
        let half = up(&(Rational::from(high - low) / 2));
        middle.widened(&half)
    }

    /// Returns the radius.
    #[must_use]
    pub fn radius(&self) -> &Float {
        &self.radius
    }

    /// Returns the same disc with a larger radius.
    #[must_use]
    pub fn widened(mut self, by: &Float) -> Self {
        self.radius = up(&self.radius + by);
        self
    }

    /// Adds the effect of this many roundings of the centre, in units of the last place of both parts together.
    fn rounded(mut self, roundings: u32) -> Self {
        let unit = up(&self.centre_size() >> (self.bits() - 1));
        self.radius = up(&self.radius + up(unit * roundings));
        self
    }

    fn bits(&self) -> u32 {
        self.re.prec().max(self.im.prec())
    }

    /// Returns an upper bound of the absolute value of the centre, at most sqrt(2) times it.
    fn centre_size(&self) -> Float {
        up(&up(self.re.abs_ref()) + &up(self.im.abs_ref()))
    }

    /// Returns a lower bound of the absolute value of the centre.
    fn centre_at_least(&self) -> Float {
        let (re, im) = (down(self.re.abs_ref()), down(self.im.abs_ref()));
        let (large, small) = if re < im { (im, re) } else { (re, im) };
        // Both legs of the triangle are rounded down.
        let square = down(&down(&large * &large) + &down(&small * &small));
        Float::with_val_round(RADIUS_BITS, square.sqrt_ref(), Round::Down).0
    }

    /// Returns an upper bound of all absolute values.
    #[must_use]
    pub fn at_most(&self) -> Float {
        up(&self.centre_size() + &self.radius)
    }

    /// Returns a lower bound of all absolute values, not below 0.
    #[must_use]
    pub fn at_least(&self) -> Float {
        let low = down(&self.centre_at_least() - &self.radius);
        if low > 0 { low } else { Float::new(RADIUS_BITS) }
    }

    /// Returns whether 0 is outside the disc.
    #[must_use]
    pub fn is_not_zero(&self) -> bool {
        self.at_least() > 0
    }

    /// Returns the inverse; `None` if 0 may be in the disc.
    #[must_use]
    pub fn inverse(&self) -> Option<Self> {
        let least = self.at_least();
        if !(least > 0) {
            return None;
        }
        let bits = self.bits() + 8;
        let square = Float::with_val(bits, self.re.square_ref()) + Float::with_val(bits, self.im.square_ref());
        let re = Float::with_val(bits, &self.re / &square);
        let im = -Float::with_val(bits, &self.im / &square);
        // |1/z - 1/m| = |z - m| / (|z| |m|)
        let error = up(&up(&self.radius / &least) / &self.centre_at_least());
        Some(Self { re, im, radius: error }.rounded(8))
    }

    /// Returns a square root with nonnegative real part; `None` if the disc is not far enough from 0.
    #[must_use]
    pub fn sqrt(&self) -> Option<Self> {
        let least = self.centre_at_least();
        if up(&self.radius * 2_u32) > least || least == 0 {
            return None;
        }
        let bits = self.bits() + 16;
        let size = Float::with_val(bits, self.re.hypot_ref(&self.im));
        // The larger part comes first: it suffers no cancellation, and the other one is a quotient.
        let half = |x: Float| (x / 2_u32).sqrt();
        let (re, im) = if self.re >= 0 {
            let re = half(Float::with_val(bits, &size + &self.re));
            let im = Float::with_val(bits, &self.im / &re) / 2_u32;
            (re, im)
        } else {
            let im = half(Float::with_val(bits, &size - &self.re));
            let re = Float::with_val(bits, &self.im / &im) / 2_u32;
            if re < 0 { (-re, -im) } else { (re, im) }
        };
        // |sqrt z - sqrt m| = |z - m| / |sqrt z + sqrt m|, and the two roots are no more than a right angle apart.
        let error = up(&self.radius / &Float::with_val_round(RADIUS_BITS, least.sqrt_ref(), Round::Down).0);
        Some(Self { re, im, radius: error }.rounded(16))
    }

    /// Returns all n-th roots, anticlockwise from the one whose argument is least in size; `None` if the disc is not far enough from 0.
    #[must_use]
    pub fn roots(&self, n: u32) -> Option<Vec<Self>> {
        let least = self.centre_at_least();
        if up(&self.radius * 2_u32) > least || least == 0 || n == 0 {
            return None;
        }
        // An angle of up to n turns is divided by n, with a few roundings of a unit of n turns.
        let bits = self.bits() + 16 + u32::BITS - n.leading_zeros();
        let size = Float::with_val(bits, self.re.hypot_ref(&self.im)).root(n);
        let argument = Float::with_val(bits, self.im.atan2_ref(&self.re));
        let turn = Float::with_val(bits, Constant::Pi) * 2_u32;
        // w = w_m (1 + d)^(1/n) with d = (z - m)/m below 1/2, and |(1 + d)^(1/n) - 1| <= 2 |d|.
        let error = up(&up(&up(&self.radius * 2_u32) / &least) * &up(&size));
        let root = |k: u32| {
            let angle = (Float::with_val(bits, &turn * k) + &argument) / n;
            let (sin, cos) = angle.sin_cos(Float::new(bits));
            Self { re: cos * &size, im: sin * &size, radius: error.clone() }.rounded(1 << 8)
        };
        Some((0..n).map(root).collect())
    }

    /// Returns the angle with this cosine and sine, real or complex: `-i log(cos + i sin)` with a real part in (-pi, pi].
    /// `None` if the discs are too large to determine it.
    #[must_use]
    pub fn angle(cos: &Self, sin: &Self) -> Option<Self> {
        let i = Self::point(Float::new(1), Float::with_val(1, 1));
        let turned = sin.mul(&i);
        let (plus, minus) = (cos.add(&turned), cos.sub(&turned));
        // Both expressions are valid, as their product is 1; the larger one has the better digits.
        let (z, flip) = if plus.centre_at_least() >= minus.centre_at_least() { (plus, false) } else { (minus, true) };
        let least = z.centre_at_least();
        if up(&z.radius * 2_u32) > least || least == 0 {
            return None;
        }
        let bits = z.bits() + 16;
        let real = Float::with_val(bits, z.im.atan2_ref(&z.re));
        let size = Float::with_val(bits, z.re.hypot_ref(&z.im)).ln();
        // |log z - log m| <= 2 |z - m| / |m| within half the distance of 0.
        let error = up(&up(&z.radius * 2_u32) / &least);
        // z = exp(i q), or exp(-i q).
        let angle = if flip { (-real, size) } else { (real, -size) };
        let rounding = up(Float::with_val(RADIUS_BITS, 1) >> (bits - 4));
        Some(Self { re: angle.0, im: angle.1, radius: error }.rounded(4).widened(&rounding))
    }

    /// Returns the values of a polynomial with rational coefficients.
    #[must_use]
    pub fn evaluate(&self, coefficients: &[Rational]) -> Self {
        let bits = self.bits();
        let zero = Self::point(Float::new(bits), Float::new(bits));
        coefficients.iter().rev().fold(zero, |value, c| value.mul(self).add(&Self::of(c, bits)))
    }
}

impl Ring for Disc {
    fn zero() -> Self {
        Self::point(Float::new(1), Float::new(1))
    }
    fn one() -> Self {
        Self::point(Float::with_val(1, 1), Float::new(1))
    }
    fn add(&self, other: &Self) -> Self {
        let bits = self.bits().max(other.bits()).max(RADIUS_BITS);
        let radius = up(&self.radius + &other.radius);
        let (re, im) = (Float::with_val(bits, &self.re + &other.re), Float::with_val(bits, &self.im + &other.im));
        Self { re, im, radius }.rounded(1)
    }
    fn sub(&self, other: &Self) -> Self {
        self.add(&other.neg())
    }
    fn mul(&self, other: &Self) -> Self {
        let bits = self.bits().max(other.bits()).max(RADIUS_BITS);
        let product = |x: &Float, y: &Float| Float::with_val(bits, x * y);
        let re = product(&self.re, &other.re) - product(&self.im, &other.im);
        let im = product(&self.re, &other.im) + product(&self.im, &other.re);
        let (own, others) = (self.centre_size(), other.centre_size());
        // Three roundings of each part, each of a number no larger than the product of these sizes.
        let rounding = up(up(&own * &others) >> (bits - 3));
        let spread = up(&up(&own * &other.radius) + &up(&others * &self.radius));
        let radius = up(&up(&spread + &up(&self.radius * &other.radius)) + &rounding);
        Self { re, im, radius }
    }
    fn neg(&self) -> Self {
        Self {
            re: Float::with_val(self.re.prec(), -&self.re),
            im: Float::with_val(self.im.prec(), -&self.im),
            radius: self.radius.clone(),
        }
    }
    fn is_zero(&self) -> bool {
        self.re == 0 && self.im == 0 && self.radius == 0
    }
    fn from_rational(q: &Rational) -> Option<Self> {
        Some(Self::of(q, DEFAULT_BITS))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(re: f64, im: f64, radius: f64) -> Disc {
        Disc::new(Float::with_val(100, re), Float::with_val(100, im), &Float::with_val(64, radius))
    }

    /// Returns the distance of a number from the centre, over the radius.
    fn off(disc: &Disc, re: f64, im: f64) -> f64 {
        let (x, y) = (Float::with_val(100, &disc.re - re), Float::with_val(100, &disc.im - im));
        (Float::with_val(64, x.hypot_ref(&y)) / disc.radius()).to_f64()
    }

    #[test]
    fn results_hold_those_of_all_numbers_inside() {
        let (a, b) = (disc(1.5, -0.25, 0.125), disc(-2.0, 0.75, 0.25));
        for step in 0..16 {
            let (sin, cos) = (f64::from(step) / 2.5).sin_cos();
            let (x, y) = ((1.5 + 0.125 * cos, -0.25 + 0.125 * sin), (-2.0 - 0.25 * sin, 0.75 + 0.25 * cos));
            let product = (x.0 * y.0 - x.1 * y.1, x.0 * y.1 + x.1 * y.0);
            assert!(off(&a.mul(&b), product.0, product.1) <= 1.0 + 1e-9);
            assert!(off(&a.add(&b), x.0 + y.0, x.1 + y.1) <= 1.0 + 1e-9);
            let z = num_complex::Complex::new(y.0, y.1);
            assert!(off(&b.inverse().unwrap(), z.inv().re, z.inv().im) <= 1.0 + 1e-9);
            assert!(off(&b.sqrt().unwrap(), z.sqrt().re, z.sqrt().im) <= 1.0 + 1e-9);
        }
    }

    #[test]
    fn roots_of_all_numbers_inside_are_held() {
        for (re, im) in [(0.3, 0.0), (-3.0, 0.5), (-1.0, 0.0), (2.8, -3.0)] {
            let given = disc(re, im, 0.125);
            for n in [1_u32, 2, 3, 7, 40] {
                let roots = given.roots(n).unwrap();
                assert_eq!(roots.len(), n as usize);
                for step in 0..16 {
                    let (sin, cos) = (f64::from(step) / 2.5).sin_cos();
                    let z = num_complex::Complex::new(re + 0.125 * cos, im + 0.125 * sin);
                    // Each of the roots lies in a disc of its own.
                    for k in 0..n {
                        let turn = f64::from(k) * std::f64::consts::TAU / f64::from(n);
                        let root = z.powf(1.0 / f64::from(n)) * num_complex::Complex::from_polar(1.0, turn);
                        assert!(roots.iter().any(|disc| off(disc, root.re, root.im) <= 1.0 + 1e-9), "{re} {im} {n}");
                    }
                }
                let back = roots[0].clone();
                let power = (1..n).fold(back.clone(), |power, _| power.mul(&back));
                assert!(off(&power, re, im) <= 1.0);
            }
        }
        assert!(disc(0.1, 0.0, 0.2).roots(3).is_none() && disc(1.0, 0.0, 0.0).roots(0).is_none());
    }

    #[test]
    fn angles_are_those_of_their_cosine_and_sine() {
        for (re, im) in [(0.3, 0.0), (-3.0, 0.5), (1.2, -4.0), (2.8, 3.0)] {
            let q = num_complex::Complex::new(re, im);
            let (c, s) = (q.cos(), q.sin());
            let angle = Disc::angle(&disc(c.re, c.im, 1e-12), &disc(s.re, s.im, 1e-12)).unwrap();
            assert!(off(&angle, re, im) < 1.0 && angle.radius().to_f64() < 1e-10, "{q}");
        }
        assert!(Disc::angle(&disc(0.5, 0.0, 0.6), &disc(0.1, 0.0, 0.6)).is_none());
    }
}
