//! The quotient algebra of a Stewart platform, of dimension 40: three multiplication matrices, degree by degree.
//!
//! The unknowns are the rotation `z` in the chart `z0 = 1`, and `tau_1, tau_2, ...`, which measure where in the kernel of
//! the legs' matrix K (and in its nearly singular directions) the vector `u = (p.p, p, R^T p)` lies. The algebra is
//! filtered by the degree, `z` of degree 1 and `tau` of degree 2; its levels have 1, 3, 7, 9, 9, 7, 3, 1 basis elements.
//! The basis of a level consists of the products of `z` with the level below, reduced by the relations of that degree.
//!
//! One code runs over f64, where every step is orthogonal, over numbers of 384 bits, and modulo one prime or four.

mod arithmetic;
mod basis;
mod directions;
mod echelon;
mod orthogonal;
mod pivoted;
mod setting;
mod side_by_side;

pub use arithmetic::{Arithmetic, LongReals, Reals, Relations, Split};
pub use basis::{BorderBasis, DIMENSION, LEVELS, LostRank};
pub use directions::{Directions, MOST_DIRECTIONS, exact_directions, weak_directions};
pub use setting::Setting;
pub use side_by_side::{Residues, SIDE, SideBySide};
