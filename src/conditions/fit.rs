//! Relations among terms fitted to mobile members over one small prime field.

use super::configurations::configurations;
use super::curve_ansatz::canonical;
use super::finite_field::{random_unit, square_root};
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::ModP;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::catalogue::ansatz::{Ansatz, Members};
use crate::error::{Error, Result};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::Rational;
use std::collections::BTreeMap;

/// The results of random members over one prime field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The prime.
    pub prime: u64,
    /// Number of random choices of the parameters.
    pub draws: usize,
    /// Number of these choices by their number of mobile members.
    pub roots: BTreeMap<usize, usize>,
    /// The typical number: the degree of the condition in the unknown.
    pub typical: usize,
    /// Number of mobile members used in the fit.
    pub members: usize,
    /// The number of independent relations among the terms.
    pub relations: usize,
}

/// A symbol that runs through the field while the others are drawn: its index among the free ones of its kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// A half-angle tangent.
    Tangent(usize),
    Length(usize),
}

/// Returns the places of the unknown symbols, lengths first.
pub(super) fn unknown_places(ansatz: &Ansatz) -> Vec<Place> {
    let lengths = ansatz.free_lengths();
    let angles = ansatz.free_angles();
    let place = |list: &[usize], k: &usize| list.iter().position(|other| other == k);
    let of_lengths = ansatz.unknown.iter().filter_map(|k| place(&lengths, k).map(Place::Length));
    of_lengths.chain(ansatz.unknown_angles.iter().filter_map(|k| place(angles, k).map(Place::Tangent))).collect()
}

/// Maximum number of choices of angles until the required square roots exist.
const TRIES: usize = 64;

/// A choice of all free parameters.
pub(super) struct Draw<F> {
    pub(super) tangents: Vec<F>,
    pub(super) lengths: Vec<F>,
}

impl<const P: u64> Draw<ModP<P>> {
    /// Makes a random choice. If square roots are needed and none of a few choices has them, it returns the last one.
    pub(super) fn random(ansatz: &Ansatz, members: &Members<'_, ModP<P>>, rng: &mut ChaCha8Rng) -> Self {
        let mut tangents: Vec<ModP<P>> = Vec::new();
        for _ in 0..TRIES {
            tangents = ansatz.free_angles().iter().map(|_| random_unit(rng)).collect();
            if !ansatz.has_solved_symbols() || members.has_angles(&tangents) {
                break;
            }
        }
        Self { tangents, lengths: ansatz.free_lengths().iter().map(|_| random_unit(rng)).collect() }
    }

    /// Sets the running symbols to their values number `choice`.
    pub(super) fn set(&mut self, places: &[Place], choice: u64) {
        let mut rest = choice;
        for &place in places {
            let value = ModP::new(rest % P);
            match place {
                Place::Tangent(k) => self.tangents[k] = value,
                Place::Length(k) => self.lengths[k] = value,
            }
            rest /= P;
        }
    }
}

/// Returns the number of joint values of the symbols.
pub(super) fn choices<const P: u64>(places: &[Place]) -> u64 {
    P.pow(u32::try_from(places.len()).unwrap_or(u32::MAX))
}

/// Returns the random numbers of a draw.
pub(super) fn random<const P: u64>(seed: u64, number: usize) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed ^ (P << 32) ^ number as u64)
}

/// Converts the ansatz to a field.
pub(super) fn over<const P: u64>(ansatz: &Ansatz) -> Result<Members<'_, ModP<P>>> {
    ansatz.with_roots(|x| square_root(*x)).ok_or_else(unlucky::<P>)
}

/// Converts polynomials to a field.
pub(super) fn images<const P: u64>(polynomials: &[Polynomial<Rational>]) -> Result<Vec<Polynomial<ModP<P>>>> {
    polynomials.iter().map(|term| term.map(ModP::from_rational)).collect::<Option<_>>().ok_or_else(unlucky::<P>)
}

fn unlucky<const P: u64>() -> Error {
    Error::Unsupported(format!("a number of the ansatz that is a fraction modulo {P}"))
}

/// Returns the values of all symbols of the mobile members of a draw, for all values of the running symbols.
fn mobile<const P: u64>(
    members: &Members<'_, ModP<P>>,
    places: &[Place],
    mut draw: Draw<ModP<P>>,
) -> Vec<Vec<ModP<P>>> {
    let member = |choice: u64| {
        draw.set(places, choice);
        let values = members.values(&draw.tangents, &draw.lengths)?;
        moves(members, &values).then_some(values)
    };
    (0..choices::<P>(places)).filter_map(member).collect()
}

/// Returns whether a member has a family of configurations in which all joints move.
pub(super) fn moves<const P: u64>(members: &Members<'_, ModP<P>>, values: &[ModP<P>]) -> bool {
    let limit = usize::try_from(4 * P).unwrap_or(usize::MAX);
    members.links(values).is_some_and(|links| configurations(&links, limit).all_move())
}

