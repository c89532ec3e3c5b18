//! All methods for a 5R or 6R loop with symbols, and their results.

use super::composed::Composed;
use super::curve_ansatz::{Curve, rational_curves};
use super::examples::{Example, examples};
use super::family::{Family, family};
use super::formulas::{Formulas, formulas};
use super::identity;
use super::implication::{Implication, implication};
use super::multiplier::{Multiplier, multiplier};
use super::pattern::{TwistPattern, patterns};
use super::sweep::{Sweep, sweep};
use super::symmetry::{Slice, SymmetricSlice, slices};
use super::verification::{
    Closed, ModularMembers, RationalMember, closed_positions, germ, held_member, modular_members, rational_member,
};
use crate::algebra::echelon::Echelon;
use crate::algebra::polynomial::Polynomial;
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::error::Result;
use crate::mobility::{Germ, Local};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;

/// A slice that moves for all lengths of its pattern.
#[derive(Clone, Debug)]
pub struct MobileSlice {
    /// The slice.
    pub slice: SymmetricSlice,
    /// The reason why it also moves for all twists of its pattern; `None` if random twists are the only evidence.
    pub proof: Option<String>,
}

impl MobileSlice {
    /// Returns whether a loop has this symmetry.
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
    /// The set of positions near one position of a member.
    pub germ: Germ<Rational>,
    /// Whether some of these lengths belong to a member of the ansatz with these twists.
    pub in_ansatz: bool,
    /// Whether all members of the ansatz with these twists have these lengths, up to a common factor.
    pub is_whole: bool,
    /// The formulas for all twists, if the ansatz leaves angles free and they were found.
    pub formulas: Option<Formulas>,
}

impl CurveLoop {
    /// Returns whether all joints move and no two axes coincide.
    #[must_use]
    pub fn is_proper(&self) -> bool {
        self.curves.iter().all(Curve::is_proper)
    }

    /// Returns whether it is a proper loop of the ansatz that is proved to move.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        self.in_ansatz && self.is_proper() && self.germ.local == Local::Curve
    }

    /// Returns whether it is all of the ansatz, and proved to move for all twists.
    #[must_use]
    pub fn is_proved_family(&self) -> bool {
        self.is_whole && self.is_proper() && self.formulas.as_ref().is_some_and(|formulas| formulas.proved)
    }
}

/// The curve ansatz at given twists.
#[derive(Clone, Debug)]
pub struct CurveSearch {
    /// The half-angle tangents of the twists.
    pub twists: Vec<Rational>,
    /// Whether the twists were chosen at random because the ansatz leaves them free.
    pub chosen: bool,
    /// The loops found.
    pub loops: Vec<CurveLoop>,
}

/// The fitted relations and the results derived from them.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// The sweep.
    pub sweep: Sweep,
    /// Random closed positions; for six joints.
    pub closed: Option<Closed>,
    /// The ansatz with the relations, if they can be solved.
    pub family: Option<Family>,
    /// A member over the rationals; for six joints.
    pub member: Option<RationalMember>,
    /// Random members over large prime fields; for six joints.
    pub modular: Option<ModularMembers>,
    /// The reason why no real numbers satisfy the relations, if that is proved.
    pub empty: Option<String>,
    /// A proof for the family.
    pub proof: Option<FamilyProof>,
}

/// A proof of mobility for all parameters.
#[derive(Clone, Debug)]
pub enum FamilyProof {
    /// By a multiplier.
    Multiplier(Multiplier),
    /// By an invariant.
    Implication(Implication),
}

impl FamilyProof {
    /// Finds a proof for the members of an ansatz of six joints that satisfy a condition, or for all of them.
    fn find(ansatz: &Ansatz, condition: Option<&Polynomial<Rational>>, seed: u64) -> Option<Self> {
        let replaced = ansatz.without_relations()?;
        let condition = condition.map(|condition| replaced.polynomial(condition));
        let multiplier = multiplier(&replaced.ansatz, condition.as_ref(), seed);
        multiplier.map(Self::Multiplier).or_else(|| implication(&replaced.ansatz, &condition?).map(Self::Implication))
    }

    /// Finds a proof for the members of an ansatz with relations, one of which may be the cause of their motion.
    fn of_all(ansatz: &Ansatz, seed: u64) -> Option<Self> {
        let with_condition = |number: usize| {
            let (ansatz, condition) = ansatz.without_relation(number)?;
            Self::find(&ansatz, Some(&condition), seed)
        };
        Self::find(ansatz, None, seed).or_else(|| (0..ansatz.relations.len()).find_map(with_condition))
    }
}

/// The results of all methods.
#[derive(Clone, Debug)]
pub struct Search {
    /// Number of slices examined.
    pub slices: usize,
    /// The mobile slices.
    pub mobile_slices: Vec<MobileSlice>,
    /// The families made of Bennett loops, if all parameters are symbols.
    pub composed: Vec<Composed>,
    /// Loops of the library that may belong to the families, if all parameters are symbols.
    pub examples: Vec<Example>,
    /// The curve ansatz, for five joints.
    pub curves: Option<CurveSearch>,
    /// The sweep and fit, if a length is unknown.
    pub fitted: Option<Fitted>,
    /// A member that satisfies all relations of the file, if no symbol is unknown; for six joints.
    pub member: Option<RationalMember>,
    /// Random members over large prime fields that satisfy all relations.
    pub modular: Option<ModularMembers>,
    /// A proof that all members move.
    pub proof: Option<FamilyProof>,
    /// The symmetric families to which the twists of the ansatz belong.
    pub patterns: Vec<TwistPattern>,
}

