//! Whole files for other programs.

use super::format::Format;
use super::names::Names;
use super::notation::{latex, plain};
use super::rename::Renamed;
use crate::polynomial::Polynomial;
use rug::Rational;

/// Terms in a line of LaTeX, and characters: about twice the width of a page. TeX sets no line of more than some 3000 digits.
const LATEX_LINE: [usize; 2] = [6, 160];

/// Returns the file of a system that is not empty.
pub(super) fn file(format: Format, polynomials: &[Polynomial<Rational>], names: &Names) -> String {
    let renamed = Renamed::new(format, names);
    let variables = renamed.list();
    let lines: Vec<String> = polynomials.iter().map(|p| plain(format, p, variables)).collect();
    let list = variables.join(", ");
    let body = match format {
        Format::Sympy => {
            let polys: Vec<String> =
                lines.iter().map(|line| format!("    Poly({line}, {list}, domain=\"QQ\"),\n")).collect();
            format!(
                "from sympy import Poly, Rational, symbols\n\nvariables = {list}, = symbols(\"{}\", seq=True)\nequations = \
                 [\n{}]\n",
                variables.join(" "),
                polys.concat()
            )
        }
        Format::Maple => format!("variables := [{list}]:\nequations := [\n  {}\n]:\n", lines.join(",\n  ")),
        Format::Mathematica => format!("variables = {{{list}}};\nequations = {{\n  {}\n}};\n", lines.join(",\n  ")),
        Format::Singular => {
            let polys: Vec<String> =
                lines.iter().zip(1..).map(|(line, index)| format!("poly f{index} = {line};\n")).collect();
            let ideal: Vec<String> = (1..=lines.len()).map(|index| format!("f{index}")).collect();
            format!("ring looproot = 0, ({list}), dp;\n{}ideal equations = {};\n", polys.concat(), ideal.join(", "))
        }
        // The promotion makes numbers polynomials if all entries are numbers.
        Format::Macaulay2 => format!(
            "looproot = QQ[{list}];\nequations = ideal promote(matrix {{{{\n  {}\n}}}}, looproot);\n",
            lines.join(",\n  ")
        ),
        Format::Msolve => format!("{}\n0\n{}\n", variables.join(","), lines.join(",\n")),
        Format::Phcpack => {
            let count = if lines.len() == variables.len() {
                lines.len().to_string()
            } else {
                format!("{} {}", lines.len(), variables.len())
            };
            format!("{count}\n {};\n", lines.join(";\n "))
        }
        Format::Julia => format!(
            "using HomotopyContinuation\n\n@var {}\nF = System([\n    {},\n]; variables = [{list}])\n",
            variables.join(" "),
            lines.join(",\n    ")
        ),
        Format::Text | Format::Json | Format::Latex => lines.concat(),
    };
    remark(format, renamed.changes()) + &body
}

/// Returns the comment on changed names; empty if there are none or the language has no comments.
fn remark(format: Format, changes: &[(String, String)]) -> String {
    if changes.is_empty() {
        return String::new();
    }
    let changes: Vec<String> = changes.iter().map(|(old, new)| format!("{new} was {old}")).collect();
    comment(format, &format!("renamed: {}", changes.join(", "))).map_or_else(String::new, |line| line + "\n")
}

/// Returns a line of comment; `None` for languages without comments.
pub(super) fn comment(format: Format, text: &str) -> Option<String> {
    let (open, close) = match format {
        Format::Text | Format::Sympy | Format::Maple | Format::Julia => ("# ", ""),
        Format::Latex => ("% ", ""),
        Format::Singular => ("// ", ""),
        Format::Macaulay2 => ("-- ", ""),
        Format::Mathematica => ("(* ", " *)"),
        Format::Json | Format::Msolve | Format::Phcpack => return None,
    };
    // Nothing in the text may end the comment.
    let text = text.replace(['\n', '\r'], " ").replace("*)", "* )");
    Some(format!("{open}{text}{close}"))
}

/// Returns the polynomials in the lines of an `align*`.
pub(super) fn latex_lines(polynomials: &[Polynomial<Rational>], names: &Names) -> String {
    let mut blocks = Vec::new();
    for (index, polynomial) in polynomials.iter().enumerate() {
        let lines = latex_broken(&latex(polynomial, names.list()));
        let name = if polynomials.len() == 1 { "f".to_owned() } else { format!("f_{{{}}}", index + 1) };
        blocks.push(format!("  {name} &= {}", lines.join(" \\\\\n    &\\quad ")));
    }
    format!("\\begin{{align*}}\n{}\n\\end{{align*}}\n", blocks.join(" \\\\\n"))
}

/// Joins terms to lines of few terms and of few characters, one term at least.
fn latex_broken(terms: &[String]) -> Vec<String> {
    let [most, width] = LATEX_LINE;
    let mut lines: Vec<Vec<&str>> = Vec::new();
    for term in terms {
        match lines.last_mut() {
            Some(line) if line.len() < most && line.iter().map(|t| t.len()).sum::<usize>() + term.len() <= width => {
                line.push(term);
            }
            _ => lines.push(vec![term]),
        }
    }
    lines.iter().map(|line| line.join(" ")).collect()
}
