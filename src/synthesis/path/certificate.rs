//! Krawczyk's theorem for a four-bar through nine points.
//!
//! For a matrix A and numbers z in discs of radii r about c, `|A f(c)| + |I - A f'(discs)| r < r` proves that f has exactly one zero
//! there. \[Krawczyk1969\] The values at c are computed in discs of 128 bits, since they cancel, and the derivatives in intervals of f64.
//! The points of the file are held in them: the proof is about their exact coordinates.

use super::class::affine;
use super::curve::{UNKNOWNS, slopes, value};
use super::homotopy::{FourBar, PLACES, Places};
use crate::algebra::disc::Disc;
use crate::algebra::interval::Interval;
use crate::algebra::ring::Ring;
use crate::algebra::sort;
use crate::solve::dense::{inverse, times};
use num_complex::Complex;
use rug::{Float, Rational};

/// Bits of values.
pub const BITS: u32 = 128;
/// Newton steps that bring a corrected point to the accuracy of f64, with one to spare.
const STEPS: usize = 3;
/// A radius is at least this part of a number: a few roundings of f64.
const LEAST: f64 = 8.0 * f64::EPSILON;
/// Numbers smaller than this are as far off as this one.
const SMALL: f64 = 1e-3;
/// Two numbers that are off from conjugates by less, relative to the larger, are taken for real and must then be proved so.
const REAL: f64 = 1e-9;
/// Room for the roundings of sums of bounds in f64.
const MARGIN: f64 = 1.000_001;

/// The numbers of a four-bar without h.
pub type Affine<T> = [T; PLACES];

/// The places of a problem in each kind of numbers.
pub struct Data {
    pub places: Places,
    discs: [[Disc; 2]; PLACES],
    intervals: [[Complex<Interval>; 2]; PLACES],
}

impl Data {
    /// Reads places from their coordinates.
    pub fn of(points: &[[Rational; 2]; PLACES]) -> Self {
        let places = points.each_ref().map(|[x, y]| {
            let z = Complex::new(x.to_f64(), y.to_f64());
            [z, z.conj()]
        });
        let i = Disc::point(Float::new(1), Float::with_val(1, 1));
        let discs = points.each_ref().map(|[x, y]| {
            let (x, y) = (Disc::of(x, BITS), Disc::of(y, BITS).mul(&i));
            [x.add(&y), x.sub(&y)]
        });
        let intervals = points.each_ref().map(|[x, y]| {
            let [x, y] = [x, y].map(|q| Interval::from_rational(q).unwrap_or(Interval::ENTIRE));
            [Complex::new(x, y), Complex::new(x, y.neg())]
        });
        Self { places, discs, intervals }
    }

    fn residual(&self, z: &Affine<Complex<f64>>) -> Affine<Disc> {
        let exact = with_one(z.map(|z| disc(z, 0.0)));
        self.discs.each_ref().map(|[d, e]| value(&exact, d, e))
    }

    fn jacobian(&self, z: &Affine<Complex<f64>>) -> [Affine<Complex<f64>>; PLACES] {
        let v = with_one(*z);
        self.places.each_ref().map(|[d, e]| without_first(&slopes(&v, d, e).gradient))
    }

