//! The built-in library: the files of equations/ that the program reads, embedded as `build.rs` sorts them.

use super::ansatz::Ansatz;
use super::entry::Entry;
use super::options::{Chains, Options};
use super::robots;
use super::scope::nearest;
use super::text::{Any, Format, ansatz_from_text, any_from_text, load_text};
use crate::algebra::sort;
use crate::error::{Error, Result};
use include_dir::{Dir, DirEntry, File, include_dir};
use std::sync::OnceLock;

static LIBRARY: Dir<'static> = include_dir!("$OUT_DIR/mechanisms");

/// The derived equations, apart from the rest: what does not show them does not contain them.
static PAGES: Dir<'static> = include_dir!("$OUT_DIR/pages");

/// The folder of the loops with symbols, which cannot be solved as mechanisms.
const CONDITIONS: &str = "conditions/";

/// The folders of frameworks, linkages, rational motions and syntheses, which are not single chains.
const MOVING: [&str; 4] = ["framework/", "linkage/", "motion/", "synthesis/"];

/// The folders of questions about displacements, gears and lines.
const CALCULUS: [&str; 3] = ["displacement/", "gearing/", "lines/"];

/// Loops that were moved to another folder: the old and new beginnings of their full names.
const MOVED: [(&str, &str); 2] = [("loop/structure_", "chain/structure_"), ("loop/ik_", "chain/ik_")];

/// Returns the names of all built-in frameworks, linkages, rational motions and syntheses, such as `framework/steffen`, in order.
#[must_use]
pub fn moving_names() -> Vec<String> {
    chosen(is_moving)
}

/// Returns the names that are chosen, in order.
fn chosen(is_chosen: impl Fn(&str) -> bool) -> Vec<String> {
    names().iter().filter(|name| is_chosen(name)).cloned().collect()
}

fn is_moving(name: &str) -> bool {
    MOVING.iter().any(|folder| name.starts_with(folder))
}

/// Returns the names of all built-in questions about displacements and lines, such as `lines/transversals`, in order.
#[must_use]
pub fn calculus_names() -> Vec<String> {
    chosen(is_calculus)
}

fn is_calculus(name: &str) -> bool {
    CALCULUS.iter().any(|folder| name.starts_with(folder))
}

/// Returns the names of all built-in entries, such as `arm/puma560`, in order.
#[must_use]
pub fn builtin_names() -> Vec<String> {
    chosen(is_entry)
}

fn is_entry(name: &str) -> bool {
    !is_ansatz(name) && !is_moving(name) && !is_calculus(name)
}

/// Returns the names of all built-in loops with symbols, such as `conditions/bennett`, in order.
#[must_use]
pub fn ansatz_names() -> Vec<String> {
    chosen(is_ansatz)
}

fn is_ansatz(name: &str) -> bool {
    name.starts_with(CONDITIONS)
}

/// Returns the names of everything in the library, such as `motion/bennett`, in order.
#[must_use]
pub fn all_names() -> Vec<String> {
    names().to_vec()
}

/// The files of mechanisms of everything in the library.
struct Shelf {
    /// Their names, in order.
    names: Vec<String>,
    /// The files in the same order: a search by path would compare it with all of them.
    files: Vec<&'static File<'static>>,
}

/// The files of the library, collected once.
fn shelf() -> &'static Shelf {
    static SHELF: OnceLock<Shelf> = OnceLock::new();
    SHELF.get_or_init(|| {
        let mut found = Vec::new();
        collect(&LIBRARY, &mut found);
        sort::by(&mut found, |(a, _), (b, _)| a.cmp(b));
        let (names, files) = found.into_iter().unzip();
        Shelf { names, files }
    })
}

/// The names of everything in the library, in order.
fn names() -> &'static [String] {
    &shelf().names
}

fn collect(folder: &'static Dir<'static>, found: &mut Vec<(String, &'static File<'static>)>) {
    for entry in folder.entries() {
        match entry {
            DirEntry::Dir(folder) => collect(folder, found),
            DirEntry::File(file) => {
                if let Some(name) = file.path().to_str().and_then(|path| path.strip_suffix(".toml")) {
                    found.push((name.replace('\\', "/"), file));
                }
            }
        }
    }
}

/// Returns the full names in the library for a name without its folder: more than one if folders share it.
///
/// # Example
/// ```
/// assert_eq!(looproot::internal::catalogue::namesakes("bennett"), ["conditions/bennett", "motion/bennett"]);
/// assert_eq!(looproot::internal::catalogue::namesakes("motion/bennett"), ["motion/bennett"]);
/// ```
#[must_use]
pub fn namesakes(name: &str) -> Vec<String> {
    let name = today(name.strip_suffix(".toml").unwrap_or(name));
    chosen(|full| is_called(full, &name))
}

/// Returns the present name of an entry that was once in another folder.
fn today(name: &str) -> String {
    let moved = MOVED.iter().find_map(|(old, new)| Some(format!("{new}{}", name.strip_prefix(old)?)));
    moved.unwrap_or_else(|| name.to_owned())
}

/// Returns whether a full name is this one, with or without its folder.
fn is_called(full: &str, name: &str) -> bool {
    full == name || full.rsplit('/').next() == Some(name)
}

