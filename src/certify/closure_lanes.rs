//! The determinant of [`closure_zeros`](super::closure_zeros) at all samples side by side, with one bound of its error for all of them.
//!
//! The entries of the columns have bounds made once per pose, from norms of the blocks of a marked line and of a row (its direction, its
//! point, ...), by Cauchy's inequality: norms are those of the exact quantities, beside each stands a bound of the distance of what is
//! computed. From the entries on an error is carried beside every number. Formulas are the same with and without fused multiply-add:
//! bounds hold for both.

use super::circle_lanes::directions;
use super::circle_zeros::{SAMPLE_ERROR, SAMPLES};
use super::closure_zeros::CONSTANT;
use crate::algebra::bounded::{Bounded, Floating};
use crate::algebra::ring::Ring;
use crate::closure::woernle_lee::{FIXED, MarkedLine, TURNING_X, TURNING_Y, act, act_on_form, z_axis};
use crate::elimination::cut::Hidden;
use crate::kinematics::motion::Motion;
use crate::solve::lanes::{Lanes, Row, WIDTH};
use pulp::Simd;

/// Half a unit in the last place of 1.
const ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// The root of 3 and a margin: the length of three errors of the same size.
const ROOT_3: f64 = 1.7321;
/// The blocks of a marked line: 1, direction, point, two products, moment, reflected direction.
const BLOCKS: [std::ops::Range<usize>; 7] = [0..1, 1..4, 4..7, 7..8, 8..9, 9..12, 12..15];
/// What bounds leave out: products of two errors, and their own roundings.
const MARGIN: f64 = 1.01;
/// Motions less exact than this prove nothing: products of two errors would count.
const INEXACT: f64 = 1e-3;

/// The coefficients of the equations of a cut as linear forms on the marked line of the closing transformation, side by side.
#[derive(Clone, Debug)]
pub struct LaneRows {
    /// `[k1][k2]`: the coefficients on the fixed coordinates for k1 = 0, on the turning ones for the others.
    forms: [[[Row; 8]; 3]; 3],
    /// The largest lengths of the blocks of the nine forms of an equation, and the largest bounds of their errors.
    sizes: [Row; 7],
    errors: [Row; 7],
}

/// The columns of the equations of a cut over `(1, cos, sin)` of the hidden angle, and what bounds the determinant.
pub struct LaneColumns {
    /// `[l][k]`: four entries of column c_l, then four of d_l.
    pub entries: [[Row; 3]; 3],
    /// Bounds of the errors of the minors of rows 0, 1 and of rows 2, 3 as factors of a sum of products, at all hidden angles.
    errors: [[f64; 15]; 2],
}

/// A linear form on the three parts of `T(V^-1) v` for a rotation V: see [`split_inverse`](crate::closure::woernle_lee::split_inverse).
fn parts<R: Ring>(form: &MarkedLine<R>) -> [MarkedLine<R>; 3] {
    let zero = || std::array::from_fn(|_| R::zero());
    let mut parts: [MarkedLine<R>; 3] = [zero(), zero(), zero()];
    for i in FIXED {
        parts[0][i] = form[i].clone();
    }
    for (x, y) in TURNING_X.into_iter().zip(TURNING_Y) {
        (parts[1][x], parts[1][y]) = (form[x].clone(), form[y].clone());
        (parts[2][x], parts[2][y]) = (form[y].neg(), form[x].clone());
    }
    parts
}

/// The coordinates on which a part of a form does not vanish.
const fn coordinates(part: usize) -> [usize; 8] {
    if part == 0 { [0, 3, 6, 7, 8, 11, 14, 14] } else { [1, 2, 4, 5, 9, 10, 12, 13] }
}

