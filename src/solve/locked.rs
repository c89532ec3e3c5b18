//! Configurations at which a loop of seven variables is singular, and whether it is locked there.
//!
//! A loop of seven variables runs through a curve. Where its Jacobian J has corank 1 two real branches of the curve cross, or two
//! conjugate complex ones meet in one real configuration, which no value of a variable leads to: the loop is locked. With the left singular vector
//! w and the right ones v, v' of the smallest singular values, `w J v` and `w J v'` are 0 there, which is linearised together with the closure.
//! The second derivatives of the closure along w are a quadratic form on v, v': the real branches run where it is 0.

use super::curve::{CLOSES_WITHIN, Curve, Point};
use crate::kinematics::motion::cross;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector, SMatrix, Vector6};

/// Steps towards closing alone, before those to a singular configuration: from as far as a radian away 9 of 10 starts lead to one then, and
/// 3 of 10 without them.
const TOWARDS: usize = 8;
/// Joins the square of the singular values there, so that steps along the smallest ones stay short.
const DAMPING: f64 = 1e-6;
/// Steps at most: they converge quadratically from nearby.
const STEPS: usize = 30;
/// A step is no longer: the cosine of half a radian is linear to an eighth.
const LONGEST: f64 = 0.5;
/// Steps this short have converged: the next one is a square of it.
const CONVERGED: f64 = 1e-9;
/// Equations that a step meets up to this are those of a singular configuration that exists.
const CONSISTENT: f64 = 1e-8;
/// Singular values below this part of the largest are none.
const RANK: f64 = 1e-7;

/// The smallest singular value of the Jacobian at a point, and how it changes.
struct Corank {
    /// The closure and the two products `w J v`, with the other sign.
    right: DVector<f64>,
    /// The derivatives of both by the variables.
    rows: DMatrix<f64>,
    /// The form on v, v'.
    form: [f64; 3],
    /// Its smallest singular value but one, in parts of the largest.
    second: f64,
}

impl Corank {
    fn of(curve: &Curve, at: &Point) -> Option<Self> {
        let (closing, jacobian) = curve.closure(at);
        // A square matrix has all its singular vectors; they come in descending order of the values.
        let matrix = finite(DMatrix::from_fn(7, 7, |i, j| jacobian.get(i).map_or(0.0, |row| row[j])));
        let svd = matrix.clone().svd(true, true);
        let (left, transposed) = (svd.u.as_ref()?, svd.v_t.as_ref()?);
        let values = &svd.singular_values;
        // The row of zeros has a left singular vector of its own, which may stand in either of the last places, or be mixed with w.
        let own = if left[(6, 5)].abs() < left[(6, 6)].abs() { 5 } else { 6 };
        let w: [f64; 6] = std::array::from_fn(|i| left[(i, own)]);
        let twist = |j: usize| -> [[f64; 3]; 2] { [0, 3].map(|first| std::array::from_fn(|i| jacobian[first + i][j])) };
        // A variable carries the axes behind it: the twist j changes by the Lie product with the twist k before it.
        let bent = |j: usize, k: usize| {
            if k >= j {
                return 0.0;
            }
            let ([omega, moment], [own, moved]) = (twist(k), twist(j));
            let (angular, one, two) = (cross(&omega, &own), cross(&omega, &moved), cross(&moment, &own));
            (0..3).map(|i| w[i] * angular[i] + w[3 + i] * (one[i] + two[i])).sum::<f64>()
        };
        let bends = DMatrix::from_fn(7, 7, bent);
        let mut rows = DMatrix::zeros(8, 7);
        let mut right = DVector::zeros(8);
        // The curve is not gone along to meet the closure.
        let regular = &matrix - left.column(own) * transposed.row(5) * values[5];
        for i in 0..6 {
            right[i] = -closing.residual[i];
            rows.row_mut(i).copy_from(&regular.row(i));
        }
        for n in 0..2 {
            let v = transposed.row(5 + n);
            rows.row_mut(6 + n).copy_from(&(v * &bends));
            right[6 + n] = -(0..6).map(|i| w[i] * (0..7).map(|j| matrix[(i, j)] * v[j]).sum::<f64>()).sum::<f64>();
        }
        let entry = |n: usize, m: usize| (transposed.row(5 + n) * &bends * transposed.row(5 + m).transpose())[0];
        let form = [entry(0, 0), f64::midpoint(entry(0, 1), entry(1, 0)), entry(1, 1)];
        Some(Self { right, rows, form, second: values[4] / values[0] })
    }
}

/// Returns a step to where the loop is closed better, by damped least squares.
fn towards(curve: &Curve, at: &Point) -> Option<Point> {
    let (closing, jacobian) = curve.closure(at);
    let entry = |i: usize, j: usize| {
        let product: f64 = (0..7).map(|k| jacobian[i][k] * jacobian[j][k]).sum();
        product + if i == j { DAMPING } else { 0.0 }
    };
    let solved = SMatrix::<f64, 6, 6>::from_fn(entry).lu().solve(&Vector6::from(closing.residual))?;
    Some(std::array::from_fn(|k| -(0..6).map(|i| jacobian[i][k] * solved[i]).sum::<f64>()))
}

/// Goes a step, or a part of it. Returns its length.
fn go(at: &mut Point, step: &[f64]) -> f64 {
    let size = step.iter().fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let part = (LONGEST / size).min(1.0);
    for (value, along) in at.iter_mut().zip(step) {
        *value += part * along;
    }
    size
}

/// Returns the configuration near `start` that closes a loop of seven variables and at which it is locked: no curve of real configurations leads
/// away from it. `None` where the steps lead to no such one.
#[must_use]
pub fn locked(curve: &Curve, start: &Point) -> Option<Point> {
    let mut at = *start;
    for _ in 0..TOWARDS {
        let step = towards(curve, &at)?;
        go(&mut at, &step);
    }
    for _ in 0..STEPS {
        let here = Corank::of(curve, &at)?;
        let step = finite(here.rows.clone()).svd(true, true).solve(&finite(here.right.clone()), RANK).ok()?;
        if go(&mut at, step.as_slice()) < CONVERGED {
            let left = (&here.right - &here.rows * &step).amax();
            let [a, b, c] = here.form;
            let is_definite = a * c - b * b > RANK * (a.abs() + c.abs()).powi(2);
            let (closing, _) = curve.closure(&at);
            let is_one = here.second > RANK && left < CONSISTENT && closing.defect < CLOSES_WITHIN;
            return (is_one && is_definite).then_some(at);
        }
    }
    None
}
