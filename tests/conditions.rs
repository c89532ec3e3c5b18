//! Conditions of mobility: files with symbols, the 4R loop, what is proved of it, the verb.
#![allow(clippy::unwrap_used)]

#[path = "conditions/ansatz.rs"]
mod ansatz;
#[path = "conditions/four_bar.rs"]
mod four_bar;
#[path = "conditions/transference.rs"]
mod transference;
#[path = "conditions/verb.rs"]
mod verb;
