//! Derivations: every solution satisfies every equation, every real one is a root of the polynomial, and the counts agree.
#![allow(clippy::unwrap_used)]

mod atlas;
mod exports;
mod symbolic;

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Case, Design, Entry};
use looproot::internal::catalogue::{Options, load};
use looproot::internal::derivation::{ClosurePolynomial, Derivation, Removed, RootPose, derive};
use looproot::internal::elimination::degree::degree;
use looproot::internal::elimination::triangle_platform::{Triangle, pairs};
use looproot::internal::kinematics::chain::{Chain, JointKind};
use looproot::internal::kinematics::closed_loop::Layout;
use looproot::internal::kinematics::dual_quaternion::Quaternion;
use looproot::internal::mechanism::{FullMode, Mechanism, Solution, closed_loop};
use looproot::internal::report::derivation::{paper, verdict};
use looproot::internal::report::paper::Style;
use looproot::internal::verdict::Status;
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::number::Number;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::resultant::sylvester;
use rug::Rational;
use std::collections::BTreeMap;
use std::fs;
use std::process::{Command, Stdio};

fn entry(path: &str) -> Entry {
    load(&format!("{}/equations/{path}", crate::ROOT), &Options::default()).unwrap()
}

fn folder(name: &str) -> Vec<Entry> {
    let files = fs::read_dir(format!("{}/equations/{name}", crate::ROOT)).unwrap();
    let mut files: Vec<String> = files.map(|file| file.unwrap().file_name().into_string().unwrap()).collect();
    files.retain(|file| file.strip_suffix(".toml").is_some());
    files.sort();
    files.iter().map(|file| entry(&format!("{name}/{file}"))).collect()
}

fn solved(entry: &Entry) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    mechanism.solve(&entry.cases[0], Roots::All, &mut Workspace::default(), &mut Assembly::default()).unwrap()
}

/// Cosine, sine and half-angle tangent, or distance, of every joint variable by its name.
fn named(chain: &Chain, q: &[f64]) -> BTreeMap<String, f64> {
    let mut values = BTreeMap::new();
    let mut q = q.iter();
    for (joint, kind) in (1..).zip(chain.joint_kinds()) {
        if kind == JointKind::Spherical {
            q.nth(2);
            continue;
        }
        let labels = match kind {
            JointKind::Prismatic => Vec::new(),
            JointKind::Universal => vec![format!("{joint}_1"), format!("{joint}_2")],
            _ => vec![joint.to_string()],
        };
        for label in labels {
            let angle: f64 = *q.next().unwrap();
            values.insert(format!("c{label}"), angle.cos());
            values.insert(format!("s{label}"), angle.sin());
            values.insert(format!("t{label}"), (0.5 * angle).tan());
        }
        if matches!(kind, JointKind::Prismatic | JointKind::Cylindrical) {
            values.insert(format!("d{joint}"), *q.next().unwrap());
        }
    }
    values
}

/// The value over the sum of the sizes of all terms, which at the origin may all be rounding.
fn relative(polynomial: &Polynomial<Rational>, names: &[String], values: &BTreeMap<String, f64>) -> f64 {
    let largest = polynomial.coefficients().iter().map(|c| c.clone().abs()).max().unwrap();
    let (mut sum, mut size) = (0.0, 0.0);
    for (exponents, c) in polynomial.terms() {
        let mut term = Rational::from(c / &largest).to_f64();
        for (name, exponent) in names.iter().zip(exponents).filter(|(_, exponent)| *exponent > 0) {
            term *= values[name].powi(i32::try_from(exponent).unwrap());
        }
        sum += term;
        size += term.abs();
    }
    sum.abs() / (size + 1e-6)
}

/// All equations, in both forms, at a solution; those in half-angle tangents only where no angle is pi.
fn assert_vanishing(what: &str, derivation: &Derivation, values: &BTreeMap<String, f64>) {
    let names = derivation.names.list();
    let at_pi = values.iter().any(|(name, value)| name.starts_with('t') && value.abs() > 1e6);
    for equation in &derivation.equations {
        let forms = std::iter::once(&equation.polynomial).chain(&equation.algebraic);
        for form in forms.filter(|form| !at_pi || !has_tangent(form, names)) {
            let residual = relative(form, names, values);
            assert!(residual < 1e-8, "{what}, {}: {residual:e}", equation.name);
        }
    }
}

