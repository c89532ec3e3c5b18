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
use crate::algebra::long_float::DiscFloat;
use crate::algebra::ring::{Field, Ring};
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

/// Numbers in which Newton's method runs: those of the middles of discs, without radii.
type Long = Complex<DiscFloat>;

/// The unknowns: the rotations of all classes, and the slides.
struct Point<R> {
    turns: Vec<R>,
    shifts: Vec<R>,
}

/// The middle of a disc; `None` if it is not finite.
fn long(disc: &Disc) -> Option<Long> {
    Some(Complex { re: DiscFloat::of_float(&disc.re)?, im: DiscFloat::of_float(&disc.im)? })
}

fn point(z: &Long) -> Disc {
    Disc::point(z.re.to_float(), z.im.to_float())
}

/// A number in f64, which has to be finite.
fn given(z: Complex<f64>) -> Option<Long> {
    let is_finite = z.re.is_finite() && z.im.is_finite();
    is_finite.then(|| Complex { re: DiscFloat::from(z.re), im: DiscFloat::from(z.im) })
}

/// One of the two numbers that stand for a complex number and its conjugate.
fn side<R>(n: &Isotropic<R>, half: usize) -> &R {
    if half == 0 { &n.z } else { &n.w }
}

/// The equations with one class at rest.
struct System<'a, R> {
    equations: Equations<Isotropic<R>>,
    /// The classes that turn.
    moving: &'a [usize],
}

impl<'a, R: Ring> System<'a, R> {
    fn of(equations: &Equations<Number>, moving: &'a [usize], image: impl Fn(&Disc) -> Option<R>) -> Option<Self> {
        let equations = equations.map(|n| Some(Isotropic { z: image(&n.z.disc)?, w: image(&n.w.disc)? }))?;
        Some(Self { equations, moving })
    }

    fn size(&self) -> usize {
        2 * self.equations.loops()
    }

    /// The value at a point: first halves, then second ones.
    fn value(&self, at: &Point<R>, inverses: &[R]) -> Vec<R> {
        let mut values = Vec::with_capacity(self.size());
        for half in 0..2 {
            let turns = if half == 0 { &at.turns } else { inverses };
            for (k, cycle) in self.equations.cycles.iter().enumerate() {
                let mut sum = R::zero();
                for (factor, turn) in cycle.iter().zip(turns) {
                    sum = sum.add(&side(factor, half).mul(turn));
                }
                for (slide, shift) in self.equations.slides.iter().zip(&at.shifts) {
                    sum = sum.add(&side(&slide.coefficients[k], half).mul(&turns[slide.class]).mul(shift));
                }
                values.push(sum);
            }
        }
        values
    }

    /// The derivative by the relative changes of rotations and the changes of slides.
    fn derivative(&self, at: &Point<R>, inverses: &[R]) -> Vec<Vec<R>> {
        let mut rows = Vec::with_capacity(self.size());
        for half in 0..2 {
            let turns = if half == 0 { &at.turns } else { inverses };
            for (k, cycle) in self.equations.cycles.iter().enumerate() {
                let mut row = Vec::with_capacity(self.size());
                for class in self.moving {
                    let mut term = side(&cycle[*class], half).mul(&turns[*class]);
                    for (slide, shift) in self.equations.slides.iter().zip(&at.shifts) {
                        if slide.class == *class {
                            let own = side(&slide.coefficients[k], half).mul(&turns[*class]);
                            term = term.add(&own.mul(shift));
                        }
                    }
                    row.push(if half == 0 { term } else { term.neg() });
                }
                for slide in &self.equations.slides {
                    row.push(side(&slide.coefficients[k], half).mul(&turns[slide.class]));
                }
                rows.push(row);
            }
        }
        rows
    }

    /// The point moved by relative changes of rotations and changes of slides.
    fn moved(&self, at: &Point<R>, by: &[R]) -> Point<R> {
        let mut turns = at.turns.clone();
        for (class, change) in self.moving.iter().zip(by) {
            turns[*class] = turns[*class].mul(&R::one().add(change));
        }
        let shifts = at.shifts.iter().zip(&by[self.moving.len()..]).map(|(shift, change)| shift.add(change)).collect();
        Point { turns, shifts }
    }
}

