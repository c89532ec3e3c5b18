//! Where the moving pivots of a four-bar stand at the points of its curve.

use super::curve::turn;
use crate::synthesis::dyad::Dyad;
use num_complex::Complex;

/// Returns the pivots of these names of a real four-bar at the first point: fixed, moving, moving, fixed.
#[must_use]
pub fn pivots(dyad: &Dyad, names: [&str; 4]) -> Option<[[f64; 2]; 4]> {
    let pivots: Vec<[f64; 2]> = names.iter().filter_map(|name| dyad.real(name).try_into().ok()).collect();
    pivots.try_into().ok()
}

/// Returns the two moving pivots at each point of the coupler curve. The four-bar stands with these pivots at the first point; `None`
/// where a point is no regular one of its curve.
#[must_use]
pub fn moving([a, x, y, b]: &[[f64; 2]; 4], points: &[[f64; 2]]) -> Option<Vec<[[f64; 2]; 2]>> {
    let origin = points.first()?;
    let seen = |p: &[f64; 2]| Complex::new(p[0] - origin[0], p[1] - origin[1]);
    let [a, x, y, b] = [a, x, y, b].map(seen);
    let v = [Complex::from(1.0), x, x.conj(), a, a.conj(), y, y.conj(), b, b.conj()];
    let at = |point: &[f64; 2]| {
        let d = seen(point);
        let [numerator, denominator, _] = turn(&v, &d, &d.conj());
        let turn = if point == origin { Complex::from(1.0) } else { numerator / denominator };
        let place = |z: Complex<f64>| {
            let turned = z * turn / turn.norm();
            [point[0] + turned.re, point[1] + turned.im]
        };
        turn.is_finite().then(|| [place(x), place(y)])
    };
    points.iter().map(at).collect()
}
