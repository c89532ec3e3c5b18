//! The equations of a cut at a pose and their brackets, side by side.
//!
//! A lane of a row is one of the eight equations as long as coefficients are made, and a place in the hidden angle from there on.

use super::lanes::{ComplexLanes, LaneNumber, Lanes, Row, WIDTH};
use crate::algebra::ring::Ring;
use crate::closure::woernle_lee::{FIXED, MarkedLine, TURNING_X, TURNING_Y, act, act_on_form, z_axis};
use crate::elimination::cut::Hidden;
use crate::kinematics::motion::Motion;
use pulp::Simd;

/// The coefficients of the equations of a cut as linear forms on the marked line of the closing transformation, side by side:
/// `[k1][k2]`, on the fixed coordinates for k1 = 0, on the turning ones for the others.
#[derive(Clone, Debug)]
pub struct LaneForms([[[Row; 8]; 3]; 3]);

/// The coefficients of the equations at a pose: those of `(1, c1, s1)[k1] (1, c2, s2)[k2]`.
pub type LaneBilinear = [[Row; 3]; 3];

/// The columns of the equations over `(1, cos, sin)` of the hidden angle, as `[l][k]`: four entries of column c_l, then four of d_l.
pub struct LaneEntries(pub [[Row; 3]; 3]);

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

/// The coefficients of the equations of a cut as forms on the marked line of the closing transformation, `[equation][k1][k2]`, from its rows
/// and the inverse of constant 1 of the cut.
#[must_use]
pub fn forms<R: Ring>(rows: &[MarkedLine<R>; 8], back: &Motion<R>) -> [[[MarkedLine<R>; 3]; 3]; 8] {
    std::array::from_fn(|e| {
        let by_second = parts(&rows[e]).map(|form| parts(&act_on_form(&form, back)));
        std::array::from_fn(|k1| std::array::from_fn(|k2| by_second[k2][k1].clone()))
    })
}

impl LaneForms {
    /// Returns these forms in lanes.
    #[must_use]
    pub fn new(forms: &[[[MarkedLine<f64>; 3]; 3]; 8]) -> Self {
        let value = |e: usize, k1: usize, k2: usize, i: usize| {
            // There are seven fixed coordinates; an eighth would be the last one again.
            if k1 == 0 && i == 7 { 0.0 } else { forms[e][k1][k2][coordinates(k1)[i]] }
        };
        Self(std::array::from_fn(|k1| {
            std::array::from_fn(|k2| std::array::from_fn(|i| std::array::from_fn(|e| value(e, k1, k2, i))))
        }))
    }

    /// Returns the coefficients at a pose, given the inverse of constant 6 of the cut, which is the closing transformation or its inverse.
    #[inline(always)]
    pub fn at_pose<S: Simd>(&self, simd: S, start: &Motion<f64>) -> LaneBilinear {
        let line = act(start, &z_axis());
        let mut coefficients = [[[0.0; WIDTH]; 3]; 3];
        for chunk in 0..Lanes::<S>::CHUNKS {
            let zero = Lanes::splat(simd, 0.0);
            for k1 in 0..3 {
                let count = if k1 == 0 { FIXED.len() } else { 8 };
                let mut sums = [zero; 3];
                for (i, at) in coordinates(k1).into_iter().enumerate().take(count) {
                    let x = zero.like(line[at]);
                    for k2 in 0..3 {
                        sums[k2] = x.fma(Lanes::load(simd, &self.0[k1][k2][i], chunk), sums[k2]);
                    }
                }
                for k2 in 0..3 {
                    sums[k2].store(&mut coefficients[k1][k2], chunk);
                }
            }
        }
        coefficients
    }
}

