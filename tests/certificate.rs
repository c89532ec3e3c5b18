//! The error bounds are bounds and the proofs are proofs, judged in 400 bits.
#![allow(clippy::unwrap_used)]

mod arms;

#[path = "certificate/big.rs"]
mod big;
#[path = "certificate/double_double.rs"]
mod double_double;
#[path = "certificate/file_data.rs"]
mod file_data;
#[path = "certificate/proofs.rs"]
mod proofs;
#[path = "certificate/wide.rs"]
mod wide;
