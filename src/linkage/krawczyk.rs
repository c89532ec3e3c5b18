//! Newton's method on the equations of a group, and the proof that exactly one solution is near.
//!
//! The unknowns are the relative changes e of the rotations and the changes of the slides. With an approximate inverse R of the
//! derivative F' at the middle, `|R F(0)| <= y` and `|I - R F'(e)| <= q < 1` for all e of size at most r, exactly one solution
//! lies in that ball where `y <= (1 - q) r`, at most `y/(1 - q)` from the middle. \[Krawczyk1969\] The numbers of the equations
//! are discs: the proof holds for all numbers in them.

use super::equations::Equations;
use super::isotropic::{BITS, Isotropic, Value, middle};
use super::quadratic::Root;
use super::state::Number;
use crate::algebra::disc::Disc;
use crate::algebra::ring::Ring;
use nalgebra::DMatrix;
use num_complex::Complex;
use rug::Float;

/// Largest number of steps of Newton's method: a start that needs more is dropped.
const STEPS: usize = 60;
/// The derivative is taken anew while steps are larger than this.
const NEAR: f64 = 1e-8;
/// Steps below this end the iteration: the last bits of discs are 1e-154.
const SETTLED: f64 = 1e-140;
/// Balls in which the derivative is bounded, the largest first.
const BALLS: [f64; 4] = [1e-4, 1e-8, 1e-16, 1e-40];
/// Room for the roundings of sums of bounds in f64.
const MARGIN: f64 = 1.000_001;

/// A solution that is proved to exist, and to be the only one near.
#[derive(Clone, Debug)]
pub struct Proved {
    /// Discs that hold it.
    pub root: Root,
    /// Whether it is real; `None` where that is undecided. It is meaningful for equations with real data.
    pub real: Option<bool>,
}

/// Approximations of the unknowns.
struct Point {
    turns: Vec<Disc>,
    shifts: Vec<Disc>,
}

fn point(z: Complex<f64>) -> Disc {
    Disc::point(Float::with_val(BITS, z.re), Float::with_val(BITS, z.im))
}

fn zero() -> Disc {
    Disc::point(Float::new(BITS), Float::new(BITS))
}

fn centre(disc: &Disc) -> Disc {
    Disc::point(disc.re.clone(), disc.im.clone())
}

/// The equations with one class at rest.
struct System<'a> {
    equations: &'a Equations<Number>,
    /// The classes that turn.
    moving: Vec<usize>,
}

impl System<'_> {
    fn size(&self) -> usize {
        2 * self.equations.loops()
    }

    /// The value at a point: first halves, then second ones.
    fn value(&self, at: &Point, inverses: &[Disc]) -> Vec<Disc> {
        let cycles = &self.equations.cycles;
        let mut values = Vec::with_capacity(self.size());
        for half in 0..2 {
            for (k, cycle) in cycles.iter().enumerate() {
                let turns = if half == 0 { &at.turns } else { inverses };
                let of = |n: &Number| if half == 0 { n.z.disc.clone() } else { n.w.disc.clone() };
                let mut sum = Disc::zero();
                for (factor, turn) in cycle.iter().zip(turns) {
                    sum = sum.add(&of(factor).mul(turn));
                }
                for (slide, shift) in self.equations.slides.iter().zip(&at.shifts) {
                    sum = sum.add(&of(&slide.coefficients[k]).mul(&turns[slide.class]).mul(shift));
                }
                values.push(sum);
            }
        }
        values
    }

    /// The derivative by the relative changes of rotations and the changes of slides.
    fn derivative(&self, at: &Point, inverses: &[Disc]) -> Vec<Vec<Disc>> {
        let mut rows = Vec::with_capacity(self.size());
        for half in 0..2 {
            for (k, cycle) in self.equations.cycles.iter().enumerate() {
                let turns = if half == 0 { &at.turns } else { inverses };
                let of = |n: &Number| if half == 0 { n.z.disc.clone() } else { n.w.disc.clone() };
                let mut row = Vec::with_capacity(self.size());
                for class in &self.moving {
                    let mut term = of(&cycle[*class]).mul(&turns[*class]);
                    for (slide, shift) in self.equations.slides.iter().zip(&at.shifts) {
                        if slide.class == *class {
                            term = term.add(&of(&slide.coefficients[k]).mul(&turns[*class]).mul(shift));
                        }
                    }
                    row.push(if half == 0 { term } else { term.neg() });
                }
                for slide in &self.equations.slides {
                    row.push(of(&slide.coefficients[k]).mul(&turns[slide.class]));
                }
                rows.push(row);
            }
        }
        rows
    }

    /// The point moved by relative changes of rotations and changes of slides.
    fn moved(&self, at: &Point, by: &[Disc]) -> Point {
        let mut turns = at.turns.clone();
        for (class, change) in self.moving.iter().zip(by) {
            turns[*class] = turns[*class].mul(&Disc::one().add(change));
        }
        let shifts = at.shifts.iter().zip(&by[self.moving.len()..]).map(|(shift, change)| shift.add(change)).collect();
        Point { turns, shifts }
    }
}

fn inverses(turns: &[Disc]) -> Option<Vec<Disc>> {
    turns.iter().map(Disc::inverse).collect()
}

/// The derivative at the middle of a point, inverted.
fn approximate_inverse(system: &System<'_>, at: &Point, back: &[Disc]) -> Option<DMatrix<Complex<f64>>> {
    let derivative = system.derivative(at, back);
    let size = system.size();
    if derivative.iter().any(|row| row.len() != size) {
        return None;
    }
    let matrix = DMatrix::from_fn(size, size, |i, j| middle(&derivative[i][j]));
    matrix.try_inverse().filter(|inverse| inverse.iter().all(|z| z.re.is_finite() && z.im.is_finite()))
}

