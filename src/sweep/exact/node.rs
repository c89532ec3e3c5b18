//! Two branches that meet at an input and both pass it.
//!
//! Where the closure polynomial is `a t^2 + b t + c`, its roots are `(-b + r)/2a` with `r^2 = D = b^2 - 4ac`. About a root of
//! D of order 2k both values of r are analytic functions of the input: the sign of r changes there k times. So it is with two of
//! more roots if all others are real and simple: they are those of a factor `t^2 + b t + c` with analytic coefficients, and the
//! discriminant is that of this factor times a function without zeros.

use super::crossing::{Sheet, is_closed_in, is_small, is_some_nonzero, place};
use super::output::Chart;
use super::plane_curve::{Rectangle, sign_changes};
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use rug::Rational;
use std::cmp::Ordering;

/// Two branches on both sides of an input at which the discriminant of a quadratic polynomial vanishes.
pub(super) struct Node<'a> {
    pub chart: &'a Chart,
    pub kind: Variable,
    pub interval: [&'a Rational; 2],
    /// The inputs on both sides, in the order of the sweep.
    pub ends: [&'a Rational; 2],
    /// The branches there.
    pub sheets: [[&'a Sheet; 2]; 2],
}

impl Node<'_> {
    /// Returns the branch of the second side into which each of the first one passes, where the discriminant has a root of this
    /// order; `None` where a distance may go to infinity, or the two may not stay among themselves.
    pub fn pairs(&self, order: usize) -> Option<[[usize; 2]; 2]> {
        if !self.is_finite() {
            return None;
        }
        let is_inverted = match self.chart.curve.degree() {
            2 => None,
            _ => Some(self.is_closed_inverted()?),
        };
        let [first, second] =
            [0, 1].map(|side| is_inverted.map_or_else(|| self.signs(side), |is| self.order(side, is)));
        let (first, second) = (first?, second?);
        let is_changed = order % 4 == 2;
        let is_next = |k: usize, j: usize| (first[k] == second[j]) != is_changed;
        let next = |k: usize| (0..2).find(|j| is_next(k, *j)).map(|j| [self.sheets[0][k].mode, self.sheets[1][j].mode]);
        Some([next(0)?, next(1)?])
    }

    /// The signs of r on one side.
    fn signs(&self, side: usize) -> Option<[Ordering; 2]> {
        let curve = &self.chart.curve;
        let [leading, linear] = [2, 1].map(|k| curve.sign_of(k, self.ends[side]));
        let [one, two] = self.sheets[side];
        // r is 2 a t + b: a times the distance to the other root, and where one root is infinite b or -b.
        let first = match (&one.t, &two.t) {
            (Some(x), Some(y)) if leading.is_gt() => x.cmp(y),
            (Some(x), Some(y)) if leading.is_lt() => y.cmp(x),
            (Some(_), None) => linear,
            (None, Some(_)) => linear.reverse(),
            _ => Ordering::Equal,
        };
        first.is_ne().then(|| [first, first.reverse()])
    }

    /// The order of the two branches of one side, by t or by 1/t.
    fn order(&self, side: usize, is_inverted: bool) -> Option<[Ordering; 2]> {
        let [one, two] = self.sheets[side].map(|sheet| place(sheet, is_inverted));
        let first = one?.cmp(&two?);
        first.is_ne().then(|| [first, first.reverse()])
    }

    /// Whether t or 1/t is the coordinate in which a rectangle holds both branches at its ends and none leaves it.
    fn is_closed_inverted(&self) -> Option<bool> {
        let (rectangle, is_inverted) = self.rectangle()?;
        is_closed_in(self.chart, &rectangle, is_inverted).then_some(is_inverted)
    }

    /// A rectangle over the interval about the ends of both branches, in t or 1/t.
    fn rectangle(&self) -> Option<(Rectangle, bool)> {
        let all = || self.sheets.iter().flatten();
        let is_inverted = !all().all(|sheet| is_small(sheet));
        let places: Option<Vec<Rational>> = all().map(|sheet| place(sheet, is_inverted)).collect();
        let places = places?;
        let (low, high) = (places.iter().min()?, places.iter().max()?);
        Some((Rectangle::over(self.interval, [low, high], 2), is_inverted))
    }

    /// Whether no distance goes to infinity on either branch.
    fn is_finite(&self) -> bool {
        let chart = self.chart;
        let leading = chart.curve.coefficient(chart.curve.degree());
        if self.kind == Variable::Translation && (leading.is_zero() || sign_changes(&leading, self.interval) > 0) {
            return false;
        }
        if sign_changes(&chart.pole, self.interval) > 0 {
            return false;
        }
        chart.parallel.is_empty() || self.is_away_from_dependence().unwrap_or(false)
    }

    /// Whether translations are independent in a rectangle that both branches stay in.
    fn is_away_from_dependence(&self) -> Option<bool> {
        let (rectangle, is_inverted) = self.rectangle()?;
        Some(
            is_closed_in(self.chart, &rectangle, is_inverted)
                && is_some_nonzero(&self.chart.parallel, &rectangle, is_inverted),
        )
    }
}
