//! The branches of a linkage in space while the value of a joint runs through a range.

use super::Range;
use super::assemblies::{AssemblySample, AssemblySweep, Running, follow, is_far, step};
use crate::algebra::number::nearest_f64;
use crate::assembly::wrapped;
use crate::catalogue::SpaceFile;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::space::SpaceGiven;
use crate::linkage::space::{Coordinate, SpaceMode, bodies, clusters, solve_real};
use crate::verdict::Status;
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::{FRAC_1_SQRT_2, TAU};

/// The result of a sweep of a linkage in space.
pub type SpaceSweep = AssemblySweep<SpaceMode>;

/// A joint that runs, while other values are held.
struct Run<'a> {
    file: &'a SpaceFile,
    joint: usize,
    held: Vec<SpaceGiven>,
    /// The points of the joints, each with its body.
    points: Vec<(usize, [f64; 3])>,
    /// The size of the linkage: places are compared in parts of it.
    size: f64,
    /// The bodies that turn: the spin of a rod between two spherical joints means nothing.
    turning: Vec<usize>,
}

impl Run<'_> {
    /// The given values at an input, that of the joint that runs in front.
    fn given(&self, input: f64) -> Result<Vec<SpaceGiven>> {
        let driven = self.file.driven(self.joint, input)?;
        Ok(std::iter::once(driven).chain(self.held.iter().cloned()).collect())
    }
}

impl Running for Run<'_> {
    type Mode = SpaceMode;
    type Memory = ();

    fn sample(&self, input: f64, (): &mut ()) -> Result<AssemblySample<SpaceMode>> {
        let answer = solve_real(&self.file.linkage, &self.given(input)?, true);
        let answer = answer.map(|answer| (answer.verdict, answer.modes));
        AssemblySample::of(input, answer, |mode| mode.real.then_some(mode.multiplicity))
    }

    /// The distance of two assemblies: the largest turn of a body, or the largest step of a joint in parts of the size.
    fn apart(&self, one: &SpaceMode, two: &SpaceMode) -> f64 {
        let turns = self.turning.iter().map(|body| {
            let [a, b] = [one, two].map(|mode| mode.bodies[*body].rotation.iter().flatten());
            // The norm of the difference of two rotations by an angle between them is 2 sqrt(2) times the sine of its half.
            a.zip(b).map(|(x, y)| (x.re - y.re).powi(2)).sum::<f64>().sqrt() * FRAC_1_SQRT_2
        });
        let steps = self.points.iter().map(|(body, point)| {
            let [a, b] = [one, two].map(|mode| place(mode, *body, point));
            step(a, b, self.size)
        });
        turns.chain(steps).fold(0.0, f64::max)
    }

    fn is_far(&self, mode: &SpaceMode) -> bool {
        self.points.iter().any(|(body, point)| is_far(place(mode, *body, point), self.size))
    }

    /// The assembly between two that are nearly one.
    fn middle(&self, one: &SpaceMode, two: &SpaceMode) -> SpaceMode {
        let mut mode = one.clone();
        for ((joint, own), other) in self.file.linkage.joints.iter().zip(&mut mode.joints).zip(&two.joints) {
            if let (Some(own), Some(other)) = (own, other) {
                let step = other.re - own.re;
                let is_angle = joint.is_distance() == Some(false);
                let value = if is_angle { wrapped(own.re + 0.5 * wrapped(step)) } else { own.re + 0.5 * step };
                *own = Complex::new(value, 0.0);
            }
        }
        let half = |a: &Coordinate, b: &Coordinate| (a + b) * 0.5;
        for (own, other) in mode.bodies.iter_mut().zip(&two.bodies) {
            let rotation =
                std::array::from_fn(|i| std::array::from_fn(|k| half(&own.rotation[i][k], &other.rotation[i][k])));
            let translation = std::array::from_fn(|k| half(&own.translation[k], &other.translation[k]));
            *own = Motion { rotation, translation };
        }
        mode
    }
}

/// Sweeps a joint of a linkage in space, on all threads of the current pool, while the other values given in the first case are held.
/// `tick` is called for every step.
///
/// # Errors
/// For joints without a value and empty ranges, and as [`solve_real`].
pub fn sweep_space(file: &SpaceFile, joint: usize, range: Range, tick: impl Fn() + Sync) -> Result<SpaceSweep> {
    let linkage = &file.linkage;
    let held: Vec<SpaceGiven> = file.cases[0].given.iter().filter(|one| one.joint != Some(joint)).cloned().collect();
    let driven = file.driven(joint, range.from)?;
    let given: Vec<SpaceGiven> = std::iter::once(driven).chain(held.iter().cloned()).collect();
    let list = clusters(linkage, &given, &bodies(linkage))?;
    let turning = list.iter().filter(|cluster| !cluster.is_rod);
    let turning = turning.flat_map(|cluster| cluster.bodies.iter().map(|(body, _)| *body)).collect();
    let float = |point: &Vector<Rational>| point.each_ref().map(nearest_f64);
    let points: Vec<(usize, [f64; 3])> =
        linkage.joints.iter().flat_map(|joint| [0, 1].map(|side| (joint.of[side], float(&joint.at[side])))).collect();
    let size = points.iter().flat_map(|(_, point)| point).fold(0.0, |most: f64, c| most.max(c.abs()));
    let size = if size > 0.0 { size } else { 1.0 };
    let is_full_turn =
        linkage.joints[joint].is_distance() == Some(false) && ((range.to - range.from).abs() - TAU).abs() < 1e-12;
    let run = Run { file, joint, held, points, size, turning };
    let mut sweep = follow(&run, joint, range, is_full_turn, tick)?;
    if let [first, rest @ ..] = sweep.samples.as_slice()
        && first.status == Status::Incomplete
        && rest.iter().all(|sample| sample.status == Status::Incomplete)
    {
        return Err(Error::Unsupported(first.reason.clone()));
    }
    sweep.verdict.proof = sweep.verdict.proof.of_rounded(!(file.exact && file.cases[0].exact));
    Ok(sweep)
}

/// The place of a point of a body in an assembly, in coordinates of the ground.
#[must_use]
pub fn place(mode: &SpaceMode, body: usize, point: &[f64; 3]) -> [f64; 3] {
    let Motion { rotation, translation } = &mode.bodies[body];
    std::array::from_fn(|i| translation[i].re + rotation[i].iter().zip(point).map(|(c, x)| c.re * x).sum::<f64>())
}
