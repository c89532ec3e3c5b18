//! The complex zeros of a real trigonometric polynomial of degree 8, side by side, where its real ones are known.
//!
//! In `w = e^(i q)` it is a polynomial p of degree 16 over w^8. Its roots off the unit circle come in pairs w and 1/conj(w), of which one is
//! inside; the real zeros are the roots on the circle. All roots inside are sought at once by the method of Ehrlich and Aberth: Newton's
//! method, each root repelled by all others.

use super::lanes::{ComplexLanes, LaneNumber, Lanes, Row, WIDTH};
use pulp::Simd;
use std::f64::consts::TAU;

/// Degree of the trigonometric polynomial.
pub const DEGREE: usize = 8;
/// Rounds until roots are given up: of 2000 poses of general arms the slowest took 18.
const MOST_ROUNDS: usize = 40;
/// The square of a step, in parts of the root, after which no other follows: the next step would be of the order of the cube of this one, 1e-15, which is
/// the rounding of the polynomial.
const SETTLED: f64 = 1e-10;
/// First guesses lie on a circle of radius between these.
const RADII: [f64; 2] = [0.01, 0.95];
/// The angle of the first guess: guesses are not on the real axis, where polynomials with real coefficients would keep them.
const FIRST: f64 = 0.3;

/// Zeros on the real line, at most 16, as cosines and sines; their number is even.
#[derive(Clone, Copy)]
pub struct OnCircle<'a> {
    /// The cosines.
    pub cos: &'a [f64],
    /// The sines.
    pub sin: &'a [f64],
}

/// The roots inside the unit circle; lanes that are not used repeat the others.
pub struct Inside {
    /// The real parts.
    pub re: Row,
    /// The imaginary parts.
    pub im: Row,
    /// The number of roots.
    pub count: usize,
}

/// Returns the roots w inside the unit circle of `c_0 + sum (c_k w^k + conj(c_k) w^-k)`, given `c_k` as real and imaginary parts, all zeros on
/// the circle, and the mean size of the values on the circle by their logarithms; `None` where they do not converge.
///
/// # Source
/// O. Aberth 1973, Iteration methods for finding all zeros of a polynomial simultaneously, Mathematics of Computation 27.
#[inline(always)]
pub fn inside<S: Simd>(simd: S, c: &[[f64; 2]; DEGREE + 1], on: OnCircle<'_>, mean: f64) -> Option<Inside> {
    let count = DEGREE.checked_sub(on.cos.len() / 2)?;
    let mut roots = Inside { re: [0.0; WIDTH], im: [0.0; WIDTH], count };
    if count == 0 {
        return Some(roots);
    }
    // The product of the roots inside is c_8 over Mahler's measure, which is that mean (Jensen's formula).
    let [re, im] = c[DEGREE];
    let radius = ((re * re + im * im).sqrt() / mean).powf(1.0 / count as f64).clamp(RADII[0], RADII[1]);
    for k in 0..WIDTH {
        let (sin, cos) = (TAU * ((k % count) as f64 + FIRST) / count as f64).sin_cos();
        (roots.re[k], roots.im[k]) = (radius * cos, radius * sin);
    }
    for _ in 0..MOST_ROUNDS {
        let mut next = ([0.0; WIDTH], [0.0; WIDTH]);
        let mut is_settled = true;
        for chunk in 0..count.div_ceil(S::F64_LANES) {
            let z = ComplexLanes { re: Lanes::load(simd, &roots.re, chunk), im: Lanes::load(simd, &roots.im, chunk) };
            let one = Lanes::splat(simd, 1.0);
            let [value, slope] = value_and_slope(c, z);
            let step = value * value.mul_from(repulsion(z, &roots, on), slope).inverse();
            let moved = z - step;
            // Outside, the root of the pair that is inside is meant.
            let square = moved.square_size();
            let scale = one.below(square).select(one / square, one);
            (moved.re * scale).store(&mut next.0, chunk);
            (moved.im * scale).store(&mut next.1, chunk);
            is_settled &= step.square_size().at_most(square * one.like(SETTLED)).all();
        }
        (roots.re, roots.im) = next;
        if is_settled {
            return Some(roots);
        }
    }
    None
}

/// The same number in every lane.
#[inline(always)]
fn number<S: Simd>([re, im]: [f64; 2], like: ComplexLanes<S>) -> ComplexLanes<S> {
    ComplexLanes { re: like.re.like(re), im: like.re.like(im) }
}

