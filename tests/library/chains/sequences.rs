//! Loops of any sequence of joints R, P, C and S, read from their files: an answer or a message of use, never a panic.

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::derivation::{derive, derive_symbolic};
use looproot::internal::error::Error;
use looproot::internal::mechanism::{Mechanism, Solution};
use proptest::prelude::*;

/// A joint: its letter, its link and the constants of its own.
fn joint() -> impl Strategy<Value = (char, String)> {
    let letter = prop::sample::select(vec!['R', 'R', 'P', 'C', 'S']);
    let twist = prop::sample::select(vec!["0", "1", "-1", "inf", "1/2", "-2/3", "3/4", "5/7"]);
    let length = || prop::sample::select(vec!["0", "0", "1", "2", "-3/2", "7/5"]);
    (letter, twist, length(), length(), prop::sample::select(vec!["0", "1", "1/3", "-4/5"])).prop_map(
        |(letter, twist, a, d, angle)| {
            let own = match letter {
                'P' => format!("d0 = \"{d}\", tan_half_theta = \"{angle}\""),
                'C' => format!("d0 = \"{d}\""),
                _ => format!("d = \"{d}\""),
            };
            (letter, format!("{{ type = \"{letter}\", a = \"{a}\", tan_half_alpha = \"{twist}\", {own} }},\n"))
        },
    )
}

/// A file of a loop of one to seven joints, mostly with an input that one of them has.
fn file() -> impl Strategy<Value = (String, String)> {
    let value = prop::sample::select(vec!["0", "1/2", "-3", "inf"]);
    (prop::collection::vec(joint(), 1..=7), 0..9_usize, any::<bool>(), value).prop_map(
        |(joints, given, angle, value)| {
            let letters: String = joints.iter().map(|(letter, _)| *letter).collect();
            let joints: String = joints.into_iter().map(|(_, text)| text).collect();
            let kind = letters.chars().nth(given.saturating_sub(1));
            let input = match (given, kind) {
                // Sometimes none, sometimes one that does not fit.
                (0, _) => String::new(),
                (_, Some('P')) if value != "inf" => format!("[[input]]\njoint = {given}\ndistance = \"{value}\"\n"),
                (_, Some('C')) if !angle && value != "inf" => {
                    format!("[[input]]\njoint = {given}\ndistance = \"{value}\"\n")
                }
                _ => format!("[[input]]\njoint = {given}\ntan_half = \"{value}\"\n"),
            };
            let head = "title = \"any\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n";
            (letters, format!("{head}{joints}]\n{input}"))
        },
    )
}

fn solved(entry: &Entry) -> Result<Solution, Error> {
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    Mechanism::prepare(entry)?.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly)
}

/// Asserts that a refusal gives its reason: a place in the file, or the mobility and the kinds that are solved.
fn assert_of_use(letters: &str, error: &Error) {
    let message = error.to_string();
    match error {
        Error::File { .. } => {
            assert!(message.contains("found") && message.contains("expected"), "{letters}: {message}");
        }
        Error::Unsupported(_) | Error::UnsupportedMobility(_) => {
            let words = ["mobility", "too large for symbols", "rotations", "parallel", "symbols", "S joint"];
            assert!(words.iter().any(|word| message.contains(word)), "{letters}: {message}");
        }
        _ => panic!("{letters}: {message}"),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 384, ..ProptestConfig::default() })]

    #[test]
    fn every_sequence_has_an_answer_or_a_message((letters, text) in file()) {
        let entry = match load_text(&text, "any.toml", Format::Toml, &Options::default()) {
            Err(error) => {
                assert_of_use(&letters, &error);
                return Ok(());
            }
            Ok(entry) => entry,
        };
        match solved(&entry) {
            Ok(solution) => {
                let verdict = &solution.verdict;
                prop_assert!(!verdict.reason.is_empty());
                prop_assert!(verdict.real <= verdict.complex || verdict.self_motion > 0, "{} {:?}", letters, verdict);
                for mode in solution.modes.iter().filter(|mode| mode.certified) {
                    prop_assert!(mode.residual < 1e-8, "{}: {:e}", letters, mode.residual);
                }
            }
            Err(error) => assert_of_use(&letters, &error),
        }
        match derive(&entry, &entry.cases[0]) {
            // The solutions in floating point satisfy every equation that is derived exactly.
            Ok(derivation) => {
                let found = derivation.substituted(&entry, &entry.cases[0]);
                prop_assert!(found.is_ok(), "{}\n{}\n{:?}", letters, text, found);
            }
            Err(error) => assert_of_use(&letters, &error),
        }
    }

    /// Two symbols are used, for speed.
    #[test]
    fn symbols_are_derived_or_refused((letters, text) in file()) {
        let Ok(entry) = load_text(&text, "any.toml", Format::Toml, &Options::default()) else { return Ok(()) };
        match derive_symbolic(&entry, &entry.cases[0], &["a1".to_owned(), "alpha1".to_owned()]) {
            Ok(derivation) => {
                let found = derivation.substituted(&entry, &entry.cases[0]);
                prop_assert!(found.is_ok(), "{}\n{}\n{:?}", letters, text, found);
            }
            Err(error) => assert_of_use(&letters, &error),
        }
    }
}

