//! Krawczyk's theorem: as many equations as unknowns have exactly one solution near given values.
//!
//! For a matrix A and a box of radius r about c, `|A f(c)| + |I - A f'(box)| r < r` proves that f has exactly one zero in
//! the box, complex ones counted. \[Krawczyk1969\]

use super::cells::Place;
use super::equations::Wanted;
use super::linear::solved;
use crate::algebra::disc::Disc;
use crate::algebra::long_float::LongFloat;
use crate::algebra::ring::{Field, Ring};
use crate::mechanism::exact_loop::roots::long;
use num_complex::Complex;
use rug::{Float, Rational};

/// Bits of centres.
pub(crate) const BITS: u32 = 512;
/// The radius of a box over the size of its centre is two to the power of minus this: far below an f64's rounding, and far above
/// that of the centres.
const RADIUS_BITS: u32 = 160;
/// Newton steps that bring the accuracy of eigenvectors to that of the centres, if they are worth anything.
const STEPS: usize = 4;

/// A solution that is proved to be in a box.
#[derive(Clone, Debug)]
pub(super) struct Certified {
    /// The unknowns: those of the fixed part first, then three coordinates of the moving point.
    boxes: Vec<Disc>,
    /// The number of unknown directions: 1 if the fixed part is a plane.
    directions: usize,
    /// Whether it is real.
    pub is_real: bool,
}

fn zero() -> Disc {
    Disc::point(Float::new(BITS), Float::new(BITS))
}

/// The centre of a disc.
pub(crate) fn centre(disc: &Disc) -> Disc {
    Disc::point(Float::with_val(BITS, &disc.re), Float::with_val(BITS, &disc.im))
}

/// As many equations as unknowns.
pub(crate) trait Square {
    /// Returns the values.
    fn values(&self, unknowns: &[Disc]) -> Vec<Disc>;

    /// Returns the derivatives, column by column.
    fn slopes(&self, unknowns: &[Disc]) -> Vec<Vec<Disc>>;

    /// Returns the rows of an approximate inverse of the derivatives.
    fn inverse(&self, unknowns: &[Disc]) -> Option<Vec<Vec<Disc>>> {
        let columns = self.slopes(unknowns);
        let size = unknowns.len();
        let row = |i: usize| {
            let unit = (0..size).map(|j| if i == j { Disc::one() } else { zero() });
            columns.iter().map(|column| column[i].clone()).chain(unit).collect()
        };
        let inverse = solved((0..size).map(row).collect())?;
        Some(inverse.into_iter().map(|row| row.iter().map(centre).collect()).collect())
    }

    /// Returns a point brought near a solution by Newton's method.
    fn refined(&self, mut unknowns: Vec<Disc>) -> Option<Vec<Disc>> {
        for _ in 0..STEPS {
            let inverse = self.inverse(&unknowns)?;
            let values = self.values(&unknowns);
            unknowns = unknowns.iter().zip(&inverse).map(|(z, row)| centre(&z.sub(&dot(row, &values)))).collect();
        }
        Some(unknowns)
    }

    /// Returns a box about a point that holds exactly one solution, and whether that is real, for equations with real coefficients;
    /// `None` where that is not shown.
    fn certified(&self, mut unknowns: Vec<Disc>) -> Option<(Vec<Disc>, bool)> {
        let largest = unknowns.iter().map(Disc::at_most).fold(Float::with_val(64, 1), |x, y| if y > x { y } else { x });
        let radius = largest >> RADIUS_BITS;
        let is_real = unknowns.iter().all(|z| *z.im.as_abs() <= radius);
        if is_real {
            // The conjugate of a zero in a box about a real point is a zero in it: they are one.
            unknowns = unknowns.iter().map(|z| Disc::point(z.re.clone(), Float::new(BITS))).collect();
        }
        let inverse = self.inverse(&unknowns)?;
        let values = self.values(&unknowns);
        let boxes: Vec<Disc> = unknowns.iter().map(|z| z.clone().widened(&radius)).collect();
        let columns = self.slopes(&boxes);
        for (i, row) in inverse.iter().enumerate() {
            let mut reach = dot(row, &values).at_most();
            for (k, column) in columns.iter().enumerate() {
                let unit = if i == k { Disc::one() } else { zero() };
                let off = unit.sub(&dot(row, column)).at_most();
                // Rounded to nearest; the sum is compared with half the radius, which is far more than all roundings.
                reach += Float::with_val(64, off * &radius);
            }
            if !(reach < Float::with_val(64, &radius * &Float::with_val(64, Rational::from((1, 2))))) {
                return None;
            }
        }
        let is_complex = unknowns.iter().any(|z| *z.im.as_abs() > Float::with_val(64, &radius * 2_u32));
        if !is_real && !is_complex {
            return None;
        }
        Some((boxes, is_real))
    }
}

