//! The answer to a loop of few unknowns, from its exact solutions.

use super::by_cut::{self, Found};
use super::configuration::{Configuration, Configurations};
use super::cycle::Cycle;
use super::equations::System;
use super::measure::measure;
use super::outcome::{Outcome, Point, Points, dimension_modulo_prime};
use crate::algebra::disc::Disc;
use crate::algebra::drawn;
use crate::algebra::groebner::{Equation, MOST_VARIABLES};
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::assembly::wrapped;
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::{Layout, Variable};
use crate::kinematics::span::too_long;
use crate::mechanism::FullMode;
use crate::mechanism::single_loop::{locked_value, within_limits};
use crate::verdict::{Code, Proof, Status, Verdict};
use num_complex::Complex;
use rug::{Float, Rational, float::Round};

/// Products of words after which a system is given up. Loops of four unknowns take a thousandth of it, half of the self-motions
/// of six joints a part of it, and what general loops of five take, or some special ones, is hours.
const EFFORT: u64 = 10_000_000;

/// Products modulo a prime after which the dimension of a system is given up: half a second.
const MODULAR_EFFORT: u64 = 30_000_000;

/// Number of unknowns from which a cut is quicker than a Gröbner basis, which is out of reach there.
const MANY: usize = 5;

/// A loop with the data of the question.
pub(crate) struct Question<'a> {
    /// The mechanism.
    pub chain: &'a Chain,
    /// Its variables.
    pub layout: &'a Layout,
    /// The input.
    pub case: &'a Case,
    /// The limits of the joints.
    pub limits: &'a [[f64; 2]],
    /// Whether numbers of the mechanism or the input had to be rounded.
    pub is_rounded: bool,
}

/// A verdict, and what it is about.
pub(crate) type Answer = (Verdict, Vec<FullMode>);

