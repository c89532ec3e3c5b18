//! The text of a `.eqs` file: closure equations and closure polynomial of an entry, where they fit two pages; and whether
//! a file that is there is that text.

use super::linkage_derivation::{self, tangent};
use super::ring_derivation::{self, Named};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::catalogue::entry::{Design, Entry};
use crate::catalogue::{Any, LinkageFile, SpaceFile, SphereFile};
use crate::claims::{Finding, Sort};
use crate::derivation::{
    RingDerivation, derive_in_space, derive_linkage, derive_on_sphere, platform_equations, transfer,
};
use crate::error::{Error, Result};
use crate::kinematics::linkage::Accuracy;
use crate::linkage::space::platform_of;
use crate::sweep::derive_any;
use rug::Rational;
use std::fmt::Write;
use std::time::Instant;

/// Two pages of characters.
const TWO_PAGES: usize = 8000;
/// As much of a line is shown.
const LONGEST_LINE: usize = 60;

/// The second line of a page.
const PAGE: &str = "# Closure equations (= 0) of the first case, written by looproot derive --bless\n";
/// The third line of a page about rounded numbers.
const ROUNDED: &str = "# Numbers without rational value or half-angle tangent are replaced by rationals nearby\n";

/// The text for an entry's first case; `None` where the equations alone are longer than two pages.
///
/// Equations are equal to 0, with integer coefficients without common factor, the first one positive, in a fixed order.
/// The closure polynomial is left out where it does not fit, for platforms, and where numbers of the file are rounded.
///
/// # Errors
/// As [`derive_any()`].
pub fn atlas(entry: &Entry) -> Result<Option<String>> {
    let case = entry.cases.first().ok_or_else(|| Error::Invalid("a file without a case".to_owned()))?;
    let line = |polynomial: &Polynomial<Rational>, names: &Names| Format::Text.polynomial(polynomial, names);
    let mut text = format!("# {}\n{PAGE}", entry.title);
    if entry.rounded {
        text.push_str(ROUNDED);
    }
    let (equations, names, polynomial) = if let Design::Platform(geometry) = &entry.design {
        let (names, equations) = platform_equations(geometry, case)?;
        (equations, names, None)
    } else {
        let derivation = derive_any(entry, case)?;
        (derivation.equations, derivation.names, derivation.polynomial)
    };
    for equation in &equations {
        let _ = write!(text, "\n{}\n  {}\n", equation.name, line(&equation.polynomial, &names));
    }
    if text.len() > TWO_PAGES {
        return Ok(None);
    }
    if let Some(polynomial) = polynomial.filter(|_| !entry.rounded) {
        let name = &names.list()[polynomial.variable];
        let last = format!(
            "\nclosure polynomial of degree {} in {name}\n  {}\n",
            polynomial.degree(),
            line(&polynomial.to_polynomial(), &names)
        );
        if text.len() + last.len() <= TWO_PAGES {
            text.push_str(&last);
        }
    }
    Ok(Some(text))
}

/// As [`atlas`], of a linkage too; `None` also where a linkage has no equations.
///
/// # Errors
/// As [`atlas`], and for files of other kinds.
pub fn page(any: &Any) -> Result<Option<String>> {
    let (heading, is_rounded, (equations, polynomial)) = match any {
        Any::Entry(entry) => return atlas(entry),
        Any::Linkage(file) if !file.cases.is_empty() => {
            let found = derive_linkage(&file.linkage, &file.cases[0].given)?;
            let page = linkage_derivation::page(file, &found);
            (&file.heading, file.accuracy(&file.cases[0]) != Accuracy::Exact, page)
        }
        Any::Space(file) if !file.cases.is_empty() => {
            if let Some(platform) = platform_of(file, &file.cases[0])? {
                return atlas(&platform);
            }
            let found = derive_in_space(&file.linkage, &file.cases[0].given)?;
            (
                &file.heading,
                !(file.exact && file.cases[0].exact),
                ring_derivation::page(&Named::in_space(file, 1), &found),
            )
        }
        Any::Sphere(file) if file.cases.first().is_some_and(|case| !case.given.is_empty()) => {
            let found = derive_on_sphere(&file.linkage, &file.cases[0].given)?;
            (
                &file.heading,
                !(file.exact && file.cases[0].exact),
                ring_derivation::page(&Named::on_sphere(file, 1), &found),
            )
        }
        _ => return Err(Error::Unsupported("a page of equations of a file of this kind".to_owned())),
    };
    let mut text = format!("# {}\n{PAGE}", heading.title);
    if is_rounded {
        text.push_str(ROUNDED);
    }
    text.push_str(&equations);
    if equations.lines().all(|line| line.starts_with('#')) || text.len() > TWO_PAGES {
        return Ok(None);
    }
    if let Some(last) = polynomial.filter(|last| !is_rounded && text.len() + last.len() <= TWO_PAGES) {
        text.push_str(&last);
    }
    Ok(Some(text))
}

