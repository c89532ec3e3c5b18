//! Bodies and joint values of an assembly from the places of the clusters, and real assemblies by search.

use super::answer::{Coordinate, SpaceMode};
use super::equations::System;
use crate::algebra::disc::Disc;
use crate::algebra::groebner::Equation;
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::space::{Axis, SpaceGiven, SpaceJoint, SpaceLinkage, SpacePair};
use crate::linkage::isotropic::middle;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rug::Rational;
use std::f64::consts::PI;

/// Starts of the search for a real assembly: with ten a set of any extent is met.
const STARTS: usize = 40;
/// Steps of the search from one start; it converges in ten or does not.
const STEPS: usize = 60;
/// Largest equation of an assembly that the search accepts, over the size of its numbers.
const CLOSED: f64 = 1e-9;
/// Singular values below this share of the largest stand for 0.
const SINGULAR: f64 = 1e-7;

fn float(v: &Vector<Rational>) -> Vector<Coordinate> {
    v.each_ref().map(|c| Complex::new(nearest_f64(c), 0.0))
}

fn difference(a: &Vector<Coordinate>, b: &Vector<Coordinate>) -> Vector<Coordinate> {
    std::array::from_fn(|k| a[k] - b[k])
}

fn norm(v: &Vector<Coordinate>) -> f64 {
    v.iter().map(Complex::norm_sqr).sum::<f64>().sqrt()
}

fn zero() -> Coordinate {
    Complex::new(0.0, 0.0)
}

/// Returns the assembly for these places of the clusters; `None` where their discs are too large to tell anything.
pub(super) fn mode(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    places: &[Option<Motion<Disc>>],
    real: bool,
    multiplicity: usize,
) -> Option<SpaceMode> {
    let mut radius = f64::EPSILON;
    let mut bodies: Vec<Option<Motion<Coordinate>>> = vec![None; linkage.bodies.len()];
    for (cluster, place) in system.clusters.iter().zip(places) {
        let Some(place) = place else { continue };
        for (body, own) in &cluster.bodies {
            let whole = place.then_after(&own.map(Disc::from_rational)?);
            for disc in whole.rotation.iter().flatten().chain(&whole.translation) {
                // A number is listed in f64, which rounds it.
                radius = radius.max(disc.radius().to_f64() + f64::EPSILON * middle(disc).norm());
            }
            let clean = |disc: &Disc| {
                let z = middle(disc);
                Some(if real { Complex::new(z.re + 0.0, 0.0) } else { z })
            };
            bodies[*body] = whole.map(clean);
        }
    }
    if !radius.is_finite() {
        return None;
    }
    Some(finished(linkage, given, system, bodies, real, multiplicity, radius))
}

/// Places the rods, and measures the joints.
pub(super) fn finished(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    mut bodies: Vec<Option<Motion<Coordinate>>>,
    real: bool,
    multiplicity: usize,
    radius: f64,
) -> SpaceMode {
    for (k, cluster) in system.clusters.iter().enumerate().filter(|(_, cluster)| cluster.is_rod) {
        let ends = system.ends(linkage, given, k);
        let end = |(joint, side): &(usize, usize)| -> Option<(Vector<Coordinate>, Vector<Coordinate>)> {
            let joint = &linkage.joints[*joint];
            let own = cluster.bodies.iter().find(|(body, _)| *body == joint.of[*side])?.1.apply(&joint.at[*side]);
            let at = bodies[joint.of[1 - side]].as_ref()?.apply(&float(&joint.at[1 - side]));
            Some((float(&own), at))
        };
        let [Some((p, at_p)), Some((q, at_q))] = [0, 1].map(|k| ends.get(k).and_then(end)) else { continue };
        let rotation = least_turn(&difference(&q, &p), &difference(&at_q, &at_p));
        let turned = Motion { rotation, translation: [zero(), zero(), zero()] };
        let place = Motion { translation: difference(&at_p, &turned.rotate(&p)), ..turned };
        for (body, own) in &cluster.bodies {
            let own = Motion { rotation: own.rotation.each_ref().map(float), translation: float(&own.translation) };
            bodies[*body] = Some(place.then_after(&own));
        }
    }
    let bodies: Vec<Motion<Coordinate>> =
        bodies.into_iter().map(|body| body.unwrap_or_else(Motion::identity)).collect();
    let residual = linkage.joints.iter().map(|joint| open(joint, &bodies)).fold(0.0, f64::max);
    let joints = linkage.joints.iter().map(|joint| value(joint, &bodies, real)).collect();
    SpaceMode { real, multiplicity, certified: true, joints, bodies, residual, radius }
}

