//! Data that vanish modulo every prime which stands in the sources: no verdict may call a wrong count proved.

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::derivation::derive;
use looproot::internal::mechanism::Mechanism;
use looproot::internal::verdict::{Status, Verdict};
use looproot_algebra::modp::is_prime;
use rug::Integer;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// Primes below this divide ordinary data.
const LEAST: u64 = 1 << 19;

/// The numbers of a line of code, those written as `(1 << 61) - 1` among them.
fn numbers(line: &str) -> Vec<u64> {
    let mut tokens: Vec<String> = Vec::new();
    for c in line.chars() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        match tokens.last_mut() {
            Some(last) if is_word(c) && last.chars().all(is_word) => last.push(c),
            _ if c.is_whitespace() => tokens.push(String::new()),
            _ => tokens.push(c.to_string()),
        }
    }
    tokens.retain(|token| !token.is_empty());
    let plain = |token: &String| {
        let text = token.replace('_', "");
        let text = ["u64", "i64", "u32", "i32", "u128", "i128", "usize"]
            .iter()
            .find_map(|t| text.strip_suffix(t))
            .unwrap_or(&text);
        match text.strip_prefix("0x") {
            Some(hexadecimal) => u64::from_str_radix(hexadecimal, 16).ok(),
            None => text.parse().ok(),
        }
    };
    let mut found: Vec<u64> = tokens.iter().filter_map(plain).collect();
    // ( 1 < < 61 ) - 57
    for window in tokens.windows(8) {
        if let [open, one, less, again, power, close, sign, rest] = window
            && [open, less, again, close].map(String::as_str) == ["(", "<", "<", ")"]
            && let (Some(1), Some(power @ 0..=63), Some(rest)) = (plain(one), plain(power), plain(rest))
        {
            let power = 1_u64 << power;
            found.extend(if sign == "-" { power.checked_sub(rest) } else { power.checked_add(rest) });
        }
    }
    found
}

fn scan(folder: &Path, primes: &mut BTreeSet<u64>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            scan(&path, primes);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            // No modulus reaches 2^63.
            let moduli = text.lines().flat_map(numbers).filter(|n| *n > LEAST && *n < 1 << 63);
            primes.extend(moduli.filter(|n| is_prime(*n)));
        }
    }
}

/// The product of the primes in the sources and of the first ones of the search below `2^49`.
fn product() -> Integer {
    let mut primes = BTreeSet::new();
    for folder in ["src", "crates"] {
        scan(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut primes);
    }
    assert!(primes.contains(&((1 << 61) - 1)) && primes.contains(&((1 << 62) - 57)), "{primes:?}");
    primes.extend((0..1_u64 << 49).rev().filter(|n| is_prime(*n)).take(6));
    primes.iter().fold(Integer::from(1), |product, prime| product * prime)
}

/// A multiple of the product between `10^-digits` and `10^(1-digits)`, as a file writes it.
fn small(product: &Integer, digits: usize) -> String {
    format!("{product}/1{}", "0".repeat(product.to_string().len() - 1 + digits))
}

fn read(text: &str) -> Entry {
    load_text(text, "test.toml", Format::Toml, &Options::default()).unwrap()
}

fn solve(entry: &Entry) -> Verdict {
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mechanism = Mechanism::prepare(entry).unwrap();
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap().verdict
}

/// Returns the number of complex solutions that a verdict states as proved.
fn claims(verdict: &Verdict) -> Option<usize> {
    let is_answer = matches!(verdict.status, Status::Complete | Status::Unreachable);
    (is_answer && verdict.proof.is_proved() && verdict.complex_complete).then_some(verdict.complex)
}

#[test]
fn numbers_are_read_from_code() {
    assert_eq!(numbers("const P: u64 = (1 << 61) - 1;"), [1, 61, 1, (1 << 61) - 1]);
    assert_eq!(numbers("f(1_000_003, 0x10u64)"), [1_000_003, 16]);
}

