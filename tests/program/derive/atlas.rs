//! The atlas of closure equations: text beside every mechanism whose equations fit two pages. `looproot check equations/`, a step of
//! `./check`, compares all of it.

use super::run;
use std::fs;
use std::path::PathBuf;

#[test]
fn checking_compares_the_equations_beside_a_file() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("page");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let root = PathBuf::from(crate::ROOT).join("equations/loop");
    for name in ["cccr_1_angle.toml", "cccr_1_angle.eqs"] {
        fs::copy(root.join(name), folder.join(name)).unwrap();
    }
    let (file, page) = (folder.join("cccr_1_angle.toml"), folder.join("cccr_1_angle.eqs"));
    let (file, kept) = (file.display().to_string(), fs::read_to_string(&page).unwrap());
    let (code, out, err) = run(&["check", &file]);
    assert!(code == 0 && err.is_empty() && out.contains("equations"), "{out}");
    // A digit less.
    let (line, text) = kept.lines().enumerate().find(|(_, line)| line.contains("*c")).unwrap();
    fs::write(&page, kept.replacen(text, &text.replacen("*c", "0*c", 1), 1)).unwrap();
    let (code, out, _) = run(&["check", &folder.display().to_string(), "-q"]);
    let place = format!("cccr_1_angle.eqs:{}: case 1: found \"", line + 1);
    assert!(code == 2 && out.contains(&place) && out.contains("derived \""), "{out}");
    let (code, out, _) = run(&["check", &file, "--json"]);
    let document: serde_json::Value = serde_json::from_str(&out).unwrap();
    let failure = &document[0]["failures"][0];
    assert!(code == 2 && failure["claim"] == "equations" && failure["line"] == line + 1, "{out}");
    assert!(failure["file"].as_str().unwrap().ends_with("cccr_1_angle.eqs"), "{out}");
    // A line missing at the end is reported.
    fs::write(&page, kept.trim_end().rsplit_once('\n').unwrap().0).unwrap();
    let (code, out, _) = run(&["check", &file, "-q"]);
    assert!(code == 2 && out.contains("found the end"), "{out}");
    let (code, ..) = run(&["derive", "--bless", &file, "-q"]);
    assert_eq!((code, fs::read_to_string(&page).unwrap()), (0, kept));
    assert_eq!(run(&["check", &file]).0, 0);
    assert_eq!(run(&["check", "cccr_1_angle"]).0, 0);
}

#[test]
fn blessing_writes_beside_the_file_and_nowhere_else() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("bless");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(folder.join("inner")).unwrap();
    let root = PathBuf::from(crate::ROOT).join("equations");
    for (from, to) in [("loop/cccr_1_angle.toml", "one.toml"), ("arm/general_16real.toml", "inner/long.toml")] {
        fs::copy(root.join(from), folder.join(to)).unwrap();
    }
    let before = fs::read(folder.join("one.toml")).unwrap();
    let path = folder.display().to_string();
    let (code, out, err) = run(&["derive", "--bless", &path]);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(
        out.contains("one.eqs written")
            && out.contains("long.toml: there are no equations, or they are longer than two pages")
    );
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
