//! The mobility of a loop as text and JSON.

use super::json::{kind, number};
use super::number::{counted, short};
use super::table::{Columns, paragraph};
use super::text::variables;
use crate::catalogue::entry::{Design, Entry};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::freedom::Freedom;
use crate::kinematics::motion::Vector;
use crate::kinematics::screw_system::{PrincipalScrew, Screw, ScrewSystem};
use crate::mobility::{Configuration, Local, Mobility};
use serde_json::{Value, json};
use std::fmt::Write;

/// Returns a verdict as the documents say it: one that nothing moves begins with `immobile`.
pub(super) fn of_document(verdict: &str, is_immobile: bool) -> String {
    if is_immobile && !verdict.starts_with("immobile") { format!("immobile: {verdict}") } else { verdict.to_owned() }
}

/// `mobile: mobility 1 (Gruebler's count -2), screw rank 3, 1 branch; proof: proved`
#[must_use]
pub fn verdict(answer: &Mobility) -> String {
    let gruebler = answer.gruebler();
    let mut text = match (answer.mobility, answer.shaky) {
        (None, _) if answer.complex > 0 && answer.is_listed => {
            format!("complex mobility; no real configuration found (Gruebler's count {gruebler})")
        }
        (None, _) => format!("not decided (Gruebler's count {gruebler})"),
        (Some(0), Some(order)) => {
            format!("shaky of order {order}: infinitesimally mobile only (Gruebler's count {gruebler})")
        }
        (Some(0), None) => {
            let none = if !answer.configurations.is_empty() || !answer.is_listed {
                String::new()
            } else if answer.complex == 0 && answer.gruebler() <= 0 {
                ": no configuration".to_owned()
            } else {
                ": no real configuration".to_owned()
            };
            format!("immobile{none} (Gruebler's count {gruebler})")
        }
        (Some(mobility), _) => format!("mobile: mobility {mobility} (Gruebler's count {gruebler})"),
    };
    if let Some(rank) = answer.screw_rank() {
        let _ = write!(text, ", screw rank {rank}");
    }
    match answer.branches() {
        0 => {}
        1 => text += ", 1 branch",
        n => _ = write!(text, ", {n} branches"),
    }
    let _ = write!(text, "; proof: {}", answer.proof.word());
    text
}

/// Verdict, reason, and a table of the configurations.
#[must_use]
pub fn text(entry: &Entry, answer: &Mobility) -> String {
    let mut text = verdict(answer) + "\n";
    paragraph(&mut text, &answer.reason);
    let freedoms = answer.variables.len();
    let count = answer.gruebler();
    let _ = match (&entry.design, entry.chain().and_then(|chain| Freedom::of(chain).rank)) {
        (Design::Platform(_), _) => writeln!(text, "Gruebler: 6 freedoms of the plate less 6 legs = {count}"),
        (Design::Arm(_), _) => writeln!(text, "Gruebler: {}, none bound", counted(freedoms, "joint freedom")),
        (Design::Loop(_), rank) => {
            let rank = rank.map_or_else(String::new, |rank| format!("; screw rank {rank} in general position"));
            writeln!(text, "Gruebler: {} less 6 = {count}{rank}", counted(freedoms, "joint freedom"))
        }
    };
    let names: Vec<(String, Variable)> = entry.chain().map(variables).unwrap_or_default();
    for (number, configuration) in answer.configurations.iter().enumerate() {
        let Configuration { rank, .. } = configuration;
        let deficit = 6 - rank;
        let redundant = if deficit == 0 {
            String::new()
        } else {
            format!(
                ", degree of freedom {freedoms} - {rank} = {}, {}",
                freedoms - rank,
                counted(deficit, "redundant constraint")
            )
        };
        let words = format!(
            "\nconfiguration {} ({}): screw rank {rank}{redundant}; {}",
            number + 1,
            what(configuration),
            configuration.system
        );
        text.push('\n');
        paragraph(&mut text, &words);
        for screw in &configuration.redundant {
            let _ = writeln!(text, "  reciprocal screw: {}", described(screw));
        }
        let (principal, translations) = principal(configuration);
        for PrincipalScrew { screw, .. } in &principal {
            let _ = writeln!(text, "  principal screw of the joints: {}", described(screw));
        }
        match translations {
            0 => {}
            n => _ = writeln!(text, "  the joints admit {}", counted(n, "independent translation")),
        }
    }
    if !answer.configurations.is_empty() {
        text.push('\n');
        let first: &[&str] = if answer.branches() > 0 { &["nr", "branch"] } else { &["nr"] };
        let header: Vec<&str> = first.iter().copied().chain(names.iter().map(|(name, _)| name.as_str())).collect();
        let mut table = Columns::new(&header, &[]);
        for (k, configuration) in answer.configurations.iter().enumerate() {
            let cells = configuration.q.iter().zip(&names).zip(&configuration.moving);
            let cells = cells.map(|((q, (_, variable)), moves)| {
                let shown = match variable {
                    Variable::Rotation => short(q.to_degrees(), 4),
                    Variable::Translation => short(*q, 6),
                };
                if *moves || configuration.dimension() == Some(0) { shown } else { format!("{shown} (still)") }
            });
            let branch = configuration.branch.map_or_else(String::new, |branch| (branch + 1).to_string());
            table.row([(k + 1).to_string(), branch].into_iter().take(first.len()).chain(cells));
        }
        text += &table.text();
        text += "angles in degrees, distances in metres\n";
    }
    text
}

