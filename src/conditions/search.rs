//! Everything that is tried on a 5R or 6R loop with symbols, and what came out.

use super::curve_ansatz::{Curve, rational_curves};
use super::identity;
use super::implication::{Implication, implication};
use super::multiplier::{Multiplier, multiplier};
use super::sweep::{Sweep, sweep};
use super::symmetry::{Slice, SymmetricSlice, slices};
use super::verification::{Closed, RationalMember, closed_positions, germ, rational_member};
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::error::Result;
use crate::mobility::Germ;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// A slice that moves for all lengths of its pattern.
#[derive(Clone, Debug)]
pub struct MobileSlice {
    /// The slice.
    pub slice: SymmetricSlice,
    /// Why it does so for all twists of its pattern too; `None` where random twists are all the evidence.
    pub proof: Option<String>,
}

impl MobileSlice {
    /// Whether a loop has this symmetry.
    #[must_use]
    pub fn contains(&self, links: &[Link<Rational>]) -> bool {
        let (involution, signs) = (&self.slice.involution, self.slice.signs);
        let maps = |negative: bool, from: &Rational, to: &Rational| {
            if negative { Rational::from(-from) == *to } else { from == to }
        };
        let is_mapped = |(k, link): (usize, &Link<Rational>)| {
            let (image, opposite) = (&links[involution.links[k]], &links[involution.joints[k]]);
            link.cos == image.cos
                && maps(signs.twist, &link.sin, &image.sin)
                && maps(signs.length, &link.a, &image.a)
                && maps(signs.offset, &link.d, &opposite.d)
        };
        links.len() == involution.links.len() && links.iter().enumerate().all(is_mapped)
    }
}

/// A 5R loop on a curve with tied joints.
#[derive(Clone, Debug)]
pub struct CurveLoop {
    /// The lengths, all a first, then all d, up to a common factor; one vector for each degree of freedom of the choice.
    pub lengths: Vec<Vec<Rational>>,
    /// All curves found that have these lengths, each with another tie.
    pub curves: Vec<Curve<Rational>>,
    /// What the positions near one position of a member form.
    pub germ: Germ<Rational>,
}

/// The curve ansatz at given twists.
#[derive(Clone, Debug)]
pub struct CurveSearch {
    /// The half-angle tangents of the twists.
    pub twists: Vec<Rational>,
    /// Whether these were chosen at random because the ansatz leaves them free.
    pub chosen: bool,
    /// The loops found.
    pub loops: Vec<CurveLoop>,
}

/// The fit of relations and what was made of it.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The sweep.
    pub sweep: Sweep,
    /// Random closed positions; for six joints.
    pub closed: Option<Closed>,
    /// A member over the rationals; for six joints.
    pub member: Option<RationalMember>,
    /// A proof for the family by a multiplier.
    pub multiplier: Option<Multiplier>,
    /// A proof for the family by an invariant.
    pub implication: Option<Implication>,
}

impl Fitted {
    /// Whether mobility is proved for all parameters.
    #[must_use]
    pub const fn is_proved(&self) -> bool {
        self.multiplier.is_some() || self.implication.is_some()
    }
}

/// What was tried and found.
#[derive(Clone, Debug)]
pub struct Search {
    /// Slices looked at.
    pub slices: usize,
    /// Those that move.
    pub mobile_slices: Vec<MobileSlice>,
    /// The curve ansatz, for five joints.
    pub curves: Option<CurveSearch>,
    /// The sweep and fit, where a length is unknown.
    pub fitted: Option<Fitted>,
    /// A member that satisfies all relations of the file, where no length is unknown; for six joints.
    pub member: Option<RationalMember>,
}

/// The prime of the slices.
pub const SLICE_PRIME: u64 = 23;
/// Random closed positions looked at.
const CLOSED: usize = 64;
/// Draws for a member over the rationals.
const DRAWS: usize = 60_000;

/// Tries everything that fits the ansatz.
///
/// # Errors
/// [`crate::error::Error::Unsupported`] for more than two unknown lengths and for loops of other than five or six joints.
pub fn search(ansatz: &Ansatz, seed: u64) -> Result<Search> {
    let joints = ansatz.joints.len();
    if !(5..=6).contains(&joints) {
        let message = format!("a search for conditions of {joints} joints, expected five or six");
        return Err(crate::error::Error::Unsupported(message));
    }
    let all = slices::<SLICE_PRIME>(joints, seed);
    let looked_at = all.len();
    let mobile = all.into_iter().filter(|slice| matches!(slice.slice, Slice::Mobile | Slice::Folded));
    let mobile_slices = mobile.map(|slice| MobileSlice { proof: identity::proof(&slice), slice }).collect();
    let curves = (joints == 5 && ansatz.unknown.is_empty()).then(|| curve_search(ansatz, seed)).flatten();
    let fitted = if ansatz.unknown.is_empty() { None } else { Some(fitted(ansatz, seed)?) };
    let only_relations = joints == 6 && ansatz.unknown.is_empty() && !ansatz.relations.is_empty();
    let member = only_relations.then(|| rational_member(ansatz, &[], DRAWS, seed)).flatten();
    Ok(Search { slices: looked_at, mobile_slices, curves, fitted, member })
}

fn fitted(ansatz: &Ansatz, seed: u64) -> Result<Fitted> {
    let sweep = sweep(ansatz, seed)?;
    let mut fitted = Fitted { sweep, closed: None, member: None, multiplier: None, implication: None };
    let relations = &fitted.sweep.relations;
    if ansatz.joints.len() == 6 && !relations.is_empty() {
        fitted.closed = closed_positions(ansatz, relations, CLOSED, seed);
        fitted.member = rational_member(ansatz, relations, DRAWS, seed);
        if let [relation] = relations.as_slice() {
            fitted.multiplier = multiplier(ansatz, relation, seed);
            fitted.implication = implication(ansatz, relation);
        }
    }
    Ok(fitted)
}

/// The curve ansatz at the twists of the ansatz, free angles chosen at random.
fn curve_search(ansatz: &Ansatz, seed: u64) -> Option<CurveSearch> {
    let members = ansatz.over::<Rational>()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let tangent = |_: &usize| Rational::from((rng.random_range(1..8), rng.random_range(8..14)));
    let tangents: Vec<Rational> = ansatz.free_angles().iter().map(tangent).collect();
    let zero = vec![Rational::new(); ansatz.free_lengths().len()];
    let links = members.member(&tangents, &zero)?;
    let half = |link: &Link<Rational>| {
        let cos = Rational::from(&link.cos + 1);
        (!cos.is_zero()).then(|| Rational::from(&link.sin / &cos))
    };
    let twists: Vec<Rational> = links.iter().map(half).collect::<Option<_>>()?;
    let mut loops: Vec<CurveLoop> = Vec::new();
    for curve in rational_curves(&twists) {
        if let Some(known) = loops.iter_mut().find(|known| known.lengths == curve.lengths) {
            known.curves.push(curve);
            continue;
        }
        // A member with general lengths among those that close, in one of the positions found.
        let mut member = links.clone();
        for (weight, vector) in (1..).zip(&curve.lengths) {
            for (link, (a, d)) in member.iter_mut().zip(vector.iter().zip(&vector[5..])) {
                link.a += Rational::from(a * weight);
                link.d += Rational::from(d * weight);
            }
        }
        let germ = germ(&member, curve.points.first()?);
        loops.push(CurveLoop { lengths: curve.lengths.clone(), curves: vec![curve], germ });
    }
    Some(CurveSearch { chosen: !tangents.is_empty(), twists, loops })
}
