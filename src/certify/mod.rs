//! Proof: of each mode, and of the list.

pub mod mode;
pub mod verdict;
