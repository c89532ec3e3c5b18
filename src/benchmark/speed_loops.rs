//! Timings of loops, input after input of a geometry prepared once, and of exact closure polynomials.

use super::sample::{CHAINS, Set, matrix, motions, sample};
use super::speed_robots::{Posed, posed};
use crate::algebra::number::{Angle, HalfTangent, Number, Reading};
use crate::assembly::{Assembly, Roots, Solver, Workspace};
use crate::catalogue::entry::{Case, Design, Entry, Input, InputValue, Kind, Labels};
use crate::catalogue::{Options, builtin, builtin_names};
use crate::derivation::derive;
use crate::error::{Error, Result};
use crate::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use crate::kinematics::closed_loop::{Layout, OpenLoop, Variable};
use crate::kinematics::motion::Motion;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::mechanism::Mechanism;
use crate::solve::eigen::EigenWorkspace;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rug::Rational;
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;

/// Number of inputs of each random loop.
const INPUTS: usize = 4;
/// Number of times an input is solved before the next one, to measure a steady state and not cold caches.
const ROUNDS: usize = 3;
/// Exact polynomials are timed once per this many passes.
const PASSES: usize = 5;
/// Sequences of unknowns whose closure polynomials are derived: degrees 2, 4, 8 and 16.
const DERIVED: [&str; 7] = ["CCC", "CRCR", "SRRR", "PRPRRR", "CRRRR", "PRRRRR", "RRRRRR"];

/// Microseconds over many inputs, each of them timed several times.
#[derive(Clone, Copy, Debug)]
pub struct Spread {
    /// The median of all.
    pub median: f64,
    /// The fastest of all.
    pub least: f64,
    /// The 99 % quantile of the medians of the inputs.
    pub nearly_all: f64,
    /// The median of the slowest input.
    pub slowest: f64,
}

/// Times of one kind of loop with prepared geometry; every input is solved many times.
#[derive(Clone, Debug)]
pub struct LoopRow {
    /// The sequence of unknowns, or the name of the entry.
    pub name: String,
    /// Number of solutions of the first input, with multiplicity.
    pub solutions: usize,
    /// Real solutions in numbers only, each mode with its certificate; `None` if only the whole answer is timed.
    pub real: Option<Spread>,
    /// All solutions in numbers only, each mode with its certificate.
    pub all: Option<Spread>,
    /// The whole answer of `looproot solve`: reading the input from its exact value, all real solutions, the proof that there are no others, and
    /// the verdict.
    pub answer: Spread,
    /// The number of the slowest draw and of its input, from 1, by the time of the answer.
    pub slowest: (u64, usize),
}

/// Times of exact closure polynomials.
#[derive(Clone, Debug)]
pub struct ExactRow {
    /// The sequence of unknowns.
    pub name: &'static str,
    /// The largest degree that occurred.
    pub degree: usize,
    /// From data to isolated real roots, including the equations and the comparison of elimination routes.
    pub derived: Spread,
    /// The part of it spent on isolating the real roots and counting them by Sturm's theorem.
    pub isolated: Spread,
}

/// All timings.
#[derive(Clone, Debug)]
pub struct LoopTimings {
    /// The eigenvalues of one 16 x 16 matrix by faer.
    pub reference: Spread,
    /// Loops and arms.
    pub loops: Vec<LoopRow>,
    /// Closure polynomials of data with three decimals.
    pub exact: Vec<ExactRow>,
}

/// The times of one job, repeat after repeat.
#[derive(Clone, Debug, Default)]
struct Clock(Vec<f64>);

impl Clock {
    fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = black_box(work());
        self.0.push(start.elapsed().as_secs_f64() * 1e6);
        result
    }

    fn sorted(&self) -> Vec<f64> {
        let mut sorted = self.0.clone();
        sorted.sort_by(f64::total_cmp);
        sorted
    }

    fn median(&self) -> Option<f64> {
        let sorted = self.sorted();
        sorted.get(sorted.len() / 2).copied()
    }
}

