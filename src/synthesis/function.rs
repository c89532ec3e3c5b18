//! Function generation: the four-bars whose crank and rocker take pairs of angles together.
//!
//! Seen from the crank the rocker is a body that takes positions, and the coupler is a dyad of it: with the frame from (0, 0)
//! to (1, 0) a point b of the rocker stands at `exp(-i crank) (1 + exp(i rocker) b)` in the coordinates of the crank. One dyad
//! is the frame itself, from the origin of the crank to that of the rocker. \[McCarthySoh2011\]

use super::answer::{Answer, found, undecided};
use super::dyad::four_bar;
use super::equations::Wanted;
use super::solved::{Found, solve};
use super::{EFFORT, remarks};
use crate::algebra::dual::Dual;
use crate::algebra::ring::Ring;
use crate::catalogue::{AnglePair, DyadKind, Space, SynthesisFile};
use crate::kinematics::motion::Motion;
use rug::Rational;

/// The four-bars of these pairs of angles, each as cosine and sine.
pub(super) fn synthesize(file: &SynthesisFile, pairs: &[AnglePair]) -> Answer {
    let wanted = Wanted {
        kind: DyadKind::RR,
        space: Space::Plane,
        trivial: 1,
        positions: pairs
            .iter()
            .map(|AnglePair { angles: [input, output], .. }| seen_from_crank(input, output))
            .collect(),
        rates: pairs.iter().filter_map(leaving).collect(),
    };
    let equations = |place: &super::cells::Place<_>| wanted.equations(place);
    let Some(solutions) = solve(&wanted.shape(), &equations, EFFORT) else { return undecided() };
    let solutions = match solutions {
        Found::Points(points) => Found::Points(points.into_iter().filter(|point| !point.is_origin()).collect()),
        family @ Found::Family(_) => family,
    };
    let mut answer = found(file, &wanted, solutions, four_bar);
    answer.verdict.reason += "; the frame, which is a solution of the equations, is not counted";
    answer.warnings.extend(remarks::remarks(&wanted));
    answer
}

/// The position of the rocker in the coordinates of the crank.
fn seen_from_crank<R: Ring>((cos, sin): &(R, R), output: &(R, R)) -> Motion<R> {
    let back = Motion::rotation_z(cos.clone(), sin.neg());
    let turn = Motion::rotation_z(output.0.clone(), output.1.clone());
    let mut motion = back.then_after(&turn);
    motion.translation = [cos.clone(), sin.neg(), R::zero()];
    motion
}

/// Returns the motion at unit rate of the crank, where the ratio of the rates is given.
fn leaving(pair: &AnglePair) -> Option<Motion<Dual<Rational>>> {
    let ratio = pair.ratio.as_ref()?;
    let [input, output] = &pair.angles;
    let turning = |(cos, sin): &(Rational, Rational), rate: &Rational| Dual::angle(cos.clone(), sin.clone(), rate);
    Some(seen_from_crank(&turning(input, &Rational::from(1)), &turning(output, ratio)))
}
