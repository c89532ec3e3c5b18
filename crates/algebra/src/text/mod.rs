//! Polynomials as text: read with positions in every complaint, and written for people and for other programs.
//!
//! Reading goes in two steps. [`Expression::parse`] turns text into a tree, in which sums of plain terms are already
//! flat lists; [`Expression::expand`] multiplies it out over the integers, with one common denominator, and
//! [`Expression::evaluate`] computes its value in any ring without multiplying out. [`read_polynomial`] does both steps, and in one
//! where it can.

mod document;
mod expand;
mod export;
mod expression;
mod fault;
mod format;
mod fraction;
mod names;
mod notation;
mod parser;
mod plain;
mod rename;
mod scanner;
mod terms;

pub use document::{read_json, write_json};
pub use expression::Expression;
pub use fault::{Fault, Place};
pub use format::Format;
pub use fraction::Fraction;
pub use names::Names;
pub use plain::read_polynomial;
pub use scanner::{read_fraction, read_number};
