//! `looproot convert`

use super::arguments::ConvertOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::internal::catalogue::{Chains, Options, load};
use looproot::internal::report::convert::converted;
use std::io::Write;

/// Writes an arm as a file of another format.
pub fn run(options: &ConvertOptions) -> Result<Exit, Fault> {
    let read = Options { chains: Chains::Swept, ..options.read.options() };
    let entry = load(&options.mechanism, &read)?;
    let text = converted(&entry, options.to).map_err(|error| error.at(&options.mechanism, 1))?;
    let mut output = Output::open(&options.output, &options.mechanism)?;
    output.writer.write_all(text.as_bytes())?;
    output.writer.flush()?;
    Ok(Exit::Complete)
}
