//! The page of what `bench --json` has measured: accuracy, times, mechanisms with a small error.

use super::page::{POLICY, STYLE};
use super::words::Tone;
use crate::report::picture::escaped;
use serde_json::Value;
use std::fmt::Write;

/// Width of a chart, of the names beside its bars, and the height of a bar with its room, in pixels.
const WIDTH: f64 = 560.0;
const NAMES: f64 = 190.0;
const BAR: f64 = 22.0;

/// Whether a document is one of `bench`, or a list of them.
#[must_use]
pub fn is_scores(document: &Value) -> bool {
    let is_one = |own: &Value| {
        own["set"].is_string() && own["found"].is_u64()
            || own["disturbed"].is_u64() && own["immobile"].is_u64()
            || own["stages"].is_array()
    };
    match document.as_array() {
        Some(list) => !list.is_empty() && list.iter().all(is_one),
        None => is_one(document),
    }
}

/// The page of scores.
#[must_use]
pub fn page(document: &Value) -> String {
    let one = std::slice::from_ref(document);
    let list = document.as_array().map_or(one, Vec::as_slice);
    let (tone, headline) = headline(list);
    let mut text = format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<link rel=\"icon\" href=\"data:,\">\n\
         <title>Scores</title>\n<style>\n{STYLE}</style>\n</head>\n<body class=\"{0} scores\">\n\
         <header><p class=\"kicker\"><b>Scores</b></p><div class=\"verdict {0}\"><h1>{1}</h1></div></header>\n",
        tone.class(),
        escaped(&headline)
    );
    for own in list.iter().filter(|own| own["disturbed"].is_null()) {
        let _ = writeln!(text, "<section class=\"extra\">");
        if let Some(stages) = own["stages"].as_array() {
            let bars: Vec<(String, f64)> =
                stages.iter().map(|stage| (word(&stage["name"]), number(&stage["median_us"]))).collect();
            text.push_str(&chart("Microseconds, one core, median", &bars, |x| format!("{x:.1}")));
        } else {
            accuracy(&mut text, own);
        }
        text.push_str("</section>\n");
    }
    let disturbed: Vec<&Value> = list.iter().filter(|own| own["disturbed"].is_u64()).collect();
    if !disturbed.is_empty() {
        let heads = ["mechanism", "disturbed", "immobile", "undecided", "solved", "counted", "real"];
        let rows = disturbed.iter().map(|own| heads.map(|key| plain(&own[key])).to_vec()).collect::<Vec<_>>();
        let _ = writeln!(text, "<section class=\"extra\">{}</section>", table(&heads, &rows));
    }
    text + "</body>\n</html>\n"
}

fn word(value: &Value) -> String {
    value.as_str().unwrap_or_default().to_owned()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(0.0)
}

/// A number or a word as it is printed.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => "\u{2013}".to_owned(),
        other => other.to_string(),
    }
}

fn sum(list: &[Value], key: &str) -> u64 {
    list.iter().filter_map(|own| own[key].as_u64()).sum()
}

/// Returns the number of samples drawn, and their name.
fn drawn(own: &Value) -> (u64, &'static str) {
    ["arms", "platforms", "loops"]
        .into_iter()
        .find_map(|noun| Some((own[noun].as_u64()?, noun)))
        .unwrap_or((0, "samples"))
}

fn headline(list: &[Value]) -> (Tone, String) {
    if list.iter().all(|own| own["disturbed"].is_u64()) {
        let (disturbed, immobile) = (sum(list, "disturbed"), sum(list, "immobile"));
        let tone = if disturbed == immobile { Tone::Sure } else { Tone::Doubt };
        return (tone, format!("{immobile} of {disturbed} mechanisms with a small error are proved immobile"));
    }
    if list.iter().all(|own| own["stages"].is_array()) {
        return (Tone::Nothing, "Times of the stages of an answer".to_owned());
    }
    let count: u64 = list.iter().map(|own| drawn(own).0).sum();
    let wrong = ["lost", "spurious", "duplicates"].map(|key| sum(list, key));
    let is_right = wrong == [0; 3] && sum(list, "miscounted") == 0;
    let tone = if is_right { Tone::Sure } else { Tone::Doubt };
    let [lost, spurious, duplicates] = wrong;
    let found = sum(list, "found");
    (
        tone,
        format!(
            "{found} of {count} planted solutions found: {lost} lost, {spurious} spurious, {duplicates} duplicates"
        ),
    )
}

