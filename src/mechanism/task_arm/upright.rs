//! Poses at which the tool's axis is parallel to that of the base: there the tilt is one condition more than elsewhere.

use super::{OF_FEW, Plan, TaskArm, Tools};
use crate::catalogue::entry::{Case, Entry};
use crate::error::Result;
use crate::kinematics::chain::Placement;
use crate::kinematics::task::{Demand, Task};
use crate::kinematics::tolerance::Tolerance;
use crate::mechanism::Solution;
use crate::verdict::Proof;

impl TaskArm {
    /// Returns whether the tilt of a pose is 0 or a half turn, if it is so within the tolerance: proved, or measured. `None` for
    /// other poses and other tasks.
    ///
    /// The tilt then fixes the direction of the tool's axis, and the two virtual joints of the task are coaxial: its loop is singular in every
    /// configuration, and the loop of the axis is the one to solve.
    pub(super) fn stands_upright(&self, case: &Case, pose: &Placement, tolerance: Option<Tolerance>) -> Option<bool> {
        if self.task != Task::PositionTilt {
            return None;
        }
        if pose.keeps_z() {
            return Some(true);
        }
        let [x, y, _] = pose.float.rotation[2];
        (x.hypot(y) <= self.allowed(case, tolerance).angle).then_some(false)
    }

    /// The tolerance of a pose: of few joints that of the digits typed where no other one is given.
    fn allowed(&self, case: &Case, tolerance: Option<Tolerance>) -> Tolerance {
        tolerance.unwrap_or_else(|| match &self.plan {
            Plan::Filled(_) | Plan::Dependent(_) => case.typed.unwrap_or(OF_FEW).or(OF_FEW),
            Plan::Whole(_) | Plan::Redundant(..) => Tolerance::default(),
        })
    }

    /// Solves a pose by the direction of the tool's axis.
    pub(super) fn solve_upright(&self, is_exact: bool, case: &Case, with: &mut Tools<'_>) -> Result<Solution> {
        let prepared = self.upright.get_or_init(|| {
            let entry = Entry { limits: self.limits.clone(), ..self.shell.clone() };
            // The joint that the task leaves free is held last, and found again.
            let asked = self.held.len() - usize::from(self.coaxial.is_some());
            let demand = Demand { task: Task::PositionAxis, held: self.held[..asked].to_vec() };
            Ok(Box::new(Self::prepare(&entry, &self.chain, &demand)?))
        });
        let arm = prepared.as_ref().map_err(Clone::clone)?;
        let mut solution = arm.solve(case, with.roots, with.tolerance, with.workspace, with.assembly)?;
        let verdict = &mut solution.verdict;
        if is_exact {
            verdict.reason = format!("the tilt fixes the direction of the tool's axis; {}", verdict.reason);
        } else {
            // Directions that are off by less than the tolerance, and not in the pose's own way, are not listed.
            (verdict.proof, verdict.complex_complete) = (Proof::None, false);
            verdict.reason = format!(
                "the tilt fixes the direction of the tool's axis within the tolerance, and the one of the pose was asked for; {}",
                verdict.reason
            );
        }
        Ok(solution)
    }
}
