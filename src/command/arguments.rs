//! The words of the command line.

use super::poly::arguments::{PolyOptions, format};
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Parser, Subcommand, ValueEnum};
use clap_complete::Shell;
use looproot::algebra::text::Format;
use looproot::catalogue::{Chains, Options};
use looproot::report::paper::Style;
use std::path::PathBuf;

/// All solutions of kinematic closure equations, with a verdict on completeness.
#[derive(Parser)]
#[command(version, about, disable_help_subcommand = true, after_help = EXIT_CODES)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub verb: Verb,
}

const EXIT_CODES: &str = "\
Exit codes: 0 complete and certified, 1 usage or input, 2 not proved complete or a self-motion,
            3 no real solution, 4 unsupported, 130 interrupted; of several answers 1, 4, 2, 3, 0 in this order.";

/// The verbs.
#[derive(Subcommand)]
pub enum Verb {
    /// Find every solution of a mechanism file
    Solve(SolveOptions),
    /// Derive the closure equations and the exact closure polynomial of one case
    Derive(DeriveOptions),
    /// Run the input of a loop through a range: branches, limit positions
    Sweep(SweepOptions),
    /// Decide whether a loop moves, with proof
    Mobility(MobilityOptions),
    /// Factor a rational motion and close loops of its factorisations
    Factor(FactorOptions),
    /// Derive for which parameters a closed chain of revolute joints moves
    Conditions(ConditionsOptions),
    /// List the built-in library
    List(ListOptions),
    /// Print a mechanism as it was understood
    Show(ShowOptions),
    /// Test every claim of mechanism files
    Check(CheckOptions),
    /// Polynomials: multiply out, eliminate, determinants, real roots
    Poly(PolyOptions),
    /// Measure accuracy and speed on random arms and platforms
    Bench(BenchOptions),
    /// Print the completions of a shell
    Completions(CompletionsOptions),
}

/// How to read the mechanism.
#[derive(Args)]
pub struct ReadOptions {
    /// Decimal digits of the rationals that replace irrational numbers in exact work
    #[arg(long, value_name = "N", default_value_t = 15)]
    pub digits: u32,
    /// URDF: the link at the root of the chain
    #[arg(long, value_name = "LINK")]
    pub base_link: Option<String>,
    /// URDF: the link at the end of the chain
    #[arg(long, value_name = "LINK")]
    pub tip_link: Option<String>,
}

impl ReadOptions {
    /// As the reader wants them.
    pub fn options(&self) -> Options {
        Options {
            digits: self.digits,
            base_link: self.base_link.clone(),
            tip_link: self.tip_link.clone(),
            ..Options::default()
        }
    }
}

/// Which case of a mechanism is meant.
#[derive(Args)]
pub struct CaseOptions {
    /// This pose (of a platform: set of legs) of the file only, counted from 1
    #[arg(long, value_name = "K")]
    pub pose: Option<usize>,
    /// This input of the file only, counted from 1, or another one: 7="90 deg", 3="20 mm"; without a unit in those of the file
    #[arg(long, value_name = "K|JOINT=VALUE", conflicts_with = "pose")]
    pub input: Option<String>,
    /// The pose that these joint values reach: "10 deg, 0.3, pi/2, ..."; without a unit in those of the file
    #[arg(long, value_name = "Q", conflicts_with_all = ["pose", "input"], allow_hyphen_values = true)]
    pub joints: Option<String>,
    /// Platform: legs of these lengths: "1, 1.2, 900 mm, ..."
    #[arg(long, value_name = "L", conflicts_with = "pose", allow_hyphen_values = true)]
    pub legs: Option<String>,
    /// Platform: the legs that this pose asks for: "x, y, z; w, x, y, z", position and quaternion
    #[arg(long, value_name = "POSE", conflicts_with_all = ["pose", "legs"], allow_hyphen_values = true)]
    pub at: Option<String>,
}

impl CaseOptions {
    /// Which files are read: those without a case where the command line gives one.
    pub fn chains(&self) -> Chains {
        let is_value = self.input.as_ref().is_some_and(|input| input.contains('='));
        let is_given = is_value || self.joints.is_some() || self.legs.is_some() || self.at.is_some();
        if is_given { Chains::Swept } else { Chains::Solved }
    }
}

/// Where the output goes.
#[derive(Args)]
pub struct OutputOptions {
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Colour the verdict (NO_COLOR is respected)
    #[arg(long, value_name = "WHEN", default_value = "auto")]
    pub color: Colour,
}

/// When to use colours.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Colour {
    /// On a terminal.
    Auto,
    /// In any case.
    Always,
    /// In no case.
    Never,
}

/// What to do with solutions outside the joint limits.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Limits {
    /// List and mark them.
    Mark,
    /// Leave them out; the verdict still counts them.
    Drop,
}

