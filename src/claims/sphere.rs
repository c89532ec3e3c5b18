//! Claims about the assemblies of linkages on the sphere.

use super::{Finding, Judgement, Sort};
use crate::catalogue::{SphereCase, SphereClaim, SphereFile};
use crate::derivation::{Watch, trace_on_sphere};
use crate::error::Result;
use crate::linkage::sphere::{SphereAnswer, SphereMode, solve};
use crate::verdict::Status;
use std::f64::consts::TAU;

/// Judges the claims of a file of a linkage on the sphere.
///
/// # Errors
/// As [`solve`].
pub(super) fn sphere(file: &SphereFile) -> Result<Judgement> {
    let mut judgement = Judgement { cases: file.cases.len(), ..Judgement::default() };
    // A file of curves alone has no input.
    let is_posed = |case: &&SphereCase| !case.given.is_empty() || file.traces.is_empty();
    for (number, case) in (1..).zip(file.cases.iter().filter(is_posed)) {
        let answer = solve(&file.linkage, &case.given, file.exact && case.exact)?;
        match answer.verdict.status {
            Status::Complete | Status::Unreachable => judgement.complete += 1,
            Status::SelfMotion => judgement.self_motions += 1,
            Status::Incomplete | Status::Unsupported => {}
        }
        let (expected, verdict) = (&case.expected, &answer.verdict);
        let mut add = |line: usize, sort: Sort, holds: bool, message: String| {
            judgement.findings.push(Finding { case: number, file: None, line, sort, holds, message });
        };
        let counts = [
            (Sort::Complex, expected.complex, verdict.complex, "complex assemblies"),
            (Sort::Real, expected.real, verdict.real, "real assemblies"),
            (Sort::Dimension, expected.dimension, verdict.self_motion, "dimensions"),
        ];
        for (sort, claimed, found, what) in counts {
            if let Some(claimed) = claimed {
                let message = format!("claims {claimed} {what}, found {found}: {}", verdict.reason);
                add(case.line, sort, claimed == found, message);
            }
        }
        for claim in &expected.solutions {
            let tolerance = 10_f64.powi(-i32::try_from(claim.digits.min(14)).unwrap_or(14));
            let nearest = nearest(&answer, claim);
            let message = match nearest {
                None => "the assembly is claimed, but no real one was found".to_owned(),
                Some(distance) => format!("the nearest assembly found is {distance:.1e} away"),
            };
            add(claim.line, Sort::Found, nearest.is_some_and(|distance| distance <= tolerance), message);
        }
    }
    for claim in &file.traces {
        let Some(point) = file.linkage.bodies[claim.body].point(&claim.point) else { continue };
        let given = file.cases.first().map_or(&[][..], |case| &case.given);
        let degree = trace_on_sphere(&file.linkage, given, claim.body, point, &Watch::none())?.degree();
        let message = format!("claims a curve of degree {} of {}, found {degree}", claim.degree, claim.point);
        let holds = degree == claim.degree;
        judgement.findings.push(Finding { case: 1, file: None, line: claim.line, sort: Sort::Complex, holds, message });
    }
    Ok(judgement)
}

/// Returns the distance of the nearest real assembly: the largest difference of a claimed number.
fn nearest(answer: &SphereAnswer, claim: &SphereClaim) -> Option<f64> {
    let real = answer.modes.iter().filter(|mode| mode.real);
    real.map(|mode| distance(mode, claim)).min_by(f64::total_cmp)
}

fn distance(mode: &SphereMode, claim: &SphereClaim) -> f64 {
    let mut worst = 0.0_f64;
    for (joint, value) in &claim.joints {
        let apart = mode.joints[*joint].re - value;
        worst = worst.max((apart - TAU * (apart / TAU).round()).abs());
    }
    for (body, claimed) in &claim.bodies {
        let Some(found) = mode.quaternion(*body) else { return f64::INFINITY };
        // A quaternion and its negative are one rotation.
        let off = |sign: f64| found.iter().zip(claimed).map(|(z, q)| (z.re - sign * q).abs()).fold(0.0, f64::max);
        worst = worst.max(off(1.0).min(off(-1.0)));
    }
    worst
}
