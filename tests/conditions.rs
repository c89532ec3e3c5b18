//! Conditions of mobility: files with symbols, the 4R loop, what is proved of it.
#![allow(clippy::unwrap_used)]

#[path = "conditions/ansatz.rs"]
mod ansatz;