/// A rotation that takes one vector along another one of equal length, without turning about it where that can be said.
fn least_turn(from: &Vector<Coordinate>, to: &Vector<Coordinate>) -> [Vector<Coordinate>; 3] {
    let square = dot(from, from);
    let identity = Motion::<Coordinate>::identity().rotation;
    if square.norm() == 0.0 {
        return identity;
    }
    // Two reflections: in the plane across some vector, then in the one that takes its image to the end.
    let reflected = |normal: &Vector<Coordinate>| -> [Vector<Coordinate>; 3] {
        let length = dot(normal, normal);
        std::array::from_fn(|i| std::array::from_fn(|j| identity[i][j] - normal[i] * normal[j] * 2.0 / length))
    };
    let sum: Vector<Coordinate> = std::array::from_fn(|k| from[k] + to[k]);
    let between = if dot(&sum, &sum).norm() > 1e-12 * square.norm() {
        sum
    } else {
        // Opposite: about any direction across.
        let least = (0..3).min_by(|a, b| from[*a].norm().total_cmp(&from[*b].norm())).unwrap_or(0);
        let unit = std::array::from_fn(|k| Complex::new(f64::from(u8::from(k == least)), 0.0));
        let across = cross(from, &unit);
        let half = reflected(&across);
        let back = reflected(from);
        return std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| half[i][k] * back[k][j]).sum()));
    };
    // The reflection in `from` and then in the bisector of both: -from goes to from, and that to `to` with the sign changed twice.
    let (first, second) = (reflected(from), reflected(&between));
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| second[i][k] * first[k][j]).sum()))
}

/// The distance by which a joint is open.
fn open(joint: &SpaceJoint, bodies: &[Motion<Coordinate>]) -> f64 {
    let [one, two] = [0, 1].map(|side| bodies[joint.of[side]].apply(&float(&joint.at[side])));
    let apart = difference(&one, &two);
    let length = |square: &Rational| (dot(&apart, &apart).sqrt() - nearest_f64(square).sqrt()).norm();
    match &joint.pair {
        SpacePair::Revolute(_) | SpacePair::Spherical | SpacePair::Universal(_) => norm(&apart),
        SpacePair::Rod(square) | SpacePair::Parallelogram(_, square) => length(square),
        SpacePair::Leg => 0.0,
        SpacePair::UniversalLeg(axes) => {
            let [n, m] = [0, 1].map(|side| bodies[joint.of[side]].rotate(&float(&axes[side])));
            dot(&cross(&n, &m), &apart).norm() / (norm(&n) * norm(&m))
        }
        SpacePair::Prismatic(axis) => {
            let along = bodies[joint.of[0]].rotate(&float(&axis.sphere.at[0]));
            norm(&cross(&along, &apart)) / norm(&along)
        }
    }
}

/// The value of a joint: an angle in (-pi, pi] or a distance.
fn value(joint: &SpaceJoint, bodies: &[Motion<Coordinate>], real: bool) -> Option<Coordinate> {
    let [a, b] = joint.of.map(|body| &bodies[body]);
    let apart = difference(&b.apply(&float(&joint.at[1])), &a.apply(&float(&joint.at[0])));
    let clean = |z: Coordinate| if real { Complex::new(z.re + 0.0, 0.0) } else { z };
    match &joint.pair {
        SpacePair::Revolute(axis) => Some(clean(angle(axis, a, b, real))),
        SpacePair::Prismatic(axis) => {
            let u = a.rotate(&float(&axis.sphere.at[0]));
            let length = dot(&axis.sphere.at[0], &axis.sphere.at[0]);
            Some(clean(dot(&apart, &u) / nearest_f64(&length).sqrt()))
        }
        SpacePair::Leg | SpacePair::UniversalLeg(_) => Some(clean(dot(&apart, &apart).sqrt())),
        _ => None,
    }
}

