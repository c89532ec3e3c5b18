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
    // As of `solve`: the answer is printed, and a note says that there is no certificate.
    assert_eq!(code, run("linkage/jansen", &[]).0);
    assert!(error.contains("note: no certificate: motions of linkages are not covered"), "{error}");
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

#[test]
fn a_coupling_of_three_chains_moves_and_turns_both_shafts_alike() {
    let (code, out, _) = run("linkage/clemens_coupling", &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (0, &1.into(), &Value::from(-1)), "{found}");
    assert_eq!((&found["first_order"], &found["proof"]), (&1.into(), &"proved".into()));
    assert_eq!(found["code"], "order-exceeds-bound");
    assert_eq!(found["shafts"], serde_json::json!([{ "joints": ["S0", "S1"], "ratio": -1 }]));
    let (code, out, _) = run("linkage/ball_in_track", &["--json"]);
    let found: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (0, &1.into(), &1.into()), "{found}");
    assert_eq!(found["shafts"], serde_json::json!([{ "joints": ["S0", "S1"], "ratio": -1 }]));
}

/// The coupling of three chains with one axis turned, so that one chain is no mirror image of itself.
#[test]
fn a_coupling_with_a_crooked_chain_does_not_move() {
    let file = PathBuf::from(crate::ROOT).join("equations/linkage/clemens_coupling.toml");
    let text = fs::read_to_string(file).unwrap();
    let axis = "axis = [\"12/25\", \"16/25\", \"-3/5\"] },\n    { name = \"S1\"";
    assert!(text.contains(axis));
    let (code, found) =
        document(&written("crooked.toml", &text.replace(axis, "axis = [1, 2, 2] },\n    { name = \"S1\"")));
    assert_eq!((code, &found["mobility"], &found["proof"]), (3, &0.into(), &"proved".into()), "{found}");
}

const SPHERE: &str = "[mechanism]\nkind = \"linkage\"\nspace = \"sphere\"\nground = \"f\"\njoints = \"shared points\"\n\
                      [mechanism.bodies]\nf = { A = [2, 1, 2], D = [3, 0, 0] }\na = { A = [2, 1, 2], B = [1, 2, 2] }\n\
                      b = { B = [1, 2, 2], C = [0, 3, 0] }\nc = { C = [0, 3, 0], D = [3, 0, 0] }\n";

#[test]
fn a_four_bar_on_the_sphere_moves() {
    let path = written("sphere.toml", &format!("{SPHERE}[configuration]\na = {{}}\nb = {{}}\nc = {{}}\n"));
    let (code, found) = document(&path);
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (0, &1.into(), &1.into()), "{found}");
    assert_eq!(found["code"], "regular-configuration");
    assert_eq!(found["shafts"], Value::Null);
    let turned = format!("{SPHERE}[configuration]\na = {{ quaternion = [0, 0, 1, 0] }}\nb = {{}}\nc = {{}}\n");
    let (code, _, error) = run(written("sphere_open.toml", &turned).to_str().unwrap(), &[]);
    assert_eq!((code, error.contains("leaves the joint")), (1, true), "{error}");
    let (code, _, error) = run(written("sphere_bare.toml", SPHERE).to_str().unwrap(), &[]);
    assert_eq!((code, error.contains("without a [configuration]")), (4, true), "{error}");
    let (code, out, _) = run("linkage/spherical_four_bar", &["-q"]);
    assert_eq!((code, out.trim()), (0, "mobile: mobility 1 (Gruebler's count 1); proof: proved"));
    let (code, out, _) = run("linkage/rssr_ssr", &["-q"]);
    assert_eq!((code, out.trim()), (2, "mobile: mobility 1 (Gruebler's count 1); proof: none"));
}

