//! The answer to one case of a linkage on the sphere.

use super::equations::{Cluster, System, identity};
use super::family::{Found, SphereFamily, family};
use crate::algebra::disc::Disc;
use crate::algebra::groebner::{Basis, Equation};
use crate::algebra::number::nearest_f64;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::sphere::{SphereGiven, SphereLinkage};
use crate::linkage::isotropic::middle;
use crate::linkage::points::{EFFORT, Points};
use crate::mechanism::exact_loop::roots::Root;
use crate::verdict::{Code, Proof, Status, Verdict};
use looproot_calculus::rotation::matrix::{Matrix, apply, from_matrix, product, transpose};
use looproot_calculus::rotation::vectors::unit;
use num_complex::Complex;
use rug::Rational;
use std::time::Instant;

/// Bits in which axes are computed from a root, and more where they do not tell enough.
const BITS: [u32; 4] = [320, 1280, 5120, 20_480];
/// Relative accuracy beyond which no more bits are computed.
const WANTED: f64 = 1e-17;

/// A number of an assembly, real of a real one.
pub type Coordinate = Complex<f64>;

/// An assembly.
#[derive(Clone, Debug)]
pub struct SphereMode {
    /// Whether it is real.
    pub real: bool,
    /// The multiplicity.
    pub multiplicity: usize,
    /// The angles of the joints, radians.
    pub joints: Vec<Coordinate>,
    /// The rotations of the bodies against the ground.
    pub bodies: Vec<Matrix<Coordinate>>,
    /// The largest distance by which an axis is open, for axes of length 1.
    pub residual: f64,
    /// No entry of a rotation is farther from that of the assembly than this.
    pub radius: f64,
}

impl SphereMode {
    /// The quaternion of a body, of norm 1: w, x, y, z. `None` of a complex rotation whose quaternion has norm 0.
    #[must_use]
    pub fn quaternion(&self, body: usize) -> Option<[Coordinate; 4]> {
        quaternion(&self.bodies[body], self.real)
    }
}

/// The quaternion of a rotation, of norm 1: w, x, y, z. `None` of a complex rotation whose quaternion has norm 0.
#[must_use]
pub fn quaternion(rotation: &Matrix<Coordinate>, real: bool) -> Option<[Coordinate; 4]> {
    if real {
        let q = unit(&from_matrix(&rotation.each_ref().map(|row| row.each_ref().map(|c| c.re))))?;
        return Some([q.scalar, q.vector[0], q.vector[1], q.vector[2]].map(|part| Complex::new(part + 0.0, 0.0)));
    }
    let q = unit(&from_matrix(rotation))?;
    Some([q.scalar, q.vector[0], q.vector[1], q.vector[2]])
}

/// The answer to a case.
#[derive(Clone, Debug)]
pub struct SphereAnswer {
    /// The verdict on the list.
    pub verdict: Verdict,
    /// The isolated assemblies, real ones first.
    pub modes: Vec<SphereMode>,
    /// The curves of assemblies.
    pub families: Vec<SphereFamily>,
    /// Microseconds that it took.
    pub solve_us: f64,
}

/// Finds all assemblies with these inputs; `exact` says whether no number of file and inputs was rounded.
///
/// # Errors
/// Where inputs are too few or hold what others hold, and for linkages that are beyond what is implemented.
pub fn solve(linkage: &SphereLinkage, given: &[SphereGiven], exact: bool) -> Result<SphereAnswer> {
    let start = Instant::now();
    let system = System::least(linkage, given)?;
    let too_much =
        || Error::Unsupported("the Gröbner basis of this linkage takes more work than is allowed".to_owned());
    let basis = Basis::of(system.unknowns, &system.equations, EFFORT).ok_or_else(too_much)?;
    let (mut modes, dimension, found) = match basis.dimension() {
        None => (Vec::new(), 0, Found::default()),
        Some(0) => (modes(linkage, &system, &basis).ok_or_else(too_much)?, 0, Found::default()),
        Some(dimension) => {
            let Found { family, regular } = family(linkage, &system, dimension);
            (regular.clone().unwrap_or_default(), dimension, Found { family, regular })
        }
    };
    let key = |mode: &SphereMode| mode.joints.iter().map(|z| z.re).collect::<Vec<f64>>();
    sort::by(&mut modes, |a, b| {
        let order = key(a).into_iter().zip(key(b)).map(|(x, y)| x.total_cmp(&y)).find(|order| order.is_ne());
        b.real.cmp(&a.real).then(order.unwrap_or(std::cmp::Ordering::Equal))
    });
    let verdict = verdict(&modes, dimension, &found, exact);
    Ok(SphereAnswer {
        verdict,
        modes,
        families: found.family.into_iter().collect(),
        solve_us: start.elapsed().as_secs_f64() * 1e6,
    })
}

