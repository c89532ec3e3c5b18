//! A motion of a framework followed in f64, and the error of the lengths along it.

use super::Framework;
use looproot_calculus::finite::finite;
use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest one belong to motions.
const MOTION: f64 = 1e-7;
/// Lengths that Newton's method brings to within this, relative, are kept.
const KEPT: f64 = 1e-13;
/// A step moves no vertex further than this share of the extent.
const STEP: f64 = 0.02;

/// A motion, step by step.
#[derive(Clone, Debug)]
pub struct Flex {
    /// The realisations, the given one first.
    pub positions: Vec<Framework<f64>>,
    /// The largest relative error of a length over all of them.
    pub residual: f64,
    /// The infinitesimal freedom at each of them: the least and the greatest.
    pub freedom: (usize, usize),
    /// The largest change of a distance between two vertices, relative to the extent.
    pub change: f64,
}

/// Returns the realisation nearest to this one with the given squared lengths; `None` where Newton's method finds none.
///
/// # Shape
/// One square for every bar of the framework.
#[must_use]
pub fn settled(framework: &Framework<f64>, squares: &[f64]) -> Option<Framework<f64>> {
    let mut here = framework.clone();
    let mut best = f64::INFINITY;
    for _ in 0..40 {
        let error = residual(&here, squares);
        // A last step past the goal costs little and halves the number of missing digits.
        if error <= KEPT * 1e-2 || (error <= KEPT && error >= 0.5 * best) {
            return Some(here);
        }
        best = best.min(error);
        here = corrected(&here, squares)?;
    }
    (residual(&here, squares) <= KEPT).then_some(here)
}

/// Follows a motion for a number of steps from a realisation with these squared lengths; `None` where there is no first-order
/// motion to begin with. It ends early where Newton's method finds no further realisation.
#[must_use]
pub fn flex(start: &Framework<f64>, squares: &[f64], steps: usize) -> Option<Flex> {
    let ahead = follow(start, squares, steps, 1.0)?;
    if ahead.positions.len() > steps {
        return Some(ahead);
    }
    // An end of the motion is near on this side.
    let back = follow(start, squares, steps, -1.0)?;
    Some(if back.positions.len() > ahead.positions.len() { back } else { ahead })
}

/// Follows a motion to one side.
fn follow(start: &Framework<f64>, squares: &[f64], steps: usize, side: f64) -> Option<Flex> {
    let extent = extent(start);
    let (mut tangents, mut freedom) = tangent_space(start);
    let mut tangent = tangents.first()? * side;
    let mut flex = Flex {
        positions: vec![start.clone()],
        residual: residual(start, squares),
        freedom: (freedom, freedom),
        change: 0.0,
    };
    let mut here = start.clone();
    for _ in 0..steps {
        let mut step = STEP * extent / tangent.amax();
        let next = loop {
            let state: Vec<f64> = here.state().iter().zip(tangent.iter()).map(|(x, v)| x + step * v).collect();
            // A jump that is too long leads to another branch.
            let near = |found: &Framework<f64>| {
                let moved = found.state().iter().zip(&state).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
                moved <= 0.5 * step * tangent.amax()
            };
            match settled(&here.at(&state), squares).filter(near) {
                Some(next) => break Some(next),
                None if step * tangent.amax() < 1e-4 * STEP * extent => break None,
                None => step *= 0.5,
            }
        };
        let Some(next) = next else { break };
        here = next;
        (tangents, freedom) = tangent_space(&here);
        if tangents.is_empty() {
            break;
        }
        // The direction of the last step, as far as it is a motion.
        let mut ahead = DVector::zeros(tangent.len());
        for t in &tangents {
            ahead += t * t.dot(&tangent);
        }
        if !(ahead.norm() > 0.1 * tangent.norm()) {
            break;
        }
        tangent = ahead.normalize();
        flex.residual = flex.residual.max(residual(&here, squares));
        flex.freedom = (flex.freedom.0.min(freedom), flex.freedom.1.max(freedom));
        flex.change = flex.change.max(change(start, &here) / extent);
        flex.positions.push(here.clone());
    }
    Some(flex)
}

