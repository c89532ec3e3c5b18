//! Judges the claims of a mechanism file: counts against those found, solutions against the closure itself.

mod calculus;
mod joints;
mod linkage;
mod mobility;
mod moving;
mod poses;
mod space;
mod sphere;
mod synthesis;

use crate::assembly::{Assembly, Roots, Workspace};
use crate::catalogue::Any;
use crate::catalogue::entry::{Case, Claim, Design, Entry};
use crate::error::{Error, Result};
use crate::mechanism::{FullMode, Mechanism, Solution};
use crate::verdict::Status;
use joints::Joints;
use poses::Poses;

/// The sorts of claims, in the order of reports.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sort {
    /// The number of isolated complex solutions.
    Complex,
    /// The number of isolated real solutions.
    Real,
    /// The dimension of the solution set.
    Dimension,
    /// The motion of a loop: dimension and screw rank.
    Mobility,
    /// A listed solution closes the loop.
    Closes,
    /// A listed solution is among those found.
    Found,
    /// The equations beside a file are those derived from it.
    Equations,
}

impl Sort {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Complex, Self::Real, Self::Dimension, Self::Mobility, Self::Closes, Self::Found, Self::Equations];

    /// Returns the heading of a sort.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Complex => "complex",
            Self::Real => "real",
            Self::Dimension => "dimension",
            Self::Mobility => "mobility",
            Self::Closes => "closes",
            Self::Found => "found",
            Self::Equations => "equations",
        }
    }
}

/// A claim, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Number of the case in the file, from 1.
    pub case: usize,
    /// The file of the claim, if it is not that of the mechanism.
    pub file: Option<String>,
    /// Line of the claim, or of its case.
    pub line: usize,
    /// The sort of the claim.
    pub sort: Sort,
    /// Whether the claim is true.
    pub holds: bool,
    /// The claimed value and the one found.
    pub message: String,
}

/// All claims of one file, judged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement {
    /// The claims in the order of the file.
    pub findings: Vec<Finding>,
    /// Number of cases.
    pub cases: usize,
    /// Cases whose list of solutions was proved complete.
    pub complete: usize,
    /// Cases with a self-motion, whose list cannot be complete.
    pub self_motions: usize,
}

impl Judgement {
    /// Returns the number of claims of a sort that hold, and the number of all of them.
    #[must_use]
    pub fn score(&self, sort: Sort) -> (usize, usize) {
        let of_sort = self.findings.iter().filter(|finding| finding.sort == sort);
        (of_sort.clone().filter(|finding| finding.holds).count(), of_sort.count())
    }

    /// Returns the claims that do not hold.
    pub fn failures(&self) -> impl Iterator<Item = &Finding> {
        self.findings.iter().filter(|finding| !finding.holds)
    }
}

/// Judges the claims of a file of any kind.
///
/// # Errors
/// As [`judge`]; also for a framework without a realisation, and for loops with symbols, which make no claims.
pub fn judge_any(any: &Any) -> Result<Judgement> {
    match any {
        Any::Entry(entry) => judge(entry),
        Any::Framework(file) => moving::framework(file),
        Any::Linkage(file) => linkage::linkage(file),
        Any::Sphere(file) => sphere::sphere(file),
        Any::Space(file) => space::space(file),
        Any::Motion(file) => moving::motion(file),
        Any::Calculus(file) => calculus::calculus(file),
        Any::Synthesis(file) => Ok(synthesis::judge(file)),
        Any::Conditions(_) => Err(Error::Invalid(any.kind().unexpected("a file that can make claims"))),
    }
}

/// Solves every case of an entry and judges its claims.
///
/// # Errors
/// As [`Mechanism::prepare`].
///
/// # Example
/// ```
/// use looproot::internal::{catalogue, claims};
/// let puma = catalogue::builtin("puma560", &Default::default())?;
/// assert_eq!(claims::judge(&puma)?.failures().count(), 0);
/// # Ok::<(), looproot::internal::error::Error>(())
/// ```
pub fn judge(entry: &Entry) -> Result<Judgement> {
    let mechanism = Mechanism::prepare(entry)?;
    let ruler = match &entry.design {
        Design::Arm(chain) | Design::Loop(chain) => Ruler::Joints(Joints::of(chain)?),
        Design::Platform(platform) => Ruler::Poses(Box::new(Poses::of(platform))),
    };
    let (mut workspace, mut assembly) = (Workspace::default(), Assembly::default());
    let mut judgement = Judgement { cases: entry.cases.len(), ..Judgement::default() };
    for (index, case) in entry.cases.iter().enumerate() {
        let solution = mechanism.solve(case, Roots::All, &mut workspace, &mut assembly)?;
        match solution.verdict.status {
            Status::Complete | Status::Unreachable => judgement.complete += 1,
            Status::SelfMotion => judgement.self_motions += 1,
            Status::Incomplete | Status::Unsupported => {}
        }
        let judge = Judge { ruler: &ruler, case, number: index + 1, solution: &solution };
        judge.counts(&mut judgement.findings);
        judgement.findings.extend(mobility::findings(entry, case, index + 1));
        for claim in &case.expected.solutions {
            judge.solution(claim, &mut judgement.findings)?;
        }
    }
    Ok(judgement)
}

