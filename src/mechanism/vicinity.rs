//! Self-motions and near solutions of one case as its answer lists them.

use super::FullMode;
use super::family::{Family, Joints, Shape};
use super::near::{Near, Neighbourhood, Start};
use super::single_loop::{SingleLoop, SixUnknowns, full_mode};
use crate::assembly::{Assembly, Gap, Hits, Mode};
use crate::kinematics::chain::Placement;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use crate::kinematics::forward::Forward;
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::Tolerance;
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::dense;
use crate::solve::newton::{Six, closure};
use crate::solve::self_motion::SelfMotion;
use crate::verdict::{Status, Verdict};
use num_complex::Complex;

/// One case of a loop of six unknowns.
pub(super) struct Vicinity<'a> {
    /// The mechanism.
    pub of: &'a SingleLoop,
    /// Its solver.
    pub prepared: &'a SixUnknowns,
    /// The value of the locked variable.
    pub locked: f64,
    /// The closing transformation of the case.
    pub gap: &'a Gap,
}

impl Vicinity<'_> {
    fn closed(&self) -> (ClosedLoop<f64>, f64) {
        self.prepared.solver.closed(self.gap)
    }

    /// Self-motions as families.
    pub fn families(&self, found: &[SelfMotion]) -> Vec<Family> {
        let (closed, scale) = self.closed();
        let inside: Vec<SelfMotion> = found.iter().map(|motion| scaled(motion, &closed, 1.0 / scale)).collect();
        self.listed(&closed, scale, inside.iter().map(|motion| (motion, 0.0)), CLOSES_WITHIN)
    }

    /// Self-motions in the unit of the loop, each with its distance.
    fn listed<'b>(
        &self,
        closed: &ClosedLoop<f64>,
        scale: f64,
        found: impl Iterator<Item = (&'b SelfMotion, f64)>,
        within: f64,
    ) -> Vec<Family> {
        let Layout { variables, .. } = &self.prepared.layout;
        let joints = Joints { variables, limits: &self.of.limits };
        found.flat_map(|one| self.place(closed, scale).families(joints, one, within)).collect()
    }

    fn place<'b>(&'b self, closed: &'b ClosedLoop<f64>, scale: f64) -> Place<'b> {
        Place { layout: &self.prepared.layout, locked: self.locked, closed, scale }
    }

    /// Returns the configurations near the pose of an arm. Where the list of solutions is unknown, only the families met are
    /// used.
    pub fn near(&self, pose: &Placement, tolerance: Tolerance, verdict: &Verdict, assembly: &Assembly) -> Near {
        let status = verdict.status;
        let is_moving = status == Status::SelfMotion;
        let starts = if status == Status::Incomplete { Vec::new() } else { self.starts(assembly) };
        let (closed, scale) = self.closed();
        let inside: Vec<SelfMotion> =
            assembly.families.iter().map(|motion| scaled(motion, &closed, 1.0 / scale)).collect();
        let (exact, seen) = if is_moving { (inside, Vec::new()) } else { (Vec::new(), inside) };
        let is_empty = status == Status::Unreachable && starts.is_empty();
        let run = |here: &Neighbourhood<'_>| here.run(&starts, &exact, &seen);
        self.neighbourhood(pose, tolerance, is_empty, run).unwrap_or_default()
    }

    /// Returns by how many tolerances the configuration misses the pose of an arm that comes nearest to it as far as is known; `None`
    /// where nothing is.
    pub fn closest(&self, pose: &Placement, tolerance: Tolerance, assembly: &Assembly) -> Option<f64> {
        let starts = self.starts(assembly);
        self.neighbourhood(pose, tolerance, false, |here| here.closest(&starts))?
    }

    /// Returns the unknowns of a configuration of an arm, in the unit of the loop.
    pub fn unknowns(&self, q: &[f64]) -> Six<f64> {
        let (closed, scale) = self.closed();
        let joints = self.prepared.layout.joint_variables();
        let values = joints.map(|joint| joint.and_then(|joint| q.get(joint)).copied().unwrap_or_default());
        in_unit(&values, &closed, 1.0 / scale)
    }

    /// The solutions of a list, in the unit of the loop.
    fn starts(&self, assembly: &Assembly) -> Vec<Start> {
        let (closed, scale) = self.closed();
        let unit = |variable: Variable| if variable == Variable::Rotation { 1.0 } else { scale };
        let start = |mode: &Mode| Start {
            unknowns: std::array::from_fn(|k| mode.unknowns[k] / unit(closed.variables[k])),
            is_real: mode.real,
            condition: mode.condition,
        };
        assembly.modes.iter().map(start).collect()
    }

    /// Asks the neighbourhood of a pose; `None` where the numbers of the arm are not known well enough.
    fn neighbourhood<T>(
        &self,
        pose: &Placement,
        tolerance: Tolerance,
        is_empty: bool,
        ask: impl FnOnce(&Neighbourhood<'_>) -> T,
    ) -> Option<T> {
        let (closed, scale) = self.closed();
        let layout = &self.prepared.layout;
        let forward = self.of.forward.get_or_init(|| Forward::of(&self.of.chain)).as_ref()?;
        let solver = &self.prepared.solver;
        let closed_at = |pose: &Motion<f64>| solver.closed(&solver.gap(&pose.inverse())).0;
        let is_deficient = solver.structural_rank() < 6;
        let (closed, closed_at) = (&closed, &closed_at);
        Some(ask(&Neighbourhood { forward, layout, pose, closed, closed_at, scale, tolerance, is_deficient, is_empty }))
    }

    /// Adds what is near to an answer, behind what is exact.
    pub fn list(&self, near: &Near, tolerance: Tolerance, modes: &mut Vec<FullMode>, families: &mut Vec<Family>) {
        let (closed, scale) = self.closed();
        let within = tolerance.angle.max(tolerance.length / scale).max(CLOSES_WITHIN);
        for family in &near.families {
            let found = [(&family.motion, family.distance.max(f64::MIN_POSITIVE))].into_iter();
            let (closed, within) = family.closed.as_ref().map_or((&closed, within), |own| (own, CLOSES_WITHIN));
            families.extend(self.listed(closed, scale, found, within));
        }
        for (point, error) in &near.modes {
            let unknowns: Six<Complex<f64>> = in_unit(point, &closed, scale).map(Complex::from);
            let here = closure(&closed, &point.map(|x| x));
            let inverse = dense::inverse(&here.jacobian);
            let mode = Mode {
                unknowns,
                real: true,
                multiplicity: 0,
                residual: here.relative_defect(&closed, &point.map(Complex::from), true),
                condition: inverse.map_or(f64::INFINITY, |inverse| dense::norm(&here.jacobian) * dense::norm(&inverse)),
                certificate: None,
                hits: Hits::first(0),
            };
            let layout = &self.prepared.layout;
            let q = layout.assemble(&mode.unknowns, Complex::from(self.locked));
            let own = full_mode(&mode, q, &layout.variables, &self.of.limits);
            modes.push(FullMode { near: true, error: Some(*error), ..own });
        }
    }
}

