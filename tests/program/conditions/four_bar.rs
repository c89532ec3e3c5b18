//! The 4R loop: the numbers of the derivation, what it says of loops with numbers, and what it refuses.

use looproot::internal::catalogue::ansatz::Ansatz;
use looproot::internal::catalogue::{Format, Options, ansatz_from_text, load_ansatz};
use looproot::internal::conditions::closure_identity::{closes, product};
use looproot::internal::conditions::component::{Coefficients, Component};
use looproot::internal::conditions::decide::{Class, Decision, decide, lengths_at};
use looproot::internal::conditions::four_bar::{FourBar, LENGTHS, conditions, derive, members};
use looproot::internal::conditions::null_space::{null_space, square_root};
use looproot::internal::conditions::twist_family::{families, sine};
use looproot::internal::derivation::transference::Variables;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use looproot_algebra::text::{Expression, Names};
use proptest::prelude::*;
use rug::Rational;
use std::sync::OnceLock;

type Poly = Polynomial<Int>;

/// Derived once for all tests.
fn theorem() -> &'static FourBar {
    static THEOREM: OnceLock<FourBar> = OnceLock::new();
    THEOREM.get_or_init(derive)
}

/// A polynomial in half-angle tangents, lengths, offsets, x and y.
fn poly(text: &str) -> Poly {
    let mut names = Names::given(Variables::TANGENTS).unwrap();
    Expression::parse(text, &mut names).unwrap().expand().unwrap().numerator
}

/// A loop of numbers: length, half-angle tangent of the twist, offset of each joint.
fn numbers(joints: [[&str; 3]; 4]) -> Decision {
    let joint =
        |[a, t, d]: [&str; 3]| format!("{{ type = \"R\", a = \"{a}\", tan_half_alpha = \"{t}\", d = \"{d}\" }}");
    let text =
        format!("[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [{}]\n", joints.map(joint).join(", "));
    let ansatz = ansatz_from_text(&text, "x.toml", Format::Toml, &Options::default()).unwrap();
    decide(theorem(), &ansatz).unwrap()
}

fn classes(decision: &Decision) -> Vec<Class> {
    let mut classes: Vec<Class> = decision.families.iter().map(|family| family.class).collect();
    classes.dedup();
    classes
}

#[test]
fn every_step_holds_with_the_known_numbers() {
    let theorem = theorem();
    for step in &theorem.steps {
        assert!(step.holds, "{}", step.title);
    }
    assert!(theorem.is_proved());
    assert_eq!((theorem.pair.f.len(), theorem.pair.g.len()), (84, 408));
    let all: String = theorem.steps.iter().flat_map(|step| &step.formulas).map(|f| f.value.clone() + "\n").collect();
    for golden in [
        "16384 t1^2 t2 t3^2 t4^3 (t1^2 + 1)^3 (t2^2 + 1)^4 (t3^2 + 1)^3 (t4^2 + 1)^2",
        "65536 t1^2 t2^2 t3^2 t4^2 (t1^2 + 1)^2 (t2^2 + 1)^2 (t3^2 + 1)^2 (t4^2 + 1)^2",
        "-2 s(+++-) s(+-+-)",
        "16 t1 t3 (t2^2 + 1) (t4^2 + 1)",
    ] {
        assert!(all.contains(golden), "{golden} in\n{all}");
    }
    let texts: String = theorem.steps.iter().map(|step| step.text.as_str()).collect();
    assert!(texts.contains("240 terms"));
}

