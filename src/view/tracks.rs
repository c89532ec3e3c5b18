//! The tracks of a page: a mode is one configuration, a family, a branch or a motion runs through many.

use super::encode;
use serde_json::{Value, json};

/// One of them.
#[derive(Clone, Debug)]
pub(super) struct Track<'a> {
    /// Its name on buttons.
    pub(super) name: String,
    pub(super) kind: Kind,
    /// Index of the result to which it belongs, from 0.
    pub(super) case: usize,
    /// Its object in the document.
    pub(super) source: &'a Value,
    /// The objects with `poses`.
    pub(super) frames: Vec<&'a Value>,
    /// The input at every frame, degrees or metres.
    pub(super) inputs: Option<Vec<f64>>,
}

/// The kind of a track.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Mode,
    /// The configuration of an arm that comes nearest to a pose which nothing reaches.
    Nearest,
    Family,
    Branch,
    Motion,
}

impl Kind {
    fn word(self) -> &'static str {
        match self {
            // It is chosen and drawn as a mode.
            Self::Mode | Self::Nearest => "mode",
            Self::Family => "family",
            Self::Branch => "branch",
            Self::Motion => "motion",
        }
    }
}

/// A list of the document, empty where there is none.
pub(super) fn list<'a>(object: &'a Value, key: &str) -> &'a [Value] {
    object[key].as_array().map_or(&[], Vec::as_slice)
}

/// Whether it is the document of a sweep.
pub(super) fn is_sweep(document: &Value) -> bool {
    document["branches"].is_array() && !is_path(document)
}

/// Whether it is the document of `solve --follow`: the poses are a path, and modes of neighbouring poses are connected.
pub(super) fn is_path(document: &Value) -> bool {
    document["branches"].is_array() && document["results"].is_array()
}

/// All tracks of a document, in the order of its page.
pub(super) fn tracks(document: &Value) -> Vec<Track<'_>> {
    let mut tracks = Vec::new();
    for (case, result) in list(document, "results").iter().enumerate() {
        for mode in list(result, "modes") {
            let name = mode["id"].as_u64().map_or_else(String::new, |id| id.to_string());
            tracks.push(Track { name, kind: Kind::Mode, case, source: mode, frames: vec![mode], inputs: None });
        }
        let nearest = &result["nearest"];
        if nearest.is_object() {
            let (name, frames) = ("nearest".to_owned(), vec![nearest]);
            tracks.push(Track { name, kind: Kind::Nearest, case, source: nearest, frames, inputs: None });
        }
        for (index, family) in list(result, "families").iter().enumerate() {
            let samples = list(family, "samples");
            let frames = if samples.is_empty() { vec![&family["sample"]] } else { samples.iter().collect() };
            let name = family_name(index, family);
            tracks.push(Track { name, kind: Kind::Family, case, source: family, frames, inputs: None });
        }
    }
    if is_path(document) {
        tracks.extend(path(document));
        return tracks;
    }
    for (index, branch) in list(document, "branches").iter().enumerate() {
        let rows = list(branch, "rows");
        let inputs = rows.iter().map(|row| input(document, row)).collect();
        let (name, frames) = ((index + 1).to_string(), rows.iter().collect());
        tracks.push(Track { name, kind: Kind::Branch, case: 0, source: branch, frames, inputs: Some(inputs) });
    }
    for (index, configuration) in list(document, "configurations").iter().enumerate() {
        let (name, frames) = ((index + 1).to_string(), vec![configuration]);
        tracks.push(Track { name, kind: Kind::Mode, case: 0, source: configuration, frames, inputs: None });
    }
    let motion = list(document, "motion");
    if !motion.is_empty() {
        let (name, frames) = ("motion".to_owned(), motion.iter().collect());
        tracks.push(Track { name, kind: Kind::Motion, case: 0, source: document, frames, inputs: None });
    }
    tracks
}

