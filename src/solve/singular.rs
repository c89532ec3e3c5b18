//! Singular solutions: how multiple, or on which self-motion.
//!
//! At a solution whose Jacobian has corank 1 the bordered system `F(q) + g b = 0, c.(q - q0) = h` is regular: it
//! follows the one direction in which the loop can give way, and g(h) is the part of the closure that cannot be met
//! there. g vanishes to the order of the multiplicity; if it vanishes altogether the solution lies on a self-motion.

use super::dense::{inverse, times};
use super::newton::{Six, closure};
use super::scalar::Scalar;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use nalgebra::{Matrix6, Vector6};
use num_complex::Complex;

/// What a singular solution is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Isolated, of this multiplicity.
    Isolated(usize),
    /// A point of a self-motion of this dimension.
    SelfMotion(usize),
    /// Singular in a way not resolved: corank above 1 with no self-motion found.
    Unresolved,
}

/// Singular values below this part of the largest count as zero on a curve.
const RANK: f64 = 1e-6;
/// The closure that a self-motion keeps at a finite distance, in scaled lengths.
const CURVE: f64 = 1e-11;

/// The border: any vectors in general position do.
const BORDER: [f64; 6] = [0.41, -0.37, 0.53, 0.29, -0.47, 0.33];
const COBORDER: [f64; 6] = [0.39, 0.45, -0.31, 0.51, 0.35, -0.43];

/// Follows the bordered system to the displacement `h` from `origin` along the kernel; g there.
fn follow<S: Scalar>(closed: &ClosedLoop<f64>, origin: &Six<S>, direction: &Six<S>, h: f64) -> Option<S> {
    let mut q: Six<S> = std::array::from_fn(|k| origin[k].add(&direction[k].times(h)));
    let along = (0..6).fold(S::zero(), |sum, k| sum.add(&direction[k].times(COBORDER[k]))).times(h);
    let mut g = S::zero();
    for _ in 0..20 {
        let here = closure(closed, &q);
        let inverted = inverse(&bordered(&here.jacobian))?;
        let mut right = [S::zero(); 7];
        for k in 0..6 {
            right[k] = here.residual[k].add(&g.times(BORDER[k]));
            right[6] = right[6].add(&q[k].sub(&origin[k]).times(COBORDER[k]));
        }
        right[6] = right[6].sub(&along);
        let step = times(&inverted, &right);
        let mut largest = 0.0_f64;
        for k in 0..6 {
            q[k] = q[k].sub(&step[k]);
            largest = largest.max(step[k].size());
        }
        g = g.sub(&step[6]);
        if !(largest < 1.0) {
            return None;
        }
        if largest < 1e-14 {
            break;
        }
    }
    Some(g)
}

fn bordered<S: Scalar>(jacobian: &[Six<S>; 6]) -> [[S; 7]; 7] {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i < 6, j < 6) {
            (true, true) => jacobian[i][j],
            (true, false) => S::from_f64(BORDER[i]),
            (false, true) => S::from_f64(COBORDER[j]),
            (false, false) => S::zero(),
        })
    })
}

/// What the singular solution at `unknowns` is, by following its one free direction.
#[must_use]
pub fn nature<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> Nature {
    let Some(direction) = free_direction(closed, unknowns) else { return Nature::Unresolved };
    // Rounding errors of complex solutions grow with their imaginary parts.
    let growth = closure(closed, unknowns).growth(S::REAL);
    // A neighbouring solution spoils the order at a large displacement, rounding at a small one.
    for h in [1e-2, 3e-3, 1e-3, 3e-4] {
        let Some([left, right]) = orders(closed, unknowns, &direction, h) else { continue };
        if h > 5e-3 && left.1 < CURVE * growth && right.1 < CURVE * growth {
            return Nature::SelfMotion(1);
        }
        let near = |order: usize| [left.0, right.0].iter().all(|x| (x - order as f64).abs() < 0.2);
        if let Some(order) = (1..16).find(|&order| near(order)) {
            return Nature::Isolated(order);
        }
    }
    Nature::Unresolved
}

/// On either side: the order with which g grows from a displacement `h` to `2 h`, and the larger |g|.
fn orders<S: Scalar>(closed: &ClosedLoop<f64>, origin: &Six<S>, direction: &Six<S>, h: f64) -> Option<[(f64, f64); 2]> {
    let side = |h: f64| {
        let near = follow(closed, origin, direction, h)?.to_complex().norm();
        let far = follow(closed, origin, direction, 2.0 * h)?.to_complex().norm();
        Some(((far / near).log2(), near.max(far)))
    };
    Some([side(h)?, side(-h)?])
}

