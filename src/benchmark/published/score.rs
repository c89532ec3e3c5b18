//! The score of answers: each is put into the closure equations of its problem and compared with the true solutions.

use super::answers::Answer;
use super::problem::{Axis, Body, Problem, Truth};
use crate::assembly::wrapped;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::{Motion, dot};
use std::collections::BTreeMap;

/// Maximum error of the pose at a solution, relative to the size of the mechanism and in radians. An answer finds a true
/// solution if it is no farther away than this times the condition number.
pub const BACKWARD: f64 = 1e-6;

/// The distances of an answer from the true solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Errors {
    /// Error of the position of tool or moving platform, relative to the size of the mechanism.
    pub position: f64,
    /// Error of the rotation of tool or moving platform, radians.
    pub rotation: f64,
    /// Largest error of an unknown, radians or metres.
    pub unknowns: f64,
}

/// Counts of problems, answers and true solutions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Tally {
    /// Number of problems.
    pub problems: usize,
    /// Number of problems with an answer.
    pub answered: usize,
    /// Number of problems of which every true solution is found, and nothing else, or the self-motion is told.
    pub complete: usize,
    /// Number of true solutions.
    pub truths: usize,
    /// True solutions that are found by an answer.
    pub found: usize,
    /// True solutions that are not found.
    pub lost: usize,
    /// Answers that miss the pose, or are at no true solution.
    pub spurious: usize,
    /// Further answers at a true solution that is already found.
    pub duplicates: usize,
    /// True solutions found by an answer that the solver certifies.
    pub certified: usize,
    /// Errors of the true solutions found.
    pub errors: Vec<Errors>,
    /// Time of each answer, seconds.
    pub seconds: Vec<f64>,
    /// Time of each preparation, seconds.
    pub setup_seconds: Vec<f64>,
    /// Number of problems whose solutions form a self-motion.
    pub self_motions: usize,
    /// Number of these of which the answer says so.
    pub detected: usize,
    /// Number of other problems of which the answer says so.
    pub invented: usize,
}

/// Counts over all problems and over parts of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Score {
    /// All problems.
    pub all: Tally,
    /// By the class of the problem.
    pub classes: BTreeMap<String, Tally>,
    /// True solutions by the power of ten of their condition number; the last entry holds multiple solutions.
    pub decades: BTreeMap<i32, Tally>,
    /// The counts by mechanism, which is the identifier of a problem without seed and number.
    pub mechanisms: BTreeMap<String, Tally>,
    /// The number of problems by their class and their number of true solutions.
    pub numbers: BTreeMap<String, BTreeMap<usize, usize>>,
    /// The problems with a true solution that was lost.
    pub lost_in: Vec<String>,
}

/// The decade of the largest numbers of f64.
const LARGEST_DECADE: i32 = 308;
/// The decade of condition numbers that are not finite.
pub const MULTIPLE: i32 = i32::MAX;

/// Scores one answer, or none, for each problem.
#[must_use]
pub fn score(problems: &[Problem], answers: &[Option<Answer>]) -> Score {
    let mut score = Score::default();
    for (problem, answer) in problems.iter().zip(answers) {
        let none = Answer::default();
        let own = answer.as_ref().unwrap_or(&none);
        let (is_moving, is_said) = (problem.self_motion > 0, own.self_motion);
        // Points of a self-motion are neither right nor wrong as isolated solutions.
        let (spurious, at) = if is_moving { (0, Vec::new()) } else { matched(problem, own) };
        let mut own = Tally { problems: 1, answered: usize::from(answer.is_some()), spurious, ..Tally::default() };
        own.seconds.extend(answer.as_ref().and_then(|answer| answer.seconds));
        own.setup_seconds.extend(answer.as_ref().and_then(|answer| answer.setup_seconds));
        own.self_motions = usize::from(is_moving);
        own.detected = usize::from(is_moving && is_said);
        own.invented = usize::from(!is_moving && is_said);
        for (truth, matched) in problem.truth.iter().zip(at) {
            let one = matched.tally();
            own.add(&one);
            score.decades.entry(decade(truth)).or_default().add(&one);
        }
        if own.lost > 0 {
            score.lost_in.push(problem.id.clone());
        }
        own.complete = usize::from(own.lost + own.spurious + own.duplicates == 0 && is_moving == is_said);
        *score.numbers.entry(problem.class.clone()).or_default().entry(problem.truth.len()).or_default() += 1;
        let mechanism = problem.id.rsplitn(3, '-').last().unwrap_or_default();
        score.mechanisms.entry(mechanism.to_owned()).or_default().add(&own);
        score.classes.entry(problem.class.clone()).or_default().add(&own);
        score.all.add(&own);
    }
    score
}