fn has_tangent(form: &Polynomial<Rational>, names: &[String]) -> bool {
    (0..names.len()).any(|variable| names[variable].starts_with('t') && form.degree(variable) > 0)
}

/// Returns the distance of the nearest root from a value of the variable; angles by their difference.
fn distance(polynomial: &ClosurePolynomial, is_angle: bool, value: f64) -> f64 {
    let at = |t: f64| if is_angle { 2.0 * t.atan() } else { t };
    let distances = polynomial.roots.iter().map(|root| (at(root.value) - at(value)).abs());
    let nearest = distances.fold(f64::INFINITY, f64::min);
    // Half-angle tangents near infinity of either sign are near one another.
    if is_angle && polynomial.at_pi > 0 { nearest.min(std::f64::consts::PI - at(value).abs()) } else { nearest }
}

fn real(solution: &Solution) -> impl Iterator<Item = &FullMode> {
    solution.modes.iter().filter(|mode| mode.real)
}

fn check(entry: &Entry) {
    let (name, chain) = (&entry.name, entry.chain().unwrap());
    let derivation = match derive(entry, &entry.cases[0]) {
        // Loops of fewer unknowns are solved by other means.
        Err(error) if error.unsupported().is_some() && Layout::of(chain, None).unwrap().variables.len() < 6 => return,
        derivation => derivation.unwrap(),
    };
    let solution = solved(entry);
    for mode in real(&solution) {
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        assert_vanishing(name, &derivation, &named(chain, &q));
    }
    let Some(polynomial) = &derivation.polynomial else {
        assert_eq!(solution.verdict.status, Status::SelfMotion, "{name}");
        return;
    };
    let variable = &derivation.names.list()[polynomial.variable];
    let mut found: Vec<f64> = Vec::new();
    for mode in real(&solution) {
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        let value = named(chain, &q)[variable];
        let distance = distance(polynomial, variable.starts_with('t'), value);
        assert!(distance < 1e-7, "{name}: {variable} = {value} is {distance:e} from every root");
        found.push(value);
    }
    // Every complex solution is a root: where there are no other roots, the real ones are counted alike.
    if polynomial.degree() + polynomial.at_pi == solution.verdict.complex
        && polynomial.distinct() == polynomial.degree()
    {
        assert_eq!(polynomial.roots.len() + polynomial.at_pi, found.len(), "{name}: {}", verdict(&derivation));
    }
}

#[test]
fn loops_of_the_library_are_derived_as_they_are_solved() {
    folder("loop").iter().for_each(check);
    folder("chain").iter().for_each(check);
}

#[test]
fn arms_of_the_library_are_derived_as_they_are_solved() {
    folder("arm").iter().for_each(check);
}

/// Returns the pairs of legs that meet at the plate, and the triangle they carry.
fn triangle(design: &Design, case: &Case) -> Option<([[usize; 2]; 3], Triangle<Rational>)> {
    let Design::Platform(platform) = design else { return None };
    let platform = looproot::internal::mechanism::platform_over::<Rational>(platform)?;
    let squares = case.legs_squared.as_ref()?.each_ref().map(|square| square.rational().clone());
    let pairs = pairs(&platform)?;
    Some((pairs.legs, Triangle::new(&platform, &squares, &pairs)?))
}

