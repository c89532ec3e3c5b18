//! Frameworks: what moves, what does not, and what only seems to; every verdict with its proof.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, FrameworkFile, Options, any_from_text, builtin_any, moving_names};
use looproot::internal::kinematics::framework::cycle::stands_still;
use looproot::internal::kinematics::framework::{Framework, Mobility, Proof, SliceKind, Verdict, mobility};
use proptest::prelude::*;
use rug::Rational;
use std::process::Command;

fn builtin(name: &str) -> FrameworkFile {
    match builtin_any(name, &Options::default()).unwrap() {
        Any::Framework(file) => *file,
        _ => panic!("{name} is no framework"),
    }
}

fn read(text: &str) -> Result<Any, String> {
    any_from_text(text, "own.toml", Format::Toml, &Options::default()).map_err(|error| error.to_string())
}

fn frameworks() -> Vec<String> {
    moving_names().into_iter().filter(|name| name.starts_with("framework/")).collect()
}

/// Moved by so little, in every coordinate, what moves moves no more.
fn perturbed(file: &FrameworkFile, noise: &[i32], scale: i64) -> Mobility {
    let mut k = 0;
    let mut moved = |x: &Rational| {
        k += 1;
        x + Rational::from((noise[k % noise.len()], 1)) / Rational::from((scale, 1))
    };
    let vertices: Vec<_> = file.framework.vertices.iter().map(|v| v.each_ref().map(&mut moved)).collect();
    let given = &file.framework.bars[..file.framework.given_bars];
    mobility(&Framework::new(vertices, given, &file.bodies), 1).unwrap()
}

#[test]
fn every_framework_is_as_it_claims_and_keeps_its_lengths() {
    let names = frameworks();
    assert!(names.len() >= 10);
    for name in names {
        let file = builtin(&name);
        let answer = file.mobility(60).unwrap();
        assert!(answer.is_proved(), "{name}");
        assert_eq!(Some(answer.freedom().0), file.dimension, "{name}");
        assert_eq!(Some(answer.freedom().1), file.dimension, "{name}");
        assert_eq!(Some(answer.infinitesimal), file.infinitesimal, "{name}");
        match answer.verdict {
            Verdict::Mobile => {
                let flex = answer.flex.unwrap();
                // Some come to an end of their motion, a flat position.
                let steps = flex.positions.len() - 1;
                assert!(steps >= 15 && flex.residual <= 1e-13, "{name}: {steps} {:e}", flex.residual);
                assert!(flex.freedom == (1, 1) && flex.change > 0.05, "{name}: {}", flex.change);
            }
            Verdict::Rigid | Verdict::Shaky(_) => assert!(answer.flex.is_none_or(|flex| flex.change < 1e-3), "{name}"),
        }
    }
}

#[test]
fn each_proof_is_the_one_for_its_kind() {
    let proof = |name: &str| builtin(name).mobility(1).unwrap().proof;
    let kind = |name: &str| match proof(name) {
        Proof::Slice(slice) => (slice.kind, slice.dimension, slice.conditions, slice.rigid),
        other => panic!("{name}: {other:?}"),
    };
    assert_eq!(kind("octahedron_line_symmetric"), (SliceKind::HalfTurn, 9, 6, 2));
    assert_eq!(kind("octahedron_plane_symmetric"), (SliceKind::Reflection, 10, 6, 3));
    assert_eq!(kind("hyperboloid"), (SliceKind::Affine, 12, 5, 6));
    assert_eq!(kind("paraboloid"), (SliceKind::Affine, 12, 5, 6));
    assert_eq!(kind("heureka"), (SliceKind::Group(24), 3, 2, 0));
    assert!(matches!(proof("octahedron_two_flat"), Proof::Octahedron(_)));
    assert!(matches!(proof("steffen"), Proof::Parts(_)));
    assert_eq!(proof("bricard_borel"), Proof::Series(41, 40));
    assert_eq!(proof("octahedron_control"), Proof::Rank);
    assert_eq!(proof("flat_tripod"), Proof::Order(2));
}

