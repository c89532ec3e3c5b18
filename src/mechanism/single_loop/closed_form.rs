//! Answers by a closed form alone.

use super::{Question, SingleLoop, Way};
use crate::algebra::double_double::DoubleDouble;
use crate::assembly::{Assembly, Crowded, Mode, Roots, Rounded, Workspace};
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::tolerance::Tolerance;
use crate::mechanism::Solution;
use crate::mechanism::by_input::Prepared;
use crate::mechanism::unproved::is_settled;
use crate::solve::scalar::Extended;
use crate::verdict::Verdict;
use std::time::Instant;

impl SingleLoop {
    /// Solves one case by a closed form alone; `None` where that does not prove its list.
    pub(crate) fn solve_in_closed_form(
        &self,
        case: &Case,
        roots: Roots,
        tolerance: Option<Tolerance>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Option<Solution>> {
        let Prepared { of: Way::Six(prepared), prepare_us, .. } = self.prepared.of(&self.chain, case)? else {
            return Ok(None);
        };
        let gap = self.gap(prepared, case)?;
        let start = Instant::now();
        let question = self.question(prepared, case, roots, tolerance, workspace, &gap);
        let Some(verdict) = question.by_closed_form(workspace, assembly) else { return Ok(None) };
        let solve_us = start.elapsed().as_secs_f64() * 1e6;
        Ok(Some(self.listed(&question, verdict, None, [*prepare_us, solve_us], assembly)))
    }
}

impl Question<'_> {
    /// A bound on the number of solutions, where this number is known.
    pub(super) fn most(&self, known: usize) -> usize {
        if self.only_lists { self.prepared.general() } else { self.prepared.bound(&self.of.chain, known).count }
    }

    /// The verdict on the list of a closed form; `None` where that does not prove as many solutions as the geometry can have. A
    /// closed form is as fast as real zeros, and has all solutions.
    pub(super) fn by_closed_form(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> Option<Verdict> {
        let solver = &self.prepared.solver;
        let enclosed = || self.prepared.enclosed(&self.of.chain, self.case).ok().flatten();
        let exact = Rounded {
            double: &|| enclosed()?.rounded(DoubleDouble::BITS),
            crowded: &|| enclosed()?.rounded(Crowded::BITS),
        };
        let most = |known| self.most(known);
        if self.only_lists || !solver.solve_in_closed_form(self.gap, &most, exact, workspace, assembly) {
            return None;
        }
        let verdict = self.judge(Roots::All, assembly);
        // The list is that of what is asked for; complex ones lead to near ones.
        let is_listed = |mode: &&Mode| mode.real || self.roots == Roots::All;
        let certified = assembly.modes.iter().filter(is_listed).filter(|mode| mode.certificate.is_some()).count();
        let complex_complete = verdict.complex_complete && self.roots == Roots::All;
        is_settled(&verdict).then_some(Verdict { complex_complete, certified, ..verdict })
    }
}
