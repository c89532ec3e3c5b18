//! All solutions of a loop of six rotations from the roots of its eliminants.
//!
//! The value of every unknown at a solution is a root of its eliminant, so that a solution is a combination of roots, and
//! no two solutions are the same combination. Combinations that are left when balls have refuted the others are solutions
//! with the multiplicities that the orders of the roots leave, where the number of all solutions is known from below.

use super::eliminant::{Eliminant, Way, eliminant, eliminant_by_ring, ways};
use super::krawczyk;
use super::multiplicity::Balance;
use super::tuples::{Closing, Tuple, closing_tuples};
use super::values::{Pair, Value, meet, pair_around, values};
use crate::algebra::ball::Ball;
use crate::algebra::drawn::Drawn;
use crate::algebra::ring::Ring;
use crate::elimination::coordinate_ring::Plan;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use num_complex::Complex;
use rug::{Float, Rational};

/// A solution that is known to be simple: exactly one lies within the radius, in every unknown.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    /// The six unknowns.
    pub unknowns: [Complex<f64>; 6],
    /// The radius.
    pub radius: f64,
}

/// Where a solution comes from.
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
        /// How many solutions coincide here.
        multiplicity: usize,
    },
}

/// What the eliminants say of all solutions.
#[derive(Clone, Debug)]
pub enum Resolution<const BITS: u32> {
    /// The known solutions are all there are: as many as an eliminant has roots.
    AllKnown,
    /// All solutions.
    All(Vec<Solution<BITS>>),
    /// The eliminants of these unknowns vanish: solutions may form families.
    Vanishing(Vec<usize>),
    /// Every unknown has an eliminant, so that the solutions are finite in number, but this does not tell them all.
    Finite {
        /// At most so many solutions there are, with multiplicity.
        most: usize,
    },
}

/// Decides what the solutions of a loop of six rotations are, some of which are known.
#[must_use]
pub fn resolve<const BITS: u32>(
    closed: &ClosedLoop<Rational>,
    modular: &ClosedLoop<Drawn>,
    known: &[Known],
) -> Resolution<BITS> {
    let ways = ways(modular);
    if ways.first().is_some_and(|best| best.count == known.len() && is_met(closed, best, known.len())) {
        return Resolution::AllKnown;
    }
    if closed.variables.contains(&Variable::Translation) {
        return Resolution::Finite { most: ways.first().map_or(16, |best| best.count) };
    }
    let mut found: [Option<Eliminant>; 6] = std::array::from_fn(|unknown| {
        let mut own = ways.iter().filter(|way| way.unknown == unknown);
        own.find_map(|way| eliminant(closed, way))
    });
    let vanishing: Vec<usize> = (0..6).filter(|&j| found[j].is_none()).collect();
    let mut result = resolution(closed, modular, known, &found);
    if matches!(result, Resolution::Vanishing(_)) {
        // What the others do not determine has values in the ring, if solutions form no families.
        for &unknown in &vanishing {
            found[unknown] = eliminant_by_ring(closed, modular, unknown);
            if found[unknown].is_none() {
                return result;
            }
        }
        result = resolution(closed, modular, known, &found);
    }
    result
}

/// What these eliminants say.
fn resolution<const BITS: u32>(
    closed: &ClosedLoop<Rational>,
    modular: &ClosedLoop<Drawn>,
    known: &[Known],
    found: &[Option<Eliminant>; 6],
) -> Resolution<BITS> {
    let vanishing: Vec<usize> = (0..6).filter(|&j| found[j].is_none()).collect();
    if vanishing.len() > MOST_MISSING {
        return Resolution::Vanishing(vanishing);
    }
    let most = found.iter().flatten().map(Eliminant::count).min().unwrap_or(16);
    let lists = found.each_ref().map(|eliminant| eliminant.as_ref().map(values));
    let is_told_apart = lists.iter().all(|list| !matches!(list, Some(None)));
    let search = Search { closed, modular, values: lists.map(Option::flatten) };
    let resolved = if is_told_apart { search.run(known) } else { None };
    match resolved {
        Some(all) => Resolution::All(all),
        None if vanishing.is_empty() => Resolution::Finite { most },
        None => Resolution::Vanishing(vanishing),
    }
}

/// Up to this many rotations follow from the others.
const MOST_MISSING: usize = 3;
/// Stands for no bound on the number of solutions: more than any loop has.
const UNBOUNDED: usize = 1000;