fn inverses<R: Ring>(turns: &[R], inverse: impl Fn(&R) -> Option<R>) -> Option<Vec<R>> {
    turns.iter().map(inverse).collect()
}

impl System<'_, Long> {
    /// The derivative at a point, inverted.
    fn approximate_inverse(&self, at: &Point<Long>, back: &[Long]) -> Option<DMatrix<Complex<f64>>> {
        let derivative = self.derivative(at, back);
        let size = self.size();
        if derivative.iter().any(|row| row.len() != size) {
            return None;
        }
        let near = |z: &Long| Complex::new(z.re.to_f64(), z.im.to_f64());
        let matrix = DMatrix::from_fn(size, size, |i, j| near(&derivative[i][j]));
        matrix.try_inverse().filter(|inverse| inverse.iter().all(|z| z.re.is_finite() && z.im.is_finite()))
    }

    /// A solution near a point, by Newton's method, and the inverted derivative there.
    fn refined(&self, mut at: Point<Long>) -> Option<(Point<Long>, DMatrix<Complex<f64>>)> {
        let mut known: Option<DMatrix<Complex<f64>>> = None;
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let back = inverses(&at.turns, Field::inverse)?;
            let value = self.value(&at, &back);
            let inverse = match known.take().filter(|_| last < NEAR) {
                Some(inverse) => inverse,
                None => self.approximate_inverse(&at, &back)?,
            };
            let right = |i: usize, _: usize| Complex::new(value[i].re.to_f64(), value[i].im.to_f64());
            let step = &inverse * DMatrix::from_fn(self.size(), 1, right);
            let size = step.iter().take(self.moving.len()).map(|z| z.norm()).fold(0.0, f64::max);
            let whole = step.iter().map(|z| z.norm()).fold(0.0, f64::max);
            // No rotation changes by more than half of itself in a step.
            let damped = if size > 0.5 { 0.5 / size } else { 1.0 };
            let by: Vec<Long> = step.iter().map(|z| given(-z * damped)).collect::<Option<_>>()?;
            at = self.moved(&at, &by);
            known = Some(inverse);
            // Beside large slides the last bits are larger.
            let stands = whole < NEAR && whole >= 0.25 * last;
            last = whole;
            if whole < SETTLED || stands {
                break;
            }
        }
        if !(last < NEAR) {
            return None;
        }
        let back = inverses(&at.turns, Field::inverse)?;
        let inverse = self.approximate_inverse(&at, &back)?;
        Some((at, inverse))
    }
}

/// A disc in f64: its middle and its radius, with the rounding of the middle.
fn rounded(disc: &Disc) -> (Complex<f64>, f64) {
    let at = middle(disc);
    (at, disc.radius().to_f64() * MARGIN + at.l1_norm() * f64::EPSILON + f64::MIN_POSITIVE)
}

/// A bound on the product of a row of numbers and a column of discs, less `unit`.
fn bound(row: &[Complex<f64>], column: &[(Complex<f64>, f64)], unit: f64) -> f64 {
    let (mut sum, mut size, mut spread) = (Complex::new(-unit, 0.0), unit, 0.0);
    for (x, (at, radius)) in row.iter().zip(column) {
        sum += x * at;
        // Sums of the absolute values of both parts bound those of complex numbers without a root.
        size += x.l1_norm() * at.l1_norm();
        spread += x.l1_norm() * radius;
    }
    // A sum of k products suffers k + 3 roundings of half an epsilon, and numbers below the least one in f64 are lost.
    let roundings = size * f64::EPSILON * 0.5 * (column.len() + 3) as f64;
    (sum.l1_norm() + roundings + spread) * MARGIN + f64::MIN_POSITIVE
}

