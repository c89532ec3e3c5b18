//! The freedoms of joints about a configuration: each a half-angle tangent or a displacement, about lines in axes of the ground.

use crate::algebra::ring::Ring;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector, cross};
use crate::kinematics::space::{SpaceJoint, SpacePair};
use looproot_calculus::line::pluecker::Line;
use rug::Rational;

/// A variable `u`: the second body moves by the product of `1 + u l` over its lines `l`. A line without a direction is a translation
/// along its moment.
pub(super) type Freedom = Vec<Line<Rational>>;

fn zero() -> Vector<Rational> {
    std::array::from_fn(|_| Rational::new())
}

fn is_zero(v: &Vector<Rational>) -> bool {
    v.iter().all(|c| *c == 0)
}

fn unit(k: usize) -> Vector<Rational> {
    std::array::from_fn(|i| Rational::from(u8::from(i == k)))
}

/// A direction across another one.
fn across(direction: &Vector<Rational>) -> Vector<Rational> {
    let least = (0..3).min_by_key(|k| Rational::from(direction[*k].abs_ref())).unwrap_or(0);
    cross(direction, &unit(least))
}

fn along(direction: &Vector<Rational>) -> Freedom {
    vec![Line { direction: zero(), moment: direction.clone() }]
}

fn about(point: &Vector<Rational>, direction: &Vector<Rational>) -> Freedom {
    vec![Line::at(point, direction)]
}

/// The opposite of a line.
pub(super) fn opposite(line: &Line<Rational>) -> Line<Rational> {
    let negative = |v: &Vector<Rational>| v.each_ref().map(Ring::neg);
    Line { direction: negative(&line.direction), moment: negative(&line.moment) }
}

/// Returns the freedoms of a joint at these places of its bodies, from the first body to the second. Rods do not spin.
pub(super) fn freedoms(joint: &SpaceJoint, places: [&Motion<Rational>; 2]) -> Result<Vec<Freedom>> {
    let [p, q] = [0, 1].map(|side| places[side].apply(&joint.at[side]));
    let leg: Vector<Rational> = std::array::from_fn(|k| Rational::from(&q[k] - &p[k]));
    let ball = |at: &Vector<Rational>| [0, 1, 2].map(|k| about(at, &unit(k)));
    let tilt = |at: &Vector<Rational>| {
        let first = across(&leg);
        [about(at, &first), about(at, &cross(&leg, &first))]
    };
    let degenerate = |what: &str| {
        Err(Error::Unsupported(format!(
            "the mobility of a linkage at a place where {what} at the joint {}",
            joint.name
        )))
    };
    let has_leg = matches!(joint.pair, SpacePair::Rod(_) | SpacePair::Leg | SpacePair::UniversalLeg(_));
    if has_leg && is_zero(&leg) {
        return degenerate("the ends of a leg coincide");
    }
    Ok(match &joint.pair {
        SpacePair::Revolute(axis) => vec![about(&p, &places[0].rotate(&axis.sphere.at[0]))],
        SpacePair::Prismatic(axis) => vec![along(&places[0].rotate(&axis.sphere.at[0]))],
        SpacePair::Spherical => ball(&p).to_vec(),
        SpacePair::Universal([a, b]) => vec![about(&p, &places[0].rotate(a)), about(&p, &places[1].rotate(b))],
        SpacePair::Rod(_) => tilt(&p).into_iter().chain(ball(&q)).collect(),
        SpacePair::Leg => tilt(&p).into_iter().chain([along(&leg)]).chain(ball(&q)).collect(),
        SpacePair::UniversalLeg([a, b]) => {
            let (n, m) = (places[0].rotate(a), places[1].rotate(b));
            let [first, second] = [cross(&n, &leg), cross(&m, &leg)];
            if is_zero(&first) || is_zero(&second) {
                return degenerate("a leg has the direction of an axis");
            }
            vec![about(&p, &n), about(&p, &first), along(&leg), about(&q, &first), about(&q, &m)]
        }
        SpacePair::Parallelogram([a, _], _) => {
            let axis = places[0].rotate(a);
            let second = cross(&axis, &leg);
            if is_zero(&second) {
                return degenerate("the rods have the direction of the axes");
            }
            let circle = vec![Line::at(&p, &second), opposite(&Line::at(&q, &second))];
            vec![about(&p, &axis), circle, about(&q, &axis)]
        }
    })
}
