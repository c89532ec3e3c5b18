//! Pages of `looproot view`. They are tested in a browser where one is found: chromium on the path, or the program that the
//! variable LOOPROOT_BROWSER names. Without one these tests say so and pass.
#![allow(clippy::unwrap_used)]

use serde_json::Value;
use std::fs;
use std::path::PathBuf;
use std::process::Command;

fn folder() -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("view");
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn run(arguments: &[&str]) -> (i32, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(arguments).output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    (output.status.code().unwrap(), String::from_utf8(output.stdout).unwrap())
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// A page without its script, in which any text might be found.
fn body(page: &str) -> &str {
    let (body, _) = page.split_once("<script type=\"application/json\"").unwrap();
    body
}

fn rows(page: &str) -> usize {
    let (_, table) = body(page).split_once("<tbody>").unwrap();
    table.matches("<tr").count()
}

#[test]
fn a_page_stands_by_itself_and_lists_every_mode() {
    let names = ["general_16real", "dietmaier_40real", "crcrr_2_angle", "linkage/jansen", "linkage/spherical_3rrr"];
    for (name, code) in names.map(|name| (name, 0)) {
        let (found, page) = run(&["view", name]);
        assert_eq!(found, code, "{name}");
        assert!(page.len() < 1_000_000, "{name}: {} bytes", page.len());
        let modes = json(&run(&["solve", name, "--json"]).1)["results"][0]["modes"].as_array().unwrap().len();
        assert_eq!(rows(&page), modes, "{name}");
        let body = body(&page);
        assert!(body.contains("content=\"default-src 'none'; "));
        assert_eq!(body.matches("<table").count(), 1);
        for fetched in ["http://", "https://", "src=\"", "@import", "url("] {
            assert!(!body.contains(fetched), "{name}: {fetched}");
        }
        assert!(
            page.contains("Copyright 2010-") && page.contains("SPDX-License-Identifier: MIT"),
            "the licence of three.js"
        );
    }
}

#[test]
fn parts_are_what_changes_of_a_page() {
    let (_, page) = run(&["view", "general_16real", "--seed", "1"]);
    let (code, parts) = run(&["view", "general_16real", "--parts", "--seed", "1"]);
    let parts = json(&parts);
    assert_eq!(code, 0);
    for key in ["header", "side", "footer"] {
        let part = parts[key].as_str().unwrap();
        assert!(part.len() > 100 && page.contains(part), "{key}");
    }
    assert_eq!(parts["data"]["tracks"].as_array().unwrap().len(), 16);
    assert_eq!(parts["tone"], "sure");
}

#[test]
fn a_live_page_has_the_program_in_it_or_says_what_makes_it() {
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(["view", "ur5", "--live"]).output().unwrap();
    let (page, fault) = (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    if output.status.success() {
        assert!(page.contains("id=\"module\"") && page.contains("--at={0} m") && page.contains("'wasm-unsafe-eval'"));
    } else {
        assert_eq!(output.status.code(), Some(1));
        assert!(fault.contains("web/build makes it"), "{fault}");
    }
}

#[test]
fn complex_modes_are_listed_where_they_are_asked_for() {
    let (_, page) = run(&["view", "general_02real", "--complex", "--pose", "1"]);
    assert_eq!(rows(&page), 16);
    assert_eq!(body(&page).matches("class=\"complex\"").count(), 14);
    assert!(body(&page).contains("<h1>2 of 16 solutions are real</h1>"));
}

#[test]
fn a_pose_that_nothing_reaches_is_drawn_with_the_nearest_configuration() {
    let (code, page) = run(&["view", "puma560", "--at", "5, 0, 0; 1, 0, 0, 0"]);
    assert_eq!((code, rows(&page)), (3, 1));
    assert!(body(&page).contains("The nearest configuration found misses the pose by 4."), "{}", body(&page));
    assert!(body(&page).contains("<canvas"));
}

#[test]
fn a_sweep_has_a_slider_a_path_for_every_branch_and_a_circle_for_every_limit() {
    let range = ["--from", "-pi", "--to", "pi", "--steps", "48"];
    let document = json(&run(&[&["sweep", "rrsrr", "--json"], &range[..]].concat()).1);
    let (_, page) = run(&[&["view", "rrsrr", "--sweep"], &range[..]].concat());
    let body = body(&page);
    let panels = document["joint_variables"].as_array().unwrap().len() - 1;
    let count = |key: &str| document[key].as_array().unwrap().len();
    assert!(count("branches") > 0 && count("limits") > 0);
    assert_eq!(body.matches("<path").count(), panels * count("branches"));
    assert_eq!(body.matches("<circle").count(), panels * count("limits"));
    assert_eq!(body.matches("type=\"range\"").count(), 1);
    assert_eq!(rows(&page), count("branches"));
}

#[test]
fn a_sweep_of_a_linkage_draws_the_curve_of_the_point_that_is_traced() {
    let range = ["--from", "-pi", "--to", "pi", "--steps", "24"];
    let name = "linkage/coupler_curve_symmetric";
    let (_, page) = run(&[&["view", name, "--sweep"], &range[..]].concat());
    assert!(page.contains("\"traces\":[{\"name\":\"coupler.P\""), "the point of the file");
    assert_eq!(rows(&page), 2);
    assert!(page.contains("\"flat\":true"));
    let (_, other) = run(&[&["view", name, "--sweep", "--trace", "coupler.C"], &range[..]].concat());
    assert!(other.contains("\"traces\":[{\"name\":\"coupler.C\""), "the point asked for");
    let (_, figures) = run(&[&["view", name, "--sweep", "--svg"], &range[..]].concat());
    assert!(figures.starts_with("<svg") && figures.contains("branch 2"));
    let (_, panels) = run(&[&["sweep", name, "--svg"], &range[..]].concat());
    assert!(["A [deg]", "B [deg]", "C [deg]", "D [deg]"].iter().all(|label| panels.contains(label)));
}

#[test]
fn a_saved_result_is_drawn_without_its_file() {
    for name in ["general_12real", "dietmaier_40real", "crcrr_2_angle", "linkage/3prr", "linkage/spherical_watt"] {
        let path = folder().join(format!("{}.json", name.replace('/', "-")));
        let (code, document) = run(&["solve", name, "--json", "--seed", "1"]);
        fs::write(&path, document).unwrap();
        let (saved_code, saved) = run(&["view", path.to_str().unwrap()]);
        let (_, fresh) = run(&["view", name, "--seed", "1"]);
        assert_eq!(saved_code, code, "{name}");
        assert!(saved.contains("\"poses\":\"") && saved.contains("<canvas"), "{name}");
        assert_eq!(body(&saved), body(&fresh), "{name}");
    }
    let path = folder().join("lines.jsonl");
    fs::write(&path, run(&["solve", "ur5", "--jsonl", "--scene"]).1).unwrap();
    assert!(rows(&run(&["view", path.to_str().unwrap()]).1) >= 8);
}

/// The document of a path of five poses, each a little farther.
fn path_document() -> PathBuf {
    let rows: Vec<String> = (0..5).map(|k| format!("0.4,{},0.4,0,1,0,0", 0.1 + 0.02 * f64::from(k))).collect();
    let poses = folder().join("path.csv");
    fs::write(&poses, format!("x,y,z,qw,qx,qy,qz\n{}\n", rows.join("\n"))).unwrap();
    let path = folder().join("path.json");
    fs::write(&path, run(&["solve", "ur5", "--poses", poses.to_str().unwrap(), "--follow", "--json"]).1).unwrap();
    path
}

#[test]
fn a_path_has_a_button_and_a_line_in_every_panel_for_every_branch() {
    let path = path_document();
    let document = json(&fs::read_to_string(&path).unwrap());
    let branches = document["branches"].as_array().unwrap().len();
    let modes: usize =
        document["results"].as_array().unwrap().iter().map(|result| result["modes"].as_array().unwrap().len()).sum();
    let (_, page) = run(&["view", path.to_str().unwrap()]);
    let body = body(&page);
    assert_eq!(body.matches("<button type=\"button\" data-track").count(), branches);
    assert_eq!(body.matches("<path").count(), 6 * branches);
    assert_eq!(rows(&page), modes);
    assert!(!body.contains("NaN"));
    assert!(body.contains(&format!("<h1>{branches} branches along 5 poses")), "{}", body.lines().nth(20).unwrap());
}

/// A document with 500 modes in a single result: random joint values, which are drawn as any others.
fn many_modes() -> PathBuf {
    let mut document = json(&run(&["solve", "ur5", "--json", "--pose", "1"]).1);
    let modes = document["results"][0]["modes"].as_array_mut().unwrap();
    let first = modes[0].clone();
    *modes = (0..500_u32)
        .map(|k| {
            let mut mode = first.clone();
            mode["id"] = (k + 1).into();
            for joint in 0..6 {
                // Multiples of the golden angle are spread over the circle.
                mode["q"][joint] = ((f64::from(k * 6) + joint as f64) * 2.399_963 % 6.2 - 3.1).into();
            }
            mode
        })
        .collect();
    let path = folder().join("many.json");
    fs::write(&path, document.to_string()).unwrap();
    path
}

#[test]
fn pages_stay_below_a_megabyte() {
    let (_, page) = run(&["view", many_modes().to_str().unwrap()]);
    assert_eq!(rows(&page), 500);
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
    let (_, page) = run(&["view", "general_7r", "--sweep", "--from", "-pi", "--to", "pi", "--steps", "360"]);
    assert!(page.len() < 1_000_000, "{} bytes", page.len());
}

#[test]
fn scores_are_a_page_of_bars() {
    let path = folder().join("scores.json");
    fs::write(&path, run(&["bench", "accuracy", "--count", "3", "--json"]).1).unwrap();
    let (code, page) = run(&["view", path.to_str().unwrap()]);
    assert_eq!(code, 0);
    assert!(page.contains("<h1>3 of 3 planted solutions found: 0 lost, 0 spurious, 0 duplicates</h1>"));
    assert!(page.contains("<rect") && page.contains("default-src 'none'") && page.len() < 50_000);
}

#[test]
fn no_text_of_a_file_becomes_part_of_the_page() {
    let path = folder().join("hostile.toml");
    let file = fs::read_to_string(PathBuf::from(crate::ROOT).join("equations/arm/general_16real.toml")).unwrap();
    let title =
        "title = '</script><script>alert(1)</script><img src=x onerror=\"alert(2)\"> & co'\nnotes = '</script><b>'";
    let rest = file.split_once("[mechanism]").unwrap().1;
    fs::write(&path, format!("{title}\n[mechanism]{rest}")).unwrap();
    let (_, page) = run(&["view", path.to_str().unwrap()]);
    assert!(!page.contains("<script>alert") && !page.contains("<img") && !page.contains("</script><b>"));
    assert_eq!(page.matches("</script").count(), 2);
    assert!(body(&page).contains("&lt;/script&gt;"));
}

#[test]
fn figures_and_maps_are_pictures_of_their_own() {
    let (_, figures) = run(&["view", "general_16real", "--svg"]);
    assert!(figures.starts_with("<svg ") && figures.trim_end().ends_with("</svg>"));
    assert_eq!(figures.matches("<text").count(), 16);
    let (_, map) = run(&["view", "general_16real", "--map", "xz", "--svg"]);
    assert!(map.starts_with("<svg ") && map.contains("Number of real solutions"));
    let output = Command::new(env!("CARGO_BIN_EXE_looproot")).args(["view", "ur5", "--map", "xx"]).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stderr).contains("found --map xx"));
}

