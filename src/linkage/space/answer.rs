//! The answer to one case of a linkage in space.

use super::clusters::{clusters, groups};
use super::equations::System;
use super::independent::{combined, parts};
use super::plate_pose::PlatePose;
use super::six_legs::{Pose, SixLegs};
use super::universal::{Count, Plate};
use super::values::{mode, real_point};
use crate::algebra::disc::Disc;
use crate::algebra::drawn;
use crate::algebra::groebner::{Basis, FiniteRing};
use crate::algebra::sort;
use crate::assembly::Roots;
use crate::error::{Error, Result};
use crate::kinematics::motion::{Motion, Vector};
use crate::kinematics::space::{SpaceGiven, SpaceLinkage};
use crate::linkage::points::{EFFORT, Points};
use crate::mechanism::Solution;
use crate::mechanism::exact_loop::roots::Root;
use crate::verdict::{Code, Proof, Status, Verdict};
use num_complex::Complex;
use std::time::Instant;

/// Bits in which places are computed from a root, and more where they do not tell enough.
const BITS: [u32; 4] = [320, 1280, 5120, 20_480];
/// Largest radius, for lengths of 1, beyond which no more bits are computed.
const WANTED: f64 = 4.0 * f64::EPSILON;

/// Maximum number of assemblies that are listed: those of fourteen parts with two each.
const MOST: usize = 1 << 14;

/// What a list of all assemblies rests on.
const EXACTLY: &str = "a Gröbner basis over the rationals";
/// What a count rests on.
const MODULO: &str = "a Gröbner basis modulo a prime drawn at run time";

/// A number of an assembly, real of a real one.
pub type Coordinate = Complex<f64>;

/// An assembly.
#[derive(Clone, Debug)]
pub struct SpaceMode {
    /// Whether it is real.
    pub real: bool,
    /// The multiplicity; 0 where it is not known.
    pub multiplicity: usize,
    /// Whether exactly one assembly is proved to lie within `radius`.
    pub certified: bool,
    /// The values of the joints that have one: radians or metres.
    pub joints: Vec<Option<Coordinate>>,
    /// The motions of the bodies against the ground.
    pub bodies: Vec<Motion<Coordinate>>,
    /// The largest distance by which a joint is open, metres.
    pub residual: f64,
    /// No entry of a rotation and no coordinate is farther from that of the assembly than this.
    pub radius: f64,
}

impl SpaceMode {
    /// The quaternion of a body, of norm 1: w, x, y, z. `None` of a complex rotation whose quaternion has norm 0.
    #[must_use]
    pub fn quaternion(&self, body: usize) -> Option<[Coordinate; 4]> {
        crate::linkage::sphere::quaternion(&self.bodies[body].rotation, self.real)
    }

    /// The place of the origin of a body.
    #[must_use]
    pub fn position(&self, body: usize) -> &Vector<Coordinate> {
        &self.bodies[body].translation
    }
}

/// A group and its count.
#[derive(Clone, Debug)]
pub struct SpaceGroup {
    /// The bodies of its clusters.
    pub bodies: Vec<Vec<usize>>,
    /// Its assemblies, with multiplicity.
    pub count: usize,
    /// The way in which they were found, in words.
    pub route: &'static str,
}

/// The answer to a case.
#[derive(Clone, Debug)]
pub struct SpaceAnswer {
    /// The verdict on the list.
    pub verdict: Verdict,
    /// The isolated assemblies, real ones first.
    pub modes: Vec<SpaceMode>,
    /// A point of a set of assemblies that is not finite, and the joints that move there.
    pub sample: Option<(SpaceMode, Vec<usize>)>,
    /// The groups in the order in which they can be solved.
    pub groups: Vec<SpaceGroup>,
    /// Microseconds that it took.
    pub solve_us: f64,
}

fn too_much() -> Error {
    Error::Unsupported("the Gröbner basis of this linkage takes more work than is allowed".to_owned())
}

/// Finds all assemblies with these inputs; `exact` says whether no number of file and inputs was rounded.
///
/// # Errors
/// Where inputs are too few or hold what others hold, and for linkages that are beyond what is implemented.
pub fn solve(linkage: &SpaceLinkage, given: &[SpaceGiven], exact: bool) -> Result<SpaceAnswer> {
    answered(linkage, given, exact, Roots::All)
}

/// As [`solve`], with the verdict on all assemblies, where only real ones are wanted in the list: others may be left out of it.
///
/// # Errors
/// As [`solve`].
pub fn solve_real(linkage: &SpaceLinkage, given: &[SpaceGiven], exact: bool) -> Result<SpaceAnswer> {
    answered(linkage, given, exact, Roots::Real)
}

