//! Every residual chain of the single loops: planted solutions found, counts equal to the exact ones, and what is not
//! isolated never called complete.
#![allow(clippy::unwrap_used)]

mod agreement;
mod exact_loops;
mod overconstrained_loops;
mod sequences;
mod universal;

use crate::arms;

use arms::{at_pose, closed_at, joint, pose, random, ratio, small};
use looproot::internal::assembly::{Assembly, Roots, Solver, Workspace, wrapped};
use looproot::internal::benchmark::accuracy::{Job, run};
use looproot::internal::benchmark::sample::{CHAINS, Set};
use looproot::internal::catalogue::entry::{Case, Design, Input, InputValue};
use looproot::internal::elimination::cut::{Cut, Hidden};
use looproot::internal::elimination::degree::degree;
use looproot::internal::elimination::kind::Elimination;
use looproot::internal::elimination::octic;
use looproot::internal::elimination::point_reach::{self, Reach};
use looproot::internal::elimination::separated::{Plan, closure_polynomial, offset};
use looproot::internal::elimination::spherical_four_bar::FourBar;
use looproot::internal::elimination::spherical_triangle::triangle;
use looproot::internal::kinematics::chain::{Chain, Geometry, JointKind, Placement};
use looproot::internal::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop, Variable};
use looproot::internal::kinematics::link_form::LinkForm;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::Mechanism;
use looproot::internal::verdict::Status;
use looproot_algebra::modp::{ModP, PRIME_61};
use looproot_algebra::univariate::Univariate;
use rand::Rng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

type Mod = ModP<PRIME_61>;

/// A half tangent of which no two are alike and none is that of a right angle: both drop counts.
fn oblique(random: &mut ChaCha8Rng) -> Rational {
    ratio(random.random_range(101..997) * if random.random_bool(0.5) { 1 } else { -1 }, 997)
}

/// The joints of a chain by its letters, small rational parameters in general position.
fn general(name: &str, random: &mut ChaCha8Rng) -> Chain {
    let joint = |letter, random: &mut ChaCha8Rng| {
        let kind = match letter {
            'P' => JointKind::Prismatic,
            'C' => JointKind::Cylindrical,
            'S' => JointKind::Spherical,
            _ => JointKind::Revolute,
        };
        let twist = oblique(random);
        let mut joint = joint(kind, &small(random), &twist, &small(random));
        if kind == JointKind::Prismatic {
            joint.theta0 = arms::angle(&oblique(random));
        }
        joint
    };
    arms::chain(Geometry::Dh(name.chars().map(|letter| joint(letter, random)).collect()))
}

fn without_ball() -> impl Iterator<Item = (&'static str, usize)> {
    CHAINS.into_iter().filter(|(name, _)| !name.contains('S'))
}

/// `tan(q/2 - atan(3/7))` from `tan(q/2)`.
fn turned(t: &Rational) -> Rational {
    (t - ratio(3, 7)) / (1 + t * ratio(3, 7))
}

#[test]
fn planted_configurations_of_every_chain_are_found() {
    for (index, (name, count)) in CHAINS.into_iter().enumerate() {
        let job = Job { set: Set::Chain(index), count: 8, seed: 2024, roots: Roots::All, exact: false };
        let counts = run(job, || true, || ()).unwrap();
        assert!(counts.is_faultless(), "{name}:\n{counts}");
        assert_eq!(counts.complex.get(&count), Some(&8), "{name}:\n{counts}");
        let proved: usize = ["complete", "unreachable"].iter().filter_map(|word| counts.verdicts.get(word)).sum();
        assert_eq!(proved, 8, "{name}:\n{counts}");
        let special = Job { set: Set::SpecialChain(index), count: 6, ..job };
        let counts = run(special, || true, || ()).unwrap();
        assert!(counts.is_faultless(), "special {name}:\n{counts}");
    }
}

#[test]
fn real_solutions_alone_are_found_too() {
    for index in 0..CHAINS.len() {
        let job = Job { set: Set::Chain(index), count: 4, seed: 5, roots: Roots::Real, exact: false };
        let counts = run(job, || true, || ()).unwrap();
        assert!(counts.is_faultless(), "{}:\n{counts}", CHAINS[index].0);
    }
}

