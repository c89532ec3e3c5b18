#![no_main]

#[path = "../readers.rs"]
#[allow(dead_code, reason = "every target takes one reader")]
mod readers;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| readers::mechanism_json(bytes));
