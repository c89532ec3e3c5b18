//! The verdict in words, as the first thing on a page.

use crate::report::number::counted;
use serde_json::Value;

/// The colour of a verdict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tone {
    /// Answered and proved.
    Sure,
    /// Not proved, or a self-motion.
    Doubt,
    /// No real solution.
    Nothing,
}

impl Tone {
    /// The class in the style sheet.
    pub(super) fn class(self) -> &'static str {
        match self {
            Self::Sure => "sure",
            Self::Doubt => "doubt",
            Self::Nothing => "nothing",
        }
    }
}

/// A verdict for readers.
#[derive(Clone, Debug)]
pub(super) struct Headline {
    pub(super) tone: Tone,
    /// `complete, proved`
    pub(super) badge: String,
    /// `All 16 solutions are real, and there are no others`
    pub(super) text: String,
    /// Why.
    pub(super) reason: String,
}

fn count(value: &Value) -> usize {
    value.as_u64().and_then(|n| usize::try_from(n).ok()).unwrap_or(0)
}

/// Describes a proof.
fn proof(verdict: &Value) -> String {
    match verdict["proof"].as_str() {
        Some("proved") => "proved".to_owned(),
        Some("probable") => match verdict["probability_of_error"].as_f64() {
            Some(error) => format!("probable: wrong with probability below {error:.0e}"),
            None => "probable".to_owned(),
        },
        Some("rounded-data") => "proved for the rounded numbers".to_owned(),
        _ => "not proved".to_owned(),
    }
}

fn reason(verdict: &Value) -> String {
    verdict["reason"].as_str().unwrap_or_default().to_owned()
}

/// The verdict of one result of `solve`.
pub(super) fn solved(kind: &str, verdict: &Value) -> Headline {
    let status = verdict["status"].as_str().unwrap_or("incomplete");
    let is_proved = verdict["proof"] == "proved";
    let (real, complex) = (count(&verdict["real"]), count(&verdict["complex"]));
    let noun = if kind == "arm" { "solution" } else { "assembly mode" };
    let text = match status {
        "complete" => complete(noun, real, complex, verdict["complex_complete"] == true),
        "unreachable" => match kind {
            "arm" => "No real solution: this pose cannot be reached".to_owned(),
            "loop" => "No real solution: the loop cannot be assembled at this input".to_owned(),
            "linkage" => "No real solution: the linkage cannot be assembled with these inputs".to_owned(),
            _ => "No real solution: no pose has legs of these lengths".to_owned(),
        },
        "self-motion" => {
            let beside = if real > 0 {
                format!(", {} beside it", counted(real, &format!("isolated {noun}")))
            } else {
                String::new()
            };
            format!("A self-motion of dimension {}{beside}", count(&verdict["self_motion"]))
        }
        "unsupported" => "Not supported yet".to_owned(),
        _ => format!("{} found; others may be missing", counted(real, &format!("real {noun}"))),
    };
    let near = match count(&verdict["near"]) {
        0 => String::new(),
        near => format!(", {near} near"),
    };
    let tone = match status {
        "complete" if is_proved => Tone::Sure,
        "unreachable" | "unsupported" => Tone::Nothing,
        _ => Tone::Doubt,
    };
    let badge = if status == "unsupported" { status.to_owned() } else { format!("{status}, {}", proof(verdict)) };
    Headline { tone, badge, text: text + &near, reason: reason(verdict) }
}

fn complete(noun: &str, real: usize, complex: usize, is_known: bool) -> String {
    match (real, complex) {
        (1, _) if !is_known || complex == 1 => format!("1 {noun}, and no other"),
        (2, 2) if is_known => format!("Both {noun}s are real"),
        (real, complex) if is_known && real == complex => format!("All {real} {noun}s are real"),
        (real, complex) if is_known => format!("{real} of {complex} {noun}s are real"),
        (real, _) => format!("{real} real {noun}s, and no others"),
    }
}

