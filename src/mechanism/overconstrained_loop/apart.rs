//! Overconstrained loops that do not close: the proof by all solutions with virtual joints.
//!
//! The solutions of a loop of fewer than six unknowns are those of the loop with virtual joints at which these are zero. Where the list
//! of the longer loop is proved complete, and a virtual joint is farther from zero at every solution than the radius within which that
//! solution is proved, the loop does not close. Radii hold for the data of the file, so that irrational numbers need not be known exactly.

use super::{Ladder, OverconstrainedLoop, Rung, outcome};
use crate::assembly::{Assembly, Mode, Roots, Workspace};
use crate::catalogue::entry::Case;
use crate::mechanism::single_loop::SingleLoop;
use crate::mechanism::unproved::is_settled;
use crate::verdict::{Proof, Status, Verdict};

impl OverconstrainedLoop {
    /// Returns the verdict on a loop that is proved not to close, by one of its choices of virtual joints; `None` where none proves it.
    pub(super) fn denied(
        &self,
        ladder: &Ladder,
        case: &Case,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Option<Verdict> {
        if workspace.only_lists {
            return None;
        }
        let count = ladder.rungs.iter().find_map(|rung| self.count_apart(rung, case, workspace, assembly))?;
        let reason = format!(
            "no solution: with virtual joints in place of the missing ones there are {count} solutions, all proved, and none has the \
             virtual joints at zero"
        );
        Some(Verdict { proof: Proof::Proved, ..outcome(Status::Unreachable, 0, reason) })
    }

    /// Returns the number of solutions with virtual joints; `None` where these are not proved to be all, each with a virtual joint that
    /// is not zero.
    fn count_apart(
        &self,
        rung: &Rung,
        case: &Case,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Option<usize> {
        let prepare = || SingleLoop::with_virtual_joints(&self.chain, rung.layout.clone()).ok().map(Box::new);
        let longer = rung.longer.get_or_init(prepare).as_ref()?;
        let verdict = longer.list(case, Roots::All, None, workspace, assembly).ok()?.verdict;
        let is_virtual = rung.layout.joint_variables().map(|joint| joint.is_none());
        // Angles are between -pi and pi: of all turns that are none, 0 is the nearest.
        let is_apart = |mode: &Mode| {
            let most = (0..6).filter(|&k| is_virtual[k]).map(|k| mode.unknowns[k].norm()).fold(0.0, f64::max);
            mode.certificate.is_some_and(|certificate| most > TWICE * certificate.radius)
        };
        let is_all = is_settled(&verdict) && assembly.modes.len() == verdict.complex;
        (is_all && assembly.modes.iter().all(is_apart)).then_some(verdict.complex)
    }
}

/// The norm of a complex number exceeds the largest of its coordinates, which radii are about, by less than this factor.
const TWICE: f64 = 2.0;
