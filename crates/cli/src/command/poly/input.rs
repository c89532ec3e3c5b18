//! Polynomials given on the command line: as an expression, a file, or standard input.

use super::arguments::ReadOptions;
use crate::command::exit::Fault;
use looproot::internal::error::Error;
use looproot_algebra::text::{self, Expression, Fraction, Names};
use rug::Rational;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Maximum size of a file, bytes.
const LARGEST: u64 = 1 << 30;
/// Maximum degree of listed coefficients.
const LARGEST_DEGREE: u32 = 100_000;

/// A text and its origin.
pub struct Source {
    pub text: String,
    /// The name of the file; `None` for an expression on the command line.
    pub path: Option<String>,
}

impl Source {
    /// Reads the file that the argument names; otherwise the argument itself is the text.
    pub fn of(argument: &str) -> Result<Self, Error> {
        if argument == "-" {
            let text = bounded(std::io::stdin().lock(), argument)?;
            return Ok(Self { text, path: Some("standard input".to_owned()) });
        }
        let path = match argument.strip_prefix('@') {
            Some(path) => path,
            // A variable may have the name of a file, so only an argument that looks like a path is taken for one.
            None if argument.contains(['.', '/']) && Path::new(argument).is_file() => argument,
            None => return Ok(Self { text: argument.to_owned(), path: None }),
        };
        let fault = |error: std::io::Error| Error::Io { path: path.to_owned(), message: error.to_string() };
        if Path::new(path).is_dir() {
            return Err(Error::Io { path: path.to_owned(), message: "found a directory, expected a file".to_owned() });
        }
        let file = std::fs::File::open(path).map_err(fault)?;
        Ok(Self { text: bounded(file, path)?, path: Some(path.to_owned()) })
    }

    /// Returns whether this is JSON, which no expression is: none begins with a brace.
    pub fn is_json(&self) -> bool {
        self.path.is_some() && self.text.trim_start().starts_with('{')
    }

    /// Returns the path to name in errors about JSON.
    pub fn json_path(&self) -> &str {
        self.path.as_deref().unwrap_or("JSON")
    }

    /// Returns the error for a fault of this text.
    pub fn fault(&self, fault: text::Fault) -> Error {
        let fault = match &self.path {
            Some(path) => fault.in_file(path),
            None => fault.in_text(&self.text),
        };
        fault.into()
    }

    fn polynomials(&self, names: &mut Names) -> Result<Vec<Fraction>, Error> {
        if self.is_json() {
            let polynomials = text::read_json(&self.text, self.json_path(), names)?;
            return Ok(polynomials.iter().map(Fraction::from_rational).collect());
        }
        let expressions = Expression::parse_all(&self.text, names).map_err(|fault| self.fault(fault))?;
        expressions.iter().map(|e| e.expand().map_err(|fault| self.fault(fault))).collect()
    }
}

fn bounded(reader: impl Read, path: &str) -> Result<String, Error> {
    let mut bytes = Vec::new();
    let fault = |message: String| Error::Io { path: path.to_owned(), message };
    reader.take(LARGEST + 1).read_to_end(&mut bytes).map_err(|error| fault(error.to_string()))?;
    if bytes.len() as u64 > LARGEST {
        return Err(fault("found more than 1 GiB, expected a smaller file".to_owned()));
    }
    String::from_utf8(bytes).map_err(|error| {
        let valid = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = valid.split(|byte| *byte == b'\n').count();
        Error::Invalid("found bytes that are not UTF-8, expected text".to_owned()).at(path, line)
    })
}

/// Returns the names given on the command line, else none yet.
pub fn names(options: &ReadOptions) -> Result<Names, Error> {
    match &options.vars {
        Some(names) => Ok(Names::given(names.iter().map(|name| name.trim()))?),
        None => Ok(Names::collected()),
    }
}

/// Returns the polynomials of some arguments, as fractions, and the names of their variables.
pub fn polynomials(arguments: &[&str], options: &ReadOptions) -> Result<(Vec<Fraction>, Names), Error> {
    let mut names = names(options)?;
    let mut polynomials = Vec::new();
    for argument in arguments {
        polynomials.append(&mut Source::of(argument)?.polynomials(&mut names)?);
    }
    Ok((polynomials, names))
}

/// As [`polynomials`], for exactly this number of them.
pub fn exactly<const N: usize>(arguments: &[&str], options: &ReadOptions) -> Result<([Fraction; N], Names), Fault> {
    let (polynomials, names) = polynomials(arguments, options)?;
    let found = polynomials.len();
    let noun = if N == 1 { "polynomial" } else { "polynomials" };
    let fault = |_| Error::Invalid(format!("found {found} polynomials, expected {N} {noun}"));
    Ok((polynomials.try_into().map_err(fault)?, names))
}

/// Limits degrees, because the algorithms of most verbs work with lists of coefficients.
pub fn check_degrees(polynomials: &[Fraction]) -> Result<(), Error> {
    let open = polynomials.iter().filter(|p| p.numerator.exponent_bound() > LARGEST_DEGREE);
    let largest = open.flat_map(|p| p.numerator.degrees()).max().unwrap_or(0);
    if largest > LARGEST_DEGREE {
        return Err(Error::Invalid(format!("found the degree {largest}, expected at most {LARGEST_DEGREE}")));
    }
    Ok(())
}

/// Returns the files among the arguments, which no output may replace.
pub fn files(arguments: &[&str]) -> Vec<PathBuf> {
    arguments.iter().map(|argument| PathBuf::from(argument.strip_prefix('@').unwrap_or(argument))).collect()
}

/// Reads an exact number.
pub fn number(text: &str) -> Result<Rational, Error> {
    let source = |fault: text::Fault| fault.in_text(text);
    let mut none = Names::given::<&str>([])?;
    Ok(Expression::parse(text, &mut none).map_err(source)?.value(&[])?)
}
