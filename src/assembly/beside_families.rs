//! Arms with a closed form at singular poses: what it finds is proved, or lies on a self-motion.

use super::closed_form::{Exact, Lazy};
use super::mode::{Assembly, Roots, are_all_apart, distance};
use super::search::{Effort, Search, is_same};
use super::side_by_side::Pairs;
use super::solver::{Gap, Solver, Workspace};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::scalar::Scalar;
use crate::solve::self_motion::{nearest, self_motions};
use num_complex::Complex;
use std::cell::LazyCell;

/// The closing transformation is moved by this: the closed form of a singular pose divides by 0, and beside it its angles are as far
/// off, or the root of it at double solutions.
const SHIFT: f64 = 1e-7;
/// Distance of a solution from its start beyond which it is not that of the start.
const NEAR: f64 = 1e-4;
/// Imaginary parts that the shift gives real solutions, at most.
const SPLIT: f64 = 1e-3;

impl Solver {
    /// Finds the solutions at a singular pose by the closed form alone. Returns whether each of its `most` candidates is proved or
    /// lies on a self-motion, and some do; otherwise the list is undefined.
    pub fn solve_beside_families(
        &self,
        gap: &Gap,
        most: usize,
        exact: &dyn Fn() -> Option<Exact>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> bool {
        assembly.clear();
        let unit = 1.0 / self.unit();
        let double = || exact().map(|exact| exact.in_unit(&unit.into()));
        let (closed, _) = self.closed(gap);
        let mut search = self.searched(gap, &closed, Roots::All, Effort::OnePencil, workspace, assembly);
        let is_known = search.beside_families(most, &LazyCell::new(&double));
        self.finish(assembly);
        is_known
    }
}

impl Search<'_> {
    fn beside_families(&mut self, most: usize, exact: &Lazy<'_>) -> bool {
        let Some(decoupled) = self.decoupled else { return false };
        let candidates = decoupled.candidates(&shifted(self.closed));
        let is_known = candidates.count() == most
            && candidates.real().iter().all(|pairs| self.is_known(pairs, exact))
            && candidates.complex().iter().all(|pairs| self.is_known(pairs, exact));
        self.assembly.self_motion = self.assembly.families.iter().map(|family| family.dimension).max().unwrap_or(0);
        is_known && self.assembly.self_motion > 0
    }

    /// Lists the solution near a candidate, or the self-motions there. Returns whether there is either.
    fn is_known<S: Scalar>(&mut self, pairs: &Pairs<S>, exact: &Lazy<'_>) -> bool {
        let start = pairs.map(|(cos, sin)| S::angle_of(cos, sin).to_complex());
        let (listed, variables) = (self.assembly.modes.len(), self.closed.variables);
        if self.one_alone(&start, S::REAL, exact)
            && let Some(last) = self.assembly.modes.last()
            && distance(&variables, &last.unknowns, &start) < NEAR
            && are_all_apart(&variables, &self.assembly.modes)
        {
            return true;
        }
        self.assembly.modes.truncate(listed);
        if start.iter().any(|z| z.im.abs() > SPLIT) {
            return false;
        }
        let Some(point) = nearest(self.closed, &start.map(|z: Complex<f64>| z.re), CLOSES_WITHIN) else { return false };
        let families = &mut self.assembly.families;
        if families.iter().any(|family| family.holds(self.closed, &point, CLOSES_WITHIN)) {
            return true;
        }
        let found = self_motions(self.closed, &point, CLOSES_WITHIN);
        let moves = !found.is_empty();
        for family in found {
            if !families.iter().any(|known| is_same(self.closed, known, &family)) {
                families.push(family);
            }
        }
        moves
    }
}

/// A loop whose closing transformation is moved in no special direction.
fn shifted(closed: &ClosedLoop<f64>) -> ClosedLoop<f64> {
    let mut shifted = closed.clone();
    let turn = |angle: f64| (angle.cos(), angle.sin());
    let turned = Motion::turned([0.7, -0.5, 0.6].map(|part| turn(SHIFT * part)));
    let moved = Motion::translation([0.5, 0.6, -0.4].map(|part| SHIFT * part));
    shifted.constants[5] = moved.then_after(&turned).then_after(&closed.constants[5]);
    shifted
}