/// A loop of six unknowns, some of which may be virtual joints, at an input or a pose.
#[derive(Clone, Copy)]
pub(super) struct Place<'a> {
    pub layout: &'a Layout,
    /// The value of the locked variable.
    pub locked: f64,
    /// The loop with lengths over a unit, and this unit.
    pub closed: &'a ClosedLoop<f64>,
    pub scale: f64,
}

impl Place<'_> {
    /// Returns a self-motion whose points have lengths over the unit, and its distance from what was asked for, as families of joint variables.
    pub fn families(&self, joints: Joints, (motion, distance): (&SelfMotion, f64), within: f64) -> Vec<Family> {
        let configuration =
            |point: &Six<f64>| self.layout.assemble(&in_unit(point, self.closed, self.scale), self.locked);
        let between =
            |first: usize, part: f64| Some(configuration(&motion.between(self.closed, first, part, within)?));
        let moving = self.layout.assemble(&motion.moving, false);
        let shape = Shape {
            dimension: motion.dimension,
            moving: (0..moving.len()).filter(|&k| moving[k]).collect(),
            distance,
            points: motion.points.iter().map(configuration).collect(),
            is_closed: motion.is_closed,
        };
        joints.families(&shape, &between)
    }
}

/// A point with its translations in another unit.
fn in_unit(point: &Six<f64>, closed: &ClosedLoop<f64>, unit: f64) -> Six<f64> {
    std::array::from_fn(|k| match closed.variables[k] {
        Variable::Rotation => point[k],
        Variable::Translation => point[k] * unit,
    })
}

/// A self-motion with its translations in another unit.
pub(super) fn scaled(motion: &SelfMotion, closed: &ClosedLoop<f64>, unit: f64) -> SelfMotion {
    let points = motion.points.iter().map(|point| in_unit(point, closed, unit)).collect();
    SelfMotion { points, ..motion.clone() }
}
