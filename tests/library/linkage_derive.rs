//! Derivations of linkages: closure polynomials, input and output, coupler curves.
#![allow(clippy::unwrap_used)]

use looproot::internal::catalogue::{Any, Format, LinkageFile, Options, any_from_text, builtin_any};
use looproot::internal::derivation::{
    Curve, CurveSymbolic, LinkageDerivation, Watch, derive_linkage, derive_linkage_with_symbols, in_cosines, trace,
    trace_mass, trace_with_symbols,
};
use looproot::internal::error::Error;
use looproot::internal::kinematics::linkage::Accuracy;
use looproot::internal::linkage::answer::solve;
use looproot_algebra::int::Int;
use looproot_algebra::polynomial::Polynomial;
use looproot_algebra::ring::Ring;
use rug::{Integer, Rational};

/// Every point name that several bodies have is a joint.
const SHARED: &str = r#"joints = "shared points""#;

fn read(joints: &str, bodies: &str, rest: &str) -> Box<LinkageFile> {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\n{joints}\n[mechanism.bodies]\n{bodies}\n{rest}"
    );
    match any_from_text(&text, "test.toml", Format::Toml, &Options::default()).unwrap() {
        Any::Linkage(file) => file,
        _ => panic!("a linkage"),
    }
}

fn curve(file: &LinkageFile, of: &str) -> Result<Curve, Error> {
    let (body, point) = of.split_once('.').unwrap();
    let body = file.linkage.bodies.iter().position(|own| own.name == body).unwrap();
    let place = file.linkage.bodies[body].point(point).unwrap().clone();
    trace(&file.linkage, &file.cases[0].given, body, &place, &Watch::none())
}

fn derived(file: &LinkageFile) -> LinkageDerivation {
    derive_linkage(&file.linkage, &file.cases[0].given).unwrap()
}

fn with_terms(terms: &[(u32, u32, i64)]) -> Polynomial<Int> {
    Polynomial::from_terms(terms.iter().map(|(i, j, c)| (vec![*i, *j], Int::from(*c))))
}

/// The value at a place in f64, relative to the sum of the absolute values of the terms.
fn relative(polynomial: &Polynomial<Int>, x: f64, y: f64) -> f64 {
    let terms = polynomial.terms().map(|(exponents, c)| {
        let exponent = |k: usize| i32::try_from(exponents.get(k).copied().unwrap_or(0)).unwrap();
        c.to_integer().to_f64() * x.powi(exponent(0)) * y.powi(exponent(1))
    });
    let (sum, size) = terms.fold((0.0, 0.0), |(sum, size), term: f64| (sum + term, size + term.abs()));
    sum / size
}

/// The sextic of the four-bar, interpolated modulo eight primes by another program.
const SEXTIC: [(u32, u32, i64); 25] = [
    (6, 0, 25),
    (5, 0, -420),
    (4, 2, 75),
    (4, 1, -180),
    (4, 0, 2068),
    (3, 2, -840),
    (3, 1, 2160),
    (3, 0, -984),
    (2, 4, 75),
    (2, 3, -360),
    (2, 2, 2696),
    (2, 1, -5400),
    (2, 0, -10796),
    (1, 4, -420),
    (1, 3, 2160),
    (1, 2, -984),
    (1, 1, -4320),
    (1, 0, 2016),
    (0, 6, 25),
    (0, 5, -180),
    (0, 4, 628),
    (0, 3, -5400),
    (0, 2, 22036),
    (0, 1, -27360),
    (0, 0, 10368),
];

