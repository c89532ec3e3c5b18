//! Verdicts on platforms with multiple poses, nearly multiple ones and self-motions, against what other programs know of
//! them; and on random flat platforms, against the exact polynomial.

use super::cases::Draw;
use looproot::algebra::number::Number;
use looproot::algebra::real_roots::RealRoot;
use looproot::algebra::univariate::Univariate;
use looproot::assembly::Roots;
use looproot::benchmark::platform::sample::{PlatformSet, sample};
use looproot::catalogue::entry::{Case, Design, Entry};
use looproot::elimination::platform_polynomial::multiple_platform_polynomial;
use looproot::kinematics::dual_quaternion::Quaternion;
use looproot::kinematics::motion::Motion;
use looproot::kinematics::platform::Platform;
use looproot::mechanism::{FullMode, Mechanism, Solution};
use looproot::verdict::Status;
use rug::Rational;

/// A platform, and what is known of its poses.
struct Known {
    name: String,
    dimension: usize,
    count: Option<usize>,
    needs_proof: bool,
    points: Vec<[Rational; 3]>,
    legs: Vec<Rational>,
    /// Rotation matrices, row by row, and positions.
    poses: Vec<Vec<f64>>,
}

fn known() -> Vec<Known> {
    let mut all: Vec<Known> = Vec::new();
    for line in include_str!("verdicts.txt").lines().filter(|line| !line.starts_with('#')) {
        let (kind, rest) = line.split_once(' ').unwrap();
        let words: Vec<&str> = rest.split_whitespace().collect();
        if kind == "case" {
            let (dimension, count, needs_proof) =
                (words[1].parse().unwrap(), words[2].parse().ok(), words[3] == "proof");
            let (points, legs, poses) = Default::default();
            all.push(Known { name: words[0].to_owned(), dimension, count, needs_proof, points, legs, poses });
            continue;
        }
        let case = all.last_mut().unwrap();
        let numbers = || words.iter().map(|w| w.parse::<Rational>().unwrap());
        match kind {
            "l" => case.legs = numbers().collect(),
            "p" => case.poses.push(words.iter().map(|w| w.parse().unwrap()).collect()),
            _ => case.points.push(numbers().collect::<Vec<_>>().try_into().unwrap()),
        }
    }
    all
}

