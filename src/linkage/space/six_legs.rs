//! A plate on six rods or legs of given lengths: the assemblies are those of a platform, whose engine lists and proves them.
//!
//! A point that an arm holds on a circle, as in a 3-RRS or a 3-RPS robot, is held by two rods to points of its axis.

use super::answer::{Coordinate, SpaceMode, bodies};
use super::clusters::{home, open_joints};
use super::equations::System;
use super::plate_pose::{PlatePose, PoseForms, proved, times};
use super::values::{finished, mode};
use crate::algebra::disc::Disc;
use crate::algebra::number::{Number, nearest_f64};
use crate::algebra::ring::Ring;
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry, Labels};
use crate::catalogue::{SpaceCase, SpaceFile};
use crate::closure::study::{Four, Leg as StudyLeg};
use crate::closure::universal_leg::joined;
use crate::error::Result;
use crate::kinematics::dual_quaternion::Quaternion;
use crate::kinematics::motion::{Motion, Vector, cross, dot};
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::kinematics::space::{Known, SpaceGiven, SpaceLinkage, SpacePair};
use crate::linkage::isotropic::middle;
use crate::mechanism::{FullMode, Mechanism, Solution};
use crate::synthesis::krawczyk::BITS;
use num_complex::Complex;
use rug::Rational;

/// A plate and its legs.
pub(super) struct SixLegs {
    /// The cluster that is the plate.
    plate: usize,
    /// The arms by which points are held on circles, each in the place of two legs.
    arms: Vec<Arm>,
    geometry: Platform<Number>,
    /// The squares of the lengths.
    squares: [Number; 6],
}

/// A cluster between a revolute and a spherical joint, one at the ground and one at the plate: its point moves on a circle.
struct Arm {
    cluster: usize,
    /// The cluster at which its axis is.
    home: usize,
    /// The axis there and in the arm: a point of each, nearest to the spherical joint, and directions of equal length.
    axis: [(Vector<Rational>, Vector<Rational>); 2],
    /// The point of the spherical joint in the arm, and that in the cluster which it holds.
    ends: [Vector<Rational>; 2],
}

impl Arm {
    /// Returns the two rods from the axis to the spherical joint that hold its point on the same circle; `None` where the point is on the
    /// axis.
    fn legs(&self, plate: usize) -> Option<[Leg; 2]> {
        let [(centre, direction), (own, _)] = &self.axis;
        let radius: Vector<Rational> = std::array::from_fn(|k| Rational::from(&self.ends[0][k] - &own[k]));
        let radius = dot(&radius, &radius);
        if radius == 0 {
            return None;
        }
        let square = radius + dot(direction, direction);
        Some([1, -1].map(|sign| {
            let foot = std::array::from_fn(|k| Rational::from(&direction[k] * sign) + &centre[k]);
            let other = self.ends[1].clone();
            Leg { ends: if self.home == plate { [other, foot] } else { [foot, other] }, square: square.clone() }
        }))
    }

    /// Returns the place of the arm, where those of its two neighbours are known; `None` for an unlucky number.
    fn place<R: Ring>(&self, [home, held]: [&Motion<R>; 2]) -> Option<Motion<R>> {
        let over = |v: &Vector<Rational>| -> Option<Vector<R>> {
            let [x, y, z] = v.each_ref().map(R::from_rational);
            Some([x?, y?, z?])
        };
        let [(centre, u), (own, v)] = &self.axis;
        let square = dot(u, u);
        let here: Vector<Rational> = std::array::from_fn(|k| Rational::from(&self.ends[0][k] - &own[k]));
        let radius = dot(&here, &here);
        // The frame of the axis and the point in the arm, over the squares of its lengths, and where it stands.
        let across = cross(v, &here).map(|c| c / &radius / &square);
        let along = v.each_ref().map(|c| Rational::from(c / &square));
        let here = here.map(|c| c / &radius);
        let (frame, centre) = ([over(&along)?, over(&here)?, over(&across)?], over(centre)?);
        let place = home.inverse().apply(&held.apply(&over(&self.ends[1])?));
        let there: Vector<R> = std::array::from_fn(|k| place[k].sub(&centre[k]));
        let u = over(u)?;
        let turned = cross(&u, &there);
        let stands = [u, there, turned];
        let entry = |i: usize, k: usize| (0..3).fold(R::zero(), |sum, n| sum.add(&stands[n][i].mul(&frame[n][k])));
        let rotation = std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)));
        let turn = Motion { rotation, translation: std::array::from_fn(|_| R::zero()) };
        let from = turn.rotate(&over(own)?);
        let translation = std::array::from_fn(|k| centre[k].sub(&from[k]));
        Some(home.then_after(&Motion { translation, ..turn }))
    }
}

