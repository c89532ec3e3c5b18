//! The library of mechanisms and the readers of mechanism files.

mod dh_table;
pub mod entry;
mod geometry;
mod job;
mod library;
mod node;
mod scope;
mod source;
mod urdf;

pub use library::{builtin, builtin_names, builtin_text, citation};
pub use source::{Format, Options, load, load_text};
