//! A linear program over a box: cosine and sine of every angle, measured from the middle of its arc, between their bounds on it.
//!
//! Nothing here is proved. What it yields are factors of the equations, and [`super::forms`] proves what follows from these.
//! Every row of the tableau is such a combination: one unknown, the basic one, by those that stand at a bound. The bounded dual
//! simplex method changes the basis until the extreme value of one unknown is as small as the equations allow \[Maros2003\].
//! Pivots are few: the first basis holds the sines, whose rows are those of Newton's method.

use super::arc::Arc;
use super::forms::Forms;
use std::f64::consts::{FRAC_PI_2, PI};

/// No row.
const NONE: usize = usize::MAX;
/// Entries below this are roundings of zero: coefficients are near 1.
const ZERO: f64 = 1e-11;
/// Bounds may be left by this part of their distance.
const FEASIBLE: f64 = 1e-9;
/// A bound counts as attained within this part of the distance of both: no cut would gain more.
const ATTAINED: f64 = 0.02;
/// Most pivots for one extreme value; ten are usual for twenty angles.
const PIVOTS: usize = 60;

/// The tableau. Column 2 j is the cosine of an angle, 2 j + 1 its sine; behind these stand the factors of the equations,
/// and the constant.
#[derive(Debug)]
pub struct Tableau {
    rows: usize,
    columns: usize,
    width: usize,
    entries: Vec<f64>,
    /// The basic unknown of every row.
    basis: Vec<usize>,
    /// The row of every basic unknown.
    place: Vec<usize>,
    low: Vec<f64>,
    high: Vec<f64>,
    /// The value of every unknown that is not basic: one of its bounds; 0 of basic ones.
    values: Vec<f64>,
    at_high: Vec<bool>,
    /// The values of the basic unknowns.
    basic: Vec<f64>,
    middles: Vec<f64>,
    candidates: Vec<(f64, usize, f64)>,
}

/// Which bound of an unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The lower one.
    Low,
    /// The upper one.
    High,
}

impl Tableau {
    /// The equations solved for unknowns that vary most; `None` where they are dependent.
    #[must_use]
    pub fn new(forms: &Forms, arcs: &[Arc]) -> Option<Self> {
        let (rows, columns) = (forms.rows(), 2 * arcs.len());
        let width = columns + rows + 1;
        let mut entries = vec![0.0; rows * width];
        let middles: Vec<f64> = arcs.iter().map(Arc::middle).collect();
        for (j, middle) in middles.iter().enumerate() {
            let (sin, cos) = middle.sin_cos();
            for i in 0..rows {
                let wave = forms.row(i)[j];
                entries[i * width + 2 * j] = wave.u * cos + wave.v * sin;
                entries[i * width + 2 * j + 1] = wave.v * cos - wave.u * sin;
            }
        }
        for i in 0..rows {
            entries[i * width + columns + i] = 1.0;
            entries[i * width + width - 1] = -forms.constant(i);
        }
        let mut tableau = Self {
            rows,
            columns,
            width,
            entries,
            basis: vec![NONE; rows],
            place: vec![NONE; columns],
            low: vec![0.0; columns],
            high: vec![0.0; columns],
            values: vec![0.0; columns],
            at_high: vec![false; columns],
            basic: vec![0.0; rows],
            middles,
            candidates: Vec::new(),
        };
        tableau.bound(arcs);
        for _ in 0..rows {
            let mut best = (0.0, 0, 0);
            for i in (0..rows).filter(|i| tableau.basis[*i] == NONE) {
                for c in (0..columns).filter(|c| tableau.place[*c] == NONE) {
                    let moved = (tableau.entry(i, c) * tableau.span(c)).abs();
                    if moved > best.0 {
                        best = (moved, i, c);
                    }
                }
            }
            // Below, nothing but roundings of a box of width 1e-8 is left.
            if !(best.0 > 1e-20) {
                return None;
            }
            tableau.pivot(best.1, best.2);
        }
        Some(tableau)
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        self.entries[row * self.width + column]
    }

    fn span(&self, column: usize) -> f64 {
        (self.high[column] - self.low[column]).max(f64::MIN_POSITIVE)
    }

    /// Takes the bounds of narrower arcs.
    pub fn bound(&mut self, arcs: &[Arc]) {
        for (j, (arc, middle)) in arcs.iter().zip(&self.middles).enumerate() {
            let (from, to) = (arc.lo() - middle, arc.hi() - middle);
            let farthest = to.max(-from);
            self.low[2 * j] = if farthest >= PI { -1.0 } else { farthest.cos() };
            self.high[2 * j] = if from <= 0.0 && to >= 0.0 { 1.0 } else { from.cos().max(to.cos()) };
            self.low[2 * j + 1] = if from <= -FRAC_PI_2 { -1.0 } else { from.sin() };
            self.high[2 * j + 1] = if to >= FRAC_PI_2 { 1.0 } else { to.sin() };
        }
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let width = self.width;
        let inverse = 1.0 / self.entry(row, column);
        let (before, rest) = self.entries.split_at_mut(row * width);
        let (own, after) = rest.split_at_mut(width);
        for x in own.iter_mut() {
            *x *= inverse;
        }
        for other in before.chunks_exact_mut(width).chain(after.chunks_exact_mut(width)) {
            let factor = other[column];
            if factor != 0.0 {
                for (x, y) in other.iter_mut().zip(own.iter()) {
                    *x -= factor * y;
                }
            }
        }
        if self.basis[row] != NONE {
            self.place[self.basis[row]] = NONE;
        }
        self.basis[row] = column;
        self.place[column] = row;
    }

