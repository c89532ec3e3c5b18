//! Does a closed chain move: the library, its negative controls, shaky loops, and the verb.
#![allow(clippy::unwrap_used)]

use looproot::internal::assembly::{Assembly, Roots, Workspace, are_apart};
use looproot::internal::benchmark::mobility::{disturbed, run as disturb};
use looproot::internal::catalogue::entry::Entry;
use looproot::internal::catalogue::{Format, Options, builtin, load_text};
use looproot::internal::elimination::coordinate_ring::Plan;
use looproot::internal::kinematics::closed_loop::{Layout, OpenLoop, Variable};
use looproot::internal::kinematics::dual_quaternion::DualQuaternion;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mechanism::Mechanism;
use looproot::internal::mobility::{Germ, Linkage, Local, Mobility, mobility};
use looproot::internal::verdict::{Code, Proof, Status};
use looproot_algebra::modp::{ModP, PRIME_62};
use looproot_algebra::number_field::NumberField;
use looproot_algebra::ring::{Field, Ring};
use looproot_algebra::univariate::Univariate;
use rug::Rational;
use std::process::Command;

fn answer(name: &str) -> Mobility {
    mobility(&builtin(name, &Options::default()).unwrap()).unwrap()
}

fn entry(text: &str) -> Entry {
    load_text(text, "test.toml", Format::Toml, &Options::default()).unwrap()
}

#[test]
fn overconstrained_loops_are_proved_to_move() {
    // Name, screw rank, real branches at the held value, complex configurations there.
    let cases = [
        ("bennett_a", 3, 1, 1),
        ("goldberg_a", 4, 1, 1),
        ("myard_a", 4, 1, 2),
        ("bricard_line_symmetric_a", 5, 1, 2),
        ("bricard_plane_symmetric_a", 5, 2, 4),
        ("bricard_trihedral_a", 5, 2, 2),
        ("wohlhart_hybrid_a", 5, 1, 4),
        ("waldron_hybrid", 5, 1, 1),
        ("double_goldberg", 5, 1, 1),
        ("dietmaier_a", 5, 2, 4),
        ("rrcrp_a", 5, 1, 2),
        ("rrrrp_parallel_pairs", 4, 1, 1),
        ("planar_4r", 3, 2, 2),
    ];
    for (name, rank, branches, complex) in cases {
        let answer = answer(name);
        assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::Proved), "{name}");
        assert_eq!(answer.screw_rank(), Some(rank), "{name}");
        assert_eq!((answer.branches(), answer.complex), (branches, complex), "{name}");
        assert!(answer.configurations.iter().all(|c| c.redundant.len() == 6 - rank), "{name}");
    }
}

#[test]
fn broken_ones_are_refused() {
    // Right angles leave limits of configurations that theorem 4 cannot exclude, and theorem 6 can.
    for name in ["bennett_broken", "dietmaier_broken", "bricard_trihedral_broken"] {
        let answer = answer(name);
        assert_eq!((answer.mobility, answer.proof, answer.shaky), (Some(0), Proof::Proved, None), "{name}");
    }
}

#[test]
fn loops_with_enough_freedoms_move_by_a_certified_configuration() {
    for (name, freedoms) in [("cccr_1_angle", 1), ("rscr", 1), ("rssr", 2)] {
        // The coupler of the last one, of length sqrt(69), is rounded.
        let proof = answer(name).proof;
        assert!(proof == Proof::Proved || name == "rssr" && proof == Proof::RoundedData, "{name}");
        let answer = answer(name);
        assert_eq!((answer.mobility, answer.screw_rank(), answer.proof), (Some(freedoms), Some(6), proof), "{name}");
    }
}

#[test]
fn a_small_error_in_any_link_stops_the_motion() {
    let names = [
        "bennett_a",
        "myard_a",
        "bricard_line_symmetric_a",
        "bricard_plane_symmetric_a",
        "bricard_trihedral_a",
        "bricard_trihedral_b",
        "dietmaier_a",
        "double_goldberg",
        "goldberg_a",
        "motion_polynomial_4r",
        "motion_polynomial_6r",
        "planar_4r",
        "rrcrp_a",
        "rrcrp_b",
        "rrrrp_parallel_pairs",
        "waldron_hybrid",
        "wohlhart_hybrid_a",
    ];
    for name in names {
        let tally = disturb(&builtin(name, &Options::default()).unwrap(), (6, 6), 1, || true, || ());
        assert_eq!((tally.count, tally.immobile, tally.mobile.len()), (6, 6, 0), "{name}");
        assert_eq!((tally.asked, tally.solved, tally.counted), (6, 6, 6), "{name}: {tally:?}");
        assert!(tally.miscounted.is_empty(), "{name}");
    }
}

