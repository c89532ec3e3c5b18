//! The answer to one case of a linkage: its assemblies as numbers, and the verdict on their list.

use super::assembly::{
    Asked, Assemblies, Family, FamilyKind, Route, Solution, assemblies, assemblies_of_squares, assemblies_within,
};
use super::isotropic::{Value, middle};
use super::near::sort_near;
use super::rates::{movable, resting};
use super::state::{Number, State, number};
use crate::algebra::drawn;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::error::Result;
use crate::kinematics::linkage::{Accuracy, Given, Linkage, Pair};
use crate::verdict::{Code, Proof, Status, Verdict};
use num_complex::Complex;
use rug::Float;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// What is not known where a group moves on which others stand.
const UNFOLLOWED: &str = "a group moves by itself, and groups that stand on it were not found to close at the places of that motion that were tried";

/// A joint value or a coordinate, real of a real assembly.
pub type Coordinate = Complex<f64>;

/// An assembly.
#[derive(Clone, Debug)]
pub struct LinkageMode {
    /// Whether it is real.
    pub real: bool,
    /// The multiplicity.
    pub multiplicity: usize,
    /// The values of the joints: radians in (-pi, pi] or metres; `None` of gears.
    pub joints: Vec<Option<Coordinate>>,
    /// The angles of the bodies against the ground, radians in (-pi, pi], and the places of their origins, metres.
    pub bodies: Vec<(Coordinate, [Coordinate; 2])>,
    /// The largest distance by which a joint is open, metres.
    pub residual: f64,
    /// Exactly one assembly lies within this distance, of all rotations as complex numbers and all origins.
    pub radius: f64,
}

/// A curve of assemblies.
#[derive(Clone, Debug)]
pub struct LinkageFamily {
    /// Its dimension.
    pub dimension: usize,
    /// The joints that move.
    pub joints: Vec<usize>,
    /// A point of it.
    pub sample: LinkageMode,
}

impl LinkageFamily {
    /// The assemblies near one of them, of which these joints move.
    #[must_use]
    pub fn at(linkage: &Linkage, state: &State, dimension: usize, joints: Vec<usize>) -> Self {
        Self { dimension, joints, sample: mode(linkage, state) }
    }
}

/// A group and how it was solved.
#[derive(Clone, Debug)]
pub struct LinkageGroup {
    /// The bodies of its clusters.
    pub bodies: Vec<Vec<usize>>,
    /// Its assemblies, with multiplicity.
    pub count: usize,
    /// The way, in a few words.
    pub route: String,
}

/// The answer to a case.
#[derive(Clone, Debug)]
pub struct LinkageAnswer {
    /// The verdict on the list.
    pub verdict: Verdict,
    /// The isolated assemblies, real ones first.
    pub modes: Vec<LinkageMode>,
    /// The curves of assemblies.
    pub families: Vec<LinkageFamily>,
    /// The groups in the order in which they were solved.
    pub groups: Vec<LinkageGroup>,
    /// Whether `modes` holds all assemblies that the verdict counts.
    pub listed: bool,
    /// Microseconds that it took.
    pub solve_us: f64,
}

/// Finds all assemblies with these inputs; of large groups all real ones.
///
/// # Errors
/// Where inputs are too few, too many or meet a rigid part, and for groups that are beyond what is implemented.
pub fn solve(linkage: &Linkage, given: &[Given], accuracy: Accuracy) -> Result<LinkageAnswer> {
    solve_asked(linkage, given, accuracy, Asked { complex: false, stop: &AtomicBool::new(false), near: None })
}

