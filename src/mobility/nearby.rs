//! Loops that do not move, near ones that do: data of a mobile loop that were rounded, or measured.

use super::branches::{Curve, floating};
use crate::exact::linkage::{Linkage, Study, equations, one, times};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::dual_quaternion::DualQuaternion;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};
use rug::Rational;
use std::f64::consts::PI;

/// Values of the joint that is held: more than a loop of six joints has parameters.
const VALUES: usize = 24;
/// Least number of places at which the loop has to close, nearly.
const FEWEST: usize = 16;
/// Starts from which it is closed for the first time.
const STARTS: u32 = 30;
/// Steps of Newton's method.
const STEPS: usize = 30;
/// Closure residuals up to this, in radians and in lengths over the mean link, are nearly closed.
const NEARLY: f64 = 1e-2;
/// Residuals below this are rounding.
const CLOSED: f64 = 1e-11;
/// Corrections of the links.
const CORRECTIONS: usize = 8;
/// Weight by which a joint is moved rather than a link changed.
const JOINTS: f64 = 1e3;
/// Singular values below this part of the largest count as none.
const LEAST: f64 = 1e-10;

/// A loop nearby that closes through a range of a joint, in floating point.
pub(super) struct Nearby {
    /// The place of the joint variable.
    pub held: usize,
    /// At how many values of it the loop was closed, half of them not used to find it.
    pub values: usize,
    /// The largest rotation of a link, in radians.
    pub turn: f64,
    /// The largest shift of a link.
    pub shift: f64,
}

/// Looks for the nearest loop that moves.
pub(super) fn nearby(linkage: &Linkage<Rational>) -> Option<Nearby> {
    let unit = linkage.unit().to_f64();
    let mut nearby = Approach { linkage: floating(linkage), unit };
    let held = linkage.variables.iter().position(|variable| *variable == Variable::Rotation)?;
    let places = nearby.around(held)?;
    let (places, [turn, shift]) = nearby.corrected(held, places)?;
    // Points between the places, at which the links were not adapted, show whether they move.
    let between = places.windows(2).all(|pair| {
        let mut at = (&pair[0] + &pair[1]) / 2.0;
        at[held] = f64::midpoint(pair[0][held], pair[1][held]);
        let between = (&pair[1] - &pair[0]).amax() < PI / 4.0;
        !between || nearby.closed(held, at).1 < CLOSED
    });
    (between && turn < NEARLY && shift < NEARLY * unit).then_some(Nearby {
        held,
        values: 2 * places.len() - 1,
        turn,
        shift,
    })
}

struct Approach {
    linkage: Linkage<f64>,
    unit: f64,
}

impl Approach {
    /// The place nearest to closure with one joint held, and what is left of the equations.
    fn closed(&self, held: usize, mut at: DVector<f64>) -> (DVector<f64>, f64) {
        let curve = Curve { linkage: &self.linkage, unit: self.unit };
        let mut left = f64::INFINITY;
        for _ in 0..STEPS {
            let (matrix, right) = curve.equations(&at);
            if !matrix.iter().chain(&right).all(|x| x.is_finite()) {
                return (at, f64::INFINITY);
            }
            left = right.amax();
            let svd = finite(matrix.remove_column(held)).svd(true, true);
            let least = LEAST * svd.singular_values.amax();
            let Ok(step) = svd.solve(&right, least) else { break };
            let step = step.insert_row(held, 0.0);
            let length = step.norm();
            at -= &step * (0.5 / length.max(0.5));
            if length < 1e-14 {
                break;
            }
        }
        (at, left)
    }

    /// Places all round the held joint at which the loop nearly closes, one behind the other.
    fn around(&self, held: usize) -> Option<Vec<DVector<f64>>> {
        let n = self.linkage.variables.len();
        let start = (0..STARTS).find_map(|start| {
            // Any places, the same every time.
            let mut at =
                DVector::from_fn(n, |k, _| (f64::from(start * 7 + 1) * (k as f64 + 1.0) * 0.754_877).fract() * PI);
            at[held] = 0.3 + f64::from(start) * 0.41;
            let (at, left) = self.closed(held, at);
            (left < NEARLY).then_some(at)
        })?;
        let mut places: Vec<DVector<f64>> = vec![start.clone()];
        for direction in [1.0, -1.0] {
            let mut here = start.clone();
            while places.len() < VALUES {
                here[held] += direction * PI / VALUES as f64;
                let (next, left) = self.closed(held, here.clone());
                if !(left < NEARLY) {
                    break;
                }
                here = next;
                if direction > 0.0 { places.push(here.clone()) } else { places.insert(0, here.clone()) }
            }
        }
        (places.len() >= FEWEST).then_some(places)
    }

