//! Four-bars with one coupler curve: three cognates, each with its dyads in either order. \[Roberts1875\]

use super::curve::UNKNOWNS;
use crate::algebra::ring::{Field, Ring};
use crate::algebra::sort;
use num_complex::Complex;

/// A four-bar with the numbers of its class.
type Numbered = ([Complex<f64>; UNKNOWNS], [Complex<f64>; 3]);

/// Numbers of classes closer than this, relative to their size, are equal: far more than the error of corrected points, and far less than
/// the distance of classes in general.
const CLOSE: f64 = 1e-7;
/// A coupler shorter than this, in units of a problem, is none.
const SHORT: f64 = 1e-7;

/// Numbers that all four-bars of a coupler curve have in common: of the three fixed pivots, seen from the first point of the curve, the
/// sum, the sum of the products of two, and the sum of the conjugates. `None` where the coupler has no length.
pub fn numbers<R: Ring>(
    [x, x_star, a, a_star, y, y_star, b, b_star]: &[R; UNKNOWNS - 1],
    inverse: fn(&R) -> Option<R>,
) -> Option<[R; 3]> {
    let c = third_pivot([x, a, y, b], inverse)?;
    let c_star = third_pivot([x_star, a_star, y_star, b_star], inverse)?;
    let sum = a.add(b);
    Some([sum.add(&c), a.mul(b).add(&sum.mul(&c)), a_star.add(b_star).add(&c_star)])
}

/// The third pivot: the triangles of the fixed pivots and of the coupler are similar.
pub fn third_pivot<R: Ring>([x, a, y, b]: [&R; 4], inverse: fn(&R) -> Option<R>) -> Option<R> {
    Some(a.mul(y).sub(&b.mul(x)).mul(&inverse(&y.sub(x))?))
}

/// The moving pivots of the cognate on the first pivot and the third one, and of that on the second and the third one.
pub fn moving_pivots<R: Ring>([x, a, y, b]: [&R; 4], inverse: fn(&R) -> Option<R>) -> Option<[[R; 2]; 2]> {
    let pair = |x: &R, a: &R, y: &R| -> Option<[R; 2]> {
        // Two links and a part of the coupler are the sides of a parallelogram; its coupler is similar to the given one.
        let own = a.sub(x);
        let ratio = x.neg().mul(&inverse(&y.sub(x))?);
        let other = own.add(&ratio.mul(&x.sub(a)));
        Some([own, other])
    };
    Some([pair(x, a, y)?, pair(y, b, x)?])
}

/// The four-bars of different classes among these, in their order; those without a coupler are left out, for which the conditions hold
/// without a linkage.
pub fn distinct(four_bars: impl IntoIterator<Item = [Complex<f64>; UNKNOWNS]>) -> Vec<[Complex<f64>; UNKNOWNS]> {
    let with_numbers = |v: [Complex<f64>; UNKNOWNS]| {
        let z = affine(&v);
        let has_coupler = (0..2).all(|k| (z[k] - z[4 + k]).norm() > SHORT * (1.0 + z[k].norm()));
        let numbers = numbers(&z, Field::inverse).filter(|_| has_coupler)?;
        numbers.iter().all(|z| z.is_finite()).then_some((v, numbers))
    };
    let mut sorted: Vec<(usize, Numbered)> = four_bars.into_iter().filter_map(with_numbers).enumerate().collect();
    sort::by(&mut sorted, |(_, (_, one)), (_, (_, other))| one[0].re.total_cmp(&other[0].re));
    let mut is_new = vec![true; sorted.len()];
    for (k, (place, (_, own))) in sorted.iter().enumerate() {
        let size = own.each_ref().map(|z| CLOSE * (1.0 + z.norm()));
        for (other_place, (_, other)) in
            sorted[k + 1..].iter().take_while(|(_, (_, other))| other[0].re - own[0].re < size[0])
        {
            if (0..3).all(|i| (own[i] - other[i]).norm() < size[i]) {
                is_new[*place.max(other_place)] = false;
            }
        }
    }
    let mut kept: Vec<_> = sorted.into_iter().filter(|(place, _)| is_new[*place]).collect();
    sort::by_key(&mut kept, |(place, _)| *place);
    kept.into_iter().map(|(_, (v, _))| v).collect()
}

/// The unknowns without their common factor.
pub fn affine(v: &[Complex<f64>; UNKNOWNS]) -> [Complex<f64>; UNKNOWNS - 1] {
    std::array::from_fn(|k| v[k + 1] / v[0])
}