#[test]
fn three_cognates_trace_one_sextic() {
    let four_bars = [
        r#"frame = { A = ["0", "0"], D = ["6", "0"] }
crank = { A = ["0", "0"], B = ["3", "0"] }
coupler = { B = ["0", "0"], C = ["5", "0"], P = ["2", "3"] }
rocker = { D = ["0", "0"], C = ["4", "0"] }"#,
        r#"frame = { A = ["0", "0"], D = ["12/5", "18/5"] }
crank = { A = ["0", "0"], B = ["2", "3"] }
coupler = { B = ["0", "0"], C = ["6/5", "9/5"], P = ["3", "0"] }
rocker = { D = ["0", "0"], C = ["8/5", "12/5"] }"#,
        r#"frame = { A = ["6", "0"], D = ["12/5", "18/5"] }
crank = { A = ["0", "0"], B = ["3", "-3"] }
coupler = { B = ["0", "0"], C = ["12/5", "-12/5"], P = ["4", "0"] }
rocker = { D = ["0", "0"], C = ["9/5", "-9/5"] }"#,
    ];
    for bodies in four_bars {
        let found = curve(&read(SHARED, bodies, ""), "coupler.P").unwrap();
        assert_eq!(found.polynomial, with_terms(&SEXTIC), "{bodies}");
        assert_eq!((found.degree(), found.rows), (6, 6));
    }
}

#[test]
fn the_point_of_a_slider_crank_lies_on_its_quartic() {
    let joints = r#"joints = [
    { name = "A", type = "R", of = ["frame", "crank"] },
    { name = "B", type = "R", of = ["crank", "rod"] },
    { name = "C", type = "R", of = ["rod", "piston"] },
    { name = "S", type = "P", of = ["frame", "piston"], along = [1, 0] },
]"#;
    let bodies = r"frame = { A = 0, S = [0, 1] }
crank = { A = 0, B = 2 }
rod = { B = 0, C = 5, P = [2, 3] }
piston = { C = 0, S = 0 }";
    let file = read(joints, bodies, "");
    let found = curve(&file, "rod.P").unwrap();
    assert_eq!(found.degree(), 4);
    for k in 0..40 {
        // The rod meets the line y = 1 in C: 2 sin a + 5 sin b = 1.
        let a = 0.157 * f64::from(k);
        let sin = (1.0 - 2.0 * a.sin()) / 5.0;
        for cos in [(1.0 - sin * sin).sqrt(), -(1.0 - sin * sin).sqrt()] {
            let x = 2.0 * a.cos() + 2.0 * cos - 3.0 * sin;
            let y = 2.0 * a.sin() + 2.0 * sin + 3.0 * cos;
            assert!(relative(&found.polynomial, x, y).abs() < 1e-13, "{a}");
            assert!(relative(&found.polynomial, x + 0.1, y).abs() > 1e-8, "{a}");
        }
    }
    // The crank's end runs on a circle, the piston on a line.
    let circle = curve(&file, "crank.B").unwrap();
    assert_eq!(circle.polynomial, with_terms(&[(2, 0, 1), (0, 2, 1), (0, 0, -4)]));
    assert_eq!(curve(&file, "piston.C").unwrap().polynomial, with_terms(&[(0, 1, 1), (0, 0, -1)]));
}