/// `looproot solve`
#[derive(Args)]
pub struct SolveOptions {
    /// A file (TOML, JSON, DH table as CSV, URDF), the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// List complex solutions too
    #[arg(long)]
    pub complex: bool,
    /// Look for real solutions only: faster, mostly without a proof of completeness
    #[arg(long, conflicts_with = "complex")]
    pub real: bool,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// JSON Lines: one result a line, as soon as it is there
    #[arg(long, conflicts_with = "json")]
    pub jsonl: bool,
    #[command(flatten)]
    pub asked: CaseOptions,
    /// Loops: velocities and accelerations of all joints per unit rate of the input, at every real mode
    #[arg(long)]
    pub derivatives: bool,
    /// Solutions outside the joint limits
    #[arg(long, value_name = "HOW", default_value = "mark")]
    pub limits: Limits,
    /// Seed of the primes that are drawn for counts: the same seed repeats an answer [default: drawn]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 53))]
    pub seed: Option<u64>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print verdicts only
    #[arg(short, long)]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// The languages of papers by their names.
fn style() -> impl TypedValueParser<Value = Style> {
    PossibleValuesParser::new(Style::NAMED.map(|(name, _)| name)).map(|name| {
        let found = Style::NAMED.iter().find(|(known, _)| *known == name);
        found.map_or(Style::Markdown, |(_, style)| *style)
    })
}

/// `looproot derive`
#[derive(Args)]
pub struct DeriveOptions {
    /// A file (TOML, JSON, DH table as CSV, URDF), the name of a built-in entry, or - for standard input; of several
    /// poses or inputs the first one, unless one is asked for; with --bless files and folders
    #[arg(required = true, value_name = "MECHANISM")]
    pub mechanisms: Vec<String>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Keep link parameters and the input as symbols: all that are neither zero nor a right angle, or those named, as
    /// a1,alpha2,d3,theta4
    #[arg(
        long,
        value_name = "NAMES",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = ""
    )]
    pub symbolic: Option<String>,
    /// Write the equations, where they fit two pages, to name.eqs beside every name.toml
    #[arg(long, conflicts_with_all = ["json", "format", "explain", "symbolic", "output"])]
    pub bless: bool,
    /// The equations in half-angle form (of a platform: in Study's parameters) and the closure polynomial as a file for
    /// another program
    #[arg(long, value_name = "NAME", value_parser = format(), conflicts_with = "json")]
    pub format: Option<Format>,
    /// The whole derivation as a paper, in Markdown with LaTeX formulas or as a LaTeX document, checked by putting in solutions
    #[arg(
        long,
        value_name = "LANGUAGE",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = "markdown",
        value_parser = style(),
        conflicts_with_all = ["json", "format"]
    )]
    pub explain: Option<Style>,
    /// Loops of four R or C joints: the spherical closure equation and, over dual numbers, the spatial one; of a file, or with
    /// all parameters symbols: rccc, ccrr, 4r, hooke
    #[arg(long, conflicts_with_all = ["explain", "symbolic", "bless", "pose", "input", "joints", "legs", "at"])]
    pub transference: bool,
    /// Seed of the primes that are drawn for counts: the same seed repeats an answer [default: drawn]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 53))]
    pub seed: Option<u64>,
    /// Print the verdict only
    #[arg(short, long, conflicts_with_all = ["json", "format", "explain"])]
    pub quiet: bool,
    #[command(flatten)]
    pub asked: CaseOptions,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot sweep`
#[derive(Args)]
pub struct SweepOptions {
    /// A file of a loop, the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// The joint to sweep, counted from 1; of a C joint its angle (3 or q3) or its distance (d3) [default: the input of the
    /// file]
    #[arg(long, value_name = "JOINT")]
    pub joint: Option<String>,
    /// Where the input begins: "-180 deg", "pi/3", "20 mm"; without a unit in those of the file
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub from: String,
    /// Where it ends; a full turn joins up
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true)]
    pub to: String,
    /// Number of equal steps between
    #[arg(long, value_name = "N", default_value = "360", value_parser = steps)]
    pub steps: usize,
    /// CSV: one row for every branch and step, radians and metres
    #[arg(long, conflicts_with_all = ["json", "svg"])]
    pub csv: bool,
    /// A picture: every joint variable against the input
    #[arg(long, conflicts_with = "json")]
    pub svg: bool,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Seed of the primes that are drawn for counts: the same seed repeats an answer [default: drawn]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 53))]
    pub seed: Option<u64>,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print the verdict only
    #[arg(short, long)]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot conditions`
