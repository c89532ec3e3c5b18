//! Poses as a path: matches the solutions of each row with those of the row before.

use looproot::internal::catalogue::entry::{Design, Entry};
use looproot::internal::kinematics::chain::Chain;
use looproot::internal::kinematics::closed_loop::Variable;
use looproot::internal::kinematics::platform::{Platform, pose_of};
use looproot::internal::mechanism::{Solution, platform_over};
use looproot::internal::report::document;
use looproot::internal::report::number::short;
use looproot::internal::report::text::View;
use serde_json::{Value, json};
use std::f64::consts::TAU;
use std::fmt::Write;

/// A joint that moves by more than this between successive rows jumps; half a radian is no step of a path, nor is a way of the
/// points of a plate as long as that of half a radian about their centroid.
const JUMP: f64 = 0.5;
/// Condition numbers above this count as singular for a controller.
const SINGULAR: f64 = 1e4;

/// A solution that was followed from row to row.
struct Branch {
    /// The rows at which it begins and ends so far.
    rows: [usize; 2],
    q: Vec<f64>,
    /// The largest move of a joint between successive rows: its size, the joint, and the second row.
    largest: (f64, usize, usize),
}

/// The branches of a path.
pub struct Follow {
    measure: Measure,
    labels: Vec<String>,
    branches: Vec<Branch>,
    /// The branches that reach the last row.
    open: Vec<usize>,
}

/// How moves are measured.
enum Measure {
    /// By the joint that moves most.
    Joints(Vec<Variable>),
    /// By the way of the points of a plate.
    Plate(Box<Platform<f64>>),
}

/// A move from one row to the next.
#[derive(Clone, Copy)]
struct Move {
    /// Radians or metres.
    by: f64,
    /// The same in radians, or of a plate in parts of its size: a turn by as many radians moves its points as far.
    relative: f64,
    /// The joint, or 0 for the plate.
    joint: usize,
}

/// The results of a row for the path.
pub struct Row {
    /// The branch of every mode, counted from 1; `None` for complex modes.
    pub branches: Vec<Option<usize>>,
    /// The events at this row.
    pub events: Vec<Value>,
}

impl Row {
    /// Adds branches and events to a result.
    pub fn insert(&self, result: &mut Value, solution: &Solution, view: &View) {
        let shown = solution.modes.iter().zip(&self.branches).filter(|(mode, _)| view.shows(mode));
        for (index, (_, branch)) in shown.enumerate() {
            result["modes"][index]["branch"] = json!(branch);
        }
        result["events"] = json!(self.events);
    }
}

impl Follow {
    /// Returns a path without rows.
    pub fn of(entry: &Entry) -> Self {
        let plate = match &entry.design {
            Design::Platform(geometry) => platform_over::<f64>(geometry),
            Design::Arm(_) | Design::Loop(_) => None,
        };
        let variables = entry.chain().map(Chain::variables).unwrap_or_default();
        let (measure, labels) = match plate {
            Some(platform) => (Measure::Plate(Box::new(platform)), vec!["plate".to_owned()]),
            None => (Measure::Joints(variables.iter().map(|own| own.variable).collect()), document::labels(entry)),
        };
        Self { measure, labels, branches: Vec::new(), open: Vec::new() }
    }

