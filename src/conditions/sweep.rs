//! Conditions for the mobility of an ansatz with free parameters: mobile members are sought over small prime fields, and
//! relations are fitted to them.
//!
//! Parameters are drawn at random and one unknown runs through the whole field, then two if one is not enough. Members
//! with a family of configurations in which every joint moves are kept. The terms of a relation, evaluated at these, are
//! linearly dependent. The relations found are conjectures.

use super::fit::{Draw, Place, Scouted, choices, fit, images, moves, over, random, scout, unknown_places};
use crate::algebra::echelon::Echelon;
use crate::algebra::lift;
use crate::algebra::modp::{ModP, PRIME_61};
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::catalogue::ansatz::{Ansatz, Symbols};
use crate::error::{Error, Result};
use rand::Rng;
use rayon::prelude::*;
use rug::{Integer, Rational};

pub use super::fit::Evidence;

/// The results of a sweep.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// The results of the random members for each prime.
    pub evidence: Vec<Evidence>,
    /// The symbols that ran through the fields, by name; the other unknown ones were drawn like parameters.
    pub running: Vec<String>,
    /// Relations with coprime integer coefficients that all mobile members satisfy, none of them a consequence of the
    /// others; empty if there are none among the terms.
    pub relations: Vec<Polynomial<Rational>>,
    /// The terms among which relations were sought.
    pub terms: usize,
    /// A trial of the relations on fresh members; `None` without relations.
    pub trial: Option<Trial>,
    /// Whether almost all members move for any value of the unknown.
    pub always: bool,
}

/// Fresh members over another prime field, on the relations and off them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Trial {
    /// The prime.
    pub prime: u64,
    /// Number of members that satisfy the relations.
    pub on: usize,
    /// Number of these members with a family of configurations.
    pub mobile_on: usize,
    /// Number of members that do not satisfy the relations.
    pub off: usize,
    /// Number of these members with a family of configurations.
    pub mobile_off: usize,
}

impl Trial {
    /// Returns whether every member on the relations moves and none off them.
    #[must_use]
    pub const fn agrees(&self) -> bool {
        self.on > 0 && self.on == self.mobile_on && self.off > 0 && self.mobile_off == 0
    }
}

type Fit = fn(&Ansatz, &[Polynomial<Rational>], &[Place], u64) -> Result<(Evidence, Vec<Vec<u64>>)>;
type Scout = fn(&Ansatz, &[Place], usize, u64) -> Result<Scouted>;

/// The fields for one running unknown, and smaller ones for two. Two fields are used, and more if the coefficients are
/// too large for two.
const FITS: [[Fit; 4]; 2] =
    [[fit::<59>, fit::<67>, fit::<71>, fit::<79>], [fit::<31>, fit::<43>, fit::<47>, fit::<59>]];
/// The field, and number of draws, of the test whether any member moves.
const SCOUTS: [(Scout, usize); 2] = [(scout::<59>, 16), (scout::<31>, 8)];
/// The prime of the trial.
const TRIAL: u64 = 103;
/// One in this many members off the relations is tried.
const OFF: u64 = 8;
/// Number of random choices of parameters in the trial.
const TRIALS: usize = 12;
/// Number of draws in the test whether relations imply another one.
const SAMPLES: usize = 8;

/// Sweeps an ansatz.
///
/// # Errors
/// [`Error::Unsupported`] without an unknown symbol, for other than four to six joints, and for numbers that are fractions
/// modulo one of the primes.
pub fn sweep(ansatz: &Ansatz, seed: u64) -> Result<Sweep> {
    if !(4..=6).contains(&ansatz.joints.len()) {
        return Err(Error::Unsupported(format!("a sweep for {} joints, expected four to six", ansatz.joints.len())));
    }
    let unknown = unknown_places(ansatz);
    if unknown.is_empty() {
        return Err(Error::Unsupported("a sweep without an unknown symbol, expected one at least".to_owned()));
    }
    let mut sweep = Sweep {
        evidence: Vec::new(),
        running: names(ansatz, &unknown),
        relations: Vec::new(),
        terms: 0,
        trial: None,
        always: false,
    };
    let Some((running, scouted)) = running(ansatz, &unknown, seed)? else { return Ok(sweep) };
    sweep.running = names(ansatz, &running);
    if scouted == Scouted::All {
        return Ok(Sweep { always: true, ..sweep });
    }
    for terms in term_lists(ansatz) {
        let terms = independent(ansatz, &terms, seed)?;
        sweep.terms = terms.len();
        sweep.evidence.clear();
        let mut spaces: Vec<(u64, Vec<Vec<u64>>)> = Vec::new();
        for fit in FITS[running.len() - 1] {
            let (found, space) = fit(ansatz, &terms, &running, seed)?;
            let is_empty = space.is_empty();
            if !is_empty {
                spaces.push((found.prime, space));
            }
            sweep.evidence.push(found);
            if is_empty && spaces.is_empty() {
                break;
            }
            let Some(relations) = lifted(&spaces, &terms) else { continue };
            sweep.relations = minimal(ansatz, relations, &running, seed)?;
            let trial = trial::<TRIAL>(ansatz, &sweep.relations, &running, seed)?;
            sweep.trial = Some(trial);
            if trial.agrees() {
                return Ok(sweep);
            }
        }
        if !sweep.relations.is_empty() {
            return Ok(sweep);
        }
    }
    Ok(sweep)
}

