//! Laws of texts: what is written is read back the same, and what is read means what it says.

use looproot_algebra::error::Error;
use looproot_algebra::{
    modp::{ModP, PRIME_61},
    polynomial::Polynomial,
    ring::Ring,
    text::{Expression, Format, Fraction, Names, read_json, read_number, write_json},
};
use proptest::prelude::*;
use rug::{Integer, Rational};

type Poly = Polynomial<Rational>;

fn names() -> Names {
    Names::given(["x", "y", "z_1"]).unwrap()
}

fn read(text: &str) -> Poly {
    let mut names = names();
    let polynomial = Expression::parse(text, &mut names).and_then(|expression| expression.expand());
    polynomial.unwrap_or_else(|fault| panic!("{text}: {fault:?}")).to_rational()
}

/// Numbers of all lengths, with their text.
fn number() -> impl Strategy<Value = (String, Rational)> {
    let digits = prop_oneof![4 => "[0-9]{1,3}", 1 => "[0-9]{15,25}", 1 => "[1-9][0-9]{80}"];
    let integer = digits.prop_map(|text| (text.clone(), Rational::from(text.parse::<Integer>().unwrap())));
    let decimal = ("[0-9]{1,3}", "[0-9]{0,4}", -3_i32..4).prop_map(|(whole, fraction, exponent)| {
        let digits: Integer = format!("{whole}{fraction}").parse().unwrap();
        let mut value = Rational::from(digits);
        for _ in 0..fraction.len() {
            value /= 10;
        }
        for _ in 0..exponent.abs() {
            if exponent < 0 { value /= 10 } else { value *= 10 }
        }
        (format!("{whole}.{fraction}e{exponent}"), value)
    });
    prop_oneof![4 => integer, 1 => decimal]
}

/// A text and the polynomial it stands for, computed beside it by ring operations.
fn written() -> impl Strategy<Value = (String, Poly)> {
    let variable = (0_usize..3).prop_map(|v| (["x", "y", "z_1"][v].to_owned(), Poly::variable(v)));
    let constant = number().prop_map(|(text, value)| (text, Poly::constant(value)));
    let leaf = prop_oneof![2 => variable, 1 => constant];
    leaf.prop_recursive(5, 40, 4, |inner| {
        let pair = (inner.clone(), inner.clone());
        let divisor = number().prop_filter("no division by zero", |(_, value)| !value.is_zero());
        prop_oneof![
            3 => pair.clone().prop_map(|((a, p), (b, q))| (format!("{a} + {b}"), p.add(&q))),
            2 => pair.clone().prop_map(|((a, p), (b, q))| (format!("{a} -({b})"), p.sub(&q))),
            3 => pair.prop_map(|((a, p), (b, q))| (format!("({a})*\t({b})"), p.mul(&q))),
            1 => inner.clone().prop_map(|(a, p)| (format!("-({a})"), p.neg())),
            1 => inner.clone().prop_map(|(a, p)| (format!("+-+({a})\n"), p.neg())),
            1 => (inner.clone(), 0_u32..4).prop_map(|((a, p), k)| (format!("({a})^{k}"), p.pow(k))),
            1 => (inner.clone(), 0_u32..3).prop_map(|((a, p), k)| (format!("({a}) ** ({k})"), p.pow(k))),
            1 => (inner, divisor).prop_map(|((a, p), (b, q))| (format!("({a})/{b}"), p.scale(&q.recip()))),
        ]
    })
}

/// Polynomials as ring operations make them.
fn polynomial() -> impl Strategy<Value = Poly> {
    let term = (number(), any::<bool>(), number(), prop::collection::vec(0_u32..30, 0..4));
    prop::collection::vec(term, 0..12).prop_map(|terms| {
        Poly::from_terms(terms.into_iter().map(|((_, n), negative, (_, d), exponents)| {
            let q = if d.is_zero() { n } else { n / d };
            (exponents.into_iter().take(3).collect(), if negative { -q } else { q })
        }))
    })
}