/// Orders of the curves of six-bars: the numbers of positions on a random line, by Groebner bases modulo 32009 in another
/// program. The last one is a coupler curve of its second four-bar, every point of which is reached twice.
#[test]
fn six_bars_trace_curves_of_the_counted_orders() {
    let six_bars = [
        (
            "m.T",
            14,
            r#"frame = { A = ["-11", "-21"], D = ["-20", "35"] }
c = { A = ["-303/13", "-592/13"], B = ["291/13", "-417/13"], E = ["-496/13", "-244/13"] }
k = { B = ["73/5", "211/5"], C = ["-64/5", "-148/5"], H = ["-32/5", "301/5"] }
r = { C = ["-2843/37", "1333/37"], D = ["-270/37", "1472/37"] }
m = { E = ["-925/29", "-1762/29"], F = ["-887/29", "-1886/29"], T = ["17", "-31"] }
n = { F = ["-689/25", "-1023/25"], H = ["-1298/25", "639/25"] }"#,
        ),
        (
            "n.T",
            16,
            r#"frame = { A = ["-11", "-21"], D = ["-20", "35"] }
c = { A = ["-303/13", "-592/13"], B = ["291/13", "-417/13"], E = ["-496/13", "-244/13"] }
k = { B = ["73/5", "211/5"], C = ["-64/5", "-148/5"], H = ["-32/5", "301/5"] }
r = { C = ["-2843/37", "1333/37"], D = ["-270/37", "1472/37"] }
m = { E = ["-925/29", "-1762/29"], F = ["-887/29", "-1886/29"] }
n = { F = ["-689/25", "-1023/25"], H = ["-1298/25", "639/25"], T = ["17", "-31"] }"#,
        ),
        (
            "m.T",
            16,
            r#"frame = { A = ["-11", "-21"], D = ["-20", "35"] }
c = { A = ["-303/13", "-592/13"], B = ["291/13", "-417/13"], E = ["-496/13", "-244/13"] }
k = { B = ["73/5", "211/5"], C = ["-64/5", "-148/5"] }
r = { C = ["-2843/37", "1333/37"], D = ["-270/37", "1472/37"], H = ["245/37", "84/37"] }
m = { E = ["-925/29", "-1762/29"], F = ["-887/29", "-1886/29"], T = ["17", "-31"] }
n = { F = ["-689/25", "-1023/25"], H = ["-1298/25", "639/25"] }"#,
        ),
        (
            "e.T",
            16,
            r#"frame = { A = ["-11", "-21"], D = ["26", "9"] }
c = { A = ["-303/13", "-592/13"], B = ["-694/13", "-584/13"] }
d = { D = ["73/5", "211/5"], E = ["-138/5", "-16/5"], H = ["-32/5", "301/5"] }
k = { B = ["-2843/37", "1333/37"], C = ["-270/37", "1472/37"], F = ["-1909/37", "1575/37"] }
e = { C = ["-1350/29", "-685/29"], E = ["-925/29", "-1762/29"], T = ["17", "-31"] }
m = { F = ["-689/25", "-1023/25"], H = ["-1298/25", "639/25"] }"#,
        ),
        (
            "m.T",
            6,
            r#"frame = { A = ["-11", "-21"], D = ["-20", "35"], H = ["20", "36"] }
c = { A = ["-303/13", "-592/13"], B = ["291/13", "-417/13"] }
k = { B = ["73/5", "211/5"], C = ["-64/5", "-148/5"] }
r = { C = ["-2843/37", "1333/37"], D = ["-270/37", "1472/37"], E = ["-1745/37", "1553/37"] }
m = { E = ["-925/29", "-1762/29"], F = ["-887/29", "-1886/29"], T = ["17", "-31"] }
n = { F = ["-689/25", "-1023/25"], H = ["-1298/25", "639/25"] }"#,
        ),
    ];
    for (point, order, bodies) in six_bars {
        let found = curve(&read(SHARED, bodies, ""), point).unwrap();
        assert_eq!(found.degree(), order, "{point}");
        assert!(found.removed.iter().all(|(factor, _)| factor.total_degree() == Some(2)));
    }
}

/// Freudenstein's equation of a crank a, coupler b, rocker c and frame d, in half-angle tangents s and t:
/// `a^2 - b^2 + c^2 + d^2 + 2 c d cos(out) - 2 a d cos(in) - 2 a c cos(in - out) = 0`.
fn freudenstein([a, b, c, d]: [i64; 4]) -> Polynomial<Int> {
    let [s, t] = [0, 1].map(Polynomial::<Int>::variable);
    let number = |n: i64| Polynomial::constant(Int::from(n));
    let one = number(1);
    let (ss, tt) = (s.mul(&s), t.mul(&t));
    let (plus_s, minus_s) = (one.add(&ss), one.sub(&ss));
    let (plus_t, minus_t) = (one.add(&tt), one.sub(&tt));
    let constant = number(a * a - b * b + c * c + d * d).mul(&plus_s).mul(&plus_t);
    let out = number(2 * c * d).mul(&minus_t).mul(&plus_s);
    let input = number(2 * a * d).mul(&minus_s).mul(&plus_t);
    let both = number(2 * a * c).mul(&minus_s.mul(&minus_t).add(&number(4).mul(&s).mul(&t)));
    constant.add(&out).sub(&input).sub(&both).primitive_part()
}

