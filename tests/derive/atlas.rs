//! The atlas of closure equations: text beside every mechanism whose equations fit two pages.

use crate::run;
use looproot::catalogue::{Options, load};
use looproot::report::atlas::atlas;
use std::fs;
use std::path::PathBuf;

fn entries() -> Vec<PathBuf> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("equations");
    let folders = fs::read_dir(root).unwrap().map(|item| item.unwrap().path()).filter(|path| path.is_dir());
    let files = folders.flat_map(|folder| fs::read_dir(folder).unwrap().map(|item| item.unwrap().path()));
    let mut files: Vec<PathBuf> = files.filter(|path| path.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    files
}

#[test]
fn the_atlas_is_what_is_derived() {
    let mut pages = 0;
    for path in entries() {
        let Ok(kept) = fs::read_to_string(path.with_extension("eqs")) else { continue };
        let name = path.display().to_string();
        let derived = atlas(&load(&name, &Options::default()).unwrap()).unwrap();
        assert!(derived.as_ref() == Some(&kept), "{name}: looproot derive --bless equations");
        pages += 1;
    }
    assert!(pages >= 70, "{pages} pages");
}

#[test]
fn blessing_writes_beside_the_file_and_nowhere_else() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("bless");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("inner")).unwrap();
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("equations");
    for (from, to) in [("loop/cccr_1_angle.toml", "one.toml"), ("arm/general_16real.toml", "inner/long.toml")] {
        fs::copy(root.join(from), folder.join(to)).unwrap();
    }
    let before = fs::read(folder.join("one.toml")).unwrap();
    let path = folder.display().to_string();
    let (code, out, err) = run(&["derive", "--bless", &path]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(out.contains("one.eqs written") && out.contains("long.toml: the equations are longer than two pages"));
    let written = fs::read_to_string(folder.join("one.eqs")).unwrap();
    assert_eq!(written, fs::read_to_string(root.join("loop/cccr_1_angle.eqs")).unwrap());
    assert_eq!(before, fs::read(folder.join("one.toml")).unwrap());
    let names = |folder: &PathBuf| fs::read_dir(folder).unwrap().count();
    assert_eq!((names(&folder), names(&folder.join("inner"))), (3, 1));
    let (code, out, _) = run(&["derive", "--bless", &path]);
    assert!(code == 0 && out.contains("one.toml: up to date"), "{out}");
    fs::write(folder.join("inner/long.eqs"), "").unwrap();
    let (code, _, err) = run(&["derive", "--bless", &path, "-q"]);
    assert!(code == 1 && err.contains("long.eqs: should not be there"), "{err}");
    let (code, _, err) = run(&["derive", "--bless", "cccr_1_angle"]);
    assert!(code == 1 && err.contains("no name.toml"), "{err}");
    let (code, _, err) = run(&["derive", "cccr_1_angle", "rssr"]);
    assert!(code == 1 && err.contains("2 mechanisms"), "{err}");
}
