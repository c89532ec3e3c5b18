//! The verbs: one file for each, and their common parts.

mod answer_file;
pub mod arguments;
#[cfg(not(target_family = "wasm"))]
mod arrow_table;
#[cfg(not(target_family = "wasm"))]
pub mod bench;
pub mod bless;
pub mod calculus;
pub mod certificates;
pub mod check;
pub mod completions;
pub mod conditions;
pub mod conditions_search;
pub mod convert;
pub mod demand;
pub mod derive;
pub mod discriminant;
pub mod dynamics;
pub mod exit;
pub mod factor;
pub mod follow;
pub mod help;
pub mod instant;
mod inverse;
mod kept;
pub mod linkage;
pub mod linkage_derive;
pub mod linkage_sweep;
pub mod list;
mod loads;
pub mod mobility;
pub mod motion;
mod motion_arguments;
mod npy;
mod npz;
pub mod order;
pub mod output;
mod platform_sweep;
pub mod poly;
pub mod rows;
#[cfg(not(target_family = "wasm"))]
pub mod score;
pub mod seed;
pub mod show;
pub mod solve;
mod space;
pub mod space_instant;
mod sphere;
mod stream;
pub mod sweep;
mod symbols;
pub mod synthesize;
pub mod transference;
pub mod verify;
pub mod view;
pub mod view_live;
pub mod view_map;
pub mod wanted;

use arguments::{
    BenchOptions, CheckOptions, CompletionsOptions, ConditionsOptions, ConvertOptions, DeriveOptions, DynamicsOptions,
    FactorOptions, InstantOptions, ListOptions, MobilityOptions, MotionOptions, ShowOptions, SolveOptions,
    SweepOptions, SynthesizeOptions, VerifyOptions, ViewOptions,
};
use clap::{Parser, Subcommand};
use exit::{Exit, Fault};
use poly::arguments::PolyOptions;

/// All solutions of kinematic closure equations, with a verdict on completeness.
#[derive(Parser)]
#[command(name = "looproot", version, about, disable_help_subcommand = true, after_help = EXIT_CODES)]
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
    /// Draw what solve, sweep or mobility finds as a page that stands by itself
    View(Box<ViewOptions>),
    /// Decide whether a loop, an arm, a platform or a framework moves, with proof
    Mobility(MobilityOptions),
    /// Find all dyads through given positions, or all four-bars for pairs of angles or through points
    Synthesize(SynthesizeOptions),
    /// Factor a rational motion and close loops of its factorisations
    Factor(FactorOptions),
    /// Derive for which parameters a closed chain of revolute joints moves
    Conditions(ConditionsOptions),
    /// Convert a rotation or a displacement into every parametrisation, with all branches
    Motion(MotionOptions),
    /// The instantaneous motion of a body of a linkage: pole, inflection circle, centres of curvature
    Instant(InstantOptions),
    /// The equations of motion of a linkage with masses, the forces in its joints, and its motion in time
    Dynamics(DynamicsOptions),
    /// List the built-in library
    List(ListOptions),
    /// Print a mechanism as it was understood
    Show(ShowOptions),
    /// Write an arm as a file of another format
    Convert(ConvertOptions),
    /// Test every claim of mechanism files
    Check(CheckOptions),
    /// Check certificates of answers, without solving anything
    Verify(VerifyOptions),
    /// Polynomials: multiply out, eliminate, determinants, real roots
    Poly(PolyOptions),
    /// Measure accuracy and speed on random arms and platforms
    Bench(BenchOptions),
    /// Print the completions of a shell
    Completions(CompletionsOptions),
}

impl Verb {
    /// Does it.
    pub fn run(&self) -> Result<Exit, Fault> {
        match self {
            Self::Solve(options) => solve::run(options),
            Self::Derive(options) => derive::run(options),
            Self::Sweep(options) => sweep::run(options),
            Self::View(options) => view::run(options),
            Self::Mobility(options) => mobility::run(options),
            Self::Synthesize(options) => synthesize::run(options),
            Self::Factor(options) => factor::run(options),
            Self::Conditions(options) => conditions::run(options),
            Self::Motion(options) => motion::run(options),
            Self::Instant(options) => instant::run(options),
            Self::Dynamics(options) => dynamics::run(options),
            Self::List(options) => list::run(options),
            Self::Show(options) => show::run(options),
            Self::Convert(options) => convert::run(options),
            Self::Check(options) => check::run(options),
            Self::Verify(options) => verify::run(options),
            Self::Poly(options) => poly::run(options),
            #[cfg(not(target_family = "wasm"))]
            Self::Bench(options) => bench::run(options),
            // Pages have 6 MB, and a solver that is compiled for size is not the one to be measured.
            #[cfg(target_family = "wasm")]
            Self::Bench(_) => {
                let message = "bench in a browser: expected the program on a computer";
                Err(looproot::internal::error::Error::Unsupported(message.to_owned()).into())
            }
            Self::Completions(options) => completions::run(options),
        }
    }
}
