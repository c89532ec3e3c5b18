//! One HTML file: verdict, figure, plots, table, reasons. It fetches nothing, which its own policy enforces. A live page also
//! has controls and the program itself.

use super::dials::dials;
use super::encode::script;
use super::live::{Live, controls, solver};
use super::panels::panels;
use super::scores;
use super::stick;
use super::table::{case_name, case_noun, table};
use super::tracks::{Kind, Track, begun, first_case, is_path, is_sweep, list, stride, tracks};
use super::words::{Headline, followed, moving, solved, swept};
use crate::report::number::counted;
use crate::report::picture::escaped;
use serde_json::Value;
use std::fmt::Write;

/// The script, bundled with three.js (see assets/viewer).
const SCRIPT: &str = include_str!("../../assets/viewer/viewer.min.js");
/// What runs the script of a live page.
const START: &str = include_str!("../../assets/viewer/start.js");
pub(super) const STYLE: &str = include_str!("../../assets/viewer/viewer.css");
/// Nothing is fetched from anywhere; the icon is empty data.
pub(super) const POLICY: &str =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:";
/// The policy of a page that also runs WebAssembly in a worker inside the page.
const LIVE_POLICY: &str = "default-src 'none'; script-src 'unsafe-inline' 'wasm-unsafe-eval' blob:; worker-src blob:; \
                           style-src 'unsafe-inline'; img-src data:";
/// Bytes for the poses of a page: with the script and the table it stays below 1 MB.
const POSES: usize = 240_000;
/// The view box of the flat figure.
const FLAT: [f64; 2] = [400.0, 300.0];

/// The page of a document that [`drawable`](super::drawable) has made ready; `figure` is a further picture, as SVG.
#[must_use]
pub fn page(document: &Value, figure: Option<&str>) -> String {
    if scores::is_scores(document) {
        return scores::page(document);
    }
    whole(document, figure, None)
}

/// The page of a document with controls for what was asked, which solves anew whenever one is moved.
///
/// # Errors
/// [`Error::Invalid`](crate::error::Error::Invalid) for a document of another question than one pose, input or set of legs.
pub fn live_page(document: &Value, live: &Live) -> Result<String, crate::error::Error> {
    let controls = controls(document)?;
    Ok(whole(document, None, Some((&controls, live))))
}

/// Returns the parts of a page that change with the answer, for a page that is open: HTML and the data of the script.
#[must_use]
pub fn parts(document: &Value) -> Value {
    let tracks = tracks(document);
    let headlines = headlines(document);
    let (mut top, mut middle, mut bottom) = (String::new(), String::new(), String::new());
    header(&mut top, document, &headlines);
    side(&mut middle, document, &tracks);
    footer(&mut bottom, document, &headlines);
    object([
        ("tone", tone(document, &headlines).into()),
        ("header", top.into()),
        ("side", middle.into()),
        ("footer", bottom.into()),
        ("data", data(document, &tracks)),
    ])
}

/// Returns an object of values as they are: the macro `json!` would copy each of them.
fn object<const N: usize>(entries: [(&str, Value); N]) -> Value {
    Value::Object(entries.into_iter().map(|(key, value)| (key.to_owned(), value)).collect())
}

fn whole(document: &Value, figure: Option<&str>, live: Option<(&Value, &Live)>) -> String {
    let tracks = tracks(document);
    let title = document["title"].as_str().unwrap_or("looproot");
    let headlines = headlines(document);
    let tone = tone(document, &headlines);
    let policy = if live.is_some() { LIVE_POLICY } else { POLICY };
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>{0}</title>\n<style>\n{STYLE}</style>\n</head>\n<body class=\"{tone}\">\n",
        escaped(title)
    );
    header(&mut text, document, &headlines);
    if live.is_some() {
        // The script fills it with one slider for every requested number.
        text.push_str("<section id=\"controls\" aria-label=\"What is asked\"></section>\n");
    }
    text.push_str("<main>\n");
    stage(&mut text, document, &tracks, live.is_some());
    text.push_str("<section class=\"side\">\n");
    side(&mut text, document, &tracks);
    text.push_str("</section>\n</main>\n");
    if let Some(figure) = figure {
        let _ = writeln!(text, "<section class=\"extra\">{figure}</section>");
    }
    footer(&mut text, document, &headlines);
    if let Some((controls, live)) = live {
        solver(&mut text, controls, live);
    }
    // The script of a page with the program stands there gzipped, and is run from there.
    let runs = if live.is_some_and(|(_, live)| live.program.is_some()) { START } else { SCRIPT };
    let _ = write!(
        text,
        "<script type=\"application/json\" id=\"data\">{}</script>\n<script>{}</script>\n</body>\n</html>\n",
        script(&data(document, &tracks)),
        runs.replace("</script", "<\\/script")
    );
    text
}

