//! Files for the answers to many poses: arrays of numpy, or a table of Arrow.

#[cfg(not(target_family = "wasm"))]
use super::arrow_table::ArrowTable;
use super::npz::Arrays;
use looproot::internal::error::Error;
use looproot::internal::mechanism::Solution;
use std::path::Path;

/// A file that is written as the answers come.
pub enum AnswerFile {
    /// Arrays of numpy.
    Npz(Arrays),
    /// A table of Arrow.
    #[cfg(not(target_family = "wasm"))]
    Arrow(Box<ArrowTable>),
}

impl AnswerFile {
    /// Says whether the name of an output is that of such a file.
    #[must_use]
    pub fn is_named(path: &Path) -> bool {
        has_extension(path, "npz") || is_arrow(path)
    }

    /// Begins the file of an arm whose joint variables have these names.
    pub fn create(path: &Path, names: &[String], has_limits: bool) -> Result<Self, Error> {
        #[cfg(not(target_family = "wasm"))]
        if is_arrow(path) {
            return Ok(Self::Arrow(Box::new(ArrowTable::create(path, names)?)));
        }
        Arrays::create(path, names, has_limits).map(Self::Npz)
    }

    /// Adds the answer to the next pose: its real solutions.
    pub fn add(&mut self, solution: &Solution) -> Result<(), Error> {
        match self {
            Self::Npz(arrays) => arrays.add(solution),
            #[cfg(not(target_family = "wasm"))]
            Self::Arrow(table) => table.add(solution),
        }
    }

    /// Adds a row that is no pose.
    pub fn refuse(&mut self, message: &str) -> Result<(), Error> {
        match self {
            Self::Npz(arrays) => arrays.refuse(message),
            #[cfg(not(target_family = "wasm"))]
            Self::Arrow(table) => table.refuse(message),
        }
    }

    /// Ends the file.
    pub fn close(self) -> Result<(), Error> {
        match self {
            Self::Npz(arrays) => arrays.close(),
            #[cfg(not(target_family = "wasm"))]
            Self::Arrow(table) => table.close(),
        }
    }
}

fn has_extension(path: &Path, wanted: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(wanted))
}

/// Says whether the name is that of a table of Arrow, which a browser has no use for.
fn is_arrow(path: &Path) -> bool {
    cfg!(not(target_family = "wasm")) && has_extension(path, "arrow")
}