proptest! {
    #[test]
    fn mean_what_they_say((text, polynomial) in written()) {
        prop_assert_eq!(read(&text), polynomial);
    }

    #[test]
    fn have_values_without_being_multiplied_out((text, polynomial) in written(), at in prop::array::uniform3(number())) {
        let expression = Expression::parse(&text, &mut names()).unwrap();
        let at = at.map(|(_, value)| value);
        prop_assert_eq!(expression.value(&at).unwrap(), polynomial.evaluate(&at));
        let modulo = |q: &Rational| ModP::<PRIME_61>::from_rational(q);
        let images: Option<Vec<_>> = at.iter().map(modulo).collect();
        if let (Some(images), Some(image)) = (images, polynomial.map(modulo)) {
            prop_assert_eq!(expression.evaluate(&images), Some(image.evaluate(&images)));
        }
    }

    #[test]
    fn come_back_from_every_language_that_is_a_part_of_ours(p in polynomial()) {
        for format in [Format::Text, Format::Maple, Format::Mathematica, Format::Macaulay2, Format::Phcpack] {
            // Variables renamed there keep their places.
            let text = format.polynomial(&p, &names());
            let mut renamed = Names::given(["x", "y", if text.contains("z_1") { "z_1" } else { "z1" }]).unwrap();
            let again = Expression::parse(&text, &mut renamed).unwrap().expand().unwrap();
            prop_assert_eq!(&again.to_rational(), &p, "{}", text);
        }
        let integers = Fraction::from_rational(&p).numerator.map(|c| Some(Rational::from(c.to_integer()))).unwrap();
        for format in [Format::Sympy, Format::Singular, Format::Msolve, Format::Julia] {
            prop_assert_eq!(read(&format.polynomial(&integers, &names())), integers.clone());
        }
        prop_assert_eq!(Format::Text.polynomial(&read(&Format::Text.polynomial(&p, &names())), &names()),
            Format::Text.polynomial(&p, &names()));
    }

    #[test]
    fn come_back_from_json(p in polynomial(), q in polynomial()) {
        for list in [vec![p.clone()], vec![p.clone(), q.clone()], Vec::new()] {
            let text = write_json(&list, &names());
            prop_assert_eq!(read_json(&text, "file", &mut names()).unwrap(), list.clone());
            let mut collected = Names::collected();
            prop_assert_eq!(read_json(&text, "file", &mut collected).unwrap(), list);
            prop_assert_eq!(collected.list(), ["x", "y", "z_1"]);
        }
        // Another order of names moves the variables.
        let mut turned = Names::given(["z_1", "y", "x"]).unwrap();
        let moved = read_json(&write_json(std::slice::from_ref(&p), &names()), "file", &mut turned).unwrap();
        prop_assert_eq!(Expression::parse(&Format::Text.polynomial(&moved[0], &turned), &mut names()).unwrap()
            .expand().unwrap().to_rational(), p);
    }

    #[test]
    fn of_numbers_are_exact((text, value) in number(), (below, divisor) in number()) {
        prop_assert_eq!(&read_number(&text).unwrap(), &value);
        prop_assert_eq!(read_number(&format!(" -{text} ")).unwrap(), Rational::from(-&value));
        match read_number(&format!("{text}/{below}")) {
            Ok(quotient) => prop_assert_eq!(quotient * divisor, value),
            Err(_) => prop_assert!(divisor.is_zero()),
        }
    }

    #[test]
    fn never_make_the_reader_panic(text in "[-+*/^().xyz0-9e_' \\n;,#]{0,40}", any in ".{0,20}") {
        for text in [text, any] {
            let mut names = Names::collected();
            if let Ok(expression) = Expression::parse(&text, &mut names) {
                let _ = expression.expand();
                let _ = expression.value(&vec![Rational::from((3, 2)); names.list().len()]);
            }
            let _ = Expression::parse_all(&text, &mut Names::collected());
            let _ = Expression::parse_matrix(&text, &mut Names::collected());
            let _ = read_number(&text);
            let _ = read_json(&text, "file", &mut Names::collected());
        }
    }
}

