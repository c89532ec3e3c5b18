//! U joints: a chain has the answers of the same chain with two revolutes in the place of each of them.

use looproot::internal::assembly::{Assembly, Roots, Workspace};
use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::catalogue::{Options, builtin};
use looproot::internal::derivation::derive;
use looproot::internal::kinematics::chain::{Chain, Geometry, JointKind, Placement, ScrewJoint};
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::{Mechanism, Solution};
use looproot::internal::mobility::mobility;
use looproot::internal::sweep::{Range, sweep};
use looproot::internal::verdict::{Proof, Status};
use rug::Rational;

fn solve(entry: &Entry) -> Solution {
    let mechanism = Mechanism::prepare(entry).unwrap();
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap()
}

/// The screw axes of every joint variable in the home position: what a U joint is is not asked.
fn with_revolutes(chain: &Chain) -> Chain {
    let (variables, constants) = chain.unknowns_and_constants::<Rational>().unwrap();
    let exact = |v: [Rational; 3]| v.map(looproot_algebra::number::Number::exact);
    let mut frame = Motion::<Rational>::identity();
    let mut joints = Vec::new();
    for (variable, constant) in variables.iter().zip(&constants) {
        frame = frame.then_after(constant);
        let kind = if *variable == Variable::Rotation { JointKind::Revolute } else { JointKind::Prismatic };
        let axis = exact(std::array::from_fn(|i| frame.rotation[i][2].clone()));
        joints.push(ScrewJoint { kind, axis, point: exact(frame.translation.clone()), pitch: None });
    }
    let home = Box::new(Placement::from_motion_exact(frame.then_after(&constants[variables.len()])));
    let geometry = Geometry::Screws { joints, home };
    Chain { geometry, base: Placement::identity(), tool: Placement::identity() }
}

fn replaced(entry: &Entry) -> Entry {
    let mut other = entry.clone();
    let (Design::Arm(chain) | Design::Loop(chain)) = &mut other.design else { panic!("a chain") };
    *chain = with_revolutes(chain);
    for input in other.cases.iter_mut().flat_map(|case| &mut case.input) {
        assert_eq!(input.joint, 1, "the joint before every U joint keeps its number");
    }
    other
}

#[test]
fn universal_joints_are_two_revolutes() {
    for name in ["rurur", "arm_ruru", "hooke_rur"] {
        let entry = builtin(name, &Options::default()).unwrap();
        let (one, two) = (solve(&entry), solve(&replaced(&entry)));
        for found in [&one, &two] {
            let verdict = &found.verdict;
            assert!(matches!(verdict.status, Status::Complete), "{name}: {}", verdict.reason);
            assert_eq!(Some(verdict.complex), entry.cases[0].expected.complex, "{name}");
        }
        assert_eq!((one.modes.len(), one.verdict.real), (two.modes.len(), two.verdict.real), "{name}");
        for mode in &one.modes {
            let off = |other: &looproot::internal::mechanism::FullMode| {
                mode.q.iter().zip(&other.q).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
            };
            let nearest = two.modes.iter().map(off).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-9, "{name}: {nearest:e}");
        }
    }
}

#[test]
fn a_loop_with_universal_joints_is_proved_and_derived_and_swept() {
    let entry = builtin("rurur", &Options::default()).unwrap();
    let found = solve(&entry);
    assert_eq!((found.verdict.complex, found.verdict.certified), (16, 16), "{}", found.verdict.reason);
    assert_eq!((found.verdict.status, found.verdict.proof), (Status::Complete, Proof::Proved));

    let derivation = derive(&entry, &entry.cases[0]).unwrap();
    let degree =
        derivation.polynomial.as_ref().map(|polynomial| polynomial.to_polynomial().degree(polynomial.variable));
    assert_eq!(degree, Some(16));
    let substituted = derivation.substituted(&entry, &entry.cases[0]).unwrap();
    assert_eq!((substituted.solutions, substituted.without), (16, None));

    let range = Range { from: 1.0, to: 1.5, steps: 4 };
    let swept = sweep(&entry, 1, Variable::Rotation, range, || true, || {}).unwrap();
    assert_eq!(swept.samples.len(), 5);
    assert!(!swept.branches.is_empty());

    let moves = mobility(&entry).unwrap();
    assert_eq!((moves.variables.len(), moves.mobility), (7, Some(1)), "{}", moves.reason);
}
