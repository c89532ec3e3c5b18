//! The result of a function of the library, and its message.

use looproot::internal::error::Error;
use std::any::Any;
use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// The status that a function returns. The first five are the exit codes of the command line.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LrStatus {
    /// Answered and proved.
    Ok = 0,
    /// A bad argument: NULL, a number that is not finite, a matrix that is no pose, a file that cannot be read.
    Invalid = 1,
    /// Answered, but not proved complete, or the solutions form curves.
    NotProved = 2,
    /// No real solution, and that is proved.
    Unreachable = 3,
    /// A mechanism beyond what is implemented.
    Unsupported = 4,
    /// The buffer is too small: it is full, and the count is the number of all solutions.
    Truncated = 5,
    /// A fault of the library: please report it.
    Panic = 6,
}

/// Why a function has no answer.
pub enum Fault {
    /// A pointer that must not be NULL.
    Null(&'static str),
    /// Anything else.
    Error(Error),
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl Fault {
    /// A bad argument.
    pub fn invalid(message: String) -> Self {
        Self::Error(Error::Invalid(message))
    }

    fn status(&self) -> LrStatus {
        match self {
            Self::Error(Error::Unsupported(_) | Error::UnsupportedMobility(_)) => LrStatus::Unsupported,
            Self::Null(_) | Self::Error(_) => LrStatus::Invalid,
        }
    }

    fn text(&self) -> String {
        match self {
            Self::Null(name) => format!("found NULL as {name}, expected a pointer"),
            Self::Error(error) => error.to_string(),
        }
    }
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Keeps what was said last on this thread. A zero byte within it ends it.
pub fn say(text: &str) {
    let until_zero = text.split('\0').next().unwrap_or_default();
    let message = CString::new(until_zero).unwrap_or_default();
    // Nothing holds the cell while this runs; at the end of a thread there is none left to write to.
    let _ = MESSAGE.try_with(|cell| cell.replace(message));
}

/// Returns the last message on this thread.
pub fn said() -> *const c_char {
    const NOTHING: &CStr = c"";
    MESSAGE.try_with(|cell| cell.borrow().as_ptr()).unwrap_or(NOTHING.as_ptr())
}

/// Runs it; faults and panics become a status with a message.
pub fn guarded(run: impl FnOnce() -> Result<LrStatus, Fault>) -> LrStatus {
    match catch_unwind(AssertUnwindSafe(run)) {
        Ok(Ok(status)) => status,
        Ok(Err(fault)) => {
            say(&fault.text());
            fault.status()
        }
        Err(panic) => {
            say(&panic_text(panic.as_ref()));
            LrStatus::Panic
        }
    }
}

fn panic_text(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
    format!("looproot panicked: {}", text.unwrap_or("without a message"))
}
