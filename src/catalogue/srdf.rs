//! Planning groups of semantic robot descriptions (SRDF) and the end links of their chains.

use super::options::Options;
use super::scope::Scope;
use super::text::LARGEST;
use super::urdf::{child, line, parse};
use crate::algebra::number::Reading;
use crate::error::{Error, Result};
use roxmltree::Node as Element;
use std::path::Path;

/// The links at the ends of a group.
#[derive(Default)]
pub(super) struct Ends {
    pub(super) base: Option<String>,
    pub(super) tip: Option<String>,
}

/// Deepest nesting of groups that is followed.
const DEEPEST: usize = 8;

/// Returns the ends of the chain of a planning group; `ends_of` gives parent and child of a joint of the robot.
pub(super) fn ends<'a>(path: &Path, group: &str, ends_of: &dyn Fn(&str) -> Option<(&'a str, &'a str)>) -> Result<Ends> {
    let shown = path.display().to_string();
    let unreadable = |message: String| Error::Io { path: shown.clone(), message };
    let size = std::fs::metadata(path).map_err(|fault| unreadable(fault.to_string()))?.len();
    if size > LARGEST {
        return Err(super::text::too_large(&shown));
    }
    let text = std::fs::read_to_string(path).map_err(|fault| unreadable(fault.to_string()))?;
    let scope = Scope::new(&shown, Reading { digits: Options::default().digits, ..Reading::default() });
    let document = parse(&scope, &text)?;
    of_group(&scope, document.root_element(), group, ends_of, 0)
}

fn of_group<'a>(
    scope: &Scope<'_>,
    root: Element<'_, '_>,
    name: &str,
    ends_of: &dyn Fn(&str) -> Option<(&'a str, &'a str)>,
    depth: usize,
) -> Result<Ends> {
    let groups = || root.children().filter(|element| element.has_tag_name("group"));
    let Some(group) = groups().find(|group| group.attribute("name") == Some(name)) else {
        let known: Vec<&str> = groups().filter_map(|group| group.attribute("name")).collect();
        let message = format!("found no group `{name}`, expected one of {}", known.join(", "));
        return Err(scope.fail(line(root), message));
    };
    if let Some(chain) = child(group, "chain") {
        let end = |key: &str| chain.attribute(key).map(str::to_owned);
        return Ok(Ends { base: end("base_link"), tip: end("tip_link") });
    }
    let joints: Vec<(&str, &str)> = group
        .children()
        .filter(|element| element.has_tag_name("joint"))
        .filter_map(|joint| ends_of(joint.attribute("name")?))
        .collect();
    let inner = child(group, "group").and_then(|inner| inner.attribute("name"));
    match (joints.first(), joints.last(), inner) {
        (Some((base, _)), Some((_, tip)), _) => {
            Ok(Ends { base: Some((*base).to_owned()), tip: Some((*tip).to_owned()) })
        }
        (_, _, Some(inner)) if depth < DEEPEST => of_group(scope, root, inner, ends_of, depth + 1),
        _ => {
            let message =
                format!("found the group `{name}` without a chain and without joints of the robot, expected one");
            Err(scope.fail(line(group), message))
        }
    }
}
