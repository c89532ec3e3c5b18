//! A loop as its rotations see it: translations put into the links between them.
//!
//! `prod_k Rz(q_k) (R_k, s_k) = I` over the rotations k, with `s_k = s_k0 + sum_j d_j u_j` over the translations j that
//! stand in link k, each along its fixed direction u_j. Rotations then close by themselves,
//! `prod Rz(q_k) R_k = I`, and `sum_k Q_k s_k = 0` with `Q_k = Rz(q_1) R_1 ... Rz(q_k)` is linear in the translations.

use super::closed_loop::{ClosedLoop, Variable};
use super::motion::{Motion, Vector, cross, dot};
use crate::algebra::ring::{Field, Ring};

/// A loop of `RHO` rotations and `TAU` translations, six together.
#[derive(Clone, Debug, PartialEq)]
pub struct LinkForm<R, const RHO: usize, const TAU: usize> {
    /// The unknown of the loop that each rotation is.
    pub rotations: [usize; RHO],
    /// The link behind each rotation, translations at zero: R_k and s_k0.
    pub links: [Motion<R>; RHO],
    /// The translations.
    pub slides: [Slide<R>; TAU],
}

/// A translation inside a link.
#[derive(Clone, Debug, PartialEq)]
pub struct Slide<R> {
    /// The unknown of the loop that it is.
    pub unknown: usize,
    /// In which link it stands.
    pub link: usize,
    /// Its direction there, of length 1.
    pub direction: Vector<R>,
}

/// The translations that close a loop whose rotations are known.
#[derive(Clone, Debug, PartialEq)]
pub struct Slides<R, const TAU: usize> {
    /// The translations; `None` where their directions are dependent.
    pub values: Option<[R; TAU]>,
    /// Independence of the directions: their determinant, or for two of them their cross product, over the product of their
    /// sizes; 0 or 1 in exact fields.
    pub independence: f64,
    /// The largest such determinant with the displacement to be bridged in place of one direction: the distance of dependent
    /// directions from closing the loop.
    pub gap: f64,
}

impl<R: Ring, const RHO: usize, const TAU: usize> LinkForm<R, RHO, TAU> {
    /// The link form of a loop; `None` unless it has `RHO` rotations, at least one.
    #[must_use]
    pub fn of(closed: &ClosedLoop<R>) -> Option<Self> {
        let rotates = |j: usize| closed.variables[j % 6] == Variable::Rotation;
        if (0..6).filter(|&j| rotates(j)).count() != RHO || RHO + TAU != 6 {
            return None;
        }
        let first = (0..6).find(|&j| rotates(j))?;
        let mut rotations = [0; RHO];
        let mut links: [Motion<R>; RHO] = std::array::from_fn(|_| Motion::identity());
        let blank = |_| Slide { unknown: 0, link: 0, direction: std::array::from_fn(|_| R::zero()) };
        let mut slides: [Slide<R>; TAU] = std::array::from_fn(blank);
        // `open` rotations and `slid` translations are behind us; translations before the first rotation come last.
        let (mut open, mut slid) = (0, 0);
        for unknown in (first..first + 6).map(|j| j % 6) {
            if rotates(unknown) {
                rotations[open] = unknown;
                open += 1;
            } else {
                let direction = std::array::from_fn(|i| links[open - 1].rotation[i][2].clone());
                slides[slid] = Slide { unknown, link: open - 1, direction };
                slid += 1;
            }
            links[open - 1] = links[open - 1].then_after(&closed.constants[unknown]);
        }
        Some(Self { rotations, links, slides })
    }

    /// Maps the form to another ring; `None` as soon as one entry has no image.
    pub fn map<S: Ring>(&self, image: impl Fn(&R) -> Option<S>) -> Option<LinkForm<S, RHO, TAU>> {
        let mut links: [Motion<S>; RHO] = std::array::from_fn(|_| Motion::identity());
        for (to, from) in links.iter_mut().zip(&self.links) {
            *to = from.map(&image)?;
        }
        let zero = || std::array::from_fn(|_| S::zero());
        let mut slides: [Slide<S>; TAU] = std::array::from_fn(|j| Slide {
            unknown: self.slides[j].unknown,
            link: self.slides[j].link,
            direction: zero(),
        });
        for (to, from) in slides.iter_mut().zip(&self.slides) {
            let [x, y, z] = &from.direction;
            to.direction = [image(x)?, image(y)?, image(z)?];
        }
        Some(LinkForm { rotations: self.rotations, links, slides })
    }

    /// The squared sine of the twist of a link, and its cosine.
    #[must_use]
    pub fn twist(&self, link: usize) -> (R, R) {
        let r = &self.links[link % RHO].rotation;
        (r[0][2].mul(&r[0][2]).add(&r[1][2].mul(&r[1][2])), r[2][2].clone())
    }

