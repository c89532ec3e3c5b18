//! The command line of looproot.

mod again;
mod command;
mod long_numbers;

use clap::Parser;
use command::Arguments;
use command::exit::Exit;
use std::process::ExitCode;

/// Results of batches are freed by another thread than made them, and large polynomials come and go: the allocator of the C library
/// waits for its lock in the first case, and gives memory back to the system each time in the second.
#[cfg(not(target_family = "wasm"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    #[cfg(not(target_family = "wasm"))]
    long_numbers::share_allocator();
    run().into()
}

/// Runs the command that the arguments of the process give.
fn run() -> Exit {
    match Arguments::try_parse() {
        Ok(arguments) => arguments.verb.run().unwrap_or_else(|fault| Exit::from_fault(&fault)),
        Err(misuse) => command::exit::misuse(&misuse),
    }
}
