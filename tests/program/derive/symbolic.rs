//! Derivations with symbols: what they say of the numbers, and of solutions.

use super::{entry, named, real, run, solved};
use looproot::internal::catalogue::entry::{Case, Design, Entry, Input, InputValue};
use looproot::internal::derivation::transference::SpatialFourBar;
use looproot::internal::derivation::{Symbolic, Watch, derive, derive_symbolic, derive_with_symbols};
use looproot::internal::kinematics::chain::{Chain, Geometry, Joint, JointKind, Placement};
use looproot_algebra::number::{Angle, HalfTangent, Number};
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::text::Format;
use looproot_algebra::univariate::Univariate;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

fn symbolic(entry: &Entry) -> Symbolic {
    derive_symbolic(entry, &entry.cases[0], &[]).unwrap()
}

/// Values of the symbols for the joints of a chain, by the names of their variables.
fn parameters(chain: &Chain) -> BTreeMap<String, f64> {
    let (Geometry::Dh(joints) | Geometry::ModifiedDh(joints)) = &chain.geometry else { panic!("DH parameters") };
    let mut values = BTreeMap::new();
    for (n, joint) in (1..).zip(joints) {
        let (cos, sin) = joint.alpha.cos_sin_f64();
        values.insert(format!("ca{n}"), cos);
        values.insert(format!("sa{n}"), sin);
        values.insert(format!("a{n}"), joint.a.to_f64());
        values.insert(format!("d{n}"), joint.d.to_f64());
        if joint.kind == JointKind::Prismatic {
            let (cos, sin) = joint.theta0.cos_sin_f64();
            values.insert(format!("c{n}"), cos);
            values.insert(format!("s{n}"), sin);
        }
    }
    values
}

/// Value and the sum of the sizes of all terms.
fn value(polynomial: &Polynomial<Rational>, names: &[String], values: &BTreeMap<String, f64>) -> (f64, f64) {
    polynomial.terms().fold((0.0, 0.0), |(sum, size), (exponents, c)| {
        let powers = names.iter().zip(exponents).filter(|(_, e)| *e > 0);
        let term = powers.fold(c.to_f64(), |term, (name, e)| term * values[name].powi(i32::try_from(e).unwrap()));
        (sum + term, size + term.abs())
    })
}

/// Equations and polynomial vanish at every real solution, translations are the solution's, and the names stand for
/// what they name.
fn assert_true_at_solutions(path: &str) -> Symbolic {
    let entry = entry(path);
    let (derived, chain) = (symbolic(&entry), entry.chain().unwrap());
    let names = derived.names.list();
    let mut modes = 0;
    for mode in real(&solved(&entry)) {
        modes += 1;
        let q: Vec<f64> = mode.q.iter().map(|z| z.re).collect();
        let mut values = parameters(chain);
        values.extend(named(chain, &q));
        for (name, part) in &derived.parts {
            let (value, _) = value(part, names, &values);
            values.insert(name.clone(), value);
        }
        let displayed = derived.equations.iter().chain(derived.polynomial.iter().map(|p| &p.displayed));
        for one in displayed {
            for form in [&one.polynomial, &one.compact] {
                let (zero, size) = value(form, names, &values);
                assert!(zero.abs() < 1e-9 * size, "{path}, {}: {zero:e} of {size:e}", one.name);
            }
        }
        for translation in &derived.translations {
            let [above, below] = [&translation.numerator, &translation.denominator].map(|p| value(p, names, &values).0);
            let (found, expected) = (above / below, values[&names[translation.variable]]);
            assert!((found - expected).abs() < 1e-9 * (1.0 + expected.abs()), "{path}: {found} {expected}");
        }
        // Elsewhere the polynomial is the same in names as in symbols.
        if let Some(polynomial) = &derived.polynomial {
            values.insert(names[polynomial.variable].clone(), 0.37);
            let (expanded, size) = value(&polynomial.displayed.polynomial, names, &values);
            let (compact, _) = value(&polynomial.displayed.compact, names, &values);
            assert!((expanded - compact).abs() < 1e-9 * size && expanded.abs() > 1e-9 * size, "{path}");
        }
    }
    assert!(modes > 0, "{path}");
    derived
}