#[test]
fn bennetts_conditions_and_constants() {
    let theorem = theorem();
    assert_eq!(theorem.bennett.len(), 16);
    let usual = [poly("t2 - t4"), poly("t1 - t3"), poly("a1 - a3"), poly("a2 - a4")];
    let mut found = Vec::new();
    for bennett in &theorem.bennett {
        let conditions = conditions(bennett);
        if usual.iter().all(|condition| conditions.contains(condition)) {
            for k in 1..=4 {
                assert!(conditions.contains(&poly(&format!("d{k}"))));
            }
            found.push((conditions, bennett));
        }
    }
    assert_eq!(found.len(), 2);
    let plus = poly("a1*t2*(1 + t1^2) - a2*t1*(1 + t2^2)");
    let minus = poly("a1*t2*(1 + t1^2) + a2*t1*(1 + t2^2)");
    let of = |condition: &Poly| found.iter().find(|(conditions, _)| conditions.contains(condition)).unwrap().1;
    // y = K/x with K = (t1 + t2)/(t1 - t2), and (1 - t1 t2)/(1 + t1 t2).
    let is = |ratio: &(Poly, Poly), n: &str, d: &str| ratio.0.mul(&poly(d)) == ratio.1.mul(&poly(n));
    assert!(is(&of(&plus).fourth, "t1 + t2", "x*(t1 - t2)"));
    assert!(is(&of(&minus).fourth, "1 - t1*t2", "x*(1 + t1*t2)"));
    // tan(theta1/2) tan(theta2/2) = -K in the first, K in the second; theta3 = -theta1, theta1.
    assert!(is(&of(&plus).angles[1], "-(t1 + t2)", "x*(t1 - t2)"));
    assert!(is(&of(&plus).angles[2], "-x", "1"));
    assert!(is(&of(&minus).angles[1], "1 - t1*t2", "x*(1 + t1*t2)"));
    assert!(is(&of(&minus).angles[2], "x", "1"));
}

#[test]
fn the_closure_identity_discriminates() {
    for bennett in &theorem().bennett {
        let right = members(bennett);
        assert!(closes(&right));
        let (_, scalar) = product(&right);
        assert!(!scalar.is_zero());
        for joint in 1..4 {
            let mut wrong = right.clone();
            wrong[joint].theta.0 = wrong[joint].theta.0.neg();
            let (rest, _) = product(&wrong);
            assert!(rest.iter().filter(|p| !p.is_zero()).count() >= 2, "joint {joint}");
            assert!(!closes(&wrong));
        }
        let mut wrong = right.clone();
        wrong[2].a = wrong[2].a.neg();
        assert!(!closes(&wrong));
    }
    // The scalar of the family with the plus sign, as in a calculation by hand.
    let usual = |b: &&looproot::internal::conditions::four_bar::Bennett| {
        conditions(b).contains(&poly("a1*t2*(1 + t1^2) - a2*t1*(1 + t2^2)"))
            && conditions(b).contains(&poly("t1 - t3"))
            && conditions(b).contains(&poly("t2 - t4"))
    };
    let scalar = product(&members(theorem().bennett.iter().find(usual).unwrap())).1;
    let expected = poly("256*(1 + x^2)*(1 + t1^2)*(1 + t2^2)*((t1 - t2)^2*x^2 + (t1 + t2)^2)");
    assert!(scalar == expected || scalar == expected.neg());
}

#[test]
fn numbers_are_decided() {
    let bennett = numbers([["4", "1/2", "0"], ["3", "1/3", "0"], ["4", "1/2", "0"], ["3", "1/3", "0"]]);
    assert_eq!((classes(&bennett), bennett.confirmed), (vec![Class::Bennett], Some(true)));
    assert!(bennett.families[0].note.as_ref().unwrap().contains("tan(theta1/2) tan(theta4/2) = 5"));
    let broken = [["4", "1/2", "0"], ["3", "1/3", "0"], ["4", "1/2", "0"], ["31/10", "1/3", "0"]];
    assert_eq!((classes(&numbers(broken)), numbers(broken).confirmed), (vec![], Some(true)));
    let offset = numbers([["4", "1/2", "0"], ["3", "1/3", "1/1000000000"], ["4", "1/2", "0"], ["3", "1/3", "0"]]);
    assert_eq!((classes(&offset), offset.confirmed), (vec![], Some(true)));
    let spherical = numbers([["0", "1/2", "0"], ["0", "1/3", "0"], ["0", "1/5", "0"], ["0", "3/7", "0"]]);
    assert_eq!(classes(&spherical), [Class::Spherical]);
    let planar = numbers([["1", "0", "1"], ["2", "0", "0"], ["3", "inf", "2"], ["3", "inf", "3"]]);
    assert_eq!(classes(&planar), [Class::Planar]);
    let shifted = numbers([["1", "0", "1"], ["2", "0", "0"], ["3", "0", "0"], ["3", "0", "0"]]);
    assert_eq!(classes(&shifted), []);
    // The directions of the axes do not come back to themselves.
    assert_eq!(classes(&numbers([["1", "0", "0"], ["2", "0", "0"], ["3", "0", "0"], ["3", "inf", "0"]])), []);
    // A rhombus: K is infinite, only folds.
    let rhombus = numbers([["2", "1/2", "0"], ["2", "1/2", "0"], ["2", "1/2", "0"], ["2", "1/2", "0"]]);
    assert_eq!((classes(&rhombus), rhombus.confirmed), (vec![Class::Coincident], Some(true)));
    // Two parallel neighbours in an oblique loop.
    assert_eq!(classes(&numbers([["1", "0", "0"], ["2", "1/2", "0"], ["3", "1/3", "0"], ["1", "1/5", "0"]])), []);
}

