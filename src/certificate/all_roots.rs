//! All complex roots of a square-free polynomial, each in its own ball.

use super::isolation::Longer;
use crate::algebra::ring::Ring;
use crate::algebra::univariate::Univariate;
use num_complex::Complex;
use rug::{Float, Rational};

/// Maximum number of Weierstrass iterations: some hundreds from a circle, a few from approximations.
const STEPS: usize = 600;
/// Corrections below this part of a root end the iteration, as a power of two: further steps only meet rounding.
const DIGITS: u32 = 300;

/// The same in f64, and the distance of roots that it tells apart.
const ROUNDED: f64 = 1e-12;

/// Returns the roots, with these places as first starts; `None` if they are not separated.
///
/// # Source
/// Of n approximations each disc of radius `n |w_k|` around one, with Weierstrass' corrections `w_k = p(z_k) / (a_n prod_j
/// (z_k - z_j))`, holds a root, and exactly one if it meets no other disc. \[Smith1970\]
pub(super) fn all_roots(polynomial: &Univariate<Rational>, starts: &[Complex<f64>]) -> Option<Vec<Longer>> {
    let degree = polynomial.degree()?;
    let leading = polynomial.coefficients().last()?;
    let monic: Vec<Longer> = polynomial
        .coefficients()
        .iter()
        .map(|c| Longer::from_rational(&Rational::from(c / leading)))
        .collect::<Option<_>>()?;
    let mut points = starting(&monic, degree, starts);
    for _ in 0..STEPS {
        let corrections = corrections(&monic, &points)?;
        let is_done = corrections.iter().zip(&points).all(|(w, z)| {
            let size = z.upper();
            w.midpoint().upper() <= size >> DIGITS
        });
        points = points.iter().zip(&corrections).map(|(z, w)| z.sub(w).midpoint()).collect();
        if is_done {
            break;
        }
    }
    let corrections = corrections(&monic, &points)?;
    let radius = |w: &Longer| w.upper() * u32::try_from(degree).unwrap_or(u32::MAX);
    let balls: Vec<Longer> = points.iter().zip(&corrections).map(|(z, w)| z.clone().enlarged(&radius(w))).collect();
    let are_apart = (0..degree).all(|k| balls[..k].iter().all(|other| !balls[k].overlaps(other)));
    are_apart.then_some(balls)
}

/// Returns as many different starts as there are roots: those given, and others on a circle around all roots.
fn starting(monic: &[Longer], degree: usize, starts: &[Complex<f64>]) -> Vec<Longer> {
    let point = |z: &Complex<f64>| Longer::point(&Float::with_val(53, z.re), &Float::with_val(53, z.im));
    let mut places: Vec<Complex<f64>> = Vec::new();
    for start in starts {
        let is_new = places.iter().all(|place| (place - start).norm() > 1e-12 * start.norm());
        if is_new && places.len() < degree {
            places.push(*start);
        }
    }
    // The geometric mean of the absolute values of all roots follows from the last coefficient.
    let last = monic[0].upper();
    let exponent = f64::from(last.get_exp().unwrap_or(0)) / degree.max(1) as f64;
    let radius = exponent.clamp(-900.0, 900.0).exp2();
    // An angle that is no rational part of 2 pi keeps the starts off the symmetries of the polynomial.
    let on_circle = |k: usize| Complex::from_polar(radius, 0.7 + 2.399_963 * k as f64);
    places.extend((places.len()..degree).map(on_circle));
    rounded(monic, &places).unwrap_or(places).iter().map(point).collect()
}

/// Improves starts in f64, where a step costs little; `None` if they do not become different numbers.
fn rounded(monic: &[Longer], starts: &[Complex<f64>]) -> Option<Vec<Complex<f64>>> {
    let monic: Vec<Complex<f64>> = monic.iter().map(|c| Complex::new(c.re().to_f64(), c.im().to_f64())).collect();
    let mut points = starts.to_vec();
    for _ in 0..STEPS {
        let correction = |k: usize| {
            let z = points[k];
            let value = monic.iter().rev().fold(Complex::new(0.0_f64, 0.0), |value, c| value * z + c);
            let others = points.iter().enumerate().filter(|(other, _)| *other != k);
            value / others.fold(Complex::new(1.0_f64, 0.0), |product, (_, other)| product * (z - other))
        };
        let corrections: Vec<Complex<f64>> = (0..points.len()).map(correction).collect();
        let is_done = corrections.iter().zip(&points).all(|(w, z)| w.norm() <= ROUNDED * z.norm());
        points = points.iter().zip(&corrections).map(|(z, w)| z - w).collect();
        if is_done {
            break;
        }
    }
    let is_apart = |k: usize| points[..k].iter().all(|other| (other - points[k]).norm() > ROUNDED * points[k].norm());
    (points.iter().all(|z| z.is_finite()) && (0..points.len()).all(is_apart)).then_some(points)
}

fn corrections(monic: &[Longer], points: &[Longer]) -> Option<Vec<Longer>> {
    let correction = |k: usize| {
        let z = &points[k];
        let value = monic.iter().rev().fold(Longer::zero(), |value, c| value.mul(z).add(c));
        let others = points.iter().enumerate().filter(|(other, _)| *other != k);
        value.over(&others.fold(Longer::one(), |product, (_, other)| product.mul(&z.sub(other))))
    };
    (0..points.len()).map(correction).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_root_is_in_a_ball_of_its_own() {
        // (x - 1)(x - 2)(x^2 + 1)(1000 x - 1)
        let factors = [vec![-1, 1], vec![-2, 1], vec![1, 0, 1], vec![-1, 1000]];
        let polynomial = factors.iter().fold(Univariate::constant(Rational::from(1)), |product, factor| {
            product.mul(&Univariate::new(factor.iter().map(|c| Rational::from(*c)).collect()))
        });
        for starts in [vec![], vec![Complex::new(1.0, 1e-9), Complex::new(0.0, 1.0)]] {
            let roots = all_roots(&polynomial, &starts).expect("simple roots");
            assert_eq!(roots.len(), 5);
            for (re, im) in [(1.0, 0.0), (2.0, 0.0), (0.0, 1.0), (0.0, -1.0), (0.001, 0.0)] {
                let near = |ball: &&Longer| {
                    let (x, y) = (ball.re().to_f64() - re, ball.im().to_f64() - im);
                    x.hypot(y) < 1e-15
                };
                assert_eq!(roots.iter().filter(near).count(), 1, "{re} {im}");
            }
        }
    }
}
