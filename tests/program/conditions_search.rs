//! The search for conditions of 5R and 6R loops: what the literature knows is found, from the ansatz alone, and nothing
//! else is called mobile.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::ansatz::{Ansatz, Link, Symbols};
use looproot::internal::catalogue::{Format as FileFormat, Options, ansatz_from_text, load_ansatz};
use looproot::internal::conditions::configurations::{configurations, link_motion};
use looproot::internal::conditions::curve_ansatz::{Relation, rational_curves, spherical_links};
use looproot::internal::conditions::finite_field::{
    all_turns, half_tangent_turn, random_unit, square_root, turn, turn_number,
};
use looproot::internal::conditions::identity;
use looproot::internal::conditions::implication::{Implication, implication};
use looproot::internal::conditions::multiplier::multiplier;
use looproot::internal::conditions::search::{FamilyProof, search};
use looproot::internal::conditions::spherical::{Directions, closed_by};
use looproot::internal::conditions::sweep::sweep;
use looproot::internal::conditions::symmetry::{Slice, slices};
use looproot::internal::conditions::verification::{
    closed_positions, germ, held_member, modular_members, rational_member,
};
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::mobility::Local;
use looproot_algebra::echelon::Echelon;
use looproot_algebra::modp::ModP;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::Format;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::io::Write;
use std::process::{Command, Stdio};

fn builtin(name: &str) -> Ansatz {
    load_ansatz(name, &Options::default()).unwrap()
}

fn rational(text: &str) -> Rational {
    text.parse().unwrap()
}

/// A loop given by length, half-angle tangent of the twist and offset of each link.
fn member<const P: u64>(links: &[(&str, &str, &str)]) -> Vec<Link<ModP<P>>> {
    let image = |text: &str| ModP::from_rational(&rational(text)).unwrap();
    let link = |(a, t, d): &(&str, &str, &str)| {
        let (cos, sin) = turn(image(t));
        Link { cos, sin, a: image(a), d: image(d) }
    };
    links.iter().map(link).collect()
}

const BENNETT: [(&str, &str, &str); 4] = [("4", "1/2", "0"), ("3", "1/3", "0"), ("4", "1/2", "0"), ("3", "1/3", "0")];

const GOLDBERG: [(&str, &str, &str); 5] =
    [("91/17", "7/11", "0"), ("4", "1/2", "0"), ("40/17", "1/4", "0"), ("3", "1/3", "0"), ("4", "1/2", "0")];

const DIETMAIER: [(&str, &str, &str); 6] = [
    ("24/13", "2/3", "-1/4"),
    ("8/5", "1/2", "0"),
    ("3/2", "3/5", "-1/4"),
    ("15744/13585", "1/3", "3/4"),
    ("5120/2717", "4/5", "0"),
    ("3/2", "3/5", "3/4"),
];

#[test]
fn mobile_loops_have_a_family_of_configurations_and_broken_ones_do_not() {
    for loop_ in [&BENNETT[..], &GOLDBERG, &DIETMAIER] {
        let mut links = member::<43>(loop_);
        let found = configurations(&links, 1000);
        assert!(found.complete && found.all_move(), "{:?}", found.values());
        for turns in &found.turns {
            let all = all_turns::<43>();
            let product = turns.iter().zip(&links).fold(Motion::identity(), |product, (&number, link)| {
                let (cos, sin) = all[usize::from(number)];
                product.then_after(&Motion::rotation_z(cos, sin)).then_after(&link_motion(link))
            });
            assert_eq!(product, Motion::identity());
        }
        links[0].d = links[0].d.add(&ModP::one());
        assert!(!configurations(&links, 1000).are_a_family());
    }
}

#[test]
fn meeting_in_the_middle_finds_what_looking_through_all_rotations_does() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let all = all_turns::<23>();
    for case in 0..6 {
        let mut links = member::<23>(&BENNETT);
        if case > 0 {
            for link in &mut links {
                (link.cos, link.sin) = turn(random_unit(&mut rng));
                (link.a, link.d) = (random_unit(&mut rng), random_unit(&mut rng));
            }
        }
        if case > 3 {
            // A planar loop, whose axes are parallel.
            for link in &mut links {
                (link.cos, link.sin, link.d) = (ModP::one(), ModP::zero(), ModP::zero());
            }
        }
        let motions: Vec<Motion<ModP<23>>> = links.iter().map(link_motion).collect();
        let at =
            |joint: usize, number: usize| Motion::rotation_z(all[number].0, all[number].1).then_after(&motions[joint]);
        let mut expected = Vec::new();
        for (i, j) in (0..24).flat_map(|i| (0..24).map(move |j| (i, j))) {
            let front = at(0, i).then_after(&at(1, j));
            for k in 0..24 {
                let back = front.then_after(&at(2, k)).inverse().then_after(&motions[3].inverse());
                for l in 0..24 {
                    if back == Motion::rotation_z(all[l].0, all[l].1) {
                        expected.push([i, j, k, l].map(|n| u16::try_from(n).unwrap()).to_vec());
                    }
                }
            }
        }
        let mut found = configurations(&links, usize::MAX).turns;
        found.sort();
        assert_eq!(found, expected, "case {case}");
    }
}

