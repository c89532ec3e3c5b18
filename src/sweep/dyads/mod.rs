//! The proof of a sweep of a linkage of dyads: docs/exact.md, theorem 7.
//!
//! Between two critical inputs no dyad of a real assembly is stretched or folded, so that the signs of its dyads name an assembly and
//! stay along its branch. At a critical input the multiplicity of the root says how many dyads can be stretched there.

mod critical;
mod form;

use super::Range;
use super::assemblies::{AssemblySample, Link, Proved};
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Given, Linkage, Pair};
use crate::linkage::answer::LinkageMode;
use crate::linkage::dyads::Dyads;
use crate::linkage::laurent::Laurent;
use crate::linkage::sphere::{SphereDyads, SphereMode};
use crate::verdict::Code;
use super::sphere::half_tangent;
use crate::algebra::number::{Angle, HalfTangent};
use critical::{Count, Counted, Critical, Criticals, Reading};
use form::Form;
use rug::Rational;
use std::collections::BTreeSet;

/// Assemblies are looked at this far on both sides of a critical input, in radians or parts of the range: two that meet there are
/// the square root of that apart.
const REACH: f64 = 1e-9;
/// A part of the distance to the next critical input.
const PART: f64 = 0.25;
/// The least of these distances: f64 has room for the sides.
const LEAST: f64 = 1e-13;
/// Inputs are no farther apart than this, in radians.
const LONGEST: f64 = 1.5;

type Sample<M> = AssemblySample<M>;
/// The signs of all dyads.
type Signs = Vec<bool>;
/// The signs of an assembly at an input; none where one is too close to 0.
type Signed<M> = Box<dyn Fn(&M, f64) -> Option<Signs> + Send + Sync>;

/// A linkage of dyads and its critical inputs.
pub(super) struct Proof<M> {
    signs: Signed<M>,
    criticals: Criticals,
}

/// Dyads in the plane, and the length of the direction of a displacement.
struct Plane<'a>(&'a Dyads, Rational);

impl Counted for Plane<'_> {
    const READING: Reading = |input, _| match Angle::from_radians(input).half_tangent() {
        HalfTangent::Finite(t) => Some(t.clone()),
        HalfTangent::Infinite => None,
    };

    fn squares(&self) -> Vec<Option<Rational>> {
        let angle = || Some(Rational::from(1));
        let input = if self.0.is_turn { angle() } else { None };
        std::iter::once(input).chain(self.0.list.iter().map(|_| angle())).collect()
    }

    fn length(&self) -> Rational {
        self.1.clone()
    }

    fn forms(&self, counts: &[Count]) -> Option<Vec<[Form; 2]>> {
        let forms = self.0.list.iter().map(|dyad| {
            let [a, b, c] = &dyad.equation;
            let y = |exponent| Laurent::power(dyad.variable, exponent);
            let equation = a.mul(&y(1)).add(b).add(&c.mul(&y(-1)));
            Some([Form::of(&dyad.discriminant, counts)?, Form::of(&equation, counts)?])
        });
        forms.collect()
    }
}

impl Counted for SphereDyads {
    const READING: Reading = half_tangent;

    fn squares(&self) -> Vec<Option<Rational>> {
        self.squares.iter().cloned().map(Some).collect()
    }

    fn length(&self) -> Rational {
        Rational::from(1)
    }

    fn forms(&self, counts: &[Count]) -> Option<Vec<[Form; 2]>> {
        let form = |function| Form::on_sphere(function, counts);
        self.list.iter().map(|dyad| Some([form(&dyad.discriminant)?, form(&dyad.equation)?])).collect()
    }
}

impl Proof<LinkageMode> {
    /// Returns what is needed for a proof; `None` for linkages that are no dyads, or whose polynomials are too large.
    pub fn of(linkage: &Linkage, held: &[Given], joint: usize) -> Option<Self> {
        let length = match &linkage.joints[joint].pair {
            Pair::Prismatic { length, .. } => length.clone(),
            _ => Rational::from(1),
        };
        let dyads = Dyads::of(linkage, held, joint)?;
        let part = length.to_f64();
        let criticals = Criticals::of(&Plane(&dyads, length))?;
        Some(Self { signs: Box::new(move |mode, input| dyads.signs(mode, input / part)), criticals })
    }
}

impl Proof<SphereMode> {
    /// Returns what is needed for a proof on the sphere; `None` where the polynomials are too large.
    pub fn on_sphere(dyads: SphereDyads) -> Option<Self> {
        let criticals = Criticals::of(&dyads)?;
        Some(Self { signs: Box::new(move |mode, _| dyads.signs(mode)), criticals })
    }
}

impl<M: Clone> Proof<M> {
    fn variable(&self) -> Variable {
        if self.criticals.is_turn() { Variable::Rotation } else { Variable::Translation }
    }

