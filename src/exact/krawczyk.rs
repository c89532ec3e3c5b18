//! Krawczyk's theorem in balls: a loop closes near given values, and exactly once.
//!
//! With `E(h) = V1(x1 + h1) G1 ... V6(x6 + h6) G6` let `f(h)` be the translation and the skew part of the rotation of E.
//! For a matrix A and a box of radius r, `|A f(0)| + |I - A f'(box)| r < r` proves that f has exactly one zero in the box.
//! Where E is near the identity in the whole box that zero closes the loop: a complex orthogonal matrix that is symmetric
//! and near the identity is the identity. \[Krawczyk1969\]

use super::values::{Pair, moved};
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use rug::Float;

type Matrix<const BITS: u32> = Vec<Vec<Ball<BITS>>>;

/// Returns a radius within which exactly one solution lies near the values, in every unknown; `None` where that is not proved.
#[must_use]
pub fn radius<const BITS: u32>(
    variables: [Variable; 6],
    constants: &[Motion<Ball<BITS>>],
    pairs: &[Pair<BITS>; 6],
) -> Option<Float> {
    let at = |pairs: &[Pair<BITS>; 6]| steps(variables, constants, pairs);
    let here = function(&closure(&at(pairs)));
    let inverse = inverse(&jacobian(variables, constants, pairs))?;
    let step =
        |row: &Vec<Ball<BITS>>| row.iter().zip(&here).fold(Ball::zero(), |sum, (a, f)| sum.add(&a.mul(f))).upper();
    let step = inverse.iter().map(step).fold(Float::new(32), |a, b| if b > a { b } else { a });
    // Wider than the step, and than what rounding in the derivative needs.
    let radius = Float::with_val(32, &step * 4_u32) + (Float::with_val(32, 1) >> (BITS / 2));
    let around = std::array::from_fn(|k| match variables[k] {
        Variable::Rotation => widened(&pairs[k], &radius),
        Variable::Translation => (pairs[k].0.clone().enlarged(&radius), Ball::zero()),
    });
    if !is_near_identity(&closure(&at(&around))) {
        return None;
    }
    let slopes = jacobian(variables, constants, &around);
    let deviation = |(i, row): (usize, &Vec<Ball<BITS>>)| {
        let entry = |j: usize| {
            let product = (0..6).fold(Ball::zero(), |sum: Ball<BITS>, k| sum.add(&row[k].mul(&slopes[k][j])));
            if i == j { Ball::one().sub(&product) } else { product }.upper()
        };
        (0..6).map(entry).fold(Float::new(32), |a, b| Float::with_val(40, a + b))
    };
    let deviation = inverse.iter().enumerate().map(deviation).fold(Float::new(40), |a, b| if b > a { b } else { a });
    // The sums above are of a few terms in 32 bits and more: a millionth covers their rounding.
    let reached = (deviation * &radius + step) * 1.000_001_f64;
    (reached < radius).then_some(radius)
}

/// Cosine and sine of all angles within a radius below 1 of an angle.
fn widened<const BITS: u32>((cos, sin): &Pair<BITS>, radius: &Float) -> Pair<BITS> {
    let square = Float::with_val(32, radius * radius);
    let (one, nought) = (Ball::one().enlarged(&square), Ball::zero().enlarged(&Float::with_val(32, radius * 1.2_f64)));
    (cos.mul(&one).sub(&sin.mul(&nought)), sin.mul(&one).add(&cos.mul(&nought)))
}

/// The unknowns, each with the constant behind it.
fn steps<const BITS: u32>(
    variables: [Variable; 6],
    constants: &[Motion<Ball<BITS>>],
    pairs: &[Pair<BITS>; 6],
) -> Vec<Motion<Ball<BITS>>> {
    let step = |((variable, pair), constant): ((&Variable, &Pair<BITS>), &Motion<Ball<BITS>>)| {
        moved(*variable, pair).then_after(constant)
    };
    variables.iter().zip(pairs).zip(constants).map(step).collect()
}