impl Question<'_> {
    /// The answer over the rationals; `None` for loops of another kind, and where it takes too long.
    ///
    /// # Errors
    /// For a case without input that has one.
    pub fn answer(&self) -> Result<Option<Answer>> {
        let Some(cycle) = Cycle::of(self.chain, self.layout, self.case)? else { return Ok(None) };
        if cycle.before.is_none()
            && cycle.steps.len() == MANY
            && let Some(found) = by_cut::solutions(&cycle)
        {
            return Ok(Some(self.simple(&cycle, &found)));
        }
        let Some(system) = system(&cycle) else { return Ok(None) };
        Ok(match Outcome::of(&system, EFFORT) {
            Some(Outcome::Moving(dimension)) => Some((self.moving(&cycle, dimension), Vec::new())),
            Some(Outcome::Finite(points)) => Some(self.finite(&cycle, &system, &points)),
            None => None,
        })
    }

    /// The verdict by a basis modulo the prime of the run, where that over the rationals takes too long since its numbers do: a
    /// self-motion of some dimension, or finitely many solutions, which are not listed. `None` where this takes too long, too.
    ///
    /// # Errors
    /// As [`Question::answer`].
    pub fn modulo_prime(&self) -> Result<Option<Verdict>> {
        let Some(cycle) = Cycle::of(self.chain, self.layout, self.case)?.filter(|cycle| cycle.before.is_none()) else {
            return Ok(None);
        };
        let dimension =
            System::of_loop(&cycle.steps).and_then(|system| dimension_modulo_prime(&system, MODULAR_EFFORT));
        Ok(dimension.map(|dimension| {
            let verdict = self.moving(&cycle, dimension);
            if verdict.code == Code::LinkTooLong {
                return verdict;
            }
            if dimension == 0 {
                let of = equations(&cycle);
                let reason = format!(
                    "not proved: finitely many solutions, by a Gröbner basis of {of} modulo a prime drawn at run time"
                );
                let (status, code) = (Status::Incomplete, Code::UnknownMultiplicity);
                return Verdict { status, proof: Proof::None, code, reason, ..verdict };
            }
            let proof = Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() };
            let reason = verdict.reason.replace("over the rationals", "modulo a prime drawn at run time");
            Verdict { proof, reason, ..verdict }
        }))
    }

    /// Returns all solutions but those at which every standing joint of one of these families stands as on it, in the order of a list, and how
    /// many there are with multiplicity; `None` where they are not known to be finitely many.
    ///
    /// # Errors
    /// As [`Question::answer`].
    pub fn beside(&self, families: &[Standing]) -> Result<Option<(Vec<FullMode>, usize)>> {
        let Some(cycle) = Cycle::of(self.chain, self.layout, self.case)? else { return Ok(None) };
        let Some(system) = system(&cycle).filter(|system| system.variables < MOST_VARIABLES) else { return Ok(None) };
        let (mut modes, mut count) = (Vec::new(), 0);
        for part in elsewhere(&system, &cycle, families).into_iter().flatten() {
            let Some(Outcome::Finite(points)) = Outcome::of(&part, EFFORT) else { return Ok(None) };
            let found = self.modes(&cycle, &system, &points);
            // With a joint held in place a multiple solution may count less often.
            let is_held = part.equations.len() > system.equations.len() + 1;
            if is_held && found.iter().any(|mode| !(mode.condition < REGULAR)) {
                return Ok(None);
            }
            count += points.count;
            modes.extend(found);
        }
        sort::by(&mut modes, in_order);
        Ok((count > 0).then_some((modes, count)))
    }

    fn proof(&self) -> Proof {
        Proof::Proved.of_rounded(self.is_rounded)
    }

    fn moving(&self, cycle: &Cycle, dimension: usize) -> Verdict {
        let of = equations(cycle);
        let reason = format!(
            "solutions form a self-motion of dimension {dimension}: that of the set of all solutions, real or complex, of {of}, \
             by a Gröbner basis over the rationals"
        );
        let verdict = Verdict {
            status: Status::SelfMotion,
            proof: self.proof(),
            code: Code::SelfMotion,
            complex_complete: false,
            complex: 0,
            real: 0,
            at_infinity: 0,
            self_motion: dimension,
            certified: 0,
            reason,
        };
        let is_turning = cycle.steps.iter().all(|step| step.variable == Variable::Rotation);
        let links = cycle.steps.iter().map(|step| &step.behind).chain(&cycle.before);
        match too_long(links.map(|link| &link.translation)).filter(|_| is_turning) {
            Some(reason) => {
                let (status, code) = (Status::Unreachable, Code::LinkTooLong);
                Verdict { status, code, self_motion: 0, reason, ..verdict }
            }
            None => verdict,
        }
    }

    /// The modes of finitely many solutions; a complex one may have no angles.
    fn modes(&self, cycle: &Cycle, system: &System, points: &Points) -> Vec<FullMode> {
        let configurations = Configurations::new(system, &cycle.steps, cycle.before.as_ref(), points);
        let mode =
            |point: &Point| Some(self.mode(cycle, point.is_real(), point.multiplicity, &configurations.at(point)?));
        points.distinct.iter().filter_map(mode).collect()
    }

    fn finite(&self, cycle: &Cycle, system: &System, points: &Points) -> Answer {
        let modes = self.modes(cycle, system, points);
        self.listed(modes, points.distinct.len(), [points.count, points.real()], reason(cycle, points))
    }

    /// The answer for solutions that are all simple.
    fn simple(&self, cycle: &Cycle, found: &[Found]) -> Answer {
        let modes = found.iter().map(|(is_real, configuration)| self.mode(cycle, *is_real, 1, configuration)).collect();
        let (count, real) = (found.len(), found.iter().filter(|(is_real, _)| *is_real).count());
        let reason = match count {
            0 => "no solution: the closure equations have none over the roots of an exact eliminant".to_owned(),
            1 => "the only solution of the closure equations, over a root of an exact eliminant".to_owned(),
            _ => format!("all {count} solutions of the closure equations, each over a root of an exact eliminant"),
        };
        self.listed(modes, count, [count, real], reason)
    }

    /// Returns the verdict on a list that has all of `distinct` distinct solutions.
    fn listed(&self, mut modes: Vec<FullMode>, distinct: usize, [count, real]: [usize; 2], reason: String) -> Answer {
        sort::by(&mut modes, in_order);
        let (status, code) = match (count, real) {
            (0, _) => (Status::Unreachable, Code::NoSolution),
            (_, 0) => (Status::Unreachable, Code::ExactRootsMatched),
            _ => (Status::Complete, Code::ExactRootsMatched),
        };
        let verdict = Verdict {
            status,
            proof: self.proof(),
            code,
            complex_complete: modes.len() == distinct,
            complex: count,
            real,
            at_infinity: 0,
            self_motion: 0,
            certified: modes.iter().filter(|mode| mode.certified).count(),
            reason,
        };
        (verdict, modes)
    }

    /// A solution as a user reads it.
    fn mode(&self, cycle: &Cycle, real: bool, multiplicity: usize, configuration: &Configuration) -> FullMode {
        let unit = self.chain.unit().to_f64();
        let mut q = vec![Complex::from(locked_value(self.case)); self.layout.variables.len()];
        let mut radius: f64 = 0.0;
        let mut place = |index: usize, ball: &Disc| {
            let (value, error) = nearest(ball, self.layout.variables[index], real);
            q[index] = value;
            let over = if self.layout.variables[index] == Variable::Rotation { 1.0 } else { unit.min(1.0) };
            radius = radius.max(error / over);
        };
        for (index, ball) in cycle.indices.iter().zip(&configuration.values) {
            place(*index, ball);
        }
        if let (Some(first), Some(angles)) = (self.layout.spherical, &configuration.spherical) {
            angles.iter().enumerate().for_each(|(k, angle)| place(first + k, angle));
        }
        let values: Vec<Complex<f64>> = cycle.indices.iter().map(|index| q[*index]).collect();
        let (residual, condition) = measure(cycle, &values, unit);
        let is_simple = multiplicity == 1;
        // With rounded data no solution is proved to exist.
        let certified = !self.is_rounded && radius.is_finite();
        FullMode {
            real,
            multiplicity,
            residual,
            condition: if is_simple { condition } else { f64::INFINITY },
            certified,
            radius: if certified { radius } else { f64::INFINITY },
            within_limits: (real && !self.limits.is_empty())
                .then(|| within_limits(&q, &self.layout.variables, self.limits)),
            q,
            near: false,
            error: None,
            platform: None,
        }
    }
}

