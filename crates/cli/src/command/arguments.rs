//! The options of the verbs.

use super::help;
pub use super::motion_arguments::{DynamicsOptions, InstantOptions, MotionOptions};
use super::poly::arguments::format;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand, ValueEnum};
use clap_complete::Shell;
use looproot::internal::catalogue::{Chains, Options};
use looproot::internal::derivation::Way;
use looproot::internal::report::convert::Target;
use looproot::internal::report::paper::Style;
use looproot_algebra::text::Format;
use std::path::PathBuf;

/// How to read numbers.
#[derive(Args, Clone)]
pub struct NumberOptions {
    /// Decimal digits of the rationals that replace irrational numbers in exact work
    #[arg(long, value_name = "N", default_value_t = 15)]
    pub digits: u32,
}

impl NumberOptions {
    /// Returns the options of the reader.
    pub fn options(&self) -> Options {
        Options { digits: self.digits, ..Options::default() }
    }
}

/// How to read the mechanism.
#[derive(Args, Clone)]
pub struct ReadOptions {
    #[command(flatten)]
    pub numbers: NumberOptions,
    /// URDF and MJCF: the link or body at the root of the chain
    #[arg(long, value_name = "LINK")]
    pub base_link: Option<String>,
    /// URDF and MJCF: the link, body or site at the end of the chain
    #[arg(long, value_name = "LINK")]
    pub tip_link: Option<String>,
    /// URDF: the SRDF file of the planning group that names the chain
    #[arg(long, value_name = "FILE", requires = "group")]
    pub srdf: Option<PathBuf>,
    /// URDF: the planning group of the SRDF file
    #[arg(long, value_name = "NAME", requires = "srdf")]
    pub group: Option<String>,
    /// URDF, MJCF and DH tables: take truncated multiples of pi (1.5708, 3.14159) as the angles meant
    #[arg(long)]
    pub snap: bool,
}

impl ReadOptions {
    /// Returns the options of the reader.
    pub fn options(&self) -> Options {
        Options {
            digits: self.numbers.digits,
            base_link: self.base_link.clone(),
            tip_link: self.tip_link.clone(),
            snap: self.snap,
            group: self.srdf.clone().zip(self.group.clone()),
            ..Options::default()
        }
    }
}

/// Which case of a mechanism is meant.
#[derive(Args, Clone)]
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
    /// This pose of the tool or plate: "x, y, z; w, x, y, z", position and quaternion, or "x, y, z; roll, pitch, yaw"; without a
    /// unit in those of the file (of a URDF metres and radians)
    #[arg(long, value_name = "POSE", conflicts_with_all = ["pose", "input", "joints", "legs"], allow_hyphen_values = true)]
    pub at: Option<String>,
}

/// What is asked of an arm beside its pose.
#[derive(Args, Clone)]
pub struct DemandOptions {
    /// Arms: hold a joint at a value, by its name or number: elbow="10 deg"; once for every joint that is held
    #[arg(long, value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub lock: Vec<String>,
    /// Arms: what is asked of the tool: pose, position+axis, position+tilt, position, orientation [default: pose]
    #[arg(long, value_name = "TASK")]
    pub task: Option<String>,
}

impl CaseOptions {
    /// Returns the chains that are accepted: those without a case if the command line gives one.
    pub fn chains(&self) -> Chains {
        let is_value = self.input.as_ref().is_some_and(|input| input.contains('='));
        let is_given = is_value || self.joints.is_some() || self.legs.is_some() || self.at.is_some();
        if is_given { Chains::Swept } else { Chains::Solved }
    }
}