/// Returns the text in the library for this name, with or without its folder, and its full name. Entries come first, as
/// other files may share their names.
fn find(name: &str) -> Option<(String, &'static str)> {
    [is_entry, is_moving, is_calculus, is_ansatz].into_iter().find_map(|is_kind| find_in(is_kind, name))
}

/// [`find`] among the names of one kind.
fn find_in(is_kind: fn(&str) -> bool, name: &str) -> Option<(String, &'static str)> {
    let name = name.strip_suffix(".toml").unwrap_or(name);
    let name = &today(name);
    let place = names().iter().position(|full| is_called(full, name) && is_kind(full))?;
    Some((names()[place].clone(), shelf().files[place].contents_utf8()?))
}

/// Returns the text of a file of the library, with or without its folder; `None` for an unknown name.
#[must_use]
pub fn builtin_text(name: &str) -> Option<&'static str> {
    find(name).map(|(_, text)| text)
}

/// Returns the derived equations that the library holds for an entry, with or without its folder, and the name of their file.
#[must_use]
pub fn builtin_page(name: &str) -> Option<(String, &'static str)> {
    let (full, _) = find(name)?;
    let file = format!("{full}.eqs");
    let text = PAGES.get_file(&file)?.contents_utf8()?;
    Some((format!("equations/{file}"), text))
}

/// Returns the citation for a key of equations/REFERENCES.md, on one line; `None` for an unknown key.
///
/// # Example
/// ```
/// let citation = looproot::internal::catalogue::citation("LeeLiang1988").unwrap();
/// assert!(citation.starts_with("H.-Y. Lee"));
/// ```
#[must_use]
pub fn citation(key: &str) -> Option<String> {
    let text = LIBRARY.get_file("REFERENCES.md")?.contents_utf8()?;
    let item = format!("- `[{key}]`");
    let mut lines = text.lines().skip_while(|line| !line.starts_with(&item));
    let mut citation = lines.next()?[item.len()..].trim().to_owned();
    for line in lines.take_while(|line| line.starts_with("  ")) {
        citation.push(' ');
        citation.push_str(line.trim());
    }
    Some(citation)
}

/// Returns the built-in loop with symbols of this name, with or without its folder, else any other file of that name.
pub(super) fn builtin_ansatz(name: &str, options: &Options) -> Option<Result<Ansatz>> {
    let (full, text) = find_in(is_ansatz, name).or_else(|| find(name))?;
    Some(ansatz_from_text(text, &format!("equations/{full}.toml"), Format::Toml, options))
}

/// Returns the built-in question of this name, with or without its folder, unless an entry has that name.
pub(super) fn builtin_calculus(name: &str, options: &Options) -> Option<Result<Any>> {
    let (full, text) = find(name).filter(|(full, _)| is_calculus(full) || full.starts_with("linkage/"))?;
    Some(any_from_text(text, &format!("equations/{full}.toml"), Format::Toml, options))
}

/// Returns the library's file of this name, with or without its folder.
///
/// # Errors
/// [`Error::UnknownEntry`] with similar names.
pub fn builtin_any(name: &str, options: &Options) -> Result<Any> {
    let Some((full, text)) = find(name) else {
        let robot = robots::robot(name, options).ok_or_else(|| unknown(name))??;
        return Ok(Any::Entry(Box::new(robot)));
    };
    any_from_text(text, &format!("equations/{full}.toml"), Format::Toml, options)
}

/// Returns whether the library has a file of this name.
pub(super) fn has(name: &str) -> bool {
    find(name).is_some() || robots::has(name)
}

/// Returns the text of a file of the library.
pub(super) fn file(name: &str) -> Option<&'static str> {
    LIBRARY.get_file(name)?.contents_utf8()
}

/// Returns the error for a name that the library does not have, with similar names.
pub(super) fn unknown(name: &str) -> Error {
    let names = [all_names(), robots::robot_names()].concat();
    let known = || names.iter().flat_map(|full| [full.as_str(), full.rsplit('/').next().unwrap_or(full)]);
    let mut near = nearest(name, known());
    // Robots stand in no folder.
    if let (true, Some((_, own))) = (near.is_empty(), name.rsplit_once('/')) {
        near = nearest(own, known());
    }
    Error::UnknownEntry { name: name.to_owned(), near }
}

/// Returns the built-in entry of a name, with or without its folder: `puma560` or `arm/puma560`.
///
/// # Errors
/// [`Error::UnknownEntry`] with similar names, [`Error::File`] if it is no arm, loop or platform.
///
/// # Example
/// ```
/// let puma = looproot::internal::catalogue::builtin("puma560", &Default::default())?;
/// assert_eq!(puma.name, "puma560");
/// # Ok::<(), looproot::internal::error::Error>(())
/// ```
pub fn builtin(name: &str, options: &Options) -> Result<Entry> {
    let Some((full, text)) = find(name) else {
        return robots::robot(name, options).ok_or_else(|| unknown(name))?;
    };
    // Claims are about the poses of the file. Those of the library are tested, so that reading them would find no error either.
    let options = Options { claims: options.claims && options.chains != Chains::Swept, ..options.clone() };
    load_text(text, &format!("equations/{full}.toml"), Format::Toml, &options)
}
