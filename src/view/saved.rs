//! Documents as they are saved, made ready to be drawn.

use super::mechanism::stage;
use super::scores::is_scores;
use crate::error::Error;
use crate::report::scene::{self, pose_result, pose_sweep};
use crate::scene::Stage;
use serde_json::{Value, json};

/// Reads a saved document, or the lines of `solve --jsonl --scene`; `None` where the text is something else, such as the
/// file of a mechanism.
#[must_use]
pub fn parse(text: &str) -> Option<Value> {
    let is_document = |value: &Value| {
        value["mechanism"].is_object() && ["results", "branches", "mobility"].iter().any(|key| !value[*key].is_null())
    };
    if let Ok(value) = serde_json::from_str::<Value>(text) {
        return Some(value).filter(|value| is_document(value) || is_scores(value));
    }
    let mut lines = text.lines().map(serde_json::from_str::<Value>);
    let mut document = lines.next()?.ok()?.get_mut("document")?.take();
    // A last line that was cut off is left out.
    document["results"] = lines.map_while(Result::ok).collect();
    Some(document).filter(is_document)
}

/// Adds the scene and the poses that a document lacks.
///
/// # Errors
/// [`Error::Invalid`] for a document without results to draw.
pub fn drawable(document: &mut Value) -> Result<(), Error> {
    if is_scores(document) {
        return Ok(());
    }
    if !document.is_object() {
        return Err(Error::Invalid(
            "found no document, expected what solve, sweep, mobility or bench --json prints".to_owned(),
        ));
    }
    let is_posed = document["scene"].is_object();
    let Some(stage) = (if is_posed { None } else { stage(document) }) else { return Ok(()) };
    document["scene"] = scene::json(&stage.scene);
    if document["branches"].is_array() && document["results"].is_null() {
        pose_sweep(document, &stage);
    }
    for result in document["results"].as_array_mut().into_iter().flatten() {
        pose_result(result, &stage);
    }
    pose_motion(document, &stage);
    Ok(())
}

/// The realisations along the motion of a framework, or those of the file where it does not move; the configurations of a
/// loop.
fn pose_motion(document: &mut Value, stage: &Stage) {
    let flat = |position: &Value| -> Option<Vec<f64>> {
        position.as_array()?.iter().flat_map(|v| v.as_array().into_iter().flatten()).map(Value::as_f64).collect()
    };
    let list = |q: Option<Vec<f64>>| q.and_then(|q| stage.poses(&q)).map(|poses| json!({ "poses": poses }));
    if document["kind"] == "framework" {
        let seen = document["flex"]["positions"].as_array().filter(|positions| !positions.is_empty());
        let frames: Vec<Value> = match seen {
            Some(positions) => positions.iter().filter_map(|position| list(flat(position))).collect(),
            None => list(flat(&document["mechanism"]["vertices"])).into_iter().collect(),
        };
        document["motion"] = json!(frames);
    }
    for configuration in document["configurations"].as_array_mut().into_iter().flatten() {
        let q: Option<Vec<f64>> = configuration["q"].as_array().and_then(|q| q.iter().map(Value::as_f64).collect());
        if let Some(posed) = list(q) {
            configuration["poses"] = posed["poses"].clone();
        }
    }
}
