//! The command line of looproot.

mod command;

use clap::Parser;
use command::Arguments;
use command::exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(misuse) => return command::exit::misuse(&misuse).into(),
    };
    arguments.verb.run().unwrap_or_else(|fault| Exit::from_fault(&fault)).into()
}
