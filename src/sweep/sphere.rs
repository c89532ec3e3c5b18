//! The branches of a linkage on the sphere while the angle of a joint runs through a range.

use crate::algebra::number::{Angle, HalfTangent, nearest_f64};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::catalogue::sphere::turned;
use crate::derivation::{Transfer, transfer};
use crate::error::Result;
use crate::kinematics::sphere::{SphereGiven, SphereLinkage};
use crate::linkage::sphere::{SphereMode, solve};
use crate::verdict::Verdict;
use rug::Rational;
use std::f64::consts::{PI, TAU};

/// Half-angle tangents of the steps are multiples of this over 1: small numbers, and closer than any picture shows.
const GRAIN: f64 = 1.0 / 1_048_576.0;
/// No joint of a branch turns by more than this in a step, radians; farther modes begin a new branch.
const STEP: f64 = 2.0;

/// One position of a branch.
#[derive(Clone, Debug)]
pub struct SphereNode {
    /// The number of the step, from 0.
    pub step: usize,
    /// The assembly.
    pub mode: SphereMode,
}

/// The result over the range.
#[derive(Clone, Debug)]
pub struct SphereSweep {
    /// The joint that runs.
    pub joint: usize,
    /// The angle of the input in radians, and the verdict, for every step.
    pub inputs: Vec<(f64, Verdict)>,
    /// The real branches, each as its positions in order.
    pub branches: Vec<Vec<SphereNode>>,
    /// The angles in (-pi, pi] at which two assemblies of a four-bar meet, exactly counted in the whole turn; none where no transfer
    /// function of one four-bar is known.
    pub limits: Option<Vec<f64>>,
    /// The number of complex limit positions in the whole turn.
    pub complex_limits: Option<usize>,
}

/// Runs a joint from one angle to another in `steps` steps; the other inputs stay.
///
/// # Errors
/// As [`solve`].
pub fn sweep_sphere(
    linkage: &SphereLinkage,
    given: &[SphereGiven],
    joint: usize,
    (from, to, steps): (f64, f64, usize),
) -> Result<SphereSweep> {
    let others: Vec<SphereGiven> = given.iter().filter(|one| one.joint != Some(joint)).cloned().collect();
    let mut branches: Vec<Vec<SphereNode>> = Vec::new();
    let (mut open, mut inputs): (Vec<usize>, Vec<(f64, Verdict)>) = (Vec::new(), Vec::new());
    for step in 0..=steps {
        #[expect(clippy::cast_precision_loss, reason = "steps are few")]
        let input = from + (to - from) * step as f64 / steps.max(1) as f64;
        let (rotation, _) = turned(&linkage.joints[joint], &angle(input));
        let mut all = others.clone();
        all.push(SphereGiven { of: linkage.joints[joint].of, rotation, joint: Some(joint), line: linkage.joints[joint].line });
        let answer = solve(linkage, &all, true)?;
        inputs.push((input, answer.verdict));
        let mut modes: Vec<SphereMode> = answer.modes.into_iter().filter(|mode| mode.real).collect();
        let mut still = Vec::new();
        for branch in open {
            let last = branches[branch].last().map(|node| node.mode.clone());
            let nearest = last.and_then(|last| {
                let distances = modes.iter().map(|mode| apart(mode, &last)).enumerate();
                distances.filter(|(_, d)| *d < STEP).min_by(|a, b| a.1.total_cmp(&b.1))
            });
            if let Some((k, _)) = nearest {
                branches[branch].push(SphereNode { step, mode: modes.remove(k) });
                still.push(branch);
            }
        }
        for mode in modes {
            still.push(branches.len());
            branches.push(vec![SphereNode { step, mode }]);
        }
        open = still;
    }
    let found = transfer(linkage, joint).ok().and_then(|found| limits(&found));
    let (limits, complex_limits) = match found {
        Some((real, complex)) => (Some(real), Some(complex)),
        None => (None, None),
    };
    Ok(SphereSweep { joint, inputs, branches, limits, complex_limits })
}

/// The angle as one with a short half-angle tangent.
fn angle(radians: f64) -> Angle {
    let wrapped = radians - TAU * (radians / TAU).round();
    let tangent = (wrapped / 2.0).tan();
    if wrapped.abs() >= PI || tangent.abs() > 1.0 / GRAIN {
        return Angle::from_half_tangent(HalfTangent::Infinite);
    }
    let rounded = Rational::from_f64((tangent / GRAIN).round() * GRAIN).unwrap_or_default();
    Angle::from_half_tangent(HalfTangent::Finite(rounded))
}

/// The largest difference of a joint.
fn apart(one: &SphereMode, two: &SphereMode) -> f64 {
    let turned = |a: f64, b: f64| ((a - b) - TAU * ((a - b) / TAU).round()).abs();
    one.joints.iter().zip(&two.joints).map(|(a, b)| turned(a.re, b.re)).fold(0.0, f64::max)
}

/// The real limit positions of one four-bar and the number of complex ones: roots of the discriminant of its transfer function,
/// which is quadratic in the output.
fn limits(found: &Transfer) -> Option<(Vec<f64>, usize)> {
    if found.bodies.len() != 1 {
        return None;
    }
    let exact = found.polynomial.map(|c| Some(Rational::from(c.to_integer())))?;
    let mut list = exact.coefficients_in(1);
    list.resize(3, Polynomial::zero());
    let four = Polynomial::constant(Rational::from(4));
    let discriminant = list[1].mul(&list[1]).sub(&four.mul(&list[0]).mul(&list[2]));
    let discriminant: Univariate<Rational> = discriminant.to_univariate(0)?;
    if discriminant.is_zero() {
        return None;
    }
    // The discriminant has degree 4 in general; what is missing is at infinity, at a half turn.
    let degree = discriminant.degree().unwrap_or(0);
    let mut real: Vec<f64> =
        discriminant.real_roots().into_iter().map(|mut root| 2.0 * root.to_f64().atan()).collect();
    if degree < 4 {
        real.push(PI);
    }
    real.sort_by(f64::total_cmp);
    Some((real, 4))
}

/// The direction of a point of a body in an assembly.
#[must_use]
pub fn place(mode: &SphereMode, body: usize, point: &[Rational; 3]) -> [f64; 3] {
    let p = point.each_ref().map(nearest_f64);
    mode.bodies[body].map(|row| row.iter().zip(p).map(|(c, x)| c.re * x).sum())
}
