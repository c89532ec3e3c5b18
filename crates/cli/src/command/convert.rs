//! `looproot convert`

use super::arguments::ConvertOptions;
use super::exit::{Exit, Fault};
use super::output::Output;
use looproot::internal::catalogue::{Chains, Options, load};
use looproot::internal::report::convert::converted;

/// Writes an arm as a file of another format.
pub fn run(options: &ConvertOptions) -> Result<Exit, Fault> {
    let read = Options { chains: Chains::Swept, ..options.read.options() };
    let entry = load(&options.mechanism, &read)?;
    let text = converted(&entry, options.to).map_err(|error| error.at(&options.mechanism, 1))?;
    Output::write(&options.output, &options.mechanism, &text)?;
    Ok(Exit::Complete)
}
