//! Proves that a platform moves with its legs locked, along a curve through a pose that is known exactly.

use crate::algebra::echelon::Echelon;
use crate::algebra::ring::Ring;
use crate::closure::study::{Four, Leg, scalar};
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::platform::Platform;
use crate::verdict::MOST_POSES;
use rug::Rational;

/// Study's parameters x and y of a pose, as coefficients of a power series.
type Coefficient = [Four<Rational>; 2];

/// Largest number of bits of a coefficient, after which the series is given up: coordinates of three digits come to it in less than a second.
const MOST_BITS: u32 = 6000;

/// Number of unknowns: Study's parameters without the first, which is held at 1.
const UNKNOWNS: usize = 7;

/// Returns whether the poses next to this one form a smooth curve; `false` also where that is not decided, which is so where the legs hold the
/// plate by fewer than five conditions to first order, or the numbers become too long.
///
/// The seven equations in Study's parameters are solved order by order for six of them, as power series of the seventh. What is left over is one
/// power series; the lowest order in it is the multiplicity of the pose if that is isolated.
///
/// # Source
/// docs/platforms.md, theorem 10.
#[must_use]
pub fn moves_along_curve(platform: &Platform<Rational>, squares: &[Rational; 6], pose: &Motion<Rational>) -> bool {
    let legs = about(platform, squares, pose);
    let polar = |i: usize, u: &Coefficient, v: &Coefficient| match legs.get(i) {
        Some(leg) => {
            let [w, other] = [u, v].map(|[x, y]| leg.vector(x, y, Ring::mul));
            scalar(&w, &other).sub(&scalar(&u[0], &v[0]).mul(&leg.square))
        }
        None => scalar(&u[0], &v[1]).add(&scalar(&u[1], &v[0])),
    };
    let values = |u: &Coefficient, v: &Coefficient| -> [Rational; UNKNOWNS] { std::array::from_fn(|i| polar(i, u, v)) };
    // The pose is the identity here.
    let mut series = vec![unit(0)];
    let columns: Vec<[Rational; UNKNOWNS]> =
        (1..=UNKNOWNS).map(|k| values(&series[0], &unit(k)).map(|x| x.add(&x))).collect();
    let rows = (0..UNKNOWNS).map(|i| {
        // Behind the derivatives stand the row operations made.
        let own = (0..UNKNOWNS).map(|j| if i == j { Rational::from(1) } else { Rational::new() });
        columns.iter().map(|column| column[i].clone()).chain(own).collect()
    });
    let solved = Echelon::among(rows.collect(), 2 * UNKNOWNS, UNKNOWNS);
    let left_over = Echelon::of(columns.iter().map(|column| column.to_vec()).collect(), UNKNOWNS).null_space();
    let free: Vec<usize> = (0..UNKNOWNS).filter(|k| !solved.pivots().contains(k)).collect();
    let ([free], [left_over]) = (&free[..], &left_over[..]) else { return false };
    let along = |row: &[Rational], rest: &[Rational; UNKNOWNS]| {
        row.iter().zip(rest).fold(Rational::new(), |mut sum, (x, y)| {
            sum.add_product(x, y);
            sum
        })
    };
    if (0..UNKNOWNS).any(|i| !polar(i, &series[0], &series[0]).is_zero()) {
        return false;
    }
    for order in 1..=MOST_POSES {
        let mut rest: [Rational; UNKNOWNS] =
            if order == 1 { columns[*free].clone() } else { std::array::from_fn(|_| Rational::new()) };
        for j in 1..order {
            for (sum, value) in rest.iter_mut().zip(values(&series[j], &series[order - j])) {
                *sum = sum.add(&value);
            }
        }
        if !along(left_over, &rest).is_zero() {
            return false;
        }
        let mut flat: [Rational; 8] = std::array::from_fn(|_| Rational::new());
        if order == 1 {
            flat[free + 1] = Rational::from(1);
        }
        for (pivot, row) in solved.pivots().iter().zip(solved.rows()) {
            flat[pivot + 1] = along(&row[UNKNOWNS..], &rest).neg();
        }
        if flat.iter().any(|x| x.numer().significant_bits().max(x.denom().significant_bits()) > MOST_BITS) {
            return false;
        }
        let [a, b, c, d, e, f, g, h] = flat;
        series.push([[a, b, c, d], [e, f, g, h]]);
    }
    true
}

/// The legs in frames in which a pose is the identity.
fn about(platform: &Platform<Rational>, squares: &[Rational; 6], pose: &Motion<Rational>) -> [Leg<Rational>; 6] {
    std::array::from_fn(|i| {
        let moved: Vector<Rational> = std::array::from_fn(|k| platform.base[i][k].sub(&pose.translation[k]));
        Leg::new(&moved, &pose.rotate(&platform.plate[i]), squares[i].clone())
    })
}

/// The parameters of which one is 1, and the others are 0.
fn unit(k: usize) -> Coefficient {
    [0, 4].map(|from| std::array::from_fn(|i| Rational::from(u8::from(from + i == k))))
}
