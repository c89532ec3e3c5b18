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

/// Median and fastest time of each stage, microseconds per sample.
#[derive(Clone, Debug)]
pub struct Timings {
    /// Name, median, minimum.
    pub rows: Vec<(&'static str, f64, f64)>,
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
        stages.time(4, arms.len(), &mut |k| solvers[k].solve(&arms[k].1, Roots::All, &mut workspace, &mut assembly));
        stages.time(5, batch.1.len(), &mut |k| batch.0.solve(&batch.1[k], Roots::All, &mut workspace, &mut assembly));
        stages.time(6, arms.len(), &mut |k| {
            black_box(Solver::prepare(&arms[k].0));
        });
    }
    Ok(stages.timings())
}

/// Draws a general arm, and poses that random joint values reach.
fn one_arm(seed: u64) -> Result<(Solver, Vec<Motion<f64>>)> {
    let chain = sample(Set::General, seed, 0)?.chain;
    let solver = Solver::prepare(&chain.open_loop(&Layout::of(&chain, None)?)?);
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let mut closings = Vec::with_capacity(POSES);
    for _ in 0..POSES {
        let turns: [Motion<f64>; 6] = std::array::from_fn(|_| {
            let (sin, cos) = random.random_range(-PI..PI).sin_cos();
            Motion::rotation_z(cos, sin)
        });
        closings.extend(chain.forward::<f64>(&turns).map(|reached| reached.inverse()));
    }
    Ok((solver, closings))
}

/// Times of several stages, gathered over many repeats.
pub(super) struct Stages {
    names: Vec<&'static str>,
    times: Vec<Vec<f64>>,
}

impl Stages {
    /// Creates stages of these names; the first one is the reference for all.
    pub(super) fn new(names: &[&'static str]) -> Self {
        Self { names: names.to_vec(), times: vec![Vec::new(); names.len()] }
    }

    /// Times one stage over this many samples.
    pub(super) fn time(&mut self, stage: usize, samples: usize, work: &mut dyn FnMut(usize)) {
        let start = Instant::now();
        for k in 0..samples {
            work(k);
        }
        self.times[stage].push(start.elapsed().as_secs_f64() * 1e6 / samples as f64);
    }

    /// Median and minimum of every stage that was timed.
    pub(super) fn timings(mut self) -> Timings {
        let rows = self.names.iter().zip(&mut self.times).filter(|(_, times)| !times.is_empty());
        let rows = rows.map(|(name, times)| {
            times.sort_by(f64::total_cmp);
            (*name, times[times.len() / 2], times[0])
        });
        Timings { rows: rows.collect() }
    }
}

impl Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let base_median = self.rows.first().map_or(f64::NAN, |(_, median, _)| *median);
        write!(f, "{:<28}{:>10}{:>10}{:>12}", "microseconds, one core", "median", "least", "of faer")?;
        for (name, median, least) in &self.rows {
            write!(f, "\n{name:<28}{median:>10.1}{least:>10.1}{:>12.2}", median / base_median)?;
        }
        Ok(())
    }
}