#[test]
fn modes_crowded_by_a_small_error_are_told_apart() {
    // In f64 these are self-motions, or clouds of points.
    let cases = [
        ("bricard_plane_symmetric_a", 0, 8),
        ("bricard_plane_symmetric_a", 1, 12),
        ("motion_polynomial_6r", 1, 16),
        ("double_goldberg", 1, 8),
    ];
    for (name, number, count) in cases {
        let entry = disturbed(&builtin(name, &Options::default()).unwrap(), 1, number).unwrap();
        let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
        let mechanism = Mechanism::prepare(&entry).unwrap();
        let solution = mechanism.solve(&entry.cases[0], Roots::All, &mut workspace, &mut assembly).unwrap();
        let verdict = &solution.verdict;
        assert!(matches!(verdict.status, Status::Complete | Status::Unreachable), "{name}: {}", verdict.reason);
        assert_eq!((verdict.complex, verdict.certified), (count, count), "{name}: {}", verdict.reason);
        // Whatever is left is a solution by itself.
        for (k, one) in assembly.modes.iter().enumerate() {
            assert!(one.certificate.is_some_and(|proof| proof.radius < 1e-6), "{name}");
            assert!(assembly.modes[..k].iter().all(|two| are_apart(&[Variable::Rotation; 6], one, two)), "{name}");
        }
    }
}

/// Four revolutes of a loop, the lengths and twists of Bennett's loop with a factor on one length.
fn bennett(length: &str) -> String {
    format!(
        r#"
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            {{ type = "R", a = {length}, tan_half_alpha = "1/2", d = 0 }},
            {{ type = "R", a = 3, tan_half_alpha = "1/3", d = 0 }},
            {{ type = "R", a = 4, tan_half_alpha = "1/2", d = 0 }},
            {{ type = "R", a = 3, tan_half_alpha = "1/3", d = 0 }},
        ]
        [[input]]
        joint = 1
        tan_half = "1/2"
        "#
    )
}

#[test]
fn the_least_change_of_a_length_stops_bennett() {
    assert_eq!(mobility(&entry(&bennett("4"))).unwrap().mobility, Some(1));
    let broken = mobility(&entry(&bennett("\"4000000001/1000000000\""))).unwrap();
    assert_eq!((broken.mobility, broken.proof), (Some(0), Proof::Proved));
    assert!(broken.configurations.is_empty());
}

/// A loop of revolutes by lengths and twists, no offsets.
fn revolutes(links: &[(&str, &str)]) -> Entry {
    let joint = |(a, alpha): &(&str, &str)| format!("{{ type = \"R\", a = \"{a}\", alpha = \"{alpha}\", d = 0 }},\n");
    let joints: String = links.iter().map(joint).collect();
    entry(&format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n"))
}

#[test]
fn loops_of_irrational_numbers_close_all_round() {
    let bennett = [("3*sin(40 deg)", "40 deg"), ("3*sin(65 deg)", "65 deg")].repeat(2);
    let goldberg = [
        ("2*(sin(50 deg) + sin(35 deg))", "85 deg"),
        ("2*sin(20 deg)", "20 deg"),
        ("2*sin(35 deg)", "35 deg"),
        ("2*sin(50 deg)", "50 deg"),
        ("2*sin(20 deg)", "20 deg"),
    ];
    let myard =
        [("5*sin(40 deg)", "40 deg"), ("5", "90 deg"), ("0", "100 deg"), ("5", "90 deg"), ("5*sin(40 deg)", "140 deg")];
    for (links, rank, branches) in [(&bennett[..], 3, 1), (&goldberg, 4, 1), (&myard, 4, 1)] {
        let answer = mobility(&revolutes(links)).unwrap();
        assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::Proved), "{}", answer.reason);
        assert_eq!((answer.screw_rank(), answer.branches()), (Some(rank), branches));
        // Off by a part of 1e-10 in one length, none of them moves.
        let longer = format!("{}*(1 + 1e-10)", links[1].0);
        let mut broken = links.to_vec();
        broken[1].0 = &longer;
        let answer = mobility(&revolutes(&broken)).unwrap();
        assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::Proved), "{}", answer.reason);
    }
}