impl LaneRows {
    /// Returns the forms of exact rows, enclosed, and the inverse of constant 1 of the cut.
    #[must_use]
    pub fn new<T: Floating>(rows: &[MarkedLine<Bounded<T>>; 8], back: &Motion<Bounded<T>>) -> Self {
        let forms: [[[MarkedLine<Bounded<f64>>; 3]; 3]; 8] = std::array::from_fn(|e| {
            let by_second = parts(&rows[e]).map(|form| parts(&act_on_form(&form, back)));
            std::array::from_fn(|k1| std::array::from_fn(|k2| by_second[k2][k1].map(Bounded::in_f64)))
        });
        let length = |x: &[Bounded<f64>], of: fn(Bounded<f64>) -> f64| {
            1.01 * x.iter().map(|x| of(*x).powi(2)).sum::<f64>().sqrt()
        };
        let block = |b: usize, of: fn(Bounded<f64>) -> f64| {
            std::array::from_fn(|e| largest(forms[e].iter().flatten().map(|form| length(&form[BLOCKS[b].clone()], of))))
        };
        let value = |e: usize, k1: usize, k2: usize, i: usize| {
            // There are seven fixed coordinates; an eighth would be the last one again.
            if k1 == 0 && i == 7 { 0.0 } else { forms[e][k1][k2][coordinates(k1)[i]].value }
        };
        Self {
            forms: std::array::from_fn(|k1| {
                std::array::from_fn(|k2| std::array::from_fn(|i| std::array::from_fn(|e| value(e, k1, k2, i))))
            }),
            sizes: std::array::from_fn(|b| block(b, Bounded::size)),
            errors: std::array::from_fn(|b| block(b, Bounded::error)),
        }
    }

    /// Returns the columns of the equations at a pose, given the inverse of constant 6 of the cut, which is the closing transformation or its
    /// inverse as computed in f64. The longest translation of the loop, and a bound of the row-sum norm of what the closing transformation is
    /// off beyond the roundings of a constant, are for the errors.
    #[inline(always)]
    pub fn columns<S: Simd>(
        &self,
        simd: S,
        start: &Motion<f64>,
        [longest, off]: [f64; 2],
        hidden: Hidden,
    ) -> LaneColumns {
        let line = act(start, &z_axis());
        let (bounds, is_exact) = wrong_blocks(start, longest, off);
        let mut coefficients = [[[0.0; WIDTH]; 3]; 3];
        let mut errors = [0.0; WIDTH];
        for chunk in 0..Lanes::<S>::CHUNKS {
            let zero = Lanes::splat(simd, 0.0);
            for k1 in 0..3 {
                let count = if k1 == 0 { FIXED.len() } else { 8 };
                let mut sums = [zero; 3];
                for (i, at) in coordinates(k1).into_iter().enumerate().take(count) {
                    let x = zero.like(line[at]);
                    for k2 in 0..3 {
                        sums[k2] = x.fma(Lanes::load(simd, &self.forms[k1][k2][i], chunk), sums[k2]);
                    }
                }
                for k2 in 0..3 {
                    sums[k2].store(&mut coefficients[k1][k2], chunk);
                }
            }
            let mut error = zero;
            for (b, [size, wrong]) in bounds.into_iter().enumerate() {
                // A sum of eight products, of two numbers that are rounded once.
                error = Lanes::load(simd, &self.sizes[b], chunk).fma(zero.like(wrong + 10.0 * ROUNDOFF * size), error);
                error = Lanes::load(simd, &self.errors[b], chunk).fma(zero.like(size), error);
            }
            error = error * zero.like(if is_exact { MARGIN } else { f64::NAN });
            error.store(&mut errors, chunk);
        }
        columns(simd, &coefficients, &errors, hidden)
    }
}

/// Returns bounds of the lengths of the blocks of the marked line of a motion, and of their errors, and whether these are small.
#[inline(always)]
fn wrong_blocks(start: &Motion<f64>, longest: f64, off: f64) -> ([[f64; 2]; 7], bool) {
    let t = &start.translation;
    let computed = 1.01 * (t[0] * t[0] + t[1] * t[1] + t[2] * t[2]).sqrt();
    // Nine entries of a rotation, of which the direction is a column, and three of a translation. If that of the closing transformation is
    // turned back, so are its errors, and each entry is a sum of three products.
    let entry = CONSTANT * ROUNDOFF + off;
    let direction = ROOT_3 * entry;
    let point = ROOT_3 * (CONSTANT * ROUNDOFF * (1.0 + longest) + off) + (3.0 * entry + 6.0 * ROUNDOFF) * computed;
    let size = computed + point;
    let both = point + size * direction + 4.0 * ROUNDOFF * size;
    let bounds = [
        [1.0, 0.0],
        [1.0, direction],
        [size, point],
        [size, both],
        [size * size, size * (2.0 * point + 4.0 * ROUNDOFF * size)],
        [size, both],
        // The direction times the square of the point, less twice the point times their product.
        [size * size, size * (6.0 * point + 3.0 * size * direction + 16.0 * ROUNDOFF * size)],
    ];
    (bounds, entry < INEXACT && point <= INEXACT * (1.0 + size))
}