/// Where the output goes.
#[derive(Args, Clone)]
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
#[derive(Args, Clone)]
#[command(after_help = help::SOLVE)]
pub struct SolveOptions {
    /// A file (TOML, JSON, DH table as CSV, URDF, MJCF), the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// List complex solutions too
    #[arg(long)]
    pub complex: bool,
    /// Look for real solutions only: faster; lists of loops with translations are mostly not proved complete
    #[arg(long, conflicts_with = "complex")]
    pub real: bool,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// JSON Lines: one result a line, as soon as it is there
    #[arg(long, conflicts_with = "json")]
    pub jsonl: bool,
    /// JSON: add the scene and the poses of its bodies at every configuration, so that another program can draw it
    #[arg(long)]
    pub scene: bool,
    #[command(flatten)]
    pub asked: CaseOptions,
    /// Many poses, one a row: CSV with the header x,y,z,qw,qx,qy,qz or x,y,z,roll,pitch,yaw or m00,...,m23 (a suffix gives a
    /// unit: x_mm, roll_deg), JSON lines, or an array of numpy (n, 4, 4) or (n, 7) in metres; - for standard input
    #[arg(long, value_name = "FILE", conflicts_with_all = ["pose", "input", "joints", "legs", "at"])]
    pub poses: Option<String>,
    #[command(flatten)]
    pub demand: DemandOptions,
    /// The rows of --poses are a path: which solution continues which one, jumps and singularities, the largest move of a joint
    #[arg(long, requires = "poses")]
    pub follow: bool,
    /// Platforms: the lengths of the legs at the poses of --at, --poses or the file, beside their limits; nothing is solved
    #[arg(long, conflicts_with_all = ["complex", "real", "legs", "scene", "follow", "near", "turns", "derivatives", "tolerance", "certificate"])]
    pub inverse: bool,
    /// Sort real solutions by their distance to these joint values, of a platform to this pose of the plate, as in --at; of a linkage in the
    /// plane to the values of its joints or of some: A=10 deg, B=0.5
    #[arg(long, value_name = "Q", allow_hyphen_values = true)]
    pub near: Option<String>,
    /// Every representative of an angle within the joint limits, not one alone
    #[arg(long)]
    pub turns: bool,
    /// Loops: velocities and accelerations of all joints per unit rate of the input, at every real mode
    #[arg(long)]
    pub derivatives: bool,
    /// Solutions outside the joint limits
    #[arg(long, value_name = "HOW", default_value = "mark")]
    pub limits: Limits,
    /// Arms: how far a solution may miss the pose and still be listed [default: 1e-9 m, 1e-9 rad; of arms with fewer than six
    /// joints 1e-6 m, 1e-6 rad, or the last digit typed]
    #[arg(long, value_name = "LENGTH,ANGLE")]
    pub tolerance: Option<String>,
    /// Write a certificate of every proved answer to this file, one a line: `looproot verify` and verify/verify.py check it
    #[arg(long, value_name = "FILE", conflicts_with = "real")]
    pub certificate: Option<PathBuf>,
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

/// Returns the languages of papers by name.
fn style() -> impl TypedValueParser<Value = Style> {
    PossibleValuesParser::new(Style::NAMED.map(|(name, _)| name)).map(|name| {
        let found = Style::NAMED.iter().find(|(known, _)| *known == name);
        found.map_or(Style::Markdown, |(_, style)| *style)
    })
}

fn way() -> impl TypedValueParser<Value = Way> {
    PossibleValuesParser::new(Way::NAMED.map(|(name, _)| name)).map(|name| {
        let found = Way::NAMED.iter().find(|(known, _)| *known == name);
        found.map_or(Way::WoernleLee, |(_, way)| *way)
    })
}

/// `looproot derive`
#[derive(Args)]
#[command(after_help = help::DERIVE)]
pub struct DeriveOptions {
    /// A file (TOML, JSON, DH table as CSV, URDF, MJCF), the name of a built-in entry, or - for standard input; of several
    /// poses or inputs the first one, unless one is asked for; with --bless files and folders
    #[arg(required = true, value_name = "MECHANISM")]
    pub mechanisms: Vec<String>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Keep link parameters and the input as symbols: all that are neither zero nor a right angle, or those named, as
    /// a1,alpha2,d3,theta4; up to three are kept in any mechanism, among them x and turn_x of the tool at a pose, point2.x of axes in
    /// screws, leg1 and base1.x of platforms; coordinates of points in linkages, as crank.B.x; in space also lengths, as rod.length, and given joints; on the sphere sides, as crank.A.B, or as
    /// crank_A_B in the transfer function, and given joints
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
    /// A table, in Markdown, of what is derived from all files under these paths: degree, real roots, length
    #[arg(long, conflicts_with_all = ["json", "format", "explain", "symbolic", "output", "bless"])]
    pub atlas: bool,
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
    /// Linkages: the curve of a point of a body, as a polynomial in its coordinates
    #[arg(long, value_name = "BODY.POINT", conflicts_with_all = ["explain", "bless", "format"])]
    pub trace: Option<String>,
    /// --trace of a point of the coupler of a four-bar: the two other four-bars with the same curve, as files
    #[arg(long, requires = "trace")]
    pub cognates: bool,
    /// The closure polynomial by one elimination, with its own equations and matrix, compared over the rationals
    #[arg(long, value_name = "WAY", value_parser = way(), conflicts_with_all = ["symbolic", "bless", "transference", "trace"])]
    pub by: Option<Way>,
    /// The numbers of real assembly modes between the zeros of the discriminant in one parameter (theta4, a2, x, leg1), or over the
    /// plane of two, as a1,theta4
    #[arg(
        long,
        value_name = "NAMES",
        conflicts_with_all = ["symbolic", "bless", "transference", "trace", "by", "format", "explain"]
    )]
    pub discriminant: Option<String>,
    /// With --discriminant: an SVG picture
    #[arg(long, requires = "discriminant", conflicts_with = "json")]
    pub svg: bool,
    /// With two parameters: where the first one begins [default: a full turn, a length from 0 to twice that of the file]
    #[arg(long, value_name = "VALUE", requires_all = ["discriminant", "to"], allow_hyphen_values = true)]
    pub from: Option<String>,
    /// With two parameters: where the first one ends
    #[arg(long, value_name = "VALUE", requires_all = ["discriminant", "from"], allow_hyphen_values = true)]
    pub to: Option<String>,
    /// With two parameters: the number of columns, in each of which the cells of the second one are exact
    #[arg(long, value_name = "N", requires = "discriminant", default_value = "72", value_parser = steps)]
    pub columns: usize,
    /// Write a certificate of a proved polynomial of an arm or a loop to this file: `looproot verify` and verify/verify.py check it
    #[arg(long, value_name = "FILE", conflicts_with_all = ["symbolic", "bless", "atlas", "transference", "trace", "by", "discriminant"])]
    pub certificate: Option<PathBuf>,
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
#[command(after_help = help::SWEEP)]
pub struct SweepOptions {
    /// A file of a loop, a linkage or a platform, the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// The joint to sweep, counted from 1; of a C joint its angle (3 or q3) or its distance (d3); of a linkage its name; of a platform
    /// the leg (leg1 to leg6) whose length changes
    /// [default: the input of the file]
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
    /// A picture: every joint variable against the input, or of a planar linkage the curve of the point of --trace
    #[arg(long, conflicts_with = "json")]
    pub svg: bool,
    /// Linkages: the place of a point of a body at every step
    #[arg(long, value_name = "BODY.POINT")]
    pub trace: Option<String>,
    /// JSON of linkages in the plane: the pole of a body at every step, in axes of the ground and of the body
    #[arg(long, value_name = "BODY", requires = "json")]
    pub centrodes: Option<String>,
    /// JSON of loops (the body behind this joint) and of linkages on the sphere: the axis of the velocity screw, in the same axes
    #[arg(long, value_name = "BODY", requires = "json")]
    pub axodes: Option<String>,
    /// Write a certificate of the proved branches of a four-bar over a full turn to this file: `looproot verify` and verify/verify.py
    /// check it
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// Loops and linkages: the velocity ratio of this joint to the input, and its least and greatest value on every branch
    #[arg(long, value_name = "JOINT", conflicts_with_all = ["svg", "quiet"])]
    pub ratio: Option<String>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// JSON: add the scene and the poses of its bodies at every configuration, so that another program can draw it
    #[arg(long, requires = "json")]
    pub scene: bool,
    #[command(flatten)]
    pub drawn: super::seed::SeedOptions,
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

/// `looproot view`
#[derive(Args, Clone)]
#[command(
    mut_arg("mechanism", |arg| arg.value_name("FILE|RESULT").help(VIEWED)),
    mut_arg("json", |arg| arg.hide(true)),
    mut_arg("jsonl", |arg| arg.hide(true)),
    mut_arg("scene", |arg| arg.hide(true)),
    mut_arg("derivatives", |arg| arg.hide(true)),
    mut_arg("quiet", |arg| arg.hide(true)),
    mut_arg("color", |arg| arg.hide(true)),
    after_help = help::VIEW
)]
pub struct ViewOptions {
    #[command(flatten)]
    pub solve: SolveOptions,
    /// Loops and linkages: run the input through a range, all branches moving
    #[arg(long, requires_all = ["from", "to"])]
    pub sweep: bool,
    /// --sweep: the joint to sweep [default: the input of the file]
    #[arg(long, value_name = "JOINT", requires = "sweep")]
    pub joint: Option<String>,
    /// --sweep: where the input begins
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, requires = "sweep")]
    pub from: Option<String>,
    /// --sweep: where it ends
    #[arg(long, value_name = "VALUE", allow_hyphen_values = true, requires = "sweep")]
    pub to: Option<String>,
    /// --sweep: number of equal steps between
    #[arg(long, value_name = "N", default_value = "360", value_parser = steps)]
    pub steps: usize,
    /// --sweep of a linkage: the point of a body whose curve is drawn [default: those of the [[trace]]s of the file]
    #[arg(long, value_name = "BODY.POINT", requires = "sweep")]
    pub trace: Option<String>,
    /// A picture for a paper in place of a page: stick figures, or the map
    #[arg(long)]
    pub svg: bool,
    /// Arms: the number of real solutions over a plane through the pose, with the orientation kept: xy, xz or yz
    #[arg(long, value_name = "PLANE", conflicts_with = "sweep")]
    pub map: Option<String>,
    /// A page that solves anew when what was asked is moved: the program itself is in it (web/build makes it once)
    #[arg(long, conflicts_with_all = ["sweep", "svg", "map", "poses", "follow"])]
    pub live: bool,
    /// Prints the parts of a page that change with the answer, as JSON: live pages ask for it
    #[arg(long, hide = true, conflicts_with_all = ["live", "sweep", "svg", "map", "open"])]
    pub parts: bool,
    /// Show the page in the browser; without -o it is written to the folder for temporary files
    #[arg(long)]
    pub open: bool,
}

