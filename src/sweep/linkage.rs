//! All assemblies of a linkage while one of its joints runs through a range.

use super::Range;
use super::assemblies::{AssemblySample, AssemblySweep, Proved, Running, follow, is_far, is_listed, step};
use super::dyads::Proof;
use super::linkage_relation::BodyRelations;
use super::linking::{Linking, links};
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

/// The result of a sweep of a linkage.
pub type LinkageSweep = AssemblySweep<LinkageMode>;

/// A joint that runs, while other values are given.
struct Run<'a> {
    linkage: &'a Linkage,
    joint: usize,
    held: Vec<Given>,
    /// The size of the linkage: places are compared in parts of it.
    size: f64,
    /// By its dyads, or by the relation of the input and the angle of a body.
    proof: Option<Box<dyn Linking<LinkageMode>>>,
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
                Given::Shift { joint, shift: metres / length, square: None, line }
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

    /// The distance of two assemblies: the largest turn or step of a body.
    fn apart(&self, one: &LinkageMode, two: &LinkageMode) -> f64 {
        one.bodies.iter().zip(&two.bodies).fold(0.0, |worst, ((angle, place), (other, at))| {
            let turn = wrapped(angle.re - other.re).abs();
            let [here, there] = [place, at].map(|p| [p[0].re, p[1].re]);
            worst.max(turn).max(step(here, there, self.size))
        })
    }

    fn is_far(&self, mode: &LinkageMode) -> bool {
        mode.bodies.iter().any(|(_, place)| is_far([place[0].re, place[1].re], self.size))
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

    fn proved(
        &self,
        range: Range,
        is_full_turn: bool,
        samples: &[AssemblySample<LinkageMode>],
    ) -> Result<Proved<LinkageMode>> {
        match &self.proof {
            Some(proof) => links(&**proof, range, is_full_turn, samples, |input| self.sample(input, &mut ())),
            None => Ok(Err(Code::NoExactRoute)),
        }
    }

    fn because(&self) -> &'static str {
        self.proof.as_ref().map_or("", |proof| proof.because())
    }
}

/// What proves the branches, if anything does.
fn proof(linkage: &Linkage, held: &[Given], joint: usize) -> Option<Box<dyn Linking<LinkageMode>>> {
    if let Some(dyads) = Proof::of(linkage, held, joint) {
        return Some(Box::new(dyads));
    }
    Some(Box::new(BodyRelations::of(linkage, held, joint)?))
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
    let proof = proof(linkage, &held, joint);
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
        Accuracy::Squared | Accuracy::Rounded => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue::{Any, Options, builtin_any};
    use std::f64::consts::PI;

    type Limits = Vec<(f64, bool)>;
    type Turned = (Code, Limits, Vec<(f64, usize)>);

    /// The limit positions of a turn, and the beginnings of the branches with their circuits.
    fn turned(run: &Run<'_>, steps: usize) -> Turned {
        let range = Range { from: -PI, to: PI, steps };
        let sweep = follow(run, run.joint, range, true, || ()).unwrap();
        let limits = sweep.limits.iter().map(|limit| (limit.input, limit.is_largest)).collect();
        (sweep.verdict.code, limits, sweep.branches.iter().map(|branch| (branch.from, branch.circuit)).collect())
    }

    fn is_same(name: &str, [one, two]: [&Turned; 2]) {
        assert_eq!((one.1.len(), one.2.len()), (two.1.len(), two.2.len()), "{name}");
        for (own, other) in one.1.iter().zip(&two.1) {
            assert!((own.0 - other.0).abs() < 1e-6 && own.1 == other.1, "{name}: {own:?} {other:?}");
        }
        for (own, other) in one.2.iter().zip(&two.2) {
            assert!((own.0 - other.0).abs() < 1e-6 && own.1 == other.1, "{name}: {own:?} {other:?}");
        }
    }

    /// The branches by dyads and by the relation are the same; without dyads those by the relation and by distances.
    #[test]
    fn proofs_of_a_sweep_agree() {
        let mut compared = [0, 0];
        for name in ["four_bar_coupler", "watt_1", "watt_2", "stephenson_1", "stephenson_3", "stephenson_2", "3rrr"] {
            let Any::Linkage(file) = builtin_any(&format!("linkage/{name}"), &Options::default()).unwrap() else {
                panic!("{name}")
            };
            let (given, _) = file.given(&file.cases[0]);
            let joint = given[0].joint().unwrap();
            let linkage = &file.linkage;
            let held = held_beside(given, joint);
            let run = |proof| Run { linkage, joint, held: held.clone(), size: 1.0, proof };
            let relation = BodyRelations::of(linkage, &held, joint).map(|proof| Box::new(proof) as Box<dyn Linking<_>>);
            let dyads = Proof::of(linkage, &held, joint).map(|proof| Box::new(proof) as Box<dyn Linking<_>>);
            let Some(relation) = relation else { continue };
            let found = turned(&run(Some(relation)), 24);
            if found.0 == Code::SingularNotDecided && dyads.is_some() {
                continue;
            }
            assert_eq!(found.0, Code::BranchesProved, "{name}");
            compared[usize::from(dyads.is_none())] += 1;
            let steps = if dyads.is_some() { 24 } else { 120 };
            is_same(name, [&found, &turned(&run(dyads), steps)]);
        }
        assert!(compared[0] >= 2 && compared[1] == 2, "{compared:?}");
    }
}
