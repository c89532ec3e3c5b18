//! `looproot view --live`: the page, the file and the program in one.

use super::arguments::{Limits, SolveOptions, ViewOptions};
use super::exit::Fault;
use looproot::internal::catalogue::entry::Kind;
use looproot::internal::catalogue::{Chains, load};
use looproot::internal::error::Error;
use looproot::internal::kinematics::joint::Variable;
use looproot::internal::view::{Live, Program};
use serde_json::Value;
use std::path::Path;

/// The name for a file whose own name would be misread.
const PLAIN: &str = "mechanism";

/// Returns the same options with a default problem, if neither the command line nor the file gives one: the first of several
/// cases; for an arm without poses the pose at joint values 0.5 (radians or metres); for a loop without input its first joint at
/// that value.
pub fn begun(options: &ViewOptions) -> Option<ViewOptions> {
    let asked = &options.solve.asked;
    if asked.pose.is_some()
        || asked.input.is_some()
        || asked.joints.is_some()
        || asked.legs.is_some()
        || asked.at.is_some()
    {
        return None;
    }
    let mut read = options.solve.read.options();
    read.chains = Chains::Swept;
    // Faults of the file are reported by its solver.
    let entry = load(&options.solve.mechanism, &read).ok()?;
    let mut begun = options.clone();
    let first = entry.cases.first();
    if first.is_some_and(|case| !case.input.is_empty()) {
        begun.solve.asked.input = Some("1".to_owned());
    } else if first.is_some() {
        begun.solve.asked.pose = Some(1);
    } else {
        let variables = entry.chain()?.variables();
        let mut values = variables.iter().map(|own| match own.variable {
            Variable::Rotation => "0.5 rad",
            Variable::Translation => "0.5 m",
        });
        match entry.kind() {
            Kind::Loop => begun.solve.asked.input = Some(format!("1={}", values.next()?)),
            Kind::Arm => begun.solve.asked.joints = Some(values.collect::<Vec<_>>().join(", ")),
            Kind::Platform => return None,
        }
    }
    Some(begun)
}

/// Returns the data with which a live page solves: the command that it runs, its files, and the program.
pub fn live(options: &ViewOptions, document: &Value) -> Result<Live, Fault> {
    let solve = &options.solve;
    let mut live = Live { program: program()?, ..Live::default() };
    let name = embedded(&mut live, &solve.mechanism)?;
    live.arguments = vec!["view".to_owned(), name, "--parts".to_owned()];
    let mut add = |words: &[&str]| live.arguments.extend(words.iter().map(|word| (*word).to_owned()));
    for (flag, is_set) in
        [("--complex", solve.complex), ("--real", solve.real), ("--turns", solve.turns), ("--snap", solve.read.snap)]
    {
        if is_set {
            add(&[flag]);
        }
    }
    if solve.limits == Limits::Drop {
        add(&["--limits", "drop"]);
    }
    for (option, value) in values(solve) {
        add(&[&format!("{option}={value}")]);
    }
    // The links of the chain, so that the page need not determine them again.
    for (option, key) in [("--base-link", "base_link"), ("--tip-link", "tip_link")] {
        if let Some(link) = document[key].as_str() {
            add(&[&format!("{option}={link}")]);
        }
    }
    Ok(live)
}

/// Returns the options that have a value, as they were given.
fn values(solve: &SolveOptions) -> Vec<(&'static str, String)> {
    let mut found: Vec<(&str, String)> = solve.demand.lock.iter().map(|lock| ("--lock", lock.clone())).collect();
    let texts = [("--task", &solve.demand.task), ("--near", &solve.near), ("--tolerance", &solve.tolerance)];
    found.extend(texts.into_iter().filter_map(|(option, value)| Some((option, value.clone()?))));
    found.extend(solve.seed.map(|seed| ("--seed", seed.to_string())));
    found.push(("--digits", solve.read.numbers.digits.to_string()));
    found
}

/// Returns the name by which the page reads the mechanism: that of an entry of the library, or the last part of a file's name,
/// whose text is embedded.
fn embedded(live: &mut Live, mechanism: &str) -> Result<String, Fault> {
    let path = Path::new(mechanism);
    if !path.is_file() {
        return Ok(mechanism.to_owned());
    }
    let fault = |error: std::io::Error| Error::Io { path: mechanism.to_owned(), message: error.to_string() };
    let text = std::fs::read_to_string(path).map_err(fault)?;
    let last = path.file_name().and_then(|name| name.to_str()).unwrap_or(PLAIN);
    let name = if last.starts_with('-') { format!("{PLAIN}{last}") } else { last.to_owned() };
    live.files.push((name.clone(), text));
    Ok(name)
}

/// Returns the program from the places of `web/build` and an installation: beside the folder of this program in `browser`, beside
/// this program, or in `share/looproot`. In a browser there is none: the window around the page has it.
fn program() -> Result<Option<Program>, Fault> {
    const MODULE: &str = "looproot.wasm.gz";
    const VIEWER: &str = "viewer.min.js.gz";
    if cfg!(target_family = "wasm") {
        return Ok(None);
    }
    let folder = std::env::current_exe().ok().and_then(|path| path.parent().map(Path::to_path_buf)).unwrap_or_default();
    let mut places = ["../browser", ".", "../share/looproot"].iter().map(|place| folder.join(place));
    let Some(place) = places.find(|place| place.join(MODULE).is_file() && place.join(VIEWER).is_file()) else {
        let message = format!(
            "found no {MODULE} with {VIEWER} in {}, expected the program as WebAssembly: web/build makes it from the sources",
            folder.join("../browser").display()
        );
        return Err(Error::Invalid(message).into());
    };
    let read = |name: &str| {
        let path = place.join(name);
        std::fs::read(&path).map_err(|error| Error::Io { path: path.display().to_string(), message: error.to_string() })
    };
    Ok(Some(Program { module: read(MODULE)?, viewer: read(VIEWER)? }))
}
