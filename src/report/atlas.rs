//! The text of a `.eqs` file: closure equations and closure polynomial of an entry, where they fit two pages.

use crate::algebra::polynomial::Polynomial;
use crate::algebra::text::{Format, Names};
use crate::catalogue::entry::{Design, Entry};
use crate::derivation::{derive, platform_equations};
use crate::error::{Error, Result};
use rug::Rational;
use std::fmt::Write;

/// Two pages of characters.
const TWO_PAGES: usize = 8000;

/// The text for an entry's first case; `None` where the equations alone are longer than two pages.
///
/// Equations are equal to 0, with integer coefficients without common factor, the first one positive, in a fixed order.
/// The closure polynomial is left out where it does not fit, for platforms, and where numbers of the file are rounded.
///
/// # Errors
/// As [`derive()`].
pub fn atlas(entry: &Entry) -> Result<Option<String>> {
    let case = entry.cases.first().ok_or_else(|| Error::Invalid("a file without a case".to_owned()))?;
    let line = |polynomial: &Polynomial<Rational>, names: &Names| Format::Text.polynomial(polynomial, names);
    let mut text =
        format!("# {}\n# Closure equations (= 0) of the first case, written by looproot derive --bless\n", entry.title);
    if entry.rounded {
        text.push_str("# Numbers without rational value or half-angle tangent are replaced by rationals nearby\n");
    }
    let (equations, names, polynomial) = if let Design::Platform(geometry) = &entry.design {
        let (names, equations) = platform_equations(geometry, case)?;
        (equations, names, None)
    } else {
        let derivation = derive(entry, case)?;
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
