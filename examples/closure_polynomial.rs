//! Derives the closure polynomial of an arm at a pose, exactly, and asks whether a linkage moves.

use looproot::{Arm, mobility};

/// Runs the example; a test calls it, too.
///
/// # Errors
/// None with the data given here.
pub fn main() -> looproot::Result<()> {
    let arm = Arm::robot("puma560")?;
    let derivation = arm.derive(&arm.fk(&[0.2, -0.5, 0.4, 0.3, 0.8, -0.1])?)?;
    println!("{}", derivation["title"]);
    println!("degree {}", derivation["degree"]);
    let bennett = mobility("bennett_a")?;
    println!("the Bennett loop has mobility {}: {}", bennett["mobility"], bennett["reason"]);
    assert!(bennett["mobility"] == 1 && bennett["proof"] == "proved");
    Ok(())
}
