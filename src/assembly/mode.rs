//! What is found: modes, and the list of them.

use crate::certify::Certificate;
use crate::kinematics::closed_loop::Variable;
use crate::solve::newton::Six;
use crate::solve::self_motion::SelfMotion;
use num_complex::Complex;
use std::f64::consts::{PI, TAU};

/// Which roots are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Roots {
    /// Every complex root polished and certified: what completeness needs.
    All,
    /// Real roots only: faster, without a proof that none is missing.
    Real,
}

/// One way to assemble the loop.
#[derive(Clone, Debug, PartialEq)]
pub struct Mode {
    /// The six unknowns in loop order; angles in (-pi, pi], lengths in the unit of the mechanism.
    pub unknowns: Six<Complex<f64>>,
    /// Whether all unknowns are real.
    pub real: bool,
    /// How many solutions coincide here; 0 where that is not known.
    pub multiplicity: usize,
    /// Largest entry of |E - I| of the closure E over the size of what cancels in it, see
    /// [`relative_defect`](crate::solve::newton::Closure::relative_defect).
    pub residual: f64,
    /// Row-sum condition number of the Jacobian, lengths over the scale of the mechanism.
    pub condition: f64,
    /// The proof, if there is one. Radii hold for angles in radians and for lengths in the unit of the mechanism.
    pub certificate: Option<Certificate>,
    /// How often it was found.
    pub hits: Hits,
}

/// How often a mode was found by the roots of one pencil.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hits {
    pencil: usize,
    here: usize,
    /// The most of all pencils.
    pub most: usize,
}

impl Hits {
    /// Found for the first time, in this pencil.
    #[must_use]
    pub fn first(pencil: usize) -> Self {
        Self { pencil, here: 1, most: 1 }
    }

    /// Found again.
    #[must_use]
    pub fn again(self, other: Self) -> Self {
        let here = if self.pencil == other.pencil { self.here + other.here } else { other.here };
        Self { pencil: other.pencil, here, most: self.most.max(here) }
    }
}

/// What was found at one pose or input.
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
    /// How many pencils were solved.
    pub tries: usize,
    /// How many modes were found or proved in multiprecision arithmetic only.
    pub by_high_precision: usize,
    /// The bits of these numbers.
    pub high_precision_bits: u32,
}

impl Assembly {
    /// Forgets what was found.
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

    /// Takes in modes proved in more digits: those not known are added, and where all of the `expected` ones are proved
    /// then, what could not be proved is left out as none.
    pub(super) fn complete_with(&mut self, modes: Vec<Mode>, variables: &[Variable; 6], expected: usize, bits: u32) {
        let proved = |modes: &[Mode]| modes.iter().filter(|m| m.certificate.is_some()).count();
        let before = proved(&self.modes);
        let mut all = modes;
        for mode in self.modes.drain(..) {
            let same = |other: &&mut Mode| !are_apart(variables, other, &mode);
            match all.iter_mut().find(same) {
                // What f64 proves already stays as it is.
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

/// Whether one unknown at least differs by more than both modes are off. Those without certificate count as exact.
#[must_use]
pub fn are_apart(variables: &[Variable; 6], one: &Mode, two: &Mode) -> bool {
    let off = |mode: &Mode, k: usize| {
        let rounding = 4.0 * f64::EPSILON * mode.unknowns[k].norm().max(1.0);
        mode.certificate.map_or(0.0, |c| c.proved + rounding)
    };
    let apart = |k: usize| difference(variables[k], one.unknowns[k] - two.unknowns[k]) > off(one, k) + off(two, k);
    (0..6).any(apart)
}

/// An angle in (-pi, pi].
#[must_use]
pub fn wrapped(angle: f64) -> f64 {
    // The remainder of what is smaller is itself.
    let mut x = if angle.abs() < TAU { angle } else { angle % TAU };
    if x > PI {
        x -= TAU;
    } else if x <= -PI {
        x += TAU;
    }
    x
}

/// The largest difference of two unknowns, angles modulo 2 pi.
#[must_use]
pub fn distance(variables: &[Variable; 6], a: &Six<Complex<f64>>, b: &Six<Complex<f64>>) -> f64 {
    (0..6).map(|k| difference(variables[k], a[k] - b[k])).fold(0.0, f64::max)
}

/// The size of a difference, of angles modulo 2 pi.
fn difference(variable: Variable, z: Complex<f64>) -> f64 {
    let re = if variable == Variable::Rotation { wrapped(z.re) } else { z.re };
    re.abs().max(z.im.abs())
}
