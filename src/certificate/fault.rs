//! The faults of certificates.

use std::fmt;

/// The fault of a certificate.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// It cannot be read.
    Unreadable(String),
    /// An item, which the text names, does not hold.
    Refused(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unreadable(message) => write!(f, "{message}"),
            Self::Refused(message) => write!(f, "refused: {message}"),
        }
    }
}

pub(super) fn unreadable<T>(message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Unreadable(message.into()))
}

pub(super) fn refused<T>(message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::Refused(message.into()))
}

/// Returns the first characters of the text found.
pub(super) fn shortened(found: &impl ToString) -> String {
    found.to_string().chars().take(60).collect()
}
