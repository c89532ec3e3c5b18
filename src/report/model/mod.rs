//! A mechanism in its normalised form: what was understood of a file, for the reader to compare.

mod ansatz;
mod calculus;
mod chain;
mod framework;
mod linkage;
mod motion;
mod platform;
mod space;
mod sphere;
mod synthesis;

pub use ansatz::json as ansatz_json;
pub use framework::json as framework_json;
pub use linkage::json as linkage_json;
pub use platform::limits as platform_limits;
pub use space::json as space_json;
pub use sphere::json as sphere_json;
pub use synthesis::json as synthesis_json;

use super::json::{kind, number};
use super::number::counted;
use super::table::paragraph;
use crate::algebra::number::Reading;
use crate::catalogue::entry::{Case, Design, Entry, Expected, InputValue, Kind, Source};
use crate::catalogue::{Any, citation};
use crate::kinematics::chain::Placement;
use serde::ser::{Serialize, SerializeMap, Serializer};
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// A file of any kind as a table, with its source and its claims.
#[must_use]
pub fn any_text(any: &Any) -> String {
    match any {
        Any::Entry(entry) => text(entry),
        Any::Framework(file) => framework::text(file),
        Any::Linkage(file) => linkage::text(file),
        Any::Sphere(file) => sphere::text(file),
        Any::Space(file) => space::text(file),
        Any::Motion(file) => motion::text(file),
        Any::Synthesis(file) => synthesis::text(file),
        Any::Conditions(file) => ansatz::text(file),
        Any::Calculus(file) => calculus::text(file),
    }
}

/// A file of any kind in radians and metres.
#[must_use]
pub fn any_json(any: &Any) -> Value {
    match any {
        Any::Entry(entry) => json(entry),
        Any::Framework(file) => framework::json(file),
        Any::Linkage(file) => linkage::json(file),
        Any::Sphere(file) => sphere::json(file),
        Any::Space(file) => space::json(file),
        Any::Motion(file) => motion::json(file),
        Any::Synthesis(file) => synthesis::json(file),
        Any::Conditions(file) => ansatz::json(file),
        Any::Calculus(file) => calculus::json(file),
    }
}

/// Returns the listing of a file without its name: its kind in short, source, title; and the same as JSON.
#[must_use]
pub fn listed(any: &Any) -> ([String; 3], Value) {
    let (short, object) = match any {
        Any::Entry(entry) => (format!("{} {}", joints(entry), kind(entry.kind())), identity(entry)),
        Any::Framework(file) => (framework::short(file), framework::identity(file)),
        Any::Linkage(file) => (linkage::short(file), linkage::identity(file)),
        Any::Sphere(file) => (sphere::short(file), sphere::identity(file)),
        Any::Space(file) => (space::short(file), space::identity(file)),
        Any::Motion(file) => (motion::short(file), motion::identity(file)),
        Any::Synthesis(file) => (synthesis::short(file), synthesis::identity(file)),
        Any::Conditions(file) => (ansatz::short(file), ansatz::identity(file)),
        Any::Calculus(file) => (calculus::short(file), calculus::identity(file)),
    };
    let word = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let words = [short, word(&object["source"]["key"]), word(&object["title"])];
    (words, Value::Object(object))
}

/// The joints in short: `6R`, `RRPRRR`; of a platform the numbers of different points: `6-3`.
#[must_use]
pub fn joints(entry: &Entry) -> String {
    let letters = match &entry.design {
        Design::Platform(platform) => return platform::points(platform),
        Design::Arm(chain) | Design::Loop(chain) => chain::letters(chain),
    };
    let first = &letters[..1.min(letters.len())];
    if letters.len() > 1 && letters.replace(first, "").is_empty() {
        return format!("{}{first}", letters.len());
    }
    letters
}

/// `6 poses`, `1 input`.
#[must_use]
pub fn cases(entry: &Entry) -> String {
    counted(entry.cases.len(), case_noun(entry))
}

