//! The real poses of a list, compared with the real roots of the exact polynomial.

use crate::algebra::real_roots::RealRoot;
use crate::algebra::univariate::Univariate;
use crate::assembly::platform::PlatformMode;
use crate::elimination::platform_polynomial::{Coordinate, PlatformPolynomial};
use rug::Rational;

/// Bits to which roots are isolated: more than a pose in f64 can tell.
const BITS: u32 = 80;
/// Margin on bounds that are themselves computed in f64.
const MARGIN: f64 = 1.01;

/// An interval that holds the variable of the polynomial at a real mode with a certificate; `None` where that is not bounded.
fn interval(coordinate: &Coordinate, mode: &PlatformMode) -> Option<(f64, f64)> {
    let radius = mode.certificate?.radius + 16.0 * f64::EPSILON;
    let x: [_; 4] = std::array::from_fn(|k| mode.study[k]);
    let [above, below] = coordinate.parts(&x);
    let sizes = coordinate.sizes();
    // Numerator and denominator are linear in x, with coefficients of these sums; rounding is within the radius above.
    let [most_above, most_below] = sizes.map(|size| size * radius);
    let least = below.norm() - most_below;
    let value = (above / below).re;
    let error = MARGIN * (most_above + value.abs() * most_below) / least + 4.0 * f64::EPSILON * value.abs();
    (least > 0.0 && error.is_finite()).then_some((value - error, value + error))
}

/// Returns whether every real root of the polynomial is the value of listed real modes whose multiplicities add up to its own, so
/// that no real pose is missing.
pub fn are_all_matched(polynomial: &PlatformPolynomial, modes: &[PlatformMode]) -> bool {
    let mut roots = Univariate::new(polynomial.coefficients.clone()).real_roots();
    for root in &mut roots {
        let (low, high) = root.bounds();
        let size = low.abs().max(high.abs()).max(Rational::from(1));
        root.refine(&(size >> BITS));
    }
    let mut counted = vec![0; roots.len()];
    for mode in modes.iter().filter(|mode| mode.real && mode.certificate.is_some()) {
        // A real pose has a real value, which is a root.
        let Some(place) = interval(&polynomial.coordinate, mode).and_then(|interval| only_root(&roots, interval))
        else {
            continue;
        };
        counted[place] += mode.multiplicity;
    }
    roots.iter().zip(counted).all(|(root, counted)| root.multiplicity() == counted)
}

/// The only root that can lie in an interval.
fn only_root(roots: &[RealRoot], (low, high): (f64, f64)) -> Option<usize> {
    let (low, high) = (Rational::from_f64(low)?, Rational::from_f64(high)?);
    let meets = |root: &RealRoot| {
        let bounds = root.bounds();
        bounds.0 <= high && low <= bounds.1
    };
    let mut inside = (0..roots.len()).filter(|&k| meets(&roots[k]));
    match (inside.next(), inside.next()) {
        (Some(root), None) => Some(root),
        _ => None,
    }
}