    /// Adds the solutions of a row.
    pub fn add(&mut self, number: usize, solution: &Solution) -> Row {
        let real = solution.modes.iter().enumerate().filter(|(_, mode)| mode.real);
        let modes: Vec<(usize, Vec<f64>)> =
            real.map(|(k, mode)| (k, mode.q.iter().map(|value| value.re).collect())).collect();
        let mut pairs: Vec<(Move, usize, usize)> = Vec::new();
        for &branch in &self.open {
            for (mode, (_, q)) in modes.iter().enumerate() {
                pairs.push((self.largest_move(&self.branches[branch].q, q), branch, mode));
            }
        }
        pairs.sort_by(|a, b| a.0.relative.total_cmp(&b.0.relative));
        let mut row = Row { branches: vec![None; solution.modes.len()], events: Vec::new() };
        let mut taken: Vec<Option<usize>> = vec![None; modes.len()];
        let mut continued = Vec::new();
        for (Move { by, relative, joint }, branch, mode) in pairs {
            if taken[mode].is_some() || continued.contains(&branch) {
                continue;
            }
            if relative > JUMP {
                let joint = self.labels.get(joint);
                row.events.push(json!({ "event": "jump", "branch": branch + 1, "joint": joint, "move": by }));
            }
            taken[mode] = Some(branch);
            continued.push(branch);
            let own = &mut self.branches[branch];
            (own.rows[1], own.q) = (number, modes[mode].1.clone());
            if by > own.largest.0 {
                own.largest = (by, joint, number);
            }
        }
        for &branch in self.open.iter().filter(|branch| !continued.contains(branch)) {
            row.events.push(json!({ "event": "ends", "branch": branch + 1 }));
        }
        let is_first = self.branches.is_empty();
        for (mode, (_, q)) in modes.iter().enumerate().filter(|(mode, _)| taken[*mode].is_none()).collect::<Vec<_>>() {
            self.branches.push(Branch { rows: [number; 2], q: q.clone(), largest: (0.0, 0, number) });
            taken[mode] = Some(self.branches.len() - 1);
            if !is_first {
                row.events.push(json!({ "event": "begins", "branch": self.branches.len() }));
            }
        }
        for ((at, _), branch) in modes.iter().zip(&taken) {
            row.branches[*at] = branch.map(|branch| branch + 1);
            if !(solution.modes[*at].condition < SINGULAR) {
                row.events.push(json!({ "event": "singular", "branch": branch.map(|branch| branch + 1) }));
            }
        }
        self.open = taken.into_iter().flatten().collect();
        row
    }

    /// Returns the largest move of a joint between two configurations, or the move of the plate between two poses.
    fn largest_move(&self, one: &[f64], other: &[f64]) -> Move {
        let variables = match &self.measure {
            Measure::Joints(variables) => variables,
            Measure::Plate(platform) => {
                let poses = pose_of(one).zip(pose_of(other));
                let by = poses.map_or(f64::INFINITY, |(one, other)| platform.distance(&one, &other));
                return Move { by, relative: by / platform.plate_size(), joint: 0 };
            }
        };
        let off = |(joint, (a, b)): (usize, (&f64, &f64))| {
            let off = a - b;
            let turns = variables.get(joint) == Some(&Variable::Rotation);
            let by = if turns { (off - TAU * (off / TAU).round()).abs() } else { off.abs() };
            Move { by, relative: by, joint }
        };
        let moves = one.iter().zip(other).enumerate().map(off);
        let none = Move { by: 0.0, relative: 0.0, joint: 0 };
        moves.fold(none, |best, own| if own.by > best.by { own } else { best })
    }

    /// Returns the branches at the end of the path as JSON.
    pub fn json(&self) -> Value {
        let branch = |(number, own): (usize, &Branch)| {
            let (move_by, joint, row) = own.largest;
            json!({
                "branch": number,
                "from": own.rows[0],
                "to": own.rows[1],
                "largest_move": { "joint": self.labels.get(joint), "value": move_by, "case": row },
            })
        };
        (1..).zip(&self.branches).map(branch).collect()
    }

    /// Returns the branches at the end of the path as text.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (number, own) in (1..).zip(&self.branches) {
            let ([from, to], (move_by, joint, row)) = (own.rows, own.largest);
            let is_angle = match &self.measure {
                Measure::Joints(variables) => variables.get(joint) == Some(&Variable::Rotation),
                Measure::Plate(_) => false,
            };
            let size = if is_angle {
                format!("{} deg", short(move_by.to_degrees(), 3))
            } else {
                format!("{} m", short(move_by, 6))
            };
            let label = self.labels.get(joint).map_or("", String::as_str);
            let _ =
                writeln!(text, "branch {number}: poses {from} to {to}, largest move {size} of {label} at pose {row}");
        }
        text
    }
}
