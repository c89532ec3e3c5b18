//! Loads the text of a mechanism from a file, standard input, or the library.

use super::ansatz::Ansatz;
use super::entry::Entry;
use super::library;
use super::options::Options;
use super::text::{
    Any, Format, LARGEST, ansatz_from_text, any_from_text, load_text, sniffed, solvable_from_text, too_large,
};
use crate::error::{Error, Result};
use std::io::Read;
use std::path::Path;

/// Reads the mechanism named on a command line: a file, `-` for standard input, or a built-in entry.
///
/// # Errors
/// [`Error::Io`] if nothing can be read, [`Error::UnknownEntry`] for a name that is neither file nor entry,
/// [`Error::File`] with file and line for faults of the text, [`Error::Unsupported`] for kinds not solved yet.
pub fn load(name: &str, options: &Options) -> Result<Entry> {
    match text_of(name, || library::has(name))? {
        Some((text, path, format)) => load_text(&text, path, format, options),
        None => library::builtin(name, options),
    }
}

/// Reads the input of `solve` named on a command line: a file, `-` for standard input, or a built-in entry.
///
/// # Errors
/// As [`load`].
pub fn load_solvable(name: &str, options: &Options) -> Result<Any> {
    if let Some((text, path, format)) = text_of(name, || library::has(name))? {
        return solvable_from_text(&text, path, format, options);
    }
    match library::builtin_calculus(name, options) {
        Some(found) => found,
        None => library::builtin(name, options).map(|entry| Any::Entry(Box::new(entry))),
    }
}

/// Reads the mechanism of any kind named on a command line: a file, `-` for standard input, or one of the library.
///
/// # Errors
/// As [`load`].
pub fn load_any(name: &str, options: &Options) -> Result<Any> {
    match text_of(name, || library::has(name))? {
        Some((text, path, format)) => any_from_text(&text, path, format, options),
        None => library::builtin_any(name, options),
    }
}

/// Reads the loop with symbols named on a command line: a file, `-` for standard input, or one of the library.
///
/// # Errors
/// As [`load`].
pub fn load_ansatz(name: &str, options: &Options) -> Result<Ansatz> {
    let built_in = library::builtin_ansatz(name, options);
    match (text_of(name, || built_in.is_some())?, built_in) {
        (Some((text, path, format)), _) => ansatz_from_text(&text, path, format, options),
        (None, Some(found)) => found,
        (None, None) => Err(library::unknown(name)),
    }
}

/// Returns the text of a file or of standard input, its name in errors, and its format; `None` if nothing has
/// this name. The library is asked only where no file has it.
fn text_of(name: &str, is_built_in: impl Fn() -> bool) -> Result<Option<(String, &str, Format)>> {
    let unreadable = |message: String| Error::Io { path: name.to_owned(), message };
    if name == "-" {
        let bytes = bounded(std::io::stdin().lock(), name)?;
        let text = utf8(bytes, name)?;
        let format = sniffed(&text);
        return Ok(Some((text, "standard input", format)));
    }
    let path = Path::new(name);
    let metadata = match std::fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() && !is_built_in() => {
            return Err(unreadable("found a directory, expected a file".to_owned()));
        }
        Ok(metadata) if !metadata.is_dir() => metadata,
        _ if is_built_in() => return Ok(None),
        Err(fault) if fault.kind() == std::io::ErrorKind::NotFound => return Ok(None),
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
        Some("urdf" | "xml" | "mjcf") => Format::Urdf,
        _ => sniffed(&text),
    };
    Ok(Some((text, name, format)))
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
