//! Sorts the files of the mechanisms that are embedded: a program that shows no derived equations does not contain them, and none
//! contains the schemas and the atlas. It also rebuilds the crate when they change, which `include_dir` cannot ask for itself.

use std::path::{Path, PathBuf};
use std::{env, fs, io};

/// The folder that a file of `equations` is embedded with; `None` for a file that the program does not read.
fn part(file: &Path) -> Option<&'static str> {
    match file.extension()?.to_str()? {
        "eqs" => Some("pages"),
        "toml" => Some("mechanisms"),
        _ => (file.ends_with("robots.json") || file.ends_with("REFERENCES.md")).then_some("mechanisms"),
    }
}

/// Copies what is below a folder, path by path.
fn copy(folder: &Path, below: &Path, target: &Path) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let file = below.join(path.file_name().unwrap_or_default());
        if path.is_dir() {
            copy(&path, &file, target)?;
        } else if let Some(part) = part(&path) {
            let place = target.join(part).join(file);
            if let Some(folder) = place.parent() {
                fs::create_dir_all(folder)?;
            }
            fs::copy(path, place)?;
        }
    }
    Ok(())
}

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=equations");
    let target = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    for part in ["mechanisms", "pages"] {
        // What was embedded before may have been removed since.
        if target.join(part).exists() {
            fs::remove_dir_all(target.join(part))?;
        }
        fs::create_dir_all(target.join(part))?;
    }
    copy(Path::new("equations"), Path::new(""), &target)
}