#[test]
fn the_picture_in_the_readme_is_made_by_this_program() {
    let path = PathBuf::from(crate::ROOT).join("docs/pictures/manocha_canny_1994.svg");
    let (kept, made) = (fs::read_to_string(path).unwrap(), run(&["view", "manocha_canny_1994", "--svg"]).1);
    // Lines as deep as each other may stand in another order.
    let sorted = |text: &str| {
        let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
        lines.sort();
        lines
    };
    assert_eq!(
        sorted(&kept),
        sorted(&made),
        "write it anew: looproot view manocha_canny_1994 --svg -o docs/pictures/manocha_canny_1994.svg"
    );
}

#[test]
fn a_framework_is_drawn_along_its_motion() {
    let (code, page) = run(&["view", "framework/hyperboloid"]);
    assert_eq!(code, 0);
    assert!(body(&page).contains("<h1>It moves with one degree of freedom</h1>"));
    assert!(page.contains("\"kind\":\"motion\",\"case\":0,\"reach\":") && page.contains("\"poses\":\""));
}

// ---- in a browser ------------------------------------------------------------------------------------------------------

fn browser() -> Option<String> {
    let named = std::env::var("LOOPROOT_BROWSER").ok();
    let names = named.into_iter().chain(["chromium", "chromium-browser", "google-chrome"].map(str::to_owned));
    let found =
        names.into_iter().find(|name| Command::new(name).arg("--version").output().is_ok_and(|o| o.status.success()));
    if found.is_none() {
        eprintln!("no browser found: what it would make of the page is not tested");
    }
    found
}

