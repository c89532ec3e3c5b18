//! Sweeps: branches, limit positions and derivatives of loops against closed forms, finite differences and the solver itself.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, wrapped};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, load, load_text};
use looproot::internal::elimination::spherical_pair;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{Derivatives, InputCurve, Mechanism, Solution, ss_dyad_loop};
use looproot::internal::sweep::{End, Range, Sweep, case, sweep};
use std::f64::consts::PI;
use std::process::{Command, Output};

fn entry(name: &str) -> Entry {
    load(name, &Options::default()).unwrap()
}

fn swept(name: &str, joint: usize, variable: Variable, range: [f64; 2], steps: usize) -> Sweep {
    swept_entry(&entry(name), joint, variable, range, steps)
}

fn swept_entry(entry: &Entry, joint: usize, variable: Variable, [from, to]: [f64; 2], steps: usize) -> Sweep {
    sweep(entry, joint, variable, Range { from, to, steps }, || true, || {}).unwrap()
}

/// A loop of joints of these kinds with data of its own.
fn own(kinds: &str) -> Entry {
    let joint = |(kind, k): (char, usize)| {
        let (a, twist) = (1 + k * k % 4, ["1/2", "-2/3", "3/4", "-1/3"][k % 4]);
        let rest = match kind {
            'P' => "tan_half_theta = \"1/3\"".to_owned(),
            'C' => "d0 = 0".to_owned(),
            _ => format!("d = \"{}/2\"", k % 3),
        };
        format!("{{ type = \"{kind}\", a = {a}, tan_half_alpha = \"{twist}\", {rest} }},\n")
    };
    let joints: String = kinds.chars().zip(0..).map(joint).collect();
    let first = kinds.find(['R', 'P']).unwrap();
    let value = if kinds[first..].starts_with('R') { "angle = 1" } else { "distance = 1" };
    let (head, input) = ("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"", first + 1);
    let text = format!("{head}\njoints = [\n{joints}]\n[[input]]\njoint = {input}\n{value}\n");
    load_text(&text, "own.toml", Format::Toml, &Options::default()).unwrap()
}

/// A loop at one input, its curve, and what is found there.
struct At {
    solution: Solution,
    curve: InputCurve,
}

fn at(name: &str, joint: usize, variable: Variable, input: f64) -> At {
    at_entry(entry(name), joint, variable, input)
}

fn at_entry(mut entry: Entry, joint: usize, variable: Variable, input: f64) -> At {
    entry.cases = vec![case(joint, variable, input)];
    let mechanism = Mechanism::prepare(&entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let solution = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
    At { solution, curve: InputCurve::of(&entry, &entry.cases[0]).unwrap() }
}

impl At {
    fn real(&self) -> Vec<Vec<f64>> {
        let real = self.solution.modes.iter().filter(|mode| mode.real);
        real.map(|mode| mode.q.iter().map(|z| z.re).collect()).collect()
    }

    fn derivatives(&self) -> Vec<Derivatives> {
        let real = self.solution.modes.iter().filter(|mode| mode.real);
        real.map(|mode| self.curve.derivatives(mode).unwrap()).collect()
    }

    /// The changes from a mode to the nearest one here.
    fn change(&self, q: &[f64]) -> Vec<f64> {
        let variables = self.curve.variables();
        let change = |other: &Vec<f64>| -> Vec<f64> {
            let pairs = other.iter().zip(q).zip(variables);
            pairs.map(|((a, b), v)| if *v == Variable::Rotation { wrapped(a - b) } else { a - b }).collect()
        };
        let size = |v: &Vec<f64>| v.iter().map(|x| x.abs()).fold(0.0, f64::max);
        self.real().iter().map(change).min_by(|a, b| size(a).total_cmp(&size(b))).unwrap()
    }
}

#[test]
fn derivatives_agree_with_finite_differences_of_the_solver() {
    const STEP: f64 = 1e-3;
    for (name, joint, variable, input) in [
        ("crcrr_2_angle", 2, Variable::Rotation, 1.176_005_207_095_135),
        ("rrsrr", 1, Variable::Rotation, 2.5),
        ("rscr", 3, Variable::Translation, -1.5),
        ("rssr", 1, Variable::Rotation, 1.0),
        ("rssr", 4, Variable::Rotation, 2.5),
        ("general_7r", 1, Variable::Rotation, -1.080_839_000_541_168),
        ("cprcr_2_distance", 2, Variable::Translation, 0.75),
    ] {
        let here = at(name, joint, variable, input);
        let [two_behind, behind, ahead, two_ahead] =
            [-2.0, -1.0, 1.0, 2.0].map(|k| at(name, joint, variable, input + k * STEP));
        let modes = here.real();
        assert!(!modes.is_empty(), "{name}");
        for (q, derivatives) in modes.iter().zip(here.derivatives()) {
            let [a, b, c, d] = [&two_behind, &behind, &ahead, &two_ahead].map(|there| there.change(q));
            for k in 0..q.len() {
                // Differences of fourth order.
                let velocity = (8.0 * (c[k] - b[k]) - (d[k] - a[k])) / (12.0 * STEP);
                let acceleration = (16.0 * (c[k] + b[k]) - (d[k] + a[k])) / (12.0 * STEP * STEP);
                let size = 1.0 + derivatives.acceleration.iter().map(|x| x.abs()).fold(0.0, f64::max).powi(2);
                let (v, w) = (derivatives.velocity[k], derivatives.acceleration[k]);
                assert!((v - velocity).abs() < 1e-7 * size, "{name} variable {k}: {v} {velocity}");
                assert!((w - acceleration).abs() < 1e-5 * size, "{name} variable {k}: {w} {acceleration}");
            }
            let input = here.curve.input();
            assert!((derivatives.velocity[input] - 1.0).abs() < 1e-14 && derivatives.acceleration[input].abs() < 1e-13);
        }
    }
}

#[test]
fn accelerations_are_derivatives_of_velocities() {
    const STEP: f64 = 1e-4;
    let [behind, here, ahead] = [-STEP, 0.0, STEP].map(|h| at("crcrr_2_angle", 2, Variable::Rotation, 1.2 + h));
    let nearest = |there: &At, q: &[f64]| {
        let size = |v: &Vec<f64>| v.iter().zip(q).map(|(a, b)| wrapped(a - b).abs()).fold(0.0, f64::max);
        let modes = there.real();
        let best = (0..modes.len()).min_by(|a, b| size(&modes[*a]).total_cmp(&size(&modes[*b]))).unwrap();
        there.derivatives()[best].clone()
    };
    for (q, derivatives) in here.real().iter().zip(here.derivatives()) {
        let (before, after) = (nearest(&behind, q), nearest(&ahead, q));
        for k in 0..q.len() {
            let acceleration = (after.velocity[k] - before.velocity[k]) / (2.0 * STEP);
            assert!((acceleration - derivatives.acceleration[k]).abs() < 1e-5, "variable {k}");
        }
    }
}

/// CCCR: its angles are those of a spherical four-bar with sides of 2 atan(1/2), (3/4), (2/5), (1/3). It stands in a limit
/// position where the two sides beyond the input lie on one great circle.
#[test]
fn limit_positions_of_a_spherical_four_bar_are_those_of_its_triangle() {
    let [a, b, c, d] = [1.0 / 2.0, 3.0 / 4.0, 2.0 / 5.0, 1.0 / 3.0_f64].map(|t: f64| 2.0 * t.atan());
    let stretched = |opening: f64| (a.cos() * d.cos() - opening.cos()) / (a.sin() * d.sin());
    let mut expected: Vec<f64> = [stretched(b - c), stretched(b + c)]
        .into_iter()
        .filter(|cos| cos.abs() < 1.0)
        .flat_map(|cos| [cos.acos(), -cos.acos()])
        .collect();
    expected.sort_by(f64::total_cmp);
    for range in [[-PI, PI], [PI, -PI], [-3.0, 3.0]] {
        let found = swept("cccr_1_angle", 1, Variable::Rotation, range, 90);
        let inputs: Vec<f64> = found.limits.iter().map(|limit| limit.input).collect();
        assert_eq!(inputs.len(), expected.len(), "{inputs:?} {expected:?}");
        for (x, y) in inputs.iter().zip(&expected) {
            assert!((x - y).abs() < 1e-10, "{x} {y}");
        }
        assert_eq!(found.unresolved(), 0);
        assert!(found.samples.iter().all(looproot::internal::sweep::Sample::is_complete));
    }
}

/// Halves an interval at whose ends the numbers of real modes differ.
fn change_of_count(name: &str, mut low: f64, mut high: f64) -> f64 {
    let count = |x: f64| at(name, 1, Variable::Rotation, x).real().len();
    let at_low = count(low);
    assert_ne!(at_low, count(high));
    while high - low > 1e-7 {
        let middle = f64::midpoint(low, high);
        if count(middle) == at_low { low = middle } else { high = middle }
    }
    f64::midpoint(low, high)
}

#[test]
fn limit_positions_are_where_the_number_of_real_modes_changes() {
    for name in ["rrsrr", "general_7r"] {
        let found = swept(name, 1, Variable::Rotation, [-PI, PI], 60);
        assert!(!found.limits.is_empty() && found.unresolved() == 0, "{name}");
        for limit in &found.limits {
            let near = found.limits.iter().filter(|other| (other.input - limit.input).abs() < 4e-3).count();
            if near == 1 {
                let x = change_of_count(name, limit.input - 2e-3, limit.input + 2e-3);
                assert!((x - limit.input).abs() < 1e-6, "{name}: {x} {}", limit.input);
            }
            assert_eq!(limit.branches.len(), 2, "{name} {limit:?}");
        }
    }
}

/// Every real mode of every input lies on one branch, and branches do not jump.
#[test]
fn branches_hold_every_mode_once_and_are_continuous() {
    for (name, joint) in [("rrsrr", 1), ("general_7r", 1), ("crcrr_2_angle", 2)] {
        let found = swept(name, joint, Variable::Rotation, [-PI, PI], 120);
        assert_eq!(found.unresolved(), 0, "{name}");
        let curve = at(name, joint, Variable::Rotation, 0.1).curve;
        let mut met: Vec<Vec<usize>> = found.samples.iter().map(|sample| vec![0; sample.modes.len()]).collect();
        for branch in &found.branches {
            for row in &branch.rows {
                met[row.step][row.mode] += 1;
            }
            for pair in branch.rows.windows(2) {
                let next = (pair[0].step + 1) % found.samples.len();
                assert!(pair[1].step == next || pair[1].step == pair[0].step, "{name}");
            }
            if matches!(branch.begin, End::Closed(_)) {
                assert!(branch.rows.len() >= 121, "{name}");
            }
        }
        assert!(met.iter().flatten().all(|count| *count == 1), "{name}: {met:?}");
        assert!(found.is_full_turn && curve.variables().len() == 7);
    }
}

/// Three limit positions lie between two neighbouring inputs of the coarse sweep.
#[test]
fn limit_positions_within_a_step_are_found() {
    let coarse = swept("three_parallel_in_series", 1, Variable::Rotation, [-PI, PI], 60);
    let fine = swept("three_parallel_in_series", 1, Variable::Rotation, [-PI, PI], 720);
    for found in [&coarse, &fine] {
        assert_eq!((found.branches.len(), found.limits.len(), found.unresolved()), (4, 4, 0));
        assert!(found.limits.iter().all(|limit| limit.branches.len() == 2));
        assert!(found.branches.iter().all(|branch| branch.circuit == 1));
    }
    let sorted = |found: &Sweep| {
        let mut inputs: Vec<f64> = found.limits.iter().map(|limit| limit.input).collect();
        inputs.sort_by(f64::total_cmp);
        inputs
    };
    for (one, two) in sorted(&coarse).iter().zip(sorted(&fine)) {
        assert!((one - two).abs() < 1e-12);
    }
    assert_eq!(coarse.branches.iter().filter(|branch| branch.rows.is_empty()).count(), 2);
}

#[test]
fn a_limit_position_on_the_way_to_infinity_is_found() {
    let [coarse, fine] = [37, 360].map(|steps| swept("ccprr_4_angle", 4, Variable::Rotation, [-PI, PI], steps));
    for found in [&coarse, &fine] {
        assert_eq!((found.branches.len(), found.limits.len(), found.unresolved()), (4, 2, 0));
        assert!(found.limits.iter().all(|limit| limit.branches.len() == 2));
    }
    assert!((coarse.limits[0].input - fine.limits[0].input).abs() < 1e-12);
}

fn run(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).env_remove("NO_COLOR").output().unwrap()
}

fn printed(arguments: &[&str]) -> String {
    let output = run(arguments);
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    String::from_utf8(output.stdout).unwrap()
}

#[test]
fn a_reader_sees_the_verdict_first() {
    let text = printed(&["sweep", "cccr_1_angle", "--from", "-180 deg", "--to", "pi", "--steps", "60"]);
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/sweep.txt");
    if std::env::var_os("LOOPROOT_BLESS").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    let golden = std::fs::read_to_string(path).unwrap_or_default();
    assert!(golden == text, "tests/golden/sweep.txt says\n{golden}\nbut now it is\n{text}");
    let quiet = printed(&["sweep", "cccr_1_angle", "--from", "0", "--to", "1", "--steps", "4", "--quiet"]);
    assert_eq!(quiet, "2 branches, 0 limit positions, 5 inputs, all complete; branches proved\n");
}

#[test]
fn csv_has_a_row_for_every_branch_and_step() {
    let text = printed(&["sweep", "cccr_1_angle", "--from", "0", "--to", "1", "--steps", "4", "--csv"]);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "branch,circuit,turn,step,input,status,q1,d1,q2,d2,q3,d3,q4");
    assert_eq!(lines.len(), 11);
    assert!(lines[1..].iter().all(|line| line.split(',').count() == 13 && line.contains(",complete,")));
}