fn answered(linkage: &SpaceLinkage, given: &[SpaceGiven], exact: bool, wanted: Roots) -> Result<SpaceAnswer> {
    let start = Instant::now();
    let all = bodies(linkage);
    let system = System::of(linkage, given, &all)?;
    let plate = Plate::of(linkage, given, &system);
    let counted_plate = plate.and_then(|plate| plate.count().map(|count| (plate, count)));
    let ((mut modes, sample, verdict), route) = match (counted_plate, SixLegs::of(linkage, given, &system)) {
        (Some((plate, count)), _) => (by_paths(linkage, given, &system, (&plate, count), exact), "paths"),
        (None, Some(legs)) => {
            let found = by_legs(linkage, given, &system, &legs, (exact, wanted))?;
            let is_open = found.2.status == Status::Incomplete || matches!(found.2.proof, Proof::Probable { .. });
            let by_basis = || by_basis(linkage, given, &system, exact).ok();
            let other = if is_open && legs.is_on_arms() { by_basis() } else { None };
            other.map_or((found, "platform"), |other| (other, "Gröbner basis"))
        }
        (None, None) => {
            let by_parts = by_parts(linkage, given, &system, exact)?;
            (by_parts.map_or_else(|| by_basis(linkage, given, &system, exact), Ok)?, "Gröbner basis")
        }
    };
    sort(&mut modes);
    let groups = counted(linkage, given, verdict.complex, route)?;
    Ok(SpaceAnswer { verdict, modes, sample, groups, solve_us: start.elapsed().as_secs_f64() * 1e6 })
}

/// The assemblies, a point of a set of them, and the verdict.
type Listed = (Vec<SpaceMode>, Option<(SpaceMode, Vec<usize>)>, Verdict);

/// All assemblies by a Gröbner basis over the rationals.
fn by_basis(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System, exact: bool) -> Result<Listed> {
    let basis = Basis::of(system.unknowns, &system.equations, EFFORT).ok_or_else(too_much)?;
    let dimension = basis.dimension();
    let mut modes = Vec::new();
    let mut sample = None;
    match dimension {
        None => {}
        Some(0) => modes = isolated(linkage, given, system, &basis).ok_or_else(too_much)?,
        Some(_) => sample = real_point(linkage, given, system),
    }
    let verdict = verdict(EXACTLY, &modes, dimension, sample.is_some(), exact);
    Ok((modes, sample, verdict))
}

/// All combinations of the assemblies of parts that only the ground joins; `None` of a linkage of one part, and where a part moves.
fn by_parts(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System, exact: bool) -> Result<Option<Listed>> {
    let lists = parts(linkage, given, system);
    if lists.len() < 2 {
        return Ok(None);
    }
    let mut found = Vec::new();
    for within in lists {
        // A part with too few conditions and one with too many are told from each other by the whole.
        let Ok(system) = System::of(linkage, given, &within) else { return Ok(None) };
        let basis = Basis::of(system.unknowns, &system.equations, EFFORT).ok_or_else(too_much)?;
        match basis.dimension() {
            None => return Ok(Some((Vec::new(), None, verdict(EXACTLY, &[], None, false, exact)))),
            Some(0) => found.push((within, isolated(linkage, given, &system, &basis).ok_or_else(too_much)?)),
            Some(_) => return Ok(None),
        }
    }
    let number: usize = found.iter().map(|(_, modes)| modes.len()).product();
    if number > MOST {
        let message = format!("{number} assemblies of parts that only the ground joins, more than are listed");
        return Err(Error::Unsupported(message));
    }
    let modes = combined(linkage, given, system, &found);
    let verdict = verdict(EXACTLY, &modes, Some(0), false, exact);
    Ok(Some((modes, None, verdict)))
}

/// All assemblies of a plate on UPU legs, whose number is known modulo a prime.
fn by_paths(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    (plate, count): (&Plate, Count),
    exact: bool,
) -> Listed {
    let one = |pose: &PlatePose| {
        mode(linkage, given, system, &[Some(Motion::identity()), Some(pose.place.clone())], pose.is_real, 1)
    };
    let (modes, sample) = match count {
        Count::Finite(count) => (plate.poses(count).iter().filter_map(one).collect(), None),
        Count::Dimension(_) => (Vec::new(), real_point(linkage, given, system)),
    };
    let verdict = counted_verdict(&modes, count, sample.is_some(), exact);
    (modes, sample, verdict)
}