/// The head of the table of all entries, in Markdown.
pub const HEAD: &str = "| entry | mechanism | degree | unknown | real roots | longest coefficient [digits] | time [ms] | equations |\n\
                        |---|---|---|---|---|---|---|---|\n";

/// What a row says of a closure polynomial.
struct Columns {
    degree: usize,
    unknown: String,
    /// `None` of polynomials in two unknowns.
    real: Option<usize>,
    digits: usize,
}

/// The digits of the longest of these numbers.
fn digits<T: ToString>(numbers: impl Iterator<Item = T>) -> usize {
    numbers.map(|c| c.to_string().trim_start_matches('-').len()).max().unwrap_or(0)
}

/// A row of that table: its columns, or why there are none. `page` is the last one.
fn row_of(
    name: &str,
    title: &str,
    page: &str,
    derive: impl FnOnce() -> std::result::Result<Columns, String>,
) -> String {
    let start = Instant::now();
    let found = derive();
    let time = start.elapsed().as_secs_f64() * 1e3;
    let columns = match found {
        Ok(Columns { degree, unknown, real, digits }) => {
            let real = real.map_or_else(String::new, |real| real.to_string());
            // Below 10 ms one decimal, so that short times are told apart.
            let time = if time < 10.0 { format!("{time:.1}") } else { format!("{time:.0}") };
            format!("{degree} | {unknown} | {real} | {digits} | {time} | {page}")
        }
        Err(reason) => {
            format!("– | | | | | {}", reason.split(['\n', ';']).next().unwrap_or_default().replace('|', "/"))
        }
    };
    format!("| {name} | {} | {columns} |\n", title.replace('|', "/"))
}

/// Returns the reason of an error that says what is not supported, else all of it.
fn reason(error: &Error) -> String {
    error.unsupported().map_or_else(|| error.to_string(), ToOwned::to_owned)
}

/// A row of that table: what is derived from an entry's first case, or why nothing is. `has_page` says whether a `.eqs` file stands
/// beside it.
#[must_use]
pub fn row(entry: &Entry, name: &str, has_page: bool) -> String {
    row_of(name, &entry.title, &linked(name, has_page), || {
        let case = entry.cases.first().ok_or("no case")?;
        let derivation = derive_any(entry, case).map_err(|error| reason(&error))?;
        let none = || derivation.without.clone().unwrap_or_else(|| "no closure polynomial".to_owned());
        let polynomial = derivation.polynomial.as_ref().ok_or_else(none)?;
        Ok(Columns {
            degree: polynomial.degree() + polynomial.at_pi,
            unknown: derivation.names.list()[polynomial.variable].clone(),
            real: Some(polynomial.roots.len() + usize::from(polynomial.at_pi > 0)),
            digits: digits(polynomial.coefficients.coefficients().iter()),
        })
    })
}

/// The row of a linkage in the plane: the closure polynomial of least degree.
#[must_use]
pub fn linkage_row(file: &LinkageFile, name: &str, has_page: bool) -> String {
    row_of(name, &file.heading.title, &linked(name, has_page), || {
        let case = file.cases.first().ok_or("no case")?;
        let derivation = derive_linkage(&file.linkage, &case.given).map_err(|error| reason(&error))?;
        let best = derivation.polynomials.first().ok_or("no closure polynomial")?;
        Ok(Columns {
            degree: best.roots(),
            unknown: tangent(file, best.body),
            real: Some(best.coefficients.real_roots().len() + usize::from(best.at_pi > 0)),
            digits: digits(best.coefficients.coefficients().iter()),
        })
    })
}