#[test]
fn bennett_loops_of_whole_degrees_move_in_a_field_of_degree_48() {
    let links = [("3*sin(23 deg)", "23 deg"), ("3*sin(41 deg)", "41 deg")].repeat(2);
    let answer = mobility(&revolutes(&links)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::Proved), "{}", answer.reason);
    assert_eq!((answer.code, answer.screw_rank()), (Code::FamilyOfMobileLoops, Some(3)));
    let mut broken = links.clone();
    broken[2].0 = "3*sin(23 deg) + 1e-14";
    let answer = mobility(&revolutes(&broken)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::Proved), "{}", answer.reason);
}

#[test]
fn numbers_without_a_field_are_rounded() {
    // Bennett's loop with twists of 0.4 and 0.7 rad.
    let links = [("3*sin(2/5)", "2/5"), ("3*sin(7/10)", "7/10")].repeat(2);
    let answer = mobility(&revolutes(&links)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::None), "{}", answer.reason);
    assert_eq!(answer.code, Code::CertifiedSweep);
    assert!(answer.reason.contains("at 180 of 180 inputs"), "{}", answer.reason);
    let broken = [("3*sin(2/5)", "2/5"), ("3*sin(7/10)", "7/10"), ("1", "2/5"), ("2", "1/2")];
    let answer = mobility(&revolutes(&broken)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::RoundedData), "{}", answer.reason);
    assert!(answer.reason.contains("to rounding the loop does not close through any range"), "{}", answer.reason);
}

/// Source: construction, the third slider along the sum of the other two.
#[test]
fn sliders_with_square_roots_are_decided_in_their_field() {
    let with = |third: &str| {
        let axis = format!("[1, 1, \"{third}\"]");
        mobility(&screws(&[
            ("P", "[1, 0, \"sqrt(2)\"]", "[0, 0, 0]"),
            ("R", "[0, 0, 1]", "[0, 0, 0]"),
            ("P", "[0, 1, \"sqrt(3)\"]", "[0, 0, 0]"),
            ("P", &axis, "[0, 0, 0]"),
        ]))
        .unwrap()
    };
    let moves = with("sqrt(2) + sqrt(3)");
    assert_eq!((moves.mobility, moves.proof, moves.code), (Some(1), Proof::Proved, Code::GroupOfMotions));
    let stands = with("sqrt(2) + sqrt(3) + 1e-30");
    assert_eq!((stands.mobility, stands.proof, stands.code), (Some(0), Proof::Proved, Code::NoCurve));
}

/// Source: construction. The six screws of the joints have rank 6 (the determinant of the moments is 112/63), also where two of the
/// three angles of the spherical joint turn about one axis.
#[test]
fn spherical_joints_have_no_singular_position() {
    let revolutes =
        [("R", "[1, 2, 2]", "[1, 0, 1]"), ("R", "[2, -1, 2]", "[2, 1, 0]"), ("R", "[2, 3, 6]", "[0, 3, 1]")];
    for axis in ["[0, 0, 1]", "[1, 2, 2]", "[2, 3, 6]"] {
        let joints: Vec<(&str, &str, &str)> = std::iter::once(("S", axis, "[0, 0, 0]")).chain(revolutes).collect();
        let answer = mobility(&screws(&joints)).unwrap();
        assert_eq!((answer.mobility, answer.proof, answer.shaky), (Some(0), Proof::Proved, None), "{}", answer.reason);
        assert!(answer.configurations.iter().all(|configuration| configuration.rank == 6));
    }
}

