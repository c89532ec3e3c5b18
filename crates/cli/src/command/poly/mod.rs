//! `looproot poly`: operations on polynomials.

pub mod arguments;
mod determinant;
mod envelope;
mod evaluate;
mod expand;
mod factors;
mod input;
mod job;
mod resultant;
mod roots;
mod tell;
mod timing;

use super::exit::{Exit, Fault};
use arguments::{PolyOptions, Task};

/// Carries out the requested task.
pub fn run(options: &PolyOptions) -> Result<Exit, Fault> {
    match &options.task {
        Task::Expand(options) => expand::run(options),
        Task::Resultant(options) => resultant::run(options),
        Task::Det(options) => determinant::run(options),
        Task::Roots(options) => roots::run(options),
        Task::FactorFree(options) => factors::square_free(options),
        Task::Gcd(options) => factors::common(options),
        Task::Evaluate(options) => evaluate::run(options),
        Task::Envelope(options) => envelope::run(options),
        Task::Job(options) => job::run(options),
    }
}
