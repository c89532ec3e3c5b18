//! Double solutions at points with algebraic coordinates: theorem 15 of docs/certificate.md.

use super::algebraic::{Far, Points, constant, exact_solutions};
use super::chain::ChainClosure;
use super::deflated::double_solution;
use super::enclosing::Enclosing;
use super::fault::{Fault, refused};
use super::mode::Ball;
use super::reconstructed::item;
use super::refine::{Near, short_centre};
use crate::algebra::number_field::Algebraic;
use crate::algebra::ring::Ring;
use crate::kinematics::joint::Variable;
use crate::kinematics::motion::{Motion, Vector, cross};
use rug::Rational;
use serde_json::{Value, json};

/// The kind of the item.
pub(super) const KIND: &str = "double";
/// The factors by which rows are added up, and columns: other ones might hide that a form is not 0.
const ROW: [i32; 6] = [1, 2, 4, 7, 11, 16];
/// See [`ROW`].
const COLUMN: [i32; 6] = [1, -3, 5, 2, -7, 4];

/// Denominator of the radius of a double solution: it is known to thirty decimals.
const PARTS: u64 = 1_000_000_000_000;

/// A screw: direction and moment.
type Screw = [Vector<Algebraic>; 2];

/// Returns the points of an item, at each of which a loop of six unknowns has a solution of multiplicity 2.
pub(super) fn double_solutions(closure: &ChainClosure, item: &Value) -> Result<Points, Fault> {
    if closure.own != 6 {
        return refused("proof: double: only bounds of loops of six unknowns are covered");
    }
    let points = exact_solutions(closure, item)?;
    let motions = closure.own_links.as_ref().and_then(|links| points.standing(links));
    let Some(motions) = motions else { return refused("proof: double: the loop is not closed there") };
    check(&points, &screws(closure, &motions))?;
    Ok(points)
}

/// Returns balls around double solutions, and the item of theorem 15 about them; `None` if their coordinates have too many digits. The item
/// is not checked.
#[must_use]
pub fn proof_of_doubles(closure: &ChainClosure, near: &[Near]) -> Option<(Vec<Ball>, Value)> {
    let found = near.iter().map(|(x, _)| double_solution(closure, x)).collect::<Option<Vec<_>>>()?;
    let coordinates = |x: &Vec<(Rational, Rational)>| {
        let own = x.iter().zip(closure.variables).map(|(x, variable)| match variable {
            Variable::Rotation => {
                let (cos, sin) = Far::cos_sin_about(x, 0.0);
                vec![cos.midpoint(), sin.midpoint()]
            }
            Variable::Translation => vec![Far::about(x, 0.0).midpoint()],
        });
        own.collect()
    };
    let points: Vec<Vec<Vec<Far>>> = found.iter().map(coordinates).collect();
    let mut item = item(&points)?;
    item["kind"] = json!(KIND);
    let ball = |(x, (_, real)): (&Vec<(Rational, Rational)>, &Near)| {
        let centre = short_centre(closure, x.clone(), *real)?;
        Some(Ball { centre, radius: Rational::from((1, PARTS)), real: *real })
    };
    Some((found.iter().zip(near).map(ball).collect::<Option<_>>()?, item))
}

/// Returns the joint screws, seen from the first frame.
fn screws(closure: &ChainClosure, motions: &[Motion<Algebraic>]) -> Vec<Screw> {
    let mut before = Motion::<Algebraic>::identity();
    let screw = |(variable, motion): (&Variable, &Motion<Algebraic>)| {
        let axis = before.rotation.each_ref().map(|row: &Vector<Algebraic>| row[2].clone());
        let screw = match variable {
            Variable::Rotation => [axis.clone(), cross(&before.translation, &axis)],
            Variable::Translation => [std::array::from_fn(|_| Algebraic::zero()), axis],
        };
        before = before.then_after(motion);
        screw
    };
    closure.variables.iter().zip(motions).map(screw).collect()
}

/// Returns the commutator of two screws.
fn bracket([w, v]: &Screw, [x, y]: &Screw) -> Screw {
    let (one, other) = (cross(w, y), cross(v, x));
    [cross(w, x), std::array::from_fn(|k| one[k].add(&other[k]))]
}

/// Returns a determinant by the minors of the first rows, of all choices of columns, which are bits.
fn determinant(rows: &[Vec<Algebraic>]) -> Algebraic {
    let count = rows.len();
    let mut minors = vec![Algebraic::zero(); 1 << count];
    minors[0] = Algebraic::one();
    for columns in 1_usize..1 << count {
        let row = &rows[columns.count_ones() as usize - 1];
        minors[columns] = (0..count).filter(|k| columns >> k & 1 == 1).fold(Algebraic::zero(), |sum, k| {
            let term = row[k].mul(&minors[columns & !(1 << k)]);
            let behind = columns >> (k + 1);
            if behind.count_ones() % 2 == 0 { sum.add(&term) } else { sum.sub(&term) }
        });
    }
    minors.pop().unwrap_or_else(Algebraic::one)
}

/// Checks that at every point the six screws have the rank 5, and the loop opens to second order along the motion that is left.
fn check(points: &Points, screws: &[Screw]) -> Result<(), Fault> {
    let flat: Vec<Vec<&Algebraic>> = screws.iter().map(|screw| screw.iter().flatten().collect()).collect();
    let rows: Vec<Vec<Algebraic>> = (0..6).map(|i| flat.iter().map(|screw| screw[i].clone()).collect()).collect();
    if determinant(&rows) != Algebraic::zero() {
        return refused("proof: double: the joint screws are independent at a point");
    }
    let whole = |n: i32| constant(&Rational::from(n));
    let motion: Vec<Algebraic> = (0..6)
        .map(|k| {
            let mut rows = rows.clone();
            rows.iter_mut().zip(COLUMN).for_each(|(row, own)| row[k] = whole(own));
            determinant(&rows)
        })
        .collect();
    let wrench: Vec<Algebraic> = (0..6)
        .map(|i| {
            let mut rows = rows.clone();
            rows[i] = ROW.map(whole).to_vec();
            determinant(&rows)
        })
        .collect();
    let mut opening = Algebraic::zero();
    for k in 0..6 {
        for j in 0..k {
            let bracket = bracket(&screws[j], &screws[k]);
            let force = wrench.iter().zip(bracket.iter().flatten());
            let force = force.fold(Algebraic::zero(), |sum, (w, x)| sum.add(&w.mul(x)));
            opening = opening.add(&force.mul(&motion[j]).mul(&motion[k]));
        }
    }
    if opening.polynomial().gcd(&points.polynomial).degree() != Some(0) {
        return refused("proof: double: the loop opens at a point to a higher order than the second one");
    }
    Ok(())
}
