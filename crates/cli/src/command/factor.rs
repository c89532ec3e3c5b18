//! `looproot factor`

use super::arguments::FactorOptions;
use super::exit::{Exit, Fault, unexpected};
use super::output::Output;
use looproot::internal::catalogue::{Any, load_any};
use looproot::internal::error::Error;
use looproot::internal::factoring::{Factored, factor};
use looproot::internal::report::motion::{json, text, toml, verdict};

/// Factors a rational motion and prints the loop of two factorisations.
pub fn run(options: &FactorOptions) -> Result<Exit, Fault> {
    let file = match load_any(&options.mechanism, &options.read.options())? {
        Any::Motion(file) => file,
        other => return Err(unexpected(&options.mechanism, other.kind(), "a rational motion")),
    };
    let factored = factor(&file);
    let closed = factored.closed_loop(options.pair)?;
    let written = match (&closed, options.toml) {
        (Some(closed), true) => toml(&file, closed),
        (None, true) => {
            let message = format!("no loop to print: {}", verdict(&factored, None));
            return Err(Error::Unsupported(message).into());
        }
        (_, false) if options.json => format!("{:#}\n", json(&file, &factored, closed.as_ref())),
        (_, false) if options.quiet => verdict(&factored, closed.as_ref()) + "\n",
        (_, false) => text(&factored, closed.as_ref()),
    };
    Output::write(&options.output, &options.mechanism, &written)?;
    Ok(match factored {
        Factored::Exact(_) => Exit::Complete,
        Factored::Float(_) | Factored::None(_) => Exit::NotProved,
    })
}
