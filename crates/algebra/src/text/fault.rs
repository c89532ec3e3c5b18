//! A fault of a text, with its place.

use crate::error::Error;

/// A place in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The line, from 1.
    pub line: usize,
    /// The column, from 1, in bytes.
    pub column: usize,
}

/// A message that states what was found and what was expected, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The place in the text.
    pub place: Place,
    /// The message.
    pub message: String,
}

impl Fault {
    pub(super) const fn new(place: Place, message: String) -> Self {
        Self { place, message }
    }

    /// Returns the fault of a file.
    #[must_use]
    pub fn in_file(self, path: &str) -> Error {
        let message = format!("column {}: {}", self.place.column, self.message);
        Error::File { path: path.to_owned(), line: self.place.line, message }
    }

    /// Returns the fault of a text that stands in no file, such as an argument of a command line.
    #[must_use]
    pub fn in_text(self, text: &str) -> Error {
        let Place { line, column } = self.place;
        let place =
            if text.contains('\n') { format!("line {line}, column {column}") } else { format!("column {column}") };
        Error::Invalid(format!("`{}`, {place}: {}", shortened(text.trim()), self.message))
    }
}

/// Returns the text, cut to a readable length.
pub(super) fn shortened(text: &str) -> String {
    if text.chars().count() <= 40 {
        return text.to_owned();
    }
    let head: String = text.chars().take(37).collect();
    format!("{head}...")
}
