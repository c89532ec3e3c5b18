//! The cycles of a group as real linear equations in cosines and sines, and what a combination of them says about a box.

use super::arc::{Arc, MOST_ROWS, ROUNDING, Wave};
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use crate::linkage::equations::Equations;
use crate::linkage::isotropic::middle;
use crate::linkage::state::Number;
use num_complex::Complex;

/// Combinations whose size is beyond these bounds are left out: nothing in them over- or underflows.
const SIZES: std::ops::Range<f64> = 1e-100..1e100;
/// A coefficient below this part of the largest one counts as none in the choice of short cycles.
const NEGLIGIBLE: f64 = 1e-12;

/// The equations `k_i + sum_j (a_ij cos + b_ij sin) = 0`: real and imaginary parts of the cycles.
#[derive(Clone, Debug)]
pub struct Forms {
    /// The class that rests.
    pub rest: usize,
    /// The classes that turn, by whose angles the arcs of a box are numbered.
    pub moving: Vec<usize>,
    /// The coefficients row by row, with bounds of their absolute values.
    waves: Vec<Vec<Wave>>,
    constants: Vec<Wave>,
}

/// What is left of a box.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Nothing: it is proved to hold no solution.
    Nothing,
    /// All or part of it.
    Something,
}

/// Memory of one combination, used again and again.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    waves: Vec<Wave>,
    ranges: Vec<[f64; 2]>,
}

/// A cycle in f64, with bounds of the errors of its coefficients.
type Cycle = Vec<(Complex<f64>, f64)>;

fn terms(cycle: &[Disc], largest: f64) -> usize {
    cycle.iter().filter(|disc| middle(disc).norm() > NEGLIGIBLE * largest).count()
}

/// Sums and differences of cycles are cycles: those with fewer terms take the place of others.
fn shortened(mut cycles: Vec<Vec<Disc>>, largest: f64) -> Vec<Vec<Disc>> {
    loop {
        let mut is_shorter = false;
        for i in 0..cycles.len() {
            for k in (0..cycles.len()).filter(|k| *k != i) {
                for sign in [false, true] {
                    let join = |(a, b): (&Disc, &Disc)| if sign { a.sub(b) } else { a.add(b) };
                    let new: Vec<Disc> = cycles[i].iter().zip(&cycles[k]).map(join).collect();
                    if terms(&new, largest) < terms(&cycles[i], largest) {
                        cycles[i] = new;
                        is_shorter = true;
                        break;
                    }
                }
            }
        }
        // Every change takes terms away, so that the changes end.
        if !is_shorter {
            return cycles;
        }
    }
}

impl Forms {
    /// The equations of a group without slides, with the class that has the most of them at rest; `None` for other groups,
    /// and for those beyond [`MOST_ROWS`].
    #[must_use]
    pub fn new(equations: &Equations<Number>) -> Option<Self> {
        let rows = 2 * equations.loops();
        if !equations.slides.is_empty() || equations.classes != rows + 1 || rows > MOST_ROWS {
            return None;
        }
        let own = |cycle: &Vec<Number>| cycle.iter().map(|n| n.z.disc.clone()).collect::<Vec<Disc>>();
        let cycles: Vec<Vec<Disc>> = equations.cycles.iter().map(own).collect();
        let size = |disc: &Disc| middle(disc).norm();
        let largest = cycles.iter().flatten().map(size).fold(0.0, f64::max);
        if !(largest.is_normal()) {
            return None;
        }
        let cycles = shortened(cycles, largest);
        // Numbers near 1: a power of two, by which products are exact.
        let unit = (-largest.log2().floor()).exp2();
        if !unit.is_normal() {
            return None;
        }
        let float = |disc: &Disc| {
            let z = middle(disc);
            // Rounding of the middle is below 2^-52 of its size; the disc is added as that part of a larger size.
            let size = z.l1_norm() + (disc.radius().to_f64() * 2.0_f64.powi(53)) + f64::MIN_POSITIVE;
            (z * unit, size * unit * (1.0 + ROUNDING))
        };
        let cycles: Vec<Cycle> = cycles.iter().map(|cycle| cycle.iter().map(float).collect()).collect();
        let whole = |class: usize| cycles.iter().map(|cycle| cycle[class].0.norm()).sum::<f64>();
        let rest = (0..equations.classes).max_by(|a, b| whole(*a).total_cmp(&whole(*b)))?;
        let moving: Vec<usize> = (0..equations.classes).filter(|class| *class != rest).collect();
        let mut forms = Self { rest, moving, waves: Vec::new(), constants: Vec::new() };
        for cycle in &cycles {
            for half in 0..2 {
                let wave = |class: &usize| {
                    let (z, size) = cycle[*class];
                    if half == 0 { Wave { u: z.re, v: -z.im, size } } else { Wave { u: z.im, v: z.re, size } }
                };
                forms.waves.push(forms.moving.iter().map(wave).collect());
                forms.constants.push(wave(&rest));
            }
        }
        Some(forms)
    }

