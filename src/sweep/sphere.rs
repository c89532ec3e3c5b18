//! The branches of a linkage on the sphere while the angle of a joint runs through a range.

use super::Range;
use super::assemblies::{AssemblySample, AssemblySweep, Proved, Running, follow};
use super::dyads::Proof;
use super::linking::{Linking, links};
use crate::algebra::number::{Angle, HalfTangent, nearest_f64};
use crate::assembly::wrapped;
use crate::catalogue::root;
use crate::error::{Error, Result};
use crate::kinematics::motion::dot;
use crate::kinematics::sphere::{SphereGiven, SphereLinkage};
use crate::linkage::sphere::{SphereDyads, SphereMode, about, half_turn, solve, start};
use crate::verdict::{Code, Status};
use looproot_calculus::rotation::matrix::{Matrix, product};
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::TAU;

/// The result of a sweep of a linkage on the sphere.
pub type SphereSweep = AssemblySweep<SphereMode>;

/// Larger tangents of half an angle are those of half a turn: that of pi in f64 is 1.6e16.
const HALF_TURN: f64 = 1e15;

/// A joint that runs, while other rotations are held.
struct Run<'a> {
    linkage: &'a SphereLinkage,
    joint: usize,
    held: Vec<SphereGiven>,
    /// The rotation of its second body against the first from which its angle is counted.
    start: Matrix<Rational>,
    /// The square of the length of its axis.
    square: Rational,
    /// Where the linkage consists of dyads.
    proof: Option<Proof<SphereMode>>,
}

impl Running for Run<'_> {
    type Mode = SphereMode;
    type Memory = ();

    fn sample(&self, input: f64, (): &mut ()) -> Result<AssemblySample<SphereMode>> {
        let own = &self.linkage.joints[self.joint];
        let axis = &own.at[0];
        let turn = match half_tangent(input, &self.square) {
            Some(x) => about(axis, &x),
            None => half_turn(axis),
        };
        let rotation = product(&turn, &self.start);
        let driven = SphereGiven { of: own.of, rotation, joint: Some(self.joint), line: own.line };
        let given: Vec<SphereGiven> = self.held.iter().cloned().chain([driven]).collect();
        let answer = solve(self.linkage, &given, true).map(|answer| (answer.verdict, answer.modes));
        AssemblySample::of(input, answer, |mode| mode.real.then_some(mode.multiplicity))
    }

    /// The distance of two assemblies: the largest turn of a joint.
    fn apart(&self, one: &SphereMode, two: &SphereMode) -> f64 {
        one.joints.iter().zip(&two.joints).map(|(a, b)| wrapped(a.re - b.re).abs()).fold(0.0, f64::max)
    }

    /// The assembly between two that are nearly one.
    fn middle(&self, one: &SphereMode, two: &SphereMode) -> SphereMode {
        let mut mode = one.clone();
        for (own, other) in mode.joints.iter_mut().zip(&two.joints) {
            *own = Complex::new(wrapped(own.re + 0.5 * wrapped(other.re - own.re)), 0.0);
        }
        for (own, other) in mode.bodies.iter_mut().zip(&two.bodies) {
            for (entry, second) in own.iter_mut().flatten().zip(other.iter().flatten()) {
                *entry = (*entry + second) * 0.5;
            }
        }
        mode
    }

    fn because(&self) -> &'static str {
        self.proof.as_ref().map_or("", Linking::because)
    }

    fn proved(
        &self,
        range: Range,
        is_full_turn: bool,
        samples: &[AssemblySample<SphereMode>],
    ) -> Result<Proved<SphereMode>> {
        match &self.proof {
            Some(proof) => links(proof, range, is_full_turn, samples, |input| self.sample(input, &mut ())),
            None => Ok(Err(Code::NoExactRoute)),
        }
    }
}

/// The tangent of half an angle in radians over the length of an axis whose square is given; `None` for half a turn, and for what f64
/// does not tell from it.
pub(super) fn half_tangent(angle: f64, square: &Rational) -> Option<Rational> {
    match Angle::from_radians(angle).half_tangent() {
        HalfTangent::Finite(t) if t.to_f64().abs() < HALF_TURN => {
            // Roots have 30 digits behind the point: those of large numbers are as accurate relatively.
            let bits = square.denom().significant_bits();
            let length = root(&Rational::from(square << (2 * bits))).0 >> bits;
            Some(t / length)
        }
        _ => None,
    }
}

/// Sweeps a joint of a linkage on the sphere, on all threads of the current pool, while the other given rotations are held; `exact`
/// says whether no number of the linkage and of these was rounded.
///
/// # Errors
/// For empty ranges, and as [`solve`].
pub fn sweep_sphere(
    linkage: &SphereLinkage,
    (given, exact): (&[SphereGiven], bool),
    joint: usize,
    range: Range,
) -> Result<SphereSweep> {
    let held: Vec<SphereGiven> = given.iter().filter(|one| one.joint != Some(joint)).cloned().collect();
    let axis = &linkage.joints[joint].at[0];
    let proof = SphereDyads::of(linkage, &held, joint).and_then(Proof::on_sphere);
    let run = Run { linkage, joint, held, start: start(linkage, joint), square: dot(axis, axis), proof };
    let is_full_turn = ((range.to - range.from).abs() - TAU).abs() < 1e-12;
    let mut sweep = follow(&run, joint, range, is_full_turn, || ())?;
    if let [first, rest @ ..] = sweep.samples.as_slice()
        && first.status == Status::Incomplete
        && rest.iter().all(|sample| sample.status == Status::Incomplete)
    {
        return Err(Error::Unsupported(first.reason.clone()));
    }
    sweep.verdict.proof = sweep.verdict.proof.of_rounded(!exact);
    Ok(sweep)
}

/// The direction of a point of a body in an assembly.
#[must_use]
pub fn place(mode: &SphereMode, body: usize, point: &[Rational; 3]) -> [f64; 3] {
    let p = point.each_ref().map(nearest_f64);
    mode.bodies[body].map(|row| row.iter().zip(p).map(|(c, x)| c.re * x).sum())
}
