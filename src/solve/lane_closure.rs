//! The closure of loops of rotations at several places side by side, the inverse of its derivative, and angles.

use super::lanes::{ComplexLanes, LaneNumber, Lanes, Mask, Row, WIDTH};
use crate::kinematics::motion::Motion;
use pulp::Simd;

/// Cosine and sine of six angles.
pub type Pairs<N> = [[N; 2]; 6];

/// A motion in every lane.
struct Frame<N> {
    rotation: [[N; 3]; 3],
    translation: [N; 3],
}

/// Norms of a frame for error bounds, see [`StepNorms`](super::newton::StepNorms).
#[derive(Clone, Copy)]
pub struct Lengths<S: Simd> {
    /// The row-sum norm of the frame.
    pub norm: Lanes<S>,
    /// The row-sum norm of the inverse of the frame.
    pub inverse: Lanes<S>,
    /// The row-sum norm of the twist of the unknown behind it.
    pub twist: Lanes<S>,
    /// The derivative of that twist with respect to the frame.
    pub lever: Lanes<S>,
}

/// Cosines and sines of real or of complex angles.
pub trait Angular<S: Simd>: LaneNumber<S> {
    /// Whether the angles are real.
    const REAL: bool;
    /// Returns a pair that is off the circle by little, on it to rounding.
    fn on_circle(pair: [Self; 2]) -> [Self; 2];
    /// Returns a pair of any length on the circle.
    fn normalised(pair: [Self; 2]) -> [Self; 2];
    /// Bounds the norms of a frame.
    fn lengths(rotation: &[[Self; 3]; 3], translation: &[Self; 3]) -> Lengths<S>;
    /// Bounds how far a pair is off that of the angle that [`Self::angle`] computes, both numbers together, in parts of their sizes.
    fn off_circle(pair: [Self; 2]) -> Lanes<S>;
    /// Returns the angle of a pair on the circle: real part and imaginary part, each within [`ANGLE_ERROR`] and that many parts of the
    /// imaginary part.
    fn angle(pair: [Self; 2]) -> [Row; 2];
}

/// The closure at several places, see [`Closure`](super::newton::Closure).
pub struct LaneClosure<S: Simd, N> {
    /// The skew part of the rotation as a vector, and the translation.
    pub residual: [N; 6],
    /// Column j is the twist of unknown j, as `[j][row]`.
    pub jacobian: [[N; 6]; 6],
    /// The largest entry of |E - I| in the rotation.
    pub turn: Lanes<S>,
    /// The largest one in the translation.
    pub shift: Lanes<S>,
    /// Norms of the frame in front of each unknown, and of the last one.
    pub lengths: [Lengths<S>; 7],
}

/// The root of 2 and of 3, with a margin: row sums of rotations, and of twists.
pub(crate) const ROOT_2: f64 = 1.4143;
pub(crate) const ROOT_3: f64 = 1.7321;

impl<S: Simd> Angular<S> for Lanes<S> {
    const REAL: bool = true;

    #[inline(always)]
    fn on_circle([cos, sin]: [Self; 2]) -> [Self; 2] {
        let square = cos.fma(cos, sin * sin);
        // One step of Newton's method towards one over the root.
        let factor = square.fma(cos.like(-0.5), cos.like(1.5));
        [cos * factor, sin * factor]
    }

    #[inline(always)]
    fn normalised([cos, sin]: [Self; 2]) -> [Self; 2] {
        let over = cos.like(1.0) / cos.fma(cos, sin * sin).sqrt();
        [cos * over, sin * over]
    }

    #[inline(always)]
    fn lengths(_: &[[Self; 3]; 3], [x, y, z]: &[Self; 3]) -> Lengths<S> {
        // Rows of a rotation are unit vectors, and the inverse moves the origin by the same distance.
        let distance = x.fma(*x, y.fma(*y, *z * *z)).sqrt();
        let norm = distance + x.like(ROOT_3);
        let lever = distance.fma(x.like(ROOT_3 * ROOT_3), x.like(ROOT_3));
        Lengths { norm, inverse: norm, twist: distance + x.like(ROOT_2), lever }
    }

