//! The contradiction that closure equations without solution come to, with its distance from configurations that nearly close.
//!
//! Where 1 is a combination of the closure equations, no configuration closes the loop. Let every equation be off by `miss` at
//! most at a real configuration. Then the relations formed from the equations are off there by what follows from the
//! steps of the plan: cosines and sines are at most 1. If 1 is off by less than 1, there is no such configuration.

use super::{Plan, Relations, Setting, Source, Sparse};
use crate::algebra::interval::Interval;
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};

impl Plan {
    /// Returns a bound on the number 1 at every real configuration at which no closure equation of a loop of rotations is off by
    /// more than `miss`: if it is below 1, there is no such configuration. `None` where the plan leads to solutions, and where
    /// intervals do not follow it.
    #[must_use]
    pub fn one_off(&self, closed: &ClosedLoop<Interval>, miss: f64) -> Option<f64> {
        if self.count != 0 || closed.variables.contains(&Variable::Translation) {
            return None;
        }
        let setting = Setting::of(closed, self.is_zero)?;
        let mut relations = setting.relations(self.most);
        let mut off = vec![0.0; relations.columns.len()];
        for (source, column) in &self.steps {
            let relation = relations.relation(&setting.equations, *source)?;
            let own = match source {
                Source::Equation(_) => miss,
                Source::Product { column, .. } => off[*column],
            };
            let (row, own) = relations.reduced_and_off(&relation, *column, own, &off)?;
            off[*column] = own * row[*column].inverse()?.magnitude();
            if !relations.take(*column, &row) {
                return None;
            }
        }
        // The monomial 1 is the last one.
        let is_one = relations.rows.last().is_some_and(Option::is_some);
        off.last().copied().filter(|bound| is_one && bound.is_finite())
    }
}

impl Relations<Interval> {
    /// Reduces a relation that is off by `own` up to a column, by relations that are off by so much; how much the result is off.
    fn reduced_and_off(
        &self,
        relation: &Sparse<Interval>,
        column: usize,
        mut own: f64,
        off: &[f64],
    ) -> Option<(Vec<Interval>, f64)> {
        let mut row = vec![Interval::zero(); self.columns.len()];
        for (monomial, c) in relation.iter().filter(|(_, c)| !c.is_zero()) {
            row[*self.places.get(monomial)?] = *c;
        }
        for k in 0..column {
            let here = row[k];
            match &self.rows[k] {
                // Rounding of zero as a rule; whatever it is, it counts as off.
                _ if here.contains(0.0) => own += here.magnitude(),
                Some(pivot) => {
                    own += here.magnitude() * off[k];
                    let factor = here.neg();
                    for (x, p) in row[k..].iter_mut().zip(pivot).filter(|(_, p)| !p.is_zero()) {
                        x.add_product(&factor, p);
                    }
                }
                None => return None,
            }
            row[k] = Interval::zero();
        }
        Some((row, own))
    }
}