#[test]
fn a_translation_is_swept_in_metres() {
    let text = printed(&["sweep", "cprcr_2_distance", "--from", "500 mm", "--to", "1", "--steps", "5"]);
    assert!(text.contains("q2 from 0.5 to 1 m in 5 steps"), "{text}");
    let angle =
        printed(&["sweep", "cprcr_2_distance", "--joint", "q3", "--from", "0", "--to", "5 deg", "--steps", "2"]);
    assert!(angle.contains("q3 from 0 to 5 deg"), "{angle}");
}

#[test]
fn branches_of_a_four_bar_are_certified() {
    let path = concat!(env!("CARGO_TARGET_TMPDIR"), "/four_bar.cert");
    let turn = ["--from", "0", "--to", "360 deg", "--steps", "12", "-q", "--certificate", path];
    for (entry, holds) in [
        (&["linkage/watt_line"][..], "branches 2, circuits 1, limit positions 2"),
        (&["overconstrained/spherical_4r", "--joint", "4"], "branches 4, circuits 2, limit positions 4"),
        (&["overconstrained/slider_crank", "--joint", "2"], "branches 2, circuits 2, limit positions 0"),
    ] {
        printed(&[&["sweep"][..], entry, &turn].concat());
        let answer = printed(&["verify", path, "--file", entry[0]]);
        assert!(answer.contains(holds), "{answer}");
        assert_eq!(run(&["verify", path, "--file", "linkage/holditch"]).status.code(), Some(2));
        let changed = std::fs::read_to_string(path).unwrap().replace("\"crank\":[\"", "\"crank\":[\"7");
        std::fs::write(path, changed).unwrap();
        assert_eq!(run(&["verify", path]).status.code(), Some(2), "{entry:?}");
        std::fs::remove_file(path).unwrap();
    }
    let none = run(&[&["sweep", "bennett_a", "--joint", "1"][..], &turn].concat());
    assert!(String::from_utf8_lossy(&none.stderr).contains("no certificate: only loops RSSR"), "{none:?}");
    assert!(!std::path::Path::new(path).exists());
}