/// The document after a script has run on the page, and what the console said.
fn browsed(browser: &str, name: &str, page: &str, script: &str, more: &[&str]) -> (String, String) {
    let path = folder().join(format!("{name}.html"));
    let report = format!(
        "<script>const key = (key) => document.dispatchEvent(new KeyboardEvent('keydown', {{ key, bubbles: true }}));{script}</script></body>"
    );
    fs::write(&path, page.replace("</body>", &report)).unwrap();
    let profile = folder().join(format!("{name}.profile"));
    let output = Command::new(browser)
        .args([
            "--headless",
            "--no-sandbox",
            "--use-angle=swiftshader",
            "--enable-unsafe-swiftshader",
            "--enable-logging=stderr",
        ])
        .args(["--disable-dev-shm-usage", "--virtual-time-budget=6000", "--window-size=1300,850", "--dump-dom"])
        .arg(format!("--user-data-dir={}", profile.display()))
        .args(more)
        .arg(format!("file://{}", path.display()))
        .output()
        .unwrap();
    let console: Vec<String> = String::from_utf8_lossy(&output.stderr)
        .lines()
        .filter(|line| line.contains("CONSOLE"))
        .map(str::to_owned)
        .collect();
    (String::from_utf8(output.stdout).unwrap(), console.join("\n"))
}

