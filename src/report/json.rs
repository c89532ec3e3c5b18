//! JSON as equations/result.schema.json describes it: radians, lengths in metres, finite numbers only.

use super::line;
use super::model::Asked;
use super::text::View;
use crate::catalogue::entry::{Case, Entry, Kind};
use crate::kinematics::platform_limits::Part;
use crate::kinematics::tolerance::PoseError;
use crate::mechanism::{Family, FullMode, Solution};
use crate::verdict::{Code, Proof, Verdict};
use num_complex::Complex;
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Map, Value, json};

/// The word of a kind.
#[must_use]
pub fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Arm => "arm",
        Kind::Loop => "loop",
        Kind::Platform => "platform",
    }
}

/// Returns the document before the results, up to the opening bracket of the list. `keys` are the keys of every document.
#[must_use]
pub fn head(entry: &Entry, keys: &Map<String, Value>) -> String {
    let mut text = format!("{{ \"title\": {}, \"kind\": \"{}\",", json!(entry.title), kind(entry.kind()));
    for (key, value) in keys {
        text += &format!(" {}: {value},", json!(key));
    }
    text + " \"results\": ["
}

/// The document that [`head`], the results and [`foot`] write; `branches` are those of a path of poses.
#[must_use]
pub fn document(
    entry: &Entry,
    keys: &Map<String, Value>,
    results: Vec<Value>,
    branches: Option<Value>,
    seed: Option<u64>,
) -> Value {
    let mut document = line_of_document(entry, keys)["document"].take();
    document["results"] = Value::Array(results);
    if let Some(branches) = branches {
        document["branches"] = branches;
    }
    if let Some(seed) = seed {
        document["seed"] = json!(seed);
    }
    document
}

/// The first of several lines of JSON: what holds for all of them.
#[must_use]
pub fn line_of_document(entry: &Entry, keys: &Map<String, Value>) -> Value {
    let mut object = Map::new();
    object.insert("title".into(), json!(entry.title));
    object.insert("kind".into(), json!(kind(entry.kind())));
    object.extend(keys.clone());
    json!({ "document": object })
}

/// Returns the document after the results: the closing bracket, and the seed of the primes if any was drawn.
#[must_use]
pub fn foot(seed: Option<u64>) -> String {
    seed.map_or_else(|| "] }".to_owned(), |seed| format!("], \"seed\": {seed} }}"))
}

/// The answer to one case as a value, to insert more into. [`Answer`] writes the same without one.
#[must_use]
pub fn result(number: usize, case: &Case, solution: &Solution, labels: &[String], view: &View) -> Value {
    json!(Answer { number, case, solution, labels, view })
}

/// The answer to one case as it is written. A tree of values takes as long as it takes to solve an arm with parallel axes.
#[derive(Clone, Copy, Debug)]
pub struct Answer<'a> {
    /// Its number in the file, from 1.
    pub number: usize,
    /// The question.
    pub case: &'a Case,
    /// The answer.
    pub solution: &'a Solution,
    /// Labels of the joint variables.
    pub labels: &'a [String],
    /// Which modes are listed.
    pub view: &'a View,
}

/// What the JSON of an answer and of each of its modes takes, as a rule: memory is then asked for once.
const ANSWER_BYTES: usize = 1024;
const MODE_BYTES: usize = 400;

impl Answer<'_> {
    /// Returns the answer as a line of text, with its end.
    ///
    /// # Errors
    /// For values that JSON does not have.
    pub fn line(&self) -> serde_json::Result<Vec<u8>> {
        let mut text = Vec::with_capacity(ANSWER_BYTES + MODE_BYTES * self.solution.modes.len());
        line::append(self, &mut text)?;
        text.push(b'\n');
        Ok(text)
    }
}