#[test]
fn what_cannot_be_swept_is_said() {
    let range = ["--from", "0", "--to", "1"];
    for (arguments, words) in [
        (&["rrsrr", "--joint", "9"][..], "expected one from 1 to 5"),
        (&["rrsrr", "--joint", "0"], "expected one from 1 to 5"),
        (&["rrsrr", "--joint", "first"], "expected the number of a joint"),
        (&["rrsrr", "--joint", "3"], "Spherical"),
        (&["rrsrr", "--joint", "d1"], "has no distance"),
        (&["rrsrr", "--steps", "0"], "expected 1 to 100000"),
        (&["rrsrr", "--steps", "100001"], "expected 1 to 100000"),
        (&["rrsrr", "--steps", "some"], "expected 1 to 100000"),
        (&["puma560"], "found an arm, expected a loop"),
        (&["platform/hexapod"], "found a platform and no --joint, expected a leg, leg1 to leg6"),
        (&["rrsrr", "--csv", "--json"], "cannot be used with"),
    ] {
        let output = run(&[&["sweep"][..], arguments, &range].concat());
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && message.contains(words), "{arguments:?}: {message}");
    }
    for (range, words) in [
        (["--from", "1", "--to", "1"], "expected a range"),
        (["--from", "1 mm", "--to", "1"], "--from: found `1 mm`, expected an angle"),
        (["--from", "0", "--to", "east"], "--to: "),
    ] {
        let output = run(&[&["sweep", "rrsrr"][..], &range].concat());
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && message.contains(words), "{range:?}: {message}");
    }
    for name in ["puma560", "platform/hexapod"] {
        let output = run(&["solve", name, "--derivatives"]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.code() == Some(1) && message.contains("derivatives are by its input"), "{message}");
    }
}

