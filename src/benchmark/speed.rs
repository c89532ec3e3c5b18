//! Timing, one core, all figures of one run side by side with the eigenvalues of one 16 x 16 matrix by faer.

use super::sample::{Set, sample};
use crate::assembly::{Assembly, Roots, Solver, Workspace};
use crate::elimination::pencil::Square;
use crate::error::Result;
use crate::kinematics::closed_loop::{Layout, OpenLoop};
use crate::kinematics::motion::Motion;
use crate::solve::eigen::EigenWorkspace;
use crate::solve::francis;
use std::fmt::{self, Display};
use std::hint::black_box;
use std::time::Instant;

/// Median and fastest time of each stage, microseconds per arm.
#[derive(Clone, Debug)]
pub struct Timings {
    /// Name, median, minimum.
    pub rows: Vec<(&'static str, f64, f64)>,
}

/// Times `count` general arms, `repeats` times over: the stages in turn within each repeat, so that a machine that
/// changes its speed changes it for all of them.
///
/// # Errors
/// None in practice, see [`sample`].
pub fn run(count: u64, repeats: usize, seed: u64) -> Result<Timings> {
    let mut arms: Vec<(OpenLoop<f64>, Motion<f64>)> = Vec::new();
    for index in 0..count {
        let drawn = sample(Set::General, seed, index)?;
        let open = drawn.chain.open_loop(&Layout::of(&drawn.chain, None)?)?;
        let pose = drawn.entry.cases[0].pose.as_ref().map(|p| p.float.inverse());
        arms.extend(pose.map(|pose| (open, pose)));
    }
    let solvers: Vec<Solver> = arms.iter().map(|(open, _)| Solver::prepare(open)).collect();
    let matrices: Vec<Square<f64, 16>> =
        solvers.iter().zip(&arms).filter_map(|(solver, (_, pose))| solver.companion(pose)).collect();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mut eigen = EigenWorkspace::default();
    let names = [
        "faer, eigenvalues of 16x16",
        "own eigenvalues of 16x16",
        "real solutions",
        "all 16 solutions",
        "prepare a geometry",
    ];
    let mut times = vec![Vec::new(); names.len()];
    for _ in 0..repeats {
        let mut stage = |index: usize, work: &mut dyn FnMut(usize)| {
            let start = Instant::now();
            for k in 0..arms.len() {
                work(k);
            }
            times[index].push(start.elapsed().as_secs_f64() * 1e6 / arms.len() as f64);
        };
        stage(0, &mut |k| {
            black_box(eigen.of_matrix(&matrices[k % matrices.len()]));
        });
        stage(1, &mut |k| {
            black_box(francis::eigenvalues(&mut matrices[k % matrices.len()].clone()));
        });
        stage(2, &mut |k| solvers[k].solve(&arms[k].1, Roots::Real, &mut workspace, &mut assembly));
        stage(3, &mut |k| solvers[k].solve(&arms[k].1, Roots::All, &mut workspace, &mut assembly));
        stage(4, &mut |k| {
            black_box(Solver::prepare(&arms[k].0));
        });
    }
    let rows = names.iter().zip(&mut times).map(|(name, times)| {
        times.sort_by(f64::total_cmp);
        (*name, times[times.len() / 2], times[0])
    });
    Ok(Timings { rows: rows.collect() })
}

impl Display for Timings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (_, base_median, _) = self.rows[0];
        write!(f, "{:<28}{:>10}{:>10}{:>12}", "microseconds, one core", "median", "least", "of faer")?;
        for (name, median, least) in &self.rows {
            write!(f, "\n{name:<28}{median:>10.1}{least:>10.1}{:>12.2}", median / base_median)?;
        }
        Ok(())
    }
}