impl Serialize for Answer<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let solution = self.solution;
        let mut map = to.serialize_map(None)?;
        map.serialize_entry("case", &self.number)?;
        map.serialize_entry("asked", &Asked(self.case))?;
        map.serialize_entry("verdict", &Judged(solution))?;
        if let Some((q, miss)) = &solution.nearest {
            let q: Value = q.iter().map(|x| number(*x)).collect();
            map.serialize_entry("nearest", &json!({ "q": q, "error": Miss(miss) }))?;
        }
        if let Some(platform) = &solution.platform {
            map.serialize_entry("legs", &platform.legs.map(Finite))?;
            map.serialize_entry("route", &platform.route)?;
            if !platform.outside.is_empty() {
                map.serialize_entry("outside", &words(&platform.outside))?;
            }
        }
        let is_platform = solution.platform.is_some();
        map.serialize_entry("modes", &Modes(solution, self.view))?;
        let families = solution.families.iter().map(|one| family(one, self.labels, is_platform));
        map.serialize_entry("families", &families.collect::<Vec<_>>())?;
        map.serialize_entry("warnings", &solution.warnings)?;
        map.serialize_entry("timings_us", &Timings(solution))?;
        map.end()
    }
}

/// A finite number, else null; zero has no sign.
struct Finite(f64);

impl Serialize for Finite {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        // What is not finite is null in JSON.
        to.serialize_f64(self.0 + 0.0)
    }
}

/// The time of a solution.
struct Timings<'a>(&'a Solution);

impl Serialize for Timings<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(2))?;
        map.serialize_entry("prepare", &Finite(in_tenths(self.0.prepare_us)))?;
        map.serialize_entry("solve", &Finite(in_tenths(self.0.solve_us)))?;
        map.end()
    }
}

/// The verdict of a solution: that of the list, with what only a solution has.
struct Judged<'a>(&'a Solution);

impl Serialize for Judged<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        insert_verdict(&mut map, &self.0.verdict, self.0.near())?;
        if let Some(arm) = self.0.arm.as_ref().filter(|arm| !arm.conditions.is_empty()) {
            map.serialize_entry("conditions", &arm.conditions)?;
        }
        map.end()
    }
}

/// A verdict, key by key.
fn insert_verdict<M: SerializeMap>(map: &mut M, verdict: &Verdict, near: usize) -> Result<(), M::Error> {
    map.serialize_entry("status", verdict.status.word())?;
    map.serialize_entry("proof", verdict.proof.word())?;
    map.serialize_entry("code", verdict.code.word())?;
    map.serialize_entry("complex_complete", &verdict.complex_complete)?;
    // Where the real solutions are counted alone, nothing is known of the others.
    let is_counted = verdict.complex_complete || verdict.code != Code::RealZerosMatched;
    map.serialize_entry("complex", &is_counted.then_some(verdict.complex))?;
    map.serialize_entry("real", &verdict.real)?;
    map.serialize_entry("at_infinity", &verdict.at_infinity)?;
    map.serialize_entry("self_motion", &verdict.self_motion)?;
    map.serialize_entry("certified", &verdict.certified)?;
    map.serialize_entry("near", &near)?;
    map.serialize_entry("reason", &verdict.reason)?;
    if let Proof::Probable { error, seed } = verdict.proof {
        map.serialize_entry("probability_of_error", &Finite(error))?;
        map.serialize_entry("seed", &seed)?;
    }
    Ok(())
}

/// A verdict as a value.
#[must_use]
pub fn verdict(verdict: &Verdict) -> Value {
    json!(Alone(verdict))
}

/// A verdict of a list in which no mode is near.
struct Alone<'a>(&'a Verdict);

impl Serialize for Alone<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        insert_verdict(&mut map, self.0, 0)?;
        map.end()
    }
}

/// By how much a pose is missed.
struct Miss<'a>(&'a PoseError);

impl Serialize for Miss<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(2))?;
        map.serialize_entry("position", &Finite(self.0.position))?;
        map.serialize_entry("orientation", &Finite(self.0.orientation))?;
        map.end()
    }
}

