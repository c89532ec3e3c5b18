//! Four rotations, two of them opposite and with the translations along their axes: degree 4.
//!
//! With axes i and m = i + 2 that translate, the dual cosine of these two lines, their angle and its moment, is free of
//! all that is between them but the rotation j on one side, k on the other: two equations, linear in (1, cos, sin) of j
//! and of k.

use super::separated::Separated;
use crate::algebra::ring::{Field, Ring};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::{LinkForm, product, turned};
use crate::kinematics::motion::{Vector, cross};

/// The axes along which the translations run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OppositeAxes {
    /// Rotation i; the other one is two behind it.
    pub first: usize,
}

impl OppositeAxes {
    /// The axes along which the translations run, if these are opposite; sines no larger than `tolerance` (0 in exact
    /// fields) are zero.
    #[must_use]
    pub fn of<F: Field>(form: &LinkForm<F, 4, 2>, tolerance: f64) -> Option<Self> {
        let along = |slide: usize, axis: usize| {
            let slide = &form.slides[slide];
            let z: Vector<F> = if axis % 4 == slide.link {
                [F::zero(), F::zero(), F::one()]
            } else if axis % 4 == (slide.link + 1) % 4 {
                std::array::from_fn(|i| form.links[slide.link].rotation[i][2].clone())
            } else {
                return false;
            };
            cross(&z, &slide.direction).iter().all(|x| x.pivot_size() <= tolerance)
        };
        let both = |i: usize| (along(0, i) && along(1, i + 2)) || (along(1, i) && along(0, i + 2));
        (0..2).find(|&i| both(i)).map(|first| Self { first })
    }

    /// `(1, cos, sin)` of the rotation behind axis `axis`: the cosine between that axis and the one two behind it, and
    /// the moment.
    fn functional<R: Ring>(form: &LinkForm<R, 4, 2>, axis: usize) -> [[R; 3]; 2] {
        let (here, next) = (&form.links[axis % 4], &form.links[(axis + 1) % 4]);
        let z: Vector<R> = [R::zero(), R::zero(), R::one()];
        // The first axis and its moment behind its link, the second one and its moment before the rotation.
        let back = |v: &Vector<R>| -> Vector<R> {
            std::array::from_fn(|j| (0..3).fold(R::zero(), |sum, i| sum.add(&here.rotation[i][j].mul(&v[i]))))
        };
        let (n, moment) = (back(&z), back(&cross(&here.translation, &z)));
        let m: Vector<R> = std::array::from_fn(|i| next.rotation[i][2].clone());
        let second = cross(&m, &next.translation);
        // x . Rz(q) y over (1, cos, sin)
        let turning = |x: &Vector<R>, y: &Vector<R>| -> [R; 3] {
            [x[2].mul(&y[2]), x[0].mul(&y[0]).add(&x[1].mul(&y[1])), x[1].mul(&y[0]).sub(&x[0].mul(&y[1]))]
        };
        let (one, two) = (turning(&moment, &m), turning(&n, &second));
        [turning(&n, &m), std::array::from_fn(|k| one[k].add(&two[k]))]
    }

    /// The coordinates of one of the axes across the other, over `(1, cos, sin)` of the rotation on a side: both vanish where the axes are
    /// parallel.
    #[must_use]
    pub fn across<R: Ring>(&self, form: &LinkForm<R, 4, 2>, side: usize) -> [[R; 3]; 2] {
        let axis = self.first + 2 * side;
        let (here, next) = (&form.links[axis % 4].rotation, &form.links[(axis + 1) % 4].rotation);
        let [x, y, z] = [0, 1, 2].map(|i| next[i][2].clone());
        [0, 1].map(|i| {
            let row = &here[i];
            let cos = row[0].mul(&x).add(&row[1].mul(&y));
            let sin = row[1].mul(&x).sub(&row[0].mul(&y));
            [row[2].mul(&z), cos, sin]
        })
    }

    /// The two equations; the sides are the rotations behind the first axis and behind the second one.
    #[must_use]
    pub fn equations<R: Ring>(&self, form: &LinkForm<R, 4, 2>) -> Separated<R> {
        let [cosine, moment] = Self::functional(form, self.first);
        let [other_cosine, other_moment] = Self::functional(form, self.first + 2);
        Separated { kinds: [Variable::Rotation; 2], rows: [[cosine, other_cosine], [moment, other_moment]] }
    }

    /// All rotations from those behind the two axes; `None` where the axes are parallel.
    #[must_use]
    pub fn rotations<F: Field>(&self, form: &LinkForm<F, 4, 2>, j: &(F, F), k: &(F, F)) -> Option<[(F, F); 4]> {
        let link = |at: usize| &form.links[at % 4].rotation;
        let half = |axis: usize, pair: &(F, F)| product(&turned(link(axis), pair), link(axis + 1));
        let (one, two) = (half(self.first, j), half(self.first + 2, k));
        // Rz(q) x = y for the first axis, seen from both sides of the second one.
        let (x, y) = ([&two[0][2], &two[1][2]], [&one[2][0], &one[2][1]]);
        let inverse = x[0].mul(x[0]).add(&x[1].mul(x[1])).inverse()?;
        let m = (x[0].mul(y[0]).add(&x[1].mul(y[1])).mul(&inverse), x[0].mul(y[1]).sub(&x[1].mul(y[0])).mul(&inverse));
        // Read from the rotation behind the first axis, that axis comes last.
        let known = [j.clone(), m.clone(), k.clone()];
        let i = form.last_rotation((self.first + 1) % 4, &known);
        let mut all: [(F, F); 4] = std::array::from_fn(|_| (F::zero(), F::zero()));
        for (at, pair) in [i, j.clone(), m, k.clone()].into_iter().enumerate() {
            all[(self.first + at) % 4] = pair;
        }
        Some(all)
    }
}