#[test]
fn general_chains_have_the_degrees_of_the_table_modulo_a_prime() {
    let mut random = random(31);
    for (name, count) in CHAINS {
        let chain = general(name, &mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let closed: ClosedLoop<Mod> = closed_at(&chain, &values);
        let layout = Layout::of(&chain, None).unwrap();
        let found = match layout.spherical_unknown() {
            Some(spherical) => point_reach::count(&closed, spherical),
            None => degree(&closed, None, 0).map(|degree| degree.solutions),
        };
        assert_eq!(found, Some(count), "{name}");
    }
}

#[test]
fn a_spherical_triangle_vanishes_exactly_at_the_planted_angle() {
    let mut random = random(32);
    for (name, _) in without_ball() {
        let chain = general(name, &mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let closed: ClosedLoop<Rational> = closed_at(&chain, &values);
        let Some(form) = LinkForm::<Rational, 3, 3>::of(&closed) else { continue };
        let triangle = triangle(&form);
        let t = &values[form.rotations[(triangle.dropped + 2) % 3]];
        let [constant, cos, sin] = &triangle.equation;
        let square = Rational::from(t * t);
        let value: Rational = constant * (1 + square.clone()) + cos * (1 - square) + sin * Rational::from(t * 2);
        assert!(value.is_zero(), "{name}");
        assert!(!cos.is_zero() || !sin.is_zero(), "{name}");
    }
}

#[test]
fn every_octic_has_the_planted_root_and_the_real_roots_that_are_found() {
    let mut random = random(33);
    for (name, count) in without_ball() {
        let chain = general(name, &mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let closed: ClosedLoop<Rational> = closed_at(&chain, &values);
        let Some(form) = LinkForm::<Rational, 4, 2>::of(&closed) else { continue };
        let solution = at_pose(&chain, pose(&chain, &values));
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, count), "{name}");
        for base in 0..4 {
            let bar = FourBar::new(&form, base).unwrap();
            let equations = bar.equations();
            for (hidden, ahead) in [(Hidden::First, 0), (Hidden::Second, 1)] {
                let octic = octic::closure_polynomial(&equations, hidden, &offset());
                assert_eq!(octic.degree(), Some(8), "{name} {base} {hidden:?}");
                let root = turned(&values[form.rotations[(base + ahead) % 4]]);
                assert!(octic.eval(&root).is_zero(), "{name} {base} {hidden:?}");
                assert!(!octic.eval(&(root + 1)).is_zero(), "{name} {base} {hidden:?}");
                if count == 8 {
                    assert_eq!(octic.distinct_real_roots(), solution.verdict.real, "{name} {base} {hidden:?}");
                }
            }
        }
    }
}

#[test]
fn every_quartic_of_a_ball_has_the_planted_root_and_the_real_roots_that_are_found() {
    let mut random = random(34);
    for (name, count) in CHAINS.into_iter().filter(|(name, _)| name.contains('S')) {
        let chain = general(name, &mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let closed: ClosedLoop<Rational> = closed_at(&chain, &values);
        let solution = at_pose(&chain, pose(&chain, &values));
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, count), "{name}");
        let reach = Reach::of(&closed, 0);
        let Plan::Together { hidden, other } = reach.equations.plan(0.0) else { continue };
        let polynomial = closure_polynomial(&reach.equations, hidden, &other);
        assert_eq!(polynomial.degree(), Some(count), "{name}");
        let value = &values[if hidden == 0 { 5 } else { 3 }];
        let root = if reach.equations.kinds[hidden] == Variable::Rotation { turned(value) } else { value.clone() };
        assert!(polynomial.eval(&root).is_zero(), "{name}");
        assert_eq!(polynomial.distinct_real_roots(), solution.verdict.real, "{name}");
    }
}

/// An open loop that is closed by nothing.
fn opened(closed: &ClosedLoop<f64>) -> OpenLoop<f64> {
    OpenLoop {
        variables: closed.variables,
        constants: std::array::from_fn(|k| closed.constants[k].clone()),
        before_gap: closed.constants[5].clone(),
        after_gap: Motion::identity(),
    }
}