/// The equations at a point, with one more that fixes the scale of a direction.
struct System<'a> {
    wanted: &'a Wanted,
    directions: usize,
    /// The component of the direction that is 1.
    chart: usize,
}

impl Square for System<'_> {
    fn values(&self, unknowns: &[Disc]) -> Vec<Disc> {
        let mut values = self.wanted.equations(&place(unknowns, self.directions));
        if self.directions > 0 {
            values.push(unknowns[self.chart].sub(&Disc::one()));
        }
        values
    }

    /// The derivatives, column by column: differences, as the equations are linear in either half of the unknowns.
    fn slopes(&self, unknowns: &[Disc]) -> Vec<Vec<Disc>> {
        let half = unknowns.len() / 2;
        let column = |k: usize| {
            let with = |value: Disc| {
                let mut at = unknowns.to_vec();
                for z in if k < half { &mut at[..half] } else { &mut at[half..] } {
                    *z = zero();
                }
                at[k] = value;
                self.values(&at)
            };
            with(Disc::one()).iter().zip(&with(zero())).map(|(x, y)| x.sub(y)).collect()
        };
        (0..unknowns.len()).map(column).collect()
    }
}

fn place(unknowns: &[Disc], directions: usize) -> Place<Disc> {
    if directions == 0 {
        return Place { directions: Vec::new(), numbers: unknowns.to_vec() };
    }
    let (direction, numbers) = unknowns.split_at(3);
    Place { directions: vec![direction.to_vec()], numbers: numbers.to_vec() }
}

fn dot(x: &[Disc], y: &[Disc]) -> Disc {
    x.iter().zip(y).fold(zero(), |sum, (x, y)| sum.add(&x.mul(y)))
}

impl Certified {
    /// The solution near y and x; `None` where that is not shown, or not whether it is real.
    pub fn near(wanted: &Wanted, [y, x]: &[Vec<Complex<LongFloat>>; 2]) -> Option<Self> {
        let directions = usize::from(y.len() == 3);
        let size = |z: &Complex<LongFloat>| crate::solve::scalar::narrowed(*z).norm_sqr();
        let chart = (0..y.len()).max_by(|j, k| size(&y[*j]).total_cmp(&size(&y[*k])))?;
        let last = if directions > 0 { y[chart] } else { *y.last()? };
        let over = |v: &[Complex<LongFloat>], by: Complex<LongFloat>| -> Option<Vec<Disc>> {
            let inverse = by.inverse()?;
            let disc = |z: &Complex<LongFloat>| {
                let z = z.mul(&inverse);
                centre(&Disc::point(long(z.re), long(z.im)))
            };
            Some(v[..3].iter().map(disc).collect())
        };
        let system = System { wanted, directions, chart };
        let unknowns = system.refined([over(y, last)?, over(x, *x.last()?)?].concat())?;
        let (boxes, is_real) = system.certified(unknowns)?;
        Some(Self { boxes, directions, is_real })
    }

    /// The unknowns in discs.
    pub fn place(&self) -> Place<Disc> {
        place(&self.boxes, self.directions)
    }

    /// Returns whether the moving point is proved to be another one.
    pub fn is_apart_from(&self, other: &Self) -> bool {
        self.boxes[3..].iter().zip(&other.boxes[3..]).any(|(x, y)| x.sub(y).is_not_zero())
    }
}