/// Three parallel axes, the outer two of which coincide where the links between them lie on each other, as the other two links do: the loop
/// moves, whatever the lengths are, in every order of the joints. A length, a twist or an offset that is off locks it.
#[test]
fn folds_with_parallel_links_move() {
    let loops = [
        // Links lie on each other at half a turn, or are opposite and stretched.
        [["2", "1/2", "0"], ["2", "1/2", "0"], ["1", "0", "0"], ["1", "0", "0"]],
        [["2", "1/2", "-1"], ["-2", "-1/2", "0"], ["1", "0", "3"], ["-1", "0", "-2"]],
        [["3", "-2/3", "-1"], ["3", "-2/3", "0"], ["1/2", "0", "2"], ["1/2", "0", "-1"]],
    ];
    for joints in loops {
        for first in 0..4 {
            let turned: [[&str; 3]; 4] = std::array::from_fn(|k| joints[(first + k) % 4]);
            assert_eq!(classes(&numbers(turned)), [Class::Coincident], "{turned:?}");
        }
        for (joint, part, value) in [(2, 0, "7/8"), (0, 1, "3/7"), (1, 2, "1/9"), (3, 2, "11/9")] {
            let mut off = joints;
            off[joint][part] = value;
            assert!(numbers(off).families.is_empty(), "{off:?}");
        }
    }
}

#[test]
fn the_general_loop_and_the_file_of_bennett() {
    let general = decide(theorem(), &Ansatz::general(4)).unwrap();
    assert_eq!(
        classes(&general),
        [Class::Bennett, Class::Spherical, Class::Coincident, Class::Planar, Class::Coincident]
    );
    assert_eq!(general.families.iter().filter(|family| family.class == Class::Bennett).count(), 16);
    let file = decide(theorem(), &load_ansatz("bennett", &Options::default()).unwrap()).unwrap();
    let first = &file.families[0];
    let mut names = file.names.clone();
    let text = "t1^2*t2*a1 - t1*t2^2*a2 - t1*a2 + t2*a1";
    let plus = Expression::parse(text, &mut names).unwrap().expand().unwrap().numerator;
    assert_eq!(first.name, "Bennett (+)");
    assert!(first.conditions.contains(&plus), "{:?}", first.conditions);
    assert_eq!(first.conditions.len(), 7);
}

