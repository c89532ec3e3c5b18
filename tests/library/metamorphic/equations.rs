//! The closure equations over the rationals: true exactly at planted joint values.

use crate::arms::{angle, joint, motion, motions, pi, ratio, screw, screw_chain, small, variable_motion};
use looproot::internal::closure::half_angle::half_angle_form;
use looproot::internal::closure::woernle_lee::{
    MarkedLine, act, act_on_form, left_columns, right_columns, split, split_inverse,
};
use looproot::internal::elimination::cut::Cut;
use looproot::internal::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use looproot::internal::kinematics::closed_loop::{ClosedLoop, Layout, OpenLoop, Variable};
use looproot::internal::kinematics::motion::Motion;
use looproot_algebra::number::Number;
use looproot_algebra::ring::exact_cos_sin;
use rand_chacha::ChaCha8Rng;
use rug::Rational;

type Line = MarkedLine<Rational>;

/// Lists of joints with six variables, every kind that can be solved.
const ARMS: [&str; 7] = ["RRRRRR", "RRRRPR", "RRRPRR", "RPRRRR", "PRRRRR", "RRCRR", "CRRRR"];

fn kinds(letters: &str) -> Vec<JointKind> {
    let kind = |c| match c {
        'R' => JointKind::Revolute,
        'P' => JointKind::Prismatic,
        _ => JointKind::Cylindrical,
    };
    letters.chars().map(kind).collect()
}

/// A joint with every parameter it can have.
fn full_joint(kind: JointKind, random: &mut ChaCha8Rng) -> Joint {
    let plain = joint(kind, &small(random), &small(random), &small(random));
    Joint { theta0: angle(&small(random)), ..plain }
}

/// One chain in each convention, between a base and a tool.
fn chains(letters: &str, random: &mut ChaCha8Rng) -> [Chain; 3] {
    let joints = |random: &mut ChaCha8Rng| kinds(letters).into_iter().map(|kind| full_joint(kind, random)).collect();
    let dh = Geometry::Dh(joints(random));
    let modified = Geometry::ModifiedDh(joints(random));
    let screws = kinds(letters).into_iter().map(|kind| screw(kind, &motion(random))).collect();
    let screws = screw_chain(screws, motion(random)).geometry;
    [dh, modified, screws].map(|geometry| Chain {
        geometry,
        base: Placement::from_motion_exact(motion(random)),
        tool: Placement::from_motion_exact(motion(random)),
    })
}

/// A loop and the values of its unknowns: half tangents and distances.
fn planted(chain: &Chain, random: &mut ChaCha8Rng) -> (ClosedLoop<Rational>, [Rational; 6]) {
    let values: [Rational; 6] = std::array::from_fn(|_| small(random));
    let layout = Layout::of(chain, None).unwrap();
    let pose = chain.forward::<Rational>(&motions(&layout.variables, &values)).unwrap();
    let open: OpenLoop<Rational> = chain.open_loop(&layout).unwrap();
    (open.close(&pose.inverse()), values)
}

/// The product round a loop.
fn product(closed: &ClosedLoop<Rational>, values: &[Rational; 6]) -> Motion<Rational> {
    (0..6).fold(Motion::identity(), |pose, j| {
        pose.then_after(&variable_motion(closed.variables[j], &values[j])).then_after(&closed.constants[j])
    })
}

/// Returns the unknowns as a cut reads them.
fn seen(cut: Cut, values: &[Rational; 6]) -> [Rational; 6] {
    std::array::from_fn(|j| {
        let value = values[cut.unknown_index(j)].clone();
        if cut.reversed { -value } else { value }
    })
}

/// `(1, cos, sin)` or `(1, d, d^2)`
fn monomials(variable: Variable, value: &Rational) -> [Rational; 3] {
    match variable {
        Variable::Rotation => {
            let (cos, sin) = exact_cos_sin(&angle(value));
            [ratio(1, 1), cos, sin]
        }
        Variable::Translation => [ratio(1, 1), value.clone(), Rational::from(value * value)],
    }
}

fn dot(n: &Line, v: &Line) -> Rational {
    n.iter().zip(v).fold(Rational::new(), |sum, (x, y)| sum + Rational::from(x * y))
}

fn combine<'a>(terms: impl Iterator<Item = (Rational, &'a Line)>) -> Line {
    let mut sum: Line = std::array::from_fn(|_| Rational::new());
    for (factor, line) in terms {
        for (s, x) in sum.iter_mut().zip(line) {
            *s += Rational::from(&factor * x);
        }
    }
    sum
}

