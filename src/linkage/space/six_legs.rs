//! A plate on six rods or legs of given lengths: the assemblies are those of a platform, whose engine lists and proves them.

use super::answer::{SpaceMode, bodies};
use super::clusters::{home, open_joints};
use super::equations::System;
use super::values::finished;
use crate::algebra::number::{Number, nearest_f64};
use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::entry::{Case, Design, Entry, Labels};
use crate::catalogue::{SpaceCase, SpaceFile};
use crate::error::Result;
use crate::kinematics::motion::{Motion, Vector, dot};
use crate::kinematics::platform::Platform;
use crate::kinematics::platform_limits::PlatformLimits;
use crate::kinematics::space::{Known, SpaceGiven, SpaceLinkage, SpacePair};
use crate::mechanism::{FullMode, Mechanism, Solution};
use num_complex::Complex;
use rug::Rational;

/// A plate and its legs.
pub(super) struct SixLegs {
    /// The cluster that is the plate.
    plate: usize,
    geometry: Platform<Number>,
    /// The squares of the lengths.
    squares: [Number; 6],
}

/// A pose of the plate as the engine gives it.
pub(super) struct Pose<'a> {
    /// A quaternion of norm 1 and a position.
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

impl SixLegs {
    /// Returns the platform that a linkage is with these inputs; `None` for other linkages.
    pub(super) fn of(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System) -> Option<Self> {
        let list = &system.clusters;
        let mut plates = (1..list.len()).filter(|k| !list[*k].is_rod);
        let (plate, None) = (plates.next()?, plates.next()) else { return None };
        let mut legs = Vec::new();
        let point = |joint: usize, side: usize| -> Option<(usize, Vector<Rational>)> {
            let own = &linkage.joints[joint];
            let cluster = home(list, own.of[side])?;
            let place = list[cluster].bodies.iter().find(|(body, _)| *body == own.of[side])?;
            Some((cluster, place.1.apply(&own.at[side])))
        };
        // From the ground to the plate, whichever end is named first.
        let between = |one: (usize, Vector<Rational>), two: (usize, Vector<Rational>), square: Rational| {
            let ends = match (one.0, two.0) {
                (0, k) if k == plate => [one.1, two.1],
                (k, 0) if k == plate => [two.1, one.1],
                _ => return None,
            };
            Some(Leg { ends, square })
        };
        for (joint, of) in open_joints(linkage, given, list) {
            if of.iter().any(|k| list[*k].is_rod) {
                continue;
            }
            let square = match &linkage.joints[joint].pair {
                SpacePair::Rod(square) => square.clone(),
                SpacePair::Leg => match given.iter().find(|one| one.joint == Some(joint)).map(|one| &one.known) {
                    Some(Known::Square(square)) => square.clone(),
                    // A leg whose length is not given holds nothing.
                    _ => continue,
                },
                _ => return None,
            };
            legs.push(between(point(joint, 0)?, point(joint, 1)?, square)?);
        }
        for rod in (1..list.len()).filter(|k| list[*k].is_rod) {
            let ends = system.ends(linkage, given, rod);
            let [(one, first), (two, second)] = ends.as_slice() else { return None };
            let (_, p) = point(*one, *first)?;
            let (_, q) = point(*two, *second)?;
            let apart: Vector<Rational> = std::array::from_fn(|k| Rational::from(&p[k] - &q[k]));
            legs.push(between(point(*one, 1 - first)?, point(*two, 1 - second)?, dot(&apart, &apart))?);
        }
        let legs: [Leg; 6] = legs.try_into().ok()?;
        let points = |side: usize| legs.each_ref().map(|leg| leg.ends[side].each_ref().map(|c| Number::exact(c.clone())));
        let geometry = Platform { base: points(0), plate: points(1) };
        Some(Self { plate, geometry, squares: legs.each_ref().map(|leg| Number::exact(leg.square.clone())) })
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
        let mut bodies = vec![None; linkage.bodies.len()];
        for (number, cluster) in system.clusters.iter().enumerate() {
            let own_place = match number {
                0 => Motion::identity(),
                number if number == self.plate => place.clone(),
                _ => continue,
            };
            for (body, own) in &cluster.bodies {
                bodies[*body] = Some(own_place.then_after(&own.map(|c| Some(Complex::new(nearest_f64(c), 0.0)))?));
            }
        }
        // Each entry of the rotation is a sum of products of two parts of the quaternion, each in one product with factor 2 or in one
        // square.
        let parts: f64 = pose.q[..4].iter().map(|part| part.norm()).sum();
        let turned = 2.0 * parts * pose.radius + 4.0 * pose.radius * pose.radius;
        // The plate may stand on bodies far from its origin.
        let reach = system.clusters[self.plate].bodies.iter().flat_map(|(_, own)| &own.translation);
        let reach = reach.map(|c| nearest_f64(c).abs()).sum::<f64>();
        let radius = (pose.radius + turned * (1.0 + reach)).max(f64::EPSILON);
        let mode = finished(linkage, given, system, bodies, pose.real, pose.multiplicity, radius);
        Some(SpaceMode { certified: pose.certified, ..mode })
    }
}

/// Returns the platform that a linkage is in a case: a plate on six rods or legs of given lengths; `None` for other linkages.
///
/// # Errors
/// For inputs that leave freedoms by count or hold what others hold.
pub fn platform_of(file: &SpaceFile, case: &SpaceCase) -> Result<Option<Entry>> {
    let system = System::of(&file.linkage, &case.given, &bodies(&file.linkage))?;
    Ok(SixLegs::of(&file.linkage, &case.given, &system).map(|legs| legs.entry(file, case)))
}

/// Whether a linkage is a plate on six rods or legs of given lengths.
#[must_use]
pub fn is_platform(linkage: &SpaceLinkage, given: &[SpaceGiven]) -> bool {
    System::of(linkage, given, &bodies(linkage)).is_ok_and(|system| SixLegs::of(linkage, given, &system).is_some())
}

/// The rotation matrix of a quaternion of norm 1.
fn rotation([w, x, y, z]: [Complex<f64>; 4]) -> [Vector<Complex<f64>>; 3] {
    let two = |a: Complex<f64>, b: Complex<f64>| a * b * 2.0;
    [
        [w * w + x * x - y * y - z * z, two(x, y) - two(w, z), two(x, z) + two(w, y)],
        [two(x, y) + two(w, z), w * w - x * x + y * y - z * z, two(y, z) - two(w, x)],
        [two(x, z) - two(w, y), two(y, z) + two(w, x), w * w - x * x - y * y + z * z],
    ]
}
