//! A geometry prepared once for many poses.

use super::axis_triples::{AxisTriple, decoupled};
use super::limits;
use super::mode::{Assembly, Mode, Roots};
use super::platform::{PlatformAssembly, PlatformWorkspace};
use super::prepared::PreparedCut;
use super::high_precision::solve_in_high_precision;
use super::search::{AS_IT_IS, Effort, Search};
use super::shifted::Shifted;
use crate::closure::half_angle::half_angle_form;
use crate::elimination::coordinate_ring::Plan;
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::degree::general_degree;
use crate::elimination::pencil::{before_second_link, bilinear};
use crate::elimination::point_reach::general_count;
use crate::kinematics::closed_loop::{ClosedLoop, OpenLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::solve::decoupled::Decoupled;
use crate::solve::eigen::{EigenWorkspace, companion};
use crate::solve::scalar::Extended;
use crate::solve::singular::structural_rank;

/// A geometry, prepared: solve many poses of it.
///
/// # Example
/// ```
/// use looproot::internal::assembly::{Assembly, Roots, Solver, Workspace};
/// use looproot::internal::kinematics::{closed_loop::{OpenLoop, Variable}, motion::Motion};
/// // Six axes, each link turned and shifted against the last.
/// let link = |k: usize| {
///     let k = k as f64;
///     let mut m = Motion::rotation_x((1.0 + k).cos(), (1.0 + k).sin());
///     m.translation = [0.3 + 0.1 * k, 0.2, 0.4 - 0.1 * k];
///     m
/// };
/// let open = OpenLoop {
///     variables: [Variable::Rotation; 6],
///     constants: std::array::from_fn(link),
///     before_gap: Motion::identity(),
///     after_gap: Motion::identity(),
/// };
/// let solver = Solver::prepare(&open);
/// let mut assembly = Assembly::default();
/// solver.solve(&link(7), Roots::All, &mut Workspace::default(), &mut assembly);
/// assert_eq!(assembly.total(), 16);
/// ```
pub struct Solver {
    open: OpenLoop<f64>,
    /// Lengths inside the solver are lengths of the mechanism over this power of two.
    scale: f64,
    /// Cuts that need no pose, best first.
    prepared: Vec<PreparedCut>,
    structural_rank: usize,
    axis_triples: Vec<AxisTriple>,
    /// What a closed form takes out of the loop, if there is one.
    decoupled: Option<Decoupled>,
    /// Where the three rotations of a spherical joint begin, if there is one.
    spherical: Option<usize>,
}

/// What a pose or input leaves open: the constant behind the last unknown, in the scale of its solver.
#[derive(Clone, Debug)]
pub struct Gap {
    last: Motion<f64>,
    /// How far it may be off beside one rounding: a bound of the row-sum norm.
    rounding: f64,
    is_rough: bool,
}

/// Roundings of the rotation of a gap, by rows: a product of three rotations, each rounded once. An entry of the first
/// product is off by 5 u, one of the second by 5 sqrt(3) u and 4 u of its own.
const GAP_TURN: f64 = 40.0;
/// Roundings of the translation of a gap, in parts of the lengths that are added up: as those of an entry, with the
/// rotation of the first end before.
const GAP_SHIFT: f64 = 16.0;

impl Gap {
    /// Whether digits were lost that exact arithmetic would keep: a base or a tool far away costs them.
    #[must_use]
    pub fn is_rough(&self) -> bool {
        self.is_rough
    }
}

fn length(motion: &Motion<f64>) -> f64 {
    motion.translation.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The motion with lengths over a power of two.
fn scaled(motion: &Motion<f64>, scale: f64) -> Motion<f64> {
    Motion { translation: motion.translation.map(|x| x / scale), ..motion.clone() }
}

/// Memory reused from pose to pose: one per thread.
#[derive(Default)]
pub struct Workspace {
    eigen: EigenWorkspace,
    /// The workspace of platforms.
    pub platform: PlatformWorkspace,
    /// What was found last of a platform.
    pub platform_assembly: PlatformAssembly,
    /// Whether a list is complete once its real solutions are, though complex ones may be missing.
    pub only_real_list: bool,
    /// Whether solutions that crowd are listed as they are found, not proved to be all, where the numbers lie in a number
    /// field: there the proof takes seconds.
    pub leaves_fields: bool,
    /// Whether solutions are listed as f64 finds them, and that they are all is not proved.
    pub only_lists: bool,
}

impl Workspace {
    /// Memory of the eigenvalue routines.
    pub(super) fn eigen(&mut self) -> &mut EigenWorkspace {
        &mut self.eigen
    }
}

impl Solver {
    /// Prepares a geometry: all that does not depend on the pose, and the order of the cuts.
    #[must_use]
    pub fn prepare(open: &OpenLoop<f64>) -> Self {
        let square = |m: &Motion<f64>| length(m).powi(2);
        // The mean link length, not the distance of a base or a tool; of an arm without lengths its ends, else 1. A power
        // of two: scaling then costs no digit.
        let links = open.constants.iter().map(square).sum::<f64>() / 5.0;
        let mean = if links > 0.0 { links } else { square(&open.before_gap) + square(&open.after_gap) };
        let scale = if mean > 0.0 { mean.sqrt().log2().round().exp2() } else { 1.0 };
        let open = OpenLoop {
            variables: open.variables,
            constants: open.constants.each_ref().map(|m| scaled(m, scale)),
            before_gap: scaled(&open.before_gap, scale),
            after_gap: scaled(&open.after_gap, scale),
        };
        let closed = open.close(&Motion::identity());
        let mut prepared: Vec<PreparedCut> = Cut::ALL[..Cut::PREPARED]
            .iter()
            .filter(|cut| cut.fits(open.variables))
            .filter_map(|&cut| {
                let view = cut.of(&closed);
                let form = half_angle_form(&view)?;
                // The gap sits in constant 6 of the original loop.
                let free = cut.constant_index(1) != 5;
                let rows = free.then(|| before_second_link(&form, &view.constants[1]));
                (form.score > limits::SCORE).then_some(PreparedCut { cut, form, rows })
            })
            .collect();
        prepared.sort_by(|a, b| b.form.score.total_cmp(&a.form.score));
        let structural_rank = structural_rank(&closed);
        let axis_triples = AxisTriple::all(&open);
        let decoupled = decoupled(&open);
        Self { open, scale, prepared, structural_rank, axis_triples, decoupled, spherical: None }
    }

    /// As [`Solver::prepare`] for a loop with a spherical joint, whose three rotations begin at this unknown.
    #[must_use]
    pub fn with_spherical_joint(open: &OpenLoop<f64>, spherical: usize) -> Self {
        Self { spherical: Some(spherical), decoupled: None, prepared: Vec::new(), ..Self::prepare(open) }
    }

    /// The largest rank the six joints reach in general position: below 6 the arm is structurally deficient, and every
    /// solution is part of a self-motion.
    #[must_use]
    pub fn structural_rank(&self) -> usize {
        self.structural_rank
    }

    /// The triples of neighbouring axes that are parallel or meet in a point.
    #[must_use]
    pub fn axis_triples(&self) -> &[AxisTriple] {
        &self.axis_triples
    }

    /// Whether a closed form finds the solutions: three neighbouring axes meet in a point or are parallel.
    #[must_use]
    pub fn is_decoupled(&self) -> bool {
        self.decoupled.is_some()
    }

    /// Whether some cut loses equations: the geometry is special, and may have fewer than 16 solutions.
    #[must_use]
    pub fn is_special(&self) -> bool {
        let fitting = Cut::ALL[..Cut::PREPARED].iter().filter(|cut| cut.fits(self.open.variables)).count();
        self.prepared.len() < fitting || fitting == 0
    }

    /// Whether the loop has fewer than three rotations: its links move in parallel planes or without turning.
    #[must_use]
    pub fn is_out_of_reach(&self) -> bool {
        general_degree(self.open.variables).is_none()
    }

    /// The degree of the closure polynomial of general loops with these unknowns, 0 where [`Self::is_out_of_reach`].
    #[must_use]
    pub fn general_degree(&self) -> usize {
        match self.spherical {
            Some(spherical) => general_count([3, 4, 5].map(|k| self.open.variables[(spherical + k) % 6])),
            None => general_degree(self.open.variables).unwrap_or(0),
        }
    }

    /// Whether the gap is wider than the links are long together, so that no real solution can close it; then both
    /// lengths, in the unit of the mechanism.
    #[must_use]
    pub fn too_far(&self, gap: &Gap) -> Option<(f64, f64)> {
        if self.open.variables.contains(&Variable::Translation) {
            return None;
        }
        let width = length(&gap.last);
        let links: f64 = self.open.constants.iter().map(length).sum();
        // Every link turns freely at best; the margin is that of rounding.
        (width > links * (1.0 + 1e-12) + gap.rounding).then_some((width * self.scale, links * self.scale))
    }

    /// The gap that this motion fills.
    #[must_use]
    pub fn gap(&self, closing: &Motion<f64>) -> Gap {
        let closing = scaled(closing, self.scale);
        let ends = length(&self.open.before_gap) + length(&closing) + length(&self.open.after_gap);
        let last = self.open.before_gap.then_after(&closing).then_after(&self.open.after_gap);
        let rounding = 0.5 * f64::EPSILON * (GAP_TURN + GAP_SHIFT * ends);
        // Ends much longer than what remains of them lose digits.
        Gap { rounding, is_rough: ends > 8.0 * (1.0 + length(&last)), last }
    }

    /// The gap whose closing constant (behind the last unknown) was computed exactly and rounded once.
    #[must_use]
    pub fn exact_gap(&self, last: &Motion<f64>) -> Gap {
        Gap { last: scaled(last, self.scale), rounding: 0.0, is_rough: false }
    }

    /// The loop at a gap, and the power of two that its lengths are in.
    #[must_use]
    pub fn closed(&self, gap: &Gap) -> (ClosedLoop<f64>, f64) {
        (self.close(gap), self.scale)
    }

    /// The loop at a gap, scaled.
    fn close(&self, gap: &Gap) -> ClosedLoop<f64> {
        let constants = std::array::from_fn(|j| if j < 5 { self.open.constants[j].clone() } else { gap.last.clone() });
        ClosedLoop { variables: self.open.variables, constants }
    }

    /// The 16 x 16 matrix whose eigenvalues the first pencil of this pose asks for; `None` where that is singular.
    #[must_use]
    pub fn companion(&self, closing: &Motion<f64>) -> Option<[[f64; 16]; 16]> {
        let prepared = self.prepared.first()?;
        let cut = prepared.cut.of(&self.close(&self.gap(closing)));
        let rows = prepared.rows.unwrap_or_else(|| before_second_link(&prepared.form, &cut.constants[1]));
        let shifted = Shifted::best(&bilinear(&rows, &cut), Hidden::First);
        let (constant, linear) = shifted.monic()?;
        Some(companion(&constant, &linear))
    }

    /// Finds the solutions at one pose or input, given as the motion that fills the gap of the loop. Allocates nothing
    /// once `assembly` has grown to its size, but for degenerate poses.
    pub fn solve(&self, closing: &Motion<f64>, roots: Roots, workspace: &mut Workspace, assembly: &mut Assembly) {
        self.solve_up_to(&self.gap(closing), roots, &|| usize::MAX, workspace, assembly);
    }

    /// As [`Solver::solve`], for a geometry known to have no more than `most()` solutions: stops looking for more.
    /// `most` is asked only where fewer than 16 are found.
    pub fn solve_up_to(
        &self,
        gap: &Gap,
        roots: Roots,
        most: &dyn Fn() -> usize,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) {
        self.search(gap, roots, Effort::All(most), workspace, assembly);
    }

    /// As [`Solver::solve_up_to`] for all roots, by the pencils alone: what they leave open is not searched for, and nothing
    /// is decided of what has no certificate.
    pub fn solve_by_pencils(
        &self,
        gap: &Gap,
        most: &dyn Fn() -> usize,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) {
        self.search(gap, Roots::All, Effort::Pencils(most), workspace, assembly);
    }

    /// All solutions as one pencil alone leads to them: most of those that f64 can tell apart. What has no proof is left
    /// undecided.
    pub fn solve_briefly(&self, gap: &Gap, workspace: &mut Workspace, assembly: &mut Assembly) {
        self.search(gap, Roots::All, Effort::OnePencil, workspace, assembly);
    }

    /// Finds solutions with some effort.
    fn search(&self, gap: &Gap, roots: Roots, effort: Effort<'_>, workspace: &mut Workspace, assembly: &mut Assembly) {
        assembly.clear();
        let closed = self.close(gap);
        let eigen = &mut workspace.eigen;
        Search {
            prepared: &self.prepared,
            closed: &closed,
            spherical: self.spherical,
            decoupled: self.decoupled,
            arrangement: AS_IT_IS,
            gap_rounding: gap.rounding,
            roots,
            effort,
            eigen,
            assembly,
        }
        .run();
        self.finish(assembly);
    }

    /// Looks again for what is missing of a list, in numbers of more digits: `exact` is the same loop, its gap filled, from
    /// exact data, `plan` that of its ring, if it is known, and `expected` the number of its solutions.
    pub fn solve_in_high_precision<R: Extended>(
        &self,
        exact: &ClosedLoop<R>,
        plan: Option<&Plan>,
        expected: usize,
        assembly: &mut Assembly,
    ) {
        let unit = R::from(1.0 / self.scale);
        let constants = exact
            .constants
            .each_ref()
            .map(|motion| Motion { translation: motion.translation.map(|x| x.mul(&unit)), ..motion.clone() });
        let scaled = ClosedLoop { variables: exact.variables, constants };
        self.scale_lengths(assembly, 1.0 / self.scale, 1.0 / self.scale.max(1.0));
        let modes = solve_in_high_precision(&scaled, self.spherical, plan, expected);
        assembly.complete_with(modes, &self.open.variables, expected, R::BITS);
        self.finish(assembly);
    }

    /// Translations in another unit. A radius bounds the errors of angles and translations alike: it grows with these where
    /// they do.
    fn scale_lengths(&self, assembly: &mut Assembly, factor: f64, grown: f64) {
        if !self.open.variables.contains(&Variable::Translation) {
            return;
        }
        for mode in &mut assembly.modes {
            for (value, variable) in mode.unknowns.iter_mut().zip(self.open.variables) {
                if variable == Variable::Translation {
                    *value *= factor;
                }
            }
            if let Some(proof) = &mut mode.certificate {
                (proof.radius, proof.proved) = (proof.radius * grown, proof.proved * grown);
            }
        }
        for point in assembly.families.iter_mut().flat_map(|family| &mut family.points) {
            for (value, variable) in point.iter_mut().zip(self.open.variables) {
                if variable == Variable::Translation {
                    *value *= factor;
                }
            }
        }
    }

    /// Puts the modes in order, in the unit of the mechanism.
    fn finish(&self, assembly: &mut Assembly) {
        assembly.modes.sort_by(|a, b| {
            b.real.cmp(&a.real).then_with(|| {
                let key = |m: &Mode| m.unknowns.map(|z| (z.re, z.im));
                key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal)
            })
        });
        self.scale_lengths(assembly, self.scale, self.scale.max(1.0));
    }
}
