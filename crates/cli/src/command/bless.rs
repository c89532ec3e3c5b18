//! `looproot derive --bless`: the atlas of closure equations, a `.eqs` file beside every mechanism file.

use super::check::files;
use super::exit::{Exit, Fault, complain};
use super::output::print;
use looproot::internal::catalogue::{Any, Options, load_any, load_solvable};
use looproot::internal::error::{Error, Result};
use looproot::internal::report::atlas::{HEAD, linkage_row, page, row, space_row, sphere_row};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes the equations of all files under these paths; a file that is up to date is left alone.
pub fn run(paths: &[String], quiet: bool) -> std::result::Result<Exit, Fault> {
    let mut exit = Exit::Complete;
    for name in files(paths)? {
        match blessed(Path::new(&name)) {
            Ok(what) if !quiet => print(&format!("{name}: {what}\n"))?,
            Ok(_) => {}
            Err(error) => {
                complain(&error.to_string());
                exit = exit.max(Exit::of_error(&error));
            }
        }
    }
    Ok(exit)
}

/// Prints a Markdown table of the derivations of all files under these paths, with names relative to the first path.
pub fn table(paths: &[String]) -> std::result::Result<Exit, Fault> {
    print(HEAD)?;
    let root = paths.first().map_or_else(PathBuf::new, PathBuf::from);
    for file in files(paths)? {
        let path = Path::new(&file).with_extension("");
        let name = path.strip_prefix(&root).unwrap_or(&path).display().to_string();
        let has_page = path.with_extension("eqs").exists();
        match load_solvable(&file, &Options::default()) {
            Ok(Any::Entry(entry)) => print(&row(&entry, &name, has_page))?,
            Ok(Any::Linkage(file)) => print(&linkage_row(&file, &name, has_page))?,
            Ok(Any::Sphere(file)) => print(&sphere_row(&file, &name, has_page))?,
            Ok(Any::Space(file)) => print(&space_row(&file, &name, has_page))?,
            // Frameworks and other files have no closure polynomial.
            _ => {}
        }
    }
    Ok(Exit::Complete)
}

/// Writes the equations of one file, and returns a report.
fn blessed(path: &Path) -> Result<String> {
    let fault = |path: &Path, message: String| Error::Io { path: path.display().to_string(), message };
    if path.extension().is_none_or(|extension| extension != "toml") {
        return Err(fault(path, "is no name.toml, beside which name.eqs could stand".to_owned()));
    }
    let target = path.with_extension("eqs");
    let text = match page(&load_any(&path.display().to_string(), &Options::default())?) {
        Ok(text) => text,
        Err(error) => {
            return error.unsupported().map(|reason| format!("no equations, {reason}")).ok_or(error.clone());
        }
    };
    let before = fs::read_to_string(&target).ok();
    match (text, before) {
        (None, None) => Ok("there are no equations, or they are longer than two pages".to_owned()),
        (None, Some(_)) => Err(fault(
            &target,
            "should not be there: there are no equations, or they are longer than two pages".to_owned(),
        )),
        (Some(text), Some(before)) if text == before => Ok("up to date".to_owned()),
        (Some(text), _) => {
            write(&target, &text).map_err(|error| fault(&target, error.to_string()))?;
            Ok(format!("{} written", target.display()))
        }
    }
}

/// Writes a file so that a reader sees the old text or the new one, never a part.
fn write(target: &Path, text: &str) -> std::io::Result<()> {
    let beside: PathBuf = target.with_extension(format!("eqs.{}", std::process::id()));
    fs::write(&beside, text)?;
    fs::rename(&beside, target).inspect_err(|_| {
        // The error of the renaming matters more than a leftover file.
        let _ = fs::remove_file(&beside);
    })
}