#[test]
fn input_and_output_of_a_four_bar_obey_freudensteins_equation() {
    for [a, b, c, d] in [[2, 5, 4, 6], [3, 5, 4, 6], [1, 1, 3, 2], [7, 3, 8, 9]] {
        let bodies = format!(
            "frame = {{ A = 0, D = {d} }}\ncrank = {{ A = 0, B = {a} }}\n\
             coupler = {{ B = 0, C = {b} }}\nrocker = {{ D = 0, C = {c} }}"
        );
        let file = read(SHARED, &bodies, "[[input]]\njoint = \"A\"\ntan_half = \"1/3\"");
        let found = derived(&file);
        let both = found.input_output.unwrap();
        let name = |body: usize| file.linkage.bodies[body].name.as_str();
        assert_eq!((name(both.body), name(both.against)), ("rocker", "frame"));
        assert_eq!(both.polynomial, freudenstein([a, b, c, d]), "{a} {b} {c} {d}");
        assert!(
            both.agrees && found.polynomials.iter().all(looproot::internal::derivation::GroupPolynomial::is_proved)
        );
    }
}

#[test]
fn freudensteins_equation_has_the_lengths_as_symbols() {
    let bodies = "frame = { A = 0, D = 4 }\ncrank = { A = 0, B = 1 }\n\
                  coupler = { B = 0, C = 8 }\nrocker = { D = 0, C = 3 }";
    let file = read(SHARED, bodies, "[[input]]\njoint = \"A\"\ntan_half = \"1/3\"");
    let found = derive_linkage_with_symbols(&file.linkage, &file.cases[0].given, &[], &Watch::none()).unwrap();
    let names: Vec<String> = found.symbols.iter().map(|one| one.name(&file.linkage)).collect();
    assert_eq!(names, ["frame.D.x", "crank.B.x", "coupler.C.x", "rocker.C.x"]);
    // d^2 + a^2 + c^2 - b^2 + 2 d c cos(out) - 2 d a cos(in) - 2 a c cos(in - out) = 0
    let [ci, si, co, so, d, a, b, c] = [0, 1, 2, 3, 4, 5, 6, 7].map(Polynomial::<Int>::variable);
    let twice = |p: Polynomial<Int>| p.add(&p);
    let cosine = ci.mul(&co).add(&si.mul(&so));
    let constant = d.mul(&d).add(&a.mul(&a)).add(&c.mul(&c)).sub(&b.mul(&b));
    let expected = constant
        .add(&twice(d.mul(&c).mul(&co)))
        .sub(&twice(d.mul(&a).mul(&ci)))
        .sub(&twice(a.mul(&c).mul(&cosine)))
        .primitive_part();
    let own = in_cosines(&found.polynomial, true).unwrap();
    assert!(own == expected || own == expected.neg(), "{own:?}");
    assert!(found.agrees && found.compared.is_none());
}

/// Bodies and joints in either order, points beside the axes, the input at either end, and the angle of the coupler as output: what is derived with
/// symbols is what is derived with numbers.
#[test]
fn four_bars_in_any_position_have_symbols() {
    let joint = |name: &str, of: [&str; 2]| {
        format!("{{ name = \"{name}\", type = \"R\", of = [\"{}\", \"{}\"] }}", of[0], of[1])
    };
    let bodies = "frame = { A = [1, -2], D = [7, 3] }\ncrank = { A = [1, 0], B = [2, 3] }\n\
                  coupler = { B = [-1, 2], C = [6, 4] }\nrocker = { D = [0, 2], C = [4, 5] }";
    for is_turned in [false, true] {
        let of = |a: &'static str, b: &'static str| if is_turned { [b, a] } else { [a, b] };
        let joints = [
            joint("A", of("frame", "crank")),
            joint("B", of("crank", "coupler")),
            joint("C", of("coupler", "rocker")),
            joint("D", of("rocker", "frame")),
        ];
        let joints = format!("joints = [{}]", joints.join(", "));
        for input in ["A", "D"] {
            let file = read(&joints, bodies, &format!("[[input]]\njoint = \"{input}\"\ntan_half = \"1/3\""));
            let wanted = ["frame.D.x", "crank.B.y", "coupler.C.x"].map(str::to_owned);
            let found =
                derive_linkage_with_symbols(&file.linkage, &file.cases[0].given, &wanted, &Watch::none()).unwrap();
            assert!(found.agrees, "{input} {is_turned}");
            assert_eq!(found.compared, None, "{input} {is_turned}");
        }
    }
}

