//! All solutions of a loop of six unknowns from the roots of its eliminants.
//!
//! The value of every unknown at a solution is a root of its eliminant, so that a solution is a combination of roots, and no two
//! solutions are the same combination. Combinations that balls do not refute are solutions with the multiplicities that the
//! orders of the roots leave, where a lower bound on the number of all solutions is known.

use super::eliminant::{Eliminant, ways};
use super::fibre::Fibre;
use super::ground::Ground;
use super::krawczyk;
use super::multiplicity::Balance;
use super::tuples::{Closing, Tuple, closing_tuples};
use super::values::{Pair, Value, meet, pair_around, values};
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use num_complex::Complex;
use rug::Float;

/// A solution that is known to be simple: exactly one lies within the radius, in every unknown.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// The six unknowns.
    pub unknowns: [Complex<f64>; 6],
    /// The radius.
    pub radius: f64,
}

/// Bits of the balls in which exact roots are compared first: solutions that differ by more than about `1e-70` are distinguished.
pub const BALL_BITS: u32 = 256;
/// Bits of the second attempt, four times as many, for crowded solutions and lengths of very different sizes.
const LONG_BITS: u32 = 1024;

/// The origin of a solution.
#[derive(Clone, Debug)]
pub enum Solution<const BITS: u32> {
    /// The known solution with this place in its list, which is simple.
    Known(usize),
    /// Cosine and sine of every unknown.
    Found {
        /// Cosine and sine of every unknown.
        pairs: Box<[Pair<BITS>; 6]>,
        /// Whether all unknowns are real.
        is_real: bool,
        /// The number of solutions that coincide here.
        multiplicity: usize,
    },
}

/// The conclusion of the eliminants about all solutions.
#[derive(Clone, Debug)]
pub enum Resolution {
    /// The known solutions are all: as many as an eliminant has roots.
    AllKnown,
    /// All solutions.
    All(Vec<Solution<BALL_BITS>>),
    /// The eliminants of these unknowns vanish: solutions may form families.
    Vanishing(Vec<usize>),
    /// Every unknown has an eliminant, so that the solutions are finite in number, but they are not all distinguished.
    Finite {
        /// Upper bound on the number of solutions, with multiplicity.
        most: usize,
    },
}

/// Resolves all solutions of a loop, some of which are known.
#[must_use]
pub fn resolve(ground: &impl Ground, known: &[Known]) -> Resolution {
    let ways = ways(ground.modular());
    if ways.first().is_some_and(|best| best.count == known.len() && ground.count(best) == Some(known.len())) {
        return Resolution::AllKnown;
    }
    let mut found: [Option<Eliminant>; 6] = std::array::from_fn(|unknown| {
        let mut own = ways.iter().filter(|way| way.unknown == unknown);
        own.find_map(|way| ground.eliminant(way))
    });
    let vanishing: Vec<usize> = (0..6).filter(|&j| found[j].is_none()).collect();
    let mut result = resolution(ground, known, &found);
    if matches!(result, Resolution::Vanishing(_)) {
        // The unknowns that the others do not determine have values in the ring, if solutions form no families. Translations
        // follow from the rotations.
        let is_rotation = |unknown: &&usize| ground.variables()[**unknown] == Variable::Rotation;
        for &unknown in vanishing.iter().filter(is_rotation) {
            found[unknown] = ground.eliminant_by_ring(unknown);
            if found[unknown].is_none() {
                return result;
            }
        }
        result = resolution(ground, known, &found);
    }
    result
}

/// Resolves the solutions by these eliminants.
fn resolution(ground: &impl Ground, known: &[Known], found: &[Option<Eliminant>; 6]) -> Resolution {
    let vanishing: Vec<usize> = (0..6).filter(|&j| found[j].is_none()).collect();
    if vanishing.len() > MOST_MISSING {
        return Resolution::Vanishing(vanishing);
    }
    let resolved = match solutions::<BALL_BITS>(ground, known, found) {
        Err(Obstacle::Digits) => solutions::<LONG_BITS>(ground, known, found).map(rounded),
        resolved => resolved,
    };
    match resolved {
        Ok(all) => Resolution::All(all),
        Err(_) if vanishing.is_empty() => {
            Resolution::Finite { most: found.iter().flatten().map(Eliminant::count).min().unwrap_or(16) }
        }
        Err(_) => Resolution::Vanishing(vanishing),
    }
}

