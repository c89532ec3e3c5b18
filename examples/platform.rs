//! Lists every pose of a platform on six legs, and checks the certificate of the list.

use looproot::{Platform, verify};

/// Runs the example; a test calls it, too.
///
/// # Errors
/// None with the data given here.
pub fn main() -> looproot::Result<()> {
    let base =
        [[1.0, 0.0, 0.0], [0.4, 0.9, 0.1], [-0.6, 0.8, 0.0], [-1.1, 0.0, 0.2], [-0.5, -0.9, 0.0], [0.6, -0.8, 0.1]];
    let plate =
        [[0.5, 0.1, 0.0], [0.3, 0.5, 0.0], [-0.2, 0.5, 0.1], [-0.6, 0.1, 0.0], [-0.3, -0.4, 0.1], [0.2, -0.5, 0.0]];
    let platform = Platform::from_points(&base, &plate)?;
    // The plate one metre above the base, not turned.
    let above = [[1.0, 0.0, 0.0, 0.1], [0.0, 1.0, 0.0, -0.2], [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 0.0, 1.0]];
    let legs = platform.legs(&above)?;
    let answer = platform.solve(&legs)?;
    println!("{} poses: {}", answer.modes.len(), answer.verdict.reason);
    let certificate = platform.certificate(&legs)?.to_string();
    let checked = verify(&certificate, None)?;
    println!("the certificate of {} kB holds: {}", certificate.len() / 1000, checked[0]["holds"]);
    assert_eq!(checked[0]["holds"], true);
    Ok(())
}
