//! Papers: headings, sentences, lists and displayed equations, as Markdown or as a whole LaTeX document.

use super::number::counted;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::derivation::Substitution;
use rug::Rational;
use std::fmt::Write;

/// The language of a paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Style {
    /// Markdown with formulas between dollars.
    Markdown,
    /// A document for LaTeX with the packages of the AMS.
    Latex,
}

impl Style {
    /// All of them by their names.
    pub const NAMED: [(&'static str, Self); 2] = [("markdown", Self::Markdown), ("latex", Self::Latex)];
}

/// A paper in the making.
pub(super) struct Paper<'n> {
    style: Style,
    names: &'n Names,
    text: String,
}

impl<'n> Paper<'n> {
    /// Begins with title and summary.
    pub(super) fn new(style: Style, names: &'n Names, title: &str, summary: &str) -> Self {
        let mut paper = Self { style, names, text: String::new() };
        if style == Style::Latex {
            paper.text.push_str(
                "\\documentclass{article}\n\\usepackage{amsmath}\n\\usepackage[margin=25mm]{geometry}\n\\allowdisplaybreaks\n\
                 \\setlength{\\parindent}{0pt}\n\\setlength{\\parskip}{1ex}\n",
            );
            let _ = write!(paper.text, "\\title{{{}}}\n\\date{{}}\n\\begin{{document}}\n\\maketitle\n", escaped(title));
        } else {
            let _ = writeln!(paper.text, "# {title}");
        }
        paper.sentence(summary);
        paper
    }

    /// A heading.
    pub(super) fn heading(&mut self, text: &str) {
        match self.style {
            Style::Markdown => self.text.push_str(&format!("\n## {text}\n")),
            Style::Latex => self.text.push_str(&format!("\n\\section*{{{}}}\n", escaped(text))),
        }
    }

    /// A paragraph whose formulas are found by their names.
    pub(super) fn sentence(&mut self, text: &str) {
        let text = self.typeset(text);
        self.typeset_paragraph(&text);
    }

    /// A paragraph that is the same in both languages.
    pub(super) fn typeset_paragraph(&mut self, text: &str) {
        let _ = write!(self.text, "\n{text}\n");
    }

    /// Writes the name of an equation.
    pub(super) fn label(&mut self, text: &str) {
        match self.style {
            Style::Markdown => self.text.push_str(&format!("\n**{text}**\n")),
            Style::Latex => self.text.push_str(&format!("\n\\textbf{{{}}}\n", escaped(text))),
        }
    }

    /// A formula in a line of its own.
    pub(super) fn formula(&mut self, formula: &str) {
        match self.style {
            Style::Markdown => self.text.push_str(&format!("\n$$\n{formula}\n$$\n")),
            Style::Latex => self.text.push_str(&format!("\\begin{{align*}}\n  & {formula}\n\\end{{align*}}\n")),
        }
    }

    /// `polynomial = 0`
    pub(super) fn equation(&mut self, polynomial: &Polynomial<Rational>) {
        self.lines("", polynomial, " = 0");
    }

    /// `name = polynomial`
    pub(super) fn definition(&mut self, name: &str, polynomial: &Polynomial<Rational>) {
        let name = Self::name(name);
        self.lines(&format!("{name} = "), polynomial, "");
    }

    /// `variable = N/D`, then N and D.
    pub(super) fn quotient(&mut self, variable: usize, parts: [&Polynomial<Rational>; 2]) {
        let name = Self::name(&self.names.list()[variable]);
        let [above, below] = ["N", "D"].map(|letter| format!("{letter}_{{{name}}}"));
        self.formula(&format!("{name} = \\frac{{{above}}}{{{below}}}"));
        for (name, part) in [above, below].iter().zip(parts) {
            self.lines(&format!("{name} = "), part, "");
        }
    }