#[test]
fn relations_of_an_ansatz_leave_what_is_left() {
    // Bennett's lengths by their ratio: nothing is left but the twists.
    let text = "[symbols]\nangles = [\"u\", \"v\"]\nlengths = [\"b\"]\n[mechanism]\nkind = \"loop\"\nconvention = \"dh\"\njoints = [\n\
        { type = \"R\", a = \"b*sin(u)\", alpha = \"u\", d = 0 }, { type = \"R\", a = \"b*sin(v)\", alpha = \"v\", d = 0 },\n\
        { type = \"R\", a = \"b*sin(u)\", alpha = \"u\", d = 0 }, { type = \"R\", a = \"b*sin(v)\", alpha = \"v\", d = 0 }]\n";
    let ansatz = ansatz_from_text(text, "x.toml", Format::Toml, &Options::default()).unwrap();
    let decision = decide(theorem(), &ansatz).unwrap();
    assert_eq!(decision.families[0].class, Class::Bennett);
    assert!(decision.families[0].conditions.is_empty());
    assert_eq!(decision.families.iter().filter(|family| family.class == Class::Bennett).count(), 1);
    let sine = text.replace("b*sin(v)\", alpha = \"v\", d = 0 }]", "b*sin(v) + 1\", alpha = \"v\", d = 0 }]");
    let ansatz = ansatz_from_text(&sine, "x.toml", Format::Toml, &Options::default()).unwrap();
    assert!(decide(theorem(), &ansatz).unwrap().families.iter().all(|family| family.class != Class::Bennett));
}

#[test]
fn loops_of_the_library_are_decided() {
    let expected = [
        ("bennett_a", &[Class::Bennett][..]),
        ("bennett_b", &[Class::Bennett]),
        ("bennett_c", &[Class::Bennett]),
        ("bennett_broken", &[]),
        ("planar_4r", &[Class::Planar]),
    ];
    for (name, classes_of_it) in expected {
        let ansatz = load_ansatz(name, &Options::default()).unwrap();
        let decision = decide(theorem(), &ansatz).unwrap();
        assert_eq!(classes(&decision), classes_of_it, "{name}");
        assert_ne!(decision.confirmed, Some(false), "{name}");
    }
    // Screw axes have no link parameters to be asked about.
    assert_eq!(load_ansatz("motion_polynomial_4r", &Options::default()).unwrap_err().exit_code(), 4);
}

#[test]
fn linear_conditions_at_numbers() {
    let ratio = |n: i32, d: i32| (Poly::constant(Int::from_integer(n)), Poly::constant(Int::from_integer(d)));
    let constant = |n: i32| Poly::constant(Int::from_integer(n));
    let spaces = lengths_at(theorem(), &[ratio(1, 2), ratio(1, 3), ratio(1, 2), ratio(1, 3)]).unwrap();
    let expected = [[4, 3, 4, 3, 0, 0], [4, -3, 4, -3, 0, 0]].map(|row| row.map(constant).to_vec());
    assert!(spaces.len() == 2 && expected.iter().all(|vector| spaces.contains(&vec![vector.clone()])), "{spaces:?}");
    // Irreducible, and a deltoid: no lengths.
    for twists in [[(1, 2), (1, 3), (2, 5), (3, 7)], [(1, 2), (1, 2), (1, 3), (1, 3)]] {
        let spaces = lengths_at(theorem(), &twists.map(|(n, d)| ratio(n, d))).unwrap();
        assert!(spaces.iter().all(Vec::is_empty), "{twists:?}: {spaces:?}");
    }
    assert_eq!(LENGTHS.len(), 6);
}

#[test]
fn components_of_special_curves() {
    let curve = |text: &str| Coefficients::of(&poly(text)).unwrap().components();
    let count = |text: &str| curve(text).map(|list| (list.iter().filter(|c| c.moves()).count(), list.len()));
    assert_eq!(count("(x*y - 2)*(x*y - 3)"), Some((2, 2)));
    assert_eq!(count("(y - 2*x)*(y - 3*x)"), Some((2, 2)));
    assert_eq!(count("x*y*(x*y + 1)"), Some((1, 3)));
    assert_eq!(count("x*y + 1"), Some((1, 3)));
    assert_eq!(count("x*y"), Some((0, 4)));
    assert_eq!(count("x*(y + x)"), Some((1, 3)));
    assert_eq!(count("x*y + x^2 + 1"), Some((1, 2)));
    assert_eq!(count("y*(x^2*y + y + x)"), Some((1, 2)));
    assert_eq!(count("x*(x*y^2 + x + y)"), Some((1, 2)));
    assert_eq!(count("x*y + y^2 + 1"), Some((1, 2)));
    // Irreducible; reducible over another field only; without x y.
    assert_eq!(count("x^2*y^2 + 2*x^2 + 3*y^2 + x*y + 5"), None);
    assert_eq!(count("x^2*y^2 + x*y + 1"), None);
    assert_eq!(count("x^2*y^2 + 1"), None);
    assert!(Coefficients::of(&poly("x^2*y + 1")).is_none());
    let fold = Component::Fold { variable: Variables::X, infinite: true };
    assert_eq!(fold.restricted(&poly("x^2*y + 3*x^2 + x*y")), [poly("3"), poly("1")]);
}

