//! Input of the border basis: u as quadratic forms and unknowns, and the conditions left.

use super::arithmetic::Arithmetic;
use super::directions::{Directions, MOST};
use crate::closure::study::Form;

/// `u_k = z^T forms_k z + sum_a null_a[k] tau_a`, with the conditions `z^T dropped_a z = sum_b slopes_ab tau_b`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting<E> {
    /// The number of unknowns tau.
    pub count: usize,
    /// The forms of u = N (p.p, p, R^T p).
    pub forms: [Form<E>; 7],
    /// The part of u that multiplies each tau.
    pub null: [[E; 7]; MOST],
    /// The forms of the conditions; `count - 1` are in use.
    pub dropped: [Form<E>; MOST - 1],
    /// The right sides of the conditions.
    pub slopes: [[E; MOST]; MOST - 1],
}

impl<E: Copy> Setting<E> {
    /// The setting of legs with right sides c.
    pub fn new<A: Arithmetic<Element = E>>(arithmetic: &A, directions: &Directions<E>, c: &[Form<E>; 6]) -> Self {
        let combined = |weights: &[E; 6]| -> Form<E> {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| {
                    let terms = weights.iter().zip(c).map(|(w, c)| arithmetic.mul(*w, c[i][j]));
                    terms.fold(arithmetic.zero(), |sum, term| arithmetic.add(sum, term))
                })
            })
        };
        Self {
            count: directions.count,
            forms: directions.particular.map(|weights| combined(&weights)),
            null: directions.null,
            dropped: directions.dropped.map(|weights| combined(&weights)),
            slopes: directions.slopes,
        }
    }

    /// As [`Self::new`], with the squares of the legs changed: c_i gains `squares[i] N`.
    #[must_use]
    pub fn with_legs<A: Arithmetic<Element = E>>(
        &self,
        arithmetic: &A,
        directions: &Directions<E>,
        squares: &[E; 6],
    ) -> Self {
        let shifted = |form: &Form<E>, weights: &[E; 6]| {
            let terms = weights.iter().zip(squares).map(|(w, s)| arithmetic.mul(*w, *s));
            let shift = terms.fold(arithmetic.zero(), |sum, term| arithmetic.add(sum, term));
            let mut form = *form;
            for (i, row) in form.iter_mut().enumerate() {
                row[i] = arithmetic.add(row[i], shift);
            }
            form
        };
        Self {
            forms: std::array::from_fn(|k| shifted(&self.forms[k], &directions.particular[k])),
            dropped: std::array::from_fn(|a| shifted(&self.dropped[a], &directions.dropped[a])),
            ..*self
        }
    }
}