/// What is known of assemblies that are infinitely many.
fn motion(dimension: usize, found: &Found) -> String {
    let real = match &found.family {
        Some(SphereFamily { is_proved: true, .. }) if dimension == 1 => {
            "; a curve of real ones is among them: cuts at more places than there can be isolated ones have a real assembly each"
        }
        Some(SphereFamily { is_proved: true, .. }) => {
            "; a curve of real ones is among them, and that the real ones have this dimension too is not proved"
        }
        Some(_) => "; the real one that is listed has others near it to first order",
        None => "; no real one that moves was found",
    };
    let isolated = if found.regular.is_some() {
        "; all regular assemblies, which are isolated, are listed beside it, and multiple ones are not looked for"
    } else {
        "; isolated assemblies beside it are not all looked for"
    };
    format!(
        "a Gröbner basis over the rationals: the assemblies form a set of dimension {dimension}, complex ones counted{real}{isolated}"
    )
}

fn verdict(modes: &[SphereMode], dimension: usize, found: &Found, exact: bool) -> Verdict {
    let complex = modes.iter().map(|mode| mode.multiplicity).sum();
    let real = modes.iter().filter(|mode| mode.real).map(|mode| mode.multiplicity).sum();
    let (status, code, reason) = match (dimension, complex, real) {
        (1.., ..) => (Status::SelfMotion, Code::SelfMotion, motion(dimension, found)),
        (0, 0, _) => (
            Status::Unreachable,
            Code::NoSolution,
            "a Gröbner basis over the rationals: the equations of the axes contradict one another".to_owned(),
        ),
        (0, _, 0) => (
            Status::Unreachable,
            Code::NoSolution,
            "a Gröbner basis over the rationals counts them with multiplicity".to_owned(),
        ),
        _ => (
            Status::Complete,
            Code::GeneralBoundMet,
            "a Gröbner basis over the rationals counts them with multiplicity".to_owned(),
        ),
    };
    let is_curve = dimension == 1 && found.family.as_ref().is_some_and(|family| family.is_proved);
    Verdict {
        status,
        // The dimension is one with complex assemblies; of real ones a curve is proved.
        proof: if dimension == 0 || is_curve { Proof::Proved.of_rounded(!exact) } else { Proof::None },
        code,
        complex_complete: dimension == 0,
        complex,
        real,
        at_infinity: 0,
        self_motion: dimension,
        certified: modes.len(),
        reason: if exact { reason } else { reason + "; some angles or numbers of the file were rounded" },
    }
}

/// All assemblies of a finite set.
fn modes(linkage: &SphereLinkage, system: &System, basis: &Basis) -> Option<Vec<SphereMode>> {
    let points = Points::of(system.unknowns, basis)?;
    points.list.iter().map(|(root, multiplicity)| assembled(linkage, system, &points, root, *multiplicity)).collect()
}

/// Returns the assembly of a root, computed with as many bits as it needs.
fn assembled(
    linkage: &SphereLinkage,
    system: &System,
    points: &Points,
    root: &Root,
    multiplicity: usize,
) -> Option<SphereMode> {
    let mut best = None;
    for bits in BITS {
        let Some(values) = points.values(root, bits) else { continue };
        let image = |equation: &Equation| equation.evaluate(&values);
        let found = mode(linkage, system, multiplicity, root.is_real(), &image);
        let is_enough = found.as_ref().is_some_and(|mode| mode.radius <= WANTED.max(4.0 * f64::EPSILON));
        best = found.or(best);
        if is_enough {
            break;
        }
    }
    best
}