/// Returns the data for the script: the bodies and their places.
fn data(document: &Value, tracks: &[Track<'_>]) -> Value {
    let scene = if document["scene"].is_object() { document["scene"].clone() } else { Value::Null };
    let stride = stride(tracks, POSES);
    let first = begun(document, tracks);
    let tracks: Vec<Value> = tracks.iter().map(|track| track.json(document, stride)).collect();
    let case = first_case(document);
    object([("scene", scene), ("tracks", Value::Array(tracks)), ("case", case.into()), ("first", first.into())])
}

/// The colour of the verdict that is shown first.
fn tone(document: &Value, headlines: &[Headline]) -> &'static str {
    headlines.get(first_case(document)).map_or("doubt", |headline| headline.tone.class())
}

/// A verdict for every result.
fn headlines(document: &Value) -> Vec<Headline> {
    if is_sweep(document) {
        return vec![swept(document)];
    }
    let results = list(document, "results");
    if results.is_empty() {
        return vec![moving(document)];
    }
    let kind = document["kind"].as_str().unwrap_or_default();
    let mut headlines: Vec<Headline> = results.iter().map(|result| solved(kind, &result["verdict"])).collect();
    if is_path(document) {
        headlines.push(followed(document, &headlines));
    }
    headlines
}

fn header(text: &mut String, document: &Value, headlines: &[Headline]) {
    let mechanism = &document["mechanism"];
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let kind = match (word(&mechanism["type"]), word(&document["kind"])) {
        (kinds, kind) if kinds.is_empty() => kind,
        (size, kind) if kind == "linkage" => format!("{kind}, {size}"),
        (kinds, kind) => format!("{kinds} {kind}"),
    };
    let title = document["title"].as_str().unwrap_or("untitled");
    let kind = if kind == title { String::new() } else { kind };
    let _ =
        writeln!(text, "<header>\n<p class=\"kicker\"><b>{}</b><span>{}</span></p>", escaped(title), escaped(&kind));
    for (case, headline) in headlines.iter().enumerate() {
        let hidden = if case == first_case(document) { "" } else { " hidden" };
        let class = headline.tone.class();
        let which = if headlines.len() > 1 && case < list(document, "results").len() {
            format!("<span class=\"which\">{} {}</span>", case_noun(document), case_name(document, case))
        } else {
            String::new()
        };
        let _ = writeln!(
            text,
            "<div class=\"verdict {class}\" data-case=\"{case}\"{hidden}>{which}<h1>{}</h1><span class=\"badge\">{}</span></div>",
            escaped(&headline.text),
            escaped(&headline.badge)
        );
    }
    text.push_str("</header>\n");
}

