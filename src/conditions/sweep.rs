//! Conditions for the mobility of an ansatz with free parameters: mobile members are sought over small prime fields, and
//! relations fitted to what they have in common.
//!
//! Parameters are drawn at random and the unknown lengths run through the whole field; members with a family of
//! configurations in which every joint moves are kept. The terms of a relation, evaluated at these, are linearly dependent.
//! What is found is a conjecture.

use super::configurations::configurations;
use super::curve_ansatz::canonical;
use super::finite_field::random_unit;
use super::lift;
use crate::algebra::echelon::Echelon;
use crate::algebra::modp::ModP;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::catalogue::ansatz::{Ansatz, Members, Symbols};
use crate::error::{Error, Result};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};
use std::collections::BTreeMap;

/// What a sweep found.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// For each prime, what the random members said.
    pub evidence: Vec<Evidence>,
    /// Relations with coprime integer coefficients that all mobile members satisfy; none where there are none among the
    /// terms.
    pub relations: Vec<Polynomial<Rational>>,
    /// The terms among which relations were sought.
    pub terms: usize,
    /// Fresh members looked at to try the relations; absent without relations.
    pub trial: Option<Trial>,
}

/// What random members over one prime field said.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Evidence {
    /// The prime.
    pub prime: u64,
    /// Random choices of the parameters.
    pub draws: usize,
    /// How many of these have how many mobile members.
    pub roots: BTreeMap<usize, usize>,
    /// The typical number: the degree of the condition in the unknown.
    pub typical: usize,
    /// Mobile members that relations were fitted to.
    pub members: usize,
    /// The number of independent relations among the terms.
    pub relations: usize,
}

/// Fresh members over another prime field, on the relations and off them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trial {
    /// The prime.
    pub prime: u64,
    /// Members that satisfy the relations.
    pub on: usize,
    /// How many of these have a family of configurations.
    pub mobile_on: usize,
    /// Members that do not.
    pub off: usize,
    /// How many of these have one.
    pub mobile_off: usize,
}

impl Trial {
    /// Whether every member on the relations moves and none off them.
    #[must_use]
    pub const fn agrees(&self) -> bool {
        self.on > 0 && self.on == self.mobile_on && self.off > 0 && self.mobile_off == 0
    }
}

/// The fit over one prime field. Fields are larger where there is one unknown to run through them; two of them, so that
/// coefficients up to some dozens come back.
type Fit = fn(&Ansatz, &[Polynomial<Rational>], u64) -> Result<(Evidence, Vec<Vec<u64>>)>;

/// The prime of the trial.
const TRIAL: u64 = 103;
/// Members more than terms, so that a relation among them is no accident.
const SURPLUS: usize = 12;
/// Random choices of parameters, for each member wanted, before a sweep gives up.
const PATIENCE: usize = 4;
/// One of so many members off the relations is tried.
const OFF: u64 = 8;
/// Random choices of parameters in the trial.
const TRIALS: usize = 12;

/// Sweeps an ansatz.
///
/// # Errors
/// [`Error::Unsupported`] unless there are one or two unknown lengths and four to six joints.
pub fn sweep(ansatz: &Ansatz, seed: u64) -> Result<Sweep> {
    let fits: [Fit; 2] = match ansatz.unknown.len() {
        1 => [fit::<59>, fit::<67>],
        2 => [fit::<31>, fit::<43>],
        n => return Err(Error::Unsupported(format!("a sweep over {n} unknown lengths, expected one or two"))),
    };
    if !(4..=6).contains(&ansatz.joints.len()) {
        return Err(Error::Unsupported(format!("a sweep for {} joints, expected four to six", ansatz.joints.len())));
    }
    let mut last = None;
    for terms in term_lists(ansatz) {
        let mut evidence = Vec::new();
        let mut spaces = Vec::new();
        for fit in fits {
            let (found, space) = fit(ansatz, &terms, seed)?;
            let empty = space.is_empty();
            spaces.push((found.prime, space));
            evidence.push(found);
            if empty {
                break;
            }
        }
        let relations = lifted(&spaces, &terms);
        let sweep = Sweep { evidence, relations, terms: terms.len(), trial: None };
        if !sweep.relations.is_empty() {
            let trial = trial::<TRIAL>(ansatz, &sweep.relations, seed)?;
            return Ok(Sweep { trial: Some(trial), ..sweep });
        }
        let members = sweep.evidence.iter().map(|evidence| evidence.members).max().unwrap_or(0);
        last = Some(sweep);
        // Without mobile members, other terms find nothing either.
        if members == 0 {
            break;
        }
    }
    last.ok_or_else(|| Error::Invalid("found no terms to fit".to_owned()))
}

