//! Reads the text of a mechanism with the reader of its format and kind.

use super::ansatz::{Ansatz, ansatz};
use super::calculus::{CalculusFile, calculus};
use super::entry::Entry;
use super::file_kind::FileKind;
use super::framework::{FrameworkFile, framework};
use super::linkage::{LinkageFile, linkage, lives_in};
use super::motion::{MotionFile, motion};
use super::node::Node;
use super::options::Options;
use super::scope::Scope;
use super::space::{SpaceFile, space};
use super::sphere::{SphereFile, sphere};
use super::synthesis::{SynthesisFile, synthesis};
use super::{dh_table, job, node, urdf};
use crate::algebra::number::{MOST_DIGITS, Reading};
use crate::error::{Error, Result};
use std::path::Path;

/// Largest text read, bytes.
pub(super) const LARGEST: u64 = 64 << 20;

/// The formats of mechanism files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// TOML as described in equations/README.md.
    Toml,
    /// The same keys as TOML.
    Json,
    /// A DH table with the header `type,a,alpha,d,theta0`.
    Csv,
    /// A robot description, from which a chain between two links is taken.
    Urdf,
}

/// Reads a mechanism from text; `path` is its name in errors.
///
/// # Errors
/// [`Error::File`] with file and line for faults of the text, [`Error::Unsupported`] for kinds not solved yet.
pub fn load_text(text: &str, path: &str, format: Format, options: &Options) -> Result<Entry> {
    let (text, name, mut scope) = prepared(text, path, options)?;
    let root = match format {
        Format::Toml => node::from_toml(text, path)?,
        Format::Json => node::from_json(text, path)?,
        Format::Csv => return dh_table::entry(&scope, text, &name),
        Format::Urdf => return urdf::entry(&scope, text, &name, options),
    };
    entry_of(&mut scope, &root, &name)
}

