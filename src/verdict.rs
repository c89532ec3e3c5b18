//! The verdict on a list of modes: is it complete, and why.

use crate::assembly::{Assembly, Mode, Roots};

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

/// What is claimed of a list of modes.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// The outcome.
    pub status: Status,
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

/// An upper bound on the number of isolated solutions, and where it comes from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Bound {
    /// At most this many, with multiplicity.
    pub count: usize,
    /// A clause such as `the closure polynomial of this arm has degree 8 (mod p)`.
    pub because: String,
}

impl Bound {
    /// What holds for every loop of six unknown joints.
    #[must_use]
    pub fn general() -> Self {
        Self { count: 16, because: "a degree-16 closure polynomial".to_owned() }
    }
}

/// Judges a list of modes. `geometry` bounds the number of solutions at every pose, `pose` at this one; each is asked
/// only when needed.
pub fn verdict(
    assembly: &Assembly,
    roots: Roots,
    structural_rank: usize,
    geometry: impl FnOnce() -> Bound,
    pose: impl FnOnce() -> Option<Bound>,
) -> Verdict {
    let certified = assembly.modes.iter().filter(|m| m.certificate.is_some()).count();
    let mut verdict = Verdict {
        status: Status::Incomplete,
        complex: assembly.total(),
        real: assembly.real(),
        at_infinity: 0,
        self_motion: assembly.self_motion,
        certified,
        reason: String::new(),
    };
    let deficient =
        || format!("structurally deficient: the joint axes reach only rank {structural_rank} of 6 in general position");
    if assembly.self_motion > 0 {
        verdict.status = Status::SelfMotion;
        verdict.reason = format!(
            "solutions form a self-motion of dimension {}{}; the isolated ones are listed, not proved complete",
            assembly.self_motion,
            if structural_rank < 6 { format!(" ({})", deficient()) } else { String::new() }
        );
        return verdict;
    }
    if structural_rank < 6 {
        verdict.reason = format!("{}; no solution was found, which is not proved", deficient());
        if !assembly.modes.is_empty() {
            verdict.reason = format!("{}; the list is not proved complete", deficient());
        }
        return verdict;
    }
    if let Some(mode) = assembly.modes.iter().find(|m| m.multiplicity == 0) {
        let kind = if mode.real { "real" } else { "complex" };
        verdict.reason = format!("not proved: a singular {kind} solution of unknown multiplicity");
        return verdict;
    }
    let simple = assembly.modes.iter().filter(|m| m.multiplicity == 1 && m.certificate.is_none()).count();
    let accounted = |bound: &Bound| {
        let multiple = assembly.modes.iter().filter(|m| m.multiplicity > 1).count();
        let mut text = format!("{certified} distinct certified roots");
        if multiple > 0 {
            let counted: usize = assembly.modes.iter().filter(|m| m.multiplicity > 1).map(|m| m.multiplicity).sum();
            text += &format!(" and {multiple} multiple ones (counted {counted})");
        }
        format!("{text} of {}", bound.because)
    };
    let found = verdict.complex;
    if roots == Roots::Real && found < 16 {
        let bound = geometry();
        if found < bound.count || simple > 0 {
            verdict.reason = "not proved: only real roots were looked for".to_owned();
            return verdict;
        }
        verdict.reason = accounted(&bound);
    } else if simple > 0 {
        verdict.reason = format!("not proved: {simple} of {found} roots have no certificate");
        return verdict;
    } else {
        let bound = if found == 16 { Bound::general() } else { geometry() };
        if found == bound.count {
            verdict.reason = accounted(&bound);
        } else if found > bound.count {
            verdict.reason = format!("contradiction: {found} roots found, but {}", bound.because);
            return verdict;
        } else {
            match pose() {
                Some(here) if here.count == found => {
                    verdict.at_infinity = bound.count - found;
                    verdict.reason = accounted(&here);
                }
                here => {
                    let bound = here.unwrap_or(bound);
                    verdict.reason =
                        format!("not proved: found {found} of up to {} roots of {}", bound.count, bound.because);
                    return verdict;
                }
            }
        }
    }
    if !assembly.modes.iter().filter(|m| !m.real).all(is_proved_complex) {
        verdict.reason = "not proved: a root is neither proved real nor proved complex".to_owned();
        return verdict;
    }
    verdict.status = if verdict.real == 0 { Status::Unreachable } else { Status::Complete };
    verdict
}

/// Whether a complex mode is farther from the real numbers than its error.
fn is_proved_complex(mode: &Mode) -> bool {
    let imaginary = mode.unknowns.iter().map(|z| z.im.abs()).fold(0.0, f64::max);
    match mode.certificate {
        Some(certificate) => imaginary > certificate.radius,
        None => imaginary > 1e-6,
    }
}
