//! The real solutions of one pose with their proofs, side by side in vector registers.
//!
//! The steps are those of [`real_list`](super::real_list): all zeros of a determinant on the circle of a hidden angle, at each of them the
//! kernel and the other angles. Then [every solution is polished and certified](super::lane_finish). Where a step is not certain, nothing is
//! said.

use super::lane_finish::{Finish, Found};
use super::mode::Assembly;
use super::prepared::PreparedCut;
use super::real_list::distinct_real;
use crate::algebra::double_double::DoubleDouble;
use crate::certify::circle_lanes::{Isolated, Waiting, fourier, isolated};
use crate::certify::circle_zeros::SAMPLES;
use crate::certify::closure_lanes::{Brackets, LaneColumns, LaneRows};
use crate::certify::closure_zeros::EnclosedRows;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::{Cut, Hidden};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::lane_closure::{Angular, Pairs};
use crate::solve::lanes::Lanes;
use pulp::{Arch, Simd, WithSimd};

/// A cut with a hidden angle, prepared for many poses.
struct LaneCut {
    cut: Cut,
    hidden: Hidden,
    rows: LaneRows,
    /// The constants of the cut and the inverses of the first three; the last one is made for a pose.
    constants: [Motion<f64>; 6],
    inverses: [Motion<f64>; 3],
    /// Rows that give cosine and sine of unknowns 5 and 4.
    last: [MarkedLine<f64>; 4],
}

/// The cuts and hidden angles of a loop in which solutions are looked for, those first in which they are found as a rule.
pub(super) struct LaneList {
    arch: Arch,
    cuts: Vec<LaneCut>,
}

impl LaneList {
    /// Prepares a loop, given closed at some poses without any property. `exact` gives the loop, scaled, closed by the identity.
    pub fn new(
        prepared: &[PreparedCut],
        exact: &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>,
        closed: &[ClosedLoop<f64>],
    ) -> Self {
        let arch = Arch::new();
        let mut rated: Vec<(f64, LaneCut)> = Vec::new();
        let mut waiting = Waiting::default();
        for prepared in prepared {
            let Some(rows) = prepared.enclosed(exact) else { continue };
            for hidden in [Hidden::First, Hidden::Second] {
                let new = |closed| LaneCut::new(rows, &prepared.form.last_monomials, closed, hidden);
                let Some(cut) = closed.first().and_then(new) else { continue };
                // In the mean over the poses, in digits; where zeros are not told apart there are none.
                let digits = |closed| arch.dispatch(Digits { cut: &cut, closed, waiting: &mut waiting });
                let digits: f64 = closed.iter().map(digits).sum();
                // Where a geometry is special, solutions share some of the angles at every pose.
                if digits > 0.0 {
                    rated.push((digits, cut));
                }
            }
        }
        rated.sort_by(|a, b| b.0.total_cmp(&a.0));
        Self { arch, cuts: rated.into_iter().map(|(_, cut)| cut).collect() }
    }

    /// Lists all real solutions of a pose, and returns whether they are proved to be all; otherwise the list is undefined. `off` bounds what
    /// the closing transformation is off beyond roundings for the count of the zeros, `gap_rounding` for each solution, and `blur` hides
    /// zeros that are nearly double.
    pub fn solve(
        &self,
        closed: &ClosedLoop<f64>,
        [off, blur, gap_rounding]: [f64; 3],
        workspace: &mut LaneWorkspace,
        assembly: &mut Assembly,
    ) -> bool {
        let finish = Finish::new(closed, gap_rounding);
        self.cuts.iter().any(|cut| {
            assembly.modes.clear();
            let pose = PoseOf { cut, closed, off, blur, finish };
            let is_found = self.arch.dispatch(Task { pose, workspace, assembly });
            is_found && distinct_real(&closed.variables, &assembly.modes) == Some(assembly.modes.len())
        })
    }
}

/// Memory for one pose.
#[derive(Default)]
pub struct LaneWorkspace {
    waiting: Waiting,
}

impl LaneCut {
    /// Prepares a cut of a loop of rotations whose rows do not depend on the pose; `None` for other loops.
    fn new(rows: &EnclosedRows, last: &[MarkedLine<f64>; 4], closed: &ClosedLoop<f64>, hidden: Hidden) -> Option<Self> {
        let cut = rows.cut;
        let constants = cut.of(closed).constants;
        let inverses = [0, 1, 2].map(|k: usize| constants[k].inverse());
        let lanes = rows.lanes.as_ref().filter(|_| closed.variables == [Variable::Rotation; 6])?;
        Some(Self { cut, hidden, rows: lanes.clone(), constants, inverses, last: *last })
    }
}