fn spread<'a>(clocks: impl IntoIterator<Item = &'a Clock>) -> Option<Spread> {
    let mut medians = Vec::new();
    let mut least = f64::INFINITY;
    for sorted in clocks.into_iter().map(Clock::sorted) {
        if let Some(first) = sorted.first() {
            least = least.min(*first);
            medians.push(sorted[sorted.len() / 2]);
        }
    }
    medians.sort_by(f64::total_cmp);
    let nearly_all = *medians.get((99 * medians.len()).div_ceil(100).checked_sub(1)?)?;
    Some(Spread { median: *medians.get(medians.len() / 2)?, least, nearly_all, slowest: *medians.last()? })
}

/// One geometry with its inputs.
struct Job {
    /// The solver and the closing transformation of each input; `None` if only the whole answer is timed.
    numeric: Option<(Solver, Vec<Motion<f64>>)>,
    mechanism: Mechanism,
    cases: Vec<Case>,
    /// Real solutions, all solutions, the whole answer: a clock for each input.
    clocks: [Vec<Clock>; 3],
}

impl Job {
    fn new(entry: &Entry, numeric: Option<(Solver, Vec<Motion<f64>>)>) -> Result<Self> {
        let cases = entry.cases.clone();
        let clocks = std::array::from_fn(|_| vec![Clock::default(); cases.len()]);
        Ok(Self { numeric, mechanism: Mechanism::prepare(entry)?, cases, clocks })
    }

    /// Times every input.
    fn pass(&mut self, workspace: &mut Workspace, assembly: &mut Assembly) -> Result<()> {
        // As in `solve` without `--complex`.
        workspace.only_real_list = true;
        let inputs = self.cases.iter().enumerate();
        for (k, case) in inputs.flat_map(|input| std::iter::repeat_n(input, ROUNDS)) {
            if let Some((solver, closings)) = &self.numeric {
                self.clocks[0][k].time(|| solver.solve(&closings[k], Roots::Real, workspace, assembly));
                self.clocks[1][k].time(|| solver.solve(&closings[k], Roots::All, workspace, assembly));
            }
            self.clocks[2][k].time(|| self.mechanism.solve(case, Roots::All, workspace, assembly))?;
        }
        Ok(())
    }
}

/// A row being timed: its name, the number of solutions, and its jobs.
struct Row {
    name: String,
    solutions: usize,
    jobs: Vec<Job>,
}

impl Row {
    /// Computes the prepared data once before the timing.
    fn warmed(name: String, mut jobs: Vec<Job>, workspace: &mut Workspace, assembly: &mut Assembly) -> Result<Self> {
        let mut solutions = 0;
        workspace.only_real_list = false;
        for job in &mut jobs {
            for (k, case) in job.cases.iter().enumerate() {
                let answer = job.mechanism.solve(case, Roots::All, workspace, assembly)?;
                if k == 0 {
                    solutions = solutions.max(answer.verdict.complex);
                }
            }
        }
        Ok(Self { name, solutions, jobs })
    }

    fn timings(&self) -> Option<LoopRow> {
        let [real, all, answer] = [0, 1, 2].map(|k| spread(self.jobs.iter().flat_map(|job| &job.clocks[k])));
        let places = self.jobs.iter().zip(0..).flat_map(|(job, draw)| {
            let medians = job.clocks[2].iter().zip(1..).map(move |(clock, input)| (clock.median(), (draw, input)));
            medians.filter_map(|(median, place)| Some((median?, place)))
        });
        let (_, slowest) = places.max_by(|(a, _), (b, _)| a.total_cmp(b))?;
        Some(LoopRow { name: self.name.clone(), solutions: self.solutions, real, all, answer: answer?, slowest })
    }
}

