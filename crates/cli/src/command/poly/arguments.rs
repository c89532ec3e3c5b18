//! The words behind `looproot poly`.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use looproot_algebra::text::Format;
use std::path::PathBuf;

/// `looproot poly`
#[derive(Args)]
#[command(after_help = INPUT, disable_help_subcommand = true)]
pub struct PolyOptions {
    /// What to do.
    #[command(subcommand)]
    pub task: Task,
}

const INPUT: &str = "\
A polynomial is an expression such as \"(x + y/2)^2 - 0.1*y\", or a file of such expressions with `;` between them,
or one of the JSON that `--format json` writes: @FILE, the path of a file, or - for standard input.";

/// What can be done with polynomials.
#[derive(Subcommand)]
pub enum Task {
    /// Multiply out, or translate into another language
    Expand(ExpandOptions),
    /// Eliminate a variable from two polynomials
    Resultant(ResultantOptions),
    /// The determinant of a matrix of polynomials
    Det(DetOptions),
    /// All real roots, each in an interval of its own
    Roots(RootsOptions),
    /// Split into square-free factors by multiplicity
    FactorFree(FactorFreeOptions),
    /// The greatest common divisor
    Gcd(GcdOptions),
    /// The exact value at numbers
    Evaluate(EvaluateOptions),
    /// The envelope of a family of curves or surfaces
    Envelope(EnvelopeOptions),
    /// Time a job of the comparison with other systems
    Job(JobOptions),
}

/// How polynomials are read.
#[derive(Args)]
pub struct ReadOptions {
    /// The variables in their order [default: in order of appearance]
    #[arg(long, value_name = "X,Y,...", value_delimiter = ',')]
    pub vars: Option<Vec<String>>,
}

/// How results are written.
#[derive(Args)]
pub struct WriteOptions {
    /// The language of the result
    #[arg(long, value_name = "LANGUAGE", default_value = "text", value_parser = format())]
    pub format: Format,
    /// A JSON document, as --format json
    #[arg(long, conflicts_with = "format")]
    pub json: bool,
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

impl WriteOptions {
    /// Returns the requested language.
    pub const fn language(&self) -> Format {
        if self.json { Format::Json } else { self.format }
    }
}

/// Returns the parser of a language name.
pub fn format() -> impl TypedValueParser<Value = Format> {
    let find = |name: String| Format::NAMED.into_iter().find(|(known, _)| *known == name).map(|(_, format)| format);
    PossibleValuesParser::new(Format::NAMED.map(|(name, _)| name)).try_map(move |name| find(name).ok_or("no language"))
}

/// How tables are written.
#[derive(Args)]
pub struct TableOptions {
    /// A JSON document
    #[arg(long)]
    pub json: bool,
    /// Write to a file instead of standard output
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

/// `looproot poly expand`
#[derive(Args)]
pub struct ExpandOptions {
    /// A polynomial
    #[arg(allow_hyphen_values = true)]
    pub polynomial: String,
    /// More of them, those that begin with a minus sign behind --
    #[arg(value_name = "POLYNOMIAL")]
    pub more: Vec<String>,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly resultant`
#[derive(Args)]
pub struct ResultantOptions {
    /// A polynomial, or a file with both
    #[arg(allow_hyphen_values = true)]
    pub f: String,
    /// The other polynomial
    #[arg(allow_hyphen_values = true)]
    pub g: Option<String>,
    /// The variable to eliminate
    #[arg(long, value_name = "X")]
    pub eliminate: String,
    /// Print a second polynomial that gives the eliminated variable: it vanishes at the common root, and is linear in X
    /// where one exists
    #[arg(long)]
    pub lift: bool,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly envelope`
#[derive(Args)]
pub struct EnvelopeOptions {
    /// A family: a polynomial in the coordinates and the parameter
    #[arg(allow_hyphen_values = true)]
    pub family: String,
    /// The parameter of the family
    #[arg(long, value_name = "T")]
    pub parameter: String,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly det`
#[derive(Args)]
pub struct DetOptions {
    /// Rows such as "[[x, 1], [2, x]]" or "x, 1; 2, x", or a file of them
    #[arg(value_name = "MATRIX", allow_hyphen_values = true)]
    pub matrix: String,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly roots`
#[derive(Args)]
pub struct RootsOptions {
    /// A polynomial in one variable
    #[arg(allow_hyphen_values = true)]
    pub polynomial: String,
    #[command(flatten)]
    pub write: TableOptions,
}

/// `looproot poly factor-free`
#[derive(Args)]
pub struct FactorFreeOptions {
    /// A polynomial
    #[arg(allow_hyphen_values = true)]
    pub polynomial: String,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: TableOptions,
}

/// `looproot poly gcd`
#[derive(Args)]
pub struct GcdOptions {
    /// A polynomial, or a file with several
    #[arg(allow_hyphen_values = true)]
    pub f: String,
    /// Another polynomial
    #[arg(allow_hyphen_values = true)]
    pub g: Option<String>,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly evaluate`
#[derive(Args)]
pub struct EvaluateOptions {
    /// A polynomial
    #[arg(allow_hyphen_values = true)]
    pub polynomial: String,
    /// Numbers for some or all variables: x=1/2,y=-0.3
    #[arg(long, value_name = "X=NUMBER,...", value_delimiter = ',', required = true)]
    pub at: Vec<String>,
    #[command(flatten)]
    pub read: ReadOptions,
    #[command(flatten)]
    pub write: WriteOptions,
}

/// `looproot poly job`
#[derive(Args)]
pub struct JobOptions {
    /// A JSON file of kind polydet, mpolydet, res, expand, mul, gcd or roots
    pub file: String,
    /// Repeat for at most this long
    #[arg(long, value_name = "S", default_value_t = 1.5)]
    pub seconds: f64,
}
