//! Reads arms of six rotations from the problems of `looproot bench accuracy --export`, and writes answers for `looproot bench score`.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, UnitQuaternion, Vector3};
use serde_json::{Value, json};
use std::error::Error;
use std::io::Write;
use std::path::Path;
use std::time::Instant;

/// Axes that meet, are parallel or at right angles up to rounding are taken to be so, in metres and radians.
pub const NEAR: f64 = 1e-9;
/// The fastest of so many runs is the time of an answer.
const REPEATS: usize = 25;

/// An arm of six rotations when all joint variables are 0, and the pose that it is to reach.
pub struct Arm {
    pub directions: [Vector3<f64>; 6],
    pub points: [Vector3<f64>; 6],
    pub home: Isometry3<f64>,
    pub pose: Isometry3<f64>,
}

impl Arm {
    /// Returns the arm of a problem; `None` of other kinds.
    fn read(problem: &Value) -> Option<Arm> {
        let axes = problem["axes"].as_array().filter(|axes| axes.len() == 6)?;
        if axes.iter().any(|axis| axis["type"] != "R") {
            return None;
        }
        let vectors = |key: &str| -> Option<[Vector3<f64>; 6]> {
            let vectors: Option<Vec<_>> = axes.iter().map(|axis| vector(&axis[key])).collect();
            vectors?.try_into().ok()
        };
        Some(Arm {
            directions: vectors("direction")?,
            points: vectors("point")?,
            home: motion(&problem["home"])?,
            pose: motion(&problem["pose"])?,
        })
    }

    #[must_use]
    pub fn are_parallel(&self, i: usize, j: usize) -> bool {
        self.directions[i].cross(&self.directions[j]).norm() < NEAR
    }

    /// Returns the point at which two axes meet; `None` where they are skew or parallel.
    #[must_use]
    pub fn crossing(&self, i: usize, j: usize) -> Option<Vector3<f64>> {
        let (u, v) = (self.directions[i], self.directions[j]);
        let (normal, between) = (u.cross(&v), self.points[j] - self.points[i]);
        let square = normal.norm_squared();
        if square < NEAR * NEAR || (between.dot(&normal) / square.sqrt()).abs() > NEAR {
            return None;
        }
        Some(self.points[i] + u * (between.cross(&v).dot(&normal) / square))
    }

    /// Returns the centre of a spherical wrist.
    #[must_use]
    pub fn wrist(&self) -> Option<Vector3<f64>> {
        let (one, other) = (self.crossing(3, 4)?, self.crossing(4, 5)?);
        ((one - other).norm() < NEAR).then_some(one)
    }
}

fn vector(value: &Value) -> Option<Vector3<f64>> {
    Some(Vector3::new(value[0].as_f64()?, value[1].as_f64()?, value[2].as_f64()?))
}

/// Returns the motion of four rows.
fn motion(value: &Value) -> Option<Isometry3<f64>> {
    let column = |j: usize| Some(Vector3::new(value[0][j].as_f64()?, value[1][j].as_f64()?, value[2][j].as_f64()?));
    let rotation = Rotation3::from_matrix_unchecked(Matrix3::from_columns(&[column(0)?, column(1)?, column(2)?]));
    Some(Isometry3::from_parts(Translation3::from(column(3)?), UnitQuaternion::from_rotation_matrix(&rotation)))
}

/// Writes the answers of a solver to the two files named on the command line: problems, answers. `prepare` returns the
/// function that solves for an arm, which alone is timed; `None` where the solver does not take it.
///
/// # Errors
///
/// Fails on files that cannot be read or written, and on problems that are not JSON.
pub fn answer<S: Fn() -> Vec<[f64; 6]>>(
    solver: &str,
    prepare: impl Fn(&Arm) -> Option<S>,
) -> Result<(), Box<dyn Error>> {
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
        "format": "looproot-answers", "version": 1, "solver": solver, "problems": problems, "hash": head["hash"],
    });
    writeln!(file, "{first}")?;
    for problem in lines {
        let problem = problem?;
        let Some(solve) = Arm::read(&problem).and_then(|arm| prepare(&arm)) else { continue };
        let mut seconds = f64::INFINITY;
        let mut solutions = Vec::new();
        for _ in 0..REPEATS {
            let start = Instant::now();
            solutions = solve();
            seconds = seconds.min(start.elapsed().as_secs_f64());
        }
        let line = json!({ "id": problem["id"], "solutions": solutions, "certified": false, "seconds": seconds });
        writeln!(file, "{line}")?;
    }
    Ok(())
}