#[test]
fn a_slider_crank_has_its_offset_as_a_symbol() {
    let joints = "joints = [\n{ name = \"A\", type = \"R\", of = [\"frame\", \"crank\"] },\n\
                  { name = \"B\", type = \"R\", of = [\"crank\", \"rod\"] },\n\
                  { name = \"C\", type = \"PR\", of = [\"frame\", \"rod\"], along = [1, 0] },\n]";
    let bodies = "frame = { A = 0, C = [0, 1] }\ncrank = { A = 0, B = 2 }\nrod = { B = 0, C = 5 }";
    let file = read(joints, bodies, "[[input]]\njoint = \"A\"\ntan_half = \"1/3\"");
    let wanted = ["frame.C.y".to_owned(), "rod.C.x".to_owned()];
    let found = derive_linkage_with_symbols(&file.linkage, &file.cases[0].given, &wanted, &Watch::none()).unwrap();
    // The height of C: 2 sin(in) + rod sin(out) = offset, in half-angle tangents t of the crank and u of the rod.
    let [t, u, offset, rod] = [0, 1, 2, 3].map(Polynomial::<Int>::variable);
    let one = Polynomial::<Int>::one();
    let (plus_t, plus_u) = (one.add(&t.mul(&t)), one.add(&u.mul(&u)));
    let four = Polynomial::constant(Int::from(4));
    let two = Polynomial::constant(Int::from(2));
    let heights = four.mul(&t).mul(&plus_u).add(&two.mul(&rod).mul(&u).mul(&plus_t));
    let expected = heights.sub(&offset.mul(&plus_t).mul(&plus_u)).primitive_part();
    assert!(found.polynomial == expected || found.polynomial == expected.neg(), "{:?}", found.polynomial);
    assert!(found.agrees);
}

#[test]
fn legs_of_given_lengths_are_inputs_beside_symbols() {
    let Any::Linkage(file) = builtin_any("linkage/3rpr", &Options::default()).unwrap() else { panic!("a linkage") };
    let names = |names: &[&str]| -> Vec<String> { names.iter().map(|&name| name.to_owned()).collect() };
    let given = &file.cases[0].given;
    let best = derived(&file).polynomials.swap_remove(0);
    for (wanted, input) in
        [(vec!["L1"], "L1"), (vec!["L3"], "L3"), (vec!["plate.B1.x"], "L1"), (vec!["L2", "plate.B1.x"], "L2")]
    {
        let found = derive_linkage_with_symbols(&file.linkage, given, &names(&wanted), &Watch::none()).unwrap();
        assert_eq!(file.linkage.joints[found.input].name, input);
        // At the numbers of the file it is the closure polynomial.
        assert!(found.agrees && !found.is_turn, "{wanted:?}");
        assert_eq!(found.polynomial.degree(1) as usize, best.coefficients.degree().unwrap(), "{wanted:?}");
    }
    let two = derive_linkage_with_symbols(&file.linkage, given, &names(&["L1", "L2"]), &Watch::none()).unwrap_err();
    assert!(two.to_string().contains("found the given joints L1 and L2"), "{two}");
}

#[test]
fn unknown_symbols_and_too_many_are_refused() {
    let bodies = "frame = { A = [1, 2], D = [4, 5] }\ncrank = { A = [3, 1], B = [1, 2] }\n\
                  coupler = { B = 0, C = 8 }\nrocker = { D = 0, C = 3 }";
    let file = read(SHARED, bodies, "[[input]]\njoint = \"A\"\ntan_half = \"1/3\"");
    let derive = |wanted: &[&str]| {
        let wanted: Vec<String> = wanted.iter().map(|name| (*name).to_owned()).collect();
        let found = derive_linkage_with_symbols(&file.linkage, &file.cases[0].given, &wanted, &Watch::none());
        found.unwrap_err().to_string()
    };
    assert!(derive(&["crank.E.x"]).contains("found the symbol crank.E.x, expected some of frame.A.x"));
    assert!(derive(&["crank.B.x", "crank.B.x"]).contains("twice"));
    assert!(derive(&[]).contains("found 10 symbols, expected one to 6"));
}

