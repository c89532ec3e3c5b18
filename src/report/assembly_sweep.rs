//! Sweeps whose branches are joined by the distances of assemblies, as text and JSON, whatever the mechanism.

use super::json::number;
use super::number::{counted, short};
use super::picture::Graph;
use super::sweep::proof_words;
use super::table::{Columns, paragraph};
use crate::sweep::{AssemblyBranch, AssemblySweep, End};
use crate::verdict::Status;
use serde_json::{Map, Value, json};
use std::fmt::Write;

/// `4 branches, 2 limit positions, 361 inputs, all complete; branches not proved`
#[must_use]
pub fn verdict<M>(sweep: &AssemblySweep<M>) -> String {
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
    format!("{branches}, {limits}, {inputs}, {complete}{unresolved}{}", proof_words(sweep.verdict.proof))
}

/// The input that runs.
#[derive(Clone, Copy, Debug)]
pub struct Input<'a> {
    /// The title of the mechanism.
    pub title: &'a str,
    /// The name of the input.
    pub name: &'a str,
    /// Whether it is a length, else an angle.
    pub is_length: bool,
}

impl Input<'_> {
    /// Returns the unit.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        if self.is_length { "m" } else { "deg" }
    }

    /// Returns the input in its unit.
    #[must_use]
    pub fn value(&self, x: f64) -> f64 {
        if self.is_length { x } else { x.to_degrees() }
    }

    /// Returns the input as text.
    #[must_use]
    pub fn shown(&self, x: f64) -> String {
        let (value, decimals) = (self.value(x) + 0.0, if self.is_length { 6 } else { 4 });
        format!("{value:.decimals$}")
    }
}

/// Returns the verdict, the branches and the limit positions. `more` is a further column of the branches, by its name.
#[must_use]
pub fn text<M>(input: Input<'_>, sweep: &AssemblySweep<M>, more: Option<(&str, &[String])>) -> String {
    let unit = input.unit();
    let mut text = format!("{}\n", verdict(sweep));
    let digits = if input.is_length { 9 } else { 6 };
    let range = [sweep.range.from, sweep.range.to].map(|x| short(input.value(x), digits));
    let turn = if sweep.is_full_turn { ", a full turn" } else { "" };
    let steps = counted(sweep.range.steps, "step");
    let _ = writeln!(text, "{}, {} from {} to {} {unit} in {steps}{turn}", input.title, input.name, range[0], range[1]);
    let words = |end: &End| match end {
        End::Limit(limit) => format!("limit {}", limit + 1),
        End::Range => "end of range".to_owned(),
        End::Closed(turns) => format!("closed after {}", counted(*turns, "turn")),
        End::Unresolved([one, two]) => format!("unresolved {} to {}", input.shown(*one), input.shown(*two)),
        End::Infinite(near) => format!("to infinity near {}", input.shown(*near)),
        End::Isolated => "isolated".to_owned(),
    };
    if !sweep.branches.is_empty() {
        let (from, to) = (format!("from [{unit}]"), format!("to [{unit}]"));
        let mut header = vec!["branch", "circuit", &from, "begins", &to, "ends", "inputs"];
        header.extend(more.map(|(name, _)| name));
        let words_of = more.map_or("ends", |(name, _)| name);
        let mut table = Columns::new(&header, &["begins", "ends", words_of]);
        for (index, branch) in sweep.branches.iter().enumerate() {
            let own = [
                (index + 1).to_string(),
                branch.circuit.to_string(),
                input.shown(branch.from),
                words(&branch.begin),
                input.shown(branch.to),
                words(&branch.end),
                branch.rows.len().to_string(),
            ];
            table.row(own.into_iter().chain(more.map(|(_, cells)| cells[index].clone())));
        }
        let _ = write!(text, "\n{}", table.text());
    }
    if !sweep.limits.is_empty() {
        let name = format!("{} [{unit}]", input.name);
        let mut table = Columns::new(&["limit", "input", "branches", &name], &["input"]);
        for (index, limit) in sweep.limits.iter().enumerate() {
            let kind = if limit.is_largest { "largest" } else { "smallest" };
            let meeting: Vec<String> = limit.branches.iter().map(|branch| (branch + 1).to_string()).collect();
            table.row([(index + 1).to_string(), kind.to_owned(), meeting.join(", "), input.shown(limit.input)]);
        }
        let _ = write!(text, "\n{}", table.text());
    }
    text.push('\n');
    paragraph(&mut text, &sweep.verdict.reason);
    text
}

/// Returns the lines and the dots of a graph: one line for every branch and turn, one dot for every limit position.
#[must_use]
pub fn graph<M>(sweep: &AssemblySweep<M>, label: String, is_turn: bool, point: impl Fn(f64, &M) -> [f64; 2]) -> Graph {
    let line = |branch: &AssemblyBranch| {
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
        label,
        is_turn,
        lines: sweep.branches.iter().map(line).collect(),
        dots: sweep.limits.iter().map(|limit| (point(limit.input, &limit.mode), circuit(&limit.branches))).collect(),
    }
}

fn end_json(end: &End) -> Value {
    match end {
        End::Limit(limit) => json!({ "kind": "limit", "limit": limit + 1 }),
        End::Range => json!({ "kind": "range" }),
        End::Closed(turns) => json!({ "kind": "closed", "turns": turns }),
        End::Unresolved(between) => json!({ "kind": "unresolved", "between": between.map(number) }),
        End::Infinite(near) => json!({ "kind": "infinity", "near": number(*near) }),
        End::Isolated => json!({ "kind": "isolated" }),
    }
}

/// Inserts the keys of a sweep into a document: range, verdict, branches, limit positions and inputs. `place` makes the keys of an
/// assembly.
pub fn insert<M>(document: &mut Value, sweep: &AssemblySweep<M>, place: impl Fn(&M) -> Map<String, Value>) {
    let branch = |branch: &AssemblyBranch| {
        let rows = branch.rows.iter().map(|row| {
            let mut object = place(&sweep.samples[row.step].modes[row.mode]);
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
        let mut object = place(&limit.mode);
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
    let self_motions = sweep.samples.iter().filter(|sample| sample.status == Status::SelfMotion).count();
    document["joint"] = json!(sweep.joint + 1);
    document["from"] = number(sweep.range.from);
    document["to"] = number(sweep.range.to);
    document["steps"] = json!(sweep.range.steps);
    document["full_turn"] = json!(sweep.is_full_turn);
    document["verdict"] = json!({
        "status": sweep.verdict.status.word(),
        "proof": sweep.verdict.proof.word(),
        "code": sweep.verdict.code.word(),
        "reason": sweep.verdict.reason,
        "branches": sweep.branches.len(),
        "limits": sweep.limits.len(),
        "complex_limits": sweep.complex_limits,
        "inputs": sweep.samples.len(),
        "incomplete": sweep.incomplete(),
        "self_motion": self_motions,
        "unresolved": sweep.unresolved(),
    });
    document["branches"] = sweep.branches.iter().map(branch).collect();
    document["limits"] = limits.collect();
    document["standing"] = json!([]);
    document["inputs"] = inputs.collect();
}
