//! The verdict on the poses of a platform.

use super::{Bound, Code, Judged, Proof, Status, Verdict, accounted_for};
use crate::assembly::Roots;
use crate::assembly::platform::{PlatformAssembly, PlatformMode};
use crate::certify::pose::{are_apart, is_complex};

/// The most isolated poses that six legs can have.
pub const MOST_POSES: usize = 40;

/// The knowledge of the poses of one set of legs beside the list.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlatformKnowledge {
    /// The number of isolated poses, counted with multiplicity.
    pub count: Option<Bound>,
    /// The counted dimension of a family of poses, complex ones included; a measurement only.
    pub infinite: Option<usize>,
    /// Whether the equations have infinitely many solutions modulo a prime drawn at random.
    pub infinite_modulo_prime: bool,
    /// The proof that no real pose is missing: every real root of the exact polynomial belongs to listed real poses whose
    /// multiplicities add up to its own.
    pub reals: Option<Proof>,
    /// The self-motion that is proved.
    pub moving: Option<Moving>,
    /// Whether two legs alone show that no pose is real.
    pub no_real_pose: bool,
    /// Whether complex poses are requested as well.
    pub complex_asked: bool,
}

/// A self-motion of a platform that is proved to be real.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Moving {
    /// Its dimension.
    pub dimension: usize,
    /// Whether no pose is isolated among all complex ones, because legs depend on others; it goes through the pose of the file otherwise.
    pub is_all: bool,
}

impl Moving {
    fn judged(self) -> Judged {
        let Self { dimension, is_all } = self;
        let reason = if is_all {
            format!(
                "poses form a self-motion of dimension {dimension}, and every other one lies on a family, too, real or complex: the equations \
                 of some legs are combinations of the others'; a real pose may stand alone on a family of complex ones"
            )
        } else {
            format!(
                "poses form a self-motion of dimension {dimension} through the pose of the file, as power series show; the isolated ones \
                 are listed, not proved complete"
            )
        };
        let proof = Proof::Proved;
        Judged { status: Status::SelfMotion, proof, ..Judged::unproved(Code::SelfMotion, reason) }
    }
}

