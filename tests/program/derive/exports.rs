//! Exports that can be used alone: they say what they are, and lose nothing.

use super::run;
use looproot_algebra::text::{Expression, Format, Names};

#[test]
fn comments_say_what_everything_is() {
    for (name, format) in Format::NAMED {
        let (code, out, _) = run(&["derive", "cccr_4_angle", "--format", name]);
        assert_eq!(code, 0, "{name}");
        let Some(sample) = format.comment("x") else {
            assert!(!out.contains("closure polynomial"), "{name}");
            continue;
        };
        assert!(out.starts_with(&sample[..sample.find('x').unwrap()]), "{name}: {out}");
        for wanted in [
            "CCCR loop, angle of joint 4 given, case 1",
            "source: Wittenburg2016",
            "the closure polynomial, of degree 2 in t3",
            "t3: tangent of half the angle of joint 3",
        ] {
            let source = if wanted.starts_with("source") { "source: " } else { wanted };
            assert!(out.contains(source), "{name}: {wanted}\n{out}");
        }
    }
}

#[test]
fn linkages_are_exported_with_what_their_variables_are() {
    for (entry, wanted) in [
        (
            "linkage/3prr",
            [
                "A1 = -6.8 m, A2 = 17 m, A3 = 0.6 m",
                "closure equation, cycle 1, x",
                "the closure polynomial, of degree 6: t_rod1 is",
                "cosine and sine: c_plate^2",
            ],
        ),
        (
            "linkage/3rps",
            ["closure equation 6", "what t_A1 is in", "the closure polynomial, of degree 16", "P1 = 14.476582 m"],
        ),
        (
            "linkage/spherical_3rrr",
            ["closure equation 1", "the closure polynomial, of degree 8", "source: ", "on the sphere, of the axis"],
        ),
    ] {
        for (name, format) in Format::NAMED {
            let (code, out, err) = run(&["derive", entry, "--format", name]);
            assert_eq!(code, 0, "{entry} {name}: {err}");
            if format.comment("x").is_some() {
                for wanted in wanted {
                    assert!(out.contains(wanted), "{entry} {name}: {wanted}\n{out}");
                }
            }
        }
    }
    let (code, _, err) = run(&["derive", "linkage/branched_tree", "--format", "sympy"]);
    assert_eq!(code, 4);
    assert!(err.contains("there are no closure equations to write"), "{err}");
    let (code, _, err) = run(&["derive", "linkage/coupler_curve", "--trace", "coupler.P", "--symbolic", "--explain"]);
    assert_eq!(code, 1, "{err}");
}

#[test]
fn symbols_come_with_their_relations_and_translations() {
    let (code, out, _) = run(&["derive", "cccr_4_angle", "--symbolic", "--format", "text"]);
    assert_eq!(code, 0);
    let lines: Vec<&str> = out.lines().filter(|line| !line.starts_with('#')).collect();
    for relation in ["ca1^2 + sa1^2 - 1", "c4^2 + s4^2 - 1"] {
        assert!(lines.iter().any(|line| line.trim_end_matches(';') == relation), "{relation}\n{out}");
    }
    for variable in ["d1", "d2", "d3"] {
        assert!(out.contains(&format!("the translation {variable}")), "{variable}\n{out}");
    }
    // Every polynomial is read again.
    let mut names = Names::default();
    for line in lines {
        assert!(Expression::parse(line.trim_end_matches(';'), &mut names).unwrap().expand().is_ok(), "{line}");
    }
    assert!(names.list().iter().any(|name| name == "sa1"));
}