const VIEWED: &str = "A file (TOML, JSON, DH table as CSV, URDF, MJCF), the name of a built-in entry, or what solve, sweep, mobility or bench --json has \
                      written (- for standard input)";

/// `looproot conditions`
#[derive(Args)]
#[command(after_help = help::CONDITIONS)]
pub struct ConditionsOptions {
    /// 4R, 5R or 6R (all parameters symbols), a file of a loop with symbols or numbers, the name of a built-in one, or - for standard
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
    /// 4R: write a certificate of its families to this file: `looproot verify` and verify/verify.py check it
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// Seed of the numbers that are drawn: the same seed repeats an answer [default: 1 of five and six
    /// joints, else drawn]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(..1 << 53))]
    pub seed: Option<u64>,
    /// Print the verdict only
    #[arg(short, long, conflicts_with_all = ["json", "format", "explain"])]
    pub quiet: bool,
    #[command(flatten)]
    pub read: NumberOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// Reads a number of steps.
fn steps(text: &str) -> Result<usize, String> {
    const MOST: usize = 100_000;
    match text.trim().parse() {
        Ok(steps @ 1..=MOST) => Ok(steps),
        _ => Err(format!("expected 1 to {MOST}")),
    }
}

/// `looproot mobility`
#[derive(Args)]
#[command(after_help = help::MOBILITY)]
pub struct MobilityOptions {
    /// A file of a loop, an arm, a platform, a linkage or a framework, the name of a built-in entry, or - for standard input;
    /// inputs of the file are not looked at
    pub mechanism: String,
    /// Frameworks: how many steps of the motion are followed in f64
    #[arg(long, value_name = "N", default_value = "60", value_parser = steps)]
    pub steps: usize,
    /// Write a certificate of a proved answer about a loop to this file: `looproot verify` and verify/verify.py check it
    #[arg(long, value_name = "FILE")]
    pub certificate: Option<PathBuf>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub drawn: super::seed::SeedOptions,
    /// Print the verdict only
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot synthesize`
#[derive(Args)]
#[command(after_help = help::SYNTHESIZE)]
pub struct SynthesizeOptions {
    /// A file of a synthesis (kind "synthesis"), the name of a built-in one, or - for standard input
    pub mechanism: String,
    /// Sort by the distance from these numbers: those of the fixed and the moving point or of the fixed point, of a path A, D, B, C or A, D
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    pub near: Option<String>,
    /// The linkage of these dyads, or the four-bar of this number, as a file: 1,3
    #[arg(long, value_name = "I,J", requires = "toml")]
    pub linkage: Option<String>,
    /// A linkage as a mechanism file; `--linkage` names its dyads
    #[arg(long, requires = "linkage", conflicts_with_all = ["json", "quiet", "svg"])]
    pub toml: bool,
    /// Paths, and dyads RR in the plane: the four-bars that pass all points or positions in their order on one circuit
    #[arg(long, conflicts_with_all = ["toml", "svg", "quiet"])]
    pub no_defects: bool,
    /// A drawing of the positions, the dyads and the curves of their points, in the plane
    #[arg(long, conflicts_with_all = ["json", "quiet"])]
    pub svg: bool,
    /// Complex dyads, too
    #[arg(long)]
    pub complex: bool,
    #[command(flatten)]
    pub drawn: super::seed::SeedOptions,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    /// Print the verdict only
    #[arg(short, long, conflicts_with = "json")]
    pub quiet: bool,
    #[command(flatten)]
    pub read: NumberOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot factor`
#[derive(Args)]
#[command(after_help = help::FACTOR)]
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
    pub read: NumberOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// Converts two numbers counted from 1 to numbers counted from 0.
fn pair(text: &str) -> Result<(usize, usize), String> {
    let number = |text: &str| text.trim().parse::<usize>().ok()?.checked_sub(1);
    let numbers = text.split_once(',').and_then(|(i, j)| Some((number(i)?, number(j)?)));
    numbers.ok_or_else(|| "expected two numbers from 1, such as 1,6".to_owned())
}

/// `looproot list`
#[derive(Args)]
#[command(after_help = help::LIST)]
pub struct ListOptions {
    /// What: robots lists the arms of makers by name [default: everything]
    #[arg(value_parser = ["robots"])]
    pub what: Option<String>,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
}

/// `looproot verify`
#[derive(Args)]
#[command(after_help = help::VERIFY)]
pub struct VerifyOptions {
    /// A file of certificates, as solve --certificate writes them
    pub certificate: String,
    /// The mechanism of which they have to be: a file, or the name of a built-in entry
    #[arg(long, value_name = "FILE")]
    pub file: Option<String>,
    #[command(flatten)]
    pub read: ReadOptions,
}

/// `looproot show`
#[derive(Args)]
#[command(after_help = help::SHOW)]
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

/// Returns the formats that can be written, by name.
fn target() -> impl TypedValueParser<Value = Target> {
    PossibleValuesParser::new(Target::NAMED.map(|(name, _)| name)).map(|name| {
        let found = Target::NAMED.iter().find(|(known, _)| *known == name);
        found.map_or(Target::Toml, |(_, target)| *target)
    })
}

/// `looproot convert`
#[derive(Args)]
#[command(after_help = help::CONVERT)]
pub struct ConvertOptions {
    /// A file of an arm (TOML, JSON, DH table as CSV, URDF, MJCF), the name of a built-in entry, or - for standard input
    pub mechanism: String,
    /// The format; opw is the seven lengths of arms with an ortho-parallel base and a spherical wrist
    #[arg(long, value_name = "FORMAT", value_parser = target())]
    pub to: Target,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot check`
#[derive(Args)]
#[command(after_help = help::CHECK)]
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
    /// The answers of any solver to problems of `bench accuracy --export`: found, lost, spurious, errors, times
    Score(ScoreOptions),
    /// Times on one core beside faer's eigenvalues of one 16 x 16 or 40 x 40 matrix
    Speed(SpeedOptions),
}

/// `looproot bench accuracy`
#[derive(Args)]
pub struct AccuracyOptions {
    /// general, structured, near-singular, badly-scaled or calibrated arms; loops or special-loops of all residual
    /// chains; platform, platform-planar-base, platform-near-planar, platform-6-3 ... (all names: --set help). With
    /// --export several of them, with commas between, robots, or all
    #[arg(long, default_value = "general")]
    pub set: String,
    /// Writes the problems with all their solutions, for other solvers, and measures nothing: docs/benchmark.md
    #[arg(long, value_name = "FILE", conflicts_with_all = ["real", "exact", "json"])]
    pub export: Option<PathBuf>,
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

/// `looproot bench score`
#[derive(Args)]
pub struct ScoreOptions {
    /// Answers of a solver, in the format of docs/benchmark.md
    pub answers: PathBuf,
    /// The problems, if not those that the answers name
    #[arg(long, value_name = "FILE")]
    pub problems: Option<PathBuf>,
    /// Writes histograms of errors and times into this folder
    #[arg(long, value_name = "FOLDER")]
    pub svg: Option<PathBuf>,
    /// Writes the histograms and a LaTeX table into this folder
    #[arg(long, value_name = "FOLDER")]
    pub paper: Option<PathBuf>,
    /// A JSON document
    #[arg(long)]
    pub json: bool,
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
    /// general (arms); robots of the library; loops of all residual chains, short and planar loops of the library, and exact closure polynomials;
    /// special-loops with right angles and parallel axes; platform or another set of platforms
    #[arg(long, default_value = "general")]
    pub set: String,
    /// Number of arms or platforms, of loops per chain, or of poses per robot [default: 200; loops, robots: 20]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=100_000))]
    pub count: Option<u64>,
    /// How often each of them is timed [default: 101; loops: 11; robots: 3]
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
#[command(after_help = help::COMPLETIONS)]
pub struct CompletionsOptions {
    /// The shell
    pub shell: Shell,
}
