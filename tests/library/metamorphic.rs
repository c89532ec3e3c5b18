//! Invariants: closures are exact over the rationals however a mechanism is written, and moving, reversing, rotating, scaling or
//! rewriting a mechanism changes no answer.
#![allow(clippy::unwrap_used)]

mod answers;
mod equations;
mod platforms;
