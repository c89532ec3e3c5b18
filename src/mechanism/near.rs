//! Configurations that reach a pose within the tolerance but not exactly. A pose that is typed is rounded, and a singular pose is
//! lost by rounding: a double solution becomes a complex pair, and a self-motion becomes a few isolated solutions.

use super::nearest::nearest as nearest_to;
use super::singular_posture::{MOST_CORANK, Postures, Singular};
use crate::assembly::wrapped;
use crate::kinematics::chain::Placement;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use crate::kinematics::forward::Forward;
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
    pub forward: &'a Forward,
    /// The order of its variables.
    pub layout: &'a Layout,
    /// The pose.
    pub pose: &'a Placement,
    /// The loop that both make, lengths over `scale`.
    pub closed: &'a ClosedLoop<f64>,
    /// The loop at another pose, in the same unit.
    pub closed_at: &'a dyn Fn(&Motion<f64>) -> ClosedLoop<f64>,
    /// The unit of lengths in the loop.
    pub scale: f64,
    /// The tolerance.
    pub tolerance: Tolerance,
    /// Whether the joints are dependent in every position.
    pub is_deficient: bool,
    /// Whether the exact data leave no solution to start from, not even a complex one, and nothing denies the pose: rounding may have sent
    /// all of a self-motion to infinity.
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

impl Start {
    /// Whether it is the first one of a pair of conjugates, or real.
    fn is_first(&self) -> bool {
        self.unknowns.iter().map(|z| z.im).find(|x| *x != 0.0).is_none_or(|x| x > 0.0)
    }
}

/// The configurations and families near a pose.
#[derive(Debug, Default)]
pub(super) struct Near {
    /// Configurations that appear to be isolated.
    pub modes: Vec<(Six<f64>, PoseError)>,
    /// Self-motions.
    pub families: Vec<NearFamily>,
}

impl Near {
    /// Whether nothing is near.
    pub fn is_empty(&self) -> bool {
        self.modes.is_empty() && self.families.is_empty()
    }
}

/// A self-motion near a pose.
#[derive(Debug)]
pub(super) struct NearFamily {
    /// Its points.
    pub motion: SelfMotion,
    /// The largest error of the pose along it.
    pub distance: f64,
    /// The loop at the pose that it reaches exactly; `None` where it reaches the pose asked for up to what may be missed.
    pub closed: Option<ClosedLoop<f64>>,
}

/// Ratio of the condition of a solution on a near self-motion to the tolerance: 0.02 of its way changes the pose by no more than
/// the tolerance.
const CONDITION: f64 = 1e-3;
/// Solutions nearer to each other than this are one as seen from a near one: a pair that rounding splits.
const SAME: f64 = 1e-3;
/// Two solutions are nearer than this many roots of the tolerance if rounding split one.
const SPLIT: f64 = 2.0;
/// Condition of complex solutions beside a near configuration, in parts of the root of the tolerance: rounding leads by that root away
/// from where the arm is singular, and the arm by as much away from being so.
const BESIDE: f64 = 0.3;
/// Rounding alone keeps solutions of this condition, in parts of the tolerance, apart from a self-motion.
const LOST: f64 = 0.1;
/// Samples of a self-motion are apart by less in each variable.
const STEP: f64 = 0.1;
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
/// A self-motion is near if it is at this number of points: rounding adds up along the others.
const LOOKED_AT: usize = 24;

