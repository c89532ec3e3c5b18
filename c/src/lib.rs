//! looproot for C and C++: the functions of `include/looproot.h`.
//!
//! Pointers are turned into slices and values in [`border`] alone; everything else is safe.

mod answer;
pub mod border;
mod fault;