/// The reason why the eliminants do not resolve all solutions.
#[derive(Clone, Copy, Debug)]
enum Obstacle {
    /// Balls of more digits may resolve them.
    Digits,
    /// Balls of more digits do not help.
    Other,
}

/// Returns all solutions as far as balls of this precision distinguish them.
fn solutions<const BITS: u32>(
    ground: &impl Ground,
    known: &[Known],
    found: &[Option<Eliminant>; 6],
) -> Result<Vec<Solution<BITS>>, Obstacle> {
    let lists = found.each_ref().map(|eliminant| eliminant.as_ref().map(values));
    if lists.iter().any(|list| matches!(list, Some(None))) {
        return Err(Obstacle::Digits);
    }
    let constants = ground.constants().ok_or(Obstacle::Other)?;
    Search { ground, constants, values: lists.map(Option::flatten) }.run(known)
}

/// Rounds the solutions to balls of fewer digits.
fn rounded<const BITS: u32, const LESS: u32>(solutions: Vec<Solution<BITS>>) -> Vec<Solution<LESS>> {
    let shorter = |solution| match solution {
        Solution::Known(place) => Solution::Known(place),
        Solution::Found { pairs, is_real, multiplicity } => {
            let pairs = pairs.each_ref().map(|(cos, sin)| (Ball::of_precision(cos), Ball::of_precision(sin)));
            Solution::Found { pairs: Box::new(pairs), is_real, multiplicity }
        }
    };
    solutions.into_iter().map(shorter).collect()
}

/// Largest number of rotations that follow from the others.
const MOST_MISSING: usize = 3;
/// Largest number of isolated solutions of a loop of rotations.
const MOST_SOLUTIONS: usize = 16;
/// A bound larger than the number of solutions of any loop: no bound.
const UNBOUNDED: usize = 1000;

/// A loop with the values of all its unknowns.
struct Search<'a, const BITS: u32, G> {
    ground: &'a G,
    constants: Vec<Motion<Ball<BITS>>>,
    /// By unknown; `None` for those without an eliminant.
    values: [Option<Vec<Value<BITS>>>; 6],
}

