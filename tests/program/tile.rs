//! `looproot solve` on questions `find = "tile"`.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

/// Runs a tile and returns its result.
fn solved(name: &str, corners: &str, pairs: &str, glides: &str) -> Value {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("tile");
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    let text = format!(
        "[mechanism]\nkind = \"displacement\"\nfind = \"tile\"\ncorners = {corners}\npairs = {pairs}\nglides = {glides}\n"
    );
    fs::write(&path, text).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_looproot"))
        .args(["solve", path.to_str().unwrap(), "--json"])
        .output()
        .unwrap();
    let document: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)));
    document["results"][0].clone()
}

/// The groups without mirrors that rational corners allow: those of Heesch's tiles.
#[test]
fn tiles_of_five_groups() {
    let hexagon = "[[0, 0], [3, 0], [4, 2], [3, 3], [0, 3], [-1, 1]]";
    let square = "[[0, 0], [1, 0], [1, 1], [0, 1]]";
    let quadrangle = "[[0, 0], [4, 0], [3, 3], [1, 2]]";
    let pentagon = "[[0, 0], [4, 1], [5, 5], [1, 6], [-1, 4]]";
    let triangle = "[[0, 0], [4, 0], [2, 3]]";
    let tiles = [
        ("hexagon", hexagon, "[[1, 4], [2, 5], [3, 6]]", "[]", "p1"),
        ("quadrangle", quadrangle, "[[1, 1], [2, 2], [3, 3], [4, 4]]", "[]", "p2"),
        ("triangle", triangle, "[[1, 1], [2, 2], [3, 3]]", "[]", "p2"),
        ("pentagon", pentagon, "[[5, 1], [2, 3], [4, 4]]", "[]", "p4"),
        ("quarters", square, "[[1, 2], [3, 4]]", "[]", "p4"),
        ("torus", square, "[[1, 3], [2, 4]]", "[]", "p1"),
        ("bottle", square, "[[1, 3]]", "[[2, 4]]", "pg"),
        ("glides", triangle, "[[1, 1]]", "[[2, 3]]", "pgg"),
    ];
    for (name, corners, pairs, glides, group) in tiles {
        let found = solved(&format!("{name}.toml"), corners, pairs, glides);
        assert_eq!(found["verdict"]["proof"], "proved", "{name}: {found}");
        assert_eq!(found["modes"][0]["group"], group, "{name}: {found}");
    }
}

#[test]
fn polygons_that_do_not_tile() {
    let refused = [
        ("lengths", "[[0, 0], [4, 0], [2, 3]]", "[[1, 2], [3, 3]]", "[]", "different lengths"),
        ("clockwise", "[[0, 0], [0, 1], [1, 1], [1, 0]]", "[[1, 3], [2, 4]]", "[]", "clockwise"),
        ("crossed", "[[0, 0], [2, 2], [2, 0], [0, 2]]", "[[1, 1], [2, 2], [3, 3], [4, 4]]", "[]", "meet"),
        // A pentagon whose every side goes to itself: three quarters of two turns at its corners.
        (
            "pentagon",
            "[[0, 0], [4, 0], [5, 3], [2, 5], [-1, 3]]",
            "[[1, 1], [2, 2], [3, 3], [4, 4], [5, 5]]",
            "[]",
            "add up to 1.5",
        ),
    ];
    for (name, corners, pairs, glides, part) in refused {
        let found = solved(&format!("{name}.toml"), corners, pairs, glides);
        let reason = found["verdict"]["reason"].as_str().unwrap();
        assert_eq!(found["verdict"]["real"], 0, "{name}: {found}");
        assert!(reason.contains(part), "{name}: {reason}");
    }
}

#[test]
fn the_turns_of_slits_are_counted_however_small_they_are() {
    // A square with slits at two corners: the angles round the one point of the tiling are three whole turns.
    let off = |size: &str, x: &str, factor: &str| format!("\"{x} + ({factor})*{size}\"");
    for (name, size) in [("wide", "1e-10"), ("thin", "1e-149*1e-149")] {
        let at = |x: &str, fx: &str, y: &str, fy: &str| format!("[{}, {}]", off(size, x, fx), off(size, y, fy));
        let d = "1/100000000";
        let corners = [
            "[1, 1]".to_owned(),
            "[5, 1]".to_owned(),
            at("5", "-1", "1", "1"),
            at("5", d, "1", d),
            at("5", d, "5", d),
            at("1", d, "5", d),
            at("1", "100000001/100000000", "5", "-99999999/100000000"),
            "[1, 5]".to_owned(),
        ];
        let found = solved(name, &format!("[{}]", corners.join(", ")), "[[1, 5], [2, 6], [3, 7], [4, 8]]", "[]");
        assert!(found["modes"].as_array().is_none_or(Vec::is_empty), "{name}: {found}");
        assert!(found["verdict"]["reason"].as_str().unwrap().contains("3.000000 of a turn"), "{name}: {found}");
    }
}
