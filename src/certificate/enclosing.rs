//! The numbers of the checker: complex numbers with a bound on their errors.

use crate::algebra::ball::Ball;
use crate::algebra::enclosure::Enclosure;
use crate::algebra::ring::Field;
use rug::{Float, Rational, float::Round};

/// Bits beyond those of a number in which its cosine and sine are computed.
const GUARD: u32 = 32;
/// Precision of bounds, in bits.
const BOUND: u32 = 53;

/// Complex numbers known up to a radius, independent of the arithmetic used for them.
pub(super) trait Enclosing: Field {
    /// Bits of a midpoint.
    const BITS: u32;
    /// Returns a ball about a point, which is known to at least `BITS` bits, with this radius.
    fn near(re: &Float, im: &Float, radius: f64) -> Self;
    /// Converts a real number of the data.
    fn of(known: &Enclosure) -> Self;
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
    ///
    /// Neither changes by more than `r exp(|im| + r)` within the radius r.
    fn cos_sin_about((re, im): &(Rational, Rational), radius: f64) -> (Self, Self) {
        let bits = Self::BITS + GUARD;
        let up = |x: Float| Float::with_val_round(BOUND, x, Round::Up).0;
        // Where a cosine is nearly 0, the rounding of its argument is large beside it.
        let rounded = |q: &Rational| {
            let (x, order) = Float::with_val_round(bits, q, Round::Nearest);
            let error = if order.is_eq() { 0.0 } else { (up(x.clone().abs()) >> bits).to_f64_round(Round::Up) };
            (x, error)
        };
        let ((re, of_re), (im, of_im)) = (rounded(re), rounded(im));
        let error = of_re + of_im;
        let radius = if error > 0.0 { (radius + error.next_up()).next_up() } else { radius };
        let growth = up(up(up(im.clone().abs()) + radius) + 1e-3_f64).exp();
        let off = if radius == 0.0 { 0.0 } else { (up(growth) * radius).to_f64_round(Round::Up).next_up() };
        let (sin, cos) = re.sin_cos(Float::new(bits));
        let (sinh, cosh) = im.sinh_cosh(Float::new(bits));
        let part = |a: &Float, b: &Float| Float::with_val(bits, a * b);
        let minus = |x: Float| -x;
        let cosine = Self::near(&part(&cos, &cosh), &minus(part(&sin, &sinh)), off);
        let sine = Self::near(&part(&sin, &cosh), &part(&cos, &sinh), off);
        (cosine, sine)
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