/// The columns c0, c1, c2, d0, d1, d2 of the brackets, by their numbers; in the determinant each of the first five is multiplied by the one
/// five places behind it, and the last one by itself.
pub const BRACKETS: [[usize; 4]; 11] = [
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

/// The columns at a hidden angle, up to a factor.
pub type At<N> = [[N; 4]; 6];

/// The brackets, determinants of four columns each.
pub struct Brackets<N>(pub [N; 11]);

impl LaneEntries {
    /// Returns the columns of bilinear equations.
    #[inline(always)]
    pub fn of<S: Simd>(simd: S, coefficients: &LaneBilinear, hidden: Hidden) -> Self {
        let mut entries = [[[0.0; WIDTH]; 3]; 3];
        for chunk in 0..Lanes::<S>::CHUNKS {
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
                (one + cos).store(&mut entries[0][k], chunk);
                (sin + sin).store(&mut entries[1][k], chunk);
                (one - cos).store(&mut entries[2][k], chunk);
            }
        }
        Self(entries)
    }

    /// Returns the columns at real hidden angles.
    #[inline(always)]
    pub fn at<S: Simd>(&self, [cos, sin]: [Lanes<S>; 2]) -> At<Lanes<S>> {
        let mut at = [[cos; 4]; 6];
        for l in 0..3 {
            for e in 0..WIDTH {
                let [one, c, s] = &self.0[l];
                at[3 * (e / 4) + l][e % 4] = sin.fma(sin.like(s[e]), cos.fma(cos.like(c[e]), cos.like(one[e])));
            }
        }
        at
    }

    /// Returns the columns at complex hidden angles q, given `w = e^(i q)`, times w.
    #[inline(always)]
    pub fn times_exponential<S: Simd>(&self, w: ComplexLanes<S>) -> At<ComplexLanes<S>> {
        let half = w.re.like(0.5);
        let square = w * w;
        // w cos q = (w^2 + 1) / 2 and w sin q = -i (w^2 - 1) / 2
        let cos = ComplexLanes { re: square.re.fma(half, half), im: square.im * half };
        let sin = ComplexLanes { re: cos.im, im: half - square.re * half };
        let mut at = [[w; 4]; 6];
        for l in 0..3 {
            for e in 0..WIDTH {
                let [one, c, s] = &self.0[l];
                let (one, c, s) = (half.like(one[e]), half.like(c[e]), half.like(s[e]));
                at[3 * (e / 4) + l][e % 4] = sin.times_plus(s, cos.times_plus(c, w.times(one)));
            }
        }
        at
    }

    /// Returns the determinant at real hidden angles.
    #[inline(always)]
    pub fn determinants<S: Simd, const K: usize>(&self, simd: S, cos: &[f64; K], sin: &[f64; K]) -> [f64; K] {
        let mut values = [0.0; K];
        for chunk in 0..K / S::F64_LANES {
            let at = self.at([Lanes::load(simd, cos, chunk), Lanes::load(simd, sin, chunk)]);
            Brackets::of(&at).determinant().store(&mut values, chunk);
        }
        values
    }
}

/// The place of the pair of columns i < j among all fifteen.
#[inline(always)]
#[must_use]
pub const fn pair(i: usize, j: usize) -> usize {
    5 * i - i * i.saturating_sub(1) / 2 + j - i - 1
}

/// Minors of two rows of the columns, or their sizes, by [`pair`].
pub type Minors<N> = [N; 15];

#[inline(always)]
fn minor<S: Simd, N: LaneNumber<S>>(columns: &At<N>, row: usize, i: usize, j: usize) -> N {
    let (a, b) = (&columns[i], &columns[j]);
    a[row + 1].mul_from(b[row], a[row] * b[row + 1])
}

/// Returns the minors of two rows of the columns.
#[inline(always)]
pub fn minors<S: Simd, N: LaneNumber<S>>(columns: &At<N>, row: usize) -> Minors<N> {
    [
        minor::<S, N>(columns, row, 0, 1),
        minor::<S, N>(columns, row, 0, 2),
        minor::<S, N>(columns, row, 0, 3),
        minor::<S, N>(columns, row, 0, 4),
        minor::<S, N>(columns, row, 0, 5),
        minor::<S, N>(columns, row, 1, 2),
        minor::<S, N>(columns, row, 1, 3),
        minor::<S, N>(columns, row, 1, 4),
        minor::<S, N>(columns, row, 1, 5),
        minor::<S, N>(columns, row, 2, 3),
        minor::<S, N>(columns, row, 2, 4),
        minor::<S, N>(columns, row, 2, 5),
        minor::<S, N>(columns, row, 3, 4),
        minor::<S, N>(columns, row, 3, 5),
        minor::<S, N>(columns, row, 4, 5),
    ]
}

/// Returns the determinant of four columns from their minors of rows 0, 1 and of rows 2, 3.
#[inline(always)]
fn bracket<S: Simd, N: LaneNumber<S>>([u, v]: [&Minors<N>; 2], [a, b, c, d]: [usize; 4]) -> N {
    let plus = u[pair(a, b)].mul_add(v[pair(c, d)], u[pair(a, d)] * v[pair(b, c)]);
    let other = u[pair(b, c)].mul_add(v[pair(a, d)], u[pair(c, d)] * v[pair(a, b)]);
    let minus = u[pair(a, c)].mul_add(v[pair(b, d)], u[pair(b, d)] * v[pair(a, c)]);
    plus + other - minus
}