#[test]
fn derivatives_are_printed_beside_the_modes() {
    let text = printed(&["solve", "cprcr_2_distance", "--derivatives"]);
    assert!(text.contains("\nvelocities, unit rate of q2\n") && text.contains("q1 [rad/m]"), "{text}");
    assert!(text.contains("\naccelerations, unit rate and no acceleration of q2\n") && text.contains("[m/m^2]"));
}

#[test]
fn help_and_completions_know_sweep() {
    assert!(printed(&["--help"]).contains("sweep"));
    assert!(printed(&["sweep", "--help"]).contains("--steps"));
    assert!(printed(&["completions", "bash"]).contains("sweep"));
}

/// Two circuits, each within one step: no input of the sweep has a real mode.
#[test]
fn circuits_within_one_step_are_found() {
    let degrees = |x: f64| x.to_radians();
    let found = swept("cprprr_5_angle", 5, Variable::Rotation, [degrees(-80.0), degrees(130.0)], 3);
    assert!(found.samples.iter().all(|sample| sample.modes.is_empty()));
    let inputs: Vec<f64> = found.limits.iter().map(|limit| limit.input.to_degrees()).collect();
    let expected = [-75.8711, -15.8067, 62.9112, 122.9757];
    assert_eq!(inputs.len(), 4, "{inputs:?}");
    assert!(inputs.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-4), "{inputs:?}");
    assert_eq!(found.branches.iter().map(|branch| branch.circuit).max(), Some(2));
    assert_eq!(found.unresolved(), 0);
}

