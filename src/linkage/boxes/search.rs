//! One box: narrowed, proved to hold nothing or one assembly, or divided.

use super::arc::{Arc, ROUNDING};
use super::forms::{Forms, Left, Scratch};
use super::tableau::{Side, Tableau};
use crate::algebra::elementary::sin_cos;
use crate::linkage::equations::Equations;
use crate::linkage::krawczyk::{Proved, prove};
use crate::linkage::state::Number;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;
use std::f64::consts::TAU;

/// Cuts below this part of an arc are not made: they cost more than they gain.
const GAIN: f64 = 0.01;
/// Where some arc has lost this part in a round, another round is made.
const ROUND: f64 = 0.2;
/// Where Newton's rows take less than this part from every arc, linear programs are solved.
const SLOW: f64 = 0.3;
/// Most rounds for one box: an end to those that go on in small steps.
const ROUNDS: usize = 20;
/// Boxes are divided here and not in the middle, so that no corner is at a rational part of the turn, where assemblies of special
/// data are.
const DIVISION: f64 = 0.5137;
/// Boxes with arcs below this width are left open: within the square root of [`ROUNDING`], 3e-7, of a double solution nothing
/// is decided, and dividing further is in vain.
const NARROWEST: f64 = 1e-8;
/// Only where all arcs are below this width, radians, a proof that the box has one solution at most is tried.
const LOCAL: f64 = 1.0;
/// Steps of Newton's method: from where it converges at all, it takes fewer.
const STEPS: usize = 20;
/// The angles of a certified assembly, in f64, are within this of the true ones.
const ANGLE: f64 = 1e-9;

/// What became of a box.
#[derive(Debug)]
pub enum Fate {
    /// It holds no solution.
    Nothing,
    /// All its solutions are this one, if it has any.
    One(Box<Proved>),
    /// Its solutions are those of these two.
    Divided([Vec<Arc>; 2]),
    /// It is too narrow to be divided, and nothing is proved of it.
    Open,
}

/// The equations of a search.
#[derive(Debug)]
pub struct Search<'e> {
    equations: &'e Equations<Number>,
    forms: Forms,
    weights: Vec<f64>,
}

impl<'e> Search<'e> {
    /// A search in the equations of a group; `None` with slides.
    #[must_use]
    pub fn new(equations: &'e Equations<Number>) -> Option<Self> {
        let forms = Forms::new(equations)?;
        let weights = (0..forms.rows()).map(|angle| forms.weight(angle)).collect();
        Some(Self { equations, forms, weights })
    }

    /// The class that rests.
    #[must_use]
    pub fn rest(&self) -> usize {
        self.forms.rest
    }

    /// The box of all assemblies. Circles are cut at other places each, none of them a rational part of the turn.
    #[must_use]
    pub fn whole(&self) -> Vec<Arc> {
        let arc = |angle: usize| {
            let from = -3.0 + 0.0137 * angle as f64;
            // The ends overlap by more than the rounding of a turn.
            Arc::new(from, from + TAU + 1e-12)
        };
        (0..self.forms.rows()).map(arc).collect()
    }

    /// Narrows a box and decides on it.
    #[must_use]
    pub fn decide(&self, mut arcs: Vec<Arc>) -> Fate {
        let mut scratch = Scratch::default();
        for _ in 0..ROUNDS {
            let before: Vec<f64> = arcs.iter().map(Arc::width).collect();
            let lost = |arcs: &[Arc]| {
                1.0 - arcs.iter().zip(&before).map(|(arc, before)| arc.width() / before).fold(1.0, f64::min)
            };
            let Some(mut tableau) = Tableau::new(&self.forms, &arcs) else { break };
            for row in 0..self.forms.rows() {
                if self.forms.narrow(tableau.factors(row), &mut arcs, GAIN, &mut scratch) == Left::Nothing {
                    return Fate::Nothing;
                }
            }
            if let Some(found) = self.one(&tableau, &arcs, &mut scratch) {
                return Fate::One(Box::new(found));
            }
            if lost(&arcs) < SLOW && self.narrowed_by_programs(&mut tableau, &mut arcs, &mut scratch) == Left::Nothing {
                return Fate::Nothing;
            }
            if lost(&arcs) < ROUND {
                break;
            }
        }
        self.divided(&arcs)
    }

