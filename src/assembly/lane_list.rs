//! The real solutions of one pose with their proofs, side by side in vector registers.
//!
//! The steps are those of [`real_list`](super::real_list): all zeros of a determinant on the circle of a hidden angle, at each of them the
//! kernel, the other angles, and a few steps of Newton's method. Then every solution is certified as in [`certify`](crate::certify), with
//! bounds of the norms by distances: the rows of a rotation have sums of at most the root of 3. Where a step is not certain, nothing is said.

use super::limits;
use super::mode::{Assembly, Hits, Mode, wrapped};
use super::prepared::PreparedCut;
use super::real_list::distinct_real;
use crate::algebra::double_double::DoubleDouble;
use crate::certify::Certificate;
use crate::certify::circle_lanes::{Isolated, Waiting, fourier, isolated};
use crate::certify::circle_zeros::SAMPLES;
use crate::certify::closure_lanes::{Brackets, LaneColumns, LaneRows};
use crate::certify::closure_zeros::EnclosedRows;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::{Cut, Hidden};
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::lane_closure::{
    ANGLE_ERROR, LaneClosure, Pairs, angle_of, lane_closure, lane_inverse, normalised, turned_back,
};
use crate::solve::lanes::{Lanes, Mask, Row, WIDTH};
use num_complex::Complex;
use pulp::{Arch, Simd, WithSimd};

/// Half a unit in the last place of 1.
const ROUNDOFF: f64 = f64::EPSILON / 2.0;
/// The root of 3 and a margin: the row-sum norm of a rotation.
const ROOT_3: f64 = 1.7321;
/// The root of 2 and a margin.
const ROOT_2: f64 = 1.4143;
/// As in [`certify`](crate::certify): roundings per step of the product, and the margin on bounds computed in f64.
const ROUNDINGS: f64 = 70.0;
const MARGIN: f64 = 1.01;
/// Newton's steps with the inverse of the first place: each gains the digits that the first one gained.
const STEPS: usize = 5;
/// Closure errors below this are rounding.
const ROUNDING: f64 = 4e-15;
/// The squares of cosine and sine add up to 1 within so much: then each is off by 8 half units in the last place at most, which
/// [`ROUNDINGS`] holds.
const OFF_CIRCLE: f64 = 16.0 * ROUNDOFF;
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
        let length = |motion: &Motion<f64>| motion.translation.iter().map(|x| x * x).sum::<f64>().sqrt();
        let length = closed.constants.iter().map(length).sum::<f64>().max(1.0);
        self.cuts.iter().any(|cut| {
            assembly.modes.clear();
            let pose = PoseOf { cut, closed, off, blur, gap_rounding, length };
            let is_found = self.arch.dispatch(Task { pose, workspace, assembly });
            is_found && distinct_real(&closed.variables, &assembly.modes) == Some(assembly.modes.len())
        })
    }
}

/// The lanes of the solutions of one register.
#[derive(Clone, Copy)]
struct Found {
    angles: [Row; 6],
    radius: Row,
    isolation: Row,
    turn: Row,
    shift: Row,
    condition: Row,
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
    gap_rounding: f64,
    /// The length of all links, at least 1: errors of translations are measured by it.
    length: f64,
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
                let Some(mode) = self.pose.mode(&found, lane) else { return false };
                self.assembly.modes.push(mode);
            }
        }
        true
    }
}