/// A picture has a panel for every joint but the input, every limit position in each, and no NaN.
#[test]
fn a_picture_shows_every_joint_and_every_limit_position() {
    let program = env!("CARGO_BIN_EXE_looproot");
    let run = |options: &[&str]| -> Output {
        let range = ["sweep", "cprprr_5_angle", "--from", "-180 deg", "--to", "180 deg", "--steps", "90"];
        Command::new(program).args(range).args(options).output().unwrap()
    };
    let picture = String::from_utf8(run(&["--svg"]).stdout).unwrap();
    assert!(picture.starts_with("<svg ") && picture.ends_with("</svg>\n"));
    for name in ["q1 [deg]", "d1 [m]", "q2 [m]", "q3 [deg]", "q4 [m]", "q6 [deg]"] {
        assert_eq!(picture.matches(&format!(">{name}<")).count(), 1, "{name}");
    }
    assert_eq!(picture.matches("<circle").count(), 6 * 4);
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
    assert_eq!(run(&["--svg", "--csv"]).status.code(), Some(1));
}

#[test]
fn overconstrained_loops_keep_closed_through_a_full_turn() {
    let names = ["bennett_a", "goldberg_a", "myard_a", "bricard_line_symmetric_a", "bricard_trihedral_a", "rrcrp_a"];
    for (name, branches) in names.into_iter().zip([1, 1, 1, 2, 2, 2]) {
        let found = swept(name, 1, Variable::Rotation, [0.0, 2.0 * PI], 36);
        assert_eq!(found.branches.len(), branches, "{name}");
        assert!(
            found.unresolved() == 0 && found.samples.iter().all(looproot::internal::sweep::Sample::is_complete),
            "{name}"
        );
        let entry = entry(name);
        let chain = entry.chain().unwrap();
        let kinds = looproot::internal::kinematics::closed_loop::Layout::of(chain, None).unwrap().variables;
        for q in found.samples.iter().flat_map(|sample| &sample.modes) {
            let motions = q.iter().zip(&kinds).map(|(x, kind)| match kind {
                Variable::Rotation => Motion::rotation_z(x.cos(), x.sin()),
                Variable::Translation => Motion::translation_z(*x),
            });
            let round = chain.forward(&motions.collect::<Vec<Motion<f64>>>()).unwrap();
            let identity = Motion::<f64>::identity();
            for i in 0..3 {
                assert!(round.translation[i].abs() < 1e-13, "{name} {q:?}");
                for j in 0..3 {
                    assert!((round.rotation[i][j] - identity.rotation[i][j]).abs() < 1e-13, "{name} {q:?}");
                }
            }
        }
    }
}