/// Returns the columns of bilinear equations whose coefficients are off by these errors.
#[inline(always)]
fn columns<S: Simd>(simd: S, coefficients: &[[Row; 3]; 3], errors: &Row, hidden: Hidden) -> LaneColumns {
    let mut entries = [[[0.0; WIDTH]; 3]; 3];
    // The largest sizes of the entries on the circle, and bounds of their errors.
    let (mut sizes, mut wrongs) = ([[0.0; WIDTH]; 3], [[0.0; WIDTH]; 3]);
    for chunk in 0..Lanes::<S>::CHUNKS {
        let zero = Lanes::splat(simd, 0.0);
        let own = Lanes::load(simd, errors, chunk);
        let mut all = [[zero; 3]; 3];
        for k in 0..3 {
            let rows = match hidden {
                Hidden::First => [&coefficients[k][0], &coefficients[k][1], &coefficients[k][2]],
                Hidden::Second => [&coefficients[0][k], &coefficients[1][k], &coefficients[2][k]],
            };
            let [one, cos, sin] = [
                Lanes::load(simd, rows[0], chunk),
                Lanes::load(simd, rows[1], chunk),
                Lanes::load(simd, rows[2], chunk),
            ];
            (all[0][k], all[1][k], all[2][k]) = (one + cos, sin + sin, one - cos);
        }
        for (l, [constant, cos, sin]) in all.into_iter().enumerate() {
            for (k, value) in [constant, cos, sin].into_iter().enumerate() {
                value.store(&mut entries[l][k], chunk);
            }
            // Two coefficients make an entry, and |1| + |cos| + |sin| is at most 1 + sqrt(2). The terms of an entry are rounded five times,
            // and cosine and sine are off by two units.
            let sum = constant.abs() + cos.abs() + sin.abs();
            let wrong = own.fma(zero.like(2.0 * 2.415), sum * zero.like(10.0 * ROUNDOFF + SAMPLE_ERROR));
            wrong.store(&mut wrongs[l], chunk);
            // With the error, and a margin for the root.
            (constant.abs() + cos.fma(cos, sin * sin).sqrt() * zero.like(MARGIN) + wrong).store(&mut sizes[l], chunk);
        }
    }
    LaneColumns { entries, errors: [wrong_minors(&sizes, &wrongs, 0), wrong_minors(&sizes, &wrongs, 2)] }
}

/// The columns c0, c1, c2, d0, d1, d2 of the brackets, by their numbers; in the determinant each of the first five is multiplied by the one
/// five places behind it, and the last one by itself.
const BRACKETS: [[usize; 4]; 11] = [
    [0, 1, 3, 4],
    [0, 1, 2, 3],
    [0, 1, 3, 5],
    [0, 2, 3, 4],
    [0, 3, 4, 5],
    [1, 2, 4, 5],
    [2, 3, 4, 5],
    [1, 2, 3, 5],
    [0, 2, 4, 5],
    [0, 1, 2, 5],
    [0, 2, 3, 5],
];
/// Half roundings that are added to the error of each factor in a sum of products, in parts of the factor: with those of the other factor they
/// are the rounding of the product and those of six sums.
const FACTOR: f64 = 4.0;
/// More than a product loses by underflow.
const TINY: f64 = 1e-280;

/// The columns at a hidden angle.
pub type At<S> = [[Lanes<S>; 4]; 6];

/// The brackets, determinants of four columns each.
pub struct Brackets<S: Simd>([Lanes<S>; 11]);

