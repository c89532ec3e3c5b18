//! `looproot completions`

use super::Arguments;
use super::arguments::CompletionsOptions;
use super::exit::{Exit, Fault};
use super::output::print;
use clap::CommandFactory;

/// Prints the completions of a shell.
pub fn run(options: &CompletionsOptions) -> Result<Exit, Fault> {
    let mut text = Vec::new();
    clap_complete::generate(options.shell, &mut Arguments::command(), "looproot", &mut text);
    print(&String::from_utf8_lossy(&text))?;
    Ok(Exit::Complete)
}
