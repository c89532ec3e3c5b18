//! The reader of loops with symbols.

use looproot::internal::catalogue::ansatz::Ansatz;
use looproot::internal::catalogue::{Format, Options, ansatz_from_text, ansatz_names, load_ansatz};
use looproot::internal::error::Error;
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::ring::{Field, Ring};
use rug::Rational;

/// A loop of four joints with these symbols, first joint and relations.
fn file(symbols: &str, joint: &str, relations: &str) -> String {
    format!(
        "[symbols]\n{symbols}\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joint},\n\
         {{ type = \"R\", a = 1, alpha = \"pi/2\", d = 0 }},\n{{ type = \"R\", a = 1, alpha = \"pi/2\", d = 0 }},\n\
         {{ type = \"R\", a = 1, alpha = \"pi/2\", d = 0 }},\n]\n[ansatz]\nrelations = [{relations}]\n"
    )
}

const SYMBOLS: &str = "angles = [\"u\", \"v\"]\nlengths = [\"a\", \"b\", \"c'\"]";
const JOINT: &str = "{ type = \"R\", a = \"a\", alpha = \"u\", d = 0 }";

type Mod = ModP<PRIME_61>;

fn read(text: &str) -> Result<Ansatz, Error> {
    ansatz_from_text(text, "x.toml", Format::Toml, &Options::default())
}

fn complaint(symbols: &str, joint: &str, relations: &str) -> String {
    read(&file(symbols, joint, relations)).unwrap_err().to_string()
}

#[test]
fn every_file_of_the_library_is_read() {
    assert!(ansatz_names().len() >= 5);
    for name in ansatz_names() {
        let ansatz = load_ansatz(&name, &Options::default()).unwrap();
        assert!((4..=6).contains(&ansatz.joints.len()), "{name}");
        assert!(ansatz.source.is_some(), "{name}");
        assert_eq!(ansatz.empty(), None);
    }
}

#[test]
fn members_satisfy_the_relations() {
    let text = file(
        SYMBOLS,
        "{ type = \"R\", a = \"b*sin(u) + c'\", alpha = \"pi - v + 2*u\", d = \"a\" }",
        "\"v = u + pi/2\", \"a*sin(u) = b*cos( v )\", \"2*c' = a\"",
    );
    let ansatz = read(&text).unwrap();
    assert_eq!((ansatz.free_angles(), ansatz.free_lengths()), (&[0][..], vec![1]));
    let members = ansatz.over::<Rational>().unwrap();
    let q = |n: i32, d: i32| Rational::from((n, d));
    // u has sine 4/5 and cosine 3/5; v = u + pi/2 has cosine -4/5; so a = -b and c' = -b/2.
    let links = members.member(&[q(1, 2)], &[q(10, 1)]).unwrap();
    assert_eq!((links[0].a.clone(), links[0].d.clone()), (q(3, 1), q(-10, 1)));
    // pi - v + 2u = pi/2 + u
    assert_eq!((links[0].cos.clone(), links[0].sin.clone()), (q(-4, 5), q(3, 5)));
    let half = Mod::from_integer(2).inverse().unwrap();
    let modular = ansatz.over::<Mod>().unwrap().member(&[half], &[Mod::from_integer(10)]).unwrap();
    assert_eq!(modular[0].a, Mod::from_integer(3));
}

#[test]
fn faults_name_their_place() {
    let tests = [
        (SYMBOLS, JOINT, "\"a = b\", \"b = a + 1\"", "x.toml:14", "contradicts the relations before it"),
        (SYMBOLS, JOINT, "\"u = v\", \"v = u + pi/2\"", "x.toml:14", "contradicts the relations before it"),
        (SYMBOLS, JOINT, "\"1 = 2\"", "x.toml:14", "contradicts itself"),
        (SYMBOLS, JOINT, "\"a = a\"", "x.toml:14", "says nothing"),
        (SYMBOLS, JOINT, "\"a = x\"", "x.toml:14", "column 5: found the unknown variable `x`"),
        (SYMBOLS, JOINT, "\"a = sin(x)\"", "x.toml:14", "column 5: found the unknown variable `sin_x`"),
        (SYMBOLS, JOINT, "\"a = sin(u + v)\"", "x.toml:14", "of something else than one symbol"),
        (SYMBOLS, JOINT, "\"u = a\"", "x.toml:14", "found the length `a` in a relation of angles"),
        (SYMBOLS, JOINT, "\"2*u = v + v\"", "x.toml:14", "unsupported"),
        (SYMBOLS, JOINT, "\"a = b\"]\nunknown = [\"a\"", "", ""),
        (SYMBOLS, JOINT, "\"a = 2\"]\nunknown = [\"a\"", "x.toml:14", "contradicts `unknown`"),
        (SYMBOLS, JOINT, "]\nunknown = [\"z\"", "x.toml:15", "found the unknown `z`"),
        (SYMBOLS, JOINT, "]\nfit = [\"a + b\"", "x.toml:15", "found a sum or a factor in `fit`"),
        ("angles = [\"u\"]\nlengths = [\"u\"]", JOINT, "", "x.toml:1", "among the angles and among the lengths"),
        ("angles = [\"u\", \"u\"]", JOINT, "", "x.toml:1", "`u` twice"),
        ("angles = [\"pi\"]", JOINT, "", "x.toml:2", "which has a meaning already"),
        ("lengths = [\"a\", \"u\"]", JOINT, "", "x.toml:7", "found the length `u` in an angle"),
        ("angles = [\"a\", \"u\"]", JOINT, "", "x.toml:7", "found the angle `a` where a length is meant"),
        ("lengths = [\"a\"]", JOINT, "", "x.toml:7", "found the unknown symbol `u`"),
    ];
    for (symbols, joint, relations, place, message) in tests {
        if place.is_empty() {
            assert!(read(&file(symbols, joint, relations)).is_ok(), "{relations}");
            continue;
        }
        let found = complaint(symbols, joint, relations);
        let place = if message == "unsupported" { "unsupported: x.toml:14" } else { place };
        assert!(found.starts_with(place) && found.contains(message), "{relations}: {found}");
    }
}

#[test]
fn relations_without_real_solution_are_found_out() {
    let empty = |relation: &str| read(&file(SYMBOLS, JOINT, relation)).unwrap().empty().map(str::to_owned);
    assert!(empty("\"a^2 + b^2 + 1 = 0\"").unwrap().contains("sum of even powers"));
    assert!(empty("\"cos(u) = 2\"").unwrap().contains("all cosines and sines between -1 and 1"));
    assert!(empty("\"a^2 + a + 1 = 0\"").unwrap().contains("of degree 2, has no real root"));
    assert!(empty("\"tan_half(u)^2 = -1\"").is_some());
    for real in ["\"cos(u) = -1\"", "\"cos(u) = 1/2\"", "\"a^2 = 2\"", "\"a^2 = b^2 + 1\"", "\"sin(u) = cos(v)\""] {
        assert_eq!(empty(real), None, "{real}");
    }
}
