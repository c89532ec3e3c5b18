//! The proof of a sweep of a linkage of dyads: docs/exact.md, theorem 7.
//!
//! Between two critical inputs no dyad of a real assembly is stretched or folded, so that the signs of its dyads name an assembly and
//! stay along its branch. At a critical input the multiplicity of the root says how many dyads can be stretched there.

mod critical;
mod form;

use super::assemblies::{AssemblySample, Link};
use super::linking::Linking;
use super::sphere::half_tangent;
use crate::algebra::number::{Angle, HalfTangent};
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Given, Linkage, Pair};
use crate::linkage::answer::LinkageMode;
use crate::linkage::dyads::Dyads;
use crate::linkage::laurent::Laurent;
use crate::linkage::sphere::{SphereDyads, SphereMode};
use crate::verdict::Code;
use critical::{Count, Counted, Critical, Criticals, Reading};
use form::Form;
use rug::Rational;
use std::collections::BTreeSet;

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

impl<M> Linking<M> for Proof<M> {
    fn variable(&self) -> Variable {
        if self.criticals.is_turn() { Variable::Rotation } else { Variable::Translation }
    }

    fn criticals(&self) -> Vec<f64> {
        self.criticals.list.iter().map(|critical| critical.value).collect()
    }

    fn because(&self) -> &'static str {
        "between all critical inputs, the real roots of exact polynomials, no dyad is stretched or folded, so that the signs of its dyads \
         name every assembly; at each critical input the multiplicity of the root says which end"
    }

    fn link(&self, samples: [&Sample<M>; 2], to: f64) -> std::result::Result<Link, Code> {
        let signs = |sample: &Sample<M>| -> Option<Vec<Signs>> {
            sample.modes.iter().map(|mode| (self.signs)(mode, sample.input)).collect()
        };
        let [Some(from), Some(into)] = samples.map(signs) else { return Err(Code::BranchesNotMatched) };
        self.link_of_signs([samples[0].input, to], [&from, &into])
    }
}

impl<M> Proof<M> {
    /// Returns how assemblies with these signs at two inputs pass into each other.
    fn link_of_signs(&self, [from, to]: [f64; 2], signs: [&[Signs]; 2]) -> std::result::Result<Link, Code> {
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
    fn crossed(
        &self,
        critical: &Critical,
        [from, to]: &[BTreeSet<&Signs>; 2],
    ) -> std::result::Result<Option<usize>, Code> {
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
