//! Angles within the joint limits: which of the values that differ by whole turns is listed.

use super::FullMode;
use crate::kinematics::chain::Chain;
use crate::kinematics::joint::Variable;
use std::f64::consts::TAU;

/// The limits of the rotations of a chain, with their places among the joint variables.
pub(super) struct Turns(Vec<(usize, [f64; 2])>);

impl Turns {
    /// The limited rotations of a chain.
    pub(super) fn of(chain: Option<&Chain>, limits: &[[f64; 2]]) -> Self {
        let variables = chain.map(Chain::variables).unwrap_or_default();
        let limited = variables.iter().zip(limits).enumerate();
        let rotations = limited.filter(|(_, (own, _))| own.variable == Variable::Rotation);
        Self(rotations.map(|(at, (_, limits))| (at, *limits)).collect())
    }

    /// Moves the angles of a mode that respects the limits into them, by whole turns.
    pub(super) fn apply(&self, mode: &mut FullMode) {
        if mode.within_limits != Some(true) {
            return;
        }
        for &(at, limits) in &self.0 {
            if let Some(value) = mode.q.get_mut(at) {
                value.re = within(value.re, limits);
            }
        }
    }
}

/// The angle itself where it respects the limits, else the first one beyond the lower limit, or before the upper one.
fn within(angle: f64, [low, high]: [f64; 2]) -> f64 {
    if (low..=high).contains(&angle) {
        return angle;
    }
    let turns = if low.is_finite() { ((low - angle) / TAU).ceil() } else { ((high - angle) / TAU).floor() };
    // A sum may be rounded beyond a limit that it meets.
    (angle + TAU * turns).clamp(low, high)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn angles_move_by_whole_turns_only_where_they_must() {
        let degrees =
            |angle: f64, limits: [f64; 2]| within(angle.to_radians(), limits.map(f64::to_radians)).to_degrees();
        assert_eq!(degrees(20.0, [-360.0, 360.0]), 20.0);
        assert!((degrees(-100.0, [47.0, 313.0]) - 260.0).abs() < 1e-12);
        assert!((degrees(170.0, [-350.0, -10.0]) + 190.0).abs() < 1e-12);
        assert!((degrees(10.0, [f64::NEG_INFINITY, -90.0]) + 350.0).abs() < 1e-12);
        assert_eq!(within(-PI, [PI, PI]), PI);
    }
}
