//! Eliminations of one mechanism by several ways: the same closure polynomial over the rationals, or a refusal that says why.
#![allow(clippy::unwrap_used)]

use looproot::internal::benchmark::sample::{CHAINS, Set, rational_sample};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load, load_text};
use looproot::internal::derivation::{ByWay, Way, derive_by};
use looproot::internal::error::Error;
use std::collections::BTreeSet;

fn by(entry: &Entry, way: Way) -> Result<ByWay, Error> {
    derive_by(entry, &entry.cases[0], way)
}

/// The ways that apply to a mechanism; each compares its eliminant with the closure polynomial over the rationals and fails where
/// they differ. Returns the sizes of their matrices.
fn agreeing(entry: &Entry) -> Vec<(&'static str, [usize; 2])> {
    let mut found = Vec::new();
    for (name, way) in Way::NAMED {
        match by(entry, way) {
            Ok(by) => {
                let polynomial = by.derivation.polynomial.as_ref().unwrap();
                assert!(by.before >= polynomial.degree(), "{name}");
                let divided: usize = by.divided.iter().map(degree).sum();
                assert_eq!(by.before, polynomial.degree() + divided, "{name}: {:?}", by.divided);
                found.push((name, [by.matrix.rows, by.matrix.columns]));
            }
            Err(Error::Unsupported(message)) => assert!(message.starts_with(&format!("--by {name} ")), "{message}"),
            Err(error) => panic!("{name}: {error}"),
        }
    }
    found
}

fn degree(one: &looproot::internal::derivation::Removed) -> usize {
    one.factor.as_ref().map_or(0, |factor| usize::try_from(factor.total_degree().unwrap_or(0)).unwrap())
        * one.multiplicity
}

#[test]
fn ways_have_matrices_of_their_own() {
    let entry = |name: &str| load(name, &Options::default()).unwrap();
    let general = agreeing(&entry("general_7r"));
    let sizes: BTreeSet<[usize; 2]> = general.iter().map(|(_, size)| *size).collect();
    assert_eq!(
        general.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
        ["woernle-lee", "half-angle", "study", "raghavan-roth"]
    );
    assert!(sizes.contains(&[8, 8]) && sizes.contains(&[12, 12]), "{sizes:?}");
    let transferred = agreeing(&entry("cccr_4_angle"));
    assert!(transferred.iter().any(|(name, _)| *name == "dual"), "{transferred:?}");
    for name in ["rsrc", "crcrr_2_angle", "crcrr_4_angle"] {
        assert!(agreeing(&entry(name)).len() >= 2, "{name}");
    }
}

#[test]
fn ways_that_do_not_apply_say_why() {
    let rssr = load("rssr", &Options::default()).unwrap();
    let message = by(&rssr, Way::Study).unwrap_err().to_string();
    assert!(message.contains("two spherical joints"), "{message}");
    let general = load("general_7r", &Options::default()).unwrap();
    let message = by(&general, Way::Dual).unwrap_err().to_string();
    assert!(message.contains("real angle"), "{message}");
}

/// The minors of the four equations have a factor in common here, and those of combinations of the equations have none.
#[test]
fn half_angle_tangents_serve_where_two_minors_have_a_common_factor() {
    let text = r#"
title = "CRRRRR"
[mechanism]
kind = "loop"
convention = "dh"
joints = [
    { type = "C", a = "-1", tan_half_alpha = "1" },
    { type = "R", a = "-1/2", tan_half_alpha = "-5/2", d = "4" },
    { type = "R", a = "-1", tan_half_alpha = "-1/2", d = "-2/3" },
    { type = "R", a = "-5/3", tan_half_alpha = "1", d = "-2/3" },
    { type = "R", a = "2/3", tan_half_alpha = "3", d = "4/3" },
    { type = "R", a = "-5/2", tan_half_alpha = "-1/2", d = "5" },
]
[[input]]
joint = 3
tan_half = "-3/2"
"#;
    let entry = load_text(text, "loop.toml", Format::Toml, &Options::default()).unwrap();
    let found = by(&entry, Way::HalfAngle).unwrap();
    assert_eq!((found.before, found.derivation.polynomial.unwrap().degree()), (32, 16));
}

/// Random loops of every sequence of unknowns that `bench accuracy --set loops` has.
fn random(count: u64) {
    let mut applied = 0;
    for index in 0..count {
        let sample =
            rational_sample(Set::Chain((usize::try_from(index).unwrap() * 7) % CHAINS.len()), 19, index).unwrap();
        applied += agreeing(&sample.entry).len();
    }
    println!("{applied} eliminations of {count} loops agree");
    assert!(applied as u64 >= 2 * count, "{applied}");
}

#[test]
fn ways_agree_on_a_few_random_loops() {
    random(3);
}

#[test]
fn ways_agree_on_fifty_random_loops() {
    random(50);
}