#[test]
fn one_polynomial_in_every_language() {
    let p = read("2*x^2*y - z_1/3 + x - 1");
    let text = |format: Format| format.polynomial(&p, &names());
    assert_eq!(text(Format::Text), "2*x^2*y + x - 1/3*z_1 - 1");
    assert_eq!(text(Format::Sympy), "2*x**2*y + x - Rational(1, 3)*z_1 - 1");
    assert_eq!(text(Format::Latex), "2 x^{2} y + x - \\frac{1}{3} z_{1} - 1");
    assert_eq!(text(Format::Mathematica), "2*x^2*y + x - 1/3*z1 - 1");
    assert_eq!(text(Format::Julia), "2*x^2*y + x - 1//3*z_1 - 1");
    assert_eq!(text(Format::Msolve), "2*x^2*y+x-1/3*z_1-1");
    let json = "{\"vars\": [\"x\",\"y\",\"z_1\"], \"terms\": [[\"2\", \"1\", [2, 1, 0]], [\"1\", \"1\", [1, 0, 0]], \
                [\"-1\", \"3\", [0, 0, 1]], [\"-1\", \"1\", [0, 0, 0]]]}";
    assert_eq!(text(Format::Json), json);
    assert_eq!(Format::Text.polynomial(&Poly::zero(), &names()), "0");
}

#[test]
fn faults_are_placed_and_told() {
    for (text, line, column, words) in [
        ("", 1, 1, "found the end, expected a number"),
        ("x +\n  2x", 2, 4, "found `x` where an operator should stand; write products with `*`"),
        ("x y", 1, 3, "found `y` where"),
        ("x (y)", 1, 3, "found `(` where"),
        ("(x + y", 1, 7, "`)` for the `(` in line 1, column 1"),
        ("x + y)", 1, 6, "found `)`, expected an operator"),
        ("x + * y", 1, 5, "found `*`, expected a number"),
        ("x^-1", 1, 3, "found `-`, expected a whole number as exponent"),
        ("x^y", 1, 3, "found `y`, expected a whole number"),
        ("x^1.5", 1, 4, "found `.`, expected a whole number"),
        ("x^2^3", 1, 4, "parentheses"),
        ("x^1073741824", 1, 3, "exponent above 1073741823"),
        ("x^99999999999999999999999", 1, 3, "exponent above"),
        ("(x^1073741823)^2", 1, 1, "exponent above"),
        ("x^1073741823*x", 1, 14, "exponent above"),
        ("x^1073741823*(x + y)", 1, 1, "exponent above 1073741823 when multiplied out"),
        ("(x^1073741823 + 1)^2", 1, 1, "exponent above 1073741823 when multiplied out"),
        ("x/y", 1, 3, "division by variables"),
        ("x/(y - y)", 1, 3, "division by variables"),
        ("x/(2 - 4/2)", 1, 3, "division by zero"),
        ("1/0", 1, 3, "division by zero"),
        ("x + w", 1, 5, "unknown variable `w`; expected one of x, y, z_1"),
        ("x + z1", 1, 5, "did you mean `z_1`?"),
        ("x + X", 1, 5, "did you mean `x`?"),
        ("(x + y + z_1 + 1)^1000", 1, 1, "terms"),
        ("(x + y + 1)^1000", 1, 1, "digits"),
        ("(x + 1)^1000000000", 1, 1, "terms"),
        ("9^99999999999", 1, 3, "exponent above"),
        ("9^999999999", 1, 1, "too many digits"),
        ("(9^9999999)^99", 1, 1, "too many digits"),
        ("x + (x - x + 2)^1000000000", 1, 5, "digits"),
        ("((x - x + 2)^1000000000)^1000000000", 1, 1, "digits"),
        ("1e401", 1, 1, "power of ten"),
        (".", 1, 1, "point without digits"),
        ("x = y", 1, 3, "found `=`"),
        ("\u{3b8}", 1, 1, "found `\u{3b8}`"),
        ("x\0", 1, 2, "found `\\0`"),
    ] {
        let mut names = names();
        let fault = Expression::parse(text, &mut names).and_then(|e| e.expand()).map(|_| ()).unwrap_err();
        assert_eq!((fault.place.line, fault.place.column), (line, column), "{text}: {}", fault.message);
        assert!(fault.message.contains(words), "{text}: {}", fault.message);
    }
    let fault = Expression::parse("1 +\n+ w", &mut names()).unwrap_err();
    let Error::File { path, line, message } = fault.in_file("f.txt") else { panic!("a fault of a file") };
    assert_eq!((path.as_str(), line), ("f.txt", 2));
    assert!(message.starts_with("column 3: found the unknown variable `w`"), "{message}");
}

