//! The answer to a synthesis: its dyads, and the verdict on their list.

use super::cells::Place;
use super::curves::Curve;
use super::dyad::Dyad;
use super::equations::Wanted;
use super::sample::sample;
use super::solved::{Found, Point};
use crate::algebra::disc::Disc;
use crate::algebra::sort;
use crate::catalogue::SynthesisFile;
use crate::error::{Error, Result};
use crate::verdict::{Code, Proof, Status, Verdict};

/// Bits in which the numbers of a dyad are computed first, and at most. The last are more than twice what the exact numbers of
/// twenty solutions through positions of two digits take.
const BITS: [u32; 6] = [320, 1280, 5120, 10_240, 20_480, 40_960];
/// Relative accuracy beyond which no more bits are computed: that of an f64.
const WANTED: f64 = 4.0 * f64::EPSILON;

/// A dyad that takes all positions, or a four-bar.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// Whether all its numbers are real.
    pub is_real: bool,
    /// The number of solutions that coincide here.
    pub multiplicity: usize,
    /// Its numbers.
    pub dyad: Dyad,
}

impl Mode {
    /// Whether its numbers are proved to their radius.
    #[must_use]
    pub fn is_certified(&self) -> bool {
        self.dyad.radius.is_finite()
    }
}

/// A set of dyads that is not finite.
#[derive(Clone, Debug, PartialEq)]
pub struct Family {
    /// Its dimension, complex members counted.
    pub dimension: usize,
    /// One real member, where one was met.
    pub sample: Option<Dyad>,
}

/// All dyads of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The verdict on the list.
    pub verdict: Verdict,
    /// The degrees of the exact polynomials on whose roots the dyads depend, one for each multiplicity.
    pub degrees: Vec<usize>,
    /// The dyads, real ones first.
    pub modes: Vec<Mode>,
    /// The family that they form, if they are not finitely many.
    pub families: Vec<Family>,
    /// Curves of moving and fixed points, where there are any.
    pub curves: Vec<Curve>,
    /// Remarks on special positions.
    pub warnings: Vec<String>,
}

/// A function that computes the numbers of a solution.
pub(super) type Maker = fn(&Wanted, &Place<Disc>, bool) -> Option<Dyad>;

/// The answer where the equations were not solved.
pub(super) fn undecided() -> Answer {
    let reason = "the Gröbner basis of the equations takes more work than is allowed; nothing is known of the dyads";
    let verdict = Verdict {
        status: Status::Incomplete,
        proof: Proof::None,
        code: Code::NotDecided,
        complex_complete: false,
        complex: 0,
        real: 0,
        at_infinity: 0,
        self_motion: 0,
        certified: 0,
        reason: reason.to_owned(),
    };
    Answer { verdict, degrees: vec![], modes: vec![], families: vec![], curves: vec![], warnings: vec![] }
}

/// The answer of solved equations.
pub(super) fn found(file: &SynthesisFile, wanted: &Wanted, solutions: Found, maker: Maker) -> Answer {
    let proof = Proof::Proved.of_rounded(!file.exact);
    let mut answer = match solutions {
        Found::Family(dimension) => family(wanted, dimension, proof, maker),
        Found::Points(points) => list(wanted, &points, proof, maker),
    };
    if !file.exact {
        answer.verdict.reason += "; some angles or numbers of the file are not rational and were rounded";
    }
    answer
}

fn family(wanted: &Wanted, dimension: usize, proof: Proof, maker: Maker) -> Answer {
    let general = wanted.freedom();
    let expected = i64::try_from(dimension).is_ok_and(|dimension| dimension == general);
    let compared = match general {
        _ if expected => "as in general for so many positions".to_owned(),
        1.. => format!("in general it has dimension {general}"),
        0 => "in general there are finitely many".to_owned(),
        _ => "in general there are none".to_owned(),
    };
    let beside = if expected { "" } else { "; isolated dyads beside the family are not listed" };
    let reason = format!(
        "a Gröbner basis over the rationals: the dyads form a family of dimension {dimension}, complex ones counted ({compared}){beside}"
    );
    let verdict = Verdict {
        status: Status::SelfMotion,
        proof,
        code: Code::SelfMotion,
        complex_complete: false,
        self_motion: dimension,
        reason,
        ..undecided().verdict
    };
    let families = vec![Family { dimension, sample: sample(wanted, dimension, maker) }];
    Answer { verdict, families, ..undecided() }
}