/// The prime for the slices.
pub const SLICE_PRIME: u64 = 23;
/// Number of random closed positions examined.
const CLOSED: usize = 64;
/// Number of random members over each large prime field.
const MEMBERS: usize = 8;
/// Number of draws for a member over the rationals.
const DRAWS: usize = 60_000;

/// Applies every method suited to the ansatz.
///
/// # Errors
/// [`crate::error::Error::Unsupported`] for loops of other than five or six joints, and for six joints without symbols.
pub fn search(ansatz: &Ansatz, seed: u64) -> Result<Search> {
    let joints = ansatz.joints.len();
    let unsupported = |message: &str| Err(crate::error::Error::Unsupported(message.to_owned()));
    if !(5..=6).contains(&joints) {
        return unsupported(&format!("a search for conditions of {joints} joints, expected five or six"));
    }
    let free = ansatz.free_angles().len() + ansatz.free_lengths().len();
    if joints == 6 && free == 0 {
        return unsupported(
            "conditions of a loop of six joints without symbols: there is nothing to derive; whether it moves, \
             `looproot mobility` decides",
        );
    }
    let is_special = free < 3 * joints;
    let has_unknown = !ansatz.unknown.is_empty() || !ansatz.unknown_angles.is_empty();
    let all = slices::<SLICE_PRIME>(joints, seed);
    let looked_at = all.len();
    let mobile = all.into_iter().filter(|slice| matches!(slice.slice, Slice::Mobile | Slice::Folded));
    let mobile_slices: Vec<MobileSlice> =
        mobile.map(|slice| MobileSlice { proof: identity::proof(&slice), slice }).collect();
    let fitted = if has_unknown { Some(fitted(ansatz, seed)?) } else { None };
    // With the fitted relations the curves belong to the family.
    let of_family = fitted.as_ref().and_then(Fitted::all_relations);
    let curves = (joints == 5).then(|| curve_search(of_family.as_ref().unwrap_or(ansatz), seed)).flatten();
    let as_it_is = joints == 6 && !has_unknown && is_special;
    let member = as_it_is.then(|| rational_member(ansatz, &[], DRAWS, seed)).flatten();
    let held = (as_it_is && !moves(member.as_ref())).then(|| held_member(ansatz, seed)).flatten();
    let member = held.or(member);
    let modular = as_it_is.then(|| modular_members(ansatz, &[], MEMBERS, seed));
    let proof = if as_it_is { FamilyProof::of_all(ansatz, seed) } else { None };
    let (composed, examples) =
        if is_special { (Vec::new(), Vec::new()) } else { (Composed::all(joints), examples(joints)) };
    let patterns = if is_special { patterns(ansatz, &mobile_slices) } else { Vec::new() };
    Ok(Search {
        slices: looked_at,
        mobile_slices,
        composed,
        examples,
        curves,
        fitted,
        member,
        modular,
        proof,
        patterns,
    })
}

impl Fitted {
    /// Returns the ansatz with all fitted relations that are linear in lengths or equations between angles.
    fn all_relations(&self) -> Option<Ansatz> {
        let family = self.family.as_ref()?;
        let Some(condition) = &family.condition else { return Some(family.ansatz.clone()) };
        let meaning = crate::catalogue::ansatz::Meaning::Polynomial(condition.clone());
        family.ansatz.satisfying(vec![meaning], Vec::new(), Vec::new())
    }
}

fn fitted(ansatz: &Ansatz, seed: u64) -> Result<Fitted> {
    let sweep = sweep(ansatz, seed)?;
    let family = if sweep.relations.is_empty() { None } else { family(ansatz, &sweep.relations) };
    let empty = sweep.relations.iter().find_map(|relation| ansatz.without_real_solution(relation));
    let mut fitted = Fitted { sweep, closed: None, family, member: None, modular: None, empty, proof: None };
    if ansatz.joints.len() != 6 {
        return Ok(fitted);
    }
    if fitted.sweep.always {
        fitted.member = rational_member(ansatz, &[], DRAWS, seed);
        fitted.modular = Some(modular_members(ansatz, &[], MEMBERS, seed));
        fitted.proof = FamilyProof::of_all(ansatz, seed);
    }
    let Some(Family { ansatz, condition, .. }) = &fitted.family else { return Ok(fitted) };
    let conditions: Vec<Polynomial<Rational>> = condition.iter().cloned().collect();
    fitted.member = rational_member(ansatz, &conditions, DRAWS, seed);
    fitted.modular = Some(modular_members(ansatz, &conditions, MEMBERS, seed));
    if !moves(fitted.member.as_ref())
        && let Some(member) = fitted.all_relations().and_then(|all| held_member(&all, seed))
    {
        fitted.member = Some(member);
    }
    if condition.is_some() {
        fitted.closed = closed_positions(ansatz, &conditions, CLOSED, seed);
    }
    fitted.proof = FamilyProof::find(ansatz, condition.as_ref(), seed);
    Ok(fitted)
}

