//! The tolerance of a configuration beside the requested pose.

use super::motion::Motion;
use crate::algebra::number::{Angle, Number, Quantity, Reading};
use crate::error::{Error, Result};

/// Largest error of the pose with which a configuration is still listed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tolerance {
    /// Error of the position, in metres.
    pub length: f64,
    /// Error of the orientation, in radians.
    pub angle: f64,
}

impl Default for Tolerance {
    /// The default of arms of six joints and more is a nanometre and a nanoradian: nine printed digits leave that open.
    fn default() -> Self {
        Self { length: 1e-9, angle: 1e-9 }
    }
}

impl Tolerance {
    /// Reads `LENGTH,ANGLE`.
    ///
    /// # Errors
    /// [`Error::Invalid`] for anything but two numbers that are not negative.
    ///
    /// # Example
    /// ```
    /// use looproot_engine::kinematics::tolerance::Tolerance;
    /// use looproot_algebra::number::Reading;
    /// let tolerance = Tolerance::parse("0.1 mm, 1e-3", &Reading::default())?;
    /// assert_eq!(tolerance, Tolerance { length: 1e-4, angle: 1e-3 });
    /// # Ok::<(), looproot_engine::error::Error>(())
    /// ```
    pub fn parse(text: &str, reading: &Reading) -> Result<Self> {
        let expected = || Error::Invalid(format!("found the tolerance `{text}`, expected LENGTH,ANGLE, none below 0"));
        let (length, angle) = text.split_once(',').ok_or_else(expected)?;
        let length = Number::parse(length.trim(), Quantity::Length, reading)?.to_f64();
        let angle = Angle::parse(angle.trim(), reading)?.radians();
        if length >= 0.0 && angle >= 0.0 { Ok(Self { length, angle }) } else { Err(expected()) }
    }

    /// Whether a miss is within it.
    #[must_use]
    pub fn allows(&self, miss: &PoseError) -> bool {
        miss.position <= self.length && miss.orientation <= self.angle
    }

    /// Returns the size of an error in units of the tolerance.
    #[must_use]
    pub fn parts(&self, miss: &PoseError) -> f64 {
        let over = |size: f64, one: f64| size / one.max(f64::MIN_POSITIVE);
        over(miss.position, self.length).max(over(miss.orientation, self.angle))
    }

    /// The larger one of each.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        Self { length: self.length.max(other.length), angle: self.angle.max(other.angle) }
    }
}

/// The error of a configuration against the requested pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PoseError {
    /// The distance of the origins of the tool, metres.
    pub position: f64,
    /// The angle between the orientations, radians.
    pub orientation: f64,
}

impl PoseError {
    /// The larger one of both numbers.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.position.max(self.orientation)
    }

    /// The distance and the angle between two poses.
    #[must_use]
    pub fn between(one: &Motion<f64>, other: &Motion<f64>) -> Self {
        let apart = (0..3).map(|i| (one.translation[i] - other.translation[i]).powi(2)).sum::<f64>();
        // The difference of the matrices is 2 sqrt(2) sin(angle / 2) long, which keeps the digits of small angles.
        let turned = (0..9).map(|k| (one.rotation[k / 3][k % 3] - other.rotation[k / 3][k % 3]).powi(2)).sum::<f64>();
        let half_sine = (turned / 8.0).sqrt().min(1.0);
        Self { position: apart.sqrt(), orientation: 2.0 * half_sine.asin() }
    }
}
