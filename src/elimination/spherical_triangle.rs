//! Three rotations: a spherical triangle, degree 2.
//!
//! The rotations of the loop close by themselves. With link m left out, read from the rotation behind it, the third row
//! r of the first rotation's link and the third column q of the next one's give one equation in the angle between them,
//! `(r1 q1 + r2 q2) cos + (r2 q1 - r1 q2) sin + r3 q3 - (R_m)_33 = 0`; the other angles and then the three translations
//! are rational in it. Two roots, no other factor.

use super::separated::{offset, powers};
use crate::algebra::ring::{Domain, Field, Ring};
use crate::algebra::univariate::Univariate;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::link_form::{LinkForm, product, turned};
use crate::kinematics::motion::{cross, dot};

/// The equation of one angle of a spherical triangle.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangle<R> {
    /// The link left out.
    pub dropped: usize,
    /// `equation . (1, cos, sin) = 0` for the rotation two behind that link.
    pub equation: [R; 3],
}

/// The equation with the link left out whose sine is smallest, so that two axes may be parallel.
#[must_use]
pub fn triangle<F: Field>(form: &LinkForm<F, 3, 3>) -> Triangle<F> {
    let mut dropped = 0;
    for link in 1..3 {
        if form.twist(link).0.pivot_size() < form.twist(dropped).0.pivot_size() {
            dropped = link;
        }
    }
    triangle_without(form, dropped)
}

/// The equation with this link left out.
#[must_use]
pub fn triangle_without<R: Ring>(form: &LinkForm<R, 3, 3>, dropped: usize) -> Triangle<R> {
    let (first, second) = (&form.links[(dropped + 1) % 3].rotation, &form.links[(dropped + 2) % 3].rotation);
    let ([r1, r2, r3], [q1, q2, q3]) = (&first[2], [&second[0][2], &second[1][2], &second[2][2]]);
    let constant = r3.mul(q3).sub(&form.links[dropped].rotation[2][2]);
    Triangle { dropped, equation: [constant, r1.mul(q1).add(&r2.mul(q2)), r2.mul(q1).sub(&r1.mul(q2))] }
}

impl<F: Field> Triangle<F> {
    /// Returns all three rotations at the cosine and sine of the equation's angle; `None` where two axes are parallel, so that
    /// the others are not determined.
    #[must_use]
    pub fn rotations(&self, form: &LinkForm<F, 3, 3>, known: &(F, F)) -> Option<[(F, F); 3]> {
        let [first, second, third] = [self.dropped + 1, self.dropped + 2, self.dropped].map(|k| k % 3);
        let next = following(form, self.dropped, known, &form.twist(third).0.inverse()?);
        let last = form.last_rotation(second, &[known.clone(), next.clone()]);
        let mut all: [(F, F); 3] = std::array::from_fn(|_| (F::zero(), F::zero()));
        (all[first], all[second], all[third]) = (last, known.clone(), next);
        Some(all)
    }
}

/// The rotation behind the dropped link's, times the unit in which `known` is measured: `Rz(q) m = t`.
fn following<R: Ring>(form: &LinkForm<R, 3, 3>, dropped: usize, known: &(R, R), inverse: &R) -> (R, R) {
    let product =
        product(&turned(&form.links[(dropped + 1) % 3].rotation, known), &form.links[(dropped + 2) % 3].rotation);
    let link = &form.links[dropped].rotation;
    let (m1, m2, t1, t2) = (&link[0][2], &link[1][2], &product[2][0], &product[2][1]);
    (m1.mul(t1).add(&m2.mul(t2)).mul(inverse), m1.mul(t2).sub(&m2.mul(t1)).mul(inverse))
}

/// The closure polynomial of three rotations and the conditions on their translations, in the half tangent x of the equation's
/// rotation.
#[derive(Clone, Debug)]
pub struct Conditions<F> {
    /// The closure polynomial, of degree 2 in general.
    pub roots: Univariate<F>,
    /// The determinant of the directions of the translations, times powers of 1 + x^2, and its degree in general.
    pub determinant: (Univariate<F>, usize),
    /// The polynomials that vanish with it where dependent translations close the loop, each with its degree in general.
    pub bridged: [(Univariate<F>, usize); 3],
}

/// The conditions with angles counted from `origin`; `None` where two axes are parallel, so that rotations are not
/// determined.
#[must_use]
pub fn conditions<F: Field>(
    form: &LinkForm<F, 3, 3>,
    triangle: &Triangle<F>,
    origin: &[F; 3],
) -> Option<Conditions<F>> {
    let inverse = form.twist(triangle.dropped).0.inverse()?;
    let lifted = form.map(|x: &F| Some(Univariate::constant(x.clone())))?;
    // Cosine and sine times a number and 1 + x^2.
    let [one, cos, sin] = powers(Variable::Rotation, origin).map(|row| Univariate::new(row.to_vec()));
    let known = (cos, sin);
    let [constant, first, second] = &triangle.equation;
    let roots = one.scale(constant).add(&known.0.scale(first)).add(&known.1.scale(second));
    let second = (triangle.dropped + 2) % 3;
    // Directions of the translations in a frame before the known rotation, each times a power of `one`.
    let next = following_scaled(&lifted, triangle.dropped, &known, &one, &Univariate::constant(inverse));
    let mut directions = Vec::new();
    for slide in &lifted.slides {
        let u = &slide.direction;
        let weigh = |m: [[Univariate<F>; 3]; 3]| m.map(|row| dot(&row, u));
        let rotation = |pair| turning(pair, &one);
        directions.push(if slide.link == second {
            (weigh(rotation(&known)), 2)
        } else if slide.link == triangle.dropped {
            let behind = product(&rotation(&known), &lifted.links[second].rotation);
            (weigh(product(&behind, &rotation(&next))), 4)
        } else {
            let link = &lifted.links[slide.link].rotation;
            (std::array::from_fn(|i| dot(&std::array::from_fn(|k| link[k][i].clone()), u)), 0)
        });
    }
    let [(u, i), (v, j), (w, k)] = [&directions[0], &directions[1], &directions[2]];
    let determinant = (dot(&cross(u, v), w), i + j + k);
    // The sum of the links that the translations must bridge, in the same frame, over a common power of `one`.
    let sum = links_sum(&lifted, triangle.dropped, &known, &next, &one);
    let across = |x: &[Univariate<F>; 3], y: &[Univariate<F>; 3]| dot(&cross(x, y), &sum);
    let bridged = [(across(v, w), j + k + 4), (across(w, u), k + i + 4), (across(u, v), i + j + 4)];
    Some(Conditions { roots, determinant, bridged })
}

