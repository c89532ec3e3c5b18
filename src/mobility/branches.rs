//! Configurations of a mobile loop that lie on one and the same curve: the curve is followed in floating point.

use super::answer::Configuration;
use super::order::Germ;
use crate::exact::linkage::{Axis, JointValue, Linkage};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::dual_quaternion::DualQuaternion;
use crate::kinematics::motion::dot;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};
use rug::Rational;
use std::f64::consts::PI;

/// Length of a step, in half angles and in lengths over the mean link.
const STEP: f64 = 0.02;
/// Steps after which a curve that does not come back is given up.
const STEPS: usize = 5000;
/// Newton's steps after each one.
const CORRECTIONS: usize = 4;
/// Distances, in mean links, beyond which a curve is given up.
const FAR: f64 = 20.0;
/// A point of the curve is a configuration if they are nearer than this.
const NEAR: f64 = 0.5 * STEP;
/// Singular values below this part of the largest are those of motions.
const MOTION: f64 = 1e-6;

/// A number for every configuration that moves, the same one for those on one curve, from 0 in order of appearance; `None` for those
/// that do not move.
///
/// Curves are followed straight through the points where they cross. A motion of more than one dimension is one branch for
/// every configuration.
pub(super) fn branches(linkage: &Linkage<Rational>, configurations: &[Configuration]) -> Vec<Option<usize>> {
    let unit = linkage.unit().to_f64();
    let linkage = floating(linkage);
    let mut found: Vec<Option<usize>> = vec![None; configurations.len()];
    let mut count = 0;
    for k in 0..configurations.len() {
        if found[k].is_some() || configurations[k].dimension().is_none_or(|dimension| dimension == 0) {
            continue;
        }
        found[k] = Some(count);
        if configurations[k].dimension() == Some(1) {
            for other in (Curve { linkage: &linkage, unit }).passes(k, configurations) {
                found[other].get_or_insert(count);
            }
        }
        count += 1;
    }
    found
}

/// The loop in floating point, axes of length 1 and each link over its largest coordinate.
pub(super) fn floating(linkage: &Linkage<Rational>) -> Linkage<f64> {
    let link = |link: &DualQuaternion<Rational>| {
        let (x, y) = link.study();
        let largest = x.iter().chain(&y).map(|c| c.clone().abs()).max().unwrap_or_else(|| Rational::from(1));
        let image = |v: &[Rational; 4]| v.each_ref().map(|c| Rational::from(c / &largest).to_f64());
        DualQuaternion::from_study(&image(&x), &image(&y))
    };
    let axis = |axis: &Axis<Rational>| match axis {
        Axis::Z => Axis::Z,
        Axis::Along(e) => {
            let e = e.each_ref().map(Rational::to_f64);
            let length = dot(&e, &e).sqrt();
            Axis::Along(e.map(|x| x / length))
        }
    };
    Linkage {
        variables: linkage.variables.clone(),
        axes: linkage.axes.iter().map(axis).collect(),
        links: linkage.links.iter().map(link).collect(),
    }
}

/// A curve of configurations.
pub(super) struct Curve<'a> {
    pub(super) linkage: &'a Linkage<f64>,
    pub(super) unit: f64,
}

