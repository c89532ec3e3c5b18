//! ik-geo: answers the arms of six rotations for which it has closed forms. Answers that it marks as least squares are left out.
//!
//! ```sh
//! looproot bench accuracy --set robots --count 20 --export problems.jsonl
//! cargo run --release --manifest-path benches/peers/rust/Cargo.toml -- problems.jsonl ik_geo.jsonl
//! looproot bench score ik_geo.jsonl
//! ```

use ik_geo::robot::{self, IKSolver, Robot};
use nalgebra::{Matrix3, Matrix3x6, Vector3};
use serde_json::{Value, json};
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// Axes that meet or are parallel up to rounding are taken to do so, in metres and radians.
const NEAR: f64 = 1e-9;
/// The fastest of so many runs is the time of an answer.
const REPEATS: usize = 25;

/// The axes of an arm when all joint variables are 0.
struct Axes {
    directions: [Vector3<f64>; 6],
    points: [Vector3<f64>; 6],
}

impl Axes {
    fn are_parallel(&self, i: usize, j: usize) -> bool {
        self.directions[i].cross(&self.directions[j]).norm() < NEAR
    }

    /// Returns the point at which two axes meet; `None` where they are skew or parallel.
    fn crossing(&self, i: usize, j: usize) -> Option<Vector3<f64>> {
        let (u, v) = (self.directions[i], self.directions[j]);
        let (normal, between) = (u.cross(&v), self.points[j] - self.points[i]);
        let square = normal.norm_squared();
        if square < NEAR * NEAR || (between.dot(&normal) / square.sqrt()).abs() > NEAR {
            return None;
        }
        Some(self.points[i] + u * (between.cross(&v).dot(&normal) / square))
    }

    /// Returns the centre of a spherical wrist.
    fn wrist(&self) -> Option<Vector3<f64>> {
        let (one, other) = (self.crossing(3, 4)?, self.crossing(4, 5)?);
        ((one - other).norm() < NEAR).then_some(one)
    }

    /// Returns the robot with the solver that fits, which reaches the tool at `tool` when all joint variables are 0. Axes that meet
    /// have their common point as origin, as the solvers presume. `None` where ik-geo searches along a line instead of solving.
    fn robot(mut self, tool: Vector3<f64>) -> Option<Robot> {
        let solver = if let Some(centre) = self.wrist() {
            self.points[3..].fill(centre);
            if self.are_parallel(1, 2) {
                robot::spherical_two_parallel
            } else if let Some(shoulder) = self.crossing(0, 1) {
                self.points[..2].fill(shoulder);
                robot::spherical_two_intersecting
            } else {
                robot::spherical
            }
        } else if self.are_parallel(1, 2) && self.are_parallel(2, 3) {
            match self.crossing(4, 5) {
                Some(point) => {
                    self.points[4..].fill(point);
                    robot::three_parallel_two_intersecting
                }
                None => robot::three_parallel,
            }
        } else {
            return None;
        };
        let mut steps = [self.points[0]; 7];
        for k in 1..6 {
            steps[k] = self.points[k] - self.points[k - 1];
        }
        steps[6] = tool - self.points[5];
        Some(solver(
            Matrix3x6::from_columns(&self.directions),
            nalgebra::Matrix3xX::from_columns(&steps).fixed_columns::<7>(0).into_owned(),
        ))
    }
}

fn vector(value: &Value) -> Option<Vector3<f64>> {
    Some(Vector3::new(value[0].as_f64()?, value[1].as_f64()?, value[2].as_f64()?))
}

/// Returns rotation and position of four rows.
fn motion(value: &Value) -> Option<(Matrix3<f64>, Vector3<f64>)> {
    let column = |j: usize| Some(Vector3::new(value[0][j].as_f64()?, value[1][j].as_f64()?, value[2][j].as_f64()?));
    Some((Matrix3::from_columns(&[column(0)?, column(1)?, column(2)?]), column(3)?))
}

/// Returns the answer to a problem; `None` where ik-geo has no closed form.
fn answer(problem: &Value) -> Option<Value> {
    let axes = problem["axes"].as_array().filter(|axes| axes.len() == 6)?;
    if axes.iter().any(|axis| axis["type"] != "R") {
        return None;
    }
    let column = |key: &str| -> Option<[Vector3<f64>; 6]> {
        let vectors: Option<Vec<_>> = axes.iter().map(|axis| vector(&axis[key])).collect();
        vectors?.try_into().ok()
    };
    let (home, pose) = (motion(&problem["home"])?, motion(&problem["pose"])?);
    let robot = Axes { directions: column("direction")?, points: column("point")? }.robot(home.1)?;
    // The tool of ik-geo is not turned when all joint variables are 0.
    let rotation = pose.0 * home.0.transpose();
    let mut seconds = f64::INFINITY;
    let mut found = Vec::new();
    for _ in 0..REPEATS {
        let start = Instant::now();
        found = robot.ik(rotation, pose.1);
        seconds = seconds.min(start.elapsed().as_secs_f64());
    }
    let solutions: Vec<Vec<f64>> = found
        .iter()
        .filter(|(_, is_least_squares)| !is_least_squares)
        .map(|(q, _)| q.iter().copied().collect())
        .collect();
    Some(json!({ "id": problem["id"], "solutions": solutions, "certified": false, "seconds": seconds }))
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [problems, answers] = &arguments[..] else {
        return Err("expected two files: problems.jsonl answers.jsonl".into());
    };
    let text = std::fs::read_to_string(problems)?;
    let mut lines = text.lines().map(serde_json::from_str::<Value>);
    let head = lines.next().ok_or("found no problems")??;
    let mut file = std::io::BufWriter::new(std::fs::File::create(answers)?);
    let problems = std::path::absolute(Path::new(problems))?;
    let first = json!({
        "format": "looproot-answers", "version": 1, "solver": "ik-geo 0.1.2 (Rust)", "problems": problems, "hash": head["hash"],
    });
    writeln!(file, "{first}")?;
    for problem in lines {
        if let Some(line) = answer(&problem?) {
            writeln!(file, "{line}")?;
        }
    }
    Ok(())
}