    /// Returns the samples with those beside all critical inputs, and how the assemblies of each pass into those of the next one.
    pub fn links(
        &self,
        range: Range,
        is_full_turn: bool,
        samples: &[Sample<M>],
        sample: impl Fn(f64) -> Result<Sample<M>>,
    ) -> Result<Proved<M>> {
        let Some(inputs) = self.inputs(range, is_full_turn, samples) else {
            return Ok(Err(Code::SingularNotDecided));
        };
        let mut nodes: Vec<(Sample<M>, Option<usize>)> = Vec::new();
        for (input, step) in inputs {
            let own = match step {
                Some(step) => samples[step].clone(),
                None => sample(input)?,
            };
            if !own.is_regular {
                return Ok(Err(Code::BranchesNotMatched));
            }
            nodes.push((own, step));
        }
        let signs = |(sample, _): &(Sample<M>, Option<usize>)| -> Option<Vec<Signs>> {
            sample.modes.iter().map(|mode| (self.signs)(mode, sample.input)).collect()
        };
        let Some(signs) = nodes.iter().map(signs).collect::<Option<Vec<_>>>() else {
            return Ok(Err(Code::BranchesNotMatched));
        };
        let mut links = Vec::new();
        for k in 1..nodes.len() {
            let ends = [nodes[k - 1].0.input, nodes[k].0.input];
            match self.link(ends, [&signs[k - 1], &signs[k]]) {
                Ok(link) => links.push(link),
                Err(code) => return Ok(Err(code)),
            }
        }
        if let (true, Some((first, _)), Some((last, _))) = (is_full_turn, nodes.first(), nodes.last()) {
            let ends = [last.input, first.input + (range.to - range.from)];
            match self.link(ends, [&signs[signs.len() - 1], &signs[0]]) {
                Ok(link) => links.push(Link { is_ring: true, ..link }),
                Err(code) => return Ok(Err(code)),
            }
        }
        Ok(Ok((nodes, links)))
    }

    /// Returns the inputs to look at, with the steps whose samples they are, in the order of the sweep.
    fn inputs(&self, range: Range, is_full_turn: bool, samples: &[Sample<M>]) -> Option<Vec<(f64, Option<usize>)>> {
        let values: Vec<f64> = self.criticals.list.iter().map(|critical| critical.value).collect();
        let all = range.turned(&values, self.variable());
        let span = (range.to - range.from).abs();
        let whole = if self.criticals.is_turn() { 1.0 } else { span };
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
        if !self.criticals.is_turn() {
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

    /// Returns how assemblies with these signs at two inputs pass into each other.
    fn link(&self, [from, to]: [f64; 2], signs: [&[Signs]; 2]) -> std::result::Result<Link, Code> {
        let inside = self.criticals.between(from, to).ok_or(Code::SingularNotDecided)?;
        let all: [BTreeSet<&Signs>; 2] = signs.map(|list| list.iter().collect());
        if all.iter().zip(signs).any(|(set, list)| set.len() != list.len()) {
            return Err(Code::BranchesNotMatched);
        }
        let place = |side: usize, wanted: &Signs| signs[side].iter().position(|own| own == wanted);
        let mut link = Link { passes: vec![None; signs[0].len()], folds: [Vec::new(), Vec::new()], is_ring: false };
        let flipped = match inside.as_slice() {
            [] if all[0] != all[1] => return Err(Code::BranchesNotMatched),
            [] => None,
            [index] => {
                let critical = &self.criticals.list[*index];
                link.folds = [0, 1].map(|side| {
                    let ends = all[side].difference(&all[1 - side]);
                    let dyad = critical.dyad.map_or(0, |(dyad, _)| dyad);
                    let pair = |own: &&Signs| {
                        let one = place(side, own)?;
                        own[dyad].then(|| place(side, &with(own, dyad)))?.map(|other| [one, other])
                    };
                    ends.filter_map(pair).collect()
                });
                self.crossed(critical, &all)?
            }
            _ => return Err(Code::SingularNotDecided),
        };
        for (own, pass) in signs[0].iter().zip(&mut link.passes) {
            *pass = place(1, &flipped.map_or_else(|| own.clone(), |dyad| with(own, dyad)));
        }
        Ok(link)
    }

    /// Returns the dyad whose sign changes on all branches that pass a critical input, if one does; the reason where it is not
    /// decided which pass.
    fn crossed(&self, critical: &Critical, [from, to]: &[BTreeSet<&Signs>; 2]) -> std::result::Result<Option<usize>, Code> {
        let (dyad, multiplicity) = critical.dyad.ok_or(Code::SingularNotDecided)?;
        let changed: BTreeSet<&Signs> = from.symmetric_difference(to).copied().collect();
        // The assemblies of the dyads below, at which this one opens or closes.
        let mut places: BTreeSet<Vec<bool>> = BTreeSet::new();
        for own in &changed {
            let side = if from.contains(*own) { from } else { to };
            // Both assemblies of the dyad end, or neither does.
            let other = with(own, dyad);
            if !side.contains(&other) || !changed.contains(&other) {
                return Err(Code::BranchesNotMatched);
            }
            places.insert(self.criticals.needed[dyad].iter().map(|below| own[*below]).collect());
        }
        if multiplicity < places.len() {
            return Err(Code::BranchesNotMatched);
        }
        if multiplicity - places.len() < 2 {
            return Ok(None);
        }
        // The discriminant depends on the input alone: J is a function of it that changes its sign as often as half the multiplicity.
        let is_node = self.criticals.needed[dyad].is_empty() && places.is_empty() && multiplicity.is_multiple_of(2);
        if is_node { Ok((multiplicity % 4 == 2).then_some(dyad)) } else { Err(Code::SingularNotDecided) }
    }
}

/// Signs with that of one dyad changed.
fn with(signs: &Signs, dyad: usize) -> Signs {
    let mut other = signs.clone();
    other[dyad] = !other[dyad];
    other
}
