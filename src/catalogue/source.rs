//! Where the text of a mechanism comes from, and which reader it goes to.

use super::entry::Entry;
use super::scope::Scope;
use super::{dh_table, job, library, node, urdf};
use crate::algebra::number::{DIGITS, MOST_DIGITS, Reading};
use crate::error::{Error, Result};
use std::io::Read;
use std::path::Path;

/// Largest file read, bytes.
const LARGEST: u64 = 64 << 20;

/// The formats of mechanism files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// equations/README.md.
    Toml,
    /// The same keys as TOML.
    Json,
    /// A DH table with the header `type,a,alpha,d,theta0`.
    Csv,
    /// A robot description, of which a chain between two links is taken.
    Urdf,
}

/// How to read a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// Decimal digits to which irrational angles and numbers are replaced by rationals for exact work.
    pub digits: u32,
    /// URDF: the link at the root of the chain; the root of the robot if none is named.
    pub base_link: Option<String>,
    /// URDF: the link at the end of the chain; the only leaf of the robot if none is named.
    pub tip_link: Option<String>,
}

impl Default for Options {
    /// 15 digits, no links named.
    fn default() -> Self {
        Self { digits: DIGITS, base_link: None, tip_link: None }
    }
}

/// Reads the mechanism named on a command line: a file, `-` for standard input, or a built-in entry.
///
/// # Errors
/// [`Error::Io`] for what cannot be read at all, [`Error::UnknownEntry`] for a name that is neither file nor entry,
/// [`Error::File`] with file and line for what the text says, [`Error::Unsupported`] for kinds not solved yet.
pub fn load(name: &str, options: &Options) -> Result<Entry> {
    let unreadable = |message: String| Error::Io { path: name.to_owned(), message };
    if name == "-" {
        let bytes = bounded(std::io::stdin().lock(), name)?;
        let text = utf8(bytes, name)?;
        return load_text(&text, "standard input", sniffed(&text), options);
    }
    let path = Path::new(name);
    let metadata = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() && !library::has(name) => {
            return Err(unreadable("found a directory, expected a file".to_owned()));
        }
        Ok(metadata) if !metadata.is_dir() => metadata,
        _ if library::has(name) => return library::builtin(name, options),
        Err(fault) if fault.kind() == std::io::ErrorKind::NotFound => {
            return Err(Error::UnknownEntry { name: name.to_owned(), near: library::similar(name) });
        }
        Err(fault) => return Err(unreadable(fault.to_string())),
        Ok(_) => return Err(unreadable("found a directory, expected a file".to_owned())),
    };
    if metadata.len() > LARGEST {
        return Err(too_large(name));
    }
    let file = std::fs::File::open(path).map_err(|fault| unreadable(fault.to_string()))?;
    let text = utf8(bounded(file, name)?, name)?;
    let extension = path.extension().map(|extension| extension.to_string_lossy().to_ascii_lowercase());
    let format = match extension.as_deref() {
        Some("toml") => Format::Toml,
        Some("json") => Format::Json,
        Some("csv") => Format::Csv,
        Some("urdf" | "xml") => Format::Urdf,
        _ => sniffed(&text),
    };
    load_text(&text, name, format, options)
}

/// Reads a mechanism from text; `path` is the name that errors give.
///
/// # Errors
/// As [`load`].
pub fn load_text(text: &str, path: &str, format: Format, options: &Options) -> Result<Entry> {
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
    match format {
        Format::Toml => job::entry(&mut scope, &node::from_toml(text, path)?, &name),
        Format::Json => job::entry(&mut scope, &node::from_json(text, path)?, &name),
        Format::Csv => dh_table::entry(&scope, text, &name),
        Format::Urdf => urdf::entry(&scope, text, &name, options),
    }
}

/// The format that the beginning of a text shows.
fn sniffed(text: &str) -> Format {
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

fn bounded(reader: impl Read, name: &str) -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = reader.take(LARGEST + 1).read_to_end(&mut bytes);
    read.map_err(|fault| Error::Io { path: name.to_owned(), message: fault.to_string() })?;
    if bytes.len() as u64 > LARGEST { Err(too_large(name)) } else { Ok(bytes) }
}

fn utf8(bytes: Vec<u8>, name: &str) -> Result<String> {
    String::from_utf8(bytes).map_err(|fault| {
        let valid = fault.utf8_error().valid_up_to();
        let line = String::from_utf8_lossy(&fault.as_bytes()[..valid]).matches('\n').count() + 1;
        Error::Invalid("found bytes that are not UTF-8, expected text".to_owned()).at(name, line)
    })
}

fn too_large(name: &str) -> Error {
    Error::Io { path: name.to_owned(), message: "found more than 64 MiB, expected a mechanism file".to_owned() }
}