/// Returns a value that the script left in the attributes of the root element.
fn left(dom: &str, name: &str) -> String {
    let (_, rest) = dom.split_once(&format!("data-{name}=\"")).unwrap_or_else(|| panic!("{name} is not there"));
    rest.split('"').next().unwrap().to_owned()
}

const CHOSEN: &str = "document.documentElement.dataset.chosen = [...document.querySelectorAll('tbody tr')].findIndex((row) => row.getAttribute('aria-selected') === 'true');";

#[test]
fn keys_and_clicks_choose_a_mode_in_the_table_and_in_the_plots() {
    let Some(browser) = browser() else { return };
    let (_, page) = run(&["view", "general_16real"]);
    let script = format!(
        "key('ArrowDown'); key('ArrowDown'); {CHOSEN}
         document.documentElement.dataset.marks = document.querySelectorAll('.dials .chosen').length;
         document.querySelectorAll('tbody tr')[6].click();
         document.documentElement.dataset.clicked = document.querySelector('tr[aria-selected=\"true\"] .id').textContent;
         setTimeout(() => {{
           const canvas = document.querySelector('canvas'); const gl = canvas.getContext('webgl2');
           const seen = new Set(); const pixel = new Uint8Array(4 * canvas.width * canvas.height);
           gl.readPixels(0, 0, canvas.width, canvas.height, gl.RGBA, gl.UNSIGNED_BYTE, pixel);
           for (let k = 0; k < pixel.length; k += 64) seen.add(pixel.slice(k, k + 3).join());
           document.documentElement.dataset.colours = seen.size;
           document.documentElement.dataset.requests = performance.getEntriesByType('resource').length;
         }}, 1500);"
    );
    let (dom, console) = browsed(&browser, "keys", &page, &script, &[]);
    assert_eq!(console, "");
    assert_eq!((left(&dom, "chosen").as_str(), left(&dom, "marks").as_str()), ("2", "6"));
    assert_eq!(left(&dom, "clicked"), "7");
    assert!(left(&dom, "colours").parse::<usize>().unwrap() > 20, "the canvas is blank");
    assert_eq!(left(&dom, "requests"), "0");
}

