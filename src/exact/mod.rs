//! The exact side: what the closure equations of a loop say over the rationals wherever f64 does not settle it.

mod eliminant;
mod incidence;
mod krawczyk;
mod missing;
mod multiplicity;
mod rank;
mod resolution;
mod roots;
mod tuples;
mod values;

pub use eliminant::{Eliminant, Way, eliminant, eliminant_by_ring, ways};
pub use incidence::{MOST_WITH_TRIPLE, has_triple};
pub use rank::general_rank;
pub use resolution::{Known, Resolution, Solution, resolve};
pub use roots::{Isolated, isolated_roots};
pub use values::{Pair, Value, values};