/// Judges the poses of a platform.
#[must_use]
pub fn platform_verdict(assembly: &PlatformAssembly, roots: Roots, knowledge: &PlatformKnowledge) -> Verdict {
    let dimension = match knowledge.infinite {
        // Where solutions are multiple, a pose is shaky in more directions than it can move.
        Some(counted) if knowledge.moving.is_none() => assembly.self_motion.min(counted),
        _ => assembly.self_motion,
    };
    let mut complex_complete = false;
    let mut judged = if let Some(moving) = knowledge.moving {
        moving.judged()
    } else if dimension > 0 {
        let reason = format!(
            "poses form a self-motion of dimension {dimension}, as far as f64 tells; the isolated ones are listed, not proved \
             complete"
        );
        Judged { status: Status::SelfMotion, ..Judged::unproved(Code::SelfMotion, reason) }
    } else if let Some((code, doubt)) = doubt(assembly) {
        Judged::unproved(code, format!("not proved: {doubt}"))
    } else {
        let judged = count(assembly, roots, knowledge);
        complex_complete = judged.is_complete();
        judged
    };
    if !judged.is_complete() && !knowledge.complex_asked {
        judged = real_list(assembly, knowledge).unwrap_or(judged);
    }
    if assembly.by_high_precision > 0 {
        let (by_high_precision, bits) = (assembly.by_high_precision, assembly.high_precision_bits);
        judged.reason += &format!("; {by_high_precision} of them found or proved in {bits}-bit arithmetic only");
    }
    Verdict {
        status: judged.status,
        proof: judged.proof,
        code: judged.code,
        complex_complete,
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

/// Judges the real poses alone.
fn real_list(assembly: &PlatformAssembly, knowledge: &PlatformKnowledge) -> Option<Judged> {
    if knowledge.no_real_pose && assembly.real() == 0 {
        let reason = "no pose has legs of these lengths: two of them alone show it".to_owned();
        let bound = Bound { count: 0, proof: Proof::Proved, code: Code::NoPoseHasLegs, because: reason.clone() };
        return Some(Judged::by(Status::Unreachable, &bound, reason));
    }
    let proof = knowledge.reals?;
    let real = assembly.real();
    let because = "every real root of the exact polynomial of all poses belongs to listed ones";
    let (status, reason) = match real {
        0 => (Status::Unreachable, "no pose is real: the exact polynomial of all poses has no real root".to_owned()),
        _ => (Status::Complete, format!("{real} real poses, with multiplicity, are all that there are: {because}")),
    };
    let bound = Bound { count: real, proof, code: Code::ExactRootsMatched, because: because.to_owned() };
    Some(Judged::by(status, &bound, reason))
}

/// Returns the doubt that prevents counting these modes at all.
fn doubt(assembly: &PlatformAssembly) -> Option<(Code, String)> {
    let modes = &assembly.modes;
    if let Some(mode) = modes.iter().find(|mode| mode.multiplicity == 0) {
        let kind = if mode.real { "real" } else { "complex" };
        return Some((Code::UnknownMultiplicity, format!("a singular {kind} pose of unknown multiplicity")));
    }
    // The multiplicity of a pose is proved, or the pose is not listed as certified.
    let unproved = modes.iter().filter(|mode| mode.certificate.is_none()).count();
    if unproved > 0 {
        return Some((Code::NoCertificate, format!("{unproved} of {} roots have no certificate", modes.len())));
    }
    let radius = |mode: &PlatformMode| mode.certificate.map_or(f64::INFINITY, |certificate| certificate.radius);
    let apart = |one: &PlatformMode, two: &PlatformMode| are_apart(&one.study, radius(one), &two.study, radius(two));
    // A check of the list as a whole: the solver has merged what is one already.
    if (1..modes.len()).any(|k| (0..k).any(|j| !apart(&modes[j], &modes[k]))) {
        return Some((Code::NotDistinct, "two roots are not proved to be distinct".to_owned()));
    }
    let undecided = modes.iter().any(|mode| !mode.real && !is_complex(&mode.study, radius(mode)));
    undecided.then(|| (Code::RealOrComplex, "a root is neither proved real nor proved complex".to_owned()))
}

/// Compares the number of modes with what is known of the number of poses.
fn count(assembly: &PlatformAssembly, roots: Roots, knowledge: &PlatformKnowledge) -> Judged {
    let found = assembly.total();
    let status = if assembly.real() == 0 { Status::Unreachable } else { Status::Complete };
    let settled = |bound: &Bound| {
        let multiple: Vec<usize> = assembly.modes.iter().map(|mode| mode.multiplicity).filter(|&m| m > 1).collect();
        Judged::by(status, bound, accounted_for(certified(&assembly.modes) - multiple.len(), &multiple, bound))
    };
    let bound = match &knowledge.count {
        Some(bound) if found != MOST_POSES => bound,
        _ => {
            if found == MOST_POSES {
                let because = format!("at most {MOST_POSES} that six legs can have");
                let (count, proof, code) = (MOST_POSES, Proof::Proved, Code::GeneralBoundMet);
                return settled(&Bound { count, proof, code, because });
            }
            if roots == Roots::Real {
                return Judged::unproved(Code::OnlyReal, "not proved: only real roots were looked for".to_owned());
            }
            let reason = match knowledge.infinite {
                Some(_) if knowledge.infinite_modulo_prime => {
                    "not proved: there seem to be infinitely many poses, real or complex, as modulo a prime drawn at random".to_owned()
                }
                Some(_) => "not proved: it is not decided whether there are finitely many poses".to_owned(),
                None => format!("not proved: found {found} of up to {MOST_POSES} roots"),
            };
            return Judged::unproved(Code::TooFew, reason);
        }
    };
    match found.cmp(&bound.count) {
        std::cmp::Ordering::Equal => settled(bound),
        std::cmp::Ordering::Less => {
            Judged::unproved(Code::TooFew, format!("not proved: found {found} of {}", bound.because))
        }
        std::cmp::Ordering::Greater => {
            let reason = format!("contradiction: {found} roots found, but there are {}", bound.because);
            Judged::unproved(Code::TooMany, reason)
        }
    }
}
