//! The order in which solutions are listed, and the full turns added to their angles.

use super::arguments::SolveOptions;
use looproot::internal::catalogue::entry::{Design, Entry, Kind};
use looproot::internal::catalogue::poses::typed_pose;
use looproot::internal::error::Error;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::motion::Motion;
use looproot::internal::kinematics::platform::{Platform, pose_of};
use looproot::internal::mechanism::{FullMode, Solution, platform_over, representatives};
use looproot::internal::report::number::{counted, short};
use looproot::internal::report::text::View;
use looproot_algebra::number::{Angle, Number, Quantity};
use serde_json::{Value, json};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::fmt::Write;

/// The requests of `--near` and `--turns`.
pub struct Order {
    variables: Vec<Variable>,
    limits: Vec<[f64; 2]>,
    near: Option<Near>,
    turns: bool,
}

/// The value of `--near`.
enum Near {
    /// Joint values.
    Joints(Vec<f64>),
    /// A pose of the plate of a platform.
    Pose(Box<Platform<f64>>, Motion<f64>),
}

impl Order {
    /// Reads the options of the command line.
    pub fn of(options: &SolveOptions, entry: &Entry) -> Result<Self, Error> {
        let variables: Vec<Variable> =
            entry.chain().map(|chain| chain.variables().iter().map(|own| own.variable).collect()).unwrap_or_default();
        if options.turns && entry.kind() == Kind::Platform {
            return Err(Error::Invalid("found --turns for a platform, expected an arm or a loop".to_owned()));
        }
        let near = |text: &String| match &entry.design {
            Design::Platform(geometry) => {
                let case = typed_pose(text, "--near", &entry.design, &entry.reading)?;
                let pose = case.pose.map(|pose| pose.float);
                let pose =
                    platform_over::<f64>(geometry).zip(pose).map(|(platform, pose)| Near::Pose(platform.into(), pose));
                pose.ok_or_else(|| Error::Invalid(format!("found --near \"{text}\", expected a pose of the plate")))
            }
            Design::Arm(_) | Design::Loop(_) => {
                values(text, &variables, entry).map(Near::Joints).map_err(|fault| fault.of_option("--near"))
            }
        };
        let near = options.near.as_ref().map(near).transpose()?;
        Ok(Self { variables, limits: entry.limits.clone(), near, turns: options.turns })
    }

    /// Whether answers are printed as they were found.
    pub fn is_as_found(&self) -> bool {
        self.near.is_none() && !self.turns
    }

    /// Returns the solution with its real modes sorted by their distance to the values of `--near`.
    pub fn sorted<'a>(&self, solution: &'a Solution) -> Cow<'a, Solution> {
        let Some(near) = &self.near else { return Cow::Borrowed(solution) };
        let mut sorted = solution.clone();
        let near = match near {
            Near::Joints(near) => near,
            Near::Pose(platform, near) => {
                let pose = |mode: &FullMode| pose_of(&real_parts(mode)).filter(|_| mode.real);
                let key = |mode: &FullMode| pose(mode).map_or(f64::INFINITY, |pose| platform.distance(&pose, near));
                sorted.modes.sort_by(|a, b| key(a).total_cmp(&key(b)));
                return Cow::Owned(sorted);
            }
        };
        for mode in sorted.modes.iter_mut().filter(|mode| mode.real) {
            let all = representatives(mode, &self.variables, &self.limits);
            let best = all.into_iter().min_by(|a, b| self.distance(a, near).total_cmp(&self.distance(b, near)));
            if let Some(best) = best {
                mode.q.iter_mut().zip(best).for_each(|(value, best)| value.re = best);
            }
        }
        let key = |mode: &FullMode| if mode.real { self.distance(&real_parts(mode), near) } else { f64::INFINITY };
        sorted.modes.sort_by(|a, b| key(a).total_cmp(&key(b)));
        Cow::Owned(sorted)
    }

    /// Returns the distance of two configurations; without limits full turns do not count.
    fn distance(&self, one: &[f64], other: &[f64]) -> f64 {
        let off = |(k, (a, b)): (usize, (&f64, &f64))| {
            let off = a - b;
            let turns = self.limits.is_empty() && self.variables.get(k) == Some(&Variable::Rotation);
            if turns { off - TAU * (off / TAU).round() } else { off }
        };
        one.iter().zip(other).enumerate().map(off).map(|x| x * x).sum::<f64>().sqrt()
    }

    /// Adds the representatives to the modes of a result.
    pub fn insert_turns(&self, result: &mut Value, solution: &Solution, view: &View) {
        if !self.turns {
            return;
        }
        let shown = solution.modes.iter().filter(|mode| view.shows(mode)).enumerate();
        for (index, mode) in shown.filter(|(_, mode)| mode.real) {
            result["modes"][index]["turns"] = json!(representatives(mode, &self.variables, &self.limits));
        }
    }

    /// Returns the representatives as text.
    pub fn turns_text(&self, solution: &Solution, view: &View) -> String {
        let mut text = String::new();
        if !self.turns || view.quiet {
            return text;
        }
        let shown = (1..).zip(solution.modes.iter().filter(|mode| view.shows(mode)));
        for (number, mode) in shown.filter(|(_, mode)| mode.real) {
            for q in representatives(mode, &self.variables, &self.limits) {
                let value = |(x, variable): (&f64, &Variable)| match variable {
                    Variable::Rotation => short(x.to_degrees(), 4),
                    Variable::Translation => short(*x, 6),
                };
                let values: Vec<String> = q.iter().zip(&self.variables).map(value).collect();
                let _ = writeln!(text, "turns of {number}: {}", values.join(", "));
            }
        }
        text
    }
}

fn real_parts(mode: &FullMode) -> Vec<f64> {
    mode.q.iter().map(|value| value.re).collect()
}

/// Reads joint values, separated by commas.
fn values(text: &str, variables: &[Variable], entry: &Entry) -> Result<Vec<f64>, Error> {
    let texts: Vec<&str> = text.split(',').map(str::trim).collect();
    if texts.len() != variables.len() {
        let (found, expected) = (texts.len(), variables.len());
        return Err(Error::Invalid(format!(
            "found {} in --near, expected {expected}, separated by commas",
            counted(found, "value")
        )));
    }
    let value = |(text, variable): (&str, &Variable)| match variable {
        Variable::Rotation => Ok(Angle::parse(text, &entry.reading)?.radians()),
        Variable::Translation => Ok(Number::parse(text, Quantity::Length, &entry.reading)?.to_f64()),
    };
    texts.into_iter().zip(variables).map(value).collect()
}