/// The two solutions of a nearly double one: where the parabola through g at three displacements along the nearly free
/// direction vanishes, accurate to about 1e-8; and how far the closure is from a double solution, |g| at the vertex of
/// that parabola: input off by so much, in scaled lengths, would make them one. `None` where they are not both near.
#[must_use]
pub fn pair<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> Option<([Six<Complex<f64>>; 2], f64)> {
    /// Displacements at which g is taken: large against the rounding of g, its square small against the pair.
    const STEP: f64 = 1e-5;
    /// How far away the solutions may be.
    const REACH: f64 = 1e-2;
    let direction = free_direction(closed, unknowns)?;
    let [behind, here, ahead] = [-STEP, 0.0, STEP].map(|h| follow(closed, unknowns, &direction, h));
    let (behind, here, ahead) = (behind?.to_complex(), here?.to_complex(), ahead?.to_complex());
    let curvature = (ahead + behind - 2.0 * here) / (2.0 * STEP * STEP);
    let slope = (ahead - behind) / (2.0 * STEP);
    if !(curvature.norm() > 0.0) {
        return None;
    }
    let discriminant = slope * slope - 4.0 * curvature * here;
    let vertex = (discriminant / (4.0 * curvature)).norm();
    let root = discriminant.sqrt();
    let shifts = [(root - slope) / (2.0 * curvature), (-root - slope) / (2.0 * curvature)];
    let at =
        |shift: Complex<f64>| std::array::from_fn(|k| unknowns[k].to_complex() + direction[k].to_complex() * shift);
    shifts.iter().all(|shift| shift.norm() < REACH).then(|| (shifts.map(at), vertex))
}

/// The direction in which the loop gives way at a singular solution of corank 1, its largest entry 1; `None` for a
/// higher corank.
fn free_direction<S: Scalar>(closed: &ClosedLoop<f64>, unknowns: &Six<S>) -> Option<Six<S>> {
    // The kernel vector is the answer of the bordered matrix to (0, 1); a large answer means corank above 1.
    let inverted = inverse(&bordered(&closure(closed, unknowns).jacobian))?;
    let direction: Six<S> = std::array::from_fn(|k| inverted[k][6]);
    let length = direction.iter().map(|x| x.size()).fold(0.0, f64::max);
    let largest = inverted.iter().flatten().map(|x| x.size()).fold(0.0, f64::max);
    (length > 0.0 && largest < 1e7).then(|| direction.map(|x| x.times(1.0 / length)))
}

/// Real unknowns spread over the whole range, the same ones every time: starts for a search that nothing else leads.
#[must_use]
pub fn spread(variables: &[Variable; 6], trial: usize) -> Six<f64> {
    std::array::from_fn(|k| {
        // Multiples of square roots of primes, modulo 1: an even spread in six dimensions.
        let root = [2.0_f64, 3.0, 5.0, 7.0, 11.0, 13.0][k].sqrt();
        let fraction = (trial as f64 * root).fract();
        match variables[k] {
            Variable::Rotation => (2.0 * fraction - 1.0) * std::f64::consts::PI,
            Variable::Translation => 4.0 * fraction - 2.0,
        }
    })
}

/// Rank of the Jacobian at real unknowns, and its right singular vectors from the largest to the smallest value.
fn rank(closed: &ClosedLoop<f64>, unknowns: &Six<f64>) -> (usize, [Six<f64>; 6]) {
    let here = closure(closed, unknowns);
    let matrix = Matrix6::from_fn(|i, j| here.jacobian[i][j]);
    let svd = matrix.svd(false, true);
    let mut order: [usize; 6] = std::array::from_fn(|k| k);
    let values = svd.singular_values;
    order.sort_by(|&a, &b| values[b].total_cmp(&values[a]));
    let largest = values[order[0]];
    let count = order.iter().filter(|&&k| values[k] > RANK * largest).count();
    let vectors = svd.v_t.map_or([[0.0; 6]; 6], |v| order.map(|k| std::array::from_fn(|j| v[(k, j)])));
    (count, vectors)
}

/// Slides back onto the solution set by Gauss-Newton steps with the pseudo-inverse; the closure defect reached.
fn project(closed: &ClosedLoop<f64>, unknowns: &mut Six<f64>, full_rank: usize) -> f64 {
    let mut defect = f64::INFINITY;
    for _ in 0..30 {
        let here = closure(closed, unknowns);
        if !(here.defect < 0.9 * defect) {
            defect = defect.min(here.defect);
            break;
        }
        defect = here.defect;
        let svd = Matrix6::from_fn(|i, j| here.jacobian[i][j]).svd(true, true);
        let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
        values.sort_by(|a, b| b.total_cmp(a));
        // Keep as many directions as the solution set leaves transversal ones.
        let cut = values[full_rank - 1].max(1e-9 * values[0]) * 0.999;
        let Ok(step) = svd.solve(&Vector6::from(here.residual), cut) else { break };
        for k in 0..6 {
            unknowns[k] -= step[k];
        }
    }
    defect
}

/// A self-motion as measured at its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SelfMotion {
    /// Its dimension.
    pub dimension: usize,
    /// Which unknowns move along it.
    pub moving: [bool; 6],
}