/// Returns the power of ten below the condition number of a true solution.
fn decade(truth: &Truth) -> i32 {
    if truth.multiplicity > 1 || !truth.condition.is_finite() {
        return MULTIPLE;
    }
    (0..LARGEST_DECADE).find(|power| !(truth.condition >= 10.0_f64.powi(power + 1))).unwrap_or(LARGEST_DECADE)
}

/// The answers at one true solution.
#[derive(Clone, Copy, Default)]
struct Matched {
    answers: usize,
    nearest: Option<(Errors, bool)>,
}

impl Matched {
    fn tally(self) -> Tally {
        let found = usize::from(self.nearest.is_some());
        Tally {
            truths: 1,
            found,
            lost: 1 - found,
            duplicates: self.answers - found,
            certified: usize::from(self.nearest.is_some_and(|(_, certified)| certified)),
            errors: self.nearest.map(|(errors, _)| errors).into_iter().collect(),
            ..Tally::default()
        }
    }
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.problems += other.problems;
        self.answered += other.answered;
        self.complete += other.complete;
        self.truths += other.truths;
        self.found += other.found;
        self.lost += other.lost;
        self.spurious += other.spurious;
        self.duplicates += other.duplicates;
        self.certified += other.certified;
        self.errors.extend(&other.errors);
        self.seconds.extend(&other.seconds);
        self.setup_seconds.extend(&other.setup_seconds);
        self.self_motions += other.self_motions;
        self.detected += other.detected;
        self.invented += other.invented;
    }
}

/// Returns the number of answers at no true solution, and the answers at each true one.
fn matched(problem: &Problem, answer: &Answer) -> (usize, Vec<Matched>) {
    let mut at = vec![Matched::default(); problem.truth.len()];
    let reach = tolerances(problem);
    let mut spurious = 0;
    for (k, q) in answer.solutions.iter().enumerate() {
        let missed = problem.body.missed(q);
        let distance = |truth: &Truth| problem.body.distance(q, &truth.q);
        let nearest = problem.truth.iter().map(distance).enumerate().min_by(|(_, a), (_, b)| a.total_cmp(b));
        match nearest {
            Some((index, unknowns)) if missed.iter().all(|x| *x <= BACKWARD) && unknowns <= reach[index] => {
                let own = &mut at[index];
                own.answers += 1;
                if own.nearest.is_none_or(|(errors, _)| unknowns < errors.unknowns) {
                    let certified = answer.certified.get(k).copied().unwrap_or(false);
                    let [position, rotation] = problem.body.off(q, &problem.truth[index].q, missed);
                    own.nearest = Some((Errors { position, rotation, unknowns }, certified));
                }
            }
            _ => spurious += 1,
        }
    }
    (spurious, at)
}

/// Returns for each true solution the distance within which an answer finds it: the effect of an error of [`BACKWARD`] in
/// the equations, and at most a third of the distance to the next true solution.
fn tolerances(problem: &Problem) -> Vec<f64> {
    let one = |(k, truth): (usize, &Truth)| {
        let others = problem.truth.iter().enumerate().filter(|(other, _)| *other != k);
        let next = others.map(|(_, other)| problem.body.distance(&truth.q, &other.q)).fold(f64::INFINITY, f64::min);
        let own = match truth.multiplicity {
            1 => BACKWARD * truth.condition.max(1.0),
            several => BACKWARD.powf(1.0 / several as f64),
        };
        own.min(next / 3.0)
    };
    problem.truth.iter().enumerate().map(one).collect()
}

impl Body {
    /// Returns the errors of pose or legs at these unknowns: relative to the size of the mechanism, and as angle or norm of
    /// the quaternion.
    fn missed(&self, q: &[f64]) -> [f64; 2] {
        match self {
            Self::Chain { axes, home, pose, .. } => {
                let reached = axes.iter().zip(q).rev().fold(home.clone(), |behind, (axis, x)| axis.moved(*x, &behind));
                let far = axes.iter().zip(q).filter(|(axis, _)| axis.variable == Variable::Translation);
                let far = far.map(|(_, x)| x.abs()).fold(size(axes, home), f64::max);
                let off: [f64; 3] = std::array::from_fn(|i| reached.translation[i] - pose.translation[i]);
                [dot(&off, &off).sqrt() / far, angle_between(&reached.rotation, &pose.rotation)]
            }
            Self::Platform { base, plate, legs } => {
                let norm = q[..4].iter().map(|x| x * x).sum::<f64>();
                let rotation = rotation(&[q[0], q[1], q[2], q[3]]);
                let mut missed = 0.0_f64;
                for ((a, b), leg) in base.iter().zip(plate).zip(legs) {
                    let moved: [f64; 3] = std::array::from_fn(|i| dot(&rotation[i], b) + q[4 + i] - a[i]);
                    missed = missed.max((dot(&moved, &moved).sqrt() - leg).abs());
                }
                [missed / longest(legs), (norm - 1.0).abs()]
            }
        }
    }

