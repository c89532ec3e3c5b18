//! What stands above every mechanism: its title, its source, remarks, the units.

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
    /// Where it comes from.
    pub source: Option<Source>,
    /// Remarks of the file.
    pub notes: Option<String>,
}

/// Reads the head of a file with a `[mechanism]` and `[expected]`; units are set for what is read behind it.
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