/// `u(q1, q2)` of a cut at its unknowns.
fn right_side(view: &ClosedLoop<Rational>, q: &[Rational; 6]) -> Line {
    let columns = right_columns(view);
    let [first, second] = [0, 1].map(|j| monomials(view.variables[j], &q[j]));
    let term = |(k1, k2): (usize, usize)| (Rational::from(&first[k1] * &second[k2]), &columns[k1][k2]);
    combine((0..9).map(|k| term((k / 3, k % 3))))
}

#[test]
fn every_convention_closes_exactly() {
    let mut random = crate::arms::random(1);
    for letters in ARMS {
        for chain in chains(letters, &mut random) {
            let (closed, values) = planted(&chain, &mut random);
            assert_eq!(product(&closed, &values), Motion::identity(), "{letters}");
            let mut wrong = values.clone();
            wrong[3] += 1;
            assert_ne!(product(&closed, &wrong), Motion::identity(), "{letters}");
        }
    }
}

#[test]
fn a_loop_closes_exactly_whichever_variable_is_locked() {
    let mut random = crate::arms::random(2);
    for letters in ["RRRRRRR", "RRPRRRR", "RCRRRR"] {
        for mut chain in chains(letters, &mut random) {
            let values: Vec<Rational> = (0..7).map(|_| small(&mut random)).collect();
            let variables = Layout::of(&chain, None).unwrap().variables;
            chain.tool = Placement::identity();
            let reached = chain.forward::<Rational>(&motions(&variables, &values)).unwrap();
            chain.tool = Placement::from_motion_exact(reached.inverse());
            for locked in 0..7 {
                let layout = Layout::of(&chain, Some(locked)).unwrap();
                let open: OpenLoop<Rational> = chain.open_loop(&layout).unwrap();
                let closed = open.close(&variable_motion(variables[locked], &values[locked]));
                let unknowns: [Rational; 6] = std::array::from_fn(|k| values[(locked + 1 + k) % 7].clone());
                assert_eq!(product(&closed, &unknowns), Motion::identity(), "{letters}, {locked}");
            }
        }
    }
}

#[test]
fn an_angle_of_pi_closes_exactly() {
    let mut random = crate::arms::random(3);
    let arm = crate::arms::general(&mut random);
    let half_turn = Motion::rotation_z(ratio(-1, 1), Rational::new());
    assert_eq!(exact_cos_sin(&pi()), (ratio(-1, 1), Rational::new()));
    let mut turns =
        motions::<Rational>(&[Variable::Rotation; 6], &std::array::from_fn::<_, 6, _>(|_| small(&mut random)));
    turns[4] = half_turn.clone();
    let closed = crate::arms::open::<Rational>(&arm).close(&arm.forward(&turns).unwrap().inverse());
    let closure =
        (0..6).fold(Motion::identity(), |pose, j| pose.then_after(&turns[j]).then_after(&closed.constants[j]));
    assert_eq!(closure, Motion::identity());
}

#[test]
fn the_fourteen_equations_hold_exactly_in_every_cut() {
    let mut random = crate::arms::random(4);
    for letters in ARMS {
        for chain in chains(letters, &mut random) {
            let (closed, values) = planted(&chain, &mut random);
            for cut in Cut::ALL {
                let (view, q) = (cut.of(&closed), seen(cut, &values));
                assert_eq!(product(&view, &q), Motion::identity(), "{letters}, {cut:?}");
                // A translation along the axis behind which the loop is cut moves the marked point.
                if view.variables[5] == Variable::Translation {
                    continue;
                }
                let columns = left_columns(&view);
                let [fourth, fifth] = [3, 4].map(|j| monomials(view.variables[j], &q[j]));
                let left = combine((0..9).map(|k| (Rational::from(&fifth[k / 3] * &fourth[k % 3]), &columns[k])));
                let back = act(&view.constants[1].inverse(), &right_side(&view, &q));
                let third: Motion<Rational> = variable_motion(view.variables[2], &q[2]);
                let right = act(&view.constants[2].inverse(), &act(&third.inverse(), &back));
                assert_eq!(left, right, "{letters}, {cut:?}");
            }
        }
    }
}

