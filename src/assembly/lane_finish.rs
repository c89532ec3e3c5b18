//! Solutions of one loop from places near them, side by side: Newton's method and the proof of each.
//!
//! Every solution is certified as in [`certify`](crate::certify). Norms of frames of real angles are replaced by the root of 3 and the distance,
//! `e^x` by `1 + x + x^2`. Where a step is not certain, nothing is said.

use super::limits;
use super::mode::{Hits, Mode, wrapped};
use crate::certify::{Certificate, MARGIN, OFF_IDENTITY, ROUNDINGS, ROUNDOFF};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;
use crate::solve::lane_closure::{
    ANGLE_ERROR, Angular, LaneClosure, Pairs, ROOT_2, lane_closure, lane_inverse, turned_back,
};
use crate::solve::lanes::{Lanes, Mask, Row, WIDTH};
use num_complex::Complex;
use pulp::Simd;

/// Newton's steps with the inverse of the first place: each gains the digits that the first one gained.
const STEPS: usize = 5;
/// Closure errors below this are rounding, in parts of what errors grow by round the loop.
const ROUNDING: f64 = 4e-15;
/// The squares of cosine and sine of real angles add up to 1 within so much: then each is off by 8 half units in the last place at most,
/// which [`ROUNDINGS`] holds.
const OFF_CIRCLE: f64 = 16.0 * ROUNDOFF;

/// A loop of rotations at one pose.
#[derive(Clone, Copy)]
pub(super) struct Finish<'a> {
    /// The loop, scaled.
    closed: &'a ClosedLoop<f64>,
    /// A bound of the row-sum norm of what the last constant is off beyond roundings.
    gap_rounding: f64,
    /// The length of all links, at least 1: errors of translations are measured by it.
    length: f64,
}

/// The lanes of the solutions of one register.
pub(super) struct Found {
    /// Real and imaginary parts.
    angles: [[Row; 2]; 6],
    radius: Row,
    isolation: Row,
    residual: Row,
    condition: Row,
    is_real: bool,
}

/// What bounds errors of a product round the loop.
struct Bounds<S: Simd> {
    rounding: Lanes<S>,
    data: Lanes<S>,
    twist: Lanes<S>,
    lever: Lanes<S>,
    /// The largest growth of errors.
    growth: Lanes<S>,
}

impl<'a> Finish<'a> {
    pub fn new(closed: &'a ClosedLoop<f64>, gap_rounding: f64) -> Self {
        let length = |motion: &Motion<f64>| motion.translation.iter().map(|x| x * x).sum::<f64>().sqrt();
        let length = closed.constants.iter().map(length).sum::<f64>().max(1.0);
        Self { closed, gap_rounding, length }
    }

    /// Polishes solutions given nearly, by pairs on the circle to rounding, and proves them.
    #[inline(always)]
    pub fn proved<S: Simd, N: Angular<S>>(&self, mut pairs: Pairs<N>, one: Lanes<S>) -> Found {
        let constants = &self.closed.constants;
        let mut here = lane_closure(constants, &pairs, one);
        let inverse = lane_inverse(&here.jacobian, one);
        let limit = if N::REAL { one } else { self.bounds(&here, &pairs, one).growth } * one.like(ROUNDING);
        for step in 0..STEPS {
            for j in 0..6 {
                let mut sum = inverse[j][0] * here.residual[0];
                for i in 1..6 {
                    sum = inverse[j][i].mul_add(here.residual[i], sum);
                }
                pairs[j] = turned_back(pairs[j], sum, one);
            }
            here = lane_closure(constants, &pairs, one);
            let is_closed = here.turn.at_most(limit).and(here.shift.at_most(limit * one.like(self.length)));
            if step + 1 < STEPS && is_closed.all() {
                break;
            }
        }
        let bounds = self.bounds(&here, &pairs, one);
        let nothing = [[0.0; WIDTH]; 2];
        let mut found = Found {
            angles: [nothing; 6],
            radius: [f64::NAN; WIDTH],
            isolation: [f64::NAN; WIDTH],
            residual: [0.0; WIDTH],
            condition: [0.0; WIDTH],
            is_real: N::REAL,
        };
        for (rows, pair) in found.angles.iter_mut().zip(pairs) {
            *rows = N::angle(pair);
        }
        let shift = if N::REAL { here.shift / one.like(self.length) } else { here.shift };
        let residual = here.turn.max(shift);
        let residual = if N::REAL { residual } else { residual / bounds.growth };
        residual.store(&mut found.residual, 0);
        Self::certify(&here, &inverse, &bounds, off_circle(&pairs, one), &mut found);
        found
    }

