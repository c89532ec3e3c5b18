//! `looproot poly expand`

use super::arguments::ExpandOptions;
use super::{input, tell};
use crate::command::exit::{Exit, Fault};

/// Multiplies polynomials out.
pub fn run(options: &ExpandOptions) -> Result<Exit, Fault> {
    let arguments: Vec<&str> = std::iter::once(&options.polynomial).chain(&options.more).map(String::as_str).collect();
    let (polynomials, names) = input::polynomials(&arguments, &options.read)?;
    tell::results(&polynomials, &names, &options.write, &input::files(&arguments))?;
    Ok(Exit::Complete)
}
