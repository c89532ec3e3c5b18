//! Frameworks with small errors: none of them may be called mobile.

use super::mobility::{SIZES, Tally, stream};
use crate::algebra::number::nearest_f64;
use crate::catalogue::FrameworkFile;
use crate::kinematics::framework::cycle::stands_still;
use crate::kinematics::framework::octahedron::{Diagonal, Octahedron};
use crate::kinematics::framework::{Framework, Verdict, mobility};
use rand::Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};

/// Returns the framework with relative errors of 1e-3 to 1e-9, which depend on seed and number, in every coordinate of a
/// vertex, or in every length if the file gives lengths.
#[must_use]
pub fn disturbed(file: &FrameworkFile, seed: u64, number: u64) -> FrameworkFile {
    let mut random = stream(seed, number);
    let size = Integer::from(Integer::u_pow_u(10, random.random_range(SIZES)));
    let mut error = || Rational::from((random.random_range(-1000..=1000_i32), 1000)) / &size;
    if let Some(squares) = &file.squares {
        let longer = |square: &Rational| {
            let factor = error() + 1_u32;
            Rational::from(square * &factor) * &factor
        };
        return FrameworkFile { squares: Some(squares.iter().map(longer).collect()), ..file.clone() };
    }
    let coordinates = || file.framework.vertices.iter().flatten();
    let extent = coordinates().map(|x| x.clone().abs()).max().unwrap_or_else(|| Rational::from(1));
    let mut moved = |x: &Rational| error() * &extent + x;
    let vertices = file.framework.vertices.iter().map(|v| v.each_ref().map(&mut moved)).collect();
    let bars = &file.framework.bars[..file.framework.given_bars];
    FrameworkFile { framework: Framework::new(vertices, bars, &file.bodies), ..file.clone() }
}

/// Disturbs a framework `count` times, on all threads of the current pool, and decides whether the results move. `running`
/// is called now and then and stops the run; `tick` is called for every framework.
#[must_use]
pub fn run(
    file: &FrameworkFile,
    count: u64,
    seed: u64,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
) -> Tally {
    let one = |number: u64| {
        let tally = running().then(|| Tally::of(number, moves(&disturbed(file, seed, number))));
        tick();
        tally
    };
    (0..count).into_par_iter().filter_map(one).reduce(Tally::default, Tally::and)
}

/// Returns whether a framework moves, if that is proved; one whose motion is only observed counts as mobile, too.
fn moves(file: &FrameworkFile) -> Option<bool> {
    let answer = match &file.squares {
        None => mobility(&file.framework, 1),
        Some(squares) => {
            // The lengths alone decide, whether or not the framework can be assembled.
            let start = file.framework.map(|q| Some(nearest_f64(q)))?;
            let octahedron = Octahedron::of(&start, squares);
            let is_fixed =
                |octahedron: &Octahedron| (0..3).all(|axis| octahedron.diagonal(axis, &start) == Diagonal::Fixed);
            if octahedron.as_ref().is_some_and(is_fixed) || stands_still(&start, squares) {
                return Some(false);
            }
            file.mobility(1).ok()
        }
    }?;
    match answer.verdict {
        Verdict::Mobile => Some(true),
        Verdict::Rigid | Verdict::Shaky(_) => answer.is_proved().then_some(false),
    }
}