    /// Writes a polynomial, broken into lines.
    fn lines(&mut self, before: &str, polynomial: &Polynomial<Rational>, behind: &str) {
        let formula = format!("{before}{}{behind}", words(&Format::Latex.polynomial(polynomial, self.names)));
        let lines = broken(&formula).join(" \\\\\n  &\\quad ");
        let environment = if self.style == Style::Latex { "align*" } else { "aligned" };
        let display = format!("\\begin{{{environment}}}\n  & {lines}\n\\end{{{environment}}}\n");
        self.text.push_str(&if self.style == Style::Latex { display } else { format!("\n$$\n{display}$$\n") });
    }

    /// A list with numbers.
    pub(super) fn numbered(&mut self, items: &[String]) {
        self.list("enumerate", items, |number| format!("{number}. "));
    }

    /// A list.
    pub(super) fn bullets(&mut self, items: &[String]) {
        self.list("itemize", items, |_| "- ".to_owned());
    }

    fn list(&mut self, environment: &str, items: &[String], mark: impl Fn(usize) -> String) {
        if items.is_empty() {
            return;
        }
        if self.style == Style::Latex {
            let _ = writeln!(self.text, "\\begin{{{environment}}}");
        } else {
            self.text.push('\n');
        }
        for (number, item) in (1..).zip(items) {
            let item = self.typeset(item);
            match self.style {
                Style::Markdown => self.text.push_str(&format!("{}{item}\n", mark(number))),
                Style::Latex => self.text.push_str(&format!("  \\item {item}\n")),
            }
        }
        if self.style == Style::Latex {
            let _ = writeln!(self.text, "\\end{{{environment}}}");
        }
    }

    /// Writes the result of substituting solutions.
    pub(super) fn check(&mut self, found: &Substitution) {
        self.heading("Check");
        self.sentence(&verified(found));
    }

    /// The whole text.
    pub(super) fn finish(mut self) -> String {
        if self.style == Style::Latex {
            self.text.push_str("\n\\end{document}\n");
        }
        self.text
    }

    /// A name in a formula.
    fn name(name: &str) -> String {
        let one = Names::given([name.to_owned()]);
        one.map_or_else(|_| name.to_owned(), |names| words(&Format::Latex.polynomial(&Polynomial::variable(0), &names)))
    }

    /// A sentence with its formulas in dollars, all other signs escaped.
    fn typeset(&self, text: &str) -> String {
        let mut words: Vec<String> = Vec::new();
        for word in text.split(' ') {
            let core = word.trim_matches(|c: char| "(),.;:".contains(c));
            let typeset = (!core.is_empty()).then(|| self.symbol(core)).flatten();
            words.push(match (typeset, self.style) {
                (Some(symbol), _) => word.replacen(core, &format!("${symbol}$"), 1),
                (None, Style::Markdown) => word.to_owned(),
                (None, Style::Latex) => escaped(word),
            });
        }
        words.join(" ")
    }

