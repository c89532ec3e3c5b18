//! Synthesis: counts, degenerate positions, and the linkages that come out.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, Options, SynthesisFile, any_from_text};
use looproot::internal::error::Error;
use looproot::internal::linkage::defects::{FourBar, four_bars};
use looproot::internal::synthesis::path::{NAMES, moving, pivots};
use looproot::internal::synthesis::{Answer, synthesize};
use looproot::internal::verdict::{Proof, Status};

fn read(text: &str) -> Result<Box<SynthesisFile>, Error> {
    match any_from_text(text, "test.toml", Format::Toml, &Options::default())? {
        Any::Synthesis(file) => Ok(file),
        _ => panic!("a synthesis"),
    }
}

/// A synthesis in the plane: tangent of half the angle, x and y of each position.
fn plane(dyad: &str, positions: &[[&str; 3]]) -> Answer {
    let mut text =
        format!("[mechanism]\nkind = \"synthesis\"\nspace = \"plane\"\ntask = \"motion\"\ndyad = \"{dyad}\"\n");
    for [angle, x, y] in positions {
        text += &format!("[[position]]\ntan_half = \"{angle}\"\nposition = [{x}, {y}]\n");
    }
    synthesize(&read(&text).unwrap())
}

/// A synthesis in space: quaternion and position of each.
fn space(dyad: &str, positions: &[[i32; 7]]) -> Answer {
    let mut text =
        format!("[mechanism]\nkind = \"synthesis\"\nspace = \"space\"\ntask = \"motion\"\ndyad = \"{dyad}\"\n");
    for p in positions {
        text += &format!("[[position]]\nquaternion = {:?}\nposition = {:?}\n", &p[..4], &p[4..]);
    }
    synthesize(&read(&text).unwrap())
}

#[test]
fn fewer_positions_leave_a_family_and_more_leave_nothing() {
    let positions = [
        ["0", "-7", "2"],
        ["1/2", "5", "-3"],
        ["-2", "0", "4"],
        ["3", "1", "-8"],
        ["-1/3", "6", "6"],
        ["5/4", "-2", "9"],
    ];
    for (dyad, free) in [("RR", 4), ("PR", 3), ("RP", 3)] {
        for count in 2..=6 {
            let answer = plane(dyad, &positions[..count]);
            let verdict = &answer.verdict;
            assert_eq!(verdict.proof, Proof::Proved);
            if count <= free {
                assert_eq!(
                    (verdict.status, verdict.self_motion),
                    (Status::SelfMotion, free + 1 - count),
                    "{dyad} {count}"
                );
                assert!(answer.families[0].sample.is_some());
            } else {
                let expected = if count > free + 1 {
                    0
                } else if dyad == "RR" {
                    4
                } else {
                    1
                };
                assert_eq!((verdict.self_motion, verdict.complex), (0, expected), "{dyad} {count}");
            }
        }
    }
}

/// The point of the body and the point of the ground of a real dyad have one distance in all positions.
#[test]
fn dyads_take_their_positions() {
    let positions = [["0", "0", "0"], ["6", "-5", "-5"], ["-1", "5", "6"], ["1", "-2", "3"], ["-4/5", "-6", "3"]];
    let answer = plane("RR", &positions);
    assert_eq!((answer.verdict.complex, answer.verdict.real), (4, 4));
    for mode in &answer.modes {
        assert!(mode.is_certified() && mode.dyad.radius < 1e-14);
        let (fixed, moving, length) = (mode.dyad.real("fixed"), mode.dyad.real("moving"), mode.dyad.real("length")[0]);
        for [angle, x, y] in positions {
            let parts: Vec<f64> = angle.split('/').map(|part| part.parse().unwrap()).collect();
            let (sin, cos) = (2.0 * (parts[0] / parts.get(1).unwrap_or(&1.0)).atan()).sin_cos();
            let [x, y] = [x, y].map(|text: &str| text.parse::<f64>().unwrap());
            let at = [x + cos * moving[0] - sin * moving[1], y + sin * moving[0] + cos * moving[1]];
            assert!(((at[0] - fixed[0]).hypot(at[1] - fixed[1]) - length).abs() < 1e-12);
        }
    }
}