/// The five-link loop of Stephenson's third six-bar: the polynomial of another program, by the pencil of subsets modulo
/// primes.
#[test]
fn the_closure_polynomial_of_a_triad_is_the_known_one() {
    let bodies = r#"frame = { A = [-2, -5], D = [-4, 9], H = [6, 3] }
c = { A = ["-77/13", "-151/13"], B = ["71/13", "-100/13"] }
k = { B = ["18/5", "51/5"], C = ["-16/5", "-37/5"], E = ["-33/5", "-6/5"] }
r = { C = ["-705/37", "345/37"], D = ["-85/37", "362/37"] }
m = { E = ["-216/29", "-446/29"], F = ["-217/29", "-487/29"] }
n = { F = ["-36/5", "-52/5"], H = ["-171/25", "128/25"] }"#;
    let file = read(SHARED, bodies, "[[input]]\njoint = \"H\"\ntan_half = \"-3/4\"");
    let found = derived(&file);
    let of_r = found.polynomials.iter().find(|one| file.linkage.bodies[one.body].name == "r").unwrap();
    let known = [
        "12127377460605",
        "-122320295075732",
        "484580062897199",
        "-963390853896064",
        "1017469482914483",
        "-545846862180332",
        "118481532617889",
    ];
    assert_eq!(of_r.coefficients.coefficients(), known.map(|digits| digits.parse::<Integer>().unwrap()));
    assert!(of_r.is_proved());
}

#[test]
fn an_inverted_slider_crank_and_a_trammel_have_quadratics() {
    for name in ["linkage/inverted_slider_crank", "linkage/crank_slider", "linkage/oblique_trammel"] {
        let Any::Linkage(file) = builtin_any(name, &Options::default()).unwrap() else { panic!("a linkage") };
        let found = derived(&file);
        assert!(found.polynomials.iter().all(|one| one.is_proved() && one.roots() <= 2), "{name}");
        assert!(!found.polynomials.is_empty() && found.warnings.is_empty(), "{name}");
    }
}

#[test]
fn points_that_have_no_curve_are_refused() {
    let rigid = read(
        SHARED,
        r"frame = { A = 0, D = 6 }
crank = { A = 0, B = 3 }
coupler = { B = 0, D = 5, P = 2 }",
        "",
    );
    let error = curve(&rigid, "coupler.P").unwrap_err().to_string();
    assert!(error.contains("rigid"), "{error}");
    let five = r"frame = { A = 0, E = 6 }
one = { A = 0, B = 3 }
two = { B = 0, C = 4, P = [1, 1] }
three = { C = 0, D = 4 }
four = { D = 0, E = 3 }";
    let error = curve(&read(SHARED, five, ""), "two.P").unwrap_err().to_string();
    assert!(error.contains("2 freedoms"), "{error}");
    let given = read(SHARED, five, "[[input]]\ngiven = { A = { tan_half = 1 }, E = { tan_half = \"1/2\" } }");
    assert_eq!(curve(&given, "two.P").unwrap().degree(), 6);
}

#[test]
fn the_curve_of_a_centre_of_mass_holds_its_places() {
    let Any::Linkage(file) = builtin_any("linkage/weighted_four_bar", &Options::default()).unwrap() else {
        panic!("a linkage")
    };
    let exact = file.masses.bodies.iter().enumerate();
    let masses: Vec<_> = exact
        .filter_map(|(body, mass)| {
            let (weight, centre) = mass.as_ref()?.exact.clone()?;
            Some((body, centre, weight))
        })
        .collect();
    assert_eq!(masses.len(), 3);
    let found = trace_mass(&file.linkage, &file.cases[0].given, &masses, &Watch::none()).unwrap();
    assert_eq!(found.degree(), 6);
    let polynomial = found.polynomial.map(|c| Some(c.to_f64())).unwrap();
    let size = polynomial.coefficients().iter().fold(0.0_f64, |most, c| most.max(c.abs()));
    for input in ["A=10 deg", "A=75 deg", "A=-100 deg"] {
        let case = file.case_with(input).unwrap();
        let answer = solve(&file.linkage, &case.given, Accuracy::Rounded).unwrap();
        for mode in answer.modes.iter().filter(|mode| mode.real) {
            let mut centre = [0.0; 2];
            let mut total = 0.0;
            for (body, place, weight) in &masses {
                let (angle, origin) = &mode.bodies[*body];
                let (sin, cos) = angle.re.sin_cos();
                let (x, y, weight) = (place.re.to_f64(), place.im.to_f64(), weight.to_f64());
                centre[0] += weight * (origin[0].re + cos * x - sin * y);
                centre[1] += weight * (origin[1].re + sin * x + cos * y);
                total += weight;
            }
            let value = polynomial.evaluate(&centre.map(|c| c / total));
            assert!(value.abs() < 1e-9 * size, "{input}: {value}");
        }
    }
}