#[test]
fn deep_nesting_is_refused_and_long_chains_are_not() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert_eq!(read(&nested(500)), Poly::variable(0));
    let mut names = names();
    let refused = Expression::parse(&nested(501), &mut names).unwrap_err();
    assert!(refused.message.contains("nested deeper than 500"));
    assert!(Expression::parse(&"(".repeat(1_000_000), &mut names).is_err());
    let horner = (0..499).fold("x".to_owned(), |inner, _| format!("({inner})*x + 1"));
    assert_eq!(read(&horner).len(), 500);
    assert_eq!(read(&format!("{}x", "-".repeat(100_001))), Poly::variable(0).neg());
    assert_eq!(read(&vec!["(x + 1)"; 20_000].join("+")), read("20000*x + 20000"));
    assert_eq!(read(&["x"; 1000].join("*")), Poly::variable(0).pow(1000));
}

#[test]
fn comments_and_semicolons_part_the_polynomials_of_a_file() {
    let mut names = Names::collected();
    let all = Expression::parse_all("# two lines; of comment\n x - 1; # first\n y' + x;\n", &mut names).unwrap();
    assert_eq!((all.len(), names.list()), (2, &["x".to_owned(), "y'".to_owned()][..]));
    assert!(Expression::parse_all("x;; y", &mut names).is_err());
    for text in ["[[x, 1], [2, y']]", "[x, 1; 2, y']", "x, 1; 2, y'", "x, 1;\n2, y';\n"] {
        let rows = Expression::parse_matrix(text, &mut names).unwrap();
        assert_eq!(rows.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2], "{text}");
    }
    for text in ["[[x, 1], [2, y'", "[x, 1", "[[x], 2]", "x,, 1", "[[x]] + 1", "[]", ""] {
        assert!(Expression::parse_matrix(text, &mut names).is_err(), "{text}");
    }
}

#[test]
fn json_of_another_form_is_told() {
    for (text, words) in [
        ("{", "no JSON"),
        ("{}", "no `vars`"),
        ("{\"vars\": [\"x\"]}", "no `terms`"),
        ("{\"vars\": [\"x\", \"x\"], \"terms\": []}", "twice"),
        ("{\"vars\": [\"2x\"], \"terms\": []}", "expected a letter"),
        ("{\"vars\": [\"x\"], \"terms\": [[\"1\", \"0\", [1]]]}", "denominator of zero"),
        ("{\"vars\": [\"x\"], \"terms\": [[\"1\", \"1\", [1, 2]]]}", "expected 1 exponents"),
        ("{\"vars\": [\"x\"], \"terms\": [[\"1\", \"1\", [-1]]]}", "exponents from 0"),
        ("{\"vars\": [\"x\"], \"terms\": [[\"1\", \"1\", [1073741824]]]}", "exponents from 0"),
        ("{\"vars\": [\"x\"], \"terms\": [[\"a\", \"1\", [1]]]}", "expected [\"num\", \"den\", [exponents]]"),
    ] {
        let message = read_json(text, "f.json", &mut Names::collected()).unwrap_err().to_string();
        assert!(message.contains(words) && message.contains("f.json"), "{text}: {message}");
    }
}

#[test]
fn names_are_changed_where_they_mean_something_else() {
    let changed = ["I", "e", "D", "x_1", "x'", "lambda", "f1", "det", "_k", "Pi", "end"];
    let polynomial = (0..changed.len()).fold(Poly::zero(), |sum, v| sum.add(&Poly::variable(v).pow(2)));
    let mut text = String::new();
    for (name, format) in Format::NAMED {
        let names = Names::given(changed).unwrap();
        text += &format!("=== {name}\n{}", format.system(&[polynomial.clone(), Poly::variable(0)], &names).unwrap());
    }
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/languages.txt");
    if std::env::var_os("LOOPROOT_BLESS").is_some() {
        std::fs::write(path, &text).unwrap();
    }
    assert_eq!(text, std::fs::read_to_string(path).unwrap_or_default());
}
