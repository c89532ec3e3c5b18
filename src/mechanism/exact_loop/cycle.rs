//! A loop at an input, or an arm at a pose, as a list of unknowns and the constants between them.

use super::equations::Step;
use crate::catalogue::entry::Case;
use crate::error::Result;
use crate::kinematics::chain::Chain;
use crate::kinematics::closed_loop::Layout;
use crate::kinematics::motion::Motion;
use crate::mechanism::single_loop::closing_transformation;
use rug::Rational;

/// The unknowns of a loop but those of a spherical joint.
pub(crate) struct Cycle {
    /// The unknowns in loop order.
    pub steps: Vec<Step>,
    /// Index of the joint variable of each of them.
    pub indices: Vec<usize>,
    /// The constant between the spherical joint and the first of them, if there is such a joint: the steps follow it.
    pub before: Option<Motion<Rational>>,
}

impl Cycle {
    /// The unknowns of a loop with at most one spherical joint, none of whose angles is given; `None` for others.
    ///
    /// # Errors
    /// For a case without input that has one.
    pub fn of(chain: &Chain, layout: &Layout, case: &Case) -> Result<Option<Self>> {
        let is_inside =
            |spherical: usize| layout.locked.is_some_and(|locked| (spherical..spherical + 3).contains(&locked));
        if layout.second_spherical.is_some() || layout.spherical.is_some_and(is_inside) {
            return Ok(None);
        }
        let Some((variables, mut constants)) = chain.unknowns_and_constants::<Rational>() else { return Ok(None) };
        let closing = closing_transformation::<Rational>(case)?;
        // The constant before the first variable comes behind the last one, and behind the pose of an arm.
        let start = constants.remove(0);
        if let Some(end) = constants.last_mut() {
            *end = if layout.locked.is_none() { end.then_after(&closing) } else { end.clone() }.then_after(&start);
        }
        let mut items: Vec<_> = variables.into_iter().zip(constants).enumerate().collect();
        items.rotate_left(layout.spherical.map_or(0, |spherical| spherical + 2));
        let mut found = Self { steps: Vec::new(), indices: Vec::new(), before: None };
        // The constant before the first unknown.
        let mut first = Motion::identity();
        for (index, (variable, behind)) in items {
            if layout.spherical == Some(index) {
                break;
            }
            let is_given = layout.locked == Some(index);
            if is_given || layout.spherical.is_some_and(|spherical| index == spherical + 2) {
                let constant = if is_given { closing.then_after(&behind) } else { behind };
                let last = found.steps.last_mut().map_or(&mut first, |step| &mut step.behind);
                *last = last.then_after(&constant);
            } else {
                found.steps.push(Step { variable, behind });
                found.indices.push(index);
            }
        }
        if layout.spherical.is_some() {
            found.before = Some(first);
            return Ok(Some(found));
        }
        // Conjugation carries it behind the last unknown.
        let Some(last) = found.steps.last_mut() else { return Ok(None) };
        last.behind = last.behind.then_after(&first);
        Ok(Some(found))
    }
}
