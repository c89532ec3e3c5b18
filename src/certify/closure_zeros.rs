//! The hidden angles at which a loop may close, all of them, with proof.
//!
//! The rows of a half-angle form are computed in double-double arithmetic. Beside each exact loop there are exact rows: a computed row n that annihilates
//! the left side L up to a remainder r = n L is corrected to `n - r (X L)^-1 X`, which annihilates it, where X is a computed
//! left inverse of L; with S = X L - I of row-sum norm s < 1 every entry j of the correction is at most `|r|_1 / (1 - s) max_i |X_ij|`.
//! The combinations without `e^(+i q3)` are corrected in the same way. From there on every number is carried with a bound of
//! its distance to that of the exact rows.
//!
//! At a real closure the exact 8 x 8 matrix has a kernel vector `(1, z, z^2, z^3) x (1, x3)`, homogeneous in both half-tangents, hence
//! not zero. So the determinant, a trigonometric polynomial of degree 8 in the hidden angle, vanishes. Where its zero is simple, the
//! kernel has dimension 1, z and x3 are unique, so are unknowns 4 and 5, since L has a left inverse, and unknown 6 closes the loop.
//! Hence a loop has at most as many real configurations as the exact determinant has real zeros, if all of these are simple.

use super::circle_zeros::{SAMPLE_ERROR, SAMPLES, Zeros, are_no_more, samples, zeros};
use super::closure_lanes::LaneRows;
use crate::algebra::bounded::{Bounded, Floating, Magnitude};
use crate::algebra::double_double::DoubleDouble;
use crate::algebra::ring::Ring;
use crate::closure::half_angle::{Combinations, combined, turning, with_combinations};
use crate::closure::woernle_lee::{MarkedLine, SIZE, act_on_form, left_columns};
use crate::elimination::brackets::{self, Columns};
use crate::elimination::cut::{Cut, Hidden};
use crate::elimination::pencil::{Bilinear, bilinear};
use crate::kinematics::closed_loop::ClosedLoop;
use crate::kinematics::motion::Motion;

/// Roundings by which an entry of a constant may be off, relative to 1 and, for a translation, to the longest one of the loop: they
/// are rounded once from exact numbers, or a few times.
pub(super) const CONSTANT: f64 = 32.0;

/// The exact rows of a cut, enclosed, carried over constant 2 of the cut.
#[derive(Clone, Debug)]
pub struct EnclosedRows {
    /// The cut.
    pub cut: Cut,
    values: [MarkedLine<f64>; 8],
    bounds: [MarkedLine<Magnitude>; 8],
    /// The same as forms on the closing transformation, where that is constant 6 of the cut.
    pub lanes: Option<LaneRows>,
}

/// The equations of a cut at a pose in f64, bounded.
pub struct EnclosedEquations {
    values: Bilinear<f64>,
    bounds: Bilinear<Magnitude>,
}

/// Returns the constants of a loop with bounds of their errors; the closing transformation may be off by a matrix of row-sum norm `off`
/// beyond a few roundings.
fn enclosed<T: Floating>(closed: &ClosedLoop<T>, off: f64) -> ClosedLoop<Bounded<T>> {
    let longest =
        closed.constants.iter().flat_map(|motion| motion.translation).map(|x| x.in_f64().abs()).fold(0.0, f64::max);
    let constant = |j: usize| {
        let beyond = if j == 5 { off } else { 0.0 };
        let motion = &closed.constants[j];
        let bounded = |x: T, size: f64| Bounded::new(x, CONSTANT * T::ROUNDOFF * size + beyond);
        Motion {
            rotation: motion.rotation.map(|row| row.map(|x| bounded(x, 1.0))),
            translation: motion.translation.map(|x| bounded(x, 1.0 + longest)),
        }
    };
    ClosedLoop { variables: closed.variables, constants: std::array::from_fn(constant) }
}

/// Returns exact rows, enclosed, that annihilate the columns; `None` if the left inverse is too inexact to prove that there are any.
fn corrected<T: Floating, const K: usize, const N: usize, const C: usize>(
    rows: &[[T; N]; K],
    left_inverse: &[[T; N]; C],
    columns: &[[Bounded<T>; N]; C],
) -> Option<[[Bounded<T>; N]; K]> {
    let product = |row: &[T; N], column: &[Bounded<T>; N]| {
        row.iter().zip(column).fold(Bounded::zero(), |sum, (x, y)| sum.add(&Bounded::new(*x, 0.0).mul(y)))
    };
    let mut inexact = 0.0_f64;
    for (i, row) in left_inverse.iter().enumerate() {
        let mut sum = 0.0;
        for (j, column) in columns.iter().enumerate() {
            let one = if i == j { Bounded::one() } else { Bounded::zero() };
            sum += product(row, column).sub(&one).size();
        }
        if !(sum < 0.5) {
            return None;
        }
        inexact = inexact.max(sum);
    }
    let size = |x: T| Bounded::new(x, 0.0).size();
    let largest: [f64; N] = std::array::from_fn(|j| left_inverse.iter().map(|row| size(row[j])).fold(0.0, f64::max));
    Some(rows.each_ref().map(|row| {
        let remainder: f64 = columns.iter().map(|column| product(row, column).size()).sum();
        let factor = 1.01 * remainder / (1.0 - inexact);
        std::array::from_fn(|j| Bounded::new(row[j], factor * largest[j]))
    }))
}

