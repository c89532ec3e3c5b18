//! An assembly mode, and the list of them at one pose.

use crate::certify::Certificate;
use crate::kinematics::closed_loop::Variable;
use crate::solve::newton::Six;
use crate::solve::self_motion::SelfMotion;
use num_complex::Complex;
use std::f64::consts::{PI, TAU};

/// The roots that are requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roots {
    /// Every complex root is polished and certified, as completeness requires.
    All,
    /// Only real roots are computed: faster, but without a proof that none is missing.
    Real,
}

/// One assembly mode of the loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// The six unknowns in loop order; angles in (-pi, pi], lengths in the unit of the mechanism.
    pub unknowns: Six<Complex<f64>>,
    /// Whether all unknowns are real.
    pub real: bool,
    /// The number of solutions that coincide here; 0 if it is not known.
    pub multiplicity: usize,
    /// Largest entry of |E - I| of the closure E over the size of the terms that cancel in it, see
    /// [`relative_defect`](crate::solve::newton::Closure::relative_defect).
    pub residual: f64,
    /// Row-sum condition number of the Jacobian, lengths over the scale of the mechanism.
    pub condition: f64,
    /// The certificate, if there is one. Its radius holds for angles in radians and for lengths in the unit of the mechanism.
    pub certificate: Option<Certificate>,
    /// The number of times it was found.
    pub hits: Hits,
}

impl Mode {
    /// Returns the solution with the conjugate numbers.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        Self { unknowns: self.unknowns.map(|z| z.conj()), ..self.clone() }
    }
}

/// The number of times a mode was found by the roots of one pencil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hits {
    pencil: usize,
    here: usize,
    /// The maximum over all pencils.
    pub most: usize,
}

impl Hits {
    /// Counts the first hit, in this pencil.
    #[must_use]
    pub fn first(pencil: usize) -> Self {
        Self { pencil, here: 1, most: 1 }
    }

    /// Adds another hit.
    #[must_use]
    pub fn again(self, other: Self) -> Self {
        let here = if self.pencil == other.pencil { self.here + other.here } else { other.here };
        Self { pencil: other.pencil, here, most: self.most.max(here) }
    }
}

/// The assembly modes and self-motions found at one pose or input.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// Isolated solutions, real ones first.
    pub modes: Vec<Mode>,
    /// Dimension of the self-motion, 0 if there is none.
    pub self_motion: usize,
    /// The self-motions, lengths in the unit of the mechanism.
    pub families: Vec<SelfMotion>,
    /// Whether some cut gave a pencil whose every root was resolved.
    pub all_resolved: bool,
    /// Whether some cut gave a pencil whose every root near the real axis was resolved, and one root at least led
    /// to a solution.
    pub real_resolved: bool,
    /// Number of pencils solved; solutions found by zeros of a determinant or closed forms take none.
    pub tries: usize,
    /// Number of modes found or proved in multiprecision arithmetic only.
    pub by_high_precision: usize,
    /// Number of bits of that arithmetic.
    pub high_precision_bits: u32,
}

impl Assembly {
    /// Removes all results.
    pub fn clear(&mut self) {
        self.modes.clear();
        self.families.clear();
        self.real_resolved = false;
        (self.self_motion, self.all_resolved, self.tries, self.by_high_precision) = (0, false, 0, 0);
    }

    /// Number of isolated solutions, with multiplicity.
    #[must_use]
    pub fn total(&self) -> usize {
        self.modes.iter().map(|m| m.multiplicity.max(1)).sum()
    }

    /// Number of isolated real solutions, with multiplicity.
    #[must_use]
    pub fn real(&self) -> usize {
        self.modes.iter().filter(|m| m.real).map(|m| m.multiplicity.max(1)).sum()
    }

    /// Merges modes proved in multiprecision: new ones are added. If all `expected` modes are then proved, modes without
    /// certificate are removed.
    pub(super) fn complete_with(&mut self, modes: Vec<Mode>, variables: &[Variable; 6], expected: usize, bits: u32) {
        let proved = |modes: &[Mode]| modes.iter().filter(|m| m.certificate.is_some()).count();
        let before = proved(&self.modes);
        let mut all = modes;
        for mode in self.modes.drain(..) {
            let same = |other: &&mut Mode| !are_apart(variables, other, &mode);
            match all.iter_mut().find(same) {
                // A mode that f64 proves already is kept.
                Some(other) if mode.certificate.is_some() && mode.real == other.real => *other = mode,
                Some(_) => {}
                None => all.push(mode),
            }
        }
        if proved(&all) >= expected {
            all.retain(|mode| mode.certificate.is_some());
            self.self_motion = 0;
        }
        let more = proved(&all).saturating_sub(before);
        if more > 0 {
            (self.by_high_precision, self.high_precision_bits) = (self.by_high_precision + more, bits);
        }
        self.modes = all;
    }
}

/// Returns whether one unknown at least differs by more than the radii of both modes. Modes without certificate count as exact.
#[must_use]
pub fn are_apart(variables: &[Variable; 6], one: &Mode, two: &Mode) -> bool {
    let off = |mode: &Mode, k: usize| {
        let rounding = 4.0 * f64::EPSILON * (mode.unknowns[k].re.abs() + mode.unknowns[k].im.abs()).max(1.0);
        mode.certificate.map_or(0.0, |c| c.proved + rounding)
    };
    let apart = |k: usize| difference(variables[k], one.unknowns[k] - two.unknowns[k]) > off(one, k) + off(two, k);
    (0..6).any(apart)
}

/// Returns whether all modes are simple, certified, and apart from each other.
#[must_use]
pub fn are_all_apart(variables: &[Variable; 6], modes: &[Mode]) -> bool {
    let is_simple = |mode: &Mode| mode.multiplicity == 1 && mode.certificate.is_some();
    (0..modes.len())
        .all(|k| is_simple(&modes[k]) && modes[..k].iter().all(|other| are_apart(variables, other, &modes[k])))
}

/// Reduces an angle to (-pi, pi].
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    // A smaller angle is its own remainder.
    let mut x = if angle.abs() < TAU { angle } else { angle % TAU };
    if x > PI {
        x -= TAU;
    } else if x <= -PI {
        x += TAU;
    }
    x
}

/// Returns the largest difference of two unknowns, angles modulo 2 pi.
#[must_use]
pub fn distance(variables: &[Variable; 6], a: &Six<Complex<f64>>, b: &Six<Complex<f64>>) -> f64 {
    (0..6).map(|k| difference(variables[k], a[k] - b[k])).fold(0.0, f64::max)
}

/// Returns the size of a difference, of angles modulo 2 pi.
fn difference(variable: Variable, z: Complex<f64>) -> f64 {
    let re = if variable == Variable::Rotation { wrapped(z.re) } else { z.re };
    re.abs().max(z.im.abs())
}
