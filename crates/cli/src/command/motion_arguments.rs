//! The words of `motion`, `instant` and `dynamics`.

use super::arguments::{CaseOptions, NumberOptions, OutputOptions};
use super::help;
use clap::Args;

/// `looproot motion`
#[derive(Args)]
#[command(after_help = help::MOTION)]
pub struct MotionOptions {
    /// What the numbers are: matrix, quaternion, euler, bryan, axis, euler-vector, rodrigues, wiener, cayley-klein, motion
    #[arg(long, value_name = "KIND")]
    pub from: String,
    /// The numbers, separated by commas, parts by semicolons; plain angles are radians, "10 deg" is read
    #[arg(allow_hyphen_values = true)]
    pub numbers: String,
    /// The order of the axes of Euler angles
    #[arg(long, value_name = "AXES", default_value = "zxz")]
    pub axes: String,
    /// Motions: the parametrisations over the dual numbers, each number as [value, dual part]
    #[arg(long)]
    pub dual: bool,
    /// The rates of all parameters at this angular velocity, in axes fixed in space: "x, y, z"
    #[arg(long, value_name = "OMEGA", allow_hyphen_values = true)]
    pub rates: Option<String>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot instant`
#[derive(Args)]
#[command(after_help = help::INSTANT)]
pub struct InstantOptions {
    /// A file of a linkage, a loop or an arm, the name of a built-in one, or - for standard input
    pub mechanism: String,
    /// The body whose motion is asked for; of a loop or an arm the number of the joint before it
    #[arg(long, value_name = "BODY", required_unless_present = "loads")]
    pub body: Option<String>,
    /// The body that is held to stand still [default: the ground]
    #[arg(long, value_name = "BODY", requires = "body")]
    pub against: Option<String>,
    /// The rates of the joint variables of an arm: "1, 0, -2 ..."; the input of anything else runs at unit rate
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    pub rate: Option<String>,
    #[command(flatten)]
    pub asked: CaseOptions,
    /// This point of the body only: coupler.P
    #[arg(long, value_name = "BODY.POINT", conflicts_with = "inverse", requires = "body")]
    pub point: Option<String>,
    /// The inverse motion: that of the other body against this one
    #[arg(long, requires = "body")]
    pub inverse: bool,
    /// Linkages at rest: the drive at the input that holds these forces at points and moments on bodies, in newtons, newton metres
    /// and axes of the ground, and in the plane the forces in the joints: "coupler.P: 0, -10; rocker: 5"
    #[arg(long, value_name = "LOADS", allow_hyphen_values = true)]
    pub loads: Option<String>,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub read: NumberOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}

/// `looproot dynamics`
#[derive(Args)]
#[command(after_help = help::DYNAMICS)]
pub struct DynamicsOptions {
    /// A file of a linkage with masses, the name of a built-in one, or - for standard input
    pub mechanism: String,
    /// This input of the file only, counted from 1
    #[arg(long, value_name = "K")]
    pub input: Option<String>,
    /// The rates of the inputs, radians or metres per second: 2, or "1, -2"
    #[arg(long, value_name = "W", default_value = "0", allow_hyphen_values = true)]
    pub rate: String,
    /// The forces in all joints, on the second body of each
    #[arg(long)]
    pub forces: bool,
    /// Follow the motion for this time, in seconds: a measurement, with the energy in every row
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub time: Option<f64>,
    /// --time: the mode from which the motion starts, counted from 1
    #[arg(long, value_name = "MODE", default_value_t = 1, requires = "time")]
    pub from: usize,
    /// --time: number of rows beside the first
    #[arg(long, value_name = "N", default_value_t = 100, requires = "time")]
    pub steps: usize,
    /// One JSON document
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub read: NumberOptions,
    #[command(flatten)]
    pub output: OutputOptions,
}
