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
use crate::certify::closure_lanes::{LaneColumns, LaneRows};
use crate::certify::closure_zeros::EnclosedRows;
use crate::closure::woernle_lee::MarkedLine;
use crate::elimination::cut::Hidden;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::lane_brackets::Brackets;
use crate::solve::lane_substitution::LaneView;
use crate::solve::lanes::Lanes;
use pulp::{Arch, Simd, WithSimd};

/// A cut with a hidden angle, prepared for many poses.
struct LaneCut {
    view: LaneView,
    rows: LaneRows,
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
    pub(super) waiting: Waiting,
}

impl LaneCut {
    /// Prepares a cut of a loop of rotations whose rows do not depend on the pose; `None` for other loops.
    fn new(rows: &EnclosedRows, last: &[MarkedLine<f64>; 4], closed: &ClosedLoop<f64>, hidden: Hidden) -> Option<Self> {
        let lanes = rows.lanes.as_ref().filter(|_| closed.variables == [Variable::Rotation; 6])?;
        Some(Self { view: LaneView::new(rows.cut, hidden, last, closed), rows: lanes.clone() })
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
        let [start, _] = cut.view.ends(self.closed);
        let (values, [error, largest]) = cut.columns(simd, self.closed, &start, 0.0).values(simd);
        let zeros = isolated(simd, &values, [error, largest], self.waiting);
        if zeros.is_some() { (largest / error).log10() } else { 0.0 }
    }
}

impl LaneCut {
    /// Returns the columns of the equations at a pose.
    #[inline(always)]
    fn columns<S: Simd>(&self, simd: S, closed: &ClosedLoop<f64>, start: &Motion<f64>, off: f64) -> LaneColumns {
        let mut longest = 0.0_f64;
        for constant in &closed.constants {
            for x in &constant.translation {
                longest = longest.max(x.abs());
            }
        }
        self.rows.columns(simd, start, [longest, off], self.view.hidden)
    }
}

impl WithSimd for Task<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let PoseOf { cut, closed, off, blur, .. } = self.pose;
        let ends = cut.view.ends(closed);
        let columns = cut.columns(simd, closed, &ends[0], off);
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
        let place = Place { of: self.pose, columns: &columns, zeros: &zeros, fourier: &fourier, ends: &ends };
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
    ends: &'a [Motion<f64>; 2],
}

impl Place<'_> {
    /// Returns the solutions of one register of zeros, each with the bounds of its proof, NaN where there is none.
    #[inline(always)]
    fn solutions<S: Simd>(&self, simd: S, chunk: usize) -> Found {
        let one = Lanes::splat(simd, 1.0);
        let hidden = self.zeros.near(simd, self.fourier, chunk);
        let brackets = Brackets::of(&self.columns.entries.at(hidden));
        self.of.finish.proved(self.of.cut.view.unknowns(hidden, &brackets, self.ends, one), one)
    }
}
