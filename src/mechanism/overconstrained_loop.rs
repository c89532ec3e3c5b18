//! Loops with fewer than six unknowns: overconstrained mechanisms and structures.

mod apart;
mod beside;
mod few_revolutes;

use super::by_input::{ByInput, Prepared};
use super::exact_loop::{self, Question};
use super::single_loop::{SingleLoop, closing_transformation, full_mode, is_exact, locked_value, within_limits};
use super::spherical_chain::{Positions, positions};
use super::{FullMode, Solution};
use crate::algebra::drawn::Drawn;
use crate::algebra::long_float::LongFloat;
use crate::algebra::number::{Angle, HalfTangent, Number, nearest_f64};
use crate::algebra::sort;
use crate::assembly::{Assembly, Gap, Mode, Roots, Solver, Workspace, by_ring, proof, wrapped};
use crate::catalogue::entry::{Case, Entry, Input, InputValue};
use crate::elimination::common_roots::common_roots;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::degree::{degree, general_closing};
use crate::error::{Error, Result};
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop, Variable};
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::Motion;
use crate::solve::newton::{Six, closure};
use crate::solve::singular::structural_rank;
use crate::verdict::{Code, Proof, Status, Verdict};
use looproot_calculus::finite::finite;
use nalgebra::{SMatrix, SVector};
use num_complex::Complex;
use rug::Rational;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

/// The field of exact counts.
type Mod = Drawn;

/// Virtual joints up to this, in radians and lengths over the mean link, may be rounding of zero; how many of them are,
/// the exact count says.
const NEARLY_ZERO: f64 = 1e-6;
/// Virtual joints up to this are zero where the data of the mechanism were rounded.
const ZERO: f64 = 1e-11;
/// A loop that closes no better than this, its virtual joints at zero and the others at their best, does not close: it is one
/// made with a small error.
const OPEN: f64 = 1e-11;
/// Closure residuals up to this are rounding: where the equations enlarge it, virtual joints may be larger. Loops that close so
/// well count as solutions before they are counted exactly.
const CLOSED: f64 = 1e-13;
/// Number of choices of virtual axes after which the search is given up.
const CHOICES: u32 = 2;
/// At how many places each joint of a loop without input is held, to find out whether the others follow.
const PLACES: i32 = 3;
/// Steps of the least-squares polishing.
const POLISHINGS: usize = 4;
/// Singular values below this part of the largest count as zero there.
const RANK: f64 = 1e-9;

/// Why there is no solution.
const OPEN_BY_RING: &str = "no solution: 1 is a combination of the closure equations";

/// One choice of virtual joints, prepared.
struct Rung {
    layout: Layout,
    solver: Solver,
    /// The loop with lengths over the mean link.
    open: OpenLoop<f64>,
    /// Upper bound on the number of solutions at any input, with the virtual joints free, computed at its first use; `None` where
    /// the closure polynomials vanish.
    most: OnceLock<Option<usize>>,
    /// The count of solutions, computed at its first use; `None` for an unlucky prime.
    counting: OnceLock<Option<Counting>>,
    /// The loop with the virtual joints, prepared at its first use to prove all solutions; `None` where it is out of reach.
    longer: OnceLock<Option<Box<SingleLoop>>>,
}

/// Two other choices of idle axes, modulo a prime.
struct Counting {
    loops: [OpenLoop<Mod>; 2],
    is_idle: [bool; 6],
}

/// One choice of the locked variable.
struct Ladder {
    /// Without virtual joints.
    layout: Layout,
    rungs: Vec<Rung>,
    /// Whether the unknowns are dependent in every position, whatever is added: only the rationals answer then.
    is_dependent: bool,
    /// Whether an answer over the rationals took too long at some input; it is then not tried at others.
    is_long: AtomicBool,
}

/// A chain with too few unknowns, prepared for all its cases.
pub(super) struct OverconstrainedLoop {
    chain: Chain,
    limits: Vec<[f64; 2]>,
    is_rounded: bool,
    prepared: ByInput<Ladder>,
}

/// A bound on the number of solutions.
#[derive(Clone, Copy)]
struct Count {
    most: usize,
    /// Whether it is the dimension of the ring of the closure equations, not the number of common roots.
    is_of_ring: bool,
}

