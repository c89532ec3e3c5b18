//! Velocity and acceleration of every body of an assembly in space.
//!
//! The joints are equations over series in time. Their first coefficients are linear in the velocities of the bodies, and their
//! second ones in half the accelerations, with the same matrix.

use super::answer::{SpaceMode, bodies as all_bodies};
use super::clusters::{clusters, open_joints};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::algebra::series::Series;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::space::{SpaceGiven, SpaceJoint, SpaceLinkage, SpacePair};
use crate::mechanism::Moving;
use looproot_calculus::displacement::velocity::State;
use looproot_calculus::finite::finite;
use looproot_calculus::unit::Root;
use nalgebra::{DMatrix, DVector};
use rug::Rational;

/// A number in time: value, velocity and half the acceleration.
type Scalar = Series<f64, 3>;

/// A singular value below this share of the largest one stands for 0.
const SINGULAR: f64 = 1e-10;
/// Rates that leave more than this share of the right side contradict each other.
const OPEN: f64 = 1e-8;

/// The motion of all bodies at an instant, in axes of the ground.
#[derive(Clone, Debug)]
pub struct SpaceRates {
    /// The place of every body with its rate and half its acceleration.
    pub bodies: Vec<Moving>,
    /// Rate and acceleration of every joint that has a value.
    pub joints: Vec<Option<[f64; 2]>>,
}

/// Returns the motion of a real assembly where the first input runs at unit rate and the others stand; `None` at a position where
/// the inputs do not determine the rates. Rods between two spherical joints do not spin.
#[must_use]
pub fn rates(linkage: &SpaceLinkage, given: &[SpaceGiven], mode: &SpaceMode) -> Option<SpaceRates> {
    let places: Vec<Motion<f64>> = mode.bodies.iter().map(|place| place.map(|z| Some(z.re))).collect::<Option<_>>()?;
    let moved: Vec<usize> = (0..places.len()).filter(|body| *body != linkage.ground).collect();
    given.first()?.joint?;
    let zero = State { omega: [0.0; 3], alpha: [0.0; 3], velocity: [0.0; 3], acceleration: [0.0; 3] };
    let moving = |states: &[State<f64>]| -> Option<Vec<Moving>> {
        states.iter().zip(&places).map(|(state, place)| state.motion(place)).collect()
    };
    let equations = |states: &[State<f64>]| -> Option<Vec<Scalar>> {
        let bodies = moving(states)?;
        let mut list: Vec<Scalar> = linkage.joints.iter().flat_map(|joint| closure(joint, &bodies)).collect();
        for one in given {
            match one.joint {
                Some(joint) => list.push(value(&linkage.joints[joint], &bodies)?),
                None => list.extend(bodies[one.of[1]].rotation.iter().flatten().chain(&bodies[one.of[1]].translation)),
            }
        }
        Some(list)
    };
    let mut states = vec![zero; places.len()];
    let still = equations(&states)?;
    let spins = spins(linkage, given, &places, &moved);
    let mut matrix = DMatrix::zeros(still.len() + spins.len(), 6 * moved.len());
    for (k, body) in moved.iter().enumerate() {
        for part in 0..6 {
            let mut pushed = states.clone();
            let state = &mut pushed[*body];
            *state.omega.iter_mut().chain(&mut state.velocity).nth(part)? = 1.0;
            for (row, equation) in equations(&pushed)?.iter().enumerate() {
                matrix[(row, 6 * k + part)] = equation.coefficients[1];
            }
        }
    }
    for (row, (body, axis)) in spins.iter().enumerate() {
        for part in 0..3 {
            matrix[(still.len() + row, 6 * body + part)] = axis[part];
        }
    }
    let svd = finite(matrix.clone()).svd(true, true);
    if svd.singular_values.len() < 6 * moved.len()
        || !(svd.singular_values.min() > SINGULAR * svd.singular_values.max())
    {
        return None;
    }
    let solved = |right: &DVector<f64>| {
        let found = svd.solve(right, 0.0).ok()?;
        let left = (&matrix * &found - right).amax();
        (left <= OPEN * right.amax().max(1.0)).then_some(found)
    };
    let mut right = DVector::zeros(matrix.nrows());
    // The first input is the first equation behind those of the joints.
    let rest = moving(&states)?;
    right[linkage.joints.iter().map(|joint| closure(joint, &rest).len()).sum::<usize>()] = 1.0;
    let first = solved(&right)?;
    for (k, body) in moved.iter().enumerate() {
        states[*body].omega = std::array::from_fn(|i| first[6 * k + i]);
        states[*body].velocity = std::array::from_fn(|i| first[6 * k + 3 + i]);
    }
    let mut right = DVector::zeros(matrix.nrows());
    for (row, equation) in equations(&states)?.iter().enumerate() {
        right[row] = -2.0 * equation.coefficients[2];
    }
    let second = solved(&right)?;
    for (k, body) in moved.iter().enumerate() {
        states[*body].alpha = std::array::from_fn(|i| second[6 * k + i]);
        states[*body].acceleration = std::array::from_fn(|i| second[6 * k + 3 + i]);
    }
    let bodies = moving(&states)?;
    let joints = linkage.joints.iter().map(|joint| {
        let value = value(joint, &bodies)?;
        Some([value.coefficients[1], 2.0 * value.coefficients[2]])
    });
    Some(SpaceRates { joints: joints.collect(), bodies })
}