/// The largest of bounds; NaN is none, and stays.
fn largest(bounds: impl Iterator<Item = f64>) -> f64 {
    bounds.fold(0.0, |most: f64, x| if x > most || x.is_nan() { x } else { most })
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
    let moving: Vec<usize> = (0..equations.classes).filter(|class| *class != rest).collect();
    let all = |list: &[Complex<f64>]| list.iter().map(|z| given(*z)).collect::<Option<Vec<Long>>>();
    let mut start = Point { turns: all(turns)?, shifts: all(shifts)? };
    start.turns[rest] = Long::one();
    let (at, inverse) = System::of(equations, &moving, long)?.refined(start)?;
    let system = System::of(equations, &moving, |disc| Some(disc.clone()))?;
    let at = Point { turns: at.turns.iter().map(point).collect(), shifts: at.shifts.iter().map(point).collect() };
    let value: Vec<_> = system.value(&at, &inverses(&at.turns, Disc::inverse)?).iter().map(rounded).collect();
    let size = system.size();
    let rows: Vec<Vec<_>> = inverse.row_iter().map(|row| row.iter().copied().collect()).collect();
    let step = largest((0..size).map(|i| bound(&rows[i], &value, 0.0)));
    let zero = Disc::point(Float::new(BITS), Float::new(BITS));
    let within = |radius: f64| vec![zero.clone().widened(&Float::with_val(64, radius)); size];
    let (ball, off) = BALLS.into_iter().find_map(|ball| {
        let wide = system.moved(&at, &within(ball));
        let derivative = system.derivative(&wide, &inverses(&wide.turns, Disc::inverse)?);
        let column = |j: usize| derivative.iter().map(|row| rounded(&row[j])).collect::<Vec<_>>();
        let columns: Vec<_> = (0..size).map(column).collect();
        let worst = largest((0..size).map(|i| {
            let entry = |j: usize| bound(&rows[i], &columns[j], f64::from(u8::from(i == j)));
            (0..size).map(entry).sum::<f64>() * MARGIN
        }));
        // The derivative is by the change of the moved rotation, which is 1 + e times the one at the middle.
        let worst = (worst + ball) / (1.0 - ball) * MARGIN;
        (worst < 0.5 && step * 4.0 < ball).then_some((ball, worst))
    })?;
    let radius = step / (1.0 - off) * MARGIN + f64::MIN_POSITIVE;
    let found = system.moved(&at, &within(radius));
    let back = inverses(&found.turns, Disc::inverse)?;
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of many sizes, the same ones every time.
    fn drawn(k: u32) -> Complex<f64> {
        let part = |j: u32| f64::from(7 * k + j).sin() * 10_f64.powi(i32::try_from(k % 9).unwrap() - 4);
        Complex::new(part(1), part(3))
    }

    #[test]
    fn bounds_hold_all_products_and_little_more() {
        for k in 0..300 {
            let row: Vec<_> = (0..4).map(|j| drawn(5 * k + j)).collect();
            let width = 10_f64.powi(-i32::try_from(k % 20).unwrap());
            let point = |z: Complex<f64>| Disc::point(Float::with_val(BITS, z.re), Float::with_val(BITS, z.im));
            let middles: Vec<_> = (0..4).map(|j| drawn(11 * k + j + 2)).collect();
            let by = |column: &[Disc]| {
                row.iter().zip(column).fold(Disc::one().neg(), |sum, (x, z)| sum.add(&point(*x).mul(z)))
            };
            let column: Vec<Disc> = middles.iter().map(|z| point(*z).widened(&Float::with_val(64, width))).collect();
            let product = by(&column);
            let column: Vec<_> = column.iter().map(rounded).collect();
            let bound = bound(&row, &column, 1.0);
            for step in 0..8 {
                // Numbers on the edges of the discs.
                let edge = |j: usize| point(Complex::from_polar(width, f64::from(step) + 0.8 * j as f64));
                let some: Vec<Disc> = middles.iter().enumerate().map(|(j, z)| point(*z).add(&edge(j))).collect();
                assert!(by(&some).at_least() <= bound * 1.000_01, "{k}: {bound:e}");
            }
            let size: f64 = row.iter().zip(&column).map(|(x, (z, _))| x.norm() * z.norm()).sum();
            assert!(bound <= 4.0 * product.at_most().to_f64() + 1e-14 * size, "{k}: {bound:e}");
        }
    }

    #[test]
    fn what_is_no_number_is_no_bound() {
        let infinite = (Complex::new(f64::INFINITY, 0.0), 0.0);
        let zero = Complex::new(0.0, 0.0);
        assert!(!(largest([1.0, bound(&[zero], &[infinite], 0.0), 2.0].into_iter()) < f64::INFINITY));
        assert!(given(Complex::new(f64::NAN, 0.0)).is_none());
    }
}
