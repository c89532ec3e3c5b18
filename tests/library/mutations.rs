//! The corpora of fuzz/ and changed copies of them through every reader: what is wrong is an error and never a panic.
#![allow(clippy::unwrap_used)]

#[path = "../../fuzz/readers.rs"]
mod readers;

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::fs;
use std::path::PathBuf;

/// Changed copies of each file; the fuzzer itself makes millions (CONTRIBUTING.md).
const COPIES: usize = 60;

/// Pieces of text that are hard for readers of files.
const PIECES: [&str; 24] = [
    "1e999999999",
    "1e-999999999",
    "-0",
    "nan",
    "inf",
    "1/0",
    "99999999999999999999999999",
    "\"",
    "'",
    "[",
    "]",
    "{",
    "}",
    "<",
    "/>",
    "=",
    ",",
    ";",
    "\n",
    "\u{feff}",
    "\0",
    "é",
    "pi",
    "deg",
];

/// One change: bytes left out, doubled or replaced by what readers stumble over.
fn changed(bytes: &[u8], random: &mut ChaCha8Rng) -> Vec<u8> {
    let from = random.random_range(0..=bytes.len());
    let to = (from + random.random_range(0..12)).min(bytes.len());
    let between: Vec<u8> = match random.random_range(0..4) {
        0 => Vec::new(),
        1 => [&bytes[from..to], &bytes[from..to]].concat(),
        2 => vec![random.random()],
        _ => PIECES[random.random_range(0..PIECES.len())].into(),
    };
    [&bytes[..from], &between, &bytes[to..]].concat()
}

fn panic_never(corpus: &str, read: fn(&[u8])) {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fuzz/corpus").join(corpus);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut files = 0;
    for file in fs::read_dir(folder).unwrap() {
        let own = fs::read(file.unwrap().path()).unwrap();
        read(&own);
        for _ in 0..COPIES {
            let mut copy = changed(&own, &mut random);
            read(&copy);
            copy = changed(&copy, &mut random);
            read(&copy);
        }
        files += 1;
    }
    assert!(files > 0, "{corpus} has no file");
}

#[test]
fn mechanism_files_are_read_or_refused() {
    panic_never("mechanism_toml", readers::mechanism_toml);
    panic_never("mechanism_json", readers::mechanism_json);
}

#[test]
fn tables_and_robot_descriptions_are_read_or_refused() {
    panic_never("dh_table", readers::dh_table);
    panic_never("robot_description", readers::robot_description);
    panic_never("pose_rows", readers::pose_rows);
}

#[test]
fn certificates_are_checked_or_refused() {
    panic_never("certificate", readers::certificate);
}

#[test]
fn polynomials_are_read_or_refused() {
    panic_never("polynomial", readers::polynomial);
}