/// A possible solution.
#[derive(Clone)]
struct Candidate {
    mode: Mode,
    /// The joint variables in joint order.
    q: Vec<Complex<f64>>,
    /// The largest of its virtual joints, in radians and lengths over the mean link.
    idle: f64,
}

use exact_loop::Answer;

/// Whether a loop has fewer than six unknowns.
pub(super) fn is_short(entry: &Entry, chain: &Chain) -> Result<bool> {
    let given = entry.cases.first().map_or(0, |case| case.input.len());
    Ok(Layout::of(chain, None)?.variables.len() < 6 + given)
}

/// The layout with virtual joints by which a loop is followed: with rotations only, which stay independent of the joints
/// where those are parallel to a plane.
///
/// # Errors
/// [`Error::Unsupported`] where no choice of virtual joints serves.
pub(super) fn filled_up(chain: &Chain, layout: Layout) -> Result<Layout> {
    if layout.missing() == 0 {
        return Ok(layout);
    }
    if layout.spherical.is_some() {
        return with_idle_rotations(chain, &layout);
    }
    let last = rungs(chain, &layout)?.into_iter().next_back();
    Ok(last.map_or(layout, |rung| rung.layout))
}

/// The layout of a loop with a spherical joint with idle rotations that are independent of its joints.
fn with_idle_rotations(chain: &Chain, layout: &Layout) -> Result<Layout> {
    for choice in 0..CHOICES {
        let filled = layout.with_idle(layout.missing(), choice);
        let open: OpenLoop<f64> = chain.open_loop(&filled)?;
        if structural_rank(&open.close(&Motion::identity())) == 6 {
            return Ok(filled);
        }
    }
    Err(dependent(chain))
}

fn dependent(chain: &Chain) -> Error {
    Error::UnsupportedMobility(format!(
        "the joints of this loop are dependent in every position, so that part of it moves by itself: {}",
        Freedom::of(chain)
    ))
}

/// Returns the choices of virtual joints by which a loop can be solved: first the simplest, with as many translations as leave
/// the six unknowns independent in general position, then rotations only.
fn rungs(chain: &Chain, layout: &Layout) -> Result<Vec<Rung>> {
    // A spherical joint has its own route.
    if layout.spherical.is_some() && layout.second_spherical.is_none() {
        return Ok(Vec::new());
    }
    let unit = chain.unit().to_f64();
    let mut rungs = Vec::new();
    for rotations in 0..=layout.missing() {
        if !rungs.is_empty() && rotations < layout.missing() {
            continue;
        }
        for choice in 0..CHOICES {
            let layout = layout.with_idle(rotations, choice);
            let open: OpenLoop<f64> = chain.open_loop(&layout)?;
            let solver = Solver::prepare(&open);
            if solver.is_out_of_reach() || solver.structural_rank() < 6 {
                break;
            }
            let open = open.over(unit);
            let (most, counting, longer) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
            rungs.push(Rung { layout, solver, open, most, counting, longer });
        }
    }
    if rungs.is_empty() {
        return Err(dependent(chain));
    }
    Ok(rungs)
}

impl OverconstrainedLoop {
    /// Prepares the chain of an entry for all its cases.
    pub(super) fn prepare(entry: &Entry, chain: &Chain) -> Result<Self> {
        let ladder = |layout: Layout| {
            let (rungs, is_dependent) = match rungs(chain, &layout) {
                Err(Error::UnsupportedMobility(_)) => (Vec::new(), true),
                rungs => (rungs?, false),
            };
            Ok(Ladder { layout, rungs, is_dependent, is_long: AtomicBool::new(false) })
        };
        let prepared = ByInput::prepare(entry, chain, ladder)?;
        Ok(Self { chain: chain.clone(), limits: entry.limits.clone(), is_rounded: entry.rounded, prepared })
    }