#[test]
fn special_positions_are_answers_with_a_dimension() {
    // Two equal positions: four different ones are left, and their curve.
    let equal = plane("RR", &[["0", "0", "0"], ["1", "2", "3"], ["1", "2", "3"], ["2", "-1", "4"], ["-1/2", "3", "3"]]);
    assert_eq!((equal.verdict.status, equal.verdict.self_motion), (Status::SelfMotion, 1));
    assert!(equal.warnings[0].contains("equal"));
    // Three translations: the links are parallel to one another, and every point of the body has one.
    let moved = plane("RR", &[["0", "0", "0"], ["0", "1", "2"], ["0", "3", "-1"]]);
    assert_eq!(moved.verdict.self_motion, 2);
    // Four translations in general: no circle goes through four points that are not on one.
    let none = plane("RR", &[["0", "0", "0"], ["0", "1", "2"], ["0", "3", "-1"], ["0", "4", "4"]]);
    assert_eq!((none.verdict.status, none.verdict.complex), (Status::Unreachable, 0));
    // Rotations about one point: every point of the body is on a circle about it.
    let about = plane("RR", &[["0", "0", "0"], ["1", "0", "0"], ["2", "0", "0"], ["3", "0", "0"], ["-1", "0", "0"]]);
    assert_eq!((about.verdict.status, about.verdict.self_motion), (Status::SelfMotion, 2));
    assert!(about.warnings[0].contains("rotations about one point"));
}

#[test]
fn seven_positions_of_points_on_planes_have_none_and_six_have_ten() {
    let positions = [
        [1, 0, 0, 0, 0, 0, 0],
        [-5, 9, -7, -1, 6, -2, -6],
        [-6, 6, 5, 6, 6, -5, -1],
        [3, -3, -6, 6, 1, 3, -2],
        [-9, 3, 4, -9, -1, -4, 1],
        [2, 1, -3, 4, 5, 5, -2],
        [1, 1, 2, -2, 0, 7, 3],
    ];
    let six = space("PPS", &positions[..6]);
    assert_eq!((six.verdict.complex, six.verdict.proof, six.verdict.certified), (10, Proof::Proved, 10));
    let seven = space("PPS", &positions);
    assert_eq!((seven.verdict.complex, seven.verdict.status), (0, Status::Unreachable));
}

#[test]
fn irrational_angles_are_rounded_data() {
    let text = "[mechanism]\nkind = \"synthesis\"\nspace = \"plane\"\ntask = \"function\"\n\
                [[pair]]\ninput = \"0 deg\"\noutput = \"0 deg\"\n[[pair]]\ninput = \"30 deg\"\noutput = \"20 deg\"\n\
                [[pair]]\ninput = \"60 deg\"\noutput = \"35 deg\"\n[[pair]]\ninput = \"90 deg\"\noutput = { angle = \"55 deg\" }\n\
                [[pair]]\ninput = \"120 deg\"\noutput = \"70 deg\"\n";
    let answer = synthesize(&read(text).unwrap());
    assert_eq!((answer.verdict.complex, answer.verdict.proof), (3, Proof::RoundedData));
}

#[test]
fn faults_name_line_and_expectation() {
    let head = "[mechanism]\nkind = \"synthesis\"\nspace = \"plane\"\ntask = \"motion\"\ndyad = \"RR\"\n";
    let position = "[[position]]\nangle = 0\nposition = [0, 0]\n";
    for (text, line, words) in [
        (format!("{head}{position}"), 6, "expected 2 to 20"),
        (format!("{head}{position}[[position]]\nposition = [1, 2]\n"), 9, "found neither of `angle` and `tan_half`"),
        (format!("{head}{position}[[position]]\nangle = 1\nposition = [1, 2, 3]\n"), 11, "a list of 2"),
        (format!("{head}{position}{position}[[pair]]\ninput = 0\noutput = 0\n"), 12, "expected [[position]]"),
        (head.replace("RR", "SS") + position + position, 5, "expected one of RR, PR, RP"),
        (head.replace("plane", "flat") + position + position, 3, "expected one of plane, sphere, space"),
        (head.replace("dyad = \"RR\"\n", "") + position + position, 1, "found no `dyad`"),
    ] {
        let Err(Error::File { line: found, message, .. }) = read(&text) else { panic!("{text}") };
        assert!(message.contains(words), "{message}");
        assert_eq!(found, line, "{message}");
    }
}

/// A path through these points.
fn path(points: &[[f64; 2]]) -> String {
    let mut text = "[mechanism]\nkind = \"synthesis\"\nspace = \"plane\"\ntask = \"path\"\n".to_owned();
    for [x, y] in points {
        text += &format!("[[point]]\nat = [{x:?}, {y:?}]\n");
    }
    text
}