#[test]
fn platforms_are_derived_as_they_are_solved() {
    let paths = [
        ("platform/platform_06real.toml", 1),
        ("platform/planar_both.toml", 1),
        ("platform/points_6_3.toml", 1),
        ("platform/points_3_3.toml", 2),
    ];
    for (path, per_root) in paths {
        let entry = entry(path);
        let derivation = derive(&entry, &entry.cases[0]).unwrap();
        let solution = solved(&entry);
        let polynomial = derivation.polynomial.as_ref().unwrap();
        let expected = solution.verdict.complex / per_root;
        assert_eq!((polynomial.degree(), polynomial.distinct()), (expected, expected), "{path}");
        assert_eq!(derivation.per_root, per_root, "{path}");
        let design = &entry.design;
        let triangle = triangle(design, &entry.cases[0]);
        assert_eq!(derivation.equations.len(), if triangle.is_some() { 13 } else { 7 }, "{path}");
        assert_eq!(derivation.warnings, entry.cases[0].warnings, "{path}");
        let poses: Vec<&RootPose> = polynomial.roots.iter().flat_map(|root| &root.poses).collect();
        assert_eq!(poses.len(), solution.verdict.real, "{path}");
        for root in &polynomial.roots {
            assert!(root.poses.len() == per_root || (per_root == 2 && root.poses.is_empty()), "{path}");
        }
        for mode in real(&solution) {
            let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
            let apart = |pose: &&RootPose| {
                let list = pose.quaternion.iter().chain(&pose.position);
                list.zip(&q).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
            };
            let nearest = poses.iter().map(apart).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-11, "{path}: {nearest:e}");
            // y = p x
            let ([w, i, j, k], [x, y, z]) = ([q[0], q[1], q[2], q[3]], [q[4], q[5], q[6]]);
            let y = [-x * i - y * j - z * k, x * w + y * k - z * j, y * w + z * i - x * k, z * w + x * j - y * i];
            let mut values: BTreeMap<String, f64> = BTreeMap::new();
            for n in 0..4 {
                values.insert(format!("x{n}"), q[n]);
                values.insert(format!("y{n}"), y[n]);
            }
            if let Some((legs, triangle)) = &triangle {
                let Design::Platform(platform) = design else { panic!("{path}") };
                let quaternion = Quaternion { scalar: w, vector: [i, j, k] };
                let rotation = quaternion.scaled_rotation();
                for ((n, [leg, _]), circle) in (1..).zip(legs).zip(&triangle.circles) {
                    let plate = platform.plate[*leg].each_ref().map(Number::to_f64);
                    let along = |arm: usize| -> f64 {
                        let part = |m: usize| {
                            let turned: f64 = (0..3).map(|c| rotation[m][c] * plate[c]).sum();
                            (turned + q[4 + m] - circle.centre[m].to_f64()) * circle.arms[arm][m].to_f64()
                        };
                        (0..3).map(part).sum::<f64>() / circle.squares[arm].to_f64()
                    };
                    values.insert(format!("a{n}"), along(0));
                    values.insert(format!("b{n}"), along(1));
                }
            }
            // The definition of k is linear in it.
            let definition = derivation.definition.as_ref().unwrap();
            let study = [q[0], q[1], q[2], q[3], y[0], y[1], y[2], y[3]];
            let at = |k: i32| {
                let parts = definition.coefficients_in(polynomial.variable);
                let [rest, factor] = parts.as_slice() else { panic!("{path}: linear in k") };
                let value = |p: &Polynomial<Rational>| -> f64 {
                    let image = p.map(|c| Some(c.to_f64())).unwrap();
                    image.evaluate(&study)
                };
                value(factor) * f64::from(k) + value(rest)
            };
            values.insert("k".to_owned(), at(0) / (at(0) - at(1)));
            assert_vanishing(path, &derivation, &values);
            assert!(distance(polynomial, false, values["k"]) < 1e-7 * (1.0 + values["k"].abs()), "{path}");
        }
    }
}

