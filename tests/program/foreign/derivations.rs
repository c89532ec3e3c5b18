//! Derivations as other programs read them: the degree of the closure polynomial, and its real roots.

use super::{file, program, talk};
use std::fs;
use std::process::{Command, Stdio};

/// Entries, the degree of the closure polynomial, and the number of its real roots.
const ENTRIES: [(&str, usize, usize); 3] = [("cccr_4_angle", 2, 2), ("crcrr_2_angle", 8, 4), ("general_7r", 16, 10)];

fn export(entry: &str, format: &str) -> String {
    let mut looproot = Command::new(env!("CARGO_BIN_EXE_looproot"));
    let output = looproot.args(["derive", entry, "--format", format]).current_dir(crate::ROOT).output().unwrap();
    assert!(output.status.success());
    String::from_utf8(output.stdout).unwrap()
}

#[test]
#[ignore = "needs Python with SymPy"]
fn sympy_reads_closure_polynomials() {
    // SymPy takes minutes to count the roots of the third one.
    for (entry, degree, real) in ENTRIES.into_iter().take(2) {
        let script = export(entry, "sympy")
            + "last = equations[-1].as_expr()\np = Poly(last, *last.free_symbols)\nprint(p.degree(), p.count_roots())\n";
        let answer = talk(program("python3", "LOOPROOT_PYTHON"), &script);
        assert_eq!(answer.trim(), format!("{degree} {real}"), "{entry}");
    }
}

#[test]
#[ignore = "needs Singular"]
fn singular_reads_closure_polynomials() {
    for (entry, degree, _) in ENTRIES {
        let script = export(entry, "singular") + "print(deg(equations[ncols(equations)]));\nquit;\n";
        let mut singular = program("Singular", "LOOPROOT_SINGULAR");
        singular.arg("-q");
        let answer = talk(singular, &script);
        let last = answer.lines().rfind(|line| !line.starts_with("//")).unwrap();
        assert_eq!(last.trim(), degree.to_string(), "{entry}: {answer}");
    }
}

#[test]
#[ignore = "needs Macaulay2"]
fn macaulay2_reads_closure_polynomials() {
    for (entry, degree, _) in ENTRIES {
        let script = export(entry, "macaulay2") + "print toString first degree last first entries gens equations\n";
        let path = file(&format!("{entry}.m2"), &script);
        let mut m2 = program("M2", "LOOPROOT_M2");
        let answer = String::from_utf8(m2.arg("--script").arg(path).output().unwrap().stdout).unwrap();
        assert_eq!(answer.trim(), degree.to_string(), "{entry}");
    }
}

#[test]
#[ignore = "needs msolve"]
fn msolve_reads_closure_polynomials() {
    for (entry, _, real) in ENTRIES {
        let text = export(entry, "msolve");
        // The closure polynomial alone: its variable is one of the first line's.
        let last = text.lines().last().unwrap();
        let variable = last.split(|c: char| !c.is_ascii_alphanumeric()).find(|word| word.starts_with('t')).unwrap();
        let input = file(&format!("{entry}.ms"), &format!("{variable}\n0\n{last}\n"));
        let output = file(&format!("{entry}.ms.out"), "");
        let mut msolve = program("msolve", "LOOPROOT_MSOLVE");
        assert!(msolve.arg("-f").arg(input).arg("-o").arg(&output).status().unwrap().success());
        let answer = fs::read_to_string(output).unwrap();
        assert_eq!(answer.matches(" / 2^").count() / 2, real, "{entry}: {answer}");
    }
}