#[test]
fn planted_configurations_of_six_joints_are_found() {
    let mut rng = ChaCha8Rng::seed_from_u64(8);
    let mut planted = 0;
    while planted < 5 {
        let spherical: Vec<ModP<43>> = (0..6).map(|_| random_unit(&mut rng)).collect();
        let mut links = spherical_links(&spherical).unwrap();
        let chosen: Vec<_> = (0..6).map(|_| turn(random_unit::<43>(&mut rng))).collect();
        let Some(turns) = closed_by(&links, &chosen, [1, 3, 4], |x| square_root(*x)).pop() else { continue };
        let equations = Directions::of(&links, &turns).equations().to_vec();
        let mut lengths = [ModP::zero(); 12];
        for vector in Echelon::of(equations, 12).null_space() {
            let weight: ModP<43> = random_unit(&mut rng);
            lengths.iter_mut().zip(&vector).for_each(|(total, x)| total.add_product(&weight, x));
        }
        for (k, link) in links.iter_mut().enumerate() {
            (link.a, link.d) = (lengths[k], lengths[6 + k]);
        }
        let numbers: Vec<u16> = turns.iter().map(turn_number).collect();
        assert!(configurations(&links, 1000).turns.contains(&numbers));
        planted += 1;
    }
}

#[test]
fn symmetric_families_are_those_of_bricard_and_each_is_proved() {
    let found = slices::<23>(6, 7);
    assert_eq!(found.len(), 48);
    let mobile: Vec<_> = found.iter().filter(|slice| slice.slice == Slice::Mobile).collect();
    let named = |name: &str| mobile.iter().filter(|slice| slice.involution.name == name).count();
    assert_eq!((mobile.len(), named("half-turn"), named("mirror through two joints")), (6, 4, 2));
    for slice in &mobile {
        assert_eq!((slice.dimension, slice.conditions), (2, 1));
        assert!(identity::proof(slice).is_some());
        if slice.involution.name == "half-turn" {
            assert_eq!(slice.lengths, 6);
        } else {
            // One of lengths and twists changes sign in the mirror, offsets do.
            assert!(slice.lengths == 5 && slice.signs.offset && slice.signs.twist != slice.signs.length);
        }
    }
    let folded: Vec<_> = found.iter().filter(|slice| slice.slice == Slice::Folded).collect();
    assert_eq!(folded.len(), 2);
    for slice in folded {
        let signs = slice.signs;
        assert!(signs.angle && signs.twist && signs.length && signs.offset && slice.conditions == 0);
    }
}

#[test]
fn loops_of_four_and_five_joints_move_by_symmetry_only_folded() {
    for joints in [4, 5] {
        let found = slices::<23>(joints, 3);
        assert!(found.iter().all(|slice| slice.slice != Slice::Mobile));
        assert!(found.iter().any(|slice| slice.slice == Slice::Folded));
    }
}