#[test]
fn the_identity_of_octahedra_agrees_with_their_symmetry() {
    // The same octahedra, given by their lengths only: there are no vertices from which a symmetry could be read.
    for name in ["octahedron_line_symmetric", "octahedron_plane_symmetric"] {
        let mut file = builtin(name);
        file.squares = Some(file.framework.squares());
        let answer = file.mobility(5).unwrap();
        assert_eq!(answer.verdict, Verdict::Mobile, "{name}");
        assert!(matches!(answer.proof, Proof::Octahedron(_)), "{name}");
    }
    let mut file = builtin("octahedron_two_flat");
    file.squares.as_mut().unwrap()[3] += 1;
    assert!(!matches!(file.mobility(1).map(|answer| answer.verdict), Ok(Verdict::Mobile)));
}

#[test]
fn lengths_that_break_a_polyhedron_are_told() {
    let mut file = builtin("steffen");
    file.squares.as_mut().unwrap()[7] += Rational::from((1, 1000));
    let answer = file.mobility(1);
    // Near the old realisation there may be a new one, but not one that is proved to move.
    assert!(!answer.is_ok_and(|answer| answer.is_proved() && answer.verdict == Verdict::Mobile));
}

#[test]
fn a_small_perturbation_stops_every_motion() {
    for name in frameworks() {
        let file = builtin(&name);
        if file.squares.is_some() || file.dimension != Some(1) {
            continue;
        }
        for scale in [1_000, 1_000_000_000] {
            let answer = perturbed(&file, &[3, -7, 5, 2, -9, 4, 1, 8, -5, 6, -2, 9, -4], scale);
            assert_eq!((answer.verdict, answer.proof), (Verdict::Rigid, Proof::Rank), "{name} {scale}");
        }
    }
}

#[test]
fn small_errors_of_all_sizes_stop_every_motion() {
    for name in frameworks() {
        let file = builtin(&name);
        if file.dimension != Some(1) {
            continue;
        }
        let tally = looproot::internal::benchmark::framework::run(&file, 7, 1, || true, || ());
        assert_eq!((tally.count, tally.mobile.len(), tally.immobile), (7, 0, 7), "{name}: {tally:?}");
    }
}

#[test]
fn lengths_alone_prove_that_a_polyhedron_is_rigid() {
    let file = builtin("steffen");
    let lengths = file.squares.clone().unwrap();
    let bar = |a: &str, b: &str| {
        let [a, b] = [a, b].map(|name| file.names.iter().position(|known| known == name).unwrap());
        file.framework.bars.iter().position(|bar| *bar == [a.min(b), a.max(b)]).unwrap()
    };
    let with = |changes: &[(&str, &str, i32)]| {
        let mut squares = lengths.clone();
        for (a, b, millionths) in changes {
            squares[bar(a, b)] += Rational::from((*millionths, 1_000_000));
        }
        stands_still(&file.framework, &squares)
    };
    // It moves as it is, at any size, and with any distance of A and A2: nothing may be proved then.
    assert!(!with(&[]) && !with(&[("A", "A2", 1)]) && !with(&[("A", "A2", 300_000)]));
    let doubled: Vec<Rational> = lengths.iter().map(|square| Rational::from(square * 2)).collect();
    assert!(!stands_still(&file.framework, &doubled));
    // Opposite edges of an octahedron changed alike keep it movable, with BE of the length of DP and D2P2.
    assert!(!with(&[("B", "P", 5), ("D", "E", 5)]) && !with(&[("D", "P", 7), ("D2", "P2", 7)]));
    assert!(with(&[("B", "P", 5), ("D", "E", 6), ("A", "B", 3)]));
    // One octahedron off, the other one as it was: the distance of B and E could stay at 11, but then the first does not move.
    assert!(with(&[("A", "B", 1)]) && with(&[("C", "E", -1)]));
    // Both off.
    assert!(with(&[("A", "B", 1), ("A2", "E", 2), ("D", "P", 1), ("C", "D2", 3)]));
    let mut other = file.clone();
    other.squares.as_mut().unwrap()[bar("A", "B")] += Rational::from((1, 1_000_000_000));
    if let Ok(answer) = other.mobility(1) {
        assert_eq!((answer.verdict, answer.proof), (Verdict::Rigid, Proof::Cycle));
    }
}

