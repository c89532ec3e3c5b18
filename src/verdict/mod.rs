//! The verdict on a list of modes: is it complete, and why.

mod platform;
mod proof;

pub use platform::{MOST_POSES, Moving, PlatformKnowledge, platform_verdict};
pub use proof::{Code, Proof};

use crate::assembly::{Assembly, Mode, Roots, are_apart};
use crate::kinematics::closed_loop::Variable;
use num_complex::Complex;

/// The outcome in one word.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// Every isolated solution was found, and why is known.
    Complete,
    /// Something may be missing.
    Incomplete,
    /// Complete, and no solution is real.
    Unreachable,
    /// Solutions form a curve or more.
    SelfMotion,
    /// Beyond what is implemented.
    Unsupported,
}

impl Status {
    /// The word of the JSON output.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Complete => "complete",
            Self::Incomplete => "incomplete",
            Self::Unreachable => "unreachable",
            Self::SelfMotion => "self-motion",
            Self::Unsupported => "unsupported",
        }
    }
}

/// The verdict on a list of modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The outcome.
    pub status: Status,
    /// The proof of the outcome.
    pub proof: Proof,
    /// The reason as a code.
    pub code: Code,
    /// Whether the list is complete in complex solutions, too.
    pub complex_complete: bool,
    /// Isolated complex solutions found, with multiplicity.
    pub complex: usize,
    /// Real ones among them, with multiplicity.
    pub real: usize,
    /// Solutions of the general pose that are at infinity here.
    pub at_infinity: usize,
    /// Dimension of the self-motion, 0 if there is none.
    pub self_motion: usize,
    /// Distinct modes with a certificate.
    pub certified: usize,
    /// Why.
    pub reason: String,
}

impl Verdict {
    /// Returns whether the real solutions are all listed, and the number of complex ones is not known.
    #[must_use]
    pub fn is_of_real_ones(&self) -> bool {
        let is_list = matches!(self.status, Status::Complete | Status::Unreachable);
        is_list && self.proof != Proof::None && !self.complex_complete
    }
}

/// An upper bound on the number of isolated solutions, and where it comes from.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The bound, with multiplicity.
    pub count: usize,
    /// The proof of the bound.
    pub proof: Proof,
    /// The code of a verdict that rests on it.
    pub code: Code,
    /// A clause such as `the closure polynomial of this arm has degree 8 (mod p)`.
    pub because: String,
}

impl Bound {
    /// Returns the bound of every loop whose closure polynomial has this degree in general.
    #[must_use]
    pub fn general(degree: usize) -> Self {
        let because = format!("a degree-{degree} closure polynomial");
        Self { count: degree, proof: Proof::Proved, code: Code::GeneralBoundMet, because }
    }
}

/// Judges a list of modes. `general` is the degree of the closure polynomial of general loops of this kind; `geometry` bounds the
/// number of solutions at every pose, `pose` at this one; each is called only when needed. `too_far` holds the distance to be
/// bridged and the length of all links if that is shorter.
pub fn verdict(
    assembly: &Assembly,
    roots: Roots,
    structural_rank: usize,
    general: usize,
    geometry: impl FnOnce() -> Bound,
    pose: impl FnOnce() -> Option<Bound>,
    too_far: Option<(f64, f64)>,
) -> Verdict {
    let mut judged = if assembly.self_motion > 0 {
        let reason = self_motion(assembly, structural_rank);
        Judged { status: Status::SelfMotion, ..Judged::unproved(Code::SelfMotion, reason) }
    } else if structural_rank < 6 {
        let none = if assembly.modes.is_empty() { pose().filter(|here| here.count == 0) } else { None };
        if let Some(here) = none {
            let reason = format!("{}; {}", deficient(structural_rank), accounted(&[], &here));
            Judged { code: Code::NoSolution, ..Judged::by(Status::Unreachable, &here, reason) }
        } else {
            let list =
                if assembly.modes.is_empty() { "no solution was found" } else { "the list is not proved complete" };
            Judged::unproved(Code::StructurallyDeficient, format!("{}; {list}", deficient(structural_rank)))
        }
    } else if let Some((code, doubt)) = doubt(&assembly.modes) {
        Judged::unproved(code, format!("not proved: {doubt}"))
    } else {
        count(assembly, roots, general, geometry, pose)
    };
    // A mode without certificate is multiple, real or distinct as measured only.
    if certified(&assembly.modes) < assembly.modes.len() {
        judged.proof = Proof::None;
    }
    if assembly.by_high_precision > 0 {
        let (by_high_precision, bits) = (assembly.by_high_precision, assembly.high_precision_bits);
        judged.reason += &format!("; {by_high_precision} of them found or proved in {bits}-bit arithmetic only");
    }
    if let (Some(distance), Status::Incomplete, 0) = (too_far, judged.status, assembly.real()) {
        judged = Judged::out_of_reach(distance);
    }
    judged.of(assembly)
}

/// Returns the verdict at a distance that the links cannot bridge, both given as [`verdict`] takes them; the list may hold complex
/// modes.
#[must_use]
pub fn out_of_reach(distance: (f64, f64), assembly: &Assembly) -> Verdict {
    Judged::out_of_reach(distance).of(assembly)
}

/// A status, what it rests on, and its reason.
struct Judged {
    status: Status,
    proof: Proof,
    code: Code,
    at_infinity: usize,
    reason: String,
}

impl Judged {
    fn unproved(code: Code, reason: String) -> Self {
        Self { status: Status::Incomplete, proof: Proof::None, code, at_infinity: 0, reason }
    }

