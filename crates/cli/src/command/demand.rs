//! The demands of the command line on an arm besides its pose.

use super::arguments::DemandOptions;
use looproot::internal::catalogue::entry::{Entry, Kind};
use looproot::internal::error::Error;
use looproot::internal::kinematics::chain::Chain;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::screws::Held;
use looproot::internal::kinematics::task::{Demand, TASKS, Task};
use looproot::internal::report::document;
use looproot_algebra::number::{Angle, Number, Quantity};

/// Returns the task and the locked joints.
pub fn demand(options: &DemandOptions, entry: &Entry) -> Result<Demand, Error> {
    let given = [("--lock", !options.lock.is_empty()), ("--task", options.task.is_some())];
    if let (Some((name, _)), true) = (given.iter().find(|(_, is_given)| *is_given), entry.kind() != Kind::Arm) {
        return Err(Error::Invalid(format!("found {name}, expected it for an arm only")));
    }
    let task = match &options.task {
        None => Task::Pose,
        Some(word) => TASKS.iter().find(|(name, _)| name == word).map(|(_, task)| *task).ok_or_else(|| {
            let names: Vec<&str> = TASKS.iter().map(|(name, _)| *name).collect();
            Error::Invalid(format!("found --task {word}, expected one of {}", names.join(", ")))
        })?,
    };
    let mut held: Vec<(usize, Held)> = Vec::new();
    for text in &options.lock {
        let (joint, value) = locked(text, entry).map_err(|fault| fault.of_option(&format!("--lock {text}")))?;
        if held.iter().any(|(own, _)| *own == joint) {
            return Err(Error::Invalid(format!("found --lock {text}, expected every joint once")));
        }
        held.push((joint, value));
    }
    held.sort_by_key(|(joint, _)| *joint);
    Ok(Demand { task, held })
}

/// Reads a joint variable and the value at which it is locked.
fn locked(text: &str, entry: &Entry) -> Result<(usize, Held), Error> {
    let labels = document::labels(entry);
    let variables = entry.chain().map(Chain::variables).unwrap_or_default();
    let known = || {
        let names: Vec<String> = labels.iter().enumerate().map(|(k, label)| format!("{} ({label})", k + 1)).collect();
        names.join(", ")
    };
    let Some((name, value)) = text.rsplit_once('=') else {
        return Err(Error::Invalid(format!("found --lock {text}, expected NAME=VALUE, the name one of {}", known())));
    };
    let name = name.trim();
    let by_number = || name.parse::<usize>().ok()?.checked_sub(1).filter(|k| *k < labels.len());
    let by_name = |k: &usize| variables[*k].name() == name;
    let joint = labels.iter().position(|label| label == name).or_else(by_number);
    let joint = joint
        .or_else(|| (0..variables.len()).find(by_name))
        .ok_or_else(|| Error::Invalid(format!("found no joint `{name}` for --lock, expected one of {}", known())))?;
    let held = match variables[joint].variable {
        Variable::Rotation => Held::Angle(Angle::parse(value.trim(), &entry.reading)?),
        Variable::Translation => Held::Distance(Number::parse(value.trim(), Quantity::Length, &entry.reading)?),
    };
    Ok((joint, held))
}
