//! Approximations of all complex roots of a polynomial, crowded ones included, by f64. Nothing rests on them.
//!
//! Newton's correction with the other approximations divided out settles the roots that f64 tells apart. \[Aberth1973\]
//! Where roots crowd, the polynomial is written about their middle in all the digits of its coefficients. There the roots
//! of the crowd have sizes of their own, which the Newton polygon of the coefficients tells, and the same begins again.

use super::polynomial_roots::sizes_of_roots;
use crate::algebra::ball::Ball;
use crate::algebra::ring::Ring;
use num_complex::Complex;
use rug::Float;
use std::f64::consts::TAU;

/// Rounds of corrections after which roots that have not converged count as crowded.
const ROUNDS: usize = 150;
/// Crowds within crowds.
const DEPTH: usize = 12;
/// Steps towards the middle of a crowd; their number of digits doubles with every step.
const CENTRING: usize = 12;
/// Approximations crowd where their distance is less than this multiple of their error. Where all of them crowd about the origin,
/// a smaller multiple divides them.
const CLEAR: [f64; 4] = [64.0, 16.0, 4.0, 1.0];
/// Powers of two beyond which a number counts as 0 or infinite beside another one.
const RANGE: f64 = 900.0;

/// An approximation `y 2^scale`.
#[derive(Clone, Copy, Debug)]
struct Approximation {
    y: Complex<f64>,
    scale: i32,
}

impl Approximation {
    /// The approximation over another power of two; infinite beyond the range of f64.
    fn over(&self, scale: i32) -> Complex<f64> {
        let shift = f64::from(self.scale) - f64::from(scale);
        if shift > RANGE { Complex::new(f64::INFINITY, 0.0) } else { self.y * shift.max(-RANGE).exp2() }
    }

    fn ball<const BITS: u32>(&self) -> Ball<BITS> {
        let part = |x: f64| Float::with_val(BITS, x) << self.scale;
        Ball::point(&part(self.y.re), &part(self.y.im)).midpoint()
    }
}

/// A polynomial in an unknown over a power of two, its largest coefficient about `2^size` before it was divided by that.
struct Scaled {
    size: f64,
    coefficients: Vec<Complex<f64>>,
}

impl Scaled {
    fn of<const BITS: u32>(polynomial: &[Ball<BITS>], logs: &[f64], scale: i32) -> Self {
        let at = |k: usize| f64::from(scale) * k as f64;
        let size = logs.iter().enumerate().map(|(k, log)| log + at(k)).fold(f64::NEG_INFINITY, f64::max).round();
        let image = |(k, c): (usize, &Ball<BITS>)| {
            let shift = at(k) - size;
            let part = |x: &Float| (Float::with_val(64, x) << whole(shift)).to_f64();
            Complex::new(part(c.re()), part(c.im()))
        };
        Self { size, coefficients: polynomial.iter().enumerate().map(image).collect() }
    }

    /// The value and the slope, and what rounding may have added to the value.
    fn at(&self, y: Complex<f64>) -> (Complex<f64>, Complex<f64>, f64) {
        let (mut value, mut slope, mut bound) = (Complex::ZERO, Complex::ZERO, 0.0);
        let norm = y.norm();
        for c in self.coefficients.iter().rev() {
            slope = slope * y + value;
            value = value * y + c;
            bound = bound * norm + c.norm();
        }
        (value, slope, bound * f64::EPSILON * 4.0 * self.coefficients.len() as f64)
    }
}

/// Returns approximations of all roots of a polynomial whose leading coefficient is not 0. Roots that its digits do not separate
/// are left as f64 has them. `None` where numbers overflow.
#[must_use]
pub fn approximations<const BITS: u32>(coefficients: &[Ball<BITS>]) -> Option<Vec<Ball<BITS>>> {
    smallest(coefficients.to_vec(), coefficients.len().saturating_sub(1), DEPTH)
}

/// Returns the `count` roots nearest to the origin.
fn smallest<const BITS: u32>(mut polynomial: Vec<Ball<BITS>>, count: usize, depth: usize) -> Option<Vec<Ball<BITS>>> {
    if count == 0 {
        return Some(Vec::new());
    }
    if polynomial[0].contains_zero() {
        // A root is here, as far as the digits go.
        polynomial.remove(0);
        let rest = smallest_of_none_at_zero(&polynomial, count - 1, depth)?;
        return Some(rest.into_iter().chain([Ball::zero()]).collect());
    }
    smallest_of_none_at_zero(&polynomial, count, depth)
}

