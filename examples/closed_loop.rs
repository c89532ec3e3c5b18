//! Lists the assembly modes of a closed loop at one input, and sweeps the input through a turn.

use looproot::{Loop, Range};
use std::f64::consts::PI;

/// Runs the example; a test calls it, too.
///
/// # Errors
/// None with the data given here.
pub fn main() -> looproot::Result<()> {
    let four_bar = Loop::from_file("planar_4r")?;
    let (joint, _) = four_bar.input();
    let answer = four_bar.solve(1.0)?;
    println!("with joint {joint} at 1 rad: {} assembly modes, {}", answer.modes.len(), answer.verdict.reason);
    let swept = four_bar.sweep(Range { from: -PI, to: PI, steps: 72 }, || true)?;
    let branches = swept["branches"].as_array().map_or(0, Vec::len);
    println!("over a turn: {branches} branches");
    assert!(answer.modes.len() == 2 && branches > 0);
    Ok(())
}