#[test]
fn an_rccc_loop_has_one_quadratic_and_three_translations() {
    let derived = assert_true_at_solutions("loop/cccr_4_angle.toml");
    assert_eq!((derived.equations.len(), derived.translations.len()), (3, 3));
    let polynomial = derived.polynomial.unwrap();
    assert_eq!((polynomial.displayed.polynomial.degree(polynomial.variable), derived.symbols.len()), (2, 10));
    assert_eq!(polynomial.displayed.polynomial.len(), 11);
    // Its other loops with three rotations have the polynomial without the translations.
    for path in ["loop/cccr_1_angle.toml", "loop/cpcrr_4_angle.toml", "loop/ppprrrr_4_angle.toml"] {
        assert!(assert_true_at_solutions(path).translations.is_empty(), "{path}");
    }
}

#[test]
fn an_rcrcr_loop_has_a_quartic() {
    let derived = assert_true_at_solutions("loop/crcrr_4_angle.toml");
    let polynomial = derived.polynomial.unwrap();
    let expanded = &polynomial.displayed.polynomial;
    assert_eq!((expanded.degree(polynomial.variable), expanded.len(), derived.parts.len()), (4, 4665, 6));
    assert_eq!(derived.equations.iter().map(|e| e.polynomial.len()).collect::<Vec<_>>(), [7, 25]);
}

#[test]
fn two_cylinders_side_by_side_have_an_octic() {
    let count = |path: &str| {
        let derived = assert_true_at_solutions(path);
        let polynomial = derived.polynomial.unwrap();
        let expanded = &polynomial.displayed.polynomial;
        assert_eq!(expanded.degree(polynomial.variable), 8, "{path}");
        (derived.equations.iter().map(|e| e.polynomial.len()).collect::<Vec<_>>(), expanded.len())
    };
    assert_eq!(count("loop/crcrr_2_angle.toml"), (vec![25, 82], 7088));
    assert_eq!(count("chain/ccrr.toml"), (vec![21, 66], 1769));
    // Without merged links the two equations are those of four joints.
    let mut entry = entry("loop/cccr_4_angle.toml");
    let value = InputValue::Distance(Number::exact(Rational::from((3, 2))));
    entry.cases = vec![Case::given(Input { joint: 1, value }, 1)];
    let derived = symbolic(&entry);
    assert_eq!(derived.equations.iter().map(|e| e.polynomial.len()).collect::<Vec<_>>(), [21, 66]);
    let found = derived.substituted(&entry, &entry.cases[0]).unwrap();
    assert!(found.solutions == 8 && found.values == 8 * found.equations && found.largest < 1e-10, "{found:?}");
}

/// Solutions are put into the equations that are shown: one wrong coefficient is an error.
#[test]
fn a_wrong_equation_is_found_by_its_solutions() {
    let loaded = entry("loop/crcrr_2_angle.toml");
    let case = &loaded.cases[0];
    let wrong = |polynomial: &Polynomial<Rational>| {
        let last = polynomial.len() - 1;
        Polynomial::from_terms(
            polynomial
                .terms()
                .enumerate()
                .map(|(k, (exponents, c))| (exponents, if k == last { Rational::from(c + 1) } else { c.clone() })),
        )
    };
    let right = symbolic(&loaded);
    assert!(right.substituted(&loaded, case).is_ok());
    let mut changed = right.clone();
    changed.equations[1].compact = wrong(&right.equations[1].compact);
    let message = changed.substituted(&loaded, case).unwrap_err().to_string();
    assert!(message.contains("dual part") && message.contains("does not vanish at solution 1"), "{message}");
    let mut changed = right.clone();
    changed.parts[0].1 = wrong(&right.parts[0].1);
    assert!(changed.substituted(&loaded, case).is_err());
    let numeric = derive(&loaded, case).unwrap();
    assert!(numeric.substituted(&loaded, case).is_ok());
    let mut changed = numeric.clone();
    changed.equations[0].algebraic = changed.equations[0].algebraic.as_ref().map(wrong);
    assert!(changed.substituted(&loaded, case).is_err());
    let mut changed = numeric;
    let polynomial = changed.polynomial.as_mut().unwrap();
    let mut coefficients = polynomial.coefficients.coefficients().to_vec();
    coefficients[0] = Integer::from(&coefficients[0] / 2);
    polynomial.coefficients = Univariate::new(coefficients);
    assert!(changed.substituted(&loaded, case).is_err());
    let platform = entry("platform/points_6_3.toml");
    let mut derivation = derive(&platform, &platform.cases[0]).unwrap();
    let found = derivation.substituted(&platform, &platform.cases[0]).unwrap();
    assert!(found.solutions == 16 && found.values > 0 && found.largest < 1e-10, "{found:?}");
    derivation.equations[0].polynomial = wrong(&derivation.equations[0].polynomial);
    assert!(derivation.substituted(&platform, &platform.cases[0]).is_err());
}