/// A set of solutions of dimension 1 and more; joint variables are numbered from 1.
fn family(family: &Family, labels: &[String], is_platform: bool) -> Value {
    let configuration = |q: &Vec<f64>| {
        let values = |part: &[f64]| part.iter().map(|x| number(*x)).collect::<Value>();
        match q.split_at_checked(4) {
            Some((quaternion, position)) if is_platform => {
                json!({ "quaternion": values(quaternion), "position": values(position) })
            }
            _ => json!({ "q": values(q) }),
        }
    };
    json!({
        "dimension": family.dimension,
        "joints": family.moving.iter().map(|variable| variable + 1).collect::<Vec<_>>(),
        "labels": family.moving.iter().filter_map(|variable| labels.get(*variable)).collect::<Vec<_>>(),
        "distance": number(family.distance),
        "sample": configuration(&family.sample),
        "samples": family.samples.iter().map(configuration).collect::<Vec<_>>(),
    })
}

/// The modes that are listed.
struct Modes<'a>(&'a Solution, &'a View);

impl Serialize for Modes<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let numbered = (1..).zip(&self.0.modes).filter(|(_, mode)| self.1.shows(mode));
        to.collect_seq(numbered.map(|(id, mode)| Listed(id, mode)))
    }
}

/// A mode with its number among all modes, listed or not.
struct Listed<'a>(usize, &'a FullMode);

impl Serialize for Listed<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let Self(id, mode) = self;
        let mut map = to.serialize_map(None)?;
        map.serialize_entry("id", id)?;
        map.serialize_entry("real", &mode.real)?;
        match (&mode.platform, mode.q.split_at_checked(4)) {
            (Some(_), Some((quaternion, position))) => {
                map.serialize_entry("quaternion", &Values(quaternion, mode.real))?;
                map.serialize_entry("position", &Values(position, mode.real))?;
            }
            _ => map.serialize_entry("q", &Values(&mode.q, mode.real))?,
        }
        map.serialize_entry("multiplicity", &(mode.multiplicity > 0).then_some(mode.multiplicity))?;
        map.serialize_entry("residual", &Finite(mode.residual))?;
        map.serialize_entry("condition", &Finite(mode.condition))?;
        map.serialize_entry("certified", &mode.certified)?;
        map.serialize_entry("radius", &Finite(mode.radius))?;
        if mode.near {
            map.serialize_entry("near", &true)?;
        }
        if let Some(miss) = &mode.error {
            map.serialize_entry("error", &Miss(miss))?;
        }
        match &mode.platform {
            Some(platform) => {
                let velocity = platform.velocity.as_ref();
                map.serialize_entry("mirror", &platform.mirror)?;
                if let Some(within) = mode.within_limits {
                    map.serialize_entry("within_limits", &within)?;
                    map.serialize_entry("outside", &words(&platform.outside))?;
                }
                map.serialize_entry("singular_values", &velocity.map(|v| v.singular_values.map(Finite)))?;
                let twist = velocity.and_then(|v| v.twist.map(|rows| rows.map(|row| row.map(Finite))));
                map.serialize_entry("twist", &twist)?;
            }
            None => map.serialize_entry("within_limits", &mode.within_limits)?,
        }
        map.end()
    }
}

/// Coordinates of a mode: numbers where it is real, else pairs of real and imaginary part.
struct Values<'a>(&'a [Complex<f64>], bool);

impl Serialize for Values<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        if self.1 {
            to.collect_seq(self.0.iter().map(|z| Finite(z.re)))
        } else {
            to.collect_seq(self.0.iter().map(|z| [Finite(z.re), Finite(z.im)]))
        }
    }
}

/// The parts of a platform that are outside their limits.
#[must_use]
pub fn words(parts: &[Part]) -> Value {
    parts.iter().map(Part::to_string).collect()
}

/// A finite number, else null; zero has no sign.
#[must_use]
pub fn number(x: f64) -> Value {
    if x.is_finite() { json!(x + 0.0) } else { Value::Null }
}

/// Microseconds with one decimal.
#[must_use]
pub fn tenths(microseconds: f64) -> Value {
    number(in_tenths(microseconds))
}

fn in_tenths(microseconds: f64) -> f64 {
    (microseconds * 10.0).round() / 10.0
}