/// The measure for a claimed solution.
enum Ruler<'a> {
    Joints(Joints<'a>),
    Poses(Box<Poses>),
}

impl Ruler<'_> {
    /// Returns the full claimed solution; a file may leave out the given variables.
    fn complete(&self, case: &Case, q: &[f64]) -> Result<Vec<f64>> {
        match self {
            Self::Joints(joints) => joints.complete(case, q),
            Self::Poses(_) => Ok(q.to_vec()),
        }
    }

    /// Returns the closure error of a claimed solution.
    fn closure(&self, case: &Case, q: &[f64]) -> Result<f64> {
        match self {
            Self::Joints(joints) => joints.closure(case, q),
            Self::Poses(poses) => poses.closure(case, q),
        }
    }

    /// Returns the distance of a mode from a claimed solution.
    fn distance(&self, mode: &FullMode, q: &[f64]) -> f64 {
        match self {
            Self::Joints(joints) => joints.distance(mode, q),
            Self::Poses(poses) => poses.distance(mode, q),
        }
    }
}

/// One case with its answer.
struct Judge<'a> {
    ruler: &'a Ruler<'a>,
    case: &'a Case,
    number: usize,
    solution: &'a Solution,
}

impl Judge<'_> {
    fn finding(&self, line: usize, sort: Sort, holds: bool, message: String) -> Finding {
        Finding { case: self.number, file: None, line, sort, holds, message }
    }

    fn counts(&self, findings: &mut Vec<Finding>) {
        let (expected, verdict) = (&self.case.expected, &self.solution.verdict);
        let counts = [
            (Sort::Complex, expected.complex, verdict.complex),
            (Sort::Real, expected.real, verdict.real),
            (Sort::Dimension, expected.dimension, verdict.self_motion),
        ];
        for (sort, claimed, found) in counts {
            if let Some(claimed) = claimed {
                let what = match sort {
                    Sort::Complex => "complex solutions",
                    Sort::Real => "real solutions",
                    _ => "dimensions",
                };
                let message = format!("claims {claimed} {what}, found {found}: {}", verdict.reason);
                findings.push(self.finding(self.case.line, sort, claimed == found, message));
            }
        }
    }

    fn solution(&self, claim: &Claim, findings: &mut Vec<Finding>) -> Result<()> {
        let q = self.ruler.complete(self.case, &claim.q)?;
        // Half a unit of the last printed digit would do; a whole one allows for copies that cut digits off.
        let tolerance = 10_f64.powi(-i32::try_from(claim.digits.min(14)).unwrap_or(14));
        let defect = self.ruler.closure(self.case, &q)?;
        let allowed = tolerance * q.len() as f64;
        let message = format!("the solution claims {} digits, its closure is off by {defect:.1e}", claim.digits);
        findings.push(self.finding(claim.line, Sort::Closes, defect <= allowed, message));
        if self.solution.verdict.self_motion > 0 {
            // A point of a curve of solutions need not be in a list of isolated ones.
            return Ok(());
        }
        // The rounding of the pose may have turned a double root into a complex pair; if it is near enough, it is the one meant.
        let nearest = self.solution.modes.iter().map(|mode| (self.ruler.distance(mode, &q), mode));
        let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
        let (holds, message) = match nearest {
            None => (false, "the solution is claimed, but none was found".to_owned()),
            Some((distance, mode)) => {
                // A multiple root is known to about half of the digits.
                let known = if mode.multiplicity == 1 { 4.0 * f64::EPSILON * mode.condition.min(1e8) } else { 1e-6 };
                (distance <= tolerance.max(known), format!("the nearest solution found is {distance:.1e} away"))
            }
        };
        findings.push(self.finding(claim.line, Sort::Found, holds, message));
        Ok(())
    }
}