/// The fraction of draws with mobile members.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scouted {
    /// Almost no draw has a mobile member.
    Rigid,
    /// Some members move.
    Some,
    /// Almost all members move.
    All,
}

/// Examines a few draws before many are made.
pub(super) fn scout<const P: u64>(ansatz: &Ansatz, places: &[Place], draws: usize, seed: u64) -> Result<Scouted> {
    let members = over::<P>(ansatz)?;
    let one =
        |number: usize| mobile(&members, places, Draw::random(ansatz, &members, &mut random::<P>(seed, number))).len();
    let found: Vec<usize> = (0..draws).into_par_iter().map(one).collect();
    let many = usize::try_from(choices::<P>(places) * 3 / 4).unwrap_or(usize::MAX);
    let all = found.iter().filter(|&&count| count > many).count();
    let some = found.iter().filter(|&&count| count > 0).count();
    Ok(match () {
        () if 4 * all >= 3 * draws => Scouted::All,
        () if 4 * some >= draws => Scouted::Some,
        () => Scouted::Rigid,
    })
}

/// Excess of members over terms, so that a relation among them is no accident.
const SURPLUS: usize = 12;
/// Number of random choices of parameters per required member before a sweep gives up.
const PATIENCE: usize = 4;

/// Fits the relations among the terms over one prime field.
pub(super) fn fit<const P: u64>(
    ansatz: &Ansatz,
    terms: &[Polynomial<Rational>],
    places: &[Place],
    seed: u64,
) -> Result<(Evidence, Vec<Vec<u64>>)> {
    let members = over::<P>(ansatz)?;
    let images = images::<P>(terms)?;
    let wanted = terms.len() + SURPLUS;
    let batch = wanted.div_ceil(2);
    let mut draws: Vec<Vec<Vec<ModP<P>>>> = Vec::new();
    let mut typical = 0;
    while draws.len() < PATIENCE * wanted {
        let start = draws.len();
        let one = |number| mobile(&members, places, Draw::random(ansatz, &members, &mut random::<P>(seed, number)));
        draws.par_extend((start..start + batch).into_par_iter().map(one));
        typical = usual(&draws);
        let kept = draws.iter().filter(|found| typical > 0 && found.len() == typical).count();
        if kept * typical >= wanted || draws.len() >= wanted && typical == 0 {
            break;
        }
    }
    let rows: Vec<Vec<ModP<P>>> = draws
        .iter()
        .filter(|found| typical > 0 && found.len() == typical)
        .flatten()
        .map(|values| images.iter().map(|term| term.evaluate(values)).collect())
        .collect();
    let space = if rows.len() < wanted { Vec::new() } else { null_space(&rows, terms.len()) };
    let mut roots = BTreeMap::new();
    for found in &draws {
        *roots.entry(found.len()).or_default() += 1;
    }
    let evidence =
        Evidence { prime: P, draws: draws.len(), roots, typical, members: rows.len(), relations: space.len() };
    Ok((evidence, space.iter().map(|vector| vector.iter().map(|x| x.value()).collect()).collect()))
}

/// Returns the number of mobile members of most draws, not counting draws with none.
fn usual<T>(draws: &[Vec<T>]) -> usize {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for found in draws.iter().filter(|found| !found.is_empty()) {
        *counts.entry(found.len()).or_default() += 1;
    }
    counts.into_iter().max_by_key(|&(_, count)| count).map_or(0, |(roots, _)| roots)
}

/// Number of subsets tried if a few members spoil the fit.
const SUBSETS: usize = 40;

/// Returns the null space of the rows. If there is none, it returns that of a subset on which most of the rows agree, as a few
/// members move by accident modulo a small prime.
fn null_space<const P: u64>(rows: &[Vec<ModP<P>>], columns: usize) -> Vec<Vec<ModP<P>>> {
    let whole = Echelon::of(rows.to_vec(), columns).null_space();
    if !whole.is_empty() {
        return canonical(whole);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(P);
    for _ in 0..SUBSETS {
        let chosen = rand::seq::index::sample(&mut rng, rows.len(), columns.min(rows.len()));
        let subset = chosen.into_iter().map(|i| rows[i].clone()).collect();
        let space = Echelon::of(subset, columns).null_space();
        let [vector] = space.as_slice() else { continue };
        let agrees =
            |row: &&Vec<ModP<P>>| row.iter().zip(vector).fold(ModP::zero(), |sum, (x, y)| sum.add(&x.mul(y))).is_zero();
        if 10 * rows.iter().filter(agrees).count() >= 9 * rows.len() {
            return canonical(space);
        }
    }
    Vec::new()
}
