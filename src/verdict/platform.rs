//! The verdict on the poses of a platform.

use super::{Bound, Code, Judged, Proof, Status, Verdict, accounted_for};
use crate::assembly::Roots;
use crate::assembly::platform::{PlatformAssembly, PlatformMode};
use crate::certify::pose::{are_apart, is_complex};
use crate::elimination::platform_degree::PlatformDegree;
use num_complex::Complex;

/// The most isolated poses that six legs can have.
const MOST: usize = 40;

/// Study's parameters of a mode, as its certificate bounds them.
type Study = [Complex<f64>; 8];

/// Judges the poses of a platform. `study` holds Study's parameters of every mode, `exact` the exact number of poses where
/// that was asked for.
#[must_use]
pub fn platform_verdict(
    assembly: &PlatformAssembly,
    study: &[Study],
    roots: Roots,
    exact: Option<PlatformDegree>,
) -> Verdict {
    let dimension = match exact {
        Some(PlatformDegree::Infinite { dimension }) if assembly.self_motion == 0 => dimension,
        // Where solutions are multiple, a pose gives way in more directions than it can move.
        Some(PlatformDegree::Infinite { dimension }) => assembly.self_motion.min(dimension),
        _ => assembly.self_motion,
    };
    let mut judged = if dimension > 0 {
        let how = match exact {
            Some(PlatformDegree::Infinite { .. }) if assembly.self_motion > 0 => String::new(),
            Some(PlatformDegree::Finite { poses, .. }) => format!(
                ", to within rounding (of exactly these data {poses} isolated poses, by a count modulo a prime)"
            ),
            Some(PlatformDegree::Infinite { .. }) => ", real or complex, by an exact count (modulo a prime)".to_owned(),
            None => ", as far as f64 tells".to_owned(),
        };
        let reason = format!(
            "poses form a self-motion of dimension {dimension}{how}; the isolated ones are listed, not proved complete"
        );
        Judged { status: Status::SelfMotion, ..Judged::unproved(Code::SelfMotion, reason) }
    } else if let Some((code, doubt)) = doubt(assembly, study) {
        Judged::unproved(code, format!("not proved: {doubt}"))
    } else {
        count(assembly, roots, exact)
    };
    if assembly.rescued > 0 {
        judged.reason += &format!("; {} of them found or proved in 384-bit arithmetic only", assembly.rescued);
    }
    Verdict {
        status: judged.status,
        proof: judged.proof,
        code: judged.code,
        complex_complete: judged.is_complete(),
        complex: assembly.total(),
        real: assembly.real(),
        at_infinity: judged.at_infinity,
        self_motion: dimension,
        certified: certified(&assembly.modes),
        reason: judged.reason,
    }
}

fn certified(modes: &[PlatformMode]) -> usize {
    modes.iter().filter(|mode| mode.certificate.is_some()).count()
}

/// What speaks against counting these modes at all.
fn doubt(assembly: &PlatformAssembly, study: &[Study]) -> Option<(Code, String)> {
    let modes = &assembly.modes;
    if let Some(mode) = modes.iter().find(|mode| mode.multiplicity == 0) {
        let kind = if mode.real { "real" } else { "complex" };
        return Some((Code::UnknownMultiplicity, format!("a singular {kind} pose of unknown multiplicity")));
    }
    let unproved = modes.iter().filter(|mode| mode.multiplicity == 1 && mode.certificate.is_none()).count();
    if unproved > 0 {
        return Some((Code::NoCertificate, format!("{unproved} of {} roots have no certificate", modes.len())));
    }
    let radius = |mode: &PlatformMode| mode.certificate.map_or(0.0, |certificate| certificate.radius);
    let apart = |j: usize, k: usize| are_apart(&study[j], radius(&modes[j]), &study[k], radius(&modes[k]));
    // A check of the list as a whole: the solver has merged what is one already.
    if (1..modes.len()).any(|k| (0..k).any(|j| !apart(j, k))) {
        return Some((Code::NotDistinct, "two roots are not proved to be distinct".to_owned()));
    }
    let undecided = modes.iter().zip(study).any(|(mode, v)| !mode.real && !is_complex(v, radius(mode)));
    undecided.then(|| (Code::RealOrComplex, "a root is neither proved real nor proved complex".to_owned()))
}

/// Compares the number of modes with what is known of the number of poses.
fn count(assembly: &PlatformAssembly, roots: Roots, exact: Option<PlatformDegree>) -> Judged {
    let found = assembly.total();
    let status = if assembly.real() == 0 { Status::Unreachable } else { Status::Complete };
    let settled = |proof: Proof, code: Code, because: String| {
        let multiple: Vec<usize> = assembly.modes.iter().map(|mode| mode.multiplicity).filter(|&m| m > 1).collect();
        let bound = Bound { count: found, proof, code, because };
        Judged::by(status, &bound, accounted_for(certified(&assembly.modes), &multiple, &bound))
    };
    if found == MOST && exact.is_none() {
        return settled(Proof::Proved, Code::GeneralBoundMet, "at most 40 that six legs can have".to_owned());
    }
    if roots == Roots::Real {
        return Judged::unproved(Code::OnlyReal, "not proved: only real roots were looked for".to_owned());
    }
    match exact {
        Some(PlatformDegree::Finite { poses, null, curves }) => {
            let beside = match (null, curves) {
                (_, true) => ", beside curves of solutions with N = 0, which are no poses".to_owned(),
                (0, false) => String::new(),
                (null, false) => format!(", beside {null} solutions with N = 0, which are no poses"),
            };
            let because = format!("{poses} poses by an exact count (modulo a prime){beside}");
            match found.cmp(&poses) {
                std::cmp::Ordering::Equal => settled(Proof::None, Code::CountMet, because),
                std::cmp::Ordering::Less => {
                    Judged::unproved(Code::TooFew, format!("not proved: found {found} of {because}"))
                }
                std::cmp::Ordering::Greater => {
                    let reason = format!("contradiction: {found} roots found, but there are {because}");
                    Judged::unproved(Code::TooMany, reason)
                }
            }
        }
        Some(PlatformDegree::Infinite { .. }) | None => {
            Judged::unproved(Code::TooFew, format!("not proved: found {found} of up to 40 roots"))
        }
    }
}