/// Returns a random loop of a set, with poses that it reaches.
fn random_job(set: Set, seed: u64, number: u64) -> Result<Job> {
    let drawn = sample(set, seed, number)?;
    let layout = Layout::of(&drawn.chain, None)?;
    let open: OpenLoop<f64> = drawn.chain.open_loop(&layout)?;
    let mut random = ChaCha8Rng::seed_from_u64(seed ^ number.rotate_left(32));
    let mut entry = drawn.entry;
    while entry.cases.len() < INPUTS {
        let mut planted = [0.0; 6];
        for (value, variable) in planted.iter_mut().zip(drawn.variables) {
            *value = match variable {
                Variable::Rotation => random.random_range(-PI..PI),
                Variable::Translation => random.random_range(-2.0..2.0),
            };
        }
        let Some(pose) = drawn.chain.forward::<f64>(&motions(&drawn.variables, &planted)) else { break };
        entry.cases.push(Case::at(Placement::from_matrix(&matrix(&pose))?.0, 0));
    }
    let closings = entry.cases.iter().filter_map(|case| Some(case.pose.as_ref()?.float.inverse())).collect();
    let solver = match layout.spherical_unknown() {
        Some(spherical) => Solver::with_spherical_joint(&open, spherical),
        None => Solver::prepare(&open),
    };
    Job::new(&entry, Some((solver, closings)))
}

/// Returns the library's loops with given inputs that are no arm: with two spherical joints or fewer than six unknowns.
fn library_jobs() -> Result<Vec<(String, Job)>> {
    let mut jobs = Vec::new();
    for name in builtin_names() {
        let entry = builtin(&name, &Options::default())?;
        let Some(chain) = entry.chain().filter(|_| entry.kind() == Kind::Loop) else { continue };
        let (layout, given) = (Layout::of(chain, None)?, entry.cases.first().map_or(0, |case| case.input.len()));
        if given == 1 && (layout.variables.len() != 7 || layout.second_spherical.is_some()) {
            jobs.push((name, Job::new(&entry, None)?));
        }
    }
    Ok(jobs)
}

/// Returns a number of three decimals.
fn three_decimals(random: &mut ChaCha8Rng) -> Rational {
    let numerator = random.random_range(1..1000) * if random.random_bool(0.5) { 1 } else { -1 };
    Rational::from((numerator, 1000))
}

/// Returns a loop of these unknowns and one more revolute joint for the input. Lengths, offsets and all half-angle
/// tangents are numbers of three decimals.
fn rational_loop(index: usize, seed: u64, number: u64) -> Entry {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    let mut next = || three_decimals(&mut random);
    let kinds: Vec<JointKind> = Set::Chain(index).joints().into_iter().chain([JointKind::Revolute]).collect();
    let inputs = kinds.len();
    let joint = |kind: JointKind| {
        let mut angle = || Angle::from_half_tangent(HalfTangent::Finite(next()));
        let alpha = angle();
        let theta0 = if kind == JointKind::Prismatic { angle() } else { Angle::zero() };
        let d = if kind == JointKind::Revolute { Number::exact(next()) } else { Number::zero() };
        Joint { kind, a: Number::exact(next()), alpha, d, theta0, pitch: None }
    };
    let joints: Vec<Joint> = kinds.into_iter().map(joint).collect();
    let value = InputValue::Angle(Angle::from_half_tangent(HalfTangent::Finite(three_decimals(&mut random))));
    let chain = Chain { geometry: Geometry::Dh(joints), base: Placement::identity(), tool: Placement::identity() };
    Entry {
        name: format!("sample {number}"),
        title: format!("random loop {number} of seed {seed}"),
        source: None,
        notes: None,
        design: Design::Loop(chain),
        limits: Vec::new(),
        platform_limits: PlatformLimits::default(),
        cases: vec![Case::given(Input { joint: inputs, value }, 0)],
        rounded: false,
        reading: Reading::default(),
        labels: Labels::default(),
    }
}

/// Exact polynomials of one sequence of unknowns.
struct Exact {
    name: &'static str,
    degree: usize,
    entries: Vec<Entry>,
    clocks: [Vec<Clock>; 2],
}

impl Exact {
    fn new(name: &'static str, seed: u64, count: u64) -> Result<Self> {
        let index = CHAINS.iter().position(|(chain, _)| *chain == name);
        let index = index.ok_or_else(|| Error::Invalid(format!("found `{name}`, expected a residual chain")))?;
        let entries: Vec<Entry> = (0..count).map(|number| rational_loop(index, seed, number)).collect();
        let clocks = std::array::from_fn(|_| vec![Clock::default(); entries.len()]);
        Ok(Self { name, degree: 0, entries, clocks })
    }

