//! Counts how many planted configurations are found, and checks that everything listed is a solution.

use super::agreement::{Agreements, compare};
use super::sample::{Sample, Set, motions, rational_sample, sample};
use crate::assembly::{Assembly, Roots, Workspace, wrapped};
use crate::derivation::derive;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::{FullMode, Mechanism, Solution};
use crate::verdict::{Proof, Status};
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt::{self, Display};
use std::time::Instant;

/// The counts of one run.
#[derive(Clone, Debug, Default)]
pub struct Counts {
    /// The kind of problems solved, in the plural.
    pub noun: &'static str,
    /// Number of problems solved.
    pub solved: usize,
    /// Planted configurations found.
    pub found: usize,
    /// Planted configurations that are neither listed nor on a reported self-motion.
    pub lost: Vec<u64>,
    /// Planted configurations that lie on a self-motion, which was reported.
    pub on_self_motion: usize,
    /// Real modes whose forward kinematics, computed independently, misses the pose by more than 1e-9.
    pub spurious: usize,
    /// Pairs of real modes of one pose nearer than 1e-6 radians, not proved to be two.
    pub duplicates: usize,
    /// Lists with more or fewer complex solutions than an exact count, where there is one (platforms).
    pub miscounted: usize,
    /// The samples of these lists.
    pub miscounted_in: Vec<u64>,
    /// Lists that were compared with an exact count or with an upper bound.
    pub counted: usize,
    /// Closure residuals of all modes.
    pub residuals: Vec<f64>,
    /// Distances from the planted to the found configuration.
    pub errors: Vec<f64>,
    /// Number of arms by their number of real solutions, with multiplicity.
    pub real: BTreeMap<usize, usize>,
    /// Number of arms by their number of complex solutions, with multiplicity.
    pub complex: BTreeMap<usize, usize>,
    /// Number of samples by verdict.
    pub verdicts: BTreeMap<&'static str, usize>,
    /// Number of verdicts by the kind of proof: proved, probable and so on.
    pub proofs: BTreeMap<&'static str, usize>,
    /// Number of incomplete lists by reason.
    pub reasons: BTreeMap<String, usize>,
    /// Number of modes found, and number of those with a certificate.
    pub modes: (usize, usize),
    /// Comparison of the closure polynomials with the solutions, if they were derived.
    pub exact: Option<Agreements>,
}

/// The samples to solve and the way to solve them.
#[derive(Clone, Copy, Debug)]
pub struct Job {
    /// The family of arms.
    pub set: Set,
    /// Number of samples.
    pub count: u64,
    /// Seed of the draw.
    pub seed: u64,
    /// All roots, or real ones only.
    pub roots: Roots,
    /// Whether data are rational numbers of three decimals, and closure polynomials are derived as well.
    pub exact: bool,
}

/// Runs a job on all threads of the pool it is called in; `tick` is called after every arm. Once `running` returns
/// `false`, the arms not begun are left out of the counts.
///
/// # Errors
/// As the derivation of a closure polynomial; otherwise none in practice, see [`sample`].
pub fn run(job: Job, running: impl Fn() -> bool + Sync, tick: impl Fn() + Sync) -> Result<Counts> {
    over_all(job.count, running, tick, |index, memory| one(job, index, memory))
}

/// The memory of one thread.
pub(super) type Memory = (Workspace, Assembly);

/// Adds up the counts of all samples, on all threads.
pub(super) fn over_all(
    count: u64,
    running: impl Fn() -> bool + Sync,
    tick: impl Fn() + Sync,
    one: impl Fn(u64, &mut Memory) -> Result<Counts> + Sync,
) -> Result<Counts> {
    let counted = |memory: &mut Memory, index: u64| {
        if !running() {
            return Ok(Counts::default());
        }
        let counts = one(index, memory);
        tick();
        counts
    };
    (0..count).into_par_iter().map_init(Memory::default, counted).try_reduce(Counts::default, |a, b| Ok(a.and(b)))
}