/// By construction: the second half of the joints undoes what the first half does, in three dimensions.
#[test]
fn joints_on_common_axes_undo_each_other() {
    let axes = [("[1, 4, 8]", "[2, -2, 0]"), ("[1, 4, 8]", "[3, -2, 2]"), ("[0, 0, 1]", "[3, -2, 2]")];
    let joints: Vec<(&str, &str, &str)> =
        axes.iter().chain(axes.iter().rev()).map(|(axis, at)| ("R", *axis, *at)).collect();
    let answer = mobility(&screws(&joints)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(3), Proof::Proved), "{}", answer.reason);
    assert_eq!(answer.code, Code::GroupOfMotions);
}

/// By construction: the centre of a spherical joint beside the axes that carry it stands still, and on the axis of the only other
/// joint it does not.
#[test]
fn loops_with_spherical_joints_are_decided_by_their_centres() {
    let of = |joints: &[(&str, &str, &str)]| mobility(&screws(joints)).unwrap();
    for (joints, expected) in [
        (vec![("S", "[0, 0, 1]", "[3, 3, 0]"), ("R", "[3, 4, 0]", "[1, 1, 1]")], 0),
        (vec![("S", "[0, 0, 1]", "[4, 5, 1]"), ("R", "[3, 4, 0]", "[1, 1, 1]")], 1),
        (vec![("S", "[0, 0, 1]", "[3, 3, 0]"), ("P", "[3, 4, 0]", "[0, 0, 0]")], 0),
        (vec![("S", "[0, 0, 1]", "[5, 0, 0]"), ("R", "[0, 0, 1]", "[0, 0, 0]"), ("R", "[0, 0, 1]", "[3, 0, 0]")], 0),
        // Two links stretched, and the centre in one line with them: the link between the centres spins, and no more.
        (vec![("R", "[0, 0, 1]", "[0, 0, 0]"), ("S", "[0, 0, 1]", "[3, 0, 0]"), ("S", "[0, 0, 1]", "[5, 0, 0]")], 1),
    ] {
        let answer = of(&joints);
        assert_eq!((answer.mobility, answer.proof), (Some(expected), Proof::Proved), "{joints:?}: {}", answer.reason);
    }
}

#[test]
fn decimals_are_exact_unless_they_look_rounded() {
    let with = |length: &str| mobility(&entry(&bennett("4").replace("a = 4", &format!("a = {length}")))).unwrap();
    let answer = with("4.000000000000001");
    assert_eq!((answer.mobility, answer.proof), (Some(1), Proof::None), "{}", answer.reason);
    assert_eq!(answer.code, Code::CertifiedSweep);
    assert!(answer.reason.contains("as exact numbers they do not move"), "{}", answer.reason);
    for broken in ["4.000000000001", "4.00000000012345678"] {
        let answer = with(broken);
        assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::Proved), "{broken}: {}", answer.reason);
    }
}

/// A loop by axes and points, one length of which is not rational.
#[test]
fn axes_of_irrational_length_are_taken_as_they_are() {
    // Three parallel axes along (1, 1, 0) and a translation along (1, -1, 3) across them: a slider-crank.
    let slider = |point: &str, axis: &str| {
        entry(&format!(
            r#"
            [mechanism]
            kind = "loop"
            convention = "screws"
            joints = [
                {{ type = "R", axis = [1, 1, 0], point = [0, 0, 0] }},
                {{ type = "R", axis = [2, 2, 0], point = {point} }},
                {{ type = "R", axis = [-1, -1, 0], point = [1, 0, 5] }},
                {{ type = "P", axis = {axis} }},
            ]
            "#
        ))
    };
    let answer = mobility(&slider("[0, 1, 2]", "[1, -1, 3]")).unwrap();
    assert_eq!((answer.mobility, answer.screw_rank(), answer.proof), (Some(1), Some(3), Proof::Proved));
    assert!(!answer.reason.contains("rounded"), "{}", answer.reason);
    // Held joints are reported in radians, and their values close the loop.
    let (k, value) = answer.held[0];
    assert!(answer.configurations.iter().all(|c| (c.q[k] - value).abs() < 1e-12));
    let broken = mobility(&slider("[0, 1, 2]", "[1, \"-1000001/1000000\", 3]")).unwrap();
    assert_eq!((broken.mobility, broken.proof), (Some(0), Proof::Proved), "{}", broken.reason);
}