#[test]
#[ignore = "needs PHCpack"]
fn phcpack_reads_closure_polynomials() {
    // Numbers of four doubles do not suffice for the third one.
    for (entry, degree, real) in ENTRIES.into_iter().take(2) {
        let text = export(entry, "phcpack");
        let input = file(&format!("{entry}.phc"), &format!("1\n{}\n", text.lines().last().unwrap()));
        let output = file(&format!("{entry}.phc.out"), "");
        fs::remove_file(&output).unwrap();
        let mut phc = program("phc", "LOOPROOT_PHC");
        phc.arg("-b4").arg(input).arg(&output).stdin(Stdio::null()).stdout(Stdio::null());
        assert!(phc.status().unwrap().success());
        let answer = fs::read_to_string(output).unwrap();
        // Real and imaginary part of the variable, whose name begins with t as no other line of two numbers does.
        let roots: Vec<[f64; 2]> = answer
            .lines()
            .filter(|line| line.starts_with(" t") && !line.starts_with(" t :"))
            .map(|line| {
                let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
                [numbers[0], numbers[1]]
            })
            .collect();
        assert_eq!(roots.len(), degree, "{entry}: {answer}");
        let count = roots.iter().filter(|[_, imaginary]| imaginary.abs() < 1e-12).count();
        assert_eq!(count, real, "{entry}: {answer}");
    }
}

/// Reads the last equation of a page and prints its degree and the number of its real roots.
const READ_LATEX: &str = r"
import re, sys
from sympy import Poly
from sympy.parsing.latex import parse_latex
body = open(sys.argv[1]).read().split(r'\begin{align*}')[1].split(r'\end{align*}')[0]
last = re.split(r'f(?:_\{\d+\})? &=', body)[-1]
read = parse_latex(re.sub(r'\\\\\s*|&|\\quad', '', last), backend='lark')
polynomial = Poly(read, *read.free_symbols)
print(polynomial.degree(), polynomial.count_roots())
";

#[test]
#[ignore = "needs LaTeX, and Python with SymPy and lark"]
fn latex_sets_closure_polynomials_and_sympy_reads_them() {
    let script = file("read_latex.py", READ_LATEX);
    for (number, (entry, degree, real)) in ENTRIES.into_iter().enumerate() {
        let text = export(entry, "latex");
        let page = "\\documentclass{article}\n\\usepackage{amsmath}\n\\begin{document}\n";
        let path = file(&format!("{entry}.tex"), &format!("{page}{text}\\end{{document}}\n"));
        let mut latex = program("pdflatex", "LOOPROOT_LATEX");
        latex.current_dir(path.parent().unwrap()).args(["-interaction=nonstopmode", "-halt-on-error"]).arg(&path);
        let output = latex.output().unwrap();
        assert!(output.status.success(), "{entry}: {}", String::from_utf8_lossy(&output.stdout));
        assert!(path.with_extension("pdf").is_file());
        // SymPy takes minutes to count the roots of the third one.
        if number < 2 {
            let mut python = program("python3", "LOOPROOT_PYTHON");
            let answer = String::from_utf8(python.arg(&script).arg(&path).output().unwrap().stdout).unwrap();
            assert_eq!(answer.trim(), format!("{degree} {real}"), "{entry}");
        }
    }
}

/// Linkages in the plane, with slides and gears, in space and on the sphere.
const LINKAGES: [&str; 6] = [
    "linkage/3prr",
    "linkage/inverted_slider_crank",
    "linkage/geared_five_bar",
    "linkage/stephenson_1",
    "linkage/rssr_ssr",
    "linkage/spherical_3rrr",
];

#[test]
#[ignore = "needs Singular: cargo test --test program foreign:: -- --ignored"]
fn closure_polynomials_of_linkages_lie_in_the_ideals_of_their_equations() {
    for entry in LINKAGES {
        let text = export(entry, "singular").replace("ring looproot = 0", "ring looproot = 32003");
        // The closure polynomial stands last.
        let count = text.lines().filter(|line| line.starts_with("poly f")).count();
        let others: Vec<String> = (1..count).map(|k| format!("f{k}")).collect();
        let script = format!(
            "{text}ideal rest = std(ideal({}));\nprint(dim(rest));\nprint(reduce(f{count}, rest) == 0);\nquit;\n",
            others.join(", ")
        );
        let mut singular = program("Singular", "LOOPROOT_SINGULAR");
        singular.arg("-q");
        let answer = talk(singular, &script);
        let lines: Vec<&str> = answer.lines().filter(|line| !line.starts_with("//")).collect();
        assert_eq!(lines, ["0", "1"], "{entry}: {answer}");
    }
}
