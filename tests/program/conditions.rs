//! Conditions of mobility: files with symbols, the 4R loop, what is proved of it, the verb.
#![allow(clippy::unwrap_used)]

mod ansatz;
mod four_bar;
mod transference;
mod verb;