    fn pass(&mut self) -> Result<()> {
        for (k, entry) in self.entries.iter().enumerate() {
            let derivation = self.clocks[0][k].time(|| derive(entry, &entry.cases[0]))?;
            if let Some(polynomial) = derivation.polynomial {
                self.degree = self.degree.max(polynomial.degree());
                let coefficients = &polynomial.coefficients;
                self.clocks[1][k].time(|| (coefficients.real_roots(), coefficients.distinct_real_roots()));
            }
        }
        Ok(())
    }

    fn timings(&self) -> Option<ExactRow> {
        let [derived, isolated] = self.clocks.each_ref().map(spread);
        Some(ExactRow { name: self.name, degree: self.degree, derived: derived?, isolated: isolated? })
    }
}

/// Returns the matrix whose eigenvalues a general arm needs.
fn reference(seed: u64) -> Result<[[f64; 16]; 16]> {
    let drawn = sample(Set::General, seed, 0)?;
    let open: OpenLoop<f64> = drawn.chain.open_loop(&Layout::of(&drawn.chain, None)?)?;
    let pose = drawn.entry.cases[0].pose.as_ref().map(|pose| pose.float.inverse());
    let matrix = pose.and_then(|pose| Solver::prepare(&open).companion(&pose));
    matrix.ok_or_else(|| Error::Invalid(format!("the general arm of seed {seed} has a singular pencil")))
}

/// The geometry of the loops that are timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loops {
    /// All lengths, twists and angles at random; also the library and exact polynomials.
    General,
    /// Right angles, zeros and parallel axes, the first input of each loop at angles that are mostly 0, right or pi.
    Special,
    /// The robots of the library at random poses.
    Robots,
}

/// Times `count` loops of each residual chain at a few inputs. In general geometry it adds the other loops of the
/// library and the closure polynomials of `count` loops with exact data. For robots it times each one of the library at `count`
/// poses. Everything runs `repeats` times, in turn within each repeat, so that a change of the machine's speed affects all alike.
///
/// # Errors
/// None in practice, see [`sample`].
pub fn run(loops: Loops, count: u64, repeats: usize, seed: u64) -> Result<LoopTimings> {
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mut rows = Vec::new();
    let chains = if loops == Loops::Robots { &[][..] } else { &CHAINS[..] };
    for (index, (name, _)) in chains.iter().enumerate() {
        let set = if loops == Loops::General { Set::Chain(index) } else { Set::SpecialChain(index) };
        let jobs = (0..count).map(|number| random_job(set, seed, number)).collect::<Result<Vec<Job>>>()?;
        rows.push(Row::warmed((*name).to_owned(), jobs, &mut workspace, &mut assembly)?);
    }
    if loops == Loops::Robots {
        for Posed { name, entry } in posed(count, seed)? {
            rows.push(Row::warmed(name, vec![Job::new(&entry, None)?], &mut workspace, &mut assembly)?);
        }
    }
    let mut exact = Vec::new();
    if loops == Loops::General {
        for (name, job) in library_jobs()? {
            rows.push(Row::warmed(name, vec![job], &mut workspace, &mut assembly)?);
        }
        exact = DERIVED.iter().map(|name| Exact::new(name, seed, count)).collect::<Result<Vec<Exact>>>()?;
    }
    let matrix = reference(seed)?;
    let (mut eigen, mut clock) = (EigenWorkspace::default(), Clock::default());
    for repeat in 0..repeats {
        for row in &mut rows {
            clock.time(|| eigen.of_matrix(&matrix).is_some());
            for job in &mut row.jobs {
                job.pass(&mut workspace, &mut assembly)?;
            }
        }
        if repeat % PASSES == 0 {
            exact.iter_mut().try_for_each(Exact::pass)?;
        }
    }
    let reference = spread([&clock]).ok_or_else(|| Error::Invalid("nothing was timed".to_owned()))?;
    let loops = rows.iter().filter_map(Row::timings).collect();
    Ok(LoopTimings { reference, loops, exact: exact.iter().filter_map(Exact::timings).collect() })
}
