//! Arms and loops of seven joint variables: one loop of six unknowns for each choice of the locked variable.

mod closed_form;
mod denial;
mod exact_roots;
mod far_away;
mod groups;
mod real_list;

use super::bounds::{MODULO, of_cuts, of_ring, of_triple};
use super::by_input::{ByInput, Prepared};
use super::data::{Data, Modular, is_rational};
use super::dependence::dependent;
use super::exact_loop::{Question as ExactQuestion, SsDyadQuestion};
use super::spherical_angles::idle_spin;
use super::unproved::{is_left_to_equations, is_settled, moving, not_moving, perhaps_near};
use super::vicinity::Vicinity;
use super::{FullMode, Solution};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::drawn::{self, Drawn};
use crate::algebra::enclosure::Enclosure;
use crate::algebra::interval::Interval;
use crate::algebra::long_float::{LongFloat, LongerFloat};
use crate::algebra::ring::Ring;
use crate::assembly::{Assembly, Gap, MOST_TRIES, Mode, Roots, Solver, Workspace, ss_dyad, wrapped};
use crate::catalogue::entry::{Case, Entry, InputValue};
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::degree::Degree;
use crate::elimination::spherical_pair;
use crate::error::{Error, Result};
use crate::exact::{self, BALL_BITS, MOST_WITH_TRIPLE, Resolution, has_no_solution};
use crate::kinematics::chain::{Chain, JointKind, Placement};
use crate::kinematics::closed_loop::{
    ClosedLoop, Layout, Numbers, OpenLoop, OpenSsDyad, SsDyad, Variable, angle_motion, distance_motion,
};
use crate::kinematics::forward::Forward;
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::{Motion, unit_near};
use crate::kinematics::tolerance::Tolerance;
use crate::solve::scalar::Extended;
use crate::verdict::{Bound, Code, Proof, Status, Verdict, verdict};
use num_complex::Complex;
use real_list::of_real_zeros;
use rug::Rational;
use std::cell::{OnceCell, RefCell};
use std::f64::consts::TAU;
use std::sync::OnceLock;
use std::time::Instant;

/// The way in which a loop is solved, prepared.
enum Way {
    Six(Box<SixUnknowns>),
    SphericalPair(Box<SphericalPair>),
}

/// The solver of one choice of the locked joint (of an arm: the only one).
pub(super) struct SixUnknowns {
    pub(super) layout: Layout,
    pub(super) solver: Solver,
    /// The loop modulo a prime, computed at its first use; `None` for an unlucky prime.
    modular: OnceLock<Option<OpenLoop<Drawn>>>,
    /// The loop, enclosed, computed at its first use.
    enclosed: OnceLock<Option<OpenLoop<Enclosure>>>,
    /// A bound on the number of solutions, and what would have been enough when it was computed.
    first_bound: OnceLock<(Bound, usize)>,
    /// The least bound, where the first one is not.
    bound: OnceLock<Bound>,
    /// The exactness of the numbers of the mechanism.
    data: OnceLock<Data>,
}

/// Loops with two spherical joints.
struct SphericalPair {
    layout: Layout,
    open: OpenSsDyad<f64>,
    /// The same dyad in intervals.
    bounds: OpenSsDyad<Interval>,
}

/// Modes of a lower condition number are those of the mechanism that rounded data stand for: these are off by 1e-17.
const FIRM: f64 = 1e10;

/// Closure polynomials tried in multiprecision arithmetic before exact eliminants are: some solutions of special geometry share one
/// or two of the angles that are tried.
const CROWD_TRIES: usize = 3;

/// The tolerance of what has to be met exactly.
const NOTHING: Tolerance = Tolerance { length: 0.0, angle: 0.0 };

/// A solution in spherical joints.
type ExactSolution = exact::Solution<BALL_BITS>;

impl SixUnknowns {
    /// The loop modulo the prime of the run.
    fn modular(&self, chain: &Chain) -> Option<&OpenLoop<Drawn>> {
        self.modular.get_or_init(|| chain.try_open_loop(&self.layout).ok().flatten()).as_ref()
    }

    /// Returns the exactness of the numbers of the mechanism.
    fn data(&self, chain: &Chain) -> &Data {
        self.data.get_or_init(|| Data::of(chain, &self.layout, None))
    }

    /// The loop, enclosed.
    fn open_enclosed(&self, chain: &Chain) -> Option<&OpenLoop<Enclosure>> {
        self.enclosed.get_or_init(|| chain.try_open_loop(&self.layout).ok().flatten()).as_ref()
    }

    /// The loop of a case, enclosed.
    pub(super) fn enclosed(&self, chain: &Chain, case: &Case) -> Result<Option<ClosedLoop<Enclosure>>> {
        let open = self.open_enclosed(chain);
        open.map(|open| Ok(open.close(&closing_transformation(case)?))).transpose()
    }

    /// The loop rounded once, closed by the identity; `None` where its numbers are not known to so many digits.
    fn exact(&self, chain: &Chain) -> Option<ClosedLoop<DoubleDouble>> {
        let open = self.open_enclosed(chain)?;
        Some(open.rounded::<DoubleDouble>(DoubleDouble::BITS)?.close(&Motion::identity()))
    }