/// Environments, dollars and braces in pairs, and none of LaTeX's own signs outside of formulas.
#[test]
fn a_latex_document_is_well_formed() {
    for arguments in [
        &["derive", "crcrr_2_angle", "--symbolic", "--explain=latex"][..],
        &["derive", "cccr_4_angle", "--symbolic", "--explain=latex"],
        &["derive", "prrprrr_6_angle", "--explain=latex"],
        &["derive", "rrsrr", "--explain=latex"],
        &["derive", "planar_both", "--explain=latex"],
    ] {
        let (code, text, err) = run(arguments);
        assert_eq!((code, err.as_str()), (0, ""), "{arguments:?}");
        let (mut open, flat): (Vec<&str>, String) = (Vec::new(), text.replace("\\\\", ""));
        for part in flat.split('\\') {
            if let Some(rest) = part.strip_prefix("begin{") {
                open.push(rest.split('}').next().unwrap());
            } else if let Some(rest) = part.strip_prefix("end{") {
                assert_eq!(open.pop(), rest.split('}').next(), "{arguments:?}");
            }
        }
        assert!(open.is_empty() && text.ends_with("\\end{document}\n"), "{arguments:?}");
        let mut is_display = false;
        for line in text.lines() {
            is_display |= line.starts_with("\\begin{align*}");
            if !is_display {
                let plain: String = line.replace("\\_", "").split('$').step_by(2).collect();
                assert!(line.matches('$').count() % 2 == 0 && !plain.contains(['_', '^', '&', '#']), "{line}");
            }
            is_display &= !line.starts_with("\\end{align*}");
            let braces = |c: char| line.replace("\\{", "").replace("\\}", "").matches(c).count();
            assert_eq!(braces('{'), braces('}'), "{line}");
        }
        assert!(text.contains("Checked: "), "{arguments:?}");
    }
}

#[test]
fn every_language_takes_a_derivation_with_symbols() {
    for (name, _) in Format::NAMED {
        for entry in ["rssr", "cccr_4_angle", "bennett_a", "crcrr_2_angle"] {
            let (code, out, err) = run(&["derive", entry, "--symbolic", "--format", name]);
            assert!(code == 0 && err.is_empty() && out.len() > 100, "{entry} --format {name}: {err}");
        }
    }
}

#[test]
fn loops_with_balls_have_a_quadratic_or_a_quartic() {
    for (path, degree) in [("loop/rssr.toml", 2), ("loop/rscr.toml", 4), ("loop/rsrc.toml", 4), ("loop/rrsrr.toml", 4)]
    {
        let polynomial = assert_true_at_solutions(path).polynomial.unwrap();
        assert_eq!(polynomial.displayed.polynomial.degree(polynomial.variable), degree, "{path}");
    }
}

/// A loop of four revolutes: half-angle tangents of the twists, lengths and offsets.
fn four_revolutes(twists: [(i32, i32); 4], lengths: [i32; 4], offsets: [i32; 4]) -> Entry {
    let number = |n: i32| Number::exact(Rational::from(n));
    let joint = |k: usize| Joint {
        kind: JointKind::Revolute,
        a: number(lengths[k]),
        alpha: Angle::from_half_tangent(HalfTangent::Finite(Rational::from(twists[k]))),
        d: number(offsets[k]),
        theta0: Angle::zero(),
        pitch: None,
    };
    let mut entry = entry("loop/cccr_4_angle.toml");
    let chain = Chain { geometry: Geometry::Dh((0..4).map(joint).collect()), ..entry.chain().unwrap().clone() };
    entry.design = Design::Loop(chain);
    entry
}