    /// The factors of the equations that make a row.
    #[must_use]
    pub fn factors(&self, row: usize) -> &[f64] {
        &self.entries[row * self.width + self.columns..][..self.rows]
    }

    /// The factors that solve the equations for the sine of an angle to first order; `None` where it is not basic.
    #[must_use]
    pub fn newton_factors(&self, angle: usize) -> Option<&[f64]> {
        let row = self.place[2 * angle + 1];
        (row != NONE).then(|| self.factors(row))
    }

    /// Puts an unknown that is not basic to one of its bounds.
    fn put(&mut self, column: usize, high: bool) {
        self.at_high[column] = high;
        self.values[column] = if high { self.high[column] } else { self.low[column] };
    }

    /// The values of the basic unknowns from those of the others.
    fn valued(&mut self) {
        for row in 0..self.rows {
            self.values[self.basis[row]] = 0.0;
        }
        for row in 0..self.rows {
            let own = &self.entries[row * self.width..][..self.width];
            let others: f64 = own.iter().zip(&self.values).map(|(x, y)| x * y).sum();
            self.basic[row] = own[self.width - 1] - others;
        }
    }

    /// Seeks the extreme value of the sine of an angle. Returns a row that bounds it, or that shows the box to be empty; and
    /// whether the extreme is attained, as far as the linear equations can tell.
    pub fn extreme(&mut self, angle: usize, side: Side) -> Option<(usize, bool)> {
        let column = 2 * angle + 1;
        let sign = if side == Side::High { 1.0 } else { -1.0 };
        if self.place[column] == NONE {
            let moved = |row: usize| self.entry(row, column).abs() / self.span(self.basis[row]);
            let row = (0..self.rows).max_by(|a, b| moved(*a).total_cmp(&moved(*b)))?;
            if !(self.entry(row, column).abs() > ZERO) {
                return None;
            }
            self.pivot(row, column);
        }
        let goal = self.place[column];
        for c in (0..self.columns).filter(|c| *c != column) {
            if self.place[c] == NONE {
                self.put(c, -sign * self.entry(goal, c) > 0.0);
            }
        }
        for _ in 0..PIVOTS {
            self.valued();
            let Some((row, excess, high)) = self.most_violated(goal) else { return Some((goal, true)) };
            let Some(entering) = self.entering(goal, row, excess, high) else { return Some((row, false)) };
            let leaving = self.basis[row];
            self.pivot(row, entering);
            self.put(leaving, high);
        }
        Some((goal, false))
    }

    /// The row whose basic unknown is farthest beyond a bound, and by how much, above or below.
    fn most_violated(&self, goal: usize) -> Option<(usize, f64, bool)> {
        let mut worst = None;
        let mut most = FEASIBLE;
        for row in (0..self.rows).filter(|row| *row != goal) {
            let column = self.basis[row];
            let (x, span) = (self.basic[row], self.span(column));
            for (excess, high) in [(x - self.high[column], true), (self.low[column] - x, false)] {
                if excess / span > most {
                    most = excess / span;
                    worst = Some((row, excess, high));
                }
            }
        }
        worst
    }

    /// The unknown that takes the place of the one of a row, and no longer improves the bound; those passed on the way go to
    /// their other bound. `None` where all of them do not suffice.
    fn entering(&mut self, goal: usize, row: usize, mut excess: f64, high: bool) -> Option<usize> {
        let mut candidates = std::mem::take(&mut self.candidates);
        candidates.clear();
        for c in (0..self.columns).filter(|c| self.place[*c] == NONE) {
            let entry = if high { self.entry(row, c) } else { -self.entry(row, c) };
            let lowers = if self.at_high[c] { entry < -ZERO } else { entry > ZERO };
            if lowers {
                candidates.push((self.entry(goal, c).abs() / entry.abs(), c, entry.abs()));
            }
        }
        candidates.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut found = None;
        for (_, c, entry) in &candidates {
            excess -= entry * self.span(*c);
            if excess <= 0.0 {
                found = Some(*c);
                break;
            }
            self.put(*c, !self.at_high[*c]);
        }
        self.candidates = candidates;
        found
    }

    /// Notes the bounds of sines that the point at which [`Self::extreme`] ended attains.
    pub fn attained(&self, known: &mut [[bool; 2]]) {
        for (angle, known) in known.iter_mut().enumerate() {
            let column = 2 * angle + 1;
            let row = self.place[column];
            let x = if row == NONE { self.values[column] } else { self.basic[row] };
            let near = ATTAINED * self.span(column);
            known[0] |= x < self.low[column] + near;
            known[1] |= x > self.high[column] - near;
        }
    }
}
