//! Sweeps of linkages as text, CSV, JSON and a picture.

use super::document::units;
use super::json::number;
use super::linkage::joint_variables;
use super::model;
use super::number::{counted, short};
use super::picture::{COLOURS, Frame, Graph, escaped, graphs_svg};
use super::table::{Columns, paragraph};
use crate::catalogue::LinkageFile;
use crate::kinematics::linkage::Gaussian;
use crate::linkage::answer::LinkageMode;
use crate::sweep::{End, LinkageBranch, LinkageSweep};
use crate::verdict::Status;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// A point whose curve is requested.
#[derive(Clone, Debug)]
pub struct Traced {
    /// Its body.
    pub body: usize,
    /// Its name, `BODY.POINT`.
    pub name: String,
    /// Its place in the body.
    pub place: Gaussian,
}

impl Traced {
    /// Its place against the ground, metres.
    #[must_use]
    pub fn at(&self, mode: &LinkageMode) -> [f64; 2] {
        let (angle, origin) = &mode.bodies[self.body];
        let (sin, cos) = angle.re.sin_cos();
        let (x, y) = (self.place.re.to_f64(), self.place.im.to_f64());
        [origin[0].re + cos * x - sin * y, origin[1].re + sin * x + cos * y]
    }
}

/// The input and what is traced.
#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    /// The file.
    pub file: &'a LinkageFile,
    /// The point.
    pub traced: Option<&'a Traced>,
}

const REASON: &str =
    "not proved: the assemblies of every input are, but between the inputs branches are joined by their distances";

/// `4 branches, 2 limit positions, 361 inputs, all complete; branches not proved`
#[must_use]
pub fn verdict(sweep: &LinkageSweep) -> String {
    let branches =
        if sweep.branches.len() == 1 { "1 branch".to_owned() } else { format!("{} branches", sweep.branches.len()) };
    let (limits, inputs) = (counted(sweep.limits.len(), "limit position"), counted(sweep.samples.len(), "input"));
    let complete = match sweep.incomplete() {
        0 => "all complete".to_owned(),
        n => format!("{n} not proved complete"),
    };
    let unresolved = match sweep.unresolved() {
        0 => String::new(),
        n => format!(", {} of branches not resolved", counted(n, "end")),
    };
    format!("{branches}, {limits}, {inputs}, {complete}{unresolved}; branches not proved")
}

fn shown(file: &LinkageFile, sweep: &LinkageSweep, x: f64) -> String {
    if file.linkage.joints[sweep.joint].is_prismatic() {
        format!("{:.6}", x + 0.0)
    } else {
        format!("{:.4}", x.to_degrees() + 0.0)
    }
}

/// The verdict, the branches and the limit positions.
#[must_use]
pub fn text(asked: Asked<'_>, sweep: &LinkageSweep) -> String {
    let file = asked.file;
    let joint = &file.linkage.joints[sweep.joint];
    let unit = if joint.is_prismatic() { "m" } else { "deg" };
    let mut text = format!("{}\n", verdict(sweep));
    let range = [sweep.range.from, sweep.range.to]
        .map(|x| if joint.is_prismatic() { short(x, 9) } else { short(x.to_degrees(), 6) });
    let turn = if sweep.is_full_turn { ", a full turn" } else { "" };
    let steps = counted(sweep.range.steps, "step");
    let _ = writeln!(
        text,
        "{}, {} from {} to {} {unit} in {steps}{turn}",
        file.heading.title, joint.name, range[0], range[1]
    );
    let words = |end: &End| match end {
        End::Limit(limit) => format!("limit {}", limit + 1),
        End::Range => "end of range".to_owned(),
        End::Closed(turns) => format!("closed after {}", counted(*turns, "turn")),
        End::Unresolved([one, two]) => {
            format!("unresolved {} to {}", shown(file, sweep, *one), shown(file, sweep, *two))
        }
        End::Infinite(_) | End::Isolated => "isolated".to_owned(),
    };
    if !sweep.branches.is_empty() {
        let (from, to) = (format!("from [{unit}]"), format!("to [{unit}]"));
        let header = ["branch", "circuit", &from, "begins", &to, "ends", "inputs"];
        let mut table = Columns::new(&header, &["begins", "ends"]);
        for (index, branch) in sweep.branches.iter().enumerate() {
            table.row([
                (index + 1).to_string(),
                branch.circuit.to_string(),
                shown(file, sweep, branch.from),
                words(&branch.begin),
                shown(file, sweep, branch.to),
                words(&branch.end),
                branch.rows.len().to_string(),
            ]);
        }
        let _ = write!(text, "\n{}", table.text());
    }
    if !sweep.limits.is_empty() {
        let mut table = Columns::new(&["limit", "input", "branches", &format!("{} [{unit}]", joint.name)], &["input"]);
        for (index, limit) in sweep.limits.iter().enumerate() {
            let kind = if limit.is_largest { "largest" } else { "smallest" };
            let meeting: Vec<String> = limit.branches.iter().map(|branch| (branch + 1).to_string()).collect();
            table.row([(index + 1).to_string(), kind.to_owned(), meeting.join(", "), shown(file, sweep, limit.input)]);
        }
        let _ = write!(text, "\n{}", table.text());
    }
    text.push('\n');
    paragraph(&mut text, REASON);
    text
}