/// The columns of the closure polynomial of the last group.
fn columns(named: &Named<'_>, derivation: &RingDerivation) -> std::result::Result<Columns, String> {
    let best = derivation.polynomials.first().ok_or("no closure polynomial")?;
    Ok(Columns {
        degree: best.roots(),
        unknown: named.variable(best.unknown),
        real: Some(best.real_roots()),
        digits: digits(best.coefficients.coefficients().iter()),
    })
}

/// The page of a linkage in the last column.
fn linked(name: &str, has_page: bool) -> String {
    if has_page { format!("[{name}.eqs]({name}.eqs)") } else { "`derive`".to_owned() }
}

/// The row of a linkage in space.
#[must_use]
pub fn space_row(file: &SpaceFile, name: &str, has_page: bool) -> String {
    if let Some(Ok(Some(platform))) = file.cases.first().map(|case| platform_of(file, case)) {
        return row(&platform, name, has_page);
    }
    row_of(name, &file.heading.title, &linked(name, has_page), || {
        let case = file.cases.first().ok_or("no case")?;
        let found = derive_in_space(&file.linkage, &case.given).map_err(|error| reason(&error))?;
        columns(&Named::in_space(file, 1), &found)
    })
}

/// The row of a linkage on the sphere: the closure polynomial, or without a given joint the transfer function, a polynomial in the tangents
/// of two half angles.
#[must_use]
pub fn sphere_row(file: &SphereFile, name: &str, has_page: bool) -> String {
    row_of(name, &file.heading.title, &linked(name, has_page), || {
        let given = &file.cases.first().ok_or("no case")?.given;
        if !given.is_empty() {
            let found = derive_on_sphere(&file.linkage, given).map_err(|error| reason(&error))?;
            return columns(&Named::on_sphere(file, 1), &found);
        }
        let ground = file.linkage.joints.iter().position(|joint| joint.of.contains(&file.linkage.ground));
        let found = transfer(&file.linkage, ground.ok_or("no joint at the ground")?).map_err(|error| reason(&error))?;
        let joint = |joint: usize| &file.linkage.joints[joint].name;
        Ok(Columns {
            degree: found.polynomial.degree(1) as usize,
            unknown: format!(
                "t_{}, with t_{} of degree {}",
                joint(found.output),
                joint(found.input),
                found.polynomial.degree(0)
            ),
            real: None,
            digits: digits(found.polynomial.terms().map(|(_, c)| c.to_integer())),
        })
    })
}

/// Judges the text of a `.eqs` file by what is derived from its entry.
#[must_use]
pub fn judged(any: &Any, file: &str, kept: &str) -> Finding {
    let (line, message) = match page(any) {
        Ok(Some(derived)) if derived == kept => (1, None),
        Ok(Some(derived)) => {
            let (line, found, expected) = first_difference(kept, &derived);
            (line, Some(format!("found {found}, derived {expected} (looproot derive --bless writes it)")))
        }
        Ok(None) => {
            (1, Some("should not be there: no equations are derived, or they are longer than two pages".to_owned()))
        }
        Err(error) => (1, Some(format!("no such equations are derived: {error}"))),
    };
    Finding {
        case: 1,
        file: Some(file.to_owned()),
        line,
        sort: Sort::Equations,
        holds: message.is_none(),
        message: message.unwrap_or_default(),
    }
}

/// The number of the first line in which two texts differ, and what both have there.
fn first_difference(kept: &str, derived: &str) -> (usize, String, String) {
    let shown =
        |line: Option<&str>| line.map_or_else(|| "the end".to_owned(), |line| format!("\"{}\"", shortened(line)));
    let (mut left, mut right) = (kept.lines(), derived.lines());
    for number in 1.. {
        let (one, two) = (left.next(), right.next());
        if one != two || one.is_none() {
            return (number, shown(one), shown(two));
        }
    }
    (1, String::new(), String::new())
}

/// The beginning of a line.
fn shortened(line: &str) -> String {
    let line = line.trim();
    let mut short: String = line.chars().take(LONGEST_LINE).collect();
    if short.len() < line.len() {
        short.push_str("...");
    }
    short
}