/// Returns the noun for a case of this entry.
#[must_use]
pub fn case_noun(entry: &Entry) -> &'static str {
    match entry.kind() {
        Kind::Arm => "pose",
        Kind::Loop => "input",
        // Legs that were computed from poses, of the file or of a table.
        Kind::Platform if entry.cases.first().is_none_or(|case| case.pose.is_some()) => "pose",
        Kind::Platform => "leg set",
    }
}

/// The claims of one sort over all cases: `16`, `4-8`, empty without any.
#[must_use]
pub fn claimed(entry: &Entry, claim: impl Fn(&Expected) -> Option<usize>) -> String {
    let counts: Vec<usize> = entry.cases.iter().filter_map(|case| claim(&case.expected)).collect();
    match (counts.iter().min(), counts.iter().max()) {
        (Some(low), Some(high)) if low == high => low.to_string(),
        (Some(low), Some(high)) => format!("{low}-{high}"),
        _ => String::new(),
    }
}

/// The model as a table, with its source and its claims.
#[must_use]
pub fn text(entry: &Entry) -> String {
    let mut text = format!("{}\n", entry.title);
    let _ = writeln!(text, "{} {}{}", joints(entry), kind(entry.kind()), formula(entry));
    origin(&mut text, entry.source.as_ref(), entry.notes.as_deref());
    if entry.rounded {
        paragraph(&mut text, "exact: no; some numbers are irrational and rounded for exact work (--digits)");
    }
    let [length, angle] = entry.reading.units();
    if [length, angle] != Reading::default().units() {
        paragraph(&mut text, &format!("plain numbers of options: {length}, {angle}"));
    }
    text.push('\n');
    match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => chain::write(&mut text, entry, chain),
        Design::Platform(platform) => platform::write(&mut text, entry, platform),
    }
    let _ = write!(text, "\n{}", cases(entry));
    let solutions: usize = entry.cases.iter().map(|case| case.expected.solutions.len()).sum();
    let claims = [
        ("complex", claimed(entry, |e| e.complex)),
        ("real", claimed(entry, |e| e.real)),
        ("dimension", claimed(entry, |e| e.dimension)),
        ("solutions", if solutions > 0 { solutions.to_string() } else { String::new() }),
    ];
    let claims: Vec<String> = claims
        .into_iter()
        .filter(|(_, count)| !count.is_empty())
        .map(|(what, count)| format!("{what} {count}"))
        .collect();
    if claims.is_empty() {
        text.push_str(", no claims\n");
    } else {
        let _ = writeln!(text, "; claimed: {}", claims.join(", "));
    }
    text
}

/// Writes the source of a mechanism and the remarks of its file.
fn origin(text: &mut String, source: Option<&Source>, notes: Option<&str>) {
    if let Some(source) = source {
        let place = source.place.as_ref().map_or(String::new(), |place| format!(", {place}"));
        let citation = citation(&source.key).map_or(String::new(), |citation| format!(". {citation}"));
        paragraph(text, &format!("source: [{}]{place}{citation}", source.key));
    }
    if let Some(notes) = notes {
        paragraph(text, &format!("notes: {notes}"));
    }
}

/// Inserts the source and the remarks for JSON.
fn remarks(object: &mut Map<String, Value>, source: Option<&Source>, notes: Option<&str>) {
    object.insert("notes".into(), json!(notes));
    object.insert("citation".into(), json!(source.and_then(|source| citation(&source.key))));
}

/// The claims in one line.
fn claims<const N: usize>(claims: [(&str, Option<String>); N]) -> String {
    let claims: Vec<String> =
        claims.into_iter().filter_map(|(what, claim)| claim.map(|claim| format!("{what} {claim}"))).collect();
    if claims.is_empty() { "no claims\n".to_owned() } else { format!("claimed: {}\n", claims.join(", ")) }
}

/// Returns the formula that relates its numbers.
fn formula(entry: &Entry) -> String {
    match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => {
            let (name, formula) = chain::convention(&chain.geometry);
            format!(", {name}: {formula}")
        }
        Design::Platform(_) => ": leg i is |p + R plate_i - base_i| long".to_owned(),
    }
}

