//! Detects printed angles that are multiples of half a degree.

use std::f64::consts::PI;

/// Number of agreeing digits from which on an angle is taken as a multiple of half a degree.
const DIGITS: i32 = 12;
/// Number of agreeing digits from which on an angle is reported. Fewer are too often a coincidence: with four, one in thirty
/// angles agrees with a multiple of half a degree.
const NOTICED: i32 = 6;
/// The same number for multiples of 45 degrees, which are ninety times rarer.
const NOTICED_RIGHT: i32 = 3;
/// Maximum error of a truncated angle, in units of its last digit: `1.570796325` is a popular `pi/2`.
const UNITS: f64 = 2.0;

/// An angle of a file that represents a multiple of half a degree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Snapped {
    /// Its text in the file.
    pub written: String,
    /// The angle in halves of a degree.
    pub halves: i64,
    /// The joint, or the row of a table.
    pub place: String,
    /// Whether it was replaced by that angle, or only reported.
    pub taken: bool,
}

impl Snapped {
    /// Returns the intended angle with its unit.
    #[must_use]
    pub fn meant(&self) -> String {
        let sign = if self.halves < 0 { "-" } else { "" };
        let (whole, half) = (self.halves.abs() / 2, self.halves.abs() % 2);
        format!("{sign}{whole}{} deg", if half == 1 { ".5" } else { "" })
    }
}

/// The nearness of a number in radians to a multiple of half a degree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Nearness {
    /// It is the double nearest to it, or agrees in twelve digits.
    Same,
    /// It looks like the multiple truncated.
    Truncated,
}

/// Returns the multiple of half a degree that a plain decimal in radians may represent, except a plain zero.
pub(super) fn multiple(text: &str) -> Option<(i64, Nearness)> {
    let is_decimal = text.bytes().all(|b| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E'));
    let value: f64 = if is_decimal { text.parse().ok()? } else { return None };
    let halves = (value * 360.0 / PI).round();
    if value == 0.0 || halves.abs() > 1e6 {
        return None;
    }
    let meant = halves * PI / 360.0;
    let off = (value - meant).abs();
    let (digits, unit) = printed(text)?;
    // A zero has no digits of its own; it is compared to twelve decimals.
    let agrees = if halves == 0.0 { off < 0.5e-12 } else { digits >= DIGITS && off <= unit.max(value.abs() * 4e-16) };
    let noticed = if halves % 90.0 == 0.0 { NOTICED_RIGHT } else { NOTICED };
    let is_truncated = halves != 0.0 && digits >= noticed && off <= UNITS * unit;
    #[expect(clippy::cast_possible_truncation, reason = "a whole number below a million")]
    let halves = halves as i64;
    if agrees || value == meant {
        Some((halves, Nearness::Same))
    } else if is_truncated {
        Some((halves, Nearness::Truncated))
    } else {
        None
    }
}

/// Returns the significant digits of a decimal, and one unit of its last one.
pub(super) fn printed(text: &str) -> Option<(i32, f64)> {
    let lower = text.to_ascii_lowercase();
    let (mantissa, exponent) = lower.split_once('e').unwrap_or((&lower, "0"));
    let exponent: i32 = exponent.parse().ok()?;
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    let significant = i32::try_from(digits.trim_start_matches('0').len()).ok()?;
    let place = exponent.checked_sub(i32::try_from(decimals).ok()?)?;
    Some((significant, 10_f64.powi(place)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn doubles_and_twelve_digits_are_the_angle() {
        for text in ["1.5707963267948966", "1.57079632679", "-1.570796326795", "3.141592653589793", "0.785398163398"] {
            assert_eq!(multiple(text).expect(text).1, Nearness::Same, "{text}");
        }
        assert_eq!(multiple("-1.1344640137963142"), Some((-130, Nearness::Same)));
        assert_eq!(multiple("-1.7889624832941877"), Some((-205, Nearness::Same)));
        assert_eq!(multiple("8.67362e-16"), Some((0, Nearness::Same)));
    }

    #[test]
    fn truncated_angles_are_noticed_only() {
        for text in ["1.5708", "-1.571", "3.14159", "1.570795", "1.570796325", "3.1416"] {
            assert_eq!(multiple(text).expect(text).1, Nearness::Truncated, "{text}");
        }
        for text in ["0.3", "1.5", "0.0436497", "1.25539", "0", "0.0", "0.1", "pi/2", "1.58", "90 deg", "-5.2e-8"] {
            assert_eq!(multiple(text), None, "{text}");
        }
    }

    #[test]
    fn multiples_are_written_with_their_unit() {
        let snapped = |halves| Snapped { written: String::new(), halves, place: String::new(), taken: true }.meant();
        assert_eq!(
            [snapped(-1), snapped(180), snapped(0), snapped(-205)],
            ["-0.5 deg", "90 deg", "0 deg", "-102.5 deg"]
        );
    }
}