    /// Returns a bound on the number of solutions at every pose or input: the least one that is known, unless it is at most
    /// `enough`.
    fn bound(&self, chain: &Chain, enough: usize) -> &Bound {
        let (first, asked) = self.first_bound.get_or_init(|| (self.counted(chain, enough), enough));
        let is_least = first.count > *asked;
        if is_least || first.count <= enough { first } else { self.bound.get_or_init(|| self.counted(chain, 0)) }
    }

    /// The bound on the number of solutions at every pose or input by cuts that are tried until one is at most `enough`.
    fn counted(&self, chain: &Chain, enough: usize) -> Bound {
        let locked = self.layout.locked.map(|k| self.layout.variables[k]);
        let general = |choice| self.data(chain).general(self.modular(chain), locked, choice);
        let other = if locked.is_none() { general(1) } else { None };
        let counted = general(0).and_then(|closed| self.degree(&closed, other.as_ref(), enough));
        let bound = counted.map_or_else(|| Bound::general(self.general()), |d| of_cuts(d, "at general poses"));
        let is_counted = bound.code == Code::CountMet && bound.count == MOST_WITH_TRIPLE;
        if !is_counted || self.layout.spherical_unknown().is_some() {
            return bound;
        }
        self.data(chain).triple(chain, &self.layout, self.open_enclosed(chain)).map_or(bound, of_triple)
    }

    /// The number of solutions, exactly.
    fn degree(&self, closed: &Modular, other: Option<&Modular>, enough: usize) -> Option<Degree> {
        let Some(spherical) = self.layout.spherical_unknown() else { return closed.degree(other, enough) };
        let solutions = closed.reach(spherical)?;
        Some(Degree { solutions, left_out: self.general().saturating_sub(solutions) })
    }

    /// The degree of the closure polynomial of general loops with these unknowns.
    fn general(&self) -> usize {
        self.solver.general_degree()
    }
}

/// A chain, prepared for all its cases.
pub(super) struct SingleLoop {
    pub(super) chain: Chain,
    pub(super) limits: Vec<[f64; 2]>,
    is_rounded: bool,
    prepared: ByInput<Way>,
    /// The chain in f64, made at its first use; `None` where its numbers are not known to so many digits.
    pub(super) forward: OnceLock<Option<Forward>>,
}

impl SingleLoop {
    /// Prepares the chain of an entry for all its cases.
    pub(super) fn prepare(entry: &Entry, chain: &Chain) -> Result<Self> {
        let prepared = ByInput::prepare(entry, chain, |layout| way(chain, layout))?;
        let (chain, limits, forward) = (chain.clone(), entry.limits.clone(), OnceLock::new());
        Ok(Self { chain, limits, is_rounded: entry.rounded, prepared, forward })
    }

    /// Prepares a chain with the virtual joints of a layout, which make six unknowns of fewer.
    pub(super) fn with_virtual_joints(chain: &Chain, layout: Layout) -> Result<Self> {
        let prepared = ByInput::only(layout, |layout| way(chain, layout))?;
        Ok(Self { chain: chain.clone(), limits: Vec::new(), is_rounded: true, prepared, forward: OnceLock::new() })
    }

    /// Solves one case.
    pub(super) fn solve(
        &self,
        case: &Case,
        roots: Roots,
        tolerance: Option<Tolerance>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let mut solution = self.list(case, roots, tolerance, workspace, assembly)?;
        // Real solutions alone do not show whether a root is multiple or one of a motion: the equations do, which have complex ones, too.
        let is_arm = || case.pose.is_some() && self.chain.joint_kinds().iter().all(|kind| *kind == JointKind::Revolute);
        let is_open = |verdict: &Verdict| {
            let is_left = is_left_to_equations(verdict) && verdict.code != Code::NearNotDecided;
            is_left || verdict.code == Code::OnlyReal && is_arm()
        };
        if roots == Roots::Real && is_open(&solution.verdict) && !workspace.only_lists {
            let all = self.list(case, Roots::All, tolerance, workspace, assembly)?;
            solution = Solution { solve_us: solution.solve_us + all.solve_us, ..all.of_real() };
        }
        Ok(solution)
    }