#[test]
fn rotating_and_reversing_a_loop_changes_no_count_and_no_solution() {
    let mut random = random(35);
    for (name, count) in without_ball().filter(|(_, count)| *count < 16) {
        let chain = general(name, &mut random);
        let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
        let (exact, numeric): (ClosedLoop<Mod>, ClosedLoop<f64>) =
            (closed_at(&chain, &values), closed_at(&chain, &values));
        assert_ne!(Elimination::of(numeric.variables, None), Elimination::Planar);
        let mut real = None;
        for cut in Cut::ALL {
            let solutions = degree(&cut.of(&exact), None, 0).map(|degree| degree.solutions);
            assert_eq!(solutions, Some(count), "{name}, {cut:?}");
            let view = cut.of(&numeric);
            let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
            Solver::prepare(&opened(&view)).solve(&Motion::identity(), Roots::All, &mut workspace, &mut assembly);
            assert_eq!(assembly.total(), count, "{name}, {cut:?}");
            assert_eq!(*real.get_or_insert(assembly.real()), assembly.real(), "{name}, {cut:?}");
            // The planted one among them.
            let apart = |q: &[num_complex::Complex<f64>; 6]| {
                let difference = |k: usize| {
                    let planted = values[cut.unknown_index(k)].to_f64();
                    let planted = if cut.reversed { -planted } else { planted };
                    match view.variables[k] {
                        Variable::Rotation => wrapped(q[k].re - 2.0 * planted.atan()).abs() + q[k].im.abs(),
                        Variable::Translation => (q[k] - planted).norm(),
                    }
                };
                (0..6).map(difference).fold(0.0, f64::max)
            };
            let nearest = assembly.modes.iter().map(|mode| apart(&mode.unknowns)).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-8, "{name}, {cut:?}: {nearest}");
        }
    }
}

#[test]
fn a_ball_whose_second_angle_is_0_or_pi_is_found_and_proved() {
    let mut random = random(36);
    for name in ["SRRR", "SCR", "SRRP", "SPPR"] {
        for half_turn in [false, true] {
            let chain = general(name, &mut random);
            let layout = Layout::of(&chain, None).unwrap();
            let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
            let mut motions: Vec<Motion<Rational>> = arms::motions(&layout.variables, &values);
            let sign = if half_turn { -1 } else { 1 };
            motions[1] = Motion::rotation_z(Rational::from(sign), Rational::new());
            let pose = chain.forward(&motions).unwrap();
            let solution = at_pose(&chain, pose);
            assert_eq!(solution.verdict.status, Status::Complete, "{name}: {}", solution.verdict.reason);
            let planted = |k: usize| match layout.variables[k] {
                Variable::Rotation => 2.0 * values[k].to_f64().atan(),
                Variable::Translation => values[k].to_f64(),
            };
            let near = |q: &[num_complex::Complex<f64>]| (3..6).all(|k| wrapped(q[k].re - planted(k)).abs() < 1e-8);
            let mode = solution.modes.iter().find(|mode| mode.real && near(&mode.q)).unwrap();
            assert!(mode.certified && mode.residual < 1e-13, "{name}");
        }
    }
}

/// A chain of prismatic joints at right angles with this twist between the last two, and three revolutes.
fn gantry(twist: &Rational) -> Chain {
    let right = ratio(1, 1);
    let mut joints = vec![
        joint(JointKind::Prismatic, &ratio(1, 2), &right, &ratio(0, 1)),
        joint(JointKind::Prismatic, &ratio(1, 3), twist, &ratio(0, 1)),
        joint(JointKind::Prismatic, &ratio(1, 5), &ratio(1, 3), &ratio(0, 1)),
    ];
    joints[1].theta0 = arms::angle(&right);
    for k in 1..4 {
        joints.push(joint(JointKind::Revolute, &ratio(k, 4), &ratio(1, k + 1), &ratio(k, 3)));
    }
    arms::chain(Geometry::Dh(joints))
}

#[test]
fn dependent_translations_are_never_called_complete() {
    // Two of the three translations are parallel: a solution is one of a continuum.
    let chain = gantry(&ratio(0, 1));
    let values: [Rational; 6] = [1, 2, 3, 4, 5, 6].map(|k| ratio(k, 3));
    let solution = at_pose(&chain, pose(&chain, &values));
    assert_ne!(solution.verdict.status, Status::Complete, "{}", solution.verdict.reason);
    assert_ne!(solution.verdict.status, Status::Unreachable, "{}", solution.verdict.reason);
    assert_eq!(degree(&closed_at::<Mod>(&chain, &values), None, 0), None);
    let chain = gantry(&ratio(1, 2));
    let solution = at_pose(&chain, pose(&chain, &values));
    assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, 2));
}

