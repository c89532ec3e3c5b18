//! Claims about the assemblies of linkages.

use super::{Finding, Judgement, Sort};
use crate::catalogue::{LinkageClaim, LinkageFile};
use crate::derivation::{Watch, trace};
use crate::error::Result;
use crate::linkage::answer::{LinkageAnswer, LinkageMode, solve};
use crate::verdict::Status;
use std::f64::consts::TAU;

/// Judges the claims of a linkage file.
///
/// # Errors
/// As [`solve`].
pub(super) fn linkage(file: &LinkageFile) -> Result<Judgement> {
    let mut judgement = Judgement { cases: file.cases.len(), ..Judgement::default() };
    for (number, case) in (1..).zip(&file.cases) {
        let answer = solve(&file.linkage, &case.given, file.accuracy(case))?;
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
    for claim in &file.traces {
        let given = file.cases.first().map_or(&[][..], |case| &case.given);
        let degree = trace(&file.linkage, given, claim.body, &claim.point.1, &Watch::none())?.degree();
        let message = format!("claims a curve of degree {} of {}, found {degree}", claim.degree, claim.point.0);
        let holds = degree == claim.degree;
        judgement.findings.push(Finding { case: 1, file: None, line: claim.line, sort: Sort::Complex, holds, message });
    }
    Ok(judgement)
}

/// Returns the distance of the nearest real assembly: the largest difference of a claimed number relative to its size.
fn nearest(answer: &LinkageAnswer, claim: &LinkageClaim) -> Option<f64> {
    let real = answer.modes.iter().filter(|mode| mode.real);
    real.map(|mode| distance(mode, claim)).min_by(f64::total_cmp)
}

fn distance(mode: &LinkageMode, claim: &LinkageClaim) -> f64 {
    let turned = |a: f64, b: f64| ((a - b) - TAU * ((a - b) / TAU).round()).abs();
    let moved = |a: f64, b: f64| (a - b).abs() / b.abs().max(1.0);
    let mut worst = 0.0_f64;
    for (joint, value) in &claim.joints {
        let own = mode.joints[*joint].map_or(f64::INFINITY, |z| z.re);
        // An angle that differs by full turns is the same; a distance differs by less, or is not the one meant.
        worst = worst.max(turned(own, *value).min(moved(own, *value)));
    }
    for (body, angle, position) in &claim.bodies {
        let (own, origin) = &mode.bodies[*body];
        if let Some(angle) = angle {
            worst = worst.max(turned(own.re, *angle));
        }
        if let Some(position) = position {
            worst = origin.iter().zip(position).fold(worst, |worst, (z, x)| worst.max(moved(z.re, *x)));
        }
    }
    worst
}