/// The rotation of a cluster from two of its axes.
fn rotation<R: Ring>(cluster: &Cluster, axes: [&Vector<R>; 2]) -> Matrix<R> {
    let [p, q] = cluster.base.map(|place| &cluster.joints[place].1);
    let [v, w] = axes;
    let normal = cross(v, w);
    // Rows that give the coefficients of a vector of the cluster in p, q and p x q.
    let unit = |k: usize| -> Vector<Rational> { std::array::from_fn(|i| Rational::from(u8::from(i == k))) };
    let columns: [[Rational; 3]; 3] = std::array::from_fn(|k| super::equations::combination(&unit(k), p, q));
    std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let parts = [&v[i], &w[i], &normal[i]];
            let terms = parts.iter().zip(&columns[k]).filter(|(_, c)| **c != 0);
            terms.fold(R::zero(), |sum, (part, c)| sum.add(&part.mul(&R::from_rational(c).unwrap_or_else(R::zero))))
        })
    })
}

/// Returns the rotations of all bodies against that which rests in the equations, from the axes of all joints.
#[must_use]
pub fn rotations<R: Ring>(system: &System, axes: &[Vector<R>]) -> Vec<(usize, Matrix<R>)> {
    let exactly = |own: &Matrix<Rational>| {
        own.each_ref().map(|row| row.each_ref().map(|c| R::from_rational(c).unwrap_or_else(R::zero)))
    };
    let mut places = Vec::new();
    for (k, cluster) in system.clusters.iter().enumerate() {
        let turn: Matrix<R> = if k == 0 {
            exactly(&identity())
        } else {
            rotation(cluster, cluster.base.map(|place| &axes[cluster.joints[place].0]))
        };
        places.extend(cluster.bodies.iter().map(|(body, own)| (*body, product(&turn, &exactly(own)))));
    }
    places
}

pub(super) fn mode(
    linkage: &SphereLinkage,
    system: &System,
    multiplicity: usize,
    real: bool,
    image: &dyn Fn(&Equation) -> Disc,
) -> Option<SphereMode> {
    let axes: Vec<Vector<Disc>> = system.axes.iter().map(|axis| axis.each_ref().map(image)).collect();
    let zero = || Complex::new(0.0, 0.0);
    let mut bodies: Vec<Matrix<Coordinate>> =
        vec![std::array::from_fn(|_| std::array::from_fn(|_| zero())); linkage.bodies.len()];
    let mut radius = f64::EPSILON;
    let places = rotations(system, &axes);
    // From the axes of the body that rests in the equations to those of the ground.
    let ground = places.iter().find(|(body, _)| *body == linkage.ground).map(|(_, place)| transpose(place))?;
    for (body, place) in &places {
        let is_ground = *body == linkage.ground;
        let place = if is_ground { Motion::identity().rotation } else { product(&ground, place) };
        for (i, row) in place.iter().enumerate() {
            for (j, entry) in row.iter().enumerate() {
                radius = radius.max(entry.radius().to_f64());
                let z = middle(entry);
                bodies[*body][i][j] = if real { Complex::new(z.re + 0.0, 0.0) } else { z };
            }
        }
    }
    if !radius.is_finite() {
        return None;
    }
    let float = |v: &Vector<Rational>| v.each_ref().map(|c| Complex::new(nearest_f64(c), 0.0));
    let mut residual = 0.0_f64;
    let joints = linkage.joints.iter().map(|joint| {
        let [a, b] = joint.of.map(|body| &bodies[body]);
        let [u, w] = joint.at.each_ref().map(float);
        let length = dot(&u, &u).re.sqrt();
        let apart = apply(a, &u).into_iter().zip(apply(b, &w)).map(|(x, y)| (x - y).norm_sqr()).sum::<f64>();
        residual = residual.max(apart.sqrt() / length);
        let [e, f] = [0, 1].map(|side| float(&joint.reference(side)));
        let f = apply(&product(&transpose(a), b), &f);
        let size = (dot(&e, &e) * dot(&f, &f)).re.sqrt();
        let (cos, sin) = (dot(&e, &f) / size, dot(&u, &cross(&e, &f)) / (size * length));
        if real {
            let angle = sin.re.atan2(cos.re);
            return Complex::new(if angle <= -std::f64::consts::PI { -angle } else { angle + 0.0 }, 0.0);
        }
        // -i log(cos + i sin)
        let log = (cos + Complex::new(0.0, 1.0) * sin).ln();
        Complex::new(log.im, -log.re)
    });
    let joints = joints.collect();
    Some(SphereMode { real, multiplicity, joints, bodies, residual, radius })
}
