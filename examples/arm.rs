//! Lists every joint position in which an arm of the library reaches a pose.

use looproot::{Arm, Status};

/// Runs the example; a test calls it, too.
///
/// # Errors
/// None with the data given here.
pub fn main() -> looproot::Result<()> {
    let arm = Arm::robot("ur5")?;
    let pose = arm.fk(&[0.1, -1.0, 1.2, 0.3, 0.7, -0.4])?;
    let answer = arm.ik(&pose)?;
    println!("{}: {}", answer.verdict.status.word(), answer.verdict.reason);
    for mode in &answer.modes {
        let degrees: Vec<String> = mode.q.iter().map(|q| format!("{:9.3}", q.re.to_degrees())).collect();
        println!("{}  within {:.0e} rad", degrees.join(" "), mode.radius);
    }
    assert_eq!(answer.verdict.status, Status::Complete);
    assert!(answer.verdict.proof.is_proved());
    Ok(())
}