fn list(wanted: &Wanted, points: &[Point], proof: Proof, maker: Maker) -> Answer {
    let complex: usize = points.iter().map(|point| point.multiplicity).sum();
    let real: usize = points.iter().filter(|point| point.is_real()).map(|point| point.multiplicity).sum();
    let mut degrees: Vec<usize> = points.iter().filter_map(Point::degree).collect();
    degrees.sort_unstable();
    degrees.dedup();
    let mut modes: Vec<Mode> = points.iter().map(|point| mode(wanted, point, maker)).collect();
    sort::by(&mut modes, |one, other| other.is_real.cmp(&one.is_real).then_with(|| by_numbers(&one.dyad, &other.dyad)));
    let certified = modes.iter().filter(|mode| mode.is_certified()).count();
    let at_infinity = wanted.general_count().map_or(0, |general| general.saturating_sub(complex));
    let mut reason = match complex {
        0 => "a Gröbner basis over the rationals: the equations have no solution, not even a complex one".to_owned(),
        _ if degrees.is_empty() => format!(
            "{complex} different certified solutions, and the rank of the equations times monomials (not 0 modulo a prime) leaves room for \
             no more"
        ),
        _ => format!(
            "a Gröbner basis over the rationals: {complex} with multiplicity, {} distinct, rational in the isolated roots of an exact \
             polynomial of degree {}",
            modes.len(),
            degrees.iter().map(ToString::to_string).collect::<Vec<_>>().join(" and "),
        ),
    };
    if at_infinity > 0 {
        reason += &format!("; {at_infinity} of the general ones are at infinity here");
    }
    let verdict = Verdict {
        status: if real > 0 { Status::Complete } else { Status::Unreachable },
        proof,
        code: match complex {
            0 => Code::NoSolution,
            _ if degrees.is_empty() => Code::GeneralBoundMet,
            _ => Code::ExactRootsMatched,
        },
        complex_complete: true,
        complex,
        real,
        at_infinity,
        self_motion: 0,
        certified,
        reason,
    };
    Answer { verdict, degrees, modes, ..undecided() }
}

/// Dyads in the order of their numbers.
pub(super) fn by_numbers(one: &Dyad, other: &Dyad) -> std::cmp::Ordering {
    let numbers = |dyad: &Dyad| dyad.parts.iter().flat_map(|part| part.values.clone()).collect::<Vec<_>>();
    let (one, other) = (numbers(one), numbers(other));
    let order = |(x, y): (&num_complex::Complex<f64>, &num_complex::Complex<f64>)| {
        x.re.total_cmp(&y.re).then(x.im.total_cmp(&y.im))
    };
    one.iter().zip(&other).map(order).find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
}

/// Computes the numbers of a solution with as many bits as they need.
pub(super) fn numbers(wanted: &Wanted, point: &Point, maker: Maker) -> Dyad {
    let mut best: Option<Dyad> = None;
    for bits in BITS {
        let Some(dyad) = point.place(bits).and_then(|place| maker(wanted, &place, point.is_real())) else { continue };
        let size = dyad.parts.iter().flat_map(|part| &part.values).map(|z| z.norm()).fold(1.0, f64::max);
        let is_enough = dyad.radius <= WANTED * size;
        if best.as_ref().is_none_or(|best| dyad.radius < best.radius) {
            best = Some(dyad);
        }
        if is_enough {
            break;
        }
    }
    best.unwrap_or(Dyad { parts: Vec::new(), radius: f64::INFINITY })
}

fn mode(wanted: &Wanted, point: &Point, maker: Maker) -> Mode {
    Mode { is_real: point.is_real(), multiplicity: point.multiplicity, dyad: numbers(wanted, point, maker) }
}

impl Answer {
    /// Sorts the dyads by their distance from numbers: those of the fixed and the moving part, or of the fixed part only; of
    /// four-bars for pairs of angles crank, its angle, rocker, its angle and coupler; of those for a path A and D, or A, D, B and C.
    ///
    /// # Errors
    /// For another number of numbers than these have.
    pub fn sort_near(&mut self, wanted: &[f64]) -> Result<()> {
        let of = |dyad: &Dyad| -> [Vec<f64>; 2] {
            let with = |start: &str| {
                let parts = dyad.parts.iter().filter(|part| part.name.split('.').next() == Some(start));
                parts.flat_map(|part| part.values.iter().map(|z| z.re)).collect::<Vec<f64>>()
            };
            let arms = ["crank", "crank_angle0", "rocker", "rocker_angle0", "coupler"];
            if dyad.get("A").is_some() {
                let of = |names: &[&str]| names.iter().flat_map(|name| dyad.real(name)).collect();
                return [of(&["A", "D"]), of(&["A", "D", "B", "C"])];
            }
            if dyad.get("crank").is_some() {
                return [
                    arms[..2].iter().flat_map(|name| dyad.real(name)).collect(),
                    arms.iter().flat_map(|name| dyad.real(name)).collect(),
                ];
            }
            [with("fixed"), [with("fixed"), with("moving")].concat()]
        };
        let Some(first) = self.modes.iter().find(|mode| mode.is_real) else { return Ok(()) };
        let [fixed, all] = of(&first.dyad).map(|numbers| numbers.len());
        if ![fixed, all].contains(&wanted.len()) {
            let message = format!("found {} numbers in --near, expected {fixed} or {all}", wanted.len());
            return Err(Error::Invalid(message));
        }
        let distance = |mode: &Mode| {
            let [fixed, all] = of(&mode.dyad);
            let numbers = if wanted.len() == fixed.len() { fixed } else { all };
            let square: f64 = numbers.iter().zip(wanted).map(|(x, y)| (x - y) * (x - y)).sum();
            if mode.is_real { square } else { f64::INFINITY }
        };
        sort::by(&mut self.modes, |one, other| distance(one).total_cmp(&distance(other)));
        Ok(())
    }
}