/// As [`solve`], for complex assemblies of large groups as well where they are asked for. A search that is ended is incomplete.
///
/// # Errors
/// As [`solve`].
pub fn solve_asked(linkage: &Linkage, given: &[Given], accuracy: Accuracy, asked: Asked<'_>) -> Result<LinkageAnswer> {
    let start = Instant::now();
    // What discs decide holds for the angles themselves; where they leave a doubt, or ends coincide, the rounded ones are taken.
    let within = if accuracy == Accuracy::Enclosed { Some(assemblies_within(linkage, given, asked)?) } else { None };
    let within = within.filter(|found| found.doubt.is_none() && found.curves.is_empty() && !found.is_probable);
    let squared = if accuracy == Accuracy::Squared { assemblies_of_squares(linkage, given, asked)? } else { None };
    let squared = squared.filter(|found| found.doubt.is_none() && !found.is_probable && !found.only_real);
    let within = within.or(squared);
    let (found, exact) = match within {
        Some(within) if !within.only_real => (within, true),
        within => {
            // All complex assemblies of the rounded angles say more than the real ones of the angles themselves.
            let rounded = assemblies(linkage, given, asked)?;
            match within {
                Some(within) if rounded.only_real || rounded.doubt.is_some() => (within, true),
                _ => (rounded, accuracy == Accuracy::Exact),
            }
        }
    };
    let mut modes: Vec<LinkageMode> = found.modes.iter().map(|state| mode(linkage, state)).collect();
    let key = |mode: &LinkageMode| mode.bodies.iter().map(|(angle, _)| angle.re).collect::<Vec<f64>>();
    sort::by(&mut modes, |a, b| {
        let angles = || {
            let pairs = key(a).into_iter().zip(key(b));
            pairs.map(|(x, y)| x.total_cmp(&y)).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
        };
        b.real.cmp(&a.real).then_with(angles)
    });
    if let Some(near) = asked.near {
        sort_near(linkage, &mut modes, near);
    }
    let families = found.curves.iter().filter(|family| is_one(&family.state));
    let families = families.map(|family| {
        let mut one = LinkageFamily::at(linkage, &family.state, family.dimension, family.joints.clone());
        if family.kind == FamilyKind::Followed {
            one.joints = movable(linkage, given, &resting(&one.sample));
        }
        one
    });
    let families: Vec<LinkageFamily> = families.collect();
    let verdict = verdict(&found, &modes, &families, exact);
    let groups = found.groups.iter().map(|group| LinkageGroup {
        bodies: group.bodies.clone(),
        count: group.count,
        route: route(group),
    });
    Ok(LinkageAnswer {
        verdict,
        modes,
        families,
        groups: groups.collect(),
        listed: true,
        solve_us: start.elapsed().as_secs_f64() * 1e6,
    })
}

fn route(group: &Solution) -> String {
    match group.route {
        Route::Quadratic => "quadratic".to_owned(),
        Route::Pencil(rows) => format!("pencil of {rows} rows"),
        Route::Basis => "Gröbner basis".to_owned(),
        Route::Boxes(boxes) => format!("{boxes} boxes of angles"),
        Route::Wheel => "a power of a rotation".to_owned(),
        Route::Gears(1) => "Gröbner basis of a pair of gears".to_owned(),
        Route::Gears(pairs) => format!("Gröbner basis of {pairs} pairs of gears"),
    }
}

/// Whether all bodies are one cluster.
pub(super) fn is_one(state: &State) -> bool {
    state.bodies.iter().all(|body| body.0 == state.bodies[0].0)
}

/// Why no assembly is missing.
fn because(has: &dyn Fn(fn(&Route) -> bool) -> bool) -> String {
    let mut parts = Vec::new();
    if has(|route| matches!(route, Route::Pencil(_))) {
        parts.push("every root of the exact closure polynomials is a certified assembly");
    }
    if has(|route| matches!(route, Route::Basis)) {
        parts.push("Gröbner bases over the rationals count those of groups with multiple ones");
    }
    if has(|route| matches!(route, Route::Gears(_))) {
        parts.push("Gröbner bases over the rationals count those of gears");
    }
    if has(|route| matches!(route, Route::Wheel)) {
        parts.push("a wheel has one for every root of the power of its rotation that is known");
    }
    if has(|route| matches!(route, Route::Quadratic)) {
        parts.push("dyads have two each");
    }
    parts.join(", ")
}