impl LaneColumns {
    /// Returns the columns at hidden angles.
    #[inline(always)]
    pub fn at<S: Simd>(&self, cos: Lanes<S>, sin: Lanes<S>) -> At<S> {
        let mut at = [[cos; 4]; 6];
        for l in 0..3 {
            for e in 0..WIDTH {
                let [one, c, s] = &self.entries[l];
                at[3 * (e / 4) + l][e % 4] = sin.fma(sin.like(s[e]), cos.fma(cos.like(c[e]), cos.like(one[e])));
            }
        }
        at
    }

    /// Returns the determinant at the samples, a bound of its error, NaN where there is none, and the size of the largest value.
    #[inline(always)]
    pub fn values<S: Simd>(&self, simd: S) -> ([f64; SAMPLES], [f64; 2]) {
        let (cos, sin) = directions();
        let (mut values, mut errors) = ([0.0; SAMPLES], [0.0; SAMPLES]);
        for chunk in 0..SAMPLES / S::F64_LANES {
            let at = self.at(Lanes::load(simd, cos, chunk), Lanes::load(simd, sin, chunk));
            let (u, v) = (minors(&at, 0), minors(&at, 2));
            let brackets = Brackets::of_minors([&u, &v]);
            brackets.determinant().store(&mut values, chunk);
            self.error([&u, &v], &brackets).store(&mut errors, chunk);
        }
        // NaN stays.
        let larger = |most: f64, x: &f64| if x.abs() <= most || most.is_nan() { most } else { x.abs() };
        let most = |of: &[f64; SAMPLES]| of.iter().fold(0.0, larger);
        let bounds = [most(&errors), most(&values)];
        (values, bounds)
    }
}

/// The place of the pair of columns i < j among all fifteen.
#[inline(always)]
const fn pair(i: usize, j: usize) -> usize {
    5 * i - i * i.saturating_sub(1) / 2 + j - i - 1
}

/// Returns bounds of the errors of the minors of two rows, with half the roundings of a sum of products of them, from the sizes of the entries
/// and their errors.
#[inline(always)]
fn wrong_minors(sizes: &[Row; 3], wrongs: &[Row; 3], row: usize) -> [f64; 15] {
    let mut minors = [0.0; 15];
    for i in 0..5 {
        for j in i + 1..6 {
            let (k, l) = (4 * (i / 3) + row, 4 * (j / 3) + row);
            let (a, b) = ([sizes[i % 3][k], sizes[i % 3][k + 1]], [sizes[j % 3][l], sizes[j % 3][l + 1]]);
            let (da, db) = ([wrongs[i % 3][k], wrongs[i % 3][k + 1]], [wrongs[j % 3][l], wrongs[j % 3][l + 1]]);
            let moved = a[0] * db[1] + da[0] * b[1] + a[1] * db[0] + da[1] * b[0];
            // Each product and their difference are rounded: two units of the sizes.
            minors[pair(i, j)] = MARGIN * (moved + (2.0 + FACTOR) * ROUNDOFF * (a[0] * b[1] + a[1] * b[0])) + TINY;
        }
    }
    minors
}

/// Minors of two rows of the columns, or their sizes, by [`pair`].
type Minors<S> = [Lanes<S>; 15];

#[inline(always)]
fn minor<S: Simd>(columns: &At<S>, row: usize, i: usize, j: usize) -> Lanes<S> {
    let (a, b) = (&columns[i], &columns[j]);
    a[row + 1].subtracted_from(b[row], a[row] * b[row + 1])
}

/// Returns the minors of two rows of the columns.
#[inline(always)]
fn minors<S: Simd>(columns: &At<S>, row: usize) -> Minors<S> {
    [
        minor(columns, row, 0, 1),
        minor(columns, row, 0, 2),
        minor(columns, row, 0, 3),
        minor(columns, row, 0, 4),
        minor(columns, row, 0, 5),
        minor(columns, row, 1, 2),
        minor(columns, row, 1, 3),
        minor(columns, row, 1, 4),
        minor(columns, row, 1, 5),
        minor(columns, row, 2, 3),
        minor(columns, row, 2, 4),
        minor(columns, row, 2, 5),
        minor(columns, row, 3, 4),
        minor(columns, row, 3, 5),
        minor(columns, row, 4, 5),
    ]
}