/// Returns the index of the track that a page shows first: of the case that it begins with, a configuration within the limits of the
/// joints where there is one, else the first that is drawn.
pub(super) fn begun(document: &Value, tracks: &[Track<'_>]) -> usize {
    let drawn = |track: &Track<'_>| track.frames.iter().any(|frame| frame["poses"].is_array());
    let own = |track: &Track<'_>| drawn(track) && track.case == first_case(document);
    let within = |track: &Track<'_>| own(track) && track.source["within_limits"] == true;
    let first = |is_right: &dyn Fn(&Track<'_>) -> bool| tracks.iter().position(is_right);
    first(&within).or_else(|| first(&own)).or_else(|| first(&drawn)).unwrap_or(0)
}

/// Returns the case that is shown first: the path as a whole, where there is one.
pub(super) fn first_case(document: &Value) -> usize {
    if is_path(document) { list(document, "results").len() } else { 0 }
}

/// The branches of a path. Their case is the one behind the last pose: the path as a whole.
fn path(document: &Value) -> Vec<Track<'_>> {
    let results = list(document, "results");
    let mut tracks = Vec::new();
    for source in list(document, "branches") {
        let mut frames = Vec::new();
        let mut inputs = Vec::new();
        for result in results {
            let own = list(result, "modes")
                .iter()
                .find(|mode| mode["branch"].is_u64() && mode["branch"] == source["branch"] && mode["q"].is_array());
            if let (Some(mode), Some(case)) = (own, result["case"].as_f64()) {
                frames.push(mode);
                inputs.push(case);
            }
        }
        let name = source["branch"].to_string();
        tracks.push(Track { name, kind: Kind::Branch, case: results.len(), source, frames, inputs: Some(inputs) });
    }
    tracks
}

/// `self-motion of q1, q4`
fn family_name(index: usize, family: &Value) -> String {
    let labels: Vec<&str> = list(family, "labels").iter().filter_map(Value::as_str).collect();
    if labels.is_empty() {
        format!("self-motion {}", index + 1)
    } else {
        format!("self-motion of {}", labels.join(", "))
    }
}

/// Whether the swept joint turns.
pub(super) fn turns(document: &Value) -> bool {
    if is_path(document) {
        return false;
    }
    let name = document["variable"].as_str().unwrap_or("q");
    let own = list(document, "joint_variables").iter().find(|variable| variable["name"] == name);
    own.map_or(!name.starts_with('d'), |variable| variable["kind"] != "distance")
}

/// The input of a row in degrees or metres.
pub(super) fn input(document: &Value, row: &Value) -> f64 {
    let step = row["step"].as_u64().and_then(|step| usize::try_from(step).ok()).unwrap_or(0);
    shown(document, &list(document, "inputs").get(step).unwrap_or(&Value::Null)["input"])
}

/// A value of the input in degrees or metres.
pub(super) fn shown(document: &Value, value: &Value) -> f64 {
    let value = value.as_f64().unwrap_or(0.0);
    if turns(document) { value.to_degrees() } else { value }
}

/// Returns the stride between drawn configurations with which all of them fit into `bytes` bytes.
pub(super) fn stride(tracks: &[Track<'_>], bytes: usize) -> usize {
    let poses = |frame: &&Value| list(frame, "poses").len();
    let count: usize = tracks.iter().flat_map(|track| &track.frames).map(poses).sum();
    // Seven numbers of two bytes, four letters for three bytes.
    (count * 14 * 4 / 3).div_ceil(bytes).max(1)
}

impl Track<'_> {
    /// As the script of the page reads it, with every configuration whose step is a multiple of `stride`, and the ends.
    pub(super) fn json(&self, document: &Value, stride: usize) -> Value {
        let last = self.frames.len().saturating_sub(1);
        // Branches are drawn together at one input, so that all must keep the same steps.
        let step = |index: usize| {
            let own = self.frames[index]["step"].as_u64().and_then(|step| usize::try_from(step).ok());
            own.unwrap_or(index)
        };
        let kept: Vec<usize> =
            (0..self.frames.len()).filter(|k| *k == 0 || *k == last || step(*k).is_multiple_of(stride)).collect();
        let posed: Vec<&[Value]> =
            kept.iter().map(|k| list(self.frames[*k], "poses")).filter(|poses| !poses.is_empty()).collect();
        let is_whole = posed.len() == kept.len() && !posed.is_empty();
        let numbers: Vec<f64> = posed
            .iter()
            .flat_map(|poses| poses.iter().flat_map(|pose| pose.as_array().into_iter().flatten()))
            .map(|x| x.as_f64().unwrap_or(0.0))
            .collect();
        let mut object = json!({ "name": self.name, "kind": self.kind.word(), "case": self.case });
        if is_whole {
            let positions = numbers.iter().enumerate().filter(|(place, _)| place % 7 > 3);
            let reach = positions.map(|(_, x)| x.abs()).fold(0.0, f64::max);
            let reach = if reach > 0.0 { reach } else { 1.0 };
            object["reach"] = json!(reach);
            object["poses"] = json!(encode::poses(numbers.into_iter(), reach));
        }
        if let Some(inputs) = &self.inputs {
            let turns = turns(document);
            let rounded = kept.iter().map(|k| (inputs[*k] * 1e6).round() / 1e6);
            object["inputs"] = rounded.collect();
            let (variable, unit, digits) = match (is_path(document), turns) {
                (true, _) => (json!("pose"), "", 0),
                (false, true) => (document["variable"].clone(), "\u{b0}", 1),
                (false, false) => (document["variable"].clone(), " m", 4),
            };
            object["variable"] = variable;
            object["unit"] = json!(unit);
            object["digits"] = json!(digits);
            object["closed"] = json!(self.source["ends"]["kind"] == "closed");
        }
        object
    }
}