#[test]
fn goldberg_loops_follow_from_their_twists() {
    let twists: Vec<Rational> = GOLDBERG.iter().map(|(_, t, _)| rational(t)).collect();
    let curves = rational_curves(&twists);
    let zero = "0, 0, 0, 0, 0".to_owned();
    let shape = |lengths: &[Rational]| {
        let list = |part: &[Rational]| part.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        (list(&lengths[..5]), list(&lengths[5..]))
    };
    let proper: Vec<_> = curves.iter().filter(|curve| curve.is_proper()).collect();
    let ratios = |lengths: [&str; 5]| {
        let all = lengths.map(rational);
        let scaled: Vec<Rational> = all.iter().map(|a| Rational::from(a / &all[0])).collect();
        (scaled.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "), zero.clone())
    };
    // (b + c, a, c, b, a) and (b - c, a, -c, b, a).
    for expected in [["91/17", "4", "40/17", "3", "4"], ["11/17", "4", "-40/17", "3", "4"]] {
        let expected = ratios(expected);
        let own: Vec<_> =
            proper.iter().filter(|curve| curve.lengths.len() == 1 && shape(&curve.lengths[0]) == expected).collect();
        assert!(own.len() > 1, "{expected:?}");
        for curve in own {
            let mut links = spherical_links(&twists).unwrap();
            for (k, link) in links.iter_mut().enumerate() {
                (link.a, link.d) = (curve.lengths[0][k].clone(), curve.lengths[0][5 + k].clone());
            }
            assert_eq!(germ(&links, &curve.points[2]).local, Local::Curve);
            links[0].a += 1;
            assert_eq!(germ(&links, &curve.points[2]).local, Local::Open);
        }
    }
    // The ties of neighbouring joints 2 and 3 are those of the Bennett loop of twists alpha and gamma.
    let (a, c) = (rational("1/2"), rational("1/4"));
    let sine = -Rational::from(&a + &c) / Rational::from(&a - &c);
    let product = Rational::from(&a * &c);
    let cosine = Rational::from(1 - &product) / Rational::from(1 + &product);
    let tied = |constant: &Rational| {
        proper.iter().any(|curve| {
            let tie = curve.tie;
            (tie.first, tie.second, tie.relation) == (1, 2, Relation::Product) && curve.constant == *constant
        })
    };
    assert!(tied(&sine) && tied(&cosine));
    // The other curves are Bennett loops with a joint that does not move.
    assert!(curves.iter().filter(|curve| !curve.is_proper()).all(|curve| curve.moving.contains(&false)));
}

#[test]
fn random_twists_of_five_joints_close_on_no_curve() {
    for twists in [["3/5", "2/7", "5/3", "4/7", "1/6"], ["3/5", "2/7", "11/3", "4/7", "7/6"]] {
        assert!(rational_curves(&twists.map(rational)).is_empty());
    }
}

/// `variable` of an ansatz by its name.
fn variable(ansatz: &Ansatz, name: &str) -> Polynomial<Rational> {
    Polynomial::variable(ansatz.symbols.names().index(name).unwrap())
}

#[test]
fn the_cosine_relation_of_dietmaier_is_found_and_proved() {
    let ansatz = builtin("dietmaier_6r");
    let found = sweep(&ansatz, 1).unwrap();
    let [relation] = found.relations.as_slice() else { panic!("{found:?}") };
    let text = Format::Text.polynomial(relation, ansatz.symbols.names());
    let [b, other] = ["b", "b'"].map(|name| variable(&ansatz, name));
    let cos = |k: usize| Polynomial::<Rational>::variable(Symbols::cos(k));
    let expected = b.mul(&cos(0).add(&cos(1))).sub(&other.mul(&cos(3).add(&cos(4))));
    assert!(*relation == expected || *relation == expected.neg(), "{text}");
    assert!(found.trial.unwrap().agrees());
    let proof = multiplier(&ansatz, Some(relation), 1).unwrap();
    // (z1 + z3) x (z4 + z6)
    let one = Rational::from(1);
    let pairs = [(0, 3), (0, 5), (2, 3), (2, 5)].map(|(i, j)| (i, j, one.clone()));
    assert_eq!(proof.terms, pairs);
    // A relation with one sign wrong has no proof, and closed positions do not satisfy it.
    let wrong = b.mul(&cos(0).add(&cos(1))).sub(&other.mul(&cos(3).sub(&cos(4))));
    assert_eq!(multiplier(&ansatz, Some(&wrong), 1), None);
    let closed =
        |relation: &Polynomial<Rational>| closed_positions(&ansatz, std::slice::from_ref(relation), 20, 2).unwrap();
    assert_eq!((closed(relation).positions, closed(relation).satisfied), (20, 20));
    assert_eq!((closed(&wrong).positions, closed(&wrong).satisfied), (20, 0));
    let member = rational_member(&ansatz, std::slice::from_ref(relation), 60_000, 1).unwrap();
    assert_eq!((member.germ.local, member.germ.rank), (Local::Curve, 5));
    let mut broken = member.links.clone();
    broken[0].a += 1;
    assert_eq!(germ(&broken, &member.turns).local, Local::Open);
}

#[test]
fn the_length_relation_of_the_trihedral_loop_is_found() {
    let ansatz = builtin("trihedral_6r");
    let found = sweep(&ansatz, 1).unwrap();
    let [relation] = found.relations.as_slice() else { panic!("{found:?}") };
    let square = |k: usize| variable(&ansatz, &format!("a{k}")).pow(2);
    let expected =
        (1..=6).fold(Polynomial::zero(), |sum, k| if k % 2 == 1 { sum.add(&square(k)) } else { sum.sub(&square(k)) });
    assert!(*relation == expected || *relation == expected.neg());
    assert!(found.trial.unwrap().agrees());
    let closed = closed_positions(&ansatz, &found.relations, 20, 2).unwrap();
    assert_eq!((closed.positions, closed.satisfied), (20, 20));
    let member = rational_member(&ansatz, &found.relations, 60_000, 1).unwrap();
    assert_eq!(member.germ.local, Local::Curve);
    assert_eq!(implication(&ansatz, relation), Some(Implication { joint: 0 }));
    assert_eq!(implication(&ansatz, &relation.add(&square(1))), None);
}

#[test]
fn an_ansatz_that_does_not_move_yields_no_condition() {
    let text = r#"
        title = "Two Bennett proportions alone"
        [symbols]
        angles = ["p", "q", "r", "s", "t", "u"]
        lengths = ["b", "a3", "a4", "a5", "a6"]
        [mechanism]
        kind = "loop"
        convention = "dh"
        joints = [
            { type = "R", a = "b*sin(p)", alpha = "p", d = 1 },
            { type = "R", a = "b*sin(q)", alpha = "q", d = 0 },
            { type = "R", a = "a3", alpha = "r", d = 2 },
            { type = "R", a = "a4", alpha = "s", d = 3 },
            { type = "R", a = "a5", alpha = "t", d = 1 },
            { type = "R", a = "a6", alpha = "u", d = 5 },
        ]
        [ansatz]
        unknown = ["a6"]
        fit = [["a3", "a6"], ["1", "cos(r)", "cos(u)"]]
    "#;
    let ansatz = ansatz_from_text(text, "rigid.toml", FileFormat::Toml, &Options::default()).unwrap();
    let found = sweep(&ansatz, 1).unwrap();
    assert!(found.relations.is_empty() && found.trial.is_none());
}

#[test]
fn members_of_the_symmetric_families_are_proved_mobile_and_general_loops_isolated() {
    // The rational member of the second is a special one: four of its axes meet in a point, and turn by themselves.
    for (name, symmetry, local) in [
        ("line_symmetric_6r", "half-turn", Local::Curve),
        ("plane_symmetric_6r", "mirror through two joints", Local::Manifold { dimension: 1 }),
    ] {
        let found = search(&builtin(name), 1).unwrap();
        let member = found.member.as_ref().unwrap();
        assert_eq!(member.germ.local, local, "{name}");
        assert!(Directions::of(&member.links, &member.turns).closes());
        let own: Vec<_> = found.mobile_slices.iter().filter(|mobile| mobile.contains(&member.links)).collect();
        assert_eq!(own.len(), 1, "{name}");
        assert!(own[0].proof.is_some() && own[0].slice.involution.name == symmetry);
    }
    let member = rational_member(&Ansatz::general(6), &[], 60_000, 1).unwrap();
    assert_ne!(member.germ.local, Local::Curve);
}

/// Exit code, what `looproot conditions` wrote, and its complaints.
fn conditions(arguments: &[&str], input: &str) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_looproot"));
    command.arg("conditions").args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

#[test]
fn the_verb_says_what_is_proved() {
    let (code, out, err) = conditions(&["dietmaier_6r"], "");
    let verdict = out.lines().next().unwrap();
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(verdict.starts_with("mobile where ") && verdict.contains("= 0: proved for all parameters"), "{verdict}");
    assert!(out.contains("w = z1 x z4 + z1 x z6 + z3 x z4 + z3 x z6"), "{out}");
    assert!(out.contains("degenerate, folded back on itself") && out.contains("alpha4 = alpha1"), "{out}");

    let (code, out, _) = conditions(&["trihedral_6r", "--json"], "");
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &document["proved"]), (0, &true.into()));
    assert!(
        document["verdict"].as_str().unwrap().contains(
            "proved for all parameters, a member proved over the rationals; through every real closed position"
        )
    );
    assert_eq!(document["relations"].as_array().unwrap().len(), 1);

    let (code, out, _) = conditions(&["goldberg_5r"], "");
    assert_eq!(code, 0);
    assert!(out.starts_with("4 mobile choices of lengths for example twists, 4 of them proved"), "{out}");
    assert!(out.contains("degenerate, joint 4 locked"), "{out}");
}

