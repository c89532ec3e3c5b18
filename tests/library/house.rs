//! The rules of the house that a compiler does not know.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The modules of the library, each importing earlier ones only; `algebra` is a crate of its own below them.
const LAYERS: [&str; 29] = [
    "error",
    "algebra",
    "kinematics",
    "catalogue",
    "certificate",
    "closure",
    "elimination",
    "solve",
    "certify",
    "exact",
    "assembly",
    "verdict",
    "mechanism",
    "displacement",
    "gearing",
    "lines",
    "synthesis",
    "linkage",
    "derivation",
    "sweep",
    "mobility",
    "factoring",
    "conditions",
    "benchmark",
    "claims",
    "scene",
    "report",
    "view",
    "face",
];

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// All files under a folder, as paths relative to the root.
fn files(folder: &str) -> Vec<PathBuf> {
    fn collect(folder: &Path, found: &mut Vec<PathBuf>) {
        let Ok(items) = fs::read_dir(folder) else { return };
        for item in items {
            let path = item.unwrap().path();
            if path.is_dir() {
                collect(&path, found);
            } else {
                found.push(path.strip_prefix(root()).unwrap().to_owned());
            }
        }
    }
    let mut found = Vec::new();
    collect(&root().join(folder), &mut found);
    found.sort();
    found
}

/// The Rust files of a folder with their texts.
fn rust(folder: &str) -> Vec<(PathBuf, String)> {
    let rust = files(folder).into_iter().filter(|path| path.extension().is_some_and(|e| e == "rs"));
    rust.map(|path| (path.clone(), fs::read_to_string(root().join(&path)).unwrap())).collect()
}

/// The library.
fn sources() -> Vec<(PathBuf, String)> {
    rust("src")
}

/// The sources of the library, of the crates below it and of the command line above it.
fn all_sources() -> Vec<(PathBuf, String)> {
    [rust("src"), rust("crates")].concat()
}

/// Everything that is kept under version control, apart from binary files.
fn kept() -> Vec<(PathBuf, String)> {
    let mut paths: Vec<PathBuf> = fs::read_dir(root()).unwrap().map(|item| item.unwrap().path()).collect();
    paths.retain(|path| path.is_file());
    let mut paths: Vec<PathBuf> = paths.iter().map(|path| path.strip_prefix(root()).unwrap().to_owned()).collect();
    for folder in ["src", "tests", "equations", "examples", "benches", "docs", "crates", ".ci", ".github"] {
        paths.extend(files(folder));
    }
    let read = |path: PathBuf| Some((path.clone(), fs::read_to_string(root().join(path)).ok()?));
    paths.into_iter().filter_map(read).collect()
}

/// The top module that a file of src/ belongs to: `solve` for src/solve/newton.rs.
fn module(path: &Path) -> String {
    let first = path.iter().nth(1).unwrap().to_str().unwrap();
    first.strip_suffix(".rs").unwrap_or(first).to_owned()
}

/// A line without its comment; strings are left alone, which is harmless here.
fn code(line: &str) -> &str {
    let start = line.trim_start();
    if start.starts_with("//") { "" } else { line.split(" // ").next().unwrap_or(line) }
}

/// The modules that a file names behind `crate::`, also in `use crate::{a, b::c}`.
fn imports(text: &str) -> BTreeSet<String> {
    // A module has its full path where a visibility is named.
    let code = text.lines().map(code).collect::<Vec<_>>().join("\n").replace("crate::internal::", "crate::");
    let mut found = BTreeSet::new();
    for (at, _) in code.match_indices("crate::") {
        let rest = &code[at + "crate::".len()..];
        if let Some(group) = rest.strip_prefix('{') {
            let mut depth = 0;
            let mut word = String::new();
            for c in group.chars() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => found.extend(first_word(&std::mem::take(&mut word))),
                    _ if depth == 0 => word.push(c),
                    _ => {}
                }
            }
            found.extend(first_word(&word));
        } else {
            found.extend(first_word(rest));
        }
    }
    found
}

fn first_word(text: &str) -> Option<String> {
    let word: String = text.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
    (!word.is_empty()).then_some(word)
}

