//! The pencil of one cut with a rotated hidden variable, so that it is well posed.

use super::limits;
use crate::elimination::cut::Hidden;
use crate::elimination::pencil::{Bilinear, Pencil, Square, offset, pencil};
use crate::solve::dense;
use std::f64::consts::TAU;

/// The pencil of a cut, its hidden unknown rotated by an offset and its leading matrix factored.
pub(super) struct Shifted {
    pub pencil: Pencil<f64>,
    pub hidden: Hidden,
    pub offset: (f64, f64),
    factors: [[f64; 8]; 8],
    order: [usize; 8],
    /// Smallest over largest pivot of the leading matrix.
    pub quality: f64,
}

impl Shifted {
    /// Returns the first of four offsets whose leading matrix is good, else the best.
    pub fn best(equations: &Bilinear<f64>, hidden: Hidden) -> Self {
        let mut best: Option<Self> = None;
        for k in 0..4 {
            // Offsets are no multiples of a right angle, where roots of real mechanisms tend to lie.
            let (sin, cos) = (0.4 + 0.25 * TAU * f64::from(k)).sin_cos();
            let pencil = pencil(&offset(equations, hidden, &cos, &sin), hidden);
            let mut factors = pencil.coefficients[2];
            let (quality, order) = dense::factor(&mut factors);
            if best.as_ref().is_none_or(|b| quality > b.quality) {
                best = Some(Self { pencil, hidden, offset: (cos, sin), factors, order, quality });
            }
            if quality > limits::GOOD_LEADING {
                break;
            }
        }
        best.expect("four offsets were tried")
    }
}

impl Shifted {
    /// Returns `A2^-1 A0` and `A2^-1 A1`; `None` if the leading matrix is singular.
    pub fn monic(&self) -> Option<(Square<f64, 8>, Square<f64, 8>)> {
        let [a0, a1, _] = &self.pencil.coefficients;
        let divided = |a: &[[f64; 8]; 8]| dense::solve(&self.factors, &self.order, a);
        (self.quality > limits::LEADING).then(|| (divided(a0), divided(a1)))
    }
}