fn constant(v: &Vector<Rational>) -> Vector<Scalar> {
    v.each_ref().map(|c| Scalar::constant(nearest_f64(c)))
}

/// A direction of length 1.
fn unit(v: &Vector<Rational>) -> Vector<Scalar> {
    let v = v.each_ref().map(nearest_f64);
    let length = dot(&v, &v).sqrt();
    v.map(|c| Scalar::constant(c / length))
}

fn difference(a: &Vector<Scalar>, b: &Vector<Scalar>) -> Vector<Scalar> {
    std::array::from_fn(|k| a[k].sub(&b[k]))
}

/// From the point of the first body to that of the second.
fn apart(joint: &SpaceJoint, bodies: &[Moving]) -> Vector<Scalar> {
    let [one, two] = [0, 1].map(|side| bodies[joint.of[side]].apply(&constant(&joint.at[side])));
    difference(&two, &one)
}

/// What vanishes at all times because of a joint.
fn closure(joint: &SpaceJoint, bodies: &[Moving]) -> Vec<Scalar> {
    let apart = apart(joint, bodies);
    let direction = |side: usize, v: &Vector<Rational>| bodies[joint.of[side]].rotate(&unit(v));
    let square = |square: &Rational| dot(&apart, &apart).sub(&Scalar::constant(nearest_f64(square)));
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

/// The value of a joint in time, up to a constant; `None` where it has none, and of a leg without length.
fn value(joint: &SpaceJoint, bodies: &[Moving]) -> Option<Scalar> {
    let apart = apart(joint, bodies);
    match &joint.pair {
        SpacePair::Revolute(axis) => {
            let u = bodies[joint.of[0]].rotate(&unit(&axis.sphere.at[0]));
            let [e, f] = [0, 1].map(|side| bodies[joint.of[side]].rotate(&unit(&axis.sphere.reference(side))));
            let (cos, sin) = (dot(&e, &f), dot(&u, &cross(&e, &f)));
            // The sine of the angle from where it is now: the angle itself but for its cube.
            let now = |x: &Scalar| Scalar::constant(x.coefficients[0]);
            Some(sin.mul(&now(&cos)).sub(&cos.mul(&now(&sin))))
        }
        SpacePair::Prismatic(axis) => Some(dot(&apart, &bodies[joint.of[0]].rotate(&unit(&axis.sphere.at[0])))),
        SpacePair::Leg | SpacePair::UniversalLeg(_) => dot(&apart, &apart).sqrt(),
        _ => None,
    }
}

/// The rods, each by the first of its bodies among those that move, with its axis in space.
fn spins(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    places: &[Motion<f64>],
    moved: &[usize],
) -> Vec<(usize, Vector<f64>)> {
    let Ok(list) = clusters(linkage, given, &all_bodies(linkage)) else { return Vec::new() };
    let open = open_joints(linkage, given, &list);
    let axis = |k: usize| {
        let ends = open.iter().filter(|(_, of)| of.contains(&k)).map(|(joint, of)| {
            let joint = &linkage.joints[*joint];
            let side = usize::from(of[1] == k);
            (joint.of[side], places[joint.of[side]].apply(&joint.at[side].each_ref().map(nearest_f64)))
        });
        let ends: Vec<(usize, Vector<f64>)> = ends.collect();
        let [(body, p), (_, q)] = ends.as_slice() else { return None };
        let way: Vector<f64> = std::array::from_fn(|i| q[i] - p[i]);
        let length = dot(&way, &way).sqrt();
        let place = moved.iter().position(|own| own == body)?;
        (length > 0.0).then(|| (place, way.map(|c| c / length)))
    };
    (0..list.len()).filter(|k| list[*k].is_rod).filter_map(axis).collect()
}