/// The entry's own poses stand with 12 digits; the derived ones are right to the last.
#[test]
fn poses_at_the_roots_are_right_to_the_last_digit() {
    let entry = entry("platform/half_turn.toml");
    let polynomial = derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap();
    let poses: Vec<&RootPose> = polynomial.roots.iter().flat_map(|root| &root.poses).collect();
    assert_eq!(poses.len(), 4);
    let third = 1.0 / 3.0;
    let planted = RootPose { quaternion: [0.0, 2.0 * third, -2.0 * third, third], position: [14.0, 16.0, -3.0] };
    assert!(poses.contains(&&planted), "{poses:?}");
    let (code, text, _) = run(&["derive", "platform/half_turn"]);
    let line = "    quaternion (0, 0.666666666666667, -0.666666666666667, 0.333333333333333), position (14, 16, -3)";
    assert!(code == 0 && text.lines().any(|found| found == line), "{text}");
    let (_, text, _) = run(&["derive", "platform/half_turn", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&text).unwrap();
    let listed: Vec<_> = document["roots"].as_array().unwrap().iter().map(|root| &root["poses"]).collect();
    assert_eq!(listed.len(), 4);
    assert!(listed.iter().any(|poses| poses[0]["position"] == serde_json::json!([14.0, 16.0, -3.0])));
}

#[test]
fn poses_of_one_rotation_are_multiple_roots() {
    for (path, distinct) in [("platform/congruent.toml", 12), ("platform/hexapod.toml", 26)] {
        let entry = entry(path);
        let polynomial = derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap();
        let solution = solved(&entry);
        assert_eq!((polynomial.degree(), polynomial.distinct()), (solution.verdict.complex, distinct), "{path}");
        let real: usize = polynomial.roots.iter().map(|root| root.multiplicity).sum();
        assert_eq!(real, solution.verdict.real, "{path}");
        for root in &polynomial.roots {
            assert_eq!(root.poses.len(), root.multiplicity, "{path}");
        }
    }
}

#[test]
fn the_text_of_a_derivation_names_what_it_shows() {
    let entry = entry("loop/general_7r.toml");
    let derivation = derive(&entry, &entry.cases[0]).unwrap();
    assert_eq!(derivation.equations.len(), 18);
    assert_eq!(derivation.equations[0].name, "Woernle-Lee 3-6 n.n'");
    let found = derivation.substituted(&entry, &entry.cases[0]).unwrap();
    let text = paper(&entry, 1, &derivation, &found, Style::Markdown);
    assert_eq!(text.matches("\\begin{aligned}").count(), 18 + 4 + 1);
}

/// Loops of four rotations with right angles and parallel axes: joints, half-angle tangents of twists, P angles.
fn special_loop(kinds: &str, number: u64) -> Entry {
    let mut state = number.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    let mut draw = |from: &[&'static str]| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        from[usize::try_from(state >> 40).unwrap() % from.len()]
    };
    let mut joints = String::new();
    for kind in kinds.chars() {
        let (twist, a) = (draw(&["1", "1", "-1", "1/2", "2/3"]), draw(&["0", "1", "2"]));
        let rest = match kind {
            'R' => format!("d = {}", draw(&["0", "1", "2"])),
            'P' => format!("tan_half_theta = \"{}\"", draw(&["0", "1", "-1", "inf", "1/2", "2/3"])),
            _ => "d0 = 0".to_owned(),
        };
        joints += &format!("{{ type = \"{kind}\", a = {a}, tan_half_alpha = \"{twist}\", {rest} }},\n");
    }
    let text = format!(
        "title = \"special\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n[[input]]\njoint = \
         {}\ntan_half = \"3/4\"\n",
        kinds.len()
    );
    let path = format!("{}/derive_special.toml", env!("CARGO_TARGET_TMPDIR"));
    fs::write(&path, text).unwrap();
    load(&path, &Options::default()).unwrap()
}

#[test]
fn false_roots_of_three_and_four_rotations_are_divided_out() {
    // The count bounds the solutions by other means: other cuts, other conditions, modulo a prime.
    let (mut compared, mut dependent) = (0, 0);
    for kinds in ["PRPRRRR", "RPPRRRR", "PRRPRRR", "RCRPRR", "CPRRRR", "CCCR", "CPRCR", "PPRRPRR"] {
        for number in 1..=12 {
            let entry = special_loop(kinds, number);
            let derivation = derive(&entry, &entry.cases[0]).unwrap();
            let (_, closed) = closed_loop::<ModP<PRIME_61>>(entry.chain().unwrap(), &entry.cases[0]).unwrap().unwrap();
            let (Some(polynomial), Some(count)) = (&derivation.polynomial, degree(&closed, None, 0)) else { continue };
            let what = format!("{kinds} {number}: {}", verdict(&derivation));
            assert_eq!(polynomial.degree() + polynomial.at_pi, count.solutions, "{what}");
            let removed: usize = polynomial.removed.iter().map(|one| one.multiplicity * degree_of(one)).sum();
            assert_eq!(removed, count.left_out, "{what}");
            compared += 1;
            dependent += usize::from(polynomial.removed.iter().any(|one| one.reason.contains("do not close")));
        }
    }
    assert!(compared > 70 && dependent > 10, "{dependent} of {compared} with dependent translations");
}

fn degree_of(removed: &Removed) -> usize {
    removed.factor.as_ref().map_or(1, |factor| usize::try_from(factor.total_degree().unwrap()).unwrap())
}

#[test]
fn the_sign_of_the_discriminant_is_that_of_a_resultant() {
    let mut signs = [0; 3];
    for path in
        ["loop/cccr_1_angle", "loop/crcrr_2_angle", "loop/rrsrr", "loop/c5r_angle", "loop/prrprrr_6_angle", "loop/rscr"]
    {
        let entry = entry(&format!("{path}.toml"));
        let polynomial = derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap();
        let p = polynomial.coefficients.map(|c| Some(Rational::from(c))).unwrap();
        let n = polynomial.degree();
        // (-1)^(n (n - 1)/2) Res(p, p')/lead, with a positive lead.
        let resultant = sylvester::resultant(&p, &p.derivative());
        let negative = (resultant < 0) != (n * (n - 1) / 2 % 2 == 1);
        let sign = if resultant.is_zero() {
            0
        } else if negative {
            -1
        } else {
            1
        };
        assert_eq!(polynomial.discriminant_sign(), Some(sign), "{path}");
        signs[usize::try_from(sign + 1).unwrap()] += 1;
    }
    assert!(signs[0] > 0 && signs[2] > 0, "{signs:?}");
    let entry = entry("platform/congruent.toml");
    assert_eq!(derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap().discriminant_sign(), Some(0));
}

fn run(arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.args(arguments).current_dir(crate::ROOT).stdin(Stdio::null());
    let output = command.output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn what_is_printed_is_what_was_printed() {
    let mut printed = String::new();
    for arguments in [
        &["derive", "cccr_1_angle"][..],
        &["derive", "crcrr_2_angle"],
        &["derive", "rrsrr", "--json", "--seed", "7"],
        &["derive", "rsrc", "--format", "singular"],
        &["derive", "ik_4r2p_wrist", "--quiet"],
        &["derive", "cprcr_2_distance", "--explain"],
        &["derive", "rssr", "--quiet"],
        &["derive", "cccr_4_angle", "--symbolic"],
        &["derive", "rssr", "--symbolic"],
    ] {
        let (code, out, err) = run(arguments);
        assert_eq!((code, err.as_str()), (0, ""), "{arguments:?}");
        printed += &format!("$ looproot {}\n{out}\n", arguments.join(" "));
    }
    let path = format!("{}/tests/golden/derive.txt", crate::ROOT);
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, &printed).unwrap();
    }
    assert_eq!(printed, fs::read_to_string(&path).unwrap(), "BLESS=1 writes {path}");
}