fn accuracy(text: &mut String, own: &Value) {
    let (count, noun) = drawn(own);
    let _ = writeln!(text, "<h2>{}, {count} {noun}, seed {}</h2>", escaped(&word(&own["set"])), own["seed"]);
    let counts = |key: &str| -> Vec<(String, f64)> {
        own[key].as_object().into_iter().flatten().map(|(name, count)| (name.clone(), number(count))).collect()
    };
    let whole = |x: f64| format!("{x:.0}");
    text.push_str("<div class=\"charts\">\n");
    text.push_str(&chart("Real solutions of a sample", &counts("real"), whole));
    text.push_str(&chart("Complex solutions of a sample", &counts("complex"), whole));
    text.push_str(&chart("Verdicts", &counts("verdicts"), whole));
    text.push_str(&chart("What verdicts rest on", &counts("proofs"), whole));
    text.push_str("</div>\n");
    let row = |name: &str, key: &str| {
        let cells = ["median", "p99", "p999", "max"].map(|part| {
            let value = own[key][part].as_f64();
            value.map_or_else(|| "\u{2013}".to_owned(), |x| format!("{x:.1e}"))
        });
        std::iter::once(name.to_owned()).chain(cells).collect::<Vec<String>>()
    };
    let rows = [row("closure residual", "residual"), row("distance to the planted solution", "distance")];
    text.push_str(&table(&["", "median", "99 %", "99.9 %", "largest"], &rows));
    let _ = writeln!(text, "<p>{} of {} solutions are certified.</p>", own["certified"], own["modes"]);
}

/// Bars with their names and numbers.
fn chart(title: &str, bars: &[(String, f64)], written: impl Fn(f64) -> String) -> String {
    let most = bars.iter().map(|(_, value)| *value).fold(0.0, f64::max);
    let height = 30.0 + BAR * bars.len() as f64;
    let mut text = format!(
        "<figure><svg viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" role=\"img\" aria-label=\"{0}\"><text class=\"name\" y=\"14\">{0}</text>",
        escaped(title)
    );
    for (line, (name, value)) in bars.iter().enumerate() {
        let y = 26.0 + BAR * line as f64;
        // Room for the number behind the longest bar.
        let length = if most > 0.0 { (WIDTH - NAMES - 70.0) * value / most } else { 0.0 };
        let _ = write!(
            text,
            "<text class=\"tick\" x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\
             <rect x=\"{NAMES}\" y=\"{y}\" width=\"{length:.1}\" height=\"{}\" fill=\"#2f6fb0\"/>\
             <text class=\"tick\" x=\"{:.1}\" y=\"{}\">{}</text>",
            NAMES - 8.0,
            y + 12.0,
            escaped(name),
            BAR - 6.0,
            NAMES + length + 6.0,
            y + 12.0,
            escaped(&written(*value))
        );
    }
    text + "</svg></figure>\n"
}

fn table(heads: &[&str], rows: &[Vec<String>]) -> String {
    let mut text = String::from("<table><thead><tr>");
    for head in heads {
        let _ = write!(text, "<th scope=\"col\">{}</th>", escaped(head));
    }
    text.push_str("</tr></thead>\n<tbody>\n");
    for row in rows {
        text.push_str("<tr>");
        for cell in row {
            let _ = write!(text, "<td>{}</td>", escaped(cell));
        }
        text.push_str("</tr>\n");
    }
    text + "</tbody></table>\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_loss_is_in_the_headline() {
        let scores = |lost: u64| json!({ "set": "general", "arms": 30, "found": 30 - lost, "lost": lost, "spurious": 0, "duplicates": 0, "miscounted": 0 });
        assert!(is_scores(&scores(0)) && is_scores(&json!([scores(1)])) && !is_scores(&json!({ "results": [] })));
        assert_eq!(headline(&[scores(0)]).0, Tone::Sure);
        let (tone, text) = headline(&[scores(0), scores(1)]);
        assert_eq!(tone, Tone::Doubt);
        assert_eq!(text, "59 of 60 planted solutions found: 1 lost, 0 spurious, 0 duplicates");
        assert!(page(&scores(1)).contains("1 lost"));
    }
}