/// Six axes `direction, point` of the linear complex of the screw with pitch 1 about z: `d . (e_z x p + e_z) = 0`.
const COMPLEX: &str = r#"
    [mechanism]
    kind = "loop"
    convention = "screws"
    joints = [
        { type = "R", axis = [1, 0, 0], point = [0, 0, 0] },
        { type = "R", axis = [0, 1, 0], point = [0, 0, 2] },
        { type = "R", axis = [0, "3/5", "-4/5"], point = ["4/3", 0, 1] },
        { type = "R", axis = ["3/5", 0, "4/5"], point = [0, "4/3", -1] },
        { type = "R", axis = ["2/3", "-1/3", "2/3"], point = [0, 1, 3] },
        { type = "R", axis = ["2/3", "2/3", "1/3"], point = [1, "3/2", -2] },
    ]
    [[input]]
    joint = 1
    tan_half = "1/2"
"#;

#[test]
fn six_axes_of_a_linear_complex_are_shaky_only() {
    let linkage = Linkage::of(entry(COMPLEX).chain().unwrap()).unwrap();
    let home = linkage.at(&vec![[Rational::one(), Rational::zero()]; 6]);
    let germ = Germ::of(&home);
    assert_eq!((germ.local, germ.rank), (Local::Isolated { order: 2 }, 5));
    let answer = mobility(&entry(COMPLEX)).unwrap();
    assert_eq!((answer.mobility, answer.shaky, answer.proof), (Some(0), Some(2), Proof::Proved), "{}", answer.reason);
}

#[test]
fn a_half_turn_is_a_position_like_any_other() {
    // Bennett's loop with joint 1 at pi: tan(q3/2) infinite, q2 and q4 at 0 (K/x with x infinite).
    let loop_4r = Linkage::of(entry(&bennett("4")).chain().unwrap()).unwrap();
    let (one, zero) = (Rational::one, Rational::zero);
    let folded = loop_4r.at(&[[zero(), one()], [one(), zero()], [zero(), one()], [one(), zero()]]);
    assert!(folded.closes());
    assert_eq!(Germ::of(&folded).local, Local::Curve);
}

/// Two coaxial revolutes and three more round a loop: its last link is such that it closes at home, drawn at random.
fn coaxial() -> Linkage<Rational> {
    let link = |a: i32, t: i32, d: i32| -> DualQuaternion<Rational> {
        let shift = DualQuaternion::translation(&[Rational::from(a), Rational::new(), Rational::from(d)]);
        shift.mul(&DualQuaternion::rotation_x(Rational::one(), Rational::from((t, 3))))
    };
    let mut links = vec![link(0, 0, 2), link(1, 1, 1), link(2, -2, 1), link(3, 4, -1)];
    let whole = links.iter().fold(DualQuaternion::identity(), |product, link| product.mul(link));
    links.push(whole.conjugate());
    Linkage::about_z(vec![Variable::Rotation; 5], links)
}

#[test]
fn two_coaxial_joints_move_in_any_loop() {
    let linkage = coaxial();
    let germ = Germ::of(&linkage.at(&vec![[Rational::one(), Rational::zero()]; 5]));
    assert_eq!((germ.local, germ.rank), (Local::Manifold { dimension: 1 }, 4));
    assert_eq!(looproot::internal::mobility::moves(&linkage), Some(true));
}

/// Five generators `(-3 s, 3 c, 4)/5` through `(c, s, 0)` of one family of a hyperboloid: their screws have rank 3.
const REGULUS: &str = r#"
    [mechanism]
    kind = "loop"
    convention = "screws"
    joints = [
        { type = "R", axis = [0, "3/5", "4/5"], point = [1, 0, 0] },
        { type = "R", axis = ["-12/25", "9/25", "4/5"], point = ["3/5", "4/5", 0] },
        { type = "R", axis = ["-9/25", "-12/25", "4/5"], point = ["-4/5", "3/5", 0] },
        { type = "R", axis = ["36/65", "3/13", "4/5"], point = ["5/13", "-12/13", 0] },
        { type = "R", axis = ["9/17", "-24/85", "4/5"], point = ["-8/17", "-15/17", 0] },
    ]
"#;