#[test]
fn what_cannot_be_searched_is_said() {
    let joint = r#"{ type = "R", a = "a", alpha = "p", d = "d" }"#;
    let file = |unknown: &str, joints: usize| {
        format!(
            "[symbols]\nangles = [\"p\"]\nlengths = [\"a\", \"d\", \"e\"]\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\n\
             joints = [{}]\n[ansatz]\nunknown = [{unknown}]\n",
            vec![joint; joints].join(", ")
        )
    };
    let (code, _, err) = conditions(&["-"], &file("\"a\", \"x\"", 6));
    assert!(code == 1 && err.contains("the unknown `x`, expected one of the symbols: a, d, e, p"), "{err}");
    for (letter, instead) in [("P", ""), ("C", ""), ("S", "three R joints"), ("U", "two R joints")] {
        let text = file("", 6).replacen("\"R\"", &format!("\"{letter}\""), 1);
        let (code, out, err) = conditions(&["-", "--json"], &text);
        let expected =
            format!("a joint of type `{letter}`: conditions are derived for loops of 4 to 6 revolute joints");
        assert!(code == 4 && out.is_empty() && err.contains(&expected) && err.contains(instead), "{err}");
    }
    let numbers = file("", 6).replace("\"a\", alpha = \"p\", d = \"d\"", "1, tan_half_alpha = \"1/3\", d = 0");
    let (code, _, err) =
        conditions(&["-"], &numbers.replace("angles = [\"p\"]\nlengths = [\"a\", \"d\", \"e\"]\n", ""));
    assert!(code == 4 && err.contains("`looproot mobility` decides"), "{err}");
    let (code, _, err) = conditions(&["-"], &file("", 7));
    assert!(code == 4 && err.contains("7 joints"), "{err}");
}