/// The values of a mode's joints, those that have one.
fn values(file: &LinkageFile, mode: &LinkageMode) -> Vec<(String, f64)> {
    let joints = file.linkage.joints.iter().zip(&mode.joints);
    joints.filter_map(|(joint, value)| Some((joint.name.clone(), value.as_ref()?.re + 0.0))).collect()
}

/// A field of a table with commas.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// One row per branch and step: radians and metres; the columns are the joints and the coordinates of the point.
#[must_use]
pub fn csv(asked: Asked<'_>, sweep: &LinkageSweep) -> String {
    let file = asked.file;
    let mut text = String::from("branch,circuit,turn,step,input,status");
    for joint in file.linkage.joints.iter().filter(|joint| !joint.is_gear()) {
        let _ = write!(text, ",{}", field(&joint.name));
    }
    if let Some(traced) = asked.traced {
        let _ = write!(text, ",{},{}", field(&format!("{}.x", traced.name)), field(&format!("{}.y", traced.name)));
    }
    text.push('\n');
    for (index, branch) in sweep.branches.iter().enumerate() {
        for row in &branch.rows {
            let sample = &sweep.samples[row.step];
            let mode = &sample.modes[row.mode];
            let (number, circuit, status) = (index + 1, branch.circuit, sample.status.word());
            let _ = write!(text, "{number},{circuit},{},{},{},{status}", row.turn, row.step, sample.input);
            for (_, value) in values(file, mode) {
                let _ = write!(text, ",{value}");
            }
            if let Some(traced) = asked.traced {
                let [x, y] = traced.at(mode);
                let _ = write!(text, ",{x},{y}");
            }
            text.push('\n');
        }
    }
    text
}

fn end_json(end: &End) -> Value {
    match end {
        End::Limit(limit) => json!({ "kind": "limit", "limit": limit + 1 }),
        End::Range => json!({ "kind": "range" }),
        End::Closed(turns) => json!({ "kind": "closed", "turns": turns }),
        End::Unresolved(between) => json!({ "kind": "unresolved", "between": between.map(number) }),
        End::Infinite(_) | End::Isolated => json!({ "kind": "isolated" }),
    }
}

/// Joints by name, all values in the order of the file, and the point.
fn place(asked: Asked<'_>, mode: &LinkageMode) -> Map<String, Value> {
    let values = values(asked.file, mode);
    let mut object = Map::new();
    object.insert("q".into(), values.iter().map(|(_, x)| number(*x)).collect());
    let joints: Map<String, Value> = values.into_iter().map(|(name, x)| (name, number(x))).collect();
    object.insert("joints".into(), Value::Object(joints));
    if let Some(traced) = asked.traced {
        let mut points = Map::new();
        points.insert(traced.name.clone(), json!(traced.at(mode).map(number)));
        object.insert("points".into(), Value::Object(points));
    }
    object
}

