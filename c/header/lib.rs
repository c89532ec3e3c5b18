//! Tests of what is written about the library for C: its header and its page.

#[cfg(test)]
mod tests;