/// The nearest number in f64, an angle between -pi and pi, and how far it is off at most.
pub(super) fn nearest(ball: &Disc, variable: Variable, real: bool) -> (Complex<f64>, f64) {
    let im = if real { 0.0 } else { ball.im.to_f64() };
    let exact = Complex::new(ball.re.to_f64(), im);
    let mut value = exact;
    let mut error = ball.radius().to_f64_round(Round::Up);
    let off = |x: &Float, y: f64| Float::with_val(64, x - y).to_f64_round(Round::Up).abs();
    error += off(&ball.re, exact.re) + if real { 0.0 } else { off(&ball.im, exact.im) };
    if variable == Variable::Rotation {
        value.re = wrapped(exact.re);
        // Whole turns are taken off in f64.
        if value.re.to_bits() != exact.re.to_bits() {
            error += 4.0 * f64::EPSILON;
        }
    }
    // The error of the sums of this function.
    (value, error * (1.0 + 8.0 * f64::EPSILON) + f64::MIN_POSITIVE)
}

/// The joints that stand on a family: the index of the joint variable, and its cosine and sine or its distance and 0.
pub(crate) type Standing = Vec<(usize, [Rational; 2])>;

/// A solution with a condition number below this is simple: the screws of its joints are independent, and it is known to sixteen digits.
const REGULAR: f64 = 1e10;

/// Most systems of equations into which what is left beside families is divided.
const MOST_PARTS: usize = 32;

/// Returns the systems of all solutions at which for each family some standing joint stands elsewhere. No solution is in two of them: where
/// the joint stands elsewhere, all earlier ones stand as on the family. `None` for too many.
fn elsewhere(system: &System, cycle: &Cycle, families: &[Standing]) -> Option<Vec<System>> {
    let constant = |x: &Rational| Equation::from_rational(x);
    // What is added to the equations, and the factors that are not 0.
    let mut parts: Vec<(Vec<Equation>, Equation)> = vec![(Vec::new(), Equation::one())];
    for family in families {
        let mut more = Vec::new();
        for (equations, factor) in &parts {
            let mut equations = equations.clone();
            for (index, [one, other]) in family {
                let step = cycle.indices.iter().position(|own| own == index)?;
                let [x, y] = &system.unknowns[step];
                let (a, b) = (constant(one)?, constant(other)?);
                // Of two angles the cosine of the difference is 1 only if they agree.
                let gap = match cycle.steps[step].variable {
                    Variable::Rotation => Equation::one().sub(&x.mul(&a)).sub(&y.mul(&b)),
                    Variable::Translation => x.sub(&a),
                };
                more.push((equations.clone(), factor.mul(&gap)));
                equations.extend([x.sub(&a), y.sub(&b)]);
            }
        }
        parts = more;
        if parts.len() > MOST_PARTS {
            return None;
        }
    }
    let inverse = Equation::variable(system.variables);
    let with = |(equations, factor): (Vec<Equation>, Equation)| {
        let mut part = System { variables: system.variables + 1, ..system.clone() };
        part.equations.extend(equations);
        part.equations.push(factor.mul(&inverse).sub(&Equation::one()));
        part
    };
    Some(parts.into_iter().map(with).collect())
}

/// The closure equations; `None` for too many unknowns.
fn system(cycle: &Cycle) -> Option<System> {
    match &cycle.before {
        Some(before) => System::of_point(&cycle.steps, &before.inverse().translation),
        None => System::of_loop(&cycle.steps),
    }
}

/// Names the equations of a loop.
fn equations(cycle: &Cycle) -> &'static str {
    match cycle.before {
        Some(_) => "the equations by which the centre of the S joint is reached from both sides",
        None => "the closure equations",
    }
}

fn reason(cycle: &Cycle, points: &Points) -> String {
    let of = equations(cycle);
    if points.count == 0 {
        return format!("no solution: 1 is a combination of {of}, over the rationals");
    }
    let multiple: usize = points.distinct.iter().filter(|p| p.multiplicity > 1).map(|p| p.multiplicity).sum();
    let distinct = points.distinct.len();
    let also = if multiple == 0 { String::new() } else { format!(", {distinct} distinct ones") };
    format!("all {} solutions{also} of {of}, by a Gröbner basis over the rationals", points.count)
}

/// The order of solutions in a list: real ones first.
pub(super) fn in_order(a: &FullMode, b: &FullMode) -> std::cmp::Ordering {
    let key = |mode: &FullMode| mode.q.iter().map(|z| (z.re, z.im)).collect::<Vec<_>>();
    b.real.cmp(&a.real).then_with(|| key(a).partial_cmp(&key(b)).unwrap_or(std::cmp::Ordering::Equal))
}