impl EnclosedRows {
    /// Returns the rows of a cut whose constants 2 to 5 do not depend on the pose; `None` if the cut loses equations or nearly does.
    ///
    /// They are computed in double-double arithmetic from the exact constants, rounded once: otherwise the errors of f64 constants,
    /// enlarged by the elimination, would hide zeros.
    #[must_use]
    pub fn of(cut: Cut, closed: &ClosedLoop<DoubleDouble>) -> Option<Self> {
        let (_, combinations) = with_combinations(&cut.of(closed))?;
        let view = cut.of(&enclosed(closed, 0.0));
        let long = rows(&combinations, &view)?;
        // The closing transformation is constant 6 of these cuts, and no other constant changes with it.
        let lanes = (cut.constant_index(5) == 5).then(|| LaneRows::new(&long, &view.constants[0].inverse()));
        let rows = long.map(|row| row.map(Bounded::in_f64));
        let (values, bounds) = (rows.map(|row| row.map(|x| x.value)), rows.map(|row| row.map(Magnitude::from)));
        Some(Self { cut, values, bounds, lanes })
    }

    /// Returns the equations at a pose, whose closing transformation is off by a matrix of row-sum norm `off` beyond a few
    /// roundings.
    #[must_use]
    pub fn equations(&self, closed: &ClosedLoop<f64>, off: f64) -> EnclosedEquations {
        // A reversed cut inverts constants, and that is bounded, too.
        let view = self.cut.of(&enclosed(closed, off));
        let values = view.constants.each_ref().map(|motion| Motion {
            rotation: motion.rotation.map(|row| row.map(|x| x.value)),
            translation: motion.translation.map(|x| x.value),
        });
        let bounds = view.constants.map(|motion| Motion {
            rotation: motion.rotation.map(|row| row.map(Magnitude::from)),
            translation: motion.translation.map(Magnitude::from),
        });
        let view = ClosedLoop { variables: view.variables, constants: values };
        let bounds = ClosedLoop { variables: view.variables, constants: bounds };
        EnclosedEquations { values: bilinear(&self.values, &view), bounds: bilinear(&self.bounds, &bounds) }
    }
}

/// The exact rows of a half-angle form carried over constant 2, enclosed.
fn rows<T: Floating>(
    combinations: &Combinations<T>,
    view: &ClosedLoop<Bounded<T>>,
) -> Option<[MarkedLine<Bounded<T>>; 8]> {
    let annihilators: [[Bounded<T>; SIZE]; 6] =
        corrected(&combinations.annihilators, &combinations.monomials, &left_columns(view))?;
    let back = view.constants[2].inverse();
    let free_of_last = annihilators.each_ref().map(|n| act_on_form(n, &back));
    let turning = turning(&free_of_last);
    let columns: [[Bounded<T>; 12]; 8] = std::array::from_fn(|j| std::array::from_fn(|i| turning[i][j]));
    let without_plus = corrected(&combinations.without_plus, &combinations.turning_inverse, &columns)?;
    let back = view.constants[1].inverse();
    Some(combined(&without_plus, &free_of_last).each_ref().map(|row| act_on_form(row, &back)))
}

impl EnclosedEquations {
    /// Returns the columns of the equations in f64, for kernels.
    #[must_use]
    pub fn columns(&self, hidden: Hidden) -> Columns<f64> {
        brackets::columns(&self.values, hidden)
    }

    /// Returns all zeros of the determinant in the hidden angle; `None` where they crowd or the errors hide them. A positive `blur` hides
    /// them where they are all but double, too: it is added to the errors, in parts of the largest value.
    #[must_use]
    pub fn zeros(&self, hidden: Hidden, blur: f64) -> Option<Zeros> {
        let values = self.samples(hidden);
        let largest = values.iter().map(|x| x.value.abs()).fold(0.0, f64::max);
        zeros(&values.map(|x| x.value), &values.map(|x| x.error() + blur * largest))
    }

    /// Returns whether the determinant in the hidden angle has at most as many real zeros as there are angles given, which lie near them; the
    /// errors may hide which of them are apart.
    #[must_use]
    pub fn has_no_more_zeros(&self, hidden: Hidden, angles: &[f64]) -> bool {
        let values = self.samples(hidden);
        are_no_more(&values.map(|x| x.value), &values.map(Bounded::error), angles)
    }

    /// Returns the values of the determinant at the samples of the hidden angle.
    fn samples(&self, hidden: Hidden) -> [Bounded<f64>; SAMPLES] {
        let columns = brackets::columns(&self.bounded(), hidden);
        samples().map(|(cos, sin)| {
            let [cos, sin] = [cos, sin].map(|x| Bounded::new(x, SAMPLE_ERROR));
            brackets::determinant(&brackets::at(&columns, &cos, &sin))
        })
    }

    fn bounded(&self) -> Bilinear<Bounded<f64>> {
        let bounded =
            |e: usize, k1: usize, k2: usize| Bounded::new(self.values[e][k1][k2], self.bounds[e][k1][k2].error());
        std::array::from_fn(|e| std::array::from_fn(|k1| std::array::from_fn(|k2| bounded(e, k1, k2))))
    }
}