fn angle(axis: &Axis, a: &Motion<Coordinate>, b: &Motion<Coordinate>, real: bool) -> Coordinate {
    let u = float(&axis.sphere.at[0]);
    let [e, f] = [0, 1].map(|side| float(&axis.sphere.reference(side)));
    let f = a.inverse().rotate(&b.rotate(&f));
    let size = (dot(&e, &e) * dot(&f, &f)).re.sqrt();
    let (cos, sin) = (dot(&e, &f) / size, dot(&u, &cross(&e, &f)) / (size * dot(&u, &u).re.sqrt()));
    if real {
        let angle = sin.re.atan2(cos.re);
        return Complex::new(if angle <= -PI { PI } else { angle }, 0.0);
    }
    // -i log(cos + i sin)
    let log = (cos + Complex::new(0.0, 1.0) * sin).ln();
    Complex::new(log.im, -log.re)
}

/// Searches for a real assembly at which the equations are dependent to first order, and returns it with the joints that move.
pub(super) fn real_point(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
) -> Option<(SpaceMode, Vec<usize>)> {
    // Any fixed seed: what is found is measured, and nothing is proved by it.
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let size = system.equations.len();
    let at = |x: &[f64]| -> (DVector<f64>, DMatrix<f64>) {
        let mut values: Vec<Complex<f64>> = x.iter().map(|x| Complex::new(*x, 0.0)).collect();
        // A step along i of this size gives derivatives without cancellation.
        let step = 1e-100;
        let mut matrix = DMatrix::zeros(size, x.len());
        let here = DVector::from_iterator(size, system.equations.iter().map(|e| e.evaluate(&values).re));
        for k in 0..x.len() {
            values[k].im = step;
            for (i, equation) in system.equations.iter().enumerate() {
                matrix[(i, k)] = equation.evaluate(&values).im / step;
            }
            values[k].im = 0.0;
        }
        (here, matrix)
    };
    let spread = spread(linkage);
    for _ in 0..STARTS {
        let mut x: Vec<f64> = (0..system.unknowns).map(|_| spread * random.random_range(-1.0..1.0)).collect();
        for _ in 0..STEPS {
            let (gap, matrix) = at(&x);
            let Ok(step) = finite(matrix).svd(true, true).solve(&gap, 1e-12) else { break };
            x.iter_mut().zip(step.iter()).for_each(|(x, step)| *x -= step);
            if x.iter().any(|x| !x.is_finite()) {
                break;
            }
        }
        if x.iter().any(|x| !x.is_finite()) {
            continue;
        }
        let (gap, matrix) = at(&x);
        let svd = finite(matrix).svd(false, true);
        let largest = svd.singular_values.max();
        let rank = svd.singular_values.iter().filter(|s| **s > SINGULAR * largest).count();
        if gap.amax() > CLOSED * spread * spread || rank >= system.unknowns {
            continue;
        }
        let v = svd.v_t?;
        let free: Vec<Vec<f64>> = (rank..v.nrows()).map(|k| v.row(k).iter().copied().collect()).collect();
        let here = floating(linkage, given, system, &x);
        let moved: Vec<SpaceMode> = free
            .iter()
            .map(|way| {
                let next: Vec<f64> = x.iter().zip(way).map(|(x, way)| x + 1e-5 * way).collect();
                floating(linkage, given, system, &next)
            })
            .collect();
        let moves = |joint: &usize| {
            moved.iter().any(|mode| match (&mode.joints[*joint], &here.joints[*joint]) {
                (Some(a), Some(b)) => (a - b).norm() > 1e-8,
                _ => false,
            })
        };
        let joints = (0..linkage.joints.len()).filter(moves).collect();
        return Some((here, joints));
    }
    None
}

/// The largest coordinate of the file, or 1.
fn spread(linkage: &SpaceLinkage) -> f64 {
    let points = linkage.bodies.iter().flat_map(|body| &body.points).flat_map(|(_, at)| at);
    points.map(|c| nearest_f64(c).abs()).fold(1.0, f64::max)
}

/// The assembly at values of the unknowns in f64.
fn floating(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System, x: &[f64]) -> SpaceMode {
    let values: Vec<Coordinate> = x.iter().map(|x| Complex::new(*x, 0.0)).collect();
    let mut bodies: Vec<Option<Motion<Coordinate>>> = vec![None; linkage.bodies.len()];
    for (cluster, place) in system.clusters.iter().zip(&system.places) {
        let Some(place) = place.as_ref().and_then(|place| place.map(|e: &Equation| Some(e.evaluate(&values)))) else {
            continue;
        };
        for (body, own) in &cluster.bodies {
            let own = Motion { rotation: own.rotation.each_ref().map(float), translation: float(&own.translation) };
            bodies[*body] = Some(place.then_after(&own));
        }
    }
    finished(linkage, given, system, bodies, true, 1, f64::EPSILON)
}
