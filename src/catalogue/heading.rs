//! The head of every mechanism file: title, source, remarks, units.

use super::entry::Source;
use super::job::{source, units};
use super::node::Node;
use super::scope::Scope;
use crate::error::Result;

/// The head of a file whose mechanism is no arm, loop or platform.
#[derive(Clone, Debug, PartialEq)]
pub struct Heading {
    /// The file's own name without extension, or a built-in entry's name.
    pub name: String,
    /// One line that names the mechanism.
    pub title: String,
    /// The publication it is taken from.
    pub source: Option<Source>,
    /// Remarks of the file.
    pub notes: Option<String>,
}

/// Reads the head of a file with `[mechanism]` and `[expected]`; its units apply to everything read afterwards.
pub(super) fn heading(scope: &mut Scope<'_>, root: &Node, name: &str) -> Result<Heading> {
    heading_with(scope, root, name, &[])
}

/// Reads the head of a file that may have these further keys.
pub(super) fn heading_with(scope: &mut Scope<'_>, root: &Node, name: &str, more: &[&str]) -> Result<Heading> {
    let keys = [&["title", "source", "notes", "units", "mechanism", "expected"], more].concat();
    let table = scope.table(root, "the file", &keys)?;
    if let Some(node) = table.get("units") {
        units(scope, node)?;
    }
    let text = |key: &str| table.get(key).map(|node| scope.text(node, key).map(str::to_owned)).transpose();
    Ok(Heading {
        name: name.to_owned(),
        title: text("title")?.unwrap_or_else(|| name.to_owned()),
        source: table.get("source").map(|node| source(scope, node)).transpose()?,
        notes: text("notes")?,
    })
}