    /// Number of equations, which is that of the angles.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.waves.len()
    }

    /// The coefficients of an equation.
    #[must_use]
    pub fn row(&self, row: usize) -> &[Wave] {
        &self.waves[row]
    }

    /// The constant term of an equation.
    #[must_use]
    pub fn constant(&self, row: usize) -> f64 {
        self.constants[row].u
    }

    /// The sum of the coefficients of an angle in all cycles: how much its change moves.
    #[must_use]
    pub fn weight(&self, angle: usize) -> f64 {
        self.waves.iter().step_by(2).map(|row| row[angle].u.hypot(row[angle].v)).sum()
    }

    /// The sum of the equations with factors: a wave of every angle, and the constant term with its size.
    fn combined(&self, factors: &[f64], waves: &mut Vec<Wave>) -> [f64; 2] {
        waves.clear();
        waves.resize(self.moving.len(), Wave::default());
        let [mut constant, mut size] = [0.0; 2];
        for ((factor, row), own) in factors.iter().zip(&self.waves).zip(&self.constants) {
            if *factor == 0.0 {
                continue;
            }
            constant += factor * own.u;
            size += factor.abs() * own.size;
            for (sum, wave) in waves.iter_mut().zip(row) {
                sum.u += factor * wave.u;
                sum.v += factor * wave.v;
                sum.size += factor.abs() * wave.size;
            }
        }
        [constant, size]
    }

    /// Removes from a box what a combination of the equations excludes: the wave of every angle is minus the sum of all others.
    ///
    /// Parts of an arc below the part `gain` are left.
    pub fn narrow(&self, factors: &[f64], arcs: &mut [Arc], gain: f64, scratch: &mut Scratch) -> Left {
        let Scratch { waves, ranges } = scratch;
        let [constant, size] = self.combined(factors, waves);
        let [mut lo, mut hi, mut total] = [constant, constant, size];
        ranges.clear();
        for (arc, wave) in arcs.iter().zip(waves.iter()) {
            let range = arc.range(wave);
            lo += range[0];
            hi += range[1];
            total += wave.size;
            ranges.push(range);
        }
        // Numbers that are none lie in no range.
        if !SIZES.contains(&total) {
            return Left::Something;
        }
        let slack = ROUNDING * total;
        if lo > slack || hi < -slack {
            return Left::Nothing;
        }
        for ((arc, wave), [least, largest]) in arcs.iter_mut().zip(waves.iter()).zip(ranges.iter()) {
            let [top, bottom] = [slack - (lo - least), -slack - (hi - largest)];
            let above = *largest > top && !arc.trim_above(wave, top, gain);
            if above || (*least < bottom && !arc.trim_below(wave, bottom, gain)) {
                return Left::Nothing;
            }
        }
        Left::Something
    }

    /// Whether a box is proved to hold at most one solution, by factors of the equations for every angle.
    ///
    /// For two solutions in the box, the factors R and the mean M of the derivative between them, `R M (x - y) = 0`. The
    /// entries of R M are means of waves over arcs; where `|I - R M| < 1` in the norm that measures every angle by the width
    /// of its arc, R M is regular and x = y.
    #[must_use]
    pub fn is_single<'f>(
        &self,
        factors: impl Iterator<Item = Option<&'f [f64]>>,
        arcs: &[Arc],
        scratch: &mut Scratch,
    ) -> bool {
        let waves = &mut scratch.waves;
        // Widths may be any positive numbers; arcs that are points have none.
        let width = |arc: &Arc| arc.width().max(1e-14);
        for (k, factors) in factors.enumerate() {
            let Some(factors) = factors else { return false };
            self.combined(factors, waves);
            let mut sum = 0.0;
            for (j, (arc, wave)) in arcs.iter().zip(waves.iter()).enumerate() {
                let unit = f64::from(j == k);
                let [lo, hi] = arc.range(&wave.derivative());
                sum += ((lo - unit).abs().max((hi - unit).abs()) + 2.0 * ROUNDING * wave.size) * width(arc);
            }
            // A hundredth is more than the rounding of this sum.
            if !(sum < 0.99 * width(&arcs[k])) {
                return false;
            }
        }
        true
    }
}
