//! What the library of mechanisms promises as a whole. Its claims are judged by `looproot check equations/`, a step of `./check`.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Options, builtin, builtin_names, citation};

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
