//! The command line of looproot.

mod command;

use clap::Parser;
use command::arguments::{Arguments, Verb};
use command::exit::Exit;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(misuse) => return command::exit::misuse(&misuse).into(),
    };
    let outcome = match &arguments.verb {
        Verb::Solve(options) => command::solve::run(options),
        Verb::Derive(options) => command::derive::run(options),
        Verb::Sweep(options) => command::sweep::run(options),
        Verb::View(options) => command::view::run(options),
        Verb::Mobility(options) => command::mobility::run(options),
        Verb::Synthesize(options) => command::synthesize::run(options),
        Verb::Factor(options) => command::factor::run(options),
        Verb::Conditions(options) => command::conditions::run(options),
        Verb::Motion(options) => command::motion::run(options),
        Verb::Instant(options) => command::instant::run(options),
        Verb::Dynamics(options) => command::dynamics::run(options),
        Verb::List(options) => command::list::run(options),
        Verb::Show(options) => command::show::run(options),
        Verb::Convert(options) => command::convert::run(options),
        Verb::Check(options) => command::check::run(options),
        Verb::Verify(options) => command::verify::run(options),
        Verb::Poly(options) => command::poly::run(options),
        Verb::Bench(options) => command::bench::run(options),
        Verb::Completions(options) => command::completions::run(options),
    };
    outcome.unwrap_or_else(|fault| Exit::from_fault(&fault)).into()
}