#[test]
fn bennett_s_loop_is_a_pair_of_equations() {
    let general = symbolic(&four_revolutes([(1, 2), (1, 3), (2, 5), (3, 4)], [4, 3, 2, 1], [1, 2, 3, 4]));
    let [f, g] = general.equations.as_slice() else { panic!("two equations") };
    // A x^2 y^2 + B x^2 + C y^2 + D x y + E, and the dual part with all nine monomials.
    assert_eq!((f.compact.len(), g.compact.len()), (5, 9));
    let polynomial = general.polynomial.unwrap();
    assert_eq!(polynomial.displayed.polynomial.degree(polynomial.variable), 8);
    // At the conditions a1 = a3, a2 = a4, a1/sin alpha1 = a2/sin alpha2, d = 0 both have a factor in common: x y = 5.
    let bennett = four_revolutes([(1, 2), (1, 3), (1, 2), (1, 3)], [4, 3, 4, 3], [0; 4]);
    let derived = symbolic(&bennett);
    let names = derived.names.list();
    let values = parameters(bennett.chain().unwrap());
    for x in [0.3, -1.7, 2.9] {
        let mut values = values.clone();
        values.insert("t4".to_owned(), x);
        for y in [5.0 / x, 1.0 + 5.0 / x] {
            values.insert("t1".to_owned(), y);
            let at = derived.equations.iter().map(|equation| value(&equation.polynomial, names, &values));
            let zero = at.map(|(sum, size)| sum.abs() < 1e-12 * size).collect::<Vec<_>>();
            assert!(if (x * y - 5.0).abs() < 1e-9 { zero == [true, true] } else { zero.contains(&false) }, "{x} {y}");
        }
        let (sum, size) = value(&derived.polynomial.as_ref().unwrap().displayed.polynomial, names, &values);
        assert!(sum.abs() < 1e-9 * size, "the eliminant vanishes for every input: {sum:e} of {size:e}");
    }
    // Without lengths only the spherical four-bar is left.
    let spherical = symbolic(&four_revolutes([(1, 2), (1, 3), (2, 5), (3, 4)], [0; 4], [0; 4]));
    let polynomial = spherical.polynomial.unwrap();
    // The degree is 2 in the angle behind the input's.
    assert_eq!(spherical.names.list()[polynomial.variable], "t1");
    assert_eq!(polynomial.displayed.polynomial.degree(polynomial.variable), 2);
    assert_eq!(spherical.equations.iter().map(|e| e.polynomial.len()).collect::<Vec<_>>(), [21]);
}

/// The equations from a motion of the middle joints to both sides against those of the principle of transference alone.
#[test]
fn two_ways_to_the_pair_agree() {
    let entry = four_revolutes([(1, 2), (1, 3), (2, 5), (3, 4)], [4, 3, 2, 1], [1, 2, 3, 4]);
    let (derived, chain) = (symbolic(&entry), entry.chain().unwrap());
    let values = parameters(chain);
    let twists = [1, 2, 3, 4].map(|k| (values[&format!("ca{k}")], values[&format!("sa{k}")]));
    let lengths = [1, 2, 3, 4].map(|k| values[&format!("a{k}")]);
    let mut ratios = [Vec::new(), Vec::new()];
    for (x, y) in [(0.3, 0.7), (-1.7, 0.2), (2.9, -1.1), (0.1, -5.0)] {
        let angle = |t: f64| ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
        let (first_offset, fourth_offset) = (values["d1"], values["d4"]);
        let (first, fourth) = (angle(y), angle(x));
        let pair = SpatialFourBar { twists, lengths, first, first_offset, fourth, fourth_offset }.pair();
        let mut values = values.clone();
        values.extend([("t4".to_owned(), x), ("t1".to_owned(), y)]);
        for ((ratios, equation), expected) in ratios.iter_mut().zip(&derived.equations).zip([pair.f, pair.g]) {
            let (found, _) = value(&equation.polynomial, derived.names.list(), &values);
            ratios.push(found / ((1.0 + x * x) * (1.0 + y * y)) / expected);
        }
    }
    for ratios in ratios {
        assert!(ratios.iter().all(|ratio| (ratio / ratios[0] - 1.0).abs() < 1e-10), "{ratios:?}");
    }
}