impl Curve<'_> {
    /// The configurations that the curve through one of them passes.
    fn passes(&self, start: usize, configurations: &[Configuration]) -> Vec<usize> {
        let places: Vec<DVector<f64>> = configurations.iter().map(|c| self.place(&c.q)).collect();
        let mut here = places[start].clone();
        let mut passed = vec![start];
        let Some(mut tangent) = self.tangent(&here, None) else { return passed };
        let first = tangent.clone();
        for step in 0..STEPS {
            let Some(next) = self.corrected(&here + &tangent * STEP) else { break };
            // Another curve.
            if !((&next - &here).norm() < 2.0 * STEP) {
                break;
            }
            // A slide without end does not come back.
            let is_far = |(x, variable): (&f64, &Variable)| *variable == Variable::Translation && x.abs() > FAR;
            if next.iter().zip(&self.linkage.variables).any(is_far) {
                break;
            }
            let Some(ahead) = self.tangent(&next, Some(&tangent)) else { break };
            (here, tangent) = (next, ahead);
            for (k, place) in places.iter().enumerate() {
                let between = self.between(place, &here);
                // Beside the curve, along it anywhere within a step.
                let along = between.dot(&tangent);
                let beside = (&between - &tangent * along).norm();
                if along.abs() > STEP || beside > NEAR * STEP.sqrt() {
                    continue;
                }
                if !passed.contains(&k) {
                    passed.push(k);
                } else if k == start && step > 2 && tangent.dot(&first) > 0.9 {
                    return passed;
                }
            }
        }
        passed
    }

    /// Half angles, and half distances over the unit.
    fn place(&self, q: &[f64]) -> DVector<f64> {
        let scaled = |(q, variable): (&f64, &Variable)| match variable {
            Variable::Rotation => q / 2.0,
            Variable::Translation => q / 2.0 / self.unit,
        };
        DVector::from_iterator(q.len(), q.iter().zip(&self.linkage.variables).map(scaled))
    }

    /// From one place to another, half angles modulo half a turn.
    fn between(&self, from: &DVector<f64>, to: &DVector<f64>) -> DVector<f64> {
        let difference = |k: usize| match self.linkage.variables[k] {
            Variable::Rotation => (to[k] - from[k] + PI / 2.0).rem_euclid(PI) - PI / 2.0,
            Variable::Translation => to[k] - from[k],
        };
        DVector::from_fn(from.len(), |k, _| difference(k))
    }

    /// Returns the joint screws at a place, padded to at least as many rows as columns, and the residual of the closure
    /// equations.
    pub(super) fn equations(&self, at: &DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
        let value = |(x, variable): (&f64, &Variable)| -> JointValue<f64> {
            match variable {
                Variable::Rotation => [x.cos(), x.sin()],
                Variable::Translation => [1.0, x * self.unit],
            }
        };
        let values: Vec<JointValue<f64>> = at.iter().zip(&self.linkage.variables).map(value).collect();
        let (screws, rest) = Germ::first_order(&self.linkage.at(&values));
        let n = screws.len();
        let scale = |row: usize| if row < 3 { 1.0 } else { 1.0 / self.unit };
        let of = |k: usize| if self.linkage.variables[k] == Variable::Translation { self.unit } else { 1.0 };
        let matrix = DMatrix::from_fn(n.max(6), n, |i, k| if i < 6 { screws[k][i] * scale(i) * of(k) } else { 0.0 });
        let right = DVector::from_fn(n.max(6), |i, _| if i < 6 { rest[i] * scale(i) } else { 0.0 });
        (matrix, right)
    }

    /// The direction of the curve, ahead of the one before.
    fn tangent(&self, at: &DVector<f64>, before: Option<&DVector<f64>>) -> Option<DVector<f64>> {
        let (matrix, _) = self.equations(at);
        if !matrix.iter().all(|x| x.is_finite()) {
            return None;
        }
        let svd = finite(matrix).svd(false, true);
        let (values, rows) = (svd.singular_values, svd.v_t?);
        let least = MOTION * values.amax();
        let ahead = match before {
            // Where curves cross there are several tangents: the one that goes straight on is taken.
            Some(before) => (0..values.len())
                .filter(|k| values[*k] <= least.max(values.min()))
                .map(|k| rows.row(k).transpose())
                .fold(DVector::zeros(at.len()), |sum, v| &sum + &v * v.dot(before)),
            None => rows.row(values.imin()).transpose(),
        };
        (ahead.norm() > 0.1).then(|| ahead.normalize())
    }

    /// The place on the curve nearest to one beside it.
    fn corrected(&self, mut at: DVector<f64>) -> Option<DVector<f64>> {
        for _ in 0..CORRECTIONS {
            let (matrix, right) = self.equations(&at);
            if !matrix.iter().chain(&right).all(|x| x.is_finite()) {
                return None;
            }
            let svd = finite(matrix).svd(true, true);
            let least = MOTION * svd.singular_values.amax();
            at -= svd.solve(&right, least).ok()?;
        }
        Some(at)
    }
}
