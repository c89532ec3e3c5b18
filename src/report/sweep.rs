//! A sweep as text, CSV and JSON.

use super::json::{kind, number};
use super::number::{counted, short};
use super::table::{Columns, paragraph};
use super::text::variables;
use crate::catalogue::entry::Entry;
use crate::kinematics::closed_loop::Variable;
use crate::sweep::{Branch, End, Limit, Sample, Sweep};
use crate::verdict::{Proof, Status};
use serde_json::{Value, json};
use std::fmt::Write;

/// The swept joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Swept {
    /// Its number, from 1.
    pub joint: usize,
    /// The variable of that joint.
    pub variable: Variable,
}

/// `4 branches, 2 limit positions, 361 inputs, all complete`
#[must_use]
pub fn verdict(sweep: &Sweep) -> String {
    let branches = match sweep.branches.len() {
        1 => "1 branch".to_owned(),
        n => format!("{n} branches"),
    };
    let inputs = sweep.samples.len();
    let mut text =
        format!("{branches}, {}, {}", counted(sweep.limits.len(), "limit position"), counted(inputs, "input"));
    if inputs < sweep.range.steps + 1 {
        let _ = write!(text, " of {}", sweep.range.steps + 1);
    }
    let odd = [(Status::Incomplete, "not proved complete"), (Status::SelfMotion, "on a self-motion")];
    let odd: Vec<String> = odd
        .into_iter()
        .filter_map(|(status, words)| Some(sweep.count(status)).filter(|n| *n > 0).map(|n| format!("{n} {words}")))
        .collect();
    text.push_str(", ");
    text.push_str(&if odd.is_empty() { "all complete".to_owned() } else { odd.join(", ") });
    if sweep.unresolved() > 0 {
        let _ = write!(text, ", {} of branches not resolved", counted(sweep.unresolved(), "end"));
    }
    text + proof_words(sweep.verdict.proof)
}

/// Whether the branches are proved.
pub(super) fn proof_words(proof: Proof) -> &'static str {
    match proof {
        Proof::Proved => "; branches proved",
        Proof::RoundedData => "; branches proved for the rounded numbers",
        _ => "; branches not proved",
    }
}

/// Degrees or metres.
fn shown(x: f64, variable: Variable) -> String {
    match variable {
        Variable::Rotation => format!("{:.4}", x.to_degrees() + 0.0),
        Variable::Translation => format!("{:.6}", x + 0.0),
    }
}

/// The name of the input, and its unit.
pub(super) fn input_name(entry: &Entry, swept: Swept) -> (String, &'static str) {
    let names = entry.chain().map(variables).unwrap_or_default();
    let is_input =
        |(name, variable): &&(String, Variable)| *variable == swept.variable && name[1..].parse() == Ok(swept.joint);
    let name = names.iter().find(is_input).map_or_else(|| format!("q{}", swept.joint), |(name, _)| name.clone());
    (name, if swept.variable == Variable::Rotation { "deg" } else { "m" })
}

/// Describes an end of a branch.
fn words(end: &End, swept: Swept) -> String {
    match end {
        End::Limit(limit) => format!("limit {}", limit + 1),
        End::Range => "end of range".to_owned(),
        End::Closed(turns) => format!("closed after {}", counted(*turns, "turn")),
        End::Infinite(input) => format!("to infinity near {}", shown(*input, swept.variable)),
        End::Isolated => "isolated".to_owned(),
        End::Unresolved([one, two]) => {
            format!("unresolved {} to {}", shown(*one, swept.variable), shown(*two, swept.variable))
        }
    }
}

