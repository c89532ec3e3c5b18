//! Arms whose numbers are off by little, as files of robots write them: their solutions are in pairs, or in fours, that errors do not tell apart.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::entry::{Case, Entry, InputValue};
use looproot::internal::catalogue::{Any, Format, Options, any_from_text};
use looproot::internal::mechanism::Mechanism;
use looproot::internal::verdict::Code;
use looproot_algebra::number::{Angle, Reading};

/// Returns an arm with a wrist whose right angles are written with five digits, and whose axes miss each other by a millionth.
fn truncated() -> Entry {
    let rows = [("0", "1.5708", "0.24"), ("0.256", "1e-6", "0"), ("1e-6", "1.5708", "0"), ("0", "-1.5708", "0.21")];
    let last = [("1e-6", "1.5708", "0"), ("0", "0", "0.144")];
    let joint = |(a, alpha, d): &(&str, &str, &str)| {
        format!("{{ type = \"R\", a = \"{a}\", alpha = \"{alpha}\", d = \"{d}\" }}")
    };
    let joints: Vec<String> = rows.iter().chain(&last).map(joint).collect();
    let text =
        format!("[mechanism]\nkind = \"arm\"\nconvention = \"dh\"\njoints = [{}]\n[[pose]]\n", joints.join(", "));
    let text = text + "matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.3], [0, 0, 0, 1]]\n";
    let Any::Entry(entry) = any_from_text(&text, "x.toml", Format::Toml, &Options::default()).unwrap() else {
        panic!("an arm")
    };
    *entry
}

/// The real solutions are proved to be all without numbers longer than f64, at poses with a tolerance, and they are those of all solutions.
#[test]
fn crowded_real_solutions_are_proved_to_be_all() {
    let entry = truncated();
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let mut matched = 0;
    for planted in [[0.3, 0.5, 1.0, 0.4, 0.5, 0.6], [0.3, 0.5, 2.0, 0.4, 0.5, 0.6], [-2.1, -2.2, -1.1, 1.8, -1.9, 0.4]]
    {
        let angles = planted.map(|x: f64| Angle::parse(&x.to_string(), &Reading::default()).unwrap());
        let values: Vec<InputValue> = angles.into_iter().map(InputValue::Angle).collect();
        let case = Case::reached(entry.chain().unwrap(), &values, 1).unwrap();
        let solve = |roots| mechanism.solve(&case, roots, &mut Workspace::default(), &mut Assembly::default()).unwrap();
        let (real, all) = (solve(Roots::Real), solve(Roots::All));
        let known: Vec<_> = all.modes.iter().filter(|mode| mode.real).collect();
        assert_eq!(real.modes.len(), known.len(), "{planted:?}: {}", real.verdict.reason);
        for mode in &real.modes {
            let apart = |one: &[num_complex::Complex<f64>], other: &[num_complex::Complex<f64>]| {
                one.iter().zip(other).map(|(x, y)| wrapped(x.re - y.re).abs()).fold(0.0, f64::max)
            };
            assert!(known.iter().any(|other| apart(&mode.q, &other.q) < 1e-9), "{planted:?}");
        }
        matched += usize::from(real.verdict.code == Code::RealZerosMatched);
    }
    assert!(matched >= 2, "{matched} of 3");
}
