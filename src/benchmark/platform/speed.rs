//! Timings on one core, all of one run beside faer's eigen-decomposition of one 40 x 40 matrix.

use super::sample::{PlatformSet, sample};
use crate::algebra::number::Number;
use crate::assembly::Roots;
use crate::assembly::platform::{PlatformAssembly, PlatformSolver, PlatformWorkspace};
use crate::benchmark::speed::{Stages, Timings};
use crate::error::Result;
use crate::solve::eigen::{Eigenvectors, Method};
use crate::solve::spectrum::Spectrum;
use std::hint::black_box;

/// Times `count` platforms of a set, `repeats` times over. The stages alternate within each repeat, so that a change of
/// the machine's speed affects all of them alike.
///
/// # Errors
/// None in practice, see [`sample`].
pub fn run(set: PlatformSet, count: u64, repeats: usize, seed: u64) -> Result<Timings> {
    let (mut solvers, mut legs, mut platforms) = (Vec::new(), Vec::new(), Vec::new());
    for index in 0..count {
        let drawn = sample(set, seed, index)?;
        solvers.push(PlatformSolver::prepare(&drawn.platform));
        legs.extend(drawn.entry.cases[0].legs_squared.as_ref().map(|squares| squares.each_ref().map(Number::to_f64)));
        platforms.push(drawn.platform);
    }
    let (mut workspace, mut assembly) = (PlatformWorkspace::default(), PlatformAssembly::default());
    let matrices: Vec<_> =
        solvers.iter().zip(&legs).filter_map(|(solver, legs)| solver.matrix(legs, &mut workspace)).collect();
    let (mut reference, mut spectrum) = (Eigenvectors::<40>::default(), Spectrum::<40>::default());
    let mut stages = Stages::new(&[
        "faer, eigenvectors of 40x40",
        "own eigenvalues of 40x40",
        "real poses",
        "all 40 poses",
        "prepare a geometry",
    ]);
    for _ in 0..repeats {
        let matrix = |k: usize| &matrices[k % matrices.len()];
        if !matrices.is_empty() {
            stages.time(0, solvers.len(), &mut |k| {
                black_box(reference.decompose(matrix(k)));
            });
            stages.time(1, solvers.len(), &mut |k| {
                black_box(spectrum.decompose(Method::Francis, &matrix(k)[..]));
            });
        }
        stages.time(2, solvers.len(), &mut |k| {
            solvers[k].solve(&legs[k], Roots::Real, &mut workspace, &mut assembly);
        });
        stages.time(3, solvers.len(), &mut |k| solvers[k].solve(&legs[k], Roots::All, &mut workspace, &mut assembly));
        stages.time(4, solvers.len(), &mut |k| {
            black_box(PlatformSolver::prepare(&platforms[k]));
        });
    }
    Ok(stages.timings())
}