#[test]
fn sines_and_families() {
    assert_eq!(sine([1, 1, 1, 1]).len(), 8);
    assert!(families([1, 1, 1, -1], [1, 1, 1, 1]).is_none());
    let found = families([1, 1, 1, -1], [1, -1, 1, 1]).unwrap();
    let relations = found.map(|family| family.relations);
    assert_eq!(relations, [[poly("t1 + t3"), poly("t2 - t4")], [poly("t1*t3 - 1"), poly("t2*t4 + 1")]]);
}

#[test]
fn square_roots_and_null_spaces() {
    let p = poly("3*t1^2 - 6*t2*x + 1").scale(&Int::from_integer(5));
    let root = square_root(&p.mul(&p)).unwrap();
    assert!(root == p || root == p.neg());
    assert!(square_root(&p.mul(&p).neg()).is_none() && square_root(&poly("2*t1^2")).is_none());
    assert!(square_root(&poly("t1^3")).is_none());
    assert_eq!(square_root(&Poly::zero()), Some(Poly::zero()));
    let rows = [vec![poly("t1"), poly("t2"), poly("0")], vec![poly("t1^2"), poly("t1*t2"), poly("0")]];
    assert_eq!(null_space(&rows, 3), [vec![poly("t2"), poly("-t1"), poly("0")], vec![poly("0"), poly("0"), poly("1")]]);
    assert!(null_space(&[vec![poly("t1"), poly("1")], vec![poly("1"), poly("t1")]], 2).is_empty());
    assert_eq!(null_space(&[], 1), [vec![poly("1")]]);
}

/// A small fraction that is not zero.
fn fraction() -> impl Strategy<Value = Rational> {
    (1_i32..9, 1_i32..9, any::<bool>()).prop_map(|(n, d, negative)| Rational::from((if negative { -n } else { n }, d)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn random_bennett_loops_move_and_perturbed_ones_do_not(
        u in fraction(), v in fraction(), b in fraction(), which in 0_usize..8, digits in 3_usize..10, minus in any::<bool>(),
    ) {
        // Neither folded nor both right-angled, where other signs of the lengths are possible.
        let product = Rational::from(&u * &v);
        prop_assume!(u.clone().abs() != v.clone().abs() && product.clone().abs() != 1);
        let sine = |t: &Rational| -> Rational { t / (Rational::from(t * t) + 1) };
        let first: Rational = sine(&u) * &b;
        let second: Rational = sine(&v) * &b;
        let second = if minus { -second } else { second };
        let mut values = [
            [first.clone(), u.clone(), Rational::new()], [second.clone(), v.clone(), Rational::new()],
            [first, u, Rational::new()], [second, v, Rational::new()],
        ];
        let decided = |values: &[[Rational; 3]; 4]| {
            let texts: Vec<[String; 3]> = values.iter().map(|joint| joint.each_ref().map(ToString::to_string)).collect();
            numbers(std::array::from_fn(|k| texts[k].each_ref().map(String::as_str)))
        };
        let right = decided(&values);
        prop_assert_eq!(classes(&right), [Class::Bennett]);
        prop_assert_eq!(right.confirmed, Some(true));
        let entry = [(0, 0), (1, 0), (2, 0), (3, 0), (0, 2), (1, 2), (2, 1), (3, 2)][which];
        values[entry.0][entry.1] += Rational::from((1, 10_u64.pow(u32::try_from(digits).unwrap())));
        let wrong = decided(&values);
        prop_assert!(!classes(&wrong).contains(&Class::Bennett), "{values:?}");
        prop_assert_eq!(wrong.confirmed, Some(true));
    }
}