/// The diameter of the box around the vertices.
fn extent(framework: &Framework<f64>) -> f64 {
    let span = |k: usize| {
        let values = || framework.vertices.iter().map(|v| v[k]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(|k| span(k).powi(2)).sum::<f64>().sqrt()
}

/// The largest relative error of a length.
fn residual(framework: &Framework<f64>, squares: &[f64]) -> f64 {
    framework
        .squares()
        .iter()
        .zip(squares)
        .map(|(found, wanted)| ((found / wanted).sqrt() - 1.0).abs())
        .fold(0.0, f64::max)
}

/// The largest change of a distance.
fn change(from: &Framework<f64>, to: &Framework<f64>) -> f64 {
    let count = from.vertices.len();
    let pairs = (0..count).flat_map(|a| (0..a).map(move |b| [a, b]));
    pairs.map(|pair| (from.square(pair).sqrt() - to.square(pair).sqrt()).abs()).fold(0.0, f64::max)
}

/// The rigidity matrix by unit lengths, over rows that forbid the rigid motions; at least as many rows as columns.
fn matrix(framework: &Framework<f64>) -> DMatrix<f64> {
    let columns = framework.coordinates();
    let (bars, lengths) = (framework.rigidity_matrix(), framework.squares());
    let rigid = framework.rigid_motions();
    let rows = (bars.len() + rigid.len()).max(columns);
    let mut matrix = DMatrix::zeros(rows, columns);
    for (i, (row, square)) in bars.iter().zip(&lengths).enumerate() {
        for (j, x) in row.iter().enumerate() {
            matrix[(i, j)] = x / square.sqrt();
        }
    }
    for (i, row) in rigid.iter().enumerate() {
        let norm = row.iter().map(|x| x * x).sum::<f64>().sqrt();
        for (j, x) in row.iter().enumerate() {
            matrix[(bars.len() + i, j)] = if norm > 0.0 { x / norm } else { 0.0 };
        }
    }
    matrix
}

/// Whether a decomposition of the matrix will come to an end.
fn is_finite(matrix: &DMatrix<f64>) -> bool {
    matrix.iter().all(|x| x.is_finite())
}

/// Returns orthonormal first-order motions, without those of the whole, and their number.
fn tangent_space(framework: &Framework<f64>) -> (Vec<DVector<f64>>, usize) {
    let matrix = matrix(framework);
    if !is_finite(&matrix) {
        return (Vec::new(), 0);
    }
    let svd = finite(matrix).svd(false, true);
    let largest = svd.singular_values.amax();
    let Some(v) = svd.v_t else { return (Vec::new(), 0) };
    let motions: Vec<DVector<f64>> = svd
        .singular_values
        .iter()
        .enumerate()
        .filter(|(_, value)| **value <= MOTION * largest)
        .map(|(k, _)| v.row(k).transpose())
        .collect();
    let count = motions.len();
    (motions, count)
}

/// One step of Newton's method, of least length.
fn corrected(framework: &Framework<f64>, squares: &[f64]) -> Option<Framework<f64>> {
    let matrix = matrix(framework);
    let mut right = DVector::zeros(matrix.nrows());
    for (k, (found, wanted)) in framework.squares().iter().zip(squares).enumerate() {
        right[k] = (wanted - found) / (2.0 * found.sqrt());
    }
    if !is_finite(&matrix) || !right.iter().all(|x| x.is_finite()) {
        return None;
    }
    let svd = finite(matrix).svd(true, true);
    let least = MOTION * svd.singular_values.amax();
    let step = svd.solve(&right, least).ok()?;
    let state: Vec<f64> = framework.state().iter().zip(step.iter()).map(|(x, d)| x + d).collect();
    state.iter().all(|x| x.is_finite()).then(|| framework.at(&state))
}
