//! Verdicts on platforms with multiple poses, nearly multiple ones and self-motions, against what other programs know of
//! them; and on random flat platforms, against the exact polynomial.

use super::cases::{Draw, answer, translation};
use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::{Format, Options, load_text};
use looproot::internal::elimination::platform_polynomial::{multiple_platform_polynomial, platform_polynomial};
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::Platform;
use looproot::internal::mechanism::{FullMode, Mechanism, Solution};
use looproot::internal::verdict::{Code, Proof, Status};
use looproot_algebra::real_roots::RealRoot;
use looproot_algebra::univariate::Univariate;
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
fn platforms_without_any_pose() {
    check_all("empty");
}

#[test]
fn platforms_beside_congruent_ones_have_finitely_many_poses() {
    check_all("beside");
}

#[test]
fn multiple_poses_that_differ_by_a_turn_about_one_axis() {
    check_all("shared");
}

#[test]
fn special_platforms() {
    check_all("platform");
}

#[test]
fn special_platforms_at_special_poses() {
    check_all("fuzzp");
}

/// The classes of random platforms.
const CLASSES: [&str; 14] = [
    "general",
    "plane",
    "similar",
    "affine",
    "mirrored",
    "congruent",
    "plane and similar",
    "plane and affine",
    "rings",
    "singular",
    "five similar",
    "five congruent",
    "plane and five affine",
    "mixed scales",
];

type Points = [[Rational; 3]; 6];

/// A rational rotation with small numbers.
fn rotation(draw: &mut Draw) -> [[Rational; 3]; 3] {
    draw.pose().1.rotation
}

fn image(matrix: &[[Rational; 3]; 3], points: &Points) -> Points {
    let dot = |row: &[Rational; 3], p: &[Rational; 3]| (0..3).map(|k| Rational::from(&row[k] * &p[k])).sum();
    points.each_ref().map(|p| std::array::from_fn(|i| dot(&matrix[i], p)))
}

/// Three pairs of points on a circle, rounded to some decimals.
fn ring(draw: &mut Draw, radius: f64) -> Points {
    let (half, phase, decimals) = (5.0 + draw.choice(20) as f64, draw.choice(120) as f64, draw.choice(5));
    let unit = 10_u32.pow(u32::try_from(decimals).unwrap());
    let rounded = |x: f64| Rational::from_f64((x * f64::from(unit)).round()).unwrap() / unit;
    std::array::from_fn(|k| {
        let side = if k % 2 == 0 { -half } else { half };
        let (sin, cos) = (120.0 * (k / 2) as f64 + phase + side).to_radians().sin_cos();
        [rounded(radius * cos), rounded(radius * sin), Rational::new()]
    })
}

/// Points on the lines from those of the base to the z axis.
fn towards_axis(draw: &mut Draw, base: &Points) -> Points {
    base.each_ref().map(|a| {
        let (height, part) = (draw.number(), Rational::from((5 + draw.choice(9), 3_u64)));
        std::array::from_fn(|c| {
            let onto = if c == 2 { height.clone() } else { Rational::new() };
            &a[c] + (onto - &a[c]) * &part
        })
    })
}

fn geometry(draw: &mut Draw, class: &str) -> Platform<Rational> {
    let mut platform = draw.platform();
    let is_plane = class.starts_with("plane");
    if is_plane {
        platform.base.iter_mut().chain(&mut platform.plate).for_each(|p| p[2] = Rational::new());
    }
    let base = &platform.base;
    let ratio = Rational::from((1 + draw.choice(7), 2 + draw.choice(4)));
    let scaled = |points: Points| points.map(|p| p.map(|x| x * &ratio));
    let mut plate = match class {
        "similar" | "plane and similar" | "five similar" => scaled(image(&rotation(draw), base)),
        "affine" | "plane and affine" | "plane and five affine" => image(&std::array::from_fn(|_| draw.point()), base),
        "mirrored" => image(&rotation(draw), base).map(|p| p.map(|x| -x)),
        "congruent" | "five congruent" => image(&rotation(draw), base),
        "singular" => towards_axis(draw, base),
        _ => platform.plate.clone(),
    };
    if class == "rings" {
        return Platform { base: ring(draw, 50.0), plate: ring(draw, 35.0) };
    }
    if class.contains("five") {
        // One pair is off, along an axis in the plane if there is one.
        let [leg, axis] = [6, 2].map(|most| usize::try_from(draw.choice(most)).unwrap());
        plate[leg][axis] += Rational::from((1, 10_u64.pow(u32::try_from(draw.choice(12)).unwrap())));
    }
    if class == "mixed scales" {
        // The whole plate, or one point of it.
        let scale = Rational::from(10_u64.pow(4 + u32::try_from(draw.choice(5)).unwrap()));
        let last = if draw.choice(2) == 0 { 6 } else { 1 };
        plate[..last].iter_mut().flatten().for_each(|x| *x *= &scale);
    }
    Platform { base: platform.base, plate }
}