/// Reads an arm, a loop or a platform from the values of a file.
fn entry_of(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Entry> {
    let others = [
        FileKind::Framework,
        FileKind::Linkage,
        FileKind::Motion,
        FileKind::Synthesis,
        FileKind::Conditions,
        FileKind::Displacement,
        FileKind::Lines,
        FileKind::Gearing,
    ];
    refuse(scope, root, &others, "an arm, a loop or a platform with numbers")?;
    job::entry(scope, root, name)
}

/// A mechanism file of any kind.
#[derive(Clone, Debug)]
pub enum Any {
    /// An arm, a loop or a platform.
    Entry(Box<Entry>),
    /// Bars and bodies.
    Framework(Box<FrameworkFile>),
    /// Bodies and the joints between them.
    Linkage(Box<LinkageFile>),
    /// Bodies whose joints have axes through one point.
    Sphere(Box<SphereFile>),
    /// Bodies in space.
    Space(Box<SpaceFile>),
    /// A rational motion.
    Motion(Box<MotionFile>),
    /// Positions or pairs of angles for the synthesis of a linkage.
    Synthesis(Box<SynthesisFile>),
    /// A loop with symbols for parameters.
    Conditions(Box<Ansatz>),
    /// A question about displacements or lines.
    Calculus(Box<CalculusFile>),
}

impl Any {
    /// Returns its kind.
    #[must_use]
    pub fn kind(&self) -> FileKind {
        match self {
            Self::Entry(entry) => entry.kind().into(),
            Self::Framework(_) => FileKind::Framework,
            Self::Linkage(_) | Self::Sphere(_) | Self::Space(_) => FileKind::Linkage,
            Self::Motion(_) => FileKind::Motion,
            Self::Synthesis(_) => FileKind::Synthesis,
            Self::Conditions(_) => FileKind::Conditions,
            Self::Calculus(file) => file.kind(),
        }
    }
}

/// Reads a mechanism of any kind from text; `path` is its name in errors.
///
/// # Errors
/// As [`load_text`].
pub fn any_from_text(text: &str, path: &str, format: Format, options: &Options) -> Result<Any> {
    let (text, name, mut scope) = prepared(text, path, options)?;
    let root = match format {
        Format::Toml => node::from_toml(text, path)?,
        Format::Json => node::from_json(text, path)?,
        Format::Csv | Format::Urdf => {
            return load_text(text, path, format, options).map(|entry| Any::Entry(Box::new(entry)));
        }
    };
    any_of(&mut scope, &root, &name)
}

/// Reads a mechanism of any kind from the values of a file.
fn any_of(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Any> {
    Ok(match FileKind::of(root).map(|(kind, _)| kind) {
        Some(FileKind::Framework) => Any::Framework(Box::new(framework(scope, root, name)?)),
        Some(FileKind::Linkage) => match lives_in(root).as_deref() {
            Some("sphere") => Any::Sphere(Box::new(sphere(scope, root, name)?)),
            Some("space") => Any::Space(Box::new(space(scope, root, name)?)),
            _ => Any::Linkage(Box::new(linkage(scope, root, name)?)),
        },
        Some(FileKind::Motion) => Any::Motion(Box::new(motion(scope, root, name)?)),
        Some(FileKind::Synthesis) => Any::Synthesis(Box::new(synthesis(scope, root, name)?)),
        Some(FileKind::Conditions) => Any::Conditions(Box::new(ansatz(scope, root, name)?)),
        Some(kind @ (FileKind::Displacement | FileKind::Lines | FileKind::Gearing)) => {
            Any::Calculus(Box::new(calculus(scope, root, name, kind)?))
        }
        _ => Any::Entry(Box::new(job::entry(scope, root, name)?)),
    })
}

/// Reads the input of `solve` from text: a linkage, a question of the calculus, else as [`load_text`].
///
/// # Errors
/// As [`load_text`].
pub(super) fn solvable_from_text(text: &str, path: &str, format: Format, options: &Options) -> Result<Any> {
    let (text, name, mut scope) = prepared(text, path, options)?;
    let root = match format {
        Format::Toml => node::from_toml(text, path)?,
        Format::Json => node::from_json(text, path)?,
        Format::Csv | Format::Urdf => {
            return load_text(text, path, format, options).map(|entry| Any::Entry(Box::new(entry)));
        }
    };
    match FileKind::of(&root) {
        Some((FileKind::Displacement | FileKind::Lines | FileKind::Gearing | FileKind::Linkage, _)) => {
            any_of(&mut scope, &root, &name)
        }
        _ => entry_of(&mut scope, &root, &name).map(|entry| Any::Entry(Box::new(entry))),
    }
}

/// Refuses the kinds of files that the reader does not accept.
fn refuse(scope: &Scope<'_>, root: &Node, kinds: &[FileKind], expected: &str) -> Result<()> {
    match FileKind::of(root) {
        Some((kind, line)) if kinds.contains(&kind) => Err(scope.fail(line, kind.unexpected(expected))),
        _ => Ok(()),
    }
}

/// Reads a loop with symbols for parameters from text; `path` is its name in errors.
///
/// # Errors
/// [`Error::File`] with file and line for faults of the text, [`Error::Unsupported`] for loops that are not covered.
pub fn ansatz_from_text(text: &str, path: &str, format: Format, options: &Options) -> Result<Ansatz> {
    let (text, name, mut scope) = prepared(text, path, options)?;
    let root = match format {
        Format::Toml => node::from_toml(text, path)?,
        Format::Json => node::from_json(text, path)?,
        Format::Csv | Format::Urdf => {
            return Err(Error::Unsupported(format!("{path}: conditions are read from TOML or JSON only")));
        }
    };
    let others = [
        FileKind::Arm,
        FileKind::Platform,
        FileKind::Framework,
        FileKind::Linkage,
        FileKind::Motion,
        FileKind::Synthesis,
        FileKind::Displacement,
        FileKind::Lines,
        FileKind::Gearing,
    ];
    refuse(&scope, &root, &others, "a loop, with symbols or numbers")?;
    ansatz(&mut scope, &root, &name)
}

/// Returns whether a text in TOML is an ansatz and no mechanism: whether it has symbols.
#[must_use]
pub fn is_ansatz(text: &str) -> bool {
    text.lines().any(|line| line.trim_start().starts_with("[symbols]"))
}

/// Returns the text without byte-order mark, the name of the mechanism and the state of its reader.
fn prepared<'a>(text: &'a str, path: &'a str, options: &Options) -> Result<(&'a str, String, Scope<'a>)> {
    if !(1..=MOST_DIGITS).contains(&options.digits) {
        return Err(Error::Invalid(format!("found {} digits, expected 1 to {MOST_DIGITS}", options.digits)));
    }
    if text.len() as u64 > LARGEST {
        return Err(too_large(path));
    }
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if text.trim().is_empty() {
        return Err(Error::Invalid("found an empty file, expected a mechanism".to_owned()).at(path, 1));
    }
    if let Some(at) = text.find('\0') {
        let line = node::Lines::new(text).at(at);
        return Err(Error::Invalid("found a zero byte, expected text".to_owned()).at(path, line));
    }
    let name = Path::new(path).file_stem().map_or_else(|| path.to_owned(), |stem| stem.to_string_lossy().into_owned());
    let reading = Reading { digits: options.digits, ..Reading::default() };
    let mut scope = Scope::new(path, reading);
    scope.chains = options.chains;
    scope.claims = options.claims;
    scope.snap = options.snap;
    Ok((text, name, scope))
}

/// Returns the format indicated by the beginning of a text.
pub(super) fn sniffed(text: &str) -> Format {
    let start = text.trim_start_matches('\u{feff}').trim_start();
    if start.starts_with('{') {
        Format::Json
    } else if start.starts_with('<') {
        Format::Urdf
    } else if start.lines().next().is_some_and(|line| line.starts_with("type") && line.contains(',')) {
        Format::Csv
    } else {
        Format::Toml
    }
}

pub(super) fn too_large(name: &str) -> Error {
    Error::Io { path: name.to_owned(), message: "found more than 64 MiB, expected a mechanism file".to_owned() }
}