/// A four-bar is drawn with its coupler point at nine places: its triple is found among 1442, and the triples take their points.
#[test]
fn a_planted_four_bar_is_found_with_its_cognates() {
    // Frame, crank, coupler and rocker of a crank-rocker, and its coupler point, seen from the crank's end.
    let (fixed, [crank, coupler, rocker], [u, v]) = ([[0.0, 0.0], [4.0, 1.0]], [1.5, 4.0, 3.5], [2.0, 1.5]);
    let at = |angle: f64| {
        let b = [crank * angle.cos(), crank * angle.sin()];
        let way = [fixed[1][0] - b[0], fixed[1][1] - b[1]];
        let square = way[0] * way[0] + way[1] * way[1];
        let along = (square + coupler * coupler - rocker * rocker) / (2.0 * square);
        let across = (coupler * coupler / square - along * along).sqrt();
        let c = [b[0] + along * way[0] - across * way[1], b[1] + along * way[1] + across * way[0]];
        let [x, y] = [(c[0] - b[0]) / coupler, (c[1] - b[1]) / coupler];
        ([b, c], [b[0] + u * x - v * y, b[1] + u * y + v * x])
    };
    let angles = [0.2, 0.9, 1.5, 2.3, 2.9, 3.6, 4.4, 5.0, 5.7];
    let points = angles.map(|angle| at(angle).1);
    let file = read(&path(&points)).unwrap();
    let answer = synthesize(&file);
    let verdict = &answer.verdict;
    assert_eq!(
        (verdict.status, verdict.complex, verdict.certified),
        (Status::Complete, 1442, 1442),
        "{}",
        verdict.reason
    );
    assert!(matches!(verdict.proof, Proof::Probable { error, .. } if error < 1e-12), "{:?}", verdict.proof);
    let ([b, c], _) = at(angles[0]);
    let wanted = [fixed[0], b, c, fixed[1]];
    let mut is_found = false;
    for mode in answer.modes.iter().filter(|mode| mode.is_real) {
        for names in NAMES {
            let pivots = pivots(&mode.dyad, names).unwrap();
            let size = |[x, y]: [f64; 2], [u, v]: [f64; 2]| (x - u).hypot(y - v);
            let extent = pivots.iter().map(|pivot| size(*pivot, points[0])).fold(1.0, f64::max);
            let [own, reversed] = [[0, 1, 2, 3], [3, 2, 1, 0]]
                .map(|order| (0..4).map(|k| size(pivots[order[k]], wanted[k])).fold(0.0, f64::max));
            is_found |= own.min(reversed) < 1e-8;
            let lengths = |[b, c]: [[f64; 2]; 2], point: [f64; 2]| {
                [size(pivots[0], b), size(pivots[3], c), size(b, c), size(b, point), size(c, point)]
            };
            let places = moving(&pivots, &points).unwrap();
            let first = lengths(places[0], points[0]);
            for (place, point) in places.iter().zip(points) {
                let off = lengths(*place, point).iter().zip(first).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                assert!(off < 1e-8 * extent, "{off:e} of {extent}");
            }
        }
    }
    assert!(is_found, "the four-bar that was planted");
    // The planted one passes the points in their order, and with it its cognates.
    let sound = four_bars(&file, &answer).into_iter().filter(FourBar::is_sound).count();
    assert!(sound >= 6, "{sound}");
}

#[test]
fn faults_of_paths_name_line_and_expectation() {
    let points: Vec<[f64; 2]> = (0..10_i32).map(|k| [f64::from(k), f64::from(k * k)]).collect();
    for (text, line, words) in [
        (path(&points), 5, "found 10 of [[point]], expected 2 to 9"),
        (path(&points[..1]), 5, "found 1 of [[point]], expected 2 to 9"),
        (path(&[[1.0, 2.0]; 8]), 7, "found points 1 and 2 at the same place, expected different points"),
        (path(&[[1.0, 2.0], [f64::NAN, 0.0]]).replace("NaN", "nan"), 8, "expected"),
        (path(&points[..9]).replace("at = [0.0, 0.0]", "at = [0.0, 0.0, 1.0]"), 6, "a list of 2"),
        (path(&points[..9]).replace("task", "dyad = \"RR\"\ntask"), 4, "found `dyad` beside the task path"),
        (path(&points[..9]) + "[[pair]]\ninput = 0\noutput = 0\n", 23, "expected [[point]]"),
    ] {
        let Err(Error::File { line: found, message, .. }) = read(&text) else { panic!("{text}") };
        assert!(message.contains(words), "{message}");
        assert_eq!(found, line, "{message}");
    }
    let sphere = path(&points[..9]).replace("plane", "sphere");
    assert!(matches!(read(&sphere), Err(Error::Unsupported(_))));
}