    /// Lists the solutions of one case.
    pub(super) fn list(
        &self,
        case: &Case,
        roots: Roots,
        tolerance: Option<Tolerance>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let Prepared { of, prepare_us, .. } = self.prepared.of(&self.chain, case)?;
        let prepared = match of {
            Way::Six(prepared) => prepared,
            Way::SphericalPair(spherical_joints) => {
                return self.solve_ss_dyad(spherical_joints, *prepare_us, case, roots, workspace, assembly);
            }
        };
        let solver = &prepared.solver;
        let gap = self.gap(prepared, case)?;
        let question = self.question(prepared, case, roots, tolerance, workspace, &gap);
        let start = Instant::now();
        let mut fast = if solver.structural_rank() == 6 { Some(question.answer(workspace, assembly)) } else { None };
        let mut exact_modes = None;
        if prepared.layout.spherical.is_some()
            && !fast.as_ref().is_some_and(|(verdict, _)| is_settled(verdict))
            && let Some((verdict, modes)) = self.exactly(&prepared.layout, case, fast.is_some())?
        {
            let is_whole = case.pose.is_none() || verdict.status == Status::SelfMotion;
            match &mut fast {
                // The pose is also answered by near solutions, which follow the exact ones in the list.
                Some((own, us)) if !is_whole => {
                    (*own, *us, exact_modes) = (verdict, start.elapsed().as_secs_f64() * 1e6, Some(modes));
                }
                _ if !is_whole
                    && verdict.status == Status::Unreachable
                    && !question.is_clear(tolerance.unwrap_or_default()) =>
                {
                    return Ok(exact_solution(
                        case,
                        perhaps_near(&verdict, Code::StructurallyDeficient),
                        modes,
                        *prepare_us,
                        start,
                    ));
                }
                _ => return Ok(exact_solution(case, verdict, modes, *prepare_us, start)),
            }
        }
        let (mut verdict, solve_us) = fast.unwrap_or_else(|| question.answer(workspace, assembly));
        if roots == Roots::All
            && !workspace.only_lists
            && is_left_to_equations(&verdict)
            && prepared.layout.spherical.is_none()
            && matches!(question.data(), Data::Rational)
        {
            let exact = self.exactly(&prepared.layout, case, true)?;
            let exact = match exact {
                None => self.modulo_prime(&prepared.layout, case)?.map(|verdict| (verdict, Vec::new())),
                known => known,
            };
            match exact.map(|(exact, modes)| (exact.status, exact, modes)) {
                Some((Status::SelfMotion, exact, _)) => {
                    verdict = moving(&exact, &verdict, solver.structural_rank());
                    for family in &mut assembly.families {
                        family.dimension = family.dimension.min(exact.self_motion);
                    }
                }
                // Finitely many solutions, but not which. What f64 takes for a self-motion is near the pose.
                Some((Status::Incomplete, exact, _)) if verdict.status == Status::SelfMotion => {
                    verdict = not_moving(&exact, &verdict);
                }
                None | Some((Status::Incomplete, ..)) => {}
                Some((_, exact, modes)) if case.pose.is_none() => {
                    return Ok(exact_solution(case, exact, modes, *prepare_us, start));
                }
                // The pose is also answered by near solutions, which follow the exact ones in the list.
                Some((_, exact, modes)) => (verdict, exact_modes) = (exact, Some(modes)),
            }
        }
        Ok(self.listed(&question, verdict, exact_modes, [*prepare_us, solve_us], assembly))
    }