#[test]
fn a_framework_moves_if_bars_are_missing_and_does_not_if_there_are_more_than_enough() {
    let text =
        "[mechanism]\nkind = \"framework\"\nvertices = [[0, 0, 0], [4, 0, 0], [1, 3, 0], [2, 1, 5]]\nbars = BARS\n";
    let answer = |bars: &str| match read(&text.replace("BARS", bars)).unwrap() {
        Any::Framework(file) => file.mobility(3).unwrap(),
        _ => panic!("a framework"),
    };
    let open = answer("[[1, 2], [2, 3], [3, 4], [4, 1]]");
    assert_eq!((open.verdict.clone(), open.freedom(), open.infinitesimal), (Verdict::Mobile, (2, 2), 2));
    let closed = answer("[[1, 2], [2, 3], [3, 4], [4, 1], [1, 3], [2, 4]]");
    assert_eq!((closed.verdict, closed.proof, closed.count), (Verdict::Rigid, Proof::Rank, (4, 6, 0)));
}

#[test]
fn bad_frameworks_are_refused_with_their_place() {
    let head = "[mechanism]\nkind = \"framework\"\n";
    let vertices = "vertices = { A = [0, 0, 0], B = [1, 0, 0], C = [0, 1, 0] }\n";
    let cases = [
        (
            format!("{head}{vertices}bars = [[\"A\", \"B\"], [\"B\", \"D\"]]"),
            "own.toml:4: found the unknown vertex `D`",
        ),
        (
            format!("{head}{vertices}bars = [[\"A\", \"B\"], [\"B\", \"C\"],\n [\"B\", \"A\"]]"),
            "own.toml:5: found the bar B A twice",
        ),
        (format!("{head}{vertices}bars = [[\"A\", \"A\"]]"), "own.toml:4: found a bar from A to itself"),
        (format!("{head}{vertices}bars = [[\"A\", \"B\"]]"), "found no bar and no body at vertex C"),
        (format!("{head}{vertices}"), "found no `bars`"),
        (
            format!("{head}vertices = [[0, 0, 0],\n [0, 0, 0]]\nbars = [[1, 2]]"),
            "own.toml:4: found vertices 1 and 2 at the same place",
        ),
        (format!("{head}vertices = [[0, 0, 0]]\nbars = []"), "found 1 vertices, expected 2"),
        (format!("{head}{vertices}bodies = [[\"A\", \"B\"]]"), "own.toml:4: found a body of 2 vertices"),
        (format!("{head}{vertices}bodies = [[\"A\", \"B\", \"A\"]]"), "found vertex A twice in a body"),
        (
            format!("{head}vertices = [[\"sqrt(2)\", 0, 0], [1, 0, 0], [0, 1, 0]]\nbodies = [[1, 2, 3]]"),
            "own.toml:4: found bodies between vertices that are not rational",
        ),
        (
            format!("{head}{vertices}bars = [[\"A\", \"B\"], [\"B\", \"C\"]]\nlengths = [1]"),
            "own.toml:5: found 1 values in `lengths`, expected 2",
        ),
        (
            format!("{head}{vertices}bars = [[\"A\", \"B\"], [\"B\", \"C\"]]\nlengths = [1, -1]"),
            "own.toml:5: found -1 in `lengths`, expected a positive number",
        ),
        (
            format!(
                "{head}{vertices}bars = [[\"A\", \"B\"], [\"B\", \"C\"]]\nlengths = [1, 1]\nlengths_squared = [1, 1]"
            ),
            "own.toml:6: found both",
        ),
    ];
    for (text, expected) in cases {
        let error = read(&text).map(|_| ()).unwrap_err();
        assert!(error.contains(expected), "{error}\n{expected}");
    }
}

fn run(arguments: &[&str]) -> (i32, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).current_dir(crate::ROOT).output().unwrap();
    assert!(!String::from_utf8_lossy(&output.stderr).contains("panicked"));
    (output.status.code().unwrap(), String::from_utf8(output.stdout).unwrap())
}

