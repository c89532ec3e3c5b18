//! Errors as exceptions. No panic leaves this crate as one.

use looproot::internal::error::Error;
use pyo3::create_exception;
use pyo3::exceptions::{PyException, PyKeyError, PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::panic::{AssertUnwindSafe, catch_unwind};

create_exception!(looproot, UnsupportedError, PyException, "A mechanism beyond what is implemented.");
create_exception!(looproot, InternalError, PyRuntimeError, "What should not happen: please report it.");

/// The exception of an error.
pub fn exception(error: Error) -> PyErr {
    let text = error.to_string();
    match error {
        Error::Unsupported(_) | Error::UnsupportedMobility(_) => UnsupportedError::new_err(text),
        Error::UnknownEntry { .. } => PyKeyError::new_err(text),
        Error::Io { .. } => PyOSError::new_err(text),
        _ => PyValueError::new_err(text),
    }
}

/// The text of a panic.
pub fn panic_text(panic: &(dyn std::any::Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("looproot panicked: {}", text.unwrap_or("without a message"))
}

/// Runs it; an error becomes its exception, a panic an internal error.
pub fn guarded<T>(run: impl FnOnce() -> Result<T, Error>) -> PyResult<T> {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(answer) => answer.map_err(exception),
        Err(panic) => Err(InternalError::new_err(panic_text(panic.as_ref()))),
    }
}