    /// What is asked in one case, nothing of it computed yet.
    fn question<'a>(
        &'a self,
        prepared: &'a SixUnknowns,
        case: &'a Case,
        roots: Roots,
        tolerance: Option<Tolerance>,
        workspace: &Workspace,
        gap: &'a Gap,
    ) -> Question<'a> {
        Question {
            of: self,
            prepared,
            case,
            roots,
            leaves_fields: workspace.leaves_fields,
            only_lists: workspace.only_lists,
            only_real_list: workspace.only_real_list || roots == Roots::Real,
            real_first: workspace.real_first,
            tolerance: case.pose.is_some().then_some(tolerance.unwrap_or_default()),
            rounding: if tolerance.is_none() { case.rounding } else { None },
            gap,
            by_cuts: OnceCell::new(),
            ring: OnceCell::new(),
            resolved: RefCell::new(None),
            data: OnceCell::new(),
        }
    }

    /// The answer with the modes of the list, or those of the exact side in their place, and what is near the pose behind them.
    fn listed(
        &self,
        question: &Question<'_>,
        mut verdict: Verdict,
        exact_modes: Option<Vec<FullMode>>,
        [prepare_us, solve_us]: [f64; 2],
        assembly: &Assembly,
    ) -> Solution {
        let Question { prepared, case, roots, gap, .. } = *question;
        let solver = &prepared.solver;
        if solver.structural_rank() < 6 {
            verdict.reason += &dependent(&self.chain, &prepared.layout, solver.axis_triples());
            if case.pose.is_none() {
                verdict.reason +=
                    &format!("; the loop has {}, as `looproot mobility` tells in full", Freedom::of(&self.chain));
            }
        }
        let locked_value = Complex::from(locked_value(case));
        let values = |mode: &Mode| prepared.layout.assemble(&mode.unknowns, locked_value);
        let full = |mode: &Mode| full_mode(mode, values(mode), &prepared.layout.variables, &self.limits);
        let is_listed = |mode: &&Mode| mode.real || roots == Roots::All;
        let mut modes =
            exact_modes.unwrap_or_else(|| assembly.modes.iter().filter(is_listed).map(full).collect::<Vec<_>>());
        let vicinity = Vicinity { of: self, prepared, locked: locked_value.re, gap };
        let is_moving = verdict.status == Status::SelfMotion;
        let mut families = if is_moving { vicinity.families(&assembly.families) } else { Vec::new() };
        if let (Some(pose), Some(tolerance)) = (&case.pose, question.tolerance) {
            let (near, tolerance) = question.near(&vicinity, pose, tolerance, &mut verdict, assembly);
            vicinity.list(&near, tolerance, &mut modes, &mut families);
        }
        let warnings = case.warnings.clone();
        Solution { arm: None, nearest: None, families, verdict, modes, warnings, prepare_us, solve_us, platform: None }
    }

    /// The closing transformation of a case in f64.
    fn gap(&self, prepared: &SixUnknowns, case: &Case) -> Result<Gap> {
        let solver = &prepared.solver;
        let float = case.pose.as_ref().and_then(Placement::inverse_in_f64);
        let is_exact = float.is_some() || is_rational(case);
        let gap = solver.gap(&float.map_or_else(|| closing_transformation(case), Ok)?);
        // Irrational numbers of a pose are enclosed: the rationals in their place have the digits that are printed.
        if is_exact && !gap.is_rough() {
            return Ok(gap);
        }
        let closed = prepared.enclosed(&self.chain, case)?.and_then(|closed| closed.rounded(f64::MANTISSA_DIGITS));
        Ok(closed.map_or(gap, |ClosedLoop { constants: [.., last], .. }| solver.exact_gap(&last)))
    }

    /// The answer to a loop with a spherical joint over the rationals; `None` where rounded data may hide what there is, and
    /// f64 has an answer.
    fn exactly(&self, layout: &Layout, case: &Case, is_known: bool) -> Result<Option<(Verdict, Vec<FullMode>)>> {
        let is_rounded = self.is_rounded || !is_exact(case);
        if is_rounded && is_known {
            return Ok(None);
        }
        let question = ExactQuestion { chain: &self.chain, layout, case, limits: &self.limits, is_rounded };
        Ok(question.answer()?.filter(|(verdict, _)| !is_rounded || verdict.real > 0 || verdict.self_motion > 0))
    }

    /// The dimension of the solutions modulo a prime, as a verdict; `None` where it takes too long, and for rounded data.
    fn modulo_prime(&self, layout: &Layout, case: &Case) -> Result<Option<Verdict>> {
        if self.is_rounded || !is_exact(case) {
            return Ok(None);
        }
        ExactQuestion { chain: &self.chain, layout, case, limits: &self.limits, is_rounded: false }.modulo_prime()
    }

    /// Solves a loop with two spherical joints.
    fn solve_ss_dyad(
        &self,
        prepared: &SphericalPair,
        prepare_us: f64,
        case: &Case,
        roots: Roots,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let start = Instant::now();
        let layout = &prepared.layout;
        let ss_dyad = prepared.open.close(&closing_transformation(case)?);
        let idle = idle_spin(&self.chain, layout, ss_dyad.indices[1]);
        // Where the equation may not depend on its unknown, rounding would produce roots.
        let bounds = spherical_pair::equation(&prepared.bounds.close(&closing_transformation(case)?));
        let is_equation = bounds[1..].iter().any(|c| c.mignitude() > 0.0);
        let spherical_joints = is_equation.then(|| ss_dyad::solve(&ss_dyad, roots, workspace, assembly));
        let fast = spherical_joints.map(|spherical_joints| {
            let general = || Bound::general(2);
            (verdict(assembly, roots, 6, 2, general, || None, None), spherical_joints)
        });
        let settled = fast.filter(|(verdict, _)| is_settled(verdict));
        let Some((mut verdict, spherical_joints)) = settled else {
            let (mut verdict, modes) = self.ss_dyad_exactly(layout, case)?;
            verdict.reason = format!("{}; {idle}", verdict.reason);
            return Ok(exact_solution(case, verdict, modes, prepare_us, start));
        };
        let solve_us = start.elapsed().as_secs_f64() * 1e6;
        verdict.reason = format!("{}; {idle}", verdict.reason);
        let modes = assembly.modes.iter().zip(spherical_joints).map(|(mode, spherical_joints)| {
            let mut q = vec![Complex::from(locked_value(case)); layout.variables.len()];
            for (&at, angles) in ss_dyad.indices.iter().zip(spherical_joints) {
                q[at..at + 3].copy_from_slice(&angles);
            }
            q[ss_dyad.indices[2]] = mode.unknowns[5];
            full_mode(mode, q, &layout.variables, &self.limits)
        });
        Ok(Solution { solve_us, ..exact_solution(case, verdict, modes.collect(), prepare_us, start) })
    }
}

impl SingleLoop {
    /// The answer to a loop with two spherical joints over the rationals.
    fn ss_dyad_exactly(&self, layout: &Layout, case: &Case) -> Result<(Verdict, Vec<FullMode>)> {
        let ss_dyad = self.chain.ss_dyad_loop::<Rational>(layout, &closing_transformation(case)?)?;
        let given = vec![Complex::from(locked_value(case)); layout.variables.len()];
        let is_rounded = self.is_rounded || !is_exact(case);
        let unit = self.chain.unit().to_f64();
        let (verdict, mut modes) = SsDyadQuestion { ss_dyad: &ss_dyad, given, unit, is_rounded }.answer();
        for mode in modes.iter_mut().filter(|mode| mode.real && !self.limits.is_empty()) {
            mode.within_limits = Some(within_limits(&mode.q, &layout.variables, &self.limits));
        }
        Ok((verdict, modes))
    }
}