/// A built-in ansatz as text.
fn text_of(name: &str) -> String {
    std::fs::read_to_string(format!("{}/equations/conditions/{name}.toml", crate::ROOT)).unwrap()
}

#[test]
fn with_two_lengths_unknown_one_runs_where_that_is_enough() {
    let text = text_of("trihedral_6r").replace("unknown = [\"a6\"]", "unknown = [\"a5\", \"a6\"]");
    let (code, out, _) = conditions(&["-"], &text);
    let verdict = out.lines().next().unwrap();
    let expected = "mobile where a1^2 - a2^2 + a3^2 - a4^2 + a5^2 - a6^2 = 0: proved for all parameters";
    assert!(code == 0 && verdict.starts_with(expected), "{verdict}");
    assert!(out.contains("Sweep over a5 (a6 drawn with the parameters)"), "{out}");
}

#[test]
fn an_unknown_twist_is_found() {
    let text = text_of("line_symmetric_6r")
        .replace("\"alpha6 = alpha3\",", "")
        .replace("[ansatz]", "[ansatz]\nunknown = [\"alpha6\"]");
    let ansatz = ansatz_from_text(&text, "twist.toml", FileFormat::Toml, &Options::default()).unwrap();
    let found = search(&ansatz, 1).unwrap();
    let family = found.fitted.as_ref().unwrap().family.as_ref().unwrap();
    assert_eq!((family.angle.as_deref(), family.condition.is_none()), (Some("alpha6 = alpha3"), true));
    assert_eq!(found.fitted.unwrap().member.unwrap().germ.local, Local::Curve);
}

#[test]
fn relations_that_others_imply_are_left_out_and_identities_of_all_members_are_none() {
    // Terms of which cos^2 + sin^2 - 1 is a combination, and products with the relation.
    let text = text_of("wohlhart_6r").replace(
        "unknown = [\"d5\"]",
        "unknown = [\"d5\"]\nfit = [[\"d1\", \"d3\", \"d5\"], [\"1\", \"cos(alpha1)\", \"cos(alpha1)^2\", \"sin(alpha1)^2\"]]",
    );
    let ansatz = ansatz_from_text(&text, "wohlhart.toml", FileFormat::Toml, &Options::default()).unwrap();
    let found = sweep(&ansatz, 1).unwrap();
    let sum = ["d1", "d3", "d5"].map(|name| variable(&ansatz, name));
    let expected = sum.iter().fold(Polynomial::zero(), |sum, d| sum.add(d));
    assert!(found.relations == [expected.clone()] || found.relations == [expected.neg()], "{:?}", found.relations);
    // Without the three terms that are combinations of others.
    assert_eq!(found.terms, 9);
    assert!(found.trial.unwrap().agrees());
    assert!(matches!(search(&ansatz, 1).unwrap().fitted.unwrap().proof, Some(FamilyProof::Multiplier(_))));
}