/// With A = 0 three axes meet and there are 8 solutions; with any other A there are 16.
fn arm(a: &str) -> Entry {
    let joint = |a: &str, t: &str, d: &str| {
        format!("{{ type = \"R\", a = \"{a}\", tan_half_alpha = \"{t}\", d = \"{d}\" }},\n")
    };
    let joints = [
        joint("1/5", "1/2", "0"),
        joint("-1/2", "1/3", "1/10"),
        joint("1/10", "3/4", "1/5"),
        joint(a, "2/3", "2/5"),
        joint("0", "2/5", "0"),
        joint("0", "0", "1/10"),
    ];
    read(&format!(
        "[mechanism]\nkind = \"arm\"\nconvention = \"dh\"\njoints = [\n{}]\n[[pose]]\nmatrix = [[\"1/3\", \"-2/15\", \"14/15\", \
         \"3/10\"], [\"2/3\", \"11/15\", \"-2/15\", \"1/5\"], [\"-2/3\", \"2/3\", \"1/3\", \"1/2\"], [0, 0, 0, 1]]\n",
        joints.concat()
    ))
}

#[test]
fn an_arm_next_to_a_wrist_has_16_solutions_or_no_proof() {
    let product = product();
    for digits in [6, 10, 13, 20, 27] {
        let entry = arm(&small(&product, digits));
        let claimed = claims(&solve(&entry));
        assert!(matches!(claimed, None | Some(16)), "1e-{digits}: {claimed:?}");
    }
    let derivation = derive(&arm(&small(&product, 10)), &arm("0").cases[0]).unwrap();
    let degree = derivation.polynomial.as_ref().map(|p| p.to_polynomial().degree(p.variable));
    assert!(!derivation.proved || degree == Some(16), "{degree:?}");
}

#[test]
fn a_bennett_loop_with_an_offset_has_no_solution_or_no_proof() {
    let product = product();
    let link =
        |a: u32, t: &str, d: &str| format!("{{ type = \"R\", a = {a}, tan_half_alpha = \"{t}\", d = \"{d}\" }},\n");
    for digits in [3, 8, 12, 16, 24] {
        let joints =
            [link(4, "1/2", &small(&product, digits)), link(3, "1/3", "0"), link(4, "1/2", "0"), link(3, "1/3", "0")];
        let entry = read(&format!(
            "[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{}]\n[[input]]\njoint = 1\ntan_half = \"1/2\"\n",
            joints.concat()
        ));
        let claimed = claims(&solve(&entry));
        assert!(matches!(claimed, None | Some(0)), "1e-{digits}: {claimed:?}");
    }
}

#[test]
fn a_platform_next_to_shared_points_has_40_poses_or_no_proof() {
    let product = product();
    for digits in [7, 11, 16] {
        let e = small(&product, digits);
        let multiple = |k: u32| format!("\"{k}*{e}\"");
        let shifted = |x: &str, k: u32| format!("\"{x}+{k}*{e}\"");
        let plate = [
            ["0".to_owned(), "0".to_owned(), "0".to_owned()],
            [multiple(1), multiple(2), format!("\"-1*{e}\"")],
            ["1".to_owned(), "0".to_owned(), "0".to_owned()],
            [shifted("1", 1), multiple(3), multiple(1)],
            ["\"1/3\"".to_owned(), "\"4/5\"".to_owned(), "0".to_owned()],
            [format!("\"1/3-{e}\""), shifted("4/5", 1), multiple(2)],
        ];
        let plate: Vec<String> = plate.iter().map(|point| format!("[{}]", point.join(", "))).collect();
        let entry = read(&format!(
            "[mechanism]\nkind = \"platform\"\nbase = [[0, 0, 0], [1, 0, \"1/10\"], [\"7/5\", \"3/4\", 0], [\"1/2\", \"6/5\", \"1/5\"], \
             [\"-1/2\", 1, 0], [\"-3/5\", \"2/5\", \"1/10\"]]\nplate = [{}]\nlegs = [\"11/10\", \"6/5\", \"13/10\", 1, \"6/5\", \
             \"5/4\"]\n",
            plate.join(", ")
        ));
        let claimed = claims(&solve(&entry));
        assert!(matches!(claimed, None | Some(40)), "1e-{digits}: {claimed:?}");
    }
}