fn with_symbols(file: &LinkageFile, of: &str, names: &[&str]) -> Result<CurveSymbolic, Error> {
    let (body, point) = of.split_once('.').unwrap();
    let body = file.linkage.bodies.iter().position(|own| own.name == body).unwrap();
    let point = file.linkage.bodies[body].points.iter().position(|(own, _)| own == point).unwrap();
    let names: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
    trace_with_symbols(&file.linkage, &file.cases[0].given, (body, point), &names, &Watch::none())
}

/// Puts numbers in the place of the symbols.
fn at_file(found: &CurveSymbolic) -> Polynomial<Int> {
    let values = found.symbols.iter().enumerate().map(|(k, one)| (2 + k, Polynomial::constant(one.value.clone())));
    let rational = found.polynomial.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
    rational.substitute_all(&values.collect::<Vec<_>>()).primitive().0
}

#[test]
fn the_sextic_of_a_four_bar_has_its_lengths_as_symbols() {
    let bodies = r#"frame = { A = ["0", "0"], D = ["6", "0"] }
crank = { A = ["0", "0"], B = ["3", "0"] }
coupler = { B = ["0", "0"], C = ["5", "0"], P = ["2", "3"] }
rocker = { D = ["0", "0"], C = ["4", "0"] }"#;
    let file = read(SHARED, bodies, "");
    let found = with_symbols(&file, "coupler.P", &[]).unwrap();
    // Ground, crank, coupler, the two coordinates of the point, rocker.
    assert_eq!((found.symbols.len(), found.degree(), found.compared), (6, 6, None));
    assert!(found.agrees);
    assert_eq!(at_file(&found), with_terms(&SEXTIC));
    // Wampler's determinant is the squares of crank and rocker times an irreducible sextic of 239 terms.
    assert_eq!(found.polynomial.len(), 239);
    let one = with_symbols(&file, "coupler.P", &["coupler.P.y"]).unwrap();
    assert_eq!(at_file(&one), with_terms(&SEXTIC));
    assert!(with_symbols(&file, "coupler.P", &["coupler.P.z"]).is_err());
    // The end of the crank runs on its circle, whatever the other lengths are.
    let circle = with_symbols(&file, "crank.B", &["crank.B.x"]).unwrap();
    assert_eq!(at_file(&circle), with_terms(&[(2, 0, 1), (0, 2, 1), (0, 0, -9)]));
}

#[test]
fn the_quartic_of_a_slider_crank_has_symbols() {
    let joints = r#"joints = [
    { name = "A", type = "R", of = ["frame", "crank"] },
    { name = "B", type = "R", of = ["crank", "rod"] },
    { name = "C", type = "R", of = ["rod", "piston"] },
    { name = "S", type = "P", of = ["frame", "piston"], along = [1, 0] },
]"#;
    let bodies = r"frame = { A = 0, S = [0, 1] }
crank = { A = 0, B = 2 }
rod = { B = 0, C = 5, P = [2, 3] }
piston = { C = 0, S = [1, 0] }";
    let file = read(joints, bodies, "");
    let found = with_symbols(&file, "rod.P", &[]).unwrap();
    assert!(found.agrees && found.compared.is_none());
    assert_eq!((found.symbols.len(), found.degree()), (6, 4));
    assert_eq!(at_file(&found), curve(&file, "rod.P").unwrap().polynomial);
}