#[test]
fn random_members_over_prime_fields_tell_families_from_others() {
    let ansatz = builtin("dietmaier_6r");
    let [b, other] = ["b", "b'"].map(|name| variable(&ansatz, name));
    let cos = |k: usize| Polynomial::<Rational>::variable(Symbols::cos(k));
    let relation = b.mul(&cos(0).add(&cos(1))).sub(&other.mul(&cos(3).add(&cos(4))));
    let found = modular_members(&ansatz, &[relation], 2, 3);
    assert!(found.all_move() && found.members == 4, "{found:?}");
    assert!(!modular_members(&Ansatz::general(6), &[], 2, 3).all_move());
}

#[test]
fn a_file_that_states_the_condition_is_proved_for_all_parameters() {
    let known = text_of("dietmaier_6r");
    let start = known.find("[ansatz]").unwrap();
    let relation = "b*(cos(alpha1) + cos(alpha2)) = b'*(cos(alpha4) + cos(alpha5))";
    let (code, out, _) =
        conditions(&["-", "-q"], &format!("{}[ansatz]\nrelations = [\"{relation}\"]\n", &known[..start]));
    assert_eq!((code, out.as_str()), (0, "mobile: proved for all parameters, a member proved over the rationals\n"));
    let wrong = relation.replacen("+ cos(alpha2)", "- cos(alpha2)", 1);
    let (code, out, _) = conditions(&["-", "-q"], &format!("{}[ansatz]\nrelations = [\"{wrong}\"]\n", &known[..start]));
    // Members with b = b' = 0 satisfy it and move: nothing is said of the others.
    assert!(code == 2 && !out.starts_with("mobile"), "{out}");
}

#[test]
fn twists_with_a_symmetry_say_which_lengths_move() {
    let text = text_of("line_symmetric_6r").replace("\"a4 = a1\", ", "");
    let ansatz = ansatz_from_text(&text, "lengths.toml", FileFormat::Toml, &Options::default()).unwrap();
    let found = search(&ansatz, 1).unwrap();
    let [pattern] = found.patterns.as_slice() else { panic!("{:?}", found.patterns) };
    let [one, four] = ["a1", "a4"].map(|name| variable(&ansatz, name));
    assert!(pattern.proved && pattern.involution == "half-turn");
    assert!(pattern.conditions == [four.sub(&one)] || pattern.conditions == [one.sub(&four)]);
    let whole = search(&builtin("line_symmetric_6r"), 1).unwrap();
    assert!(whole.patterns.iter().any(|pattern| pattern.conditions.is_empty() && pattern.proved));
}

#[test]
fn goldberg_and_myard_have_formulas_for_all_twists() {
    let zero = ["d1", "d2", "d3", "d4", "d5"].map(|name| format!("{name} = 0"));
    for (name, wanted) in [
        (
            "goldberg_5r",
            ["a2 - a5 = 0", "sin_alpha*a3 - sin_gamma*a2 = 0", "sin_alpha*a4 - sin_beta*a2 = 0", "a1 - a3 - a4 = 0"],
        ),
        (
            "goldberg_5r",
            ["a2 - a5 = 0", "sin_alpha*a3 + sin_gamma*a2 = 0", "sin_alpha*a4 - sin_beta*a2 = 0", "a1 - a3 - a4 = 0"],
        ),
        ("myard_5r", ["a3 = 0", "a1 - a5 = 0", "a2 - a4 = 0", "sin_alpha*a2 - a1 = 0"]),
    ] {
        let (code, out, _) = conditions(&[name], "");
        assert!(code == 0 && out.lines().next().unwrap().ends_with("4 for all twists by an identity"), "{out}");
        let has =
            |line: &str| wanted.iter().all(|part| line.contains(part)) && zero.iter().all(|part| line.contains(part));
        assert!(out.lines().any(has), "{name}: {out}");
    }
    // In the languages of other programs too.
    let (code, out, _) = conditions(&["myard_5r", "--format", "singular", "--family", "loop 1"], "");
    assert!(code == 0 && out.contains("ring ") && out.contains("sin_alpha*a2"), "{out}");
    let (code, _, err) = conditions(&["myard_5r", "--format", "singular", "--family", "loop 9"], "");
    assert!(code == 1 && err.contains("expected a part of one of: loop 1; loop 2"), "{err}");
}