/// All assemblies of a plate on six legs, by the engine for platforms.
fn by_legs(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    legs: &SixLegs,
    (exact, wanted): (bool, Roots),
) -> Result<Listed> {
    let Solution { mut verdict, modes, families, .. } = legs.solve()?;
    let poses: Vec<_> = modes.iter().filter(|pose| pose.real || wanted == Roots::All).collect();
    let modes: Vec<SpaceMode> =
        poses.iter().filter_map(|pose| legs.mode(linkage, given, system, &Pose::of(pose))).collect();
    if modes.len() < poses.len() {
        (verdict.status, verdict.code, verdict.proof) = (Status::Incomplete, Code::TooFew, Proof::None);
    }
    // A family of poses has the lengths of the legs, which are the values of its joints.
    let sample = families.first().and_then(|family| {
        let q: Vec<Coordinate> = family.sample.iter().map(|x| Complex::new(*x, 0.0)).collect();
        let pose = Pose { q: &q, real: true, multiplicity: 0, certified: false, radius: f64::EPSILON };
        Some((legs.mode(linkage, given, system, &pose)?, Vec::new()))
    });
    verdict.proof = verdict.proof.of_rounded(!exact);
    if !exact {
        verdict.reason += "; some numbers of the file were rounded";
    }
    Ok((modes, sample, verdict))
}

/// Real assemblies first.
fn sort(modes: &mut [SpaceMode]) {
    let key = |mode: &SpaceMode| mode.bodies.iter().map(|body| body.translation[0].re).collect::<Vec<f64>>();
    sort::by(modes, |a, b| {
        let order = key(a).into_iter().zip(key(b)).map(|(x, y)| x.total_cmp(&y)).find(|order| order.is_ne());
        b.real.cmp(&a.real).then(order.unwrap_or(std::cmp::Ordering::Equal))
    });
}

/// All bodies, the ground first.
#[must_use]
pub fn bodies(linkage: &SpaceLinkage) -> Vec<usize> {
    let others = (0..linkage.bodies.len()).filter(|body| *body != linkage.ground);
    std::iter::once(linkage.ground).chain(others).collect()
}

/// The groups with their counts: the whole has the product of them.
fn counted(linkage: &SpaceLinkage, given: &[SpaceGiven], total: usize, route: &'static str) -> Result<Vec<SpaceGroup>> {
    let list = clusters(linkage, given, &bodies(linkage))?;
    let found = groups(linkage, given, &list);
    let mut parts: Vec<(Vec<usize>, usize)> = Vec::new();
    let mut result = Vec::new();
    let last = found.len();
    for (number, (group, held)) in found.into_iter().enumerate() {
        let whole = if number + 1 == last { Some(total) } else { count(linkage, given, &held) };
        let Some(whole) = whole else { return Ok(Vec::new()) };
        let inner = |part: &(Vec<usize>, usize)| part.0.iter().all(|body| held.contains(body));
        // Parts that later ones hold stand for nothing by themselves any more.
        let before: usize = parts.iter().filter(|part| inner(part)).map(|part| part.1).product();
        if before == 0 || whole % before != 0 {
            // Not every assembly of the first parts has as many of this one.
            return Ok(Vec::new());
        }
        parts.retain(|part| !inner(part));
        parts.push((held, whole));
        result.push(SpaceGroup { bodies: group.bodies, count: whole / before, route });
    }
    Ok(result)
}

/// The number of assemblies of some bodies, with multiplicity; `None` where it is not finite or takes too much work.
fn count(linkage: &SpaceLinkage, given: &[SpaceGiven], within: &[usize]) -> Option<usize> {
    let mut order: Vec<usize> = within.to_vec();
    sort::by_key(&mut order, |body| *body != linkage.ground);
    let system = System::of(linkage, given, &order).ok()?;
    let basis = Basis::of(system.unknowns, &system.equations, EFFORT)?;
    match basis.dimension() {
        None => Some(0),
        Some(0) if system.unknowns == 0 => Some(1),
        Some(0) => Some(FiniteRing::of(&basis)?.dimension()),
        Some(_) => None,
    }
}

/// All assemblies of a finite set.
fn isolated(linkage: &SpaceLinkage, given: &[SpaceGiven], system: &System, basis: &Basis) -> Option<Vec<SpaceMode>> {
    let points = Points::of(system.unknowns, basis)?;
    let one = |(root, multiplicity): &(Root, usize)| assembled(linkage, given, system, &points, root, *multiplicity);
    points.list.iter().map(one).collect()
}

