//! Assemblies of a linkage on the sphere that are infinitely many: a real one that moves, and the proof that there is one.
//!
//! The equations in the axes are polynomials over the rationals, as those of a planar group are, and the same theorem holds for them: the
//! set is cut at rational values of a coordinate of an axis, and more cuts with real members than it can have isolated ones, or
//! connected parts, are proof of a real curve (`linkage::real_motion`).

use super::answer::{SphereMode, mode};
use super::equations::System;
use crate::algebra::disc::Disc;
use crate::algebra::groebner::Equation;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::kinematics::motion::dot;
use crate::kinematics::sphere::SphereLinkage;
use crate::linkage::exact_group::moved;
use crate::linkage::quadratic::Root;
use crate::linkage::real_motion::Moving;
use crate::linkage::real_system::RealSystem;
use rug::{Float, Rational};
use std::f64::consts::{PI, TAU};

/// A step along a first-order motion, in parts of the fastest coordinate: what stands still moves by its square.
const STEP: f64 = 1e-5;
/// Changes of angles below this stand for 0: the square of a step is a hundredth of that.
const STILL: f64 = 1e-8;

/// A curve of assemblies, or a set of more dimensions.
#[derive(Clone, Debug)]
pub struct SphereFamily {
    /// Its dimension, complex assemblies counted.
    pub dimension: usize,
    /// The joints that move.
    pub joints: Vec<usize>,
    /// A real one of them.
    pub sample: SphereMode,
    /// Whether a curve of real ones is proved.
    pub is_proved: bool,
}

/// What is found of assemblies that are infinitely many.
#[derive(Default)]
pub(super) struct Found {
    /// A family with a real member.
    pub family: Option<SphereFamily>,
    /// All regular assemblies, which are isolated; `None` where they were not looked for.
    pub regular: Option<Vec<SphereMode>>,
}

/// Describes infinitely many assemblies of this dimension.
pub(super) fn family(linkage: &SphereLinkage, system: &System, dimension: usize) -> Found {
    let sizes = sizes(linkage, system);
    let shifts = sizes.iter().enumerate().map(|(k, size)| {
        let inverse = Equation::from_rational(&Rational::from(size.recip_ref())).unwrap_or_else(Equation::one);
        Equation::variable(k).mul(&inverse)
    });
    let real = RealSystem {
        unknowns: system.unknowns,
        turns: Vec::new(),
        shifts: shifts.collect(),
        equations: system.equations.clone(),
        squares: Vec::new(),
        spinning: Vec::new(),
    };
    let Moving { sample, beside, is_proved, regular, .. } = moved(&real, dimension);
    let placed = |root: &Root, real: bool, off: &[f64]| {
        let values: Vec<Disc> = (0..system.unknowns).map(|k| value(root, &sizes, off, k)).collect();
        mode(linkage, system, root.multiplicity, real, &|equation| equation.evaluate(&values))
    };
    let regular = regular.and_then(|list| list.iter().map(|(root, real)| placed(root, *real, &[])).collect());
    let family = sample.and_then(|(root, rates)| {
        let sample = placed(&root, true, &[])?;
        let others: Vec<SphereMode> = if let Some(other) = beside {
            // Two members of a curve: what stands still has one value in both.
            vec![placed(&other, true, &[])?]
        } else {
            rates.iter().map(|rate| placed(&root, true, rate)).collect::<Option<_>>()?
        };
        let joints = moving_joints(&sample, &others);
        Some(SphereFamily { dimension, joints, sample, is_proved })
    });
    Found { family, regular }
}

/// The joints whose angles differ between a member and others.
fn moving_joints(sample: &SphereMode, others: &[SphereMode]) -> Vec<usize> {
    let apart = |joint: usize, other: &SphereMode| {
        let angle = (sample.joints[joint].re - other.joints[joint].re).rem_euclid(TAU);
        if angle > PI { TAU - angle } else { angle }
    };
    let moves = |joint: &usize| others.iter().any(|other| apart(*joint, other) > STILL);
    (0..sample.joints.len()).filter(moves).collect()
}

/// The lengths of the axes whose coordinates the unknowns are, as rational numbers near them.
fn sizes(linkage: &SphereLinkage, system: &System) -> Vec<Rational> {
    let of = |k: usize| {
        let is_own = |axis: &&[Equation; 3]| axis.contains(&Equation::variable(k));
        let joint = system.axes.iter().position(|axis| is_own(&axis));
        let square =
            joint.map_or(1.0, |joint| nearest_f64(&dot(&linkage.joints[joint].at[0], &linkage.joints[joint].at[0])));
        Rational::from_f64(square.sqrt()).filter(|size| *size > 0).unwrap_or_else(|| Rational::from(1))
    };
    (0..system.unknowns).map(of).collect()
}

/// The value of an unknown, moved by a step along rates.
fn value(root: &Root, sizes: &[Rational], rates: &[f64], k: usize) -> Disc {
    let own = &root.shifts[k].z.disc;
    let bits = own.re.prec();
    let moved = match rates.get(k) {
        Some(rate) => own.add(&Disc::point(Float::with_val(bits, rate * STEP), Float::new(bits))),
        None => own.clone(),
    };
    moved.mul(&Disc::of(&sizes[k], bits))
}
