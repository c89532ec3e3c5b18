//! The closure of loops of rotations at several places side by side, the inverse of its derivative, and angles.

use super::lanes::Lanes;
use crate::kinematics::motion::Motion;
use pulp::Simd;

/// Cosine and sine of six angles.
pub type Pairs<S> = [[Lanes<S>; 2]; 6];

/// A motion in every lane.
struct Frame<S: Simd> {
    rotation: [[Lanes<S>; 3]; 3],
    translation: [Lanes<S>; 3],
}

/// The closure at several places, see [`Closure`](super::newton::Closure).
pub struct LaneClosure<S: Simd> {
    /// The skew part of the rotation as a vector, and the translation.
    pub residual: [Lanes<S>; 6],
    /// Column j is the twist of unknown j, as `[j][row]`.
    pub jacobian: [[Lanes<S>; 6]; 6],
    /// The largest entry of |E - I| in the rotation, and in the translation.
    pub turn: Lanes<S>,
    /// The largest one in the translation.
    pub shift: Lanes<S>,
    /// The distance of the frame in front of each unknown, and of the last one.
    pub distances: [Lanes<S>; 7],
}

impl<S: Simd> Frame<S> {
    /// `frame * constant`
    #[inline(always)]
    fn behind(&self, constant: &Motion<f64>) -> Self {
        let (r, g) = (&self.rotation, &constant.rotation);
        let mut next = Self { rotation: *r, translation: self.translation };
        for i in 0..3 {
            for j in 0..3 {
                let (a, b, c) = (r[i][0].like(g[0][j]), r[i][0].like(g[1][j]), r[i][0].like(g[2][j]));
                next.rotation[i][j] = r[i][2].fma(c, r[i][1].fma(b, r[i][0] * a));
            }
            let t = &constant.translation;
            let (a, b, c) = (r[i][0].like(t[0]), r[i][0].like(t[1]), r[i][0].like(t[2]));
            next.translation[i] = r[i][2].fma(c, r[i][1].fma(b, r[i][0].fma(a, self.translation[i])));
        }
        next
    }

    /// `frame * Rz`
    #[inline(always)]
    fn turn(&mut self, [cos, sin]: [Lanes<S>; 2]) {
        for row in &mut self.rotation {
            let (x, y) = (row[0], row[1]);
            row[0] = x.fma(cos, y * sin);
            row[1] = x.subtracted_from(sin, y * cos);
        }
    }

    #[inline(always)]
    fn distance(&self) -> Lanes<S> {
        let [x, y, z] = self.translation;
        x.fma(x, y.fma(y, z * z)).sqrt()
    }
}

/// Returns the closure of a loop of six rotations.
#[inline(always)]
pub fn lane_closure<S: Simd>(constants: &[Motion<f64>; 6], pairs: &Pairs<S>) -> LaneClosure<S> {
    let one = pairs[0][0].like(1.0);
    let zero = one.like(0.0);
    let mut jacobian = [[zero; 6]; 6];
    let mut distances = [zero; 7];
    // The first rotation turns the first constant from the left, about the z axis of the frame.
    jacobian[0][2] = one;
    let [cos, sin] = pairs[0];
    let first = &constants[0];
    let mut frame = Frame { rotation: [[zero; 3]; 3], translation: [zero; 3] };
    for j in 0..3 {
        let (x, y) = (cos.like(first.rotation[0][j]), cos.like(first.rotation[1][j]));
        frame.rotation[0][j] = cos * x - sin * y;
        frame.rotation[1][j] = sin * x + cos * y;
        frame.rotation[2][j] = cos.like(first.rotation[2][j]);
    }
    let (x, y) = (cos.like(first.translation[0]), cos.like(first.translation[1]));
    frame.translation = [cos * x - sin * y, sin * x + cos * y, cos.like(first.translation[2])];
    for j in 1..6 {
        let z = [frame.rotation[0][2], frame.rotation[1][2], frame.rotation[2][2]];
        let p = frame.translation;
        jacobian[j] = [
            z[0],
            z[1],
            z[2],
            z[1].subtracted_from(p[2], p[1] * z[2]),
            z[2].subtracted_from(p[0], p[2] * z[0]),
            z[0].subtracted_from(p[1], p[0] * z[1]),
        ];
        distances[j] = frame.distance();
        frame.turn(pairs[j]);
        frame = frame.behind(&constants[j]);
    }
    distances[6] = frame.distance();
    let r = &frame.rotation;
    let half = one.like(0.5);
    let (mut turn, mut shift) = (zero, zero);
    for i in 0..3 {
        for j in 0..3 {
            let off = if i == j { r[i][j] - one } else { r[i][j] };
            turn = larger(turn, off.abs());
        }
        shift = larger(shift, frame.translation[i].abs());
    }
    let [x, y, z] = frame.translation;
    let residual = [half * (r[2][1] - r[1][2]), half * (r[0][2] - r[2][0]), half * (r[1][0] - r[0][1]), x, y, z];
    LaneClosure { residual, jacobian, turn, shift, distances }
}

/// The larger number, y where that is NaN; where x is, the off-diagonal entries beside it are, and the residuals with them.
#[inline(always)]
fn larger<S: Simd>(x: Lanes<S>, y: Lanes<S>) -> Lanes<S> {
    y.at_most(x).select(x, y)
}