    #[inline(always)]
    fn off_circle([cos, sin]: [Self; 2]) -> Self {
        (cos.fma(cos, sin * sin) - cos.like(1.0)).abs()
    }

    #[inline(always)]
    fn angle(pair: [Self; 2]) -> [Row; 2] {
        let mut angle = [0.0; WIDTH];
        angle_of(pair).store(&mut angle, 0);
        [angle, [0.0; WIDTH]]
    }
}

impl<S: Simd> Angular<S> for ComplexLanes<S> {
    const REAL: bool = false;

    #[inline(always)]
    fn on_circle(pair: [Self; 2]) -> [Self; 2] {
        // From the larger of e^(i q) and e^(-i q) both follow without cancellation.
        let (larger, is_minus) = pair.larger_exponential();
        let other = larger.inverse();
        let half = larger.re.like(0.5);
        let (sum, difference) = ((larger + other).times(half), (larger - other).times(half));
        // sin = -i (w - 1/w) / 2
        let sin = Self { re: difference.im, im: -difference.re };
        [sum, Self::selected(is_minus, -sin, sin)]
    }

    #[inline(always)]
    fn normalised([cos, sin]: [Self; 2]) -> [Self; 2] {
        let over = cos.mul_add(cos, sin * sin).root().inverse();
        Self::on_circle([cos * over, sin * over])
    }

    #[inline(always)]
    fn lengths(r: &[[Self; 3]; 3], t: &[Self; 3]) -> Lengths<S> {
        let one = t[0].re.like(1.0);
        let (mut norm, mut inverse) = (one, one);
        let at = [t[0].bound(), t[1].bound(), t[2].bound()];
        for j in 0..3 {
            norm = norm.max(r[j][0].bound() + r[j][1].bound() + r[j][2].bound() + at[j]);
            let back = r[0][j].mul_add(t[0], r[1][j].mul_add(t[1], r[2][j] * t[2]));
            inverse = inverse.max(r[0][j].bound() + r[1][j].bound() + r[2][j].bound() + back.bound());
        }
        let z = [r[0][2], r[1][2], r[2][2]];
        let moment = moment(t, &z);
        let size = [z[0].bound(), z[1].bound(), z[2].bound()];
        let twist = (size[1] + size[2] + moment[0].bound())
            .max(size[0] + size[2] + moment[1].bound())
            .max(size[0] + size[1] + moment[2].bound());
        let lever = (size[0] + size[1] + size[2]) * (one + at[0] + at[1] + at[2]);
        Lengths { norm, inverse, twist, lever }
    }

    #[inline(always)]
    fn off_circle(pair: [Self; 2]) -> Lanes<S> {
        // With w = e^(i q), the larger one, and c^2 + s^2 = 1 + x the other one is (1 + x)/w in place of 1/w: cosine and sine are off by
        // |x/w|/2 each, and their sizes add up to |w| at least. Of the square of the length, at most |w|^2 in all, eight half units are lost.
        let [cos, sin] = pair;
        let (larger, _) = pair.larger_exponential();
        let off = cos.mul_add(cos, sin * sin) - Self::of(cos.re.like(1.0));
        (off.bound() / larger.square_size() + cos.re.like(8.0 * f64::EPSILON)) * cos.re.like(1.5)
    }

    #[inline(always)]
    fn angle(pair: [Self; 2]) -> [Row; 2] {
        let (larger, is_minus) = pair.larger_exponential();
        let square = larger.square_size();
        let over = square.like(1.0) / square.sqrt();
        let turn = angle_of([larger.re * over, larger.im * over]);
        let (mut re, mut im, mut sign) = ([0.0; WIDTH], [0.0; WIDTH], [0.0; WIDTH]);
        is_minus.select(-turn, turn).store(&mut re, 0);
        square.store(&mut im, 0);
        is_minus.select(square.like(0.5), square.like(-0.5)).store(&mut sign, 0);
        for (x, half) in im.iter_mut().zip(sign).take(S::F64_LANES) {
            *x = half * x.ln();
        }
        [re, im]
    }
}