#[test]
fn the_program_says_what_moves() {
    let (code, out) = run(&["mobility", "steffen"]);
    assert_eq!(code, 0);
    assert!(
        out.starts_with("mobile: mobility 1 (Maxwell's count 0), 1 motion to first order; proof: proved\n"),
        "{out}"
    );
    let (code, out) = run(&["mobility", "octahedron_control", "--quiet"]);
    assert_eq!((code, out.as_str()), (3, "rigid (Maxwell's count 0), 0 motions to first order; proof: proved\n"));
    let (code, out) = run(&["mobility", "flat_tripod", "--json"]);
    let answer: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &answer["shaky"], &answer["mobility"]), (3, &true.into(), &0.into()));
    let (code, _) = run(&["check", "equations/framework", "--quiet"]);
    assert_eq!(code, 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn octahedra_with_a_half_turn_or_a_mirror_move(
        points in [[-9_i32..=9, -9..=9, -9..=9], [-9..=9, -9..=9, -9..=9], [-9..=9, -9..=9, -9..=9]],
        mirror in any::<bool>(),
    ) {
        let image = |[x, y, z]: [i32; 3]| if mirror { [x, -y, z] } else { [-x, -y, z] };
        let mut points: Vec<[i32; 3]> = points.iter().copied().chain(points.iter().map(|p| image(*p))).collect();
        if mirror {
            // One pair of opposite vertices in the plane.
            points[0][1] = 0;
            points[3] = [points[3][2] - 1, 0, points[3][0] + 2];
        }
        let distinct = (0..6).all(|a| (0..a).all(|b| points[a] != points[b]));
        prop_assume!(distinct);
        let vertices: Vec<_> = points.iter().map(|p| p.map(Rational::from)).collect();
        let bars: Vec<[usize; 2]> =
            (0..6).flat_map(|a| (0..a).map(move |b| [b, a])).filter(|[b, a]| b + 3 != *a).collect();
        let framework = Framework::new(vertices, &bars, &[]);
        prop_assume!(framework.infinitesimal_freedom() == 1);
        let answer = mobility(&framework, 3).unwrap();
        // The only first-order motion may be one that has no part in the symmetry, at a shaky position.
        let symmetric = matches!(answer.proof, Proof::Slice(_) | Proof::Octahedron(_));
        prop_assert!(symmetric || !answer.is_proved() || answer.verdict == Verdict::Mobile, "{:?}", answer.proof);
    }
}

/// A complete bipartite framework on two planes. Source: construction.
fn bipartite(lift: (i32, i32)) -> Framework<Rational> {
    let q = |(n, d): (i32, i32)| Rational::from((n, d));
    let first = [((3, 1), (10, 1)), ((-1, 1), (1, 1)), ((-2, 3), (3, 1)), ((3, 2), (9, 2))];
    let second = [
        ((5, 1), (8, 1)),
        ((-5, 3), (6, 1)),
        ((2, 1), (9, 1)),
        ((1, 1), (10, 1)),
        ((-3, 1), (10, 1)),
        ((2, 1), (2, 1)),
    ];
    let mut vertices: Vec<[Rational; 3]> = first.iter().map(|(x, y)| [q(*x), q(*y), Rational::new()]).collect();
    vertices.extend(second.iter().map(|(x, z)| [q(*x), Rational::new(), q(*z)]));
    vertices[0][2] = q(lift);
    let bars: Vec<[usize; 2]> = (0..4).flat_map(|a| (4..10).map(move |b| [a, b])).collect();
    Framework::new(vertices, &bars, &[])
}

#[test]
fn bipartite_frameworks_on_perpendicular_planes_move() {
    let moves = mobility(&bipartite((0, 1)), 4).unwrap();
    assert_eq!((moves.verdict.clone(), moves.is_proved()), (Verdict::Mobile, true));
    assert!(matches!(moves.proof, Proof::Planes(_) | Proof::Slice(_)), "{:?}", moves.proof);
    let lifted = mobility(&bipartite((1, 1000)), 4).unwrap();
    assert!(!matches!(lifted.verdict, Verdict::Mobile) && lifted.is_proved());
}