    /// Returns the errors of position and rotation: for a chain those of the pose to reach, for a platform those of its pose.
    fn off(&self, q: &[f64], truth: &[f64], missed: [f64; 2]) -> [f64; 2] {
        let Self::Platform { legs, .. } = self else { return missed };
        let place: [f64; 3] = std::array::from_fn(|i| q[4 + i] - truth[4 + i]);
        let turn = |q: &[f64]| rotation(&[q[0], q[1], q[2], q[3]]);
        [dot(&place, &place).sqrt() / longest(legs), angle_between(&turn(q), &turn(truth))]
    }

    /// Returns the largest difference of two solutions: angles modulo 2 pi, quaternions up to their sign.
    fn distance(&self, one: &[f64], two: &[f64]) -> f64 {
        match self {
            Self::Chain { axes, spherical, .. } => {
                let apart = |one: &[f64], two: &[f64]| {
                    let difference = |k: usize| match axes[k].variable {
                        Variable::Rotation => wrapped(one[k] - two[k]).abs(),
                        Variable::Translation => (one[k] - two[k]).abs(),
                    };
                    (0..axes.len()).map(difference).fold(0.0, f64::max)
                };
                // A spherical joint has two triples of angles for each rotation.
                let mut other = two.to_vec();
                let mut least = apart(one, two);
                for first in spherical {
                    other[*first] += std::f64::consts::PI;
                    other[first + 1] *= -1.0;
                    other[first + 2] += std::f64::consts::PI;
                    least = least.min(apart(one, &other));
                }
                least
            }
            Self::Platform { .. } => {
                let apart = |sign: f64| {
                    let difference = |k: usize| (one[k] - if k < 4 { sign * two[k] } else { two[k] }).abs();
                    (0..7).map(difference).fold(0.0, f64::max)
                };
                apart(1.0).min(apart(-1.0))
            }
        }
    }
}

fn longest(legs: &[f64; 6]) -> f64 {
    legs.iter().copied().fold(f64::MIN_POSITIVE, f64::max)
}

/// Returns the rotation of a quaternion of norm 1.
fn rotation([w, x, y, z]: &[f64; 4]) -> [[f64; 3]; 3] {
    [
        [w * w + x * x - y * y - z * z, 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
}

/// Returns the angle of the rotation from one to the other.
fn angle_between(one: &[[f64; 3]; 3], two: &[[f64; 3]; 3]) -> f64 {
    let off = |i: usize, j: usize| (0..3).map(|k| one[i][k] * two[j][k]).sum::<f64>();
    let skew = [off(2, 1) - off(1, 2), off(0, 2) - off(2, 0), off(1, 0) - off(0, 1)];
    dot(&skew, &skew).sqrt().atan2(off(0, 0) + off(1, 1) + off(2, 2) - 1.0)
}

/// Returns the sum of the distances from axis to axis and on to the tool, metres; 1 if it is zero.
fn size(axes: &[Axis], home: &Motion<f64>) -> f64 {
    let points: Vec<&[f64; 3]> = axes.iter().map(|axis| &axis.point).chain([&home.translation]).collect();
    let apart = |one: &[f64; 3], two: &[f64; 3]| (0..3).map(|i| (one[i] - two[i]).powi(2)).sum::<f64>().sqrt();
    let way: f64 = points.windows(2).map(|pair| apart(pair[0], pair[1])).sum();
    if way > 0.0 { way } else { 1.0 }
}

impl Axis {
    /// Returns a motion behind the rotation about this axis, or the translation along it.
    fn moved(&self, x: f64, behind: &Motion<f64>) -> Motion<f64> {
        let u = self.direction;
        if self.variable == Variable::Translation {
            let translation = std::array::from_fn(|i| behind.translation[i] + x * u[i]);
            return Motion { rotation: behind.rotation, translation };
        }
        let (sin, cos) = x.sin_cos();
        let turned = |v: [f64; 3]| {
            let along = dot(&u, &v) * (1.0 - cos);
            let across = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
            std::array::from_fn(|i| cos * v[i] + sin * across[i] + along * u[i])
        };
        let columns: [[f64; 3]; 3] = std::array::from_fn(|j| turned(std::array::from_fn(|i| behind.rotation[i][j])));
        let from_point: [f64; 3] = turned(std::array::from_fn(|i| behind.translation[i] - self.point[i]));
        Motion {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i])),
            translation: std::array::from_fn(|i| from_point[i] + self.point[i]),
        }
    }
}
