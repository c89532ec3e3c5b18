//! Pages: what a document of `solve`, `sweep`, `mobility` or `bench` says, drawn. One file that needs nothing else.
//!
//! The page is written from the document alone, so that a saved result gives the same page as a fresh one.

mod dials;
mod encode;
mod live;
pub mod map;
mod mechanism;
mod page;
mod panels;
mod saved;
mod scores;
mod stick;
mod table;
mod tracks;
mod words;

pub use live::{Live, Program};
pub use page::{live_page, page, parts};
pub use saved::{drawable, parse};
pub use scores::is_scores;
pub use stick::figures;