/// The verdict, the branches, the limit positions, and what to beware of.
#[must_use]
pub fn text(entry: &Entry, swept: Swept, sweep: &Sweep) -> String {
    let (name, unit) = input_name(entry, swept);
    let range = [sweep.range.from, sweep.range.to].map(|x| match swept.variable {
        Variable::Rotation => short(x.to_degrees(), 6),
        Variable::Translation => short(x, 9),
    });
    let mut text = format!("{}\n", verdict(sweep));
    let turn = if sweep.is_full_turn { ", a full turn" } else { "" };
    let steps = counted(sweep.range.steps, "step");
    let _ = writeln!(text, "{}, {name} from {} to {} {unit} in {steps}{turn}", entry.title, range[0], range[1]);
    if !sweep.branches.is_empty() {
        let (from, to) = (format!("from [{unit}]"), format!("to [{unit}]"));
        let header = ["branch", "circuit", &from, "begins", &to, "ends", "inputs"];
        let mut table = Columns::new(&header, &["begins", "ends"]);
        for (index, branch) in sweep.branches.iter().enumerate() {
            table.row([
                (index + 1).to_string(),
                branch.circuit.to_string(),
                shown(branch.from, swept.variable),
                words(&branch.begin, swept),
                shown(branch.to, swept.variable),
                words(&branch.end, swept),
                branch.rows.len().to_string(),
            ]);
        }
        let _ = write!(text, "\n{}", table.text());
    }
    if !sweep.limits.is_empty() {
        let _ = write!(text, "\n{}", limits(entry, sweep).text());
    }
    let _ = writeln!(text);
    paragraph(&mut text, &sweep.verdict.reason);
    let remarks = remarks(sweep, swept);
    if !remarks.is_empty() {
        let _ = write!(text, "\n{remarks}");
    }
    text
}

fn limits(entry: &Entry, sweep: &Sweep) -> Columns {
    let names = entry.chain().map(variables).unwrap_or_default();
    let column = |(name, variable): &(String, Variable)| {
        format!("{name} [{}]", if *variable == Variable::Rotation { "deg" } else { "m" })
    };
    let mut header = vec!["limit".to_owned(), "input".to_owned(), "branches".to_owned()];
    header.extend(names.iter().map(column));
    let mut table = Columns::new(&header, &["input", "branches"]);
    for (index, limit) in sweep.limits.iter().enumerate() {
        let kind = if limit.is_largest { "largest" } else { "smallest" };
        let mut row = vec![(index + 1).to_string(), kind.to_owned(), meeting(limit)];
        row.extend(limit.q.iter().zip(&names).map(|(x, (_, variable))| shown(*x, *variable)));
        table.row(row);
    }
    table
}

fn meeting(limit: &Limit) -> String {
    limit.branches.iter().map(|branch| (branch + 1).to_string()).collect::<Vec<_>>().join(", ")
}

/// The inputs whose list is not complete, a few of them by name.
fn remarks(sweep: &Sweep, swept: Swept) -> String {
    const NAMED: usize = 5;
    let mut text = String::new();
    for (status, words) in [(Status::Incomplete, "not proved complete"), (Status::SelfMotion, "self-motion")] {
        let samples: Vec<&Sample> = sweep.samples.iter().filter(|sample| sample.status == status).collect();
        let Some(first) = samples.first() else { continue };
        let inputs: Vec<String> = samples.iter().take(NAMED).map(|s| shown(s.input, swept.variable)).collect();
        let more = if samples.len() > NAMED { format!(" and {} more", samples.len() - NAMED) } else { String::new() };
        paragraph(&mut text, &format!("{words}: input {}{more} ({})", inputs.join(", "), first.reason));
    }
    if !sweep.standing.is_empty() {
        let inputs: Vec<String> = sweep.standing.iter().map(|input| shown(*input, swept.variable)).collect();
        paragraph(&mut text, &format!("the loop also moves while its input stands still at {}", inputs.join(", ")));
    }
    if sweep.is_overconstrained && sweep.branches.is_empty() {
        let note = "fewer than seven joint variables: such a loop may close at single inputs between these, which a sweep does not \
                    look for; `looproot solve` finds the positions of a loop without input";
        paragraph(&mut text, note);
    }
    if let Some(note) = &sweep.note {
        paragraph(&mut text, note);
    }
    text
}

