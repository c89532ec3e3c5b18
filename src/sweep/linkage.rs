//! All assemblies of a linkage while one of its joints runs through a range.

use super::Range;
use super::assemblies::{AssemblySample, AssemblySweep, Proved, Running, follow, is_listed};
use super::dyads::Proof;
use crate::algebra::number::Angle;
use crate::algebra::ring::exact_cos_sin;
use crate::assembly::wrapped;
use crate::error::{Error, Result};
use crate::kinematics::linkage::{Accuracy, Gaussian, Given, Linkage, Pair};
use crate::linkage::answer::{LinkageMode, solve};
use crate::linkage::limits::complex_limits;
use crate::verdict::Code;
use num_complex::Complex;
use rug::Rational;
use std::f64::consts::TAU;

/// A body at this many times the size of the linkage is on its way to infinity.
const FAR: f64 = 1e6;

/// The result of a sweep of a linkage.
pub type LinkageSweep = AssemblySweep<LinkageMode>;

/// A joint that runs, while other values are given.
struct Run<'a> {
    linkage: &'a Linkage,
    joint: usize,
    held: Vec<Given>,
    /// The size of the linkage: places are compared in parts of it.
    size: f64,
    /// Where the linkage consists of dyads.
    proof: Option<Proof<LinkageMode>>,
}

impl Run<'_> {
    fn given(&self, input: f64) -> Result<Vec<Given>> {
        let (joint, line) = (self.joint, 1);
        let own = match &self.linkage.joints[joint].pair {
            Pair::Revolute => {
                let (re, im) = exact_cos_sin(&Angle::from_radians(input));
                Given::Turn { joint, turn: Gaussian { re, im }, within: None, line }
            }
            Pair::Prismatic { length, .. } => {
                let metres = Rational::from_f64(input);
                let metres =
                    metres.ok_or_else(|| Error::Invalid(format!("found the input {input}, expected a number")))?;
                Given::Shift { joint, shift: metres / length, line }
            }
            Pair::Gear { .. } => {
                return Err(Error::Invalid("found gears as the input, expected a joint with a value".to_owned()));
            }
        };
        Ok(self.held.iter().cloned().chain([own]).collect())
    }
}

impl Running for Run<'_> {
    type Mode = LinkageMode;
    type Memory = ();

    fn sample(&self, input: f64, (): &mut ()) -> Result<AssemblySample<LinkageMode>> {
        let answer = solve(self.linkage, &self.given(input)?, Accuracy::Exact)?;
        let status = answer.verdict.status;
        let modes: Vec<LinkageMode> = answer.modes.into_iter().filter(|mode| mode.real).collect();
        let is_regular = is_listed(status) && modes.iter().all(|mode| mode.multiplicity == 1);
        Ok(AssemblySample { input, status, reason: answer.verdict.reason, modes, is_regular })
    }

    /// The distance of two assemblies: the largest turn or step of a body. Steps are parts of the size, or of the distance of a body
    /// on its way to infinity: all steps there would else be too large, however short they are. Very far away its direction counts.
    fn apart(&self, one: &LinkageMode, two: &LinkageMode) -> f64 {
        one.bodies.iter().zip(&two.bodies).fold(0.0, |worst, ((angle, place), (other, at))| {
            let turn = wrapped(angle.re - other.re).abs();
            let [here, there] = [place, at].map(|p| [p[0].re, p[1].re]);
            let [one, two] = [here, there].map(|[x, y]| x.hypot(y));
            let scale = if one.min(two) > FAR * self.size { [one, two] } else { [self.size.max(one.min(two)); 2] };
            let step = (here[0] / scale[0] - there[0] / scale[1]).hypot(here[1] / scale[0] - there[1] / scale[1]);
            worst.max(turn).max(step)
        })
    }

    /// The assembly between two that are nearly one.
    fn middle(&self, one: &LinkageMode, two: &LinkageMode) -> LinkageMode {
        let between = |a: f64, b: f64, is_turn: bool| {
            if is_turn { wrapped(a + 0.5 * wrapped(b - a)) } else { 0.5 * (a + b) }
        };
        let mut mode = one.clone();
        for ((own, (angle, place)), (other, at)) in mode.bodies.iter_mut().zip(&one.bodies).zip(&two.bodies) {
            own.0 = Complex::new(between(angle.re, other.re, true), 0.0);
            own.1 = [0, 1].map(|k| Complex::new(between(place[k].re, at[k].re, false), 0.0));
        }
        for (own, other) in mode.joints.iter_mut().zip(&two.joints) {
            if let (Some(own), Some(other)) = (own, other) {
                // Displacements that are nearly one are nearer than a half turn.
                let step = if (other.re - own.re).abs() > 1.0 { wrapped(other.re - own.re) } else { other.re - own.re };
                *own = Complex::new(own.re + 0.5 * step, 0.0);
            }
        }
        mode
    }

    fn proved(&self, range: Range, is_full_turn: bool, samples: &[AssemblySample<LinkageMode>]) -> Result<Proved<LinkageMode>> {
        match &self.proof {
            Some(proof) => proof.links(range, is_full_turn, samples, |input| self.sample(input, &mut ())),
            None => Ok(Err(Code::NoExactRoute)),
        }
    }
}

/// Sweeps a joint of a linkage, on all threads of the current pool, while the other given values are held. `accuracy` says what is
/// known of the numbers of the linkage and of the values.
///
/// # Errors
/// [`Error::Invalid`] for empty ranges and gears; as [`solve`].
pub fn sweep_linkage(
    linkage: &Linkage,
    (given, accuracy): (&[Given], Accuracy),
    joint: usize,
    range: Range,
    tick: impl Fn() + Sync,
) -> Result<LinkageSweep> {
    let held = held_beside(given, joint);
    let proof = Proof::of(linkage, &held, joint);
    let points = linkage.bodies.iter().flat_map(|body| &body.points);
    let size = points.map(|(_, at)| at.re.to_f64().hypot(at.im.to_f64())).fold(1e-9, f64::max);
    let run = Run { linkage, joint, held, size, proof };
    let turn = !linkage.joints[joint].is_prismatic();
    let is_full_turn = turn && ((range.to - range.from).abs() - TAU).abs() < 1e-12;
    let mut sweep = follow(&run, joint, range, is_full_turn, tick)?;
    sweep.verdict.proof = sweep.verdict.proof.of_rounded(is_rounded(&run.held, accuracy));
    Ok(sweep)
}

/// Counts the complex limit positions of a sweep, which may take longer than the sweep.
pub fn count_limits(sweep: &mut LinkageSweep, linkage: &Linkage, (given, accuracy): (&[Given], Accuracy)) {
    let held = held_beside(given, sweep.joint);
    sweep.complex_limits = if is_rounded(&held, accuracy) { None } else { complex_limits(linkage, &held, sweep.joint) };
}

/// The values that are held while a joint runs.
fn held_beside(given: &[Given], joint: usize) -> Vec<Given> {
    let is_other = |one: &&Given| !matches!(one, Given::Turn { joint: own, .. } | Given::Shift { joint: own, .. } if *own == joint);
    given.iter().filter(is_other).cloned().collect()
}

/// Whether numbers of the file or of the held values are rounded.
fn is_rounded(held: &[Given], accuracy: Accuracy) -> bool {
    match accuracy {
        Accuracy::Exact => false,
        Accuracy::Enclosed => held.iter().any(|one| matches!(one, Given::Turn { within: Some(_), .. })),
        Accuracy::Rounded => true,
    }
}