#[test]
fn without_webgl_the_table_and_the_flat_figure_remain() {
    let Some(browser) = browser() else { return };
    let (_, page) = run(&["view", "general_16real"]);
    let script = format!(
        "key('ArrowDown'); {CHOSEN} document.documentElement.dataset.lines = document.querySelectorAll('#flat polyline').length;"
    );
    let (dom, console) = browsed(&browser, "flat", &page, &script, &["--disable-3d-apis"]);
    assert_eq!(console, "");
    assert_eq!(left(&dom, "chosen"), "1");
    assert!(!dom.contains("class=\"sure has-3d\""));
    assert!(left(&dom, "lines").parse::<usize>().unwrap() > 5);
}

#[test]
fn a_slider_moves_a_sweep() {
    let Some(browser) = browser() else { return };
    let (_, page) = run(&["view", "rrsrr", "--sweep", "--from", "-pi", "--to", "pi", "--steps", "24"]);
    let script = "const range = document.querySelector('input[type=range]'); const before = document.querySelector('#value').textContent;
                  range.value = 0; range.dispatchEvent(new Event('input'));
                  document.documentElement.dataset.moved = before !== document.querySelector('#value').textContent;
                  key('g'); key('o'); key('r');";
    let (dom, console) = browsed(&browser, "sweep", &page, script, &[]);
    assert_eq!(console, "");
    assert_eq!(left(&dom, "moved"), "true");
}

#[test]
fn a_page_of_500_modes_answers_keys() {
    let Some(browser) = browser() else { return };
    let (_, page) = run(&["view", many_modes().to_str().unwrap()]);
    let script = format!(
        "const start = performance.now(); for (let k = 0; k < 40; k += 1) key('ArrowDown'); key('g'); {CHOSEN}
         document.documentElement.dataset.took = Math.round(performance.now() - start);
         setTimeout(() => {{ document.documentElement.dataset.cells = document.querySelectorAll('.cell').length; }}, 3000);"
    );
    let (dom, console) = browsed(&browser, "many", &page, &script, &[]);
    assert_eq!(console, "");
    assert_eq!(left(&dom, "chosen"), "40");
    assert_eq!(left(&dom, "cells"), "48");
    // Forty steps; a second for each would be no use.
    assert!(left(&dom, "took").parse::<f64>().unwrap() < 8000.0);
}

#[test]
fn a_path_and_scores_leave_the_console_silent() {
    let Some(browser) = browser() else { return };
    let (_, page) = run(&["view", path_document().to_str().unwrap()]);
    let script = "key('ArrowRight'); document.documentElement.dataset.value = document.querySelector('#value').textContent;
                  document.querySelectorAll('button[data-track]')[2].click();
                  document.documentElement.dataset.pressed = document.querySelectorAll('button[aria-pressed=true][data-track]').length;";
    let (dom, console) = browsed(&browser, "path", &page, script, &[]);
    assert_eq!(console, "");
    assert_eq!((left(&dom, "value").as_str(), left(&dom, "pressed").as_str()), ("pose = 3", "1"));
    let path = folder().join("scores_in_browser.json");
    fs::write(&path, run(&["bench", "accuracy", "--count", "2", "--json"]).1).unwrap();
    let (_, page) = run(&["view", path.to_str().unwrap()]);
    assert_eq!(browsed(&browser, "scores", &page, "", &[]).1, "");
}
