//! The command line of looproot.

mod again;
mod command;

use clap::Parser;
use command::Arguments;
use command::exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    run().into()
}

/// Runs the command that the arguments of the process give.
fn run() -> Exit {
    match Arguments::try_parse() {
        Ok(arguments) => arguments.verb.run().unwrap_or_else(|fault| Exit::from_fault(&fault)),
        Err(misuse) => command::exit::misuse(&misuse),
    }
}