/// In the flat positions at 0 and 180 degrees the axes lose another rank: the only solution is multiple there, and close by
/// the matrix of the curve is nearly singular.
#[test]
fn a_loop_runs_through_flat_positions() {
    for ([from, to], steps) in [([-180.0_f64, 180.0_f64], 72), ([0.0, 360.0], 36), ([-179.0, 181.0], 71)] {
        let range = [from.to_radians(), to.to_radians()];
        let found = swept("double_goldberg", 1, Variable::Rotation, range, steps);
        assert!(found.samples.iter().all(looproot::internal::sweep::Sample::is_complete), "{from}");
        let inputs: Vec<f64> = found.samples.iter().flat_map(|sample| &sample.modes).map(|q| q[0]).collect();
        assert_eq!(inputs, (0..=steps).map(|step| found.range.input(step)).collect::<Vec<f64>>());
        let [branch] = found.branches.as_slice() else { panic!("{from}: {} branches", found.branches.len()) };
        assert!(branch.begin == End::Closed(1) && branch.end == End::Closed(1), "{branch:?}");
        assert!(found.limits.is_empty());
    }
}

/// Numbers of degrees: no mode is counted, but all close to rounding, and the branch is that of the exact loop.
#[test]
fn a_loop_of_rounded_numbers_is_followed() {
    let text = r#"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "R", a = "3*sin(40 deg)", alpha = "40 deg", d = 0 },
            { type = "R", a = "3*sin(65 deg)", alpha = "65 deg", d = 0 },
            { type = "R", a = "3*sin(40 deg)", alpha = "40 deg", d = 0 },
            { type = "R", a = "3*sin(65 deg)", alpha = "65 deg", d = 0 },
        ]
    "#;
    let entry = load_text(text, "own.toml", Format::Toml, &Options::default()).unwrap();
    let range = Range { from: -PI, to: PI, steps: 48 };
    let found = sweep(&entry, 1, Variable::Rotation, range, || true, || ()).unwrap();
    let [branch] = found.branches.as_slice() else { panic!("{} branches", found.branches.len()) };
    assert!(branch.begin == End::Closed(1) && branch.rows.len() == 49 && found.unresolved() == 0);
    // tan(q1/2) tan(q2/2) of Bennett's loop.
    let half = |degrees: f64| (degrees / 2.0).to_radians();
    let product = half(105.0).sin() / half(25.0).sin();
    for q in found.samples.iter().flat_map(|sample| &sample.modes).filter(|q| (q[0].sin()).abs() > 1e-3) {
        assert!((((q[0] / 2.0).tan() * (q[1] / 2.0).tan() / product).abs() - 1.0).abs() < 1e-9, "{q:?}");
    }
}

/// Idle joints in place of the missing ones are dependent near this position of a subtractive Goldberg loop, its own are not.
#[test]
fn positions_singular_for_idle_joints_only_are_passed() {
    let found = swept("goldberg_subtractive", 2, Variable::Rotation, [-PI, PI], 72);
    assert_eq!((found.branches.len(), found.unresolved()), (1, 0));
    assert_eq!(found.branches[0].begin, End::Closed(1));
}

/// A pole of large residue: the translations are beyond what double precision follows long before it.
#[test]
fn poles_of_large_residue_are_told() {
    for (name, joint) in [("cprcr_every_input", 3), ("crpprr_every_input", 2)] {
        let found = swept(name, joint, Variable::Rotation, [-PI, PI], 72);
        assert_eq!(found.unresolved(), 0, "{name}");
    }
}