/// Returns whether a member is proved to move.
fn moves(member: Option<&RationalMember>) -> bool {
    member.is_some_and(|member| member.germ.local == Local::Curve)
}

/// Applies the curve ansatz at the twists of the ansatz, with random free angles.
fn curve_search(ansatz: &Ansatz, seed: u64) -> Option<CurveSearch> {
    let members = ansatz.over::<Rational>()?;
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let tangent = |_: &usize| Rational::from((rng.random_range(1..8), rng.random_range(8..14)));
    let tangents: Vec<Rational> = ansatz.free_angles().iter().map(tangent).collect();
    let free = ansatz.free_lengths().len();
    let at = |lengths: &[Rational]| members.member(&tangents, lengths);
    let zero = vec![Rational::new(); free];
    let links = at(&zero)?;
    let half = |link: &Link<Rational>| {
        let cos = Rational::from(&link.cos + 1);
        (!cos.is_zero()).then(|| Rational::from(&link.sin / &cos))
    };
    let twists: Vec<Rational> = links.iter().map(half).collect::<Option<_>>()?;
    let own = |links: &[Link<Rational>]| -> Vec<Rational> {
        links.iter().map(|link| link.a.clone()).chain(links.iter().map(|link| link.d.clone())).collect()
    };
    // The lengths of the members with these twists: one vector for each free length, and a constant one to which they are added.
    let constant = own(&links);
    let mut family = Vec::new();
    for k in 0..free {
        let mut unit = zero.clone();
        unit[k] = Rational::from(1);
        let lengths = own(&at(&unit)?);
        family.push(lengths.iter().zip(&constant).map(|(x, c)| Rational::from(x - c)).collect::<Vec<_>>());
    }
    let mut loops: Vec<CurveLoop> = Vec::new();
    for curve in rational_curves(&twists) {
        if let Some(known) = loops.iter_mut().find(|known| known.lengths == curve.lengths) {
            known.curves.push(curve);
            continue;
        }
        // A member with general lengths among those that close, in one of the positions found.
        let common = in_common(&family, &constant, &curve.lengths);
        let in_ansatz = common.is_some();
        let is_whole = in_ansatz
            && curve.lengths.len() == 1
            && constant.iter().all(Rational::is_zero)
            && Echelon::of(family.clone(), constant.len()).rank() == 1;
        let general = || {
            let sum = |k: usize| (1..).zip(&curve.lengths).map(|(w, vector)| Rational::from(&vector[k] * w)).sum();
            (0..10).map(sum).collect()
        };
        let lengths: Vec<Rational> = common.unwrap_or_else(general);
        let mut member = links.clone();
        for (link, (a, d)) in member.iter_mut().zip(lengths.iter().zip(&lengths[5..])) {
            (link.a, link.d) = (a.clone(), d.clone());
        }
        let germ = germ(&member, curve.points.first()?);
        loops.push(CurveLoop {
            lengths: curve.lengths.clone(),
            curves: vec![curve],
            germ,
            in_ansatz,
            is_whole,
            formulas: None,
        });
    }
    // Formulas contain free symbols only.
    let is_plain =
        |found: &&mut CurveLoop| found.is_proper() && found.lengths.len() == 1 && !ansatz.has_solved_symbols();
    for found in loops.iter_mut().filter(is_plain) {
        found.formulas = found.curves.iter().find_map(|curve| formulas(ansatz, &tangents, curve, seed));
    }
    Some(CurveSearch { chosen: !tangents.is_empty(), twists, loops })
}

/// Returns a nonzero vector of a space that is a constant and a combination of others; `None` if there is none.
fn in_common(others: &[Vec<Rational>], constant: &[Rational], space: &[Vec<Rational>]) -> Option<Vec<Rational>> {
    let columns: Vec<&[Rational]> =
        space.iter().map(Vec::as_slice).chain(others.iter().map(Vec::as_slice)).chain([constant]).collect();
    let rows = (0..constant.len()).map(|i| columns.iter().map(|column| column[i].clone()).collect::<Vec<_>>());
    let mut sum = vec![Rational::new(); columns.len()];
    for (weight, vector) in (1..).zip(Echelon::of(rows.collect(), columns.len()).null_space()) {
        for (total, x) in sum.iter_mut().zip(&vector) {
            *total += Rational::from(x * weight);
        }
    }
    let has_constant = constant.iter().any(|c| !c.is_zero());
    let scale = if has_constant { Rational::from(-sum.last()?) } else { Rational::from(1) };
    if scale.is_zero() {
        return None;
    }
    let vector: Vec<Rational> = (0..constant.len())
        .map(|i| {
            let combination: Rational = space.iter().zip(&sum).map(|(vector, c)| Rational::from(&vector[i] * c)).sum();
            combination / &scale
        })
        .collect();
    vector.iter().any(|x| !x.is_zero()).then_some(vector)
}
