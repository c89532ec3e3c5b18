//! Answers of a solver as lines of JSON.

use super::problem::{Problems, check_format, numbers, object, wrong};
use crate::error::{Error, Result};
use serde_json::Value;
use std::collections::BTreeMap;

/// The `format` in the first line of a file of answers.
pub const ANSWERS: &str = "looproot-answers";

/// The answer of a solver to one problem.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Answer {
    /// Its solutions, each in the unknowns of the problem.
    pub solutions: Vec<Vec<f64>>,
    /// Whether the solver certifies each of them; empty if it does not say.
    pub certified: Vec<bool>,
    /// The time it took, seconds.
    pub seconds: Option<f64>,
    /// The time that preparing the mechanism took, seconds.
    pub setup_seconds: Option<f64>,
    /// Whether it says that solutions form a self-motion.
    pub self_motion: bool,
}

/// A file of answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Answers {
    /// The name and version of the solver.
    pub solver: String,
    /// The file of problems as named in the answers.
    pub problems: Option<String>,
    /// The hash of the problems.
    pub hash: String,
    lines: Vec<(usize, Value)>,
}

impl Answers {
    /// Reads a file of answers; [`Answers::to`] reads the solutions.
    ///
    /// # Errors
    /// Names the line that does not conform to docs/benchmark.md.
    pub fn read(text: &str) -> Result<Self> {
        let mut lines = text.lines().enumerate().map(|(at, line)| (at + 1, line)).filter(|(_, l)| !l.trim().is_empty());
        let Some((1, first)) = lines.next() else {
            return Err(Error::Invalid("line 1: found nothing, expected the first line of answers".to_owned()));
        };
        let head = object(1, first)?;
        check_format(&head, ANSWERS)?;
        let text = |key: &str| head[key].as_str().map(str::to_owned);
        let solver = text("solver").ok_or_else(|| wrong(1, "`solver`", "a text"))?;
        let hash = text("hash").ok_or_else(|| wrong(1, "`hash`", "a text"))?;
        let lines = lines.map(|(at, line)| Ok((at, object(at, line)?))).collect::<Result<_>>()?;
        Ok(Self { solver, problems: text("problems"), hash, lines })
    }

    /// Returns the answer to each problem, in the order of the problems; `None` if there is no line for it.
    ///
    /// # Errors
    /// Names the line of an answer to no problem, of a second answer, or of a solution with another number of unknowns.
    pub fn to(&self, problems: &Problems) -> Result<Vec<Option<Answer>>> {
        if self.hash != problems.hash {
            let (own, other) = (&self.hash, &problems.hash);
            return Err(Error::Invalid(format!("line 1: found answers to the problems {own}, expected {other}")));
        }
        let place: BTreeMap<&str, usize> =
            problems.problems.iter().enumerate().map(|(at, problem)| (problem.id.as_str(), at)).collect();
        let mut answers = vec![None; problems.problems.len()];
        for (line, value) in &self.lines {
            let id = value["id"].as_str().unwrap_or_default();
            let Some(at) = place.get(id) else { return Err(wrong(*line, &format!("the id `{id}`"), "of a problem")) };
            if answers[*at].is_some() {
                return Err(wrong(*line, &format!("the id `{id}`"), "there once"));
            }
            answers[*at] = Some(Answer::read(value, *line, problems.problems[*at].body.unknowns())?);
        }
        Ok(answers)
    }
}

impl Answer {
    fn read(value: &Value, line: usize, unknowns: usize) -> Result<Self> {
        let list = value["solutions"].as_array().ok_or_else(|| wrong(line, "`solutions`", "a list"))?;
        let solutions = list.iter().map(|q| numbers(line, q, "solutions")).collect::<Result<Vec<_>>>()?;
        if solutions.iter().any(|q| q.len() != unknowns) {
            return Err(wrong(line, "a solution", &format!("of {unknowns} numbers")));
        }
        let certified: Option<Vec<bool>> = match &value["certified"] {
            Value::Null => Some(Vec::new()),
            Value::Bool(all) => Some(vec![*all; solutions.len()]),
            Value::Array(each) => each.iter().map(Value::as_bool).collect(),
            _ => None,
        };
        let certified = certified.filter(|each| each.is_empty() || each.len() == solutions.len());
        let certified = certified.ok_or_else(|| wrong(line, "`certified`", "true or false, for each solution"))?;
        let time = |key: &str| match &value[key] {
            Value::Null => Ok(None),
            other => {
                let seconds = other.as_f64().filter(|seconds| *seconds >= 0.0);
                seconds.map(Some).ok_or_else(|| wrong(line, &format!("`{key}`"), "a number that is not negative"))
            }
        };
        let (seconds, setup_seconds) = (time("seconds")?, time("setup_seconds")?);
        let self_motion = match &value["self_motion"] {
            Value::Null => Some(false),
            other => other.as_bool(),
        };
        let self_motion = self_motion.ok_or_else(|| wrong(line, "`self_motion`", "true or false"))?;
        Ok(Self { solutions, certified, seconds, setup_seconds, self_motion })
    }
}