#[test]
fn five_rods_and_a_ball_leave_what_their_count_says() {
    // A plate on three rods and one ball: 6 - 3 - 3 = 0; on two rods and the ball it turns.
    let head = "[mechanism]\nkind = \"linkage\"\nspace = \"space\"\nground = \"base\"\njoints = [\n\
                { name = \"O\", type = \"S\", of = [\"base\", \"plate\"] },\n\
                { name = \"one\", type = \"SS\", of = [\"base\", \"plate\"], at = [\"A\", \"E\"], length = 1 },\n\
                { name = \"two\", type = \"SS\", of = [\"base\", \"plate\"], at = [\"B\", \"F\"], length = 2 },\n";
    let third = "{ name = \"three\", type = \"SS\", of = [\"base\", \"plate\"], at = [\"C\", \"G\"], length = 3 },\n";
    let rest = "]\n[mechanism.bodies]\nbase = { O = [0, 0, 0], A = [1, 0, 1], B = [0, 2, 2], C = [3, 0, 3] }\n\
                plate = { O = [0, 0, 0], E = [1, 0, 0], F = [2, 2, 2], G = [0, 0, 3] }\n[configuration]\nplate = {}\n";
    let (code, found) = document(&written("two_rods.toml", &format!("{head}{rest}")));
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (0, &1.into(), &1.into()), "{found}");
    let (code, found) = document(&written("three_rods.toml", &format!("{head}{third}{rest}")));
    assert_eq!((code, &found["mobility"], &found["gruebler"]), (3, &0.into(), &0.into()), "{found}");
}

/// Two shafts joined by a rod, the half-angle tangents of which have the ratio 2 along one of two components.
fn shafts(name: &str, axis: &str) -> Value {
    let text = format!(
        "[mechanism]\nkind = \"linkage\"\nspace = \"space\"\nground = \"house\"\njoints = [\n\
         {{ name = \"S0\", type = \"R\", of = [\"house\", \"in\"], axis = [0, 0, 1] }},\n\
         {{ name = \"rod\", type = \"SS\", of = [\"in\", \"out\"], length = \"sqrt(722/81)\" }},\n\
         {{ name = \"S1\", type = \"R\", of = [\"house\", \"out\"], axis = {axis} }},\n]\n\
         [mechanism.bodies]\nhouse = {{ S0 = [0, 0, 0], S1 = [\"1/9\", 2, \"17/9\"] }}\n\
         in = {{ S0 = [0, 0, 0], rod = [1, 0, 0] }}\nout = {{ S1 = [\"1/9\", 2, \"17/9\"], rod = [\"4/9\", \"8/3\", \"11/9\"] }}\n\
         [configuration]\nin = {{}}\nout = {{}}\n"
    );
    document(&written(name, &text)).1
}

#[test]
fn shafts_turn_alike_or_not_however_long_their_axes_are_written() {
    for (name, axis) in [("double.toml", r#"["4/3", "-4/3", "-2/3"]"#), ("unit.toml", r#"["2/3", "-2/3", "-1/3"]"#)] {
        let found = shafts(name, axis);
        assert_eq!((&found["mobility"], &found["proof"]), (&1.into(), &"proved".into()), "{found}");
        assert!(found["shafts"].as_array().is_none_or(Vec::is_empty), "{found}");
    }
    // The two shafts of a homokinetic coupling, one axis written twice as long.
    let file = Path::new(super::ROOT).join("equations/linkage/clemens_coupling.toml");
    let text = fs::read_to_string(file).unwrap();
    let longer = text.replace(r#"axis = ["-4/5", "3/5", 0]"#, r#"axis = ["-8/5", "6/5", 0]"#);
    assert_ne!(text, longer);
    let [(_, one), (_, two)] = [text, longer].map(|text| document(&written("clemens.toml", &text)));
    assert!(one["shafts"].as_array().is_some_and(|shafts| !shafts.is_empty()), "{one}");
    assert_eq!(one["shafts"], two["shafts"]);
}

#[test]
fn a_gap_below_all_numbers_is_one() {
    let text = "[mechanism]\nkind = \"linkage\"\nspace = \"space\"\nground = \"g\"\njoints = [\n\
                { name = \"A\", type = \"R\", of = [\"g\", \"a\"], axis = [0, 0, 1] },\n\
                { name = \"B\", type = \"SS\", of = [\"g\", \"a\"], length = 2 },\n]\n\
                [mechanism.bodies]\ng = { A = [0, 0, 0], B = [3, 0, 0] }\n\
                a = { A = [0, 0, 0], B = [\"1 - 1e-149*1e-149*1e-100\", 0, 0] }\n[configuration]\na = {}\n";
    let (_, found) = document(&written("gap.toml", text));
    assert_eq!(found["proof"], "none", "{found}");
}
