//! Closure polynomials of overconstrained loops in input and output: every mode is a root, and every real root a mode.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Entry};
use looproot::internal::catalogue::{Any, Format, Options, any_from_text, load};
use looproot::internal::mechanism::Mechanism;
use looproot::internal::sweep::derive_any;
use looproot::internal::verdict::{Code, Proof, Status};

fn entry(name: &str) -> Entry {
    load(&format!("overconstrained/{name}"), &Options::default()).unwrap()
}

/// A link that is longer than all others together keeps a loop open, of whose complex solutions there are families.
#[test]
fn a_link_that_is_too_long_denies_a_loop() {
    let planar = |lengths: [&str; 4]| {
        let joint = |a: &str| format!("{{ type = \"R\", a = \"{a}\", alpha = 0, d = 0 }}");
        let text = format!(
            "[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [{}]\n",
            lengths.map(joint).join(", ")
        );
        let Any::Entry(entry) = any_from_text(&text, "x.toml", Format::Toml, &Options::default()).unwrap() else {
            panic!("a loop")
        };
        let mechanism = Mechanism::prepare(&entry).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let verdict = mechanism.solve(&Case::free(1), Roots::All, &mut workspace, &mut assembly).unwrap().verdict;
        (verdict.status, verdict.code, verdict.proof)
    };
    let denied = (Status::Unreachable, Code::LinkTooLong, Proof::Proved);
    assert_eq!(planar(["10", "1", "2", "3"]), denied);
    assert_eq!(planar(["1", "2", "60000001/10000000", "3"]), denied);
    assert_eq!(planar(["1", "2", "59999999/10000000", "3"]).0, Status::SelfMotion);
}

/// Irrational numbers are known within intervals only. A loop of fewer than six unknowns is proved not to close with them where every
/// solution with virtual joints has one of these apart from zero.
#[test]
fn irrational_loops_are_proved_not_to_close() {
    let verdict = |twist: &str| {
        let joint = |a: &str, alpha: &str, d: &str| format!("{{ type = \"R\", a = \"{a}\", {alpha}, d = \"{d}\" }}");
        let half = |tangent: &str| format!("tan_half_alpha = \"{tangent}\"");
        let joints = [
            joint("0.456", &half("1/3"), "0.295"),
            joint("sqrt(2)", "alpha = \"pi\"", "-0.203"),
            joint("0", &format!("alpha = \"{twist}\""), "0.959"),
            joint("-0.77", &half("1 + 1e-6"), "-0.978"),
            joint("-0.683", &half("1/4"), "0.846"),
            "{ type = \"P\", a = \"0.183\", tan_half_alpha = \"1 + 1e-8\", tan_half_theta = \"2/3\" }".to_owned(),
        ];
        let text = format!(
            "[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [{}]\n[[input]]\njoint = 2\ntan_half = \"1/3\"\n",
            joints.join(", ")
        );
        let Any::Entry(entry) = any_from_text(&text, "x.toml", Format::Toml, &Options::default()).unwrap() else {
            panic!("a loop")
        };
        let mechanism = Mechanism::prepare(&entry).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap().verdict
    };
    for twist in ["40 deg", "17 deg"] {
        let verdict = verdict(twist);
        assert_eq!(
            (verdict.status, verdict.code, verdict.proof),
            (Status::Unreachable, Code::NoSolution, Proof::Proved)
        );
        assert!(verdict.reason.contains("all proved"), "{}", verdict.reason);
    }
}

/// The degree of the closure polynomial, and how many joints have one with the input.
fn derived(name: &str) -> [usize; 2] {
    let entry = entry(name);
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let mut found = [0, 0];
    for case in &entry.cases {
        let derivation = derive_any(&entry, case).unwrap();
        let polynomial = derivation.polynomial.as_ref().unwrap_or_else(|| panic!("{name}: {:?}", derivation.without));
        // Every solution is put into every equation.
        let check = derivation.substituted(&entry, case).unwrap();
        assert!(check.without.is_some() || check.values > 0, "{name}");
        let solution = mechanism.solve(case, Roots::All, &mut Workspace::default(), &mut Assembly::default()).unwrap();
        let real = solution.modes.iter().filter(|mode| mode.real).count();
        assert_eq!(polynomial.roots.len() + polynomial.at_pi, real, "{name}: {polynomial:?}");
        found = [polynomial.degree() + polynomial.at_pi, derivation.equations.len()];
    }
    found
}

