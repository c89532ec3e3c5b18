//! Systems for other programs that can be read alone: with comments on what they are, and with the relations that their variables
//! satisfy.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::text::{Format, Names};
use crate::error::{Error, Result};
use rug::Rational;

/// A polynomial of a system, and what it is.
pub(super) struct Line {
    pub meaning: String,
    pub polynomial: Polynomial<Rational>,
}

impl Line {
    pub fn new(meaning: impl Into<String>, polynomial: Polynomial<Rational>) -> Self {
        Self { meaning: meaning.into(), polynomial }
    }
}

/// What stands above a system.
pub(super) struct Head<'a> {
    pub title: &'a str,
    /// The key of the publication.
    pub source: Option<&'a str>,
    /// The number of the case in the file.
    pub case: usize,
    /// What was asked for and what else a reader has to know, a line each.
    pub remarks: Vec<String>,
}

/// The remark on a system whose numbers are near those of the file.
pub(super) const ROUNDED: &str =
    "numbers without rational value or half-angle tangent are replaced by rationals nearby";

/// A system in a language: title, source, remarks, the meaning of each polynomial and of each variable as comments, where the language has
/// comments, then all polynomials, over the variables that occur.
///
/// # Errors
/// Where the language has no way to say it.
pub(super) fn export(head: &Head, lines: &[Line], names: &Names, format: Format) -> Result<String> {
    if lines.is_empty() {
        return Err(Error::Unsupported(format!("{}: there are no closure equations to write", head.title)));
    }
    let occurs = |variable: &usize| lines.iter().any(|line| line.polynomial.degree(*variable) > 0);
    let used: Vec<usize> = (0..names.list().len()).filter(occurs).collect();
    let mut text = vec![format!("{}, case {}", head.title, head.case)];
    text.extend(head.source.map(|source| format!("source: {source}")));
    text.extend(head.remarks.iter().cloned());
    text.push(format!("written by looproot {}; every polynomial is 0", env!("CARGO_PKG_VERSION")));
    text.extend(lines.iter().zip(1..).map(|(line, number)| format!("{number}: {}", line.meaning)));
    text.extend(used.iter().filter_map(|variable| {
        let name = &names.list()[*variable];
        Some(format!("{name}: {}", meaning(name)?))
    }));
    let comments: String = text.iter().filter_map(|line| format.comment(line)).map(|line| line + "\n").collect();
    let compact = |line: &Line| {
        Polynomial::from_terms(line.polynomial.terms().map(|(exponents, c)| {
            let exponent = |variable: &usize| exponents.get(*variable).copied().unwrap_or(0);
            (used.iter().map(exponent).collect(), c.clone())
        }))
    };
    let names = Names::given(used.iter().map(|&variable| &names.list()[variable]))?;
    Ok(comments + &format.system(&lines.iter().map(compact).collect::<Vec<_>>(), &names)?)
}

/// Names that every language has, with a remark on each name for which another one stands.
///
/// # Errors
/// Never: `v1`, `v2`, ... are names.
pub(super) fn plain_names(wanted: &[String]) -> Result<(Names, Vec<String>)> {
    if let Ok(names) = Names::given(wanted) {
        return Ok((names, Vec::new()));
    }
    let plain: Vec<String> = (1..=wanted.len()).map(|k| format!("v{k}")).collect();
    let remarks = plain.iter().zip(wanted).map(|(plain, own)| format!("{plain} is {own}")).collect();
    Ok((Names::given(&plain)?, remarks))
}

/// `c^2 + s^2 = 1` for every cosine with its sine, and what a half-angle tangent has to do with them, of the variables that occur.
pub(super) fn relations(lines: &[Line], names: &Names) -> Vec<Line> {
    let place = |name: &str| names.list().iter().position(|known| known == name);
    let occurs = |variable: usize| lines.iter().any(|line| line.polynomial.degree(variable) > 0);
    let mut found = Vec::new();
    for (cos, name) in names.list().iter().enumerate() {
        let Some(rest) = name.strip_prefix('c') else { continue };
        let Some(sin) = place(&format!("s{rest}")) else { continue };
        if !occurs(cos) && !occurs(sin) {
            continue;
        }
        let [c, s]: [Polynomial<Rational>; 2] = [cos, sin].map(Polynomial::variable);
        let one = Polynomial::one();
        found
            .push(Line::new(format!("cosine and sine: {name}^2 + s{rest}^2 = 1"), c.mul(&c).add(&s.mul(&s)).sub(&one)));
        if let Some(tangent) = place(&format!("t{rest}")).filter(|tangent| occurs(*tangent)) {
            let t = Polynomial::variable(tangent);
            let circle = t.mul(&t).add(&one);
            found.push(Line::new(
                format!("t{rest} is the tangent of half the angle: its cosine"),
                c.mul(&circle).add(&t.mul(&t)).sub(&one),
            ));
            found.push(Line::new(
                format!("t{rest} is the tangent of half the angle: its sine"),
                s.mul(&circle).sub(&t).sub(&t),
            ));
        }
    }
    found
}

/// Returns the meaning of a variable by its name; `None` for names that explain themselves.
fn meaning(name: &str) -> Option<String> {
    let number = |prefix: &str| name.strip_prefix(prefix).filter(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    let list: [(&str, &str); 15] = [
        ("c0_", "cosine of the constant angle theta0 of joint"),
        ("s0_", "sine of the constant angle theta0 of joint"),
        ("t0_", "tangent of half the constant angle theta0 of joint"),
        ("d0_", "constant distance of joint"),
        ("ca", "cosine of the twist alpha of link"),
        ("sa", "sine of the twist alpha of link"),
        ("ta", "tangent of half the twist alpha of link"),
        ("leg", "length of leg"),
        ("a", "length of link"),
        ("c", "cosine of the angle of joint"),
        ("s", "sine of the angle of joint"),
        ("t", "tangent of half the angle of joint"),
        ("d", "distance or offset of joint"),
        ("x", "Study's parameter of the rotation, a coordinate of its quaternion, number"),
        ("y", "Study's parameter of the translation, number"),
    ];
    let found = list.into_iter().find_map(|(prefix, text)| Some(format!("{text} {}", number(prefix)?)));
    found.or_else(|| ["x", "y", "z"].contains(&name).then(|| format!("coordinate {name} of the position of the pose")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_they_are() {
        assert_eq!(meaning("t3").unwrap(), "tangent of half the angle of joint 3");
        assert_eq!(meaning("ca2").unwrap(), "cosine of the twist alpha of link 2");
        assert_eq!(meaning("d0_4").unwrap(), "constant distance of joint 4");
        assert_eq!(meaning("a1").unwrap(), "length of link 1");
        assert_eq!(meaning("x").unwrap(), "coordinate x of the position of the pose");
        assert_eq!(meaning("C"), None);
    }

    #[test]
    fn a_cosine_comes_with_its_sine() {
        let names = Names::given(["c1", "s1", "t1", "a1"]).unwrap();
        let line = Line::new("f", Polynomial::variable(0).add(&Polynomial::variable(3)));
        assert_eq!(relations(&[line], &names).len(), 1);
        let both = Line::new("f", Polynomial::variable(1).add(&Polynomial::variable(2)));
        assert_eq!(relations(&[both], &names).len(), 3);
    }
}
