//! The command line of looproot.

mod again;
mod command;
mod long_numbers;

use clap::{CommandFactory, FromArgMatches};
use command::Arguments;
use command::exit::Exit;
use std::cell::RefCell;
use std::process::ExitCode;

thread_local! {
    /// The options of all verbs. A page runs one command after the other in the same program: to describe them takes a tenth of an answer.
    static OPTIONS: RefCell<clap::Command> = RefCell::new(Arguments::command());
}

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
    let parsed = OPTIONS.with_borrow_mut(|options| {
        let mut matches = options.try_get_matches_from_mut(std::env::args_os())?;
        Arguments::from_arg_matches_mut(&mut matches).map_err(|misuse| misuse.format(options))
    });
    match parsed {
        Ok(arguments) => arguments.verb.run().unwrap_or_else(|fault| Exit::from_fault(&fault)),
        Err(misuse) => command::exit::misuse(&misuse),
    }
}