fn one(job: Job, index: u64, (workspace, assembly): &mut Memory) -> Result<Counts> {
    let draw = if job.exact { rational_sample } else { sample };
    let drawn = draw(job.set, job.seed, index)?;
    let mechanism = Mechanism::prepare(&drawn.entry)?;
    let solution = mechanism.solve(&drawn.entry.cases[0], job.roots, workspace, assembly)?;
    let mut counts = Counts::of("arms", &solution);
    if job.exact {
        let start = Instant::now();
        let derivation = derive(&drawn.entry, &drawn.entry.cases[0])?;
        let time = start.elapsed().as_secs_f64();
        let agreement = compare(&derivation, &drawn.chain, &solution);
        counts.exact = Some(Agreements::of(index, agreement, derivation.proved, time));
    }
    let real: Vec<&FullMode> = solution.modes.iter().filter(|m| m.real).collect();
    let apart = |mode: &FullMode, q: &[f64; 6]| {
        let difference = |k: usize| match drawn.variables[k] {
            Variable::Rotation => wrapped(mode.q[k].re - q[k]).abs(),
            Variable::Translation => (mode.q[k].re - q[k]).abs(),
        };
        (0..6).map(difference).fold(0.0, f64::max)
    };
    let nearest = real.iter().map(|m| apart(m, &drawn.planted)).fold(f64::INFINITY, f64::min);
    if nearest < job.set.tolerance() {
        counts.found = 1;
        counts.errors.push(nearest);
    } else if solution.verdict.self_motion > 0 && drawn.regularity < 1e-5 {
        counts.on_self_motion = 1;
    } else {
        counts.lost.push(index);
    }
    for (k, mode) in real.iter().enumerate() {
        counts.spurious += usize::from(!(miss(&drawn, mode) < 1e-9));
        let q: [f64; 6] = std::array::from_fn(|j| mode.q[j].re);
        counts.duplicates +=
            real[..k].iter().filter(|other| apart(other, &q) < 1e-6 && !(mode.certified && other.certified)).count();
    }
    Ok(counts)
}

/// Returns the distance of the tool from the pose at a mode, by forward kinematics alone: the largest entry of the
/// difference. That of the position is relative to the longest translation if this is above 1.
fn miss(drawn: &Sample, mode: &FullMode) -> f64 {
    let motions = motions(&drawn.variables, &std::array::from_fn(|k| mode.q[k].re));
    let (Some(reached), Some(wanted)) = (drawn.chain.forward(&motions), &drawn.entry.cases[0].pose) else {
        return f64::INFINITY;
    };
    let translations = drawn.variables.iter().zip(&mode.q).filter(|(variable, _)| **variable == Variable::Translation);
    let far = translations.map(|(_, q)| q.re.abs()).fold(1.0, f64::max);
    let mut largest = 0.0_f64;
    for i in 0..3 {
        for j in 0..3 {
            largest = largest.max((reached.rotation[i][j] - wanted.float.rotation[i][j]).abs());
        }
        largest = largest.max((reached.translation[i] - wanted.float.translation[i]).abs() / far);
    }
    largest
}

impl Counts {
    /// Returns the counts of one answer, of any kind.
    pub(super) fn of(noun: &'static str, solution: &Solution) -> Self {
        let mut counts = Self { noun, solved: 1, ..Self::default() };
        counts.residuals = solution.modes.iter().map(|m| m.residual).collect();
        counts.real.insert(solution.verdict.real, 1);
        counts.complex.insert(solution.verdict.complex, 1);
        counts.verdicts.insert(solution.verdict.status.word(), 1);
        counts.proofs.insert(solution.verdict.proof.word(), 1);
        if solution.verdict.status == Status::Incomplete {
            // Numbers differ from sample to sample, so reasons are counted without them.
            let reason = solution.verdict.reason.split_whitespace();
            let plain = reason.map(|word| if word.parse::<usize>().is_ok() { "n" } else { word });
            counts.reasons.insert(plain.collect::<Vec<_>>().join(" "), 1);
        }
        counts.modes = (solution.modes.len(), solution.modes.iter().filter(|m| m.certified).count());
        counts
    }

    fn and(mut self, mut other: Self) -> Self {
        self.noun = if self.noun.is_empty() { other.noun } else { self.noun };
        self.solved += other.solved;
        self.miscounted += other.miscounted;
        self.counted += other.counted;
        self.miscounted_in.append(&mut other.miscounted_in);
        self.found += other.found;
        self.lost.append(&mut other.lost);
        self.on_self_motion += other.on_self_motion;
        self.spurious += other.spurious;
        self.duplicates += other.duplicates;
        self.residuals.append(&mut other.residuals);
        self.errors.append(&mut other.errors);
        for (key, count) in other.real {
            *self.real.entry(key).or_default() += count;
        }
        for (key, count) in other.complex {
            *self.complex.entry(key).or_default() += count;
        }
        for (key, count) in other.verdicts {
            *self.verdicts.entry(key).or_default() += count;
        }
        for (key, count) in other.proofs {
            *self.proofs.entry(key).or_default() += count;
        }
        for (key, count) in other.reasons {
            *self.reasons.entry(key).or_default() += count;
        }
        self.modes = (self.modes.0 + other.modes.0, self.modes.1 + other.modes.1);
        self.exact = match (self.exact, other.exact) {
            (Some(one), Some(two)) => Some(one.and(two)),
            (one, two) => one.or(two),
        };
        self
    }