    /// Bounds the errors of the product of all steps.
    #[inline(always)]
    fn bounds<S: Simd, N: Angular<S>>(&self, at: &LaneClosure<S, N>, pairs: &Pairs<N>, one: Lanes<S>) -> Bounds<S> {
        let zero = one.like(0.0);
        let (mut rounding, mut twist, mut lever, mut growth) = (zero, zero, zero, one);
        let mut of_gap = zero;
        for (j, constant) in self.closed.constants.iter().enumerate() {
            let constant = one.like(row_sum(constant));
            // A real rotation about z has row sums of at most the root of 2.
            let turn = if N::REAL { one.like(ROOT_2) } else { one.max(pairs[j][0].bound() + pairs[j][1].bound()) };
            of_gap = at.lengths[j].norm * at.lengths[j + 1].inverse * (constant * turn);
            growth = growth.max(of_gap);
            let wrong = one.like(ROUNDINGS * ROUNDOFF);
            let wrong = if N::REAL { wrong } else { wrong + N::off_circle(pairs[j]) };
            rounding = of_gap.fma(wrong, rounding);
            twist = twist + at.lengths[j].twist;
            lever = lever + at.lengths[j].lever;
        }
        Bounds { rounding, data: of_gap * one.like(self.gap_rounding), twist, lever, growth }
    }

    /// Bounds the radius in which exactly one solution lies, and that in which there is no other: see [`certify`](crate::certify), whose
    /// names are used here.
    #[inline(always)]
    fn certify<S: Simd, N: Angular<S>>(
        at: &LaneClosure<S, N>,
        inverse: &[[N; 6]; 6],
        bounds: &Bounds<S>,
        off_circle: Lanes<S>,
        found: &mut Found,
    ) {
        let zero = at.turn.like(0.0);
        let one = zero.like(1.0);
        let error = bounds.rounding + bounds.data;
        let off = at.turn.max(at.shift).fma(zero.like(8.0), error);
        let twist_error = bounds.lever * (error + zero.like(2.0 * ROUNDOFF)) * zero.like(3.0);
        let twists = twist_error.fma(zero.like(3.0), bounds.twist) * zero.like(MARGIN);
        let derivative = (twists * off).fma(zero.like(2.0), twist_error) * zero.like(MARGIN);
        let (mut norm, mut step, mut deviation, mut residual, mut jacobian) = (zero, zero, zero, zero, [zero; 6]);
        // A maximum may lose what is no number, a sum does not.
        let mut all = at.turn + at.shift + off_circle + error + twists;
        for (i, row) in inverse.iter().enumerate() {
            let (mut size, mut wrong) = (zero, zero);
            let mut moved = N::of(zero);
            for a in 0..6 {
                size = size + row[a].bound();
                moved = row[a].mul_add(at.residual[a], moved);
                let mut value = N::of(if a == i { one } else { zero });
                for b in 0..6 {
                    value = row[b].mul_from(at.jacobian[a][b], value);
                }
                wrong = wrong + value.bound();
                jacobian[i] = jacobian[i] + at.jacobian[a][i].bound();
            }
            norm = norm.max(size);
            step = step.max(moved.bound());
            deviation = deviation.max(wrong);
            residual = residual.max(at.residual[i].bound());
            all = all + size + moved.bound() + wrong + at.residual[i].bound();
        }
        let mut size = zero;
        for row in jacobian {
            size = size.max(row);
        }
        (size * norm).store(&mut found.condition, 0);
        let norm = norm * zero.like(MARGIN);
        let y = (norm.fma(residual.fma(zero.like(16.0 * ROUNDOFF), error), step)) * zero.like(MARGIN);
        // The sums of the terms of a row of the product are at most the product of the norms.
        let z0 = ((norm * size).fma(zero.like(40.0 * ROUNDOFF), norm.fma(derivative, deviation))) * zero.like(MARGIN);
        let bend = norm * twists * twists * (off + one) * zero.like(MARGIN);
        // exp x is at most 1 + x + x^2 for x up to 1.
        let radius = (y / (one - z0) * zero.like(1.05 * 1.5)).max(zero.like(f64::MIN_POSITIVE));
        let bounds = [y, z0, twists];
        let x = radius * twists;
        let growth = x.fma(x, x + one);
        // The distance of complex pairs from the circle is in the error of every step.
        let most_off = if N::REAL { OFF_CIRCLE } else { OFF_IDENTITY };
        let is_sound = all.below(zero.like(f64::MAX)).and(off_circle.at_most(zero.like(most_off)));
        let is_proved = works(bounds, radius, bend * growth)
            .and(is_sound)
            .and(z0.below(zero.like(0.5)))
            .and(off.below(zero.like(OFF_IDENTITY)))
            .and((x.fma(x, x)).fma(zero.like(MARGIN), off).below(zero.like(0.5)));
        let mut isolation = (one - z0) / (bend * growth) * zero.like(0.9);
        let x = isolation * twists;
        let works_there = works(bounds, isolation, bend * x.fma(x, x + one)).and(radius.below(isolation));
        let half = isolation * zero.like(0.5);
        let x = half * twists;
        let works_half = works(bounds, half, bend * x.fma(x, x + one)).and(radius.below(half));
        isolation = works_there.select(isolation, works_half.select(half, radius));
        let nothing = zero.like(f64::NAN);
        is_proved.select(radius, nothing).store(&mut found.radius, 0);
        is_proved.select(isolation, nothing).store(&mut found.isolation, 0);
    }
}

