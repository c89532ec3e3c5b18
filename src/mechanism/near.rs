//! Configurations that reach a pose within the tolerance but not exactly. A pose that is typed is rounded, and a singular pose is
//! lost by rounding: a double solution becomes a complex pair, and a self-motion becomes a few isolated solutions.

use crate::assembly::wrapped;
use crate::kinematics::chain::{Chain, Placement};
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use crate::kinematics::motion::Motion;
use crate::kinematics::tolerance::{PoseError, Tolerance};
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::newton::{Six, approach};
use crate::solve::self_motion::{SelfMotion, nearest, self_motions};
use crate::solve::singular::spread;
use num_complex::Complex;

/// An arm at a pose, and what of it is looked at.
pub(super) struct Neighbourhood<'a> {
    /// The arm.
    pub chain: &'a Chain,
    /// The order of its variables.
    pub layout: &'a Layout,
    /// The pose.
    pub pose: &'a Placement,
    /// The loop that both make, lengths over `scale`.
    pub closed: &'a ClosedLoop<f64>,
    /// The unit of lengths in the loop.
    pub scale: f64,
    /// The tolerance.
    pub tolerance: Tolerance,
    /// Whether the joints are dependent in every position.
    pub is_deficient: bool,
    /// Whether the exact data leave no solution to start from, not even a complex one, and reach alone does not deny the pose:
    /// rounding may have sent all of a self-motion to infinity.
    pub is_empty: bool,
}

/// A solution as far as a neighbourhood looks at it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    /// The six unknowns, in the unit of the loop.
    pub unknowns: Six<Complex<f64>>,
    /// Whether it is real.
    pub is_real: bool,
    /// Condition number of the Jacobian.
    pub condition: f64,
}

/// The configurations and families near a pose.
#[derive(Debug, Default)]
pub(super) struct Near {
    /// Configurations that appear to be isolated.
    pub modes: Vec<(Six<f64>, PoseError)>,
    /// Self-motions, with the largest error along them.
    pub families: Vec<(SelfMotion, f64)>,
}

/// Ratio of the condition of a solution on a near self-motion to the tolerance: 0.02 of its way changes the pose by no more than
/// the tolerance.
const CONDITION: f64 = 1e-3;
/// Solutions nearer to each other than this are one as seen from a near one: a pair that rounding splits.
const SAME: f64 = 1e-3;
/// Imaginary parts of solutions that may be near a real configuration, at most.
const IMAGINARY: f64 = 0.5;
/// The search for near solutions starts from this number of solutions at most: no loop has more.
const MOST_STARTS: usize = 16;
/// This number of pairs of complex solutions starts a search for a near self-motion.
const MOST_SEARCHES: usize = 4;
/// Starts of a search for a near self-motion.
const TRIALS: usize = 8;
/// Starts of the search of an arm of dependent joints, whose self-motions rounding dissolves without a trace: as many as of a search
/// that no pencil leads.
const STARTS: usize = 40;
/// The error of a self-motion is measured at this number of points.
const LOOKED_AT: usize = 24;