/// Returns the determinant of four columns from their minors of rows 0, 1 and of rows 2, 3.
#[inline(always)]
fn bracket<S: Simd>([u, v]: [&Minors<S>; 2], [a, b, c, d]: [usize; 4]) -> Lanes<S> {
    let plus = u[pair(a, b)].fma(v[pair(c, d)], u[pair(a, d)] * v[pair(b, c)]);
    let other = u[pair(b, c)].fma(v[pair(a, d)], u[pair(c, d)] * v[pair(a, b)]);
    let minus = u[pair(a, c)].fma(v[pair(b, d)], u[pair(b, d)] * v[pair(a, c)]);
    plus + other - minus
}

/// Returns a bound of the error of a bracket, with half the roundings of a sum of products, from the sizes of the minors and their errors.
#[inline(always)]
fn wrong<S: Simd>(
    size: Lanes<S>,
    [u, v]: [&Minors<S>; 2],
    [du, dv]: &[[f64; 15]; 2],
    [a, b, c, d]: [usize; 4],
) -> Lanes<S> {
    let mut both = TINY;
    let mut sums = [size.abs() * size.like(FACTOR * ROUNDOFF), size.like(0.0)];
    for (i, j) in [
        (pair(a, b), pair(c, d)),
        (pair(a, c), pair(b, d)),
        (pair(a, d), pair(b, c)),
        (pair(b, c), pair(a, d)),
        (pair(b, d), pair(a, c)),
        (pair(c, d), pair(a, b)),
    ] {
        sums = [u[i].fma(size.like(dv[j]), sums[0]), v[j].fma(size.like(du[i]), sums[1])];
        both += du[i] * dv[j];
    }
    sums[0] + sums[1] + size.like(both)
}

impl LaneColumns {
    /// Returns a bound of the error of the determinant at hidden angles.
    #[inline(always)]
    fn error<S: Simd>(&self, [u, v]: [&Minors<S>; 2], brackets: &Brackets<S>) -> Lanes<S> {
        let (mut size_u, mut size_v) = (*u, *v);
        for k in 0..15 {
            (size_u[k], size_v[k]) = (u[k].abs(), v[k].abs());
        }
        let sizes = [&size_u, &size_v];
        let (b, e) = (&brackets.0, &self.errors);
        let mut sum = b[0].like(0.0);
        sum = wrong_product([b[0], b[5]], [BRACKETS[0], BRACKETS[5]], sizes, e, sum);
        sum = wrong_product([b[1], b[6]], [BRACKETS[1], BRACKETS[6]], sizes, e, sum);
        sum = wrong_product([b[2], b[7]], [BRACKETS[2], BRACKETS[7]], sizes, e, sum);
        sum = wrong_product([b[3], b[8]], [BRACKETS[3], BRACKETS[8]], sizes, e, sum);
        sum = wrong_product([b[4], b[9]], [BRACKETS[4], BRACKETS[9]], sizes, e, sum);
        sum = wrong_product([b[10], b[10]], [BRACKETS[10], BRACKETS[10]], sizes, e, sum);
        sum.fma(sum.like(MARGIN), sum.like(TINY))
    }
}

/// Returns `sum` and the error of a product of two brackets.
#[inline(always)]
fn wrong_product<S: Simd>(
    brackets: [Lanes<S>; 2],
    columns: [[usize; 4]; 2],
    sizes: [&Minors<S>; 2],
    errors: &[[f64; 15]; 2],
    sum: Lanes<S>,
) -> Lanes<S> {
    let one = wrong(brackets[0], sizes, errors, columns[0]);
    let other = wrong(brackets[1], sizes, errors, columns[1]);
    (brackets[0].abs() + one).fma(other, brackets[1].abs().fma(one, sum))
}

impl<S: Simd> Brackets<S> {
    /// Returns the brackets of columns.
    #[inline(always)]
    pub fn of(columns: &At<S>) -> Self {
        Self::of_minors([&minors(columns, 0), &minors(columns, 2)])
    }

