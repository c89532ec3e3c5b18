//! The relation of an input of a planar linkage and the angle of a body, and the proof of a sweep by it: docs/exact.md, theorem 13.

use super::assemblies::{AssemblySample, Link};
use super::bridge::{Bridge, Fate};
use super::exact::{Ends, Exact};
use super::linking::Linking;
use super::track::Fold;
use crate::algebra::drawn;
use crate::derivation::{
    GroupPolynomial, InputOutput, LinkageDerivation, Watch, derive_linkage, derive_linkage_with_symbols,
    relation_by_values,
};
use crate::error::{Error, Result};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::linkage::{Gaussian, Given, Linkage};
use crate::linkage::answer::LinkageMode;
use crate::linkage::assembly::groups_of;
use crate::verdict::{Code, Proof};
use rug::Rational;
use std::sync::OnceLock;

/// Probability of error of a polynomial that is interpolated and compared at 20 places.
const ERROR: f64 = 1e-12;
/// Half tangents, or metres, at which assemblies are counted. Any numbers serve that are unlikely to be special.
const INPUTS: [(i32, i32); 3] = [(3, 7), (-5, 13), (17, 11)];
/// Bodies of a group beyond which no relation is looked for: its matrix would have more than C(6, 3) = 20 rows.
const MOST_BODIES: usize = 7;

/// A closure polynomial of a linkage in a value that moves it, or a coordinate, and the half tangent of the angle of a body.
pub(super) struct LinkageRelation {
    pub exact: Exact,
    /// The body, and that against which its angle is measured.
    bodies: [usize; 2],
    /// The name of the unknown.
    pub unknown: String,
    /// Whether it is interpolated without a bound of its degree.
    pub is_probable: bool,
    /// Whether every simple root is proved to have one assembly.
    pub proof: Proof,
}

/// Returns the polynomial on which all assemblies depend.
fn whole(derivation: &LinkageDerivation) -> Result<&GroupPolynomial> {
    let none = |what: &str| Error::Unsupported(format!("there is no closure polynomial {what}"));
    let best = derivation.polynomials.first().ok_or_else(|| none("of the linkage"))?;
    // The groups that the polynomial does not depend on have assemblies of their own.
    let all: usize = derivation.groups.iter().map(|(_, count)| count).product();
    if best.assemblies.is_some_and(|own| own != all) {
        return Err(none("on which all assemblies depend: the linkage has groups that are independent of each other"));
    }
    Ok(best)
}

/// Whether every root of a polynomial is simple and has one assembly; then a relation with as many roots has one assembly over each of
/// its roots, too. Over a simple root the matrix has a kernel of one dimension, hence one assembly at most: with as many of both every root has one. None of them is at
/// infinity where displacements are bounded.
fn is_matched(derivation: &LinkageDerivation, own: &GroupPolynomial, full: usize) -> bool {
    let is_simple = own.coefficients.gcd(&own.coefficients.derivative()).degree() == Some(0) && own.at_pi <= 1;
    own.is_proved() && is_simple && own.roots() == full && derivation.is_bounded
}

impl LinkageRelation {
    /// The relation of the first given joint and the output of a linkage, the others held; with the name of a coordinate of a point that
    /// relation with the coordinate as a symbol, interpolated, at the value of the joint.
    pub fn of(linkage: &Linkage, given: &[Given], coordinate: Option<&str>, watch: &Watch<'_>) -> Result<Self> {
        let derivation = derive_linkage(linkage, given)?;
        let best = whole(&derivation)?;
        let none = || {
            Error::Unsupported("the closure polynomial of the linkage vanishes for all values of an unknown".to_owned())
        };
        let (polynomial, kind, agrees) = match (coordinate, &derivation.input_output) {
            (Some(name), _) => {
                let found = derive_linkage_with_symbols(linkage, given, &[name.to_owned()], watch)?;
                let at_input = found.at_input(linkage, &given[0]).ok_or_else(none)?;
                (at_input, Variable::Translation, found.agrees)
            }
            (None, Some(relation)) => return Self::of_relation(linkage, &derivation, best, relation).ok_or_else(none),
            // Of a slide in a body that turns the determinant is not a polynomial in its displacement.
            (None, None) => {
                let own = relation_by_values(linkage, given, 0, (best.body, best.roots()), watch)?;
                (own, kind_of(given.first()), true)
            }
        };
        let full = polynomial.degree(1) as usize;
        let exact = Exact::of_polynomial(&polynomial, kind, Variable::Rotation, full).ok_or_else(none)?;
        let is_matched = agrees && is_matched(&derivation, best, full);
        let proof = if is_matched { Proof::Probable { error: ERROR, seed: drawn::seed() } } else { Proof::None };
        let bodies = [best.body, best.against];
        Ok(Self { exact, bodies, unknown: unknown(linkage, best), is_probable: true, proof })
    }

    /// The relation of the first given joint and the body of a polynomial; `None` where it vanishes for all values of an unknown.
    fn of_relation(
        linkage: &Linkage,
        derivation: &LinkageDerivation,
        own: &GroupPolynomial,
        relation: &InputOutput,
    ) -> Option<Self> {
        let InputOutput { polynomial, agrees, is_turn, .. } = relation;
        let full = polynomial.degree(1) as usize;
        let kind = if *is_turn { Variable::Rotation } else { Variable::Translation };
        let exact = Exact::of_polynomial(polynomial, kind, Variable::Rotation, full)?;
        let proof = if *agrees && is_matched(derivation, own, full) { Proof::Proved } else { Proof::None };
        let bodies = [own.body, own.against];
        Some(Self { exact, bodies, unknown: unknown(linkage, own), is_probable: false, proof })
    }
}