fn smallest_of_none_at_zero<const BITS: u32>(
    polynomial: &[Ball<BITS>],
    count: usize,
    depth: usize,
) -> Option<Vec<Ball<BITS>>> {
    if count > 0 && polynomial[0].contains_zero() {
        return None;
    }
    let logs: Vec<f64> = polynomial.iter().map(log2).collect();
    let mut sizes = sizes_of_roots(&logs);
    sizes.truncate(count);
    let all = settled(polynomial, &logs, &sizes)?;
    let mut found = Vec::new();
    for crowd in crowds(polynomial, &logs, &all) {
        if let [only] = crowd[..] {
            found.push(all[only].ball());
            continue;
        }
        let own: Vec<Approximation> = crowd.iter().map(|&k| all[k]).collect();
        let told = depth.checked_sub(1).and_then(|depth| resolved(polynomial, &own, depth));
        found.extend(told.unwrap_or_else(|| own.iter().map(Approximation::ball).collect()));
    }
    Some(found)
}

/// The roots of a crowd, by the polynomial about its middle; `None` where the digits do not tell them apart.
fn resolved<const BITS: u32>(
    polynomial: &[Ball<BITS>],
    crowd: &[Approximation],
    depth: usize,
) -> Option<Vec<Ball<BITS>>> {
    let scale = crowd.iter().map(|own| own.scale).max()?;
    let sum: Complex<f64> = crowd.iter().map(|own| own.over(scale)).sum();
    let near = Approximation { y: sum / crowd.len() as f64, scale }.ball();
    let (about, middle) = centred(polynomial, near, crowd.len())?;
    let found = smallest(about, crowd.len(), depth)?;
    Some(found.iter().map(|z| z.add(&middle).midpoint()).collect())
}

/// Returns the polynomial about the middle of a crowd of `count` roots near a known place, and that middle: the root there of a
/// derivative.
fn centred<const BITS: u32>(
    polynomial: &[Ball<BITS>],
    near: Ball<BITS>,
    count: usize,
) -> Option<(Vec<Ball<BITS>>, Ball<BITS>)> {
    let mut about = shifted(polynomial, &near);
    let mut middle = near;
    for _ in 0..CENTRING {
        let (low, high) = (&about[count - 1], &about[count]);
        if low.contains_zero() {
            break;
        }
        let step = low.over(&high.mul(&Ball::from_integer(i32::try_from(count).ok()?)))?.neg().midpoint();
        let radius = sizes_of_roots(&about.iter().map(log2).collect::<Vec<_>>()).get(count - 1).copied()?;
        middle = middle.add(&step).midpoint();
        about = shifted(polynomial, &middle);
        // The step squares from here on: the middle is accurate enough.
        if log2(&step) < radius - 30.0 {
            break;
        }
    }
    Some((about, middle))
}

/// `p(x + z)`
fn shifted<const BITS: u32>(polynomial: &[Ball<BITS>], by: &Ball<BITS>) -> Vec<Ball<BITS>> {
    let mut about = polynomial.to_vec();
    for first in 0..about.len() {
        for k in (first..about.len() - 1).rev() {
            about[k] = about[k].add(&about[k + 1].mul(by));
        }
    }
    about
}

/// The nearest power of two.
#[expect(clippy::cast_possible_truncation, reason = "beyond that range numbers are 0 or infinite")]
fn whole(log: f64) -> i32 {
    log.round() as i32
}

/// The logarithm of the size; of what may be 0 that of 0.
fn log2<const BITS: u32>(x: &Ball<BITS>) -> f64 {
    if x.contains_zero() {
        return f64::NEG_INFINITY;
    }
    let size = x.midpoint().upper();
    let exponent = size.get_exp().unwrap_or(0);
    (size >> exponent).to_f64().log2() + f64::from(exponent)
}

/// Approximations as good as f64 has them, from the sizes of the roots.
fn settled<const BITS: u32>(polynomial: &[Ball<BITS>], logs: &[f64], sizes: &[f64]) -> Option<Vec<Approximation>> {
    let mut scales: Vec<Scaled> = Vec::new();
    let mut all: Vec<(Approximation, usize)> = Vec::new();
    let mut from = 0;
    while from < sizes.len() {
        let log = sizes[from];
        if !(log.abs() < 1e8) {
            return None;
        }
        let length = sizes[from..].iter().take_while(|own| own.to_bits() == log.to_bits()).count();
        let scale = whole(log);
        scales.push(Scaled::of(polynomial, logs, scale));
        let radius = (log - f64::from(scale)).exp2();
        // Turned, so that no two approximations are conjugate and stay so.
        let place = |k: usize| Complex::from_polar(radius, TAU * (k as f64 + 0.3) / length as f64 + 0.4 + log);
        let own = |k| (Approximation { y: place(k), scale }, scales.len() - 1);
        all.extend((0..length).map(own));
        from += length;
    }
    let mut open = vec![true; all.len()];
    for _ in 0..ROUNDS {
        if !open.contains(&true) {
            break;
        }
        for k in 0..all.len() {
            if open[k] {
                open[k] = corrected(&mut all, k, &scales);
            }
        }
    }
    let all: Vec<Approximation> = all.into_iter().map(|(own, _)| own).collect();
    all.iter().all(|own| own.y.is_finite()).then_some(all)
}