    /// A word that is a symbol: a variable, a letter with a number or a power, a Greek letter.
    fn symbol(&self, word: &str) -> Option<String> {
        if self.names.list().iter().any(|name| name == word) && word.chars().any(|c| c.is_ascii_digit()) {
            return Some(Self::name(word));
        }
        if let Some((base, power)) = word.split_once('^') {
            let digits = !power.is_empty() && power.chars().all(|c| c.is_ascii_digit());
            let base = self.symbol(base).or_else(|| {
                let letters = base.len() <= 3 && base.chars().all(|c| c.is_ascii_alphabetic());
                letters.then(|| if base.len() == 1 { base.to_owned() } else { format!("\\{base}") })
            })?;
            return digits.then(|| format!("{base}^{{{power}}}"));
        }
        let letters = word.trim_end_matches(|c: char| c.is_ascii_digit());
        match letters {
            "alpha" | "theta" => Some(Self::name(word)),
            "eps" => Some("\\varepsilon".to_owned()),
            "f" | "g" | "u" | "v" | "t" | "p" | "q" | "N" if word.len() <= 2 => Some(Self::name(word)),
            _ => None,
        }
    }
}

/// The lines of a formula, broken before a plus or minus; numbers too long for a line run on in the next.
fn broken(formula: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    let mut room = LINE;
    for word in formula.split(' ') {
        let size = width(word);
        let is_sign = matches!(word, "+" | "-");
        // A sign stands before its term: as much room as most of them need.
        if room < size + if is_sign { TERM } else { 0.0 } && (is_sign || room < size) && room < LINE {
            lines.push(String::new());
            room = LINE - INDENT;
        }
        let mut rest = word;
        if size > room && word.chars().all(|c| c.is_ascii_digit()) {
            while rest.len() > DIGITS {
                let (line, behind) = rest.split_at(DIGITS);
                let last = lines.len() - 1;
                lines[last].push_str(line);
                lines.push(String::new());
                (rest, room) = (behind, LINE - INDENT);
            }
        }
        let last = lines.len() - 1;
        lines[last].push_str(rest);
        lines[last].push(' ');
        room -= width(rest);
    }
    lines.retain(|line| !line.trim().is_empty());
    lines.iter().map(|line| line.trim_end().to_owned()).collect()
}

/// The width of a line, in points of a page of 16 cm.
const LINE: f64 = 430.0;
/// Indent of the lines after the first.
const INDENT: f64 = 14.0;
/// As much room as most terms need behind their sign.
const TERM: f64 = 70.0;
/// Digits in a line.
const DIGITS: usize = 76;

/// About how wide a word of a formula is.
fn width(word: &str) -> f64 {
    let (mut width, mut index, mut command) = (2.0, 0_i32, false);
    for c in word.chars() {
        let was_command = command;
        command = c == '\\' || (was_command && c.is_ascii_alphabetic());
        match c {
            '_' | '^' => index += 1,
            '}' => index = (index - 1).max(0),
            '{' | '\\' => {}
            '+' | '-' | '=' => width += 10.0,
            _ if command && was_command => width += 0.7,
            _ => width += if index > 0 { 4.0 } else { 5.4 },
        }
    }
    width
}

/// Cosine and sine of a twist as `c` and `s` with the twist for an index.
fn words(latex: &str) -> String {
    let mut text = latex.to_owned();
    for letter in ["c", "s"] {
        let mark = format!("\\mathrm{{{letter}a}}_{{");
        while let Some(at) = text.find(&mark) {
            let rest = text.split_off(at);
            let rest = rest.strip_prefix(mark.as_str()).unwrap_or_default().to_owned();
            let (index, behind) = rest.split_once('}').unwrap_or((rest.as_str(), ""));
            text.push_str(&format!("{letter}_{{\\alpha_{{{index}}}}}{behind}"));
        }
    }
    text
}

/// The signs that mean something to LaTeX as themselves.
fn escaped(text: &str) -> String {
    let mut escaped = String::new();
    for c in text.chars() {
        match c {
            '_' | '&' | '%' | '#' | '$' | '{' | '}' => {
                escaped.push('\\');
                escaped.push(c);
            }
            '^' => escaped.push_str("\\textasciicircum{}"),
            '~' => escaped.push_str("\\textasciitilde{}"),
            '\\' => escaped.push_str("\\textbackslash{}"),
            '<' | '>' | '|' => escaped.push_str(&format!("${c}$")),
            _ => escaped.push(c),
        }
    }
    escaped
}

/// Describes in a sentence the check of the displayed equations.
pub(super) fn verified(found: &Substitution) -> String {
    if let Some(without) = &found.without {
        return format!("Not checked by a solution: there is none to put in. {without}");
    }
    let left_out = found.solutions * found.equations - found.values;
    let but = match left_out {
        0 => String::new(),
        one => format!(
            " ({one} pairs of an equation and a solution are left out: a half-angle tangent is infinite there, or a variable is \
                        none of the mechanism's)"
        ),
    };
    format!(
        "Checked: {} ({} real) of the numeric solver, which takes its own way in floating point, put into each of {}, leave at most {:.0e} of \
         the sum of the sizes of its terms{but}. More than 1e-8 would have been an error in place of this page.",
        counted(found.solutions, "solution"),
        found.real,
        counted(found.equations, "displayed equation"),
        found.largest
    )
}
