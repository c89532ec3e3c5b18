//! Lists of real solutions that the zeros of a determinant prove to be complete.

use super::{NOTHING, Question};
use crate::algebra::double_double::DoubleDouble;
use crate::assembly::{Assembly, Gap, Margin, Mode, Solver, Workspace, distinct_real};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::tolerance::Tolerance;
use crate::mechanism::unproved::is_settled;
use crate::verdict::{Code, Proof, Status, Verdict};

/// Where the closure polynomial comes nearer to a double zero than this, in parts of its largest value and of the tolerance, a
/// configuration may be near the pose: in parts of the largest one, values changed by up to 3000 times what poses did, as measured.
const NEAR: f64 = 3000.0;

/// One of the ways in which a solver looks for real solutions: see [`Solver::solve_real`].
type Way =
    fn(&Solver, &Gap, &dyn Fn() -> Option<ClosedLoop<DoubleDouble>>, Margin, &mut Workspace, &mut Assembly) -> bool;

impl Question<'_> {
    /// Finds the real solutions by the zeros of a determinant, and returns whether these prove them to be all. The list is then that of
    /// the real solutions; otherwise it is undefined.
    ///
    /// What is near a pose is found from complex solutions, which are not looked for: either nothing is near, or there is a real
    /// solution and no sign of others.
    pub(super) fn has_real_list(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> bool {
        self.has_quick_real_list(workspace, assembly)
            || self.by_margins(Solver::solve_real_closely, workspace, assembly)
    }

    /// As [`Self::has_real_list`], where that takes a few microseconds.
    pub(super) fn has_quick_real_list(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> bool {
        self.by_margins(Solver::solve_real_quickly, workspace, assembly)
    }

    fn by_margins(&self, way: Way, workspace: &mut Workspace, assembly: &mut Assembly) -> bool {
        let Some(tolerance) = self.tolerance else { return self.real_by(way, Margin::Blur(0.0), workspace, assembly) };
        // Where both margins prove a list it is the same, and the first one does so nearly always.
        // What is far from the joints beside the gap is moved by a turn as by a shift.
        let angle = tolerance.angle * self.prepared.solver.lever(self.gap).max(1.0);
        let blur = NEAR * angle.max(tolerance.length / self.prepared.solver.unit());
        self.real_by(way, Margin::Blur(blur), workspace, assembly) && !assembly.modes.is_empty()
            || self.real_by(way, Margin::Tolerance(tolerance), workspace, assembly)
            || self.real_by(way, Margin::Blur(0.0), workspace, assembly) && self.stay_alone(tolerance, &assembly.modes)
    }

    /// Whether real solutions are proved to be all, and alone at every pose within the tolerance: those of an arm as built are in pairs and
    /// fours, nearer to each other than the zeros of a determinant tell.
    fn stay_alone(&self, tolerance: Tolerance, real: &[Mode]) -> bool {
        let is_general = self.prepared.solver.structural_rank() == 6 && self.has_rotations_alone();
        let exact = || self.prepared.exact(&self.of.chain);
        is_general && !real.is_empty() && self.prepared.solver.stay_alone(self.gap, &exact, tolerance, real)
    }

    /// The verdict on a list with certified real solutions that are proved to be all within the tolerance; complex ones without a certificate
    /// leave the list.
    pub(super) fn of_real_alone(&self, assembly: &mut Assembly) -> Option<Verdict> {
        if self.only_lists || assembly.self_motion > 0 {
            return None;
        }
        distinct_real(&self.prepared.layout.loop_kinds(), &assembly.modes)?;
        let real: Vec<Mode> = assembly.modes.iter().filter(|mode| mode.real).cloned().collect();
        if !self.stay_alone(self.tolerance.unwrap_or(NOTHING), &real) {
            return None;
        }
        assembly.modes.retain(|mode| mode.multiplicity == 1 && mode.certificate.is_some());
        let real = assembly.real();
        let reason = format!(
            "{real} distinct certified real solutions: the closure polynomial in a joint angle has no more real zeros; complex solutions were \
             not counted"
        );
        Some(Verdict { reason, ..of_real_zeros(assembly) })
    }

    /// The verdict on a list of certified solutions, complex ones among them, where real solutions are asked for alone, the verdict at
    /// hand is not proved, and the real ones are proved to be all by the zeros of a determinant. The complex ones stay in the list:
    /// near a pose may be what is not real here.
    pub(super) fn beside_real_zeros(
        &self,
        verdict: &Verdict,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Option<Verdict> {
        let is_certified = |mode: &Mode| mode.multiplicity == 1 && mode.certificate.is_some();
        let is_asked = self.only_real_list && !self.only_lists && !is_settled(verdict) && assembly.self_motion == 0;
        if !is_asked {
            return None;
        }
        let number = distinct_real(&self.prepared.layout.loop_kinds(), &assembly.modes)?;
        // Whether a pose that is not reached is reached nearly, complex solutions tell.
        if number == 0 && self.tolerance.is_some() {
            return None;
        }
        if let Some(verdict) = self.of_real_alone(assembly) {
            return Some(verdict);
        }
        if !assembly.modes.iter().all(is_certified) {
            return None;
        }
        // What is near a pose may be among the complex solutions that this list lacks: a double one that rounding split is the hardest to
        // find. Then the real ones have to be all within the tolerance.
        let is_full = assembly.total() >= self.most(assembly.total());
        let margin = self.tolerance.filter(|_| !is_full).map_or(Margin::Blur(0.0), Margin::Tolerance);
        let mut real = Assembly::default();
        let is_proved = self.real_by(Solver::solve_real, margin, workspace, &mut real) && real.modes.len() == number;
        is_proved.then(|| of_real_zeros(assembly))
    }

    pub(super) fn real_by(&self, way: Way, margin: Margin, workspace: &mut Workspace, assembly: &mut Assembly) -> bool {
        let exact = || self.prepared.exact(&self.of.chain);
        !self.only_lists && way(&self.prepared.solver, self.gap, &exact, margin, workspace, assembly)
    }
}

/// The verdict on a list whose real solutions are proved to be all.
pub(super) fn of_real_zeros(assembly: &Assembly) -> Verdict {
    let real = assembly.real();
    let reason = format!(
        "{real} distinct certified real solutions: the closure polynomial in a joint angle has {real} real zeros, all simple; \
         complex solutions were not counted"
    );
    Verdict {
        status: if real == 0 { Status::Unreachable } else { Status::Complete },
        proof: Proof::Proved,
        code: Code::RealZerosMatched,
        complex_complete: false,
        complex: assembly.total(),
        real,
        at_infinity: 0,
        self_motion: 0,
        certified: assembly.modes.len(),
        reason,
    }
}
