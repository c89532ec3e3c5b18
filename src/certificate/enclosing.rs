//! The numbers of the checker: complex numbers with a bound on their errors.

use super::isolation::Point;
use crate::algebra::ball::Ball;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Field;
use rug::{Float, Rational, float::Round};

/// Bits beyond those of a number in which its cosine and sine are computed.
const GUARD: u32 = 32;
/// Precision of bounds, in bits.
const BOUND: u32 = 53;
/// Radii up to this multiply bounds by [`GROWN`] at most.
const SMALL: f64 = 1e-3;
/// An upper bound of `exp(1e-3)`, and of the roundings of what it is multiplied with.
const GROWN: f64 = 1.01;

/// Complex numbers known up to a radius, independent of the arithmetic used for them.
pub(super) trait Enclosing: Field {
    /// Bits of a midpoint.
    const BITS: u32;
    /// Returns a ball about a point, which is known to at least `BITS` bits, with this radius.
    fn near(re: &Float, im: &Float, radius: f64) -> Self;
    /// Converts a real number of the data.
    fn of(known: &Enclosure) -> Self;
    /// Returns a ball that holds the point with these coordinates, as small as rounding allows.
    fn holding(re: f64, im: f64) -> Self {
        Self::near(&Float::with_val(BOUND, re), &Float::with_val(BOUND, im), 0.0)
    }
    /// Returns the midpoint alone.
    fn middle(&self) -> Self;
    /// Returns an upper bound of the absolute value.
    fn at_most(&self) -> f64;
    /// Returns a lower bound of the absolute value.
    fn at_least(&self) -> f64;

    /// Returns whether the real part of the centre is positive.
    fn is_right(&self) -> bool;

    /// Returns the ball of this radius about a rational point.
    fn about((re, im): &(Rational, Rational), radius: f64) -> Self {
        let float = |q: &Rational| Float::with_val(Self::BITS + GUARD, q);
        Self::near(&float(re), &float(im), radius)
    }

    /// Returns cosine and sine of all angles within a radius of a rational point.
    fn cos_sin_about(angle: &(Rational, Rational), radius: f64) -> (Self, Self) {
        Turn::of(angle, Self::BITS + GUARD).within(radius)
    }
}

/// Cosine and sine of a rational angle, real or not, from which those of all angles within a radius follow.
pub(super) struct Turn {
    /// Real and imaginary part of the cosine, then of the sine.
    parts: [(Float, Float); 2],
    /// An upper bound of the error of the angle.
    error: f64,
    /// A bound of `exp(|im|)`, low by less than the roundings that [`GROWN`] covers.
    size: f64,
}

impl Turn {
    /// Computes cosine and sine with this many bits.
    fn of((re, im): &(Rational, Rational), bits: u32) -> Self {
        // Where a cosine is nearly 0, the rounding of its argument is large beside it.
        let rounded = |q: &Rational| {
            let (x, order) = Float::with_val_round(bits, q, Round::Nearest);
            let above = || Float::with_val_round(BOUND, x.abs_ref(), Round::Up).0;
            let error = if order.is_eq() { 0.0 } else { (above() >> bits).to_f64_round(Round::Up) };
            (x, error)
        };
        let ((re, of_re), (im, of_im)) = (rounded(re), rounded(im));
        let error = if of_re + of_im > 0.0 { (of_re + of_im).next_up() } else { 0.0 };
        let (sin, cos) = re.sin_cos(Float::new(bits));
        if im.is_zero() {
            let none = || Float::new(2);
            return Self { parts: [(cos, none()), (sin, none())], error, size: 1.0 };
        }
        let (sinh, cosh) = im.sinh_cosh(Float::new(bits));
        let part = |a: &Float, b: &Float| Float::with_val(bits, a * b);
        let size = cosh.to_f64_round(Round::Up) + sinh.to_f64().abs();
        let cosine = (part(&cos, &cosh), -part(&sin, &sinh));
        Self { parts: [cosine, (part(&sin, &cosh), part(&cos, &sinh))], error, size }
    }

    /// Returns cosine and sine of all angles within a radius. Neither changes by more than `r exp(|im| + r)` within the radius r.
    fn within<S: Enclosing>(&self, radius: f64) -> (S, S) {
        let radius = if self.error > 0.0 { (radius + self.error).next_up() } else { radius };
        let off = if radius == 0.0 {
            0.0
        } else {
            let growth = if radius <= SMALL { GROWN } else { GROWN * up_exp(radius) };
            (self.size * growth * radius).next_up()
        };
        let [cosine, sine] = self.parts.each_ref().map(|(re, im)| S::near(re, im, off));
        (cosine, sine)
    }
}

