//! The one error of the crate: what cannot go on, with the numbers in the message.
//!
//! Mathematical outcomes (unreachable pose, self-motion) are values and never errors.

use looproot_algebra as algebra;
use thiserror::Error;

/// Shorthand for a result with this crate's [`enum@Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// Why something could not be done.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[non_exhaustive]
pub enum Error {
    /// A file says something that cannot be read: what was found and what was expected.
    #[error("{path}:{line}: {message}")]
    File {
        /// The file as it was named.
        path: String,
        /// Line of the fault, from 1.
        line: usize,
        /// The value found and the value expected.
        message: String,
    },
    /// A file could not be read or written at all.
    #[error("{path}: {message}")]
    Io {
        /// The file as it was named.
        path: String,
        /// The message of the system or the reader.
        message: String,
    },
    /// Neither a file nor an entry of the built-in library.
    #[error("`{name}` is neither a file nor a built-in entry{}", did_you_mean(near))]
    UnknownEntry {
        /// The name asked for.
        name: String,
        /// Names of the library that resemble it.
        near: Vec<String>,
    },
    /// A value that cannot be used: what was found and what was expected.
    #[error("{0}")]
    Invalid(String),
    /// Well-formed, but beyond what is implemented.
    #[error("unsupported: {0}")]
    Unsupported(String),
    /// A chain of joints beyond what is implemented. The message names its mobility.
    #[error("unsupported: {0}")]
    UnsupportedMobility(String),
}

impl From<algebra::error::Error> for Error {
    fn from(error: algebra::error::Error) -> Self {
        match error {
            algebra::error::Error::File { path, line, message } => Self::File { path, line, message },
            algebra::error::Error::Io { path, message } => Self::Io { path, message },
            algebra::error::Error::Invalid(message) => Self::Invalid(message),
            other => Self::Invalid(other.to_string()),
        }
    }
}

impl Error {
    /// Names the option of the command line whose value is wrong, unless the message names it.
    #[must_use]
    pub fn of_option(self, option: &str) -> Self {
        match self {
            Self::Invalid(message) if !message.contains(option) => Self::Invalid(format!("{option}: {message}")),
            other => other,
        }
    }

    /// Places the error in a file: an [`Error::Invalid`] becomes an [`Error::File`]; an unsupported feature only gains the place,
    /// and others stay as they are.
    #[must_use]
    pub fn at(self, path: &str, line: usize) -> Self {
        match self {
            Self::Invalid(message) => Self::File { path: path.to_owned(), line, message },
            Self::Unsupported(message) => Self::Unsupported(format!("{path}:{line}: {message}")),
            Self::UnsupportedMobility(message) => Self::UnsupportedMobility(format!("{path}:{line}: {message}")),
            other => other,
        }
    }

    /// The exit code of the program: 4 for what is unsupported, 1 for every other error.
    #[must_use]
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unsupported(_) | Self::UnsupportedMobility(_) => 4,
            Self::File { .. } | Self::Io { .. } | Self::UnknownEntry { .. } | Self::Invalid(_) => 1,
        }
    }

    /// Returns the unsupported feature; `None` for any other error.
    #[must_use]
    pub fn unsupported(&self) -> Option<&str> {
        match self {
            Self::Unsupported(message) | Self::UnsupportedMobility(message) => Some(message),
            Self::File { .. } | Self::Io { .. } | Self::UnknownEntry { .. } | Self::Invalid(_) => None,
        }
    }
}

/// `; did you mean ...?`, empty without suggestions.
fn did_you_mean(near: &[String]) -> String {
    if near.is_empty() {
        return String::new();
    }
    let mut quoted: Vec<String> = near.iter().map(|name| format!("`{name}`")).collect();
    // Entries of different folders may have one name.
    quoted.dedup();
    format!("; did you mean {}?", quoted.join(" or "))
}
