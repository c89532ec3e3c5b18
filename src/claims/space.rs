//! Claims about the assemblies of linkages in space.

use super::{Finding, Judgement, Sort};
use crate::catalogue::{SpaceClaim, SpaceFile};
use crate::error::Result;
use crate::linkage::space::{SpaceAnswer, SpaceMode, solve};
use crate::verdict::{Proof, Status};
use std::f64::consts::TAU;

/// Judges the claims of a file of a linkage in space.
///
/// # Errors
/// As [`solve`].
pub(super) fn space(file: &SpaceFile) -> Result<Judgement> {
    let mut judgement = Judgement { cases: file.cases.len(), ..Judgement::default() };
    for (number, case) in (1..).zip(&file.cases) {
        let answer = solve(&file.linkage, &case.given, file.exact && case.exact)?;
        let is_probable = matches!(answer.verdict.proof, Proof::Probable { .. });
        match answer.verdict.status {
            Status::Complete | Status::Unreachable if is_probable => {}
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
        if let Some(claimed) = &expected.groups {
            let found: Vec<usize> = answer.groups.iter().map(|group| group.count).collect();
            add(case.line, Sort::Complex, *claimed == found, format!("claims groups of {claimed:?}, found {found:?}"));
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
    Ok(judgement)
}

/// Returns the distance of the nearest real assembly: the largest difference of a claimed number relative to its size.
fn nearest(answer: &SpaceAnswer, claim: &SpaceClaim) -> Option<f64> {
    let real = answer.modes.iter().filter(|mode| mode.real);
    real.map(|mode| distance(mode, claim)).min_by(f64::total_cmp)
}

fn distance(mode: &SpaceMode, claim: &SpaceClaim) -> f64 {
    let turned = |a: f64, b: f64| ((a - b) - TAU * ((a - b) / TAU).round()).abs();
    let moved = |a: f64, b: f64| (a - b).abs() / b.abs().max(1.0);
    let mut worst = 0.0_f64;
    for (joint, value) in &claim.joints {
        let own = mode.joints[*joint].map_or(f64::INFINITY, |z| z.re);
        // An angle that differs by full turns is the same; a distance differs by less, or is not the one meant.
        worst = worst.max(turned(own, *value).min(moved(own, *value)));
    }
    for (body, quaternion, position) in &claim.bodies {
        if let Some(claimed) = quaternion {
            let Some(found) = mode.quaternion(*body) else { return f64::INFINITY };
            // A quaternion and its negative are one rotation.
            let off = |sign: f64| found.iter().zip(claimed).map(|(z, q)| (z.re - sign * q).abs()).fold(0.0, f64::max);
            worst = worst.max(off(1.0).min(off(-1.0)));
        }
        if let Some(position) = position {
            let own = mode.position(*body);
            worst = own.iter().zip(position).fold(worst, |worst, (z, x)| worst.max(moved(z.re, *x)));
        }
    }
    worst
}
