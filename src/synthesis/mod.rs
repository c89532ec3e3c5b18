//! Dimensional synthesis: all dyads through positions that are given, all function generators, and all four-bars through points.
//!
//! The positions are known and the geometry is not: every position gives polynomial equations in the points and lines of a
//! dyad, which are solved exactly over the rationals. The answer is a list of all dyads with multiplicity, or the dimension
//! of their family.

mod answer;
mod bilinear;
mod cells;
mod curves;
mod dyad;
mod equations;
mod function;
pub(crate) mod krawczyk;
mod linear;
mod lines;
mod moments;
pub mod path;
mod poles;
mod remarks;
mod sample;
mod skew;
mod solved;

pub use answer::{Answer, Family, Mode};
pub use curves::Curve;
pub use dyad::{Dyad, Part};
pub use poles::{Pole, poles};

use crate::catalogue::{DyadKind, Space, SynthesisFile, Task};
use answer::{found, undecided};
use equations::Wanted;
use solved::{Found, solve};

/// Products of words that a Gröbner basis may take: seven positions of a body on spheres take a fiftieth of it.
const EFFORT: u64 = 2_000_000_000;

/// Finds all dyads of a file, or four-bars.
///
/// # Example
/// ```
/// use looproot::internal::{catalogue, synthesis};
/// let catalogue::Any::Synthesis(file) = catalogue::builtin_any("synthesis/burmester5_4real_a", &Default::default())? else {
///     panic!("a synthesis");
/// };
/// let answer = synthesis::synthesize(&file);
/// assert_eq!((answer.verdict.complex, answer.verdict.real), (4, 4));
/// # Ok::<(), looproot::internal::error::Error>(())
/// ```
#[must_use]
pub fn synthesize(file: &SynthesisFile) -> Answer {
    let (kind, positions) = match &file.task {
        Task::Motion(kind, positions) => (*kind, positions.clone()),
        Task::Function(pairs) => return function::synthesize(file, pairs),
        Task::Path(points) => return path::synthesize(file, points),
    };
    let wanted = Wanted { kind, space: file.space, positions, rates: Vec::new(), trivial: 0 };
    let mut answer = match kind {
        DyadKind::CC => lines::synthesize(file, &wanted),
        DyadKind::RR if file.space == Space::Space => skew::synthesize(file, &wanted),
        DyadKind::SS | DyadKind::PPS => match bilinear::solutions(&wanted) {
            Some(solutions) => found(file, &wanted, Found::certified(solutions), dyad::dyad),
            None => by_basis(file, &wanted, EFFORT),
        },
        _ => by_basis(file, &wanted, EFFORT),
    };
    answer.curves = curves::curves(&wanted);
    answer.warnings.extend(remarks::remarks(&wanted));
    answer
}

/// The dyads by a Gröbner basis of all their equations.
fn by_basis(file: &SynthesisFile, wanted: &Wanted, effort: u64) -> Answer {
    let equations = |place: &cells::Place<_>| wanted.equations(place);
    match solve(&wanted.shape(), &equations, effort) {
        Some(solutions) => found(file, wanted, solutions, dyad::dyad),
        None => undecided(),
    }
}