#[test]
fn several_infinitesimal_motions_are_decided_by_low_orders() {
    let linkage = Linkage::of(entry(REGULUS).chain().unwrap()).unwrap();
    let germ = Germ::of(&linkage.at(&vec![[Rational::one(), Rational::zero()]; 5]));
    // Three quadratic equations for two first-order motions leave 1 and these two: multiplicity 3.
    assert_eq!((germ.local, germ.rank), (Local::Isolated { order: 3 }, 3));
    let answer = mobility(&entry(REGULUS)).unwrap();
    assert_eq!((answer.mobility, answer.proof), (Some(0), Proof::Proved), "{}", answer.reason);
}

#[test]
fn exact_counts_agree_with_solutions_known() {
    let linkage = |name: &str| Linkage::of(builtin(name, &Options::default()).unwrap().chain().unwrap()).unwrap();
    assert_eq!(looproot::internal::mobility::at_most(&linkage("structure_6r"), 16), Some(16));
    assert_eq!(looproot::internal::mobility::count(&linkage("structure_5r")), Some(1));
    assert_eq!(looproot::internal::mobility::count(&linkage("bennett_broken")), Some(0));
}

#[test]
fn rings_with_virtual_joints_count_overconstrained_loops() {
    type Mod = ModP<PRIME_62>;
    // Without input: what moves has no finite ring.
    for (name, count) in
        [("structure_5r", Some(1)), ("structure_4r", Some(1)), ("bennett_broken", Some(0)), ("goldberg_a", None)]
    {
        let entry = builtin(name, &Options::default()).unwrap();
        let chain = entry.chain().unwrap();
        let layout = Layout::of(chain, None).unwrap();
        let layout = layout.with_idle(layout.missing(), 0);
        let is_idle = layout.joint_variables().map(|joint| joint.is_none());
        let open: OpenLoop<Mod> = chain.open_loop(&layout).unwrap();
        let closed = open.close(&Motion::identity());
        assert_eq!(Plan::at_zero(&closed, is_idle).map(|plan| plan.count()), count, "{name}");
        let by_positions = looproot::internal::mobility::count(&Linkage::of(chain).unwrap());
        assert_eq!(by_positions, count, "{name}");
    }
}

#[test]
fn translations_count_too() {
    // Three parallel translations round a triangle and one more: two freedoms of the plane, held by nothing else.
    let link = |t: i32| DualQuaternion::<Rational>::rotation_x(Rational::one(), Rational::from((t, 2)));
    let variables = vec![Variable::Translation; 4];
    let whole = (1..4).fold(DualQuaternion::identity(), |product, t| product.mul(&link(t)));
    let links = vec![link(1), link(2), link(3), whole.conjugate()];
    let linkage = Linkage::about_z(variables, links);
    let germ = Germ::of(&linkage.at(&vec![[Rational::one(), Rational::zero()]; 4]));
    assert_eq!((germ.local, germ.rank), (Local::Manifold { dimension: 2 }, 2));
}

#[test]
fn numbers_of_a_field_have_inverses() {
    // t^4 - 10 t^2 + 1, of the square roots of 2 and 3 together.
    let modulus = Univariate::new([1, 0, -10, 0, 1].map(Rational::from).to_vec());
    let field = NumberField::new(&modulus);
    let t = field.root();
    let x = t.mul(&t).mul(&t).add(&Ring::from_integer(7)).sub(&t);
    let inverse = x.inverse().unwrap();
    assert_eq!(x.mul(&inverse), Ring::one());
    assert!(field.split().is_none());
    // (t^3 - 9t)/2 is the square root of 2.
    let half = Ring::from_rational(&Rational::from((1, 2))).unwrap();
    let root = t.mul(&t).mul(&t).sub(&t.mul(&Ring::from_integer(9))).mul(&half);
    assert_eq!(root.mul(&root), Ring::from_integer(2));
}

fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_verb_says_the_verdict_first() {
    let (code, out, _) = run(&["mobility", "bennett_a"]);
    assert_eq!(code, Some(0));
    let verdict = "mobile: mobility 1 (Gruebler's count -2), screw rank 3, 1 branch; proof: proved";
    assert_eq!(out.lines().next(), Some(verdict));
    assert!(out.contains("degree of freedom 4 - 3 = 1, 3 redundant constraints"));
    let (code, out, _) = run(&["mobility", "bennett_broken", "--quiet"]);
    assert_eq!((code, out.as_str()), (Some(3), "immobile: no configuration (Gruebler's count -2); proof: proved\n"));
    let (code, out, _) = run(&["mobility", "bennett_a", "--json"]);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &document["mobility"], &document["proof"]), (Some(0), &1.into(), &"proved".into()));
    assert_eq!(
        (&document["gruebler"], &document["screw_rank"], &document["shaky"]),
        (&(-2).into(), &3.into(), &false.into())
    );
}

