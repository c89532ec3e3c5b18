//! Every mechanism with one input in special geometry: what is solved in f64 has the number of solutions of the exact
//! equations and the number of real ones of the exact closure polynomial.

use crate::arms::{self, angle, joint, pi, random, ratio, small};
use looproot::algebra::modp::{ModP, PRIME_61};
use looproot::algebra::number::Number;
use looproot::benchmark::agreement::{Agreement, compare};
use looproot::catalogue::entry::{Case, Design, Input, InputValue};
use looproot::derivation::derive;
use looproot::elimination::coordinate_ring::Plan;
use looproot::kinematics::chain::{Chain, Geometry, JointKind, Placement};
use looproot::kinematics::closed_loop::{ClosedLoop, Layout, Variable};
use looproot::mechanism::closed_loop;
use looproot::verdict::Status;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// The 26 sequences of joints with seven variables, and the inputs that differ: joint, angle or translation.
const PAIRS: [(&str, &str); 26] = [
    ("PPPRRRR", "1t 2t 4a 5a"),
    ("PPRPRRR", "1t 2t 3a 4t 5a 6a 7a"),
    ("PPRRPRR", "1t 3a 4a 5t"),
    ("PRPRPRR", "1t 2a 3t 6a"),
    ("CPPRRR", "1a 1t 2t 3t 4a 5a 6a"),
    ("CPRPRR", "1a 1t 2t 3a 4t 5a 6a"),
    ("CPRRPR", "1a 1t 2t 3a 4a 5t 6a"),
    ("CPRRRP", "1a 1t 2t 3a 4a"),
    ("CRPPRR", "1a 1t 2a 3t 4t 5a 6a"),
    ("CRPRPR", "1a 1t 2a 3t 4a"),
    ("CCPRR", "1a 1t 2a 2t 3t 4a 5a"),
    ("CCRPR", "1a 1t 3a 4t"),
    ("CPCRR", "1a 1t 2t 4a"),
    ("CPRCR", "1a 1t 2t 3a 4a 4t 5a"),
    ("CCCR", "1a 1t 2a 2t 4a"),
    ("PPRRRRR", "1t 3a 4a 5a"),
    ("PRPRRRR", "1t 2a 4a 5a"),
    ("PRRPRRR", "1t 2a 5a 6a"),
    ("CPRRRR", "1a 1t 2t 3a 4a 5a 6a"),
    ("CRPRRR", "1a 1t 2a 3t 4a 5a 6a"),
    ("CRRPRR", "1a 1t 2a 3a 4t"),
    ("CCRRR", "1a 1t 3a 4a"),
    ("CRCRR", "1a 1t 2a 4a"),
    ("PRRRRRR", "1t 2a 3a 4a"),
    ("CRRRRR", "1a 1t 2a 3a 4a"),
    ("RRRRRRR", "1a"),
];

/// Mostly right, zero or half a turn, by the tangent of its half.
fn special(random: &mut ChaCha8Rng) -> Rational {
    match random.random_range(0..6) {
        0 => ratio(0, 1),
        1 => ratio(1, 1),
        2 => ratio(-1, 1),
        _ => small(random),
    }
}

fn length(random: &mut ChaCha8Rng) -> Rational {
    if random.random_bool(0.4) { ratio(0, 1) } else { small(random) }
}

/// A loop that closes at the values it is returned with.
fn planted(name: &str, random: &mut ChaCha8Rng) -> (Chain, Vec<Rational>) {
    let joints = name.chars().map(|letter| {
        let kind = match letter {
            'P' => JointKind::Prismatic,
            'C' => JointKind::Cylindrical,
            _ => JointKind::Revolute,
        };
        let mut joint = joint(kind, &length(random), &special(random), &length(random));
        if random.random_bool(0.1) {
            joint.alpha = pi();
        }
        if kind == JointKind::Prismatic {
            joint.theta0 = angle(&special(random));
        }
        joint
    });
    let mut chain = arms::chain(Geometry::Dh(joints.collect()));
    let variables = Layout::of(&chain, Some(0)).unwrap().variables;
    let values: Vec<Rational> = variables
        .iter()
        .map(|variable| if *variable == Variable::Rotation { special(random) } else { small(random) })
        .collect();
    let reached = chain.forward(&arms::motions(&variables, &values)).unwrap();
    chain.tool = Placement::from_motion_exact(reached.inverse());
    (chain, values)
}

#[test]
fn exact_and_numeric_counts_agree_in_special_geometry() {
    let (mut loops, mut simple) = (0, 0);
    for (name, inputs) in PAIRS {
        for input in inputs.split(' ') {
            let mut random = random(1000 + loops);
            let number: usize = input[..1].parse().unwrap();
            let wanted = if input.ends_with('a') { Variable::Rotation } else { Variable::Translation };
            // Until solutions are isolated.
            for _ in 0..40 {
                let (chain, values) = planted(name, &mut random);
                let index = Layout::variable_of(&chain, number, wanted).unwrap();
                let value = match wanted {
                    Variable::Rotation => InputValue::Angle(angle(&values[index])),
                    Variable::Translation => InputValue::Distance(Number::exact(values[index].clone())),
                };
                let case = Case::given(Input { joint: number, value }, 0);
                let closed: Option<(_, ClosedLoop<ModP<PRIME_61>>)> = closed_loop(&chain, &case).unwrap();
                let Some(plan) = Plan::of(&closed.unwrap().1) else { continue };
                let entry = arms::entry(Design::Loop(chain.clone()), vec![case]);
                let solution = arms::solve(&entry);
                let verdict = &solution.verdict;
                assert_eq!(verdict.status, Status::Complete, "{name} {input}: {}", verdict.reason);
                assert_eq!(verdict.complex, plan.count(), "{name} {input}: {}", verdict.reason);
                loops += 1;
                let derivation = derive(&entry, &entry.cases[0]).unwrap();
                match compare(&derivation, &chain, &solution) {
                    Agreement::Solutions => simple += 1,
                    Agreement::Values => {}
                    other => panic!("{name} {input}: {other:?}"),
                }
                break;
            }
        }
    }
    assert_eq!(loops, 133);
    // Of the others several solutions share a root.
    assert!(simple > 100, "{simple}");
}
