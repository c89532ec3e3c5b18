//! Timings on one core, all of one run beside the eigenvalues of one 16 x 16 matrix by faer.

use super::sample::{Set, sample};
use crate::algebra::double_double::DoubleDouble;
use crate::assembly::{Assembly, Margin, Roots, Solver, Workspace};
use crate::elimination::pencil::Square;
use crate::error::Result;
use crate::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop};
use crate::kinematics::motion::Motion;
use crate::solve::eigen::EigenWorkspace;
use crate::solve::francis;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use std::f64::consts::PI;
use std::fmt::{self, Display};
use std::hint::black_box;
use std::time::Instant;

/// Poses of one arm: more of them give the same mean.
const POSES: usize = 512;

/// The times of all stages.
#[derive(Clone, Debug)]
pub struct Timings {
    /// One row for each stage; the first one is the reference.
    pub rows: Vec<StageTimes>,
}

/// The times of one stage, microseconds per sample.
#[derive(Clone, Debug)]
pub struct StageTimes {
    /// The name of the stage.
    pub name: &'static str,
    /// The median sample; the time of a sample is the median of its repeats.
    pub median: f64,
    /// The mean of all samples, the median of the repeats.
    pub mean: f64,
    /// The same, the fastest of the repeats.
    pub least: f64,
}

/// Times `count` general arms, `repeats` times over. The stages alternate within each repeat, so that a change of the
/// machine's speed affects all of them alike.
///
/// # Errors
/// None in practice, see [`sample`].
pub fn run(count: u64, repeats: usize, seed: u64) -> Result<Timings> {
    let mut arms: Vec<(OpenLoop<f64>, Motion<f64>)> = Vec::new();
    let mut exact: Vec<ClosedLoop<DoubleDouble>> = Vec::new();
    for index in 0..count {
        let drawn = sample(Set::General, seed, index)?;
        let layout = Layout::of(&drawn.chain, None)?;
        let open = drawn.chain.open_loop(&layout)?;
        let Some(pose) = drawn.entry.cases[0].pose.as_ref().map(|p| p.float.inverse()) else { continue };
        arms.push((open, pose));
        exact.push(drawn.chain.open_loop(&layout)?.close(&Motion::identity()));
    }
    let solvers: Vec<Solver> = arms.iter().map(|(open, _)| Solver::prepare(open)).collect();
    let batch = one_arm(seed)?;
    let matrices: Vec<Square<f64, 16>> =
        solvers.iter().zip(&arms).filter_map(|(solver, (_, pose))| solver.companion(pose)).collect();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mut eigen = EigenWorkspace::default();
    let mut stages = Stages::new(&[
        "faer, eigenvalues of 16x16",
        "own eigenvalues of 16x16",
        "real solutions",
        "real solutions, proved",
        "proved, poses of one arm",
        "all 16 solutions",
        "all 16, poses of one arm",
        "prepare a geometry",
    ]);
    for _ in 0..repeats {
        stages.time(0, arms.len(), &mut |k| {
            black_box(eigen.of_matrix(&matrices[k % matrices.len()]));
        });
        stages.time(1, arms.len(), &mut |k| {
            black_box(francis::eigenvalues(&mut matrices[k % matrices.len()].clone()));
        });
        stages.time(2, arms.len(), &mut |k| {
            solvers[k].solve(&arms[k].1, Roots::Real, &mut workspace, &mut assembly);
        });
        stages.time(3, arms.len(), &mut |k| {
            let gap = solvers[k].gap(&arms[k].1);
            let exact = || Some(exact[k].clone());
            black_box(solvers[k].solve_real(&gap, &exact, Margin::Blur(0.0), &mut workspace, &mut assembly));
        });
        stages.time(4, batch.poses.len(), &mut |k| {
            let gap = batch.solver.gap(&batch.poses[k]);
            let exact = || Some(batch.exact.clone());
            black_box(batch.solver.solve_real(&gap, &exact, Margin::Blur(0.0), &mut workspace, &mut assembly));
        });
        stages.time(5, arms.len(), &mut |k| solvers[k].solve(&arms[k].1, Roots::All, &mut workspace, &mut assembly));
        stages.time(6, batch.poses.len(), &mut |k| {
            batch.solver.solve(&batch.poses[k], Roots::All, &mut workspace, &mut assembly);
        });
        stages.time(7, arms.len(), &mut |k| {
            black_box(Solver::prepare(&arms[k].0));
        });
    }
    Ok(stages.timings())
}