#[test]
fn what_does_not_move_by_joints_is_refused() {
    let (code, _, err) = run(&["mobility", "motion/bennett"]);
    assert_eq!(code, Some(1));
    assert!(err.contains("found a rational motion, expected a loop"), "{err}");
}

#[test]
fn configurations_crowded_by_short_decimals_are_listed() {
    // Dietmaier's loop with twelve decimals: in f64 it moves, by its numbers it does not.
    let links = [
        ("1.846153846154", "0.666666666667", "-0.25"),
        ("1.6", "0.5", "0"),
        ("1.5", "0.6", "-0.25"),
        ("1.158925285241", "0.333333333333", "0.75"),
        ("1.884431358116", "0.8", "0"),
        ("1.5", "0.6", "0.75"),
    ];
    let joint = |(a, t, d): &(&str, &str, &str)| {
        format!("{{ type = \"R\", a = \"{a}\", tan_half_alpha = \"{t}\", d = \"{d}\" }},\n")
    };
    let joints: String = links.iter().map(joint).collect();
    let answer =
        mobility(&entry(&format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n{joints}]\n")))
            .unwrap();
    assert_eq!((answer.mobility, answer.proof, answer.complex), (Some(0), Proof::Proved, 16), "{}", answer.reason);
    assert!(!answer.reason.contains("self-motion"), "{}", answer.reason);
}

/// A loop of joints by type, axis and point.
fn screws(joints: &[(&str, &str, &str)]) -> Entry {
    let joint = |(kind, axis, point): &(&str, &str, &str)| {
        format!("{{ type = \"{kind}\", axis = {axis}, point = {point} }},\n")
    };
    let joints: String = joints.iter().map(joint).collect();
    entry(&format!("[mechanism]\nkind = \"loop\"\nconvention = \"screws\"\njoints = [\n{joints}]\n"))
}

/// Source: construction, sliders whose directions are dependent.
#[test]
fn loops_of_sliders_alone_move() {
    let slider = |axis| ("P", axis, "[0, 0, 0]");
    for (loop_, mobility_, rank) in [
        (screws(&["[1, 0, 0]", "[2, 0, 0]"].map(slider)), 1, 1),
        (screws(&["[1, 0, 0]", "[0, 1, 0]", "[3, 4, 0]"].map(slider)), 1, 2),
        (screws(&["[1, 0, 0]", "[0, 1, 0]", "[0, 0, 2]", "[1, 2, 2]"].map(slider)), 1, 3),
    ] {
        let answer = mobility(&loop_).unwrap();
        assert_eq!((answer.mobility, answer.screw_rank()), (Some(mobility_), Some(rank)), "{}", answer.reason);
        assert_eq!((answer.proof, answer.code), (Proof::Proved, Code::GroupOfMotions));
        assert!(looproot::internal::report::mobility::text(&loop_, &answer).contains("independent translation"));
        assert!(
            looproot::internal::report::mobility::json(&loop_, &answer)["configurations"][0]["translations"] == rank
        );
    }
}

/// Source: construction. The first and third axes are parallel and three sliders span all translations, which is one freedom too many;
/// with any one joint held the others still move, or the cuts separate nothing.
#[test]
fn the_configuration_of_the_file_is_looked_at() {
    let answer = mobility(&screws(&[
        ("R", "[1, -1, 0]", "[0, 1, 0]"),
        ("R", "[1, 1, 0]", "[2, 0, 0]"),
        ("R", "[1, -1, 0]", "[-1, 0, 2]"),
        ("P", "[1, -1, 0]", "[0, 0, 0]"),
        ("P", "[0, 1, 0]", "[0, 0, 0]"),
        ("P", "[0, 1, 1]", "[0, 0, 0]"),
    ]))
    .unwrap();
    assert_eq!((answer.mobility, answer.proof, answer.code), (Some(1), Proof::Proved, Code::GroupOfMotions));
}