/// The document that equations/sweep.schema.json describes: radians and metres.
#[must_use]
pub fn json(asked: Asked<'_>, sweep: &LinkageSweep) -> Value {
    let file = asked.file;
    let joint = &file.linkage.joints[sweep.joint];
    let branch = |branch: &LinkageBranch| {
        let rows = branch.rows.iter().map(|row| {
            let mut object = place(asked, &sweep.samples[row.step].modes[row.mode]);
            object.insert("step".into(), json!(row.step));
            object.insert("turn".into(), json!(row.turn));
            Value::Object(object)
        });
        json!({
            "circuit": branch.circuit,
            "from": number(branch.from), "begins": end_json(&branch.begin),
            "to": number(branch.to), "ends": end_json(&branch.end),
            "rows": rows.collect::<Vec<_>>(),
        })
    };
    let limits = sweep.limits.iter().map(|limit| {
        let mut object = place(asked, &limit.mode);
        object.insert("input".into(), number(limit.input));
        object.insert("is".into(), json!(if limit.is_largest { "largest" } else { "smallest" }));
        object.insert("branches".into(), limit.branches.iter().map(|branch| branch + 1).collect());
        Value::Object(object)
    });
    let inputs = sweep.samples.iter().enumerate().map(|(step, sample)| {
        json!({
            "step": step, "input": number(sample.input), "status": sample.status.word(),
            "real": sample.modes.len(), "reason": sample.reason,
        })
    });
    let variables = file.linkage.joints.iter().filter(|joint| !joint.is_gear()).map(|joint| joint.name.clone());
    let self_motions = sweep.samples.iter().filter(|sample| sample.status == Status::SelfMotion).count();
    json!({
        "name": file.heading.name,
        "version": env!("CARGO_PKG_VERSION"),
        "units": units(),
        "joint_variables": joint_variables(file),
        "mechanism": model::linkage_json(file),
        "title": file.heading.title,
        "kind": "linkage",
        "joint": sweep.joint + 1,
        "variable": joint.name,
        "from": number(sweep.range.from),
        "to": number(sweep.range.to),
        "steps": sweep.range.steps,
        "full_turn": sweep.is_full_turn,
        "verdict": {
            "status": "incomplete",
            "proof": "none",
            "code": if sweep.unresolved() > 0 { "branches-not-matched" } else { "no-exact-route" },
            "reason": REASON,
            "branches": sweep.branches.len(),
            "limits": sweep.limits.len(),
            "complex_limits": null,
            "inputs": sweep.samples.len(),
            "incomplete": sweep.incomplete(),
            "self_motion": self_motions,
            "unresolved": sweep.unresolved(),
        },
        "variables": variables.collect::<Vec<_>>(),
        "branches": sweep.branches.iter().map(branch).collect::<Vec<_>>(),
        "limits": limits.collect::<Vec<_>>(),
        "standing": [],
        "inputs": inputs.collect::<Vec<_>>(),
    })
}

/// Every joint against the input, one panel each.
#[must_use]
pub fn joints_svg(file: &LinkageFile, sweep: &LinkageSweep) -> String {
    let joints = &file.linkage.joints;
    let is_turn = |joint: usize| !joints[joint].is_prismatic();
    let unit = |joint: usize| if is_turn(joint) { "deg" } else { "m" };
    let shown = |joint: usize, x: f64| if is_turn(joint) { x.to_degrees() } else { x };
    let graph = |joint: usize| {
        let point = |input: f64, mode: &LinkageMode| {
            [shown(sweep.joint, input), mode.joints[joint].map_or(f64::NAN, |value| shown(joint, value.re))]
        };
        let line = |branch: &LinkageBranch| {
            let limit = |end: &End| match end {
                End::Limit(limit) => Some(point(sweep.limits[*limit].input, &sweep.limits[*limit].mode)),
                _ => None,
            };
            let turns = branch.rows.iter().map(|row| row.turn).max().unwrap_or(0);
            let points = |turn: usize| {
                let rows = branch.rows.iter().filter(|row| row.turn == turn);
                let rows = rows.map(|row| {
                    let sample = &sweep.samples[row.step];
                    point(sample.input, &sample.modes[row.mode])
                });
                let first = if turn == 0 { limit(&branch.begin) } else { None };
                let last = if turn == turns { limit(&branch.end) } else { None };
                first.into_iter().chain(rows).chain(last).collect()
            };
            (branch.circuit, (0..=turns).map(points).collect())
        };
        let circuit = |branches: &[usize]| branches.first().map_or(1, |branch| sweep.branches[*branch].circuit);
        Graph {
            label: format!("{} [{}]", joints[joint].name, unit(joint)),
            is_turn: is_turn(joint),
            lines: sweep.branches.iter().map(line).collect(),
            dots: sweep.limits.iter().map(|limit| (point(limit.input, &limit.mode), circuit(&limit.branches))).collect(),
        }
    };
    let others = (0..joints.len()).filter(|joint| *joint != sweep.joint && !joints[*joint].is_gear());
    let frame = Frame {
        title: &file.heading.title,
        verdict: &verdict(sweep),
        input: &format!("{} [{}]", joints[sweep.joint].name, unit(sweep.joint)),
        is_turn: is_turn(sweep.joint),
        range: [sweep.range.from, sweep.range.to].map(|x| shown(sweep.joint, x)),
    };
    graphs_svg(&frame, &others.map(graph).collect::<Vec<_>>())
}