impl Neighbourhood<'_> {
    /// Returns the near configurations that are not yet known. `solutions` are all exact ones, `families` the self-motions that
    /// reach the pose exactly.
    pub fn run(&self, solutions: &[Start], families: &[SelfMotion], seen: &[SelfMotion]) -> Near {
        let within = self.tolerance.angle.max(self.tolerance.length / self.scale).max(CLOSES_WITHIN);
        let mut near = Near::default();
        for family in seen {
            self.admit(family, families, within, &mut near);
        }
        let (real, complex): (Vec<&Start>, Vec<&Start>) = solutions.iter().partition(|start| start.is_real);
        let is_bad = |start: &&&Start| !(start.condition < CONDITION / within);
        let bad: Vec<&Start> = real.iter().filter(is_bad).copied().collect();
        let middles = self.middles(&bad);
        // A solution of order k splits by the k-th root of what it misses; orders above 4 are not looked for.
        let widest = (10.0 * within.powf(0.25)).min(IMAGINARY);
        let imaginary = |start: &Start| start.unknowns.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
        let split = complex.iter().filter(|start| imaginary(start) < widest);
        for start in middles.iter().chain(bad).chain(split.copied()).take(MOST_STARTS) {
            let Some(point) = nearest(self.closed, &start.unknowns.map(|z| z.re), within) else { continue };
            let holds = |family: &SelfMotion| family.holds(self.closed, &point, within);
            if families.iter().chain(near.families.iter().map(|(family, _)| family)).any(holds) {
                continue;
            }
            let found = self_motions(self.closed, &point, within);
            for family in &found {
                self.admit(family, families, within, &mut near);
            }
            let is_on = |(family, _): &(SelfMotion, f64)| family.holds(self.closed, &point, within);
            if !start.is_real && !near.families.iter().any(is_on) {
                self.admit_mode(&point, &real, &mut near);
            }
        }
        for start in complex.iter().filter(is_bad).step_by(2).take(MOST_SEARCHES) {
            self.search(&start.unknowns.map(|z| z.re), families, within, &mut near);
        }
        if self.is_deficient && families.is_empty() && near.families.is_empty() {
            for trial in 1..=STARTS {
                self.look(&spread(&self.closed.variables, trial), families, within, &mut near);
            }
        } else if self.is_empty && families.is_empty() && near.families.is_empty() {
            for trial in 1..=STARTS {
                let start = spread(&self.closed.variables, trial);
                if self.look(&start, families, within, &mut near) {
                    continue;
                }
                if let Some(point) = nearest(self.closed, &approach(self.closed, &start), within) {
                    self.admit_mode(&point, &[], &mut near);
                }
            }
        }
        self.rest_spherical(&real, &mut near);
        near
    }

    /// The middles of pairs of solutions that are one but for rounding. Where two singular positions meet, rounding splits the solution
    /// by its root in one of them, and so leaves the other one by as much; the middle has lost the square of that only.
    fn middles(&self, bad: &[&Start]) -> Vec<Start> {
        let mut found = Vec::new();
        for (k, one) in bad.iter().enumerate() {
            for other in &bad[..k] {
                let way: Six<f64> = std::array::from_fn(|j| {
                    let off = other.unknowns[j].re - one.unknowns[j].re;
                    if self.closed.variables[j] == Variable::Rotation { wrapped(off) } else { off }
                });
                if way.iter().all(|x| x.abs() < SAME) {
                    found.push(Start { unknowns: std::array::from_fn(|j| one.unknowns[j] + way[j] / 2.0), ..**one });
                }
            }
        }
        found
    }

    /// Takes the families along which a spherical joint alone seems to turn for single configurations: where the axes of its first and
    /// third rotation coincide these two turn against each other, and the joint stands still.
    fn rest_spherical(&self, real: &[&Start], near: &mut Near) {
        let Some(first) = self.layout.spherical_unknown() else { return };
        let rests = |family: &SelfMotion| (0..6).all(|k| !family.moving[k] || k == first || k == first + 2);
        let (resting, moving): (Vec<_>, Vec<_>) = near.families.drain(..).partition(|(family, _)| rests(family));
        near.families = moving;
        for point in resting.iter().filter_map(|(family, _)| family.points.first()) {
            self.admit_mode(point, real, near);
        }
    }

    /// Takes in the near self-motions downhill of a start. Whether there are any, known or not.
    fn look(&self, start: &Six<f64>, families: &[SelfMotion], within: f64, near: &mut Near) -> bool {
        let Some(point) = nearest(self.closed, &approach(self.closed, start), within) else { return false };
        let holds = |family: &SelfMotion| family.holds(self.closed, &point, within);
        if families.iter().chain(near.families.iter().map(|(family, _)| family)).any(holds) {
            return true;
        }
        let found = self_motions(self.closed, &point, within);
        for family in &found {
            self.admit(family, families, within, near);
        }
        !found.is_empty()
    }

    /// Looks for a near self-motion from a singular complex solution. Rounding may leave of a curve only complex points of its
    /// continuation, far from all real ones; the unknowns that do not move along it are real up to rounding.
    fn search(&self, beside: &Six<f64>, families: &[SelfMotion], within: f64, near: &mut Near) {
        for trial in 0..TRIALS {
            let elsewhere = spread(&self.closed.variables, trial);
            // At first as it is, then farther and farther away.
            let part = trial as f64 / TRIALS as f64;
            let start = std::array::from_fn(|k| beside[k] + part * elsewhere[k]);
            if self.look(&start, families, within, near) {
                return;
            }
        }
    }

    /// Takes in a self-motion that is near all along and not known.
    fn admit(&self, family: &SelfMotion, exact: &[SelfMotion], within: f64, near: &mut Near) {
        let middle = &family.points[family.points.len() / 2];
        let known = exact.iter().chain(near.families.iter().map(|(family, _)| family));
        let mut same = known.filter(|other| other.dimension == family.dimension);
        if same.any(|other| {
            other.holds(self.closed, middle, within) || other.moving == family.moving && other.dimension > 1
        }) {
            return;
        }
        let stride = family.points.len().div_ceil(LOOKED_AT);
        let errors: Option<Vec<PoseError>> = family.points.iter().step_by(stride).map(|q| self.error(q)).collect();
        let Some(errors) = errors.filter(|errors| errors.iter().all(|error| self.allows(error))) else { return };
        let distance = errors.iter().map(PoseError::largest).fold(0.0, f64::max);
        near.families.push((family.clone(), distance));
    }

    /// Takes in a configuration that is near and no solution again.
    fn admit_mode(&self, point: &Six<f64>, real: &[&Start], near: &mut Near) {
        let apart = |other: &Six<f64>| {
            let difference = |k: usize| match self.closed.variables[k] {
                Variable::Rotation => wrapped(other[k] - point[k]),
                Variable::Translation => other[k] - point[k],
            };
            (0..6).map(|k| difference(k).abs()).fold(0.0, f64::max) > SAME
        };
        let is_new = real.iter().all(|start| apart(&start.unknowns.map(|z| z.re)))
            && near.modes.iter().all(|(other, _)| apart(other));
        if let Some(error) = self.error(point).filter(|error| is_new && self.allows(error)) {
            near.modes.push((*point, error));
        }
    }

    fn allows(&self, error: &PoseError) -> bool {
        error.position <= self.tolerance.length && error.orientation <= self.tolerance.angle
    }

    /// Returns the error of the pose at a configuration.
    fn error(&self, unknowns: &Six<f64>) -> Option<PoseError> {
        let q = self.layout.assemble(unknowns, 0.0);
        let motions = q.iter().zip(&self.layout.variables).map(|(value, variable)| match variable {
            Variable::Rotation => Motion::rotation_z(value.cos(), value.sin()),
            Variable::Translation => Motion::translation_z(value * self.scale),
        });
        let reached: Motion<f64> = self.chain.forward(&motions.collect::<Vec<_>>())?;
        let asked = &self.pose.float;
        let position = (0..3).map(|k| (reached.translation[k] - asked.translation[k]).powi(2)).sum::<f64>().sqrt();
        // The length of the skew part of the rotation between the two is the sine of its angle.
        let between = |i: usize, j: usize| (0..3).map(|k| asked.rotation[k][i] * reached.rotation[k][j]).sum::<f64>();
        let skew = [(2, 1), (0, 2), (1, 0)].map(|(i, j)| (between(i, j) - between(j, i)) / 2.0);
        let sine = skew.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cosine = ((0..3).map(|k| between(k, k)).sum::<f64>() - 1.0) / 2.0;
        Some(PoseError { position, orientation: sine.atan2(cosine) })
    }
}