impl<S: Simd> ComplexLanes<S> {
    /// Returns cosine and sine of angles q, given `e^(i q)`.
    #[must_use]
    #[inline(always)]
    pub fn of_exponential(w: Self) -> [Self; 2] {
        let (half, back) = (w.re.like(0.5), w.inverse());
        let (sum, difference) = ((w + back).times(half), (w - back).times(half));
        // sin = -i (w - 1/w) / 2
        [sum, Self { re: difference.im, im: -difference.re }]
    }
}

/// Pairs of complex angles.
pub trait Exponential<S: Simd> {
    /// Returns the larger one of `e^(i q)` and `e^(-i q)`, which keeps its digits, and where it is the second one.
    fn larger_exponential(self) -> (ComplexLanes<S>, Mask<S>);
}

impl<S: Simd> Exponential<S> for [ComplexLanes<S>; 2] {
    #[inline(always)]
    fn larger_exponential(self) -> (ComplexLanes<S>, Mask<S>) {
        let [cos, sin] = self;
        let plus = ComplexLanes { re: cos.re - sin.im, im: cos.im + sin.re };
        let minus = ComplexLanes { re: cos.re + sin.im, im: cos.im - sin.re };
        let is_minus = plus.square_size().below(minus.square_size());
        (ComplexLanes::selected(is_minus, minus, plus), is_minus)
    }
}

/// `p x z`
#[inline(always)]
fn moment<S: Simd, N: LaneNumber<S>>(p: &[N; 3], z: &[N; 3]) -> [N; 3] {
    [z[1].mul_from(p[2], p[1] * z[2]), z[2].mul_from(p[0], p[2] * z[0]), z[0].mul_from(p[1], p[0] * z[1])]
}

impl<N> Frame<N> {
    /// `frame * constant`
    #[inline(always)]
    fn behind<S: Simd>(&self, constant: &Motion<f64>, one: Lanes<S>) -> Self
    where
        N: LaneNumber<S>,
    {
        let (r, g) = (&self.rotation, &constant.rotation);
        let mut next = Self { rotation: *r, translation: self.translation };
        for i in 0..3 {
            for j in 0..3 {
                let (a, b, c) = (one.like(g[0][j]), one.like(g[1][j]), one.like(g[2][j]));
                next.rotation[i][j] = r[i][2].times_plus(c, r[i][1].times_plus(b, r[i][0].times(a)));
            }
            let t = &constant.translation;
            let (a, b, c) = (one.like(t[0]), one.like(t[1]), one.like(t[2]));
            next.translation[i] =
                r[i][2].times_plus(c, r[i][1].times_plus(b, r[i][0].times_plus(a, self.translation[i])));
        }
        next
    }

    /// `frame * Rz`
    #[inline(always)]
    fn turn<S: Simd>(&mut self, [cos, sin]: [N; 2])
    where
        N: LaneNumber<S>,
    {
        for row in &mut self.rotation {
            let (x, y) = (row[0], row[1]);
            row[0] = x.mul_add(cos, y * sin);
            row[1] = x.mul_from(sin, y * cos);
        }
    }
}