    /// All rotations from all but the last: the angle that closes `Rz(q_1) R_1 ... Rz(q_RHO) R_RHO = I`, when the loop is
    /// read from rotation `start`; `known[k]` belongs to rotation `start + k`.
    #[must_use]
    pub fn last_rotation(&self, start: usize, known: &[(R, R)]) -> (R, R) {
        // X Rz(q) R = I for the product X of all before the last: Rz(q) = X^T R^T, of which the first column is read.
        let mut x: [[R; 3]; 3] = Motion::identity().rotation;
        for (k, pair) in known.iter().enumerate() {
            x = turned(&x, pair);
            x = product(&x, &self.links[(start + k) % RHO].rotation);
        }
        let last = &self.links[(start + RHO - 1) % RHO].rotation;
        let x = product(last, &x);
        // (R X)^T
        (x[0][0].clone(), x[0][1].clone())
    }
}

impl<F: Field, const RHO: usize, const TAU: usize> LinkForm<F, RHO, TAU> {
    /// All unknowns of the loop at these rotations: cosine and sine, or the distance and 0; `None` where translations are dependent.
    #[must_use]
    pub fn unknowns_at(&self, rotations: &[(F, F); RHO]) -> Option<[(F, F); 6]> {
        let values = self.slides_at(rotations).values?;
        let mut pairs = std::array::from_fn(|_| (F::zero(), F::zero()));
        for (&unknown, pair) in self.rotations.iter().zip(rotations) {
            pairs[unknown] = pair.clone();
        }
        for (slide, value) in self.slides.iter().zip(values) {
            pairs[slide.unknown].0 = value;
        }
        Some(pairs)
    }

    /// The translations at these cosines and sines of the rotations.
    ///
    /// # Panics
    /// For loops with more than three translations, or with fewer than two: those have other routes.
    #[must_use]
    pub fn slides_at(&self, rotations: &[(F, F); RHO]) -> Slides<F, TAU> {
        assert!(TAU == 2 || TAU == 3, "two or three translations");
        let mut frame: Motion<F> = Motion::identity();
        let mut directions: [Vector<F>; TAU] = std::array::from_fn(|_| std::array::from_fn(|_| F::zero()));
        for k in 0..RHO {
            frame.rotation = turned(&frame.rotation, &rotations[k]);
            for (direction, slide) in directions.iter_mut().zip(&self.slides) {
                if slide.link == k {
                    *direction = frame.rotate(&slide.direction);
                }
            }
            frame = frame.then_after(&self.links[k]);
        }
        let rest = frame.translation.each_ref().map(F::neg);
        let normal = cross(&directions[0], &directions[1]);
        // For two directions the largest coordinate of their cross product decides; exactly, any nonzero one would do.
        let largest = |v: &Vector<F>| (1..3).fold(0, |b, i| if v[i].pivot_size() > v[b].pivot_size() { i } else { b });
        let [u, v] = [&directions[0], &directions[1]];
        let (determinant, numerators): (F, [F; TAU]) = if TAU == 3 {
            let w = &directions[2];
            let along = [dot(&cross(v, w), &rest), dot(&cross(w, u), &rest), dot(&normal, &rest)];
            (dot(&normal, w), std::array::from_fn(|j| along[j].clone()))
        } else {
            let along = [cross(&rest, v), cross(u, &rest)];
            let best = largest(&normal);
            // Where the directions are parallel only the size of the remaining displacement is used.
            let at = |v: &Vector<F>| if normal[best].is_zero() { largest(v) } else { best };
            (normal[best].clone(), std::array::from_fn(|j| along[j][at(&along[j])].clone()))
        };
        let size = |v: &Vector<F>| v.iter().map(F::pivot_size).fold(0.0, f64::max);
        let scale: f64 = directions.iter().map(size).product();
        let gap = numerators.iter().map(F::pivot_size).fold(0.0, f64::max) / scale;
        let values = determinant.inverse().map(|inverse| numerators.map(|x| x.mul(&inverse)));
        Slides { values, independence: determinant.pivot_size() / scale, gap }
    }
}

/// `matrix Rz(q)`
#[must_use]
pub fn turned<R: Ring>(matrix: &[[R; 3]; 3], (cos, sin): &(R, R)) -> [[R; 3]; 3] {
    matrix.each_ref().map(|row| {
        let [x, y, z] = row;
        [x.mul(cos).add(&y.mul(sin)), y.mul(cos).sub(&x.mul(sin)), z.clone()]
    })
}

/// The transposed matrix, of a rotation its inverse.
#[must_use]
pub fn transposed<R: Clone>(matrix: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| matrix[j][i].clone()))
}

/// The product of two matrices.
#[must_use]
pub fn product<R: Ring>(a: &[[R; 3]; 3], b: &[[R; 3]; 3]) -> [[R; 3]; 3] {
    let columns = transposed(b);
    std::array::from_fn(|i| std::array::from_fn(|j| dot(&a[i], &columns[j])))
}
