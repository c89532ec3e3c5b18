//! Frameworks of octahedra about one edge, such as Steffen's polyhedron.
//!
//! Let the distance of two vertices p and q be held. A vertex joined to both turns about the line pq by an angle. A bar between two
//! such vertices x and y holds the difference of their angles; an octahedron with the edge pq and the diagonal xy that moves leaves it
//! free: it has a realisation for every length of the diagonal near the given one. If nothing else is in the framework, and the
//! bars between such vertices form no cycle, then the components of the graph of these bars turn freely, near the given
//! realisation, against each other.

use super::Framework;
use super::octahedron::{Diagonal, Octahedron};
use crate::algebra::number::Number;
use crate::kinematics::motion::{Vector, cross, dot};
use rug::{Float, Rational};

/// Largest volume of four points in a plane, as a share of the product of three edges.
const FLAT: f64 = 1e-6;
/// Digits of a held distance that is no bar, where lengths but no vertices are given; it is chosen among those nearby.
const DIGITS: u32 = 9;

/// `exact`: the vertices themselves, where they are known.
///
/// The held pair of vertices, and the octahedra and bars about it, each by its vertices; `None` if the framework is not made
/// that way, or an octahedron does not move.
pub fn parts(
    framework: &Framework<f64>,
    squares: &[Rational],
    exact: Option<&Framework<Rational>>,
) -> Option<Vec<Vec<usize>>> {
    let count = framework.vertices.len();
    if framework.bodies > 0 {
        return None;
    }
    (0..count).flat_map(|q| (0..q).map(move |p| [p, q])).find_map(|edge| about(framework, squares, exact, edge))
}

fn about(
    framework: &Framework<f64>,
    squares: &[Rational],
    exact: Option<&Framework<Rational>>,
    [p, q]: [usize; 2],
) -> Option<Vec<Vec<usize>>> {
    let count = framework.vertices.len();
    let bar = |a: usize, b: usize| framework.bars.iter().position(|bar| *bar == [a.min(b), a.max(b)]);
    let joined = |a: usize, b: usize| bar(a, b).is_some();
    let wings: Vec<usize> = (0..count).filter(|&x| joined(p, x) && joined(q, x)).collect();
    if wings.len() < 3 {
        return None;
    }
    let square = |a: usize, b: usize| match bar(a, b) {
        Some(k) => squares[k].clone(),
        None => match exact {
            Some(exact) => exact.square([a, b]),
            None => Number::near(&Float::with_val(53, framework.square([a, b])), DIGITS),
        },
    };
    let mut covered = vec![false; framework.bars.len()];
    let mut cover = |vertices: &[usize]| {
        for (k, [a, b]) in framework.bars.iter().enumerate() {
            covered[k] |= vertices.contains(a) && vertices.contains(b);
        }
    };
    let mut found = vec![vec![p, q]];
    let mut inside: Vec<usize> = Vec::new();
    // Each wing on its own, then the wings that a bar or an octahedron relates.
    let mut component: Vec<usize> = (0..wings.len()).collect();
    for (k, &x) in wings.iter().enumerate() {
        cover(&[p, q, x]);
        for (j, &y) in wings.iter().enumerate().skip(k + 1) {
            if joined(x, y) {
                let (from, to) = (component[j], component[k]);
                // In one plane with p and q the bar would not hold the angle to first order.
                if from == to || is_flat([p, q, x, y].map(|v| &framework.vertices[v])) {
                    return None;
                }
                component.iter_mut().filter(|c| **c == from).for_each(|c| *c = to);
                cover(&[p, q, x, y]);
                found.push(vec![p, q, x, y]);
            }
        }
    }
    for (k, &x) in wings.iter().enumerate() {
        for &y in wings[k + 1..].iter().filter(|&&y| !joined(x, y)) {
            let outer = (0..count).filter(|v| ![p, q, x, y].contains(v) && !inside.contains(v));
            let outer: Vec<usize> = outer.filter(|&v| joined(v, x) && joined(v, y)).collect();
            let pair = outer.iter().flat_map(|&u| outer.iter().map(move |&v| (u, v))).find(|&(u, v)| {
                u != v && joined(u, v) && joined(u, q) && joined(v, p) && !joined(u, p) && !joined(v, q)
            });
            let Some((u, v)) = pair else { continue };
            let octahedron = Octahedron::with([p, q, x, u, v, y], square);
            if octahedron.diagonal(2, framework) != Diagonal::Moves {
                return None;
            }
            inside.extend([u, v]);
            cover(&[p, q, x, y, u, v]);
            found.push(vec![p, q, x, y, u, v]);
        }
    }
    let is_everything = (0..count).all(|v| v == p || v == q || wings.contains(&v) || inside.contains(&v));
    component.sort_unstable();
    component.dedup();
    (is_everything && covered.iter().all(|c| *c) && component.len() > 1 && !inside.is_empty()).then_some(found)
}

/// Whether four points are nearly in a plane.
fn is_flat([p, q, x, y]: [&Vector<f64>; 4]) -> bool {
    let from_p = |v: &Vector<f64>| -> Vector<f64> { std::array::from_fn(|k| v[k] - p[k]) };
    let (q, x, y) = (from_p(q), from_p(x), from_p(y));
    let size = [q, x, y].iter().map(|v| dot(v, v).sqrt()).product::<f64>();
    !(dot(&q, &cross(&x, &y)).abs() > FLAT * size)
}