#[test]
fn exit_codes_tell_what_came_of_it() {
    let quiet = |name: &str| run(&["derive", name, "-q"]);
    assert_eq!(quiet("bricard_line_symmetric").0, 2);
    assert_eq!(quiet("platform_00real").0, 3);
    let (code, out, err) = quiet("no_such_entry");
    assert!(code == 1 && out.is_empty() && err.contains("no_such_entry"));
    let (code, _, err) = run(&["derive", "general_7r", "--input", "99"]);
    assert!(code == 1 && err.contains("99"), "{err}");
    // Both roots are at infinity: the angle is pi.
    let right = format!("{}/derive_pi.toml", env!("CARGO_TARGET_TMPDIR"));
    let cylinders = "{ type = \"C\", a = 1, alpha = \"pi/2\" },\n".repeat(3);
    let text = format!(
        "title = \"right angles\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{cylinders}{{ type = \"R\", \
         a = 1, alpha = \"pi/2\", d = 0 }}]\n[[input]]\njoint = 4\nangle = \"pi\"\n"
    );
    fs::write(&right, text).unwrap();
    let (code, out, _) = run(&["derive", &right, "-q"]);
    assert_eq!((code, out.as_str()), (0, "degree 0 in t2, no finite root, 2 at t2 = inf (the angle pi)\n"));
    let planar = format!("{}/derive_planar.toml", env!("CARGO_TARGET_TMPDIR"));
    let joints = "{ type = \"P\", a = 1, alpha = \"pi/3\", d0 = 0, theta = 1 },\n".repeat(5);
    let joints = joints + &"{ type = \"R\", a = 1, alpha = \"pi/3\", d = 0 },\n".repeat(2);
    let text = format!(
        "title = \"slides\"\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n[[input]]\njoint = 7\nangle = 1\n"
    );
    fs::write(&planar, text).unwrap();
    let (code, out, err) = run(&["derive", &planar]);
    assert!(code == 4 && out.is_empty() && err.contains("exact route"), "{code} {err}");
}