/// Returns the assembly of a root, computed with as many bits as it needs.
fn assembled(
    linkage: &SpaceLinkage,
    given: &[SpaceGiven],
    system: &System,
    points: &Points,
    root: &Root,
    multiplicity: usize,
) -> Option<SpaceMode> {
    let mut best: Option<SpaceMode> = None;
    for bits in BITS {
        let Some(values) = points.values(root, bits) else { continue };
        let Some(places) = places(system, &values) else { continue };
        let found = mode(linkage, given, system, &places, root.is_real(), multiplicity);
        let is_enough = found.as_ref().is_some_and(|mode| mode.radius <= WANTED * size(mode));
        best = found.or(best);
        if is_enough {
            break;
        }
    }
    best
}

/// The largest coordinate or entry of a rotation, or 1.
fn size(mode: &SpaceMode) -> f64 {
    let all = mode.bodies.iter().flat_map(|body| body.rotation.iter().flatten().chain(&body.translation));
    let all = all.map(|c| c.norm());
    all.fold(1.0, f64::max)
}

/// The places of the clusters at values of the unknowns.
fn places(system: &System, values: &[Disc]) -> Option<Vec<Option<Motion<Disc>>>> {
    let place = |place: &Option<Motion<crate::algebra::groebner::Equation>>| match place {
        None => Some(None),
        Some(motion) => motion.map(|equation| Some(equation.evaluate(values))).map(Some),
    };
    system.places.iter().map(place).collect()
}

/// The verdict on a list whose number is known modulo a prime.
fn counted_verdict(modes: &[SpaceMode], count: Count, has_point: bool, exact: bool) -> Verdict {
    let count = match count {
        Count::Finite(count) => count,
        Count::Dimension(dimension) => return verdict(MODULO, modes, Some(dimension), has_point, exact),
    };
    let real = modes.iter().filter(|mode| mode.real).count();
    // A count of rounded numbers is none of the numbers that were rounded.
    let probable =
        if exact { Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() } } else { Proof::None };
    let (status, code, proof, reason) = match (modes.len() == count, real) {
        (true, 0) => {
            let reason =
                format!("{MODULO}: {count} assemblies with multiplicity; all are proved and none of them is real");
            (Status::Unreachable, Code::NoSolution, probable, reason)
        }
        (true, _) => {
            let reason =
                format!("{MODULO}: {count} assemblies with multiplicity; all are proved, by Krawczyk's theorem");
            (Status::Complete, Code::CountMet, probable, reason)
        }
        (false, _) => {
            let reason = format!(
                "{MODULO}: {count} assemblies with multiplicity, of which {} were found and proved",
                modes.len()
            );
            (Status::Incomplete, Code::TooFew, Proof::None, reason)
        }
    };
    Verdict {
        status,
        proof,
        code,
        complex_complete: modes.len() == count,
        complex: count,
        real,
        at_infinity: 0,
        self_motion: 0,
        certified: modes.len(),
        reason: if exact { reason } else { reason + "; some numbers of the file were rounded" },
    }
}

fn verdict(basis: &str, modes: &[SpaceMode], dimension: Option<usize>, has_point: bool, exact: bool) -> Verdict {
    let complex: usize = modes.iter().map(|mode| mode.multiplicity).sum();
    let real: usize = modes.iter().filter(|mode| mode.real).map(|mode| mode.multiplicity).sum();
    let proved = Proof::Proved.of_rounded(!exact);
    let (status, code, proof, reason) = match (dimension, real) {
        (None, _) => (
            Status::Unreachable,
            Code::NoSolution,
            proved,
            format!("{basis}: the equations of the joints contradict one another"),
        ),
        (Some(0), 0) => {
            (Status::Unreachable, Code::NoSolution, proved, format!("{basis} counts them with multiplicity"))
        }
        (Some(0), _) => {
            (Status::Complete, Code::GeneralBoundMet, proved, format!("{basis} counts them with multiplicity"))
        }
        (Some(dimension), _) if has_point => (
            Status::SelfMotion,
            Code::SelfMotion,
            Proof::None,
            format!(
                "{basis}: the assemblies form a set of dimension {dimension}, complex ones counted; a real one near which others lie to first order is listed"
            ),
        ),
        (Some(dimension), _) => (
            Status::Incomplete,
            Code::TooFew,
            Proof::None,
            format!(
                "{basis}: the assemblies form a set of dimension {dimension}, complex ones counted; no real one was found in it"
            ),
        ),
    };
    Verdict {
        status,
        proof,
        code,
        complex_complete: dimension.is_none_or(|dimension| dimension == 0),
        complex,
        real,
        at_infinity: 0,
        self_motion: if has_point { dimension.unwrap_or(0) } else { 0 },
        certified: modes.len(),
        reason: if exact { reason } else { reason + "; some numbers of the file were rounded" },
    }
}