fn float(v: &Vector<Rational>) -> Vector<Coordinate> {
    v.each_ref().map(|c| Complex::new(nearest_f64(c), 0.0))
}

fn difference(a: &Vector<Coordinate>, b: &Vector<Coordinate>) -> Vector<Coordinate> {
    std::array::from_fn(|k| a[k] - b[k])
}

/// The legs with the numbers of their forms as discs.
struct Legs([StudyLeg<Disc>; 6]);

impl PoseForms for Legs {
    fn values(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<Disc> {
        self.0.iter().map(|leg| leg.quadric(x, y, times)).collect()
    }

    fn slopes(&self, x: &Four<Disc>, y: &Four<Disc>) -> Vec<[Disc; 8]> {
        let twice = |v: Four<Disc>| v.map(|z| z.add(&z));
        let slope = |leg: &StudyLeg<Disc>| {
            let w = leg.vector(x, y, times);
            joined(&twice(leg.half_slope(&w, x, times)), &twice(w))
        };
        self.0.iter().map(slope).collect()
    }
}

/// Whether a place in f64 is no farther from an exact one than a bound.
fn is_within(place: &Motion<Coordinate>, exact: &Motion<Disc>, bound: f64) -> bool {
    let numbers = |p: &Motion<Coordinate>| -> Vec<Coordinate> {
        p.rotation.iter().flatten().chain(&p.translation).copied().collect()
    };
    let Some(exact) = exact.map(|disc| Some(middle(disc))) else { return false };
    numbers(place).iter().zip(numbers(&exact)).all(|(a, b)| (a - b).norm() <= bound)
}

/// A pose of the plate as the engine gives it.
pub(super) struct Pose<'a> {
    /// A quaternion whose parts have squares of absolute value that sum up to 1, and a position.
    pub q: &'a [Complex<f64>],
    pub real: bool,
    pub multiplicity: usize,
    pub certified: bool,
    /// A bound of the error of each of these numbers.
    pub radius: f64,
}

impl<'a> Pose<'a> {
    pub(super) fn of(mode: &'a FullMode) -> Self {
        let FullMode { q, real, multiplicity, certified, radius, .. } = mode;
        Self { q, real: *real, multiplicity: *multiplicity, certified: *certified, radius: *radius }
    }
}

/// A leg: its ends in the ground and in the plate, and the square of its length.
struct Leg {
    ends: [Vector<Rational>; 2],
    square: Rational,
}

/// A linkage with its clusters, the first of which is the ground.
struct Parts<'a> {
    linkage: &'a SpaceLinkage,
    given: &'a [SpaceGiven],
    system: &'a System,
    plate: usize,
}