impl<N: Copy> Brackets<N> {
    /// Returns the brackets of columns.
    #[inline(always)]
    pub fn of<S: Simd>(columns: &At<N>) -> Self
    where
        N: LaneNumber<S>,
    {
        Self::of_minors::<S>([&minors::<S, N>(columns, 0), &minors::<S, N>(columns, 2)])
    }

    /// Returns the brackets of columns from their minors of rows 0, 1 and of rows 2, 3.
    #[inline(always)]
    pub fn of_minors<S: Simd>(minors: [&Minors<N>; 2]) -> Self
    where
        N: LaneNumber<S>,
    {
        Self([
            bracket::<S, N>(minors, BRACKETS[0]),
            bracket::<S, N>(minors, BRACKETS[1]),
            bracket::<S, N>(minors, BRACKETS[2]),
            bracket::<S, N>(minors, BRACKETS[3]),
            bracket::<S, N>(minors, BRACKETS[4]),
            bracket::<S, N>(minors, BRACKETS[5]),
            bracket::<S, N>(minors, BRACKETS[6]),
            bracket::<S, N>(minors, BRACKETS[7]),
            bracket::<S, N>(minors, BRACKETS[8]),
            bracket::<S, N>(minors, BRACKETS[9]),
            bracket::<S, N>(minors, BRACKETS[10]),
        ])
    }

    /// Returns the determinant of [`brackets`](crate::elimination::brackets).
    #[inline(always)]
    pub fn determinant<S: Simd>(&self) -> N
    where
        N: LaneNumber<S>,
    {
        let b = &self.0;
        let plus = b[0].mul_add(b[5], b[10] * b[10]);
        let minus = b[1].mul_add(b[6], b[2] * b[7]);
        plus - b[3].mul_add(b[8], b[4].mul_add(b[9], minus))
    }

    /// Returns the kernel `(1, z) x (1, x3)` up to a factor where the determinant is zero, z and x3 being half-tangents of the other unknown
    /// and of unknown 3.
    ///
    /// With `y_k = z^k (1, x3)` the four equations are `C0 y0 + C1 y1 + C2 y2 = 0`, `C_l` having the columns c_l and d_l, and so are
    /// `C0 y1 + C1 y2 + C2 y3 = 0`. What is left of them modulo the columns of C0, and of C2, are two skew forms that vanish at
    /// `(y1, y2)`: lines of the projective space, which meet where the determinant is zero.
    #[inline(always)]
    pub fn kernel<S: Simd>(&self, zero: Lanes<S>) -> [N; 4]
    where
        N: LaneNumber<S>,
    {
        let [b0134, b0123, b0135, b0234, b0345, b1245, b2345, b1235, b0245, b0125, b0235] = self.0;
        let (none, zero) = (zero, N::of(zero));
        // The dual of the form [0 3 . .] over columns 1, 4, 2, 5.
        let [a12, a13, a14, a23, a24, a34] = [-b0235, -b0345, b0234, -b0135, -b0123, -b0134];
        let dual = [[zero, a12, a13, a14], [-a12, zero, a23, a24], [-a13, -a23, zero, a34], [-a14, -a24, -a34, zero]];
        // The form [2 5 . .] over columns 0, 3, 1, 4.
        let [b12, b13, b14, b23, b24, b34] = [-b0235, b0125, -b0245, b1235, b2345, -b1245];
        let form = [[zero, b12, b13, b14], [-b12, zero, b23, b24], [-b13, -b23, zero, b34], [-b14, -b24, -b34, zero]];
        let mut best = [zero; 4];
        let mut most = none;
        for i in 0..4 {
            let mut column = [zero; 4];
            let mut square = none;
            for j in 0..4 {
                for k in 0..4 {
                    if j != k && k != i {
                        column[j] = dual[j][k].mul_add(form[k][i], column[j]);
                    }
                }
                square = column[j].square_plus(square);
            }
            let is_larger = most.below(square);
            most = is_larger.select(square, most);
            for j in 0..4 {
                best[j] = N::selected(is_larger, column[j], best[j]);
            }
        }
        best
    }
}
