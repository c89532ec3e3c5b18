//! Lines and linear complexes: the questions of files of kind `lines`, answered with a verdict.
//!
//! All counts are decided over the rationals: ranks, and the sign of one discriminant.

mod complex;
mod cylindroid;
mod forces;
mod meeting;
mod planes;
mod regulus;
mod ruled;

use crate::catalogue::CalculusFile;
use crate::catalogue::calculus::Question;
use crate::catalogue::lines::Lines;
use crate::displacement::{self, Answer};
use crate::error::Result;
use crate::gearing;

/// The answers to a file of the calculus, one for each of its problems.
///
/// # Errors
/// As [`displacement::answers`].
///
/// # Example
/// ```
/// use looproot::internal::catalogue::{Any, Options, load_solvable};
/// let Any::Calculus(file) = load_solvable("lines/transversals", &Options::default())? else { panic!() };
/// assert_eq!(looproot::internal::lines::answers(&file)?[0].verdict.complex, 2);
/// # Ok::<(), looproot::internal::error::Error>(())
/// ```
pub fn answers(file: &CalculusFile) -> Result<Vec<Answer>> {
    let mut answers = match &file.question {
        Question::Displacement(question) => displacement::answers(question)?,
        Question::Lines(question) => vec![answer(question)],
        Question::Gearing(question) => vec![gearing::answer(question)],
    };
    for answer in &mut answers {
        answer.warnings.extend(file.warnings.iter().cloned());
    }
    Ok(answers.into_iter().map(|answer| answer.of_rounded(file.rounded)).collect())
}

/// The answer to a question.
#[must_use]
pub fn answer(question: &Lines) -> Answer {
    match question {
        Lines::Transversals(lines) => meeting::transversals(lines),
        Lines::Congruence(complexes) => meeting::congruence(complexes),
        Lines::Complex(lines, points) => complex::answer(lines, points),
        Lines::Cylindroid(screws) => cylindroid::answer(screws),
        Lines::Perpendicular([first, second]) => regulus::perpendicular(first, second),
        Lines::Regulus(lines) => regulus::answer(lines),
        Lines::Plane(points) => planes::plane(points),
        Lines::Planes(both) => planes::line(both),
        Lines::Polarity(question) => planes::polarity(question),
        Lines::Generator(both) => ruled::generator(both),
        Lines::Relative(both) => ruled::relative(both),
        Lines::Wrench(question) => forces::wrench(question),
        Lines::Reciprocal(screws) => forces::reciprocal(screws),
    }
}