impl Parts<'_> {
    /// A point or a direction of a body in coordinates of its cluster, whose number comes first.
    fn in_cluster(
        &self,
        body: usize,
        map: impl Fn(&Motion<Rational>) -> Vector<Rational>,
    ) -> Option<(usize, Vector<Rational>)> {
        let cluster = home(&self.system.clusters, body)?;
        let place = self.system.clusters[cluster].bodies.iter().find(|(own, _)| *own == body)?;
        Some((cluster, map(&place.1)))
    }

    /// The point of a joint on one of its sides.
    fn point(&self, joint: usize, side: usize) -> Option<(usize, Vector<Rational>)> {
        let own = &self.linkage.joints[joint];
        self.in_cluster(own.of[side], |place| place.apply(&own.at[side]))
    }

    /// A leg from the ground to the plate, whichever end is named first.
    fn leg(&self, [one, two]: [(usize, Vector<Rational>); 2], square: Rational) -> Option<Leg> {
        let ends = match (one.0, two.0) {
            (0, k) if k == self.plate => [one.1, two.1],
            (k, 0) if k == self.plate => [two.1, one.1],
            _ => return None,
        };
        Some(Leg { ends, square })
    }

    /// A joint between ground and plate as a leg, and none where it holds nothing.
    fn direct(&self, joint: usize) -> Option<Vec<Leg>> {
        let square = match &self.linkage.joints[joint].pair {
            SpacePair::Rod(square) => square.clone(),
            SpacePair::Leg => {
                let known = self.given.iter().find(|one| one.joint == Some(joint)).map(|one| &one.known);
                match known {
                    Some(Known::Square(square)) => square.clone(),
                    _ => return Some(Vec::new()),
                }
            }
            _ => return None,
        };
        self.leg([self.point(joint, 0)?, self.point(joint, 1)?], square).map(|leg| vec![leg])
    }

    /// A rod that is a body as a leg.
    fn rod(&self, rod: usize) -> Option<Leg> {
        let ends = self.system.ends(self.linkage, self.given, rod);
        let [(one, first), (two, second)] = ends.as_slice() else { return None };
        let ((_, p), (_, q)) = (self.point(*one, *first)?, self.point(*two, *second)?);
        let apart: Vector<Rational> = std::array::from_fn(|k| Rational::from(&p[k] - &q[k]));
        let square = dot(&apart, &apart);
        // A rod without length is one spherical joint.
        if square == 0 {
            return None;
        }
        self.leg([self.point(*one, 1 - first)?, self.point(*two, 1 - second)?], square)
    }

    /// A cluster between a revolute joint and a spherical one.
    fn arm(&self, cluster: usize) -> Option<Arm> {
        let ends = self.system.ends(self.linkage, self.given, cluster);
        let [one, two] = ends.as_slice() else { return None };
        let is_turning = |end: &(usize, usize)| matches!(self.linkage.joints[end.0].pair, SpacePair::Revolute(_));
        let ((turning, near), (ball, own)) = if is_turning(one) { (*one, *two) } else { (*two, *one) };
        let joint = &self.linkage.joints[turning];
        let SpacePair::Revolute(axis) = &joint.pair else { return None };
        if self.linkage.joints[ball].pair != SpacePair::Spherical {
            return None;
        }
        let direction = |side: usize| self.in_cluster(joint.of[side], |place| place.rotate(&axis.sphere.at[side]));
        let ((home, base), (_, root)) = (self.point(turning, 1 - near)?, self.point(turning, near)?);
        let ((_, u), (_, v)) = (direction(1 - near)?, direction(near)?);
        let ((_, point), (held, other)) = (self.point(ball, own)?, self.point(ball, 1 - own)?);
        if [home, held] != [0, self.plate] && [home, held] != [self.plate, 0] {
            return None;
        }
        // The point of the axis nearest to the spherical joint.
        let apart: Vector<Rational> = std::array::from_fn(|k| Rational::from(&point[k] - &root[k]));
        let along = dot(&apart, &v) / dot(&v, &v);
        let foot = |from: &Vector<Rational>, direction: &Vector<Rational>| -> Vector<Rational> {
            std::array::from_fn(|k| Rational::from(&along * &direction[k]) + &from[k])
        };
        let axis = [(foot(&base, &u), u), (foot(&root, &v), v)];
        Some(Arm { cluster, home, axis, ends: [point, other] })
    }
}

impl SixLegs {
    /// Returns the platform that a linkage is with these inputs, by its rods, legs and points that arms hold on circles; `None` for other
    /// linkages.
    pub(super) fn of(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System) -> Option<Self> {
        let list = &system.clusters;
        let count = |k: usize| system.ends(linkage, given, k).len();
        // An arm has two joints, a plate three at least.
        let mut plates = (1..list.len()).filter(|k| !list[*k].is_rod && count(*k) > 2);
        let (plate, None) = (plates.next()?, plates.next()) else { return None };
        let parts = Parts { linkage, given, system, plate };
        let mut legs = Vec::new();
        for (joint, of) in open_joints(linkage, given, list) {
            if of.iter().all(|k| [0, plate].contains(k)) {
                legs.extend(parts.direct(joint)?);
            }
        }
        let mut arms = Vec::new();
        for k in (1..list.len()).filter(|k| *k != plate) {
            if list[k].is_rod {
                legs.push(parts.rod(k)?);
            } else {
                let arm = parts.arm(k)?;
                legs.extend(arm.legs(plate)?);
                arms.push(arm);
            }
        }
        let legs: [Leg; 6] = legs.try_into().ok()?;
        let points =
            |side: usize| legs.each_ref().map(|leg| leg.ends[side].each_ref().map(|c| Number::exact(c.clone())));
        let geometry = Platform { base: points(0), plate: points(1) };
        let squares = legs.each_ref().map(|leg| Number::exact(leg.square.clone()));
        Some(Self { plate, arms, geometry, squares })
    }

    /// Whether the plate stands on three arms: a Gröbner basis of so few unknowns ends.
    pub(super) fn is_on_arms(&self) -> bool {
        self.arms.len() == 3
    }