/// Improves approximations of the rotations of all classes, that of `rest` being 1, and of the slides, and proves that
/// one solution is there; `None` where that does not succeed.
#[must_use]
pub fn prove(
    equations: &Equations<Number>,
    rest: usize,
    turns: &[Complex<f64>],
    shifts: &[Complex<f64>],
) -> Option<Proved> {
    let moving = (0..equations.classes).filter(|class| *class != rest).collect();
    let system = System { equations, moving };
    let mut at = Point {
        turns: turns.iter().copied().map(point).collect(),
        shifts: shifts.iter().copied().map(point).collect(),
    };
    // In full precision, so that its inverse has that, too.
    at.turns[rest] = point(Complex::new(1.0, 0.0));
    let mut known: Option<DMatrix<Complex<f64>>> = None;
    let mut last = f64::INFINITY;
    for _ in 0..STEPS {
        let back = inverses(&at.turns)?;
        let value = system.value(&at, &back);
        let inverse = match known.take().filter(|_| last < NEAR) {
            Some(inverse) => inverse,
            None => approximate_inverse(&system, &at, &back)?,
        };
        let step = &inverse * DMatrix::from_fn(system.size(), 1, |i, _| middle(&value[i]));
        let size = step.iter().take(system.moving.len()).map(|z| z.norm()).fold(0.0, f64::max);
        let whole = step.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if !whole.is_finite() {
            return None;
        }
        // No rotation changes by more than half of itself in a step.
        let damped = if size > 0.5 { 0.5 / size } else { 1.0 };
        let by: Vec<Disc> = step.iter().map(|z| point(-z * damped)).collect();
        at = system.moved(&at, &by);
        at.turns = at.turns.iter().map(centre).collect();
        at.shifts = at.shifts.iter().map(centre).collect();
        known = Some(inverse);
        // Where the data are rounded, steps end at the size of their discs.
        let stands = whole < NEAR && whole >= 0.25 * last;
        last = whole;
        if whole < SETTLED || stands {
            break;
        }
    }
    if !(last < NEAR) {
        return None;
    }
    let back = inverses(&at.turns)?;
    let inverse = approximate_inverse(&system, &at, &back)?;
    let value = system.value(&at, &back);
    let size = system.size();
    let inverse: Vec<Vec<Disc>> = (0..size).map(|i| (0..size).map(|j| point(inverse[(i, j)])).collect()).collect();
    let product =
        |row: &[Disc], column: &[Disc]| row.iter().zip(column).fold(Disc::zero(), |sum, (x, y)| sum.add(&x.mul(y)));
    let step = inverse.iter().map(|row| product(row, &value).at_most().to_f64()).fold(0.0, f64::max) * MARGIN;
    let (ball, off) = BALLS.into_iter().find_map(|ball| {
        let change = zero().widened(&Float::with_val(64, ball));
        let wide = system.moved(&at, &vec![change; size]);
        let derivative = system.derivative(&wide, &inverses(&wide.turns)?);
        let mut worst = 0.0_f64;
        for (i, row) in inverse.iter().enumerate() {
            let mut sum = 0.0;
            for j in 0..size {
                let column: Vec<Disc> = derivative.iter().map(|row| row[j].clone()).collect();
                let entry = product(row, &column);
                let entry = if i == j { Disc::one().sub(&entry) } else { entry };
                sum += entry.at_most().to_f64();
            }
            worst = worst.max(sum * MARGIN);
        }
        // The derivative is by the change of the moved rotation, which is 1 + e times the one at the middle.
        let worst = (worst + ball) / (1.0 - ball) * MARGIN;
        (worst < 0.5 && step * 4.0 < ball).then_some((ball, worst))
    })?;
    let radius = step / (1.0 - off) * MARGIN + f64::MIN_POSITIVE;
    let change = zero().widened(&Float::with_val(64, radius));
    let found = system.moved(&at, &vec![change; size]);
    let back = inverses(&found.turns)?;
    // The mirror image of a solution is a solution: where it lies in the same ball, it is the same one.
    let off_circle = |turn: &Disc| (middle_square(turn) - 1.0).abs();
    let turned = at.turns.iter().map(off_circle).fold(0.0, f64::max);
    let shifted = at.shifts.iter().map(|shift| 2.0 * shift.im.to_f64().abs()).fold(0.0, f64::max);
    let mirror = |turn: &Disc, back: &Disc| turn.sub(&conjugate(back)).is_not_zero();
    let real = if turned.max(shifted) + 4.0 * radius < 0.25 * ball {
        Some(true)
    } else if found.turns.iter().zip(&back).any(|(turn, back)| mirror(turn, back))
        || found.shifts.iter().any(|shift| shift.sub(&conjugate(shift)).is_not_zero())
    {
        Some(false)
    } else {
        None
    };
    let turns = found.turns.into_iter().zip(back).map(|(z, w)| Isotropic { z: Value::within(z), w: Value::within(w) });
    let shifts = found.shifts.into_iter().map(|s| Isotropic { z: Value::within(s.clone()), w: Value::within(s) });
    let root = Root { turns: turns.collect(), shifts: shifts.collect(), multiplicity: 1 };
    Some(Proved { root, real })
}

/// The square of the absolute value of a middle, to more digits than f64 has before it is rounded.
fn middle_square(disc: &Disc) -> f64 {
    let square = Float::with_val(BITS, disc.re.square_ref()) + Float::with_val(BITS, disc.im.square_ref());
    let off = square - 1_u32;
    1.0 + off.to_f64()
}

/// The conjugates of the numbers of a disc.
#[must_use]
pub fn conjugate(disc: &Disc) -> Disc {
    Disc::new(disc.re.clone(), Float::with_val(disc.im.prec(), -&disc.im), disc.radius())
}
