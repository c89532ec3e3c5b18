//! What must not change: closures are exact over the rationals however a mechanism is written, and moving, reversing,
//! rotating, scaling or rewriting a mechanism changes no answer.
#![allow(clippy::unwrap_used)]

mod arms;

#[path = "metamorphic/answers.rs"]
mod answers;
#[path = "metamorphic/equations.rs"]
mod equations;
#[path = "metamorphic/platforms.rs"]
mod platforms;
