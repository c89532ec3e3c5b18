//! A further command in the process of an earlier one, which a page in a browser asks for.
#![cfg(target_family = "wasm")]

/// Runs the command whose arguments the system now gives, and returns its exit code. What was read and prepared for an earlier command
/// need not be done again. `main` has to end first.
#[allow(unsafe_code, reason = "the page finds the function by its name, which must be that of no other one")]
#[unsafe(no_mangle)]
pub extern "C" fn again() -> i32 {
    crate::run().code().into()
}