/// The discriminant of the one equation of two spherical joints, A^2 + B^2 - C^2 of an angle, at an input.
fn discriminant(entry: &Entry, joint: usize, variable: Variable, input: f64) -> f64 {
    let ss_dyad = ss_dyad_loop::<f64>(entry.chain().unwrap(), &case(joint, variable, input)).unwrap().unwrap();
    let [c, a, b] = spherical_pair::equation(&ss_dyad);
    match ss_dyad.variable {
        Variable::Rotation => a * a + b * b - c * c,
        Variable::Translation => 0.25 * a * a - c * b,
    }
}

/// Loops of two spherical joints, both of their other joints as input: a rotation or a translation on the same side of the spherical joints or one
/// on each side.
#[test]
fn limit_positions_of_two_balls_are_where_a_discriminant_vanishes() {
    let mut found_any = 0;
    for kinds in ["rssr", "RSSR", "PSSR", "RSSP", "PSSP", "RSRS", "RSPS", "PSPS"] {
        let entry = if kinds == "rssr" { entry(kinds) } else { own(kinds) };
        for (joint, kind) in (1..).zip(kinds.to_uppercase().chars()).filter(|(_, kind)| *kind != 'S') {
            let (variable, range) = match kind {
                'R' => (Variable::Rotation, [-PI, PI]),
                _ => (Variable::Translation, [-12.0, 12.0]),
            };
            let swept = swept_entry(&entry, joint, variable, range, 90);
            assert_eq!(swept.unresolved(), 0, "{kinds} {joint}");
            assert!(swept.samples.iter().all(looproot::internal::sweep::Sample::is_complete), "{kinds} {joint}");
            let at = |input: f64| discriminant(&entry, joint, variable, input);
            let largest = (0..=90).map(|step| at(swept.range.input(step)).abs()).fold(0.0, f64::max);
            for limit in &swept.limits {
                assert!(at(limit.input).abs() < 1e-11 * largest, "{kinds} {joint}: {}", at(limit.input) / largest);
            }
            let fine = Range { from: range[0], to: range[1], steps: 2000 };
            let signs: Vec<bool> = (0..=2000).map(|step| at(fine.input(step)) > 0.0).collect();
            let changes = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
            assert_eq!(swept.limits.len(), changes, "{kinds} {joint}");
            found_any += changes;
            assert!(swept.note.as_ref().is_some_and(|note| note.contains("universal joint")));
        }
    }
    assert!(found_any > 10, "{found_any}");
}

/// All joints of all modes close the loop, and a branch is continuous in all of them, the idle spin included.
#[test]
fn branches_of_two_balls_are_continuous_in_every_joint() {
    for (entry, joint) in [(entry("rssr"), 1), (entry("rssr"), 4), (own("RSSR"), 1), (own("RSPS"), 1)] {
        let swept = swept_entry(&entry, joint, Variable::Rotation, [-PI, PI], 720);
        let mut met: Vec<Vec<usize>> = swept.samples.iter().map(|sample| vec![0; sample.modes.len()]).collect();
        for branch in &swept.branches {
            for row in &branch.rows {
                met[row.step][row.mode] += 1;
            }
            let turns = |row: &looproot::internal::sweep::Row| {
                let q = &swept.samples[row.step].modes[row.mode];
                q.iter().flat_map(|x| [x.cos(), x.sin()]).collect::<Vec<f64>>()
            };
            let jumps = branch.rows.windows(2).map(|pair| {
                let (one, two) = (turns(&pair[0]), turns(&pair[1]));
                one.iter().zip(two).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
            });
            // Steep beside limit positions only.
            let large = jumps.filter(|jump| *jump > 0.2).count();
            assert!(large <= 2, "{joint}: {large}");
        }
        assert!(met.iter().flatten().all(|count| *count == 1), "{joint}");
    }
}