/// The name of the unknown of a polynomial.
fn unknown(linkage: &Linkage, own: &GroupPolynomial) -> String {
    format!("t_{}", linkage.bodies[own.body].name)
}

/// Whether a given value is an angle or a distance.
fn kind_of(given: Option<&Given>) -> Variable {
    if matches!(given, Some(Given::Turn { .. })) { Variable::Rotation } else { Variable::Translation }
}

/// The relations of an input and the angles of bodies, which prove how assemblies pass from input to input.
pub(super) struct BodyRelations {
    linkage: Linkage,
    given: Vec<Given>,
    derivation: LinkageDerivation,
    first: LinkageRelation,
    /// Relations of other bodies of the same group with the numbers of their polynomials; each is derived when it is first asked for.
    others: Vec<(usize, OnceLock<Option<LinkageRelation>>)>,
}

impl BodyRelations {
    /// The relations of a joint that runs, while other values are held; `None` where there is none that proves branches.
    pub fn of(linkage: &Linkage, held: &[Given], joint: usize) -> Option<Self> {
        let zero = if linkage.joints[joint].is_prismatic() {
            Given::Shift { joint, shift: Rational::new(), square: None, line: 1 }
        } else {
            let one = Gaussian { re: Rational::from(1), im: Rational::new() };
            Given::Turn { joint, turn: one, within: None, line: 1 }
        };
        INPUTS.iter().find_map(|value| {
            let own = zero.at(linkage, &Rational::from(*value))?;
            let given: Vec<Given> = std::iter::once(own).chain(held.iter().cloned()).collect();
            let groups = groups_of(linkage, &given).ok()?;
            // Gears have no relation that is proved, and their polynomials take long.
            if groups.list.iter().any(|group| group.clusters.len() > MOST_BODIES || !group.gears.is_empty()) {
                return None;
            }
            let derivation = derive_linkage(linkage, &given).ok()?;
            let best = whole(&derivation).ok()?;
            let first = LinkageRelation::of_relation(linkage, &derivation, best, derivation.input_output.as_ref()?)?;
            let is_beside = |k: &usize| derivation.polynomials[*k].group == best.group;
            let others = (1..derivation.polynomials.len()).filter(is_beside).map(|k| (k, OnceLock::new())).collect();
            (first.proof == Proof::Proved).then(|| Self { linkage: linkage.clone(), given, derivation, first, others })
        })
    }

    fn others(&self) -> impl Iterator<Item = &LinkageRelation> {
        let derive = |number: usize| {
            let relation = self.derivation.relation_to(&self.linkage, &self.given, number)?;
            let own = self.derivation.polynomials.get(number)?;
            LinkageRelation::of_relation(&self.linkage, &self.derivation, own, &relation)
                .filter(|relation| relation.proof == Proof::Proved)
        };
        self.others.iter().filter_map(move |(number, known)| known.get_or_init(|| derive(*number)).as_ref())
    }
}

/// The assemblies at two inputs, and the bodies whose angles tell them apart.
struct Assemblies<'a> {
    samples: [&'a AssemblySample<LinkageMode>; 2],
    bodies: [usize; 2],
}

impl Ends for Assemblies<'_> {
    fn inputs(&self) -> [f64; 2] {
        self.samples.map(|sample| sample.input)
    }

    fn outputs(&self, end: usize, _: usize) -> Vec<f64> {
        let [body, against] = self.bodies;
        self.samples[end].modes.iter().map(|mode| mode.bodies[body].0.re - mode.bodies[against].0.re).collect()
    }

    /// At a simple turning point both modes approach one assembly, since rotations are functions on a smooth curve.
    fn limit(&self, _: usize, _: [usize; 2]) -> std::result::Result<Option<Fold>, Code> {
        Ok(None)
    }
}

impl Linking<LinkageMode> for BodyRelations {
    fn variable(&self) -> Variable {
        self.first.exact.input
    }

    fn criticals(&self) -> Vec<f64> {
        self.first.exact.criticals()
    }

    fn because(&self) -> &'static str {
        "between all critical inputs, the real zeros of the discriminant of the exact closure polynomial, its real roots never meet, and \
         each has one assembly; at each critical input it is proved what the branches do"
    }

    /// Assemblies in which one body has the same angle may be told apart by that of another one.
    fn link(&self, samples: [&AssemblySample<LinkageMode>; 2], to: f64) -> std::result::Result<Link, Code> {
        let by = |relation: &LinkageRelation| {
            let bridge = relation.exact.bridge_between(&Assemblies { samples, bodies: relation.bodies }, to)?;
            link(&bridge)
        };
        by(&self.first).or_else(|code| self.others().find_map(|relation| by(relation).ok()).ok_or(code))
    }
}

/// A bridge as a link, where the fate of every assembly is known.
fn link(Bridge { forwards, backwards, .. }: &Bridge) -> std::result::Result<Link, Code> {
    let mut link = Link { passes: vec![None; forwards.len()], folds: [Vec::new(), Vec::new()], is_ring: false };
    for (side, fates) in [forwards, backwards].into_iter().enumerate() {
        for (mode, fate) in fates.iter().enumerate() {
            match fate {
                Fate::On(next, _) if side == 0 => link.passes[mode] = Some(*next),
                Fate::Back(other, _) if mode < *other => link.folds[side].push([mode, *other]),
                // The other end of a pass, and the second of two that meet.
                Fate::On(..) | Fate::Back(..) => {}
                Fate::Infinite(..) | Fate::Still | Fate::Lost => return Err(Code::SingularNotDecided),
            }
        }
    }
    Ok(link)
}
