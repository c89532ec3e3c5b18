//! What stands beside a self-motion of an overconstrained loop at an input: the family as f64 sees it, and the isolated solutions, exactly.

use super::{Ladder, NEARLY_ZERO, OverconstrainedLoop, Rung};
use crate::algebra::approximation::simplest_within;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::closed_loop::Variable;
use crate::mechanism::exact_loop::{Question, Standing};
use crate::mechanism::family::Joints;
use crate::mechanism::single_loop::{is_exact, locked_value};
use crate::mechanism::vicinity::{Place, scaled};
use crate::mechanism::{Family, FullMode};
use crate::solve::curve::CLOSES_WITHIN;
use crate::solve::self_motion::SelfMotion;
use crate::verdict::Verdict;
use rug::{Float, Rational};

/// A number within this of a point of a family may stand for its coordinate. A wrong one leaves infinitely many solutions, and nothing is listed.
const NEAR: f64 = 1e-9;

/// The answer of a loop that moves.
pub(super) struct Beside {
    pub verdict: Verdict,
    pub modes: Vec<FullMode>,
    pub families: Vec<Family>,
}

impl OverconstrainedLoop {
    /// Adds to the verdict of a self-motion what is known of it and beside it.
    pub(super) fn beside(
        &self,
        ladder: &Ladder,
        case: &Case,
        verdict: Verdict,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Beside> {
        let mut families: Vec<Family> = Vec::new();
        for rung in &ladder.rungs {
            families = self.families(rung, case, workspace, assembly)?;
            if !families.is_empty() {
                break;
            }
        }
        let mut found = Beside { verdict, modes: Vec::new(), families };
        let standing: Option<Vec<Standing>> = found.families.iter().map(|family| standing(family, ladder)).collect();
        let Some(standing) = standing.filter(|standing| !standing.is_empty()) else { return Ok(found) };
        let is_rounded = self.is_rounded || !is_exact(case);
        let question = Question { chain: &self.chain, layout: &ladder.layout, case, limits: &self.limits, is_rounded };
        if let Some((modes, count)) = question.beside(&standing)? {
            let verdict = &mut found.verdict;
            verdict.complex = count;
            verdict.real = modes.iter().filter(|mode| mode.real).map(|mode| mode.multiplicity).sum();
            verdict.certified = modes.iter().filter(|mode| mode.certified).count();
            verdict.reason += "; the isolated ones are all at which a joint that stands on the families listed stands elsewhere, by further bases";
            found.modes = modes;
        }
        Ok(found)
    }

    /// The families of the loop with virtual joints along which these stay at 0.
    fn families(
        &self,
        rung: &Rung,
        case: &Case,
        workspace: &mut Workspace,
        assembly: &mut Assembly,
    ) -> Result<Vec<Family>> {
        let most = *rung.most.get_or_init(|| self.most(&rung.layout));
        self.candidates(rung, case, Roots::All, most, workspace, assembly)?;
        let (closed, scale) = rung.solver.closed(&self.gap(rung, case)?);
        let is_idle = rung.layout.joint_variables().map(|joint| joint.is_none());
        let stays = |motion: &&SelfMotion| {
            let is_zero = |point: &[f64; 6]| (0..6).all(|k| !is_idle[k] || point[k].abs() < NEARLY_ZERO);
            (0..6).all(|k| !(is_idle[k] && motion.moving[k])) && motion.points.iter().all(is_zero)
        };
        let place = Place { layout: &rung.layout, locked: locked_value(case), closed: &closed, scale };
        let joints = Joints { variables: &rung.layout.variables, limits: &self.limits };
        let list = assembly.families.iter().filter(stays).flat_map(|motion| {
            let inside = scaled(motion, &closed, 1.0 / scale);
            place.families(joints, (&inside, 0.0), CLOSES_WITHIN)
        });
        Ok(list.collect())
    }
}

/// The joints that stand along a family, where their places are rational numbers of few digits; `None` where one is not.
fn standing(family: &Family, ladder: &Ladder) -> Option<Standing> {
    let stands = |k: &usize| !family.moving.contains(k) && ladder.layout.locked != Some(*k);
    let place = |k: usize| {
        let value = family.sample[k];
        let simple = |x: f64| simplest_within(&Float::with_val(64, x), &Float::with_val(64, NEAR));
        let numbers = match ladder.layout.variables[k] {
            Variable::Rotation => [simple(value.cos()), simple(value.sin())],
            Variable::Translation => [simple(value), Rational::new()],
        };
        let is_on_circle = || numbers.iter().map(|x| Rational::from(x * x)).sum::<Rational>() == 1;
        (ladder.layout.variables[k] == Variable::Translation || is_on_circle()).then_some((k, numbers))
    };
    (0..family.sample.len()).filter(stands).map(place).collect()
}
