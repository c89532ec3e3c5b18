//! Four-bars without circuit and order defects, as text and JSON.

use crate::catalogue::{SynthesisFile, Task};
use crate::linkage::defects::{FourBar, Source, four_bars};
use crate::report::table::{Columns, paragraph};
use crate::synthesis::Answer;
use serde_json::{Value, json};
use std::fmt::Write;

fn sound(file: &SynthesisFile, answer: &Answer) -> (usize, Vec<FourBar>) {
    let all = four_bars(file, answer);
    let count = all.len();
    (count, all.into_iter().filter(FourBar::is_sound).collect())
}

/// Adds `linkages` to the result: the four-bars without defects, by the numbers of their dyads, or by their own and those of their cognates.
pub fn add(document: &mut Value, file: &SynthesisFile, answer: &Answer) {
    let (_, list) = sound(file, answer);
    let one = |own: &FourBar| {
        let mut object = json!({ "class": own.class, "one_circuit": own.one_circuit, "in_order": own.in_order, "without_limit": own.without_limit });
        match own.source {
            Source::Dyads(dyads) => object["dyads"] = json!(dyads.map(|k| k + 1)),
            Source::Cognate { mode, cognate, crank } => {
                (object["id"], object["cognate"], object["crank"]) = (json!(mode + 1), json!(cognate), json!(crank));
            }
        }
        object
    };
    document["results"][0]["linkages"] = list.iter().map(one).collect();
}

/// A table of the four-bars without defects.
#[must_use]
pub fn text(file: &SynthesisFile, answer: &Answer) -> String {
    let (count, list) = sound(file, answer);
    let mut text = "\n".to_owned();
    let (what, places) = match &file.task {
        Task::Path(_) => ("four-bars and cognates, with either link as the crank,", "points"),
        _ => ("four-bars of two dyads", "positions"),
    };
    paragraph(&mut text, &format!("{} of {count} {what} have all {places} on one circuit, in their order", list.len()));
    if list.is_empty() {
        return text;
    }
    let columns = if matches!(file.task, Task::Path(_)) { ["four-bar", "crank at"] } else { ["crank", "rocker"] };
    let mut table =
        Columns::new(&[columns[0], columns[1], "class", "crank passes them"], &["class", "crank passes them"]);
    for own in &list {
        let [one, other] = match own.source {
            Source::Dyads(dyads) => dyads.map(|k| (k + 1).to_string()),
            Source::Cognate { mode, cognate: 0, crank } => [(mode + 1).to_string(), crank.to_owned()],
            Source::Cognate { mode, cognate, crank } => [format!("{}, cognate {cognate}", mode + 1), crank.to_owned()],
        };
        let passes = if own.without_limit == Some(true) { "without a limit" } else { "with a limit on the way" };
        table.row([one, other, own.class.to_owned(), passes.to_owned()]);
    }
    let _ = write!(text, "\n{}", table.text());
    text
}