/// The terms of the file, or what usual conditions are made of: lengths times functions of one angle, then products of two
/// lengths.
fn term_lists(ansatz: &Ansatz) -> Vec<Vec<Polynomial<Rational>>> {
    if !ansatz.fit.is_empty() {
        return vec![ansatz.fit.clone()];
    }
    let lengths: Vec<_> =
        ansatz.free_lengths().into_iter().map(|k| Polynomial::variable(ansatz.symbols.length(k))).collect();
    let mut functions = vec![Polynomial::one()];
    for &angle in ansatz.free_angles() {
        functions.extend([Symbols::cos(angle), Symbols::sin(angle)].map(Polynomial::variable));
    }
    let linear = lengths.iter().flat_map(|length| functions.iter().map(|f| length.mul(f))).collect();
    let quadratic = (0..lengths.len()).flat_map(|i| (0..=i).map(move |j| (i, j)));
    vec![linear, quadratic.map(|(i, j)| lengths[i].mul(&lengths[j])).collect()]
}

/// A choice of the free parameters with all lengths but the unknown ones, which are 0 so far.
struct Draw<F> {
    tangents: Vec<F>,
    lengths: Vec<F>,
}

/// The places of the unknown among the free lengths.
fn unknown_places(ansatz: &Ansatz) -> Vec<usize> {
    let free = ansatz.free_lengths();
    ansatz.unknown.iter().filter_map(|unknown| free.iter().position(|k| k == unknown)).collect()
}

fn draw<const P: u64>(ansatz: &Ansatz, rng: &mut ChaCha8Rng) -> Draw<ModP<P>> {
    Draw {
        tangents: ansatz.free_angles().iter().map(|_| random_unit(rng)).collect(),
        lengths: ansatz.free_lengths().iter().map(|_| random_unit(rng)).collect(),
    }
}

/// The values of all symbols of the members of a draw that move, for all values of the unknown.
fn mobile<const P: u64>(members: &Members<'_, ModP<P>>, places: &[usize], draw: &Draw<ModP<P>>) -> Vec<Vec<ModP<P>>> {
    let choices = P.pow(u32::try_from(places.len()).unwrap_or(u32::MAX));
    let member = |choice: u64| {
        let mut lengths = draw.lengths.clone();
        let mut rest = choice;
        for &place in places {
            lengths[place] = ModP::new(rest % P);
            rest /= P;
        }
        let values = members.values(&draw.tangents, &lengths)?;
        moves(members, &values).then_some(values)
    };
    (0..choices).filter_map(member).collect()
}

/// Whether a member has a family of configurations in which all joints move.
fn moves<const P: u64>(members: &Members<'_, ModP<P>>, values: &[ModP<P>]) -> bool {
    let limit = usize::try_from(4 * P).unwrap_or(usize::MAX);
    members.links(values).is_some_and(|links| configurations(&links, limit).all_move())
}

