//! Every row of docs/book.md is run as it stands: the exit code, the time and the answer.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The numbered sections of the book.
const SECTIONS: usize = 255;

/// The longest time of a row. Without optimisation the slowest one, 6.11, takes 54 s on two cores at 3 GHz; a busy machine takes
/// twice that. Optimized, the slowest one, 17.12, takes 7 s, and took 20.2 s beside two compilers and other tests.
fn limit() -> Duration {
    Duration::from_secs(if env!("OPT_LEVEL") == "0" { 120 } else { 40 })
}

/// A row of the table.
struct Row {
    number: String,
    status: String,
    command: String,
    answer: String,
    line: String,
}

fn rows() -> Vec<Row> {
    let page = std::fs::read_to_string(Path::new(crate::ROOT).join("docs/book.md")).unwrap();
    let is_row = |line: &&str| line.starts_with("| ") && line.as_bytes().get(2).is_some_and(u8::is_ascii_digit);
    page.lines()
        .filter(is_row)
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            let [number, _, status, command, answer] = cells[..] else { panic!("not five cells: {line}") };
            let own = |cell: &str| cell.to_owned();
            Row {
                number: own(number),
                status: own(status),
                command: own(command),
                answer: own(answer),
                line: own(line),
            }
        })
        .collect()
}

/// The words of a command line, in which quotation marks hold a word together.
fn words(command: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut is_quoted = false;
    for c in command.chars() {
        match c {
            '"' => is_quoted = !is_quoted,
            ' ' if !is_quoted => words.push(String::new()),
            _ => words.last_mut().unwrap().push(c),
        }
    }
    words.retain(|word| !word.is_empty());
    words
}

/// The text between backticks.
fn quoted(cell: &str) -> Option<&str> {
    cell.strip_prefix('`')?.strip_suffix('`')
}

#[test]
fn every_section_has_one_row() {
    let rows = rows();
    assert_eq!(rows.len(), SECTIONS);
    let numbers: BTreeSet<&str> = rows.iter().map(|row| row.number.as_str()).collect();
    assert_eq!(numbers.len(), SECTIONS);
    for row in &rows {
        match row.status.as_str() {
            "works" | "partly" => {
                assert!(quoted(&row.command).is_some_and(|command| command.starts_with("looproot ")), "{}", row.line);
                assert!(quoted(&row.answer).is_some_and(|answer| answer.len() > 3), "{}", row.line);
            }
            "no" => assert!(row.answer.len() > 10, "a reason: {}", row.line),
            other => panic!("the status {other}: {}", row.line),
        }
    }
}

/// Runs the rows whose place leaves this remainder.
fn run(share: usize, of: usize) {
    for row in rows().into_iter().skip(share).step_by(of) {
        let Some(command) = quoted(&row.command) else { continue };
        let words = words(command);
        let start = Instant::now();
        let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
            .args(&words[1..])
            .current_dir(crate::ROOT)
            .stdin(Stdio::null())
            .output()
            .unwrap();
        let taken = start.elapsed();
        assert!(taken <= limit(), "{taken:?}: {}", row.line);
        let code = output.status.code();
        let may_be_2 = row.line.contains("self-motion") || row.line.contains("probable");
        assert!(matches!(code, Some(0 | 3)) || (code == Some(2) && may_be_2), "exit {code:?}: {}", row.line);
        let text = String::from_utf8(output.stdout).unwrap();
        let answer = quoted(&row.answer).unwrap();
        assert!(
            text.contains(answer),
            "the answer is missing: {}\n{}",
            row.line,
            text.chars().take(2000).collect::<String>()
        );
    }
}

#[test]
fn the_first_share_of_commands_gives_the_answers() {
    run(0, 2);
}

#[test]
fn the_second_share_of_commands_gives_the_answers() {
    run(1, 2);
}
