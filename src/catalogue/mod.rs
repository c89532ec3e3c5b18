//! The library of mechanisms and the readers of mechanism files.

pub mod ansatz;
mod dh_table;
pub mod entry;
mod file_kind;
mod framework;
mod geometry;
mod heading;
mod job;
mod library;
mod motion;
mod node;
mod options;
mod platform;
mod scope;
mod source;
mod text;
mod urdf;

pub use file_kind::FileKind;
pub use framework::FrameworkFile;
pub use heading::Heading;
pub use library::{
    all_names, ansatz_names, builtin, builtin_any, builtin_names, builtin_page, builtin_text, citation, moving_names,
    namesakes,
};
pub use motion::MotionFile;
pub use options::{Chains, Options};
pub use source::{load, load_ansatz, load_any};
pub use text::{Any, Format, ansatz_from_text, any_from_text, is_ansatz, load_text};