/// Whether a motion of the whole linkage is proved, and what is known of it.
fn motion(family: &Family, found: &Assemblies) -> (bool, String) {
    if family.kind == FamilyKind::Followed {
        let groups = if family.is_proved {
            "those that stand on it have a regular assembly at a place of that motion, which goes on along it"
        } else {
            "those that stand on it close at a place of that motion"
        };
        let reason = format!(
            "a group moves by itself, and {groups}; isolated assemblies and other motions beside it are not all looked for"
        );
        return (family.is_proved, reason);
    }
    if family.kind != FamilyKind::Other {
        let list = match &found.doubt {
            Some(doubt) => format!("the isolated ones may not be all: {doubt}"),
            None => "the isolated ones listed beside it are all that there are".to_owned(),
        };
        let what = match family.kind {
            FamilyKind::Dyad => "a dyad whose ends coincide turns freely",
            FamilyKind::Slide => "bodies between slides move along them, by linear equations",
            _ => "a body whose joints coincide turns freely",
        };
        return (found.doubt.is_none(), format!("{what}; {list}"));
    }
    let real = if family.is_proved {
        "a curve of real ones is among them: cuts at more places than there can be isolated ones have a real assembly each"
    } else {
        "the real one that is listed has others near it to first order"
    };
    let reason = format!(
        "the assemblies of a group form a set of dimension {}, complex ones counted, by a Gröbner basis over the rationals; {real}; \
         {}",
        family.dimension,
        if family.with_regular {
            "all regular assemblies of the group, which are isolated, are listed beside it; multiple ones are not looked for"
        } else {
            "isolated assemblies beside it are not all looked for"
        }
    );
    // That the real ones have this dimension too is not shown beyond curves.
    if family.dimension > 1 {
        return (false, format!("{reason}; that the real ones have this dimension too is not proved"));
    }
    (family.is_proved, reason)
}

fn verdict(found: &Assemblies, modes: &[LinkageMode], families: &[LinkageFamily], exact: bool) -> Verdict {
    let count =
        |of: &dyn Fn(&LinkageMode) -> bool| modes.iter().filter(|mode| of(mode)).map(|mode| mode.multiplicity).sum();
    let (complex, real): (usize, usize) = (count(&|_| true), count(&|mode| mode.real));
    let counts: Vec<String> = found.groups.iter().map(|group| group.count.to_string()).collect();
    let counts = counts.join(" x ");
    let complete = found.doubt.is_none() && found.curves.is_empty();
    let moving: Vec<&Family> = found.curves.iter().filter(|family| family.state.real).collect();
    let rounded = if found.is_probable {
        Proof::Probable { error: drawn::PROBABILITY_OF_ERROR, seed: drawn::seed() }
    } else {
        Proof::Proved.of_rounded(!exact)
    };
    let has = |wanted: fn(&Route) -> bool| found.groups.iter().any(|group| wanted(&group.route));
    let mut because = because(&has);
    if found.is_probable {
        because += "; groups whose numbers are not rational have as many as members whose numbers are drawn";
    }
    let has_boxes = has(|route| matches!(route, Route::Boxes(_)));
    let code = if found.is_probable {
        Code::CountMet
    } else if has_boxes {
        Code::BoxesExhausted
    } else if has(|route| !matches!(route, Route::Quadratic)) {
        Code::ExactRootsMatched
    } else {
        Code::GeneralBoundMet
    };
    let whole: Vec<&Family> = moving.iter().copied().filter(|family| is_one(&family.state)).collect();
    // Of a motion of several joints isolated assemblies beside it are not all known, whatever turns freely elsewhere.
    let is_several = |family: &&&Family| matches!(family.kind, FamilyKind::Other | FamilyKind::Followed);
    let first = whole.iter().find(is_several).or(whole.first());
    let (status, proof, code, reason) = if let Some(first) = first {
        let (is_first, reason) = motion(first, found);
        let is_proved = is_first && whole.iter().filter(is_several).all(|family| motion(family, found).0);
        // Along the motion of another group there may be more freedoms.
        let is_all = moving.iter().all(|family| is_one(&family.state));
        let reason = if is_all { reason } else { format!("{reason}; {UNFOLLOWED}") };
        (Status::SelfMotion, if is_proved && is_all { rounded } else { Proof::None }, Code::SelfMotion, reason)
    } else if !moving.is_empty() {
        (Status::Incomplete, Proof::None, Code::TooFew, format!("not proved: {UNFOLLOWED}"))
    } else if let Some(doubt) = &found.doubt {
        (Status::Incomplete, Proof::None, Code::TooFew, format!("not proved: {doubt}"))
    } else if !complete {
        let reason = "some assemblies that are not real form curves; all real ones are listed".to_owned();
        let status = if real == 0 { Status::Unreachable } else { Status::Complete };
        (status, rounded, code, reason)
    } else if found.only_real {
        let status = if real == 0 { Status::Unreachable } else { Status::Complete };
        let list = if real == 0 {
            "no assembly is real".to_owned()
        } else {
            format!("all {real} real ones of groups of {counts}")
        };
        let why = if has_boxes { "every box of angles is proved to hold none but these" } else { &because };
        let reason = format!("{list}: {why}; complex ones were not looked for");
        (status, rounded, code, reason)
    } else if real == 0 {
        let far = match found.gap {
            Some(gap) if gap > 0.0 => format!("; links of a dyad are too short or too long by {gap:.6} m at least"),
            _ => String::new(),
        };
        let reason = format!("no assembly is real: all {complex} of groups of {counts} are complex{far}");
        (Status::Unreachable, rounded, code, reason)
    } else if found.groups.is_empty() {
        (Status::Complete, rounded, code, "every body is held by what is given".to_owned())
    } else {
        let reason = format!("the groups have {counts}, with multiplicity: {because}");
        (Status::Complete, rounded, code, reason)
    };
    Verdict {
        status,
        proof,
        code,
        complex_complete: complete && !found.only_real,
        complex,
        real,
        at_infinity: 0,
        self_motion: families
            .iter()
            .filter(|family| family.sample.real)
            .map(|family| family.dimension)
            .max()
            .unwrap_or(0),
        certified: modes.len(),
        reason,
    }
}

