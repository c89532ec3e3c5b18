//! One row per entry of the library and stage, beside the eigenvalues of one 16 x 16 matrix.
//!
//! `cargo bench --bench speed`, or `cargo bench --bench speed -- puma560` for one entry; the first case of each.
#![allow(clippy::unwrap_used)]

use divan::{Bencher, black_box};
use looproot::internal::assembly::{Assembly, Roots, Solver, Workspace};
use looproot::internal::benchmark::sample::{Set, sample};
use looproot::internal::catalogue::entry::{Entry, InputValue, Kind};
use looproot::internal::catalogue::{Options, builtin, builtin_names};
use looproot::internal::kinematics::closed_loop::{Layout, OpenLoop, Variable, angle_motion, distance_motion};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::solve::eigen::EigenWorkspace;
use looproot::internal::solve::francis;

fn main() {
    divan::main();
}

/// Returns the loop of an entry, and its closing transformation in the first case.
fn first_case(entry: &Entry) -> (OpenLoop<f64>, Motion<f64>) {
    let (case, chain) = (&entry.cases[0], entry.chain().unwrap());
    let (locked, closing) = if let Some(pose) = &case.pose {
        (None, pose.float.inverse())
    } else {
        let input = &case.input[0];
        let (wanted, closing) = match &input.value {
            InputValue::Angle(angle) => (Variable::Rotation, angle_motion(angle)),
            InputValue::Distance(distance) => (Variable::Translation, distance_motion(distance)),
        };
        (Layout::variable_of(chain, input.joint, wanted), closing.unwrap())
    };
    (chain.open_loop(&Layout::of(chain, locked).unwrap()).unwrap(), closing)
}

fn builtin_case(name: &str) -> (OpenLoop<f64>, Motion<f64>) {
    first_case(&builtin(name, &Options::default()).unwrap())
}

/// All arms and loops of six unknowns: with two spherical joints there are more, overconstrained loops have fewer.
fn names() -> Vec<String> {
    let has_six = |name: &String| {
        let entry = builtin(name, &Options::default()).unwrap();
        let given = entry.cases.first().map_or(0, |case| case.input.len());
        (given == 1 || entry.kind() == Kind::Arm)
            && entry.name != "rssr"
            && Layout::of(entry.chain().unwrap(), None).is_ok_and(|layout| layout.variables.len() == 6 + given)
    };
    builtin_names().into_iter().filter(has_six).collect()
}

/// The matrix of a general arm at a pose.
fn matrix() -> [[f64; 16]; 16] {
    let (open, closing) = first_case(&sample(Set::General, 1, 0).unwrap().entry);
    Solver::prepare(&open).companion(&closing).unwrap()
}

/// The measure of all times: eigenvalues of one matrix by faer.
#[divan::bench]
fn eigenvalues_faer(bencher: Bencher) {
    let (matrix, mut workspace) = (matrix(), EigenWorkspace::default());
    bencher.bench_local(|| workspace.of_matrix(black_box(&matrix)));
}

/// The eigenvalues by our own routine.
#[divan::bench]
fn eigenvalues_own(bencher: Bencher) {
    let matrix = matrix();
    bencher.bench_local(|| francis::eigenvalues(&mut black_box(matrix)));
}

/// All that depends on the geometry alone.
#[divan::bench(args = names())]
fn prepare(bencher: Bencher, name: &str) {
    let (open, _) = builtin_case(name);
    bencher.bench_local(|| Solver::prepare(black_box(&open)));
}

/// One pose or input, real solutions only.
#[divan::bench(args = names())]
fn solve_real(bencher: Bencher, name: &str) {
    solve(bencher, name, Roots::Real);
}

/// One pose or input, all solutions.
#[divan::bench(args = names())]
fn solve_all(bencher: Bencher, name: &str) {
    solve(bencher, name, Roots::All);
}

fn solve(bencher: Bencher, name: &str, roots: Roots) {
    let (open, closing) = builtin_case(name);
    let solver = Solver::prepare(&open);
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    bencher.bench_local(|| {
        solver.solve(black_box(&closing), roots, &mut workspace, &mut assembly);
        assembly.modes.len()
    });
}
