//! Every claim of every built-in entry, and what the library promises as a whole.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Options, builtin, builtin_names, citation};
use looproot::internal::claims::judge;

#[test]
fn every_claim_of_the_library_holds() {
    let mut failures = Vec::new();
    let mut claims = 0;
    for name in builtin_names() {
        let judgement = judge(&builtin(&name, &Options::default()).unwrap()).unwrap();
        claims += judgement.findings.len();
        failures.extend(judgement.failures().map(|failure| format!("{name}:{}: {}", failure.line, failure.message)));
    }
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
    assert!(claims > 1000, "only {claims} claims");
}

#[test]
fn every_entry_has_a_source_and_a_case() {
    let names = builtin_names();
    assert!(names.len() >= 25);
    for name in names {
        let entry = builtin(&name, &Options::default()).unwrap();
        let source = entry.source.unwrap_or_else(|| panic!("{name} has no source"));
        assert!(citation(&source.key).is_some(), "{name}: {}", source.key);
        assert!(!entry.cases.is_empty(), "{name}");
    }
}

#[test]
fn no_two_entries_share_a_name() {
    let names = builtin_names();
    let mut short: Vec<&str> = names.iter().filter_map(|name| name.rsplit('/').next()).collect();
    short.sort_unstable();
    let all = short.len();
    short.dedup();
    assert_eq!(short.len(), all, "entries are found without their folder");
}