#[test]
fn imports_are_found_in_every_form() {
    let text = "use crate::{error::{Error, Result}, algebra};\nlet x = crate::solve::dense::y();\n// crate::not\n";
    assert_eq!(imports(text).into_iter().collect::<Vec<_>>(), ["algebra", "error", "solve"]);
}

#[test]
fn layers_import_in_one_direction() {
    let place = |module: &str| LAYERS.iter().position(|layer| *layer == module);
    for (path, text) in sources() {
        let module = module(&path);
        if module == "lib" || module == "engine" {
            continue;
        }
        let own =
            place(&module).unwrap_or_else(|| panic!("{}: give `{module}` its place among the layers", path.display()));
        for import in imports(&text) {
            let imported = place(&import);
            assert!(imported.is_some_and(|imported| imported <= own), "{} imports crate::{import}", path.display());
        }
        if path.iter().count() == 2 {
            let up = text.lines().map(code).filter(|line| line.contains("super::") && !line.contains("use super::*"));
            assert_eq!(up.count(), 0, "{} reaches up by super::", path.display());
        }
        assert!(!text.contains("super::super::"), "{} reaches up twice", path.display());
    }
}

/// The rooms that a crate declares, in its order.
fn declared(root_of_crate: &str) -> Vec<String> {
    let text = fs::read_to_string(root().join(root_of_crate)).unwrap();
    let names = text.lines().filter_map(|line| line.trim_start().strip_prefix("pub mod ")?.strip_suffix(';'));
    names.map(str::to_owned).collect()
}

#[test]
fn the_crates_declare_the_layers_in_order() {
    for root_of_crate in ["src/lib.rs", "src/engine.rs"] {
        let place = |name: &String| LAYERS.iter().position(|layer| layer == name).unwrap_or_else(|| panic!("{name}"));
        let places: Vec<usize> = declared(root_of_crate).iter().map(place).collect();
        assert!(places.is_sorted(), "{places:?}");
    }
}

/// What runs pose after pose is compiled for speed, and needs nothing that is compiled for size.
#[test]
fn the_engine_imports_its_own_rooms_alone() {
    let own = declared("src/engine.rs");
    for (path, text) in sources().iter().filter(|(path, _)| own.contains(&module(path))) {
        let stranger = imports(text).into_iter().find(|import| import != "algebra" && !own.contains(import));
        assert_eq!(stranger, None, "{}", path.display());
    }
}

/// The public names of the library are few enough to be read: 60 to 80 are intended.
#[test]
fn the_root_has_few_names_and_hides_the_rest() {
    let text = fs::read_to_string(root().join("src/lib.rs")).unwrap();
    assert!(text.contains("#[doc(hidden)]\n#[path = \"\"]\n#[rustfmt::skip]\npub mod internal {"), "one hidden module");
    assert_eq!(text.lines().filter(|line| line.starts_with("pub mod ")).count(), 1);
    let shown = text.split_once("\npub use ").unwrap().1;
    let names =
        shown.split([',', '{', ';']).filter(|name| !name.trim().is_empty() && !name.trim().ends_with('}')).count();
    assert!((20..=80).contains(&names), "{names}");
}

#[test]
fn one_file_names_the_eigenvalue_library() {
    for (path, text) in all_sources() {
        let names = text.lines().map(code).any(|line| line.contains("faer::") || line.contains("use faer"));
        assert_eq!(names, path == Path::new("src/solve/eigen.rs"), "{}", path.display());
    }
}

#[test]
fn nothing_is_imported_wholesale_and_no_file_is_long() {
    for (path, text) in all_sources() {
        assert!(!text.contains("use crate::*"), "{}", path.display());
        let lines = text.lines().count();
        assert!(lines <= 900, "{} has {lines} lines", path.display());
        let stem = path.file_stem().unwrap().to_str().unwrap();
        assert!(!["utils", "util", "common", "helpers", "types", "core", "misc"].contains(&stem), "{}", path.display());
    }
}

/// The keys of equations/REFERENCES.md.
fn references() -> BTreeSet<String> {
    let text = fs::read_to_string(root().join("equations/REFERENCES.md")).unwrap();
    text.lines().filter_map(|line| Some(line.strip_prefix("- `[")?.split_once(']')?.0.to_owned())).collect()
}