    #[inline(always)]
    fn of_minors(minors: [&Minors<S>; 2]) -> Self {
        Self([
            bracket(minors, BRACKETS[0]),
            bracket(minors, BRACKETS[1]),
            bracket(minors, BRACKETS[2]),
            bracket(minors, BRACKETS[3]),
            bracket(minors, BRACKETS[4]),
            bracket(minors, BRACKETS[5]),
            bracket(minors, BRACKETS[6]),
            bracket(minors, BRACKETS[7]),
            bracket(minors, BRACKETS[8]),
            bracket(minors, BRACKETS[9]),
            bracket(minors, BRACKETS[10]),
        ])
    }

    /// Returns the determinant of [`brackets`](crate::elimination::brackets).
    #[inline(always)]
    pub fn determinant(&self) -> Lanes<S> {
        let b = &self.0;
        let plus = b[0].fma(b[5], b[10] * b[10]);
        let minus = b[1].fma(b[6], b[2] * b[7]);
        plus - b[3].fma(b[8], b[4].fma(b[9], minus))
    }

    /// Returns the kernel `(1, z) x (1, x3)` up to a factor where the determinant is zero, z and x3 being half-tangents of the other unknown
    /// and of unknown 3.
    ///
    /// With `y_k = z^k (1, x3)` the four equations are `C0 y0 + C1 y1 + C2 y2 = 0`, `C_l` having the columns c_l and d_l, and so are
    /// `C0 y1 + C1 y2 + C2 y3 = 0`. What is left of them modulo the columns of C0, and of C2, are two skew forms that vanish at
    /// `(y1, y2)`: lines of the projective space, which meet where the determinant is zero.
    #[inline(always)]
    pub fn kernel(&self) -> [Lanes<S>; 4] {
        let [b0134, b0123, b0135, b0234, b0345, b1245, b2345, b1235, b0245, b0125, b0235] = self.0;
        let zero = b0123.like(0.0);
        // The dual of the form [0 3 . .] over columns 1, 4, 2, 5.
        let [a12, a13, a14, a23, a24, a34] = [-b0235, -b0345, b0234, -b0135, -b0123, -b0134];
        let dual = [[zero, a12, a13, a14], [-a12, zero, a23, a24], [-a13, -a23, zero, a34], [-a14, -a24, -a34, zero]];
        // The form [2 5 . .] over columns 0, 3, 1, 4.
        let [b12, b13, b14, b23, b24, b34] = [-b0235, b0125, -b0245, b1235, b2345, -b1245];
        let form = [[zero, b12, b13, b14], [-b12, zero, b23, b24], [-b13, -b23, zero, b34], [-b14, -b24, -b34, zero]];
        let mut best = [zero; 4];
        let mut most = zero;
        for i in 0..4 {
            let mut column = [zero; 4];
            let mut square = zero;
            for j in 0..4 {
                for k in 0..4 {
                    if j != k && k != i {
                        column[j] = dual[j][k].fma(form[k][i], column[j]);
                    }
                }
                square = column[j].fma(column[j], square);
            }
            let is_larger = most.below(square);
            most = is_larger.select(square, most);
            for j in 0..4 {
                best[j] = is_larger.select(column[j], best[j]);
            }
        }
        best
    }
}