/// The relations among the terms over one prime field.
fn fit<const P: u64>(ansatz: &Ansatz, terms: &[Polynomial<Rational>], seed: u64) -> Result<(Evidence, Vec<Vec<u64>>)> {
    let unlucky = || Error::Unsupported(format!("a number of the ansatz that is a fraction modulo {P}"));
    let members = ansatz.over::<ModP<P>>().ok_or_else(unlucky)?;
    let places = unknown_places(ansatz);
    let images: Option<Vec<Polynomial<ModP<P>>>> = terms.iter().map(|term| term.map(ModP::from_rational)).collect();
    let images = images.ok_or_else(unlucky)?;
    let wanted = terms.len() + SURPLUS;
    let batch = wanted.div_ceil(2);
    let mut draws: Vec<Vec<Vec<ModP<P>>>> = Vec::new();
    let mut typical = 0;
    while draws.len() < PATIENCE * wanted {
        let start = draws.len();
        draws.par_extend((start..start + batch).into_par_iter().map(|number| {
            let mut rng = ChaCha8Rng::seed_from_u64(seed ^ (P << 32) ^ number as u64);
            mobile(&members, &places, &draw(ansatz, &mut rng))
        }));
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

/// The number of mobile members, none apart, that most draws have.
fn usual<T>(draws: &[Vec<T>]) -> usize {
    let mut counts: BTreeMap<usize, usize> = BTreeMap::new();
    for found in draws.iter().filter(|found| !found.is_empty()) {
        *counts.entry(found.len()).or_default() += 1;
    }
    counts.into_iter().max_by_key(|&(_, count)| count).map_or(0, |(roots, _)| roots)
}

/// Subsets tried where a few members spoil the fit.
const SUBSETS: usize = 40;

/// The null space of the rows; where there is none, that of a subset with which most of the rows agree, as a few members
/// move by accident modulo a small prime.
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

/// The relations from their residues; none unless all primes give as many.
fn lifted(spaces: &[(u64, Vec<Vec<u64>>)], terms: &[Polynomial<Rational>]) -> Vec<Polynomial<Rational>> {
    let count = spaces.first().map_or(0, |(_, space)| space.len());
    if spaces.len() < 2 || spaces.iter().any(|(_, space)| space.len() != count) {
        return Vec::new();
    }
    let relation = |number: usize| {
        let residues: Vec<(u64, Vec<u64>)> =
            spaces.iter().map(|(prime, space)| (*prime, space[number].clone())).collect();
        let coefficients = lift::vector(&residues)?;
        let denominator = coefficients.iter().fold(Integer::from(1), |lcm, c| lcm.lcm(c.denom()));
        let sum = terms
            .iter()
            .zip(&coefficients)
            .fold(Polynomial::zero(), |sum, (term, c)| sum.add(&term.scale(&Rational::from(c * &denominator))));
        Some(sum)
    };
    (0..count).map(relation).collect::<Option<_>>().unwrap_or_default()
}

/// Tries relations on fresh members over another field.
fn trial<const P: u64>(ansatz: &Ansatz, relations: &[Polynomial<Rational>], seed: u64) -> Result<Trial> {
    let unlucky = || Error::Unsupported(format!("a number of the ansatz that is a fraction modulo {P}"));
    let members = ansatz.over::<ModP<P>>().ok_or_else(unlucky)?;
    let images: Option<Vec<Polynomial<ModP<P>>>> = relations.iter().map(|r| r.map(ModP::from_rational)).collect();
    let images = images.ok_or_else(unlucky)?;
    let places = unknown_places(ansatz);
    let one = |number: usize| {
        let mut rng = ChaCha8Rng::seed_from_u64(seed ^ (P << 32) ^ number as u64);
        let draw = draw::<P>(ansatz, &mut rng);
        let mut trial = Trial { prime: P, on: 0, mobile_on: 0, off: 0, mobile_off: 0 };
        let mut lengths = draw.lengths;
        let choices = P.pow(u32::try_from(places.len()).unwrap_or(u32::MAX));
        let off = OFF * (choices / P).max(1);
        for choice in 0..choices {
            let mut rest = choice;
            for &place in &places {
                lengths[place] = ModP::new(rest % P);
                rest /= P;
            }
            let Some(values) = members.values(&draw.tangents, &lengths) else { continue };
            let on = images.iter().all(|relation| relation.evaluate(&values).is_zero());
            // Off the relations a few are enough.
            if !on && rng.random_range(0..off) != 0 {
                continue;
            }
            let moves = usize::from(moves(&members, &values));
            if on {
                (trial.on, trial.mobile_on) = (trial.on + 1, trial.mobile_on + moves);
            } else {
                (trial.off, trial.mobile_off) = (trial.off + 1, trial.mobile_off + moves);
            }
        }
        trial
    };
    let trials: Vec<Trial> = (0..TRIALS).into_par_iter().map(one).collect();
    let empty = Trial { prime: P, on: 0, mobile_on: 0, off: 0, mobile_off: 0 };
    Ok(trials.iter().fold(empty, |sum, t| Trial {
        prime: P,
        on: sum.on + t.on,
        mobile_on: sum.mobile_on + t.mobile_on,
        off: sum.off + t.off,
        mobile_off: sum.mobile_off + t.mobile_off,
    }))
}