/// Returns an upper bound of the exponential of a positive number.
fn up_exp(x: f64) -> f64 {
    let mut power = Float::with_val(BOUND, x);
    power.exp_round(Round::Up);
    power.to_f64()
}

/// A rational point, and cosine and sine of those of its coordinates that are angles, from which points within all radii follow.
pub(super) struct Centre {
    x: Vec<(Float, Float)>,
    turns: Vec<Option<Turn>>,
}

impl Centre {
    /// Computes the point for numbers of this many bits and fewer.
    pub(super) fn of(x: &[(Rational, Rational)], angles: &[bool], bits: u32) -> Self {
        let bits = bits + GUARD;
        let float = |q: &Rational| Float::with_val(bits, q);
        Self {
            x: x.iter().map(|(re, im)| (float(re), float(im))).collect(),
            turns: x.iter().zip(angles).map(|(x, is_angle)| is_angle.then(|| Turn::of(x, bits))).collect(),
        }
    }

    /// Returns all points within a radius, in the largest norm.
    pub(super) fn within<S: Enclosing>(&self, radius: f64) -> Point<S> {
        Point {
            x: self.x.iter().map(|(re, im)| S::near(re, im, radius)).collect(),
            turns: self.turns.iter().map(|turn| turn.as_ref().map(|turn| turn.within(radius))).collect(),
        }
    }
}

impl<const BITS: u32> Enclosing for Ball<BITS> {
    const BITS: u32 = BITS;
    fn near(re: &Float, im: &Float, radius: f64) -> Self {
        Self::point(re, im).enlarged(&Float::with_val(BOUND, radius))
    }
    fn of(known: &Enclosure) -> Self {
        Self::from(known)
    }
    fn middle(&self) -> Self {
        self.midpoint()
    }
    fn at_most(&self) -> f64 {
        self.upper().to_f64_round(Round::Up)
    }
    fn at_least(&self) -> f64 {
        self.lower().to_f64_round(Round::Down)
    }
    fn is_right(&self) -> bool {
        *self.re() > 0
    }
}

/// Returns an upper bound of the distance of a number of the data from the middle of its enclosure.
pub(super) fn distance_from_middle(known: &Enclosure) -> f64 {
    if known.off() == i32::MIN {
        0.0
    } else {
        Float::with_val(BOUND, Float::i_exp(1, known.off())).to_f64_round(Round::Up)
    }
}

/// Returns the approximate inverse of the midpoints of a matrix; proofs with it do not rest on its accuracy.
pub(super) fn near_inverse<S: Enclosing, const N: usize>(matrix: &[[S; N]; N]) -> Option<[[S; N]; N]> {
    let mut left = matrix.each_ref().map(|row| row.each_ref().map(Enclosing::middle));
    let unit = |i: usize, j: usize| if i == j { S::one() } else { S::zero() };
    let mut right: [[S; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| unit(i, j)));
    for column in 0..N {
        let size = |row: &usize| left[*row][column].pivot_size();
        let pivot = (column..N).max_by(|i, j| size(i).total_cmp(&size(j)))?;
        left.swap(column, pivot);
        right.swap(column, pivot);
        let scale = left[column][column].inverse()?.middle();
        for row in [&mut left, &mut right] {
            row[column] = row[column].each_ref().map(|x| x.mul(&scale).middle());
        }
        for i in (0..N).filter(|&i| i != column) {
            let factor = left[i][column].clone();
            if factor.is_zero() {
                continue;
            }
            for side in [&mut left, &mut right] {
                let own = side[column].clone();
                side[i] = std::array::from_fn(|j| side[i][j].sub(&factor.mul(&own[j])).middle());
            }
        }
    }
    Some(right)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rug::float::Constant;

    #[test]
    fn a_cosine_beside_a_right_angle_lies_in_its_ball() {
        let quarter = Float::with_val(1024, Constant::Pi) / 2_u32;
        let beside =
            quarter - Float::with_val(1024, 10).recip().square() * Float::with_val(1024, Float::i_exp(1, -400));
        let angle = beside.to_rational().unwrap_or_default();
        let truth = Float::with_val(2048, &angle).cos();
        let (cos, _) = Ball::<384>::cos_sin_about(&(angle, Rational::new()), 0.0);
        assert!(cos.overlaps(&Ball::point(&truth, &Float::new(53))));
    }
}
