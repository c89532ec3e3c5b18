//! The library of mechanisms and the readers of mechanism files.

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

pub use library::{builtin, builtin_names, builtin_text, citation};
pub use options::Options;
pub use source::load;
pub use text::{Format, load_text};
