//! Singular solutions: how multiple, or on which self-motion.
//!
//! At a solution whose Jacobian has corank 1 the bordered system `F(q) + g b = 0, c.(q - q0) = h` is regular: it
//! follows the one direction in which the loop can give way, and g(h) is the part of the closure that cannot be met
//! there. g vanishes to the order of the multiplicity; if it vanishes altogether the solution lies on a self-motion.

use super::dense::{inverse, times};
use super::newton::{Six, closure};
use super::scalar::Scalar;
use crate::kinematics::closed_loop::{ClosedLoop, Variable};
use looproot_calculus::finite::finite;
use nalgebra::Matrix6;
use num_complex::Complex;

/// The nature of a singular solution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Nature {
    /// Isolated, of this multiplicity.
    Isolated(usize),
    /// A point of a self-motion of this dimension.
    SelfMotion(usize),
    /// Singular in a way not resolved: corank above 1 with no self-motion found.
    Unresolved,
}

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

/// Returns the nature of the singular solution at `unknowns`, found by following its one free direction.
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
    /// Largest distance of the solutions.
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

/// The largest rank of the twists of the loop's joints over a few fixed generic positions of the unknowns, the loop
/// not being closed: below 6 the mechanism is structurally deficient.
#[must_use]
pub fn structural_rank(closed: &ClosedLoop<f64>) -> usize {
    (1..=3)
        .map(|trial| {
            let q = spread(&closed.variables, trial);
            let here = closure(closed, &q);
            let matrix = Matrix6::from_fn(|i, j| here.jacobian[i][j]);
            let values = finite(matrix).singular_values();
            let largest = values.max();
            values.iter().filter(|&&v| v > 1e-12 * largest).count()
        })
        .max()
        .unwrap_or(0)
}