/// Returns the largest of some numbers that are not negative, NaN where one is: nothing is bounded then.
fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, |largest, x| if x.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(x) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::double_double::DoubleDouble;
    use crate::certify::closure_zeros::EnclosedRows;
    use crate::closure::half_angle::half_angle_form;
    use crate::elimination::brackets;
    use crate::elimination::cut::Cut;
    use crate::elimination::pencil::{before_second_link, bilinear};
    use crate::kinematics::closed_loop::{ClosedLoop, Variable};
    use pulp::{Arch, Scalar, WithSimd};
    use rand::{Rng, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    type Values = ([f64; SAMPLES], [f64; 2]);

    struct OfPose<'a>(&'a LaneRows, Motion<f64>, f64, Hidden);

    impl WithSimd for OfPose<'_> {
        type Output = Values;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Values {
            self.0.columns(simd, &self.1, [self.2, 0.0], self.3).values(simd)
        }
    }

    #[test]
    fn determinants_are_within_their_bounds() {
        let mut random = ChaCha8Rng::seed_from_u64(8);
        let (mut nearest, mut widest) = (0.0_f64, 0.0_f64);
        for _ in 0..40 {
            let mut motion = || {
                let mut angle = || random.random_range(-3.0..3.0_f64);
                let turned = Motion::rotation_x(angle().cos(), angle().sin());
                let (c, s) = (turned.rotation[1][1], turned.rotation[2][1]);
                let norm = (c * c + s * s).sqrt();
                let (one, other) = (angle(), angle());
                let both = Motion::rotation_x(c / norm, s / norm).then_after(&Motion::rotation_z(one.cos(), one.sin()));
                let mut motion = both.then_after(&Motion::rotation_x(other.cos(), other.sin()));
                motion.translation = [angle(), angle(), angle()];
                motion
            };
            let constants: [Motion<f64>; 6] = std::array::from_fn(|_| motion());
            let closed = ClosedLoop { variables: [Variable::Rotation; 6], constants };
            let longest = closed.constants.iter().flat_map(|m| m.translation).fold(0.0, |a: f64, x| a.max(x.abs()));
            let long = |motion: &Motion<f64>| Motion {
                rotation: motion.rotation.map(|row| row.map(DoubleDouble::from)),
                translation: motion.translation.map(DoubleDouble::from),
            };
            let exact = ClosedLoop { variables: closed.variables, constants: closed.constants.each_ref().map(long) };
            for cut in [Cut { rotation: 0, reversed: false }, Cut { rotation: 0, reversed: true }] {
                let (Some(rows), Some(form)) = (EnclosedRows::of(cut, &exact), half_angle_form(&cut.of(&exact))) else {
                    continue;
                };
                let lanes = rows.lanes.as_ref().unwrap();
                let view = cut.of(&exact);
                let own = before_second_link(&form, &view.constants[1]);
                for hidden in [Hidden::First, Hidden::Second] {
                    let gap = &closed.constants[5];
                    let start = if cut.reversed { gap.clone() } else { gap.inverse() };
                    let (values, [error, largest]) =
                        Arch::new().dispatch(OfPose(lanes, start.clone(), longest, hidden));
                    assert!(error < 1e-3 * largest, "{error} of {largest}");
                    let (one_by_one, [bound, _]) = Scalar.vectorize(OfPose(lanes, start, longest, hidden));
                    let apart = |(x, y): (&f64, &f64)| (x - y).abs() <= error + bound;
                    assert!(values.iter().zip(&one_by_one).all(apart) && bound < 1.01 * error);
                    // Every loop whose closing transformation is within the roundings of a constant is meant.
                    let mut near = exact.clone();
                    for x in near.constants[5].rotation.iter_mut().flatten() {
                        *x = x.add(&DoubleDouble::from(random.random_range(-1.0..1.0) * CONSTANT * ROUNDOFF));
                    }
                    for x in &mut near.constants[5].translation {
                        *x = x.add(&DoubleDouble::from(
                            random.random_range(-1.0..1.0) * CONSTANT * ROUNDOFF * (1.0 + longest),
                        ));
                    }
                    let columns = brackets::columns(&bilinear(&own, &cut.of(&near)), hidden);
                    let (cos, sin) = directions();
                    for k in 0..SAMPLES {
                        let at = brackets::at(&columns, &DoubleDouble::from(cos[k]), &DoubleDouble::from(sin[k]));
                        let off = brackets::determinant(&at).sub(&DoubleDouble::from(values[k])).to_f64().abs();
                        assert!(off <= error, "sample {k} of {cut:?}: {off} is more than {error}");
                        nearest = nearest.max(off / error);
                    }
                    widest = widest.max(error / largest);
                }
            }
        }
        // The bound is used: errors come within a thousandth of it.
        assert!(nearest > 1e-3 && widest > 0.0, "{nearest}, {widest}");
    }
}
