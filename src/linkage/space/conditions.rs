//! What vanishes because of a joint, over any ring.

use crate::algebra::ring::Ring;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::space::{SpaceJoint, SpacePair};
use rug::Rational;

fn difference<R: Ring>(a: &Vector<R>, b: &Vector<R>) -> Vector<R> {
    std::array::from_fn(|k| a[k].sub(&b[k]))
}

/// Returns the polynomials that vanish because of a joint where its bodies stand at these places. `number` is the image of a
/// rational number.
pub fn conditions<R: Ring>(
    joint: &SpaceJoint,
    places: [&Motion<R>; 2],
    number: impl Fn(&Rational) -> R + Copy,
) -> Vec<R> {
    let constant = |v: &Vector<Rational>| v.each_ref().map(number);
    let [one, two] = [0, 1].map(|side| places[side].apply(&constant(&joint.at[side])));
    let apart = difference(&one, &two);
    let direction = |side: usize, v: &Vector<Rational>| places[side].rotate(&constant(v));
    let square = |square: &Rational| dot(&apart, &apart).sub(&number(square));
    match &joint.pair {
        SpacePair::Spherical => apart.to_vec(),
        SpacePair::Universal([a, b]) => [apart.as_slice(), &[dot(&direction(0, a), &direction(1, b))]].concat(),
        SpacePair::Rod(length) => vec![square(length)],
        SpacePair::Leg => Vec::new(),
        SpacePair::UniversalLeg([a, b]) => vec![dot(&cross(&direction(0, a), &direction(1, b)), &apart)],
        SpacePair::Parallelogram([a, b], length) => {
            let turned = difference(&direction(0, a), &direction(1, b));
            [turned.as_slice(), &[square(length)]].concat()
        }
        SpacePair::Revolute(axis) => {
            let [u, v] = [0, 1].map(|side| direction(side, &axis.sphere.at[side]));
            [apart, difference(&u, &v)].concat()
        }
        SpacePair::Prismatic(axis) => {
            let along = cross(&direction(0, &axis.sphere.at[0]), &apart);
            let frame = [0, 1, 2].map(|k| std::array::from_fn(|i| Rational::from(u8::from(i == k))));
            let turned = frame.map(|unit| difference(&direction(0, &axis.home.rotate(&unit)), &direction(1, &unit)));
            [along].into_iter().chain(turned).flatten().collect()
        }
    }
}