impl PoseOf<'_> {
    /// Returns the certified solution of a lane; `None` where there is no proof.
    fn mode(&self, found: &Found, lane: usize) -> Option<Mode> {
        let (radius, isolation) = (found.radius[lane] + ANGLE_ERROR, found.isolation[lane] - ANGLE_ERROR);
        // NaN fails. What is known so badly is left to longer numbers.
        if !(radius <= isolation && radius < limits::LONE_RADIUS) {
            return None;
        }
        let (turn, shift) = (found.turn[lane], found.shift[lane] / self.length);
        Some(Mode {
            unknowns: std::array::from_fn(|j| Complex::from(wrapped(found.angles[j][lane]))),
            real: true,
            multiplicity: 1,
            residual: if turn > shift { turn } else { shift },
            condition: found.condition[lane],
            certificate: Some(Certificate { radius, isolation, proved: radius }),
            hits: Hits::first(0),
        })
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
        self.proved(pairs)
    }

    /// Returns the unknowns of the cut from the hidden one.
    #[inline(always)]
    fn pairs<S: Simd>(&self, hidden: [Lanes<S>; 2]) -> Pairs<S> {
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
        let fifth = normalised([last[0], last[1]]);
        let fourth = normalised([last[2], last[3]]);
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
        [one, two, third, fourth, fifth, normalised([x[0], x[1]])]
    }

    /// Returns the unknowns in the order and direction of the loop.
    #[inline(always)]
    fn in_loop_order<S: Simd>(&self, pairs: &Pairs<S>) -> Pairs<S> {
        let cut = self.of.cut.cut;
        let mut ordered = *pairs;
        for (j, [cos, sin]) in pairs.iter().enumerate() {
            ordered[cut.unknown_index(j)] = [*cos, if cut.reversed { -*sin } else { *sin }];
        }
        ordered
    }

    /// Polishes solutions and proves them.
    #[inline(always)]
    fn proved<S: Simd>(&self, mut pairs: Pairs<S>) -> Found {
        let constants = &self.of.closed.constants;
        let mut here = lane_closure(constants, &pairs);
        let inverse = lane_inverse(&here.jacobian);
        let limit = here.turn.like(ROUNDING);
        let far = here.turn.like(ROUNDING * self.of.length);
        for step in 0..STEPS {
            for j in 0..6 {
                let mut sum = inverse[j][0] * here.residual[0];
                for i in 1..6 {
                    sum = inverse[j][i].fma(here.residual[i], sum);
                }
                pairs[j] = turned_back(pairs[j], sum);
            }
            here = lane_closure(constants, &pairs);
            let is_closed = here.turn.at_most(limit).and(here.shift.at_most(far));
            if step + 1 < STEPS && is_closed.all() {
                break;
            }
        }
        let mut found = Found {
            angles: [[0.0; WIDTH]; 6],
            radius: [f64::NAN; WIDTH],
            isolation: [f64::NAN; WIDTH],
            turn: [0.0; WIDTH],
            shift: [0.0; WIDTH],
            condition: [0.0; WIDTH],
        };
        for (row, pair) in found.angles.iter_mut().zip(pairs) {
            angle_of(pair).store(row, 0);
        }
        here.turn.store(&mut found.turn, 0);
        here.shift.store(&mut found.shift, 0);
        // How far the pairs are from the circle, on which cosines and sines are.
        let mut off_circle = limit.like(0.0);
        for [cos, sin] in pairs {
            off_circle = off_circle.max((cos.fma(cos, sin * sin) - limit.like(1.0)).abs());
        }
        self.certify(&here, &inverse, off_circle, &mut found);
        found
    }

    /// Bounds the radius in which exactly one solution lies, and that in which there is no other: see [`certify`](crate::certify), whose
    /// names are used here.
    #[inline(always)]
    fn certify<S: Simd>(
        &self,
        at: &LaneClosure<S>,
        inverse: &[[Lanes<S>; 6]; 6],
        off_circle: Lanes<S>,
        found: &mut Found,
    ) {
        let zero = at.turn.like(0.0);
        // Steps of the product: a rotation about z has row sums of at most the root of 2.
        let (mut rounding, mut twist, mut lever) = (zero, zero, zero);
        let mut of_gap = zero;
        for (j, constant) in self.of.closed.constants.iter().enumerate() {
            let step = ROOT_2 * row_sum(constant);
            of_gap =
                (at.distances[j] + zero.like(ROOT_3)) * (at.distances[j + 1] + zero.like(ROOT_3)) * zero.like(step);
            rounding = rounding + of_gap;
            twist = twist + at.distances[j] + zero.like(ROOT_2);
            lever = at.distances[j].fma(zero.like(ROOT_3 * ROOT_3), lever + zero.like(ROOT_3));
        }
        let rounding = rounding * zero.like(ROUNDINGS * ROUNDOFF);
        let data = of_gap * zero.like(self.of.gap_rounding);
        let error = rounding + data;
        let off = at.turn.max(at.shift).fma(zero.like(8.0), error);
        let twist_error = lever * (error + zero.like(2.0 * ROUNDOFF)) * zero.like(3.0);
        let twists = twist_error.fma(zero.like(3.0), twist) * zero.like(MARGIN);
        let derivative = (twists * off).fma(zero.like(2.0), twist_error) * zero.like(MARGIN);
        let (mut norm, mut step, mut deviation, mut residual, mut jacobian) = (zero, zero, zero, zero, [zero; 6]);
        // A maximum may lose what is no number, a sum does not.
        let mut all = at.turn + at.shift + off_circle;
        for (i, row) in inverse.iter().enumerate() {
            let (mut size, mut moved, mut wrong) = (zero, zero, zero);
            for a in 0..6 {
                size = size + row[a].abs();
                moved = row[a].fma(at.residual[a], moved);
                let mut value = if a == i { zero.like(1.0) } else { zero };
                for b in 0..6 {
                    value = row[b].subtracted_from(at.jacobian[a][b], value);
                }
                wrong = wrong + value.abs();
                jacobian[i] = jacobian[i] + at.jacobian[a][i].abs();
            }
            norm = norm.max(size);
            step = step.max(moved.abs());
            deviation = deviation.max(wrong);
            residual = residual.max(at.residual[i].abs());
            all = all + size + moved.abs() + wrong + at.residual[i].abs();
        }
        let mut size = zero;
        for row in jacobian {
            size = size.max(row);
        }
        (size * norm).store(&mut found.condition, 0);
        let norm = norm * zero.like(MARGIN);
        let y = (norm.fma(residual.fma(zero.like(16.0 * ROUNDOFF), error), step)) * zero.like(MARGIN);
        // The sums of the terms of a row of the product are at most the product of the norms.
        let z0 = ((norm * size).fma(zero.like(40.0 * ROUNDOFF), norm.fma(derivative, deviation))) * zero.like(MARGIN);
        let bend = norm * twists * twists * (off + zero.like(1.0)) * zero.like(MARGIN);
        let one = zero.like(1.0);
        // exp x is at most 1 + x + x^2 for x up to 1.
        let radius = (y / (one - z0) * zero.like(1.05 * 1.5)).max(zero.like(f64::MIN_POSITIVE));
        let bounds = [y, z0, twists];
        let x = radius * twists;
        let growth = x.fma(x, x + one);
        let is_sound = all.below(zero.like(f64::MAX)).and(off_circle.at_most(zero.like(OFF_CIRCLE)));
        let is_proved = works(bounds, radius, bend * growth)
            .and(is_sound)
            .and(z0.below(zero.like(0.5)))
            .and(off.below(zero.like(1e-3)))
            .and((x.fma(x, x)).fma(zero.like(MARGIN), off).below(zero.like(0.5)));
        let mut isolation = (one - z0) / (bend * growth) * zero.like(0.9);
        let x = isolation * twists;
        let works_there = works(bounds, isolation, bend * x.fma(x, x + one)).and(radius.below(isolation));
        let half = isolation * zero.like(0.5);
        let x = half * twists;
        let works_half = works(bounds, half, bend * x.fma(x, x + one)).and(radius.below(half));
        isolation = works_there.select(isolation, works_half.select(half, radius));
        let nothing = zero.like(f64::NAN);
        is_proved.select(radius, nothing).store(&mut found.radius, 0);
        is_proved.select(isolation, nothing).store(&mut found.isolation, 0);
    }
}

/// Whether a radius proves a solution: `y + z0 r + z2 r^2 / 2` is at most r and `z0 + z2 r` below 1, where `r twists` is at most 1.
#[inline(always)]
fn works<S: Simd>([y, z0, twists]: [Lanes<S>; 3], r: Lanes<S>, z2: Lanes<S>) -> Mask<S> {
    let one = r.like(1.0);
    let reached = (z2 * r * r).fma(r.like(0.5), z0.fma(r, y));
    reached.at_most(r).and(z2.fma(r, z0).below(one)).and((r * twists).at_most(one))
}

/// The sum of products.
#[inline(always)]
fn dot<S: Simd>(x: &[Lanes<S>; 3], y: &[Lanes<S>; 3]) -> Lanes<S> {
    x[0].fma(y[0], x[1].fma(y[1], x[2] * y[2]))
}

/// The row-sum norm of a constant as a matrix, at least 1.
#[inline(always)]
fn row_sum(motion: &Motion<f64>) -> f64 {
    let mut largest = 1.0_f64;
    for (row, shift) in motion.rotation.iter().zip(&motion.translation) {
        largest = largest.max(row[0].abs() + row[1].abs() + row[2].abs() + shift.abs());
    }
    largest
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