/// In half-angle tangents this equation is `1 = 0`: both roots are at infinity, and there the tangents say nothing.
#[test]
fn equations_without_finite_roots_hold_where_the_angle_is_pi() {
    let text = r#"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "R", a = 1, tan_half_alpha = 0, d = 0 },
            { type = "S", a = 0, tan_half_alpha = 0, d = 1 },
            { type = "S", a = 2, tan_half_alpha = 0, d = 0 },
        ]
    "#;
    let entry = load_text(text, "any.toml", Format::Toml, &Options::default()).unwrap();
    let derivation = derive(&entry, &entry.cases[0]).unwrap();
    let found = derivation.substituted(&entry, &entry.cases[0]).unwrap();
    // Only the form in the cosine has a value.
    assert_eq!((found.solutions, found.values), (1, 1));
    assert!(found.largest < 1e-12, "{:e}", found.largest);
}

/// Behind a twist of pi a translation runs against the axis of the rotation before it.
#[test]
fn translations_behind_a_twist_of_pi_have_their_sign() {
    let text = r#"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "C", a = 0, tan_half_alpha = 1, d0 = 0 },
            { type = "R", a = 0, tan_half_alpha = "inf", d = 0 },
            { type = "P", a = 0, tan_half_alpha = 0, d0 = 0, tan_half_theta = 0 },
            { type = "R", a = 0, tan_half_alpha = "1/2", d = 0 },
            { type = "C", a = 1, tan_half_alpha = 1, d0 = 0 },
        ]
        [[input]]
        joint = 4
        tan_half = 0
    "#;
    let entry = load_text(text, "any.toml", Format::Toml, &Options::default()).unwrap();
    let derivation = derive_symbolic(&entry, &entry.cases[0], &["a1".to_owned(), "alpha1".to_owned()]).unwrap();
    assert_eq!(derivation.translations.len(), 3);
    let found = derivation.substituted(&entry, &entry.cases[0]).unwrap();
    assert_eq!((found.solutions, found.values), (2, 22));
}

/// The translations lie in a plane wherever the rotations close: the polynomial of the numbers has lost its roots.
#[test]
fn roots_lost_at_the_numbers_are_no_fault_of_the_symbols() {
    let text = r#"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "R", a = 0, tan_half_alpha = 0, d = 0 },
            { type = "P", a = 0, tan_half_alpha = 0, d0 = 0, tan_half_theta = 0 },
            { type = "P", a = 0, tan_half_alpha = 1, d0 = 0, tan_half_theta = 0 },
            { type = "C", a = 0, tan_half_alpha = 1, d0 = 0 },
            { type = "R", a = 0, tan_half_alpha = 1, d = 1 },
        ]
    "#;
    let entry = load_text(text, "any.toml", Format::Toml, &Options::default()).unwrap();
    let exact = derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap();
    assert_eq!(exact.degree(), 0);
    let symbolic = derive_symbolic(&entry, &entry.cases[0], &["a1".to_owned(), "alpha1".to_owned()]).unwrap();
    assert!(symbolic.polynomial.is_some());
}
