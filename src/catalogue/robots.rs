//! The robots of the library: the arms of equations/robots.json, which have no poses of their own.

use super::entry::Entry;
use super::library;
use super::options::{Chains, Options};
use super::text::{Format, load_text};
use crate::error::Result;
use serde_json::Value;

/// Real robots among the entries of the folder `arm`.
const ENTRIES: [&str; 11] =
    ["crx10ia", "iiwa14", "jaco_j2n6", "kr5", "kr6_r900", "puma560", "ur10", "ur10e", "ur3e", "ur5", "ur5e"];

/// Returns the robots of the file, each a mechanism file with a name.
fn all() -> Vec<Value> {
    let text = library::file("robots.json").unwrap_or("[]");
    serde_json::from_str(text).unwrap_or_default()
}

fn name(robot: &Value) -> &str {
    robot["name"].as_str().unwrap_or_default()
}

/// Returns the names of all robots, in order.
#[must_use]
pub fn robot_names() -> Vec<String> {
    let entries = ENTRIES.iter().map(|name| (*name).to_owned());
    let mut names: Vec<String> = all().iter().map(|robot| name(robot).to_owned()).chain(entries).collect();
    names.sort();
    names
}

/// Returns whether there is a robot of this name beside the entries.
pub(super) fn has(wanted: &str) -> bool {
    all().iter().any(|robot| name(robot) == wanted)
}

/// Returns the robot of this name beside the entries; it has no pose.
pub(super) fn robot(wanted: &str, options: &Options) -> Option<Result<Entry>> {
    let mut robot = all().into_iter().find(|robot| name(robot) == wanted)?;
    robot.as_object_mut()?.remove("name");
    let chains = if options.chains == Chains::Solved { Chains::Swept } else { options.chains };
    let options = Options { chains, ..options.clone() };
    let path = format!("equations/robots/{wanted}.json");
    Some(load_text(&robot.to_string(), &path, Format::Json, &options))
}