#[test]
fn a_loop_of_the_ansatz_is_told_from_others_of_its_twists() {
    let goldberg = text_of("goldberg_5r");
    let (code, out, _) = conditions(&["-", "-q"], &format!("{goldberg}\n[ansatz]\nrelations = [\"a1 = 2*a3 + a4\"]\n"));
    assert!(code == 2 && out.contains("none is in the ansatz"), "{out}");
    let relations = "\"d1 = 0\", \"d2 = 0\", \"d3 = 0\", \"d4 = 0\", \"d5 = 0\", \"a5 = a2\", \"a2*sin(gamma) = a3*sin(alpha)\", \
                     \"a2*sin(beta) = a4*sin(alpha)\"";
    let unknown = format!(
        "{goldberg}\n[ansatz]\nrelations = [{relations}]\nunknown = [\"a1\"]\nfit = [\"a1\", \"a2\", \"a3\", \"a4\"]\n"
    );
    let (code, out, _) = conditions(&["-", "-q"], &unknown);
    assert!(code == 0 && out.starts_with("mobile where a1 - a3 - a4 = 0: proved for all parameters"), "{out}");
}

#[test]
fn a_condition_without_real_solution_is_said_to_be_empty() {
    let text = text_of("trihedral_6r").replace(
        "unknown = [\"a6\"]",
        "unknown = [\"a6\"]\nrelations = [\"a1 = 1\", \"a3 = 4\", \"a5 = 5\", \"a2 = 2\", \"a4 = 7\"]",
    );
    let text = text.split("fit = [").next().unwrap().to_owned() + "fit = [\"1\", \"a6\", \"a6^2\"]\n";
    let (code, out, _) = conditions(&["-", "-q"], &text);
    assert!(code == 3 && out.starts_with("no real mechanism: the real solution set is empty, "), "{out}");
}

#[test]
fn other_conventions_give_the_same_loop() {
    let goldberg = builtin("goldberg_5r");
    // Rx Tx of each joint before its Rz Tz: those of the link before it.
    let links = [("a1", "beta + gamma"), ("a2", "alpha"), ("a3", "gamma"), ("a4", "beta"), ("a5", "alpha")];
    let joint = |k: usize| {
        let (a, alpha) = links[(k + 4) % 5];
        format!("{{ type = \"R\", a = \"{a}\", alpha = \"{alpha}\", d = \"d{}\" }}", k + 1)
    };
    let start = text_of("goldberg_5r").split("joints").next().unwrap().replace("\"dh\"", "\"modified-dh\"");
    let text = format!("{start}joints = [{}]", (0..5).map(joint).collect::<Vec<_>>().join(", "));
    let modified = ansatz_from_text(&text, "modified.toml", FileFormat::Toml, &Options::default()).unwrap();
    for (one, other) in goldberg.joints.iter().zip(&modified.joints) {
        assert_eq!((&one.a, &one.alpha, &one.d), (&other.a, &other.alpha, &other.d));
    }
}

#[test]
fn screw_axes_give_twists_lengths_and_offsets_where_they_are_rational() {
    // The Bennett loop of twists 2 arctan(1/2) and 2 arctan(1/3) in an exact position, by its axes there.
    let mut axes = Vec::new();
    let mut frame = Motion::<Rational>::identity();
    for ((a, t, _), theta) in BENNETT.iter().zip(["2", "-5/2", "-2", "5/2"]) {
        let [(c, s), (cos, sin)] = [*t, theta].map(|t| half_tangent_turn(&rational(t)).unwrap());
        let link = Link { cos: c, sin: s, a: rational(a), d: Rational::new() };
        let vector = |column: [&Rational; 3]| column.map(|x| format!("\"{x}\"")).join(", ");
        axes.push(format!(
            "{{ type = \"R\", axis = [{}], point = [{}] }}",
            vector([0, 1, 2].map(|i| &frame.rotation[i][2])),
            vector([0, 1, 2].map(|i| &frame.translation[i])),
        ));
        frame = frame.then_after(&Motion::rotation_z(cos, sin)).then_after(&link_motion(&link));
    }
    assert_eq!(frame, Motion::identity());
    let text = format!("[mechanism]\nkind = \"loop\"\nconvention = \"screws\"\njoints = [{}]\n", axes.join(", "));
    let (code, out, _) = conditions(&["-", "-q"], &text);
    assert!(code == 0 && out.starts_with("moves: Bennett"), "{out}");
    let irrational = text.replacen("axis = [\"0\", \"0\", \"1\"]", "axis = [1, 0, 1]", 1);
    let (code, _, err) = conditions(&["-", "-q"], &irrational);
    assert!(code == 4 && err.contains("no rational root"), "{err}");
}