fn answer(platform: &Platform<Rational>, squares: &[Rational; 6]) -> Solution {
    let numbers = |p: &[[Rational; 3]; 6]| p.each_ref().map(|p| p.each_ref().map(|x| Number::exact(x.clone())));
    let design = Platform { base: numbers(&platform.base), plate: numbers(&platform.plate) };
    let case = Case::legs(squares.each_ref().map(|s| Number::exact(s.clone())), 0);
    let entry = Entry {
        design: Design::Platform(Box::new(design)),
        cases: vec![case],
        ..sample(PlatformSet::General, 1, 0).unwrap().entry
    };
    let (mut workspace, mut assembly) = Default::default();
    Mechanism::prepare(&entry).unwrap().solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

/// The largest difference of a mode from a pose, in the rotation and, relative to its size, in the position.
fn apart(mode: &FullMode, pose: &[f64]) -> (f64, f64) {
    let q: [f64; 7] = std::array::from_fn(|k| mode.q[k].re);
    let quaternion = Quaternion { scalar: q[0], vector: [q[1], q[2], q[3]] };
    let (norm, rotation) = (quaternion.norm(), quaternion.scaled_rotation());
    let turned = (0..9).map(|k| (rotation[k / 3][k % 3] / norm - pose[k]).abs()).fold(0.0, f64::max);
    let moved = (0..3).map(|k| (q[4 + k] - pose[9 + k]).abs() / pose[9 + k].abs().max(1.0)).fold(0.0, f64::max);
    (turned, moved)
}

fn check(case: &Known) {
    let name = &case.name;
    let (base, plate) = case.points.split_at(6);
    let platform = Platform { base: base.to_vec().try_into().unwrap(), plate: plate.to_vec().try_into().unwrap() };
    let squares: [Rational; 6] = case.legs.clone().try_into().unwrap();
    let solution = answer(&platform, &squares);
    let verdict = &solution.verdict;
    let real: Vec<&FullMode> = solution.modes.iter().filter(|mode| mode.real).collect();
    for mode in real.iter().filter(|mode| mode.certified && case.dimension == 0) {
        let rotation = case.poses.iter().map(|pose| apart(mode, pose).0).fold(f64::INFINITY, f64::min);
        assert!(rotation / 8.0 <= mode.radius + 1e-16, "{name}: off by {rotation:e} with radius {:e}", mode.radius);
    }
    assert!(
        verdict.status != Status::SelfMotion || verdict.self_motion <= case.dimension,
        "{name}: {}",
        verdict.reason
    );
    let is_complete = matches!(verdict.status, Status::Complete | Status::Unreachable);
    assert!(!case.needs_proof || is_complete && verdict.proof.is_proved(), "{name}: {}", verdict.reason);
    if is_complete {
        assert_eq!((case.dimension, Some(verdict.complex)), (0, case.count), "{name}: {}", verdict.reason);
        assert_eq!(real.len(), case.poses.len(), "{name}: {}", verdict.reason);
        for pose in &case.poses {
            let near = |mode: &&FullMode| {
                let (turned, moved) = apart(mode, pose);
                turned.max(moved) < 1e-5
            };
            assert!(real.iter().any(near), "{name}: a real pose is missing");
        }
    }
}

/// The cases whose names begin so.
fn check_all(start: &str) {
    let cases: Vec<Known> = known().into_iter().filter(|case| case.name.starts_with(start)).collect();
    assert!(!cases.is_empty());
    cases.iter().for_each(check);
}

#[test]
fn flat_platforms() {
    check_all("flat");
}

#[test]
fn platforms_with_a_double_pose_and_beside_it() {
    check_all("double");
}

#[test]
fn platforms_nearly_flat_or_nearly_special() {
    check_all("near");
}

#[test]
fn special_platforms() {
    check_all("platform");
}

#[test]
fn special_platforms_at_special_poses() {
    check_all("fuzzp");
}

/// Small integers in the plane z = 0.
fn flat_points(draw: &mut Draw) -> [[Rational; 3]; 6] {
    std::array::from_fn(|_| {
        let [x, y, _] = draw.point();
        [x, y, Rational::new()]
    })
}

/// Random flat platforms, at a flat pose and above it by powers of ten: as many are done as the variable `LOOPROOT_PLATFORMS`
/// says.
#[test]
fn real_poses_of_flat_platforms_are_as_many_as_the_polynomial_has_real_roots() {
    let most = std::env::var("LOOPROOT_PLATFORMS").ok().and_then(|text| text.parse().ok()).unwrap_or(2);
    let mut draw = Draw::new(61);
    for index in 0..most {
        let platform = Platform { base: flat_points(&mut draw), plate: flat_points(&mut draw) };
        let [x, y, _] = draw.point();
        let height = if index % 2 == 0 { Rational::new() } else { Rational::from((1, 10_u64.pow(3 + index % 11))) };
        let identity = Quaternion { scalar: Rational::from(1), vector: [0; 3].map(Rational::from) };
        let pose = Motion { rotation: identity.scaled_rotation(), translation: [x, y, height] };
        let squares = platform.legs_squared(&pose);
        let Some(polynomial) = multiple_platform_polynomial(&platform, &squares) else { continue };
        let verdict = answer(&platform, &squares).verdict;
        let roots = Univariate::new(polynomial.coefficients).real_roots();
        let real: usize = roots.iter().map(RealRoot::multiplicity).sum();
        if verdict.proof.is_proved() {
            assert_eq!(verdict.real, real, "{index}: {}", verdict.reason);
        }
        assert_ne!(verdict.status, Status::SelfMotion, "{index}: {}", verdict.reason);
    }
}