impl Found {
    /// Returns whether real solutions were looked for.
    pub fn is_real(&self) -> bool {
        self.is_real
    }

    /// Returns the unknowns of a lane, polished.
    pub fn unknowns(&self, lane: usize) -> [Complex<f64>; 6] {
        std::array::from_fn(|j| {
            let [re, im] = &self.angles[j];
            Complex::new(wrapped(re[lane]), im[lane])
        })
    }

    /// Returns the certified solution of a lane; `None` where there is no proof.
    pub fn mode(&self, lane: usize) -> Option<Mode> {
        let unknowns = self.unknowns(lane);
        let imaginary = unknowns.iter().fold(0.0_f64, |a, z| a.max(z.im.abs()));
        let wrong = ANGLE_ERROR * (1.0 + imaginary);
        let (radius, isolation) = (self.radius[lane] + wrong, self.isolation[lane] - wrong);
        // NaN fails. What is known so badly is left to longer numbers.
        if !(radius <= isolation && radius < limits::LONE_RADIUS) {
            return None;
        }
        // What may be real is left to other ways.
        if !(self.is_real || imaginary > limits::REAL_PART + radius) {
            return None;
        }
        Some(Mode {
            unknowns,
            real: self.is_real,
            multiplicity: 1,
            residual: self.residual[lane],
            condition: self.condition[lane],
            certificate: Some(Certificate { radius, isolation, proved: radius }),
            hits: Hits::first(0),
        })
    }
}

/// How far the pairs are from the circle; NaN may be lost, which shows in the closure.
#[inline(always)]
fn off_circle<S: Simd, N: Angular<S>>(pairs: &Pairs<N>, one: Lanes<S>) -> Lanes<S> {
    let mut most = one.like(0.0);
    for pair in pairs {
        most = most.max(N::off_circle(*pair));
    }
    most
}

/// Whether a radius proves a solution: `y + z0 r + z2 r^2 / 2` is at most r and `z0 + z2 r` below 1, where `r twists` is at most 1.
#[inline(always)]
fn works<S: Simd>([y, z0, twists]: [Lanes<S>; 3], r: Lanes<S>, z2: Lanes<S>) -> Mask<S> {
    let one = r.like(1.0);
    let reached = (z2 * r * r).fma(r.like(0.5), z0.fma(r, y));
    reached.at_most(r).and(z2.fma(r, z0).below(one)).and((r * twists).at_most(one))
}

/// The row-sum norm of a constant as a matrix, at least 1.
#[inline(always)]
fn row_sum(motion: &Motion<f64>) -> f64 {
    let mut largest = 1.0_f64;
    for (row, shift) in motion.rotation.iter().zip(&motion.translation) {
        largest = largest.max(row[0].abs() + row[1].abs() + row[2].abs() + shift.abs());
    }
    largest
}