    /// Returns whether nothing is lost, spurious, double or miscounted, and everything agrees with the closure polynomial.
    #[must_use]
    pub fn is_faultless(&self) -> bool {
        let alike = self.exact.as_ref().is_none_or(|exact| exact.differ.is_empty());
        self.lost.is_empty() && self.spurious == 0 && self.duplicates == 0 && self.miscounted == 0 && alike
    }
}

/// Returns a table with one line per family.
#[must_use]
pub fn table(rows: &[(&str, Counts)]) -> String {
    let columns = ["chain", "loops", "found", "lost", "spurious", "double", "proved", "residual", "complex solutions"];
    let line = |cells: [String; 9]| {
        let [chain, rest @ .., last] = cells;
        let middle = rest.iter().fold(String::new(), |text, cell| text + &format!("{cell:>9}"));
        format!("{chain:<8}{middle}  {last}\n")
    };
    let mut text = line(columns.map(str::to_owned));
    for (name, counts) in rows {
        let proved = counts.proofs.get(Proof::Proved.word()).copied().unwrap_or(0);
        let complex = counts.complex.iter().map(|(key, count)| format!("{key}:{count}")).collect::<Vec<_>>().join(" ");
        let worst = counts.residuals.iter().copied().fold(0.0, f64::max);
        text += &line([
            (*name).to_owned(),
            counts.solved.to_string(),
            counts.found.to_string(),
            counts.lost.len().to_string(),
            counts.spurious.to_string(),
            counts.duplicates.to_string(),
            proved.to_string(),
            format!("{worst:.1e}"),
            complex,
        ]);
        for (reason, count) in &counts.reasons {
            text += &format!("    incomplete {count:>6}  {reason}\n");
        }
        if counts.on_self_motion > 0 {
            text += &format!("    on a self-motion {:>6}\n", counts.on_self_motion);
        }
    }
    text
}

/// Returns the quantiles of a sample: median, 99 %, 99.9 %, largest.
#[must_use]
pub fn quantiles(values: &[f64]) -> [f64; 4] {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    [0.5, 0.99, 0.999, 1.0].map(|part| {
        // The smallest value such that at least this part of all values is no larger.
        let below = |k: usize| (k as f64) < sorted.len() as f64 * part;
        let index = (1..sorted.len()).take_while(|&k| below(k)).count();
        sorted.get(index).copied().unwrap_or(f64::NAN)
    })
}

impl Display for Counts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let joined = |map: &BTreeMap<usize, usize>| {
            map.iter().map(|(key, count)| format!("{key}:{count}")).collect::<Vec<_>>().join("  ")
        };
        writeln!(
            f,
            "{} {}: {} planted found, {} lost, {} spurious, {} duplicates",
            self.solved,
            self.noun,
            self.found,
            self.lost.len(),
            self.spurious,
            self.duplicates
        )?;
        if self.counted > 0 {
            let (counted, off) = (self.counted, self.miscounted);
            writeln!(f, "  exact count          known of {counted}, found {off} solutions more or fewer")?;
        }
        if self.on_self_motion > 0 {
            writeln!(f, "  on a self-motion     {} planted, reported as such", self.on_self_motion)?;
        }
        for (what, samples) in [("lost samples", &self.lost), ("miscounted samples", &self.miscounted_in)] {
            if !samples.is_empty() {
                let shown: Vec<String> = samples.iter().take(10).map(u64::to_string).collect();
                writeln!(f, "  {what:<21}{}", shown.join(" "))?;
            }
        }
        for (what, words) in [("verdicts", &self.verdicts), ("proofs", &self.proofs)] {
            let words: Vec<String> = words.iter().map(|(word, count)| format!("{count} {word}")).collect();
            writeln!(f, "  {what:<21}{}", words.join(", "))?;
        }
        writeln!(f, "  certified            {} of {} modes", self.modes.1, self.modes.0)?;
        for (name, values) in [("closure residual", &self.residuals), ("distance to planted", &self.errors)] {
            let [median, p99, p999, largest] = quantiles(values);
            writeln!(f, "  {name:<21}median {median:.1e}  99% {p99:.1e}  99.9% {p999:.1e}  max {largest:.1e}")?;
        }
        writeln!(f, "  real solutions       {}", joined(&self.real))?;
        write!(f, "  complex solutions    {}", joined(&self.complex))?;
        for (reason, count) in &self.reasons {
            write!(f, "\n  incomplete {count:>6}  {reason}")?;
        }
        Ok(())
    }
}
