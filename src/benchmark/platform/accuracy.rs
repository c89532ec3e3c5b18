//! Counts whether the planted pose is found, whether all poses are found, and whether every result is a pose.

use super::sample::{PlatformSample, PlatformSet, sample};
use crate::algebra::number::Number;
use crate::assembly::Roots;
use crate::benchmark::accuracy::{Counts, Memory, over_all};
use crate::elimination::platform_degree::{PlatformDegree, platform_degree};
use crate::error::Result;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::Motion;
use crate::kinematics::platform::Platform;
use crate::mechanism::{FullMode, Mechanism};
use crate::verdict::Status;
use num_complex::Complex;
use rug::Rational;

/// Number of solutions of the general platform.
const MOST: usize = 40;
/// Tolerance for the planted pose: components of the rotation matrix, and of the position over the size.
const NEAR: f64 = 1e-6;
/// Tolerance for the legs of a mode, relative to their length and divided by the norm of the quaternion squared.
const OFF: f64 = 1e-9;

/// The samples to solve and the way to solve them.
#[derive(Clone, Copy, Debug)]
pub struct PlatformJob {
    /// The family of platforms.
    pub set: PlatformSet,
    /// Number of platforms.
    pub count: u64,
    /// Seed of the draw.
    pub seed: u64,
    /// All roots, or real ones only.
    pub roots: Roots,
}

/// Runs a job on all threads of the pool it is called in; `tick` is called after every platform. Once `running` returns
/// `false`, the platforms not begun are left out of the counts.
///
/// # Errors
/// None in practice, see [`sample`].
pub fn run(job: PlatformJob, running: impl Fn() -> bool + Sync, tick: impl Fn() + Sync) -> Result<Counts> {
    over_all(job.count, running, tick, |index, memory| one(job, index, memory))
}

fn one(job: PlatformJob, index: u64, (workspace, assembly): &mut Memory) -> Result<Counts> {
    let drawn = sample(job.set, job.seed, index)?;
    let mechanism = Mechanism::prepare(&drawn.entry)?;
    let solution = mechanism.solve(&drawn.entry.cases[0], job.roots, workspace, assembly)?;
    let mut counts = Counts::of("platforms", &solution);
    let size = size(&drawn.platform);
    let real: Vec<&FullMode> = solution.modes.iter().filter(|m| m.real).collect();
    let nearest = real.iter().map(|m| apart(&pose(m), &drawn.planted, size)).fold(f64::INFINITY, f64::min);
    if nearest < NEAR {
        counts.found = 1;
        counts.errors.push(nearest);
    } else {
        counts.lost.push(index);
    }
    counts.spurious = solution.modes.iter().filter(|mode| !is_pose(&drawn, mode)).count();
    for (k, mode) in real.iter().enumerate() {
        let here = pose(mode);
        let twin = |other: &&&FullMode| apart(&pose(other), &here, size) < NEAR && !(mode.certified && other.certified);
        counts.duplicates += real[..k].iter().filter(twin).count();
    }
    if job.roots == Roots::All {
        // A list that was proved complete has already been compared with the exact count.
        let complete = matches!(solution.verdict.status, Status::Complete | Status::Unreachable);
        let expected = if complete { Some(solution.verdict.complex) } else { expected(&drawn) };
        if let Some(expected) = expected {
            counts.counted = 1;
            counts.miscounted = expected.abs_diff(solution.verdict.complex);
            counts.miscounted_in.extend((counts.miscounted > 0).then_some(index));
        }
    }
    Ok(counts)
}

/// Returns the exact number of poses.
fn expected(drawn: &PlatformSample) -> Option<usize> {
    let exact = |x: &f64| Rational::from_f64(*x);
    let squares = drawn.entry.cases[0].legs_squared.as_ref()?.each_ref().map(|square| square.rational().clone());
    let points = |points: &[[f64; 3]; 6]| -> Option<[[Rational; 3]; 6]> {
        let images: Option<Vec<[Rational; 3]>> =
            points.iter().map(|[x, y, z]| Some([exact(x)?, exact(y)?, exact(z)?])).collect();
        images?.try_into().ok()
    };
    let platform = Platform { base: points(&drawn.platform.base)?, plate: points(&drawn.platform.plate)? };
    match platform_degree(&platform, &squares)? {
        PlatformDegree::Finite { poses, .. } => Some(poses.min(MOST)),
        PlatformDegree::Infinite { .. } => None,
    }
}

fn size(platform: &Platform<f64>) -> f64 {
    platform.base.iter().chain(&platform.plate).flatten().map(|x| x.abs()).fold(0.0, f64::max)
}

/// Returns the pose of a real mode.
fn pose(mode: &FullMode) -> Motion<f64> {
    let q: [f64; 7] = std::array::from_fn(|k| mode.q[k].re);
    let quaternion = Quaternion { scalar: q[0], vector: [q[1], q[2], q[3]] };
    let norm = quaternion.norm();
    Motion { rotation: quaternion.scaled_rotation().map(|row| row.map(|x| x / norm)), translation: [q[4], q[5], q[6]] }
}

/// Returns the largest difference of two poses.
fn apart(one: &Motion<f64>, two: &Motion<f64>, size: f64) -> f64 {
    let mut largest = 0.0_f64;
    for i in 0..3 {
        for j in 0..3 {
            largest = largest.max((one.rotation[i][j] - two.rotation[i][j]).abs());
        }
        largest = largest.max((one.translation[i] - two.translation[i]).abs() / size);
    }
    largest
}

/// Returns whether the legs of a mode, complex or not, have the right lengths, by the rotation matrix and the points alone.
fn is_pose(drawn: &PlatformSample, mode: &FullMode) -> bool {
    let [w, x, y, z, a, b, c]: [Complex<f64>; 7] = std::array::from_fn(|k| mode.q[k]);
    let quaternion = Quaternion { scalar: w, vector: [x, y, z] };
    let norm = quaternion.norm();
    let rotation = quaternion.scaled_rotation().map(|row| row.map(|x| x / norm));
    let complex = |points: &[[f64; 3]; 6]| points.map(|p| p.map(Complex::from));
    let platform = Platform { base: complex(&drawn.platform.base), plate: complex(&drawn.platform.plate) };
    let legs = platform.legs(&Motion { rotation, translation: [a, b, c] });
    let wanted = drawn.entry.cases[0].legs_squared.as_ref().map(|squares| squares.each_ref().map(Number::to_f64));
    let allowed = OFF / norm.norm_sqr().min(1.0);
    wanted.is_some_and(|wanted| {
        legs.iter().zip(wanted).all(|(leg, wanted)| {
            let square: Complex<f64> = leg.iter().map(|x| x * x).sum();
            let scale = leg.iter().map(Complex::norm_sqr).sum::<f64>() + wanted;
            (square - wanted).norm() <= allowed * scale
        })
    })
}