/// Width and height of the picture, in pixels.
const SIZE: f64 = 640.0;
/// Room on every side.
const MARGIN: f64 = 60.0;

/// The curve of the point: one colour for every circuit, limit positions as dots, both axes in one scale.
#[must_use]
pub fn svg(file: &LinkageFile, traced: &Traced, sweep: &LinkageSweep) -> String {
    let colour = |circuit: usize| COLOURS[(circuit.max(1) - 1) % COLOURS.len()];
    let paths: Vec<(usize, Vec<[f64; 2]>)> = sweep
        .branches
        .iter()
        .map(|branch| {
            let limit = |end: &End| match end {
                End::Limit(limit) => Some(traced.at(&sweep.limits[*limit].mode)),
                _ => None,
            };
            let rows = branch.rows.iter().map(|row| traced.at(&sweep.samples[row.step].modes[row.mode]));
            (branch.circuit, limit(&branch.begin).into_iter().chain(rows).chain(limit(&branch.end)).collect())
        })
        .collect();
    let points = || paths.iter().flat_map(|(_, path)| path);
    let extent = |k: usize| {
        let values = || points().map(move |point| point[k]);
        [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)]
    };
    let (x, y) = (extent(0), extent(1));
    let span = (x[1] - x[0]).max(y[1] - y[0]);
    let scale = if span.is_normal() { (SIZE - 2.0 * MARGIN) / span } else { 1.0 };
    let middle = [0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])].map(|m| if m.is_finite() { m } else { 0.0 });
    let at =
        |point: &[f64; 2]| [0.5 * SIZE + scale * (point[0] - middle[0]), 0.5 * SIZE - scale * (point[1] - middle[1])];
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {SIZE:.0} {SIZE:.0}\" width=\"{SIZE:.0}\" height=\"{SIZE:.0}\" \
         font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n\
         <text x=\"16\" y=\"26\" font-size=\"17\" font-weight=\"bold\">{}</text>\n\
         <text x=\"16\" y=\"46\" fill=\"#444\">curve of {}; one colour for each circuit, dots are limit positions</text>\n",
        escaped(&file.heading.title),
        escaped(&traced.name),
    );
    for (circuit, path) in paths.iter().filter(|(_, path)| path.len() > 1) {
        let mut d = String::new();
        for (k, point) in path.iter().enumerate() {
            let [x, y] = at(point);
            let _ = write!(d, "{}{x:.2} {y:.2}", if k == 0 { "M" } else { "L" });
        }
        let _ = writeln!(text, "<path d=\"{d}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\"/>", colour(*circuit));
    }
    for limit in &sweep.limits {
        let [x, y] = at(&traced.at(&limit.mode));
        let circuit = limit.branches.first().map_or(1, |branch| sweep.branches[*branch].circuit);
        let _ = writeln!(
            text,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3.4\" fill=\"{}\" stroke=\"#fff\"/>",
            colour(circuit)
        );
    }
    let (x, y) = (x.map(|v| short(v, 6)), y.map(|v| short(v, 6)));
    let _ = writeln!(
        text,
        "<text x=\"16\" y=\"{:.0}\" fill=\"#444\">x from {} to {} m, y from {} to {} m</text>\n</svg>",
        SIZE - 16.0,
        x[0],
        x[1],
        y[0],
        y[1]
    );
    text
}