#[test]
fn families_of_four_and_five_joints_have_closure_polynomials() {
    assert_eq!(derived("bennett_a"), [1, 3]);
    assert_eq!(derived("bennett_c")[0], 1);
    assert_eq!(derived("goldberg_a"), [1, 4]);
    assert_eq!(derived("goldberg_subtractive")[0], 1);
    assert!(derived("myard_a")[0] >= 1);
}

#[test]
fn families_of_six_joints_have_closure_polynomials() {
    for name in [
        "bricard_line_symmetric_a",
        "bricard_plane_symmetric_a",
        "bricard_trihedral_a",
        "waldron_hybrid",
        "double_goldberg",
        "dietmaier_a",
        "wohlhart_hybrid_a",
    ] {
        println!("{name}: {:?}", derived(name));
    }
}

/// Loops with translations, and those whose cuts give no relation: the ring of the closure equations at the input.
#[test]
fn loops_with_translations_have_closure_polynomials_at_their_inputs() {
    let oldham = r#"
        [mechanism]
        kind = "loop"
        convention = "screws"
        joints = [
            { type = "R", axis = [0, 0, 1], point = [0, 0, 0] },
            { type = "P", axis = [1, 0, 0] },
            { type = "P", axis = [0, 1, 0] },
            { type = "R", axis = [0, 0, 1], point = [1, 0, 0] },
        ]
        [[input]]
        joint = 1
        tan_half = "1/5""#;
    let Any::Entry(oldham) = any_from_text(oldham, "x.toml", Format::Toml, &Options::default()).unwrap() else {
        panic!("a loop")
    };
    for entry in [*oldham, entry("rrcrp_a"), entry("rrcrp_b")] {
        let mechanism = Mechanism::prepare(&entry).unwrap();
        for case in &entry.cases {
            let derivation = derive_any(&entry, case).unwrap();
            let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
            let solution = mechanism.solve(case, Roots::All, &mut workspace, &mut assembly).unwrap();
            let polynomial = derivation.polynomial.as_ref().unwrap();
            let (unknown, _) = derivation.unknown(entry.chain().unwrap()).unwrap();
            assert!(
                derivation.proved && polynomial.degree() + polynomial.at_pi == solution.verdict.complex,
                "{}",
                entry.title
            );
            assert_eq!(polynomial.roots.len(), solution.verdict.real, "{}", entry.title);
            for mode in solution.modes.iter().filter(|mode| mode.real) {
                let value = mode.q[unknown].re;
                let is_root = |root: f64| (root - value).abs() < 1e-9 || (root - (value / 2.0).tan()).abs() < 1e-9;
                assert!(polynomial.roots.iter().any(|root| is_root(root.value)), "{}: {value}", entry.title);
            }
        }
    }
}

/// Both lifted configurations of a Sarrus linkage are listed beside the family of a folded leg; a third of a degree off, with links of
/// different lengths, no leg can be folded.
#[test]
fn isolated_solutions_beside_a_family_are_listed() {
    let entry = entry("sarrus");
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let solution = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
    let verdict = &solution.verdict;
    assert_eq!((verdict.status, verdict.proof, verdict.self_motion), (Status::SelfMotion, Proof::Proved, 1));
    assert_eq!((verdict.real, verdict.complex, verdict.certified), (2, 2, 2));
    assert_eq!(solution.families.len(), 1);
    assert_eq!(solution.families[0].moving, [3, 5]);
    // Leg 2 stands at 45 degrees plus and minus the same angle: the height of the other one is 2 L cos(beta).
    let beta = 0.5_f64.atan() - 2.0 * 0.2_f64.atan();
    let away = (2.0 * 1.25_f64.sqrt() * beta.cos() / 8.0_f64.sqrt()).acos();
    for (mode, sign) in solution.modes.iter().zip([-1.0, 1.0]) {
        let expected = std::f64::consts::FRAC_PI_4 + sign * away;
        assert!((mode.q[3].re - expected).abs() < 1e-12 && (mode.q[5].re - expected).abs() < 1e-12, "{:?}", mode.q);
    }
}
