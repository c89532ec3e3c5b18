//! Poses that no real configuration reaches exactly: what is near them, or why nothing is.
//!
//! Where the numbers of a pose are rounded, that the pose as typed is not reached says little: at a singular posture half of all poses
//! beside the one that it reaches are beyond it. `unreachable` is said where nothing reaches a pose within the tolerance, nor one that
//! typing rounds to this one. Either that is proved, or the search for singular postures finds none, and least squares from all solutions
//! and from places all over stay far from the pose.

use super::{Question, SixUnknowns};
use crate::assembly::{Assembly, Margin, Solver, Workspace};
use crate::kinematics::chain::Placement;
use crate::kinematics::tolerance::Tolerance;
use crate::mechanism::near::Near;
use crate::mechanism::unproved::perhaps_near;
use crate::mechanism::vicinity::Vicinity;
use crate::verdict::{Code, Status, Verdict};

/// A pose that least squares miss by this many tolerances is none that is missed by one.
const FAR: f64 = 10.0;

impl Question<'_> {
    /// Returns what is near a pose, and the tolerance within which it is. A verdict that denies the pose stands where nothing
    /// is.
    pub(super) fn near(
        &self,
        vicinity: &Vicinity<'_>,
        pose: &Placement,
        tolerance: Tolerance,
        verdict: &mut Verdict,
        assembly: &Assembly,
    ) -> (Near, Tolerance) {
        if verdict.status != Status::Unreachable {
            return (vicinity.near(pose, tolerance, verdict, assembly), tolerance);
        }
        let typed = self.rounding.map(|rounding| tolerance.or(rounding)).filter(|typed| *typed != tolerance);
        for within in [Some(tolerance), typed].into_iter().flatten() {
            if self.is_denied(within, verdict, assembly) {
                continue;
            }
            let near = self.found_near(vicinity, pose, within, verdict, assembly);
            if near.is_empty() {
                if self.is_far(vicinity, pose, within, assembly) {
                    continue;
                }
                *verdict = perhaps_near(verdict, self.open_code());
                return (self.by_least_squares(vicinity, pose, within), within);
            }
            verdict.status = Status::Complete;
            if within != tolerance {
                let rounded = "nothing reaches the pose as typed; what is near misses it by no more than one unit of its last digit";
                verdict.reason = format!("{rounded}; {}", verdict.reason);
            }
            return (near, within);
        }
        (Near::default(), tolerance)
    }

    /// Returns what least squares find within the tolerance, which are not all that come near.
    fn by_least_squares(&self, vicinity: &Vicinity<'_>, pose: &Placement, within: Tolerance) -> Near {
        let modes = self.of.all_nearest(pose, within).into_iter();
        Near { modes: modes.map(|(q, miss)| (vicinity.unknowns(&q), miss)).collect(), families: Vec::new() }
    }

    /// Whether everything that is known to come near the pose stays far from it. Dependent joints reach poses of a lower dimension, which
    /// nothing but a proof denies.
    fn is_far(&self, vicinity: &Vicinity<'_>, pose: &Placement, within: Tolerance, assembly: &Assembly) -> bool {
        let is_deficient = self.prepared.solver.structural_rank() < 6;
        !is_deficient && vicinity.closest(pose, within, assembly).is_some_and(|parts| parts > FAR)
    }

    /// The code of a verdict that leaves open whether something is near.
    fn open_code(&self) -> Code {
        let is_deficient = self.prepared.solver.structural_rank() < 6;
        if is_deficient { Code::StructurallyDeficient } else { Code::NearNotDecided }
    }

    /// Looks for what is near a pose that nothing reaches, from complex solutions: a list of real ones has none of them.
    fn found_near(
        &self,
        vicinity: &Vicinity<'_>,
        pose: &Placement,
        within: Tolerance,
        verdict: &Verdict,
        assembly: &Assembly,
    ) -> Near {
        if verdict.code != Code::RealZerosMatched {
            return vicinity.near(pose, within, verdict, assembly);
        }
        let (mut workspace, mut all) = (Workspace::default(), Assembly::default());
        self.prepared.solver.solve_by_pencils(self.gap, &|known| self.most(known), &mut workspace, &mut all);
        vicinity.near(pose, within, verdict, &all)
    }

    /// Whether it is proved that no real configuration reaches a pose within the tolerance of this one, which none reaches.
    fn is_denied(&self, within: Tolerance, verdict: &Verdict, assembly: &Assembly) -> bool {
        let SixUnknowns { solver, .. } = self.prepared;
        if solver.structural_rank() < 6 {
            return self.is_clear(within);
        }
        let is_bounded =
            matches!(verdict.code, Code::GeneralBoundMet | Code::GeometryBoundMet) && verdict.proof.is_proved();
        let has_all = || {
            is_bounded
                && assembly.total() == verdict.complex
                && assembly.modes.iter().all(|mode| mode.certificate.is_some())
        };
        // A list of real zeros is proved for the tolerance of the pose.
        let is_list = || verdict.code == Code::RealZerosMatched && self.tolerance == Some(within);
        self.is_beyond(within)
            || is_list()
            || has_all() && solver.stay_complex(self.gap, within, &assembly.modes)
            || self.has_no_zeros(within)
    }

    /// Whether no pose within the tolerance has a real zero of the closure polynomial, which proves that none is reached.
    fn has_no_zeros(&self, within: Tolerance) -> bool {
        let (mut workspace, mut real) = (Workspace::default(), Assembly::default());
        self.real_by(Solver::solve_real, Margin::Tolerance(within), &mut workspace, &mut real) && real.modes.is_empty()
    }

    /// Returns whether it is proved that no real configuration reaches the pose, or closes the loop, within the tolerance.
    pub(super) fn is_clear(&self, tolerance: Tolerance) -> bool {
        let is_contradictory = |plan| self.prepared.is_clear(&self.of.chain, self.case, plan, tolerance);
        self.is_beyond(tolerance) || self.plan().is_some_and(is_contradictory)
    }

    /// Whether the links are too short for every pose within the tolerance.
    fn is_beyond(&self, within: Tolerance) -> bool {
        let beyond = |(gap, links): (f64, f64)| gap - links - within.length - within.angle * links;
        self.prepared.solver.too_far(self.gap).is_some_and(|far| beyond(far) > 0.0)
    }
}
