//! The exit codes and the reports on stderr.

use looproot::internal::catalogue::FileKind;
use looproot::internal::error::Error;
use looproot::internal::mechanism::Solution;
use looproot::internal::verdict::{Status, Verdict};
use std::io::{ErrorKind, Write};
use std::process::ExitCode;

/// The exit codes, in order of gravity: of several answers the gravest counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Answered and proved.
    Complete,
    /// No real solution, and that is proved.
    Unreachable,
    /// Any other answer: incomplete, probable, of rounded data, or a self-motion.
    NotProved,
    /// A mechanism beyond what is implemented.
    Unsupported,
    /// An error of usage or input.
    Misuse,
    /// Ctrl-C.
    Interrupted,
}

/// The reason why a verb stopped.
pub enum Fault {
    /// A fault of the input or the mechanism.
    Error(Error),
    /// The output could not be written.
    Output(std::io::Error),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl From<looproot_algebra::error::Error> for Fault {
    fn from(error: looproot_algebra::error::Error) -> Self {
        Self::Error(error.into())
    }
}

impl From<std::io::Error> for Fault {
    fn from(error: std::io::Error) -> Self {
        Self::Output(error)
    }
}

impl Exit {
    /// Returns the code of an answer; an answer that is not proved never counts as certain.
    pub fn of(solution: &Solution) -> Self {
        Self::of_verdict(&solution.verdict)
    }

    /// Returns the exit code of a verdict.
    pub fn of_verdict(verdict: &Verdict) -> Self {
        let is_proved = verdict.proof.is_proved();
        match verdict.status {
            Status::Complete if is_proved => Self::Complete,
            Status::Unreachable if is_proved => Self::Unreachable,
            Status::Complete | Status::Unreachable | Status::Incomplete | Status::SelfMotion => Self::NotProved,
            Status::Unsupported => Self::Unsupported,
        }
    }

    /// Returns the number with which the process ends.
    pub fn code(self) -> u8 {
        match self {
            Self::Complete => 0,
            Self::Misuse => 1,
            Self::NotProved => 2,
            Self::Unreachable => 3,
            Self::Unsupported => 4,
            Self::Interrupted => 130,
        }
    }

    /// Returns the code of an error.
    pub fn of_error(error: &Error) -> Self {
        if error.exit_code() == 4 { Self::Unsupported } else { Self::Misuse }
    }

    /// Reports the fault of a verb on stderr. An output that was closed (`looproot list | head`) is no fault.
    pub fn from_fault(fault: &Fault) -> Self {
        match fault {
            Fault::Error(error) => {
                complain(&error.to_string());
                Self::of_error(error)
            }
            Fault::Output(error) if error.kind() == ErrorKind::BrokenPipe => Self::Complete,
            Fault::Output(error) => {
                complain(&format!("cannot write the output: {error}"));
                Self::Misuse
            }
        }
    }
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit.code())
    }
}

/// Prints help, version or an error of the argument parser, whose own exit code for misuse has another meaning here.
pub fn misuse(message: &clap::Error) -> Exit {
    // If even this cannot be printed, nothing is left to do.
    let _ = message.print();
    if message.use_stderr() { Exit::Misuse } else { Exit::Complete }
}

/// Returns the fault of a verb that does not accept files of this kind.
pub fn unexpected(name: &str, kind: FileKind, expected: &str) -> Fault {
    Error::Invalid(format!("{name}: {}", kind.unexpected(expected))).into()
}

/// Writes one line to stderr, which may be closed.
pub fn complain(message: &str) {
    let _ = writeln!(std::io::stderr(), "error: {message}");
}
