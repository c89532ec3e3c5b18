//! Angles without a unit.

use crate::algebra::number::{Angle, Reading};
use crate::error::{Error, Result};

/// The largest angle in radians that is read without a unit: a full turn, whose last digit may be rounded up.
const LARGEST: f64 = 6.3;

/// Reads an angle as [`Angle::parse`] does. Where numbers without a unit are radians, one beyond a full turn is taken for degrees that lack
/// theirs.
///
/// # Errors
/// For text that is no angle, and for such a number.
pub fn turn(text: &str, reading: &Reading) -> Result<Angle> {
    let is_large = |plain: f64| plain.is_finite() && plain.abs() > LARGEST;
    if !reading.degrees && text.trim().parse().is_ok_and(is_large) {
        return Err(Error::Invalid(format!(
            "found the angle {0} without a unit, expected at most a full turn in radians: write `{0} deg` for degrees",
            text.trim()
        )));
    }
    Ok(Angle::parse(text, reading)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_beyond_a_full_turn_wants_a_unit() {
        let reading = Reading::default();
        for text in ["3.1", "6.2832", "-2*pi", "45 deg", "45 rad", "10*pi"] {
            assert!(turn(text, &reading).is_ok(), "{text}");
        }
        for text in ["45", "-30.5", " 360 "] {
            let message = turn(text, &reading).expect_err("no unit").to_string();
            assert!(message.contains(&format!("`{} deg`", text.trim())), "{message}");
        }
        assert!(turn("360", &Reading { degrees: true, ..reading }).is_ok());
    }
}