/// One pose of one cut.
#[derive(Clone, Copy)]
struct PoseOf<'a> {
    cut: &'a LaneCut,
    closed: &'a ClosedLoop<f64>,
    off: f64,
    blur: f64,
    finish: Finish<'a>,
}

/// The search for the solutions of a pose.
struct Task<'a> {
    pose: PoseOf<'a>,
    workspace: &'a mut LaneWorkspace,
    assembly: &'a mut Assembly,
}

/// The number of digits that the largest value of the determinant has at a pose, 0 where its zeros are not told apart.
struct Digits<'a> {
    cut: &'a LaneCut,
    closed: &'a ClosedLoop<f64>,
    waiting: &'a mut Waiting,
}

impl WithSimd for Digits<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let cut = self.cut;
        let [start, _] = cut.ends(self.closed);
        let (values, [error, largest]) = cut.columns(simd, self.closed, &start, 0.0).values(simd);
        let zeros = isolated(simd, &values, [error, largest], self.waiting);
        if zeros.is_some() { (largest / error).log10() } else { 0.0 }
    }
}

impl LaneCut {
    /// Returns the inverse of constant 6 of the cut, and that constant.
    #[inline(always)]
    fn ends(&self, closed: &ClosedLoop<f64>) -> [Motion<f64>; 2] {
        let (gap, back) = (closed.constants[5].clone(), closed.constants[5].inverse());
        if self.cut.reversed { [gap, back] } else { [back, gap] }
    }

    /// Returns the columns of the equations at a pose.
    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, closed: &ClosedLoop<f64>, start: &Motion<f64>, off: f64) -> LaneColumns {
        let mut longest = 0.0_f64;
        for constant in &closed.constants {
            for x in &constant.translation {
                longest = longest.max(x.abs());
            }
        }
        self.rows.columns(simd, start, [longest, off], self.hidden)
    }
}

impl WithSimd for Task<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let PoseOf { cut, closed, off, blur, .. } = self.pose;
        let [start, last] = &cut.ends(closed);
        let columns = cut.columns(simd, closed, start, off);
        let (values, [error, largest]) = columns.values(simd);
        let Some(zeros) = isolated(simd, &values, [error + blur * largest, largest], &mut self.workspace.waiting)
        else {
            return false;
        };
        let count = zeros.count;
        if count == 0 {
            return true;
        }
        let fourier = fourier(simd, &values);
        let place = Place { of: self.pose, columns: &columns, zeros: &zeros, fourier: &fourier, start, last };
        for chunk in 0..count.div_ceil(S::F64_LANES) {
            let found = place.solutions(simd, chunk);
            let lanes = (count - chunk * S::F64_LANES).min(S::F64_LANES);
            for lane in 0..lanes {
                let Some(mode) = found.mode(lane) else { return false };
                self.assembly.modes.push(mode);
            }
        }
        true
    }
}

/// The zeros of a pose.
struct Place<'a> {
    of: PoseOf<'a>,
    columns: &'a LaneColumns,
    zeros: &'a Isolated,
    fourier: &'a [f64; SAMPLES],
    /// The inverse of constant 6 of the cut, and that constant.
    start: &'a Motion<f64>,
    last: &'a Motion<f64>,
}

/// Double angles of half-angles given by multiples of cosine and sine.
#[inline(always)]
fn double<S: Simd>(cos: Lanes<S>, sin: Lanes<S>) -> [Lanes<S>; 2] {
    let (square, other, product) = (cos * cos, sin * sin, cos * sin);
    let over = cos.like(1.0) / (square + other);
    [(square - other) * over, (product + product) * over]
}

/// The first or the second pair, whichever is longer.
#[inline(always)]
fn longer<S: Simd>(one: [Lanes<S>; 2], other: [Lanes<S>; 2]) -> [Lanes<S>; 2] {
    let square = one[0].fma(one[0], one[1] * one[1]);
    let is_other = square.below(other[0].fma(other[0], other[1] * other[1]));
    [is_other.select(other[0], one[0]), is_other.select(other[1], one[1])]
}

/// A rotation about z backwards, of a vector.
#[inline(always)]
fn unwind<S: Simd>(v: &mut [Lanes<S>; 3], [cos, sin]: [Lanes<S>; 2]) {
    let (x, y) = (v[0], v[1]);
    v[0] = cos.fma(x, sin * y);
    v[1] = sin.subtracted_from(x, cos * y);
}

/// The image of a direction.
#[inline(always)]
fn rotate<S: Simd>(motion: &Motion<f64>, v: &[Lanes<S>; 3]) -> [Lanes<S>; 3] {
    let mut image = *v;
    for (x, row) in image.iter_mut().zip(&motion.rotation) {
        *x = v[0].fma(v[0].like(row[0]), v[1].fma(v[0].like(row[1]), v[2] * v[0].like(row[2])));
    }
    image
}