    /// Changes the links as little as it takes to close at all places, and says by how much.
    fn corrected(&mut self, held: usize, mut places: Vec<DVector<f64>>) -> Option<(Vec<DVector<f64>>, [f64; 2])> {
        let n = self.linkage.variables.len();
        let free: Vec<usize> = (0..n).filter(|k| *k != held).collect();
        let mut change = DVector::<f64>::zeros(6 * n);
        let mut largest = f64::INFINITY;
        for _ in 0..CORRECTIONS {
            let of_joints = free.len() * places.len();
            let mut matrix = DMatrix::<f64>::zeros(6 * places.len(), of_joints + 6 * n);
            let mut right = DVector::<f64>::zeros(6 * places.len());
            for (p, at) in places.iter().enumerate() {
                let (joints, rest) = Curve { linkage: &self.linkage, unit: self.unit }.equations(at);
                let links = self.of_links(at);
                for i in 0..6 {
                    right[6 * p + i] = rest[i];
                    for (c, k) in free.iter().enumerate() {
                        matrix[(6 * p + i, p * free.len() + c)] = joints[(i, *k)] * JOINTS;
                    }
                    for c in 0..6 * n {
                        matrix[(6 * p + i, of_joints + c)] = links[(i, c)];
                    }
                }
            }
            largest = right.amax();
            if !largest.is_finite() {
                return None;
            }
            if largest < CLOSED / 10.0 {
                break;
            }
            let svd = finite(matrix).svd(true, true);
            let least = LEAST * svd.singular_values.amax();
            let step = svd.solve(&right, least).ok()?;
            for (p, at) in places.iter_mut().enumerate() {
                for (c, k) in free.iter().enumerate() {
                    at[*k] -= step[p * free.len() + c] * JOINTS;
                }
            }
            for k in 0..n {
                let part: Vec<f64> = (0..6).map(|i| -step[of_joints + 6 * k + i]).collect();
                let scaled = [3, 4, 5].map(|i| 2.0 * part[i] * self.unit);
                let turn = DualQuaternion::from_study(&[1.0, part[0], part[1], part[2]], &[0.0; 4]);
                self.linkage.links[k] = self.linkage.links[k].mul(&DualQuaternion::translation(&scaled)).mul(&turn);
            }
            change -= step.rows(of_joints, 6 * n);
        }
        let norm = |k: usize, first: usize| 2.0 * change.rows(6 * k + first, 3).norm();
        let most = |first: usize| (0..n).map(|k| norm(k, first)).fold(0.0, f64::max);
        (largest < CLOSED).then(|| (places, [most(0), most(3) * self.unit]))
    }

    /// Returns the derivatives of the closure equations, as in [`Curve::equations`], by small half rotations about, and half
    /// shifts along, the axes of the frame behind each link.
    fn of_links(&self, at: &DVector<f64>) -> DMatrix<f64> {
        let n = self.linkage.variables.len();
        let value = |k: usize| match self.linkage.variables[k] {
            Variable::Rotation => [at[k].cos(), at[k].sin()],
            Variable::Translation => [1.0, at[k] * self.unit],
        };
        let position = self.linkage.at(&(0..n).map(value).collect::<Vec<_>>());
        let mut behind: Vec<Study<f64>> = vec![one()];
        for link in position.links.iter().rev() {
            behind.push(times(link, &behind[behind.len() - 1]));
        }
        let scalar = behind[n][0];
        let mut matrix = DMatrix::zeros(6, 6 * n);
        let mut before: Study<f64> = one();
        for (k, link) in position.links.iter().enumerate() {
            before = times(&before, link);
            for (c, unit) in [1, 2, 3, 5, 6, 7].into_iter().enumerate() {
                let mut generator: Study<f64> = [0.0; 8];
                generator[unit] = 1.0;
                let changed = equations(&times(&times(&before, &generator), &behind[n - 1 - k]));
                for (i, x) in changed.into_iter().enumerate() {
                    let row = if i < 3 { 1.0 } else { 1.0 / self.unit };
                    let column = if c < 3 { 1.0 } else { self.unit };
                    matrix[(i, 6 * k + c)] = x / scalar * row * column;
                }
            }
        }
        matrix
    }
}