/// A random platform of a class with legs that have a known pose, exactly or but for a power of ten.
struct Planted {
    platform: Platform<Rational>,
    squares: [Rational; 6],
    /// The pose, where it is one exactly.
    pose: Option<Motion<Rational>>,
}

fn planted(index: u64) -> Planted {
    let mut draw = Draw::new(1000 + index);
    let class = CLASSES[usize::try_from(index).unwrap() % CLASSES.len()];
    let mut platform = geometry(&mut draw, class);
    let [x, y, z] = draw.point();
    let mut pose = match (class, draw.choice(3)) {
        ("singular", _) => translation([0; 3].map(Rational::from)),
        // Flat, if base and plate are.
        (_, 0) => translation([x, y, Rational::new()]),
        (_, 1) => translation([x, y, z]),
        _ => draw.pose().1,
    };
    let small = Rational::from((1 + draw.choice(9), 10_u64.pow(3 + u32::try_from(draw.choice(11)).unwrap())));
    let beside = draw.choice(6);
    if beside == 3 {
        for x in platform.base.iter_mut().chain(&mut platform.plate).flatten() {
            *x += &small * draw.number();
        }
    }
    if beside == 4 {
        pose.translation[2] += &small;
    }
    let mut squares = platform.legs_squared(&pose);
    if beside == 5 {
        squares[0] += &small;
    }
    Planted { platform, squares, pose: (beside != 5).then_some(pose) }
}

/// Nothing is listed twice, and the pose that was planted is in a complete list.
fn check_list(name: &str, solution: &Solution, pose: Option<&Motion<Rational>>) {
    let flat = |mode: &FullMode| -> Vec<f64> {
        let q: [f64; 4] = std::array::from_fn(|k| mode.q[k].re);
        let rotation = Quaternion { scalar: q[0], vector: [q[1], q[2], q[3]] }.scaled_rotation();
        rotation.into_iter().flatten().chain((4..7).map(|k| mode.q[k].re)).collect()
    };
    let real: Vec<&FullMode> = solution.modes.iter().filter(|mode| mode.real && mode.certified).collect();
    for (k, mode) in real.iter().enumerate() {
        let twice = real[..k].iter().find(|other| {
            let (turned, moved) = apart(other, &flat(mode));
            turned.max(moved) < 1e-14
        });
        assert!(twice.is_none(), "{name}: a pose is listed twice");
    }
    let is_complete = matches!(solution.verdict.status, Status::Complete | Status::Unreachable);
    if let Some(pose) = pose.filter(|_| is_complete && solution.verdict.proof.is_proved()) {
        let numbers = pose.rotation.iter().flatten().chain(&pose.translation);
        let pose: Vec<f64> = numbers.map(Rational::to_f64).collect();
        let near = |mode: &&FullMode| {
            let (turned, moved) = apart(mode, &pose);
            turned.max(moved) < 1e-5
        };
        assert!(real.iter().any(near), "{name}: the planted pose is missing: {}", solution.verdict.reason);
        // Its position is within the radius of a mode, in metres; the planted one is rounded to f64.
        let size = pose[9..].iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        let beyond =
            |mode: &&FullMode| (0..3).map(|k| (mode.q[4 + k].re - pose[9 + k]).abs()).fold(0.0, f64::max) - mode.radius;
        let beyond = real.iter().map(beyond).fold(f64::INFINITY, f64::min);
        assert!(beyond <= 2e-16 * size, "{name}: {beyond:e} beyond the radius");
    }
}