/// Returns the unknowns that have to run for some members to move: one of them, two, or none of those tried.
fn running(ansatz: &Ansatz, unknown: &[Place], seed: u64) -> Result<Option<(Vec<Place>, Scouted)>> {
    let singles = unknown.iter().map(|&place| vec![place]);
    let pairs = (0..unknown.len()).flat_map(|i| (i + 1..unknown.len()).map(move |j| vec![unknown[i], unknown[j]]));
    for places in singles.chain(pairs) {
        let (scout, draws) = SCOUTS[places.len() - 1];
        let scouted = scout(ansatz, &places, draws, seed)?;
        if scouted != Scouted::Rigid {
            return Ok(Some((places, scouted)));
        }
    }
    Ok(None)
}

fn names(ansatz: &Ansatz, places: &[Place]) -> Vec<String> {
    let symbols = &ansatz.symbols;
    let name = |place: &Place| match *place {
        Place::Tangent(k) => symbols.angles[ansatz.free_angles()[k]].clone(),
        Place::Length(k) => symbols.lengths[ansatz.free_lengths()[k]].clone(),
    };
    places.iter().map(name).collect()
}

/// Returns the terms of the file, or those of usual conditions: lengths times functions of one angle, products of two
/// lengths; if an angle is unknown, functions of angles first.
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
    let products = |list: &[Polynomial<Rational>]| -> Vec<Polynomial<Rational>> {
        (0..list.len()).flat_map(|i| (0..=i).map(move |j| list[i].mul(&list[j]))).collect()
    };
    let mut lists = Vec::new();
    if !ansatz.unknown_angles.is_empty() {
        lists.extend([functions.clone(), products(&functions)]);
    }
    if !lengths.is_empty() {
        let one = Polynomial::one();
        let factors = lengths.iter().chain([&one]);
        lists.push(factors.flat_map(|length| functions.iter().map(|f| length.mul(f))).collect());
        lists.push(products(&lengths.iter().cloned().chain([one.clone()]).collect::<Vec<_>>()));
    }
    lists
}

/// Returns the terms without those that are combinations of earlier ones for every member, mobile or not.
fn independent(ansatz: &Ansatz, terms: &[Polynomial<Rational>], seed: u64) -> Result<Vec<Polynomial<Rational>>> {
    let members = over::<PRIME_61>(ansatz)?;
    let images = images::<PRIME_61>(terms)?;
    let wanted = terms.len() + 4;
    let row = |number: usize| {
        let draw = Draw::<ModP<PRIME_61>>::random(ansatz, &members, &mut random::<PRIME_61>(seed, number));
        let values = members.values(&draw.tangents, &draw.lengths)?;
        Some(images.iter().map(|term| term.evaluate(&values)).collect::<Vec<_>>())
    };
    let rows: Vec<_> = (0..2 * wanted).filter_map(row).take(wanted).collect();
    if rows.len() < wanted {
        return Ok(terms.to_vec());
    }
    let mut pivots = Echelon::of(rows, terms.len()).pivots().to_vec();
    pivots.sort_unstable();
    Ok(pivots.into_iter().map(|k| terms[k].clone()).collect())
}