    /// Returns a platform of which this is all, with the title and the name of a file. Its legs are in the order of the file: those
    /// without a body first.
    fn entry(self, file: &SpaceFile, case: &SpaceCase) -> Entry {
        let heading = &file.heading;
        Entry {
            name: heading.name.clone(),
            title: heading.title.clone(),
            source: heading.source.clone(),
            notes: heading.notes.clone(),
            design: Design::Platform(Box::new(self.geometry)),
            limits: Vec::new(),
            platform_limits: PlatformLimits::default(),
            cases: vec![Case::legs(self.squares, case.line)],
            rounded: !(file.exact && case.exact),
            reading: file.reading.clone(),
            labels: Labels::default(),
        }
    }

    /// Returns the answer of the engine for platforms.
    ///
    /// # Errors
    /// As [`Mechanism::solve`].
    pub(super) fn solve(&self) -> Result<Solution> {
        let mechanism = Mechanism::of_platform(&self.geometry)?;
        let case = Case::legs(self.squares.clone(), 1);
        mechanism.solve(&case, Roots::All, &mut Workspace::default(), &mut Assembly::default())
    }

    /// Returns a bound of the error of all entries of rotations and all coordinates of an assembly.
    fn radius(&self, system: &System, pose: &Pose<'_>) -> f64 {
        let (quaternion, position) = pose.q.split_at(4);
        let size = |list: &[Complex<f64>]| list.iter().map(|part| part.norm()).sum::<f64>();
        let (parts, far) = (size(quaternion), size(position));
        let norm = quaternion.iter().map(|part| part * part).sum::<Complex<f64>>().norm();
        // The largest entry of the rotation, at most.
        let largest = parts * parts / norm;
        // Each entry of a rotation is a sum of products of two parts of the quaternion, each in one product with factor 2 or in one
        // square, over the norm, which is such a sum; rounding adds some units of their size.
        let off = 2.0 * parts * pose.radius + 4.0 * pose.radius * pose.radius;
        if off >= norm {
            return f64::INFINITY;
        }
        let turned = off * (1.0 + largest) / (norm - off) + 12.0 * f64::EPSILON * largest;
        let bodies = system.clusters.iter().flat_map(|cluster| &cluster.bodies);
        let joints = self.arms.iter().flat_map(|arm| arm.ends.iter().chain(arm.axis.iter().map(|(point, _)| point)));
        let reach = reach(bodies.map(|(_, own)| &own.translation).chain(joints));
        let moved = pose.radius + turned * reach + 4.0 * f64::EPSILON * far;
        let arm = |arm: &Arm| {
            let [(_, u), (own, _)] = &arm.axis;
            let here = difference(&float(&arm.ends[0]), &float(own));
            let (radius, length) = (dot(&here, &here).re.sqrt(), dot(&float(u), &float(u)).re.sqrt());
            // The point stands off by `moved`; in a plate that turns its place is seen with that turn, too. The rotation is linear in
            // the direction to it, which has the length of the radius where it is real and may be longer where it is not.
            let seen = if arm.home == 0 { moved } else { 3.0 * largest * moved + turned * (reach + far) };
            let long = (3.0 * largest * (reach + far) + far + reach) / radius;
            let rotation = 2.0 * seen / radius + 16.0 * f64::EPSILON * (1.0 + long) * (1.0 + reach / length.min(1.0));
            let carried = if arm.home == 0 { 1.0 } else { 3.0 * largest };
            carried * (rotation * (1.0 + 2.0 * reach) + turned * (1.0 + long) * (1.0 + reach)) + moved
        };
        self.arms.iter().map(arm).fold(turned.max(moved), f64::max).max(f64::EPSILON)
    }

    /// Returns the places of the clusters for one of the plate.
    fn places<R: Ring>(&self, system: &System, plate: &Motion<R>) -> Option<Vec<Option<Motion<R>>>> {
        let mut places: Vec<Option<Motion<R>>> = system.clusters.iter().map(|_| None).collect();
        let ground = Motion::identity();
        for arm in &self.arms {
            let neighbours = if arm.home == 0 { [&ground, plate] } else { [plate, &ground] };
            places[arm.cluster] = Some(arm.place(neighbours)?);
        }
        (places[0], places[self.plate]) = (Some(ground), Some(plate.clone()));
        Some(places)
    }