#[test]
fn symbols_that_relations_give_by_square_roots_and_quotients_are_solved_for() {
    let text = r#"
[symbols]
angles = ["alpha", "beta", "gamma"]
lengths = ["a", "b", "c"]
[mechanism]
kind = "loop"
convention = "dh"
joints = [
    { type = "R", a = "a", alpha = "alpha", d = 0 },
    { type = "R", a = "b", alpha = "beta", d = 0 },
    { type = "R", a = "c", alpha = "gamma", d = 0 },
    { type = "R", a = "a", alpha = "alpha", d = 0 },
    { type = "R", a = "b", alpha = "beta", d = 0 },
    { type = "R", a = "c", alpha = "gamma", d = 0 },
]
[ansatz]
relations = [
    "3*cos(beta) + 4*sin(beta) = 2*cos(alpha)",
    "tan_half(gamma)*(1 + sin(alpha)) = cos(beta)",
    "c*a = 7*b^2",
]
"#;
    let ansatz = ansatz_from_text(text, "own.toml", FileFormat::Toml, &Options::default()).unwrap();
    assert!(ansatz.has_solved_symbols());
    assert_eq!((ansatz.free_angles(), ansatz.free_lengths()), (&[0][..], vec![0, 1]));
    let members = ansatz.with_roots::<ModP<103>>(|x| square_root(*x)).unwrap();
    let mut found = 0;
    for t in 2..60 {
        let draw = [ModP::new(t)];
        let Some(values) = members.values(&draw, &[ModP::new(5), ModP::new(8)]) else { continue };
        found += 1;
        let [alpha, beta, gamma] =
            [0, 1, 2].map(|k| [values[Symbols::cos(k)], values[Symbols::sin(k)], values[Symbols::tan_half(k)]]);
        let times = |n: i32, x: ModP<103>| ModP::from_integer(n).mul(&x);
        assert_eq!(times(3, beta[0]).add(&times(4, beta[1])), times(2, alpha[0]));
        assert_eq!(gamma[2].mul(&ModP::one().add(&alpha[1])), beta[0]);
        let length = |k: usize| values[ansatz.symbols.length(k)];
        assert_eq!(length(2).mul(&length(0)), times(7, length(1).mul(&length(1))));
    }
    // A square root there is for about half of the values.
    assert!((15..45).contains(&found), "{found}");
}

#[test]
fn the_hybrid_of_two_bennett_loops_moves_where_its_two_shifts_agree() {
    let ansatz = builtin("waldron_6r");
    let found = sweep(&ansatz, 1).unwrap();
    let sum = variable(&ansatz, "s").add(&variable(&ansatz, "t"));
    assert!(found.relations == [sum.clone()] || found.relations == [sum.neg()], "{:?}", found.relations);
    assert!(found.trial.unwrap().agrees());
    let text =
        text_of("waldron_6r").replace("unknown = [\"t\"]", "").replace("relations = [", "relations = [\"t = -s\",");
    let family = ansatz_from_text(&text, "waldron.toml", FileFormat::Toml, &Options::default()).unwrap();
    let member = held_member(&family, 1).unwrap();
    assert_eq!((member.germ.rank, member.germ.local), (5, Local::Curve));
}

#[test]
fn a_member_of_the_double_goldberg_loops_is_proved_at_a_position_with_a_joint_held() {
    let [right, wrong] = ["a5 = k*sin(alpha) + k*sin(gamma)", "a5 = k*sin(alpha) - k*sin(gamma)"].map(|relation| {
        let text =
            text_of("double_goldberg_6r").replace("unknown = [\"a5\"]", &format!("relations = [\"{relation}\"]"));
        ansatz_from_text(&text, "goldberg.toml", FileFormat::Toml, &Options::default()).unwrap()
    });
    let member = held_member(&right, 1).unwrap();
    assert_eq!((member.germ.rank, member.germ.local), (5, Local::Curve));
    assert!(held_member(&wrong, 1).is_none());
}
