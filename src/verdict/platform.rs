//! The verdict on the poses of a platform.

use super::{Bound, Judged, Status, Verdict, accounted_for};
use crate::assembly::Roots;
use crate::assembly::platform::{PlatformAssembly, PlatformMode};
use num_complex::Complex;

/// The most isolated poses that six legs can have.
const MOST: usize = 40;
/// A complex pose without certificate counts as proved complex beyond this.
const IMAGINARY: f64 = 1e-6;

/// Judges the poses of a platform. `exact` counts them exactly for these legs; it is asked only when needed.
pub fn platform_verdict(assembly: &PlatformAssembly, roots: Roots, exact: impl FnOnce() -> Option<Bound>) -> Verdict {
    let judged = if assembly.self_motion > 0 {
        let reason = format!(
            "poses form a self-motion of dimension {}; the isolated ones are listed, not proved complete",
            assembly.self_motion
        );
        Judged { status: Status::SelfMotion, ..Judged::unproved(reason) }
    } else if let Some(doubt) = doubt(assembly) {
        Judged::unproved(format!("not proved: {doubt}"))
    } else {
        count(assembly, roots, exact)
    };
    Verdict {
        status: judged.status,
        complex: assembly.total(),
        real: assembly.real(),
        at_infinity: judged.at_infinity,
        self_motion: assembly.self_motion,
        certified: certified(&assembly.modes),
        reason: judged.reason,
    }
}

fn certified(modes: &[PlatformMode]) -> usize {
    modes.iter().filter(|mode| mode.certificate.is_some()).count()
}

/// What speaks against counting these modes at all.
fn doubt(assembly: &PlatformAssembly) -> Option<String> {
    let modes = &assembly.modes;
    if let Some(mode) = modes.iter().find(|mode| mode.multiplicity == 0) {
        let kind = if mode.real { "real" } else { "complex" };
        return Some(format!("a singular {kind} pose of unknown multiplicity"));
    }
    let unproved = modes.iter().filter(|mode| mode.multiplicity == 1 && mode.certificate.is_none()).count();
    if unproved > 0 {
        return Some(format!("{unproved} of {} roots have no certificate", modes.len()));
    }
    if (1..modes.len()).any(|k| modes[..k].iter().any(|other| !are_distinct(other, &modes[k]))) {
        return Some("two roots are not proved to be distinct".to_owned());
    }
    let undecided = modes.iter().any(|mode| !mode.real && !is_proved_complex(mode));
    undecided.then(|| "a root is neither proved real nor proved complex".to_owned())
}

/// Compares the number of modes with what is known of the number of poses.
fn count(assembly: &PlatformAssembly, roots: Roots, exact: impl FnOnce() -> Option<Bound>) -> Judged {
    let found = assembly.total();
    let status = if assembly.real() == 0 { Status::Unreachable } else { Status::Complete };
    let settled = |bound: &Bound| {
        let multiple = assembly.modes.iter().map(|mode| mode.multiplicity).filter(|&m| m > 1).collect::<Vec<_>>();
        let reason = accounted_for(certified(&assembly.modes), &multiple, bound);
        Judged { status, at_infinity: 0, reason }
    };
    if found == MOST {
        return settled(&Bound { count: MOST, because: "at most 40 isolated ones that six legs can have".to_owned() });
    }
    if roots == Roots::Real {
        return Judged::unproved("not proved: only real roots were looked for".to_owned());
    }
    match exact() {
        Some(bound) if bound.count == found => settled(&bound),
        Some(bound) if found > bound.count => {
            Judged::unproved(format!("contradiction: {found} roots found, but {}", bound.because))
        }
        Some(bound) => Judged::unproved(format!("not proved: found {found} of {}", bound.because)),
        None => Judged::unproved(format!("not proved: found {found} of up to 40 roots")),
    }
}

/// Whether the poses proved of two modes cannot be one. A check of the list as a whole: the solver has merged what is one
/// already. Poses are points of a projective space: as near as a factor can bring them, they must be farther apart than
/// their errors.
fn are_distinct(one: &PlatformMode, two: &PlatformMode) -> bool {
    let (v, w) = (study(one), study(two));
    let dot = |a: &[Complex<f64>; 8], b: &[Complex<f64>; 8]| -> Complex<f64> {
        a.iter().zip(b).map(|(x, y)| x.conj() * y).sum()
    };
    let factor = dot(&w, &v) / dot(&w, &w);
    let apart = v.iter().zip(&w).map(|(x, y)| (x - factor * y).norm_sqr()).sum::<f64>().sqrt();
    let radius = |mode: &PlatformMode| mode.certificate.map_or(0.0, |certificate| certificate.radius);
    // The radii bound the largest of eight components.
    apart > 8.0_f64.sqrt() * (radius(one) + factor.norm() * radius(two))
}

/// Study's parameters of a mode, `x` and `p x`.
fn study(mode: &PlatformMode) -> [Complex<f64>; 8] {
    let ([w, x, y, z], [a, b, c]) = (mode.quaternion, mode.position);
    [w, x, y, z, -(a * x + b * y + c * z), a * w + b * z - c * y, b * w + c * x - a * z, c * w + a * y - b * x]
}

/// Whether a complex mode is farther from the real numbers than its error.
fn is_proved_complex(mode: &PlatformMode) -> bool {
    // Against the largest component of the quaternion, which no phase can then hide.
    let largest = mode
        .quaternion
        .iter()
        .copied()
        .fold(Complex::from(0.0), |best: Complex<f64>, z| if z.norm_sqr() > best.norm_sqr() { z } else { best });
    let phase = largest.conj() / largest.norm();
    let imaginary = study(mode).iter().map(|z| (z * phase).im.abs()).fold(0.0, f64::max);
    match mode.certificate {
        Some(certificate) => imaginary > 2.0 * certificate.radius,
        None => imaginary > IMAGINARY,
    }
}
