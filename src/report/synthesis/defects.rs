//! Four-bars of two dyads without circuit and order defects, as text and JSON.

use crate::catalogue::SynthesisFile;
use crate::linkage::defects::{FourBar, four_bars};
use crate::report::table::{Columns, paragraph};
use crate::synthesis::Answer;
use serde_json::{Value, json};
use std::fmt::Write;

fn sound(file: &SynthesisFile, answer: &Answer) -> (usize, Vec<FourBar>) {
    let all = four_bars(file, answer);
    let count = all.len();
    (count, all.into_iter().filter(FourBar::is_sound).collect())
}

/// Adds `linkages` to the result: the four-bars without defects, by the numbers of their dyads.
pub fn add(document: &mut Value, file: &SynthesisFile, answer: &Answer) {
    let (_, list) = sound(file, answer);
    let one = |own: &FourBar| {
        json!({ "dyads": own.dyads.map(|k| k + 1), "class": own.class, "one_circuit": own.one_circuit, "in_order": own.in_order, "without_limit": own.without_limit })
    };
    document["results"][0]["linkages"] = list.iter().map(one).collect();
}

/// A table of the four-bars without defects.
#[must_use]
pub fn text(file: &SynthesisFile, answer: &Answer) -> String {
    let (count, list) = sound(file, answer);
    let mut text = "\n".to_owned();
    paragraph(&mut text, &format!("{} of {count} four-bars of two dyads have all positions on one circuit, in their order", list.len()));
    if list.is_empty() {
        return text;
    }
    let mut table = Columns::new(&["crank", "rocker", "class", "crank passes them"], &["class", "crank passes them"]);
    for own in &list {
        let [crank, rocker] = own.dyads.map(|k| (k + 1).to_string());
        let passes = if own.without_limit == Some(true) { "without a limit" } else { "with a limit on the way" };
        table.row([crank, rocker, own.class.to_owned(), passes.to_owned()]);
    }
    let _ = write!(text, "\n{}", table.text());
    text
}