/// The principal screws of the system of the joints, and how many independent translations it has; none where the joints
/// admit every motion.
fn principal(configuration: &Configuration) -> (Vec<PrincipalScrew>, usize) {
    if configuration.rank >= 6 {
        return (Vec::new(), 0);
    }
    // The screws reciprocal to all screws that are reciprocal to the joints.
    ScrewSystem::of(&configuration.redundant).reciprocal().principal_screws()
}

/// Describes the set of configurations near one.
fn what(configuration: &Configuration) -> String {
    match configuration.local {
        Local::Open => "open".to_owned(),
        Local::Manifold { dimension: 1 } | Local::Curve => "on a curve".to_owned(),
        Local::Manifold { dimension } => format!("on a manifold of dimension {dimension}"),
        Local::Isolated { order: 1 } => "isolated, regular".to_owned(),
        Local::Isolated { order } => format!("isolated, shaky of order {order}"),
        Local::Deficient => "not decided".to_owned(),
    }
}

/// A screw by its pitch and its axis.
fn described(screw: &Screw<f64>) -> String {
    let vector = |v: &Vector<f64>| format!("({})", v.each_ref().map(|x| short(*x, 4)).join(", "));
    let size = |v: &Vector<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    match (screw.pitch(), screw.foot()) {
        (Some(pitch), Some(foot)) => {
            let direction = screw.direction.map(|x| x / size(&screw.direction));
            format!("pitch {}, axis through {} along {}", short(pitch, 6), vector(&foot), vector(&direction))
        }
        _ => format!("pitch infinite, along {}", vector(&screw.moment.map(|x| x / size(&screw.moment)))),
    }
}

/// The document that equations/mobility.schema.json describes.
#[must_use]
pub fn json(entry: &Entry, answer: &Mobility) -> Value {
    let names: Vec<String> = match entry.chain() {
        Some(chain) => variables(chain).into_iter().map(|(name, _)| name).collect(),
        None => answer.variables.iter().map(|leg| format!("leg {}", leg.joint)).collect(),
    };
    let held = answer.held.iter().map(|(k, value)| json!({ "variable": names.get(*k), "value": number(*value) }));
    json!({
        "title": entry.title,
        "kind": kind(entry.kind()),
        "verdict": of_document(&verdict(answer), answer.mobility == Some(0)),
        "mobility": answer.mobility,
        "gruebler": answer.gruebler(),
        "screw_rank": answer.screw_rank(),
        "proof": answer.proof.word(),
        "code": answer.code.word(),
        "shaky": answer.shaky.is_some(),
        "order": answer.shaky,
        "branches": answer.branches(),
        "reason": answer.reason,
        "freedoms": answer.variables.len(),
        "complex": answer.complex,
        "variables": names,
        "held": held.collect::<Vec<_>>(),
        "configurations": answer.configurations.iter().map(configuration).collect::<Vec<_>>(),
    })
}

fn configuration(configuration: &Configuration) -> Value {
    let order = match configuration.local {
        Local::Isolated { order } => Some(order),
        _ => None,
    };
    let (principal, translations) = principal(configuration);
    json!({
        "q": configuration.q.iter().map(|x| number(*x)).collect::<Vec<_>>(),
        "degree": (configuration.degree > 0).then_some(configuration.degree),
        "rank": configuration.rank,
        "branch": configuration.branch.map(|branch| branch + 1),
        "dimension": configuration.dimension(),
        "order": order,
        "moving": configuration.moving,
        "system": configuration.system,
        "redundant": configuration.redundant.iter().map(screw).collect::<Vec<_>>(),
        "principal": principal.iter().map(|p| screw(&p.screw)).collect::<Vec<_>>(),
        "translations": translations,
    })
}

fn screw(screw: &Screw<f64>) -> Value {
    json!({
        "direction": screw.direction.map(number),
        "moment": screw.moment.map(number),
        "pitch": screw.pitch().map(number),
        "foot": screw.foot().map(|foot| foot.map(number)),
    })
}