#[test]
fn derivatives_of_two_balls_agree_with_finite_differences() {
    const STEP: f64 = 1e-4;
    let mut compared = 0;
    for (kinds, joint, variable) in [
        ("PSSR", 4, Variable::Rotation),
        ("RSSP", 4, Variable::Translation),
        ("RSRS", 1, Variable::Rotation),
        ("RSPS", 3, Variable::Translation),
    ] {
        for input in [-2.0, -0.7, 0.4, 1.3, 2.6] {
            let there = |h: f64| at_entry(own(kinds), joint, variable, input + h);
            let here = there(0.0);
            for (q, derivatives) in here.real().iter().zip(here.derivatives()) {
                let [behind, ahead] = [there(-STEP), there(STEP)].map(|there| there.change(q));
                let size = 1.0 + derivatives.acceleration.iter().map(|x| x.abs()).fold(0.0, f64::max).powi(2);
                for k in 0..q.len() {
                    let velocity = (ahead[k] - behind[k]) / (2.0 * STEP);
                    let acceleration = (ahead[k] + behind[k]) / (STEP * STEP);
                    let (v, w) = (derivatives.velocity[k], derivatives.acceleration[k]);
                    assert!((v - velocity).abs() < 1e-6 * size, "{kinds} {input} variable {k}: {v} {velocity}");
                    assert!((w - acceleration).abs() < 1e-4 * size, "{kinds} {input} variable {k}: {w} {acceleration}");
                }
                compared += 1;
            }
        }
    }
    assert!(compared > 10, "{compared}");
}

/// A spherical joint in place of a revolute joint of a planar four-bar turns about one axis only: its other angles stay where the three of
/// them are not independent.
#[test]
fn a_ball_that_turns_about_one_axis_only_is_followed() {
    let four_bar = |kinds: &str| {
        let joint = |(kind, a)| format!("{{ type = \"{kind}\", a = {a}, alpha = 0, d = 0 }},\n");
        let joints: String = kinds.chars().zip([3, 2, 3, 3]).map(joint).collect();
        let head = "[mechanism]\nkind = \"loop\"\nconvention = \"dh\"";
        let text = format!("{head}\njoints = [\n{joints}]\n[[input]]\njoint = 1\nangle = 1\n");
        load_text(&text, "own.toml", Format::Toml, &Options::default()).unwrap()
    };
    let plain = swept_entry(&four_bar("RRRR"), 1, Variable::Rotation, [-PI, PI], 60);
    assert!(!plain.limits.is_empty() && plain.unresolved() == 0);
    for kinds in ["RSRR", "RRSR", "RRRS"] {
        let entry = four_bar(kinds);
        let swept = swept_entry(&entry, 1, Variable::Rotation, [-PI, PI], 60);
        assert_eq!((swept.branches.len(), swept.unresolved()), (plain.branches.len(), 0), "{kinds}");
        assert_eq!(swept.limits.len(), plain.limits.len(), "{kinds}");
        for (one, two) in swept.limits.iter().zip(&plain.limits) {
            assert!((one.input - two.input).abs() < 1e-10, "{kinds}: {} {}", one.input, two.input);
        }
        let here = at_entry(entry, 1, Variable::Rotation, 1.0);
        for derivatives in here.derivatives() {
            assert!(derivatives.velocity.iter().chain(&derivatives.acceleration).all(|x| x.is_finite()), "{kinds}");
        }
    }
}

/// A structure closes at one of the inputs and does not move there.
#[test]
fn a_position_of_a_structure_is_isolated() {
    for name in ["structure_4r", "structure_6r"] {
        let found = swept(name, 1, Variable::Rotation, [-PI, PI], 12);
        assert_eq!((found.branches.len(), found.unresolved()), (1, 0), "{name}");
        let branch = &found.branches[0];
        assert_eq!((&branch.begin, &branch.end, branch.rows.len()), (&End::Isolated, &End::Isolated, 1), "{name}");
    }
}

/// With its slider d3 given, no two of the closure polynomials of this loop count its solutions: the ring of its equations does,
/// and finds the complex ones beyond the limit positions.
#[test]
fn a_loop_of_parallel_pairs_is_followed_by_its_translation() {
    let found = swept("rrcrp_a", 3, Variable::Translation, [-10.0, 10.0], 60);
    assert!(found.samples.iter().all(looproot::internal::sweep::Sample::is_complete));
    assert_eq!((found.branches.len(), found.limits.len(), found.unresolved()), (2, 2, 0));
}
