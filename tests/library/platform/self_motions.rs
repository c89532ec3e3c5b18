//! Self-motions that are proved: legs that depend on others, and curves through poses that are known.

use super::cases::translation;
use looproot::internal::assembly::Roots;
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot::internal::verdict::{Code, Proof, Status};
use rug::Rational;
use serde_json::{Value, json};

type Points = [[Rational; 3]; 6];

/// A pose with the rotation of the quaternion (1, 1, 0, 1).
const POSE: [[&str; 4]; 4] =
    [["1/3", "-2/3", "2/3", "1"], ["2/3", "-1/3", "-2/3", "-2"], ["2/3", "2/3", "1/3", "7"], ["0", "0", "0", "1"]];

fn texts(points: &Points) -> Value {
    let point = |p: &[Rational; 3]| p.each_ref().map(ToString::to_string);
    json!(points.each_ref().map(point))
}

fn solved(base: &Points, plate: &Points, legs: &Value) -> Solution {
    let mut file = json!({"mechanism": {"kind": "platform", "base": texts(base), "plate": texts(plate)}});
    let (key, value) = legs.as_object().unwrap().iter().next().unwrap();
    file[key] = value.clone();
    let loaded = load_text(&file.to_string(), "platform.json", Format::Json, &Options::default()).unwrap();
    let (mut workspace, mut assembly) = Default::default();
    let mechanism = Mechanism::prepare(&loaded).unwrap();
    mechanism.solve(&loaded.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

fn at_pose() -> Value {
    json!({"pose": [{"matrix": POSE}]})
}

/// The pose as a motion.
fn pose() -> Motion<Rational> {
    let number = |text: &str| text.parse::<Rational>().unwrap();
    let rotation = std::array::from_fn(|i| std::array::from_fn(|k| number(POSE[i][k])));
    Motion { rotation, ..translation(std::array::from_fn(|i| number(POSE[i][3]))) }
}

/// Six points with the parameter t of a conic, moved by a scale and a shift.
fn on_a_conic(parameters: [i32; 6], scale: i32, shift: i32) -> Points {
    parameters.map(|t| {
        let below = Rational::from(1 + t * t);
        let [x, y] = [1 - t * t, 2 * t].map(|c| Rational::from(&Rational::from(c * scale) / &below));
        [x + shift, y * 2, Rational::new()]
    })
}

#[test]
fn legs_between_points_of_conics_with_the_same_parameters_move() {
    let parameters = [0, 1, -1, 2, -3, 5];
    let (base, plate) = (on_a_conic(parameters, 5, 1), on_a_conic(parameters, 3, 0));
    let solution = solved(&base, &plate, &at_pose());
    let verdict = &solution.verdict;
    assert_eq!(
        (verdict.status, verdict.proof, verdict.self_motion),
        (Status::SelfMotion, Proof::Proved, 1),
        "{verdict:?}"
    );
    assert!(solution.modes.is_empty() && verdict.reason.contains("combinations of the others"), "{}", verdict.reason);
    // Every sample of the family has the legs.
    let exact = Platform { base, plate };
    let squares = exact.legs_squared(&pose());
    let rounded = exact.map(|x| Some(x.to_f64())).unwrap();
    let samples = &solution.families[0].samples;
    assert!(samples.len() > 10);
    for sample in samples {
        let place = looproot::internal::kinematics::platform::pose_of(sample).unwrap();
        for (found, square) in rounded.legs_squared(&place).iter().zip(&squares) {
            assert!((found - square.to_f64()).abs() < 1e-8 * square.to_f64(), "{found} {square}");
        }
    }
    // One leg longer by the least: no pose at all.
    let mut other = squares.each_ref().map(ToString::to_string);
    other[2] = format!("{}", other[2].parse::<Rational>().unwrap() + Rational::from((1, 1_000_000_000)));
    let verdict = solved(&exact.base, &exact.plate, &json!({"legs": [{"squared": other}]})).verdict;
    assert_eq!((verdict.status, verdict.proof, verdict.code), (Status::Unreachable, Proof::Proved, Code::NoSolution));
    // Legs written as square roots are the same ones. Of irrational squares nothing is proved, and the motion is seen.
    let roots = squares.each_ref().map(|square| format!("sqrt({square})"));
    let verdict = solved(&exact.base, &exact.plate, &json!({"legs": [{"lengths": roots}]})).verdict;
    assert_eq!((verdict.status, verdict.proof, verdict.self_motion), (Status::SelfMotion, Proof::Proved, 1));
    let mut irrational = exact.base.clone().map(|p| p.map(|x| x.to_string()));
    irrational[0][2] = "sqrt(2)".to_owned();
    let file = json!({"mechanism": {"kind": "platform", "base": irrational, "plate": texts(&exact.plate)}, "pose": [{"matrix": POSE}]});
    let loaded = load_text(&file.to_string(), "platform.json", Format::Json, &Options::default()).unwrap();
    let (mut workspace, mut assembly) = Default::default();
    let mechanism = Mechanism::prepare(&loaded).unwrap();
    let rounded = mechanism.solve(&loaded.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap().verdict;
    assert!(rounded.status != Status::SelfMotion || rounded.proof != Proof::Proved, "{rounded:?}");
    // The combination of the legs' equations of which these are the constants: irrational lengths may fulfil it, too.
    let shifted = ["107.6+sqrt(2)/50", "106+21*sqrt(2)/500", "55.12", "50", "53.2", "82"];
    let circle = |points: f64| {
        let point = |(x, y): (f64, f64)| json!([x * points / 5.0, y * points / 5.0, 0]);
        json!([(5.0, 0.0), (3.0, 4.0), (-3.0, 4.0), (-4.0, -3.0), (0.0, -5.0), (4.0, -3.0)].map(point))
    };
    let file = json!({"mechanism": {"kind": "platform", "base": circle(5.0), "plate": circle(3.0)}, "legs": [{"squared": shifted}]});
    let loaded = load_text(&file.to_string(), "platform.json", Format::Json, &Options::default()).unwrap();
    let mechanism = Mechanism::prepare(&loaded).unwrap();
    let rounded = mechanism.solve(&loaded.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap().verdict;
    assert!(rounded.status == Status::SelfMotion && rounded.proof == Proof::RoundedData, "{rounded:?}");
    // The legs of an irrational pose are rounded: the plate turns about the line (1, 2, 3), on which half of its points are.
    let turning = json!({
        "mechanism": {
            "kind": "platform",
            "base": [[1, 2, 3], [2, 4, 6], [-1, -2, -3], [5, 0, 1], [0, 6, -2], [4, -3, 2]],
            "plate": [[3, 0, 1], [1, -4, 2], [-2, 5, 0], [1, 2, 3], [-2, -4, -6], [3, 6, 9]],
        },
        "pose": [{"quaternion": [1, 0, 0, 0], "position": ["sqrt(2)", "sqrt(8)", "sqrt(18)"]}],
    });
    let loaded = load_text(&turning.to_string(), "platform.json", Format::Json, &Options::default()).unwrap();
    let mechanism = Mechanism::prepare(&loaded).unwrap();
    let rounded = mechanism.solve(&loaded.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap().verdict;
    assert!(rounded.proof != Proof::Proved, "{rounded:?}");
    // One parameter of the plate differs: the legs are independent, and nothing moves.
    let plate = on_a_conic([0, 1, -1, 2, -3, 4], 3, 0);
    let verdict = solved(&exact.base, &plate, &at_pose()).verdict;
    assert!(verdict.status != Status::SelfMotion && verdict.real > 0, "{verdict:?}");
}

#[test]
fn a_curve_through_the_pose_of_the_file_is_proved_by_power_series() {
    // With this rotation the plate, a mirror image of the base, is mirrored back in a plane: it is moved on a circle.
    let numbers = [[6, 3], [0, -1], [5, 2], [-6, -2], [6, 4], [4, -2]];
    let points = |sign: i32| numbers.map(|[x, y]| [x, sign * y, 0].map(Rational::from));
    let (base, plate) = (points(1), points(-1));
    let solution = solved(&base, &plate, &at_pose());
    let verdict = &solution.verdict;
    assert_eq!(
        (verdict.status, verdict.proof, verdict.self_motion),
        (Status::SelfMotion, Proof::Proved, 1),
        "{verdict:?}"
    );
    assert!(verdict.reason.contains("power series"), "{}", verdict.reason);
    // The legs alone do not say through which pose the curve goes.
    let squares = Platform { base: base.clone(), plate: plate.clone() }.legs_squared(&pose());
    let legs = json!({"legs": [{"squared": squares.map(|square| square.to_string())}]});
    assert_eq!(solved(&base, &plate, &legs).verdict.proof, Proof::None);
    // A point off by a millionth stops it.
    let mut bent = plate;
    bent[5][1] += Rational::from((1, 1_000_000));
    let verdict = solved(&base, &bent, &at_pose()).verdict;
    assert!(verdict.status != Status::SelfMotion, "{verdict:?}");
}