/// Returns an approximate inverse of a matrix given by its columns, as rows: Gram and Schmidt's triangular factor, inverted.
#[inline(always)]
pub fn lane_inverse<S: Simd>(columns: &[[Lanes<S>; 6]; 6]) -> [[Lanes<S>; 6]; 6] {
    let mut q = *columns;
    let one = q[0][0].like(1.0);
    let mut factor = [[one; 6]; 6];
    let mut over = [one; 6];
    for j in 0..6 {
        let mut square = q[j][0] * q[j][0];
        for i in 1..6 {
            square = q[j][i].fma(q[j][i], square);
        }
        over[j] = one / square.sqrt();
        for i in 0..6 {
            q[j][i] = q[j][i] * over[j];
        }
        for k in j + 1..6 {
            let mut dot = q[j][0] * q[k][0];
            for i in 1..6 {
                dot = q[j][i].fma(q[k][i], dot);
            }
            factor[j][k] = dot;
            for i in 0..6 {
                q[k][i] = dot.subtracted_from(q[j][i], q[k][i]);
            }
        }
    }
    for j in (0..6).rev() {
        for k in j + 1..6 {
            for i in 0..6 {
                q[j][i] = factor[j][k].subtracted_from(q[k][i], q[j][i]);
            }
        }
        for i in 0..6 {
            q[j][i] = q[j][i] * over[j];
        }
    }
    q
}

/// Returns cosine and sine of an angle off by a small one, subtracted, to fourth order, over their length.
#[inline(always)]
pub fn turned_back<S: Simd>([cos, sin]: [Lanes<S>; 2], angle: Lanes<S>) -> [Lanes<S>; 2] {
    let one = cos.like(1.0);
    let square = angle * angle;
    let by_sin = angle * square.subtracted_from(cos.like(1.0 / 6.0), one);
    let by_cos = square.fma(square.fma(cos.like(1.0 / 24.0), cos.like(-0.5)), one);
    on_circle([cos.fma(by_cos, sin * by_sin), cos.subtracted_from(by_sin, sin * by_cos)])
}

/// Returns a pair near the circle on it, to rounding.
#[inline(always)]
fn on_circle<S: Simd>([cos, sin]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
    let square = cos.fma(cos, sin * sin);
    // One step of Newton's method towards one over the root.
    let factor = square.fma(cos.like(-0.5), cos.like(1.5));
    [cos * factor, sin * factor]
}

/// Returns a pair over its length.
#[inline(always)]
pub fn normalised<S: Simd>([cos, sin]: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
    let over = cos.like(1.0) / cos.fma(cos, sin * sin).sqrt();
    [cos * over, sin * over]
}

/// Half the width of the two arcs to which an angle below 45 degrees is reduced: their middles are at 11.25 and 33.75 degrees.
const ARC: f64 = std::f64::consts::PI / 16.0;
/// Tangents of these middles.
const TANGENTS: [f64; 2] = [0.198_912_367_379_658, 0.668_178_637_919_298_9];
/// The tangent of 22.5 degrees, where the arcs meet.
const MEETING: f64 = 0.414_213_562_373_095_1;
/// Terms of the arc tangent: the first one left out is below `0.2^24 / 25`.
const TERMS: usize = 12;
/// No angle is off by more: of the quotient and its series by 4 half units of 1/4, of the sums with the middle, with a quarter and
/// with half a turn by 1, 2 and 4 half units, and those of the constants are as large.
pub const ANGLE_ERROR: f64 = 16.0 * f64::EPSILON;

/// Returns the angles of pairs on the circle, within [`ANGLE_ERROR`].
#[inline(always)]
pub fn angle_of<S: Simd>([cos, sin]: [Lanes<S>; 2]) -> Lanes<S> {
    let zero = cos.like(0.0);
    let (a, b) = (cos.abs(), sin.abs());
    let (near, far) = (a.min(b), a.max(b));
    let is_second = (far * zero.like(MEETING)).below(near);
    let tangent = is_second.select(zero.like(TANGENTS[1]), zero.like(TANGENTS[0]));
    let middle = is_second.select(zero.like(3.0 * ARC), zero.like(ARC));
    let x = tangent.subtracted_from(far, near) / tangent.fma(near, far);
    let square = x * x;
    let mut sum = zero;
    for k in (0..TERMS).rev() {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        sum = sum.fma(square, zero.like(sign / (2 * k + 1) as f64));
    }
    let angle = x.fma(sum, middle);
    let angle = a.below(b).select(zero.like(std::f64::consts::FRAC_PI_2) - angle, angle);
    let angle = cos.below(zero).select(zero.like(std::f64::consts::PI) - angle, angle);
    sin.below(zero).select(-angle, angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use pulp::{Arch, WithSimd};
    use rug::Float;

    struct Angles<'a>(&'a [f64; 8], &'a [f64; 8]);

    impl WithSimd for Angles<'_> {
        type Output = [f64; 8];

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> [f64; 8] {
            let mut angles = [0.0; 8];
            for chunk in 0..Lanes::<S>::CHUNKS {
                angle_of([Lanes::load(simd, self.0, chunk), Lanes::load(simd, self.1, chunk)])
                    .store(&mut angles, chunk);
            }
            angles
        }
    }

    #[test]
    fn angles_are_within_their_bound() {
        let mut largest = 0.0_f64;
        for step in 0..100_000 {
            let angle = |k: usize| -3.2 + 6.4 * f64::from(u32::try_from(8 * step + k).unwrap()) / 800_000.0;
            let cos: [f64; 8] = std::array::from_fn(|k| angle(k).cos());
            let sin: [f64; 8] = std::array::from_fn(|k| angle(k).sin());
            let found = Arch::new().dispatch(Angles(&cos, &sin));
            for k in 0..8 {
                let exact = Float::with_val(100, sin[k]).atan2(&Float::with_val(100, cos[k]));
                largest = largest.max((exact - found[k]).to_f64().abs());
            }
        }
        assert!(largest < ANGLE_ERROR / 2.0, "{largest}");
    }
}