#[test]
fn the_half_angle_rows_vanish_exactly() {
    let mut random = crate::arms::random(5);
    for letters in ARMS {
        let [chain, _, screws] = chains(letters, &mut random);
        let mut used = 0;
        for chain in [chain, screws] {
            let (closed, values) = planted(&chain, &mut random);
            for cut in Cut::ALL.into_iter().filter(|cut| cut.fits(closed.variables)) {
                let (view, q) = (cut.of(&closed), seen(cut, &values));
                let form = half_angle_form(&view).unwrap();
                let u = act(&view.constants[1].inverse(), &right_side(&view, &q));
                for k in 0..4 {
                    let (free, with_x3) = (dot(&form.rows[k], &u), dot(&form.rows[4 + k], &u));
                    assert!(!with_x3.is_zero(), "{letters}, {cut:?}: an empty equation");
                    assert_eq!(free + with_x3 * &q[2], 0, "{letters}, {cut:?}");
                }
                let third: Motion<Rational> = variable_motion(view.variables[2], &q[2]);
                let turned = act(&third.inverse(), &u);
                for row in &form.free_of_last {
                    assert!(dot(row, &turned).is_zero(), "{letters}, {cut:?}");
                }
                let behind = act(&view.constants[2].inverse(), &turned);
                let [_, c5, s5] = monomials(view.variables[4], &q[4]);
                let [_, c4, s4] = monomials(view.variables[3], &q[3]);
                let found = form.last_monomials.each_ref().map(|row| dot(row, &behind));
                assert_eq!(found, [c5, s5, c4, s4], "{letters}, {cut:?}");
                used += 1;
            }
        }
        assert!(used >= 4, "{letters}: {used} cuts");
    }
}

fn line(random: &mut ChaCha8Rng) -> Line {
    std::array::from_fn(|_| small(random))
}

#[test]
fn the_action_is_a_representation() {
    let mut random = crate::arms::random(6);
    for _ in 0..20 {
        let (g, h, v, n) = (motion(&mut random), motion(&mut random), line(&mut random), line(&mut random));
        assert_eq!(act(&g.then_after(&h), &v), act(&g, &act(&h, &v)));
        assert_eq!(act(&g.inverse(), &act(&g, &v)), v);
        assert_eq!(dot(&act_on_form(&n, &g), &v), dot(&n, &act(&g, &v)));
    }
}

#[test]
fn the_action_is_that_on_lines_with_a_marked_point() {
    // (1, l, p, p.l, p.p, p x l, (p.p) l - 2 (p.l) p) from its definition.
    use looproot::internal::kinematics::motion::{cross, dot};
    let coordinates = |l: &[Rational; 3], p: &[Rational; 3]| -> Line {
        let (pl, pp, q) = (dot(p, l), dot(p, p), cross(p, l));
        let w: [Rational; 3] = std::array::from_fn(|i| Rational::from(&pp * &l[i]) - Rational::from(&pl * &p[i]) * 2);
        std::array::from_fn(|i| match i {
            0 => ratio(1, 1),
            1..=3 => l[i - 1].clone(),
            4..=6 => p[i - 4].clone(),
            7 => pl.clone(),
            8 => pp.clone(),
            9..=11 => q[i - 9].clone(),
            _ => w[i - 12].clone(),
        })
    };
    let mut random = crate::arms::random(7);
    for _ in 0..20 {
        let (g, frame) = (motion(&mut random), motion(&mut random));
        let l: [Rational; 3] = std::array::from_fn(|i| frame.rotation[i][2].clone());
        let v = coordinates(&l, &frame.translation);
        assert_eq!(act(&g, &v), coordinates(&g.rotate(&l), &g.apply(&frame.translation)));
    }
}

#[test]
fn the_parts_of_an_unknown_add_up_to_its_action() {
    let mut random = crate::arms::random(8);
    for variable in [Variable::Rotation, Variable::Translation] {
        for _ in 0..20 {
            let (v, value) = (line(&mut random), small(&mut random));
            let factors = monomials(variable, &value);
            let step: Motion<Rational> = variable_motion(variable, &value);
            let sum = |parts: &[Line; 3]| combine(factors.iter().cloned().zip(parts));
            assert_eq!(sum(&split(variable, &v)), act(&step, &v), "{variable:?}");
            assert_eq!(sum(&split_inverse(variable, &v)), act(&step.inverse(), &v), "{variable:?}");
        }
    }
}

#[test]
fn a_screw_axis_of_any_length_gives_the_same_motion() {
    let mut random = crate::arms::random(9);
    let frame = motion(&mut random);
    let given = screw(JointKind::Revolute, &frame);
    let mut longer = given.clone();
    longer.axis = longer.axis.map(|x| Number::exact(x.rational().clone() * 3));
    let home = motion(&mut random);
    let poses = [given, longer].map(|joint| {
        screw_chain(vec![joint], home.clone())
            .forward(&motions::<Rational>(&[Variable::Rotation], &[ratio(2, 5)]))
            .unwrap()
    });
    assert_eq!(poses[0], poses[1]);
}