    /// A status that rests on a bound that is met.
    fn by(status: Status, bound: &Bound, reason: String) -> Self {
        Self { status, proof: bound.proof, code: bound.code, at_infinity: 0, reason }
    }

    fn out_of_reach((gap, links): (f64, f64)) -> Self {
        let reason = format!("out of reach: {gap:.4e} has to be bridged by links of {links:.4e} together");
        let (status, code) = (Status::Unreachable, Code::OutOfReach);
        Self { status, proof: Proof::Proved, code, at_infinity: 0, reason }
    }

    fn of(self, assembly: &Assembly) -> Verdict {
        Verdict {
            status: self.status,
            proof: self.proof,
            code: self.code,
            complex_complete: self.is_complete() && self.code != Code::OutOfReach,
            complex: assembly.total(),
            real: assembly.real(),
            at_infinity: self.at_infinity,
            self_motion: assembly.self_motion,
            certified: certified(&assembly.modes),
            reason: self.reason,
        }
    }

    fn is_complete(&self) -> bool {
        matches!(self.status, Status::Complete | Status::Unreachable)
    }
}

fn certified(modes: &[Mode]) -> usize {
    modes.iter().filter(|m| m.certificate.is_some()).count()
}

fn deficient(rank: usize) -> String {
    format!(
        "structurally deficient: the joint axes reach only rank {rank} of 6 in general position; where it closes, {} of \
         the six unknowns stay free",
        6 - rank
    )
}

fn self_motion(assembly: &Assembly, structural_rank: usize) -> String {
    let because = if structural_rank < 6 { format!(" ({})", deficient(structural_rank)) } else { String::new() };
    format!(
        "solutions form a self-motion of dimension {}{because}; the isolated ones are listed, not proved complete",
        assembly.self_motion
    )
}

/// Returns the doubt that prevents counting these modes at all.
fn doubt(modes: &[Mode]) -> Option<(Code, String)> {
    if let Some(mode) = modes.iter().find(|m| m.multiplicity == 0) {
        let kind = if mode.real { "real" } else { "complex" };
        return Some((Code::UnknownMultiplicity, format!("a singular {kind} solution of unknown multiplicity")));
    }
    let unproved = modes.iter().filter(|m| m.multiplicity == 1 && m.certificate.is_none()).count();
    if unproved > 0 {
        return Some((Code::NoCertificate, format!("{unproved} of {} roots have no certificate", modes.len())));
    }
    if (1..modes.len()).any(|k| modes[..k].iter().any(|other| !are_distinct(other, &modes[k]))) {
        return Some((Code::NotDistinct, "two roots are not proved to be distinct".to_owned()));
    }
    let undecided = modes.iter().any(|mode| !mode.real && !is_proved_complex(mode));
    undecided.then(|| (Code::RealOrComplex, "a root is neither proved real nor proved complex".to_owned()))
}

/// Compares the number of modes with what is known of the number of solutions.
fn count(
    assembly: &Assembly,
    roots: Roots,
    general: usize,
    geometry: impl FnOnce() -> Bound,
    pose: impl FnOnce() -> Option<Bound>,
) -> Judged {
    let found = assembly.total();
    let bound = if found == general { Bound::general(general) } else { geometry() };
    if found > bound.count {
        let reason = format!("contradiction: {found} roots found, but {}", bound.because);
        return Judged::unproved(Code::TooMany, reason);
    }
    let status = if assembly.real() == 0 { Status::Unreachable } else { Status::Complete };
    if found == bound.count {
        return Judged::by(status, &bound, accounted(&assembly.modes, &bound));
    }
    if roots == Roots::Real {
        return Judged::unproved(Code::OnlyReal, "not proved: only real roots were looked for".to_owned());
    }
    match pose() {
        Some(here) if here.count == found => {
            let at_infinity = bound.count - found;
            Judged { at_infinity, ..Judged::by(status, &here, accounted(&assembly.modes, &here)) }
        }
        here => {
            let bound = here.filter(|here| here.count < bound.count).unwrap_or(bound);
            let reason = format!("not proved: found {found} of up to {} roots of {}", bound.count, bound.because);
            Judged::unproved(Code::TooFew, reason)
        }
    }
}

/// Describes in words the count of the modes against the bound.
fn accounted(modes: &[Mode], bound: &Bound) -> String {
    let multiple: Vec<usize> = modes.iter().map(|m| m.multiplicity).filter(|&m| m > 1).collect();
    accounted_for(certified(modes), &multiple, bound)
}

/// Describes in words the count of certified modes and multiple ones of these multiplicities against the bound.
fn accounted_for(certified: usize, multiple: &[usize], bound: &Bound) -> String {
    let also = match multiple.len() {
        0 => String::new(),
        several => format!(" and {several} multiple ones (counted {})", multiple.iter().sum::<usize>()),
    };
    if certified == 0 && multiple.is_empty() {
        return format!("no root at all of {}", bound.because);
    }
    format!("{certified} distinct certified roots{also} of {}", bound.because)
}

/// Returns whether two modes are proved to be different solutions. This checks the list as a whole: the solver has merged equal
/// modes already. Every unknown counts as an angle here, which can only bring modes nearer.
fn are_distinct(one: &Mode, two: &Mode) -> bool {
    are_apart(&[Variable::Rotation; 6], one, two)
}

/// Whether a complex mode is farther from the real numbers than its error.
fn is_proved_complex(mode: &Mode) -> bool {
    let off = |z: &Complex<f64>| match mode.certificate {
        Some(certificate) => certificate.proved + 4.0 * f64::EPSILON * z.norm().max(1.0),
        None => 1e-6,
    };
    mode.unknowns.iter().any(|z| z.im.abs() > off(z))
}
