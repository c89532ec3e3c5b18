//! The languages in which polynomials are written.

use super::document;
use super::export;
use super::names::Names;
use super::notation::{latex, plain};
use super::rename::Renamed;
use crate::error::{Error, Result};
use crate::polynomial::Polynomial;
use rug::Rational;

/// A language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Our own, read back by [`super::Expression::parse`].
    Text,
    /// Lossless for programs, read back by [`super::read_json`].
    Json,
    /// Formulas for AMS-LaTeX.
    Latex,
    /// Python with SymPy.
    Sympy,
    /// Maple.
    Maple,
    /// The Wolfram language.
    Mathematica,
    /// Singular.
    Singular,
    /// Macaulay2.
    Macaulay2,
    /// The input of msolve.
    Msolve,
    /// The input of PHCpack's `phc`.
    Phcpack,
    /// Julia with HomotopyContinuation.jl.
    Julia,
}

impl Format {
    /// All languages by name.
    pub const NAMED: [(&'static str, Self); 11] = [
        ("text", Self::Text),
        ("json", Self::Json),
        ("latex", Self::Latex),
        ("sympy", Self::Sympy),
        ("maple", Self::Maple),
        ("mathematica", Self::Mathematica),
        ("singular", Self::Singular),
        ("macaulay2", Self::Macaulay2),
        ("msolve", Self::Msolve),
        ("phcpack", Self::Phcpack),
        ("julia", Self::Julia),
    ];

    /// Returns one polynomial as an expression of the language, in lexicographic order. Names that mean something else there
    /// are changed, always to the same ones for the same list of names.
    ///
    /// # Panics
    /// When the polynomial has more variables than there are names.
    #[must_use]
    pub fn polynomial(self, polynomial: &Polynomial<Rational>, names: &Names) -> String {
        match self {
            Self::Json => document::write_json(std::slice::from_ref(polynomial), names),
            Self::Latex => latex(polynomial, names.list()).join(" "),
            _ => plain(self, polynomial, Renamed::new(self, names).list()),
        }
    }

    /// Returns a line of comment; `None` for languages without comments.
    #[must_use]
    pub fn comment(self, text: &str) -> Option<String> {
        export::comment(self, text)
    }

    /// Returns some polynomials as a file that the program reads; for LaTeX as one that a document includes. Changed names are
    /// listed in a comment if the language has comments.
    ///
    /// # Errors
    /// [`Error::Invalid`] if the language cannot express this: an empty system, or one without variables.
    ///
    /// # Panics
    /// If a polynomial has more variables than there are names.
    pub fn system(self, polynomials: &[Polynomial<Rational>], names: &Names) -> Result<String> {
        if matches!(self, Self::Text | Self::Json | Self::Latex) {
            return Ok(match self {
                Self::Json => document::write_json(polynomials, names) + "\n",
                Self::Latex => export::latex_lines(polynomials, names),
                _ => {
                    let lines: Vec<String> = polynomials.iter().map(|p| plain(self, p, names.list())).collect();
                    lines.join(";\n") + "\n"
                }
            });
        }
        if polynomials.is_empty() || names.list().is_empty() {
            let what = if polynomials.is_empty() { "polynomial" } else { "variable" };
            return Err(Error::Invalid(format!("found a system without any {what}, expected at least one")));
        }
        Ok(export::file(self, polynomials, names))
    }
}
