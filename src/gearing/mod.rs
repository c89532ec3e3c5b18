//! Gears and wheels: the questions of files of kind `gearing`, answered with a verdict.
//!
//! Trains and wheels are linear and decided over the rationals, and so are trochoids. Involute gears are computed in enclosures of many digits.

mod crossed;
mod involute;
mod train;
mod trochoid;
mod wheels;

use crate::catalogue::gearing::Gearing;
use crate::displacement::Answer;

/// The answer to a question.
#[must_use]
pub fn answer(question: &Gearing) -> Answer {
    match question {
        Gearing::Train(train) => train::answer(train),
        Gearing::Wheels { wheels, twist } => wheels::answer(wheels, twist.as_ref()),
        Gearing::Pair(pair) => involute::pair(pair),
        Gearing::Crossed(crossed) => crossed::answer(crossed),
        Gearing::Involute(radius, roll) => involute::curve(radius, roll),
        Gearing::Trochoid(rolling) => trochoid::answer(rolling),
    }
}