/// The verdict of a sweep.
pub(super) fn swept(document: &Value) -> Headline {
    let verdict = &document["verdict"];
    let (branches, limits) = (count(&verdict["branches"]), count(&verdict["limits"]));
    let text = match branches {
        0 if document["kind"] == "linkage" => "The linkage closes at none of the inputs".to_owned(),
        0 => "The loop closes at none of the inputs".to_owned(),
        1 => format!("1 branch, {}", counted(limits, "limit position")),
        n => format!("{n} branches, {}", counted(limits, "limit position")),
    };
    let is_proved = verdict["proof"] == "proved";
    let tone = match verdict["status"].as_str() {
        Some("complete") if is_proved => Tone::Sure,
        Some("unreachable") => Tone::Nothing,
        _ => Tone::Doubt,
    };
    let badge = format!("{}, {}", verdict["status"].as_str().unwrap_or("incomplete"), proof(verdict));
    Headline { tone, badge, text, reason: reason(verdict) }
}

/// The verdict of a path: the number of its branches, and the worst verdict of its poses.
pub(super) fn followed(document: &Value, poses: &[Headline]) -> Headline {
    let branches = document["branches"].as_array().map_or(0, Vec::len);
    let whole = document["branches"].as_array().into_iter().flatten().filter(|branch| {
        let last = document["results"].as_array().and_then(|results| results.last());
        let first = document["results"].as_array().and_then(|results| results.first());
        Some(&branch["from"]) == first.map(|own| &own["case"]) && Some(&branch["to"]) == last.map(|own| &own["case"])
    });
    let text = match (whole.count(), branches) {
        (_, 0) => "No solution along the path".to_owned(),
        (whole, _) => format!(
            "{} along {}, {whole} from the first to the last",
            counted_branches(branches),
            counted(poses.len(), "pose")
        ),
    };
    let worst = poses.iter().find(|own| own.tone == Tone::Doubt).or(poses.iter().find(|own| own.tone == Tone::Nothing));
    let (tone, badge) = match worst {
        Some(own) if own.tone == Tone::Doubt => (Tone::Doubt, format!("a pose is {}", own.badge)),
        Some(own) => (Tone::Nothing, format!("a pose is {}", own.badge)),
        None => (Tone::Sure, "every pose complete, proved".to_owned()),
    };
    let reason = "a branch continues the nearest solution of the pose before; between two poses nothing is proved";
    Headline { tone, badge, text, reason: reason.to_owned() }
}

fn counted_branches(count: usize) -> String {
    if count == 1 { "1 branch".to_owned() } else { format!("{count} branches") }
}

/// The verdict of `mobility`.
pub(super) fn moving(document: &Value) -> Headline {
    let mobility = &document["mobility"];
    let text = match (mobility.as_u64(), document["shaky"] == true) {
        (_, true) => "Shaky: it moves to first order only".to_owned(),
        (Some(0), _) => "It does not move".to_owned(),
        (Some(1), _) => "It moves with one degree of freedom".to_owned(),
        (Some(n), _) => format!("It moves with {n} degrees of freedom"),
        (None, _) => match mobility.as_array().map(Vec::as_slice) {
            Some([least, most]) => format!("It moves with {least} to {most} degrees of freedom"),
            _ => "Whether it moves is not decided".to_owned(),
        },
    };
    let tone = if document["proof"] == "proved" { Tone::Sure } else { Tone::Doubt };
    Headline { tone, badge: proof(document), text, reason: reason(document) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn verdicts_read_as_sentences() {
        let verdict = |status: &str, real: usize, complex: usize| json!({ "status": status, "proof": "proved", "real": real, "complex": complex, "complex_complete": true });
        let text =
            |kind: &str, status: &str, real: usize, complex: usize| solved(kind, &verdict(status, real, complex)).text;
        assert_eq!(text("arm", "complete", 16, 16), "All 16 solutions are real");
        assert_eq!(text("platform", "complete", 8, 40), "8 of 40 assembly modes are real");
        assert_eq!(text("loop", "complete", 2, 2), "Both assembly modes are real");
        assert_eq!(text("arm", "complete", 1, 1), "1 solution, and no other");
        assert_eq!(text("arm", "unreachable", 0, 16), "No real solution: this pose cannot be reached");
        assert_eq!(solved("arm", &verdict("complete", 1, 1)).tone, Tone::Sure);
        assert_eq!(solved("arm", &json!({ "status": "complete", "proof": "none" })).tone, Tone::Doubt);
    }
}