/// An arm and its poses, inverted.
struct Batch {
    solver: Solver,
    /// The arm in more digits; nothing is read of it but its constants.
    exact: ClosedLoop<DoubleDouble>,
    poses: Vec<Motion<f64>>,
}

/// Draws a general arm, and poses that random joint values reach.
fn one_arm(seed: u64) -> Result<Batch> {
    let chain = sample(Set::General, seed, 0)?.chain;
    let layout = Layout::of(&chain, None)?;
    let solver = Solver::prepare(&chain.open_loop(&layout)?);
    let exact = chain.open_loop(&layout)?.close(&Motion::identity());
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut poses = Vec::with_capacity(POSES);
    for _ in 0..POSES {
        let turns: [Motion<f64>; 6] = std::array::from_fn(|_| {
            let (sin, cos) = random.random_range(-PI..PI).sin_cos();
            Motion::rotation_z(cos, sin)
        });
        poses.extend(chain.forward::<f64>(&turns).map(|reached| reached.inverse()));
    }
    Ok(Batch { solver, exact, poses })
}

/// Times of several stages, gathered over many repeats.
pub(super) struct Stages {
    names: Vec<&'static str>,
    /// Of each stage the times of every sample, one for each repeat.
    times: Vec<Vec<Vec<f64>>>,
}

impl Stages {
    /// Creates stages of these names; the first one is the reference for all.
    pub(super) fn new(names: &[&'static str]) -> Self {
        Self { names: names.to_vec(), times: vec![Vec::new(); names.len()] }
    }

    /// Times one stage over this many samples.
    pub(super) fn time(&mut self, stage: usize, samples: usize, work: &mut dyn FnMut(usize)) {
        let times = &mut self.times[stage];
        times.resize(samples, Vec::new());
        let mut start = Instant::now();
        for (k, own) in times.iter_mut().enumerate() {
            work(k);
            let end = Instant::now();
            own.push((end - start).as_secs_f64() * 1e6);
            start = end;
        }
    }

    /// The times of every stage that was timed.
    pub(super) fn timings(self) -> Timings {
        let rows = self.names.into_iter().zip(self.times).filter(|(_, times)| !times.is_empty());
        Timings { rows: rows.map(|(name, times)| StageTimes::of(name, times)).collect() }
    }
}

impl StageTimes {
    /// Returns the times of a stage from those of every sample, one for each repeat.
    fn of(name: &'static str, mut times: Vec<Vec<f64>>) -> Self {
        let sorted = |times: &mut [f64]| times.sort_by(f64::total_cmp);
        let repeats = times.first().map_or(0, Vec::len);
        let mean = |repeat: usize| times.iter().map(|own| own[repeat]).sum::<f64>() / times.len() as f64;
        let mut means: Vec<f64> = (0..repeats).map(mean).collect();
        sorted(&mut means);
        let middle = |own: &mut Vec<f64>| {
            sorted(own);
            own[own.len() / 2]
        };
        let median = middle(&mut times.iter_mut().map(middle).collect());
        Self { name, median, mean: means[repeats / 2], least: means[0] }
    }
}

impl Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:<28}{:>10}{:>10}{:>10}{:>10}", "microseconds, one core", "median", "of faer", "mean", "of faer")?;
        for StageTimes { name, median, mean, .. } in &self.rows {
            let [of_median, of_mean] =
                self.rows.first().map_or([f64::NAN; 2], |own| [median / own.median, mean / own.mean]);
            write!(f, "\n{name:<28}{median:>10.1}{of_median:>10.2}{mean:>10.1}{of_mean:>10.2}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::StageTimes;

    #[test]
    fn a_row_has_the_median_sample_and_the_mean_of_all() {
        let times = vec![vec![1.0, 2.0, 9.0], vec![4.0, 3.0, 5.0], vec![100.0, 10.0, 40.0]];
        let row = StageTimes::of("stage", times);
        assert_eq!((row.median, row.mean, row.least), (4.0, 18.0, 5.0));
    }
}
