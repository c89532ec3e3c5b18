//! The error bounds are bounds and the proofs are proofs, judged in 400 bits.
#![allow(clippy::unwrap_used)]

mod big;
mod double_double;
mod file_data;
mod proofs;
mod wide;