/// `E`
fn closure<const BITS: u32>(steps: &[Motion<Ball<BITS>>]) -> Motion<Ball<BITS>> {
    steps.iter().fold(Motion::identity(), |product, step| product.then_after(step))
}

/// The translation and the skew part of the rotation.
fn function<const BITS: u32>(motion: &Motion<Ball<BITS>>) -> Vec<Ball<BITS>> {
    let skew = |i: usize, j: usize| motion.rotation[i][j].sub(&motion.rotation[j][i]);
    motion.translation.iter().cloned().chain([skew(2, 1), skew(0, 2), skew(1, 0)]).collect()
}

/// The derivatives of the function by the six unknowns, row by row.
fn jacobian<const BITS: u32>(
    variables: [Variable; 6],
    constants: &[Motion<Ball<BITS>>],
    pairs: &[Pair<BITS>; 6],
) -> Matrix<BITS> {
    let steps = steps(variables, constants, pairs);
    let mut behind = vec![Motion::identity(); 6];
    for j in (0..5).rev() {
        behind[j] = steps[j + 1].then_after(&behind[j + 1]);
    }
    let mut before: Motion<Ball<BITS>> = Motion::identity();
    let mut columns = Vec::new();
    for (j, (cos, sin)) in pairs.iter().enumerate() {
        let mut turned = Motion::rotation_z(sin.neg(), cos.clone());
        if variables[j] == Variable::Translation {
            turned = Motion::translation_z(Ball::one());
            turned.rotation = std::array::from_fn(|_| std::array::from_fn(|_| Ball::zero()));
        }
        turned.rotation[2][2] = Ball::zero();
        // Constant translations before the unknown do not depend on it.
        let frame = Motion { translation: std::array::from_fn(|_| Ball::zero()), ..before.clone() };
        let derivative = frame.then_after(&turned).then_after(&constants[j].then_after(&behind[j]));
        columns.push(function(&derivative));
        before = before.then_after(&steps[j]);
    }
    (0..6).map(|i| columns.iter().map(|column| column[i].clone()).collect()).collect()
}

/// Returns whether every entry is within 1/16 of the entry of the identity.
fn is_near_identity<const BITS: u32>(motion: &Motion<Ball<BITS>>) -> bool {
    let off = |i: usize, j: usize| {
        let entry = &motion.rotation[i][j];
        if i == j { entry.sub(&Ball::one()).upper() } else { entry.upper() }
    };
    (0..3).all(|i| (0..3).all(|j| off(i, j) < 0.0625))
}

/// An approximate inverse, of the midpoints; `None` for a matrix that is singular to the precision.
fn inverse<const BITS: u32>(matrix: &Matrix<BITS>) -> Option<Matrix<BITS>> {
    let n = matrix.len();
    let unit = |i: usize, j: usize| if i == j { Ball::one() } else { Ball::zero() };
    let row = |i: usize| matrix[i].iter().map(Ball::midpoint).chain((0..n).map(|j| unit(i, j))).collect();
    let mut rows: Vec<Vec<Ball<BITS>>> = (0..n).map(row).collect();
    for k in 0..n {
        let pivot = (k..n).max_by(|&a, &b| rows[a][k].upper().total_cmp(&rows[b][k].upper()))?;
        rows.swap(k, pivot);
        let scale = rows[k][k].midpoint().inverse()?.midpoint();
        let pivot_row: Vec<Ball<BITS>> = rows[k].iter().map(|x| x.mul(&scale).midpoint()).collect();
        for (_, target) in rows.iter_mut().enumerate().filter(|(i, _)| *i != k) {
            let factor = target[k].clone();
            for (x, p) in target.iter_mut().zip(&pivot_row) {
                *x = x.sub(&factor.mul(p)).midpoint();
            }
        }
        rows[k] = pivot_row;
    }
    Some(rows.into_iter().map(|row| row[n..].to_vec()).collect())
}
