//! The four-bars of a path as they are printed: pivots in the plane, at the first point, with both cognates.

use super::certificate::{Affine, BITS, Certified};
use super::class::{moving_pivots, third_pivot};
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::synthesis::answer::Mode;
use crate::synthesis::dyad::{Dyad, Making};
use rug::{Float, Rational};

/// Names of the pivots of the four-bar and of its two cognates, each as fixed, moving, moving, fixed.
pub const NAMES: [[&str; 4]; 3] = [
    ["A", "B", "C", "D"],
    ["cognate1.A", "cognate1.B", "cognate1.C", "cognate1.D"],
    ["cognate2.A", "cognate2.B", "cognate2.C", "cognate2.D"],
];

/// A point by both its isotropic coordinates.
type Pair = [Disc; 2];

/// The pivots of one of three cognates.
type Pivots = [Pair; 4];

/// The three cognates, by the numbers of one of them.
fn cognates([x, x_star, a, a_star, y, y_star, b, b_star]: &Affine<Disc>) -> Option<[Pivots; 3]> {
    let one = [x, a, y, b];
    let star = [x_star, a_star, y_star, b_star];
    let pair = |z: &Disc, w: &Disc| [z.clone(), w.clone()];
    let third = [third_pivot(one, Disc::inverse)?, third_pivot(star, Disc::inverse)?];
    let [[x2, y2], [x3, y3]] = moving_pivots(one, Disc::inverse)?;
    let [[x2_star, y2_star], [x3_star, y3_star]] = moving_pivots(star, Disc::inverse)?;
    let (a, b) = (pair(a, a_star), pair(b, b_star));
    Some([
        [a.clone(), pair(x, x_star), pair(y, y_star), b.clone()],
        [a, [x2, x2_star], [y2, y2_star], third.clone()],
        [b, [x3, x3_star], [y3, y3_star], third],
    ])
}

/// The length of the links together, about.
fn size(pivots: &Pivots) -> f64 {
    (0..4)
        .map(|k| {
            let [z, w] = [0, 1].map(|part| {
                let difference = pivots[k][part].sub(&pivots[(k + 1) % 4][part]);
                difference.re.to_f64().hypot(difference.im.to_f64())
            });
            (z * w).sqrt()
        })
        .sum()
}

fn link(fixed: &Pair, moving: &Pair) -> f64 {
    let difference = fixed[0].sub(&moving[0]);
    difference.re.to_f64().hypot(difference.im.to_f64())
}

/// The mode of a class: the four-bar with the shortest links of the three stands first, the shorter link to the ground of each first.
pub fn mode(certified: &Certified, origin: &[Rational; 2], unit: &Rational) -> Option<Mode> {
    let mut three = cognates(&certified.discs)?;
    for pivots in &mut three {
        if link(&pivots[3], &pivots[2]) < link(&pivots[0], &pivots[1]) {
            pivots.reverse();
        }
    }
    sort::by(&mut three, |one, other| size(one).total_cmp(&size(other)));
    let i = Disc::point(Float::new(1), Float::with_val(1, 1));
    let half = Disc::of(&(unit.clone() / 2), BITS);
    let [x, y] = origin.each_ref().map(|q| Disc::of(q, BITS));
    let point = |[z, w]: &Pair| [x.add(&z.add(w).mul(&half)), y.sub(&z.sub(w).mul(&i).mul(&half))];
    let mut making = Making::new(certified.is_real);
    for (pivots, names) in three.iter().zip(NAMES) {
        for (pivot, name) in pivots.iter().zip(names) {
            making.list(name, &point(pivot));
        }
    }
    // The pivot of the cognates that is none of the first four-bar's.
    let of_first = |pivot: &Pair| [0, 3].iter().any(|k| !three[0][*k][0].sub(&pivot[0]).is_not_zero());
    let third = [0, 3].map(|k| &three[1][k]).into_iter().find(|pivot| !of_first(pivot))?;
    making.list("third_pivot", &point(third));
    let dyad: Dyad = making.done();
    Some(Mode { is_real: certified.is_real, multiplicity: 1, dyad })
}