#[derive(Args)]
pub struct ConditionsOptions {
    /// 4R (all parameters symbols), a file of a loop with symbols or numbers, the name of a built-in one, or - for standard
    /// input
    pub mechanism: String,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// The conditions of one family as a file for another program
    #[arg(long, value_name = "NAME", value_parser = format(), conflicts_with = "json")]
    pub format: Option<Format>,
    /// Which family: a part of its name, such as "spherical" [default: the first one]
    #[arg(long, value_name = "NAME", requires = "format")]
    pub family: Option<String>,
    /// The whole derivation in Markdown with LaTeX formulas
    #[arg(long, conflicts_with_all = ["json", "format"])]
    pub explain: bool,
    /// Print the verdict only
    #[arg(short, long, conflicts_with_all = ["json", "format", "explain"])]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// A number of steps.
fn steps(text: &str) -> Result<usize, String> {
    const MOST: usize = 100_000;
    match text.trim().parse() {
        Ok(steps @ 1..=MOST) => Ok(steps),
        _ => Err(format!("expected 1 to {MOST}")),
    }
}

/// `looproot mobility`
#[derive(Args)]
pub struct MobilityOptions {
    /// A file of a loop, an arm, a platform or a framework, the name of a built-in entry, or - for standard input; inputs of
    /// the file are not looked at
    pub mechanism: String,
    /// Frameworks: how many steps of the motion are followed in f64
    #[arg(long, value_name = "N", default_value = "60", value_parser = steps)]
    pub steps: usize,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Print the verdict only
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot factor`
#[derive(Args)]
pub struct FactorOptions {
    /// A file of a rational motion (kind "motion"), the name of a built-in one, or - for standard input
    pub mechanism: String,
    /// The two factorisations that close the loop, counted from 1: 1,6 [default: the first pair with the most joints]
    #[arg(long, value_name = "I,J", value_parser = pair)]
    pub pair: Option<(usize, usize)>,
    /// The loop as a mechanism file
    #[arg(long, conflicts_with_all = ["json", "quiet"])]
    pub toml: bool,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Print the verdict only
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// Two numbers counted from 1, as counted from 0.
fn pair(text: &str) -> Result<(usize, usize), String> {
    let number = |text: &str| text.trim().parse::<usize>().ok()?.checked_sub(1);
    let numbers = text.split_once(',').and_then(|(i, j)| Some((number(i)?, number(j)?)));
    numbers.ok_or_else(|| "expected two numbers from 1, such as 1,6".to_owned())
}

/// `looproot list`
#[derive(Args)]
pub struct ListOptions {
    /// A JSON document
    #[arg(long)]
    pub json: bool,
}

/// `looproot show`
#[derive(Args)]
pub struct ShowOptions {
    /// A file, the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// The text of the file itself
    #[arg(long, conflicts_with = "json")]
    pub source: bool,
    /// A JSON document, in radians and metres
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub read: ReadOptions,
}

/// `looproot check`
#[derive(Args)]
pub struct CheckOptions {
    /// Files, folders, names of built-in entries; the whole built-in library if none is given
    pub paths: Vec<String>,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
    /// Print failures and the summary only
    #[arg(short, long)]
    pub quiet: bool,
}

/// `looproot bench`
#[derive(Args)]
pub struct BenchOptions {
    /// What to measure.
    #[command(subcommand)]
    pub measure: Measure,
}

/// What can be measured.
#[derive(Subcommand)]
pub enum Measure {
    /// Solutions found, lost, spurious, duplicated against planted configurations
    Accuracy(AccuracyOptions),
    /// Overconstrained loops with a small error in one link: none of them may be called mobile
    Mobility(DisturbOptions),
    /// Times on one core beside faer's eigenvalues of one 16 x 16 or 40 x 40 matrix
    Speed(SpeedOptions),
}

/// `looproot bench accuracy`
#[derive(Args)]
pub struct AccuracyOptions {
    /// general, structured, near-singular, badly-scaled or calibrated arms; loops or special-loops of all residual
    /// chains; platform, platform-planar-base, platform-near-planar, platform-6-3 ... (all names: --set help)
    #[arg(long, default_value = "general")]
    pub set: String,
    /// Number of arms or platforms, or of loops per chain
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub count: u64,
    /// Seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// Look for real solutions only
    #[arg(long)]
    pub real: bool,
    /// Loops only: data of three decimals, and the exact closure polynomial beside the solutions of every loop
    #[arg(long, conflicts_with = "real")]
    pub exact: bool,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

/// `looproot bench mobility`
#[derive(Args)]
pub struct DisturbOptions {
    /// A mobile loop of up to six variables or a mobile framework of the built-in library; all of them if none is given
    #[arg(long, value_name = "NAME")]
    pub entry: Option<String>,
    /// Number of disturbed mechanisms of each
    #[arg(long, value_name = "N", default_value_t = 1000)]
    pub count: u64,
    /// Number of disturbed loops of each that are solved as well, and their configurations counted [default: all]
    #[arg(long, value_name = "N")]
    pub solve: Option<u64>,
    /// Seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
    /// Number of threads [default: all cores]
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

/// `looproot bench speed`
#[derive(Args)]
pub struct SpeedOptions {
    /// general (arms); loops of all residual chains, short and planar loops of the library, and exact closure polynomials;
    /// special-loops with right angles and parallel axes; platform or another set of platforms
    #[arg(long, default_value = "general")]
    pub set: String,
    /// Number of arms or platforms, or of loops per chain [default: 200; loops: 20]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub count: Option<u64>,
    /// How often each of them is timed [default: 101; loops: 11]
    #[arg(long, value_name = "N")]
    pub repeats: Option<usize>,
    /// Seed of the draw
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub seed: u64,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
}

/// `looproot completions`
#[derive(Args)]
pub struct CompletionsOptions {
    /// The shell
    pub shell: Shell,
}
