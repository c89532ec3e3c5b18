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
        Self::new(&variables.iter().map(|own| own.variable).collect::<Vec<_>>(), limits)
    }

    /// The limited rotations among joint variables.
    pub(super) fn new(variables: &[Variable], limits: &[[f64; 2]]) -> Self {
        let limited = variables.iter().zip(limits).enumerate();
        let rotations = limited.filter(|(_, (own, _))| **own == Variable::Rotation);
        Self(rotations.map(|(at, (_, limits))| (at, *limits)).collect())
    }

    /// Moves the angles of a configuration that respects the limits to this rounding into them, by whole turns.
    pub(super) fn place(&self, q: &mut [f64], rounding: f64) {
        for &(at, [low, high]) in &self.0 {
            if let Some(value) = q.get_mut(at) {
                *value = within(*value, [low - rounding, high + rounding]).clamp(low, high);
            }
        }
    }

    /// Moves those angles of a configuration that whole turns lead into the limits; the others stay as they are.
    pub(super) fn turn(&self, q: &mut [f64]) {
        for &(at, limits) in &self.0 {
            if let Some(value) = q.get_mut(at) {
                let moved = within(*value, limits);
                let turns = (moved - *value) / TAU;
                // What is no whole turn was cut off at a limit.
                if (turns - turns.round()).abs() < f64::EPSILON * (1.0 + turns.abs()) {
                    *value = moved;
                }
            }
        }
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

/// Most representatives listed of a configuration: six joints of three turns each have 729.
const MOST: usize = 1000;

/// A real configuration with every choice of whole turns that lies within the limits; itself alone where it lies outside them
/// or there are none.
#[must_use]
pub fn representatives(mode: &FullMode, variables: &[Variable], limits: &[[f64; 2]]) -> Vec<Vec<f64>> {
    let mut all = vec![Vec::new()];
    for (k, value) in mode.q.iter().enumerate() {
        let limits = limits.get(k).filter(|_| variables.get(k) == Some(&Variable::Rotation));
        let choices = match limits {
            Some([low, high]) if mode.within_limits == Some(true) && low.is_finite() && high.is_finite() => {
                let first = value.re + TAU * ((low - value.re) / TAU).ceil();
                // The limits of a file are finite, but may be far apart.
                let turns = std::iter::successors(Some(first), |angle| Some(angle + TAU));
                // A first one that rounding put beyond a limit meets it.
                let rest = turns.skip(1).take_while(|angle| angle <= high).take(MOST);
                std::iter::once(first.clamp(*low, *high)).chain(rest).collect()
            }
            _ => vec![value.re],
        };
        all = all
            .iter()
            .flat_map(|q: &Vec<f64>| choices.iter().map(move |choice| [q.as_slice(), &[*choice]].concat()))
            .take(MOST)
            .collect();
    }
    all
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
    fn angles_that_no_turn_leads_into_the_limits_stay() {
        let turns = Turns::new(&[Variable::Rotation; 2], &[[0.0, 3.0]; 2]);
        let mut q = [1.5 - TAU, 3.1];
        turns.turn(&mut q);
        assert!((q[0] - 1.5).abs() < 1e-12 && q[1] == 3.1, "{q:?}");
    }

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
