//! ik-geo: answers the arms of six rotations for which it has closed forms. Answers that it marks as least squares are left out.
//!
//! ```sh
//! looproot bench accuracy --set robots --count 20 --export problems.jsonl
//! cargo run --release --manifest-path benches/peers/rust/Cargo.toml --bin ik_geo -- problems.jsonl ik_geo.jsonl
//! looproot bench score ik_geo.jsonl
//! ```

use answers::Arm;
use ik_geo::robot::{self, IKSolver, Robot};
use nalgebra::{Matrix3x6, Matrix3xX};
use std::error::Error;

/// Returns the robot with the solver that fits. Axes that meet have their common point as origin, as the solvers presume.
/// `None` where ik-geo searches along a line instead of solving.
fn robot(arm: &Arm) -> Option<Robot> {
    let mut points = arm.points;
    let solver = if let Some(centre) = arm.wrist() {
        points[3..].fill(centre);
        if arm.are_parallel(1, 2) {
            robot::spherical_two_parallel
        } else if let Some(shoulder) = arm.crossing(0, 1) {
            points[..2].fill(shoulder);
            robot::spherical_two_intersecting
        } else {
            robot::spherical
        }
    } else if arm.are_parallel(1, 2) && arm.are_parallel(2, 3) {
        match arm.crossing(4, 5) {
            Some(point) => {
                points[4..].fill(point);
                robot::three_parallel_two_intersecting
            }
            None => robot::three_parallel,
        }
    } else {
        return None;
    };
    let mut steps = [points[0]; 7];
    for k in 1..6 {
        steps[k] = points[k] - points[k - 1];
    }
    steps[6] = arm.home.translation.vector - points[5];
    Some(solver(
        Matrix3x6::from_columns(&arm.directions),
        Matrix3xX::from_columns(&steps).fixed_columns::<7>(0).into_owned(),
    ))
}

fn main() -> Result<(), Box<dyn Error>> {
    answers::answer("ik-geo 0.1.2 (Rust)", |arm| {
        let robot = robot(arm)?;
        // The tool of ik-geo is not turned when all joint variables are 0.
        let rotation = (arm.pose.rotation * arm.home.rotation.inverse()).to_rotation_matrix().into_inner();
        let position = arm.pose.translation.vector;
        Some(move || {
            let found = robot.ik(rotation, position);
            found.into_iter().filter(|(_, is_least_squares)| !is_least_squares).map(|(q, _)| q.into()).collect()
        })
    })
}
