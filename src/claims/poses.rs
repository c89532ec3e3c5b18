//! Poses of a platform, measured by the lengths of its legs.

use crate::algebra::number::Number;
use crate::catalogue::entry::Case;
use crate::error::{Error, Result};
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::platform::Platform;
use crate::mechanism::FullMode;

/// A platform in f64, and its size.
pub(super) struct Poses {
    platform: Platform<f64>,
    reach: f64,
}

impl Poses {
    /// Returns the poses of a platform.
    pub(super) fn of(platform: &Platform<Number>) -> Self {
        let rounded = |points: &[[Number; 3]; 6]| points.each_ref().map(|p| p.each_ref().map(Number::to_f64));
        let platform = Platform { base: rounded(&platform.base), plate: rounded(&platform.plate) };
        let size = |v: &Vector<f64>| v.iter().map(|x| x * x).sum::<f64>().sqrt();
        let reach = platform.base.iter().chain(&platform.plate).map(size).fold(f64::MIN_POSITIVE, f64::max);
        Self { platform, reach }
    }

    /// Returns the largest difference of a leg's length at this pose from the given one, over the reach.
    pub(super) fn closure(&self, case: &Case, q: &[f64]) -> Result<f64> {
        let &[w, x, y, z, a, b, c] = q else {
            return Err(Error::Invalid(format!("found a solution of {} values, expected 7", q.len())));
        };
        let squares = case.legs_squared.as_ref();
        let squares = squares.ok_or_else(|| Error::Invalid("a case of a platform without legs".to_owned()))?;
        let rotation = Quaternion { scalar: w, vector: [x, y, z] }.scaled_rotation();
        let pose = Motion { rotation, translation: [a, b, c] };
        let found = self.platform.legs_squared(&pose);
        let reach = found.iter().map(|square| square.sqrt()).fold(self.reach, f64::max);
        let off = |(found, wanted): (&f64, &Number)| (found.sqrt() - wanted.to_f64().sqrt()).abs() / reach;
        Ok(found.iter().zip(squares).map(off).fold(0.0, f64::max))
    }

    /// Returns the largest difference of a component of quaternion or position, imaginary parts included; a quaternion and
    /// its negative are the same, lengths count over the reach.
    pub(super) fn distance(&self, mode: &FullMode, q: &[f64]) -> f64 {
        let apart = |sign: f64| {
            let differences = mode.q.iter().zip(q).enumerate().map(|(k, (found, claimed))| {
                let (wanted, scale) = if k < 4 { (sign * claimed, 1.0) } else { (*claimed, self.reach) };
                (found - wanted).re.abs().max(found.im.abs()) / scale
            });
            differences.fold(0.0, f64::max)
        };
        apart(1.0).min(apart(-1.0))
    }
}