/// The figure, its buttons and its slider. A live page has all of them, since the next answer may need them.
fn stage(text: &mut String, document: &Value, tracks: &[Track<'_>], live: bool) {
    let is_posed = tracks.iter().any(|track| track.frames.iter().any(|f| f["poses"].is_array()));
    if !document["scene"].is_object() || !(live || is_posed) {
        return;
    }
    let button = |key: &str, name: &str, hint: &str| {
        format!("<button type=\"button\" data-key=\"{key}\" title=\"{hint}\">{name}</button>")
    };
    let many = live || tracks.len() > 1;
    let mut buttons = String::new();
    if many {
        buttons += &button("overlay", "All", "Show the others as ghosts (o)");
        buttons += &button("grid", "Grid", "Every one by itself (g)");
    }
    buttons += &button("reset", "Reset view", "From where it was first seen (r)");
    let _ = writeln!(
        text,
        "<figure class=\"stage\"><div class=\"view\"><canvas id=\"canvas\" aria-label=\"The mechanism in space\"></canvas>\
         <svg id=\"flat\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"The mechanism\">{}</svg>\
         <div id=\"labels\" aria-hidden=\"true\"></div>\
         <div class=\"tools\">{buttons}</div></div>",
        FLAT[0],
        FLAT[1],
        stick::first(document, tracks, FLAT)
    );
    if live || tracks.iter().any(|track| track.frames.len() > 1) {
        let hidden = if tracks.first().is_some_and(|track| track.frames.len() > 1) { "" } else { " hidden" };
        let _ = writeln!(
            text,
            "<div id=\"slider\"{hidden}><button type=\"button\" id=\"play\" data-key=\"play\" title=\"Play (space)\">Play</button>\
             <input type=\"range\" id=\"range\" min=\"0\" max=\"{}\" value=\"0\" aria-label=\"Along the motion\"><output id=\"value\"></output></div>",
            tracks.first().map_or(1, |track| track.frames.len().max(2) - 1)
        );
    }
    let keys: [(bool, &str); 4] = [
        (many, "<kbd>\u{2191}</kbd> <kbd>\u{2193}</kbd> choose"),
        (
            tracks.iter().any(|track| track.frames.len() > 1),
            "<kbd>\u{2190}</kbd> <kbd>\u{2192}</kbd> move, <kbd>space</kbd> play",
        ),
        (many, "<kbd>o</kbd> all together, <kbd>g</kbd> side by side"),
        (true, "<kbd>r</kbd> reset; drag to turn, wheel to zoom"),
    ];
    let keys: Vec<&str> = keys.iter().filter(|(is_used, _)| *is_used).map(|(_, words)| *words).collect();
    let _ = writeln!(text, "<figcaption>{}</figcaption></figure>", keys.join(", "));
}

/// Plots, families and the table.
fn side(text: &mut String, document: &Value, tracks: &[Track<'_>]) {
    if is_sweep(document) {
        text.push_str(&panels(document, tracks));
    }
    if is_path(document) {
        let first = first_case(document);
        let _ = writeln!(text, "<p class=\"families\">{}</p>", branch_buttons(tracks));
        let _ = writeln!(text, "<div data-case=\"{first}\">\n{}</div>", panels(document, tracks));
    }
    let cases = list(document, "results").len();
    for case in 0..cases {
        let own: Vec<(usize, &Track<'_>)> = tracks.iter().enumerate().filter(|(_, track)| track.case == case).collect();
        let hidden = if case == first_case(document) { "" } else { " hidden" };
        let mut families = String::new();
        for (index, track) in own.iter().filter(|(_, track)| track.kind == Kind::Family) {
            let name = escaped(&track.name);
            let _ = write!(
                families,
                "<button type=\"button\" data-track=\"{index}\" aria-pressed=\"false\">{name}</button>"
            );
        }
        let plots = dials(document, &own);
        if plots.is_empty() && families.is_empty() {
            continue;
        }
        let _ = writeln!(text, "<div data-case=\"{case}\"{hidden}>{plots}");
        if !families.is_empty() {
            let _ = writeln!(text, "<p class=\"families\">{families}</p>");
        }
        text.push_str("</div>\n");
    }
    text.push_str(&table(document, tracks));
}

/// A button for every branch of a path.
fn branch_buttons(tracks: &[Track<'_>]) -> String {
    let mut text = String::new();
    for (index, track) in tracks.iter().enumerate().filter(|(_, track)| track.kind == Kind::Branch) {
        let (from, to) = (&track.source["from"], &track.source["to"]);
        let _ = write!(
            text,
            "<button type=\"button\" data-track=\"{index}\" aria-pressed=\"false\" title=\"{}\">branch {}: {from} to {to}</button>",
            escaped(&largest_move(track.source)),
            escaped(&track.name)
        );
    }
    text
}

/// `largest move 0.0696 of q3 at pose 3`, radians or metres
fn largest_move(branch: &Value) -> String {
    let own = &branch["largest_move"];
    match (own["joint"].as_str(), own["value"].as_f64()) {
        (Some(joint), Some(value)) => format!("largest move {value:.4} of {joint} at pose {}", own["case"]),
        _ => "a single pose".to_owned(),
    }
}

/// Why, what to beware of, and where it comes from.
fn footer(text: &mut String, document: &Value, headlines: &[Headline]) {
    text.push_str("<footer>\n");
    let results = list(document, "results");
    for (case, headline) in headlines.iter().enumerate() {
        let hidden = if case == first_case(document) { "" } else { " hidden" };
        let _ = writeln!(text, "<div data-case=\"{case}\"{hidden}>");
        if !headline.reason.is_empty() {
            let _ = writeln!(text, "<p><b>Why</b> {}</p>", escaped(&headline.reason));
        }
        for warning in results.get(case).map_or(&[][..], |result| list(result, "warnings")) {
            let _ = writeln!(text, "<p><b>Note</b> {}</p>", escaped(warning.as_str().unwrap_or_default()));
        }
        text.push_str("</div>\n");
    }
    let mechanism = &document["mechanism"];
    let about = [("Notes", &mechanism["notes"]), ("Source", &mechanism["citation"])];
    let about: Vec<String> = about
        .iter()
        .filter_map(|(name, text)| Some(format!("<p><b>{name}</b> {}</p>\n", escaped(text.as_str()?))))
        .collect();
    if !about.is_empty() {
        let _ = writeln!(text, "<details><summary>About this mechanism</summary>\n{}</details>", about.concat());
    }
    let cases =
        if results.len() > 1 { format!(", {}", counted(results.len(), case_noun(document))) } else { String::new() };
    let seed = document["seed"].as_u64().map_or_else(String::new, |seed| format!(", seed {seed}"));
    let _ = writeln!(
        text,
        "<p class=\"small\">{}{cases}{seed}; looproot {}; angles in degrees, lengths in metres</p>\n</footer>",
        escaped(document["name"].as_str().unwrap_or_default()),
        escaped(document["version"].as_str().unwrap_or_default())
    );
}