/// Lifts the relations from their residues modulo the primes with equally many; `None` unless there are two such
/// primes, and integers of a size that they determine.
fn lifted(spaces: &[(u64, Vec<Vec<u64>>)], terms: &[Polynomial<Rational>]) -> Option<Vec<Polynomial<Rational>>> {
    let count = spaces.iter().map(|(_, space)| space.len()).min()?;
    let spaces: Vec<_> = spaces.iter().filter(|(_, space)| space.len() == count).collect();
    if spaces.len() < 2 {
        return None;
    }
    let relation = |number: usize| {
        let residues: Vec<(u64, Vec<u64>)> =
            spaces.iter().map(|(prime, space)| (*prime, space[number].clone())).collect();
        let coefficients = lift::vector(&residues)?;
        let denominator = coefficients.iter().fold(Integer::from(1), |lcm, c| lcm.lcm(c.denom()));
        let scaled = |(term, c): (&Polynomial<Rational>, &Rational)| term.scale(&Rational::from(c * &denominator));
        let sum = terms.iter().zip(&coefficients).map(scaled).fold(Polynomial::zero(), |sum, term| sum.add(&term));
        Some(without_monomial(&sum))
    };
    (0..count).map(relation).collect()
}

/// Divides a polynomial by the product of variables that divides it.
fn without_monomial(polynomial: &Polynomial<Rational>) -> Polynomial<Rational> {
    let variables = polynomial.variables();
    let exponent = |variable: usize| polynomial.terms().map(|(exponents, _)| exponents[variable]).min().unwrap_or(0);
    let common: Vec<u32> = (0..variables).map(exponent).collect();
    let divided = |(exponents, c): (Vec<u32>, &Rational)| {
        (exponents.iter().zip(&common).map(|(e, less)| e - less).collect::<Vec<_>>(), c.clone())
    };
    Polynomial::from_terms(polynomial.terms().map(divided))
}

/// Returns the simplest relations, without those that the others imply for general values of the parameters.
fn minimal(
    ansatz: &Ansatz,
    mut relations: Vec<Polynomial<Rational>>,
    running: &[Place],
    seed: u64,
) -> Result<Vec<Polynomial<Rational>>> {
    sort::by_key(&mut relations, |relation| (relation.total_degree(), relation.len()));
    let mut kept: Vec<Polynomial<Rational>> = Vec::new();
    for relation in relations {
        if !implied::<TRIAL>(ansatz, &kept, &relation, running, seed)? {
            kept.push(relation);
        }
    }
    Ok(kept)
}

/// Returns whether a relation vanishes wherever others do, for random values of the symbols that do not run.
fn implied<const P: u64>(
    ansatz: &Ansatz,
    others: &[Polynomial<Rational>],
    relation: &Polynomial<Rational>,
    running: &[Place],
    seed: u64,
) -> Result<bool> {
    let (members, others) = (over::<P>(ansatz)?, images::<P>(others)?);
    let relation = images::<P>(std::slice::from_ref(relation))?;
    let vanish = |list: &[Polynomial<ModP<P>>], values: &[ModP<P>]| list.iter().all(|p| p.evaluate(values).is_zero());
    let (mut common, mut also) = (0_usize, 0_usize);
    for number in 0..SAMPLES {
        let mut draw = Draw::<ModP<P>>::random(ansatz, &members, &mut random::<P>(seed, number));
        for choice in 0..choices::<P>(running) {
            draw.set(running, choice);
            let Some(values) = members.values(&draw.tangents, &draw.lengths) else { continue };
            if vanish(&others, &values) {
                common += 1;
                also += usize::from(vanish(&relation, &values));
            }
        }
    }
    // A few accidents of a small field are allowed.
    Ok(!others.is_empty() && common > 0 && 10 * also >= 9 * common)
}

/// Tries relations on fresh members over another field.
fn trial<const P: u64>(
    ansatz: &Ansatz,
    relations: &[Polynomial<Rational>],
    running: &[Place],
    seed: u64,
) -> Result<Trial> {
    let (members, images) = (over::<P>(ansatz)?, images::<P>(relations)?);
    let choices = choices::<P>(running);
    let off = OFF * (choices / P).max(1);
    let none = Trial { prime: P, on: 0, mobile_on: 0, off: 0, mobile_off: 0 };
    let one = |number: usize| {
        let mut rng = random::<P>(seed, number);
        let mut draw = Draw::<ModP<P>>::random(ansatz, &members, &mut rng);
        let mut trial = none;
        for choice in 0..choices {
            draw.set(running, choice);
            let Some(values) = members.values(&draw.tangents, &draw.lengths) else { continue };
            let on = images.iter().all(|relation| relation.evaluate(&values).is_zero());
            // Off the relations a few members are enough.
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
    Ok(trials.iter().fold(none, |sum, t| Trial {
        prime: P,
        on: sum.on + t.on,
        mobile_on: sum.mobile_on + t.mobile_on,
        off: sum.off + t.off,
        mobile_off: sum.mobile_off + t.mobile_off,
    }))
}