    /// Narrows a box by the extreme values of all sines.
    fn narrowed_by_programs(&self, tableau: &mut Tableau, arcs: &mut [Arc], scratch: &mut Scratch) -> Left {
        tableau.bound(arcs);
        let mut attained = vec![[false; 2]; arcs.len()];
        for angle in 0..arcs.len() {
            for side in [Side::Low, Side::High] {
                if attained[angle][usize::from(side == Side::High)] {
                    continue;
                }
                let Some((row, is_attained)) = tableau.extreme(angle, side) else { continue };
                if self.forms.narrow(tableau.factors(row), arcs, GAIN, scratch) == Left::Nothing {
                    return Left::Nothing;
                }
                if is_attained {
                    tableau.attained(&mut attained);
                }
                tableau.bound(arcs);
            }
        }
        Left::Something
    }

    /// The certified assembly that is the only one a box can hold, if that is proved.
    fn one(&self, tableau: &Tableau, arcs: &[Arc], scratch: &mut Scratch) -> Option<Proved> {
        let factors = || (0..arcs.len()).map(|angle| tableau.newton_factors(angle));
        if arcs.iter().any(|arc| arc.width() > LOCAL) || !self.forms.is_single(factors(), arcs, scratch) {
            return None;
        }
        let angles = self.newton(arcs)?;
        let mut turns = vec![Complex::new(1.0, 0.0); self.equations.classes];
        for (class, angle) in self.forms.moving.iter().zip(&angles) {
            turns[*class] = Complex::cis(*angle);
        }
        let proved = prove(self.equations, self.forms.rest, &turns, &[])?;
        if proved.real != Some(true) {
            return None;
        }
        // The box that holds both the arcs and the assembly has one solution at most: that assembly.
        let mut hull = Vec::with_capacity(arcs.len());
        for (class, arc) in self.forms.moving.iter().zip(arcs) {
            let angle = angle_near(&proved.root.turns[*class], arc.middle())?;
            hull.push(arc.with(angle, ANGLE));
        }
        self.forms.is_single(factors(), &hull, scratch).then_some(proved)
    }

    /// Newton's method from the middle of a box.
    fn newton(&self, arcs: &[Arc]) -> Option<Vec<f64>> {
        let rows = self.forms.rows();
        let mut angles: Vec<f64> = arcs.iter().map(Arc::middle).collect();
        for _ in 0..STEPS {
            let points: Vec<(f64, f64)> = angles.iter().map(|angle| angle.sin_cos()).collect();
            let value = DVector::from_fn(rows, |i, _| {
                let terms = self.forms.row(i).iter().zip(&points).map(|(wave, (sin, cos))| wave.u * cos + wave.v * sin);
                terms.fold(self.forms.constant(i), |sum, term| sum + term)
            });
            let derivative = DMatrix::from_fn(rows, rows, |i, j| {
                let (wave, (sin, cos)) = (self.forms.row(i)[j], points[j]);
                wave.v * cos - wave.u * sin
            });
            let step = derivative.lu().solve(&value)?;
            let size = step.amax();
            // A step of a radian leads away.
            if !(size < 1.0) {
                return None;
            }
            for (angle, by) in angles.iter_mut().zip(step.iter()) {
                *angle -= by;
            }
            // The next step would be within rounding: Newton's method squares errors.
            if size < 1e-7 {
                return Some(angles);
            }
        }
        None
    }

    /// The two parts of a box; open if it is too narrow. The arc is divided that is widest when measured by the coefficients of
    /// its angle: bodies of many joints come before bars, which follow from them.
    fn divided(&self, arcs: &[Arc]) -> Fate {
        let measure = |angle: usize| arcs[angle].width() * self.weights[angle];
        let wide = (0..arcs.len()).filter(|angle| arcs[*angle].width() > NARROWEST);
        let Some(angle) = wide.max_by(|a, b| measure(*a).total_cmp(&measure(*b))) else { return Fate::Open };
        let parts = arcs[angle].split(arcs[angle].lo() + DIVISION * arcs[angle].width());
        Fate::Divided(parts.map(|part| {
            let mut own = arcs.to_vec();
            own[angle] = part;
            own
        }))
    }
}

/// An angle within [`ANGLE`] of that of a rotation, of those a turn apart the one nearest to another angle; `None` where
/// that is not proved.
fn angle_near(turn: &Number, near: f64) -> Option<f64> {
    let z = turn.z.middle();
    let angle = z.im.atan2(z.re);
    let (sin, cos) = sin_cos(angle);
    // Of two points of the circle closer than 1e-10 the angles differ by less than twice that. The disc is smaller still.
    let is_near = (z.re - cos).abs() + (z.im - sin).abs() < 1e-10 && *turn.z.disc.radius() < ROUNDING;
    is_near.then(|| angle + TAU * ((near - angle) / TAU).round())
}