impl Place<'_> {
    /// Returns the solutions of one register of zeros, each with the bounds of its proof, NaN where there is none.
    #[inline(always)]
    fn solutions<S: Simd>(&self, simd: S, chunk: usize) -> Found {
        let hidden = self.zeros.near(simd, self.fourier, chunk);
        let pairs = self.in_loop_order(&self.pairs(hidden));
        self.of.finish.proved(pairs, Lanes::splat(simd, 1.0))
    }

    /// Returns the unknowns of the cut from the hidden one.
    #[inline(always)]
    fn pairs<S: Simd>(&self, hidden: [Lanes<S>; 2]) -> Pairs<Lanes<S>> {
        let cut = self.of.cut;
        let [a, b, c, d] = Brackets::of(&self.columns.at(hidden[0], hidden[1])).kernel();
        let half = longer([a, c], [b, d]);
        let other = double(half[0], half[1]);
        let half = longer([a, b], [c, d]);
        let third = double(half[0], half[1]);
        let (one, two) = if cut.hidden == Hidden::First { (hidden, other) } else { (other, hidden) };
        let zero = hidden[0].like(0.0);
        // The last axis, as the frame in front of unknown 4 has it.
        let motion = self.start;
        let (r, t) = (&motion.rotation, &motion.translation);
        let mut l = [zero.like(r[0][2]), zero.like(r[1][2]), zero.like(r[2][2])];
        let mut p = [zero.like(t[0]), zero.like(t[1]), zero.like(t[2])];
        for (pair, back) in [one, two, third].into_iter().zip(&cut.inverses) {
            unwind(&mut l, pair);
            unwind(&mut p, pair);
            l = rotate(back, &l);
            p = rotate(back, &p);
            for (x, shift) in p.iter_mut().zip(back.translation) {
                *x = *x + zero.like(shift);
            }
        }
        let line = marked(&l, &p);
        let mut last = [zero; 4];
        for (value, row) in last.iter_mut().zip(&cut.last) {
            for (x, factor) in line.iter().zip(row) {
                *value = x.fma(zero.like(*factor), *value);
            }
        }
        let fifth = Lanes::normalised([last[0], last[1]]);
        let fourth = Lanes::normalised([last[2], last[3]]);
        // The x axis of the closing transformation, carried through the loop, is turned by unknown 6.
        let row = &self.last.rotation[0];
        let mut x = [zero.like(row[0]), zero.like(row[1]), zero.like(row[2])];
        for (k, pair) in [one, two, third, fourth, fifth].into_iter().enumerate() {
            unwind(&mut x, pair);
            let g = &cut.constants[k].rotation;
            let old = x;
            for (j, slot) in x.iter_mut().enumerate() {
                *slot = old[0].fma(zero.like(g[0][j]), old[1].fma(zero.like(g[1][j]), old[2] * zero.like(g[2][j])));
            }
        }
        [one, two, third, fourth, fifth, Lanes::normalised([x[0], x[1]])]
    }

    /// Returns the unknowns in the order and direction of the loop.
    #[inline(always)]
    fn in_loop_order<S: Simd>(&self, pairs: &Pairs<Lanes<S>>) -> Pairs<Lanes<S>> {
        let cut = self.of.cut.cut;
        let mut ordered = *pairs;
        for (j, [cos, sin]) in pairs.iter().enumerate() {
            ordered[cut.unknown_index(j)] = [*cos, if cut.reversed { -*sin } else { *sin }];
        }
        ordered
    }
}

/// The sum of products.
#[inline(always)]
fn dot<S: Simd>(x: &[Lanes<S>; 3], y: &[Lanes<S>; 3]) -> Lanes<S> {
    x[0].fma(y[0], x[1].fma(y[1], x[2] * y[2]))
}

/// The coordinates of a line with a marked point.
#[inline(always)]
fn marked<S: Simd>(l: &[Lanes<S>; 3], p: &[Lanes<S>; 3]) -> [Lanes<S>; 15] {
    let (pl, pp) = (dot(p, l), dot(p, p));
    let twice = pl + pl;
    [
        l[0].like(1.0),
        l[0],
        l[1],
        l[2],
        p[0],
        p[1],
        p[2],
        pl,
        pp,
        p[2].subtracted_from(l[1], p[1] * l[2]),
        p[0].subtracted_from(l[2], p[2] * l[0]),
        p[1].subtracted_from(l[0], p[0] * l[1]),
        twice.subtracted_from(p[0], pp * l[0]),
        twice.subtracted_from(p[1], pp * l[1]),
        twice.subtracted_from(p[2], pp * l[2]),
    ]
}
