//! Lines in space by Pluecker vectors, linear complexes of lines, congruences and reguli.
//!
//! A line is its direction d and its moment m = p x d, or one dual vector d + eps m. The products of dual vectors are those of
//! lines.

pub mod complex;
pub mod pencil;
pub mod plane;
pub mod pluecker;
pub mod regulus;
pub mod ruled;
pub mod strip;