/// The homogeneous matrix of a placement.
fn matrix(placement: &Placement) -> [[f64; 4]; 4] {
    let motion = &placement.float;
    let mut rows = [[0.0, 0.0, 0.0, 1.0]; 4];
    for (i, row) in rows.iter_mut().take(3).enumerate() {
        row[..3].copy_from_slice(&motion.rotation[i]);
        row[3] = motion.translation[i];
    }
    rows
}

/// The model in radians and metres.
#[must_use]
pub fn json(entry: &Entry) -> Value {
    let mut object = identity(entry);
    remarks(&mut object, entry.source.as_ref(), entry.notes.as_deref());
    match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => chain::insert(&mut object, entry, chain),
        Design::Platform(platform) => platform::insert(&mut object, entry, platform),
    }
    object.insert("exact".into(), json!(!entry.rounded));
    object.insert("cases".into(), json!(entry.cases.iter().map(Claimed).collect::<Vec<_>>()));
    Value::Object(object)
}

fn identity(entry: &Entry) -> Map<String, Value> {
    let kinds = match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => chain::letters(chain),
        Design::Platform(platform) => platform::points(platform),
    };
    labels(&entry.name, &entry.title, kind(entry.kind()), &kinds, entry.source.as_ref())
}

/// Returns the common part of every listing: name, title, kind, type and source.
fn labels(name: &str, title: &str, kind: &str, kinds: &str, source: Option<&Source>) -> Map<String, Value> {
    let source = source.map(|source| json!({ "key": source.key, "where": source.place }));
    let mut object = Map::new();
    object.insert("name".into(), json!(name));
    object.insert("title".into(), json!(title));
    object.insert("kind".into(), json!(kind));
    object.insert("type".into(), json!(kinds));
    object.insert("source".into(), json!(source));
    object
}

/// A case with its claims.
struct Claimed<'a>(&'a Case);

impl Serialize for Claimed<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        Asked(self.0).insert(&mut map)?;
        map.serialize_entry("expected", &expected(&self.0.expected, self.0.legs_squared.is_some()))?;
        map.end()
    }
}

/// The request of a case: a pose, the value of a joint, or the lengths of legs.
pub(super) struct Asked<'a>(pub &'a Case);

impl Serialize for Asked<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        self.insert(&mut map)?;
        map.end()
    }
}

impl Asked<'_> {
    fn insert<M: SerializeMap>(&self, map: &mut M) -> Result<(), M::Error> {
        if let Some(pose) = &self.0.pose {
            map.serialize_entry("matrix", &matrix(pose))?;
        }
        for input in &self.0.input {
            map.serialize_entry("joint", &input.joint)?;
            match &input.value {
                InputValue::Angle(angle) => map.serialize_entry("angle", &number(angle.radians()))?,
                InputValue::Distance(distance) => map.serialize_entry("distance", &number(distance.to_f64()))?,
            }
        }
        if let Some(squares) = &self.0.legs_squared {
            map.serialize_entry("legs", &platform::lengths(squares).map(number))?;
        }
        Ok(())
    }
}

/// The claims of a case.
fn expected(expected: &Expected, of_platform: bool) -> Value {
    let counts = [("complex", expected.complex), ("real", expected.real), ("dimension", expected.dimension)];
    let mut object: Map<String, Value> =
        counts.into_iter().filter_map(|(key, count)| Some((key.to_owned(), json!(count?)))).collect();
    if !expected.solutions.is_empty() {
        let solutions = expected.solutions.iter().map(|claim| match claim.q.split_at_checked(4) {
            Some((quaternion, position)) if of_platform => {
                json!({ "quaternion": quaternion, "position": position, "digits": claim.digits })
            }
            _ => json!({ "q": claim.q, "digits": claim.digits }),
        });
        object.insert("solutions".into(), json!(solutions.collect::<Vec<_>>()));
    }
    Value::Object(object)
}