/// Random platforms of all classes, at poses that are special or not and near them, against their exact polynomials. The variable
/// `LOOPROOT_PLATFORMS` gives their number, or a range `from..to`.
#[test]
fn verdicts_on_random_platforms_agree_with_their_exact_polynomials() {
    let wanted = std::env::var("LOOPROOT_PLATFORMS").unwrap_or_else(|_| "10".to_owned());
    let (from, to) = wanted.split_once("..").unwrap_or(("0", &wanted));
    let (mut finite, mut proved) = (0, 0);
    for index in from.parse::<u64>().unwrap()..to.parse().unwrap() {
        let Planted { platform, squares, pose } = planted(index);
        let solution = answer(&platform, &squares);
        let verdict = &solution.verdict;
        let name = format!("{index}, {}", CLASSES[usize::try_from(index).unwrap() % CLASSES.len()]);
        check_list(&name, &solution, pose.as_ref());
        let exact = || {
            let polynomial = platform_polynomial(&platform, &squares);
            polynomial.or_else(|| multiple_platform_polynomial(&platform, &squares))
        };
        let Some(polynomial) = exact() else {
            let is_complete = matches!(verdict.status, Status::Complete | Status::Unreachable);
            assert!(!(is_complete && verdict.complex_complete), "{name}: no polynomial, but {}", verdict.reason);
            continue;
        };
        let degree = polynomial.coefficients.len() - 1;
        assert_ne!(verdict.status, Status::SelfMotion, "{name}: {}", verdict.reason);
        assert!(verdict.complex <= degree, "{name}: {} of {degree} poses", verdict.complex);
        let roots = Univariate::new(polynomial.coefficients).real_roots();
        let real: usize = roots.iter().map(RealRoot::multiplicity).sum();
        finite += 1;
        if verdict.proof.is_proved() {
            proved += 1;
            // Where all roots are simple, a real root belongs to a real pose; elsewhere two may share a real rotation.
            let is_simple = roots.iter().all(|root| root.multiplicity() == 1);
            let agrees = if is_simple { verdict.real == real } else { verdict.real <= real };
            assert!(agrees, "{name}: {} real poses, {real} real roots: {}", verdict.real, verdict.reason);
            assert!(!verdict.complex_complete || verdict.complex == degree, "{name}: {}", verdict.reason);
        } else {
            println!("{name}: {}", verdict.reason);
        }
    }
    println!("{proved} of {finite} finite ones proved");
}

/// The rationals that stand for irrational coordinates fulfil equations that the coordinates need not.
#[test]
fn irrational_coordinates_are_rounded_data_unless_all_40_poses_are_certified() {
    let hexapod = |scale: &str, first: &str| {
        let base = [[6, 1, 0], [1, 6, 0], [0, 6, 1], [0, 1, 6], [1, 0, 6], [6, 0, 1]];
        let row = |p: [i32; 3]| format!("[{}]", p.map(|x| format!("\"{x}*{scale}\"")).join(", "));
        let mut rows = base.map(row);
        if !first.is_empty() {
            rows[0] = first.to_owned();
        }
        format!(
            "[mechanism]\nkind = \"platform\"\nbase = [{}]\n\
             plate = [[2, 3, 0], [0, 3, 2], [0, 2, 3], [2, 0, 3], [3, 0, 2], [3, 2, 0]]\nlegs = [11, 11, 12, 11, 12, 12]\n",
            rows.join(", ")
        )
    };
    let verdict = |text: &str| {
        let entry = load_text(text, "test.toml", Format::Toml, &Options::default()).unwrap();
        let mechanism = Mechanism::prepare(&entry).unwrap();
        mechanism
            .solve(&entry.cases[0], Roots::All, &mut Workspace::default(), &mut Assembly::default())
            .unwrap()
            .verdict
    };
    let rational = verdict(&hexapod("1", ""));
    assert_eq!((rational.code, rational.proof), (Code::GeometryBoundMet, Proof::Proved));
    let scaled = verdict(&hexapod("sqrt(2)", ""));
    assert_eq!((scaled.complex, scaled.proof), (28, Proof::RoundedData), "{}", scaled.reason);
    let general = verdict(&hexapod("sqrt(2)", "[\"6*sqrt(3)\", \"sqrt(2)\", \"sqrt(5)\"]"));
    assert_eq!((general.complex, general.code, general.proof), (40, Code::GeneralBoundMet, Proof::Proved));
}