#[test]
fn symbols_can_be_chosen_and_refused() {
    let verdict = |arguments: &[&str]| run(&[&["derive", "-q"], arguments].concat());
    let (code, out, err) = verdict(&["cccr_4_angle", "--symbolic=a1,alpha2"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.starts_with("degree 2 in t3, 7 terms in 2 symbols"), "{out}");
    let (code, _, err) = verdict(&["cccr_4_angle", "--symbolic=a9"]);
    assert!(code == 1 && err.contains("a9") && err.contains("alpha1"), "{err}");
    let (code, out, err) = verdict(&["prrprrr_6_angle", "--symbolic"]);
    assert!(code == 4 && out.is_empty() && err.contains("10^12 terms"), "{err}");
    let (code, _, err) = verdict(&["hexapod", "--symbolic"]);
    assert!(code == 4 && err.contains("platforms"), "{err}");
    let (code, out, _) = run(&["derive", "rssr", "--symbolic", "--format", "singular"]);
    assert!(code == 0 && out.contains("poly f1 = ") && out.contains("t4^2"), "{out}");
}

/// Substitutes the numbers of the file for the symbols and returns a primitive polynomial in the unknown.
fn at_the_numbers(derived: &Symbolic) -> Univariate<Integer> {
    let values: Vec<(usize, Polynomial<Rational>)> =
        derived.values.iter().map(|(variable, value)| (*variable, Polynomial::constant(value.clone()))).collect();
    let polynomial = derived.polynomial.as_ref().unwrap();
    let at = polynomial.displayed.polynomial.substitute_all(&values);
    let coefficients: Vec<Rational> = at
        .coefficients_in(polynomial.variable)
        .iter()
        .map(|c| c.terms().next().map_or(Rational::new(), |(_, c)| c.clone()))
        .collect();
    Univariate::new(Univariate::new(coefficients).primitive_integers())
}

/// The numbers of the file are none of the values between which the polynomial was interpolated.
#[test]
fn interpolated_polynomials_are_those_of_the_numbers() {
    for (path, symbols, degrees) in [
        ("loop/c5r_angle.toml", &["a2"][..], [16, 8]),
        ("arm/puma560.toml", &["z"], [8, 8]),
        ("arm/puma560.toml", &["turn_z"], [8, 8]),
    ] {
        let entry = entry(path);
        let symbols: Vec<String> = symbols.iter().map(|&name| name.to_owned()).collect();
        let derived = derive_with_symbols(&entry, &entry.cases[0], &symbols, &Watch::none()).unwrap();
        let expected = derive(&entry, &entry.cases[0]).unwrap().polynomial.unwrap().coefficients;
        let found = at_the_numbers(&derived);
        assert!(found == expected || found == expected.scale(&Integer::from(-1)), "{path}");
        let polynomial = derived.polynomial.as_ref().unwrap();
        assert_eq!(polynomial.displayed.polynomial.degree(polynomial.variable), degrees[0], "{path}");
        assert_eq!(polynomial.displayed.polynomial.degree(derived.values[0].0), degrees[1], "{path}");
        let found = derived.substituted(&entry, &entry.cases[0]).unwrap();
        assert!(found.solutions > 0 && found.largest < 1e-8, "{path}: {found:?}");
    }
}

/// A turn of the tool is one about its own axis: the polynomial at a value of the turn is that of the pose turned so.
#[test]
fn a_turn_of_the_tool_is_about_its_own_axis() {
    let entry = entry("chain/arm_3r3p.toml");
    for (axis, name) in ["turn_x", "turn_y", "turn_z"].into_iter().enumerate() {
        let mut derived = derive_with_symbols(&entry, &entry.cases[0], &[name.to_owned()], &Watch::none()).unwrap();
        // The half-angle tangent 1/2 has the cosine 3/5 and the sine 4/5.
        derived.values[0].1 = Rational::from((1, 2));
        let found = at_the_numbers(&derived);
        let (cos, sin) = (Rational::from((3, 5)), Rational::from((4, 5)));
        let mut case = entry.cases[0].clone();
        let pose = case.pose.as_ref().unwrap().exact.motion();
        let mut turned = pose.clone();
        let [one, two] = [(axis + 1) % 3, (axis + 2) % 3];
        for row in 0..3 {
            let [x, y] = [one, two].map(|k| pose.rotation[row][k].clone());
            turned.rotation[row][one] = Rational::from(&x * &cos) + Rational::from(&y * &sin);
            turned.rotation[row][two] = y * &cos - x * &sin;
        }
        case.pose = Some(Placement::from_motion_exact(turned));
        let expected = derive(&entry, &case).unwrap().polynomial.unwrap().coefficients;
        assert!(found == expected || found == expected.scale(&Integer::from(-1)), "{name}");
    }
}

#[test]
fn interpolation_says_what_it_cannot_do() {
    for (arguments, code, word) in [
        (["derive", "general_7r", "--symbolic=a9"], 1, "found the symbol a9, expected some of alpha1"),
        (["derive", "general_7r", "--symbolic=a1,a2,a3,a4"], 4, "found 4 symbols, expected one to 3"),
        (["derive", "arm/puma560", "--symbolic=x,x"], 1, "found the symbol x twice"),
        (["derive", "platform/points_6_3", "--symbolic=a1"], 1, "expected some of leg1, leg2"),
    ] {
        let (found, _, err) = run(&arguments);
        assert!(found == code && err.contains(word), "{arguments:?}: {found} {err}");
    }
}