impl Neighbourhood<'_> {
    /// Returns the near configurations that are not yet known. `solutions` are all exact ones, `families` the self-motions that
    /// reach the pose exactly.
    pub fn run(&self, solutions: &[Start], families: &[SelfMotion], seen: &[SelfMotion]) -> Near {
        let within = self.within();
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
        let is_split = |start: &Start| !start.is_real && imaginary(start) < widest;
        let is_beside = |start: &Start| is_split(start) || !(start.condition < BESIDE / within.sqrt());
        let all = middles.iter().chain(bad).chain(real.iter().chain(&complex).copied().filter(|start| {
            is_beside(start) && if start.is_real { start.condition < CONDITION / within } else { start.is_first() }
        }));
        for start in all.take(MOST_STARTS) {
            let is_far = if start.is_real { start.condition < CONDITION / within } else { !is_split(start) };
            // A pose that is singular to rounding has curves that cross each other, which are traced from the pose itself.
            if start.is_real
                && !(start.condition < LOST / within)
                && let Some(point) = nearest(self.closed, &start.unknowns.map(|z| z.re), within)
                && !self.is_known(&point, &near)
            {
                for family in &self_motions(self.closed, &point, within) {
                    self.admit(family, families, within, &mut near);
                }
            }
            let is_found = self.visit(start, families, &real, &mut near);
            // Where there is no solution, what Newton's method comes near to from afar is asked, too.
            let is_decided = is_found || self.postures().is_some() && !real.is_empty();
            if is_decided || is_far {
                continue;
            }
            let Some(point) = nearest(self.closed, &start.unknowns.map(|z| z.re), within) else { continue };
            if families.iter().any(|family| family.holds(self.closed, &point, within)) || self.is_known(&point, &near) {
                continue;
            }
            let found = self_motions(self.closed, &point, within);
            for family in &found {
                self.admit(family, families, within, &mut near);
            }
            if !start.is_real && !self.is_known(&point, &near) {
                self.admit_mode(&point, &real, &mut near);
            }
        }
        if near.families.is_empty() && near.modes.is_empty() {
            let is_lost = |start: &&&Start| !(start.condition < LOST / within);
            for start in complex.iter().filter(is_lost).step_by(2).take(MOST_SEARCHES) {
                self.search(&start.unknowns.map(|z| z.re), families, within, &mut near);
            }
        }
        if self.is_deficient && families.is_empty() && near.families.is_empty() {
            for trial in 1..=STARTS {
                let start = approach(self.closed, &spread(&self.closed.variables, trial));
                self.look(&start, families, within, &mut near);
            }
        } else if self.is_empty && families.is_empty() && near.families.is_empty() {
            for trial in 1..=STARTS {
                let start = approach(self.closed, &spread(&self.closed.variables, trial));
                let unknowns = start.map(Complex::from);
                let start = Start { unknowns, is_real: false, condition: f64::INFINITY };
                if self.visit(&start, families, &[], &mut near)
                    || self.look(&start.unknowns.map(|z| z.re), families, within, &mut near)
                {
                    continue;
                }
                if let Some(point) = nearest(self.closed, &start.unknowns.map(|z| z.re), within) {
                    self.admit_mode(&point, &[], &mut near);
                }
            }
        }
        self.add_crossing(families, &mut near);
        self.rest_spherical(&real, &mut near);
        near
    }

    /// Returns by how many tolerances the pose is missed where least squares come nearest to it, from solutions and from places all over;
    /// `None` where one joint at least is a virtual one.
    pub fn closest(&self, solutions: &[Start]) -> Option<f64> {
        self.postures()?;
        let moving: Vec<usize> = (0..6).collect();
        let first = solutions.iter().filter(|start| start.is_first()).map(|start| start.unknowns.map(|z| z.re));
        let others = (1..=TRIALS).map(|trial| spread(&self.closed.variables, trial));
        let found = first.chain(others).map(|start| {
            let from = self.values(&start);
            self.tolerance.parts(&nearest_to(self.forward, &from, &moving, &self.pose.float, self.tolerance).1)
        });
        found.reduce(f64::min)
    }

    /// The middles of pairs of solutions that are one but for rounding. Where two singular positions meet, rounding splits the solution
    /// by its root in one of them, and so leaves the other one by as much; the middle has lost the square of that only.
    fn middles(&self, bad: &[&Start]) -> Vec<Start> {
        let mut found = Vec::new();
        for (k, one) in bad.iter().enumerate() {
            for other in &bad[..k] {
                let [from, to] = [one, other].map(|start| start.unknowns.map(|z| z.re));
                let way: Six<f64> = std::array::from_fn(|j| self.difference(j, &to, &from));
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
        let rests = |family: &NearFamily| (0..6).all(|k| !family.motion.moving[k] || k == first || k == first + 2);
        let (resting, moving): (Vec<_>, Vec<_>) = near.families.drain(..).partition(rests);
        near.families = moving;
        for point in resting.iter().filter_map(|family| family.motion.points.first()) {
            self.admit_mode(point, real, near);
        }
    }

    /// The search for singular postures; `None` for joints that are dependent always, and where a joint is a virtual one.
    fn postures(&self) -> Option<Postures<'_>> {
        let is_whole = !self.is_deficient && self.layout.variables.len() == 6;
        let Self { forward, pose, tolerance, scale, .. } = *self;
        is_whole.then_some(Postures { forward, wanted: &pose.float, tolerance, scale })
    }

    /// Takes in what is near at singular postures beside a start: the self-motions of the arm through them, which reach the pose of the
    /// posture exactly, or the posture alone, unless real solutions are beside it. Returns whether there is such a posture.
    fn visit(&self, start: &Start, families: &[SelfMotion], real: &[&Start], near: &mut Near) -> bool {
        let Some(postures) = self.postures() else { return false };
        let from = self.values(&start.unknowns.map(|z| z.re));
        let mut is_found = false;
        for set in postures.nearly_dependent(&from) {
            is_found |= self.admit_dependent(&postures, set, &from, families, near);
        }
        // What a pair of real solutions would be for a pose beside is near them.
        if start.is_real && start.condition < LOST / self.within() {
            return is_found;
        }
        let by_corank = || (1..=MOST_CORANK).rev().find_map(|c| postures.nearest(&from, Singular::Corank(c)));
        if !is_found && let Some(q) = by_corank() {
            is_found = true;
            let is_on = self.is_known(&self.unknowns(&q), near) || self.admit_posture(&q, families, near);
            if !is_on && !start.is_real {
                self.admit_mode(&self.unknowns(&q), real, near);
            }
        }
        is_found
    }

    /// Takes in the self-motions near self-motions: where a curve of four joints passes a posture with two joints in line, these may turn.
    fn add_crossing(&self, families: &[SelfMotion], near: &mut Near) {
        let Some(postures) = self.postures() else { return };
        for place in 0..near.families.len() {
            let curve: Vec<Six<f64>> = near.families[place].motion.points.iter().map(|q| self.values(q)).collect();
            for (set, q) in postures.most_in_line(&curve) {
                self.admit_dependent(&postures, set, &q, families, near);
            }
        }
    }

    /// Takes in the self-motions at the posture near a start where these joints are dependent. Whether there are any, known or not.
    fn admit_dependent(
        &self,
        postures: &Postures<'_>,
        set: usize,
        from: &Six<f64>,
        families: &[SelfMotion],
        near: &mut Near,
    ) -> bool {
        let Some(q) = postures.nearest(from, Singular::Joints(set)) else { return false };
        let (point, own) = (self.unknowns(&q), self.layout.joint_variables());
        let is_of_these = |family: &SelfMotion| {
            (0..6).all(|k| own[k].is_some_and(|index| family.moving[k] == (set >> index & 1 == 1)))
        };
        let mut known = near.families.iter().map(|family| &family.motion).chain(families);
        known.any(|family| is_of_these(family) && self.is_beside(family, &point))
            || self.admit_posture(&q, families, near)
    }

    /// Takes in the self-motions through a singular posture. Whether there are any, known or not.
    fn admit_posture(&self, q: &Six<f64>, families: &[SelfMotion], near: &mut Near) -> bool {
        let point = self.unknowns(q);
        let closed = (self.closed_at)(&self.forward.pose(q));
        let found = self_motions(&closed, &point, CLOSES_WITHIN);
        for motion in &found {
            let middle = &motion.points[motion.points.len() / 2];
            let is_new = !near.families.iter().map(|family| &family.motion).chain(families).any(|other| {
                other.dimension == motion.dimension && other.moving == motion.moving && self.is_beside(other, middle)
            });
            if is_new && let Some(distance) = self.distance(motion) {
                near.families.push(NearFamily { motion: motion.clone(), distance, closed: Some(closed.clone()) });
            }
        }
        !found.is_empty()
    }

    /// Whether a configuration is near a self-motion, or would be if the joints moved that move along it.
    fn is_beside(&self, family: &SelfMotion, point: &Six<f64>) -> bool {
        let still = self.apart();
        family.points.iter().any(|sample| {
            (0..6).all(|k| {
                let off = self.difference(k, sample, point).abs();
                off < if family.moving[k] { STEP } else { still } || family.dimension > 1 && family.moving[k]
            })
        })
    }

    fn is_known(&self, point: &Six<f64>, near: &Near) -> bool {
        near.families.iter().any(|family| self.is_beside(&family.motion, point))
    }

    /// Solutions farther apart are two.
    fn apart(&self) -> f64 {
        (SPLIT * self.within().sqrt()).max(SAME)
    }

    fn within(&self) -> f64 {
        self.tolerance.angle.max(self.tolerance.length / self.scale).max(CLOSES_WITHIN)
    }

    fn difference(&self, k: usize, one: &Six<f64>, other: &Six<f64>) -> f64 {
        let off = one[k] - other[k];
        if self.closed.variables[k] == Variable::Rotation { wrapped(off) } else { off }
    }

    fn unit(&self, variable: Variable) -> f64 {
        if variable == Variable::Rotation { 1.0 } else { self.scale }
    }

    /// Takes in the near self-motions at a start. Whether there are any, known or not.
    fn look(&self, start: &Six<f64>, families: &[SelfMotion], within: f64, near: &mut Near) -> bool {
        let Some(point) = nearest(self.closed, start, within) else { return false };
        if families.iter().any(|family| family.holds(self.closed, &point, within)) || self.is_known(&point, near) {
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
            if self.look(&approach(self.closed, &start), families, within, near) {
                return;
            }
        }
    }

    /// Takes in a self-motion that is near all along and not known.
    fn admit(&self, family: &SelfMotion, exact: &[SelfMotion], within: f64, near: &mut Near) {
        let middle = &family.points[family.points.len() / 2];
        let is_same = |other: &SelfMotion| {
            other.dimension == family.dimension
                && (other.holds(self.closed, middle, within) || other.moving == family.moving && other.dimension > 1)
        };
        let is_near = |other: &NearFamily| {
            is_same(&other.motion) || other.motion.moving == family.moving && self.is_beside(&other.motion, middle)
        };
        if exact.iter().any(is_same) || near.families.iter().any(is_near) {
            return;
        }
        if let Some(distance) = self.distance(family) {
            near.families.push(NearFamily { motion: family.clone(), distance, closed: None });
        }
    }

    /// The largest error of the pose along a self-motion; `None` where it is too large.
    fn distance(&self, family: &SelfMotion) -> Option<f64> {
        let stride = family.points.len().div_ceil(LOOKED_AT);
        let errors: Vec<PoseError> = family.points.iter().map(|q| self.error(q)).collect();
        let is_near = errors.iter().step_by(stride).all(|error| self.tolerance.allows(error));
        is_near.then(|| errors.iter().map(PoseError::largest).fold(0.0, f64::max))
    }

    /// Takes in a configuration that is near and no solution again.
    fn admit_mode(&self, point: &Six<f64>, real: &[&Start], near: &mut Near) {
        let is_apart = |other: &Six<f64>| {
            (0..6).map(|k| self.difference(k, other, point).abs()).fold(0.0, f64::max) > self.apart()
        };
        let is_new = real.iter().all(|start| is_apart(&start.unknowns.map(|z| z.re)))
            && near.modes.iter().all(|(other, _)| is_apart(other));
        let error = self.error(point);
        if is_new && self.tolerance.allows(&error) {
            near.modes.push((*point, error));
        }
    }

    /// The joint values of the arm; those of joints that it does not have are 0.
    fn values(&self, unknowns: &Six<f64>) -> Six<f64> {
        let mut q = [0.0; 6];
        for (k, index) in self.layout.joint_variables().into_iter().enumerate() {
            if let Some(value) = index.and_then(|index| q.get_mut(index)) {
                *value = unknowns[k] * self.unit(self.closed.variables[k]);
            }
        }
        q
    }

    /// The unknowns of joint values of an arm of six.
    fn unknowns(&self, q: &Six<f64>) -> Six<f64> {
        let own = self.layout.joint_variables();
        std::array::from_fn(|k| own[k].map_or(0.0, |index| q[index] / self.unit(self.closed.variables[k])))
    }

    /// Returns the error of the pose at a configuration.
    fn error(&self, unknowns: &Six<f64>) -> PoseError {
        PoseError::between(&self.forward.pose(&self.values(unknowns)), &self.pose.float)
    }
}
