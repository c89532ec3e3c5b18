//! Solves many poses on all cores, and counts how many joint positions reach them.

use looproot::{Arm, Convention, DhRow, JointKind};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Runs the example; a test calls it, too.
///
/// # Errors
/// None with the data given here.
pub fn main() -> looproot::Result<()> {
    // A row is a, alpha, d: metres and radians. Right angles are taken as exact.
    let table = [
        (0.0, FRAC_PI_2, 0.4),
        (0.45, 0.0, 0.0),
        (0.05, FRAC_PI_2, 0.1),
        (0.0, -FRAC_PI_2, 0.42),
        (0.0, FRAC_PI_2, 0.0),
        (0.0, 0.0, 0.08),
    ];
    let rows = table.map(|(a, alpha, d)| DhRow { kind: JointKind::Revolute, a, alpha, d, theta0: 0.0 });
    let arm = Arm::from_dh(&rows, Convention::Dh, vec![])?;
    let mut poses = Vec::new();
    for step in 0..200 {
        let turn = TAU * f64::from(step) / 200.0;
        poses.push(arm.fk(&[turn, 0.3, 0.8, 1.1 * turn, 0.9, 0.2])?);
    }
    let mut counts = [0; 17];
    for answer in arm.ik_batch(&poses) {
        let answer = answer?;
        assert!(answer.verdict.proof.is_proved(), "{}", answer.verdict.reason);
        counts[answer.modes.len()] += 1;
    }
    for (solutions, poses) in counts.iter().enumerate().filter(|(_, poses)| **poses > 0) {
        println!("{poses} poses have {solutions} solutions");
    }
    Ok(())
}