/// One case, with results that are computed at their first use.
struct Question<'a> {
    of: &'a SingleLoop,
    prepared: &'a SixUnknowns,
    case: &'a Case,
    roots: Roots,
    /// As in [`Workspace::leaves_fields`].
    leaves_fields: bool,
    /// As in [`Workspace::only_lists`].
    only_lists: bool,
    /// Whether a list counts as complete once its real solutions are.
    only_real_list: bool,
    /// As in [`Workspace::real_first`].
    real_first: bool,
    /// The tolerance of a pose.
    tolerance: Option<Tolerance>,
    /// What typing rounded the pose by, where no tolerance was asked for.
    rounding: Option<Tolerance>,
    gap: &'a Gap,
    /// The exact count of all cuts.
    by_cuts: OnceCell<Option<Degree>>,
    /// The plan by which the ring of the loop is computed.
    ring: OnceCell<Option<Plan>>,
    /// The resolution by the eliminants, with the number of solutions known at that time.
    resolved: RefCell<Option<(usize, Resolution)>>,
    /// The exactness of the numbers of the case, where its own are not rational.
    data: OnceCell<Data>,
}

impl Question<'_> {
    /// Returns the exactness of the numbers of the mechanism and of the case.
    fn data(&self) -> &Data {
        let SingleLoop { chain, .. } = self.of;
        if is_rational(self.case) {
            return self.prepared.data(chain);
        }
        self.data.get_or_init(|| Data::of(chain, &self.prepared.layout, Some(self.case)))
    }

    fn is_rounded(&self) -> bool {
        self.data().is_rounded()
    }

    fn modular(&self) -> Option<Modular> {
        let SingleLoop { chain, .. } = self.of;
        self.data().modular(self.prepared.modular(chain), chain, self.case)
    }

    fn plan(&self) -> Option<&Plan> {
        let has_spherical_joint = self.prepared.layout.spherical_unknown().is_some();
        self.ring.get_or_init(|| self.modular().filter(|_| !has_spherical_joint)?.plan()).as_ref()
    }

    /// A bound at this pose: the ring is asked where the cuts know of nothing, or of more than `found`.
    fn count_here(&self, found: usize) -> Option<Bound> {
        let degree = *self.by_cuts.get_or_init(|| self.prepared.degree(&self.modular()?, None, 0));
        let bound = degree.map(|degree| of_cuts(degree, "at this pose"));
        if bound.as_ref().is_some_and(|bound| bound.count <= found) {
            return bound;
        }
        let ring = self.plan().map(|plan| of_ring(plan.count()));
        bound.into_iter().chain(ring).min_by_key(|bound| bound.count)
    }

    fn judge(&self, roots: Roots, assembly: &Assembly) -> Verdict {
        let SixUnknowns { solver, .. } = self.prepared;
        let everywhere = || {
            // The exact count costs more than a search for real roots, and rarely helps one.
            let skip = self.only_lists || roots == Roots::Real && !solver.is_special();
            let all = || self.prepared.bound(&self.of.chain, assembly.total()).clone();
            if skip { Bound::general(self.prepared.general()) } else { all() }
        };
        let (rank, general) = (self.rank(), self.prepared.general());
        let here = || if self.only_lists { None } else { self.count_here(assembly.total()) };
        verdict(assembly, roots, rank, general, everywhere, here, self.too_far())
    }

    /// Returns the number of solutions, where all are requested and some are missing.
    fn expected(&self, verdict: &Verdict) -> Option<usize> {
        if self.only_lists || self.roots == Roots::Real || self.rank() < 6 {
            return None;
        }
        // A motion seen in f64 is refuted by the exact equations, unless the data are rounded.
        let is_refuted = || self.case.pose.is_none() && !self.is_rounded() && self.plan().is_some();
        let here = || self.count_here(0).map(|here| here.count);
        match verdict.status {
            Status::Incomplete => {
                let everywhere = self.prepared.bound(&self.of.chain, 0).count;
                Some(here().map_or(everywhere, |here| here.min(everywhere)))
            }
            // The exact count of three rotations detects every self-motion: if it finds none, f64 was mistaken.
            Status::SelfMotion if self.prepared.general() == 2 || is_refuted() => here(),
            _ => None,
        }
    }

    /// The verdict after a look in multiprecision arithmetic for what is missing; `None` where nothing is.
    fn completed(&self, verdict: &Verdict, assembly: &mut Assembly) -> Option<Verdict> {
        let expected = self.expected(verdict)?;
        self.solve_in_high_precision::<LongFloat>(expected, assembly);
        let verdict = self.judge(self.roots, assembly);
        if verdict.status != Status::Incomplete {
            return Some(verdict);
        }
        // Solutions that only the rounding of the data keeps from infinity.
        self.solve_in_high_precision::<LongerFloat>(expected, assembly);
        Some(self.judge(self.roots, assembly))
    }

    /// Looks again for what is missing of a list, in multiprecision arithmetic.
    fn solve_in_high_precision<R: Extended>(&self, expected: usize, assembly: &mut Assembly) {
        let enclosed = self.prepared.enclosed(&self.of.chain, self.case).ok().flatten();
        if let Some(closed) = enclosed.and_then(|closed| closed.rounded::<R>(R::BITS)) {
            self.prepared.solver.solve_in_high_precision(&closed, self.plan(), expected, MOST_TRIES, assembly);
        }
    }

    /// The verdict at a pose whose solutions are too near to each other for f64, but simple: as many as the geometry can have at most are
    /// proved in multiprecision arithmetic. `None` where that is not so; then the list is as it was.
    ///
    /// A pose typed with all digits of f64 is never singular but by chance, and this takes a tenth of the time of exact eliminants.
    fn of_crowd(&self, verdict: &Verdict, assembly: &mut Assembly) -> Option<Verdict> {
        let is_open = matches!(verdict.status, Status::Incomplete | Status::SelfMotion) && !verdict.proof.is_proved();
        if !is_open || self.case.pose.is_none() || self.prepared.solver.structural_rank() < 6 {
            return None;
        }
        let most = self.prepared.bound(&self.of.chain, 0).count;
        let enclosed = self.prepared.enclosed(&self.of.chain, self.case).ok().flatten()?;
        let closed = enclosed.rounded::<LongFloat>(LongFloat::BITS)?;
        let mut crowd = Assembly::default();
        self.prepared.solver.solve_in_high_precision(&closed, None, most, CROWD_TRIES, &mut crowd);
        let verdict = if crowd.total() < most { return None } else { self.judge(Roots::All, &crowd) };
        is_settled(&verdict).then(|| {
            *assembly = crowd;
            verdict
        })
    }

    /// The answer to a loop without input by one pencil in f64 and multiprecision arithmetic; `None` where they do not settle it.
    ///
    /// Solutions are crowded there where a mechanism was that moved before it was made with an error: f64 cannot tell them
    /// apart, and to let it try costs more than multiprecision arithmetic.
    fn by_longer_numbers(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> Option<Verdict> {
        let SixUnknowns { solver, .. } = self.prepared;
        let is_structure = self.case.pose.is_none() && self.case.input.is_empty();
        if self.roots == Roots::Real || !is_structure || solver.structural_rank() < 6 {
            return None;
        }
        solver.solve_briefly(self.gap, workspace, assembly);
        let mut verdict = self.judge(self.roots, assembly);
        if verdict.status == Status::Incomplete {
            self.plan()?;
            verdict = self.completed(&verdict, assembly)?;
        }
        // No mode would be elsewhere, or none at all, had the data been rounded in another way.
        let is_firm = || !self.is_rounded() || assembly.modes.iter().all(|mode| mode.condition < FIRM);
        (verdict.status != Status::Incomplete && is_firm()).then_some(verdict)
    }

    /// The verdict, and microseconds for the search.
    fn answer(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> (Verdict, f64) {
        let start = Instant::now();
        let verdict = self.without_solution(self.verdict(workspace, assembly));
        (verdict, start.elapsed().as_secs_f64() * 1e6)
    }

    fn verdict(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> Verdict {
        if let Some(verdict) = self.far_away(assembly) {
            return verdict;
        }
        if let Some(verdict) = self.by_longer_numbers(workspace, assembly) {
            return self.by_exact_roots(verdict, assembly).0;
        }
        let most = |known| self.most(known);
        let SixUnknowns { solver, .. } = self.prepared;
        let quick = self.by_closed_form(workspace, assembly).or_else(|| self.by_groups(workspace, assembly));
        if let Some(verdict) = quick {
            return verdict;
        }
        let is_first = self.real_first && !solver.is_decoupled();
        if self.roots == Roots::Real && self.has_real_list(workspace, assembly)
            || is_first && self.has_quick_real_list(workspace, assembly)
        {
            return of_real_zeros(assembly);
        }
        if self.has_eliminants() {
            if self.only_real_list && !solver.is_decoupled() {
                solver.solve_briefly(self.gap, workspace, assembly);
                let found = assembly.total();
                if found >= most(found) {
                    let verdict = self.judge(self.roots, assembly);
                    if is_settled(&verdict) {
                        return verdict;
                    }
                }
                if let Some(verdict) = self.of_real_alone(assembly) {
                    return verdict;
                }
                if self.has_real_list(workspace, assembly) {
                    return of_real_zeros(assembly);
                }
            }
            solver.solve_by_pencils(self.gap, &most, workspace, assembly);
            let verdict = self.judge(self.roots, assembly);
            if let Some(verdict) = self.beside_real_zeros(&verdict, workspace, assembly) {
                return verdict;
            }
            if let Some(verdict) = self.of_crowd(&verdict, assembly) {
                return verdict;
            }
            let (verdict, is_settled) = self.by_exact_roots(verdict, assembly);
            if is_settled {
                return verdict;
            }
        }
        solver.solve_up_to(self.gap, self.roots, &most, workspace, assembly);
        let mut verdict = self.judge(self.roots, assembly);
        if let Some(verdict) = self.beside_real_zeros(&verdict, workspace, assembly) {
            return verdict;
        }
        if !self.has_eliminants()
            && let Some(completed) = self.completed(&verdict, assembly)
        {
            verdict = completed;
        }
        let (mut verdict, _) = self.by_exact_roots(verdict, assembly);
        if verdict.status == Status::SelfMotion
            && self.is_rounded()
            && self.case.pose.is_none()
            && let Some(plan) = self.plan()
        {
            let count = plan.count();
            verdict.reason += &format!(
                "; to rounding, that is: the equations of the rational numbers that the data were rounded to have \
                 isolated solutions only, at most {count}"
            );
        }
        verdict
    }

    /// The verdict on a loop of dependent joints that has no solution modulo the prime: proved where the same combination of
    /// the closure equations is 1 over the rationals.
    fn without_solution(&self, verdict: Verdict) -> Verdict {
        if verdict.code != Code::NoSolution || verdict.proof != Proof::None {
            return verdict;
        }
        // A contradiction in intervals holds for every value of the data.
        if self.is_clear(NOTHING) {
            let reason = format!("{}; in intervals 1 is a combination of the closure equations", verdict.reason);
            return Verdict { proof: Proof::Proved, reason, ..verdict };
        }
        let is_over_rationals = !matches!(self.data(), Data::Field(_));
        if is_over_rationals
            && let (Some(plan), Some(closed)) = (self.plan(), self.exact())
            && has_no_solution(&closed, plan)
        {
            let reason = verdict.reason.replace(MODULO, "over the rationals");
            return Verdict { proof: Proof::Proved.of_rounded(self.is_rounded()), reason, ..verdict };
        }
        let proof = Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() };
        Verdict { proof: if self.is_rounded() { Proof::None } else { proof }, ..verdict }
    }

    /// Whether the solutions are roots of eliminants that decide what f64 leaves open.
    fn has_eliminants(&self) -> bool {
        !self.only_lists && self.roots == Roots::All && self.has_rotations_alone()
    }

    /// Whether all unknowns are rotations, and none belongs to a spherical joint.
    fn has_rotations_alone(&self) -> bool {
        let kinds = self.prepared.layout.loop_kinds();
        kinds.iter().all(|kind| *kind == Variable::Rotation) && self.prepared.layout.spherical_unknown().is_none()
    }

    /// The loop rounded to f64, lengths over a unit, and that unit.
    fn in_f64(&self) -> Option<(ClosedLoop<f64>, f64)> {
        let closed = self.prepared.enclosed(&self.of.chain, self.case).ok().flatten()?;
        Some(in_unit(closed.rounded(f64::MANTISSA_DIGITS)?))
    }

    /// The loop over the rationals.
    fn exact(&self) -> Option<ClosedLoop<Rational>> {
        let open: OpenLoop<Rational> = self.of.chain.try_open_loop(&self.prepared.layout).ok().flatten()?;
        Some(open.close(&closing_transformation(self.case).ok()?))
    }

    /// Returns the rank of the six joint screws in general position. A rank deficient in f64 is computed modulo the prime, where
    /// full rank proves full rank.
    fn rank(&self) -> usize {
        let measured = self.prepared.solver.structural_rank();
        if measured == 6 {
            return measured;
        }
        self.modular().map_or(measured, |closed| closed.rank().max(measured))
    }
}

/// An answer without families, the search for which began at that time.
fn exact_solution(case: &Case, verdict: Verdict, modes: Vec<FullMode>, prepare_us: f64, start: Instant) -> Solution {
    Solution {
        arm: None,
        nearest: None,
        families: Vec::new(),
        verdict,
        modes,
        warnings: case.warnings.clone(),
        prepare_us,
        solve_us: start.elapsed().as_secs_f64() * 1e6,
        platform: None,
    }
}

/// A loop with lengths over a power of two near the mean link: residuals and condition numbers are
/// those of such lengths.
fn in_unit(mut closed: ClosedLoop<f64>) -> (ClosedLoop<f64>, f64) {
    let square = closed.constants.iter().flat_map(|motion| motion.translation).map(|x| x * x).sum::<f64>() / 6.0;
    let unit = unit_near(square.sqrt());
    for motion in &mut closed.constants {
        *motion = motion.over(unit);
    }
    (closed, unit)
}

/// The way to solve a loop, prepared.
fn way(chain: &Chain, layout: Layout) -> Result<Way> {
    if layout.second_spherical.is_some() {
        let enclosed: OpenSsDyad<Enclosure> = chain.open_ss_dyad(&layout, &Numbers)?;
        let open = enclosed.rounded(f64::MANTISSA_DIGITS);
        let open = open.ok_or_else(|| Error::Unsupported("numbers that are not known to 16 digits".into()))?;
        let bounds = chain.open_ss_dyad(&layout, &Numbers)?;
        return Ok(Way::SphericalPair(Box::new(SphericalPair { layout, open, bounds })));
    }
    let open: OpenLoop<f64> = chain.open_loop(&layout)?;
    let solver = match layout.spherical_unknown() {
        Some(spherical) => Solver::with_spherical_joint(&open, spherical),
        None => Solver::prepare(&open),
    };
    if solver.is_out_of_reach() {
        let rotations = layout_rotations(&open);
        let rank = solver.structural_rank();
        return Err(Error::UnsupportedMobility(format!(
            "{rotations} unknown rotations: with fewer than three, links move in parallel planes or without turning; the \
             screw rank is {rank} of 6, so that {} of the six unknowns stay free or the loop does not close ({} of the \
             whole loop); solved are loops with three unknown rotations at least: give a distance in place of an angle",
            6 - rank,
            Freedom::of(chain)
        )));
    }
    let (modular, enclosed, data) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
    let (first_bound, bound) = (OnceLock::new(), OnceLock::new());
    Ok(Way::Six(Box::new(SixUnknowns { layout, solver, modular, enclosed, first_bound, bound, data })))
}

/// A mode as a user reads it.
pub(super) fn full_mode(mode: &Mode, q: Vec<Complex<f64>>, variables: &[Variable], limits: &[[f64; 2]]) -> FullMode {
    FullMode {
        real: mode.real,
        multiplicity: mode.multiplicity,
        residual: mode.residual,
        condition: mode.condition,
        certified: mode.certificate.is_some(),
        radius: mode.certificate.map_or(f64::INFINITY, |c| c.radius),
        within_limits: (mode.real && !limits.is_empty()).then(|| within_limits(&q, variables, limits)),
        q,
        near: false,
        error: None,
        platform: None,
    }
}

fn layout_rotations(open: &OpenLoop<f64>) -> usize {
    open.variables.iter().filter(|v| **v == Variable::Rotation).count()
}

/// The loop of one case over a ring, and the order of its variables; `None` for an unlucky prime.
///
/// # Errors
/// For chains that are not solved, and for a case without pose and input.
pub fn closed_loop<R: Ring>(chain: &Chain, case: &Case) -> Result<Option<(Layout, ClosedLoop<R>)>> {
    let layout = Layout::of(chain, locked_variable(chain, case)?)?;
    let closed = match R::DIGITS {
        None => closed_over::<R>(chain, &layout, case)?,
        Some(digits) => closed_over::<Enclosure>(chain, &layout, case)?.and_then(|closed| closed.rounded(digits)),
    };
    Ok(closed.map(|closed| (layout, closed)))
}

fn closed_over<R: Ring>(chain: &Chain, layout: &Layout, case: &Case) -> Result<Option<ClosedLoop<R>>> {
    let open: Option<OpenLoop<R>> = chain.try_open_loop(layout)?;
    Ok(open.and_then(|open| Some(open.close(&closing_transformation(case).ok()?))))
}

/// The loop of two spherical joints of one case over a ring; `None` for chains without two spherical joints.
///
/// # Errors
/// As [`closed_loop`], and for an unlucky prime.
pub fn ss_dyad_loop<R: Ring>(chain: &Chain, case: &Case) -> Result<Option<SsDyad<R>>> {
    let layout = Layout::of(chain, locked_variable(chain, case)?)?;
    if layout.second_spherical.is_none() {
        return Ok(None);
    }
    chain.ss_dyad_loop(&layout, &closing_transformation(case)?).map(Some)
}

/// The variable that the input of a loop locks; `None` at the pose of an arm, and for a loop without input.
///
/// # Errors
/// For several given variables, and for a joint that has none of the kind.
pub fn locked_variable(chain: &Chain, case: &Case) -> Result<Option<usize>> {
    if case.pose.is_some() {
        return Ok(None);
    }
    let [input] = case.input.as_slice() else {
        if case.input.is_empty() {
            return Ok(None);
        }
        return Err(Error::Unsupported(format!(
            "{} given joint variables: a loop of seven variables takes one",
            case.input.len()
        )));
    };
    let variable = Layout::variable_of(chain, input.joint, input.value.variable());
    variable.map(Some).ok_or_else(|| Error::Invalid(format!("joint {} has no such variable", input.joint)))
}

/// Returns the closing transformation of the loop: the inverse of an arm's pose, a loop's locked joint, or the identity without
/// input.
pub(super) fn closing_transformation<R: Ring>(case: &Case) -> Result<Motion<R>> {
    if case.pose.is_none() && case.input.is_empty() {
        return Ok(Motion::identity());
    }
    let motion = case.pose.as_ref().and_then(Placement::inverse_image);
    let motion = motion.or_else(|| {
        case.input.first().and_then(|input| match &input.value {
            InputValue::Angle(angle) => angle_motion(angle),
            InputValue::Distance(distance) => distance_motion(distance),
        })
    });
    motion.ok_or_else(|| Error::Invalid("a case without pose and input".to_owned()))
}

/// Whether the input of a loop is an exact number.
pub(super) fn is_exact(case: &Case) -> bool {
    case.input.iter().all(|input| input.value.is_exact())
}

pub(super) fn locked_value(case: &Case) -> f64 {
    case.input.first().map_or(0.0, |input| match &input.value {
        InputValue::Angle(angle) => wrapped(angle.radians()),
        InputValue::Distance(distance) => distance.to_f64(),
    })
}

/// Whether every joint can be within its limits, angles modulo whole turns.
pub(super) fn within_limits(q: &[Complex<f64>], variables: &[Variable], limits: &[[f64; 2]]) -> bool {
    q.iter().zip(variables).zip(limits).all(|((value, variable), [low, high])| match variable {
        Variable::Translation => (*low..=*high).contains(&value.re),
        Variable::Rotation => {
            let above = value.re + TAU * ((low - value.re) / TAU).ceil();
            above <= *high
        }
    })
}