/// The polynomial and its derivative.
#[inline(always)]
fn value_and_slope<S: Simd>(c: &[[f64; 2]; DEGREE + 1], z: ComplexLanes<S>) -> [ComplexLanes<S>; 2] {
    let mut value = number(c[DEGREE], z);
    let mut slope = number([0.0, 0.0], z);
    for k in (0..DEGREE).rev() {
        slope = slope.mul_add(z, value);
        value = value.mul_add(z, number(c[k], z));
    }
    for [re, im] in &c[1..] {
        slope = slope.mul_add(z, value);
        value = value.mul_add(z, number([*re, -*im], z));
    }
    [value, slope]
}

/// The sum of `1 / (z - x)` over all other roots x.
#[inline(always)]
fn repulsion<S: Simd>(z: ComplexLanes<S>, roots: &Inside, on: OnCircle<'_>) -> ComplexLanes<S> {
    let one = z.re.like(1.0);
    let mut sum = ComplexLanes { re: one.like(0.0), im: one.like(0.0) };
    for k in 0..roots.count {
        // With x and 1/conj(x): (2 z conj(x) - 1 - |x|^2) / ((z - x) (z conj(x) - 1)).
        let x = number([roots.re[k], roots.im[k]], z);
        let back = x.conj();
        let apart = z - x;
        let outer = z.mul_add(back, ComplexLanes::of(-one));
        let both = outer.times(one.like(2.0)) + ComplexLanes::of(one - x.square_size());
        // A root is repelled by its partner, and not by itself.
        let is_other = one.like(0.0).below(apart.square_size());
        let apart = ComplexLanes::selected(is_other, apart, ComplexLanes::of(one));
        let both = ComplexLanes::selected(is_other, both, back);
        sum = both.mul_add((apart * outer).inverse(), sum);
    }
    for (cos, sin) in on.cos.chunks_exact(2).zip(on.sin.chunks_exact(2)) {
        let first = z - number([cos[0], sin[0]], z);
        let second = z - number([cos[1], sin[1]], z);
        sum = (first + second).mul_add((first * second).inverse(), sum);
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_complex::Complex;
    use pulp::{Arch, Scalar, WithSimd};

    struct Search<'a>([[f64; 2]; DEGREE + 1], OnCircle<'a>, f64);

    impl WithSimd for Search<'_> {
        type Output = Option<Inside>;

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) -> Option<Inside> {
            inside(simd, &self.0, self.1, self.2)
        }
    }

    /// A product of factors `2 sin ((q - a) / 2) sin ((q - b) / 2) = cos ((a - b) / 2) - cos (q - (a + b) / 2)`, where a and b are real or conjugate.
    #[test]
    fn roots_inside_are_found() {
        for real_pairs in 0..=DEGREE {
            let zeros: [[Complex<f64>; 2]; DEGREE] = std::array::from_fn(|k| {
                let x = k as f64;
                let (middle, width) = (0.4 + 0.7 * x, 0.05 + 0.4 * x);
                let width = if k < real_pairs { Complex::new(0.1 * width, 0.0) } else { Complex::new(0.0, width) };
                [middle + width, middle - width]
            });
            // Coefficients of the powers -8 to 8 of w.
            let mut powers = vec![Complex::new(0.0, 0.0); 2 * DEGREE + 1];
            powers[DEGREE] = Complex::new(1.0, 0.0);
            for [a, b] in zeros {
                let turn = Complex::from_polar(0.5, -0.5 * (a + b).re);
                let mut next = vec![Complex::new(0.0, 0.0); 2 * DEGREE + 1];
                for (k, x) in powers.iter().enumerate().filter(|(_, x)| x.norm() > 0.0) {
                    next[k] += x * (0.5 * (a - b)).cos();
                    next[k + 1] -= x * turn;
                    next[k - 1] -= x * turn.conj();
                }
                powers = next;
            }
            let c: [[f64; 2]; DEGREE + 1] = std::array::from_fn(|k| [powers[DEGREE + k].re, powers[DEGREE + k].im]);
            let on: Vec<Complex<f64>> = zeros[..real_pairs].iter().flatten().map(|q| Complex::cis(q.re)).collect();
            let (cos, sin): (Vec<f64>, Vec<f64>) = on.iter().map(|w| (w.re, w.im)).unzip();
            let on = OnCircle { cos: &cos, sin: &sin };
            let found = [Arch::new().dispatch(Search(c, on, 0.3)), Scalar.vectorize(Search(c, on, 0.3))];
            for found in found.map(|found| found.expect("simple roots are found")) {
                assert_eq!(found.count, DEGREE - real_pairs);
                for [q, _] in &zeros[real_pairs..] {
                    let w = (Complex::<f64>::i() * q).exp();
                    let near = |k: usize| (Complex::new(found.re[k], found.im[k]) - w).norm() < 1e-6 * w.norm();
                    assert_eq!((0..found.count).filter(|&k| near(k)).count(), 1, "{w} of {real_pairs}");
                }
            }
        }
    }
}