    /// Solves one case.
    pub(super) fn solve(
        &self,
        case: &Case,
        roots: Roots,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Solution> {
        let Prepared { of: ladder, prepare_us, .. } = self.prepared.of(&self.chain, case)?;
        let start = Instant::now();
        let locked = ladder.layout.locked;
        let exact = self.exactly(ladder, case)?;
        if ladder.is_dependent && exact.is_none() {
            return Err(dependent(&self.chain));
        }
        // A loop that does not close, or closes at points, need not be searched for a motion.
        let is_asked = locked.is_none() && !self.is_rounded;
        let points = if is_asked && exact.is_none() { self.count_by_ring(&ladder.layout, case) } else { None };
        let moving = match points {
            _ if exact.is_some() => exact,
            Some(0) => Some((outcome(Status::Unreachable, 0, OPEN_BY_RING.to_owned()), Vec::new())),
            None if locked.is_none() => self.motion(workspace, assembly)?,
            _ => None,
        };
        let mut families = Vec::new();
        let (verdict, modes) = match moving {
            Some((verdict, modes)) if verdict.status == Status::SelfMotion && modes.is_empty() && locked.is_some() => {
                let beside = self.beside(ladder, case, verdict, workspace, assembly)?;
                families = beside.families;
                (beside.verdict, beside.modes)
            }
            Some(answer) => answer,
            None => {
                let (found, modes) = self.isolated(ladder, case, roots, workspace, assembly)?;
                let is_open = found.proof == Proof::None && found.complex == 0 && found.self_motion == 0;
                let denied = if is_open { self.denied(ladder, case, workspace, assembly) } else { None };
                (denied.unwrap_or(found), modes)
            }
        };
        let mut warnings = case.warnings.clone();
        if locked.is_some() && verdict.complex == 0 && verdict.self_motion == 0 {
            warnings.push(format!(
                "an overconstrained loop: {}; it can be assembled at an input only with special dimensions, and looproot mobility \
                 decides whether it moves; a loop of mobility 1 in general has seven joint variables",
                Freedom::of(&self.chain)
            ));
        }
        Ok(Solution {
            arm: None,
            nearest: None,
            families,
            verdict,
            modes,
            warnings,
            prepare_us: *prepare_us,
            solve_us: start.elapsed().as_secs_f64() * 1e6,
            platform: None,
        })
    }

    /// The answer over the rationals; `None` where it takes too long, and where only the rounding of the data may keep the
    /// loop from closing.
    fn exactly(&self, ladder: &Ladder, case: &Case) -> Result<Option<Answer>> {
        if ladder.is_long.load(Ordering::Relaxed) {
            return Ok(None);
        }
        let layout = &ladder.layout;
        let is_rounded = self.is_rounded || !is_exact(case);
        let question = Question { chain: &self.chain, layout, case, limits: &self.limits, is_rounded };
        let answer = question.answer()?;
        ladder.is_long.store(answer.is_none(), Ordering::Relaxed);
        Ok(answer.filter(|(verdict, _)| !is_rounded || verdict.real > 0 || verdict.self_motion > 0))
    }

    /// Returns the motion of a loop without input; `None` where it has isolated modes only.
    fn motion(&self, workspace: &mut Workspace, assembly: &mut Assembly) -> Result<Option<Answer>> {
        let variables = Layout::of(&self.chain, None)?.variables;
        let mut complex: Option<(usize, usize)> = None;
        for locked in 0..variables.len() {
            let layout = Layout::of(&self.chain, Some(locked))?;
            if layout.spherical.is_some_and(|spherical| (spherical..spherical + 3).contains(&locked)) {
                continue;
            }
            // A joint without which the others are dependent cannot be held to find the motion.
            let Ok(rungs) = rungs(&self.chain, &layout) else { continue };
            let joint = self.joint_of(locked);
            let ladder = Ladder { layout, rungs, is_dependent: false, is_long: AtomicBool::new(true) };
            for number in 0..PLACES {
                let case = self.held(joint, variables[locked], number);
                let (verdict, _) = self.isolated(&ladder, &case, Roots::All, workspace, assembly)?;
                if verdict.real == 0 && verdict.self_motion == 0 {
                    if verdict.complex > 0 {
                        complex = Some((joint, verdict.complex));
                    }
                    continue;
                }
                let dimension = 1 + verdict.self_motion;
                let reason = format!(
                    "solutions form a self-motion of dimension {dimension}: joint {joint} can be held at will, here at \
                     {} with {} real solutions",
                    locked_value(&case),
                    verdict.real
                );
                return Ok(Some((outcome(Status::SelfMotion, dimension, reason), Vec::new())));
            }
        }
        Ok(complex.map(|(joint, solutions)| {
            let reason = format!(
                "not proved: with joint {joint} held there are {solutions} complex solutions, so that the complex \
                 solutions form curves, but no real ones were found"
            );
            (outcome(Status::Incomplete, 0, reason), Vec::new())
        }))
    }

    /// The number of the joint that a variable belongs to.
    fn joint_of(&self, variable: usize) -> usize {
        self.chain.variables().get(variable).map_or(1, |own| own.joint)
    }

    /// The loop held at one of its joint variables, at a place in general position.
    fn held(&self, joint: usize, variable: Variable, number: i32) -> Case {
        let tangent = Rational::from((7 + 24 * number, 11 - 16 * number));
        let value = match variable {
            Variable::Rotation => InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(tangent))),
            Variable::Translation => InputValue::Distance(Number::exact(tangent * self.chain.unit())),
        };
        Case::given(Input { joint, value }, 0)
    }

    /// The isolated solutions of one case.
    fn isolated(
        &self,
        ladder: &Ladder,
        case: &Case,
        roots: Roots,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Answer> {
        if ladder.layout.spherical.is_some() {
            return self.with_spherical_joint(&ladder.layout, case);
        }
        if let Some(answer) = self.with_few_revolutes(&ladder.layout, case)? {
            return Ok(answer);
        }
        let mut best: Vec<Candidate> = Vec::new();
        let mut count: Option<Count> = None;
        let mut self_motion = 0;
        let mut tight: Vec<Candidate> = Vec::new();
        let total = |list: &[Candidate]| list.iter().map(|c| c.mode.multiplicity.max(1)).sum::<usize>();
        for (k, rung) in ladder.rungs.iter().enumerate() {
            // Where closure polynomials vanish at every input, solutions with virtual joints form families.
            let most = *rung.most.get_or_init(|| self.most(&rung.layout));
            if most.is_none() && k + 1 < ladder.rungs.len() {
                continue;
            }
            let mut found = self.candidates(rung, case, roots, most, workspace, assembly)?;
            let closed: Vec<Candidate> = found.iter().filter(|c| c.mode.residual < CLOSED).cloned().collect();
            // Large imaginary parts hide how far a solution is from closing: then all closure polynomials are asked.
            let is_sure = |candidate: &Candidate| candidate.mode.real || candidate.idle < ZERO;
            let enough = if closed.iter().all(is_sure) { total(&closed) } else { 0 };
            count = count.or_else(|| {
                let common = self.count(rung, case, enough).map(|most| Count { most, is_of_ring: false });
                if common.is_some_and(|common| common.most <= enough) {
                    return common;
                }
                let ring = self.count_by_ring(&ladder.layout, case).map(|most| Count { most, is_of_ring: true });
                common.into_iter().chain(ring).min_by_key(|count| count.most)
            });
            self_motion = assembly.self_motion;
            if tight.is_empty() {
                let is_tight = |c: &&Candidate| c.idle < ZERO || c.mode.residual <= CLOSED;
                tight = found.iter().filter(is_tight).cloned().collect();
            }
            // Idle translations let solutions coincide that are simple; idle rotations do not.
            found.truncate(count.map_or(found.len(), |count| fitting(&found, count.most)));
            if total(&found) > total(&best) {
                best = found;
            }
            if roots == Roots::Real || count.is_some_and(|count| count.most == total(&best)) {
                break;
            }
        }
        if roots == Roots::All
            && count.is_some_and(|count| count.most > total(&best))
            && let Some(plan) = self.plan(&ladder.layout, case)
        {
            // The solutions that virtual joints in general position hide.
            let found = self.by_ring(&ladder.layout, case, &plan)?;
            if total(&found) > total(&best) {
                best = found;
            }
        }
        if count.is_none() && self_motion > 0 {
            let reason = format!("solutions form a self-motion of dimension {self_motion}");
            return Ok((outcome(Status::SelfMotion, self_motion, reason), Vec::new()));
        }
        let doubt = self.is_rounded && count.is_some_and(|count| count.most == 0) && !tight.is_empty();
        if doubt {
            best = tight;
        } else if count.is_none() {
            best.retain(|candidate| candidate.idle < ZERO);
        }
        let verdict = self.verdict(&best, if doubt { None } else { count }, roots);
        let proved = matches!(verdict.status, Status::Complete | Status::Unreachable);
        sort::by(&mut best, |a, b| b.mode.real.cmp(&a.mode.real).then_with(|| in_order(&a.q, &b.q)));
        let modes = best.into_iter().map(|Candidate { mode, q, .. }| FullMode {
            certified: proved && mode.certificate.is_some(),
            ..full_mode(&mode, q, &ladder.layout.variables, &self.limits)
        });
        Ok((verdict, modes.collect()))
    }

    /// The isolated solutions of one case of a loop with a spherical joint, all of them exactly.
    fn with_spherical_joint(&self, layout: &Layout, case: &Case) -> Result<Answer> {
        let (found, clear) = match positions(&self.chain, layout, case)? {
            Positions::Isolated { found, clear } => (found, clear),
            Positions::Moving => {
                let reason = "solutions form a self-motion of dimension 1: joints move while the centre of the S joint is where it \
                              has to be";
                return Ok((outcome(Status::SelfMotion, 1, reason.to_owned()), Vec::new()));
            }
        };
        let filled = with_idle_rotations(&self.chain, layout).unwrap_or_else(|_| layout.with_idle(layout.missing(), 0));
        let unit = self.chain.unit().to_f64();
        let closing: Motion<f64> = closing_transformation(case)?;
        let closed = self.chain.open_loop(&filled)?.over(unit).close(&closing.over(unit));
        let joints = filled.joint_variables();
        let units = closed.variables.map(|kind| if kind == Variable::Rotation { 1.0 } else { unit });
        let locked = Complex::from(locked_value(case));
        let mut modes = Vec::new();
        for (q, multiplicity) in found {
            let real = q.iter().all(|x| x.im.abs() < ZERO * (1.0 + x.re.abs()));
            let own = std::array::from_fn(|k| {
                let value = joints[k].map_or(Complex::ZERO, |joint| q[joint] / units[k]);
                if real { Complex::from(value.re) } else { value }
            });
            let (unknowns, residual) = closer(&closed, &own, joints.map(|joint| joint.is_none()), real);
            // With virtual rotations the closure equations have six unknowns, and a simple solution alone is a proof.
            let spherical = joints.iter().position(|joint| joint.is_some() && *joint == layout.spherical);
            let proof = spherical
                .filter(|_| multiplicity == 1)
                .and_then(|spherical| proof(&closed, &unknowns, spherical, real));
            let q = filled.assemble(&std::array::from_fn(|k| unknowns[k] * units[k]), locked);
            let within = (real && !self.limits.is_empty()).then(|| within_limits(&q, &layout.variables, &self.limits));
            modes.push(FullMode {
                q,
                real,
                multiplicity,
                residual,
                condition: proof.map_or(f64::INFINITY, |proof| proof.condition),
                certified: proof.is_some(),
                radius: proof.map_or(f64::INFINITY, |proof| proof.radius),
                within_limits: within,
                near: false,
                error: None,
                platform: None,
            });
        }
        sort::by(&mut modes, |a, b| b.real.cmp(&a.real).then_with(|| in_order(&a.q, &b.q)));
        let total: usize = modes.iter().map(|mode| mode.multiplicity).sum();
        let real = modes.iter().filter(|mode| mode.real).map(|mode| mode.multiplicity).sum();
        let (status, reason) = match (self.is_rounded && !clear, real) {
            (true, _) => {
                let reason = format!(
                    "not proved: {total} found for the rounded data, but an overconstrained loop moves with exact data only"
                );
                (Status::Incomplete, reason)
            }
            (false, 0) if total == 0 => {
                let reason = "no solution: the two equations by which the centre of the S joint is reached from both sides have no \
                              common root";
                (Status::Unreachable, reason.to_owned())
            }
            (false, real) => {
                let reason = format!(
                    "{total} of {total}: all common roots of the two equations by which the centre of the S joint is reached from \
                     both sides, exactly"
                );
                (if real == 0 { Status::Unreachable } else { Status::Complete }, reason)
            }
        };
        if status == Status::Incomplete {
            for mode in &mut modes {
                mode.certified = false;
            }
        }
        let certified = modes.iter().filter(|mode| mode.certified).count();
        Ok((Verdict { complex: total, real, certified, ..outcome(status, 0, reason) }, modes))
    }

    /// Returns the configurations that nearly close the loop, sorted by the size of their virtual joints.
    fn candidates(
        &self,
        rung: &Rung,
        case: &Case,
        roots: Roots,
        most: Option<usize>,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Vec<Candidate>> {
        let Rung { layout, solver, open, .. } = rung;
        let gap = self.gap(rung, case)?;
        solver.solve_up_to(&gap, roots, &|_| most.unwrap_or(usize::MAX), workspace, assembly);
        let setting = self.setting(layout, open, case)?;
        let candidate = |mode: &Mode| {
            let own = std::array::from_fn(|k| mode.unknowns[k] / setting.units[k]);
            setting.candidate(mode, &own, NEARLY_ZERO)
        };
        let mut candidates: Vec<Candidate> = assembly.modes.iter().filter_map(candidate).collect();
        sort::by(&mut candidates, |a, b| a.idle.total_cmp(&b.idle));
        Ok(candidates)
    }

    /// The closing transformation of a case.
    fn gap(&self, Rung { layout, solver, .. }: &Rung, case: &Case) -> Result<Gap> {
        let closing: Motion<f64> = closing_transformation(case)?;
        let gap = solver.gap(&closing);
        if !gap.is_rough() {
            return Ok(gap);
        }
        let open: OpenLoop<Rational> = self.chain.open_loop(layout)?;
        let [.., last] = open.close(&closing_transformation(case)?).constants;
        Ok(last.map(|x| Some(nearest_f64(x))).map_or(gap, |last| solver.exact_gap(&last)))
    }

    /// An exact upper bound of the number of solutions, by the common roots of two choices of virtual unknowns.
    fn count(&self, rung: &Rung, case: &Case, enough: usize) -> Option<usize> {
        let Counting { loops, is_idle } = rung.counting.get_or_init(|| self.counting(&rung.layout)).as_ref()?;
        let closing: Motion<Mod> = closing_transformation(case).ok()?;
        let [one, other] = loops.each_ref().map(|open| open.close(&closing));
        common_roots(&one, &other, *is_idle, enough)
    }

    /// Returns an upper bound on the number of solutions from all closure equations together; `None` where solutions form
    /// families, where that is not excluded, and for loops with a spherical joint.
    fn count_by_ring(&self, layout: &Layout, case: &Case) -> Option<usize> {
        self.plan(layout, case).map(|plan| plan.count())
    }

    /// Returns the plan by which the ring of the closure equations is computed.
    fn plan(&self, layout: &Layout, case: &Case) -> Option<Plan> {
        if layout.spherical.is_some() {
            return None;
        }
        let filled = layout.with_idle(layout.missing(), 0);
        let is_idle = filled.joint_variables().map(|joint| joint.is_none());
        let open = self.chain.try_open_loop::<Mod>(&filled).ok()??;
        Plan::at_zero(&open.close(&closing_transformation(case).ok()?), is_idle)
    }

    /// The solutions by that ring, in multiprecision arithmetic.
    fn by_ring(&self, layout: &Layout, case: &Case, plan: &Plan) -> Result<Vec<Candidate>> {
        let filled = layout.with_idle(layout.missing(), 0);
        let over = LongFloat::from(1.0 / self.chain.unit().to_f64());
        let exact = self.chain.open_loop::<LongFloat>(&filled)?.close(&closing_transformation(case)?);
        let modes = by_ring(&exact.in_unit(&over), plan);
        let open: OpenLoop<f64> = self.chain.open_loop(&filled)?;
        let setting = self.setting(&filled, &open.over(self.chain.unit().to_f64()), case)?;
        Ok(modes.iter().filter_map(|mode| setting.candidate(mode, &mode.unknowns, ZERO)).collect())
    }

    /// The loop at an input, lengths over the mean link.
    fn setting(&self, layout: &Layout, open: &OpenLoop<f64>, case: &Case) -> Result<Setting> {
        let unit = self.chain.unit().to_f64();
        let closing: Motion<f64> = closing_transformation(case)?;
        let closed = open.close(&closing.over(unit));
        let units = closed.variables.map(|kind| if kind == Variable::Rotation { 1.0 } else { unit });
        let is_idle = layout.joint_variables().map(|joint| joint.is_none());
        let locked = Complex::from(locked_value(case));
        Ok(Setting { layout: layout.clone(), closed, is_idle, units, locked })
    }

    /// A bound on the number of solutions with virtual joints at every input; `None` where the closure polynomials vanish.
    fn most(&self, layout: &Layout) -> Option<usize> {
        // Without input nothing is in general position.
        let Some(locked) = layout.locked.map(|k| layout.variables[k]) else { return Some(usize::MAX) };
        let open = self.chain.try_open_loop::<Mod>(layout).ok().flatten();
        let Some((open, closing)) = open.zip(general_closing(Some(locked), 0)) else { return Some(usize::MAX) };
        Some(degree(&open.close(&closing), None, 0)?.solutions)
    }

    /// Two choices of idle axes beside those of a layout.
    fn counting(&self, layout: &Layout) -> Option<Counting> {
        let plain = Layout { idle: Vec::new(), ..layout.clone() };
        let rotations = layout.loop_kinds().iter().filter(|kind| **kind == Variable::Rotation).count();
        let idle = layout.idle.iter().filter(|idle| idle.variable == Variable::Rotation).count();
        // Three rotations close by themselves, wherever idle translations point.
        let idle = (idle + usize::from(rotations == 3)).min(plain.missing());
        let open = |choice| self.chain.try_open_loop::<Mod>(&plain.with_idle(idle, choice)).ok()?;
        let is_idle = plain.with_idle(idle, 0).joint_variables().map(|joint| joint.is_none());
        Some(Counting { loops: [open(CHOICES)?, open(CHOICES + 1)?], is_idle })
    }

    fn verdict(&self, found: &[Candidate], count: Option<Count>, roots: Roots) -> Verdict {
        let total: usize = found.iter().map(|c| c.mode.multiplicity.max(1)).sum();
        let real = found.iter().filter(|c| c.mode.real).map(|c| c.mode.multiplicity.max(1)).sum();
        let certified = found.iter().filter(|c| c.mode.certificate.is_some()).count();
        let is_of_ring = count.is_some_and(|count| count.is_of_ring);
        let (status, reason) = match count.map(|count| count.most) {
            Some(0) if is_of_ring => (Status::Unreachable, OPEN_BY_RING.to_owned()),
            Some(0) => (
                Status::Unreachable,
                "no solution: the closure polynomials for two choices of virtual joints have no common root".to_owned(),
            ),
            // Large imaginary parts hide how far a solution is from closing, and the count is a bound.
            Some(count) if count == total && found.iter().any(|c| !c.mode.real && !(c.idle < ZERO)) => (
                Status::Incomplete,
                format!(
                    "not proved: complex solutions that close to rounding only, as many as the {count} {}",
                    if is_of_ring {
                        "of the closure equations"
                    } else {
                        "common roots of the closure polynomials for two choices of virtual joints"
                    }
                ),
            ),
            Some(count) if count == total => {
                let status = if real == 0 { Status::Unreachable } else { Status::Complete };
                let all = if total == 1 { "the only common root" } else { "all common roots" };
                let of = if is_of_ring {
                    format!("all solutions of the closure equations, whose ring has dimension {count}")
                } else {
                    format!(
                        "{all} of the closure polynomials for two choices of virtual joints in place of the missing ones"
                    )
                };
                (status, format!("{total} of {count}: {of} (modulo a prime drawn at run time)"))
            }
            Some(count) => {
                let only = if roots == Roots::Real { "; only real roots were looked for" } else { "" };
                (Status::Incomplete, format!("not proved: found {total} of up to {count} solutions{only}"))
            }
            None if self.is_rounded && total > 0 => (
                Status::Incomplete,
                format!(
                    "not proved: {total} solutions close to rounding, but an overconstrained loop moves with exact data \
                     only, and these were rounded"
                ),
            ),
            None => (Status::Incomplete, "not proved: the solutions could not be counted exactly".to_owned()),
        };
        let certified = if status == Status::Incomplete { 0 } else { certified };
        Verdict { complex: total, real, certified, ..outcome(status, 0, reason) }
    }
}

/// A loop with virtual joints at an input.
struct Setting {
    layout: Layout,
    /// Lengths over the mean link.
    closed: ClosedLoop<f64>,
    is_idle: [bool; 6],
    units: Six<f64>,
    locked: Complex<f64>,
}

impl Setting {
    /// Returns the candidate of a mode with these unknowns, lengths over the mean link: its virtual joints are set to zero if
    /// they are below `most` and the loop closes.
    fn candidate(&self, mode: &Mode, own: &Six<Complex<f64>>, most: f64) -> Option<Candidate> {
        let idle = (0..6).filter(|&k| self.is_idle[k]).map(|k| own[k].norm()).fold(0.0, f64::max);
        if !(idle < most) {
            return None;
        }
        let (unknowns, residual) = closer(&self.closed, own, self.is_idle, mode.real);
        let q = self.layout.assemble(&std::array::from_fn(|k| unknowns[k] * self.units[k]), self.locked);
        (residual < OPEN).then(|| Candidate { q, mode: Mode { residual, ..mode.clone() }, idle })
    }
}

/// The unknowns nearby that close the loop best with all idle ones at zero, by least squares, and the residual there.
fn closer(
    closed: &ClosedLoop<f64>,
    unknowns: &Six<Complex<f64>>,
    is_idle: [bool; 6],
    real: bool,
) -> (Six<Complex<f64>>, f64) {
    let mut at: Six<Complex<f64>> = std::array::from_fn(|k| if is_idle[k] { Complex::ZERO } else { unknowns[k] });
    let size = |at: &Six<Complex<f64>>| {
        let here = closure(closed, at);
        (here.relative_defect(closed, at, real), here)
    };
    let (mut defect, mut here) = size(&at);
    for _ in 0..POLISHINGS {
        let matrix =
            SMatrix::<Complex<f64>, 6, 6>::from_fn(|i, j| if is_idle[j] { Complex::ZERO } else { here.jacobian[i][j] });
        let svd = finite(matrix).svd(true, true);
        let Ok(step) = svd.solve(&SVector::from(here.residual), RANK * svd.singular_values.max()) else { break };
        let next = std::array::from_fn(|k| {
            let moved = at[k] - step[k];
            if real { Complex::from(moved.re) } else { moved }
        });
        let (smaller, there) = size(&next);
        if !(smaller < defect) {
            break;
        }
        (at, defect, here) = (next, smaller, there);
    }
    for (x, kind) in at.iter_mut().zip(closed.variables) {
        if kind == Variable::Rotation {
            x.re = wrapped(x.re);
        }
    }
    (at, defect)
}

/// The order of solutions in a list.
fn in_order(a: &[Complex<f64>], b: &[Complex<f64>]) -> std::cmp::Ordering {
    let key = |q: &[Complex<f64>]| q.iter().map(|z| (z.re, z.im)).collect::<Vec<_>>();
    key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
}

/// Returns the number of leading candidates whose multiplicities add up to at most this number of solutions.
fn fitting(candidates: &[Candidate], count: usize) -> usize {
    let sums = candidates.iter().scan(0, |sum, candidate| {
        *sum += candidate.mode.multiplicity.max(1);
        Some(*sum)
    });
    sums.take_while(|sum| *sum <= count).count()
}

/// A verdict without solutions.
fn outcome(status: Status, self_motion: usize, reason: String) -> Verdict {
    let (code, complex_complete) = match status {
        Status::Complete => (Code::CountMet, true),
        Status::Unreachable => (Code::NoSolution, true),
        Status::SelfMotion => (Code::SelfMotion, false),
        Status::Incomplete => (Code::TooFew, false),
        Status::Unsupported => (Code::Unsupported, false),
    };
    Verdict {
        status,
        proof: Proof::None,
        code,
        complex_complete,
        complex: 0,
        real: 0,
        at_infinity: 0,
        self_motion,
        certified: 0,
        reason,
    }
}