#[test]
fn the_closure_polynomials_of_rationals_and_of_residues_are_the_same() {
    let mut random = random(37);
    let chain = general("CCRR", &mut random);
    let values: [Rational; 6] = std::array::from_fn(|_| small(&mut random));
    let exact = LinkForm::<Rational, 4, 2>::of(&closed_at(&chain, &values)).unwrap();
    let image = LinkForm::<Mod, 4, 2>::of(&closed_at(&chain, &values)).unwrap();
    let p: Univariate<Rational> =
        octic::closure_polynomial(&FourBar::new(&exact, 0).unwrap().equations(), Hidden::First, &offset());
    let modulo = octic::closure_polynomial(&FourBar::new(&image, 0).unwrap().equations(), Hidden::First, &offset());
    let mapped = p.map(<Mod as looproot_algebra::ring::Ring>::from_rational).unwrap();
    assert_eq!(mapped.normalise(), modulo.normalise());
}

#[test]
fn the_link_between_two_balls_may_spin() {
    let mut random = random(38);
    for name in ["RSSR", "RSSP", "SRSR", "PSSR", "SPSR"] {
        let mut chain = general(name, &mut random);
        let variables = Layout::of(&chain, None).unwrap().variables;
        let values: Vec<Rational> = variables.iter().map(|_| small(&mut random)).collect();
        let reached: Motion<Rational> = chain.forward(&arms::motions(&variables, &values)).unwrap();
        chain.tool = Placement::from_motion_exact(reached.inverse());
        // The last joint is given, or the first one where the last is a slider.
        let (joint, given) = if name.ends_with('R') { (name.len(), 7) } else { (1, 0) };
        let solution = arms::at_input(&chain, joint, &values[given]);
        assert_eq!((solution.verdict.status, solution.verdict.complex), (Status::Complete, 2), "{name}");
        assert!(solution.verdict.reason.contains("spins freely"), "{name}: {}", solution.verdict.reason);
        // Index of the unknown that is no spherical joint.
        let unknown = match name {
            "RSSR" | "PSSR" => 0,
            "RSSP" => 7,
            _ => 3,
        };
        let planted = match variables[unknown] {
            Variable::Rotation => 2.0 * values[unknown].to_f64().atan(),
            Variable::Translation => values[unknown].to_f64(),
        };
        let near = |q: &[num_complex::Complex<f64>]| (q[unknown] - planted).norm() < 1e-9;
        assert!(solution.modes.iter().any(|mode| mode.real && mode.certified && near(&mode.q)), "{name}");
        for mode in solution.modes.iter().filter(|mode| mode.real) {
            let motion = |(variable, q): (&Variable, &num_complex::Complex<f64>)| match variable {
                Variable::Rotation => Motion::rotation_z(q.re.cos(), q.re.sin()),
                Variable::Translation => Motion::translation_z(q.re),
            };
            let motions: Vec<Motion<f64>> = variables.iter().zip(&mode.q).map(motion).collect();
            let closed = chain.forward(&motions).unwrap();
            let identity: Motion<f64> = Motion::identity();
            for i in 0..3 {
                assert!(closed.translation[i].abs() < 1e-10, "{name}: {closed:?}");
                for j in 0..3 {
                    assert!((closed.rotation[i][j] - identity.rotation[i][j]).abs() < 1e-10, "{name}: {closed:?}");
                }
            }
        }
    }
}

#[test]
fn loops_with_fewer_than_three_rotations_are_unsupported_and_say_why() {
    let mut random = random(39);
    let chain = general("PPPPRRR", &mut random);
    let input = Input { joint: 5, value: InputValue::Angle(arms::angle(&ratio(1, 2))) };
    let entry = arms::entry(Design::Loop(chain), vec![Case::given(input, 0)]);
    let Err(fault) = Mechanism::prepare(&entry) else { panic!("prepared") };
    assert_eq!(fault.exit_code(), 4);
    let text = fault.to_string();
    assert!(text.contains("2 unknown rotations") && text.contains("screw rank is 5 of 6"), "{text}");
}

#[test]
fn a_loop_whose_axes_are_all_parallel_is_named() {
    let link = |k: i32| joint(JointKind::Revolute, &ratio(k, 4), &ratio(0, 1), &ratio(0, 1));
    let mut chain = arms::chain(Geometry::Dh((1..8).map(link).collect()));
    let values: Vec<Rational> = (1..8).map(|k| ratio(k, 5)).collect();
    let reached: Motion<Rational> = chain.forward(&arms::motions(&[Variable::Rotation; 7], &values)).unwrap();
    chain.tool = Placement::from_motion_exact(reached.inverse());
    let verdict = arms::at_input(&chain, 1, &values[0]).verdict;
    assert_ne!(verdict.status, Status::Complete, "{}", verdict.reason);
    assert!(verdict.reason.contains("rank 3 of 6") && verdict.reason.contains("3 of the six"), "{}", verdict.reason);
}