    /// The discs in which a four-bar is proved to be the only one; `None` where that is not shown.
    pub fn certificate(&self, near: &FourBar) -> Option<Certified> {
        let mut z = affine(near);
        for _ in 0..STEPS {
            let matrix = inverse(&self.jacobian(&z))?;
            let residual = self.residual(&z).map(|value| Complex::new(value.re.to_f64(), value.im.to_f64()));
            let step = times(&matrix, &residual);
            z = std::array::from_fn(|k| z[k] - step[k]);
        }
        let is_real = (0..4).all(|k| (z[2 * k] - z[2 * k + 1].conj()).norm() <= REAL * z[2 * k].norm().max(SMALL));
        if is_real {
            z = std::array::from_fn(|k| {
                let pair = 0.5 * (z[k & !1] + z[k | 1].conj());
                if k % 2 == 0 { pair } else { pair.conj() }
            });
        }
        let matrix = inverse(&self.jacobian(&z))?;
        let residual = self.residual(&z);
        let step: Affine<f64> = std::array::from_fn(|i| {
            let products = matrix[i].iter().zip(&residual).map(|(a, f)| disc(*a, 0.0).mul(f));
            products.fold(Disc::zero(), |sum, term| sum.add(&term)).at_most().to_f64() * MARGIN
        });
        let own: Affine<f64> = std::array::from_fn(|k| 2.0 * step[k] + LEAST * z[k].norm().max(SMALL));
        // The discs of conjugates are conjugates where the four-bar may be real.
        let radii: Affine<f64> = std::array::from_fn(|k| if is_real { own[k].max(own[k ^ 1]) } else { own[k] });
        let boxes = with_one(std::array::from_fn(|k| {
            Complex::new(Interval::around(z[k].re, radii[k]), Interval::around(z[k].im, radii[k]))
        }));
        let derivatives = self.intervals.each_ref().map(|[d, e]| without_first(&slopes(&boxes, d, e).gradient));
        let matrix = matrix.map(|row| row.map(|a| Complex::new(Interval::from_f64(a.re), Interval::from_f64(a.im))));
        for (i, row) in matrix.iter().enumerate() {
            let mut reach = step[i];
            for k in 0..PLACES {
                let unit = if i == k { Complex::<Interval>::one() } else { Complex::<Interval>::zero() };
                let off = row
                    .iter()
                    .zip(&derivatives)
                    .fold(unit, |sum, (a, slope)| Ring::sub(&sum, &Ring::mul(a, &slope[k])));
                reach += (off.re.magnitude() + off.im.magnitude()) * radii[k] * MARGIN;
            }
            // Also false for NaN.
            if !(reach * MARGIN < radii[i]) {
                return None;
            }
        }
        let is_complex =
            (0..4).any(|k| (z[2 * k] - z[2 * k + 1].conj()).norm() > MARGIN * (radii[2 * k] + radii[2 * k + 1]));
        let discs = std::array::from_fn(|k| disc(z[k], radii[k]));
        // The conjugate of a real zero's neighbour in discs that are their own conjugates is a zero in them: they are one.
        (is_real || is_complex).then_some(Certified { discs, is_real })
    }
}

/// A four-bar that is proved to be in these discs, and to be the only one there.
pub struct Certified {
    pub discs: Affine<Disc>,
    pub is_real: bool,
}

fn disc(z: Complex<f64>, radius: f64) -> Disc {
    Disc::new(Float::with_val(BITS, z.re), Float::with_val(BITS, z.im), &Float::with_val(BITS, radius))
}

fn with_one<R: Ring>(z: Affine<R>) -> [R; UNKNOWNS] {
    let mut rest = z.into_iter();
    std::array::from_fn(|k| if k == 0 { R::one() } else { rest.next().unwrap_or_else(R::zero) })
}

fn without_first<R: Clone>(v: &[R; UNKNOWNS]) -> Affine<R> {
    std::array::from_fn(|k| v[k + 1].clone())
}

impl Certified {
    /// Whether dyads, couplers and frame have lengths, and the coupler has one turn at every place, not 0 and not infinite: none of the
    /// numbers in the discs is such that the conditions hold without a linkage.
    pub fn is_linkage(&self, data: &Data) -> bool {
        let [x, x_star, a, a_star, y, y_star, b, b_star] = &self.discs;
        let lengths =
            [(x, a), (x_star, a_star), (y, b), (y_star, b_star), (x, y), (x_star, y_star), (a, b), (a_star, b_star)];
        let v = with_one(self.discs.clone());
        let turns = data.discs.iter().flat_map(|[d, e]| super::curve::turn(&v, d, e));
        lengths.iter().all(|(one, other)| one.sub(other).is_not_zero())
            && turns.into_iter().all(|part| part.is_not_zero())
    }
}

/// Returns whether all classes with these numbers are proved to be different: of every two some number is.
pub fn are_distinct(classes: &[[Disc; 3]]) -> bool {
    let bounds = |class: &[Disc; 3]| {
        let (middle, radius) =
            (class[0].re.to_f64(), MARGIN * class[0].radius().to_f64() + LEAST * class[0].re.to_f64().abs());
        [middle - radius, middle + radius]
    };
    let mut sorted: Vec<([f64; 2], &[Disc; 3])> = classes.iter().map(|class| (bounds(class), class)).collect();
    sort::by(&mut sorted, |(one, _), (other, _)| one[0].total_cmp(&other[0]));
    sorted.iter().enumerate().all(|(k, ([_, end], own))| {
        let near = sorted[k + 1..].iter().take_while(|([begin, _], _)| begin <= end);
        near.into_iter().all(|(_, other)| own.iter().zip(*other).any(|(one, other)| one.sub(other).is_not_zero()))
    })
}
