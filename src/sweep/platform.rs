//! All poses of a platform while one of its legs changes its length.

use super::assemblies::{AssemblySample, AssemblySweep, Running, follow, is_listed};
use super::{End, Range};
use crate::algebra::number::Number;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry};
use crate::error::{Error, Result};
use crate::kinematics::platform::{Platform, pose_of};
use crate::mechanism::{FullMode, Mechanism, platform_over};
use num_complex::Complex;

/// The result of a sweep of a platform.
pub type PlatformSweep = AssemblySweep<FullMode>;

/// A leg that runs, while the others are held.
struct Run {
    mechanism: Mechanism,
    platform: Platform<f64>,
    size: f64,
    leg: usize,
    squares: [Number; 6],
}

/// The memory of a thread, whose lists are of real poses.
struct Memory(Workspace, Assembly);

impl Default for Memory {
    fn default() -> Self {
        let mut workspace = Workspace::default();
        workspace.only_real_list = true;
        Self(workspace, Assembly::default())
    }
}

/// Returns the quaternion and the position of a real pose.
fn place(mode: &FullMode) -> Vec<f64> {
    mode.q.iter().map(|value| value.re).collect()
}

impl Running for Run {
    type Mode = FullMode;
    type Memory = Memory;

    fn sample(&self, input: f64, Memory(workspace, assembly): &mut Memory) -> Result<AssemblySample<FullMode>> {
        let mut squares = self.squares.clone();
        squares[self.leg] = Number::from_f64(input).squared();
        let solution = self.mechanism.solve(&Case::legs(squares, 1), Roots::All, workspace, assembly)?;
        let status = solution.verdict.status;
        let modes: Vec<FullMode> = solution.modes.into_iter().filter(|mode| mode.real).collect();
        let is_regular = is_listed(status) && modes.iter().all(|mode| mode.multiplicity == 1);
        Ok(AssemblySample { input, status, reason: solution.verdict.reason, modes, is_regular })
    }

    /// Returns the root mean square of the ways of the plate's points, in parts of the size of the plate.
    fn apart(&self, one: &FullMode, two: &FullMode) -> f64 {
        match (pose_of(&place(one)), pose_of(&place(two))) {
            (Some(one), Some(two)) => self.platform.distance(&one, &two) / self.size,
            _ => f64::INFINITY,
        }
    }

    fn middle(&self, one: &FullMode, two: &FullMode) -> FullMode {
        let (from, to) = (place(one), aligned(&place(one), place(two)));
        let q: Vec<f64> = from.iter().zip(&to).map(|(a, b)| 0.5 * (a + b)).collect();
        let norm = q[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
        let value = |(k, x): (usize, &f64)| Complex::from(if k < 4 { x / norm } else { *x });
        FullMode { q: q.iter().enumerate().map(value).collect(), ..one.clone() }
    }
}

/// Returns a pose with the one of its two quaternions that is nearer to that of another pose.
fn aligned(near: &[f64], mut pose: Vec<f64>) -> Vec<f64> {
    let product: f64 = near.iter().zip(&pose).take(4).map(|(a, b)| a * b).sum();
    if product < 0.0 {
        pose.iter_mut().take(4).for_each(|x| *x = -*x);
    }
    pose
}

/// Sweeps the length of a leg of a platform, counted from 0, on all threads of the current pool, while the lengths of the others
/// are those of its first case.
///
/// # Errors
/// [`Error::Invalid`] for entries that are no platforms, without lengths, for negative lengths and empty ranges.
pub fn sweep_platform(entry: &Entry, leg: usize, range: Range, tick: impl Fn() + Sync) -> Result<PlatformSweep> {
    let Design::Platform(geometry) = &entry.design else {
        return Err(Error::Invalid("found no platform, expected one, whose legs have lengths".to_owned()));
    };
    let platform = platform_over::<f64>(geometry);
    let platform = platform.ok_or_else(|| Error::Invalid("found points without numbers, expected some".to_owned()))?;
    let squares = entry.cases.first().and_then(|case| case.legs_squared.clone());
    let squares = squares.ok_or_else(|| Error::Invalid("found no lengths of the legs, expected some".to_owned()))?;
    if let Some(end) = [range.from, range.to].into_iter().find(|end| !(*end >= 0.0)) {
        return Err(Error::Invalid(format!("found a leg of length {end}, expected 0 or more")));
    }
    let (mechanism, size) = (Mechanism::prepare(entry)?, platform.plate_size());
    let mut sweep = follow(&Run { mechanism, platform, size, leg, squares }, leg, range, false, tick)?;
    align(&mut sweep);
    Ok(sweep)
}

/// Gives the poses of every branch quaternions that do not change their signs from one to the next, and a limit position that of
/// a branch which meets it.
fn align(sweep: &mut PlatformSweep) {
    let mut known = vec![false; sweep.limits.len()];
    for branch in &sweep.branches {
        let [begin, end] = [&branch.begin, &branch.end].map(|end| match end {
            End::Limit(limit) => Some(*limit),
            _ => None,
        });
        let mut rows: Vec<(usize, usize)> = branch.rows.iter().map(|row| (row.step, row.mode)).collect();
        let mut ends = [begin, end];
        // Where a neighbour has chosen the sign already, the branch is gone through from there.
        if begin.is_none_or(|limit| !known[limit]) && end.is_some_and(|limit| known[limit]) {
            rows.reverse();
            ends.reverse();
        }
        let mut last: Option<Vec<f64>> =
            ends[0].filter(|limit| known[*limit]).map(|limit| place(&sweep.limits[limit].mode));
        let mut turn = |mode: &mut FullMode| {
            let own = place(mode);
            let own = last.as_ref().map_or(own.clone(), |last| aligned(last, own));
            mode.q = own.iter().map(|x| Complex::from(*x)).collect();
            last = Some(own);
        };
        if let Some(limit) = ends[0].filter(|limit| !std::mem::replace(&mut known[*limit], true)) {
            turn(&mut sweep.limits[limit].mode);
        }
        for (step, mode) in rows {
            turn(&mut sweep.samples[step].modes[mode]);
        }
        if let Some(limit) = ends[1].filter(|limit| !std::mem::replace(&mut known[*limit], true)) {
            turn(&mut sweep.limits[limit].mode);
        }
    }
}