impl<const BITS: u32, G: Ground> Search<'_, BITS, G> {
    fn run(&self, known: &[Known]) -> Result<Vec<Solution<BITS>>, Obstacle> {
        let (simple, places): (Vec<Tuple>, Vec<usize>) =
            known.iter().enumerate().filter_map(|(k, known)| Some((self.tuple(known)?, k))).unzip();
        // Two solutions are never the same combination.
        if (1..simple.len()).any(|k| simple[..k].contains(&simple[k])) {
            return Err(Obstacle::Digits);
        }
        let orders = self.values.each_ref().map(|list| match list {
            Some(list) => list.iter().map(|value| value.order).collect::<Vec<_>>(),
            None => vec![UNBOUNDED],
        });
        let found = self.open(&simple, &orders).ok_or(Obstacle::Other)?;
        if simple.len() + found.len() > MOST_SOLUTIONS {
            return Err(Obstacle::Digits);
        }
        let (proved, found): (Vec<_>, Vec<_>) = found.into_iter().partition(|closing| self.is_simple(closing));
        let simple: Vec<Tuple> = simple.into_iter().chain(proved.iter().map(|closing| closing.tuple)).collect();
        let open: Vec<Tuple> = found.iter().map(|closing| closing.tuple).collect();
        let balance = Balance { orders: &orders, simple: &simple, open: &open };
        let multiplicities = self.multiplicities(&balance).ok_or(Obstacle::Digits)?;
        let known = places.into_iter().map(Solution::Known);
        let proved = proved.iter().map(|closing| self.resolved(closing, 1));
        let more = found.iter().zip(multiplicities).filter(|(_, multiplicity)| *multiplicity > 0);
        let more = more.map(|(closing, multiplicity)| self.resolved(closing, multiplicity));
        Ok(known.chain(proved).chain(more).collect())
    }

    /// Returns the multiplicities of the open combinations from the solutions modulo the prime.
    fn multiplicities(&self, balance: &Balance) -> Option<Vec<usize>> {
        if balance.open.is_empty() {
            return Some(Vec::new());
        }
        let fibre = Fibre::of(self.ground.modular(), balance.most())?;
        balance.multiplicities(fibre.count()).or_else(|| balance.by_exponents(&fibre.exponents()))
    }

    /// Whether a combination is proved to be a simple solution.
    fn is_simple(&self, closing: &Closing<BITS>) -> bool {
        let pairs = self.pairs(closing);
        let Some(radius) = krawczyk::radius(self.ground.variables(), &self.constants, &pairs) else { return false };
        // The solution has roots of the eliminants as its values: these roots, if no others are as near.
        let wide = Float::with_val(32, radius * 2_u32);
        let around = |(cos, sin): &Pair<BITS>| {
            let size = cos.upper() + sin.upper();
            let by = Float::with_val(32, size * &wide);
            (cos.clone().enlarged(&by), sin.clone().enlarged(&by))
        };
        (0..6).filter(|&j| self.values[j].is_some()).all(|j| {
            let own = around(&pairs[j]);
            let values = self.values[j].iter().flatten().enumerate();
            values.filter(|(place, _)| *place != closing.tuple[j]).all(|(_, value)| !meet(&value.pair, &own))
        })
    }

    /// Returns the combination of values of a known solution; `None` where its radius leaves several.
    fn tuple(&self, known: &Known) -> Option<Tuple> {
        let mut tuple = [0; 6];
        for (j, place) in tuple.iter_mut().enumerate() {
            let Some(values) = &self.values[j] else { continue };
            let own = pair_around(known.unknowns[j], known.radius);
            let mut near = values.iter().enumerate().filter(|(_, value)| meet(&value.pair, &own));
            let (only, _) = near.next()?;
            if near.next().is_some() {
                return None;
            }
            *place = only;
        }
        Some(tuple)
    }

    /// All combinations that may be solutions beside the simple ones.
    fn open(&self, simple: &[Tuple], orders: &[Vec<usize>; 6]) -> Option<Vec<Closing<BITS>>> {
        // A value that as many simple solutions have as its order allows belongs to no other solution.
        let unsettled: [Vec<usize>; 6] = std::array::from_fn(|j| {
            let taken = |value: usize| simple.iter().filter(|tuple| tuple[j] == value).count();
            (0..orders[j].len()).filter(|&value| taken(value) < orders[j][value]).collect()
        });
        if unsettled.iter().any(Vec::is_empty) {
            return Some(Vec::new());
        }
        let lists: [Option<Vec<&Value<BITS>>>; 6] = std::array::from_fn(|j| {
            let values = self.values[j].as_ref()?;
            Some(unsettled[j].iter().map(|&value| &values[value]).collect())
        });
        let mut found = closing_tuples(self.ground.variables(), &self.constants, &lists)?;
        for closing in &mut found {
            closing.tuple = std::array::from_fn(|j| unsettled[j][closing.tuple[j]]);
        }
        found.retain(|closing| !simple.contains(&closing.tuple));
        Some(found)
    }

    /// Cosine and sine of every unknown.
    fn pairs(&self, closing: &Closing<BITS>) -> [Pair<BITS>; 6] {
        let mut rest = closing.rest.iter();
        std::array::from_fn(|j| match &self.values[j] {
            Some(values) => values[closing.tuple[j]].pair.clone(),
            // There are as many pairs left as unknowns without values.
            None => rest.next().cloned().unwrap_or_else(|| (Ball::zero(), Ball::zero())),
        })
    }

    fn resolved(&self, closing: &Closing<BITS>, multiplicity: usize) -> Solution<BITS> {
        // Unknowns that follow from real values are real: the solution with these values is unique.
        let is_real = (0..6).all(|j| self.values[j].as_ref().is_none_or(|values| values[closing.tuple[j]].is_real));
        Solution::Found { pairs: Box::new(self.pairs(closing)), is_real, multiplicity }
    }
}
