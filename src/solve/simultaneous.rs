//! All roots of a polynomial at once, from its values alone.

use num_complex::Complex;

/// Rounds after which roots that have not converged are given up.
const MOST_ROUNDS: usize = 80;
/// A step of this size, relative to 1 + |x|, is the last of a root.
const SETTLED: f64 = 1e-14;
/// Between two turns of the spiral of first guesses: the golden angle.
const TURN: f64 = 2.399_963_229_728_653;

/// The N roots of a polynomial of degree N given by its value and slope at a point, by the method of Ehrlich and Aberth:
/// Newton's method, each root repelled by the others. Multiple roots come near and not further.
/// \[Aberth1973\]
#[must_use]
pub fn roots<const N: usize>(polynomial: impl Fn(Complex<f64>) -> (Complex<f64>, Complex<f64>)) -> [Complex<f64>; N] {
    // Evenly on the sphere of all complex numbers and infinity.
    let mut roots: [Complex<f64>; N] = std::array::from_fn(|k| {
        let height = 1.0 - (2.0 * k as f64 + 1.0) / N as f64;
        Complex::from_polar(((1.0 + height) / (1.0 - height)).sqrt(), k as f64 * TURN)
    });
    let mut settled = [false; N];
    for _ in 0..MOST_ROUNDS {
        for k in 0..N {
            if settled[k] {
                continue;
            }
            let (value, slope) = polynomial(roots[k]);
            if value == Complex::from(0.0) {
                settled[k] = true;
                continue;
            }
            let others: Complex<f64> = (0..N).filter(|&j| j != k).map(|j| (roots[k] - roots[j]).inv()).sum();
            let step = (slope / value - others).inv();
            if !step.is_finite() {
                continue;
            }
            roots[k] -= step;
            settled[k] = step.norm() < SETTLED * (1.0 + roots[k].norm());
        }
        if settled.iter().all(|s| *s) {
            break;
        }
    }
    roots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_near_and_far_are_found() {
        let wanted = [0.0, 1e-3, -2.0, 5.0, 1e4].map(Complex::from);
        let found = roots::<5>(|x| {
            let factor = |k: usize| x - wanted[k];
            let value = (0..5).map(factor).product();
            let without = |k: usize| (0..5).filter(|&j| j != k).map(factor).product::<Complex<f64>>();
            (value, (0..5).map(without).sum())
        });
        for root in wanted {
            let nearest = found.iter().map(|x| (x - root).norm()).fold(f64::INFINITY, f64::min);
            assert!(nearest < 1e-12 * (1.0 + root.norm()), "{root}: {nearest:e}");
        }
    }
}
