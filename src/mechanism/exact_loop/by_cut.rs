//! Loops of five unknowns by a cut: all their solutions, where each of them is simple.
//!
//! A Gröbner basis of that many unknowns takes long. The cut hides one unknown, and over the roots of a polynomial in its
//! half tangent linear algebra gives the others (docs/mobility.md, theorem 3).

use super::configuration::Configuration;
use super::cycle::Cycle;
use super::roots::{Root, roots};
use crate::algebra::disc::Disc;
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::{Field, Ring};
use crate::exact::{Conjugates, JointValue, Linkage, Positions, positions};
use crate::kinematics::closed_loop::Variable;
use crate::kinematics::motion::Motion;
use rug::Rational;

/// Bits in which values are tried: doubled each time, up to the last.
const BITS: [u32; 4] = [160, 320, 640, 1280];

/// Solutions whose values are the same expressions in the roots of one polynomial.
struct Family {
    /// Cosine and sine of each unknown, or its distance.
    values: Vec<[Vec<Rational>; 2]>,
    roots: Vec<Root>,
}

/// A solution: whether it is real, and its values.
pub(super) type Found = (bool, Configuration);

/// All solutions of a loop of rotations and translations, each a simple one; `None` where some may not be, where there may be
/// infinitely many and where values need more digits than anything.
pub(super) fn solutions(cycle: &Cycle) -> Option<Vec<Found>> {
    let variables = cycle.steps.iter().map(|step| step.variable).collect();
    let behind = cycle.steps.iter().map(|step| step.behind.clone());
    let linkage = Linkage::of_motions(variables, std::iter::once(Motion::identity()).chain(behind).collect())?;
    let Positions::Finite { found, .. } = positions(&linkage) else { return None };
    let mut list = Vec::new();
    for conjugates in &found {
        if !conjugates.are_regular(&linkage) {
            return None;
        }
        let family = Family::of(cycle, conjugates)?;
        for root in &family.roots {
            list.push((root.is_real(), family.at(cycle, root)?));
        }
    }
    Some(list)
}

impl Family {
    fn of(cycle: &Cycle, conjugates: &Conjugates) -> Option<Self> {
        let value = |(step, value)| value_of(step, value).map(|x| x.each_ref().map(Algebraic::coefficients));
        let variables = cycle.steps.iter().map(|step| step.variable);
        let values: Option<Vec<_>> = variables.zip(&conjugates.values).map(value).collect();
        let roots = match &conjugates.polynomial {
            None => vec![Root::Rational(Rational::new())],
            Some(polynomial) => roots(polynomial)?,
        };
        Some(Self { values: values?, roots })
    }

    fn at(&self, cycle: &Cycle, root: &Root) -> Option<Configuration> {
        BITS.into_iter().find_map(|bits| {
            let root = root.ball(bits)?;
            let value = |(variable, pair): (Variable, &[Vec<Rational>; 2])| {
                let [one, other] = pair.each_ref().map(|x| root.evaluate(x));
                if variable == Variable::Rotation { Disc::angle(&one, &other) } else { Some(one) }
            };
            let variables = cycle.steps.iter().map(|step| step.variable);
            let values: Option<Vec<Disc>> = variables.zip(&self.values).map(value).collect();
            let found = Configuration { values: values?, spherical: None };
            found.is_good().then_some(found)
        })
    }
}

/// Cosine and sine of the angle with half an angle of `c : s`, or the distance `2 s/c` and 0.
fn value_of(variable: Variable, [c, s]: &JointValue<Algebraic>) -> Option<[Algebraic; 2]> {
    let twice = |x: &Algebraic| x.add(x);
    if variable == Variable::Translation {
        return Some([twice(s).mul(&c.inverse()?), Algebraic::zero()]);
    }
    let (cc, ss) = (c.mul(c), s.mul(s));
    let over = cc.add(&ss).inverse()?;
    Some([cc.sub(&ss).mul(&over), twice(&c.mul(s)).mul(&over)])
}