/// Corrects an approximation; whether more corrections may help.
fn corrected(all: &mut [(Approximation, usize)], k: usize, scales: &[Scaled]) -> bool {
    let (Approximation { y, scale }, polynomial) = all[k];
    let (value, slope, bound) = scales[polynomial].at(y);
    if value.norm() <= bound {
        return false;
    }
    let newton = value / slope;
    if !newton.is_finite() {
        // At a zero of the derivative: anywhere else.
        all[k].0.y = y * Complex::new(1.001, 0.002);
        return true;
    }
    let others = all.iter().enumerate().filter(|(j, _)| *j != k);
    let repelled = others.fold(Complex::ZERO, |sum, (_, (other, _))| {
        let inverse = (y - other.over(scale)).inv();
        if inverse.is_finite() { sum + inverse } else { sum }
    });
    let factor = (1.0 - newton * repelled).inv();
    let correction = if factor.is_finite() { newton * factor } else { newton };
    all[k].0.y = y - correction;
    correction.norm() > 2.0 * f64::EPSILON * y.norm()
}

/// Groups approximations that may stand for each other's roots: those no farther apart than a multiple of Weierstrass'
/// correction.
fn crowds<const BITS: u32>(polynomial: &[Ball<BITS>], logs: &[f64], all: &[Approximation]) -> Vec<Vec<usize>> {
    let count = all.len();
    let distance = |j: usize, k: usize| {
        let scale = all[j].scale.max(all[k].scale);
        (all[j].over(scale) - all[k].over(scale)).norm().log2() + f64::from(scale)
    };
    let reach = |k: usize| {
        let own = Scaled::of(polynomial, logs, all[k].scale);
        let (value, _, bound) = own.at(all[k].y);
        let product: f64 = (0..count).filter(|&j| j != k).map(|j| distance(j, k)).sum();
        (value.norm() + bound).log2() + own.size - logs[count] - product
    };
    let reaches: Vec<f64> = (0..count).map(reach).collect();
    let joined = |clear: f64| {
        let mut crowds: Vec<Vec<usize>> = Vec::new();
        for k in 0..count {
            // NaN does not separate them.
            let is_near = |j: &usize| !(distance(*j, k) > reaches[*j].max(reaches[k]) + clear.log2());
            let (near, apart): (Vec<_>, Vec<_>) = crowds.into_iter().partition(|crowd| crowd.iter().any(is_near));
            crowds = apart;
            crowds.push(near.into_iter().flatten().chain([k]).collect());
        }
        crowds
    };
    // About their middle, roots that are all on one side of the origin have other sizes.
    let size = all.iter().map(|own| own.y.norm().log2() + f64::from(own.scale)).fold(f64::NEG_INFINITY, f64::max);
    let is_beside = (0..count).all(|k| (0..k).all(|j| distance(j, k) < size - 2.0));
    let tried = if is_beside { &CLEAR[..1] } else { &CLEAR[..] };
    let split = tried.iter().map(|clear| joined(*clear)).find(|crowds| crowds.len() > 1);
    split.unwrap_or_else(|| vec![(0..count).collect()])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::algebra::univariate::Univariate;
    use rug::Rational;

    type Long = Ball<1024>;

    fn power(n: i32) -> Rational {
        let unit = Rational::from(10);
        (0..n.abs()).fold(Rational::from(1), |x, _| if n < 0 { x / &unit } else { x * &unit })
    }

    /// Returns the largest error of an approximation, over the distance of the root from the next one.
    fn worst(roots: &[Rational]) -> f64 {
        let one = Univariate::new(vec![Rational::from(1)]);
        let product = roots.iter().fold(one, |p, x| p.mul(&Univariate::new(vec![-x.clone(), Rational::from(1)])));
        let image: Option<Vec<Long>> = product.coefficients().iter().map(Long::from_rational).collect();
        let found = approximations(&image.expect("rationals have balls")).expect("nothing overflows");
        assert_eq!(found.len(), roots.len());
        let exact: Vec<Long> = roots.iter().filter_map(Long::from_rational).collect();
        let off = |k: usize| {
            let to = |z: &Long| log2(&z.sub(&exact[k]));
            let nearest = found.iter().map(to).fold(f64::INFINITY, f64::min);
            let gap = (0..exact.len()).filter(|j| *j != k).map(|j| to(&exact[j])).fold(f64::INFINITY, f64::min);
            (nearest - gap).exp2()
        };
        (0..roots.len()).map(off).fold(0.0, f64::max)
    }

    #[test]
    fn a_root_at_nought_and_its_neighbours_are_found() {
        let roots = [Rational::new(), power(-20), -power(-20), Rational::from(5)];
        assert!(worst(&roots) < 1e-3);
        assert_eq!(approximations::<128>(&[Ball::one()]), Some(Vec::new()));
    }
}
