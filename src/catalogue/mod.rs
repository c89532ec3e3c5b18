//! The library of mechanisms and the readers of mechanism files.

pub mod ansatz;
mod dh_table;
pub mod entry;
mod geometry;
mod job;
mod library;
mod node;
mod options;
mod platform;
mod scope;
mod source;
mod text;
mod urdf;

pub use library::{ansatz_names, builtin, builtin_names, builtin_text, citation};
pub use options::Options;
pub use source::{load, load_ansatz};
pub use text::{Format, ansatz_from_text, is_ansatz, load_text};