/// Returns the closure of a loop of six rotations; `one` is 1 in every lane.
#[inline(always)]
pub fn lane_closure<S: Simd, N: Angular<S>>(
    constants: &[Motion<f64>; 6],
    pairs: &Pairs<N>,
    one: Lanes<S>,
) -> LaneClosure<S, N> {
    let zero = one.like(0.0);
    let mut jacobian = [[N::of(zero); 6]; 6];
    // The first frame is the identity.
    let first =
        Lengths { norm: one.like(ROOT_3), inverse: one.like(ROOT_3), twist: one.like(ROOT_2), lever: one.like(ROOT_3) };
    let mut lengths = [first; 7];
    // The first rotation turns the first constant from the left, about the z axis of the frame.
    jacobian[0][2] = N::of(one);
    let [cos, sin] = pairs[0];
    let first = &constants[0];
    let mut frame = Frame { rotation: [[N::of(zero); 3]; 3], translation: [N::of(zero); 3] };
    for j in 0..3 {
        let (x, y) = (one.like(first.rotation[0][j]), one.like(first.rotation[1][j]));
        frame.rotation[0][j] = cos.times(x) - sin.times(y);
        frame.rotation[1][j] = sin.times(x) + cos.times(y);
        frame.rotation[2][j] = N::of(one.like(first.rotation[2][j]));
    }
    let (x, y) = (one.like(first.translation[0]), one.like(first.translation[1]));
    frame.translation =
        [cos.times(x) - sin.times(y), sin.times(x) + cos.times(y), N::of(one.like(first.translation[2]))];
    for j in 1..6 {
        let z = [frame.rotation[0][2], frame.rotation[1][2], frame.rotation[2][2]];
        let about = moment(&frame.translation, &z);
        jacobian[j] = [z[0], z[1], z[2], about[0], about[1], about[2]];
        lengths[j] = N::lengths(&frame.rotation, &frame.translation);
        frame.turn(pairs[j]);
        frame = frame.behind(&constants[j], one);
    }
    lengths[6] = N::lengths(&frame.rotation, &frame.translation);
    let r = &frame.rotation;
    let half = one.like(0.5);
    let (mut turn, mut shift) = (zero, zero);
    for i in 0..3 {
        for j in 0..3 {
            let off = if i == j { r[i][j] - N::of(one) } else { r[i][j] };
            turn = larger(turn, off.bound());
        }
        shift = larger(shift, frame.translation[i].bound());
    }
    let [x, y, z] = frame.translation;
    let skew = [(r[2][1] - r[1][2]).times(half), (r[0][2] - r[2][0]).times(half), (r[1][0] - r[0][1]).times(half)];
    let residual = [skew[0], skew[1], skew[2], x, y, z];
    LaneClosure { residual, jacobian, turn, shift, lengths }
}

/// The larger number; y where x is NaN or y is. A NaN in x is lost here, and comes back with the residual: its row of the frame is NaN too.
#[inline(always)]
fn larger<S: Simd>(x: Lanes<S>, y: Lanes<S>) -> Lanes<S> {
    y.at_most(x).select(x, y)
}

/// Returns an approximate inverse of a matrix given by its columns, as rows: Gram and Schmidt's triangular factor, inverted.
#[inline(always)]
pub fn lane_inverse<S: Simd, N: LaneNumber<S>>(columns: &[[N; 6]; 6], one: Lanes<S>) -> [[N; 6]; 6] {
    let mut q = *columns;
    let mut factor = [[N::of(one); 6]; 6];
    let mut over = [one; 6];
    for j in 0..6 {
        let mut square = q[j][0].square_size();
        for i in 1..6 {
            square = q[j][i].square_plus(square);
        }
        over[j] = one / square.sqrt();
        for i in 0..6 {
            q[j][i] = q[j][i].times(over[j]);
        }
        for k in j + 1..6 {
            let mut dot = q[j][0].conj() * q[k][0];
            for i in 1..6 {
                dot = q[j][i].conj().mul_add(q[k][i], dot);
            }
            factor[j][k] = dot;
            for i in 0..6 {
                q[k][i] = dot.mul_from(q[j][i], q[k][i]);
            }
        }
    }
    for j in (0..6).rev() {
        for i in 0..6 {
            q[j][i] = q[j][i].conj();
        }
        for k in j + 1..6 {
            for i in 0..6 {
                q[j][i] = factor[j][k].mul_from(q[k][i], q[j][i]);
            }
        }
        for i in 0..6 {
            q[j][i] = q[j][i].times(over[j]);
        }
    }
    q
}

/// Returns cosine and sine of an angle off by a small one, subtracted, to fourth order, over their length.
#[inline(always)]
pub fn turned_back<S: Simd, N: Angular<S>>([cos, sin]: [N; 2], angle: N, one: Lanes<S>) -> [N; 2] {
    let square = angle * angle;
    let by_sin = angle * square.times_plus(one.like(-1.0 / 6.0), N::of(one));
    let by_cos = square.mul_add(square.times_plus(one.like(1.0 / 24.0), N::of(one.like(-0.5))), N::of(one));
    N::on_circle([cos.mul_add(by_cos, sin * by_sin), cos.mul_from(by_sin, sin * by_cos)])
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