/// One row per branch and step: radians and metres, the columns named as the joint variables.
#[must_use]
pub fn csv(entry: &Entry, sweep: &Sweep) -> String {
    let names = entry.chain().map(variables).unwrap_or_default();
    let mut text = String::from("branch,circuit,turn,step,input,status");
    for (name, _) in &names {
        let _ = write!(text, ",{name}");
    }
    text.push('\n');
    for (index, branch) in sweep.branches.iter().enumerate() {
        for row in &branch.rows {
            let sample = &sweep.samples[row.step];
            let (number, circuit, status) = (index + 1, branch.circuit, sample.status.word());
            let _ = write!(text, "{number},{circuit},{},{},{},{status}", row.turn, row.step, sample.input);
            for value in &sample.modes[row.mode] {
                let _ = write!(text, ",{}", value + 0.0);
            }
            text.push('\n');
        }
    }
    text
}

/// The document that equations/sweep.schema.json describes: radians and metres.
#[must_use]
pub fn json(entry: &Entry, swept: Swept, sweep: &Sweep) -> Value {
    let names = entry.chain().map(variables).unwrap_or_default();
    let inputs = sweep.samples.iter().enumerate().map(|(step, sample)| {
        json!({
            "step": step, "input": number(sample.input), "status": sample.status.word(),
            "real": sample.modes.len(), "reason": sample.reason,
        })
    });
    json!({
        "title": entry.title,
        "kind": kind(entry.kind()),
        "joint": swept.joint,
        "variable": input_name(entry, swept).0,
        "from": number(sweep.range.from),
        "to": number(sweep.range.to),
        "steps": sweep.range.steps,
        "full_turn": sweep.is_full_turn,
        "verdict": {
            "status": sweep.verdict.status.word(),
            "proof": sweep.verdict.proof.word(),
            "code": sweep.verdict.code.word(),
            "reason": sweep.verdict.reason,
            "branches": sweep.branches.len(),
            "limits": sweep.limits.len(),
            "inputs": sweep.samples.len(),
            "incomplete": sweep.count(Status::Incomplete),
            "self_motion": sweep.count(Status::SelfMotion),
            "unresolved": sweep.unresolved(),
        },
        "variables": names.iter().map(|(name, _)| name).collect::<Vec<_>>(),
        "branches": sweep.branches.iter().map(|branch| branch_json(sweep, branch)).collect::<Vec<_>>(),
        "limits": sweep.limits.iter().map(limit_json).collect::<Vec<_>>(),
        "standing": sweep.standing.iter().map(|input| number(*input)).collect::<Vec<_>>(),
        "inputs": inputs.collect::<Vec<_>>(),
    })
}

fn branch_json(sweep: &Sweep, branch: &Branch) -> Value {
    let rows = branch.rows.iter().map(|row| {
        let q: Vec<Value> = sweep.samples[row.step].modes[row.mode].iter().map(|x| number(*x)).collect();
        json!({ "step": row.step, "turn": row.turn, "q": q })
    });
    json!({
        "circuit": branch.circuit,
        "from": number(branch.from), "begins": end_json(&branch.begin),
        "to": number(branch.to), "ends": end_json(&branch.end),
        "rows": rows.collect::<Vec<_>>(),
    })
}

fn end_json(end: &End) -> Value {
    match end {
        End::Limit(limit) => json!({ "kind": "limit", "limit": limit + 1 }),
        End::Range => json!({ "kind": "range" }),
        End::Closed(turns) => json!({ "kind": "closed", "turns": turns }),
        End::Infinite(input) => json!({ "kind": "infinity", "near": number(*input) }),
        End::Isolated => json!({ "kind": "isolated" }),
        End::Unresolved(between) => json!({ "kind": "unresolved", "between": between.map(number) }),
    }
}

fn limit_json(limit: &Limit) -> Value {
    json!({
        "input": number(limit.input),
        "is": if limit.is_largest { "largest" } else { "smallest" },
        "q": limit.q.iter().map(|x| number(*x)).collect::<Vec<_>>(),
        "branches": limit.branches.iter().map(|branch| branch + 1).collect::<Vec<_>>(),
    })
}
