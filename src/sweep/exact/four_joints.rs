//! Loops of four joints with fewer than six unknowns: planar and spherical four-bars, Bennett's loop, slider-cranks.
//!
//! The loop is `V1 C1 V2 C2 V3 C3 = I`, with the input inside C3. Where joints 2 and 3 turn, `C3 V1 C1 = K` must be
//! `Rz(-q3) L Rz(-q2)` with `L = C2^-1`. It is exactly where the axis z and the origin, carried by K and by L, have the
//! same coordinates but for a turn about z: five equations in the input and the output V1. Both angles follow from them
//! uniquely, unless L carries axis and origin to places on the axis z.

use super::plane_curve::integral_form;
use super::relation::{Content, InOutput, Relation};
use crate::algebra::circle_fraction::CircleFraction;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use crate::elimination::separated::powers;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use crate::kinematics::motion::{Motion, Vector, cross, dot};

/// One of the three joints behind the input and what stands behind it.
struct Bar {
    joint: usize,
    kind: Variable,
    behind: Motion<CircleFraction>,
}

/// The relations with the joints on both sides of the input as outputs; `joints` says which joint variable each unknown
/// is, the others stand still.
pub(super) fn relations(closed: &ClosedLoop<CircleFraction>, joints: [Option<usize>; 6]) -> Vec<Relation> {
    let bars = bars(closed, joints);
    let [one, two, three] = bars.as_slice() else { return Vec::new() };
    let turns = |bar: &Bar| bar.kind == Variable::Rotation;
    let first = (turns(two) && turns(three)).then(|| relation(one, &three.behind, &one.behind, &two.behind));
    let last = (turns(one) && turns(two)).then(|| relation(three, &two.behind, &three.behind, &one.behind));
    [first, last].into_iter().flatten().flatten().collect()
}

/// The joints that move, unknowns that stand still taken into what stands behind the joint before.
fn bars(closed: &ClosedLoop<CircleFraction>, joints: [Option<usize>; 6]) -> Vec<Bar> {
    let mut bars: Vec<Bar> = Vec::new();
    let mut leading = Motion::identity();
    for (k, joint) in joints.into_iter().enumerate() {
        let constant = closed.constants[k].clone();
        match (joint, bars.last_mut()) {
            (Some(joint), _) => bars.push(Bar { joint, kind: closed.variables[k], behind: constant }),
            (None, Some(last)) => last.behind = last.behind.then_after(&constant),
            (None, None) => leading = leading.then_after(&constant),
        }
    }
    if let Some(last) = bars.last_mut() {
        last.behind = last.behind.then_after(&leading);
    }
    bars
}

/// The relation of `before V behind = Rz L Rz` with `L` the inverse of a link; `None` where the two angles are not
/// determined.
fn relation(
    output: &Bar,
    before: &Motion<CircleFraction>,
    behind: &Motion<CircleFraction>,
    link: &Motion<CircleFraction>,
) -> Option<Relation> {
    let link = link.inverse();
    let axis: Vector<CircleFraction> = std::array::from_fn(|i| link.rotation[i][2].clone());
    let origin = &link.translation;
    if axis[..2].iter().chain(&origin[..2]).all(Ring::is_zero) {
        return None;
    }
    let (scale, turned_axis, turned_origin) = carried(output.kind, before, behind);
    let square = scale.mul(&scale);
    let less = |x: InOutput, factor: &InOutput, y: CircleFraction| x.sub(&factor.scale(&y));
    let equations = [
        less(turned_axis[2].clone(), &scale, axis[2].clone()),
        less(turned_origin[2].clone(), &scale, origin[2].clone()),
        less(dot(&turned_axis, &turned_origin), &square, dot(&axis, origin)),
        less(dot(&turned_origin, &turned_origin), &square, dot(origin, origin)),
        less(cross(&turned_axis, &turned_origin)[2].clone(), &square, cross(&axis, origin)[2].clone()),
    ];
    let simple = scale.degree().unwrap_or(0).max(usize::from(output.kind == Variable::Translation));
    let degrees = [simple, simple, 2 * simple, 2 * simple, 2 * simple];
    let equations = equations.iter().zip(degrees).map(|(f, degree)| integral_form(f, degree)).collect();
    Some(Relation { content: Content::Standing, ..Relation::of(output.joint, output.kind, equations) })
}

/// The images of the axis z and of the origin by `before V behind`, both times the first polynomial.
fn carried(
    kind: Variable,
    before: &Motion<CircleFraction>,
    behind: &Motion<CircleFraction>,
) -> (InOutput, Vector<InOutput>, Vector<InOutput>) {
    let lifted = |motion: &Motion<CircleFraction>| Motion {
        rotation: motion.rotation.each_ref().map(|row| row.each_ref().map(|x| Univariate::constant(x.clone()))),
        translation: motion.translation.each_ref().map(|x| Univariate::constant(x.clone())),
    };
    let (before, behind) = (lifted(before), lifted(behind));
    let axis: Vector<InOutput> = std::array::from_fn(|i| behind.rotation[i][2].clone());
    let origin = [1, 1, 0].map(CircleFraction::from_integer);
    let [one, cos, sin] = powers(Variable::Rotation, &origin).map(|row| Univariate::new(row.to_vec()));
    let moved = |[x, y, z]: &Vector<InOutput>| -> Vector<InOutput> {
        [x.mul(&cos).sub(&y.mul(&sin)), x.mul(&sin).add(&y.mul(&cos)), z.mul(&one)]
    };
    let (scale, axis, place) = match kind {
        Variable::Rotation => (one.clone(), moved(&axis), moved(&behind.translation)),
        Variable::Translation => {
            let [x, y, z] = behind.translation.clone();
            (Univariate::one(), axis, [x, y, z.add(&Univariate::x())])
        }
    };
    let place = before.rotate(&place);
    let place = std::array::from_fn(|i| place[i].add(&before.translation[i].mul(&scale)));
    (scale, before.rotate(&axis), place)
}
