//! `looproot mobility` of planar linkages.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Three cranks on a plate; the third one has its pivot C and its length.
fn cranks(name: &str, pivot: &str, length: &str, first: &str) -> PathBuf {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"frame\"\njoints = \"shared points\"\n\
         [mechanism.bodies]\nframe = {{ A = [0, 0], B = [4, 0], C = {pivot} }}\none = {{ A = 0, E = 2 }}\n\
         two = {{ B = 0, F = 2 }}\nthree = {{ C = 0, G = {length} }}\nplate = {{ E = 0, F = 4, G = 7 }}\n\
         [configuration]\none = {{ {first} }}\ntwo = {{ tan_half = \"1/2\" }}\nthree = {{ tan_half = \"1/2\" }}\n\
         plate = {{ angle = 0 }}\n"
    );
    written(name, &text)
}

fn written(name: &str, text: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("linkage_mobility");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn run(path: &str, more: &[&str]) -> (i32, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(["mobility", path]).args(more).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn document(path: &Path) -> (i32, Value) {
    let (code, out, _) = run(path.to_str().unwrap(), &["--json"]);
    (code, serde_json::from_str(&out).unwrap())
}

#[test]
fn three_equal_cranks_move_and_one_of_another_length_does_not() {
    let (code, moving) = document(&cranks("moving.toml", "[7, 0]", "2", "tan_half = \"1/2\""));
    assert_eq!((code, &moving["mobility"], &moving["gruebler"]), (0, &1.into(), &0.into()));
    assert_eq!(
        (&moving["first_order"], &moving["shaky"], &moving["proof"]),
        (&1.into(), &false.into(), &"proved".into())
    );
    let (code, shaky) = document(&cranks("shaky.toml", "[\"32/5\", \"-4/5\"]", "3", "tan_half = \"1/2\""));
    assert_eq!((code, &shaky["mobility"], &shaky["order"]), (3, &0.into(), &2.into()));
    assert_eq!((&shaky["first_order"], &shaky["shaky"], &shaky["proof"]), (&1.into(), &true.into(), &"proved".into()));
}

#[test]
fn a_folded_parallelogram_is_where_two_motions_cross() {
    let text = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"f\"\njoints = \"shared points\"\n\
                [mechanism.bodies]\nf = { A = 0, D = 3 }\na = { A = 0, B = 1 }\nb = { B = 0, C = 3 }\nc = { D = 0, C = 1 }\n\
                [configuration]\na = { angle = 0 }\nb = { angle = 0 }\nc = { angle = 0 }\n";
    let (code, found) = document(&written("folded.toml", text));
    assert_eq!((code, &found["mobility"], &found["branches"]), (0, &1.into(), &2.into()));
    assert_eq!((&found["first_order"], &found["shaky"]), (&2.into(), &true.into()));
}

#[test]
fn a_slider_at_its_end_is_regular_in_its_configuration() {
    let text = "[mechanism]\nkind = \"linkage\"\nspace = \"plane\"\nground = \"f\"\n\
                joints = [\n{ name = \"A\", type = \"R\", of = [\"f\", \"crank\"] },\n{ name = \"B\", type = \"R\", of = [\"crank\", \"rod\"] },\n\
                { name = \"C\", type = \"R\", of = [\"rod\", \"block\"] },\n{ name = \"S\", type = \"P\", of = [\"f\", \"block\"], along = [1, 0], at = [\"A\", \"C\"] },\n]\n\
                [mechanism.bodies]\nf = { A = 0 }\ncrank = { A = 0, B = 3 }\nrod = { B = 0, C = 5 }\nblock = { C = 0 }\n\
                [configuration]\ncrank = { angle = \"pi/2\" }\nrod = { tan_half = \"-1/3\" }\nblock = { angle = 0 }\n";
    let (code, found) = document(&written("slider.toml", text));
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (0, &1.into(), &1.into()), "{found}");
}

#[test]
fn what_does_not_close_is_an_error_with_the_gap() {
    let path = cranks("open.toml", "[7, 0]", "2", "tan_half = \"1/3\"");
    let (code, _, error) = run(path.to_str().unwrap(), &[]);
    assert_eq!(code, 1);
    assert!(error.contains("open.toml:") && error.contains("open by 0.565685 m"), "{error}");
    let (code, _, error) = run("linkage/jansen", &["--certificate", "none.json"]);
    assert_eq!(code, 1);
    assert!(error.contains("linkages have no certificate yet"), "{error}");
}

#[test]
fn without_a_configuration_a_four_bar_and_a_tree_are_decided() {
    let (code, out, _) = run("linkage/coupler_curve", &["-q"]);
    assert_eq!((code, out.trim()), (0, "mobile: mobility 1 (Gruebler's count 1); proof: proved"));
    let (code, out, _) = run("linkage/double_pendulum", &["-q"]);
    assert_eq!((code, out.trim()), (0, "mobile: mobility 2 (Gruebler's count 2); proof: proved"));
    // That no assemblies move in more dimensions is not proved: those of Peaucellier's linkage with C = D do.
    let (code, out, _) = run("linkage/peaucellier", &["-q"]);
    assert_eq!((code, out.contains("proof: none")), (2, true));
}