/// Citations such as `[LeeLiang1988]` or `[LeeLiang1988, eq. 3]`: letters, a year, perhaps a letter.
fn citations(text: &str) -> Vec<String> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices('[') {
        let inside: String = text[at + 1..].chars().take_while(|c| c.is_alphanumeric()).collect();
        let behind = text[at + 1 + inside.len()..].chars().next();
        let letters =
            inside.trim_end_matches(|c: char| c.is_ascii_lowercase()).trim_end_matches(|c: char| c.is_ascii_digit());
        let digits = inside[letters.len()..].bytes().take_while(u8::is_ascii_digit).count();
        let tail = inside.len() - letters.len() - digits;
        let is_key = inside.starts_with(|c: char| c.is_ascii_uppercase())
            && letters.len() >= 3
            && letters.chars().all(char::is_alphabetic)
            && digits == 4
            && tail <= 1
            && matches!(behind, Some(']' | ',' | '\\'));
        if is_key {
            found.push(inside);
        }
    }
    found
}

#[test]
fn every_citation_resolves() {
    assert_eq!(citations("[LeeLiang1988, eq. 3] [Rump2010] [f64; 4] [1988] [`Error`]"), ["LeeLiang1988", "Rump2010"]);
    let known = references();
    assert!(!known.is_empty());
    for (path, text) in kept() {
        if path == Path::new("tests/library/house.rs") {
            continue;
        }
        for key in citations(&text) {
            assert!(known.contains(&key), "{} cites [{key}], which equations/REFERENCES.md lacks", path.display());
        }
        if path.starts_with("equations") && path.extension().is_some_and(|e| e == "toml") {
            let source =
                text.lines().find_map(|line| line.strip_prefix("source")?.split_once("key = \"")?.1.split_once('"'));
            let key = source.unwrap_or_else(|| panic!("{} has no source", path.display())).0;
            assert!(known.contains(key), "{}: {key}", path.display());
        }
    }
}

#[test]
fn nothing_kept_knows_where_it_was_written() {
    // Put together here so that this file passes its own test.
    let places = ["root", "home", "work", "tmp"].map(|folder| format!("/{folder}/"));
    let hosts = [["crates", "io"], ["pypi", "org"], ["npmjs", "org"]].map(|parts| parts.join("."));
    for (path, text) in kept() {
        for (index, line) in text.lines().enumerate() {
            for place in &places {
                // A path that follows a name, as in an address or below target, is not absolute.
                let is_absolute = |(at, _): (usize, &str)| {
                    !line[..at].ends_with(|c: char| c.is_alphanumeric() || matches!(c, '.' | '}' | '_' | '-'))
                };
                let found = line.match_indices(place.as_str()).any(is_absolute);
                assert!(!found, "{}:{}: {line}", path.display(), index + 1);
            }
            if path == Path::new("Cargo.lock") {
                let from_a_registry = line.starts_with("source = \"registry+");
                assert!(!line.starts_with("source = ") || from_a_registry, "a crate from elsewhere: {line}");
            } else {
                for host in &hosts {
                    assert!(!line.contains(host), "{}:{} names {host}", path.display(), index + 1);
                }
            }
        }
    }
    let manifest = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    assert!(!manifest.contains("registry = ") && !manifest.contains("path = \".."), "a crate from elsewhere");
    assert!(!root().join(".cargo/config.toml").exists(), "settings of one machine");
}

#[test]
fn the_page_of_names_lists_every_word_of_a_verdict() {
    let read = |path: &str| fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let page = read("docs/names.md");
    let mut words = 0;
    for source in ["src/verdict/proof.rs", "src/verdict/mod.rs"] {
        for line in read(source).lines().filter(|line| line.trim_start().starts_with("Self::")) {
            let Some(word) = line.split_once("=> \"").and_then(|(_, rest)| rest.split('"').next()) else { continue };
            assert!(page.contains(&format!("\n| `{word}` | ")), "docs/names.md lacks {word}");
            words += 1;
        }
    }
    assert!(words > 20, "{words}");
}
