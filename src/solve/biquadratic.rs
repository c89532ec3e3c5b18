//! Two equations bilinear in (1, cos, sin) of two angles: a quadratic pencil of size 4 in the hidden one.
//!
//! With x and y the half tangents of the hidden and the other angle, rows f, y f, g, y g over the columns 1, y, y^2, y^3.
//! The hidden angle is turned by an offset for which the leading matrix is regular, so that an angle of pi is an
//! ordinary one.

use super::dense;
use super::francis;
use crate::elimination::cut::Hidden;
use crate::elimination::spherical_four_bar::{Equations, Form};
use num_complex::Complex;
use std::f64::consts::PI;

/// Leading matrices below this are singular.
const LEADING: f64 = 1e-12;
/// Leading matrices above this need no other offset.
const GOOD_LEADING: f64 = 1e-2;

/// The roots, and the offset of the angle whose half tangents they are.
#[derive(Clone, Debug)]
pub struct Roots {
    /// Half tangents of the hidden angle less the offset.
    pub roots: [Complex<f64>; 8],
    /// Cosine and sine of the offset.
    pub offset: (f64, f64),
}

type Pencil = [[[f64; 4]; 4]; 3];

/// A pencil at one offset, its leading matrix factored.
struct Turned {
    quality: f64,
    pencil: Pencil,
    factors: [[f64; 4]; 4],
    order: [usize; 4],
    offset: (f64, f64),
}

/// The roots of both equations in the half tangent of the hidden angle; `None` where the pencil is singular.
#[must_use]
pub fn roots(equations: &Equations<f64>, hidden: Hidden) -> Option<Roots> {
    let [f, g] = [&equations.f, &equations.g].map(|form| {
        let largest = form.iter().flatten().map(|x| x.abs()).fold(0.0, f64::max);
        // Rows by the hidden angle.
        let at = |k: usize, l: usize| if hidden == Hidden::First { form[k][l] } else { form[l][k] };
        let rows: Form<f64> = std::array::from_fn(|k| std::array::from_fn(|l| at(k, l) / largest));
        (rows, largest)
    });
    if !(f.1 > 0.0 && g.1 > 0.0) {
        return None;
    }
    let mut best: Option<Turned> = None;
    for k in 0..8 {
        let (sin, cos) = (0.1 + 0.25 * PI * f64::from(k)).sin_cos();
        let pencil = pencil(&f.0, &g.0, (cos, sin));
        let mut factors = pencil[2];
        let (quality, order) = dense::factor(&mut factors);
        if best.as_ref().is_none_or(|b| quality > b.quality) {
            best = Some(Turned { quality, pencil, factors, order, offset: (cos, sin) });
        }
        if quality > GOOD_LEADING {
            break;
        }
    }
    let Turned { quality, pencil, factors, order, offset } = best?;
    if !(quality > LEADING) {
        return None;
    }
    let constant = dense::solve(&factors, &order, &pencil[0]);
    let linear = dense::solve(&factors, &order, &pencil[1]);
    let mut companion = [[0.0; 8]; 8];
    for i in 0..4 {
        companion[i][4 + i] = 1.0;
        for j in 0..4 {
            companion[4 + i][j] = -constant[i][j];
            companion[4 + i][4 + j] = -linear[i][j];
        }
    }
    let roots = francis::eigenvalues(&mut companion)?;
    Some(Roots { roots, offset })
}

/// `(1, cos, sin)` times `1 + x^2` over the powers of x.
fn powers([one, cos, sin]: [f64; 3]) -> [f64; 3] {
    [one + cos, 2.0 * sin, one - cos]
}

fn pencil(f: &Form<f64>, g: &Form<f64>, (cos, sin): (f64, f64)) -> Pencil {
    let mut pencil = [[[0.0; 4]; 4]; 3];
    for (row, form) in [f, g].into_iter().enumerate() {
        // c = c' cos - s' sin, s = s' cos + c' sin
        let turned: Form<f64> = [
            form[0],
            std::array::from_fn(|l| cos * form[1][l] + sin * form[2][l]),
            std::array::from_fn(|l| cos * form[2][l] - sin * form[1][l]),
        ];
        let by_hidden: [[f64; 3]; 3] = std::array::from_fn(|l| powers([turned[0][l], turned[1][l], turned[2][l]]));
        for (power, matrix) in pencil.iter_mut().enumerate() {
            let other = powers([by_hidden[0][power], by_hidden[1][power], by_hidden[2][power]]);
            for (l, value) in other.into_iter().enumerate() {
                matrix[2 * row][l] = value;
                matrix[2 * row + 1][l + 1] = value;
            }
        }
    }
    pencil
}