/// Whether a real solution lies on a self-motion, for any corank: steps in directions of the kernel and slides back.
/// The dimension is the least one at the points found, and all unknowns move that move at one of them.
#[must_use]
pub fn self_motion(closed: &ClosedLoop<f64>, unknowns: &Six<f64>) -> Option<SelfMotion> {
    let (count, vectors) = rank(closed, unknowns);
    if count == 6 || count == 0 {
        return None;
    }
    let corank = 6 - count;
    let mut best: Option<SelfMotion> = None;
    // Kernel directions, then mixtures of them: curves leave a point of higher corank only along special ones.
    let mixtures = 2 * corank + if corank > 1 { 24 } else { 0 };
    for trial in 0..mixtures {
        let weight = |k: usize| -> f64 {
            if trial < 2 * corank {
                if trial / 2 == k { if trial % 2 == 0 { 1.0 } else { -1.0 } } else { 0.0 }
            } else {
                // A fixed sequence of directions, spread by the golden angle.
                ((trial * 7 + k * 13) as f64 * 2.399_963).sin()
            }
        };
        let norm = (0..corank).map(|k| weight(k).powi(2)).sum::<f64>().sqrt().max(1e-9);
        let mut q = *unknowns;
        for k in 0..corank {
            for (x, v) in q.iter_mut().zip(&vectors[count + k]) {
                *x += 0.02 * weight(k) / norm * v;
            }
        }
        for keep in (count..6).filter(|&r| r <= 5) {
            let mut slid = q;
            let defect = project(closed, &mut slid, keep);
            let distance = (0..6).map(|k| (slid[k] - unknowns[k]).abs()).fold(0.0, f64::max);
            if defect < CURVE && distance > 1e-3 && distance < 0.5 {
                if let Some(dimension) = dimension_at(closed, &slid) {
                    let moving = std::array::from_fn(|k| (slid[k] - unknowns[k]).abs() > MOVED);
                    best = Some(best.map_or(SelfMotion { dimension, moving }, |b: SelfMotion| SelfMotion {
                        dimension: b.dimension.min(dimension),
                        moving: std::array::from_fn(|k| b.moving[k] || moving[k]),
                    }));
                }
                break;
            }
        }
    }
    best
}

/// Unknowns that change by less along a step of 0.02 stand still: rounding at a multiple curve reaches 1e-7.
const MOVED: f64 = 1e-6;
/// How far a step goes that explores a self-motion.
const STEP: f64 = 0.01;
/// Directions in which points of a self-motion lie beside one of its points: those with at least this part of the largest
/// spread. A curve bends by a part of about one step of 0.01 out of its tangent.
const SPREAD: f64 = 0.15;

/// The dimension of the solutions at one of them on a self-motion, by where points beside it lie: the corank may be larger,
/// also all along a curve. `None` for a regular point.
fn dimension_at(closed: &ClosedLoop<f64>, unknowns: &Six<f64>) -> Option<usize> {
    let (count, vectors) = rank(closed, unknowns);
    let corank = 6 - count;
    if corank <= 1 || count == 0 {
        return (corank > 0).then_some(corank);
    }
    // A fixed sequence of directions in the kernel, several for each dimension.
    let directions = (1..=6 * corank).map(|trial| {
        let weights: Vec<f64> = (0..corank).map(|k| ((trial * 5 + k * 11) as f64 * 2.399_963).sin()).collect();
        let norm = weights.iter().map(|w| w * w).sum::<f64>().sqrt().max(1e-9);
        let entry = |j: usize| (0..corank).map(|k| weights[k] / norm * vectors[count + k][j]).sum::<f64>();
        std::array::from_fn::<f64, 6, _>(entry)
    });
    let mut moment = Matrix6::zeros();
    for direction in directions {
        let start: Six<f64> = std::array::from_fn(|j| unknowns[j] + STEP * direction[j]);
        for keep in count..6 {
            let mut slid = start;
            let defect = project(closed, &mut slid, keep);
            let moved = Vector6::from_fn(|j, _| (slid[j] - unknowns[j]) / STEP);
            if defect < CURVE && moved.norm() < 10.0 {
                moment += moved * moved.transpose();
                break;
            }
        }
    }
    let spreads: Vec<f64> = moment.symmetric_eigenvalues().iter().map(|x| x.max(0.0).sqrt()).collect();
    let largest = spreads.iter().copied().fold(0.0, f64::max);
    let dimension = spreads.iter().filter(|spread| **spread > SPREAD * largest).count();
    Some(dimension.clamp(1, corank))
}

/// The largest rank of the twists of the loop's joints over a few fixed generic positions of the unknowns, the loop
/// not being closed: below 6 the mechanism is structurally deficient.
#[must_use]
pub fn structural_rank(closed: &ClosedLoop<f64>) -> usize {
    (1..=3)
        .map(|trial| {
            let q = spread(&closed.variables, trial);
            let here = closure(closed, &q);
            let matrix = Matrix6::from_fn(|i, j| here.jacobian[i][j]);
            let values = matrix.singular_values();
            let largest = values.max();
            values.iter().filter(|&&v| v > 1e-12 * largest).count()
        })
        .max()
        .unwrap_or(0)
}