    /// Returns the pose near one of the engine that is proved in many digits; `None` where it is not simple.
    fn refined(&self, pose: &Pose<'_>) -> Option<PlatePose> {
        let [w, x, y, z, position @ ..] = pose.q else { return None };
        let over = |points: &[Number; 3]| points.each_ref().map(|c| Disc::of(c.rational(), BITS));
        let leg = |k: usize| {
            let Platform { base, plate } = &self.geometry;
            StudyLeg::new(&over(&base[k]), &over(&plate[k]), Disc::of(self.squares[k].rational(), BITS))
        };
        let translation = Quaternion { scalar: Complex::new(0.0, 0.0), vector: position.try_into().ok()? };
        let dual = translation.mul(&Quaternion { scalar: *w, vector: [*x, *y, *z] });
        let [a, b, c] = dual.vector;
        proved(&Legs(std::array::from_fn(leg)), &[*w, *x, *y, *z, dual.scalar, a, b, c], 1.0)
    }

    /// Returns the assembly of a pose of the plate.
    pub(super) fn mode(
        &self,
        linkage: &SpaceLinkage,
        given: &[SpaceGiven],
        system: &System,
        pose: &Pose<'_>,
    ) -> Option<SpaceMode> {
        let [w, x, y, z, position @ ..] = pose.q else { return None };
        let place = Motion { rotation: rotation([*w, *x, *y, *z]), translation: position.try_into().ok()? };
        let clean = |c: &Complex<f64>| Some(if pose.real { Complex::new(c.re + 0.0, 0.0) } else { *c });
        let place = place.map(clean)?;
        let radius = self.radius(system, pose);
        let is_same = |exact: &PlatePose| exact.is_real == pose.real && is_within(&place, &exact.place, radius);
        if let Some(exact) = self.refined(pose).filter(is_same) {
            let places = self.places(system, &exact.place)?;
            return mode(linkage, given, system, &places, exact.is_real, pose.multiplicity);
        }
        let places = self.places(system, &place)?;
        let mut bodies = vec![None; linkage.bodies.len()];
        for (cluster, place) in system.clusters.iter().zip(&places) {
            let Some(place) = place else { continue };
            for (body, own) in &cluster.bodies {
                bodies[*body] = Some(place.then_after(&own.map(|c| Some(Complex::new(nearest_f64(c), 0.0)))?));
            }
        }
        let mode = finished(linkage, given, system, bodies, pose.real, pose.multiplicity, radius);
        Some(SpaceMode { certified: pose.certified && radius.is_finite(), ..mode })
    }
}

/// The largest sum of the absolute values of the coordinates of some points, or 1.
fn reach<'a>(points: impl Iterator<Item = &'a Vector<Rational>>) -> f64 {
    points.map(|p| p.iter().map(|c| nearest_f64(c).abs()).sum()).fold(1.0, f64::max)
}

/// Returns the platform that a linkage is in a case: a plate on six rods or legs of given lengths; `None` for other linkages.
///
/// # Errors
/// For inputs that leave freedoms by count or hold what others hold.
pub fn platform_of(file: &SpaceFile, case: &SpaceCase) -> Result<Option<Entry>> {
    let system = System::of(&file.linkage, &case.given, &bodies(&file.linkage))?;
    let legs = SixLegs::of(&file.linkage, &case.given, &system).filter(|legs| legs.arms.is_empty());
    Ok(legs.map(|legs| legs.entry(file, case)))
}

/// Whether a linkage is a plate on six rods or legs of given lengths.
#[must_use]
pub fn is_platform(linkage: &SpaceLinkage, given: &[SpaceGiven]) -> bool {
    let system = System::of(linkage, given, &bodies(linkage)).ok();
    let legs = system.and_then(|system| SixLegs::of(linkage, given, &system));
    legs.is_some_and(|legs| legs.arms.is_empty())
}

/// The rotation matrix of a quaternion whose norm is not 0.
fn rotation([w, x, y, z]: [Complex<f64>; 4]) -> [Vector<Complex<f64>>; 3] {
    let norm = w * w + x * x + y * y + z * z;
    let two = |a: Complex<f64>, b: Complex<f64>| a * b * 2.0;
    let rows = [
        [w * w + x * x - y * y - z * z, two(x, y) - two(w, z), two(x, z) + two(w, y)],
        [two(x, y) + two(w, z), w * w - x * x + y * y - z * z, two(y, z) - two(w, x)],
        [two(x, z) - two(w, y), two(y, z) + two(w, x), w * w - x * x - y * y + z * z],
    ];
    rows.map(|row| row.map(|entry| entry / norm))
}