/// Returns the exact number of solutions of a loop with three rotations: the roots of its closure polynomial at which the three
/// translations are independent. `None` where rotations or translations are not determined, so that any solutions form families.
#[must_use]
pub fn count<F: Field + Domain>(form: &LinkForm<F, 3, 3>) -> Option<usize> {
    let triangle = triangle(form);
    let [constant, cos, sin] = &triangle.equation;
    if cos.is_zero() && sin.is_zero() {
        return (!constant.is_zero()).then_some(0);
    }
    // The loop turned by a fixed angle, so that no root is at infinity.
    let Conditions { roots, determinant: (determinant, _), bridged } = conditions(form, &triangle, &offset())?;
    if determinant.is_zero() {
        return None;
    }
    let lost = roots.gcd(&determinant);
    if lost.degree() == Some(0) {
        return Some(2);
    }
    let bridged = bridged.iter().fold(lost.clone(), |g, (n, _)| g.gcd(n));
    if bridged.degree() > Some(0) {
        return None;
    }
    // A double root at which the translations are dependent is no isolated solution either.
    let double = roots.gcd(&roots.derivative()).degree() > Some(0);
    Some(if double { 0 } else { 2 - lost.degree().unwrap_or(0) })
}

/// Returns a factor with the roots of the closure polynomial, at their whole multiplicity, at which the translations are
/// dependent and do not close the loop, and the number of such roots at infinity, where the angle is pi.
#[must_use]
pub fn false_roots<F: Field + Domain>(form: &LinkForm<F, 3, 3>, triangle: &Triangle<F>) -> (Univariate<F>, usize) {
    let origin = [1, 1, 0].map(F::from_integer);
    let none = (Univariate::one(), 0);
    let Some(Conditions { roots, determinant: (determinant, full), bridged }) = conditions(form, triangle, &origin)
    else {
        return none;
    };
    if roots.is_zero() {
        return none;
    }
    let dependent = roots.remove_factor(&Univariate::circle()).1.part_with_roots_of(&determinant);
    let closing = bridged.iter().fold(Univariate::zero(), |g: Univariate<F>, (n, _)| g.gcd(n));
    let factor = dependent.div_exact(&dependent.part_with_roots_of(&closing));
    let at_infinity = determinant.degree() < Some(full) && bridged.iter().any(|(n, full)| n.degree() == Some(*full));
    (factor, if at_infinity { 2 - roots.degree().unwrap_or(0) } else { 0 })
}

/// The sum of the links, turned into the frame before the known rotation and times `one` squared.
fn links_sum<F: Field>(
    form: &LinkForm<Univariate<F>, 3, 3>,
    dropped: usize,
    known: &(Univariate<F>, Univariate<F>),
    next: &(Univariate<F>, Univariate<F>),
    one: &Univariate<F>,
) -> [Univariate<F>; 3] {
    let (first, second) = ((dropped + 1) % 3, (dropped + 2) % 3);
    let turn = turning(known, one);
    let behind = product(&product(&turn, &form.links[second].rotation), &turning(next, one));
    let back = &form.links[first].rotation;
    let translation = |k: usize| &form.links[k].translation;
    std::array::from_fn(|i| {
        let column: [Univariate<F>; 3] = std::array::from_fn(|k| back[k][i].clone());
        let terms = [
            dot(&turn[i], translation(second)).mul(one),
            dot(&behind[i], translation(dropped)),
            dot(&column, translation(first)).mul(one).mul(one),
        ];
        terms.iter().fold(Univariate::zero(), |sum, term| sum.add(term))
    })
}

/// `Rz` of a pair measured by `one`, times `one`.
fn turning<R: Ring>((cos, sin): &(R, R), one: &R) -> [[R; 3]; 3] {
    let nought = R::zero;
    [[cos.clone(), sin.neg(), nought()], [sin.clone(), cos.clone(), nought()], [nought(), nought(), one.clone()]]
}

/// [`following`] for a known pair over `one`: the result is over `one` too.
fn following_scaled<F: Field>(
    form: &LinkForm<Univariate<F>, 3, 3>,
    dropped: usize,
    known: &(Univariate<F>, Univariate<F>),
    one: &Univariate<F>,
    inverse: &Univariate<F>,
) -> (Univariate<F>, Univariate<F>) {
    // The third column of R1 Rz(q) R2 mixes in the fixed axis: it is measured by `one` like the pair.
    let mut scaled = form.clone();
    for row in &mut scaled.links[(dropped + 1) % 3].rotation {
        row[2] = row[2].mul(one);
    }
    following(&scaled, dropped, known, inverse)
}