/// Bits of an angle before it is listed in f64.
const ANGLE_BITS: u32 = 80;
/// Bits of the modulus of a rotation before its logarithm is listed in f64: those of an f64 are left where it is 1e-27 off 1.
const GROWTH_BITS: u32 = 144;

/// The complex angle of a rotation: `-i log z`, real where z is on the unit circle.
fn angle(turn: &Number, is_real: bool) -> Coordinate {
    let (re, im) = (&turn.z.disc.re, &turn.z.disc.im);
    let angle = Float::with_val(ANGLE_BITS, im.atan2_ref(re)).to_f64();
    // The half turn is pi and not -pi.
    let angle = if angle <= -std::f64::consts::PI { std::f64::consts::PI } else { angle };
    let growth = || -Float::with_val(GROWTH_BITS, re.hypot_ref(im)).ln().to_f64();
    Complex::new(angle, if is_real { 0.0 } else { growth() })
}

/// The coordinates x and y of a point.
fn coordinates(point: &Number) -> [Coordinate; 2] {
    let sum = middle(&point.z.disc.add(&point.w.disc));
    let difference = middle(&point.z.disc.sub(&point.w.disc));
    [sum / 2.0, difference / Complex::new(0.0, 2.0)]
}

/// The numbers of a place as they are known without what is exact of them, which a list does not need.
fn enclosed(value: &Value) -> Value {
    Value::within(value.disc.clone())
}

pub(super) fn mode(linkage: &Linkage, state: &State) -> LinkageMode {
    let state = &state.map(enclosed);
    let clean = |z: Coordinate| if state.real { Complex::new(z.re + 0.0, 0.0) } else { z };
    let joints = linkage.joints.iter().map(|joint| {
        let place = state.against(joint.of[1], joint.of[0]);
        match &joint.pair {
            Pair::Revolute => Some(clean(angle(&place.turn, state.real))),
            Pair::Prismatic { along, length, .. } => {
                let gap = place.apply(&number(&joint.at[1])).sub(&number(&joint.at[0]));
                let shift = gap.z.mul(&number::<Value>(along).z.inverse()?);
                Some(clean(shift.middle() * length.to_f64()))
            }
            Pair::Gear { .. } => None,
        }
    });
    let joints = joints.collect();
    let mut radius = 0.0_f64;
    let mut bodies = Vec::with_capacity(state.bodies.len());
    for body in 0..state.bodies.len() {
        let place = state.against(body, linkage.ground);
        for value in [&place.turn.z, &place.origin.z] {
            radius = radius.max(value.disc.radius().to_f64());
        }
        bodies.push((clean(angle(&place.turn, state.real)), coordinates(&place.origin).map(clean)));
    }
    // The ground is not off itself by the last bits, which would decide the order of modes.
    if let Some(ground) = bodies.get_mut(linkage.ground) {
        *ground = (Complex::default(), <[Coordinate; 2]>::default());
    }
    let open = linkage.joints.iter().filter(|joint| matches!(joint.pair, Pair::Revolute)).map(|joint| {
        let point = |k: usize| state.bodies[joint.of[k]].1.apply(&number(&joint.at[k]));
        middle(&point(0).sub(&point(1)).z.disc).norm()
    });
    // The numbers are listed in f64.
    let residual = open.fold(0.0, f64::max);
    LinkageMode {
        real: state.real,
        multiplicity: state.multiplicity,
        joints,
        bodies,
        residual,
        radius: radius.max(f64::EPSILON),
    }
}
