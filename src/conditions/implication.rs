//! Mobility of a family because closure implies its condition: Lee's invariant of a cut.
//!
//! Between two opposite joints of a 6R loop with axes n, n' and the vector r from one to the other, `n . n'` and
//! `r^2 (n . n') - 2 (n . r)(n' . r)` do not depend on the rotations of these two joints. Suppose that on either side of the loop
//! the second is the first times a number made of lengths, `mu` on one side and `mu'` on the other. Then closure implies
//! `(n . n')(mu - mu') = 0`. Every component of the set of all closed positions of all members with `n . n'` not 0 then has members
//! on the condition only, and is as large as without it, so the position moves (docs/conditions_search.md).

use super::configurations::link_motion;
use crate::algebra::polynomial::Polynomial;
use crate::algebra::ring::{Domain, Ring};
use crate::catalogue::ansatz::{Ansatz, Link};
use crate::kinematics::motion::{Motion, dot};
use rug::Rational;

/// A cut for which closure implies the condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Implication {
    /// The first joint of the cut, counted from 0; the second is the opposite one.
    pub joint: usize,
}

type Symbol = Polynomial<Rational>;

/// Returns a cut of a 6R loop with constant twists for which closure implies the relation; `None` if there is none of this kind.
///
/// # Panics
/// Unless there are six joints.
///
/// # Source
/// \[LeeLiang1988\] for the invariant.
#[must_use]
pub fn implication(ansatz: &Ansatz, relation: &Polynomial<Rational>) -> Option<Implication> {
    assert_eq!(ansatz.joints.len(), 6, "six joints");
    let symbols = &ansatz.symbols;
    if !symbols.angles.is_empty() || ansatz.free_lengths().len() < symbols.lengths.len() {
        return None;
    }
    let links: Vec<Link<Symbol>> = ansatz
        .joints
        .iter()
        .map(|joint| {
            let (cos, sin) = joint.alpha.cos_sin(&[])?;
            Some(Link { cos, sin, a: joint.a.clone(), d: joint.d.clone() })
        })
        .collect::<Option<_>>()?;
    let first = symbols.lengths.len();
    let implied = |&joint: &usize| {
        let both = || {
            let one = factor(&links, joint, first)?;
            let other = factor(&links, joint + 3, first)?;
            one.sub(&other).checked_div_exact(relation)?.to_constant().filter(|c| !c.is_zero())
        };
        both().is_some()
    };
    (0..3).find(implied).map(|joint| Implication { joint })
}

/// Returns the ratio of Lee's invariant of three links from a joint on to the cosine between the axes; `None` if it is no
/// number made of lengths.
fn factor(links: &[Link<Symbol>], from: usize, first: usize) -> Option<Symbol> {
    let cos = |joint: usize| first + 2 * joint;
    let sin = |joint: usize| first + 2 * joint + 1;
    let mut motion = link_motion(&links[from % 6]);
    for joint in [(from + 1) % 6, (from + 2) % 6] {
        let turn = Motion::rotation_z(Symbol::variable(cos(joint)), Symbol::variable(sin(joint)));
        motion = motion.then_after(&turn).then_after(&link_motion(&links[joint]));
    }
    let r = &motion.translation;
    let axis = std::array::from_fn(|i| motion.rotation[i][2].clone());
    let between = motion.rotation[2][2].clone();
    let product = r[2].mul(&dot(&axis, r));
    let lee = dot(r, r).mul(&between).sub(&product).sub(&product);
    let reduced = |p: Symbol| (0..6).fold(p, |p, joint| on_the_circle(&p, cos(joint), sin(joint)));
    let quotient = reduced(lee).checked_div_exact(&reduced(between))?;
    let is_free = (0..6).all(|joint| quotient.degree(cos(joint)) + quotient.degree(sin(joint)) == 0);
    is_free.then_some(quotient)
}

/// Returns the remainder modulo `cos^2 + sin^2 - 1`, linear in the sine.
fn on_the_circle(p: &Symbol, cos: usize, sin: usize) -> Symbol {
    let cos = Symbol::variable(cos);
    let square = Symbol::one().sub(&cos.mul(&cos));
    let mut power = Symbol::one();
    let mut parts = [Symbol::zero(), Symbol::zero()];
    for (degree, coefficient) in p.coefficients_in(sin).iter().enumerate() {
        if degree > 0 && degree % 2 == 0 {
            power = power.mul(&square);
        }
        parts[degree % 2] = parts[degree % 2].add(&coefficient.mul(&power));
    }
    Symbol::from_coefficients_in(sin, &parts)
}
