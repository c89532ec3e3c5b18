//! The proof of a sweep of assemblies: the inputs that are looked at, beside all critical ones, and the links between neighbours.

use super::Range;
use super::assemblies::{AssemblySample, Link, Proved};
use crate::algebra::sort;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::verdict::Code;
use rayon::prelude::*;

/// Assemblies are looked at this far on both sides of a critical input, in radians or parts of the range: two that meet there are
/// the square root of that apart.
const REACH: f64 = 1e-9;
/// A part of the distance to the next critical input.
const PART: f64 = 0.25;
/// The least of these distances: f64 has room for the sides.
const LEAST: f64 = 1e-13;
/// Inputs are no farther apart than this, in radians.
const LONGEST: f64 = 1.5;

/// What proves how assemblies pass from input to input.
pub(super) trait Linking<M>: Send + Sync {
    /// Whether the input is an angle or a distance.
    fn variable(&self) -> Variable;

    /// The critical inputs, between which no branch begins or ends: angles in (-pi, pi], or metres.
    fn criticals(&self) -> Vec<f64>;

    /// How the assemblies of a sample pass into those of the next one, with one critical input between them at most. The second sample
    /// may be that of `to` a turn on.
    ///
    /// # Errors
    /// The reason where this is not proved.
    fn link(&self, samples: [&AssemblySample<M>; 2], to: f64) -> std::result::Result<Link, Code>;

    /// Why the branches are proved, in words.
    fn because(&self) -> &'static str;
}

/// Returns the samples with those beside all critical inputs, and how the assemblies of each pass into those of the next one.
pub(super) fn links<M: Clone + Send + Sync>(
    proof: &dyn Linking<M>,
    range: Range,
    is_full_turn: bool,
    samples: &[AssemblySample<M>],
    sample: impl Fn(f64) -> Result<AssemblySample<M>> + Sync,
) -> Result<Proved<M>> {
    let Some(inputs) = inputs(proof, range, is_full_turn, samples) else {
        return Ok(Err(Code::SingularNotDecided));
    };
    let node = |(input, step): (f64, Option<usize>)| {
        let own = match step {
            Some(step) => samples[step].clone(),
            None => sample(input)?,
        };
        Ok((own, step))
    };
    let nodes: Vec<(AssemblySample<M>, Option<usize>)> = inputs.into_par_iter().map(node).collect::<Result<_>>()?;
    if nodes.iter().any(|(own, _)| !own.is_regular) {
        return Ok(Err(Code::BranchesNotMatched));
    }
    let mut links = Vec::new();
    for pair in nodes.windows(2) {
        match proof.link([&pair[0].0, &pair[1].0], pair[1].0.input) {
            Ok(link) => links.push(link),
            Err(code) => return Ok(Err(code)),
        }
    }
    if let (true, Some((first, _)), Some((last, _))) = (is_full_turn, nodes.first(), nodes.last()) {
        match proof.link([last, first], first.input + (range.to - range.from)) {
            Ok(link) => links.push(Link { is_ring: true, ..link }),
            Err(code) => return Ok(Err(code)),
        }
    }
    Ok(Ok((nodes, links)))
}

/// Returns the inputs to look at, with the steps whose samples they are, in the order of the sweep.
fn inputs<M>(
    proof: &dyn Linking<M>,
    range: Range,
    is_full_turn: bool,
    samples: &[AssemblySample<M>],
) -> Option<Vec<(f64, Option<usize>)>> {
    let is_turn = proof.variable() == Variable::Rotation;
    let all = range.turned(&proof.criticals(), proof.variable());
    let span = (range.to - range.from).abs();
    let whole = if is_turn { 1.0 } else { span };
    let mut reaches = Vec::new();
    for (k, input) in all.iter().enumerate() {
        let others = all.iter().enumerate().filter(|(j, _)| *j != k).map(|(_, other)| (other - input).abs());
        let ends = [range.from, range.to].map(|end| (end - input).abs());
        let ends = ends.into_iter().filter(|gap| *gap > 0.0 && !is_full_turn);
        let gap = others.chain(ends).fold(f64::INFINITY, f64::min);
        let reach = (REACH * whole).min(PART * gap);
        if reach < LEAST * (1.0 + input.abs()) {
            return None;
        }
        reaches.push(reach);
    }
    let is_in = |input: f64| (input - range.from) * (input - range.to) <= 0.0;
    let is_beside = |input: f64| all.iter().zip(&reaches).any(|(one, reach)| (one - input).abs() <= 2.0 * reach);
    let steps = samples.iter().enumerate().map(|(step, sample)| (sample.input, Some(step)));
    let steps = steps.filter(|(input, _)| !is_beside(*input));
    let sides = all.iter().zip(&reaches).flat_map(|(one, reach)| [one - reach, one + reach]);
    let sides = sides.filter(|input| is_in(*input)).map(|input| (input, None));
    let mut inputs: Vec<(f64, Option<usize>)> = steps.chain(sides).collect();
    let forward = range.to > range.from;
    sort::by(&mut inputs, |a, b| if forward { a.0.total_cmp(&b.0) } else { b.0.total_cmp(&a.0) });
    if !is_turn {
        return Some(inputs);
    }
    let mut filled: Vec<(f64, Option<usize>)> = Vec::new();
    for (input, step) in inputs {
        if let Some((last, _)) = filled.last().copied() {
            let mut parts = 1.0;
            while (input - last).abs() > LONGEST * parts {
                parts += 1.0;
            }
            let mut k = 1.0;
            while k < parts {
                filled.push((last + (input - last) * (k / parts), None));
                k += 1.0;
            }
        }
        filled.push((input, step));
    }
    Some(filled)
}