/// Whether an eliminant over the integers has no more roots than that.
fn is_met(closed: &ClosedLoop<Rational>, way: &Way, count: usize) -> bool {
    eliminant(closed, way).is_some_and(|eliminant| eliminant.count() == count)
}

/// A loop with the values of all its unknowns.
struct Search<'a, const BITS: u32> {
    closed: &'a ClosedLoop<Rational>,
    modular: &'a ClosedLoop<Drawn>,
    /// By unknown; `None` for those without an eliminant.
    values: [Option<Vec<Value<BITS>>>; 6],
}

impl<const BITS: u32> Search<'_, BITS> {
    fn run(&self, known: &[Known]) -> Option<Vec<Solution<BITS>>> {
        let (simple, places): (Vec<Tuple>, Vec<usize>) =
            known.iter().enumerate().filter_map(|(k, known)| Some((self.tuple(known)?, k))).unzip();
        // Two solutions are never the same combination.
        if (1..simple.len()).any(|k| simple[..k].contains(&simple[k])) {
            return None;
        }
        let orders = self.values.each_ref().map(|list| match list {
            Some(list) => list.iter().map(|value| value.order).collect::<Vec<_>>(),
            None => vec![UNBOUNDED],
        });
        let found = self.open(&simple, &orders)?;
        let (proved, found): (Vec<_>, Vec<_>) = found.into_iter().partition(|closing| self.is_simple(closing));
        let simple: Vec<Tuple> = simple.into_iter().chain(proved.iter().map(|closing| closing.tuple)).collect();
        let open: Vec<Tuple> = found.iter().map(|closing| closing.tuple).collect();
        let balance = Balance { orders: &orders, simple: &simple, open: &open };
        let multiplicities =
            if open.is_empty() { Vec::new() } else { balance.multiplicities(number(self.modular, balance.most())?)? };
        let known = places.into_iter().map(Solution::Known);
        let proved = proved.iter().map(|closing| self.resolved(closing, 1));
        let more = found.iter().zip(multiplicities).filter(|(_, multiplicity)| *multiplicity > 0);
        let more = more.map(|(closing, multiplicity)| self.resolved(closing, multiplicity));
        Some(known.chain(proved).chain(more).collect())
    }

    /// Whether a combination is proved to be a simple solution.
    fn is_simple(&self, closing: &Closing<BITS>) -> bool {
        let constants = self.closed.constants.each_ref().map(|motion| motion.map(Ball::from_rational));
        let constants: Option<Vec<_>> = constants.into_iter().collect();
        let pairs = self.pairs(closing);
        let Some(radius) = constants.and_then(|constants| krawczyk::radius(&constants, &pairs)) else { return false };
        // The solution has roots of the eliminants as its values: these very ones, if no others are as near.
        let wide = Float::with_val(32, radius * 2_u32);
        let around = |(cos, sin): &Pair<BITS>| {
            let size = cos.upper() + sin.upper();
            let by = Float::with_val(32, size * &wide);
            (cos.clone().enlarged(&by), sin.clone().enlarged(&by))
        };
        (0..6).all(|j| {
            let own = around(&pairs[j]);
            let values = self.values[j].iter().flatten().enumerate();
            values.filter(|(place, _)| *place != closing.tuple[j]).all(|(_, value)| !meet(&value.pair, &own))
        })
    }

    /// The combination that a known solution is; `None` where its radius leaves several.
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
        // Where as many simple solutions have a value as its order allows there are no others.
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
        let mut found = closing_tuples(self.closed, &lists)?;
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
            // As many pairs are left as there are unknowns without values.
            None => rest.next().cloned().unwrap_or_else(|| (Ball::zero(), Ball::zero())),
        })
    }

    fn resolved(&self, closing: &Closing<BITS>, multiplicity: usize) -> Solution<BITS> {
        // What follows from real values is real, being the only solution with these.
        let is_real = (0..6).all(|j| self.values[j].as_ref().is_none_or(|values| values[closing.tuple[j]].is_real));
        Solution::Found { pairs: Box::new(self.pairs(closing)), is_real, multiplicity }
    }
}

/// The number of solutions, with multiplicity, from below: as many as there are modulo the prime, where these are finite in
/// number, because the closure equations of a loop form a complete intersection, which is flat there. Asked only as far as
/// `most`.
fn number(modular: &ClosedLoop<Drawn>, most: usize) -> Option<usize> {
    let plan = Plan::of(modular).filter(|plan| plan.count() <= most)?;
    let ring = plan.ring(modular)?;
    ring.is_exact().then(|| plan.count())
}
