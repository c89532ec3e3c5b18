//! The one error of this crate, for text or data that cannot be read: it states what was found and what was expected.

use thiserror::Error;

/// Shorthand for a result with this crate's [`enum@Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// The reason why text or data could not be read.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A part of a file cannot be read.
    #[error("{path}:{line}: {message}")]
    File {
        /// The file as it was named.
        path: String,
        /// Line of the fault, from 1.
        line: usize,
        /// The text found and the text expected.
        message: String,
    },
    /// A file has the wrong form, at no line in particular.
    #[error("{path}: {message}")]
    Io {
        /// The file as it was named.
        path: String,
        /// The text found and the text expected.
        message: String,
    },
    /// A value cannot be used: the text states what was found and what was expected.
    #[error("{0}")]
    Invalid(String),
}
